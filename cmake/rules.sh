#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Rules of the code base that a grep can check.
set -u
shopt -s lastpipe  # `refuse` at the end of a pipe is this shell: what it notes is still there at the end
cd "$(dirname "$0")/.."
bad=0
refuse() { # refuse SENTENCE, reads offending lines
  local lines
  lines=$(cat)
  [ -z "$lines" ] && return
  printf '%s\n%s\n' "$1" "$lines"
  bad=1
}
echo "a line" | refuse "" >/dev/null
[ "$bad" -eq 1 ] || { echo "a broken rule would go unnoticed"; exit 1; }
bad=0
python3 cmake/layers.py >/dev/null || python3 cmake/layers.py | refuse "The folders of core stand on each other:"
python3 cmake/quotes.py 2>&1 | refuse "A document quotes its source as it is:"
docs/pictures.sh --check 2>&1 | refuse "A picture of the documents is missing, too large, not used or older than its inputs (docs/pictures.sh PREFIX_OR_BUILD):"
python3 cmake/code_size.py 2>&1 >/dev/null | refuse "Too large:"
python3 cmake/docstrings.py | refuse "A public declaration has no docstring:"
git ls-files core links sdk plugins tools bench examples | grep -E '\.(cpp|hpp|h|c)$' | grep -v '^core/test/abi_1/' | xargs python3 cmake/commas.py |
  refuse "One statement a line, not a chain of commas (cmake/commas.py --fix FILE splits it):"
git grep -nE '^#include [<"](core|links)/' -- plugins sdk examples | refuse "Plugins and SDK must not include core:"
git grep -nE '^#include [<"]links/' -- core tools | grep -vE '^[^:]*/test/|links/[a-z]+/(library|stats)\.hpp' | refuse "Of a library in links/ the host includes what it opens it by:"
git grep -nE '^#include [<"](\.\./)*plugins/' -- core links sdk plugins | grep -vE '^plugins/([^/]+)/test/.*plugins/\1/|^plugins/fcu_serial/test/peer/.*plugins/sim_aero/|^core/app/test/frail\.cpp:' |
  refuse "Nobody includes a plugin but its own test, the peer that flies the simulated aircraft, and the test that makes all of them fail:"
git grep -nE '^#include [<"]fulmar/' -- core links | grep -vE '^[^:]*/test/|fulmar/(abi\.h|diagnostic\.hpp|quiet_thread\.hpp)' | refuse "Core and links include abi.h, diagnostic.hpp and quiet_thread.hpp of the SDK alone:"
git grep -nE '#include <(yaml-cpp|boost|spdlog|fastdds|CLI)' -- sdk plugins | grep -vE '^(plugins/fcu_serial/(link|test/peer)/|sdk/test/flight/airframe_file[.]cpp)' | refuse "Only core links yaml-cpp, Boost.DLL, spdlog and Fast DDS:"
git grep -nE 'std::chrono|clock_gettime|gettimeofday|std::random_device|\brand\(' -- plugins sdk/include | grep -vE '/test/|^plugins/fcu_serial/link/' | refuse "Time comes from the vehicle and chance from the seed:"
git grep -nIE '(^|[^[:alnum:]_.])/(work|root|home|farm)/' -- . | refuse "No path of one machine:"
git grep -nIE '\b(TODO|FIXME|XXX|HACK|TEMPORARY)\b' -- '*.cpp' '*.hpp' '*.h' '*.c' '*.mjs' '*.txt' '*.cmake' | refuse "Finish it:"
for file in $(git ls-files '*.cpp' '*.hpp' '*.h' '*.c' '*.sh' '*.cmake' '*CMakeLists.txt' '*.mjs'); do
  head -n 3 "$file" | grep -q 'SPDX-License-Identifier: BSD-3-Clause' || echo "$file"
done | refuse "Every source file names its licence:"
# The files of a folder are compiled together: of two helpers with one name, each in an unnamed namespace, the wrong one could be called without a report.
for folder in $(git ls-files 'core/*.cpp' 'links/*.cpp' 'tools/*.cpp' 'plugins/*.cpp' | grep -v '/test/' | xargs -n 1 dirname | sort -u); do
  for file in $(git ls-files "$folder/*.cpp" | grep -E "^$folder/[^/]+$"); do
    sed -nE 's/^([A-Za-z_][A-Za-z0-9_:<>,&* ]*[ &*])([a-z_][a-z0-9_]*)\(.*/\2/p; s/^(struct|class|enum class|enum) ([A-Za-z0-9_]+).*\{.*/\2/p' "$file" |
      sort -u | sed "s|\$| $file|"
  done | sort | awk '$1 == "main" { next } $1 == last { print $1 ": " file ", " $2 } { last = $1; file = $2 }'
done | refuse "A name is given once in a folder:"
python3 cmake/prose.py >/dev/null || python3 cmake/prose.py | refuse "Texts break docs/style.md:"
python3 cmake/phrases.py >/dev/null || python3 cmake/phrases.py | refuse "Tests assert codes and values, not sentences:"
python3 cmake/mutate.py --only-list 2>&1 | refuse "Each listed fault has a place of its own:"
# Subjects of commits since the first one under this rule: `area: verb what`. A shallow clone without that commit skips the check.
first=d2c08a6718df44440e1e08a9b19a3b70e239fb27
if git merge-base --is-ancestor "$first" HEAD 2>/dev/null; then
  git log --no-merges --format='%h %s' "$first..HEAD" | grep -vE '^[0-9a-f]+ [a-z0-9_./-]+(, [a-z0-9_./-]+)*: [a-z][^ ]* .' |
    refuse "The subject of a commit is 'area: verb what' (CONTRIBUTING.md):"
  git log --no-merges --format='%s' "$first..HEAD" | awk 'length($0) > 72 { print length($0) ": " $0 }' | refuse "The subject of a commit has at most 72 characters:"
fi
exit $bad

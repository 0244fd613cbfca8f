#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Cost of compiling: processor seconds per object, per target and in total, without a compiler cache; and the build time of an author's
# plugin, relative to a file that only includes Eigen.
#   build_cost.sh [--revision REV] [--tests] [--top N]     REV: another revision of this repository, built in a folder of its own
#   build_cost.sh --plugin [--revision REV]                only the figures of a plugin
set -euo pipefail
cd "$(dirname "$0")/.."
revision="" top=25 targets=(flight) configure=(-DFULMAR_TESTS=OFF) plugin_only=no
while [ $# -gt 0 ]; do
  case $1 in
    --revision) revision=$2; shift ;;
    --tests) targets=(all) configure=(-DFULMAR_TESTS=ON) ;;
    --top) top=$2; shift ;;
    --plugin) plugin_only=yes ;;
    *) sed -n '3,6s/^# \{0,1\}//p' "$0"; exit 2 ;;
  esac
  shift
done
scratch=$(mktemp -d)
trap 'git worktree remove --force "$scratch/tree" 2>/dev/null || true; rm -rf "$scratch"' EXIT
tree=$PWD
if [ -n "$revision" ]; then
  git worktree add -q --detach "$scratch/tree" "$revision"
  tree=$scratch/tree
fi

# processor_s COMMAND...: user and system time of the fastest of three runs
processor_s() {
  local TIMEFORMAT='%U %S'
  for _ in 1 2 3; do { time "$@" >/dev/null 2>&1; } 2>&1; done | awk '{print $1 + $2}' | sort -n | head -n 1
}
eigen=-I/usr/include/eigen3
command -v pkg-config >/dev/null && eigen=$(pkg-config --cflags-only-I eigen3)
flags=(-std=c++20 -O2 -fPIC -ffp-contract=off "-I$tree/sdk/include" ${eigen//-I/-isystem } -c -o "$scratch/out.o")
printf '#include <Eigen/Dense>\n#include <iostream>\n' >"$scratch/eigen.cpp"
mkdir "$scratch/law"
cp "$tree/sdk/template/my_law.cpp" "$scratch/law/"
cp "$tree/sdk/template/roles/outer.hpp" "$scratch/law/my_law.hpp"
of_eigen=$(processor_s c++ "${flags[@]}" "$scratch/eigen.cpp")
of_law=$(processor_s c++ "${flags[@]}" "$scratch/law/my_law.cpp")
of_slc=$(processor_s c++ "${flags[@]}" "$tree/plugins/control_slc/control_slc.cpp")
echo "control_slc.cpp: $of_slc s; the law of 'fulmar new --role outer': $of_law s; Eigen/Dense and iostream: $of_eigen s" \
  "(law / Eigen: $(awk "BEGIN { printf \"%.2f\", $of_law / $of_eigen }"))"
[ $plugin_only = no ] || exit 0

# Precedes the compiler, as ccache does otherwise.
cat >"$scratch/timed" <<'END'
#!/usr/bin/env bash
TIMEFORMAT='%3U %3S'
object=- before=
for word in "$@"; do [ "$before" = -o ] && object=$word; before=$word; done
exec 3>&2
status=0
cost=$({ time "$@" 2>&3 3>&-; } 2>&1) || status=$?
printf '%s %s\n' "${cost##*$'\n'}" "$object" >>"$(dirname "$0")/costs"
exit $status
END
chmod +x "$scratch/timed"
cmake -S "$tree" -B "$scratch/build" -G Ninja "-Dccache_program=$scratch/timed" "${configure[@]}" >"$scratch/configure.log" 2>&1 ||
  { cat "$scratch/configure.log"; exit 1; }
begin=$SECONDS
ninja -C "$scratch/build" "${targets[@]}" >"$scratch/build.log" 2>&1 || { tail -n 40 "$scratch/build.log"; exit 1; }
wall=$((SECONDS - begin))

awk '{ printf "%.1f %s\n", $1 + $2, $3 }' "$scratch/costs" | sort -rn >"$scratch/sorted"
sed 's|/CMakeFiles/|/|; s|\.dir/| |; s|\.o$||' "$scratch/sorted" | head -n "$top" | awk 'BEGIN { print "processor s  target  file" } { printf "%11.1f  %s  %s\n", $1, $2, $3 }'
echo
sed 's|/CMakeFiles/|/|; s|\.dir/.*||' "$scratch/sorted" |
  awk '{ cost[$2] += $1; n[$2]++ } END { for (t in cost) printf "%11.1f  %s (%d objects)\n", cost[t], t, n[t] }' | sort -rn | head -n "$top" | sed '1i processor s  target'
awk -v wall=$wall -v cores="$(nproc)" '{ all += $1; n++ } END { printf "\nin all: %.0f processor seconds for %d objects, %d s of wall time on %d cores\n", all, n, wall, cores }' "$scratch/sorted"

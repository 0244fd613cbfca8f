#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Tests the installed prefix and the pair of Debian packages. In the prefix, outside the tree, a new plugin for every role is
# written, built with warnings as errors, tested and flown. The packages hold the same files, programs without their symbols. In each, a
# plugin for one role is written and flown; a plugin is built by pkg-config alone; the debugger stops in a plugin in flight; the model as a
# library flies from C++ and from Python.
#   installed.sh [--one] [BUILD]     --one: the prefix and the plugin for one role alone
set -euo pipefail
cd "$(dirname "$0")/.."
root=$PWD
one=
if [ "${1:-}" = --one ]; then
  one=yes
  shift
fi
build=$PWD/${1:-build}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

fail() { echo "$*"; exit 1; }
# quietly COMMAND...: shows its output only when it fails
quietly() { "$@" >"$scratch/output.log" 2>&1 || { tail -n 40 "$scratch/output.log"; fail "failed: $*"; }; }
exports_entry_alone() {
  local symbols
  symbols=$(nm -D --defined-only "$1" | awk '{print $3}')
  [ "$symbols" = fulmar_plugin_entry ] || fail "$1 exports: $symbols"
}

# project PREFIX NAME FLIGHT WORDS...: new NAME WORDS, build, test, fly (FLIGHT: options of run); no guard may fire
project() {
  local prefix=$1 name=$2 flight=$3
  shift 3
  quietly "$prefix/bin/fulmar" new "$name" "$@"
  (
    cd "$name"
    quietly cmake --preset default -DCMAKE_CXX_FLAGS=-Werror
    quietly cmake --build build
    quietly ctest --test-dir build --output-on-failure
    exports_entry_alone "build/lib/fulmar/$name.so"
    # shellcheck disable=SC2086
    "$prefix/bin/fulmar" run mission.yaml $flight --json --no-log >result.json 2>run.log || { tail -n 20 run.log result.json; fail "$name did not fly"; }
    grep -q '"result": "flown"' result.json || fail "$name: $(grep '"result"' result.json)"
    grep -q '"guards": \[\]' result.json || { cat result.json; fail "$name: a guard fired"; }
  )
  echo "  $*: written, built, tested, flown"
}

# geodesy PREFIX: its header links by one word; without GeographicLib a plugin that does not use it is still configured.
geodesy() {
  local prefix=$1 words
  quietly "$prefix/bin/fulmar" new my_place --in state=nav.state --out range=Range
  (
    cd my_place
    sed -i 's|#include <fulmar/plugin.hpp>|&\n#include <fulmar/flight/earth/geodesy.hpp>|; s|// Your law goes here.|LocalFrame(40, -111, 1400).to_ned(40, -111, in.state->height_m).allFinite();|' my_place.hpp
    sed -i 's|fulmar_add_plugin(my_place my_place.cpp|& GEODESY|' CMakeLists.txt
    quietly cmake --preset default -DCMAKE_CXX_FLAGS=-Werror
    quietly cmake --build build
    quietly ctest --test-dir build --output-on-failure
    quietly "$prefix/bin/fulmar" run mission.yaml --duration 10 --no-log
    rm -rf build
    if cmake --preset default -DFULMAR_GEOGRAPHIC_LIBRARY=OFF >cmake.log 2>&1; then fail "GEODESY without GeographicLib is not refused"; fi
    words=$(tr -s ' \n' ' ' <cmake.log)
    case $words in *"GEODESY needs GeographicLib, which is not here"*) ;; *) fail "$words" ;; esac
    sed -i 's| GEODESY||' CMakeLists.txt
    rm -rf build
    quietly cmake --preset default -DFULMAR_GEOGRAPHIC_LIBRARY=OFF
  )
  echo "  geodesy: one word links it, and nobody else needs GeographicLib"
}

# model_library PREFIX: a project that is no plugin links fulmar::sim and flies, with nothing of the host; so does the Python module.
model_library() {
  local prefix=$1 folder said
  folder=$(dirname "$(find "$prefix" -path '*/dist-packages/fulmar_sim' -print -quit)")
  cp -r "$prefix/share/fulmar/examples/batch" .
  (
    cd batch
    quietly cmake -B build -G Ninja -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_CXX_FLAGS="-Wall -Wextra -Wpedantic -Werror"
    quietly cmake --build build
    quietly ./build/best_turn
    grep -q '^14 deg of aileron: ' "$scratch/output.log" || { cat "$scratch/output.log"; fail "best_turn flies otherwise"; }
    if ldd build/best_turn | grep -E 'not found|fastrtps|libssl'; then fail "the model needs more than it should"; fi
  )
  /usr/bin/python3 -c 'import numpy' 2>/dev/null || { echo "  fulmar::sim: an outside project steps; no numpy here: the module was not tried"; return; }
  said=$(cd / && PYTHONPATH=$folder /usr/bin/python3 -B -c '
import fulmar_sim
sim = fulmar_sim.Simulation("fulmar:airframes/anaconda.yaml", n=3, threads=2)
sim.fly(100, 17)
print(fulmar_sim.__file__, *sim.step(sim.trim, steps=400)[:, 0].round(2))') || fail "the installed module does not fly"
  [ "$said" = "$folder/fulmar_sim/__init__.py 17.0 17.0 17.0" ] || fail "the installed module: $said"
  echo "  fulmar::sim: an outside project steps; so does import fulmar_sim"
}

# other_law NAME ROLE: an author writes a law of his own in place of the generated one: its test still passes, since it states the contract.
other_law() {
  sed "s/MyLaw/$(sed -n 's/^struct \([A-Za-z]*\) {.*/\1/p' "$1/$1.hpp" | tail -n 1)/" "$root/sdk/test/other_laws/$2/my_law.hpp" >"$1/$1.hpp"
  quietly cmake --build "$1/build"
  quietly ctest --test-dir "$1/build" --output-on-failure
  echo "  $1: another law in its place, and its test passes"
}

# A mission with roles and messages that no template knows.
own_roles() {
  cat >own.yaml <<YAML
mission: own
extends: $1/share/fulmar/missions/common.yaml
airframe: $1/share/fulmar/airframes/anaconda.yaml
origin: {lat: 40.2463724, lon: -111.6474138, alt_msl: 1387 m}
done: "manage.progress.circuits >= 1"
roles:
  judge: {in: {state: nav.state, truth: vehicle.truth, command: guide.command}, out: {estimation: EstimationError, figures: Figures}}
components:
  sim: {params: {sensors: rosflight, start_heading: 135 deg}}
  plan: {params: {plan: $1/share/fulmar/plans/hourglass.yaml}}
  referee: {fills: judge, use: score/Score, rate: 50 Hz}
YAML
}

by_pkg_config() {
  local prefix=$1
  quietly "$prefix/bin/fulmar" new by_hand --role outer
  (
    cd by_hand
    export PKG_CONFIG_PATH=$prefix/share/pkgconfig
    local flags
    flags=$(pkg-config --cflags --libs fulmar_sdk)
    # shellcheck disable=SC2086
    ${CXX:-g++} -std=c++20 -O2 -Wall -Wextra -shared by_hand.cpp $flags -o by_hand.so
    exports_entry_alone by_hand.so
    sed -i 's|build/lib/fulmar/by_hand.so|by_hand.so|' mission.yaml  # beside the mission
    quietly "$prefix/bin/fulmar" run mission.yaml --duration 60 --no-log
    mkdir elsewhere && mv by_hand.so elsewhere
    FULMAR_PLUGIN_PATH=$PWD/elsewhere quietly "$prefix/bin/fulmar" run mission.yaml --duration 10 --no-log
  )
  echo "  pkg-config: $(PKG_CONFIG_PATH=$prefix/share/pkgconfig pkg-config --modversion fulmar_sdk), built and flown"
}

in_debugger() {
  local prefix=$1 name=$2 line
  if ! command -v gdb >/dev/null; then echo "  no gdb here: the debugger was not tried"; return; fi
  line=$(grep -n 'h_error = ' "$name/$name.hpp" | head -n 1 | cut -d: -f1)
  cd "$name"
  timeout 120 gdb -batch -nx -ex 'set breakpoint pending on' -ex 'set debuginfod enabled off' -ex "break $name.hpp:$((line + 1))" -ex run \
    -ex 'print h_error' -ex 'backtrace 1' -ex kill --args "$prefix/bin/fulmar" run mission.yaml --no-log >gdb.log 2>&1 || true
  grep -qE "^(Thread .* hit )?Breakpoint 1, .*$name.hpp:" gdb.log || grep -qE "Breakpoint 1, .*step" gdb.log || { tail -n 20 gdb.log; fail "gdb did not stop in $name.hpp"; }
  grep -qE '^\$1 = -?[0-9]' gdb.log || { tail -n 20 gdb.log; fail "gdb did not print h_error"; }
  echo "  gdb: stopped in $name.hpp:$((line + 1)), h_error$(grep '^\$1' gdb.log | cut -c3-)"
  cd ..
}

# The unit that flies a mission is one that systemd understands.
systemd_unit() {
  if ! command -v systemd-analyze >/dev/null; then echo "  no systemd here: its unit was not checked"; return; fi
  mkdir -p units
  sed "s|^ExecStart=fulmar |ExecStart=$1/bin/fulmar |" "$1/lib/systemd/system/fulmar@.service" >units/fulmar@.service
  SYSTEMD_UNIT_PATH=$PWD/units: systemd-analyze verify --man=no "$PWD/units/fulmar@hourglass.service" >unit.log 2>&1 && ! grep -q . unit.log ||
    { cat unit.log; fail "systemd does not like the unit"; }
  echo "  systemd: fulmar@.service is in order"
}

# each_role PREFIX: what can be asked of `fulmar new`, in the present folder
each_role() {
  local prefix=$1
  own_roles "$prefix"
  for role in vehicle nav guide inner; do project "$prefix" "my_$role" "--duration 60" --role "$role"; done
  project "$prefix" my_point_mass "--duration 60" --role vehicle --template point_mass
  project "$prefix" my_judge "--duration 60" --role judge --mission own.yaml
  project "$prefix" my_cascade "--duration 120" --role outer --role inner
  project "$prefix" my_part "--duration 60" --in state=nav.state --in "notices=vehicle.notices[]" --out range=Range --out "edits=PlanEdit[]"
  project "$prefix" my_sensor "--duration 60" --template sensor
  project "$prefix" my_planner "" --template planner
  geodesy "$prefix"
}

# usable PREFIX: the rest of the above
usable() {
  local prefix=$1
  project "$prefix" my_outer "" --role outer
  model_library "$prefix"
  by_pkg_config "$prefix"
  in_debugger "$prefix" my_outer
  other_law my_outer outer
  systemd_unit "$prefix"
  page "$prefix"
  links "$prefix"
  "$prefix/bin/fulmar" run "$prefix/share/fulmar/missions/hourglass.yaml" --duration 60 --log hourglass.mcap >/dev/null 2>&1 || fail "the installed hourglass does not fly"
  quietly "$prefix/bin/fulmar" replay hourglass.mcap
}

# page PREFIX: a browser gets the page from what is installed, if this was built with it
page() {
  [ -e "$build/share/fulmar/web/index.html" ] || { echo "  built without Node.js and npm: no page of the flight"; return; }
  "$1/bin/fulmar" run "$1/share/fulmar/missions/hourglass.yaml" --speed real --live 127.0.0.1:8774 --duration 30 --no-log >/dev/null 2>&1 &
  local flight=$! got=""
  for _ in $(seq 50); do
    got=$(python3 -c 'import urllib.request as u; print(u.urlopen("http://127.0.0.1:8774/").read().decode())' 2>/dev/null) && break
    sleep 0.2
  done
  kill "$flight"
  wait "$flight" 2>/dev/null || true
  [[ "$got" == *page.js* ]] || fail "the installed host does not serve the page"
}

# links PREFIX: the host's libraries are loaded from the prefix for a mission that has their section, and for no other
links() {
  local libraries section host=$1/lib/fulmar/host
  libraries=$(ldd "$1/bin/fulmar")
  ! grep -iE 'fastrtps|fastcdr|foonathan' <<<"$libraries" || fail "the host links Fast DDS"
  printf 'mission: linked\nextends: %s\nlive: {listen: 127.0.0.1:0}\ndds: {domain: 231, export: [nav.state]}\n' "$1/share/fulmar/missions/hourglass.yaml" >linked.yaml
  quietly "$1/bin/fulmar" run linked.yaml --speed 20 --duration 5 --no-log
  mkdir -p away
  for section in live dds; do
    mv "$host/fulmar_$section.so" away
    if "$1/bin/fulmar" run linked.yaml --speed 20 --duration 5 --no-log >link.log 2>&1; then fail "a flight without its library for $section is not refused"; fi
    grep -qE "linked.yaml:[34]: $section: " link.log || { cat link.log; fail "the missing library for $section is not named"; }
    mv "away/fulmar_$section.so" "$host"
  done
  mv "$host"/*.so away
  quietly "$1/bin/fulmar" run linked.yaml --duration 5 --no-log  # as fast as the machine allows: without onlookers
  mv away/*.so "$host"
  echo "  live, dds: loaded where a mission has them"
}

if [ -n "$one" ]; then
  quietly cmake --install "$build" --prefix "$scratch/prefix"
  mkdir "$scratch/work" && cd "$scratch/work"
  project "$scratch/prefix" my_outer "" --role outer
  exit 0
fi

echo "hardening"
bash cmake/hardening.sh "$build"

echo "installed prefix"
quietly cmake --install "$build" --prefix "$scratch/first"
mv "$scratch/first" "$scratch/prefix"  # nothing remembers where it was installed to
# contents FOLDER: the files below, each with its sum; programs and libraries, which a package has without their symbols, with `elf`
contents() { (cd "$1" && find . -type f | sort | while read -r file; do
  if head -c 4 "$file" | grep -q ELF; then echo "elf $file"; else sha256sum "$file"; fi
done); }
contents "$scratch/prefix" >"$scratch/installed"
# Made at once, before anything else is written into the build folder.
if command -v dpkg-shlibdeps >/dev/null; then quietly cpack --config "$build/CPackConfig.cmake" -B "$scratch/packages"; fi
mkdir "$scratch/work" && (cd "$scratch/work" && usable "$scratch/prefix" && each_role "$scratch/prefix")

echo "Debian packages"
command -v dpkg-shlibdeps >/dev/null || { echo "  no dpkg-dev here: the packages were not made"; exit 0; }
debs=("$scratch"/packages/fulmar_*.deb "$scratch"/packages/fulmar-dev_*.deb)
files() { dpkg-deb -c "$1" | awk '$1 !~ /^d/ {print $6}' | sort; }
common=$(comm -12 <(files "${debs[0]}") <(files "${debs[1]}"))
[ -z "$common" ] || fail "in both packages: $common"
! files "${debs[0]}" | grep -E '/include/|/cmake/|/pkgconfig/|/template/' || fail "the runtime package holds parts of the SDK"
! files "${debs[1]}" | grep -E '/bin/|\.so$' || fail "the development package holds parts of the runtime"
dpkg-deb -f "${debs[0]}" Depends | grep -q libyaml-cpp || fail "the package fulmar names no libraries"
dpkg-deb -f "${debs[1]}" Depends | grep -q 'fulmar (= ' || fail "the package fulmar-dev does not depend on fulmar"
for deb in "${debs[@]}"; do echo "  $(basename "$deb"), $(($(stat -c %s "$deb") / 1024)) kB: $(dpkg-deb -f "$deb" Depends)"; done
dpkg-deb -x "${debs[0]}" "$scratch/runtime"
if "$scratch/runtime/usr/bin/fulmar" new my_law --role outer --dir "$scratch/none" 2>"$scratch/words"; then fail "without the SDK there is nothing to write"; fi
grep -q 'install the package fulmar-dev' "$scratch/words" || { cat "$scratch/words"; fail "the missing SDK is not named"; }
for deb in "${debs[@]}"; do dpkg-deb -x "$deb" "$scratch/root"; done
diff "$scratch/installed" <(contents "$scratch/root/usr") || fail "the packages hold other files than the installed prefix"
mkdir "$scratch/work2" && (cd "$scratch/work2" && usable "$scratch/root/usr")
echo "prefix and packages fly"

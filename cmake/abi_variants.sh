#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds one control law in every way that its author may choose, for one host: other compiler, other optimisation, other C++ library
# mode, other version of a message. Layouts are equal, the mission is flown; fast-math is rejected.
set -euo pipefail
cd "$(dirname "$0")/.."
root=$PWD build=$PWD/${1:-build}
fulmar=$build/bin/fulmar
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
export FULMAR_STORE=$scratch/store

first=${CXX:-g++} other=clang++
case $("$first" --version | head -n 1) in *clang*) other=g++ ;; esac
eigen=$(pkg-config --cflags-only-I eigen3 2>/dev/null || echo -I/usr/include/eigen3)
eigen=${eigen//-I/-isystem }  # its own warnings are not ours
usual="-std=c++20 -shared -fPIC -fvisibility=hidden -fvisibility-inlines-hidden -ffp-contract=off -Wall -Wextra -Wl,--version-script=$root/sdk/cmake/plugin.version -Wl,-z,defs"

cp sdk/template/roles/outer.hpp "$scratch/my_law.hpp"
cp sdk/template/my_law.cpp "$scratch/my_law.cpp"
cat >"$scratch/base.yaml" <<END
mission: variant
extends: $root/configs/missions/common.yaml
airframe: $root/configs/airframes/anaconda.yaml
origin: {lat: 40.2463724, lon: -111.6474138, alt_msl: 1387 m}
seed: 7
done: "manage.progress.circuits >= 1"
END

# compile COMPILER NAME SOURCE [flag...]: builds a plugin in $scratch. An include folder among the flags precedes the SDK's own.
compile() {
  local compiler=$1 name=$2 source=$3 unique=""
  shift 3
  case $("$compiler" --version | head -n 1) in *clang*) ;; *) unique=-fno-gnu-unique ;; esac
  # shellcheck disable=SC2086
  "$compiler" $usual $unique "$@" -I"$root/sdk/include" $eigen "$source" -o "$scratch/$name.so"
}

# mission NAME COMPONENT ROLE: NAME.so fills the role in cruise
mission() {
  {
    cat "$scratch/base.yaml"
    echo "components:"
    echo "  sim:  {params: {sensors: rosflight, turbulence: none, start_heading: 135 deg}}"
    echo "  plan: {params: {plan: $root/configs/plans/hourglass.yaml}}"
    echo "  mine: {fills: $3, use: $1.so, $2}"
    case $3 in
      outer) echo "phases: {cruise: {outer: {use: mine, fallback: slc}}}" ;;
      nav) echo "phases: {hold: {nav: mine, outer: slc, next: [{to: takeoff, when: \"vehicle.status.armed\"}]}," \
        "takeoff: {nav: mine, outer: {use: slc, set: {law: takeoff}}, next: [{to: cruise, when: \"nav.state.height_m > 30 m\"}]}," \
        "cruise: {nav: mine, outer: slc}}" ;;
    esac
  } >"$scratch/$1.yaml"
}

# fly NAME: runs to the end, without a guard
fly() {
  "$fulmar" run "$scratch/$1.yaml" --json --no-log >"$scratch/$1.json" 2>"$scratch/$1.err" || { cat "$scratch/$1.err"; echo "$1: not flown"; exit 1; }
  grep -q '"result": "flown"' "$scratch/$1.json" || { cat "$scratch/$1.json"; echo "$1: not flown"; exit 1; }
  grep -q '"guards": \[\]' "$scratch/$1.json" || { cat "$scratch/$1.json"; echo "$1: a guard fired"; exit 1; }
}

# layout NAME: the host's view of ports, messages and parameters, without the line of the file itself
layout() { "$fulmar" inspect "$scratch/$1.so" --fields | sed '1,/^$/d'; }

# refused NAME PATTERN: `check` rejects it with this code
refused() {
  if FULMAR_MESSAGES=codes "$fulmar" check "$scratch/$1.yaml" >"$scratch/$1.txt" 2>&1; then echo "$1: accepted"; exit 1; fi
  grep -q -- "$2" "$scratch/$1.txt" || { cat "$scratch/$1.txt"; echo "$1: rejected with another code than: $2"; exit 1; }
  grep -- "$2" "$scratch/$1.txt" | sed "s|^$scratch/||"
}

# variant NAME COMPILER [flag...]: same layout, flies
variant() {
  local name=$1 compiler=$2
  shift 2
  if ! command -v "$compiler" >/dev/null; then echo "$name: no $compiler here, not tried"; return; fi
  compile "$compiler" "$name" "$scratch/my_law.cpp" "$@"
  layout "$name" >"$scratch/$name.layout"
  cmp "$scratch/usual.layout" "$scratch/$name.layout" || { diff "$scratch/usual.layout" "$scratch/$name.layout"; echo "$name: another layout"; exit 1; }
  mission "$name" "rate: 100 Hz" outer
  fly "$name"
  echo "$name: same layout, flies"
}

compile "$first" usual "$scratch/my_law.cpp" -O2
layout usual >"$scratch/usual.layout"
grep -qE 'VehicleState +value +[0-9]+ bytes +[0-9a-f]{16}' "$scratch/usual.layout"
variant usual "$first" -O2
variant other_compiler "$other" -O2
variant native "$first" -O3 -march=native
variant native_other_compiler "$other" -O3 -march=native
variant unoptimised "$first" -O0
variant library_debug "$first" -O1 -D_GLIBCXX_DEBUG -D_GLIBCXX_DEBUG_PEDANTIC

# a plugin whose internal layout depends on the instruction set: Eigen aligns its matrices for -march
geographic=-lGeographicLib
if ! "$first" -shared -fPIC "$geographic" -o "$scratch/geographic" 2>/dev/null; then geographic=-lGeographic; fi  # its older name
ekf_compiler=$other
command -v "$other" >/dev/null || ekf_compiler=$first
compile "$ekf_compiler" native_ekf plugins/estimator_ekf/estimator_ekf.cpp -O3 -march=native "$geographic"
mission native_ekf "in: {status: vehicle.status}" nav
fly native_ekf
echo "native_ekf: flies"

# Messages of other versions. A writer may have more fields than its readers, and a reader fewer than its writer.
changed_sdk() { # changed_sdk NAME MESSAGE_FILE SED: a copy of the SDK with one message changed
  mkdir -p "$scratch/$1"
  cp -r sdk/include "$scratch/$1/"
  sed -i "$3" "$scratch/$1/include/fulmar/msg/$2"
  ! cmp -s "sdk/include/fulmar/msg/$2" "$scratch/$1/include/fulmar/msg/$2" || { echo "$1: $2 is not changed"; exit 1; }
}
changed_sdk newer_writer attitude_command.hpp 's/^};/  double added_rad = 1;\n};/'
changed_sdk older_reader vehicle_state.hpp '/bool wind_valid/d'
changed_sdk newer_reader vehicle_state.hpp '/bool wind_valid/a \  double added_m = 0;'  # not among those that were appended
for name in newer_writer older_reader newer_reader; do
  compile "$first" "$name" "$scratch/my_law.cpp" -O2 -I"$scratch/$name/include"
  layout "$name" >"$scratch/$name.layout"
  ! cmp -s "$scratch/usual.layout" "$scratch/$name.layout" || { echo "$name: the message is not changed"; exit 1; }
  mission "$name" "rate: 100 Hz" outer
done
for name in newer_writer older_reader; do
  fly "$name"
  echo "$name: another layout, flies"
done
refused newer_reader "types.writer_field_missing(, added_m)"

# fast-math: rejected by the compiler in code with the SDK, and by the host in other code
for flag in -ffast-math -Ofast; do
  if compile "$first" fast_math "$scratch/my_law.cpp" $flag 2>"$scratch/fast_math.txt"; then echo "fast_math: $flag compiles"; exit 1; fi
  grep -q 'Fulmar plugins are not built with -ffast-math' "$scratch/fast_math.txt"
  echo "fast_math: refused by the compiler ($flag)"
done
start_file=$(${CC:-gcc} -print-file-name=crtfastmath.o)
if [ -f "$start_file" ]; then
  ${CC:-gcc} -std=c11 -O2 -shared -fPIC -fvisibility=hidden -Isdk/include examples/c_law/c_law.c "$start_file" -o "$scratch/fast_c.so" -lm
  mission fast_c "rate: 100 Hz" outer
  refused fast_c "loader.plugin_changes_float_mode(fast_c.so)"
else
  echo "fast_c: this compiler has no crtfastmath.o, not tried"
fi
echo "every variant does what it should"

#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Makes the pictures of the documents: docs/pictures/.
#   docs/pictures.sh PREFIX_OR_BUILD   makes all pictures with an installed Fulmar, or with a build, which it installs to a scratch folder.
#                                      It needs Chromium, and the packages of the page from a build: BUILD/web/node_modules, for a prefix
#                                      build/web/node_modules of this folder, or $FULMAR_NODE_MODULES. It takes about three minutes.
#   docs/pictures.sh --check           checks the committed pictures, without a flight
# Flights have a fixed seed, so each picture shows the same flight; page.png is taken in real time, to half a second.
# The tutorial pages draw their own pictures: the script runs their commands.
# docs/pictures/inputs.txt holds the SHA-256 of the missions, airframes, plans and tutorial programs of the pictures, without their comments.
# Exit code 1: a picture is missing, larger than 200 kB, not used or older than its inputs.
set -euo pipefail
cd "$(dirname "$0")/.."
pictures=docs/pictures
inputs=(configs/missions/{common,hourglass,safe,return_home}.yaml configs/airframes/anaconda.yaml configs/plans/hourglass.yaml
  configs/safety/fence.yaml configs/drawings/petrel.yaml examples/radar_altimeter/{mission.yaml,radar_*.hpp} docs/tutorial/[1-7]-*.md)

# The lines of a file that a flight depends on: of a page its program files and `fulmar plot` lines, of others all but comments.
lines_of() {
  case $1 in
    *.md) sed -n '/^```.* file=/,/^```$/p; /^\$ fulmar plot/p' "$1" ;;
    *) sed -E 's,(^|[[:space:]])(#|//).*$,,; s/[[:space:]]+$//; /^$/d' "$1" ;;
  esac
}
stamp() {
  local file
  for file in "${inputs[@]}"; do
    echo "$(lines_of "$file" | sha256sum | cut -c 1-64)  $file"
  done
}

check() {
  local bad=0 file used size
  used=$(git grep -hoE "pictures/[A-Za-z0-9_.-]+\.(png|svg)" -- '*.md' | sed 's,^pictures/,,' | sort -u)
  for file in $used; do
    [ -s "$pictures/$file" ] || { echo "$pictures/$file: missing"; bad=1; }
  done
  for file in "$pictures"/*; do
    [ "$file" = "$pictures/inputs.txt" ] && continue
    size=$(wc -c <"$file")
    [ "$size" -le 200000 ] || { echo "$file: $size bytes, at most 200000"; bad=1; }
    grep -qxF "$(basename "$file")" <<<"$used" || { echo "$file: no document uses it"; bad=1; }
  done
  if [ ! -s "$pictures/inputs.txt" ]; then
    echo "$pictures/inputs.txt: missing"
    return 1
  fi
  while read -r _ file; do
    echo "$file: changed after the pictures; docs/pictures.sh makes them again"
    bad=1
  done < <(stamp | grep -vxFf "$pictures/inputs.txt")
  return $bad
}

if [ "${1:-}" = --check ]; then
  check
  exit
fi
[ $# = 1 ] && [ -x "$1/bin/fulmar" ] || { echo "usage: docs/pictures.sh PREFIX_OR_BUILD | --check"; exit 2; }

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
prefix=$(realpath "$1") modules=${FULMAR_NODE_MODULES:-build/web/node_modules}
if [ -f "$prefix/CMakeCache.txt" ]; then
  modules=$prefix/web/node_modules
  cmake --install "$prefix" --prefix "$work/prefix" >/dev/null
  prefix=$work/prefix
fi
fulmar=$prefix/bin/fulmar
mkdir -p "$pictures" && rm -f "$pictures"/*.{png,svg}

# README: a flight in severe turbulence, its track and report, and the page of another flight.
"$fulmar" run configs/missions/hourglass.yaml --set sim.turbulence=severe --log "$work/one.mcap" >"$work/run.txt"
"$fulmar" plot "$work/one.mcap" nav.state.position_m.north --over .position_m.east --labels flown --size 100x150mm -o "$pictures/flown-path.svg"
"$fulmar" report "$work/one.mcap" -o "$work/report.html"

# Aircraft: the drawing of the Petrel and its modes.
"$fulmar" aero see configs/drawings/petrel.yaml -o "$work/petrel.html"
"$fulmar" aero vlm configs/drawings/petrel.yaml -o "$work/petrel.yaml" >/dev/null
"$fulmar" aero modes "$work/petrel.yaml" --airspeed "13..25 m/s" --svg "$pictures/petrel-modes.svg" >/dev/null

node docs/pictures.mjs "$fulmar" "$modules" "$(command -v chromium || command -v chromium-browser || echo none)" configs/missions/return_home.yaml \
  "$work/report.html" "$work/petrel.html" "$pictures"

# Tutorial: each page runs in a scratch folder and draws its picture there.
for page in docs/tutorial/[1-7]-*.md; do
  folder=$work/$(basename "$page" .md)
  mkdir "$folder"
  TMPDIR=$folder python3 cmake/tutorials.py --keep --prefix "$prefix" "$page"
  picture=$(sed -nE 's,^!\[.*\]\(\.\./pictures/(.*)\)$,\1,p' "$page")
  cp "$(find "$folder" -name "$picture" -not -path '*/fulmar/*' | head -n 1)" "$pictures/$picture"
done

stamp >"$pictures/inputs.txt"
check

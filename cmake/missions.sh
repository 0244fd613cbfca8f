#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Every shipped mission and that of the example slow_planner is checked and flown; equal runs give equal bytes, on a loaded machine too; the hourglass meets its figures.
set -euo pipefail
cd "$(dirname "$0")/.."
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
fulmar=build/bin/fulmar

# value FILE KEY: a top-level value of a JSON result
value() { sed -n "s/^  \"$2\": \"\{0,1\}\([^\",]*\)\"\{0,1\},\{0,1\}\$/\1/p" "$1"; }
expect() { [ "$2" = "$3" ] || { echo "$1: expected $3, got $2"; exit 1; }; }

for file in configs/missions/{hourglass,runway_to_runway,hand_launch,return_home,two_schemes,orbit,lla,calm,reference_gnss,two_filters,excitation,autotune}.yaml \
  build/examples/slow_planner/mission.yaml; do
  mission=$(sed -n 's/^mission: //p' "$file")
  $fulmar check "$file"
  $fulmar graph "$file" >"$scratch/$mission.txt"
  $fulmar run "$file" --json --log "$scratch/$mission.mcap" >"$scratch/$mission.json" 2>"$scratch/$mission.log" || { cat "$scratch/$mission.log"; exit 1; }
  expect "$mission result" "$(value "$scratch/$mission.json" result)" flown
  expect "$mission log_dropped" "$(value "$scratch/$mission.json" log_dropped)" 0
  grep -q '"guards": \[\]' "$scratch/$mission.json" || { echo "$mission: a guard fired"; exit 1; }
  $fulmar replay "$scratch/$mission.mcap" >"$scratch/replay.txt" || { cat "$scratch/replay.txt"; exit 1; }
  echo "$mission: $(value "$scratch/$mission.json" flight_time_s) s of flight, $(value "$scratch/$mission.json" speedup) times real time; its replay gives equal bytes"
done

$fulmar log compare "$scratch/two_filters.mcap" >"$scratch/compare.txt"
grep -q "^error against /vehicle/truth  *nav " "$scratch/compare.txt" || { cat "$scratch/compare.txt"; exit 1; }
grep "NEES of 9" "$scratch/compare.txt"

# the recorded flight: without its folder one message; with it, if present, as any other
mission=configs/missions/sensor_log.yaml
code=0; $fulmar check $mission 2>"$scratch/sensor_log.txt" || code=$?
expect "sensor_log without a folder" "$code $(wc -l <"$scratch/sensor_log.txt")" "4 1"
grep -q -e "--set recorded.folder=FOLDER" "$scratch/sensor_log.txt" || { cat "$scratch/sensor_log.txt"; exit 1; }
folder=../shared/data/flights/skywalker_x8
if [ -e $folder/imu.csv ]; then
  $fulmar run $mission --set recorded.folder=$folder --json --log "$scratch/sensor_log.mcap" >"$scratch/sensor_log.json" 2>/dev/null
  expect "sensor_log result" "$(value "$scratch/sensor_log.json" result)" flown
  $fulmar replay "$scratch/sensor_log.mcap" >"$scratch/replay.txt" || { cat "$scratch/replay.txt"; exit 1; }
  echo "sensor_log: $(value "$scratch/sensor_log.json" flight_time_s) s of flight, $(value "$scratch/sensor_log.json" speedup) times real time; its replay gives equal bytes"
else
  echo "skipped: no recorded flight at $folder"
fi

# the same seed with two flights at once, against the first one; then another seed
for n in 1 2; do $fulmar run configs/missions/hourglass.yaml --json --log "$scratch/again$n.mcap" >"$scratch/again$n.json" 2>/dev/null & done
wait
$fulmar run configs/missions/hourglass.yaml --seed 8 --json --log "$scratch/other.mcap" >"$scratch/other.json" 2>/dev/null
sha=$(value "$scratch/hourglass.json" log_sha256)
expect "sha256 of the file" "$(sha256sum <"$scratch/hourglass.mcap" | cut -d' ' -f1)" "$sha"
for n in 1 2; do
  expect "log_sha256 of an equal run" "$(value "$scratch/again$n.json" log_sha256)" "$sha"
  expect "log_dropped of an equal run" "$(value "$scratch/again$n.json" log_dropped)" 0
done
[ "$(value "$scratch/other.json" log_sha256)" != "$sha" ] || { echo "another seed gives the same log"; exit 1; }
echo "equal runs give equal bytes: $sha"

for plugin in build/lib/fulmar/*.so build/examples/*/build/lib/fulmar/*.so; do expect "symbols of $plugin" "$(nm -D --defined-only "$plugin" | awk '{print $3}')" fulmar_plugin_entry; done
echo "every plugin exports its entry alone"

if command -v node >/dev/null && [ -d core/tap/test/node/node_modules ]; then
  node core/tap/test/node/read_log.mjs "$scratch/hourglass.mcap" >"$scratch/node.txt" || { tail -5 "$scratch/node.txt"; exit 1; }
  echo "an independent reader decodes every message of the hourglass"
  $fulmar log export "$scratch/calm.mcap" --to csv --out "$scratch/csv" >/dev/null
  node core/tap/test/node/export_test.mjs "$scratch/calm.mcap" "$scratch/csv"
else
  echo "no node here: the log was not opened by an independent reader"
fi
build/bin/bench_missions

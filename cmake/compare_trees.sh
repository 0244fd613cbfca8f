#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Compares the flights of this tree with those of another revision. Both are built; both run every mission of simulation alone with seeds 1 to 3,
# and the logs are compared message by message. Differences in topics of the host (/fulmar/...) are reported, others fail. Two runs
# of this tree give equal bytes, and each log is replayed. Logs of the other revision are read by info, export and diff.
#   compare_trees.sh REV [BUILD]      REV is built in build/compare/REV once, BUILD (build) holds this tree's `flight` and `slow_planner`
set -euo pipefail
cd "$(dirname "$0")/.."
[ $# -ge 1 ] || { sed -n '6s/^# *//p' "$0"; exit 2; }
revision=$(git rev-parse --short "$1^{commit}") build=$PWD/${2:-build}
source cmake/setup.sh
other=$PWD/build/compare/$revision
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
if [ ! -e "$other/build/bin/fulmar" ]; then
  mkdir -p "$other"
  git archive "$revision" | tar -x -C "$other"
  (cd "$other" && configure_and_build build -DFULMAR_TESTS=OFF -- flight slow_planner >"$other/build.log" 2>&1) || { tail -n 40 "$other/build.log"; exit 1; }
fi
ninja -C "$build" flight slow_planner >/dev/null

# mission_file TREE-BUILD MISSION: the shipped mission, or that of the example of this name
mission_file() {
  local file
  file=$(dirname "$1")/configs/missions/$2.yaml
  if [ -e "$file" ]; then echo "$file"; else echo "$1/examples/$2/mission.yaml"; fi
}
fly() { # fly TREE-BUILD MISSION SEED LOG: in TREE-BUILD's own tree
  (cd "$(dirname "$1")" && "$1/bin/fulmar" run "$(mission_file "$1" "$2")" --seed "$3" --log "$4" >"$scratch/fly.log" 2>&1) ||
    { cat "$scratch/fly.log"; echo "$2, seed $3: not flown by $1"; exit 1; }
}
for mission in hourglass two_schemes orbit lla calm reference_gnss slow_planner two_filters first second; do
  [ -e "$(mission_file "$other/build" $mission)" ] || { echo "$mission: not there in $revision"; continue; }
  for seed in 1 2 3; do
    before=$scratch/before.mcap now=$scratch/now.mcap again=$scratch/again.mcap
    rm -f "$scratch"/*.mcap
    fly "$other/build" $mission $seed "$before"
    fly "$build" $mission $seed "$now"
    fly "$build" $mission $seed "$again"
    cmp -s "$now" "$again" || { echo "$mission, seed $seed: two runs differ"; exit 1; }
    "$build/bin/fulmar" replay "$now" >"$scratch/replay.txt" 2>&1 || { cat "$scratch/replay.txt"; exit 1; }
    "$build/bin/fulmar" log diff --messages --json "$before" "$now" >"$scratch/diff.json" || true
    python3 - "$scratch/diff.json" "$mission, seed $seed" <<'END'
import json, sys
diff = json.load(open(sys.argv[1]))
changed = {t: c for t, c in diff["topics"].items() if c["different"] or c["only_first"] or c["only_second"]}
others = [t for t in list(changed) + diff["only_first"] + diff["only_second"] if not t.startswith("/fulmar/")]
if others or diff["fault_first"] or diff["fault_second"]:
    sys.exit(f"{sys.argv[2]}: differs in {', '.join(others)}: {diff['first_difference']} {diff['fault_first']} {diff['fault_second']}")
hosts = ", ".join(sorted(set(list(changed) + diff["only_first"] + diff["only_second"]))) or "none"
print(f"{sys.argv[2]}: {sum(c['equal'] for c in diff['topics'].values())} messages equal; of the host's own topics differ: {hosts}")
END
  done
  "$build/bin/fulmar" log info "$before" >/dev/null
  "$build/bin/fulmar" log export "$before" --to csv --out "$scratch/csv" >/dev/null
  rm -rf "$scratch/csv"
done
echo "flies as $revision did; equal bytes twice; every log replays; logs of $revision are read"

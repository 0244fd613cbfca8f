#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# bench_new_plugin: the time from `fulmar new` to a flown mission (below 60 s), and from a saved source file to a flown and compared mission
# with --watch (below 10 s). Against an installed prefix, outside the tree, without a compiler cache.
#   new_plugin.sh [--json] [--prefix FOLDER] [--build FOLDER]
set -euo pipefail
cd "$(dirname "$0")/.."
json=no prefix="" build=build
while [ $# -gt 0 ]; do
  case $1 in
    --json) json=yes ;;
    --prefix) prefix=$(realpath "$2"); shift ;;
    --build) build=$2; shift ;;
    *) echo "usage: new_plugin.sh [--json] [--prefix FOLDER] [--build FOLDER]" >&2; exit 2 ;;
  esac
  shift
done
scratch=$(mktemp -d)
watcher=""
finish() {
  [ -z "$watcher" ] || kill -INT -- "-$watcher" 2>/dev/null || true
  rm -rf "$scratch"
}
trap finish EXIT
[ -n "$prefix" ] || { prefix=$scratch/prefix; cmake --install "$build" --prefix "$prefix" >/dev/null; }
export CCACHE_DISABLE=1
cd "$scratch"

fail() { echo "$1" >&2; [ -z "${2:-}" ] || tail -n 30 "$2" >&2; exit 1; }
now() { date +%s.%N; }
since() { awk -v a="$1" -v b="$(now)" 'BEGIN {printf "%.2f", b - a}'; }

begin=$(now)
"$prefix/bin/fulmar" new my_law --role outer >new.log 2>&1 || fail "fulmar new failed" new.log
cd my_law
cmake --preset default >build.log 2>&1 || fail "configuring failed" build.log
configured=$(since "$begin")
cmake --build build >>build.log 2>&1 || fail "building failed" build.log
built=$(since "$begin")
ctest --test-dir build --output-on-failure >test.log 2>&1 || fail "the test failed" test.log
"$prefix/bin/fulmar" run mission.yaml --json >result.json 2>run.log || fail "the mission did not fly" run.log
grep -q '"result": "flown"' result.json || fail "the mission did not fly" result.json
new_to_flown=$(since "$begin")

# wait_for PATTERN COUNT SECONDS: waits until the watch has printed COUNT lines with PATTERN
wait_for() {
  for _ in $(seq $(($3 * 20))); do
    [ "$(grep -cE "$1" watch.log || true)" -ge "$2" ] && return 0
    kill -0 "$watcher" 2>/dev/null || return 1
    sleep 0.05
  done
  return 1
}
save_to_compared=null
if "$prefix/bin/fulmar" run --help | grep -q -- --watch; then
  : >watch.log
  set -m  # a process group of its own: it is interrupted as by Ctrl-C
  "$prefix/bin/fulmar" run mission.yaml --watch --build "cmake --build build" >watch.log 2>&1 &
  watcher=$!
  set +m
  flown='^my_law: flown'
  wait_for "$flown" 1 60 || fail "the first flight of the watch was not flown" watch.log
  wait_for '^waiting for a change' 1 10 || fail "the watch does not wait" watch.log
  sed -i 's|course_kp{1.2|course_kp{1.1|' my_law.hpp
  begin=$(now)
  wait_for "$flown" 2 60 || fail "the edited law was not flown" watch.log
  wait_for '^compared with the flight before' 1 20 || fail "no comparison was printed" watch.log
  save_to_compared=$(since "$begin")
  kill -INT -- "-$watcher" 2>/dev/null || true
  wait "$watcher" 2>/dev/null || true
  watcher=""
fi

if [ "$json" = yes ]; then
  printf '{"configured_s": %s, "built_s": %s, "new_to_flown_s": %s, "save_to_compared_s": %s}\n' "$configured" "$built" "$new_to_flown" "$save_to_compared"
else
  printf 'fulmar new to flown mission     %7s s   (bar 60 s; configured after %s s, built after %s s)\n' "$new_to_flown" "$configured" "$built"
  printf 'saved file to compared flights  %7s s   (bar 10 s)\n' "$save_to_compared"
fi

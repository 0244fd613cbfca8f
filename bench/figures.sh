#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Writes docs/figures.md: every number in it comes from a program of this folder, run at that time on this machine.
set -euo pipefail
cd "$(dirname "$0")/.."
fulmar=build/bin/fulmar
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

speed() { # speed MISSION: median of five runs, log written, all threads on one core
  for n in 1 2 3 4 5; do
    taskset -c 0 $fulmar run "configs/missions/$1.yaml" --json --log "$scratch/$1-$n.mcap" 2>/dev/null | sed -n 's/^  "speedup": \([0-9.]*\),$/\1/p'
    rm -f "$scratch/$1-$n.mcap"
  done | sort -n | sed -n 3p
}

{
  echo "# Figures"
  echo
  echo "Written by \`bench/figures.sh\`; nothing here is typed. The limits are those of the ROSplane 2.0 paper: tracking in flight, estimation in its simulator."
  echo
  echo "## How well the hourglass is flown"
  echo
  echo "Anaconda, 17 m/s, 50 m fillets, wind 5 m/s, light turbulence, two circuits; \`build/bin/bench_missions --markdown\`. Root mean square over the flight after the"
  echo "first waypoint. \`tracking\` compares path and raw set-points with the estimated state, \`tracking_true\` with the simulated truth, \`estimation\` the estimate with the"
  echo "truth. The wind figures contain the gusts."
  echo
  build/bin/bench_missions --markdown
  echo
  echo "## Over wind and turbulence"
  echo
  echo "Anaconda, \`ublox\` sensors, wind from the south-east, means of 20 seeds against the estimate; \`build/bin/bench_tracking\`. In 12 m/s a turn of 50 m down wind takes"
  echo "more bank than the aircraft may have: what is off there is the turn."
  echo
  build/bin/bench_tracking || true  # it tells which cell is above its bar
  echo
  echo "## How fast"
  echo
  echo "Times real time, default log written, every thread pinned to one core, median of five runs; \`taskset -c 0 fulmar run\`."
  echo
  echo "| mission | times real time |"
  echo "|---|---|"
  for mission in hourglass two_schemes orbit lla calm; do printf '| %s | %.0f |\n' $mission "$(speed $mission)"; done
  echo
  echo "## How long"
  echo
  echo "\`bench/bench_endurance.py\`: the hourglass flown on and on, no log; processor time of all threads, less that of setting up, and the most memory."
  echo
  bench/bench_endurance.py
  echo
  echo "## What a step costs"
  echo
  echo "\`build/bin/bench_steps\`; nanoseconds, guards and the reading of the clock included."
  echo
  echo "| what | p50 | p99 |"
  echo "|---|---|---|"
  build/bin/bench_steps | sed -E 's/^(.*[^ ]) +([0-9]+) +([0-9]+) ns$/| \1 | \2 | \3 |/'
  echo
  if [ -e build/lib/libfulmar_sim.so ]; then
    echo "## What a batch costs"
    echo
    echo "\`bench/bench_batch.py\`: nanoseconds of processor time per step of one aircraft of 1000 through the library, from Python beside the same from C++, in turns."
    echo
    PYTHONPATH=build/lib/python /usr/bin/python3 bench/bench_batch.py
    echo
  fi
  echo "## What isolation costs"
  echo
  echo "\`build/bin/bench_isolation\`: a step in a child process beside a bare round trip between two processes of the same run."
  echo
  echo '```'
  build/bin/bench_isolation
  echo '```'
  echo
  echo "## What leaves the loop"
  echo
  echo "\`build/bin/bench_tap\`: processor time of the loop's thread per tick, the hourglass in real time at 400 Hz; with every port at its full rate into a log, to two"
  echo "clients that subscribe to everything, and four ports to a DDS reader, beside a flight that nothing leaves. Below, what was lost on the way."
  echo
  echo '```'
  build/bin/bench_tap
  echo '```'
  echo
  echo "\`build/bin/bench_tap --sizes\`: the log of the hourglass, 1 MB = 10^6 bytes."
  echo
  echo '```'
  build/bin/bench_tap --sizes
  echo '```'
  echo
  if [ -x build/bin/bench_python ]; then
    echo "## What Python costs"
    echo
    echo "\`build/bin/bench_python\`: a law in Python beside the same law in C++."
    echo
    echo '```'
    build/bin/bench_python
    echo '```'
    echo
  fi
  if [ -x build/bin/bench_fcu_latency ]; then
    echo "## From an inertial sample to the command, on a flight controller's port"
    echo
    echo "\`build/bin/bench_fcu_latency\`: the whole host at 400 Hz on a pseudo-terminal, log written, beside a bare echo on the same one in the same run."
    echo
    echo '```'
    build/bin/bench_fcu_latency
    echo '```'
    echo
  fi
  echo "## From an idea to a flight"
  echo
  echo "\`bench/new_plugin.sh\`: machine time, no compiler cache."
  echo
  echo '```'
  bench/new_plugin.sh
  echo '```'
} >"$scratch/figures.md"
mv "$scratch/figures.md" docs/figures.md
echo "docs/figures.md is written"

#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# The long campaigns: every file compiled by itself, more seeds, more byte flips, 10 000 loads and unloads of a plugin and 1000 swaps, 1e8 bytes of noise from a flight
# controller, under the address sanitizer too; 500 random missions with a random fault; what has several threads under the thread sanitizer; the hourglass through a flight controller's port in real time.
set -euo pipefail
cd "$(dirname "$0")/.."
export FULMAR_LONG=1

# Every source file compiles alone, with its own includes.
source cmake/setup.sh
configure_and_build build-single -DFULMAR_TESTS=ON -DFULMAR_UNITE=OFF -DCMAKE_BUILD_TYPE=Debug -- all benches >build/check/single.log 2>&1 || { tail -n 60 build/check/single.log; exit 1; }

# The tests of several threads under the thread sanitizer. Programs that they start write their reports to separate files.
threads() {
  local reports
  reports=$(mktemp -d)
  configure_and_build build-threads -DFULMAR_TESTS=ON -DFULMAR_SANITIZE_THREADS=ON -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ \
    -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG=-O1\ -g1 -- threads >build/check/threads.log 2>&1 || { tail -n 60 build/check/threads.log; return 1; }
  (cd build-threads && unset FULMAR_LONG && TSAN_OPTIONS="suppressions=$PWD/../cmake/threads.supp log_path=$reports/report" \
    ctest -L threads --output-on-failure --repeat until-pass:2) || { cat "$reports"/* 2>/dev/null | head -n 200; return 1; }
  if [ -n "$(ls "$reports")" ]; then cat "$reports"/* | head -n 200; return 1; fi
  rm -r "$reports"
}
threads
cmake/tidy.py build --tools
cmake/mutate.py  # do the tests notice a fault?
build/bin/loader_test
[ ! -x build-clang/bin/loader_test ] || build-clang/bin/loader_test
for folder in build build-clang; do
  [ ! -x $folder/bin/run_test ] || $folder/bin/run_test --test-case="many swaps*"
done
for folder in build build-clang; do
  [ ! -x $folder/bin/fcu_link_test ] || $folder/bin/fcu_link_test --test-case="whatever bytes come*"
done
node web/test/long_test.mjs build/bin/fulmar build/web/node_modules "$(command -v chromium)" | tee build/check/page.txt || [ ${PIPESTATUS[0]} = 77 ]
build/bin/fcu_hil_test
build/bin/random_missions_test  # 500 flights
build/bin/sensor_files_test     # Allan deviations of ten hours
build/bin/flight_test --test-case="spectra and deviations*"
build/bin/bench_link_gaps >build/check/link_gaps.md
build/bin/bench_faults >build/check/faults.md
build/bin/bench_sensor_faults >build/check/sensor_faults.md
build/bin/bench_safety >build/check/safety.md
build/bin/bench_failures >build/check/failures.md
build/bin/bench_landing --jobs 2 >build/check/landing.md
build/bin/bench_attitude >build/check/attitude.md
build/bin/bench_autotune >build/check/autotune.md
build/bin/bench_aero >build/check/aero.txt
build/bin/bench_missions --seeds 50
build/bin/bench_tracking >build/check/tracking.md
build/bin/bench_laws >build/check/laws.txt

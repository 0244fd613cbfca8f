#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# The long campaigns: every file compiled by itself, more seeds, more byte flips, 10 000 loads and unloads of a plugin and 1000 swaps, 1e8 bytes of noise from a flight
# controller, under the address sanitizer too; the hourglass through a flight controller's port in real time.
set -euo pipefail
cd "$(dirname "$0")/.."
export FULMAR_LONG=1

# Every source file compiles by itself, with what it includes itself.
source cmake/setup.sh
configure_and_build build-single -DFULMAR_TESTS=ON -DFULMAR_UNITE=OFF -DCMAKE_BUILD_TYPE=Debug -- >build/check/single.log 2>&1 || { tail -n 60 build/check/single.log; exit 1; }
build/bin/loader_test
[ ! -x build-clang/bin/loader_test ] || build-clang/bin/loader_test
for folder in build build-clang; do
  [ ! -x $folder/bin/run_test ] || $folder/bin/run_test --test-case="many swaps*"
done
for folder in build build-clang; do
  [ ! -x $folder/bin/fcu_link_test ] || $folder/bin/fcu_link_test --test-case="whatever bytes come*"
done
build/bin/fcu_hil_test
build/bin/bench_missions --seeds 50

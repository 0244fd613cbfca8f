#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Additional cost of a step of 1000 aircraft from Python, relative to C++, measured in turns with build/bin/bench_batch: processor time
of all threads, the best of six calls each, the median of 60 turns.

    PYTHONPATH=build/lib/python /usr/bin/python3 bench/bench_batch.py [BUILD]
"""
import statistics
import subprocess
import sys
import time

import fulmar_sim

N, TURNS, CALLS = 1000, 60, 6
build = sys.argv[1] if len(sys.argv) > 1 else "build"
other = subprocess.Popen([f"{build}/bin/bench_batch", "--asked"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, bufsize=1)


def made(threads):
    sim = fulmar_sim.Simulation("configs/airframes/anaconda.yaml", N, threads=threads, origin_altitude=1387)
    sim.fly(300, 17)
    return sim


def cpp_ns(threads, steps):
    other.stdin.write(f"{threads} {steps} {CALLS}\n")
    return float(other.stdout.readline())


def python_ns(sim, steps):
    actions, best = sim.trim, float("inf")
    for _ in range(CALLS):
        begin = time.process_time()
        sim.step(actions, steps)
        best = min(best, time.process_time() - begin)
    return best / (N * steps) * 1e9


sims = {threads: made(threads) for threads in (1, 2)}
cpp_ns(1, 1)  # it is ready
print("| threads | steps a call | C++ ns | Python ns | more |")
print("|---|---|---|---|---|")
for threads, sim in sims.items():
    for steps in (1, 20):
        turns = [(cpp_ns(threads, steps), python_ns(sim, steps)) for _ in range(TURNS)]
        cpp, python = (statistics.median(column) for column in zip(*turns))
        more = statistics.median(b / a for a, b in turns) - 1
        print(f"| {threads} | {steps} | {cpp:.0f} | {python:.0f} | {100 * more:.1f} % |")
other.stdin.close()
other.wait()

#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""What a batch of 1000 aircraft costs more from Python than from C++, which build/bin/bench_batch measures in turns with this.

    PYTHONPATH=build/lib/python /usr/bin/python3 bench/bench_batch.py [BUILD]
"""
import json
import subprocess
import sys
import time

import fulmar_sim

N, TURNS = 1000, 5
build = sys.argv[1] if len(sys.argv) > 1 else "build"


def steps_per_second(threads, steps):
    sim = fulmar_sim.Simulation("configs/airframes/anaconda.yaml", N, threads=threads, origin_altitude=1387)
    sim.fly(300, 17)
    actions, best = sim.trim, 0
    for _ in range(60):
        begin = time.perf_counter()
        sim.step(actions, steps)
        best = max(best, N * steps / (time.perf_counter() - begin))
    return best


cpp, python = {}, {}
for _ in range(TURNS):
    told = json.loads(subprocess.run([f"{build}/bin/bench_batch", "--json"], capture_output=True, check=True).stdout)
    for threads in (1, 2):
        for steps in (1, 20):
            key = (threads, steps)
            cpp[key] = max(cpp.get(key, 0), told[f"threads_{threads}_steps_{steps}_per_s"])
            python[key] = max(python.get(key, 0), steps_per_second(threads, steps))

print("threads  steps a call  C++ ns per step  Python ns per step  more")
for (threads, steps), rate in cpp.items():
    print(f"{threads:7}  {steps:12}  {1e9 / rate:15.0f}  {1e9 / python[threads, steps]:18.0f}  {100 * (rate / python[threads, steps] - 1):3.0f} %")

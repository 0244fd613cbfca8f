# SPDX-License-Identifier: BSD-3-Clause
"""Gains of a roll hold by random search: a thousand aircraft at once, each with its own gains."""
import sys

import fulmar_sim
import numpy

n, seconds = 1000, 3
sim = fulmar_sim.Simulation(sys.argv[1], n=n, threads=2, seed=1)
at = {name: i for i, name in enumerate(sim.columns)}
rows = sim.fly(height=100, airspeed=17)
trim = rows[0, [at["aileron_rad"], at["elevator_rad"], at["rudder_rad"]]].copy()

rng = numpy.random.default_rng(1)
kp, kd = rng.uniform(0, 2, n), rng.uniform(0, 0.5, n)
goal, cost = numpy.radians(30), numpy.zeros(n)
actions = numpy.tile([0.5, *trim], (n, 1))
for _ in range(int(seconds * 50)):
    w, x, y, z = rows[:, [at["q_w"], at["q_x"], at["q_y"], at["q_z"]]].T
    roll = numpy.arctan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y))
    actions[:, 1] = trim[0] + kp * (goal - roll) - kd * rows[:, at["p_radps"]]
    cost += (goal - roll) ** 2 / 50 + 0.1 * (actions[:, 1] - trim[0]) ** 2 / 50
    rows = sim.step(actions, steps=8)  # 8 steps of 2.5 ms

best, worst = cost.argmin(), cost.argmax()
print(f"best of {n}: kp {kp[best]:.2f}, kd {kd[best]:.2f}, cost {cost[best]:.3f}; worst {cost[worst]:.3f}")

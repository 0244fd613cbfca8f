# SPDX-License-Identifier: BSD-3-Clause
"""Episodes for a learner: an aircraft restarts after a crash, beyond the model, or at the time limit; the others continue."""
import fulmar_sim
import numpy

n, max_s, period_s = 200, 20, 0.02
sim = fulmar_sim.Simulation("fulmar:airframes/anaconda.yaml", n=n, threads=2, seed=1, turbulence="moderate")
names = {name: i for i, name in enumerate(sim.row_names)}
rng = numpy.random.default_rng(1)


def begin(only):
    return sim.fly(rng.uniform(20, 60, n), rng.uniform(15, 19, n), rng.uniform(-3, 3, n), only=only)


rows = begin(numpy.ones(n, dtype=bool))
age_s, noise, lived_s = numpy.zeros(n), numpy.zeros((n, 2)), 0
ended = {"crashed": 0, "departed": 0, "flown": 0}
for _ in range(1500):
    actions = sim.trim
    noise = 0.98 * noise + rng.normal(0, 0.004, (n, 2))
    actions[:, 1:3] += noise  # replace by the policy of a learner
    rows = sim.step(actions, steps=8)
    age_s += period_s
    crashed, departed = rows[:, names["crashed"]] > 0, rows[:, names["departed"]] > 0
    over = crashed | departed | (age_s >= max_s)
    if over.any():
        ended["crashed"] += int(crashed.sum())
        ended["departed"] += int((departed & ~crashed).sum())
        ended["flown"] += int((over & ~crashed & ~departed).sum())
        lived_s += age_s[over].sum()
        rows, age_s[over] = begin(over), 0

print(f"{sum(ended.values())} episodes, {lived_s / sum(ended.values()):.1f} s on average: " + ", ".join(f"{k} {v}" for k, v in ended.items()))

# SPDX-License-Identifier: BSD-3-Clause
"""Roll gains of the Anaconda: a step to 30 deg of bank with 256 pairs of gains, simulated at once."""
import fulmar_sim
import numpy

kp, kd = (axis.ravel() for axis in numpy.meshgrid(numpy.linspace(0.4, 6.4, 16), numpy.linspace(0, 0.3, 16)))
sim = fulmar_sim.Simulation("fulmar:airframes/anaconda.yaml", n=kp.size, threads=2)
rows = sim.fly(height=100, airspeed=17)
names = {name: i for i, name in enumerate(sim.row_names)}

period, target = 0.01, numpy.radians(30)
roll = []
for _ in range(300):
    w, x, y, z = rows[:, names["q_w"]:names["q_z"] + 1].T
    roll.append(numpy.arctan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y)))
    actions = sim.trim
    actions[:, 1] += kp * (target - roll[-1]) - kd * rows[:, names["p_radps"]]
    rows = sim.step(actions, steps=4)  # of 2.5 ms

error = numpy.array(roll) - target
overshoot = numpy.degrees(error.max(axis=0).clip(0))
far = numpy.abs(error) > numpy.radians(1.5)
settled = period * (far.shape[0] - far[::-1].argmax(axis=0))
settled[far[-1]] = numpy.inf

print("  kp    kd  settled in  overshoot")
for i in numpy.lexsort((overshoot, settled))[:5]:
    print(f"{kp[i]:4.1f}  {kd[i]:4.2f}  {settled[i]:8.2f} s  {overshoot[i]:5.1f} deg")
print(f"{numpy.isfinite(settled).sum()} of {kp.size} settle within 3 s; {int(rows[:, names['crashed']].sum())} crashed")

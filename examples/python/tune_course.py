# SPDX-License-Identifier: BSD-3-Clause
"""Effect of the course gain on a turn: one simulated course step per gain, and a table of the results.

    PYTHONPATH=build/lib/python /usr/bin/python3 examples/python/tune_course.py
"""
import argparse
import math

import fulmar

mission = "fulmar:missions/hourglass.yaml"


def wrap(angle_rad):
    return math.remainder(angle_rad, 2 * math.pi)


def first_turn(gain, seed):
    """Flight to the first corner and through it. -> (largest course error, settling time, largest bank)"""
    sim = fulmar.Sim(mission, seed=seed, set={"slc.course_kp": gain, "sim.turbulence": "none"})
    while sim["manage.progress.reached"] is None or sim["manage.progress.reached"] < 1:
        if not sim.step(4):
            raise SystemExit(f"the flight ended before the corner: {sim.result['reason']}")
    begin, settled, worst, bank = sim.now_s, sim.now_s, 0.0, 0.0
    while sim.now_s < begin + 20 and sim.step(4):
        error = abs(wrap(sim["guide.command.course_rad"] - sim["nav.state.course_rad"]))
        worst, bank = max(worst, error), max(bank, abs(sim["nav.state.roll_rad"]))
        if error > math.radians(2):
            settled = sim.now_s
    return math.degrees(worst), settled - begin, math.degrees(bank)


def main():
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--gains", type=float, nargs="+", default=[0.3, 0.6, 1.0, 1.5, 2.5])
    options.add_argument("--seed", type=int, default=1)
    options = options.parse_args()
    print("course_kp  largest error  settled in  largest bank")
    for gain in options.gains:
        worst, settled, bank = first_turn(gain, options.seed)
        print(f"{gain:9.2f}  {worst:9.1f} deg  {settled:8.2f} s  {bank:8.1f} deg")


if __name__ == "__main__":
    main()

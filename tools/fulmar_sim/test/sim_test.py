#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""sim_test.py ROWS: the package against the header, and what it refuses. ROWS flies the same without Python. Exit 77: numpy is not there."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

try:
    import numpy
except ImportError:
    print("numpy is not there: the test is skipped")
    sys.exit(77)
import fulmar_sim

ANACONDA = "configs/airframes/anaconda.yaml"
ROWS = sys.argv.pop(1)


def weave(sim, blocks=40):
    for k in range(blocks):
        s = 0.03125 if k % 2 else -0.03125
        rows = sim.step(numpy.array([[0.5625 + s, s * i * 0.5, 0.125 + 0.5 * s, -s] for i in range(sim.n)]), steps=20)
    return rows


def made(n=5, threads=1, seed=7):
    sim = fulmar_sim.Simulation(ANACONDA, n=n, threads=threads, seed=seed, origin_altitude=1387, turbulence="light")
    sim.set_wind((3, -4, 0.25))
    sim.fly(300, 17, 0.5)
    return sim


class Model(unittest.TestCase):
    def refused(self, call):
        with self.assertRaises(fulmar_sim.Error) as caught:
            call()
        return str(caught.exception)

    def test_python_flies_what_the_header_flies_to_the_bit(self):
        expected = numpy.frombuffer(subprocess.run([ROWS], capture_output=True, check=True).stdout).reshape(5, 25)
        found = weave(made())
        self.assertEqual(found.tobytes(), expected.tobytes())
        self.assertGreater(numpy.abs(found[0] - found[4]).max(), 0.01)

    def test_threads_change_no_bit_and_a_seed_does(self):
        one = weave(made()).copy()
        self.assertEqual(one.tobytes(), weave(made(threads=2)).tobytes())
        self.assertNotEqual(one.tobytes(), weave(made(seed=8)).tobytes())

    def test_a_reset_gives_the_flight_again_with_its_wind(self):
        sim = made()
        first = weave(sim).copy()
        self.assertTrue(sim.reset(7)[:, sim.columns.index("on_ground")].all())
        sim.fly(300, 17, 0.5)
        self.assertEqual(first.tobytes(), weave(sim).tobytes())

    def test_a_state_that_was_set_is_the_one_that_is_read(self):
        a, b = made(), made(seed=9)
        weave(a)
        b.state = a.state
        kept = [i for i in range(25) if i < 13 or 19 <= i < 23]
        numpy.testing.assert_array_equal(b.state[:, kept], a.state[:, kept])

    def test_level_flight_is_what_was_asked_for(self):
        sim = fulmar_sim.Simulation(ANACONDA)
        row = dict(zip(sim.columns, sim.fly(120, 18, numpy.pi / 2)[0]))
        self.assertAlmostEqual(row["down_m"], -120)
        self.assertAlmostEqual(row["airspeed_mps"], 18, places=6)
        self.assertAlmostEqual(row["v_east_mps"], 18, places=6)
        self.assertAlmostEqual(numpy.hypot(row["f_x_mps2"], row["f_z_mps2"]), 9.81, delta=0.02)

    def test_step_returns_one_array(self):
        sim = made()
        self.assertIs(weave(sim, 1), weave(sim, 1))

    def test_what_is_no_action_is_refused_and_nothing_moves(self):
        sim = made()
        before = sim.state
        good = numpy.full((5, 4), 0.1)
        bad = good.copy()
        bad[3, 2] = numpy.nan
        self.assertEqual(self.refused(lambda: sim.step(bad)), "aircraft 3: elevator_rad is nan")
        self.assertEqual(self.refused(lambda: sim.step(good[:4])), "actions: the shape (5, 4) is expected, found (4, 4)")
        self.assertEqual(self.refused(lambda: sim.step(good.astype("f4"))), "actions: float64 is expected, found float32")
        self.assertEqual(self.refused(lambda: sim.step([[0] * 4] * 5)), "actions: a numpy array is expected, found list")
        self.assertIn("steps is 0", self.refused(lambda: sim.step(good, steps=0)))
        self.assertIn("the wind is nan", self.refused(lambda: sim.set_wind((0, 0, float("nan")))))
        self.assertIn("no steady level flight at 2.0", self.refused(lambda: sim.fly(300, 2)))
        state = sim.state
        state[1, 0] += 50
        state[4, 3] = numpy.inf
        self.assertEqual(self.refused(lambda: setattr(sim, "state", state)), "aircraft 4: the state has a number that is not finite")
        self.assertEqual(sim.state.tobytes(), before.tobytes())

    def test_what_cannot_be_made_is_refused(self):
        make = fulmar_sim.Simulation
        self.assertIn("dt is 0.2", self.refused(lambda: make(ANACONDA, dt=0.2).step(numpy.zeros((1, 4)))))
        self.assertIn("n is 0", self.refused(lambda: make(ANACONDA, n=0)))
        self.assertIn("threads is 0", self.refused(lambda: make(ANACONDA, threads=0)))
        self.assertIn("valid: none, light, moderate, severe", self.refused(lambda: make(ANACONDA, turbulence="storm")))
        self.assertIn("nowhere.yaml", self.refused(lambda: make("nowhere.yaml")))

    def test_a_fault_of_the_file_is_told_with_its_line(self):
        lines = pathlib.Path(ANACONDA).read_text().splitlines()
        at = next(i for i, line in enumerate(lines) if line.startswith("mass"))
        lines[at] = "mass: -3 kg"
        with tempfile.TemporaryDirectory() as folder:
            bad = pathlib.Path(folder) / "bad.yaml"
            bad.write_text("\n".join(lines) + "\n")
            told = self.refused(lambda: fulmar_sim.Simulation(bad))
        self.assertIn(f"bad.yaml:{at + 1}", told)
        self.assertIn("must be more than 0", told)


unittest.main()

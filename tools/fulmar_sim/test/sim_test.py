#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""sim_test.py ROWS: compares the package with the headers, and checks rejected arguments. ROWS runs the same without Python. Exit 77: no numpy."""
import copy
import math
import os
import pathlib
import pickle
import re
import signal
import subprocess
import sys
import tempfile
import threading
import unittest

try:
    import numpy
except ImportError:
    print("numpy is not there: the test is skipped")
    sys.exit(77)
os.environ["FULMAR_MESSAGES"] = "codes"
import fulmar_sim

ANACONDA = "configs/airframes/anaconda.yaml"
ROWS = sys.argv.pop(1)
NAN = float("nan")


def weave(sim, blocks=40):
    for k in range(blocks):
        s = 0.03125 if k % 2 else -0.03125
        rows = sim.step([[0.5625 + s, s * i * 0.5, 0.125 + 0.5 * s, -s] for i in range(sim.n)], steps=20)
    return rows


def made(n=5, threads=1, seed=7):
    sim = fulmar_sim.Simulation(ANACONDA, n, threads=threads, seed=seed, origin_altitude=1387, turbulence="light")
    sim.set_wind((3, -4, 0.25))
    sim.fly(300, 17, 0.5)
    return sim


def column(rows, name):
    return rows[:, fulmar_sim.Simulation.row_names.index(name)]


class Told(unittest.TestCase):
    def refused(self, call, *arguments, **options):
        with self.assertRaises(fulmar_sim.Error) as caught:
            call(*arguments, **options)
        return str(caught.exception)


class Flight(Told):
    def test_python_flies_what_the_headers_fly_to_the_bit(self):
        expected = numpy.frombuffer(subprocess.run([ROWS], capture_output=True, check=True).stdout).reshape(5, 26)
        found = weave(made())
        self.assertEqual(found.tobytes(), expected.tobytes())
        self.assertGreater(numpy.abs(found[0] - found[4]).max(), 0.01)

    def test_threads_change_no_bit_and_a_seed_does(self):
        one = weave(made())
        self.assertEqual(one.tobytes(), weave(made(threads=2)).tobytes())
        self.assertNotEqual(one.tobytes(), weave(made(seed=8)).tobytes())

    def test_a_reset_gives_the_flight_again_with_its_wind(self):
        sim = made()
        first = weave(sim)
        self.assertTrue(column(sim.reset(7), "on_ground").all())
        sim.fly(300, 17, 0.5)
        self.assertEqual(first.tobytes(), weave(sim).tobytes())

    def test_one_aircraft_begins_anew_and_the_others_fly_on_as_if_it_had_not(self):
        sim, other = made(), made()
        weave(sim, 3), weave(other, 3)
        self.assertEqual(column(sim.reset(7, only=2), "down_m").round().tolist()[1:4:2], column(other.state, "down_m").round().tolist()[1:4:2])
        rows = sim.fly(300, 17, 0.5, only=[2])
        self.assertEqual(column(rows, "down_m")[2], -300)
        self.assertEqual(numpy.delete(weave(sim, 5), 2, 0).tobytes(), numpy.delete(weave(other, 5), 2, 0).tobytes())
        mask = numpy.array([False, True, False, False, True])
        self.assertEqual(column(sim.reset(only=mask), "on_ground").astype(bool).tolist(), mask.tolist())

    def test_level_flight_is_what_was_asked_for_each_aircraft(self):
        sim = fulmar_sim.Simulation(ANACONDA, 3)
        rows = sim.fly([120, 130, 140], 18, [0, math.pi / 2, -math.pi / 2])
        self.assertEqual(column(rows, "down_m").tolist(), [-120, -130, -140])
        numpy.testing.assert_allclose(column(rows, "airspeed_mps"), 18)
        numpy.testing.assert_allclose(column(rows, "v_east_mps"), [0, 18, -18], atol=0.01)  # it sideslips a little
        weight = numpy.hypot(column(rows, "f_x_mps2"), column(rows, "f_z_mps2"))
        numpy.testing.assert_allclose(weight, 9.80665, atol=0.02)

    def test_its_trim_keeps_it_in_steady_flight(self):
        sim = fulmar_sim.Simulation(ANACONDA, 2)
        self.assertEqual(sim.trim.tolist(), [[0] * 4] * 2)
        before = sim.fly(100, [16, 18])
        after = sim.step(sim.trim, steps=800)  # 2 s
        numpy.testing.assert_allclose(column(after, "down_m"), -100, atol=0.02)
        numpy.testing.assert_allclose(column(after, "north_m"), [32, 36], atol=0.05)
        self.assertGreater(sim.trim[1, 0], sim.trim[0, 0])
        numpy.testing.assert_allclose(sim.trim[:, 1:], before[:, 19:22])

    def test_a_state_that_was_set_is_the_one_that_is_read(self):
        a, b = made(), made(seed=9)
        weave(a)
        rows = b.set_state(a.state)
        kept = [i for i in range(26) if i < 13 or 19 <= i < 23]
        numpy.testing.assert_array_equal(rows[:, kept], a.state[:, kept])
        before = b.state
        moved = before.copy()
        moved[:, 0] += 10
        self.assertEqual((column(b.set_state(moved, only=1), "north_m") - column(before, "north_m")).round(6).tolist(), [0, 10, 0, 0, 0])

    def test_what_crashed_stays_until_it_is_put_elsewhere(self):
        sim = fulmar_sim.Simulation(ANACONDA)
        flying = sim.fly(100, 17)
        wreck = sim.step([0, 0, 0.3, 0], steps=4000)
        self.assertEqual(column(wreck, "crashed")[0], 1)
        self.assertEqual(sim.step([1, 0, 0, 0], steps=400)[0, :13].tolist(), wreck[0, :13].tolist())
        self.assertEqual(column(sim.set_state(flying), "crashed")[0], 0)
        self.assertLess(column(sim.step([0.5, 0, 0, 0], steps=40), "down_m")[0], -99)

    def test_what_has_left_the_model_says_so_and_flies_again(self):
        sim = fulmar_sim.Simulation(ANACONDA, 2)
        state = sim.fly(100, 17)
        state[1, 11] = 9e4  # q_radps
        sim.set_state(state)
        rows = sim.step([0.5, 0, 0, 0], steps=400)
        self.assertEqual(column(rows, "departed").tolist(), [0, 1])
        self.assertTrue(numpy.isfinite(rows[0]).all())
        self.assertEqual(column(sim.fly(100, 17, only=1), "departed").tolist(), [0, 0])

    def test_arrays_of_any_layout_fly_the_same(self):
        actions = numpy.array([[0.5, 0.01 * i, 0.125, 0] for i in range(5)], dtype=numpy.float32)
        doubles = actions.astype(float)
        wide = numpy.zeros((5, 8))
        wide[:, ::2] = doubles
        expected = made().step(doubles)
        locked = doubles.copy()
        locked.flags.writeable = False
        for given in (actions, numpy.asfortranarray(doubles), wide[:, ::2], doubles[::-1].copy()[::-1], doubles.astype(">f8"), locked, doubles.tolist()):
            self.assertEqual(made().step(given).tobytes(), expected.tobytes())
        whole = numpy.zeros((5, 4))
        whole[:, 0] = 1
        for given in (whole.astype(numpy.int8), whole.astype(numpy.uint64)):
            self.assertEqual(made().step(given).tobytes(), made().step(whole).tobytes())
        self.assertEqual(made().step(doubles[0]).tobytes(), made().step([doubles[0]] * 5).tobytes())

    def test_two_threads_of_python_take_turns_with_one_simulation(self):
        sim = fulmar_sim.Simulation(ANACONDA, 8, threads=2)
        sim.fly(300, 17)
        others = [threading.Thread(target=lambda: [sim.step([0.5, 0, 0.1, 0], steps=5) for _ in range(20)]) for _ in range(2)]
        for other in others:
            other.start()
        for other in others:
            other.join()
        alone = fulmar_sim.Simulation(ANACONDA, 8)
        alone.fly(300, 17)
        self.assertEqual(alone.step([0.5, 0, 0.1, 0], steps=200).tobytes(), sim.state.tobytes())


class Refusals(Told):
    def test_what_is_no_action_is_refused_and_nothing_moves(self):
        sim = made()
        before = sim.state
        good = numpy.full((5, 4), 0.1)
        bad = good.copy()
        bad[3, 2] = NAN
        self.assertEqual(self.refused(sim.step, bad), "aircraft 3: sim.command_not_finite(elevator_rad, nan)")
        self.assertEqual(self.refused(sim.step, good[:4]), "simulation.shape_invalid(actions, (4, 4), (5, 4) or (4,))")
        self.assertEqual(self.refused(sim.step, 0.5), "simulation.shape_invalid(actions, (), (5, 4) or (4,))")
        self.assertEqual(self.refused(sim.step, good.ravel()), "simulation.shape_invalid(actions, (20,), (5, 4) or (4,))")
        self.assertEqual(self.refused(sim.step, good.T), "simulation.shape_invalid(actions, (4, 5), (5, 4) or (4,))")
        self.assertEqual(self.refused(sim.step, numpy.zeros((0, 4))), "simulation.shape_invalid(actions, (0, 4), (5, 4) or (4,))")
        self.assertEqual(self.refused(sim.step, ["a"] * 4), "simulation.numbers_expected(actions, <U1)")
        self.assertEqual(self.refused(sim.step, [[0, 0], [0]]), "simulation.rows_expected(actions)")
        self.assertEqual(self.refused(sim.step, None), "simulation.numbers_expected(actions, NoneType)")
        for dtype, name in ((complex, "complex128"), (bool, "bool"), (object, "object"), ("M8[s]", "datetime64[s]")):
            self.assertEqual(self.refused(sim.step, numpy.zeros((5, 4), dtype=dtype)), f"simulation.numbers_expected(actions, {name})")
        self.assertEqual(self.refused(sim.step, numpy.ma.masked_less(good, 1)), "simulation.numbers_masked(actions)")
        for steps in (0, -1, 1.5, True, 2**32):
            self.assertEqual(self.refused(sim.step, good, steps), f"simulation.whole_number_expected(steps, {steps}, 1, 4294967295)")
        self.assertEqual(self.refused(sim.set_wind, (0, 0, NAN)), "aircraft 0: simulation.wind_out_of_range(nan)")
        self.assertEqual(self.refused(sim.set_wind, (0, -1e300, 0)), "aircraft 0: simulation.wind_out_of_range(-1e+300)")
        self.assertEqual(self.refused(sim.set_wind, (0, 0)), "simulation.shape_invalid(wind, (2,), (5, 3) or (3,))")
        self.assertEqual(sim.state.tobytes(), before.tobytes())

    def test_flights_that_are_none_are_refused_and_nothing_moves(self):
        sim = made()
        before = sim.state
        self.assertEqual(self.refused(sim.fly, 300, [17, 17, 2, 17, 17]),
                         "aircraft 2: simulation.level_flight_missing(2, 300)")
        self.assertEqual(self.refused(sim.fly, 0, 17), "aircraft 0: simulation.height_invalid(0)")
        self.assertEqual(self.refused(sim.fly, 300, NAN), "aircraft 0: simulation.airspeed_invalid(nan)")
        self.assertEqual(self.refused(sim.fly, 300, 17, NAN), "aircraft 0: simulation.heading_not_finite(nan)")
        self.assertIn("aircraft 0: simulation.level_flight_missing(17, ", self.refused(sim.fly, 1e7, 17))
        self.assertEqual(self.refused(sim.fly, 300, [17, 17]), "simulation.shape_invalid(airspeed, (2,), (5,), or one number is given)")
        self.assertEqual(self.refused(sim.fly, None, 17), "simulation.numbers_expected(height, NoneType)")
        for only in (5, -6, [0, 5], 1.5, [0.5], True, "all", [[0], [1, 2]], numpy.ones(4, dtype=bool), numpy.ones((5, 1), dtype=bool)):
            for call in (lambda: sim.fly(300, 17, only=only), lambda: sim.reset(only=only), lambda: sim.set_state(before, only=only)):
                self.assertEqual(self.refused(call), f"simulation.selection_invalid({only!r}, 5, 5)")
        sim.fly(300, 17, only=[])
        self.assertIn("simulation.whole_number_expected(seed, -1, ", self.refused(sim.reset, -1))
        self.assertEqual(sim.state.tobytes(), before.tobytes())

    def test_states_that_are_none_are_refused_and_nothing_moves(self):
        sim = made()
        before = sim.state
        for column, value, sentence in ((3, math.inf, "aircraft 4: sim.state_not_finite"),
                                        (6, 3, "aircraft 4: sim.state_not_normalised"),
                                        (3, 2e5, "aircraft 4: sim.state_beyond_model")):
            state = sim.state
            state[:, 0] += 50
            state[4, column] = value
            self.assertEqual(self.refused(sim.set_state, state), sentence)
        self.assertEqual(sim.state.tobytes(), before.tobytes())

    def test_what_cannot_be_made_is_refused(self):
        make = fulmar_sim.Simulation
        self.assertEqual(self.refused(make, ANACONDA, dt=0.2), "sim.step_invalid(0.2)")
        self.assertEqual(self.refused(make, ANACONDA, dt=NAN), "sim.step_invalid(nan)")
        self.assertEqual(self.refused(make, ANACONDA, dt="fast"), "simulation.number_expected(dt, 'fast')")
        self.assertEqual(self.refused(make, ANACONDA, 0), "simulation.whole_number_expected(n, 0, 1, 100000)")
        self.assertIn("simulation.whole_number_expected(threads, 0, ", self.refused(make, ANACONDA, threads=0))
        self.assertEqual(self.refused(make, ANACONDA, turbulence="storm"), "simulation.choice_unknown(turbulence, 'storm', none, light, moderate, severe)")
        for altitude in (NAN, 20001, -1001):
            self.assertEqual(self.refused(make, ANACONDA, origin_altitude=altitude), f"simulation.altitude_out_of_range({altitude})")
        self.assertEqual(self.refused(make, ANACONDA, dt=True), "simulation.number_expected(dt, True)")
        self.assertEqual(self.refused(make, ANACONDA, turbulence=numpy.zeros(2)), "simulation.choice_unknown(turbulence, array([0., 0.]), none, light, moderate, severe)")
        with self.assertRaisesRegex(TypeError, "unexpected keyword argument 'gust'"):
            make(ANACONDA, gust=3)

    def test_a_fault_of_the_file_is_told_as_the_host_tells_it(self):
        lines = pathlib.Path(ANACONDA).read_text().splitlines()
        at = next(i for i, line in enumerate(lines) if line.startswith("mass"))
        with tempfile.TemporaryDirectory() as folder:
            bad = pathlib.Path(folder) / "bad.yaml"
            for line, sentence in (("mass: -3 kg", "mass: graph.value_out_of_range(-3 kg, 0.0001, 1e+06,  kg, )"), ("mas: 3 kg", "graph.field_unknown(, mas, Airframe,  Did you mean 'mass'? [] name, ")):
                bad.write_text("\n".join(lines[:at] + [line] + lines[at + 1:]) + "\n")
                told = self.refused(fulmar_sim.Simulation, bad)
                self.assertIn(f"bad.yaml:{at + 1}: ", told)
                self.assertIn(sentence, told)
        for name, sentence in (("none/anacoda.yaml", "graph.file_missing(none/anacoda.yaml, . Did you mean 'fulmar:airframes/anaconda.yaml'?)"),
                               ("configs", "graph.file_is_folder(configs)"), (5, "simulation.file_name_expected(5)"),
                               (None, "simulation.file_name_expected(None)"), ("a\0b", "simulation.file_name_invalid('a\\x00b')")):
            self.assertEqual(self.refused(fulmar_sim.Simulation, name), sentence)
        self.assertIn("hourglass.yaml:2: graph.field_unknown(, mission, Airframe, ", self.refused(fulmar_sim.Simulation, "fulmar:missions/hourglass.yaml"))
        self.assertEqual(fulmar_sim.Simulation("fulmar:airframes/anaconda.yaml").n, 1)

    def test_a_child_process_is_told_that_the_threads_stayed_behind(self):
        sim = fulmar_sim.Simulation(ANACONDA, 2, threads=2)
        child = os.fork()
        if child == 0:
            try:
                sim.step([0, 0, 0, 0])
            except fulmar_sim.Error as error:
                sim.__del__()
                os._exit(0 if str(error) == "simulation.other_process" else 2)
            os._exit(1)
        self.assertEqual(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), 0)

    def test_nobody_gets_at_what_is_freed_or_beyond_its_arrays(self):
        sim = made()
        for call in (lambda: copy.copy(sim), lambda: copy.deepcopy(sim), lambda: pickle.dumps(sim)):
            self.assertEqual(self.refused(call), "simulation.copy_unsupported")
        with self.assertRaises(AttributeError):
            sim.n = 1
        sim.row_names = ()
        self.assertEqual(sim.state.shape, (5, 26))
        kept = sim.state
        kept[:] = NAN  # an array of its own
        self.assertTrue(numpy.isfinite(sim.state).all())
        self.refused(sim.__init__, ANACONDA, turbulence="storm")
        for call in (lambda: sim.state, lambda: sim.trim, sim.reset, lambda: sim.fly(300, 17), lambda: sim.step([0] * 4), lambda: sim.set_wind([0] * 3)):
            self.assertEqual(self.refused(call), "simulation.simulation_closed")
        sim.__del__()
        sim.__init__(ANACONDA, 2)
        self.assertEqual(sim.state.shape, (2, 26))
        self.assertEqual(self.refused(lambda: fulmar_sim.Simulation.__new__(fulmar_sim.Simulation).state), "simulation.simulation_closed")

    def test_actions_that_another_thread_spoils_meanwhile_do_not_count(self):
        sim, actions = made(threads=2), numpy.zeros((5, 4))
        for _ in range(10):
            sim.fly(300, 17)
            actions.fill(0)
            spoiler = threading.Timer(0.001, actions.fill, [NAN])
            spoiler.start()
            try:
                sim.step(actions, steps=8000)  # some 10 ms
            except fulmar_sim.Error as error:  # on a machine that was busy elsewhere
                self.assertEqual(str(error), "aircraft 0: sim.command_not_finite(throttle_frac, nan)")
            spoiler.join()
            self.assertTrue(numpy.isfinite(sim.state).all())

    def test_a_long_step_is_one_and_can_be_interrupted(self):
        sim, other = made(), made()
        pieces, fulmar_sim._PIECE = fulmar_sim._PIECE, 35
        try:
            self.assertEqual(sim.step([0.5, 0, 0.1, 0], steps=50).tobytes(), other.step([0.5, 0, 0.1, 0], steps=20).tobytes() and
                             other.step([0.5, 0, 0.1, 0], steps=30).tobytes())
        finally:
            fulmar_sim._PIECE = pieces
        signal.setitimer(signal.ITIMER_REAL, 0.05)
        signal.signal(signal.SIGALRM, lambda *_: (_ for _ in ()).throw(KeyboardInterrupt))
        with self.assertRaises(KeyboardInterrupt):
            sim.step([0.5, 0, 0.1, 0], steps=2**32 - 1)
        self.assertTrue(numpy.isfinite(sim.state).all())


class Page(unittest.TestCase):
    def test_what_the_readme_shows_runs(self):
        text = (pathlib.Path(__file__).parent.parent / "README.md").read_text()
        blocks = re.findall(r"^```python\n(.*?)^```", text, re.M | re.S)
        self.assertEqual(len(blocks), 1)
        names = {}
        exec(blocks[0], names)
        self.assertEqual(names["rows"].shape, (1000, 26))
        columns = re.search(r"rows are \(n, (\d+)\)", fulmar_sim.Simulation.__doc__, re.I)
        self.assertEqual(int(columns[1]), len(fulmar_sim.Simulation.row_names))


unittest.main()

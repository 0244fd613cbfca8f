# SPDX-License-Identifier: BSD-3-Clause
"""The module `fulmar`: flights from Python. Run by ctest with the module's folder in PYTHONPATH."""
import json
import math
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import fulmar

source, program = Path(sys.argv.pop()), Path(sys.argv.pop())
hourglass = str(source / "configs/missions/hourglass.yaml")

try:
    import numpy
except ModuleNotFoundError:
    numpy = None


class Flights(unittest.TestCase):
    def test_a_flight_from_python_is_the_flight_of_the_program(self):
        """Same mission and seed: same figures, to the last digit."""
        sim = fulmar.Sim(hourglass, seed=3, duration_s=60)
        result = sim.run()
        told = subprocess.run([program, "run", hourglass, "--seed", "3", "--duration", "60", "--json", "--no-log"], check=True,
                              capture_output=True, text=True)
        other = json.loads(told.stdout)
        self.assertEqual(result["result"], "flown")
        for key in ("tracking_rmse", "estimation_rmse", "phases", "guards", "flight_time_s"):
            self.assertEqual(result[key], other[key])

    def test_steps_advance_the_clock_by_ticks(self):
        sim = fulmar.Sim(hourglass)
        self.assertTrue(sim.step())
        begin = sim.now_s
        sim.step(400)
        self.assertAlmostEqual(sim.now_s - begin, 400 * sim.tick_s)
        self.assertFalse(sim.done)
        self.assertIsNone(sim.result)
        sim.run(until_s=1.0)
        self.assertAlmostEqual(sim.now_s, 1.0, delta=0.01)
        self.assertEqual(sim.phase, "takeoff")
        with self.assertRaises(fulmar.Error):
            sim.step(-1)

    def test_stepped_and_run_in_one_go_are_the_same_flight(self):
        one, other = fulmar.Sim(hourglass, duration_s=20), fulmar.Sim(hourglass, duration_s=20)
        while one.step(7):
            pass
        other.run()
        self.assertEqual(one["nav.state.height_m"], other["nav.state.height_m"])

    def test_ports_are_copies_and_fields_are_numbers(self):
        sim = fulmar.Sim(hourglass)
        self.assertIsNone(sim["nav.state"])
        sim.run(until_s=20)
        state = sim["nav.state"]
        height = sim["nav.state.height_m"]
        self.assertGreater(height, 20)
        self.assertEqual(height, state["height_m"])
        self.assertEqual(sim["vehicle.status.health"], "ok")
        self.assertIs(sim["vehicle.status.armed"], True)
        sim.step(400)
        self.assertEqual(height, state["height_m"])
        if numpy:
            self.assertEqual(state.height_m, height)
            self.assertEqual(state.position_m[2], -height)
            self.assertAlmostEqual(numpy.linalg.norm(state.attitude), 1)
        for wrong in ("nav.stat", "nva.state", "nav.state.hight_m", "nav"):
            with self.assertRaises((KeyError, fulmar.Error)) as told:
                sim[wrong]
            if wrong != "nav":
                self.assertIn("Did you mean", str(told.exception))

    def test_parameters_change_before_and_in_flight(self):
        sim = fulmar.Sim(hourglass, set={"slc.course_kp": 0.9, "slc.roll_limit": "30 deg"})
        self.assertEqual(sim.param["slc.course_kp"], 0.9)
        self.assertAlmostEqual(sim.param["slc.roll_limit"], math.radians(30))
        self.assertIn("slc.course_kp", list(sim.param))
        sim.param["sim.turbulence"] = "none"  # of set-up: before the first tick alone
        sim.param["sim.wind_ned"] = [0, 0, 0]
        sim.run(until_s=15)
        self.assertEqual(tuple(sim["vehicle.truth"]["wind_mps"]) if numpy else (0, 0, 0), (0, 0, 0))
        sim.param["slc.roll_limit"] = "20 deg"
        self.assertAlmostEqual(sim.param["slc.roll_limit"], math.radians(20))
        for name, value, words in (("slc.course_kp", 700, "outside"), ("slc.course_kp", "7 kg", "mass"), ("sim.turbulence", "light", "set-up"),
                                   ("slc.corse_kp", 1, "Did you mean 'course_kp'")):
            with self.assertRaises((KeyError, fulmar.Error)) as told:
                sim.param[name] = value
            self.assertIn(words, str(told.exception))

    def test_a_reset_keeps_parameters_and_gives_the_same_flight_for_the_same_seed(self):
        sim = fulmar.Sim(hourglass, seed=5)
        sim.param["slc.course_kp"] = 0.8
        sim.run(until_s=15)
        height = sim["nav.state.height_m"]
        sim.reset()
        self.assertEqual(sim.param["slc.course_kp"], 0.8)
        sim.run(until_s=15)
        self.assertEqual(sim["nav.state.height_m"], height)
        sim.reset(6)
        sim.run(until_s=15)
        self.assertNotEqual(sim["nav.state.height_m"], height)

    def test_requests_are_answered_in_the_next_step(self):
        sim = fulmar.Sim(hourglass)
        sim.run(until_s=10)
        good = sim.request("plan.edit", {"kind": "append", "waypoint": {"position_m": [0, 0, -60]}})
        bad = sim.request("plan.edit", {"kind": "remove", "index": 99})
        self.assertFalse(good.answered)
        sim.step(20)
        self.assertTrue(good.accepted)
        self.assertFalse(bad.accepted)
        self.assertTrue(bad.reason)
        self.assertEqual(sim["plan.plan"]["waypoints"]["count"] if numpy else 5, 5)
        for port, message in (("plan.edti", {}), ("plan.edit", {"kind": "explode"}), ("plan.edit", {"knd": "clear"})):
            with self.assertRaises((KeyError, fulmar.Error)) as told:
                sim.request(port, message)
            self.assertIn("Valid", str(told.exception))

    def test_a_log_is_written(self):
        with tempfile.TemporaryDirectory() as folder:
            log = Path(folder) / "flight.mcap"
            result = fulmar.Sim(hourglass, duration_s=5, log=str(log)).run()
            self.assertEqual(result["result"], "flown")
            self.assertEqual(log.read_bytes()[:5], b"\x89MCAP")

    def test_a_component_in_python_flies_in_a_program_in_python(self):
        result = fulmar.Sim(str(source / "examples/python/my_law.yaml"), duration_s=60).run()
        self.assertEqual(result["result"], "flown")
        self.assertEqual(result["guards"], [])
        self.assertIn("mine", result["step_time_us"])

    def test_fast_dds_is_loaded_for_a_mission_with_dds_and_its_faults_are_errors(self):
        def mapped():
            return "libfastrtps" in Path("/proc/self/maps").read_text()
        with tempfile.TemporaryDirectory() as folder:
            mission = Path(folder) / "over_dds.yaml"
            mission.write_text(f"mission: over_dds\nextends: {hourglass}\ndds: {{domain: 230, interfaces: [192.0.2.1]}}\n")
            fulmar.Sim(str(mission))  # as fast as possible: nothing is opened
            self.assertFalse(mapped())
            with self.assertRaises(fulmar.Error) as told:
                fulmar.Sim(str(mission), speed=20)
            self.assertIn("over_dds.yaml:3: dds.interfaces", str(told.exception))
            self.assertTrue(mapped())

    def test_a_mission_with_faults_is_an_error(self):
        with self.assertRaises(fulmar.Error) as told:
            fulmar.Sim(hourglass, roles={"outer": "nobody"})
        self.assertIn("nobody", str(told.exception))


if __name__ == "__main__":
    unittest.main()

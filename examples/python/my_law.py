# SPDX-License-Identifier: BSD-3-Clause
"""Outer loops in Python, with the law of the template. Equations: Beard & McLain, Small Unmanned Aircraft (2012), chapter 6."""
import math

import fulmar_plugin as f

__version__ = "1.0.0"


class MyLaw:
    """Proportional course, height and airspeed hold."""

    class Inputs:
        state = f.In("VehicleState")
        command = f.In("GuidanceCommand")

    class Outputs:
        attitude = f.Out("AttitudeCommand")
        height_error_m = f.Probe()

    class Params:
        course_kp = f.Param(1.2, "rad/rad", 0, 5, "roll per course error")
        height_kp = f.Param(0.02, "rad/m", 0, 0.2, "pitch per height error")
        airspeed_kp = f.Param(0.08, "s/m", 0, 1, "throttle per airspeed error")
        roll_max = f.Param(math.radians(40), "rad", 0, 1, "limit of the roll command, either way")
        pitch_trim = f.Param(math.radians(2), "rad", -0.3, 0.3, "pitch in level flight")
        throttle_trim = f.Param(0.5, "", 0, 1, "throttle in level flight")

    def step(self, tick, inp, p, out):
        state, command = inp.state, inp.command
        course_error = f.wrap_pi(command.course_rad - state.course_rad)
        height_error = command.height_m - state.height_m
        out.height_error_m = height_error
        out.attitude.roll_rad = f.clamp(command.roll_feedforward_rad + p.course_kp * course_error, -p.roll_max, p.roll_max)
        out.attitude.pitch_rad = f.clamp(p.pitch_trim + p.height_kp * height_error, -0.3, 0.3)
        out.attitude.throttle_frac = f.clamp(p.throttle_trim + p.airspeed_kp * (command.airspeed_mps - state.airspeed_mps), 0, 1)

// SPDX-License-Identifier: BSD-3-Clause
// The autotune in the nonlinear Anaconda of sdk/test/flight, straight to the north at 17 m/s.
#pragma once
#include <doctest/doctest.h>

#include <fulmar/testing.hpp>
#include <functional>
#include <string>
#include <vector>

#include "plugins/control_slc/autotune.hpp"
#include "plugins/control_slc/outer.hpp"
#include "sdk/test/flight/flight_model.hpp"

namespace autotune_test {

using namespace fulmar;
using slc::Autotune;
using Stage = AutotuneStage;
using Verdict = AutotuneVerdict;
using Reason = AutotuneReason;

struct Flight {
  test::FlightModel model;
  Bench<slc::Outer> outer;
  Bench<Autotune> tuner;
  GuidanceCommand command{
      .course_rad = 0, .height_m = 70, .climb_rate_mps = 0, .airspeed_mps = 17, .roll_feedforward_rad = 0};
  VehicleStatus status;
  std::function<void(VehicleState&)> seen = [](VehicleState&) {};  ///< effect of the estimator
  double aileron_power = 1;
  std::function<void(Actuators&)> servos = [](Actuators&) {};  ///< effect of the servos
  bool has_status = true;                                      ///< the input is wired
  double t = 0, dt = 0.01;
  std::vector<std::string> reported;

  explicit Flight(double factor = 1, Turbulence turbulence = Turbulence::none, std::uint64_t seed = 1)
      : model(test::anaconda(), turbulence, seed) {
    for (Record<Airframe>* record : {&outer.params.common.airframe, &tuner.params.law.airframe}) {
      record->value = model.airframe;
      record->is_given = true;
    }
    status.in_control = true;
    slc::Inner::Params& p = tuner.params.law;
    p.roll_kff.value = 0.21;
    p.pitch_kd.value = 0.28;
    for (Param* gain : {&p.roll_kp, &p.roll_ki, &p.roll_kd, &p.pitch_kp, &p.pitch_ki, &p.pitch_kd, &p.yaw_kd})
      gain->value *= factor;
  }
  const AutotuneReport& report() const { return tuner.out.report; }
  void step() {
    VehicleState state = model.state();
    seen(state);
    outer.set(outer.in.state, model.state());
    outer.set(outer.in.command, command);
    outer.step(dt);
    tuner.set(tuner.in.law.state, state);
    tuner.set(tuner.in.law.attitude, outer.out.attitude);
    if (has_status) tuner.set(tuner.in.status, status);
    Status ended = Status::failed;
    const bool clean = allocations([&] { ended = tuner.step(dt); }) == 0;
    if (!clean || ended == Status::failed) FAIL("a step failed or allocated");
    for (std::uint32_t i = 0; i < tuner.out.findings.count; ++i)
      reported.emplace_back(tuner.out.findings.items[i].text.bytes.data());
    Actuators u = tuner.out.law.actuators;
    u.aileron_rad *= aileron_power;
    servos(u);
    for (int i = 0; i < std::lround(dt / 0.0025); ++i) model.step(u, 0.0025);
    t += dt;
  }
  void fly(double seconds) {
    for (const double end = t + seconds - 1e-9; t < end;) step();
  }
  template <class Until>
  bool fly_until(Until until, double limit_s = 100) {
    for (const double end = t + limit_s; t < end;) {
      step();
      if (until()) return true;
    }
    return false;
  }
  void tune() {
    tuner.params.tune.value = true;
    tuner.retune();
  }
  bool done() const { return report().done; }
  bool has_reported(const std::string& code) const {
    return std::any_of(reported.begin(), reported.end(),
                       [&](const std::string& s) { return s.find(code) != std::string::npos; });
  }
};

inline bool as_before(const AutotuneReport& r, std::size_t i) {
  return r.kp_ratio[i] == r.before_kp_ratio[i] && r.ki_ratio[i] == r.before_ki_ratio[i] &&
         r.kd_ratio[i] == r.before_kd_ratio[i];
}

}  // namespace autotune_test

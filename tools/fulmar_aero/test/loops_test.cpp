// SPDX-License-Identifier: BSD-3-Clause
// Reported margins against flights of the shipped inner law around the linear aircraft, step by step in time:
// with the aileron's gain slightly inside a margin it settles, slightly outside it grows.
#include "tools/fulmar_aero/loops.hpp"

#include <doctest/doctest.h>

#include <deque>
#include <fulmar/testing.hpp>

#include "plugins/control_slc/inner.hpp"
#include "tools/fulmar_aero/airframe_file.hpp"
#include "tools/fulmar_aero/flight_model.hpp"
#include "tools/fulmar_aero/gains_file.hpp"

namespace loops_test {

using namespace fulmar;
using namespace fulmar::aero;

namespace {
struct Aircraft {
  Plant plant;
  Laws laws;
  explicit Aircraft(const char* name, double delay_s) {
    const AirframeFile file =
        read_airframe_file(std::string(FULMAR_SOURCE_DIR "/configs/airframes/") + name + ".yaml");
    laws = laws_in(file).laws;
    const AircraftModel m(file.airframe, 0);
    const SteadyFlight flight = fly(m, {.airspeed_mps = file.airframe.limits.airspeed_cruise_mps});
    plant = {file.airframe, linearised(m, flight), flight, 0, 0.01, delay_s};
  }

  /// Roll rate late over roll rate early, of a flight with `factor` on one command.
  double growth(int input, double factor) const {
    Bench<slc::Inner> bench;
    bench.params.airframe.value = plant.airframe;
    bench.params.roll_kp.value = laws.inner.roll_kp;
    bench.params.roll_ki.value = laws.inner.roll_ki;
    bench.params.roll_kd.value = laws.inner.roll_kd;
    bench.params.roll_kff.value = laws.inner.roll_kff;
    bench.params.pitch_kp.value = laws.inner.pitch_kp;
    bench.params.pitch_ki.value = laws.inner.pitch_ki;
    bench.params.pitch_kd.value = laws.inner.pitch_kd;
    bench.params.yaw_kd.value = laws.inner.yaw_kd;
    bench.params.yaw_washout.value = laws.inner.yaw_washout;
    bench.params.roll_from_sideslip.value = laws.inner.roll_from_sideslip;
    bench.params.scale_limit.value = laws.inner.scale_limit;
    bench.params.quieten.value = false;  // it is to grow
    const double Va = plant.flight.condition.airspeed_mps, theta = plant.flight.x(model::pitch);
    model::StateVector<double> x = model::StateVector<double>::Zero();
    x(input == model::elevator ? model::q : model::p) = 1e-6;
    Eigen::Vector3d at = Eigen::Vector3d::Zero(), rate = at, trim = at;
    std::deque<Eigen::Vector3d> late(std::size_t(std::lround(plant.delay_s / 0.001)) + 1, at);
    double early = 0, last = 0;
    for (int k = 0; k < 2000; ++k) {
      VehicleState s;
      s.height_m = 0;
      s.attitude_valid = s.airspeed_valid = s.height_valid = s.velocity_valid = true;
      const Eigen::Vector3d v = plant.flight.x.segment<3>(model::u);
      s.airspeed_mps = Va + v.dot(x.segment<3>(model::u)) / Va;
      s.ground_speed_mps = Va;
      s.roll_rad = x(model::roll);
      s.pitch_rad = theta + x(model::pitch);
      s.rate_radps = {x(model::p), x(model::q), x(model::r)};
      s.beta_rad = x(model::v) / Va;
      bench.set(bench.in.state, s);
      bench.set(bench.in.attitude, AttitudeCommand{0, theta, 0.5});
      bench.step(0.01);
      const Actuators& u = bench.out.actuators;
      Eigen::Vector3d wanted(u.aileron_rad, u.elevator_rad, u.rudder_rad);
      if (k == 0) trim = {plant.airframe.aileron.trim_rad, u.elevator_rad, plant.airframe.rudder.trim_rad};
      wanted -= trim;
      wanted(input) *= factor;
      for (int i = 0; i < 10; ++i) {
        late.push_back(wanted);
        late.pop_front();
        for (int n = 0; n < 10; ++n) advance(x, at, rate, late.front(), 1e-4);
      }
      const double size = std::abs(x(input == model::elevator ? model::q : model::p));
      if (k > 600 && k < 1000) early = std::max(early, size);
      if (k > 1600) last = std::max(last, size);
    }
    return last / early;
  }

 private:
  void advance(model::StateVector<double>& x, Eigen::Vector3d& at, Eigen::Vector3d& rate,
               const Eigen::Vector3d& wanted, double dt) const {
    const Airframe& a = plant.airframe;
    const std::array<const Surface*, 3> servo{&a.aileron, &a.elevator, &a.rudder};
    for (int i = 0; i < 3; ++i) {
      const double w = servo[std::size_t(i)]->natural_frequency_radps;
      if (w > 0) {
        rate(i) +=
            dt * (w * w * (wanted(i) - at(i)) - 2 * servo[std::size_t(i)]->damping_ratio * w * rate(i));
        at(i) += dt * rate(i);
      } else {
        at(i) += dt * (wanted(i) - at(i)) / servo[std::size_t(i)]->time_constant_s;
      }
    }
    model::InputVector<double> input;
    input << at, 0;
    x += dt * (plant.linear.A * x + plant.linear.B * input);
  }
};

const LoopFigures& loop_named(const LoopReport& report, const std::string& name) {
  for (const LoopFigures& f : report.loops)
    if (f.name == name) return f;
  FAIL("no loop " << name);
  return report.loops.front();
}

void check_limit(const Aircraft& a, int input, double factor) {
  CAPTURE(factor);
  const double inward = factor > 1 ? 0.88 : 1.13;
  CHECK(a.growth(input, factor * inward) < 1);
  CHECK(a.growth(input, factor / inward) > 1);
}
double ratio_of(double db) { return std::pow(10, db / 20); }
}  // namespace

TEST_CASE("roll of the X8 has its gain margin both ways" * doctest::test_suite("amounts")) {
  const Aircraft a("x8", 0);
  const LoopReport report = evaluate(a.plant, a.laws, OuterScheme::none);
  CHECK(report.unstable == 0);
  const Margins m = loop_named(report, "roll").at_actuator;
  check_limit(a, model::aileron, ratio_of(m.gain_db));
  check_limit(a, model::aileron, 1 / ratio_of(m.reduction_db));
}

TEST_CASE("roll and pitch of the Anaconda have theirs, and the delay that is told" *
          doctest::test_suite("amounts")) {
  const Aircraft a("anaconda", 0.03);
  const LoopReport report = evaluate(a.plant, a.laws, OuterScheme::none);
  check_limit(a, model::aileron, ratio_of(loop_named(report, "roll").at_actuator.gain_db));
  check_limit(a, model::elevator, ratio_of(loop_named(report, "pitch").at_actuator.gain_db));
}

TEST_CASE("an aircraft that its loops do not hold is told") {
  Aircraft a("x8", 0);
  a.laws.inner.roll_kp.value = 0.1;
  a.laws.inner.roll_kd.value = 0;
  a.laws.inner.roll_from_sideslip.value = 0;
  CHECK(evaluate(a.plant, a.laws, OuterScheme::none).unstable == 2);
  CHECK(evaluate(a.plant, a.laws, OuterScheme::slc).unstable == 2);
}

}  // namespace loops_test

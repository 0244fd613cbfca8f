// SPDX-License-Identifier: BSD-3-Clause
// What the energy laws feed forward in a turn, and what they do not learn below the minimum airspeed.
#include <doctest/doctest.h>

#include <cmath>
#include <fulmar/testing.hpp>

#include "plugins/control_tecs/outer.hpp"
#include "sdk/test/flight/flight_model.hpp"

namespace feed_forward_test {

using namespace fulmar;
using doctest::Approx;

namespace {
VehicleState flying(double airspeed) {
  VehicleState s;
  s.height_m = 70;
  s.airspeed_mps = s.ground_speed_mps = airspeed;
  s.airspeed_valid = s.attitude_valid = s.velocity_valid = s.height_valid = s.position_valid = true;
  s.specific_force_mps2 = {0, 0, -isa::g0};
  return s;
}
void fly(Bench<tecs::Outer>& bench, double wanted_mps, double roll, double airspeed) {
  bench.set(bench.in.state, flying(airspeed));
  bench.set(bench.in.command, GuidanceCommand{.course_rad = 0,
                                              .height_m = 70,
                                              .climb_rate_mps = 0,
                                              .airspeed_mps = wanted_mps,
                                              .roll_feedforward_rad = roll});
  for (int i = 0; i < 500; ++i) bench.step(0.01);
}
double throttle_at(double roll, const Airframe& a) {
  Bench<tecs::Outer> bench;
  bench.params.common.airframe.value = a;
  bench.params.common.airframe.is_given = true;
  bench.params.throttle_integral.value = bench.params.pitch_integral.value = 0;
  fly(bench, 17, roll, 17);
  return bench.out.attitude.throttle_frac;
}
}  // namespace

TEST_CASE("the engine is asked for the drag that a turn adds") {
  const Airframe a = test::anaconda();
  const double rho = standard_air(70).density_kgm3, thrust = tecs::Outer::Params{}.thrust;
  const double drag = turn_trim(a, 0.7, 17, rho).drag_newton - turn_trim(a, 0, 17, rho).drag_newton;
  CHECK((throttle_at(0.7, a) - throttle_at(0, a)) / (drag / thrust) == Approx(1).epsilon(1e-3));
}

TEST_CASE("the throttle learns nothing while the airspeed is below the minimum") {
  Bench<tecs::Outer> bench;
  fly(bench, 15, 0, 8.5);  // the minimum is 10 m/s, the band below it 1.5 m/s
  CHECK(std::abs(bench.out.throttle_integral_frac.value) < 1e-9);
}

}  // namespace feed_forward_test

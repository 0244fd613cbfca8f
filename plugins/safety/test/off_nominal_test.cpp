// SPDX-License-Identifier: BSD-3-Clause
// What happens a second time, and the wind that moves the best glide off its bound.
#include "kit.hpp"
#include "plugins/safety/home.hpp"
#include "plugins/safety/monitor.hpp"

namespace off_nominal_test {

using namespace fulmar;
using namespace fulmar::safety;
using doctest::Approx;

namespace {

/// A monitor in flight; only the position comes and goes.
struct Lost : Bench<Monitor> {
  Lost() {
    kit::give_anaconda(params);
    fly(true, 2);
  }
  const SafetyState& fly(bool position, double seconds) {
    VehicleState state = kit::level();
    state.position_valid = position;
    VehicleStatus status;
    status.armed = true, status.battery_volt = 24;
    for (double t = 0; t < seconds - 0.01; t += 0.02) {
      set(in.state, state, -0.02);
      set(in.status, status, -0.02);
      REQUIRE(step(0.02) == Status::ok);
    }
    return out.safety;
  }
};

/// Of all airspeeds from the least to the most, the one that goes farthest over the ground.
double farthest_m(double height_m, double head_wind_mps) {
  const Airframe a = test::anaconda();
  const double rho = standard_air(test::FlightModel::field_m + height_m).density_kgm3;
  double best = 0;
  for (double Va = 1.2 * a.limits.airspeed_min_mps; Va <= a.limits.airspeed_max_mps; Va += 0.01)
    best = std::max(best, height_m * (Va - head_wind_mps) / sink_rate(a, Va, 0, rho));
  return best;
}

}  // namespace

TEST_CASE("a position that is lost a second time is waited for as long as the first time") {
  Lost w;
  const double wait_s = w.params.gnss.wait_time;
  CHECK(w.fly(false, wait_s - 1).answer == SafetyAnswer::wait);
  CHECK(w.fly(true, 30).answer == SafetyAnswer::none);
  CHECK(w.fly(false, wait_s - 1).answer == SafetyAnswer::wait);
  CHECK(w.fly(false, 10).answer == SafetyAnswer::descend);
}

TEST_CASE("the reach in strong wind is that of the airspeed that goes farthest, from any side") {
  for (const double bearing : {0.0, 0.8, -2.4})
    for (const double head : {14.0, 11.0, -11.0}) {
      CAPTURE(bearing);
      CAPTURE(head);
      Bench<Home> home;
      kit::give_anaconda(home.params);
      home.params.mode.value = HomeMode::glide;
      REQUIRE(home.retune() == Status::ok);
      VehicleState s = kit::level(-300 * std::cos(bearing), -300 * std::sin(bearing), bearing);
      s.wind_mps = {-head * std::cos(bearing), -head * std::sin(bearing), 0};
      home.set(home.in.state, s);
      REQUIRE(home.activate() == Status::ok);
      home.step(0.02);
      CHECK(home.out.progress.reach_m / farthest_m(70, head) == Approx(1).epsilon(0.02));
    }
}

}  // namespace off_nominal_test

// SPDX-License-Identifier: BSD-3-Clause
#include <doctest/doctest.h>

#include <fulmar/flight/control/turn_trim.hpp>

#include "sdk/test/flight/flight_model.hpp"

namespace turn_trim_test {

using namespace fulmar;

TEST_CASE("turn rates are those of a heading that turns at g tan(phi) / Va") {
  // B&M (3.3) inverted: psi' = (q sin(phi) + r cos(phi)) / cos(theta), phi' = 0, theta' = q cos(phi) - r
  // sin(phi) = 0
  for (double phi : {-0.9, -0.2, 0.0, 0.4, 0.8}) {
    for (double theta : {-0.2, 0.0, 0.15}) {
      const TurnRates w = turn_rates(phi, theta, 17, 9.81);
      CHECK((w.q_radps * std::sin(phi) + w.r_radps * std::cos(phi)) / std::cos(theta) ==
            doctest::Approx(9.81 * std::tan(phi) / 17));
      CHECK(std::abs(w.q_radps * std::cos(phi) - w.r_radps * std::sin(phi)) < 1e-12);
      CHECK(std::abs(w.p_radps + (w.q_radps * std::sin(phi) + w.r_radps * std::cos(phi)) * std::tan(theta)) <
            1e-12);
    }
  }
  CHECK(load_factor(std::acos(0.5)) == doctest::Approx(2));
}

TEST_CASE("beyond 1.2 rad a turn is no tighter than there, either way, and nothing steps at the limit") {
  for (const double side : {-1.0, 1.0}) {
    const TurnRates at = turn_rates(1.2 * side, 0, 17), beyond = turn_rates(1.5 * side, 0, 17);
    CHECK(std::hypot(beyond.q_radps, beyond.r_radps) == doctest::Approx(std::hypot(at.q_radps, at.r_radps)));
    CHECK(std::abs(turn_rates(1.2000001 * side, 0, 17).r_radps - at.r_radps) < 1e-6);
    CHECK(at.r_radps * side > 0.5);
    CHECK(load_factor(1.5 * side) == doctest::Approx(1 / std::cos(1.2)));
    CHECK(std::abs(load_factor(1.2000001 * side) - load_factor(1.2 * side)) < 1e-5);
  }
}

TEST_CASE(
    "at the trim of a turn the nonlinear model has the lift, the drag and the balance of pitch that were "
    "meant") {
  const Airframe a = test::anaconda();
  const Aerodynamic model(a);
  const double rho = 1.063;
  for (double phi : {0.0, 0.5, -0.7, 0.9}) {
    for (double Va : {14.0, 17.0, 22.0}) {
      const TurnTrim trim = turn_trim(a, phi, Va, rho);
      const Eigen::Vector3d v_r(Va * std::cos(trim.alpha_rad), 0, Va * std::sin(trim.alpha_rad));
      const TurnRates w = turn_rates(phi, 0, Va);
      const Load load = model.load(v_r, {0, w.q_radps, 0}, {0, trim.elevator_rad, 0}, rho);
      const double ca = std::cos(trim.alpha_rad), sa = std::sin(trim.alpha_rad);
      const double lift = load.force_b.x() * sa - load.force_b.z() * ca,
                   drag = -load.force_b.x() * ca - load.force_b.z() * sa;
      CHECK(lift == doctest::Approx(load_factor(phi) * a.mass_kg * 9.80665).epsilon(5e-3));
      CHECK(std::abs(load.moment_b.y()) < 0.02);  // N m: a thousandth of the maximum by the elevator
      CHECK(trim.drag_newton ==
            doctest::Approx(drag).epsilon(
                0.06));  // the induced drag of the model has no lift of tail and pitch rate
    }
  }
}

TEST_CASE(
    "a turn needs more angle of attack and more elevator up, and an airframe without aerodynamics nothing") {
  const Airframe a = test::anaconda();
  const TurnTrim level = turn_trim(a, 0, 17, 1.063), turn = turn_trim(a, 0.7, 17, 1.063);
  CHECK(turn.alpha_rad > level.alpha_rad);
  CHECK(turn.elevator_rad < level.elevator_rad);
  CHECK(turn.drag_newton > level.drag_newton);
  CHECK(level.elevator_rad ==
        doctest::Approx(0.121).epsilon(0.05).scale(0));  // trim of the airframe file, found by a simulation
  const TurnTrim none = turn_trim(Airframe{}, 0.5, 15, 1.2);
  CHECK(none.alpha_rad == 0);
  CHECK(none.elevator_rad == 0);
}

}  // namespace turn_trim_test

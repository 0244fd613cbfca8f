// SPDX-License-Identifier: BSD-3-Clause
// How the first attitude is found: when a unit rests, and what is taken for what in the air.
#include <doctest/doctest.h>

#include <cmath>
#include <fulmar/flight/atmosphere.hpp>
#include <fulmar/flight/navigation_alignment.hpp>
#include <numbers>

namespace alignment_test {

using namespace fulmar;
using namespace fulmar::navigation;

namespace {
constexpr double g = isa::g0, dt = 0.005;

/// A steady turn through an air that moves: nose first into it.
struct Turning {
  double airspeed = 17, rate = 0.5;
  Vector3d wind = Vector3d::Zero();
  double bank() const { return std::atan(airspeed * rate / g); }
  Vector3d velocity(double t) const {
    return airspeed * Vector3d(std::cos(rate * t), std::sin(rate * t), 0) + wind;
  }
  Vector3d acceleration(double t) const {
    return airspeed * rate * Vector3d(-std::sin(rate * t), std::cos(rate * t), 0);
  }
  Quaterniond attitude(double t) const {
    return Quaterniond(Eigen::AngleAxisd(rate * t, Vector3d::UnitZ()) *
                       Eigen::AngleAxisd(bank(), Vector3d::UnitX()));
  }
  void feel(FlightAlignment& alignment, double from, double to) const {
    for (double t = from + dt / 2; t < to; t += dt) {
      const Quaterniond to_body = attitude(t).conjugate();
      alignment.imu(to_body * Vector3d(0, 0, rate), to_body * (acceleration(t) - Vector3d(0, 0, g)), dt);
    }
  }
};
double degrees(const std::optional<FlightAlignment::Found>& found, const Quaterniond& truth) {
  return found ? found->q_nb.angularDistance(truth) * 180 / std::numbers::pi : 180;
}
}  // namespace

TEST_CASE("a known wind is taken out of the course: the nose points into the air") {
  Turning flight;
  flight.wind = {-2, 6, 0};
  FlightAlignment alignment;
  const FlightAlignment::Known known{g, nullptr, &flight.wind, 0};
  (void)alignment.fix(flight.velocity(0), known);
  flight.feel(alignment, 0, 0.5);
  CHECK(degrees(alignment.fix(flight.velocity(0.5), known), flight.attitude(0.5)) < 3);
}

TEST_CASE("a field that is measured all along a turn is turned back to its beginning") {
  const Turning flight{.rate = 0.8};
  const Vector3d field(2e-5, 5e-6, -1e-5);  // far from the specific force
  FlightAlignment alignment;
  const FlightAlignment::Known known{g, &field, nullptr, 0};
  (void)alignment.fix(flight.velocity(0), known);
  for (double t = 0; t < 0.999; t += 0.02) {
    flight.feel(alignment, t, t + 0.02);
    alignment.mag(flight.attitude(t + 0.02).conjugate() * field);
  }
  CHECK(degrees(alignment.fix(flight.velocity(1), known), flight.attitude(1)) < 1);
}

TEST_CASE("a window with a gap of the inertial unit in it is none") {
  const Turning flight;
  for (const double gap_s : {0.05, 0.2}) {
    FlightAlignment alignment;
    const FlightAlignment::Known known{g, nullptr, nullptr, 0};
    (void)alignment.fix(flight.velocity(0), known);
    flight.feel(alignment, 0, 0.3);
    alignment.imu(Vector3d::Zero(), {0, 0, -g}, gap_s);
    flight.feel(alignment, 0.3 + gap_s, 0.6);
    CHECK(alignment.fix(flight.velocity(0.6), known).has_value() == (gap_s < 0.1));
  }
}

TEST_CASE("a unit rests after a second of blocks that agree, and after a gap it takes a second again") {
  Stillness stillness;
  const auto seconds = [&](double s, double rate) {
    for (int i = 0; i < std::lround(s / dt); ++i) stillness.update({rate, 0, 0}, {0, 0, -g}, dt);
  };
  seconds(0.7, 0.1);
  CHECK_FALSE(stillness.still());
  seconds(0.4, 0.1);
  CHECK(stillness.still());
  stillness.update({0.1, 0, 0}, {0, 0, -g}, 5);
  seconds(0.5, 0.1);
  CHECK_FALSE(stillness.still());
  seconds(0.8, 0.1);
  CHECK(stillness.still());
}

TEST_CASE("a turn that is even within each block and another in the next is no rest") {
  Stillness stillness;
  for (int block = 0; block < 12; ++block) {
    for (int i = 0; i < 50; ++i) stillness.update({0.05 * block, 0, 0}, {0, 0, -g}, dt);
    CHECK_FALSE(stillness.still());
  }
}

}  // namespace alignment_test

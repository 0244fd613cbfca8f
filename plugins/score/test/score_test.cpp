// SPDX-License-Identifier: BSD-3-Clause
// The score against errors that were put in: constant offsets, sines of known root mean square, delays that
// must not count.
#define FULMAR_COUNT_ALLOCATIONS
#include "plugins/score/score.hpp"

#include <doctest/doctest.h>

#include <functional>

#include "fulmar/testing.hpp"

namespace score_test {

using namespace fulmar;
using namespace fulmar::score;

namespace {

constexpr double pi = std::numbers::pi;
constexpr double lat0 = 40.2463724, lon0 = -111.6474138, alt0 = 1387;

/// Straight north at 20 m/s, level wings, 70 m up.
VehicleState north_at(double time_s, double east = 0) {
  VehicleState s;
  s.position_m = {20 * time_s, east, -70};
  s.velocity_mps = {20, 0, 0};
  s.height_m = 70;
  s.ground_speed_mps = 20;
  s.airspeed_mps = 18;
  s.wind_mps = {2, 0, 0};
  s.origin_latitude_deg = lat0;
  s.origin_longitude_deg = lon0;
  s.origin_altitude_m = alt0;
  s.origin_valid = s.attitude_valid = s.velocity_valid = s.position_valid = s.height_valid =
      s.airspeed_valid = s.wind_valid = true;
  return s;
}

Plan square() {
  Plan plan;
  plan.revision = 1;
  for (const auto& [n, e] :
       {std::pair{-10000.0, 0.0}, {10000.0, 0.0}, {10000.0, 5000.0}, {-10000.0, 5000.0}}) {
    Waypoint w;
    w.position_m = {n, e, -72};
    plan.waypoints.push_back(w);
  }
  return plan;
}

Progress under_way() {
  Progress progress;
  progress.item = 1;
  progress.items = 4;
  progress.reached = 1;
  progress.plan_revision = 1;
  return progress;
}

}  // namespace

TEST_CASE(
    "nothing is published before the first waypoint was reached, nor what there is nothing to compare with") {
  Bench<Score> bench;
  Progress progress = under_way();
  progress.reached = 0;
  bench.set(bench.in.plan, square());
  for (int i = 0; i < 500; ++i) {
    bench.set(bench.in.progress, progress);
    bench.set(bench.in.state, north_at(0.01 * i));
    bench.set(bench.in.truth, north_at(0.01 * i));
    bench.step(0.01);
    CHECK_FALSE(bench.out.tracking.written);
    CHECK_FALSE(bench.out.figures.written);
  }
  progress.reached = 1;
  bool tracking = false, gnss = false;
  for (int i = 500; i < 800; ++i) {
    bench.set(bench.in.progress, progress);
    bench.set(bench.in.state, north_at(0.01 * i));
    bench.step(0.01);
    tracking = tracking || bench.out.tracking.written;
    gnss = gnss || bench.out.gnss_error.written;
  }
  CHECK(tracking);
  CHECK_FALSE(gnss);
}

TEST_CASE("tracking errors are those that were put in, against the estimate and against the truth") {
  Bench<Score> bench;
  bench.set(bench.in.plan, square());
  GuidanceCommand command;
  command.airspeed_mps = 17;
  command.course_rad = 2 * pi - 0.1;
  AttitudeCommand attitude;
  attitude.roll_rad = 0.2;
  attitude.pitch_rad = -0.05;
  TrackingError estimated, real;
  for (int i = 0; i < 1000; ++i) {
    const double east = 3 * std::sin(2 * pi * i / 100);  // ten whole periods: root mean square 3 / sqrt 2
    bench.set(bench.in.state, north_at(0.01 * i, east));
    bench.set(bench.in.truth, north_at(0.01 * i, east + 4));
    bench.set(bench.in.progress, under_way());
    bench.set(bench.in.command, command);
    bench.set(bench.in.attitude, attitude);
    bench.step(0.01);
    if (bench.out.tracking.written) estimated = bench.out.tracking.value;
    if (bench.out.tracking_true.written) real = bench.out.tracking_true.value;
  }
  CHECK(estimated.east_m == doctest::Approx(3 / std::sqrt(2)).epsilon(0.01));
  CHECK(std::abs(estimated.north_m) < 1e-9);
  CHECK(estimated.altitude_m == doctest::Approx(2));
  CHECK(estimated.course_rad == doctest::Approx(0.1));
  CHECK(estimated.airspeed_mps == doctest::Approx(1));
  CHECK(estimated.roll_rad == doctest::Approx(0.2));
  CHECK(estimated.pitch_rad == doctest::Approx(0.05));
  CHECK(real.east_m == doctest::Approx(std::sqrt(16 + 4.5)).epsilon(0.01));
}

TEST_CASE("in a corner the error is taken from the fillet, not from the waypoint's legs") {
  Bench<Score> bench;
  const Plan plan = square();
  bench.set(bench.in.plan, plan);
  TrackingError tracking;
  // on the quarter circle of 50 m around (9950, 50), 2 m outside
  for (int i = 0; i <= 200; ++i) {
    const double azimuth = -pi / 2 + pi / 2 * i / 200;
    VehicleState s = north_at(0);
    s.position_m = {9950 + 52 * std::cos(azimuth), 50 + 52 * std::sin(azimuth), -72};
    s.height_m = 72;
    Progress progress = under_way();
    progress.item = i <= 100 ? 1 : 2;
    progress.reached = progress.item;
    bench.set(bench.in.state, s);
    bench.set(bench.in.progress, progress);
    bench.step(0.01);
    if (bench.out.tracking.written) tracking = bench.out.tracking.value;
  }
  // the last publication is at the change of the waypoint or a second later: half or all of the corner;
  // radial error 2 m throughout
  CHECK(std::hypot(tracking.north_m, tracking.east_m) == doctest::Approx(2).epsilon(1e-3));
  CHECK(tracking.altitude_m < 1e-9);
}

TEST_CASE("on the way to the plan, positions are not judged") {
  Bench<Score> bench;
  bench.set(bench.in.plan, square());
  Progress progress = under_way();
  TrackingError tracking;
  for (int i = 0; i < 600; ++i) {
    progress.joining = i >= 300;
    bench.set(bench.in.progress, progress);
    bench.set(bench.in.state, north_at(0.01 * i, progress.joining ? 800 : 1));
    bench.step(0.01);
    if (bench.out.tracking.written) tracking = bench.out.tracking.value;
  }
  CHECK(tracking.east_m == doctest::Approx(1));
}

TEST_CASE("without a plan the error is that from the piece of path that is followed") {
  Bench<Score> bench;
  Path line;
  line.origin_m = {0, 0, -70};
  line.direction_ratio = {1, 0, 0};
  Path orbit;
  orbit.kind = PathKind::orbit;
  orbit.radius_m = 50;
  orbit.origin_m = {100, 0, -70};
  for (const auto& [path, expected] : {std::pair{line, 7.0}, {orbit, std::hypot(100 - 20 * 1.99, 7) - 50}}) {
    Bench<Score> one;
    TrackingError tracking;
    for (int i = 0; i < 200; ++i) {
      one.set(one.in.path, path);
      one.set(one.in.state, north_at(1.99, 7));
      one.step(0.01);
      if (one.out.tracking.written) tracking = one.out.tracking.value;
    }
    CHECK(std::hypot(tracking.north_m, tracking.east_m) == doctest::Approx(expected));
  }
}

TEST_CASE("estimation errors compare one time, whichever of estimate and truth comes first or lags") {
  // the estimate is 0.03 s old when it comes and otherwise exact; at 20 m/s a careless difference would be
  // 0.6 m
  for (const double lag_s : {0.0, 0.03, 0.037}) {
    Bench<Score> bench;
    EstimationError error;
    bool written = false;
    for (int i = 0; i < 1000; ++i) {
      const double now = 0.01 * i;
      VehicleState estimate = north_at(now - lag_s, 0.5);
      estimate.yaw_rad = 0.02;
      estimate.velocity_mps.down = 0.1;
      estimate.wind_mps.east = -0.3;
      bench.set(bench.in.truth, north_at(now));
      bench.set(bench.in.state, estimate, lag_s);
      bench.step(0.01);
      written = written || bench.out.estimation.written;
      if (bench.out.estimation.written) error = bench.out.estimation.value;
    }
    REQUIRE(written);
    CHECK(std::abs(error.north_m) < 1e-6);
    CHECK(error.east_m == doctest::Approx(0.5));
    CHECK(error.heading_rad == doctest::Approx(0.02));
    CHECK(error.vel_z_mps == doctest::Approx(0.1));
    CHECK(error.wind_e_mps == doctest::Approx(0.3));
    CHECK(std::abs(error.vel_x_mps) < 1e-9);
  }
}

TEST_CASE("a truth that comes less often than the estimate is interpolated, not held") {
  Bench<Score> bench;
  EstimationError error;
  for (int i = 0; i < 4000; ++i) {
    const double now = 0.0025 * i;
    if (i % 4 == 1) bench.set(bench.in.truth, north_at(now));
    bench.set(bench.in.state, north_at(now, 0.25));
    bench.step(0.0025);
    if (bench.out.estimation.written) error = bench.out.estimation.value;
  }
  CHECK(std::abs(error.north_m) < 1e-6);
  CHECK(error.east_m == doctest::Approx(0.25));
}

TEST_CASE("estimates in another local frame are compared in the truth's") {
  Bench<Score> bench;
  EstimationError error;
  for (int i = 0; i < 300; ++i) {
    VehicleState estimate = north_at(0.01 * i);
    estimate.origin_altitude_m = alt0 + 10;  // its origin lies higher, so its heights are less
    estimate.height_m -= 10;
    estimate.position_m.down += 10;
    bench.set(bench.in.truth, north_at(0.01 * i));
    bench.set(bench.in.state, estimate);
    bench.step(0.01);
    if (bench.out.estimation.written) error = bench.out.estimation.value;
  }
  CHECK(std::abs(error.altitude_m) < 1e-6);
  CHECK(std::abs(error.north_m) < 1e-6);
}

TEST_CASE("the injected GNSS error is that of the fix at its own time, 0.15 s ago") {
  Bench<Score> bench;
  const LocalFrame frame(lat0, lon0, alt0);
  GnssError error;
  for (int i = 0; i < 1000; ++i) {
    const double now = 0.01 * i;
    bench.set(bench.in.truth, north_at(now));
    bench.set(bench.in.state, north_at(now));
    if (i % 20 == 0 && i >= 20) {
      const auto g = frame.from_ned({20 * (now - 0.15) + 1.5, -0.8, -70});
      Gnss gnss;
      gnss.latitude_deg = g.lat_deg;
      gnss.longitude_deg = g.lon_deg;
      gnss.altitude_m = g.alt_m;
      gnss.fix = FixType::fix_3d;
      bench.set(bench.in.gnss, gnss, 0.15);
    }
    bench.step(0.01);
    if (bench.out.gnss_error.written) error = bench.out.gnss_error.value;
  }
  CHECK(error.north_m == doctest::Approx(1.5).epsilon(1e-5));
  CHECK(error.east_m == doctest::Approx(0.8).epsilon(1e-5));
}

TEST_CASE(
    "figures: waypoints, greatest miss after the first, lap time, surface rates, least airspeed; fresh when "
    "a waypoint is reached") {
  Bench<Score> bench;
  Progress progress = under_way();
  progress.miss_m = 90;  // of the first waypoint: not judged
  Figures figures;
  double published_at = 0, circuits_at = 0;
  for (int i = 1; i <= 2345; ++i) {
    if (i == 500) {
      progress.reached = 2;
      progress.miss_m = 3;
    }
    if (i == 1000) {
      progress.reached = 3;
      progress.miss_m = 1;
    }
    if (i == 2345) {
      progress.reached = 5;
      progress.circuits = 1;
      circuits_at = 0.01 * i;
    }
    VehicleState state = north_at(0.01 * i);
    state.airspeed_mps = i == 1500 ? 12.5 : 18;
    Actuators actuators;
    actuators.aileron_rad = 0.3 * 0.01 * i;  // 0.3 rad/s, the others at rest
    bench.set(bench.in.state, state);
    bench.set(bench.in.progress, progress);
    bench.set(bench.in.actuators, actuators);
    bench.step(0.01);
    if (bench.out.figures.written) {
      figures = bench.out.figures.value;
      published_at = 0.01 * i;
    }
  }
  CHECK(published_at == circuits_at);
  CHECK(figures.waypoints_reached == 5);
  CHECK(figures.miss_distance_max_m == 3);
  CHECK(figures.lap_time_s == doctest::Approx(23.44));
  CHECK(figures.airspeed_min_mps == 12.5);
  CHECK(figures.surface_rate_rms_radps == doctest::Approx(0.3 / std::sqrt(3)));
}

TEST_CASE("the mean of squares stays exact over ten million small errors behind a large one") {
  MeanSquare sum;
  for (int i = 0; i < 10'000'000; ++i) sum.add(0.001);
  CHECK(sum.rms() == doctest::Approx(0.001).epsilon(1e-12));
  MeanSquare other;
  other.add(1000);
  for (int i = 1; i < 1'000'000; ++i) other.add(0);
  CHECK(other.rms() == doctest::Approx(1).epsilon(1e-9));
}

TEST_CASE("a step of the score does not allocate") {
  Bench<Score> bench;
  bench.set(bench.in.plan, square());
  std::uint64_t count = 0;
  for (int i = 0; i < 400; ++i) {
    Progress progress = under_way();
    progress.item = static_cast<std::uint32_t>(i / 100);
    bench.set(bench.in.progress, progress);
    bench.set(bench.in.state, north_at(0.01 * i));
    bench.set(bench.in.truth, north_at(0.01 * i));
    Gnss gnss;
    gnss.latitude_deg = lat0;
    gnss.longitude_deg = lon0;
    gnss.fix = FixType::fix_3d;
    bench.set(bench.in.gnss, gnss, 0.05);
    bench.set(bench.in.command, GuidanceCommand{});
    bench.set(bench.in.attitude, AttitudeCommand{});
    bench.set(bench.in.actuators, Actuators{});
    count += allocations([&] { bench.step(0.01); });
  }
  CHECK(count == 0);
}

TEST_CASE("beside a piece of path that climbs to the left the height wanted is that of the place") {
  for (const Turn turn : {Turn::left, Turn::right}) {
    const double side = turn == Turn::right ? 1 : -1;
    Bench<Score> bench;
    Path arc;
    arc.kind = PathKind::orbit;
    arc.turn = turn;
    arc.radius_m = 100;
    arc.origin_m = {0, 0, -70};
    arc.climb_ratio = 0.1;
    VehicleState s = north_at(0);  // 70 m up, 0.3 rad along the arc: 3 m too low
    s.position_m = {100 * std::cos(side * 0.3), 100 * std::sin(side * 0.3), -70};
    TrackingError tracking;
    double below = 0;
    for (int i = 0; i < 200; ++i) {
      bench.set(bench.in.path, arc);
      bench.set(bench.in.state, s);
      bench.step(0.01);
      if (bench.out.tracking.written) below = bench.out.tracking.value.altitude_m;
    }
    CHECK(below == doctest::Approx(3));
    s.height_m = 73;
    s.position_m.down = -73;
    Bench<Score> right;
    for (int i = 0; i < 200; ++i) {
      right.set(right.in.path, arc);
      right.set(right.in.state, s);
      right.step(0.01);
      if (right.out.tracking.written) tracking = right.out.tracking.value;
    }
    CHECK(std::abs(tracking.altitude_m) < 1e-9);
  }
}

TEST_CASE("between two truths angles go the short way, through south too") {
  Compared a, b;
  a.heading = a.course = a.roll = pi - 0.1;
  b.heading = b.course = b.roll = -pi + 0.3;
  const Compared middle = between(a, b, 0.25), late = between(a, b, 0.75);
  CHECK(std::abs(middle.heading) == doctest::Approx(pi));
  for (const double angle : {late.heading, late.course, late.roll})
    CHECK(angle == doctest::Approx(-pi + 0.2));
}

TEST_CASE("the surfaces' rate begins with the second command") {
  Bench<Score> bench;
  bench.set(bench.in.state, north_at(0));
  double rate = 1;
  for (int i = 0; i < 300; ++i) {
    bench.set(bench.in.state, north_at(0.01 * i));
    if (i > 50) bench.set(bench.in.actuators, Actuators{0.5, 0.2, -0.1, 0.05});
    bench.step(0.01);
    if (bench.out.figures.written) rate = bench.out.figures.value.surface_rate_rms_radps;
  }
  CHECK(rate == 0);
}

TEST_CASE(
    "a flight that was asked for accelerations has no course figure, one that was asked for both has it") {
  Bench<Score> bench;
  GuidanceCommand command;
  command.course_rad = 0.2;
  command.airspeed_mps = 19;
  command.lateral = LateralMode::acceleration;
  TrackingError tracking;
  const auto fly = [&](int steps) {
    for (int i = 0; i < steps; ++i) {
      bench.set(bench.in.command, command);
      bench.set(bench.in.state, north_at(1));
      bench.step(0.01);
      if (bench.out.tracking.written) tracking = bench.out.tracking.value;
    }
  };
  fly(300);
  CHECK(tracking.airspeed_mps == doctest::Approx(1));
  CHECK(tracking.course_rad == unknown_std);
  command.lateral = LateralMode::course;
  fly(200);
  CHECK(tracking.course_rad == doctest::Approx(0.2));
}

TEST_CASE("the distance from a curve is that of its closest point, its height that of there") {
  Path path;  // half an arch to the east, climbing 8 m
  set_curve(path, {{Vec3<Ned>{0, 0, -60}, {60, 0, -60}, {120, 60, -68}, {120, 120, -68}}}, 0.1);
  const VehicleState off = north_at(3.5, 30);
  double least = 1e9, height = 0;
  for (int i = 0; i <= 1000000; ++i) {
    const double u = i / 1e6, v = 1 - u;
    const double north = 3 * v * v * u * 60 + 3 * v * u * u * 120 + u * u * u * 120,
                 east = 3 * v * u * u * 60 + u * u * u * 120;
    const double d = std::hypot(north - off.position_m.north, east - off.position_m.east);
    if (d < least) {
      least = d;
      height = (v * v * v + 3 * v * v * u) * 60 + (3 * v * u * u + u * u * u) * 68;
    }
  }
  REQUIRE(least > 1);
  Bench<Score> bench;
  TrackingError tracking;
  for (int i = 0; i < 200; ++i) {
    bench.set(bench.in.path, path);
    bench.set(bench.in.state, off);
    bench.step(0.01);
    if (bench.out.tracking.written) tracking = bench.out.tracking.value;
  }
  CHECK(std::hypot(tracking.north_m, tracking.east_m) / least == doctest::Approx(1).epsilon(1e-4));
  CHECK(tracking.altitude_m / (70 - height) == doctest::Approx(1).epsilon(1e-3));
}

TEST_CASE("a figure without data is unknown: no lap, no waypoint after the first, no command, no airspeed") {
  Bench<Score> bench;
  Figures figures;
  TrackingError tracking;
  for (int i = 0; i < 300; ++i) {
    bench.set(bench.in.state, north_at(0.01 * i));
    bench.set(bench.in.progress, under_way());
    AttitudeCommand level;
    bench.set(bench.in.attitude, level);
    bench.step(0.01);
    if (bench.out.figures.written) figures = bench.out.figures.value;
    if (bench.out.tracking.written) tracking = bench.out.tracking.value;
  }
  CHECK(figures.lap_time_s == unknown_std);
  CHECK(figures.miss_distance_max_m == unknown_std);
  CHECK(figures.surface_rate_rms_radps == unknown_std);
  CHECK(figures.airspeed_min_mps == 18);
  CHECK(tracking.north_m == unknown_std);  // no plan, no path
  CHECK(tracking.airspeed_mps == unknown_std);
  CHECK(tracking.roll_rad == 0);
}

TEST_CASE("what another guide, the pilot or a failsafe flies is left out of tracking, and so is the ground") {
  enum Who { plan, landing, home, loiter, by_hand, pilot, ground, contact };
  for (const Who who : {plan, landing, home, loiter, by_hand, pilot, ground, contact}) {
    CAPTURE(who);
    Bench<Score> bench;
    GuidanceCommand command;
    command.airspeed_mps = 18;
    VehicleStatus status;
    ContactTruth air;
    bench.set(bench.in.plan, square());
    TrackingError tracking;
    Figures figures;
    for (int i = 0; i < 2000; ++i) {
      const bool second = i >= 1000;  // then it is 40 m off, and slow
      VehicleState s = north_at(0.01 * i, second ? 40 : 0);
      if (second) s.airspeed_mps = 11;
      status.in_control = !(second && who == pilot);
      air.touching = second && who == contact;
      bench.set(bench.in.state, s);
      bench.set(bench.in.progress, under_way());
      bench.set(bench.in.command, command);
      bench.set(bench.in.status, status);
      bench.set(bench.in.contact, air);
      if (second && who == landing) bench.set(bench.in.landing, LandingProgress{});
      if (second && who == home) bench.set(bench.in.home, HomeProgress{});
      if (second && who == loiter) bench.set(bench.in.loiter, LoiterProgress{});
      if (second && who == by_hand) bench.set(bench.in.by_hand, command);
      if (second && who == ground) bench.set(bench.in.ground, GroundState{Contact::ground});
      bench.step(0.01);
      if (bench.out.tracking.written) tracking = bench.out.tracking.value;
      if (bench.out.figures.written) figures = bench.out.figures.value;
    }
    CHECK(tracking.east_m == doctest::Approx(who == plan ? 40 / std::sqrt(2) : 0).epsilon(0.04));
    CHECK(tracking.time_counted_s == doctest::Approx(who == plan ? 20 : 10).epsilon(0.06));
    CHECK(figures.airspeed_min_mps == (who == plan ? 11 : 18));
    const double left_out = who == plan ? 0 : 10;
    CHECK(std::abs(figures.left_out_s - left_out) < 1.1);
  }
}

TEST_CASE("after a landing tracking counts again from the next waypoint on") {
  Bench<Score> bench;
  bench.set(bench.in.plan, square());
  ContactTruth contact;
  TrackingError tracking;
  for (int i = 0; i < 4000; ++i) {
    Progress progress = under_way();
    contact.touching = i >= 1000 && i < 2000;
    progress.reached = i < 3000 ? 1 : 2;  // it climbs away for 10 s
    bench.set(bench.in.state, north_at(0.01 * i, i >= 2000 && i < 3000 ? 40 : 0));
    bench.set(bench.in.progress, progress);
    bench.set(bench.in.contact, contact);
    bench.step(0.01);
    if (bench.out.tracking.written) tracking = bench.out.tracking.value;
  }
  CHECK(tracking.time_counted_s == doctest::Approx(20).epsilon(0.06));
  CHECK(std::abs(tracking.east_m) < 1e-9);
}

namespace {

/// Down a slope of 1 m/s along a runway to 60 deg, onto it at 10 s, 100 m beyond the threshold and 2 m right
/// of its middle, 10 deg of crab; then it rolls 50 m.
struct Landing {
  static constexpr double heading = pi / 3;
  double time_s = 0;
  double ground_m() const { return time_s < 10 ? 15 * (time_s - 10) : std::min(5 * (time_s - 10), 50.0); }
  VehicleState state(double off_m) const {
    VehicleState s = north_at(0);
    const double a = ground_m();
    s.position_m = {500 + a * std::cos(heading) - 2 * std::sin(heading) + off_m,
                    300 + a * std::sin(heading) + 2 * std::cos(heading), 0};
    s.height_m = std::max(10 - time_s, 0.0);
    s.climb_rate_mps = time_s < 10 ? -1 : 0;
    s.course_rad = heading;
    s.yaw_rad = heading + 10 * pi / 180;
    s.roll_rad = -0.1;
    s.ground_speed_mps = time_s < 10 ? 15 : a < 50 ? 5 : 0;
    return s;
  }
  LandingProgress progress() const {
    LandingProgress p;
    p.stage = time_s < 10 ? LandingStage::flare : LandingStage::roll_out;
    p.cross_m = 2;
    p.runway_rad = heading;
    p.beyond_threshold_m = 100 + ground_m();
    return p;
  }
};

}  // namespace

TEST_CASE(
    "a touch-down has sink, place on the runway, crab, bank and run-out, by each source that is wired") {
  enum Source { by_stage, by_ground, by_contact };
  for (const Source source : {by_stage, by_ground, by_contact}) {
    CAPTURE(source);
    Bench<Score> bench;
    Landing landing;
    TouchDown touch, real;
    bool any_real = false;
    for (int i = 0; i < 2500; ++i) {
      landing.time_s = 0.01 * i;
      bench.set(bench.in.state, landing.state(0));
      bench.set(bench.in.truth, landing.state(-3));  // the truth is 3 m south of the estimate
      bench.set(bench.in.landing, landing.progress());
      GroundState ground;
      ground.touch_downs = landing.time_s < 10 ? 4 : 5;
      ground.touch_sink_mps = 0.7;
      if (source == by_ground) bench.set(bench.in.ground, ground);
      ContactTruth contact;
      if (landing.time_s >= 10) {
        const VehicleState at = [&] {
          Landing l;
          l.time_s = 10;
          return l.state(-3);
        }();
        contact = {true, false, "left main wheel", 9.998, at.position_m, 1.25, 15, 0.05, 0.1, pi / 3, pi / 3};
      }
      if (source == by_contact) bench.set(bench.in.contact, contact);
      bench.step(0.01);
      if (bench.out.touch_down.written) touch = bench.out.touch_down.value;
      if (bench.out.touch_down_true.written) {
        real = bench.out.touch_down_true.value;
        any_real = true;
      }
    }
    CHECK(touch.at_s == doctest::Approx(10).epsilon(0.002));
    CHECK(touch.beyond_threshold_m == doctest::Approx(100).epsilon(0.002));
    CHECK(touch.cross_m == doctest::Approx(2));
    CHECK(touch.crab_rad == doctest::Approx(10 * pi / 180));
    CHECK(touch.roll_rad == doctest::Approx(-0.1));
    CHECK(touch.run_out_m == doctest::Approx(50).epsilon(0.01));
    CHECK(touch.cross_max_m == doctest::Approx(2));
    if (source == by_ground) CHECK(touch.sink_mps == 0.7);
    CHECK(any_real == (source == by_contact));
    if (source != by_contact) continue;
    CHECK(real.at_s == 9.998);
    CHECK(real.sink_mps == 1.25);
    CHECK(real.beyond_threshold_m == doctest::Approx(100 - 3 * std::cos(pi / 3)).epsilon(0.002));
    CHECK(real.cross_m == doctest::Approx(2 + 3 * std::sin(pi / 3)).epsilon(0.002));
    CHECK(real.crab_rad == 0);
  }
}

TEST_CASE(
    "no aircraft that stands, and no bounce, is a touch-down; without a runway its fields are unknown") {
  Bench<Score> bench;
  bool any = false;
  TouchDown touch;
  for (int i = 0; i < 3000; ++i) {
    VehicleState s = north_at(0.01 * i);
    s.height_m = i < 1000 ? 0 : i < 2000 ? 20 : 0.3;
    GroundState ground;
    ground.touch_downs = i < 500    ? 1
                         : i < 2000 ? 2
                         : i < 2100 ? 3
                                    : 4;  // at 5 s it has not flown; two at the end
    bench.set(bench.in.state, s);
    bench.set(bench.in.ground, ground);
    bench.step(0.01);
    if (!bench.out.touch_down.written) continue;
    touch = bench.out.touch_down.value;
    any = true;
    CHECK(i >= 2000);
  }
  REQUIRE(any);
  CHECK(touch.at_s == doctest::Approx(20).epsilon(0.002));
  CHECK(touch.cross_m == unknown_std);
  CHECK(touch.beyond_threshold_m == unknown_std);
}

TEST_CASE("a crash is told once, with what touched and what safety did before; figures end there") {
  Bench<Score> bench;
  int crashes = 0;
  Crash crash;
  Verdict verdict;
  SafetyState safety;
  safety.airborne = true;
  ContactTruth contact;
  for (int i = 0; i < 3000; ++i) {
    safety.engine_failed = i >= 1000;
    safety.answer = i >= 1000 ? SafetyAnswer::glide : SafetyAnswer::none;
    if (i >= 2000)
      contact = {true, true, "left wing tip", 20.0, {12, -40, 0}, 3.25, 14.125, -0.7854, 0, 0, 0};
    bench.set(bench.in.state, north_at(0.01 * i));
    bench.set(bench.in.safety, safety);
    bench.set(bench.in.contact, contact);
    bench.step(0.01);
    if (bench.out.verdict.written) verdict = bench.out.verdict.value;
    if (i == 1500) {
      CHECK(verdict.word.view().empty());
      CHECK(verdict.text.view() == "score.answered_because(score.glide, 10.0, flight.engine_failed)");
    }
    if (!bench.out.crash.written) continue;
    ++crashes;
    crash = bench.out.crash.value;
  }
  CHECK(crashes == 1);
  CHECK(crash.part.view() == "left wing tip");
  CHECK(crash.sink_mps == 3.25);
  CHECK(crash.east_m == -40);
  CHECK(verdict.word.view() == "crashed");
  CHECK(verdict.text.view() ==
        "score.crashed_after(score.crashed(left wing tip, 20.00, 3.2, -45, 14.1, 12, north, 40, west), "
        "score.answered_because(score.glide, 10.0, flight.engine_failed))");
}

TEST_CASE("an aircraft that stands is said to have never left the ground, and its alarms are no answers") {
  for (const bool lifts : {false, true}) {
    Bench<Score> bench;
    Verdict verdict;
    SafetyState safety;
    for (int i = 0; i < 1000; ++i) {
      VehicleState s = north_at(0);
      s.height_m = 0.01 * i;  // a barometer that drifts
      safety.answer = i > 300 && i < 400 ? SafetyAnswer::level : SafetyAnswer::none;
      safety.estimator_failed = true;
      bench.set(bench.in.state, s);
      bench.set(bench.in.safety, safety);
      bench.set(bench.in.ground, GroundState{lifts && i > 500 ? Contact::air : Contact::ground});
      bench.step(0.01);
      if (bench.out.verdict.written) verdict = bench.out.verdict.value;
      if (i == 499) CHECK(verdict.text.view() == "score.never_airborne");
    }
    CHECK(verdict.text.view() == (lifts ? "" : "score.never_airborne"));
    CHECK(verdict.word.view().empty());
  }
}

TEST_CASE("a landing, an answer and a crash allocate nothing") {
  Bench<Score> bench;
  SafetyState safety;
  safety.airborne = true;
  ContactTruth contact;
  const auto pass = [&](int i) {
    VehicleState s = north_at(0.01 * i);
    bench.set(bench.in.state, s);
    safety.answer = i % 7 == 0 ? SafetyAnswer::home : SafetyAnswer::wait;
    safety.gnss_lost = safety.battery_low = safety.wind_excessive = true;
    contact.touched_s = i / 20;
    contact.crashed = i == 99;
    bench.set(bench.in.safety, safety);
    bench.set(bench.in.contact, contact);
    bench.step(0.01);
  };
  pass(0);
  std::uint64_t most = 0;
  for (int i = 1; i < 100; ++i) most = std::max(most, allocations([&] { pass(i); }));
  CHECK(most == 0);
}

}  // namespace score_test

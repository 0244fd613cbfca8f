// SPDX-License-Identifier: BSD-3-Clause
// The twin against the truth that it was given, and the comparison against offsets that were put in.
#define FULMAR_COUNT_ALLOCATIONS
#include "plugins/nmea_gnss/twin.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "fulmar/testing.hpp"
#include "plugins/nmea_gnss/compare.hpp"

namespace twin_test {

using namespace fulmar;
using namespace fulmar::nmea;

namespace {

constexpr double lat0 = 40.2463724, lon0 = -111.6474138, alt0 = 1387;

/// Straight north-east at 20 m/s over ground, 70 m up.
VehicleState truth_at(double time_s) {
  VehicleState s;
  const double d = 20 * time_s / std::numbers::sqrt2;
  s.position_m = {d, d, -70};
  s.velocity_mps = {20 / std::numbers::sqrt2, 20 / std::numbers::sqrt2, -1};
  s.height_m = 70;
  s.origin_latitude_deg = lat0;
  s.origin_longitude_deg = lon0;
  s.origin_altitude_m = alt0;
  s.origin_valid = s.position_valid = true;
  return s;
}

void make_perfect(Twin::Params& p) {
  p.horizontal_std.value = p.vertical_std.value = p.white_std.value = p.speed_std.value = 0;
}

}  // namespace

TEST_CASE("a twin without errors says where the truth was, 100 ms late, five times a second") {
  Bench<Twin> bench;
  make_perfect(bench.params);
  int count = 0;
  for (int i = 1; i <= 400; ++i) {
    const double t = 0.01 * i;
    bench.tick.now_ns = (i - 1) * 10000000LL;
    bench.set(bench.in.truth, truth_at(t), -0.01);  // valid at the time of the step
    Gnss clock;
    clock.utc_ns = 1767225600000000000 + i * 10000000LL;
    bench.set(bench.in.clock, clock, -0.01);
    REQUIRE(bench.step(0.01) == Status::ok);
    for (std::size_t k = 0; k < bench.out.gnss.count; ++k, ++count) {
      const Gnss& g = bench.out.gnss.items[k];
      const double d = 20 * (t - 0.1) / std::numbers::sqrt2;
      CHECK(bench.out.gnss.stamps_ns[k] == i * 10000000LL);
      CHECK((g.latitude_deg - lat0) * 111043.6 ==
            doctest::Approx(d).epsilon(1e-3));  // metres per degree at 40.246 deg, 1387 m up
      CHECK((g.longitude_deg - lon0) * 85108.0 == doctest::Approx(d).epsilon(2e-3));
      CHECK(g.altitude_m == doctest::Approx(alt0 + 70).epsilon(1e-5));
      CHECK(g.velocity_mps.north == doctest::Approx(14.1421356));
      CHECK(g.velocity_mps.down == 0);
      CHECK(g.utc_ns == 1767225600000000000 + (i - 10) * 10000000LL);
      CHECK(g.fix == FixType::fix_3d);
    }
  }
  CHECK(count == 20);
}

TEST_CASE(
    "the errors of the twin have the deviation that the parameters say, differ by seed, and repeat with it") {
  const auto fly = [](std::uint64_t seed, double& mean_square) {
    Bench<Twin> bench(seed);
    bench.params.correlation_time.value = 0.1;  // shorter than the period: samples are nearly independent
    bench.params.latency.value = 0;
    double sum = 0, last = 0;
    int n = 0;
    for (int i = 1; i <= 4000; ++i) {
      bench.tick.now_ns = (i - 1) * 200000000LL;
      VehicleState truth = truth_at(0);
      bench.set(bench.in.truth, truth, -0.2);
      bench.step(0.2);
      for (std::size_t k = 0; k < bench.out.gnss.count; ++k, ++n) {
        last = (bench.out.gnss.items[k].latitude_deg - lat0) * 111043.6;
        sum += last * last;
      }
    }
    mean_square = sum / n;
    return last;
  };
  double a = 0, b = 0, c = 0;
  const double last_a = fly(1, a), last_b = fly(2, b), last_c = fly(1, c);
  CHECK(std::sqrt(a) == doctest::Approx(std::hypot(0.7, 0.05)).epsilon(0.05));
  CHECK(last_a != last_b);
  CHECK(last_a == last_c);
}

TEST_CASE("the twin and the comparison take no memory in flight") {
  Bench<Twin> twin;
  Bench<Compare> compare;
  twin.set(twin.in.truth, truth_at(0));
  compare.set(compare.in.state, truth_at(0));
  Gnss fix;
  fix.fix = FixType::fix_3d;
  compare.push(compare.in.reference, fix);
  twin.step(0.2);
  compare.step(0.2);
  CHECK(allocations([&] {
          for (int i = 0; i < 20; ++i) {
            twin.step(0.2);
            compare.step(0.2);
          }
        }) == 0);
}

TEST_CASE("the comparison finds a constant offset, at the time of the fix and not of its arrival") {
  Bench<Compare> bench;
  bench.params.latency.value = 0.1;
  const LocalFrame frame(lat0, lon0, alt0);
  for (int i = 1; i <= 200; ++i) {
    bench.tick.now_ns = (i - 1) * 10000000LL;
    bench.set(bench.in.state, truth_at(0.01 * i), -0.01);
    if (i >= 30 && i % 20 == 0) {
      const Vec3<Ned> then = truth_at(0.01 * i - 0.1).position_m;
      const auto g = frame.from_ned({then.north - 3, then.east + 4,
                                     then.down - 2});  // the reference lies 3 m south, 4 m east, 2 m above
      Gnss fix;
      fix.latitude_deg = g.lat_deg;
      fix.longitude_deg = g.lon_deg;
      fix.altitude_m = g.alt_m;
      fix.fix = FixType::fix_3d;
      bench.tick.now_ns += 10000000LL;  // the stamp of the sample
      bench.push(bench.in.reference, fix);
      bench.tick.now_ns -= 10000000LL;
    }
    bench.step(0.01);
  }
  const ReferenceDifference& d = bench.out.difference.value;
  CHECK(d.north_m == doctest::Approx(3).epsilon(1e-6));
  CHECK(d.east_m == doctest::Approx(4).epsilon(1e-6));
  CHECK(d.horizontal_m == doctest::Approx(5).epsilon(1e-6));
  CHECK(d.horizontal_max_m == doctest::Approx(5).epsilon(1e-6));
  CHECK(d.height_m == doctest::Approx(2).epsilon(1e-6));
  CHECK(d.samples == 9);
}

TEST_CASE("a reference without a fix is not compared") {
  Bench<Compare> bench;
  bench.set(bench.in.state, truth_at(0));
  bench.step(0.01);
  bench.push(bench.in.reference, Gnss{});
  bench.step(0.01);
  CHECK_FALSE(bench.out.difference.written);
}

}  // namespace twin_test

// SPDX-License-Identifier: BSD-3-Clause
// The statistics of a sensor on both sides of each threshold, against first-order means and statistics in
// closed form; and its state when several faults are present.
#include <doctest/doctest.h>

#include <cmath>
#include <fulmar/flight/navigation/aid.hpp>
#include <limits>

namespace aid_test {

using namespace fulmar;
using namespace fulmar::navigation;

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Samples every `dt`, all different, or all equal.
Arrivals arrivals(int n, double dt, bool same = false) {
  Arrivals a;
  for (int k = 0; k < n; ++k) a.sampled({same ? 7.0 : k, 3, -2}, 50 + k * dt);
  return a;
}
bool near(double a, double b) { return std::abs(a - b) < 1e-9; }

ekf::Fused let_in(double ratio = 0.5) { return {true, ratio}; }
ekf::Fused refused(double ratio = 7) { return {false, ratio}; }

/// A sensor of 10 Hz with 2 s of accepted samples, from 0.
struct Sensor {
  Aid aid;
  double t = 0;
  void sample(const ekf::Fused& fused, double value = 0, double dt = 0.1) {
    aid.arrivals.sampled({value != 0 ? value : t, 0, 0}, t);
    aid.record(fused, t);
    t += dt;
  }
  void samples(int n, const ekf::Fused& fused, double value = 0) {
    for (int k = 0; k < n; ++k) sample(fused, value);
  }
  SensorState state(bool flying = true) const { return aid.state(t - 0.1, flying); }
};

}  // namespace

TEST_CASE("a sensor is silent after five of its intervals, and after 0.2 s at the earliest") {
  const auto silent_after_s = [](const Arrivals& a, double last_s) {
    double t = last_s;
    while (!a.silent(t) && t < last_s + 100) t += 0.001;
    return t - last_s;
  };
  CHECK(std::abs(silent_after_s(arrivals(2, 0.1), 50.1) - 0.5) < 0.002);
  CHECK(std::abs(silent_after_s(arrivals(20, 0.01), 50.19) - 0.2) < 0.002);
  CHECK(std::abs(silent_after_s(arrivals(2, 3), 53) - 5) <
        0.002);  // the first interval counts for at most 1 s
  CHECK(Arrivals().silent(0));
  CHECK_FALSE(Arrivals().any());
  CHECK(arrivals(1, 1).any());
  Arrivals slower = arrivals(2, 0.1);  // a tenth of the difference each time
  slower.sampled({9, 9, 9}, 50.25);
  CHECK(std::abs(silent_after_s(slower, 50.25) - 5 * 0.105) < 0.002);
  Arrivals gap = arrivals(2, 0.1);  // a gap counts for three intervals
  gap.sampled({9, 9, 9}, 60);
  CHECK(std::abs(silent_after_s(gap, 60) - 5 * 0.12) < 0.002);
}

TEST_CASE("a sensor is stuck after four repetitions, and 0.45 s at the earliest") {
  CHECK_FALSE(arrivals(4, 0.5, true).stuck());  // three samples equal to the one before
  CHECK(arrivals(5, 0.5, true).stuck());
  CHECK_FALSE(arrivals(5, 0.11, true).stuck());
  CHECK(arrivals(5, 0.115, true).stuck());
  CHECK_FALSE(arrivals(45, 0.01, true).stuck());
  CHECK(arrivals(47, 0.01, true).stuck());
  CHECK_FALSE(arrivals(500, 0.1).stuck());
  CHECK(arrivals(7, 0.1, true).repeated() == 6);
  Arrivals again = arrivals(50, 0.1, true);
  again.sampled({8, 3, -2}, 55);
  CHECK_FALSE(again.stuck());
  for (int k = 1; k <= 4; ++k) again.sampled({8, 3, -2}, 55 + 0.1 * k);
  CHECK_FALSE(again.stuck());  // 0.4 s
  again.sampled({8, 3, -2}, 55.5);
  CHECK(again.stuck());
  for (const std::size_t one : {0U, 1U, 2U}) {  // each number is compared
    Arrivals a;
    for (int k = 0; k < 10; ++k) {
      std::array<double, 3> values{1, 2, 3};
      values[one] += k;
      a.sampled(values, 0.2 * k);
    }
    CHECK_FALSE(a.stuck());
  }
}

TEST_CASE("stamps that go back are a disorder at the third within 1.4 s, and it fades in seconds") {
  const auto disordered = [](double apart_s) {
    Arrivals a;
    for (int k = 0; k < 3; ++k) {
      CHECK_FALSE(a.disordered(20 + k * apart_s));
      a.early(20 + k * apart_s);
    }
    return a.disordered(20 + 2 * apart_s);
  };
  CHECK(disordered(0.69));
  CHECK_FALSE(disordered(0.72));
  Arrivals a;
  for (int k = 0; k < 3; ++k) a.early(30);
  CHECK(a.disordered(30 + 2 * std::log(3 / 2.2) - 0.01));
  CHECK_FALSE(a.disordered(30 + 2 * std::log(3 / 2.2) + 0.01));
}

TEST_CASE("mean and deviation of innovations are first-order means over four and two seconds") {
  Innovations constant, alternating;
  constant.add({2.5}, 10);
  alternating.add({1.2}, 10);
  CHECK(near(constant.mean(), 2.5 * 0.5 / 4.5));  // the first sample counts for half a second
  CHECK(near(constant.std(), 1));
  for (int k = 1; k <= 30; ++k) {
    constant.add({2.5}, 10 + 0.1 * k);
    alternating.add({k % 2 ? -1.2 : 1.2}, 10 + 0.1 * k);
    CHECK(near(constant.mean(), 2.5 * (1 - 4 / 4.5 * std::pow(4 / 4.1, k))));
    CHECK(near(constant.std(), std::sqrt(std::pow(2 / 2.1, k))));
    // half the mean square of differences of 2.4
    CHECK(near(alternating.std(), std::sqrt(2.88 - 1.88 * std::pow(2 / 2.1, k))));
  }
  constant.add({2.5}, 13 + 20);  // a gap counts for half a second
  CHECK(near(constant.mean(), 2.5 * (1 - 4 / 4.5 * std::pow(4 / 4.1, 30) * 4 / 4.5)));
  constant.centre();
  CHECK(constant.mean() == 0);
}

TEST_CASE("an outlier counts as six deviations, and so does what is no number") {
  for (const double ratio : {100.0, nan, std::numeric_limits<double>::infinity()}) {
    Innovations i;
    i.add({ratio}, 0);
    CHECK(near(i.mean(), 6 * 0.5 / 4.5));
  }
  Innovations i;
  i.add({-100}, 0);
  CHECK(near(i.mean(), -6 * 0.5 / 4.5));
}

TEST_CASE("of several axes the mean is that of the farthest, with its sign, the deviation that of all") {
  Innovations i;
  for (int k = 0; k < 400; ++k) i.add({1, k % 2 ? -2.0 : 2.0, -1.5}, 0.1 * k);
  CHECK(i.mean() == doctest::Approx(-1.5).epsilon(0.001));
  CHECK(i.std() == doctest::Approx(std::sqrt(8.0 / 3)).epsilon(0.001));
}

TEST_CASE("noisy is a deviation of two until it is below one and a half; biased a mean of three until two") {
  const auto after = [](Innovations& i, double swing, double mean) {
    static double t = 0;
    for (int k = 0; k < 800; ++k) i.add({mean + (k % 2 ? swing : -swing)}, t += 0.1);
  };
  Innovations noise, bias;
  const double one = 1 / std::sqrt(2.0);  // +-0.71: differences of 1.41, a standard deviation of 1
  for (int again = 0; again < 2; ++again) {
    after(noise, 1.97 * one, 0);
    CHECK_FALSE(noise.noisy());
    after(noise, 2.03 * one, 0);
    CHECK(noise.noisy());
    after(noise, 1.53 * one, 0);
    CHECK(noise.noisy());
    after(noise, 1.47 * one, 0);
    CHECK_FALSE(noise.noisy());
    const double side = again == 0 ? 1 : -1;
    after(bias, 0, side * 2.95);
    CHECK_FALSE(bias.biased());
    after(bias, 0, side * 3.05);
    CHECK(bias.biased());
    after(bias, 0, side * 2.05);
    CHECK(bias.biased());
    after(bias, 0, side * 1.95);
    CHECK_FALSE(bias.biased());
  }
  after(bias, 0, 4);
  bias.centre();
  CHECK_FALSE(bias.biased());
}

TEST_CASE("what successive innovations share: mean products with the one before and the one before that") {
  SharedError constant;
  const Eigen::Vector2d both(0.3, -0.4);
  for (int k = 0; k <= 200; ++k) {
    constant.add(both, 5 + 0.1 * k);
    // 0.125 in k samples of 0.1 s, after an initial 3 s of zero; the second lags by one
    const double mean = 0.125 * 0.1 * k / (3 + 0.1 * k);
    if (k > 1) CHECK(near(constant.std_mps(), std::sqrt(mean * std::min(k / (k - 1.0), 1.5))));
  }
  CHECK(SharedError().std_mps() == 0);
  SharedError alternating, pairs;
  for (int k = 0; k < 20000; ++k) {
    alternating.add((k % 2 ? 1 : -1) * both, 0.1 * k);
    pairs.add(k % 4 < 2 ? both : Eigen::Vector2d(0, 0),
              0.1 * k);  // the second while the previous one was zero
  }
  CHECK(alternating.std_mps() == 0);
  CHECK(pairs.std_mps() == doctest::Approx(std::sqrt(0.125 / 4 * 1.5)).epsilon(0.01));
  const double before = pairs.std_mps();
  for (int k = 0; k < 300; ++k) pairs.add({0, 0}, 2000 + 0.1 * k);  // half a minute of zero
  CHECK(pairs.std_mps() / before == doctest::Approx(std::pow(30 / 30.1, 150)).epsilon(0.02));
  pairs.add({0, 0}, 3000);  // a gap counts for a second
  CHECK(pairs.std_mps() / before ==
        doctest::Approx(std::pow(30 / 30.1, 150) * std::sqrt(30.0 / 31)).epsilon(0.02));
}

TEST_CASE("the book of a sensor counts what was let in and what was refused, and since when") {
  Aid aid;
  aid.record(let_in(1.5), 3);
  CHECK(aid.ratio == 1.5);
  CHECK(aid.accepted_s == 3);
  CHECK(aid.refused_from_s == never);
  aid.record(refused(-8), 4);
  aid.record(refused(9), 5);
  CHECK(aid.ratio == 9);
  CHECK(aid.accepted_s == 3);
  CHECK(aid.refused_from_s == 4);
  CHECK(aid.accepted == 1);
  CHECK(aid.refused == 2);
  aid.record(let_in(), 6);
  CHECK(aid.refused_from_s == never);
  CHECK(aid.accepted == 2);
  CHECK(aid.accepted_s == 6);
  const SensorHealth h = aid.health(6, true);
  CHECK(h.accepted == 2);
  CHECK(h.refused == 2);
  CHECK(h.innovation_ratio == 0.5);
  CHECK(h.innovation_std_ratio == aid.innovations.std());
  CHECK(h.innovation_mean_ratio == aid.innovations.mean());
}

TEST_CASE("what was off while it was refused for more than a second is not held against it afterwards") {
  for (const double refused_for_s : {0.9, 1.1}) {
    Aid aid;
    aid.record(let_in(0), 0);
    for (double t = 1; t < 1 + refused_for_s; t += 0.1) aid.record(refused(6), t);
    const bool off = aid.innovations.mean() > 1;
    aid.record(let_in(0), 1 + refused_for_s);
    CHECK(off);
    CHECK((aid.innovations.mean() == 0) == (refused_for_s > 1));
  }
}

TEST_CASE("a sensor is what is worst of it, and each ends by itself") {
  Sensor s;
  CHECK(s.aid.state(0, true) == SensorState::never);
  s.samples(20, let_in());
  CHECK(s.state() == SensorState::ok);
  s.aid.contradicts = true;
  CHECK(s.state() == SensorState::biased);
  CHECK(s.aid.state(s.t + 5, true) == SensorState::silent);
  s.aid.contradicts = false;
  s.samples(10, refused(2));  // 0.9 s since the first
  CHECK(s.state() == SensorState::ok);
  s.samples(3, refused(2));
  CHECK(s.state() == SensorState::refused);
  s.samples(8, refused(2), 5);
  CHECK(s.state(true) == SensorState::stuck);
  CHECK(s.state(false) == SensorState::refused);
  s.samples(1, let_in());
  CHECK(s.state() == SensorState::ok);
  for (int k = 0; k < 3; ++k) s.aid.arrivals.early(s.t);
  CHECK(s.state() == SensorState::refused);
  s.samples(60, let_in());
  CHECK(s.state() == SensorState::ok);
  for (int k = 0; k < 60; ++k) s.sample(refused(k % 2 ? 5 : -5));
  CHECK(s.state() == SensorState::noisy);  // the reason of the rejections
  s.samples(60, let_in());
  for (int k = 0; k < 100; ++k) s.sample(let_in(4));
  CHECK(s.state() == SensorState::biased);
}

TEST_CASE("a fix is good when it is solved, and where the Earth is, with numbers") {
  const auto with = [](auto set) {
    Gnss g;
    g.fix = FixType::fix_3d;
    g.latitude_deg = -90;
    g.longitude_deg = -360;
    g.altitude_m = 500;
    g.velocity_mps = {1, 2, 3};
    set(g);
    return good(g);
  };
  CHECK(with([](Gnss&) {}));
  CHECK(with([](Gnss& g) {
    g.latitude_deg = 90;
    g.longitude_deg = 360;
  }));
  CHECK_FALSE(with([](Gnss& g) { g.latitude_deg = 90.1; }));
  CHECK_FALSE(with([](Gnss& g) { g.latitude_deg = nan; }));
  CHECK_FALSE(with([](Gnss& g) { g.longitude_deg = -360.1; }));
  CHECK_FALSE(with([](Gnss& g) { g.altitude_m = nan; }));
  CHECK_FALSE(with([](Gnss& g) { g.velocity_mps.east = nan; }));
  for (const FixType type : {FixType::fix_3d, FixType::combined, FixType::rtk_float, FixType::rtk_fixed})
    CHECK(with([type](Gnss& g) { g.fix = type; }));
  for (const FixType type : {FixType::none, FixType::fix_2d, FixType::time_only})
    CHECK_FALSE(with([type](Gnss& g) { g.fix = type; }));
}

TEST_CASE("each sensor's samples and stamps go to its own book, and only a good fix counts") {
  const auto names = [](const Health& h) {
    std::string s;
    for (const auto& [name, aid] : {std::pair{"gyro ", &h.gyro},
                                    {"accel ", &h.accel},
                                    {"horizontal ", &h.horizontal},
                                    {"height ", &h.height},
                                    {"velocity ", &h.velocity},
                                    {"baro ", &h.baro},
                                    {"pitot ", &h.pitot},
                                    {"sideslip ", &h.sideslip},
                                    {"heading ", &h.heading}})
      if (aid->arrivals.any() || aid->arrivals.disordered(1)) s += name;
    return s;
  };
  const auto seen = [&](const auto& sample) {
    Health came, early;
    came.came(sample, 1);
    for (int k = 0; k < 3; ++k) early.early(sample, 1);
    CHECK(names(came) == names(early));
    return names(came);
  };
  Gnss fix;
  fix.fix = FixType::fix_3d;
  CHECK(seen(Imu{}) == "gyro accel ");
  CHECK(seen(Mag{}) == "heading ");
  CHECK(seen(Baro{}) == "baro ");
  CHECK(seen(Pitot{}) == "pitot ");
  CHECK(seen(fix) == "horizontal height velocity ");
  Health none;
  none.came(Gnss{}, 1);
  CHECK(names(none) == "");
}

TEST_CASE("a sensor whose numbers change in any axis is not stuck") {
  const auto stuck = [](auto&& sample) {
    Health h;
    for (int k = 0; k < 10; ++k) h.came(sample(k), 0.2 * k);
    int n = 0;
    for (const Aid* aid : {&h.gyro, &h.accel, &h.horizontal, &h.height, &h.velocity, &h.heading})
      n += aid->arrivals.stuck();
    return n;
  };
  for (int axis = 0; axis < 3; ++axis) {
    const auto one = [axis](int k) {
      return Vec3<Body>{axis == 0 ? k : 1.0, axis == 1 ? k : 1.0, axis == 2 ? k : 1.0};
    };
    CHECK(stuck([&](int k) { return Imu{one(k), one(0)}; }) == 1);  // the gyros alone
    CHECK(stuck([&](int k) { return Imu{one(0), one(k)}; }) == 1);
    CHECK(stuck([&](int k) { return Mag{one(k)}; }) == 0);
  }
  const auto fix = [](auto&& change) {
    return [change](int k) {
      Gnss g;
      g.fix = FixType::fix_3d;
      change(g, k);
      return g;
    };
  };
  CHECK(stuck(fix([](Gnss&, int) {})) == 3);
  CHECK(stuck(fix([](Gnss& g, int k) { g.latitude_deg = k; })) == 2);
  CHECK(stuck(fix([](Gnss& g, int k) { g.longitude_deg = k; })) == 2);
  CHECK(stuck(fix([](Gnss& g, int k) { g.altitude_m = k; })) == 2);
  CHECK(stuck(fix([](Gnss& g, int k) { g.velocity_mps.north = k; })) == 2);
  CHECK(stuck(fix([](Gnss& g, int k) { g.velocity_mps.east = k; })) == 2);
}

TEST_CASE("an inertial unit is shaken from 0.3 rad/s and 3 m/s2 on, and at its stop in flight alone") {
  const auto felt = [](double rate, double force) {
    Health h;
    for (int k = 0; k < 1000; ++k) {
      const double side = k % 2 ? 1 : -1;
      const Eigen::Vector3d one(1, 1, 1);
      h.felt(side * rate / std::sqrt(2.0) * one, (9 + side * force / std::sqrt(2.0)) * one);
      h.came(Imu{{side, side, side}, {side, side, side}}, 0.01 * k);
    }
    return h.message(9.99, true);
  };
  CHECK(felt(0.29, 2.9).gyro.state == SensorState::ok);
  CHECK(felt(0.29, 2.9).accel.state == SensorState::ok);
  CHECK(felt(0.31, 2.9).gyro.state == SensorState::noisy);
  CHECK(felt(0.31, 2.9).accel.state == SensorState::ok);
  CHECK(felt(0.29, 3.1).gyro.state == SensorState::ok);
  CHECK(felt(0.29, 3.1).accel.state == SensorState::noisy);
  Health h;
  for (int k = 0; k < 100; ++k) {
    const double v = std::min(k, 50) + 1;
    h.felt({v, v, v}, {0.01 * k, 1, 1});
    h.came(Imu{{v, v, 1.0 * k}, {1.0 * k, v, v}}, 0.01 * k);
  }
  CHECK(h.message(0.99, true).gyro.state == SensorState::stuck);
  CHECK(h.message(0.99, true).accel.state == SensorState::ok);
}

}  // namespace aid_test

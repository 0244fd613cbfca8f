// SPDX-License-Identifier: BSD-3-Clause
// The fault detectors of a sensor on both sides of each threshold: start and end of a report, and detection
// of a second fault as of the first.
#include <doctest/doctest.h>

#include <cmath>
#include <fulmar/flight/navigation/witness.hpp>

namespace witness_test {

using namespace fulmar::navigation;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

/// Samples until `done`, at most `most`.
template <class Step, class Done>
int count(int most, Step&& step, Done&& done) {
  int n = 0;
  while (n < most && !done()) step(n++);
  return n;
}

/// A triad with one axis that alternates by +-`amplitude` about 9.
Vector3d alternating(int axis, double amplitude, int k) {
  Vector3d v(9, 9, 9);
  v(axis) += k % 2 == 0 ? amplitude : -amplitude;
  return v;
}

/// Fixes at 5 Hz of a receiver whose position moves by `extra` m/s faster than its velocity.
struct Receiver {
  Wander wander;
  double std_m = 1, t = 0;
  Vector2d p{30, -20}, v{12, -7};
  void fix(double extra_mps, double jump_m = 0, double dt = 0.2) {
    const Vector2d way = Vector2d(3, 4) / 5;  // neither north nor east
    t += dt;
    p += dt * v + (dt * extra_mps + jump_m) * way;
    wander.fix(p, v, std_m, t);
  }
  void fixes(int n, double extra_mps) {
    for (int i = 0; i < n; ++i) fix(extra_mps);
  }
};

/// The pitot at 50 Hz, and an airspeed without it.
struct PitotSamples {
  double noise = 0.05, std = 1, t = 0, otherwise = 17;
  TubeSteps steps{};
  void sample(double excess, double dt = 0.02) {
    t += dt;
    steps.sampled(otherwise + excess, otherwise, noise, std, t);
  }
  void samples(int n, double excess) {
    for (int i = 0; i < n; ++i) sample(excess);
  }
};

}  // namespace

TEST_CASE("white noise above a triad's limit is vibration, on any axis, by the mean of a hundred samples") {
  for (int axis = 0; axis < 3; ++axis) {
    CAPTURE(axis);
    Triad triad, louder;
    for (int k = 0; k < 2000; ++k) louder.sampled(alternating(axis, 2.4, k), 2);  // 0.98 of it
    CHECK_FALSE(louder.noisy());
    for (int k = 0; k < 2000; ++k) louder.sampled(alternating(axis, 2.5, k), 2);
    CHECK(louder.noisy());
    for (int k = 0; k < 2000; ++k) louder.sampled(alternating(axis, 1.8, k), 2);  // 0.73
    CHECK(louder.noisy());
    for (int k = 0; k < 2000; ++k) louder.sampled(alternating(axis, 1.6, k), 2);
    CHECK_FALSE(louder.noisy());
    triad.sampled(alternating(axis, 0, 0), 1);  // earlier samples do not count
    CHECK_FALSE(triad.noisy());
    // half the mean square of the differences of +-a is 2 a^2: with a^2 = 3 / 2 1 of each axis
    const auto noisy = [&] { return triad.noisy(); };
    triad.sampled(alternating(axis, std::sqrt(3.0), 0), 1);
    const int n = count(
        500, [&](int k) { triad.sampled(alternating(axis, std::sqrt(3.0), k + 1), 1); }, noisy);
    CHECK(n == 69);  // 2 (1 - 0.99^n) > 1, minus half a step at the start
    for (int k = 0; k < 2000; ++k) triad.sampled(alternating(axis, std::sqrt(3.0), k), 1);
    const auto calm = [&] { return !triad.noisy(); };
    const int m = count(
        500, [&](int) { triad.sampled(alternating(axis, 0, 0), 1); }, calm);
    CHECK(std::abs(m - 140) <= 1);  // 2 0.99^m < 0.7^2
  }
}

TEST_CASE("an axis at its stop is seen after five samples, one that is held elsewhere after twenty-five") {
  for (const double side : {1.0, -1.0})
    for (int axis = 0; axis < 3; ++axis) {
      CAPTURE(axis);
      Triad triad;
      int k = 0;
      const auto lively = [&](int n) {
        for (int i = 0; i < n; ++i, ++k)
          triad.sampled(side * Vector3d(1 + 0.01 * (k % 7), 1 + 0.01 * (k % 5), 1 + 0.01 * (k % 3)), 10);
      };
      const auto hold = [&](double value, int n) {
        for (int i = 0; i < n; ++i, ++k) {
          Vector3d v(1 + 0.01 * (k % 7), 1 + 0.01 * (k % 5), 1 + 0.01 * (k % 3));
          v(axis) = value;
          triad.sampled(side * v, 10);
        }
      };
      lively(24);
      hold(2, 1 + 5);  // the 25th different one, then constant
      CHECK(triad.clipped());
      CHECK(triad.was_clipped());
      lively(99);
      CHECK_FALSE(triad.clipped());
      CHECK(triad.was_clipped());
      lively(1);
      CHECK_FALSE(triad.was_clipped());
      for (int again = 0; again < 2; ++again) {
        hold(1.5, 1 + 24);  // below its largest reading
        CHECK_FALSE(triad.clipped());
        hold(1.5, 1);
        CHECK(triad.clipped());
        lively(2);
      }
      hold(2, 1 + 4);
      CHECK_FALSE(triad.clipped());
      hold(0, 50);  // a unit with zero readings is another fault
      CHECK_FALSE(triad.clipped());
    }
}

TEST_CASE("an axis has to have changed for twenty-five samples before it can be at its stop") {
  for (const int changes : {24, 25}) {
    Triad triad;
    for (int k = 0; k < changes; ++k) triad.sampled(Vector3d(1 + k, 1 + k, 1 + k), 1e3);
    for (int k = 0; k < 40; ++k) triad.sampled(Vector3d(changes, 100 + k, 100 + k), 1e3);
    CHECK(triad.clipped() == (changes == 25));
  }
}

TEST_CASE("a position wanders when it is off by 1.6 of its deviation within the last three seconds") {
  for (const double std_m : {1.0, 2.5}) {
    Receiver r;
    r.std_m = std_m;
    r.fixes(5, 0);
    const auto wanders = [&] { return r.wander.wanders(); };
    // The sum of v dt exp(-t / 3): v dt (1 - q^n) / (1 - q), which is 1.6 at n = 10.9
    const int n = count(
        100, [&](int) { r.fix(std_m); }, wanders);
    CHECK(n == 11);
    r.fixes(20, std_m);
    const double q = std::exp(-0.2 / 3), off = 0.2 * (1 - std::pow(q, 31)) / (1 - q);
    // until below half of the limit: 0.8
    const int m = count(
        100, [&](int) { r.fix(0); }, [&] { return !r.wander.wanders(); });
    CHECK(m == static_cast<int>(std::ceil(std::log(off / 0.8) / (0.2 / 3))));
  }
}

TEST_CASE("a jump, a gap and what follows a missed fix are no wander; a fast turn is none either") {
  const auto after = [](double jump_m, double dt, bool missed) {
    Receiver r;
    r.fixes(5, 0);
    if (missed) r.wander.missed();
    r.fix(0, jump_m, dt);
    return r.wander.wanders();
  };
  CHECK(after(4.9, 0.2, false));
  CHECK_FALSE(after(5.1, 0.2, false));
  CHECK(after(-4.9, 0.2, false));
  CHECK(after(3, 1.45, false));
  CHECK_FALSE(after(3, 1.55, false));
  CHECK_FALSE(after(3, 0.2, true));
  Receiver r;
  r.fixes(5, 2);
  r.fix(0, 3);
  REQUIRE(r.wander.wanders());
  r.fix(0, 6);  // a jump ends it
  CHECK_FALSE(r.wander.wanders());
  r.fix(0, 1.4);  // also of its previous excess
  CHECK_FALSE(r.wander.wanders());
  Vector2d v(17, 0), p(0, 0);
  Wander turning;
  for (int k = 1; k < 100; ++k) {
    const Vector2d before = v;
    v = 17 * Vector2d(std::cos(0.4 * k), std::sin(0.4 * k));
    p += 0.1 * (v + before);
    turning.fix(p, v, 0.1, 0.2 * k);
    CHECK_FALSE(turning.wanders());
  }
}

TEST_CASE("what a receiver is off all the time raises the limit, over minutes, to 4.5 times as much") {
  const double dt = 0.2, steady = 1.5 * (1 - std::exp(-dt / 3)) / dt;  // constant error of 1.5
  const auto wanders_by = [&](int seconds, double off) {
    Receiver r;
    r.fixes(seconds * 5, steady);
    CHECK_FALSE(r.wander.wanders());
    r.fix(steady, off - 1.5);
    return r.wander.wanders();
  };
  // Its mean square converges to the value of 60 s, of which twice the usual counts, at least 0.4: 0.2 after
  // 17 s, then half of the difference in 20 s, 0.58 after a minute; 1.49 after five.
  CHECK_FALSE(wanders_by(20, 1.57));
  CHECK(wanders_by(20, 1.7));
  CHECK_FALSE(wanders_by(60, 2.35));
  CHECK(wanders_by(60, 2.95));
  CHECK_FALSE(wanders_by(300, 6.4));
}

TEST_CASE(
    "a barometer has stepped when it is off at once by five deviations, and stays there for two seconds") {
  const auto step = [](double step_m, double std, double dt) {
    BaroStep baro;
    double t = 100;
    for (int k = 0; k < 20; ++k) CHECK_FALSE(baro.sampled(1, std, true, t += dt));
    for (int k = 0; k < 400; ++k)
      if (const auto found = baro.sampled(1 + step_m + (k % 2 ? 0.1 : -0.1) * std, std, false, t += dt))
        return std::pair{*found, k * dt};
    return std::pair{0.0, 0.0};
  };
  for (const double std : {0.3, 0.6})
    for (const double side : {1.0, -1.0}) {
      const auto [found_m, after_s] = step(side * 5.3 * std, std, 0.02);
      CHECK(found_m == doctest::Approx(1 + side * 5.3 * std).epsilon(0.01));
      CHECK(std::abs(after_s - 2) < 0.021);
      CHECK(step(side * 4.7 * std, std, 0.02).second == 0);
    }
  CHECK(step(3, 0.3, 0.19).second > 0);
  CHECK(step(3, 0.3, 0.21).second == 0);  // no samples during the change
}

TEST_CASE("a step of the barometer that comes back within the two seconds is none, and the next one counts") {
  BaroStep baro;
  double t = 0;
  const auto samples = [&](int n, double off, bool accepted) {
    std::optional<double> found;
    for (int k = 0; k < n; ++k)
      if (const auto one = baro.sampled(off, 0.3, accepted, t += 0.02)) found = one;
    return found;
  };
  samples(10, 0, true);
  for (int again = 0; again < 2; ++again) {
    samples(50, 4, false);
    CHECK(baro.may_be());
    samples(10, 0, true);
    CHECK_FALSE(baro.may_be());
  }
  samples(30, 4, false);
  CHECK_FALSE(samples(200, 6, false));  // it continues: no step
  CHECK_FALSE(baro.may_be());
  samples(10, 0, true);
  const auto found = samples(110, -4, false);  // as without a history
  REQUIRE(found);
  CHECK(*found == doctest::Approx(-4));
  CHECK_FALSE(baro.may_be());
}

TEST_CASE("a pitot steps by 1.2 m/s, by eight times its noise or by six times what a gust changes") {
  for (const auto& [noise, std, limit] :
       {std::tuple{0.05, 1.0, 1.2}, {0.3, 1.0, 2.4}, {0.05, 4.0, 6 * 4 * std::sqrt(2 * 0.08 / 10)}})
    for (const double share : {0.96, 1.04, -0.96, -1.04}) {
      CAPTURE(limit);
      CAPTURE(share);
      PitotSamples pitot{.noise = noise, .std = std};
      pitot.samples(20, 0.1);
      pitot.samples(2, 0.1 + share * limit);
      CHECK_FALSE(pitot.steps.stepped());
      pitot.sample(0.1 + share * limit);
      CHECK(pitot.steps.stepped() == (std::abs(share) > 1));
    }
}

TEST_CASE("one odd sample, a ramp, a gap or a step of what the pitot is compared with are no step of it") {
  PitotSamples odd;
  odd.samples(20, 0);
  odd.sample(5);
  odd.samples(20, 0);
  odd.sample(5);
  odd.sample(-5);
  odd.sample(5);
  CHECK_FALSE(odd.steps.stepped());
  PitotSamples between;  // one sample during the change
  between.samples(20, 0);
  between.sample(0.6);
  between.samples(2, 3);
  CHECK_FALSE(between.steps.stepped());
  between.sample(3);
  CHECK(between.steps.stepped());
  PitotSamples ramp;  // 0.25 m/s a sample: 1 m/s from group to group
  for (int k = 0; k < 40; ++k) ramp.sample(0.25 * k);
  CHECK_FALSE(ramp.steps.stepped());
  for (const double gap_s : {0.14, 0.16}) {
    PitotSamples gap;
    gap.samples(20, 0);
    gap.sample(3, gap_s);
    gap.samples(2, 3);
    CHECK(gap.steps.stepped() == (gap_s < 0.15));
  }
  PitotSamples moved;
  moved.samples(20, 0);
  moved.otherwise += 3;
  moved.samples(10, -3);  // the pitot continues as before
  CHECK_FALSE(moved.steps.stepped());
  PitotSamples both;
  both.samples(20, 0);
  both.otherwise += 3;
  both.samples(10, 0);
  CHECK_FALSE(both.steps.stepped());
  PitotSamples few;
  few.samples(3, 0);
  few.samples(3, 5);  // six samples have no group before
  CHECK_FALSE(few.steps.stepped());
}

TEST_CASE("a pitot has stepped back when half of the step is left, and not before") {
  const auto after = [](double first, double second) {
    PitotSamples pitot;
    pitot.samples(20, 0);
    pitot.samples(20, first);
    CHECK(pitot.steps.stepped());
    pitot.samples(20, first + second);
    return pitot.steps.stepped();
  };
  CHECK_FALSE(after(3, -3));
  CHECK_FALSE(after(3, -2.1));  // 0.9 of 2.1
  CHECK(after(3, -1.9));        // 1.1 of 1.9
  CHECK_FALSE(after(-3, 2.1));
  CHECK(after(-3, 1.9));
  CHECK(after(3, 3));
  PitotSamples twice;
  twice.samples(20, 0);
  twice.samples(20, 3);
  twice.samples(20, 0);
  CHECK_FALSE(twice.steps.stepped());
  twice.samples(20, -3);
  CHECK(twice.steps.stepped());
}

TEST_CASE("a pitot that has crept off and steps to where it agrees is in order at once") {
  for (const double side : {1.0, -1.0})
    for (const double back_at : {2.3, 4.0}) {
      PitotSamples pitot;
      for (int k = 0; k <= 700; ++k) pitot.sample(side * 0.02 * k);
      REQUIRE(pitot.steps.off());
      pitot.samples(3, side * back_at);
      CHECK(pitot.steps.stepped() == (back_at > 2.5));
      pitot.sample(side * back_at);
      CHECK(pitot.steps.off() == (back_at > 2.5));
    }
}

TEST_CASE("a step of the pitot is forgotten after half a minute, if what is left of it can be borne") {
  for (const double step : {3.4, 3.6, -3.4, -3.6}) {
    CAPTURE(step);
    PitotSamples pitot{.std = 2};
    pitot.samples(60, 0);
    pitot.samples(3, step);
    REQUIRE(pitot.steps.stepped());
    pitot.samples(1490, step);
    CHECK(pitot.steps.stepped());
    pitot.samples(20, step);
    CHECK(pitot.steps.stepped() == (std::abs(step) > 3.5));
  }
}

TEST_CASE("a pitot that creeps away is off beyond five deviations, and back after six seconds in agreement") {
  for (const double std : {1.0, 3.0})
    for (const double side : {1.0, -1.0}) {
      CAPTURE(std);
      PitotSamples pitot{.std = std};
      const double limit = 5 * std::max(std, 2.0);
      double e = 0;
      pitot.samples(60, 0);
      while (e < 40 && !pitot.steps.off()) {
        e += 0.02;
        pitot.sample(side * e);  // 1 m/s2
      }
      CHECK(e == doctest::Approx(limit + 0.6).epsilon(0.01));  // the mean lags by 0.6 s
      // Back for six seconds within two and a half standard deviations, and within the tolerance.
      const double agreed = std::min(2.5 * std, 3.5);
      while (e > agreed + 0.2) {
        e -= 0.02;
        pitot.sample(side * e);
      }
      pitot.samples(1000, side * e);
      CHECK(pitot.steps.off());
      while (e > agreed - 0.2) {
        e -= 0.02;
        pitot.sample(side * e);
      }
      const int n = count(
          1000, [&](int) { pitot.sample(side * e); }, [&] { return !pitot.steps.off(); });
      CHECK(std::abs(0.02 * n - 6) < 0.7);  // the mean is within after the first of them
    }
}

TEST_CASE(
    "a pitot that goes off within a second by more than gusts do is off at once, but not one that comes "
    "back") {
  // six times the change of a gust of 2 m/s in 1 s of 10: 5.37; the mean of 0.6 s
  const auto off_after_s = [](double from, double to, int samples_before) {
    PitotSamples pitot{.noise = 10};
    pitot.samples(samples_before, from);
    const int n = count(
        200, [&](int) { pitot.sample(to); }, [&] { return pitot.steps.off(); });
    return n < 200 ? 0.02 * n : -1;
  };
  CHECK(off_after_s(0, 8, 100) == doctest::Approx(-0.6 * std::log(1 - 5.367 / 8)).epsilon(0.03));
  CHECK(off_after_s(0, -8, 100) == doctest::Approx(-0.6 * std::log(1 - 5.367 / 8)).epsilon(0.03));
  CHECK(off_after_s(0, 5.2, 100) == -1);
  CHECK(off_after_s(8, 0, 3) == -1);
  CHECK(off_after_s(0, 8, 3) > 0.9);  // no second sample to compare with yet
}

TEST_CASE("a field has changed beyond 15 %, is as before within 8 %, and what lasts is adopted in minutes") {
  struct Field {
    Strength strength;
    double t = 0;
    int seconds(double s, double value) {  // until `changed` changes
      const bool before = strength.changed();
      const auto other = [&] { return strength.changed() != before; };
      return count(
          static_cast<int>(s * 50), [&](int) { strength.sampled(value, t += 0.02); }, other);
    }
  };
  for (const double unit : {1.0, 5e-5}) {
    Field f;
    f.seconds(20, unit);
    CHECK(f.seconds(1, 1.15 * unit) == 50);  // 0.145: its mean lags by 0.3 s
    CHECK_FALSE(f.strength.changed());
    Field more, less;
    more.seconds(20, unit);
    less.seconds(20, unit);
    const double mean_s = -0.3 * std::log(1 - 0.15 / 0.5);
    CHECK(std::abs(more.seconds(1, 1.5 * unit) * 0.02 - mean_s) < 0.021);
    CHECK(std::abs(less.seconds(1, 0.5 * unit) * 0.02 - mean_s) < 0.021);
    CHECK(more.seconds(3, 1.1 * unit) == 150);
    CHECK(more.seconds(3, 1.06 * unit) < 60);
    // adopted: 1.5 / (1 + 0.5 (1 - exp(-t / 120))) < 1.08 after 180 s
    CHECK(more.seconds(1, 1.5 * unit) < 20);
    CHECK(more.seconds(400, 1.5 * unit) * 0.02 == doctest::Approx(180).epsilon(0.05));
    // A small change is followed in half a minute.
    Field slow;
    slow.seconds(20, unit);
    slow.seconds(30, 1.14 * unit);
    Field beyond = slow;
    CHECK(slow.seconds(3, 1.24 * unit) == 150);
    CHECK(beyond.seconds(3, 1.27 * unit) < 100);
  }
}

}  // namespace witness_test

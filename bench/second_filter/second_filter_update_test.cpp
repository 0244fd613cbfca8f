// SPDX-License-Identifier: BSD-3-Clause
// Updates of the second formulation against the textbook; levels of noise against simulated sequences.
#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <cmath>

#include "bench/second_filter/filter.hpp"
#include "bench/second_filter/monitor.hpp"
#include "fulmar/random.hpp"

namespace second_filter_update_test {

using namespace fulmar;
using namespace fulmar::second_filter;
using fulmar::second_filter::Vector;

namespace {

Vector3d normal(Random& r) { return {r.normal(), r.normal(), r.normal()}; }
Scalar any_measurement(Random& r, double innovation) {
  Scalar z;
  for (int i = 0; i < size; ++i) z.H(i) = i % 4 ? r.normal() : 0;
  z.innovation = innovation;
  return z;
}
/// So that everything is correlated with everything.
Filter mixed(Random& r) {
  Nominal n;
  n.q_nb = exp_map(normal(r));
  for (int i = 3; i < size; ++i) n.x(i) = r.normal();
  Filter f;
  f.reset(n, Eigen::Matrix<double, 15, 1>::Constant(0.1), 0);
  f.inflate(0, size, 0.3);
  for (int i = 0; i < 20; ++i) f.fuse(any_measurement(r, 0), 0.5, 1e9, Vector::Ones());
  return f;
}

/// A scalar filter of a white error of variance 1 and a slow error of variance 1 and 5 s, whose levels are
/// learnt, beside errors that are larger: mean of each level over the last two thirds of half an hour.
struct Levels {
  double white = 0, slow = 0;
};
Levels learn(double white_std, double slow_std, bool outliers = false) {
  Random r(11);
  Level level;
  Levels mean;
  constexpr double dt = 0.1;
  constexpr int samples = 18000;
  const double keep = std::exp(-dt / 5);
  double slow = slow_std * r.normal(), x = 0, P = 1;
  for (int k = 0; k < samples; ++k) {
    slow = keep * slow + slow_std * std::sqrt(1 - keep * keep) * r.normal();
    x *= keep;
    P = keep * keep * P + level.slow() * (1 - keep * keep);
    const double S = P + level.white();
    const double off = slow + white_std * r.normal() + (outliers && k % 100 == 0 ? 30 : 0) - x;
    level.add(0, off / std::sqrt(S), dt);
    x += P / S * off;
    P *= 1 - P / S;
    if (k < samples / 3) continue;
    mean.white += level.white() / (samples - samples / 3);
    mean.slow += level.slow() / (samples - samples / 3);
  }
  return mean;
}

}  // namespace

TEST_CASE("update: an update is the textbook's, and that of Joseph where a state is considered") {
  Random r(8);
  for (int trial = 0; trial < 20; ++trial) {
    Filter f = mixed(r);
    const Covariance P = f.covariance();
    const Nominal before = f.state();
    const Scalar z = any_measurement(r, 0.3);
    Vector gain = Vector::Ones();
    if (trial % 2)
      for (int i = 0; i < size; ++i) gain(i) = i % 3 ? 1 : 0;
    const double R = 0.4, S = (z.H * P * z.H.transpose())(0) + R;
    CHECK(f.expected_std(z, R) == doctest::Approx(std::sqrt(S)));
    const Fused fused = f.fuse(z, R, 5, gain);
    CHECK(fused.accepted);
    CHECK(fused.ratio == doctest::Approx(0.3 / std::sqrt(S)));
    const Vector K = (P * z.H.transpose()).cwiseProduct(gain) / S;
    const Covariance A = Covariance::Identity() - K * z.H;
    const Covariance expected = A * P * A.transpose() + R * K * K.transpose();
    CHECK((f.covariance() - expected).norm() < 1e-10 * P.norm());
    if (trial % 2 == 0) CHECK((f.covariance() - A * P).norm() < 1e-10 * P.norm());
    CHECK((f.state().minus(before) - 0.3 * K).norm() < 1e-9);
    for (int i = 0; i < size; i += 3) {
      if (trial % 2 == 0) break;
      CHECK(f.covariance()(i, i) == P(i, i));
      if (i >= 3) CHECK(f(i) == before.x(i));
    }
  }
}

TEST_CASE("update: the covariance stays symmetric and positive semi-definite") {
  Random r(9);
  Filter f = mixed(r);
  f.forget(pos, 3, 1000);
  for (int k = 0; k < 100; ++k) {
    Vector gain;
    for (int i = 0; i < size; ++i) gain(i) = r.uniform() < 0.8 ? 1 : 0;
    f.fuse(any_measurement(r, 0.1 * r.normal()), r.uniform(1e-4, 1), 5, gain, k % 2 == 0);
    f.predict(normal(r), 3 * normal(r) + Vector3d(0, 0, -f.gravity_mps2), 0.01);
    const Covariance& P = f.covariance();
    CHECK((P - P.transpose()).cwiseAbs().maxCoeff() <= 1e-12 * P.cwiseAbs().maxCoeff());
    if (k % 10) continue;
    const Eigen::SelfAdjointEigenSolver<Covariance> solver(P, Eigen::EigenvaluesOnly);
    CHECK(solver.eigenvalues().minCoeff() > -1e-10 * solver.eigenvalues().maxCoeff());
  }
}

TEST_CASE("update: a measurement beyond the gate is rejected, or by force counts as one at the gate") {
  Random r(10);
  Filter f = mixed(r);
  const Covariance P = f.covariance();
  const Nominal before = f.state();
  Scalar z = any_measurement(r, 0);
  const double std = f.expected_std(z, 0.4);
  z.innovation = -20 * std;
  Filter forced = f;
  CHECK_FALSE(f.fuse(z, 0.4, 5, Vector::Ones()).accepted);
  CHECK(f.covariance() == P);
  CHECK(f.state().x == before.x);
  const Fused fused = forced.fuse(z, 0.4, 5, Vector::Ones(), true);
  CHECK_FALSE(fused.accepted);
  CHECK(fused.ratio == doctest::Approx(-20));
  const double S = 16 * std * std;  // 20 / 5 standard deviations
  const Vector K = P * z.H.transpose() / S;
  CHECK((forced.covariance() - (P - S * K * K.transpose())).norm() < 1e-10 * P.norm());
  CHECK((forced.state().minus(before) - K * z.innovation).norm() < 1e-6 * (K * z.innovation).norm() + 1e-9);
  z.innovation = std::nan("");
  CHECK_FALSE(forced.fuse(z, 0.4, 5, Vector::Ones(), true).accepted);
  CHECK(forced.state().x.allFinite());
}

TEST_CASE(
    "level: the white factor converges to the true variance, the slow one to that of correlated noise") {
  for (const double std : {0.6, 1.0, 2.0}) {
    CAPTURE(std);
    const Levels levels = learn(std, 1);
    CHECK(levels.white == doctest::Approx(std * std).epsilon(0.15));
    CHECK(levels.slow == doctest::Approx(1).epsilon(0.35));
  }
  const Levels levels = learn(1, 3);
  CHECK(levels.white == doctest::Approx(1).epsilon(0.3));
  CHECK(levels.slow == doctest::Approx(9).epsilon(0.35));
  CHECK(learn(1, 1, true).white == doctest::Approx(1).epsilon(0.25));  // outliers count for little
  CHECK(learn(10, 1).white < 17);                                      // bounded: 4 standard deviations
  CHECK(learn(0.01, 0.01).white > 0.24);
  CHECK(learn(0.01, 0.01).slow == doctest::Approx(std::pow(0.5, 6)).epsilon(0.1));  // far lower
}

TEST_CASE("level: a variance that is part of an innovation is learnt from it") {
  Random r(18);
  double log_level = 0, mean = 0;
  for (int k = 0; k < 40000; ++k) {  // 1 + 4, of which the second is learnt
    const double S = 1 + std::exp(log_level);
    log_level = Level::learnt(log_level, std::sqrt(5.0) * r.normal() / std::sqrt(S), (S - 1) / S, 0.1);
    if (k >= 10000) mean += log_level / 30000;
  }
  CHECK(std::exp(mean) == doctest::Approx(4).epsilon(0.1));
}

TEST_CASE("aid: after a fault the change of its error fades, in 5 s of a jump and in 30 s of a drift") {
  for (const bool ramp : {false, true}) {
    CAPTURE(ramp);
    const double time_s = ramp ? 30 : 5;
    Aid aid;
    CHECK(aid.changing(1000) == 0);
    CHECK_FALSE(aid.faulty(1000));
    aid.fault(1000, ramp);
    CHECK(aid.changing(1000) == doctest::Approx(1));
    CHECK(aid.changing(1000 + time_s) == doctest::Approx(1 / 2.718281828));
    double integral = 0;  // of the variance of a walk, by the midpoints
    for (int k = 0; k < 6000; ++k) integral += 0.01 * std::pow(aid.changing(1000 + 0.01 * (k + 0.5)), 2);
    CHECK(integral == doctest::Approx(0.5 * time_s * (1 - std::exp(-2 * 60 / time_s))).epsilon(1e-4));
    CHECK(aid.faulty(1029));
    CHECK_FALSE(aid.faulty(1031));
    aid.fault(2000, !ramp);  // another one
    CHECK(aid.changing(2000 + time_s) == doctest::Approx(std::exp(-time_s / (35 - time_s))));
  }
}

}  // namespace second_filter_update_test

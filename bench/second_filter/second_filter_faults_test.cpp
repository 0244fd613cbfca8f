// SPDX-License-Identifier: BSD-3-Clause
// Jumps and drifts of slow errors in flights whose errors are known.
#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "bench/second_filter/simulated_flight.hpp"

namespace second_filter_faults_test {

using namespace fulmar;
using namespace fulmar::second_filter;
using fulmar::second_filter::Vector;
using simulated::Flight;

TEST_CASE("faults: white noise alone is no fault in 200 windows of 8 s") {
  Flight flight(13);
  CHECK(flight.fly(1600, 0, 25).first == -1);
}

TEST_CASE("faults: a jump is found with its state, sign and size, and the estimate follows it") {
  for (const auto& [state, size] : {std::pair{+baro_bias, 6.0},
                                    {+baro_bias, -8.0},
                                    {fix_pos + 1, 12.0},
                                    {+fix_pos, -12.0},
                                    {+fix_vel, 3.0},
                                    {fix_vel + 1, -3.0},
                                    {+tube_bias, -105.0}}) {
    CAPTURE(state);
    CAPTURE(size);
    Flight flight(14);
    REQUIRE(flight.fly(20).first == -1);
    flight.f.begin_jumps();
    flight.truth.x(state) += size;
    const Fault fault = flight.fly(8);
    CHECK(fault.first == (state == fix_pos + 1 ? +fix_pos : state == fix_vel + 1 ? +fix_vel : state));
    const bool several = state >= fix_pos && state < delay;  // a norm
    CHECK(fault.size == doctest::Approx(several ? std::abs(size) : size).epsilon(0.2));
    CHECK_FALSE(fault.ramp);
    CHECK(fault.ratio > 60);
    CHECK(std::abs(flight.f(state) - flight.truth.x(state)) < 4 * flight.f.std(state));
    CHECK(std::abs(flight.f(state) - flight.truth.x(state)) < 0.25 * std::abs(size));
    CHECK(flight.f.std(state) > 0.095 * std::abs(size));  // and it may be off
    CHECK(std::abs(flight.f(pos + 2) - flight.truth.x(pos + 2)) < 3);
    CHECK(flight.fly(40).first == -1);  // once
  }
}

TEST_CASE("faults: the covariance grows by the variance of the size, and a short window needs more") {
  Flight flight(20);
  REQUIRE(flight.fly(20).first == -1);
  flight.f.begin_jumps();
  flight.truth.x(baro_bias) += 6;
  for (int k = 0; k < 30; ++k) flight.step();
  const Filter before = flight.f;
  const Fault fault = flight.f.find_fault(10);
  REQUIRE(fault.first == baro_bias);
  Covariance grown = flight.f.covariance() - before.covariance();
  grown(baro_bias, baro_bias) -= std::pow(0.1 * fault.size, 2);
  const double moved = flight.f(baro_bias) - before(baro_bias);
  CHECK(grown(baro_bias, baro_bias) / (moved * moved / fault.ratio) == doctest::Approx(1).epsilon(0.3));
  const Eigen::SelfAdjointEigenSolver<Covariance> solver(grown, Eigen::EigenvaluesOnly);
  CHECK(solver.eigenvalues().minCoeff() > -1e-9);
  Filter more = before, less = before;  // the longest window: 40 s
  CHECK(more.find_fault(fault.ratio / 1.15).first == -1);
  CHECK(less.find_fault(fault.ratio / 1.25).first == baro_bias);
}

TEST_CASE("faults: a position that jumps along all axes is found: in the plane at once, and the height") {
  Flight flight(19);
  REQUIRE(flight.fly(20).first == -1);
  flight.f.begin_jumps();
  flight.truth.x.segment<3>(fix_pos) += Vector3d(12, -9, 12);
  const Fault one = flight.fly(8), other = flight.fly(8);
  CHECK(std::min(one.first, other.first) == fix_pos);
  CHECK(std::max(one.first, other.first) == fix_pos + 2);
  CHECK((one.first == fix_pos ? one : other).size == doctest::Approx(15).epsilon(0.15));
  CHECK((one.first == fix_pos ? other : one).size == doctest::Approx(12).epsilon(0.2));
  CHECK(flight.fly(20).first == -1);
  for (int i = fix_pos; i < fix_pos + 3; ++i) CHECK(std::abs(flight.f(i) - flight.truth.x(i)) < 4);
}

TEST_CASE("faults: accelerometers that jump along two axes at once are found in a flight with turns") {
  for (const auto& [x, y, z] : {std::tuple{0.8, 0.8, 0.0}, {0.8, -0.6, 0.7}, {0.0, 1.0, 0.0}}) {
    CAPTURE(x);
    CAPTURE(y);
    Flight flight(22, true);
    REQUIRE(flight.fly(20).first == -1);
    flight.f.begin_jumps();
    flight.accel_off << x, y, z;
    const double before_s = flight.time_s;
    const Fault fault = flight.fly(8);
    CHECK(fault.first == accel_bias);
    CHECK(flight.time_s - before_s < 3);
    CHECK(fault.size == doctest::Approx(flight.accel_off.norm()).epsilon(0.2));
    CHECK((flight.f.state().at<3>(accel_bias) - flight.accel_off).norm() < 0.2 * fault.size);
    // All axes may be off afterwards.
    for (int i = 0; i < 3; ++i) CHECK(flight.f.std(accel_bias + i) > 0.095 * fault.size);
    CHECK(flight.fly(20).first == -1);
  }
}

TEST_CASE("faults: a unit that is not judged, or errs under motion, has no fault") {
  for (const auto& [judged, motion] : {std::pair{true, 1.0}, {false, 1.0}, {true, 3.9}, {true, 4.1}}) {
    CAPTURE(judged);
    CAPTURE(motion);
    Flight flight(22, true);
    REQUIRE(flight.fly(20).first == -1);
    flight.f.begin_jumps();
    flight.judge_unit = judged;
    flight.f.unit.motion = motion;
    flight.accel_off << 0.8, 0.8, 0;
    CHECK((flight.fly(4).first == accel_bias) == (judged && motion < 4));
  }
}

TEST_CASE("faults: a jump in the middle of a window is found within a second, with its size") {
  for (const auto& [state, size, shift_s] : {std::tuple{+baro_bias, 15.0, 1.3},
                                             {+baro_bias, -15.0, 0.7},
                                             {fix_vel + 1, 4.0, 1.3},
                                             {+tube_bias, -150.0, 1.7}}) {
    CAPTURE(state);
    CAPTURE(shift_s);
    Flight flight(23);
    REQUIRE(flight.fly(20).first == -1);
    flight.f.begin_jumps();
    REQUIRE(flight.fly(shift_s).first == -1);
    flight.truth.x(state) += size;
    const double before_s = flight.time_s, error = flight.truth.x(state) - flight.f(state) - size;
    const Fault fault = flight.fly(4);
    CHECK(fault.first == (state == fix_vel + 1 ? +fix_vel : state));
    CHECK(flight.time_s - before_s < 1.01);
    CHECK(std::abs(fault.size) == doctest::Approx(std::abs(size)).epsilon(0.1));
    CHECK(std::abs(flight.truth.x(state) - flight.f(state) - error) < 0.1 * std::abs(size));
  }
}

TEST_CASE("faults: under motion a fault needs more, by half the logarithm of its variance") {
  Flight flight(20);
  REQUIRE(flight.fly(20).first == -1);
  flight.f.begin_jumps();
  flight.truth.x(baro_bias) += 6;
  for (int k = 0; k < 30; ++k) flight.step();
  Filter calm = flight.f;
  const double ratio = calm.find_fault(1).ratio;
  for (const double motion : {0.2, 1.0, 2.0, 7.0}) {
    CAPTURE(motion);
    Filter less = flight.f, more = flight.f;
    less.unit.motion = more.unit.motion = motion;
    const double factor = motion > 1 ? 1 + 0.5 * std::log(motion) : 1;
    // 1.2: of the longest window
    CHECK(less.find_fault(ratio / (1.2 * factor) / 1.04).first == baro_bias);
    CHECK(more.find_fault(ratio / (1.2 * factor) * 1.04).first == -1);
  }
}

TEST_CASE("faults: a drift is found with its state, sign and size per 10 s") {
  for (const double per_s : {0.4, -0.4}) {
    CAPTURE(per_s);
    Flight flight(15);
    REQUIRE(flight.fly(20).first == -1);
    flight.f.begin_jumps();
    const Fault fault = flight.fly(40, per_s);
    CHECK(fault.first == baro_bias);
    CHECK(fault.size == doctest::Approx(10 * per_s).epsilon(0.2));
    CHECK(std::abs(flight.f(baro_bias) - flight.truth.x(baro_bias)) < 1);
  }
}

TEST_CASE("faults: a few outliers are no jump, and do not hide one") {
  for (const double outlier_m : {5.0, 60.0, 3000.0}) {
    CAPTURE(outlier_m);
    Flight flight(16);
    REQUIRE(flight.fly(20).first == -1);
    for (int k = 0; k < 4; ++k) {
      flight.outlier_m = outlier_m;
      CHECK(flight.fly(0.5).first == -1);
    }
    CHECK(flight.fly(10).first == -1);
    flight.f.begin_jumps();
    flight.truth.x(baro_bias) += 8;
    flight.outlier_m = outlier_m;
    CHECK(flight.fly(8).first == baro_bias);
  }
}

TEST_CASE("faults: a window that is over is judged before the next one begins") {
  Flight flight(17);
  REQUIRE(flight.fly(20).first == -1);
  flight.f.begin_jumps();
  flight.truth.x(baro_bias) += 8;
  for (int k = 0; k < 401; ++k) flight.step();
  CHECK(flight.f.find_fault(60).first == baro_bias);
}

TEST_CASE("faults: a jump smaller than the least is none, however certain it is") {
  for (const double size : {2.5, -2.5, 3.5, -3.5}) {
    CAPTURE(size);
    Filter f = simulated::filter_at({});
    f.begin_jumps();
    Scalar z;
    z.innovation = size;
    z.H(baro_bias) = 1;
    for (int k = 0; k < 60; ++k) f.fuse(z, 0.25, 5, Vector::Zero());
    const Fault fault = f.find_fault(60);
    CHECK((fault.first == baro_bias) == (std::abs(size) > 3));
    CHECK(f(baro_bias) == doctest::Approx(fault.first < 0 ? 0 : size).epsilon(0.01));
  }
}

TEST_CASE("faults: outliers do not hide a drift, nor begin the long window again") {
  for (const double outlier_m : {0.0, 60.0, 3000.0}) {
    CAPTURE(outlier_m);
    Flight flight(24);
    REQUIRE(flight.fly(20).first == -1);
    flight.f.begin_jumps();
    const double before_s = flight.time_s;
    Fault fault;
    for (int k = 0; k < 10 && fault.first < 0; ++k) {
      flight.outlier_m = outlier_m;
      fault = flight.fly(4, 0.3);
    }
    CHECK(fault.first == baro_bias);
    CHECK(fault.ramp);
    CHECK(fault.size == doctest::Approx(3).epsilon(0.25));
    CHECK(flight.time_s - before_s < 18);
  }
}

}  // namespace second_filter_faults_test

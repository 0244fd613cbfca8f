// SPDX-License-Identifier: BSD-3-Clause
// Covariance of the filter against the covariance of its errors. Monte Carlo with the noise parameters of the
// filter; chi-square bounds after Bar-Shalom, Li & Kirubarajan, Estimation with Applications to Tracking and
// Navigation (2001), section 5.4.
#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <fulmar/flight/navigation/ekf_models.hpp>

#include "synthetic_flight.hpp"

namespace consistency_test {

using namespace synthetic;

namespace {

constexpr double accel_density = 0.02, gyro_density = 3e-4, position_std = 0.5, velocity_std = 0.05,
                 heading_std = 0.03, baro_std = 0.4;

ErrorStateEkf matched() {
  ErrorStateEkf f;
  f.noise = {};
  f.noise.gyro = gyro_density;
  f.noise.accel = accel_density;
  f.noise.gyro_bias_walk = f.noise.accel_bias_walk = f.noise.wind_walk = f.noise.wind_shear =
      f.noise.baro_walk = 0;
  f.noise.heading_std = 1e-6;
  f.noise.gust_std = 1e-6;
  return f;
}

struct Statistics {
  double nees = 0, innovations = 0;
  int measurements = 0;
};

/// One run from a random initial error; adds to the sums of each second.
void one_run(const std::vector<Truth>& flight, double hz, std::uint64_t seed,
             std::vector<Statistics>& seconds) {
  Random r(seed);
  const auto normal = [&] { return Vector3d(r.normal(), r.normal(), r.normal()); };
  const auto first = static_cast<std::size_t>(25 * hz);
  ekf::Vector std = ekf::Vector::Constant(1e-6);
  std.segment<3>(ekf::theta).setConstant(0.02);
  std.segment<3>(ekf::vel).setConstant(0.2);
  std.segment<3>(ekf::pos).setConstant(1);
  std.segment<3>(ekf::gyro_bias).setConstant(0.005);
  std.segment<3>(ekf::accel_bias).setConstant(0.1);
  std(ekf::baro) = 1;
  ekf::Nominal truth;
  truth.q_nb = flight[first].q_nb;
  truth.v_n = flight[first].v_n;
  truth.p_n = flight[first].p_n;
  const Vector3d gyro_bias = 0.005 * normal(), accel_bias = 0.1 * normal();
  const double baro_bias = r.normal();
  truth.gyro_bias = gyro_bias;
  truth.accel_bias = accel_bias;
  truth.baro_m = baro_bias;
  ekf::Vector error = ekf::Vector::Zero();
  for (const int i : {ekf::theta, ekf::vel, ekf::pos}) error.segment<3>(i) = std(i) * normal();
  error.segment<3>(ekf::gyro_bias) = -gyro_bias;
  error.segment<3>(ekf::accel_bias) = -accel_bias;
  error(ekf::baro) = -baro_bias;
  ErrorStateEkf f = matched();
  f.reset(truth.plus(error), std, flight[first].t);
  const double dt = 1 / hz;
  for (std::size_t k = first; k < flight.size(); ++k) {
    const Truth& x = flight[k];
    const Vector3d omega = x.omega_b + gyro_bias + gyro_density / std::sqrt(dt) * normal();
    const Vector3d f_b = x.f_b + accel_bias + accel_density / std::sqrt(dt) * normal();
    if (k > first) f.predict(omega, f_b, dt);
    const auto step = static_cast<std::size_t>(hz / 5);
    if (k == first || k % step != 0) continue;
    Statistics& second = seconds[(k - first) / static_cast<std::size_t>(hz)];
    const auto use = [&](const ekf::Scalar& z, double deviation) {
      const double ratio = f.fuse(z, deviation * deviation, 1e9).ratio;
      second.innovations += ratio * ratio;
      ++second.measurements;
    };
    for (int i = 0; i < 3; ++i)
      use(ekf::velocity(f, f.at(f.time_s()), i, x.v_n(i) + velocity_std * r.normal()), velocity_std);
    for (int i = 0; i < 3; ++i)
      use(ekf::position(f, f.at(f.time_s()), i, x.p_n(i) + position_std * r.normal()), position_std);
    ekf::Scalar heading =
        ekf::magnetic_heading(f.state(), x.q_nb.conjugate() * Vector3d(2e-5, 0, 0), heading_std * r.normal());
    use(heading, heading_std);
    ekf::Scalar height;
    height.innovation =
        -x.p_n.z() + baro_bias + baro_std * r.normal() - (-f.state().p_n.z() + f.state().baro_m);
    height.H(ekf::pos + 2) = -1;
    height.H(ekf::baro) = 1;
    use(height, baro_std);
    if (k % static_cast<std::size_t>(hz) != 0) continue;
    ekf::Nominal now = f.state();
    now.q_nb = x.q_nb;
    now.v_n = x.v_n;
    now.p_n = x.p_n;
    const Eigen::Matrix<double, 9, 1> e = now.minus(f.state()).head<9>();
    second.nees += e.dot(f.covariance().topLeftCorner<9, 9>().inverse() * e);
  }
}

}  // namespace

TEST_CASE("over forty flights the normalised errors of attitude, velocity and position follow chi-square") {
  Plan plan;
  plan.rate_hz = 200;
  plan.duration_s = 55;
  const std::vector<Truth> flight = fly(plan);
  constexpr int runs = 40, dof = 9;
  std::vector<Statistics> seconds(30);
  for (std::uint64_t seed = 1; seed <= runs; ++seed) one_run(flight, plan.rate_hz, seed, seconds);
  // 95 % bounds of the mean of `runs` chi-square variables of 9 degrees of freedom, normal approximation
  const double half = 1.96 * std::sqrt(2.0 * dof / runs);
  int inside = 0, judged = 0;
  double mean = 0, innovations = 0;
  int measurements = 0;
  for (std::size_t s = 1; s < seconds.size(); ++s) {
    const double anees = seconds[s].nees / runs;
    inside += std::abs(anees - dof) < half;
    ++judged;
    mean += anees;
    innovations += seconds[s].innovations;
    measurements += seconds[s].measurements;
  }
  CAPTURE(mean / judged);
  CAPTURE(innovations / measurements);
  CHECK(inside >= judged * 9 / 10 - 1);
  CHECK(mean / judged == doctest::Approx(dof).epsilon(0.12));
  CHECK(innovations / measurements == doctest::Approx(1).epsilon(0.05));
}

}  // namespace consistency_test

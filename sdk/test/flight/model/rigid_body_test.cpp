// SPDX-License-Identifier: BSD-3-Clause
#include "fulmar/flight/model/rigid_body.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "fulmar/flight/earth/atmosphere.hpp"
#include "sdk/test/flight/check_case.hpp"

namespace rigid_body_test {

using namespace fulmar;
using Eigen::Vector3d;

namespace {

constexpr double degree = std::numbers::pi / 180, foot = 0.3048;
constexpr double earth_rate = 7.292115e-5;

Eigen::Matrix3d some_inertia() {
  Eigen::Matrix3d J = Vector3d(0.24855, 0.3784, 0.618).asDiagonal();
  J(0, 2) = J(2, 0) = -0.06;
  return J;
}

Load nothing(const RigidBody&, double) { return {}; }

RigidBody tumbling() {
  RigidBody x;
  x.omega_b = {1.2, -0.8, 2.0};
  x.v_n = {10, -3, 2};
  x.q_nb = Eigen::Quaterniond(Eigen::AngleAxisd(0.7, Vector3d(1, 2, -1).normalized()));
  return x;
}

RigidBody flown(double dt, double duration) {
  const MassProperties body(4.5, some_inertia());
  // a load that depends on the whole state: a spring to the origin, drag, and damping
  const auto load = [](const RigidBody& x, double) {
    Load l;
    l.force_b = x.q_nb.conjugate() * Vector3d(-5 * x.p_n - 1.5 * x.v_n.norm() * x.v_n);
    l.moment_b = -0.05 * x.omega_b.norm() * x.omega_b + 0.02 * l.force_b;
    return l;
  };
  RigidBody x = tumbling();
  const auto n = static_cast<int>(std::lround(duration / dt));
  for (int i = 0; i < n; ++i) x = runge_kutta(x, load(x, 0), dt, body, {0, 0, 9.81}, load);
  return x;
}

double distance(const RigidBody& a, const RigidBody& b) {
  return (a.p_n - b.p_n).norm() + (a.v_n - b.v_n).norm() + (a.omega_b - b.omega_b).norm() +
         a.q_nb.angularDistance(b.q_nb);
}

/// Gravity minus the centrifugal part at the equator, from WGS-84 with J2: the acceleration of a falling body
/// that moves with the Earth.
double equatorial_gravity(double height_m) {
  const double a = 6378137, r = a + height_m, GM = 3.986004418e14, J2 = 1.0826267e-3;
  return GM / (r * r) * (1 + 1.5 * J2 * a * a / (r * r)) - earth_rate * earth_rate * r;
}

}  // namespace

TEST_CASE("the integrator is of fourth order: half the step, a sixteenth of the error") {
  const RigidBody best = flown(0.00025, 0.8);
  const double coarse = distance(flown(0.02, 0.8), best), fine = distance(flown(0.01, 0.8), best),
               finer = distance(flown(0.005, 0.8), best);
  CHECK(coarse / fine == doctest::Approx(16).epsilon(0.2));
  CHECK(fine / finer == doctest::Approx(16).epsilon(0.2));
}

TEST_CASE("a freely tumbling body keeps its energy, its angular momentum in space, and its straight way") {
  const MassProperties body(4.5, some_inertia());
  RigidBody x = tumbling();
  const RigidBody begin = x;
  const double energy = 0.5 * x.omega_b.dot(body.J * x.omega_b);
  const Vector3d momentum = x.q_nb * (body.J * x.omega_b);
  for (int i = 0; i < 40000; ++i) x = runge_kutta(x, {}, 0.0025, body, Vector3d::Zero(), nothing);
  CHECK(0.5 * x.omega_b.dot(body.J * x.omega_b) == doctest::Approx(energy).epsilon(1e-8));
  CHECK((x.q_nb * (body.J * x.omega_b) - momentum).norm() < 1e-7 * momentum.norm());
  CHECK(std::abs(x.q_nb.norm() - 1) < 1e-14);
  CHECK((x.p_n - begin.p_n - 100 * begin.v_n).norm() < 1e-8);
  CHECK((x.omega_b - begin.omega_b).norm() > 0.1);  // the body does tumble
}

TEST_CASE("an axisymmetric body precesses at the rate of Euler's solution") {
  const MassProperties body(1, Vector3d(0.2, 0.5, 0.5).asDiagonal());
  RigidBody x;
  x.omega_b = {3, 0.4, 0};
  for (int i = 0; i < 400; ++i) x = runge_kutta(x, {}, 0.0025, body, Vector3d::Zero(), nothing);
  const double n = (0.5 - 0.2) / 0.5 * 3;  // rad/s: the transverse rate turns in the body frame
  CHECK(x.omega_b.x() == doctest::Approx(3));
  CHECK(x.omega_b.y() == doctest::Approx(0.4 * std::cos(n)).epsilon(1e-7));
  CHECK(x.omega_b.z() == doctest::Approx(-0.4 * std::sin(n)).epsilon(1e-7));
}

TEST_CASE("a projectile follows the parabola") {
  const MassProperties body(2, Eigen::Matrix3d::Identity());
  RigidBody x;
  x.v_n = {20, 0, -15};
  for (int i = 0; i < 800; ++i) x = runge_kutta(x, {}, 0.0025, body, {0, 0, 9.80665}, nothing);
  CHECK(x.p_n.x() == doctest::Approx(40));
  CHECK(x.p_n.z() == doctest::Approx(-30 + 0.5 * 9.80665 * 4));
}

TEST_CASE("NASA check case 1: the dropped sphere") {
  const auto nasa = test::CheckCase::open("Atmos_01_DroppedSphere/Atmos_01_sim_05.csv");
  if (!nasa) {
    MESSAGE("skipped: the check cases are not there");
    return;
  }
  const MassProperties body(14.59390294, Eigen::Matrix3d::Identity());
  const auto weight = [&](const RigidBody& x, double) {
    Load l;
    l.force_b = {0, 0, body.mass * equatorial_gravity(-x.p_n.z())};
    return l;
  };
  RigidBody x;
  x.p_n.z() = -nasa->at(0, "altitudeMsl_ft") * foot;
  for (int i = 0; i < 3000; ++i) x = runge_kutta(x, weight(x, 0), 0.01, body, Vector3d::Zero(), weight);
  const std::size_t end = nasa->row_at(30);
  // error of flat ground without Coriolis acceleration in 30 s: 0.02 ft and 0.003 ft/s
  CHECK(std::abs(-x.p_n.z() / foot - nasa->at(end, "altitudeMsl_ft")) < 0.05);
  CHECK(std::abs(x.v_n.z() / foot - nasa->at(end, "feVelocity_ft_s_Z")) < 0.006);
}

TEST_CASE("NASA check case 2: the tumbling brick") {
  const auto nasa = test::CheckCase::open("Atmos_02_TumblingBrickNoDamping/Atmos_02_sim_05.csv");
  if (!nasa) {
    MESSAGE("skipped: the check cases are not there");
    return;
  }
  const double slug_foot2 = 1.3558179483;
  const MassProperties body(0.155404754 * 14.59390294,
                            slug_foot2 * Vector3d(0.00189422, 0.006211019, 0.007194665).asDiagonal());
  RigidBody x;  // relative to inertial space here
  x.omega_b = degree * Vector3d(10, 20, 30);
  double worst_rate = 0, worst_angle = 0;
  for (int i = 1; i <= 3000; ++i) {
    x = runge_kutta(x, {}, 0.01, body, Vector3d::Zero(), nothing);
    if (i % 100 != 0) continue;
    const std::size_t row = nasa->row_at(0.01 * i);
    const Vector3d rate(nasa->at(row, "bodyAngularRateWrtEi_deg_s_Roll"),
                        nasa->at(row, "bodyAngularRateWrtEi_deg_s_Pitch"),
                        nasa->at(row, "bodyAngularRateWrtEi_deg_s_Yaw"));
    worst_rate = std::max(worst_rate, (x.omega_b / degree - rate).norm());
    const Eigen::Quaterniond theirs =
        Eigen::AngleAxisd(nasa->at(row, "eulerAngle_deg_Yaw") * degree, Vector3d::UnitZ()) *
        Eigen::AngleAxisd(nasa->at(row, "eulerAngle_deg_Pitch") * degree, Vector3d::UnitY()) *
        Eigen::AngleAxisd(nasa->at(row, "eulerAngle_deg_Roll") * degree, Vector3d::UnitX());
    // at the equator the axis of the Earth points north
    const Eigen::Quaterniond ours = Eigen::AngleAxisd(-earth_rate * 0.01 * i, Vector3d::UnitX()) * x.q_nb;
    worst_angle = std::max(worst_angle, ours.angularDistance(theirs) / degree);
  }
  CHECK(worst_rate < 1e-4);   // deg/s
  CHECK(worst_angle < 5e-4);  // deg
}

TEST_CASE("NASA check case 6: a sphere with drag in the standard atmosphere") {
  const auto nasa = test::CheckCase::open("Atmos_06_DroppedSphereEllipsoidalNoWind/Atmos_06_sim_05.csv");
  if (!nasa) {
    MESSAGE("skipped: the check cases are not there");
    return;
  }
  const MassProperties body(14.59390294, Eigen::Matrix3d::Identity());
  const double CD_S = 0.1 * std::numbers::pi / 4 * 0.5 * 0.5 * foot * foot,
               earth = 6356766;  // of geopotential altitude
  const auto load = [&](const RigidBody& x, double) {
    Load l;
    const double rho = standard_air(earth * -x.p_n.z() / (earth - x.p_n.z())).density_kgm3;
    l.force_b = {
        0, 0,
        body.mass * equatorial_gravity(-x.p_n.z()) - 0.5 * rho * CD_S * x.v_n.z() * std::abs(x.v_n.z())};
    return l;
  };
  RigidBody x;
  x.p_n.z() = -nasa->at(0, "altitudeMsl_ft") * foot;
  for (int i = 0; i < 3000; ++i) x = runge_kutta(x, load(x, 0), 0.01, body, Vector3d::Zero(), load);
  const std::size_t row = nasa->row_at(30);
  CHECK(std::abs(-x.p_n.z() / foot - nasa->at(row, "altitudeMsl_ft")) < 0.1);
  CHECK(std::abs(x.v_n.z() / foot - nasa->at(row, "feVelocity_ft_s_Z")) < 0.02);
}

}  // namespace rigid_body_test

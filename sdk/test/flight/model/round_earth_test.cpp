// SPDX-License-Identifier: BSD-3-Clause
#include "fulmar/flight/model/round_earth.hpp"

#include <doctest/doctest.h>

#include <GeographicLib/Geocentric.hpp>
#include <numbers>

#include "fulmar/flight/earth/geodesy.hpp"
#include "fulmar/flight/math/attitude.hpp"

namespace earth_test {

using namespace fulmar;
using doctest::Approx;
using Eigen::Vector3d;

namespace {

constexpr double degree = std::numbers::pi / 180, omega = 7.292115e-5;

RotatingEarth earth_at(double lat_deg, double lon_deg = 0, double alt_m = 0) {
  return RotatingEarth({lat_deg * degree, lon_deg * degree, alt_m});
}

Load nothing(const RigidBody&, double) { return {}; }

RigidBody thrown(const RotatingEarth& earth, const Vector3d& p_n, const Vector3d& v_n, double seconds,
                 double dt = 0.01) {
  const MassProperties body(1, Eigen::Matrix3d::Identity());
  RigidBody x;
  x.p_n = p_n;
  x.v_n = v_n;
  for (int i = 0; i < std::lround(seconds / dt); ++i) x = runge_kutta(x, {}, dt, body, earth, nothing);
  return x;
}

/// Gravitational potential by radius and geocentric latitude, in textbook form.
double potential(const Vector3d& r_e) {
  const double r = r_e.norm(), s = r_e.z() / r, ratio = 6378137 / r;
  return 3.986004418e14 / r * (1 - 1.08262982131e-3 * ratio * ratio * (1.5 * s * s - 0.5));
}

}  // namespace

TEST_CASE(
    "normal gravity is that of WGS-84 at the equator, at the poles and between, and falls with height") {
  CHECK(std::abs(normal_gravity(0, 0) - 9.7803253359) < 1e-10);
  for (const double pole : {-90.0, 90.0})
    CHECK(std::abs(normal_gravity(pole * degree, 0) - 9.8321849379) < 1e-9);
  // Moritz, Geodetic Reference System 1980: 9.806199203 at 45 degrees; WGS-84 has 0.000001 less at the
  // equator
  CHECK(normal_gravity(45 * degree, 0) == Approx(9.8061992).epsilon(2e-7));
  CHECK(normal_gravity(-0.6, 500) == normal_gravity(0.6, 500));
  // free-air gradient, 0.3086 mGal/m at mid latitudes
  CHECK((normal_gravity(0.8, 1000) - normal_gravity(0.8, 0)) / 1000 == Approx(-3.086e-6).epsilon(1e-3));
  CHECK((normal_gravity(0.8, -1000) - normal_gravity(0.8, 0)) / 1000 == Approx(3.086e-6).epsilon(1e-3));
}

TEST_CASE("Earth-centred coordinates and back agree with GeographicLib to nanometres") {
  const GeographicLib::Geocentric& reference = GeographicLib::Geocentric::WGS84();
  for (const double lat : {-90.0, -89.9999, -45.0, -1e-7, 0.0, 1e-7, 37.96, 60.0, 89.9999, 90.0})
    for (const double lon : {-180.0, -111.6474138, 0.0, 90.0, 144.76})
      for (const double alt : {-5000.0, 0.0, 1387.0, 9144.0, 4e5, 3.6e7}) {
        Vector3d p;
        reference.Forward(lat, lon, alt, p.x(), p.y(), p.z());
        CHECK((ecef_from({lat * degree, lon * degree, alt}) - p).norm() < 1e-8 * (1 + alt / 6.4e6));
        const Geodetic g = geodetic_from(p);
        double lat_theirs = 0, lon_theirs = 0, alt_theirs = 0;
        reference.Reverse(p.x(), p.y(), p.z(), lat_theirs, lon_theirs, alt_theirs);
        const double r = p.norm();  // angles as distances in metres; 1.9e-9 m are two digits of 6378137
        CHECK(std::abs(g.lat_rad - lat_theirs * degree) * r < 2e-9 * r / 6.4e6);
        CHECK(std::abs(std::remainder(g.lon_rad - lon_theirs * degree, 2 * std::numbers::pi)) *
                  p.head<2>().norm() <
              3e-9 * r / 6.4e6);
        CHECK(std::abs(g.alt_m - alt_theirs) < 3e-9 * r / 6.4e6);
        CHECK((ecef_from(g) - p).norm() < 5e-9 * r / 6.4e6);
      }
}

TEST_CASE("the frame is that of geodesy.hpp") {
  const LocalFrame frame(-37.96, 144.76, 250);
  const RotatingEarth earth = earth_at(-37.96, 144.76, 250);
  for (const Vector3d& p : {Vector3d(0, 0, 0), Vector3d(1234.5, -6789, -321), Vector3d(-4e4, 3e4, -9000)}) {
    const LocalFrame::Geodetic theirs = frame.from_ned(p);
    const Geodetic g = earth.geodetic(p);
    CHECK(std::abs(g.lat_rad - theirs.lat_deg * degree) < 1e-15 * 2);
    CHECK(std::abs(g.lon_rad - theirs.lon_deg * degree) < 1e-15 * 2);
    CHECK(std::abs(g.alt_m - theirs.alt_m) < 1e-8);
  }
  CHECK((earth.rotation() - omega * Vector3d(std::cos(37.96 * degree), 0, std::sin(37.96 * degree))).norm() <
        1e-18);
}

TEST_CASE("gravitation is the gradient of the potential with J2") {
  for (const double lat : {-70.0, 0.0, 40.2463724, 90.0}) {
    const RotatingEarth earth = earth_at(lat, -111.6, 1387);
    const Vector3d p(3000, -20000, -8000);
    const Vector3d centre = ecef_from({lat * degree, -111.6 * degree, 1387});
    for (int k = 0; k < 3; ++k) {
      const Vector3d d = 100 * Vector3d::Unit(k);
      const auto U = [&](const Vector3d& at) { return potential(centre + earth.R_en() * at); };
      CHECK(earth.gravitation(p)(k) == Approx((U(p + d) - U(p - d)) / 200).epsilon(1e-7).scale(9.8));
    }
  }
}

TEST_CASE("attraction and centrifugal part are normal gravity, but for the fourth harmonic, and point down") {
  // of the ellipsoid, TR8350.2: C40 = 7.90303733511e-7 = -J4 / 3
  const auto fourth = [](const Vector3d& r_e) {
    const double r = r_e.norm(), s2 = std::pow(r_e.z() / r, 2), J4 = -2.37091222e-6;
    return -3.986004418e14 / r * std::pow(6378137 / r, 4) * J4 * (35 * s2 * s2 - 30 * s2 + 3) / 8;
  };
  for (const double lat : {-90.0, -63.0, -30.0, 0.0, 15.0, 45.0, 78.0})
    for (const double alt : {0.0, 1387.0, 9144.0}) {
      const RotatingEarth earth = earth_at(lat, 33, alt);
      const Vector3d centre = ecef_from({lat * degree, 33 * degree, alt});
      Vector3d g = earth.gravity(Vector3d::Zero());
      CHECK(std::abs(g.z() - normal_gravity(lat * degree, alt)) < 1.3e-5 * 9.8);  // 5 |J4| and higher terms
      for (int k = 0; k < 3; ++k) {
        const Vector3d d = earth.R_en() * Vector3d::Unit(k) * 1000;
        g(k) += (fourth(centre + d) - fourth(centre - d)) / 2000;
      }
      CHECK(std::abs(g.z() - normal_gravity(lat * degree, alt)) < 1e-6);  // the sixth is 4e-7
      CHECK(g.head<2>().norm() < 1e-6 * alt / 1000 * 9.8 + 3e-7);
    }
  // at rest: the direction of a plumb line alone
  CHECK(earth_at(40).free_acceleration({10, 20, 30}, Vector3d::Zero()) == earth_at(40).gravity({10, 20, 30}));
}

TEST_CASE("a falling body drifts east, one thrown up lands in the west, by Coriolis' formula") {
  for (const double lat : {-40.0, 0.0, 40.0}) {
    const RotatingEarth earth = earth_at(lat);
    const double t = 10, g = normal_gravity(lat * degree, 0), cosine = std::cos(lat * degree);
    CHECK(thrown(earth, {0, 0, -500}, {0, 0, 0}, t).p_n.y() ==
          Approx(omega * g * t * t * t * cosine / 3).epsilon(1e-3));
    const double v = 49, up_and_down = 2 * v / g;
    const RigidBody back = thrown(earth, {0, 0, 0}, {0, 0, -v}, up_and_down, up_and_down / 1000);
    CHECK(back.p_n.y() == Approx(-4.0 / 3 * omega * cosine * v * v * v / (g * g)).epsilon(1e-3));
  }
}

TEST_CASE("what moves turns to the right in the north and to the left in the south") {
  for (const double lat : {-50.0, 50.0}) {
    const RotatingEarth earth = earth_at(lat);
    const double f = 2 * omega * std::sin(lat * degree), g0 = earth.gravity(Vector3d::Zero()).x();
    for (const double heading : {0.0, 1.0, 4.0}) {
      const Vector3d v(20 * std::cos(heading), 20 * std::sin(heading), 0), right(-v.y(), v.x(), 0);
      const Vector3d a = earth.free_acceleration(Vector3d::Zero(), v) - Vector3d(g0, 0, 0);
      CHECK((a.head<2>() - f * right.head<2>()).norm() < 1e-9);
      // eastward flight is lighter, westward flight heavier: Eotvos effect
      CHECK(a.z() - earth.gravity(Vector3d::Zero()).z() ==
            Approx(-2 * omega * v.y() * std::cos(lat * degree)).epsilon(1e-6));
    }
  }
}

TEST_CASE("a long throw keeps energy and momentum about the Earth's axis as an observer in space sees them") {
  const RotatingEarth earth = earth_at(40.2463724, -111.6474138, 1387);
  const Vector3d centre = ecef_from({40.2463724 * degree, -111.6474138 * degree, 1387}), w(0, 0, omega);
  struct Kept {
    double energy, momentum, jacobi;
  };
  const auto of = [&](const RigidBody& x) {
    const Vector3d r = centre + earth.R_en() * x.p_n, v = earth.R_en() * x.v_n, v_i = v + w.cross(r);
    return Kept{0.5 * v_i.squaredNorm() - potential(r), r.cross(v_i).z(),
                0.5 * v.squaredNorm() - potential(r) - 0.5 * w.cross(r).squaredNorm()};
  };
  RigidBody x;
  x.v_n = {1500, 1200, -2000};
  const Kept before = of(x);
  x = thrown(earth, x.p_n, x.v_n, 400, 0.1);
  CHECK(x.p_n.norm() > 5e5);
  const Kept after = of(x);
  CHECK(after.energy == Approx(before.energy).epsilon(1e-13));
  CHECK(after.momentum == Approx(before.momentum).epsilon(1e-13));
  CHECK(after.jacobi == Approx(before.jacobi).epsilon(1e-13));
}

TEST_CASE("the attitude relative to the Earth is that in space, turned back by the Earth's turn") {
  const RotatingEarth earth = earth_at(-20, 50, 300);
  const MassProperties body(2, Vector3d(0.2, 0.3, 0.45).asDiagonal());
  RigidBody x, in_space;
  x.omega_b = in_space.omega_b = {0.3, -0.2, 0.5};
  x.q_nb = in_space.q_nb = quaternion_from({0.3, 0.2, -1});
  const double dt = 0.01;
  for (int i = 0; i < 6000; ++i) {
    x = runge_kutta(x, {}, dt, body, earth, nothing);
    in_space = runge_kutta(in_space, {}, dt, body, Vector3d(0, 0, 0), nothing);
  }
  CHECK((x.omega_b - in_space.omega_b).norm() < 1e-14);
  CHECK(x.q_nb.angularDistance(exp_map(-60 * earth.rotation()) * in_space.q_nb) < 1e-9);
  CHECK(x.q_nb.angularDistance(in_space.q_nb) == Approx(60 * omega).epsilon(1e-5));
}

TEST_CASE("a body that is held against its weight and turns with the Earth stays as it is") {
  const RotatingEarth earth = earth_at(40.2463724, -111.6474138, 1387);
  const MassProperties body(4.5, Vector3d(0.2, 0.3, 0.45).asDiagonal());
  RigidBody x;
  x.p_n = {400, -700, -120};
  x.q_nb = quaternion_from({0.1, -0.4, 2});
  x.omega_b = x.q_nb.conjugate() * earth.rotation();
  Load held;
  held.force_b = -body.mass * (x.q_nb.conjugate() * earth.gravity(x.p_n));
  held.moment_b = x.omega_b.cross(body.J * x.omega_b);
  const RigidBodyRate d = rate_of(x, held, body, earth);
  CHECK(d.v_n.norm() < 1e-14);
  CHECK(d.q_nb.norm() < 1e-19);
  CHECK(d.omega_b.norm() < 1e-20);
  CHECK(earth.relative_rate(x).norm() < 1e-19);
}

TEST_CASE("at the vehicle's own place down is where gravity points and the altitude that of geodesy") {
  const RotatingEarth earth = earth_at(55, 10, 40);
  for (const Vector3d& p : {Vector3d(0, 0, -100), Vector3d(3e4, 0, -500), Vector3d(-2e4, 2.5e4, 30)}) {
    const LocalLevel level(earth, p);
    RigidBody x;
    x.p_n = p;
    x.v_n = earth.gravity(p).normalized();
    x.q_nb = quaternion_from({0.2, 0.1, -0.7});
    x.omega_b = {0.1, -0.2, 0.3};
    const RigidBody seen = level.seen(x);
    CHECK((seen.v_n - Vector3d(0, 0, 1)).norm() < 8e-6);
    CHECK(-seen.p_n.z() == Approx(earth.geodetic(p).alt_m - 40).epsilon(1e-9));
    // at a place 30 km away the plane of the origin is 70 m above the ellipsoid
    CHECK(-seen.p_n.z() + p.z() == Approx(p.head<2>().squaredNorm() / (2 * 6.38e6)).epsilon(6e-3).scale(1));
    CHECK((seen.omega_b - (x.omega_b - x.q_nb.conjugate() * earth.rotation())).norm() < 1e-16);
    const RigidBody back = level.in_frame(seen);
    CHECK((back.p_n - x.p_n).norm() < 1e-8);
    CHECK((back.v_n - x.v_n).norm() < 1e-15);
    CHECK(back.q_nb.angularDistance(x.q_nb) < 1e-7);
    CHECK((back.omega_b - x.omega_b).norm() < 1e-15);
    // after one step the altitude is still correct, and so are the axes
    const Vector3d step(3, -4, 2);
    CHECK(std::abs(level.altitude(p + step) - earth.geodetic(p + step).alt_m) < 3e-6);
    RigidBody higher = seen;
    higher.p_n.z() -= 250;
    const Geodetic above = earth.geodetic(level.in_frame(higher).p_n), here = earth.geodetic(p);
    CHECK(above.alt_m - here.alt_m == Approx(250).epsilon(1e-10));
    CHECK(std::abs(above.lat_rad - here.lat_rad) < 1e-14);
    CHECK(std::abs(above.lon_rad - here.lon_rad) < 1e-14);
  }
  // east of the origin north leans to the west, by the convergence of the meridians, sin(lat) d(lon)
  const LocalLevel east(earth, {0, 2e4, 0});
  RigidBody x;
  const double yaw = euler_from(east.seen(x).q_nb).yaw_rad;
  CHECK(yaw == Approx(std::sin(55 * degree) * (east.place().lon_rad - 10 * degree)).epsilon(1e-4));
}

}  // namespace earth_test

// SPDX-License-Identifier: BSD-3-Clause
// The Earth, the deviation from the standard atmosphere and the wind profile, by sensors and truth.
#include <doctest/doctest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "fly.hpp"
#include "fulmar/flight/math/attitude.hpp"

namespace earth_test {

using namespace fulmar;
using namespace fulmar::sim;
using doctest::Approx;
using Eigen::Vector3d;

namespace {

constexpr double dt = 0.0025, degree = std::numbers::pi / 180, omega = 7.292115e-5;
constexpr double far_m = 20000, sagitta_m = far_m * far_m / (2 * 6.37e6);  // 31 m

Plant plant(EarthModel model, double lat_deg = 40.2463724, double alt_m = 1387, const Weather& weather = {}) {
  return Plant(anaconda(), weather, alt_m, 1, {model, lat_deg * degree, -111.6474138 * degree});
}

std::unique_ptr<Bench<Aircraft>> bench(EarthModel model, double lat_deg = 40.2463724, double alt_m = 1387) {
  auto b = std::make_unique<Bench<Aircraft>>(1);
  b->params.airframe.value = anaconda();
  b->params.sensors.value = SensorSet::perfect;
  b->params.origin.value = {lat_deg, -111.6474138, alt_m, true};
  b->params.origin.is_given = true;
  b->params.earth.value = model;
  return b;
}

/// Sensors and truth of a bench after some seconds of standing or of being carried.
struct Said {
  Imu imu;
  Gnss gnss;
  Mag mag;
  Baro baro;
  VehicleState truth;
};
Said said(Bench<Aircraft>& b, double seconds) {
  for (int i = 0; i < std::lround(seconds / dt); ++i) pass(b);
  return {b.out.imu.value, b.out.gnss.value, b.out.mag.value, b.out.baro.value, b.out.truth.value};
}

double standing_weight(EarthModel model, double lat_deg, double alt_m) {
  Plant p = plant(model, lat_deg, alt_m);
  for (int i = 0; i < 800; ++i) p.advance({}, true, dt);
  return p.specific_force().norm();
}

}  // namespace

TEST_CASE("things weigh by latitude and height when gravity does, and 9.80665 m/s2 otherwise") {
  for (const EarthModel model : {EarthModel::gravity, EarthModel::wgs84}) {
    CHECK(standing_weight(model, 0, 0) == Approx(9.7803253359).epsilon(2e-5));
    CHECK(standing_weight(model, 90, 0) == Approx(9.8321849379).epsilon(2e-5));
    CHECK(standing_weight(model, -90, 0) == Approx(9.8321849379).epsilon(2e-5));
    // free-air gradient: 0.3086 mGal/m
    CHECK(standing_weight(model, 40, 3000) - standing_weight(model, 40, 0) ==
          Approx(-3000 * 3.086e-6).epsilon(0.01).scale(0));
  }
  CHECK(standing_weight(EarthModel::flat, 0, 0) == Approx(9.80665).epsilon(1e-6));
  CHECK(standing_weight(EarthModel::flat, 90, 3000) == Approx(9.80665).epsilon(1e-6));
}

TEST_CASE("an aircraft that stands on the turning Earth stands still, and its gyro feels the Earth turn") {
  for (const double lat : {-35.0, 0.0, 62.0}) {
    Plant p = plant(EarthModel::wgs84, lat);
    p.stand(0, 0, 2);
    for (int i = 0; i < 1200; ++i) p.advance({}, true, dt);
    const Vector3d there = p.state().p_n;
    for (int i = 0; i < 8000; ++i) p.advance({}, true, dt);
    CHECK((p.state().p_n - there).norm() < 1e-4);
    CHECK(p.seen().omega_b.norm() < 1e-7);
    const Vector3d level(omega * std::cos(lat * degree) * std::cos(2.0),
                         -omega * std::cos(lat * degree) * std::sin(2.0), -omega * std::sin(lat * degree));
    CHECK((p.state().omega_b - level).norm() < 0.01 * omega);  // the gear gives way by some 0.1 degrees
    CHECK(p.on_ground());
  }
}

TEST_CASE("held before arming, sensors and truth already are those of the turning Earth") {
  auto b = bench(EarthModel::wgs84, -35);
  const Said s = said(*b, 1);
  CHECK(eigen(s.imu.rate_radps).x() == Approx(omega * std::cos(35 * degree)).epsilon(1e-6));
  CHECK(eigen(s.imu.rate_radps).z() == Approx(omega * std::sin(35 * degree)).epsilon(1e-6));
  CHECK(eigen(s.truth.rate_radps).norm() < 1e-15);
  CHECK(eigen(s.imu.specific_force_mps2).z() == Approx(-normal_gravity(-35 * degree, 1387)).epsilon(2e-5));
  auto flat = bench(EarthModel::flat, -35);
  CHECK(eigen(said(*flat, 1).imu.rate_radps).norm() == 0);
}

TEST_CASE("far from the origin the ground follows the Earth's curvature, and so do air, receiver and truth") {
  for (const Vector3d& place : {Vector3d(far_m, 0, 0), Vector3d(0, -far_m, 0)}) {
    auto round = bench(EarthModel::wgs84), flat = bench(EarthModel::flat);
    for (auto* b : {&round, &flat}) {
      (*b)->params.start.start_north.value = place.x();
      (*b)->params.start.start_east.value = place.y();
    }
    const Said r = said(**&round, 1), f = said(**&flat, 1);
    CHECK(r.truth.height_m == Approx(anaconda().gear.height_m).epsilon(1e-6));
    CHECK(r.gnss.altitude_m == Approx(1387 + anaconda().gear.height_m).epsilon(1e-8));
    CHECK(f.gnss.altitude_m - r.gnss.altitude_m == Approx(sagitta_m).epsilon(0.01));
    CHECK(r.truth.position_m.down == Approx(sagitta_m - anaconda().gear.height_m).epsilon(0.01));
    CHECK(
        r.baro.pressure_pa - f.baro.pressure_pa ==
        Approx(1.068 * 9.80665 * 1387 * 1387 / 6.356766e6).epsilon(0.02).scale(0));  // geopotential altitude
    CHECK(std::abs(r.truth.roll_rad) + std::abs(r.truth.pitch_rad) < 1e-6);          // level where it stands
    CHECK((eigen(r.mag.field_tesla) - eigen(f.mag.field_tesla)).norm() < 1e-12);
    CHECK(eigen(r.imu.specific_force_mps2).head<2>().norm() < 1e-4);  // the plumb line is the ellipsoid's
  }
}

TEST_CASE("a flight on the turning Earth drifts to the right in the north, to the left in the south") {
  for (const double lat : {-50.0, 50.0})
    for (const double heading : {0.0, 2.0}) {
      std::array<Vector3d, 2> end;
      for (const EarthModel model : {EarthModel::gravity, EarthModel::wgs84}) {
        Plant p = plant(model, lat);
        REQUIRE(p.fly({0, 0, -300}, heading, 17));
        const Actuators trim{0.57, p.deflections().aileron, p.deflections().elevator, p.deflections().rudder};
        for (int i = 0; i < 1200; ++i) p.advance(trim, true, dt);
        end[model == EarthModel::wgs84] = p.state().p_n;
      }
      const Vector3d right(-std::sin(heading), std::cos(heading), 0);
      const double drift = (end[1] - end[0]).dot(right), coriolis = 2 * omega * 17 * std::sin(lat * degree);
      // The fin resists: less than half of a t^2 of a free body, but to that side.
      CHECK(drift / (0.5 * coriolis * 9) > 0.2);
      CHECK(drift / (0.5 * coriolis * 9) < 1.05);
    }
}

TEST_CASE("a flight that starts far away starts level, on its heading and at its height") {
  Plant p = plant(EarthModel::wgs84, 40, 100, {{3, -4, 0}, Turbulence::none});
  REQUIRE(p.fly({-far_m, far_m, -250}, 0.7, 17));
  CHECK(-p.seen().p_n.z() == Approx(250).epsilon(1e-7));
  CHECK(p.state().p_n.z() + 250 == Approx(2 * sagitta_m).epsilon(0.01));
  CHECK(euler_from(p.seen().q_nb).yaw_rad == Approx(0.7).epsilon(1e-9));
  CHECK(p.air_velocity_b().norm() == Approx(17).epsilon(1e-9));
  CHECK((p.wind_n() - Vector3d(3, -4, 0)).norm() < 1e-12);
  CHECK(std::abs(p.seen().v_n.z()) < 1e-9);
  CHECK((p.specific_force() - p.seen().q_nb.conjugate() * Vector3d(0, 0, -normal_gravity(40 * degree, 350)))
            .norm() < 0.01);
}

TEST_CASE("far away receiver and truth say the velocity by north, east and down of that place") {
  auto b = bench(EarthModel::wgs84);
  b->params.start.start_north.value = far_m;
  b->params.start.start_height.value = 120;
  b->params.start.start_heading.value = 0.3;
  b->params.settle.value = 1;
  const Said s = said(*b, 1);
  const double tilt = far_m / 6.37e6;  // of that place, 0.18 degrees
  // of some milliseconds before
  CHECK((eigen(s.gnss.velocity_mps) - eigen(s.truth.velocity_mps)).norm() < 1e-3 * 17 * tilt);
  CHECK(s.truth.ground_speed_mps == Approx(17).epsilon(1e-6));
  CHECK(std::abs(s.truth.velocity_mps.down) < 1e-3 * 17 * tilt);
  CHECK(s.truth.climb_rate_mps == -s.truth.velocity_mps.down);
  CHECK(s.truth.yaw_rad == Approx(0.3).epsilon(1e-6));
  CHECK(s.truth.height_m == Approx(120).epsilon(1e-5));
  CHECK(b->component().plant().state().v_n.z() == Approx(17 * std::cos(0.3) * tilt).epsilon(0.02));
}

TEST_CASE("a warm day is thinner and a cold one denser, and the pressure at sea level counts") {
  const auto air = [](double temperature, double pressure, double alt_m) {
    auto b = bench(EarthModel::flat, 40, alt_m);
    b->params.wind.temperature_offset.value = temperature;
    b->params.wind.pressure_offset.value = pressure;
    pass(*b);
    return b->component().plant().air();
  };
  const double h = anaconda().gear.height_m;
  for (const double offset : {-30.0, 20.0}) {
    CHECK(air(offset, 0, -h).density_kgm3 == Approx(1.225 * 288.15 / (288.15 + offset)).epsilon(1e-6));
    CHECK(air(offset, 0, -h).pressure_pa == Approx(101325).epsilon(1e-6));
    CHECK(air(offset, 0, 1500 - h).temperature_kelvin == Approx(278.4 + offset).epsilon(1e-9));
  }
  for (const double offset : {-2500.0, 1800.0})
    CHECK(air(0, offset, 1387).pressure_pa / air(0, 0, 1387).pressure_pa ==
          Approx(1 + offset / 101325).epsilon(1e-9));
  // hydrostatic: dp/dh = -rho g, on a hot day too
  const Air low = air(25, 500, 1000), high = air(25, 500, 1010);
  CHECK((high.pressure_pa - low.pressure_pa) / 10 ==
        Approx(-9.80665 * 0.5 * (low.density_kgm3 + high.density_kgm3)).epsilon(1e-6));
}

TEST_CASE("the wind grows with height by the power law or the logarithm, and is constant by default") {
  const auto wind = [](WindProfile profile, double height, auto&& set) {
    auto b = bench(EarthModel::flat);
    b->params.wind.wind_ned.value = {6, -8, 0};
    b->params.wind.wind_profile.value = profile;
    b->params.start.start_height.value = height;
    set(b->params);
    pass(*b);
    const Vector3d v = eigen(b->out.truth.value.wind_mps);
    CHECK(v.y() == Approx(-4.0 / 3 * v.x()));
    return v.norm();
  };
  const auto as_is = [](Aircraft::Params&) {};
  CHECK(wind(WindProfile::constant, 2, as_is) == Approx(10));
  CHECK(wind(WindProfile::constant, 200, as_is) == Approx(10));
  CHECK(wind(WindProfile::power, 10, as_is) == Approx(10));
  CHECK(wind(WindProfile::power, 80, as_is) == Approx(10 * std::pow(8, 1.0 / 7)));
  CHECK(wind(WindProfile::power, 5, as_is) == Approx(10 * std::pow(0.5, 1.0 / 7)));
  CHECK(wind(WindProfile::power, 80, [](auto& p) { p.wind.wind_exponent.value = 0.3; }) ==
        Approx(10 * std::pow(8, 0.3)));
  CHECK(wind(WindProfile::power, 80, [](auto& p) { p.wind.wind_reference.value = 40; }) ==
        Approx(10 * std::pow(2, 1.0 / 7)));
  // MIL-F-8785C: W20 = 10 m/s at 20 ft, z0 = 2 ft: 17 m/s at 100 ft
  const auto mil = [](auto& p) {
    p.wind.wind_reference.value = 20 * 0.3048;
    p.wind.wind_roughness.value = 2 * 0.3048;
  };
  CHECK(wind(WindProfile::log, 100 * 0.3048, mil) == Approx(10 * std::log10(50.0)));
  CHECK(wind(WindProfile::log, 10 * 0.3048, mil) == Approx(10 * std::log10(5.0)));
  CHECK(wind(WindProfile::log, 10, as_is) == Approx(10));
  for (const WindProfile p : {WindProfile::power, WindProfile::log})
    CHECK(wind(p, 3000, as_is) == Approx(wind(p, 1000 * 0.3048, as_is)));
}

TEST_CASE("on the ground there is little wind or none, and nothing that is no number") {
  WindShear shear{WindProfile::log};
  CHECK(shear.at(-1) == 0);
  CHECK(shear.at(0.03) == 0);
  CHECK(shear.at(0.031) > 0);
  shear.profile = WindProfile::power;
  CHECK(shear.at(-1) == 0);
  CHECK(shear.at(0) == 0);
}

TEST_CASE("a logarithmic profile whose reference lies in the grass is refused") {
  auto b = bench(EarthModel::flat);
  b->params.wind.wind_profile.value = WindProfile::log;
  b->params.wind.wind_reference.value = 0.5;
  b->params.wind.wind_roughness.value = 0.6;
  CHECK(b->configure() == Status::failed);
  CHECK(b->error().find("wind_reference: sim_aero.wind_reference_low(0.5, 0.6)") != std::string::npos);
}

TEST_CASE("an aircraft that crashed on the turning Earth lies still and turns with it") {
  Plant p = plant(EarthModel::wgs84);
  REQUIRE(p.fly({0, 0, -20}, 0, 17));
  RigidBody x = p.state();
  x.p_n.z() = -0.25;
  x.v_n = {3, 0, 5};
  x.q_nb = Eigen::Quaterniond::Identity();
  p.set_state(x);
  for (int i = 0; i < 800; ++i) p.advance({}, true, dt);
  REQUIRE(p.crashed());
  CHECK(p.seen().v_n.norm() == 0);
  CHECK(p.seen().omega_b.norm() < 1e-18);
  CHECK(p.specific_force().norm() == Approx(normal_gravity(40.2463724 * degree, 1387)).epsilon(2e-5));
}

}  // namespace earth_test

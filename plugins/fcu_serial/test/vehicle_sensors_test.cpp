// SPDX-License-Identifier: BSD-3-Clause
#include <doctest/doctest.h>

#include <limits>

#include "plugins/fcu_serial/radio.hpp"
#include "plugins/fcu_serial/sensors.hpp"

namespace vehicle_sensors_test {

using namespace fulmar;
using namespace fulmar::fcu;
using doctest::Approx;

namespace {
constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN(),
                inf = std::numeric_limits<float>::infinity();

ParamValue integer_parameter(std::int32_t value) {
  ParamValue p;
  p.param_type = param_int32;
  p.param_value = static_cast<std::uint32_t>(value);
  return p;
}
}  // namespace

TEST_CASE("an inertial sample keeps its axes and units, and its temperature is kelvin") {
  const auto imu = to_imu({123, 1.5f, -2.5f, -9.75f, 0.125f, -0.25f, 0.5f, 300.25f});
  REQUIRE(imu);
  CHECK(imu->specific_force_mps2 == Vec3<Body>{1.5, -2.5, -9.75});
  CHECK(imu->rate_radps == Vec3<Body>{0.125, -0.25, 0.5});
  CHECK(imu->temperature_kelvin == 300.25);
}

TEST_CASE("a thermometer in Celsius, or none, does not silence a sensor") {
  CHECK(to_imu({1, 0, 0, -9.8f, 0, 0, 0, 27})->temperature_kelvin == 288.15);
  CHECK(to_baro({0, 85000, not_a_number})->temperature_kelvin == 288.15);
}

TEST_CASE("an inertial sample with one value that is not finite, or out of this world, is none") {
  CHECK_FALSE(to_imu({1, not_a_number, 0, -9.8f, 0, 0, 0, 300}));
  CHECK_FALSE(to_imu({1, 0, inf, -9.8f, 0, 0, 0, 300}));
  CHECK_FALSE(to_imu({1, 0, 0, -9.8f, 0, not_a_number, 0, 300}));
  CHECK_FALSE(to_imu({1, 0, 0, -981, 0, 0, 0, 300}));
  CHECK_FALSE(to_imu({1, 0, 0, -9.8f, 0, 0, 150, 300}));
}

TEST_CASE("the field is tesla: microteslas pass, a magnet, a nanotesla scale and silence do not") {
  const auto mag = to_mag({2.1e-5f, -1e-6f, 4.6e-5f});
  REQUIRE(mag);
  CHECK(mag->field_tesla.x == Approx(21e-6));
  CHECK(mag->field_tesla.z == Approx(46e-6));
  CHECK_FALSE(to_mag({21000, -1000, 46000}));
  CHECK_FALSE(to_mag({0, 0, 0}));
  CHECK_FALSE(to_mag({not_a_number, 0, 4e-5f}));
}

TEST_CASE("the barometer gives absolute pascals; its altitude is not used") {
  const auto baro = to_baro({-9999, 85712.5f, 300.15f});
  REQUIRE(baro);
  CHECK(baro->pressure_pa == 85712.5);
  CHECK(baro->temperature_kelvin == Approx(300.15));
  CHECK_FALSE(to_baro({0, 857.125f, 300}));  // hectopascals
  CHECK_FALSE(to_baro({0, not_a_number, 300}));
}

TEST_CASE("the pitot tube gives pascals and indicated airspeed, with their signs") {
  // 17 m/s at 1.225 kg/m3: 0.5 * 1.225 * 289 = 177.0125 Pa
  const auto pitot = to_pitot({17, 177.0125f, 290});
  REQUIRE(pitot);
  CHECK(pitot->pressure_pa == Approx(177.0125));
  CHECK(pitot->indicated_airspeed_mps == Approx(17));
  CHECK(to_pitot({-2, -2.45f, 290})->indicated_airspeed_mps == Approx(-2));
  CHECK_FALSE(to_pitot({not_a_number, 10, 290}));
  CHECK_FALSE(to_pitot({17, inf, 290}));
}

TEST_CASE("a fix keeps place, velocity, accuracies and date") {
  RosflightGnss m;
  m.seconds = 1767225600;  // 2026-01-01
  m.nanos = -250000000;    // u-blox counts backwards, too
  m.lat = 40.2463724;
  m.lon = -111.6474138;
  m.height = 1387.5f;
  m.vel_n = 1;
  m.vel_e = -2;
  m.vel_d = 0.5f;
  m.h_acc = 0.5f;
  m.v_acc = 0.75f;
  m.s_acc = 0.125f;
  m.fix_type = 3;
  m.num_sat = 17;
  const auto g = to_gnss(m);
  REQUIRE(g);
  CHECK(g->latitude_deg == 40.2463724);
  CHECK(g->longitude_deg == -111.6474138);
  CHECK(g->altitude_m == 1387.5);
  CHECK(g->velocity_mps == Vec3<Ned>{1, -2, 0.5});
  CHECK(g->horizontal_std_m == 0.5);
  CHECK(g->vertical_std_m == 0.75);
  CHECK(g->speed_std_mps == 0.125);
  CHECK(g->utc_ns == 1767225599750000000);
  CHECK(g->fix == FixType::fix_3d);
  CHECK(g->satellites == 17);
}

TEST_CASE("all kinds of fixes keep their meaning, unknown ones are none") {
  RosflightGnss m;
  const FixType expected[] = {FixType::none,      FixType::dead_reckoning, FixType::fix_2d,
                              FixType::fix_3d,    FixType::combined,       FixType::time_only,
                              FixType::rtk_float, FixType::rtk_fixed};
  for (std::uint8_t i = 0; i < 8; ++i) {
    m.fix_type = i;
    CHECK(to_gnss(m)->fix == expected[i]);
  }
  m.fix_type = 8;
  CHECK(to_gnss(m)->fix == FixType::none);
}

TEST_CASE("an accuracy that a receiver does not give is unknown, and so is its date") {
  RosflightGnss m;
  m.h_acc = 0;
  m.v_acc = not_a_number;
  m.s_acc = -1;
  m.seconds = 315964800;  // the epoch of GPS: a receiver without a date
  CHECK(to_gnss(m)->horizontal_std_m == unknown_std);
  CHECK(to_gnss(m)->vertical_std_m == unknown_std);
  CHECK(to_gnss(m)->speed_std_mps == unknown_std);
  CHECK(to_gnss(m)->utc_ns == 0);
  m.lat = 91;
  CHECK_FALSE(to_gnss(m));
}

TEST_CASE("a range is valid between its ends") {
  CHECK(to_range({2, 8, 0.25f, 1})->valid);
  CHECK(to_range({2, 8, 0.25f, 1})->distance_m == 2);
  CHECK_FALSE(to_range({0.1f, 8, 0.25f, 1})->valid);
  CHECK_FALSE(to_range({8.5f, 8, 0.25f, 1})->valid);
  CHECK_FALSE(to_range({not_a_number, 8, 0.25f, 1}));
}

TEST_CASE("the controller's quaternion is body to NED, with the angles of 3-2-1") {
  // 30 degrees of roll alone: w = cos 15, x = sin 15
  const auto roll = to_attitude({0, 0.9659258f, 0.2588190f, 0, 0, 0.1f, 0.2f, 0.3f});
  REQUIRE(roll);
  CHECK(roll->roll_rad == Approx(0.5235988));
  CHECK(roll->pitch_rad == Approx(0).epsilon(1e-6));
  CHECK(roll->rate_radps.z == Approx(0.3));
  // 20 degrees nose up, heading 90: q = q_yaw * q_pitch
  const auto up = to_attitude({0, 0.6963642f, -0.1227878f, 0.1227878f, 0.6963642f, 0, 0, 0});
  REQUIRE(up);
  CHECK(up->pitch_rad == Approx(0.3490659).epsilon(1e-5));
  CHECK(up->yaw_rad == Approx(1.5707963).epsilon(1e-5));
  CHECK_FALSE(to_attitude({0, 0, 0, 0, 0, 0, 0, 0}));
  CHECK_FALSE(to_attitude({0, not_a_number, 0, 0, 0, 0, 0, 0}));
}

TEST_CASE("outputs that are not finite are told as none") {
  RosflightOutputRaw m;
  m.values[4] = 0.5f;
  CHECK(to_outputs(m)->values_ratio[4] == 0.5);
  m.values[3] = not_a_number;
  CHECK_FALSE(to_outputs(m));
}

TEST_CASE("sticks follow the controller's map: right roll is positive") {
  RcChannels m;
  m.chan1_raw = 2000;
  m.chan2_raw = 1250;
  m.chan3_raw = 1600;
  m.chan4_raw = 1500;
  m.chan5_raw = 2000;
  m.chan6_raw = 1000;
  m.chan7_raw = 1500;
  m.chan8_raw = 1750;
  const Rc rc = to_rc(m, RcMap{}, Throws{}, true);
  CHECK(rc.roll_frac == 1);
  CHECK(rc.pitch_frac == 0.5);
  CHECK(rc.yaw_frac == 0);
  CHECK(rc.throttle_frac == Approx(0.6));
  CHECK(rc.aux1_frac == 1);
  CHECK(rc.aux2_frac == -1);
  CHECK(rc.aux3_frac == 0);
  CHECK(rc.aux4_frac == 0.5);
  CHECK(rc.link);

  RcMap other;
  other.take("RC_X_CHN", 3);
  other.take("RC_F_CHN", 0);
  other.take("RC_Z_CHN", 2);
  other.take("RC_Y_CHN", 7);
  other.take("RC_TYPE", 1);
  const Rc moved = to_rc(m, other, Throws{}, false);
  CHECK(moved.roll_frac == 0);
  CHECK(moved.throttle_frac == 1);
  CHECK(moved.yaw_frac == Approx(-0.2));
  CHECK(moved.pitch_frac == -0.5);
  CHECK_FALSE(moved.link);
}

TEST_CASE("a stick that moves a surface as a command does has that command's meaning, reversed or not") {
  const auto us = [](float u) { return static_cast<std::uint16_t>(1500 + 500 * u); };
  for (const double sign : {1.0, -1.0}) {
    const Throws throws{sign * 0.5, sign * 0.5, sign * 0.5};
    const auto right_up_right =
        to_offboard({0, 0.25, -0.25, -0.25}, throws);  // roll right, nose up, nose right
    RcChannels m;
    m.chan1_raw = us(right_up_right->u[3]);
    m.chan2_raw = us(right_up_right->u[4]);
    m.chan4_raw = us(right_up_right->u[5]);
    const Rc rc = to_rc(m, RcMap{}, throws, true);
    CHECK(rc.roll_frac == Approx(0.5));
    CHECK(rc.pitch_frac == Approx(0.5));
    CHECK(rc.yaw_frac == Approx(0.5));
  }
}

TEST_CASE("sticks beyond their ends and channels that are not there stay within bounds") {
  RcChannels m;
  m.chan1_raw = 2150;
  m.chan2_raw = 850;
  m.chan3_raw = 980;
  RcMap map;
  map.take("RC_Z_CHN", -1);
  const Rc rc = to_rc(m, map, Throws{}, true);
  CHECK(rc.roll_frac == 1);
  CHECK(rc.pitch_frac == 1);
  CHECK(rc.throttle_frac == 0);
  CHECK(rc.yaw_frac == 0);
  CHECK(rc.aux1_frac == 0);  // 0 us: no channel
  map.take("RC_F_CHN", 12);
  CHECK(to_rc(m, map, Throws{}, true).throttle_frac == 0);
}

TEST_CASE("integers of parameters are bits, negative ones included") {
  CHECK(integer_of(integer_parameter(-1)) == -1);
  CHECK(integer_of(integer_parameter(3)) == 3);
  ParamValue real;
  real.param_value = std::bit_cast<std::uint32_t>(2.0f);
  CHECK(integer_of(real) == 2);
  real.param_value = std::bit_cast<std::uint32_t>(not_a_number);
  CHECK(integer_of(real) == 0);
}

}  // namespace vehicle_sensors_test

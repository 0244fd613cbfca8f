// SPDX-License-Identifier: BSD-3-Clause
// The parts of the vehicle separately: each limit of a sensor on both sides, each axis, times to the
// nanosecond, and the initial state of a second connection.
#include <doctest/doctest.h>

#include <bit>
#include <string>

#include "plugins/fcu_serial/firmware_version.hpp"
#include "plugins/fcu_serial/link/watch_list.hpp"
#include "plugins/fcu_serial/link_report.hpp"
#include "plugins/fcu_serial/overload.hpp"
#include "plugins/fcu_serial/pace.hpp"
#include "plugins/fcu_serial/parameter_book.hpp"
#include "plugins/fcu_serial/radio.hpp"
#include "plugins/fcu_serial/sensors.hpp"

namespace vehicle_values_test {

using namespace fulmar;
using namespace fulmar::fcu;
using doctest::Approx;

namespace {

constexpr std::int64_t ms = 1'000'000, second = 1000 * ms;

ParamValue parameter(std::uint16_t index, std::uint16_t count, float value, std::string_view name = "P") {
  ParamValue p;
  p.param_index = index;
  p.param_count = count;
  p.param_value = std::bit_cast<std::uint32_t>(value);
  std::copy(name.begin(), name.end(), p.param_id.begin());
  return p;
}
std::string text(const Notices& out, std::size_t i) { return std::string(out[i].text.view()); }
/// A message whose `axis`, counted from 0, is `value`.
template <class M, class T>
M with(M m, T M::*field, T value) {
  m.*field = value;
  return m;
}

}  // namespace

TEST_CASE("each axis of an inertial sample and of a field passes up to its limit, either way") {
  SmallImu imu;
  for (float SmallImu::*f : {&SmallImu::xacc, &SmallImu::yacc, &SmallImu::zacc})
    for (const float side : {1.0f, -1.0f}) {
      CHECK(to_imu(with(imu, f, side * 399)));
      CHECK_FALSE(to_imu(with(imu, f, side * 401)));
    }
  for (float SmallImu::*f : {&SmallImu::xgyro, &SmallImu::ygyro, &SmallImu::zgyro})
    for (const float side : {1.0f, -1.0f}) {
      CHECK(to_imu(with(imu, f, side * 99)));
      CHECK_FALSE(to_imu(with(imu, f, side * 101)));
    }
  SmallMag mag;
  for (float SmallMag::*f : {&SmallMag::xmag, &SmallMag::ymag, &SmallMag::zmag}) {
    CHECK(to_mag(with(mag, f, 0.99e-3f)));
    CHECK_FALSE(to_mag(with(mag, f, -1.01e-3f)));
  }
}

TEST_CASE("pressures and temperatures pass within the air that is flown in") {
  CHECK(to_baro({0, 1.19e5f, 300}));
  CHECK_FALSE(to_baro({0, 1.21e5f, 300}));
  CHECK(to_baro({0, 1.01e4f, 300}));
  CHECK_FALSE(to_baro({0, 0.99e4f, 300}));
  CHECK(to_pitot({199, 1.99e4f, 300}));
  CHECK(to_pitot({-199, -1.99e4f, 300}));
  CHECK_FALSE(to_pitot({201, 0, 300}));
  CHECK_FALSE(to_pitot({0, 2.01e4f, 300}));
  const auto pitot = to_pitot({12, 90, 290});
  CHECK(pitot->pressure_pa == 90);
  CHECK(pitot->temperature_kelvin == 290);
  CHECK(kelvin(151) == 151);
  CHECK(kelvin(149) == 288.15);
  CHECK(kelvin(499) == 499);
  CHECK(kelvin(501) == 288.15);
}

TEST_CASE("a fix passes on the Earth and below its speeds, with its deviations and its date") {
  RosflightGnss m;
  m.fix_type = 3;
  for (const double side : {1.0, -1.0}) {
    CHECK(to_gnss(with(m, &RosflightGnss::lat, side * 90)));
    CHECK_FALSE(to_gnss(with(m, &RosflightGnss::lat, side * 90.1)));
    CHECK(to_gnss(with(m, &RosflightGnss::lon, side * 180)));
    CHECK_FALSE(to_gnss(with(m, &RosflightGnss::lon, side * 180.1)));
  }
  CHECK(to_gnss(with(m, &RosflightGnss::height, 0.99e5f)));
  CHECK_FALSE(to_gnss(with(m, &RosflightGnss::height, -1.01e5f)));
  for (float RosflightGnss::*f : {&RosflightGnss::vel_n, &RosflightGnss::vel_e, &RosflightGnss::vel_d}) {
    CHECK(to_gnss(with(m, f, -999.0f)));
    CHECK_FALSE(to_gnss(with(m, f, 1001.0f)));
  }
  CHECK(deviation(0.99e6f) == Approx(0.99e6));
  CHECK(deviation(1.01e6f) == unknown_std);
  CHECK(deviation(0) == unknown_std);
  m.h_acc = 1;
  m.v_acc = 2;
  m.s_acc = 3;
  m.vel_n = 4;
  m.vel_e = 5;
  m.vel_d = 6;
  m.num_sat = 11;
  m.lat = 40;
  m.lon = -111;
  m.height = 1400;
  const Gnss g = *to_gnss(m);
  CHECK(g.horizontal_std_m == 1);
  CHECK(g.vertical_std_m == 2);
  CHECK(g.speed_std_mps == 3);
  CHECK(g.velocity_mps == Vec3<Ned>{4, 5, 6});
  CHECK(g.latitude_deg == 40);
  CHECK(g.longitude_deg == -111);
  CHECK(g.altitude_m == 1400);
  CHECK(g.satellites == 11);
  const auto utc = [&](std::int64_t seconds, std::int32_t nanos) {
    m.seconds = seconds;
    m.nanos = nanos;
    return to_gnss(m)->utc_ns;
  };
  CHECK(utc(1'000'000'000, 0) == 0);  // 2001: a receiver without a date
  CHECK(utc(1'000'000'001, 5) == 1'000'000'001'000'000'005);
  CHECK(utc(4'102'444'799, -7) == 4'102'444'798'999'999'993);  // 2099
  CHECK(utc(4'102'444'800, 0) == 0);
  CHECK(utc(1'700'000'000, 1'000'000'000) == 1'700'000'001'000'000'000);
  CHECK(utc(1'700'000'000, -1'000'000'001) == 0);
  m.fix_type = 7;
  CHECK(to_gnss(m)->fix == FixType::rtk_fixed);
  m.fix_type = 8;
  CHECK(to_gnss(m)->fix == FixType::none);
}

TEST_CASE("a range is valid between its own bounds, and none is farther than ten kilometres") {
  const auto valid = [](float range) { return to_range({range, 8, 0.25f, 0})->valid; };
  CHECK(valid(0.25f));
  CHECK_FALSE(valid(0.24f));
  CHECK(valid(8));
  CHECK_FALSE(valid(8.1f));
  CHECK(to_range({9.9e3f, 8, 0, 0}));
  CHECK_FALSE(to_range({1.01e4f, 8, 0, 0}));
  CHECK_FALSE(to_range({1, 1.01e4f, 0, 0}));
  const Range r = *to_range({3, 8, 1, 0});
  CHECK(r.distance_m == 3);
  CHECK(r.min_m == 1);
  CHECK(r.max_m == 8);
}

TEST_CASE("an attitude is that of its quaternion, of any length near one, about all three axes at once") {
  for (const float length : {0.91f, 1.0f, 1.09f}) {
    // roll 0.4, pitch -0.3, yaw 2.1: products of half angles
    const double cr = std::cos(0.2), sr = std::sin(0.2), cp = std::cos(-0.15), sp = std::sin(-0.15),
                 cy = std::cos(1.05), sy = std::sin(1.05);
    AttitudeQuaternion m;
    m.q1 = length * static_cast<float>(cr * cp * cy + sr * sp * sy);
    m.q2 = length * static_cast<float>(sr * cp * cy - cr * sp * sy);
    m.q3 = length * static_cast<float>(cr * sp * cy + sr * cp * sy);
    m.q4 = length * static_cast<float>(cr * cp * sy - sr * sp * cy);
    m.rollspeed = 1;
    m.pitchspeed = -2;
    m.yawspeed = 3;
    const auto a = to_attitude(m);
    REQUIRE(a);
    CHECK(a->roll_rad == Approx(0.4));
    CHECK(a->pitch_rad == Approx(-0.3));
    CHECK(a->yaw_rad == Approx(2.1));
    const Quat& q = a->attitude;
    CHECK(std::hypot(std::hypot(q.w, q.x), std::hypot(q.y, q.z)) == Approx(1));
    CHECK(a->rate_radps == Vec3<Body>{1, -2, 3});
  }
  AttitudeQuaternion m;
  CHECK_FALSE(to_attitude(with(m, &AttitudeQuaternion::q1, 0.89f)));
  for (float AttitudeQuaternion::*f :
       {&AttitudeQuaternion::q1, &AttitudeQuaternion::q2, &AttitudeQuaternion::q3, &AttitudeQuaternion::q4})
    CHECK_FALSE(to_attitude(with(m, f, -1.11f)));
  for (float AttitudeQuaternion::*f :
       {&AttitudeQuaternion::rollspeed, &AttitudeQuaternion::pitchspeed, &AttitudeQuaternion::yawspeed}) {
    CHECK(to_attitude(with(m, f, 99.0f)));
    CHECK_FALSE(to_attitude(with(m, f, -101.0f)));
  }
}

TEST_CASE("outputs are those of the controller in their order, and all of them have to be numbers") {
  RosflightOutputRaw m;
  for (std::size_t i = 0; i < m.values.size(); ++i) m.values[i] = static_cast<float>(i) - 3;
  const auto o = to_outputs(m);
  REQUIRE(o);
  for (std::size_t i = 0; i < m.values.size(); ++i) CHECK(o->values_ratio[i] == static_cast<double>(i) - 3);
  for (const std::size_t i : {std::size_t{0}, m.values.size() - 1}) {
    RosflightOutputRaw bad = m;
    bad.values[i] = 1.1e6f;
    CHECK_FALSE(to_outputs(bad));
    bad.values[i] = 0.9e6f;
    CHECK(to_outputs(bad));
  }
}

TEST_CASE("commands go out at their rate, repeated after 25 ms, and a late one does not put off the next") {
  Pace pace(200);
  CHECK(pace.due(true, 0));
  pace.sent(0);
  CHECK_FALSE(pace.due(true, 5 * ms - 500'001));
  CHECK(pace.due(false, 5 * ms - 500'000));  // it still waits
  pace.sent(6 * ms);                         // late by 1 ms
  CHECK_FALSE(pace.due(true, 10 * ms - 500'001));
  CHECK(pace.due(true, 10 * ms - 500'000));
  pace.sent(30 * ms);  // too late: the pace begins again
  CHECK_FALSE(pace.due(true, 35 * ms - 500'001));
  CHECK(pace.due(true, 35 * ms - 500'000));
  pace.sent(35 * ms);
  CHECK_FALSE(pace.due(false, 60 * ms - 1));
  CHECK(pace.due(false, 60 * ms));
}

TEST_CASE("a computer that is too slow is reported in its second such second, each ten, and at its end") {
  for (const auto& [too_old, slow] : {std::pair{9, false}, {10, true}, {30, true}}) {
    Overload load;
    std::string reported;
    Notices out;
    for (int s = 1; s <= 25; ++s) {
      for (int k = 0; k < 100; ++k) load.sample(s <= 23 && k < too_old);
      load.report(s * second - 1, out);
      CHECK(out.size() == 0);
      load.report(s * second, out);
      for (std::size_t i = 0; i < out.size(); ++i) {
        reported += std::to_string(s) + " ";
        if (s < 24) CHECK(text(out, i) == "fcu_serial.computer_slow(" + std::to_string(too_old) + ")");
      }
      out.clear();
    }
    CHECK(reported == (slow ? "2 12 22 24 " : ""));
  }
  Overload none;
  Notices out;
  for (int s = 1; s < 5; ++s) none.report(s * second, out);
  CHECK(out.size() == 0);
}

TEST_CASE(
    "parameters are asked for every 10 ms, in five rounds half a second apart; missing ones are reported") {
  ParameterBook book;
  book.expect(3);
  Notices out;
  std::string asked;
  std::int64_t now = 0;
  for (; now < 10 * second; now += 5 * ms) {
    if (const auto i = book.next(now)) {
      asked += std::to_string(*i) + "@" + std::to_string(now / ms) + " ";
      if (*i == 1) (void)book.take(parameter(1, 3, 7.5f));
    }
    book.report(out);
  }
  CHECK(asked == "0@0 1@10 2@20 0@530 2@540 0@1050 2@1060 0@1570 2@1580 0@2090 2@2100 ");
  REQUIRE(out.size() == 2);
  CHECK(text(out, 0) == "fcu_serial.params_missing(2, 3)");
  out.clear();
  book.restart();  // another connection: all of them again, and now they come
  asked.clear();
  for (; now < 12 * second; now += 5 * ms) {
    if (const auto i = book.next(now)) {
      asked += std::to_string(*i) + " ";
      const auto news = book.take(parameter(static_cast<std::uint16_t>(*i), 3, *i == 1 ? 8.5f : 1.0f));
      CHECK(news);
    }
    book.report(out);
  }
  CHECK(asked == "0 1 2 ");
  REQUIRE(out.size() == 1);
  CHECK(text(out, 0) == "fcu_serial.params_changed(1)");
  CHECK_FALSE(book.take(parameter(1, 3, 8.5f)));  // already known
  CHECK_FALSE(book.take(parameter(3, 3, 1)));     // beyond
  const auto other = book.take(parameter(2, 3, -0.1f, "GAIN"));
  REQUIRE(other);
  CHECK(other->name.view() == "GAIN");
  CHECK(other->value.view() == "-0.1");
  CHECK(other->index == 2);
  CHECK(other->count == 3);
  CHECK_FALSE(other->whole);
  book.forget(2);
  CHECK_FALSE(book.next(now));  // the round is over
  CHECK(book.next(now + 500 * ms) == std::int16_t{2});
}

TEST_CASE("each calibration stands at its own place, and a whole number is one") {
  ParameterBook book;
  Notices out;
  const char* names[] = {"ACC_X_BIAS",  "ACC_Y_BIAS",  "ACC_Z_BIAS",
                         "GYRO_X_BIAS", "GYRO_Y_BIAS", "GYRO_Z_BIAS"};
  for (std::uint16_t i = 0; i < 6; ++i)
    (void)book.take(parameter(i, 8, 0.125f * static_cast<float>(i + 1), names[i]));
  (void)book.take(parameter(6, 8, -3.5f, pitot_zero));
  ParamValue whole = parameter(7, 8, 0);
  whole.param_type = param_int32;
  whole.param_value = static_cast<std::uint32_t>(-42);
  const auto taken = book.take(whole);
  REQUIRE(taken);
  CHECK(taken->whole);
  CHECK(taken->value.view() == "-42");
  book.report(out);
  REQUIRE(out.size() == 2);
  CHECK(text(out, 0) == "fcu_serial.params_logged(8)");
  CHECK(text(out, 1) == "fcu_serial.calibration(0.125 0.250 0.375, 0.5000 0.6250 0.7500, -3.5)");
}

TEST_CASE("the report of a link: rate of a second, gaps beyond 6 ms, the longest turnaround since the last") {
  LinkReport r;
  LinkState link;
  link.heard_ns = 3 * second;
  link.round_trip_ns = 2 * ms;
  link.drift_ppm = 12;
  link.offset_ns = 77;
  link.frames = 1;
  link.bad = 2;
  link.missing = 3;
  link.lost_in_queue = 4;
  link.connections = 5;
  link.reboots = 6;
  link.open = true;
  r.unusable = 7;
  r.commands = 8;
  r.unsent = 9;
  CHECK(r.due(0));
  std::int64_t t = 50 * ms;
  for (int k = 0; k < 200; ++k) r.imu(t += 5 * ms);
  LinkStatus s = r.take(link, 3 * second + 40 * ms, 0);
  CHECK(s.imu_rate_hz == 0);  // no second is over
  CHECK(s.imu_gaps == 0);
  CHECK(s.worst_gap_s == Approx(0.005));
  CHECK(s.heard_age_s == Approx(0.04));
  CHECK(s.round_trip_s == Approx(0.002));
  CHECK(s.drift_ratio == Approx(12e-6));
  CHECK(s.offset_ns == 77);
  CHECK(s.open);
  CHECK_FALSE(s.synchronised);
  CHECK((s.frames == 1 && s.bad == 2 && s.missing == 3 && s.dropped == 4 && s.connections == 5));
  CHECK((s.reboots == 6 && s.unusable == 7 && s.commands == 8 && s.unsent == 9));
  CHECK_FALSE(r.due(100 * ms - 1));
  CHECK(r.due(100 * ms));
  r.imu(t += 6 * ms);
  r.imu(t += 6 * ms + 1);
  r.imu(t += 9 * ms);
  r.imu(t += 5 * ms);
  link.open = false;
  link.synchronised = true;
  r.turnaround(3 * ms);
  r.turnaround(8 * ms);
  r.turnaround(5 * ms);
  s = r.take(link, 2 * second, second);
  CHECK(s.imu_rate_hz == Approx(204));
  CHECK(s.imu_gaps == 2);
  CHECK(s.worst_gap_s == Approx(0.009));
  CHECK(s.turnaround_s == Approx(0.008));
  CHECK_FALSE(s.open);
  CHECK(s.synchronised);
  CHECK(s.heard_age_s == 0);
  for (int k = 0; k < 100; ++k) r.imu(t += 5 * ms);
  CHECK(r.take(link, 0, second + 999 * ms).imu_rate_hz == Approx(204));
  s = r.take(link, 0, 3 * second);
  CHECK(s.imu_rate_hz == Approx(50));
  CHECK(s.turnaround_s == 0);
  link.heard_ns = 0;
  CHECK(r.take(link, 0, 3 * second).heard_age_s == 1e9);
}

TEST_CASE("channels go to their sticks by the map and by the sense of each surface, and end at full throw") {
  RcChannels m;
  m.chan1_raw = 1250;
  m.chan2_raw = 1600;
  m.chan3_raw = 1900;
  m.chan4_raw = 1300;
  m.chan5_raw = 1000;
  m.chan6_raw = 2000;
  m.chan7_raw = 1450;
  m.chan8_raw = 1700;
  const Rc one = to_rc(m, {}, {}, true);
  CHECK(one.roll_frac == Approx(-0.5));
  CHECK(one.pitch_frac == Approx(-0.2));
  CHECK(one.yaw_frac == Approx(0.4));
  CHECK(one.throttle_frac == Approx(0.9));
  CHECK(one.aux1_frac == Approx(-1));
  CHECK(one.aux2_frac == Approx(1));
  CHECK(one.aux3_frac == Approx(-0.1));
  CHECK(one.aux4_frac == Approx(0.4));
  CHECK(one.link);
  const Rc reversed = to_rc(m, {}, {-1, -1, -1}, false);
  CHECK(reversed.roll_frac == Approx(0.5));
  CHECK(reversed.pitch_frac == Approx(0.2));
  CHECK(reversed.yaw_frac == Approx(-0.4));
  RcMap map;
  map.take("RC_X_CHN", 7);
  map.take("RC_Y_CHN", 0);
  map.take("RC_Z_CHN", 1);
  map.take("RC_F_CHN", 6);
  map.take("RC_NUM_CHN", 3);
  const Rc other = to_rc(m, map, {}, true);
  CHECK(other.roll_frac == Approx(0.4));
  CHECK(other.pitch_frac == Approx(0.5));
  CHECK(other.yaw_frac == Approx(-0.2));
  CHECK(other.throttle_frac == Approx(0.45));
  const auto roll = [](std::uint16_t us, std::int32_t channel) {
    RcChannels c;
    c.chan1_raw = us;
    RcMap x;
    x.x = channel;
    return to_rc(c, x, {}, true).roll_frac;
  };
  CHECK(roll(500, 0) == -1);
  CHECK(roll(499, 0) == 0);  // none
  CHECK(roll(2500, 0) == 1);
  CHECK(roll(2501, 0) == 0);
  CHECK(roll(2000, 8) == 0);
  CHECK(roll(2000, -1) == 0);
  CHECK(integer_of(parameter(0, 1, 5.9f)) == 5);
  CHECK(integer_of(parameter(0, 1, -999'999.0f)) == -999'999);
  CHECK(integer_of(parameter(0, 1, 1e6f)) == 0);
  CHECK(integer_of(parameter(0, 1, -1e6f)) == 0);
}

TEST_CASE("at most ten watched names are on their way, asked again after 200 ms and after a restart") {
  std::vector<std::string> names;
  for (int i = 0; i < 12; ++i) names.push_back("P" + std::to_string(i));
  WatchList list(names);
  const auto burst = [&](std::int64_t now) {
    std::string asked;
    for (std::string_view name = list.next(now); !name.empty(); name = list.next(now))
      asked += std::string(name) + " ";
    return asked;
  };
  const std::string first_ten = "P0 P1 P2 P3 P4 P5 P6 P7 P8 P9 ", last_eight = "P11 P2 P4 P5 P6 P7 P8 P9 ";
  CHECK(burst(0) == first_ten);
  list.answered("P3");
  CHECK(burst(100 * ms) == "P10 ");
  CHECK(burst(200 * ms - 1) == "");
  list.answered("P0");
  list.answered("P1");
  CHECK(burst(200 * ms) == last_eight);
  for (const std::string& name : names) list.answered(name);
  CHECK(burst(900 * ms) == "");
  list.restart();
  CHECK(burst(900 * ms) == first_ten);
}

TEST_CASE(
    "a firmware's version is the number before the first dot, and the one that was tried by its whole") {
  CHECK(major_version("v2.0.1") == 2);
  CHECK(major_version("V13.4") == 13);
  CHECK(major_version("1234.5") == 1234);
  for (const char* none : {"", "v", "2", "x2.0", "12345.6", ".5"}) CHECK_FALSE(major_version(none));
  CHECK(tried("v2.0.1"));
  CHECK(tried("2.0.1-7-gabc"));
  CHECK_FALSE(tried("2.0.10"));
  CHECK_FALSE(tried("2.0"));
}

}  // namespace vehicle_values_test

// SPDX-License-Identifier: BSD-3-Clause
#define FULMAR_COUNT_ALLOCATIONS
#include "plugins/sim_aero/aircraft.hpp"

#include <doctest/doctest.h>

#include <numbers>

#include "fly.hpp"
#include "fulmar/testing.hpp"
#include "plugins/sim_aero/truth_state.hpp"

namespace aircraft_test {

using namespace fulmar;
using namespace fulmar::sim;
using doctest::Approx;

namespace {

const Actuators cruise{0.57, 0.0041, 0.1212, 0};

/// On the ground, or in the air; not armed.
std::unique_ptr<Bench<Aircraft>> bench(double start_height = 0, SensorSet set = SensorSet::rosflight,
                                       std::uint64_t seed = 1) {
  auto b = std::make_unique<Bench<Aircraft>>(seed);
  b->params.airframe.value = anaconda();
  b->params.start.start_height.value = start_height;
  b->params.sensors.value = set;
  return b;
}

struct Seen {
  int imu = 0, gnss = 0, mag = 0, baro = 0, pitot = 0, rc = 0, status = 0, truth = 0;
  void count(const Aircraft::Outputs& out) {
    imu += out.imu.written;
    gnss += out.gnss.written;
    mag += out.mag.written;
    baro += out.baro.written;
    pitot += out.pitot.written;
    rc += out.rc.written;
    status += out.status.written;
    truth += out.truth.written;
  }
};

/// Every published float is finite: by the message's own table.
bool finite(const void* data, const fulmar_type& type) {
  for (std::uint32_t i = 0; i < type.field_count; ++i) {
    const fulmar_field& f = type.fields[i];
    for (std::uint32_t k = 0; k < f.count; ++k) {
      const char* at = static_cast<const char*>(data) + f.offset + k * f.stride;
      double number = 0;
      if (f.kind == FULMAR_F64) std::memcpy(&number, at, sizeof number);
      if (!std::isfinite(number)) return false;
      if (f.kind == FULMAR_STRUCT && !finite(at, *f.type)) return false;
    }
  }
  return true;
}

template <class T>
bool finite(const T& message) {
  return finite(&message, *detail::type_table<T>());
}

/// FNV-1a over everything that is published.
std::uint64_t fingerprint(Aircraft::Outputs& out, std::uint64_t hash) {
  detail::for_each(out, [&](auto& port, std::size_t) {
    if constexpr (requires { port.written; }) {
      if (!port.written) return;
      const auto* bytes = reinterpret_cast<const unsigned char*>(&port.value);
      for (std::size_t i = 0; i < sizeof port.value; ++i) hash = (hash ^ bytes[i]) * 1099511628211ULL;
    }
  });
  return hash;
}

std::uint64_t flight_hash(std::uint64_t seed) {
  auto b = bench(50, SensorSet::ublox, seed);
  b->params.wind.turbulence.value = Turbulence::moderate;
  arm(*b);
  std::uint64_t hash = 14695981039346656037ULL;
  for (int i = 0; i < 4000; ++i) {
    pass(*b, &cruise);
    hash = fingerprint(b->out, hash);
  }
  return hash;
}

}  // namespace

TEST_CASE("time advances by exactly one period per read, from before zero through zero") {
  auto b = bench();
  pass(*b);
  CHECK(b->tick.now_ns == -5000000000 + 2500000);
  for (int i = 1; i < 4000; ++i) pass(*b);
  CHECK(b->tick.now_ns == 5000000000);
}

TEST_CASE("each sensor speaks at its rate, to the sample") {
  for (SensorSet set : {SensorSet::perfect, SensorSet::rosflight, SensorSet::ublox}) {
    auto b = bench(0, set);
    Seen seen;
    for (int i = 0; i < 4000; ++i) {  // 10 s
      pass(*b);
      seen.count(b->out);
    }
    CHECK(seen.imu == 4000);
    CHECK(seen.gnss == (set == SensorSet::ublox ? 99 : 100));  // the last one is on its way
    CHECK(seen.mag == (set == SensorSet::ublox ? 1000 : 500));
    CHECK(seen.baro == (set == SensorSet::rosflight ? 1000 : 500));
    CHECK(seen.pitot == 1000);
    CHECK(seen.rc == 500);
    CHECK(seen.truth == 500);
    CHECK(seen.status >= 100);
    CHECK(seen.status <= 101);
  }
}

TEST_CASE("a slower loop gets at most one sample per tick and loses no time") {
  auto b = bench();
  b->params.rate.value = 100;
  Seen seen;
  for (int i = 0; i < 1000; ++i) {
    pass(*b);
    seen.count(b->out);
  }
  CHECK(b->tick.now_ns == 5000000000);
  CHECK(seen.imu == 1000);
  CHECK(seen.gnss == 100);
}

TEST_CASE("armed on request, at flight time zero and not before") {
  auto b = bench();
  arm(*b);
  pass(*b);
  CHECK(b->answer(b->in.arm) == "accepted");
  while (b->tick.now_ns < -2500000) {
    pass(*b);
    if (b->out.status.written) CHECK_FALSE(b->out.status.value.armed);
  }
  pass(*b);
  CHECK(b->tick.now_ns == 0);
  REQUIRE(b->out.status.written);  // on change
  CHECK(b->out.status.value.armed);
  CHECK_FALSE(b->out.status.value.on_ground);
  CHECK_FALSE(b->out.status.value.contact_known);
  CHECK(b->out.contact.value.touching);
}

TEST_CASE("nobody asks, nobody arms, and the motor does not turn") {
  auto b = bench();
  const Actuators full{1, 0, 0, 0};
  for (int i = 0; i < 4000; ++i) pass(*b, &full);
  CHECK_FALSE(b->out.status.value.armed);
  CHECK(b->component().plant().propeller_radps() == 0);
  CHECK(b->component().plant().state().v_n.norm() == 0);
}

TEST_CASE(
    "silence for a tenth of a second is failsafe: motor off, surfaces neutral, until commands come back") {
  auto b = bench(100);
  arm(*b);
  while (b->tick.now_ns < 1000000000) pass(*b, &cruise);
  CHECK_FALSE(b->out.status.value.failsafe);
  VehicleStatus status;
  const auto silent = [&](int n) {
    for (int i = 0; i < n; ++i) {
      pass(*b);
      if (b->out.status.written) status = b->out.status.value;
    }
  };
  silent(38);  // 95 ms
  CHECK_FALSE(status.failsafe);
  CHECK(b->component().plant().propeller_radps() > 500);
  silent(200);
  CHECK(status.failsafe);
  CHECK_FALSE(status.in_control);
  CHECK(b->component().plant().propeller_radps() < 200);
  CHECK(b->component().plant().deflections().elevator == Approx(0));
  pass(*b, &cruise);
  pass(*b, &cruise);
  CHECK(b->out.status.written);
  CHECK_FALSE(b->out.status.value.failsafe);
}

TEST_CASE("a command that is not a number is silence") {
  auto b = bench(100);
  arm(*b);
  while (b->tick.now_ns < 100000000) pass(*b, &cruise);
  Actuators broken = cruise;
  broken.elevator_rad = std::numeric_limits<double>::quiet_NaN();
  for (int i = 0; i < 400; ++i) {
    pass(*b, &broken);
    CHECK(b->component().plant().state().p_n.allFinite());
  }
  CHECK(b->component().plant().deflections().elevator == Approx(0));
}

TEST_CASE("a start in the air is carried along its steady flight and passes the start at flight time zero") {
  auto b = bench(70, SensorSet::perfect);
  b->params.start.start_heading.value = 1;
  b->params.wind.wind_ned.value = {3, -4, 0};
  arm(*b);
  for (int i = 0; i < 1000; ++i) pass(*b, &cruise);
  CHECK(b->out.imu.value.specific_force_mps2.z < -9);
  while (b->tick.now_ns < 0) pass(*b, &cruise);
  const RigidBody at_zero = b->component().plant().state();
  CHECK(at_zero.p_n.head<2>().norm() < 1e-6);
  CHECK(-at_zero.p_n.z() == Approx(70));
  CHECK(b->component().plant().air_velocity_b().norm() == Approx(17));
  while (b->tick.now_ns < 3000000000) pass(*b, &cruise);
  CHECK(-b->component().plant().state().p_n.z() == Approx(70).epsilon(0.01));
}

TEST_CASE("a wind is a velocity, or a speed and where it comes from") {
  const auto wind = [](double speed, double from, double north = 0, double east = 0) {
    Aircraft::Params p;
    p.wind.wind_speed.value = speed;
    p.wind.wind_from.value = from;
    p.wind.wind_ned.value = {north, east, 0};
    return steady_wind(p.wind);
  };
  CHECK(wind(-1, 2, 3, -4) == Eigen::Vector3d(3, -4, 0));  // no speed: the velocity counts
  CHECK((wind(8, 270 * std::numbers::pi / 180) - Eigen::Vector3d(0, 8, 0)).norm() < 1e-9);  // a west wind
  CHECK((wind(8, 0, 3, -4) - Eigen::Vector3d(-8, 0, 0)).norm() < 1e-9);                     // in its place
  CHECK(wind(0, 1, 3, -4).norm() == 0);                                                     // a calm
}

TEST_CASE("what a wind of a given speed does in flight can be changed there") {
  auto b = bench(70, SensorSet::perfect);
  b->params.wind.wind_speed.value = 5;
  b->params.wind.wind_from.value = std::numbers::pi / 2;
  arm(*b);
  pass(*b, &cruise);
  CHECK((b->component().plant().wind_n() - Eigen::Vector3d(0, -5, 0)).norm() < 1e-9);
  b->params.wind.wind_speed.value = 7;
  b->component().retune(b->params);
  CHECK((b->component().plant().wind_n() - Eigen::Vector3d(0, -7, 0)).norm() < 1e-9);
}

TEST_CASE("an airframe without lift or thrust is refused: some of its fields are no aircraft") {
  const auto fault = [](auto&& change) {
    auto b = bench(0);
    change(b->params.airframe.value);
    CHECK(b->configure() == Status::failed);
    return std::string(b->error());
  };
  CHECK(fault([](Airframe& a) {
          a = Airframe{};
          a.mass_kg = 5;
        }).find("sim_aero.lift_missing") != std::string::npos);
  CHECK(fault([](Airframe& a) { a.propulsion = {}; }).find("sim_aero.thrust_missing") != std::string::npos);
}

TEST_CASE("an airspeed that the aircraft cannot fly is refused with a sentence") {
  auto b = bench(70);
  b->params.start.start_airspeed.value = 6;
  CHECK(b->configure() == Status::failed);
  CHECK(b->error().find("start_airspeed: sim_aero.level_flight_impossible(6, ") == 0);
}

TEST_CASE("the ublox fix arrives 150 ms after the time that it belongs to") {
  auto b = bench(70, SensorSet::ublox);
  arm(*b);
  int fixes = 0;
  for (int i = 0; i < 4000; ++i) {
    pass(*b, &cruise);
    if (!b->out.gnss.written) continue;
    ++fixes;
    CHECK(b->tick.now_ns - b->out.gnss.valid_at_ns == 150000000);
    CHECK(b->out.gnss.value.utc_ns == 1767225600000000000 + b->out.gnss.valid_at_ns);
  }
  CHECK(fixes > 90);
}

TEST_CASE("one seed gives the same bytes, another seed others") {
  CHECK(flight_hash(7) == flight_hash(7));
  CHECK(flight_hash(7) != flight_hash(8));
}

TEST_CASE("a flight allocates nothing and publishes nothing but finite numbers") {
  auto b = bench(50);
  b->params.wind.turbulence.value = Turbulence::severe;
  Aircraft& aircraft = b->component();
  aircraft.configure(b->params);
  Aircraft::Outputs out{};
  Aircraft::Inputs in{};
  const fulmar_input nothing{};
  in.actuators.input = &nothing;
  in.arm.input = &nothing;
  Tick tick;
  bool all_finite = true;
  const auto count = allocations([&] {
    for (int i = 0; i < 8000; ++i) {
      aircraft.read(tick, b->params, out);
      aircraft.write(tick, in, b->params);
      all_finite = all_finite && finite(out.imu.value) && finite(out.gnss.value) && finite(out.mag.value) &&
                   finite(out.baro.value) && finite(out.pitot.value) && finite(out.truth.value) &&
                   finite(out.status.value);
    }
  });
  CHECK(count == 0);
  CHECK(all_finite);
}

TEST_CASE("the truth is one consistent picture") {
  auto b = bench(70);
  b->params.wind.wind_ned.value = {3, -4, 0};
  b->params.wind.turbulence.value = Turbulence::light;
  arm(*b);
  for (int i = 0; i < 3201; ++i) pass(*b, &cruise);
  while (!b->out.truth.written) pass(*b, &cruise);
  const VehicleState& s = b->out.truth.value;
  CHECK(s.origin_latitude_deg == Approx(40.2463724));
  CHECK(s.origin_altitude_m == 1387);
  CHECK((s.position_valid && s.velocity_valid && s.attitude_valid && s.height_valid && s.airspeed_valid &&
         s.wind_valid && s.origin_valid));
  CHECK(s.height_m == -s.position_m.down);
  CHECK(s.course_rad == Approx(std::atan2(s.velocity_mps.east, s.velocity_mps.north)));
  // attitude and angles are the same rotation
  const Eigen::Quaterniond q = Eigen::AngleAxisd(s.yaw_rad, Eigen::Vector3d::UnitZ()) *
                               Eigen::AngleAxisd(s.pitch_rad, Eigen::Vector3d::UnitY()) *
                               Eigen::AngleAxisd(s.roll_rad, Eigen::Vector3d::UnitX());
  CHECK(q.angularDistance(eigen(s.attitude)) < 1e-9);
  // the wind triangle: ground velocity less the velocity of the air, gust included, is the airspeed along
  // alpha and beta
  const Eigen::Vector3d v_r = q.conjugate() * (eigen(s.velocity_mps) - eigen(s.wind_mps));
  CHECK(v_r.norm() == Approx(s.airspeed_mps));
  CHECK(std::atan2(v_r.z(), v_r.x()) == Approx(s.alpha_rad));
  CHECK(std::asin(v_r.y() / v_r.norm()) == Approx(s.beta_rad));
  CHECK((eigen(s.wind_mps) - Eigen::Vector3d(3, -4, 0)).norm() > 0.05);
  CHECK(s.gyro_bias_radps.x != 0);
  CHECK(s.accel_bias_mps2.z != 0);
}

TEST_CASE("the gyro and the accelerometer show the truth plus the bias that the truth names") {
  auto b = bench(0);
  double gyro = 0, accel = 0;
  int n = 0;
  VehicleState truth;
  for (int i = 0; i < 1900; ++i) {
    pass(*b);
    gyro += b->out.imu.value.rate_radps.y;
    accel += b->out.imu.value.specific_force_mps2.z;
    ++n;
    if (b->out.truth.written) truth = b->out.truth.value;
  }
  CHECK(std::abs(gyro / n - truth.gyro_bias_radps.y) < 5 * 0.00226 / std::sqrt(n) + 1e-4);
  CHECK(std::abs(accel / n + 9.80665 - truth.accel_bias_mps2.z) < 5 * 0.2 / std::sqrt(n));
}

TEST_CASE("sensors, radio and motor can be made to fail in flight") {
  auto b = bench(200);
  arm(*b);
  while (b->tick.now_ns < 500000000) pass(*b, &cruise);
  b->params.works.gnss_works.value = b->params.works.pitot_works.value = b->params.rc_link.value =
      b->params.motor.value = false;
  b->params.sticks.aux1.value = 0.8;
  b->retune();
  Seen seen;
  for (int i = 0; i < 400; ++i) {
    pass(*b, &cruise);
    seen.count(b->out);
  }
  CHECK(seen.gnss == 0);
  CHECK(seen.pitot == 0);
  CHECK(seen.rc == 0);
  CHECK(seen.mag == 50);
  CHECK(b->component().plant().propeller_radps() < 100);
  b->params.rc_link.value = true;
  b->retune();
  for (int i = 0; i < 8; ++i) pass(*b, &cruise);
  CHECK(b->out.rc.value.aux1_frac == 0.8);
}

TEST_CASE("the pilot who overrides flies with the sticks, and commands have no effect") {
  auto b = bench(200);
  arm(*b);
  while (b->tick.now_ns < 100000000) pass(*b, &cruise);
  b->params.sticks.pilot_flies.value = true;
  b->params.sticks.stick_roll.value = 0.5;
  b->params.sticks.stick_pitch.value = 0.25;
  b->retune();
  VehicleStatus status;
  std::uint32_t reports = 0;
  for (int i = 0; i < 80; ++i) {
    pass(*b, &cruise);
    if (b->out.status.written) status = b->out.status.value;
    reports += b->out.notices.count;
  }
  CHECK(status.override);
  CHECK(reports == 1);
  CHECK_FALSE(status.failsafe);
  CHECK(b->component().plant().deflections().aileron ==
        Approx(0.5 * anaconda().aileron.limit_rad).epsilon(1e-3));
  CHECK(b->component().plant().deflections().elevator ==
        Approx(-0.25 * anaconda().elevator.limit_rad).epsilon(1e-3));  // nose up
  CHECK(b->component().plant().state().omega_b.x() > 0.5);
}

TEST_CASE(
    "the contact comes when it changes: it stands, lifts off, crashes; then with part, sink, place and "
    "time") {
  auto b = bench(20);
  arm(*b);
  const Actuators dive{0, 0, 0.5, 0};
  int count = 0, status_s = 0;
  ContactTruth contact;
  VehicleState before;
  std::int64_t at_ns = 0;
  for (int i = 0; i < 6000 && !contact.crashed; ++i) {
    pass(*b, &dive);
    if (b->out.truth.written) before = b->out.truth.value;
    if (b->out.status.written && b->out.status.value.crashed) ++status_s;
    if (!b->out.contact.written) continue;
    contact = b->out.contact.value;
    at_ns = std::int64_t{2500000} * (i + 1) - 5000000000;
    ++count;
  }
  REQUIRE(contact.crashed);
  CHECK(count == 2);  // in the air, then this
  CHECK(status_s == 1);
  CHECK(contact.part.view().starts_with("nose"));
  CHECK(contact.touched_s == doctest::Approx(1e-9 * static_cast<double>(at_ns)));
  CHECK(contact.sink_mps == doctest::Approx(-before.climb_rate_mps).epsilon(0.1));
  CHECK(contact.sink_mps > 3);
  CHECK(contact.pitch_rad < -0.3);
  CHECK(std::abs(contact.position_m.north - before.position_m.north) < 1);
  CHECK(std::abs(contact.ground_speed_mps - before.ground_speed_mps) < 1);
}

TEST_CASE(
    "deflections in the motion follow the command with the servo's lag, accelerations are those of the "
    "rates") {
  auto b = bench(200, SensorSet::perfect);
  b->params.truth_rate.value = 400;
  b->params.motion_rate.value = 400;
  arm(*b);
  Actuators flat{0.5, 0, 0, 0};
  double rate = 0, least = 1;
  for (int i = 0; i < 2400; ++i) {
    flat.aileron_rad = i > 2100 ? 0.1 : 0;
    pass(*b, &flat);
    const double p = b->out.truth.value.rate_radps.x, dt = 0.0025;
    const MotionTruth& m = b->out.motion.value;
    if (i > 2110 && i < 2300) CHECK(std::abs((p - rate) / dt - m.angular_acceleration_radps2.x) < 0.6);
    if (i == 2103) least = m.aileron_rad;
    rate = p;
  }
  CHECK(least > 0);
  CHECK(least < 0.09);
  CHECK(b->out.motion.value.aileron_rad == doctest::Approx(0.1).epsilon(0.01));
  CHECK(b->out.motion.value.propeller_radps > 100);
}

TEST_CASE("the motion comes at its own rate beside the truth's") {
  auto b = bench(20);
  b->params.motion_rate.value = 20;
  arm(*b);
  int truths = 0, motions = 0;
  for (int i = 0; i < 400; ++i) {
    pass(*b);
    truths += b->out.truth.written;
    motions += b->out.motion.written;
  }
  CHECK(truths == 50);
  CHECK(motions == 20);
}

TEST_CASE("a crash is told, and a crashed aircraft cannot be armed again") {
  auto b = bench(20);
  arm(*b);
  const Actuators dive{0, 0, 0.5, 0};
  VehicleStatus status;
  for (int i = 0; i < 6000 && !status.crashed; ++i) {
    pass(*b, &dive);
    if (b->out.status.written) status = b->out.status.value;
  }
  CHECK(status.crashed);
  CHECK(status.health == Health::failed);
  arm(*b);
  pass(*b, &dive);
  CHECK(b->answer(b->in.arm).find("sim_aero.aircraft_crashed") != std::string::npos);
}

TEST_CASE("the magnetometer at rest sees the Earth's field at the origin") {
  auto b = bench(0, SensorSet::perfect);
  b->params.start.start_heading.value = 0.7;
  for (int i = 0; i < 10; ++i) pass(*b);
  const auto& m = b->out.mag.value.field_tesla;
  // WMM2025 at Provo, 2026.0: about 50 microtesla, 65.6 deg down, 10.3 deg east of north
  CHECK(std::hypot(m.x, m.y, m.z) == Approx(50.4e-6).epsilon(0.02).scale(0));
  CHECK(std::atan2(m.z, std::hypot(m.x, m.y)) == Approx(1.145).epsilon(0.01));
  CHECK(std::atan2(m.y, m.x) + 0.7 == Approx(0.18).epsilon(0.03).scale(0));
}

TEST_CASE("truth as navigation state keeps the stamp and claims small deviations") {
  Bench<TruthState> nav;
  VehicleState truth;
  truth.airspeed_mps = 17;
  truth.position_valid = true;
  nav.set(nav.in.truth, truth);
  REQUIRE(nav.step(0.01) == Status::ok);
  REQUIRE(nav.out.state.written);
  CHECK(nav.out.state.value.airspeed_mps == 17);
  CHECK(nav.out.state.value.position_valid);
  CHECK(nav.out.state.value.position_std_m.north == Approx(0.01));
  CHECK(nav.out.state.value.airspeed_std_mps < 0.1);
  CHECK(nav.out.state.valid_at_ns == 0);
  nav.step(0.01);
  CHECK_FALSE(nav.out.state.written);  // no new sample
}

TEST_CASE("it is disarmed as it is armed: by a request") {
  auto b = bench();
  arm(*b);
  for (int i = 0; i < 2200; ++i) pass(*b, &cruise);
  REQUIRE(b->out.status.value.armed);
  b->push(b->in.arm, ArmRequest{false});
  for (int i = 0; i < 40; ++i) pass(*b, &cruise);
  CHECK_FALSE(b->out.status.value.armed);
  CHECK_FALSE(b->out.status.value.in_control);
  arm(*b);
  for (int i = 0; i < 40; ++i) pass(*b, &cruise);
  CHECK(b->out.status.value.armed);
}

}  // namespace aircraft_test

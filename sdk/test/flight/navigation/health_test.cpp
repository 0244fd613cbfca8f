// SPDX-License-Identifier: BSD-3-Clause
// A fault of each sensor in the middle of a flight, and its end: the state on the port `health`, and its
// delay.
#include <doctest/doctest.h>

#include <string>

#include "flight_bench.hpp"

namespace health_test {

using namespace synthetic;

namespace {

using Alter = std::function<void(Samples&, Random&)>;

struct Spell {
  Alter alter{};
  Quality quality = ublox;
  SensorHealth NavigationHealth::*sensor = &NavigationHealth::baro;
  SensorState state = SensorState::silent;
  double length_s = 15;
  std::uint64_t seed = 1;
  bool imu = true;  ///< false: no inertial sample during the fault

  static constexpr double from_s = 60;
  double reported_s = -1, left_s = -1;  ///< after the start and after the end of the fault
  NavigationHealth before{}, during{}, last{};
  std::string otherwise{};  ///< other sensors with a report
  std::uint64_t allocated = 0;

  Spell& run();

 private:
  void judge(const NavigationHealth& health, double t);
};

constexpr std::array<std::pair<const char*, SensorHealth NavigationHealth::*>, 8> sensors{{
    {"gyro", &NavigationHealth::gyro},
    {"accel", &NavigationHealth::accel},
    {"gnss_position", &NavigationHealth::gnss_position},
    {"gnss_height", &NavigationHealth::gnss_height},
    {"gnss_velocity", &NavigationHealth::gnss_velocity},
    {"mag", &NavigationHealth::mag},
    {"baro", &NavigationHealth::baro},
    {"pitot", &NavigationHealth::pitot},
}};

Spell& Spell::run() {
  Plan plan;
  plan.duration_s = from_s + length_s + 20;
  plan.seed = seed;
  const std::vector<Truth> flight = fly(plan);
  Sensors reads(quality, plan, plan.seed + 100);
  Random random(plan.seed + 7);
  Bench<Ekf> bench;
  bench.params.origin.value = {plan.lat_deg, plan.lon_deg, plan.alt_m, true};
  bench.params.origin.is_given = true;
  bench.configure();
  const double dt = 1 / plan.rate_hz;
  for (std::size_t k = 0; k < flight.size(); ++k) {
    const Truth& x = flight[k];
    Samples s = reads.at(flight, k);
    const bool bad = x.t > from_s && x.t <= from_s + length_s;
    if (bad && alter) alter(s, random);
    if (!bad || imu) bench.set(bench.in.imu, s.imu, -dt);
    if (s.gnss) bench.set(bench.in.gnss, *s.gnss, s.gnss_age_s - dt);
    if (s.mag) bench.set(bench.in.mag, *s.mag, -dt);
    if (s.baro) bench.set(bench.in.baro, *s.baro, -dt);
    if (s.pitot) bench.set(bench.in.pitot, *s.pitot, -dt);
    VehicleStatus v;
    v.armed = x.t > plan.rest_s - 0.2;
    v.on_ground = x.t < plan.rest_s + 5;
    bench.set(bench.in.status, v);
    allocated += allocations([&] { bench.step(dt); });
    if (bench.validation_error() != "") otherwise += bench.validation_error();
    if (bench.out.health.written) judge(bench.out.health.value, x.t);
  }
  return *this;
}

void Spell::judge(const NavigationHealth& health, double t) {
  if (t <= from_s) before = health;
  if (t > from_s && t <= from_s + length_s) during = health;
  last = health;
  const SensorState now = (health.*sensor).state;
  if (t > from_s && reported_s < 0 && now == state) reported_s = t - from_s;
  if (now != SensorState::ok && t > from_s + length_s) left_s = t - from_s - length_s;
  if (t < 2) return;  // the first samples arrive
  for (const auto& [name, other] : sensors)
    if (other != sensor && (health.*other).state != SensorState::ok &&
        otherwise.find(name) == std::string::npos)
      otherwise += std::string(name) + " ";
}

/// Repeats the first reading.
template <class T>
Alter held(std::optional<T> Samples::*which) {
  return [which, first = std::optional<T>()](Samples& s, Random&) mutable {
    if (!first) first = s.*which;
    if (s.*which) s.*which = first;
  };
}
template <class T>
Alter dropped(std::optional<T> Samples::*which) {
  return [which](Samples& s, Random&) { (s.*which).reset(); };
}
Alter of_fix(std::function<void(Gnss&, Random&)> change) {
  return [change](Samples& s, Random& random) {
    if (s.gnss) change(*s.gnss, random);
  };
}
/// The fault is reported within `reported_s` and cleared within `left_s`, without a report of the others.
void check(Spell& spell, double reported_s, double left_s) {
  spell.run();
  CHECK((spell.before.*spell.sensor).state == SensorState::ok);
  CHECK(spell.reported_s > 0);
  CHECK(spell.reported_s <= reported_s);
  CHECK(spell.left_s <= left_s);
  CHECK((spell.last.*spell.sensor).state == SensorState::ok);
  CHECK(spell.allocated == 0);
}

}  // namespace

TEST_CASE("a flight without a fault has no report") {
  for (const Quality& quality : {rosflight, ublox})
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
      Spell spell{.quality = quality, .state = SensorState::refused, .seed = seed};
      spell.run();
      CAPTURE(seed);
      CHECK(spell.otherwise == "");
      CHECK(spell.reported_s < 0);
      CHECK((spell.during.*spell.sensor).state == SensorState::ok);
      CHECK(spell.last.baro.state == SensorState::ok);
      CHECK(spell.last.baro.accepted > 3000);
      CHECK(spell.last.baro.refused == 0);
      CHECK(std::abs(spell.last.baro.innovation_ratio) < 4);
      CHECK(spell.last.baro.innovation_std_ratio < 1.3);
      CHECK(spell.last.gyro.state == SensorState::ok);
    }
}

TEST_CASE("a sensor without samples is reported as never, and the others are not") {
  Spell spell{};
  Bench<Ekf> bench;
  for (int i = 0; i < 100; ++i) {
    bench.set(bench.in.imu, Imu{{0, 0, -9.8 + 1e-3 * i}, {}}, -0.005);
    bench.step(0.005);
    if (bench.out.health.written) spell.last = bench.out.health.value;
  }
  for (const auto& named : sensors) {
    const std::string name = named.first;
    CAPTURE(name);
    const SensorState state = (spell.last.*named.second).state;
    CHECK(state == (name == "gyro" || name == "accel" ? SensorState::ok : SensorState::never));
  }
}

TEST_CASE(
    "silent: no sample for five of its intervals, an invalid fix; reported within 1.4 s, cleared at once") {
  for (const auto& [sensor, alter, reported_s] :
       {std::tuple{&NavigationHealth::baro, dropped(&Samples::baro), 0.6},
        std::tuple{&NavigationHealth::mag, dropped(&Samples::mag), 0.6},
        std::tuple{&NavigationHealth::pitot, dropped(&Samples::pitot), 0.6},
        std::tuple{&NavigationHealth::gnss_position, dropped(&Samples::gnss), 1.4},
        std::tuple{&NavigationHealth::gnss_velocity, of_fix([](Gnss&g, Random&) { g.fix = FixType::none; }),
                   1.4}}) {
    Spell spell{.alter = alter, .sensor = sensor, .state = SensorState::silent};
    check(spell, reported_s, 0.6);
    CHECK((spell.during.*sensor).state == SensorState::silent);
  }
}

TEST_CASE("a slow sensor is not silent between its samples, nor one that becomes slower for long") {
  Quality slow = ublox;
  slow.gnss_hz = 1;
  Spell receiver{.quality = slow, .sensor = &NavigationHealth::gnss_height, .state = SensorState::silent};
  receiver.run();
  CHECK(receiver.reported_s < 0);
  CHECK(receiver.otherwise == "");
  Spell slower{.state = SensorState::silent};
  slower.alter = [n = 0](Samples& s, Random&) mutable {
    if (s.baro && ++n % 25 != 0) s.baro.reset();  // 2 Hz
  };
  slower.run();
  CHECK(slower.reported_s > 0);
  CHECK(slower.during.baro.state == SensorState::ok);
}

TEST_CASE("silent: the inertial unit, reported by this port alone") {
  Spell spell{.sensor = &NavigationHealth::gyro, .state = SensorState::silent, .length_s = 3, .imu = false};
  check(spell, 0.6, 0.4);
  CHECK(spell.during.accel.state == SensorState::silent);
  CHECK(spell.otherwise == "accel ");  // the other sensors continue with reports
}

TEST_CASE("stuck: the same bytes five times in flight; reported within 1.4 s") {
  for (const auto& [sensor, alter, reported_s] :
       {std::tuple{&NavigationHealth::baro, held(&Samples::baro), 0.8},
        std::tuple{&NavigationHealth::mag, held(&Samples::mag), 0.8},
        std::tuple{&NavigationHealth::pitot, held(&Samples::pitot), 0.8},
        std::tuple{&NavigationHealth::gnss_position, held(&Samples::gnss), 1.4},
        std::tuple{&NavigationHealth::gnss_velocity, held(&Samples::gnss), 1.4}}) {
    Spell spell{.alter = alter, .sensor = sensor, .state = SensorState::stuck, .length_s = 5};
    check(spell, reported_s, 12);
    CHECK(spell.reported_s > 0.4);
    CHECK((spell.during.*sensor).state == SensorState::stuck);
  }
}

TEST_CASE("stuck: each triad of the inertial unit by itself") {
  Spell gyro{.sensor = &NavigationHealth::gyro, .state = SensorState::stuck, .length_s = 1};
  gyro.alter = [](Samples& s, Random&) { s.imu.rate_radps = {0.1, 0, 0}; };
  check(gyro, 0.8, 0.8);
  CHECK(gyro.during.accel.state == SensorState::ok);
  Spell accel{.sensor = &NavigationHealth::accel, .state = SensorState::stuck, .length_s = 1};
  accel.alter = [](Samples& s, Random&) { s.imu.specific_force_mps2 = {0, 0, -9.8}; };
  check(accel, 0.8, 0.8);
  CHECK(accel.during.gyro.state == SensorState::ok);
}

TEST_CASE("what reads the same while the aircraft stands is not stuck") {
  Bench<Ekf> bench;
  Random random(3);
  SensorState worst = SensorState::ok;
  for (int i = 0; i < 2000; ++i) {
    const auto n = [&](double std) { return std * random.normal(); };
    bench.set(bench.in.imu, Imu{{n(0.01), n(0.01), n(0.01) - 9.8}, {n(1e-3), n(1e-3), n(1e-3)}}, -0.005);
    bench.set(bench.in.baro, Baro{9e4, 300}, -0.005);
    bench.set(bench.in.pitot, Pitot{0, 0, 300}, -0.005);
    bench.step(0.005);
    if (bench.out.health.written)
      worst = std::max({worst, bench.out.health.value.baro.state, bench.out.health.value.pitot.state});
  }
  CHECK(worst == SensorState::ok);
}

TEST_CASE("noisy: ten times its noise; reported within 2.5 s, cleared within 6 s") {
  const auto baro = [](Samples& s, Random& random) {
    if (s.baro) s.baro->pressure_pa += 40 * random.normal();
  };
  const auto pitot = [](Samples& s, Random& random) {
    if (s.pitot) s.pitot->pressure_pa += 30 * random.normal();
  };
  const auto velocity =
      of_fix([](Gnss& g, Random& random) { g.velocity_mps.north += 1.5 * random.normal(); });
  const auto height = of_fix([](Gnss& g, Random& random) { g.altitude_m += 12 * random.normal(); });
  for (const auto& [sensor, alter] :
       {std::tuple{&NavigationHealth::baro, Alter(baro)}, std::tuple{&NavigationHealth::pitot, Alter(pitot)},
        std::tuple{&NavigationHealth::gnss_velocity, velocity},
        std::tuple{&NavigationHealth::gnss_height, height}}) {
    Spell spell{.alter = alter, .sensor = sensor, .state = SensorState::noisy};
    check(spell, 2.5, 6);
    CHECK(spell.otherwise == "");
    CHECK((spell.during.*sensor).state == SensorState::noisy);
    CHECK((spell.during.*sensor).innovation_std_ratio > 2);
  }
}

TEST_CASE("biased: an error of 4 sigma within the gate; reported within 9 s, cleared within 4 s") {
  for (const double off_m : {8.0, -9.0}) {
    Spell spell{.sensor = &NavigationHealth::gnss_height, .state = SensorState::biased};
    spell.alter = of_fix([off_m](Gnss& g, Random&) { g.altitude_m += off_m; });
    check(spell, 9, 4);  // the error of the receiver itself decides the delay
    CHECK(spell.during.gnss_height.refused == spell.before.gnss_height.refused);
    CHECK(spell.during.gnss_height.innovation_mean_ratio * off_m < -2);  // down
    CHECK(spell.during.gnss_height.state == SensorState::biased);
    CHECK(spell.otherwise == "");
  }
}

TEST_CASE("refused: an error beyond the gate; reported after 1 s, cleared when accepted or right again") {
  const auto baro = [k = 0](Samples& s, Random&) mutable {
    if (s.baro) s.baro->pressure_pa += 240 + ++k;  // with a growing error
  };
  const auto pitot = [](Samples& s, Random&) {
    if (s.pitot) s.pitot->pressure_pa += 400;
  };
  const auto blocked = [](Samples& s, Random& random) {
    if (s.pitot) s.pitot->pressure_pa = random.normal();
  };
  const auto position = of_fix([](Gnss& g, Random&) { g.longitude_deg += 60 / 85e3; });
  for (const auto& [sensor, alter] :
       {std::tuple{&NavigationHealth::baro, Alter(baro)}, std::tuple{&NavigationHealth::pitot, Alter(pitot)},
        std::tuple{&NavigationHealth::pitot, Alter(blocked)},
        std::tuple{&NavigationHealth::gnss_position, position}}) {
    Spell spell{.alter = alter, .sensor = sensor, .state = SensorState::refused, .length_s = 8};
    check(spell, 1.6, 0.6);
    CHECK(spell.reported_s > 0.9);
    CHECK(spell.otherwise == "");
    CHECK((spell.during.*sensor).state == SensorState::refused);
    CHECK((spell.during.*sensor).accepted == (spell.before.*sensor).accepted);
    CHECK((spell.during.*sensor).refused > (spell.before.*sensor).refused + 30);
    CHECK(std::abs((spell.during.*sensor).innovation_ratio) > 5);
  }
}

TEST_CASE(
    "refused: a barometer that steps, for 2 s, and again when it steps back; the height is not followed") {
  for (const double step_pa : {240.0, 40.0, -40.0}) {
    CAPTURE(step_pa);
    const auto stepped = [step_pa](Samples& s, Random&) {
      if (s.baro) s.baro->pressure_pa += step_pa;
    };
    Spell spell{
        .alter = stepped, .sensor = &NavigationHealth::baro, .state = SensorState::refused, .length_s = 8};
    check(spell, 1.6, 2.6);
    CHECK(spell.reported_s > 0.9);
    CHECK(spell.left_s > 1.9);
    CHECK(spell.otherwise == "");
    CHECK(spell.during.baro.state == SensorState::ok);
  }
}

TEST_CASE("biased: a position that drifts against the velocity; reported within 2 s, and not followed") {
  Spell spell{.sensor = &NavigationHealth::gnss_position, .state = SensorState::biased};
  spell.alter = [n = 0](Samples& s, Random&) mutable {
    if (s.gnss) s.gnss->latitude_deg += 3 / ublox.gnss_hz * ++n / 111e3;  // 3 m/s
  };
  check(spell, 2, 0.6);
  CHECK(spell.otherwise == "");
  CHECK(spell.during.gnss_position.accepted < spell.before.gnss_position.accepted + 3 * ublox.gnss_hz);
}

TEST_CASE("a velocity that is wrong is not laid to the position's charge") {
  Spell spell{.sensor = &NavigationHealth::gnss_velocity, .state = SensorState::refused, .length_s = 8};
  spell.alter = of_fix([](Gnss& g, Random&) { g.velocity_mps.north += 5; });
  check(spell, 1.6, 0.6);
  CHECK(spell.otherwise == "");
}

TEST_CASE("biased: a pitot that steps by 50 Pa either way, within 0.4 s; and it is not used") {
  for (const double off_pa : {50.0, -50.0}) {
    Spell spell{.sensor = &NavigationHealth::pitot, .state = SensorState::biased};
    spell.alter = [off_pa](Samples& s, Random&) {
      if (s.pitot) s.pitot->pressure_pa += off_pa;
    };
    check(spell, 0.4, 0.6);
    CHECK(spell.otherwise == "");
    CHECK(spell.during.pitot.accepted < spell.before.pitot.accepted + 30);
  }
}

TEST_CASE("biased: a pitot that ices over in seconds, before it reads nothing") {
  Spell spell{.sensor = &NavigationHealth::pitot, .state = SensorState::biased};
  spell.alter = [share = 1.0](Samples& s, Random&) mutable {
    if (s.pitot) s.pitot->pressure_pa *= share *= std::exp(-1 / ublox.pitot_hz);
  };
  check(spell, 3, 1);
  CHECK(spell.otherwise == "");
}

TEST_CASE("a pitot with a constant step is accepted after half a minute") {
  Spell spell{.sensor = &NavigationHealth::pitot, .state = SensorState::biased, .length_s = 40};
  spell.alter = [](Samples& s, Random&) {
    if (s.pitot) s.pitot->pressure_pa += 50;
  };
  spell.run();
  CHECK(spell.reported_s > 0);
  CHECK(spell.reported_s <= 0.4);
  CHECK(spell.during.pitot.state == SensorState::ok);
}

TEST_CASE("a moment of agreement does not restore a rejected pitot, six seconds do") {
  for (const double sign : {1.0, -1.0}) {
    navigation::TubeSteps pitot;
    double t = 0, air = 16;
    const auto reads = [&](double excess, double std, double for_s) {
      for (const double until = t + for_s; t < until; t += 0.02)
        pitot.sampled(air + sign * excess, air, 0.1, std, t);
    };
    reads(0, 1, 10);
    CHECK_FALSE(pitot.off());
    reads(5.5, 1, 2);
    CHECK(pitot.stepped());
    // The wind estimate becomes less certain for any pitot reading.
    reads(5.5, 3, 60);
    CHECK((pitot.stepped() || pitot.off()));
    for (double excess = 5.5; excess > 2; excess -= 0.5) reads(excess, 3, 1);
    reads(2, 3, 3);
    CHECK((pitot.stepped() || pitot.off()));
    reads(5.5, 3, 5);
    CHECK((pitot.stepped() || pitot.off()));
    for (double excess = 5.5; excess > 0; excess -= 0.5) reads(excess, 3, 1);
    reads(0, 3, 30);
    CHECK_FALSE(pitot.stepped());
    CHECK_FALSE(pitot.off());
  }
}

TEST_CASE("a pitot with an error beyond gusts is never accepted, however long it lasts") {
  Spell spell{.sensor = &NavigationHealth::pitot, .state = SensorState::biased, .length_s = 60};
  spell.alter = [](Samples& s, Random&) {
    if (s.pitot) s.pitot->pressure_pa += 120;
  };
  spell.run();
  CHECK(spell.reported_s <= 0.4);
  CHECK(spell.during.pitot.state != SensorState::ok);
  CHECK(spell.during.pitot.accepted < spell.before.pitot.accepted + 30);
}

TEST_CASE("biased: a field that is a third stronger than before, within 0.8 s") {
  Spell spell{.sensor = &NavigationHealth::mag, .state = SensorState::biased};
  spell.alter = [](Samples& s, Random&) {
    if (!s.mag) return;
    Vec3<Body>& m = s.mag->field_tesla;
    m = {1.33 * m.x, 1.33 * m.y, 1.33 * m.z};
  };
  check(spell, 0.8, 1.6);
  CHECK(spell.otherwise == "");
}

TEST_CASE("refused: stamps that go back again and again; left 3 s after") {
  Spell spell{.sensor = &NavigationHealth::gnss_height, .state = SensorState::refused};
  spell.alter = [n = 0](Samples& s, Random&) mutable {
    if (s.gnss && ++n % 2 == 0) s.gnss_age_s += 1;
  };
  spell.run();
  CHECK(spell.reported_s > 0);
  CHECK(spell.reported_s <= 2);
  CHECK(spell.left_s <= 3);
  CHECK(spell.during.gnss_height.state == SensorState::refused);
  CHECK(spell.last.gnss_height.state == SensorState::ok);
}

TEST_CASE("noisy: an inertial unit that is shaken, each triad by itself") {
  Spell accel{.sensor = &NavigationHealth::accel, .state = SensorState::noisy};
  accel.alter = [](Samples& s, Random& random) { s.imu.specific_force_mps2.z += 9 * random.normal(); };
  check(accel, 1, 1);
  CHECK(accel.during.gyro.state == SensorState::ok);
  Spell gyro{.sensor = &NavigationHealth::gyro, .state = SensorState::noisy, .length_s = 2};
  gyro.alter = [](Samples& s, Random& random) { s.imu.rate_radps.y += 1 * random.normal(); };
  check(gyro, 1, 1);
  CHECK(gyro.during.accel.state == SensorState::ok);
}

TEST_CASE("stuck: one axis of the gyros at its stop, while the others go on") {
  Spell spell{.sensor = &NavigationHealth::gyro, .state = SensorState::stuck, .length_s = 1};
  spell.alter = [](Samples& s, Random&) { s.imu.rate_radps.x = 0.02; };
  check(spell, 0.6, 0.8);
  CHECK(spell.during.accel.state == SensorState::ok);
}

TEST_CASE("health comes at 5 Hz, with an attitude or without, in gaps as well") {
  Bench<Ekf> bench;
  int published = 0, imu = 0;
  for (int i = 0; i < 4000; ++i) {
    if (i < 1000 || i > 3000) {
      bench.set(bench.in.imu, Imu{{0, 0, -9.8 + 1e-3 * (i % 7)}, {}}, -0.0025);
      ++imu;
    }
    bench.step(0.0025);
    published += bench.out.health.written;
  }
  CHECK(published == 50);
}

TEST_CASE("an axis that has always said the same is no axis at its stop, one that had noise is") {
  using fulmar::navigation::Triad;
  for (const bool noisy : {false, true}) {
    CAPTURE(noisy);
    Triad rates;
    Random random(1);
    for (int k = 0; k < 200; ++k)  // a steady turn
      rates.sampled(
          {noisy ? 0.001 * random.normal() : 0.0, 0.02, 0.3 + (noisy ? 0.001 * random.normal() : 0)}, 1);
    CHECK_FALSE(rates.clipped());
    for (int k = 0; k < 50; ++k) rates.sampled({noisy ? 0.001 * random.normal() : 0.0, 0.02, 0.31}, 1);
    CHECK(rates.clipped() == noisy);
  }
}

}  // namespace health_test

// SPDX-License-Identifier: BSD-3-Clause
// Each sensor that fails in flight is reported once, and its return; no report on the ground or without a
// failure.
#include "plugins/safety/sensor_watch.hpp"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "kit.hpp"
#include "sdk/test/said.hpp"

namespace sensor_watch_test {

namespace fs = std::filesystem;
using namespace fulmar;
using namespace fulmar::safety;

namespace {

struct Watching {
  Bench<SensorWatch> bench;
  VehicleState state = kit::level();
  NavigationHealth health = all(SensorState::ok);
  GroundState ground;
  std::vector<Notice> reported;

  Watching() { ground.contact = Contact::air; }
  static NavigationHealth all(SensorState s) {
    NavigationHealth h;
    for (SensorHealth* each :
         {&h.gyro, &h.accel, &h.gnss_position, &h.gnss_height, &h.gnss_velocity, &h.mag, &h.baro, &h.pitot})
      each->state = s;
    return h;
  }
  void fly(double seconds) {
    for (int i = 0; i < static_cast<int>(seconds * 10 + 0.5); ++i) {
      bench.set(bench.in.state, state);
      bench.set(bench.in.health, health);
      bench.set(bench.in.ground, ground);
      bench.step(0.1);
      for (std::uint32_t n = 0; n < bench.out.notices.count; ++n)
        reported.push_back(bench.out.notices.items[n]);
    }
  }
  int count(Severity severity) const {
    int n = 0;
    for (const Notice& each : reported) n += each.severity == severity ? 1 : 0;
    return n;
  }
};

using test::Said;
using test::typed;

/// The lines of `sensors` and `follow` in a flight of the hourglass with this fault from 40 to 60 s.
std::string flown(const std::string& fault, const std::string& more = "") {
  const fs::path file = fs::temp_directory_path() / ("fulmar_sensors_" + std::to_string(getpid()) + ".yaml");
  std::ofstream(file) << "extends: " FULMAR_SOURCE_DIR "/configs/missions/hourglass.yaml\nlive: off\n"
                      << "done: \"time > 70 s\"\nphases:\n"
                      << "  cruise: {next: [{to: faulty, when: \"time > 40 s\"}]}\n"
                      << "  faulty: {outer: slc, vehicle: {set: {" << fault
                      << "}}, next: [{to: after, when: \"time > 60 s\"}]}\n  after: {outer: slc}\n"
                      << more;
  const Said r = typed("run " + file.string() + " --no-log");
  fs::remove(file);
  std::string lines;
  std::istringstream all(r.out);
  for (std::string line; std::getline(all, line);)
    if (line.find(" s  sensors: ") != std::string::npos || line.find(" s  follow: ") != std::string::npos)
      lines += line + "\n";
  return lines;
}
int lines_of(const std::string& text, const std::string& words) {
  int n = 0;
  for (auto at = text.find(words); at != std::string::npos; at = text.find(words, at + 1)) ++n;
  return n;
}

}  // namespace

TEST_CASE("a sensor that fails in flight is reported once, and once when it is in order again") {
  for (const SensorState bad : {SensorState::silent, SensorState::stuck, SensorState::refused}) {
    for (SensorHealth NavigationHealth::*which :
         {&NavigationHealth::mag, &NavigationHealth::baro, &NavigationHealth::pitot,
          &NavigationHealth::gnss_position, &NavigationHealth::gnss_velocity}) {
      Watching w;
      w.fly(5);
      CHECK(w.reported.empty());
      (w.health.*which).state = bad;
      w.fly(0.2);
      CHECK(w.reported.empty());
      w.fly(20);
      CHECK(w.reported.size() == 1);
      CHECK(w.count(Severity::warning) == 1);
      (w.health.*which).state = SensorState::ok;
      w.fly(2.5);
      CHECK(w.reported.size() == 1);
      w.fly(1);
      CHECK(w.reported.size() == 2);
      CHECK(w.count(Severity::info) == 1);
    }
  }
}

TEST_CASE("an inertial sensor that fails calls the pilot") {
  for (SensorHealth NavigationHealth::*which : {&NavigationHealth::gyro, &NavigationHealth::accel}) {
    Watching w;
    (w.health.*which).state = SensorState::stuck;
    w.fly(5);
    REQUIRE(w.reported.size() == 1);
    CHECK(w.reported[0].severity == Severity::critical);
    CHECK(w.reported[0].cause == (which == &NavigationHealth::gyro ? Cause::gyro : Cause::accelerometer));
    CHECK(w.reported[0].text.view() ==
          "safety.sensor_failed(" + std::string(which == &NavigationHealth::gyro ? "gyro" : "accelerometer") +
              ", safety.stuck, safety.attitude_unreliable)");
  }
}

TEST_CASE("two sensors without anything in common that are rejected at once point to the inertial unit") {
  using H = NavigationHealth;
  const auto reports = [](const Watching& w) {
    int n = 0;
    for (const Notice& each : w.reported)
      n += each.severity == Severity::critical && each.text.view() == "safety.inertial_wrong" ? 1 : 0;
    return n;
  };
  const std::array<SensorHealth H::*, 5> all{&H::gnss_position, &H::gnss_velocity, &H::mag, &H::baro,
                                             &H::pitot};
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = i; j < all.size(); ++j) {
      CAPTURE(i);
      CAPTURE(j);
      Watching w;
      (w.health.*all[i]).state = (w.health.*all[j]).state = SensorState::refused;
      w.fly(0.9);
      CHECK(reports(w) == 0);
      w.fly(0.2);
      const int expected = i == j || j == 1 ? 0 : 1;  // position and velocity are of one receiver
      CHECK(reports(w) == expected);
      w.health = Watching::all(SensorState::ok);
      w.fly(40);
      CHECK(reports(w) == expected);
      (w.health.*all[i]).state = (w.health.*all[j]).state = SensorState::refused;  // once more
      w.fly(2);
      CHECK(reports(w) == 2 * expected);
    }
  Watching silent;  // a loss of power, no contradiction
  silent.health.mag.state = silent.health.baro.state = SensorState::silent;
  silent.fly(10);
  CHECK(reports(silent) == 0);
}

TEST_CASE("noise and bias are reported when they last") {
  for (const SensorState bad : {SensorState::noisy, SensorState::biased}) {
    Watching w;
    w.health.baro.state = bad;
    w.fly(9.5);
    CHECK(w.reported.empty());
    w.fly(1);
    CHECK(w.reported.size() == 1);
  }
}

TEST_CASE(
    "a magnetometer mounted wrong is one line with its angle, in the run already, and one when it is right") {
  for (const double turn_rad : {-3.1, 1.05}) {
    Watching w;
    w.ground.contact = Contact::ground;
    w.health.mag.state = SensorState::biased;
    w.health.mag_turn_rad = turn_rad;
    w.fly(0.1);
    REQUIRE(w.reported.size() == 1);
    CHECK(w.reported[0].severity == Severity::warning);
    CHECK(w.reported[0].cause == Cause::magnetometer);
    CHECK(w.reported[0].text.view() ==
          (turn_rad < 0 ? "safety.magnetometer_turned(178)" : "safety.magnetometer_turned(60)"));
    w.ground.contact = Contact::air;
    w.fly(20);
    CHECK(w.reported.size() == 1);
    w.health.mag.state = SensorState::silent;  // as any other
    w.fly(1);
    CHECK(w.reported.size() == 2);
    w.health.mag.state = SensorState::ok;
    w.health.mag_turn_rad = 0;
    w.fly(4);
    CHECK(w.count(Severity::info) == 2);
  }
}

TEST_CASE("a receiver that is silent is one line, not one for each thing that it measures") {
  Watching w;
  w.fly(5);
  w.health.gnss_position.state = w.health.gnss_velocity.state = SensorState::silent;
  w.fly(20);
  CHECK(w.reported.size() == 1);
}

TEST_CASE("what comes and goes is reported twice a minute at most") {
  Watching w;
  for (int i = 0; i < 12; ++i) {
    w.health.pitot.state = SensorState::silent;
    w.fly(1);
    w.health.pitot.state = SensorState::ok;
    w.fly(4);
  }
  CHECK(w.count(Severity::warning) == 2);
  CHECK(w.count(Severity::info) == 2);
}

TEST_CASE("on the ground, and of a sensor that was never there, nothing is reported") {
  for (const Contact contact : {Contact::ground, Contact::unknown}) {
    Watching w;
    w.ground.contact = contact;
    w.health = Watching::all(SensorState::silent);
    w.fly(20);
    CHECK(w.reported.empty());
  }
  Watching w;
  w.health = Watching::all(SensorState::never);
  w.fly(20);
  CHECK(w.reported.empty());
}

TEST_CASE("a position that is lost is reported, and its return") {
  Watching w;
  w.fly(1);
  w.state.position_valid = false;
  w.fly(20);
  REQUIRE(w.reported.size() == 1);
  CHECK(w.reported[0].severity == Severity::critical);
  w.state.position_valid = true;
  w.fly(4);
  CHECK(w.reported.size() == 2);
  Watching never;
  never.state.position_valid = false;
  never.fly(20);
  CHECK(never.reported.empty());
}

TEST_CASE("in a flight each fault of a sensor is a line, and a flight in order has none") {
  CHECK(flown("baro_fault: none") == "");
  for (const char* fault : {"off", "stuck", "wrong"})
    for (const auto& [sensor, name] :
         {std::pair{"baro", "(barometer, "}, {"pitot", "(pitot tube, "}, {"mag", "(magnetometer, "}}) {
      const std::string lines = flown(std::string(sensor) + "_fault: " + fault);
      CAPTURE(fault);
      CAPTURE(lines);
      CHECK(lines_of(lines, name) == 2);
      CHECK(lines.find("safety.sensor_failed" + std::string(name)) < lines.find("safety.sensor_back"));
    }
}

TEST_CASE("the circle of an aircraft without a position begins with a line and ends with one") {
  const std::string lines =
      flown("gnss_position_fault: off", "components: {follow: {params: {reckon_time: 5 s}}}\n");
  CAPTURE(lines);
  CHECK(lines_of(lines, "follow: path.position_lost") == 1);
  CHECK(lines_of(lines, "follow: path.position_back") == 1);
}

}  // namespace sensor_watch_test

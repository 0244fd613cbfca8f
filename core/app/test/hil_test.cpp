// SPDX-License-Identifier: BSD-3-Clause
// The hourglass through the serial protocol: the host, a flight controller in software that behaves like
// ROSflight's, and the aircraft of sim_aero. FULMAR_LONG=1 flies two circuits in real time; otherwise the
// first turn and half a leg, five times faster.
#include "core/app/test/hil.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <future>

#include "core/app/test/hil_log.hpp"
#include "core/log/test/read_mcap.hpp"
#include "fulmar/msg/actuators.hpp"
#include "fulmar/msg/imu.hpp"
#include "fulmar/msg/vehicle_state.hpp"
#include "fulmar/msg/vehicle_status.hpp"

using namespace fulmar::fcu::testing;

namespace {

const bool in_full = std::getenv("FULMAR_LONG") != nullptr;
const double scale = in_full ? 1 : 5;
const Plan circuits = in_full ? Plan{"manage.progress.circuits >= 2", 0, scale, 500}
                              : Plan{"manage.progress.circuits >= 1", 93, scale, 100};

/// Least horizontal distance to the track of an undisturbed flight.
double off_track(const Row& r, const std::vector<Row>& track) {
  double least = 1e9;
  for (std::size_t k = 0; k < track.size(); k += 5)
    least = std::min(least, std::hypot(track[k].north - r.north, track[k].east - r.east));
  return least;
}

/// The largest change of a command within 10 ms, while commands come: after a gap the change belongs to a
/// longer time.
double largest_step(const std::vector<Row>& truth, double from, double to, std::size_t channel) {
  double most = 0;
  const auto came = [&](std::size_t k) { return truth[k].commands > truth[k - 1].commands; };
  for (std::size_t k = 2; k < truth.size(); ++k)
    if (truth[k - 1].t >= from && truth[k].t < to && truth[k - 1].offboard > 0 && came(k) && came(k - 1))
      most = std::max(most, std::abs(truth[k].u[channel] - truth[k - 1].u[channel]));
  return most;
}

/// False: the machine stood still in every flight, which fails a long campaign.
bool flown(const Flown& f) {
  const std::string printed = f.printed + f.peer;
  if (!f.measured && !in_full) MESSAGE("NOT MEASURED: " << printed);
  if (f.measured || in_full) REQUIRE_MESSAGE(f.code == 0, printed);
  return f.measured;
}

struct Disturbed {
  Flown flown;
  fulmar::core::WholeLog log;
};

Flown fly_plain() {
  const Scratch s("plain");
  return fly_undisturbed(s, circuits);
}

/// One flight with all disturbances. The first turn is from 41 to 49 s, then a straight leg until 109 s.
Disturbed fly_disturbed() {
  const Scratch s("disturbed");
  const Plan plan{"manage.progress.circuits >= 1", 92, scale, 200};
  Disturbed made;
  made.flown = fly_undisturbed(
      s, plan,
      {"--unplug-at", "43", "--unplug-for", "5", "--override-at", "64", "--override-until", "69",
       "--rc-silent-at", "79", "--rc-back-at", "82", "--mute-at", "88", "--mute-for", "0.1"},
      true);
  if (made.flown.code == 0) made.log = fulmar::core::read_mcap(s.log());
  return made;
}

/// Both flights run at once: each follows its own clock and needs a fifth of a processor.
struct Flights {
  Flown plain;
  Disturbed disturbed;
};
const Flights& flights() {
  static const Flights both = [] {
    std::future<Disturbed> disturbed = std::async(std::launch::async, fly_disturbed);
    Flights f;
    f.plain = fly_plain();
    f.disturbed = disturbed.get();
    return f;
  }();
  return both;
}
const Flown& undisturbed() { return flights().plain; }
const Disturbed& disturbed() { return flights().disturbed; }

TEST_CASE("missing sensors are reported before arming, by name") {
  struct Lack {
    std::vector<std::string> words;
    const char* reported;
  };
  const Lack lacks[] = {
      {{"--no-fix-at", "-1", "--no-mag"},
       "fcu_serial.not_ready(missing.attitude, missing.gnss_fix, missing.magnetometer)\n"},
      {{"--gnss-silent-at", "-1", "--no-baro", "--no-pitot"},
       "fcu_serial.not_ready(missing.gnss_fix, missing.height, missing.barometer, missing.pitot)\n"}};
  for (const Lack& lack : lacks) {
    const Scratch s("lack");
    std::vector<std::string> words = lack.words;
    words.insert(words.end(), {"--arm-at", "inf"});
    const Flown f = fly_peer(s, {"manage.progress.circuits >= 1", 6, 1, 60}, words, false);
    CHECK_MESSAGE(f.printed.find(lack.reported) != std::string::npos, f.printed);
  }
}

}  // namespace

TEST_CASE("the hourglass through the serial protocol tracks like the simulator with the same delays") {
  const Flown& fcu = undisturbed();
  if (!flown(fcu)) return;
  const Scratch s("sim");
  const Flown sim = fly_sim(s, circuits);
  REQUIRE(sim.code == 0);
  const auto horizontal = [](const Flown& f) {
    return std::hypot(f.tracking("north_m"), f.tracking("east_m"));
  };
  MESSAGE("position " << horizontal(fcu) << " m, simulated " << horizontal(sim) << " m; " << fcu.wall
                      << " s on the wall");
  // One fast circuit has few turns for an average, and every delay of this computer counts five times.
  const double alike = in_full ? 0.2 : 0.4;
  CHECK(horizontal(fcu) == doctest::Approx(horizontal(sim)).epsilon(alike));
  for (const char* key : {"airspeed_mps", "altitude_m", "course_deg", "pitch_deg", "roll_deg"}) {
    MESSAGE(std::string(key) << " " << fcu.tracking(key) << ", simulated " << sim.tracking(key));
    CHECK(fcu.tracking(key) == doctest::Approx(sim.tracking(key)).epsilon(alike));
  }
}

/// Distance of a disturbed flight from an undisturbed one, and the changes of its commands.
struct Deviation {
  const std::vector<Row>& plain;
  const Flown& f;
  double worst(double from, double to) const {
    double most = 0;
    for (const Row& r : f.truth)
      if (r.t > from && r.t < to) most = std::max(most, off_track(r, plain));
    return most;
  }
  double lowest(double from, double to) const {
    double least = 1e9;
    for (const Row& r : f.truth)
      if (r.t > from && r.t < to) least = std::min(least, r.height);
    return least;
  }
  /// No surface command steps by more than a fifth of the throw between two samples of the controllers.
  void no_step(const char* when, double from, double to) const {
    for (const std::size_t channel : {1u, 2u, 3u}) {
      const double here = largest_step(f.truth, from, to, channel),
                   usual = largest_step(plain, 30, 90, channel);
      MESSAGE(std::string(when) << ": largest change of command " << channel << " in 10 ms " << here
                                << " of the throw, usually " << usual);
      CHECK(here < 0.2);
    }
  }
};

TEST_CASE(
    "cable out for 5 s in a turn, the pilot for 5 s, no radio for 3 s, silence for 100 ms: told, and flown "
    "on without a step") {
  const Flown& plain = undisturbed();
  if (!flown(plain)) return;
  REQUIRE_MESSAGE(plain.truth.size() > 1000, plain.printed);
  const Flown& f = disturbed().flown;
  if (!flown(f)) return;
  for (const char* code : {"fcu_serial.controller_back(5",
                           "fcu_serial.pilot_flies(fcu_serial.attitude_switch, fcu_serial.throttle_switch)",
                           "fcu_serial.pilot_hands_over", "fcu_serial.radio_frozen", "fcu_serial.radio_back"})
    CHECK_MESSAGE(f.printed.find(code) != std::string::npos, f.printed);

  const Deviation d{plain.truth, f};
  double back = 0;
  for (const Row& r : f.truth)
    if (r.t > 44 && r.offboard > 0 && back == 0) back = r.t;
  MESSAGE("cable: " << d.worst(43, 60) << " m off the track, lowest " << d.lowest(43, 60)
                    << " m, commands again after " << back - 48 << " s, " << d.worst(60, 64)
                    << " m off from 12 s on");
  CHECK(back > 48);
  CHECK(back < 48 + 2 * scale);  // two seconds of wall time
  CHECK(d.lowest(43, 60) > 30);
  CHECK(d.worst(43, 60) < 60);
  CHECK(d.worst(60, 64) < 5);
  d.no_step("cable", 48, 60);

  MESSAGE("pilot: " << d.worst(64, 75) << " m off the track, " << d.worst(76, 79) << " m from 7 s on");
  CHECK(d.worst(64, 75) < 60);
  CHECK(d.worst(76, 79) < 5);
  d.no_step("pilot", 69.1, 79);
  double min_throttle = 1;
  for (const Row& r : f.truth)
    if (r.t > 69.1 && r.t < 71) min_throttle = std::min(min_throttle, r.u[0]);
  MESSAGE("pilot: lowest throttle within 2 s of the hand-back " << min_throttle);
  CHECK(min_throttle > 0.2);

  MESSAGE("no radio: " << d.worst(79, 86) << " m off the track; 100 ms of silence: " << d.worst(88, 90)
                       << " m");
  CHECK(d.worst(79, 86) < 20);
  CHECK(d.worst(88, 90) < 5);
  d.no_step("radio", 82.1, 88);
}

TEST_CASE(
    "the log of the cable out for 5 s: ticks go on, inertial samples are missing, the state is invalid after "
    "0.3 s and valid again") {
  const Disturbed& d = disturbed();
  if (!flown(d.flown)) return;
  const auto imu = logged<fulmar::Imu>(d.log, "/vehicle/imu");
  const auto states = logged<fulmar::VehicleState>(d.log, "/nav/state");
  const auto statuses = logged<fulmar::VehicleStatus>(d.log, "/vehicle/status");
  const auto found = gaps(imu, 2, 1e9);
  REQUIRE(found.size() == 1);
  const Gap gap = found.front();
  CHECK(gap.length() > 4.9);
  CHECK(gap.length() < 5 + 2 * scale);
  for (const auto& sample : imu) REQUIRE((sample.valid_t <= gap.from + 0.1 || sample.valid_t > gap.to - 0.1));

  const auto in = between(states, gap.from, gap.to - 1e-6);
  MESSAGE("cable out for " << gap.length() << " s: " << in.size() << " states");
  CHECK(static_cast<double>(in.size()) > gap.length() / 0.02);  // a tick per 10 ms
  CHECK(gaps(states, 0.1, 1e9).empty());
  double lost = 0, known = 0;
  for (const auto& s : in) {
    if (!s.value.attitude_valid && lost == 0) lost = s.t;
    if (lost > 0)
      REQUIRE_FALSE((s.value.attitude_valid || s.value.velocity_valid || s.value.position_valid ||
                     s.value.airspeed_valid));
  }
  for (const auto& s : between(states, gap.to - 1e-6, gap.to + 20))
    if (known == 0 && s.value.attitude_valid && s.value.velocity_valid && s.value.position_valid &&
        s.value.height_valid)
      known = s.t;
  MESSAGE("state invalid after " << lost - gap.from << " s, valid again " << known - gap.to
                                 << " s after the return");
  CHECK(lost - gap.from > 0.25);  // max_coast is 0.3 s
  CHECK(lost - gap.from < 0.4);
  REQUIRE(known > 0);
  CHECK(known - gap.to < 2);

  bool failed = false;
  for (const auto& s : between(statuses, gap.from + 1, gap.to - 1e-6)) {
    failed = failed || s.value.health == fulmar::Health::failed;
    CHECK_FALSE(s.value.in_control);
  }
  CHECK(failed);
}

TEST_CASE("the log of 100 ms without data: the state stays valid, the gap is flagged, no surface steps") {
  const Disturbed& d = disturbed();
  if (!flown(d.flown)) return;
  const auto imu = logged<fulmar::Imu>(d.log, "/vehicle/imu");
  const auto states = logged<fulmar::VehicleState>(d.log, "/nav/state");
  const auto found = gaps(imu, 0.08, 0.25);
  REQUIRE(found.size() == 1);
  const Gap gap = found.front();
  double known = 0, widest = 0;
  for (const auto& s : between(states, gap.from - 1, gap.from))
    known = std::max(known, s.value.attitude_std_rad.north);
  const auto in = between(states, gap.from, gap.to - 1e-6);
  CHECK(in.size() >= 4);  // ticks without a sample
  for (const auto& s : between(states, gap.from - 1, gap.to + 1)) {
    CHECK(s.value.attitude_valid);
    CHECK(s.value.velocity_valid);
    CHECK(s.value.position_valid);
  }
  for (const auto& s : in) widest = std::max(widest, s.value.attitude_std_rad.north);
  CHECK(widest > 1.2 * known);  // the extrapolated state is less certain
  bool degraded = false, recovered = false;
  for (const auto& s :
       between(logged<fulmar::VehicleStatus>(d.log, "/vehicle/status"), gap.from, gap.to + 0.5)) {
    degraded = degraded || (s.t < gap.to + 1e-6 && s.value.health == fulmar::Health::degraded);
    recovered = s.value.health == fulmar::Health::ok;
  }
  CHECK(degraded);
  CHECK(recovered);
  const auto commands =
      between(logged<fulmar::Actuators>(d.log, "/inner/actuators"), gap.from - 0.1, gap.to + 1);
  double aileron = 0, elevator = 0, rudder = 0;
  for (std::size_t k = 1; k < commands.size(); ++k) {
    const fulmar::Actuators &a = commands[k - 1].value, &b = commands[k].value;
    aileron = std::max(aileron, std::abs(b.aileron_rad - a.aileron_rad));
    elevator = std::max(elevator, std::abs(b.elevator_rad - a.elevator_rad));
    rudder = std::max(rudder, std::abs(b.rudder_rad - a.rudder_rad));
  }
  MESSAGE("silence for " << gap.length() << " s: " << in.size() << " states, attitude's deviation " << known
                         << " -> " << widest << " rad; largest steps " << aileron << ", " << elevator << ", "
                         << rudder << " rad");
  CHECK(commands.size() > 50);
  // In gusts the pitch rate changes within 100 ms, and the damper reacts at once; throws are 0.7 rad.
  CHECK(aileron < 0.07);
  CHECK(elevator < 0.175);
  CHECK(rudder < 0.07);
}

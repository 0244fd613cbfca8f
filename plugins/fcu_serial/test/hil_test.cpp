// SPDX-License-Identifier: BSD-3-Clause
// The hourglass through the serial protocol: the host, a flight controller in software that behaves as ROSflight's, and sim_aero's
// aircraft. FULMAR_LONG=1 flies it in real time; otherwise one circuit, five times faster.
#include "hil.hpp"

#include <doctest/doctest.h>

#include <algorithm>

using namespace fulmar::fcu::testing;

namespace {

const bool in_full = std::getenv("FULMAR_LONG") != nullptr;
const std::string circuits = std::string("manage.progress.circuits >= ") + (in_full ? "2" : "1");
const double scale = in_full ? 1 : 5;
const double limit_s = in_full ? 500 : 100;

/// Least horizontal distance to where an undisturbed flight was.
double off_track(const Row& r, const std::vector<Row>& track) {
  double least = 1e9;
  for (std::size_t k = 0; k < track.size(); k += 5) least = std::min(least, std::hypot(track[k].north - r.north, track[k].east - r.east));
  return least;
}

/// The largest change of a command within 10 ms, as long as commands come.
double largest_step(const std::vector<Row>& truth, double from, double to, std::size_t channel) {
  double most = 0;
  for (std::size_t k = 1; k < truth.size(); ++k)
    if (truth[k - 1].t >= from && truth[k].t < to && truth[k - 1].offboard > 0 && truth[k].commands > truth[k - 1].commands)
      most = std::max(most, std::abs(truth[k].u[channel] - truth[k - 1].u[channel]));
  return most;
}

void require_flown(const Flown& f) {
  const std::string said = f.said + f.peer;
  REQUIRE_MESSAGE(f.code == 0, said);
}

const Flown& undisturbed() {
  static const Flown f = [] {
    const Scratch s("plain");
    return fly_peer(s, circuits, scale, {}, limit_s);
  }();
  return f;
}

}  // namespace

TEST_CASE("the hourglass through the serial protocol tracks as the simulator with the same delays does") {
  const Flown& fcu = undisturbed();
  require_flown(fcu);
  const Scratch s("sim");
  const Flown sim = fly_sim(s, circuits);
  REQUIRE(sim.code == 0);
  const auto horizontal = [](const Flown& f) { return std::hypot(f.tracking("north_m"), f.tracking("east_m")); };
  MESSAGE("position " << horizontal(fcu) << " m, simulated " << horizontal(sim) << " m; " << fcu.wall << " s on the wall");
  // One circuit in a hurry holds few turns to average over, and every delay of this computer counts five times.
  const double alike = in_full ? 0.2 : 0.4;
  CHECK(horizontal(fcu) == doctest::Approx(horizontal(sim)).epsilon(alike));
  for (const char* key : {"airspeed_mps", "altitude_m", "course_deg", "pitch_deg", "roll_deg"}) {
    MESSAGE(std::string(key) << " " << fcu.tracking(key) << ", simulated " << sim.tracking(key));
    CHECK(fcu.tracking(key) == doctest::Approx(sim.tracking(key)).epsilon(alike));
  }
}

/// Where an undisturbed flight was, how far a disturbed one is from it, and how much its commands change.
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
  /// No surface is told to jump by more than a fifth of its throw between two samples of the controllers.
  void no_step(const char* when, double from, double to) const {
    for (const std::size_t channel : {1u, 2u, 3u}) {
      const double here = largest_step(f.truth, from, to, channel), usual = largest_step(plain, 30, 120, channel);
      MESSAGE(std::string(when) << ": largest change of command " << channel << " in 10 ms " << here << " of the throw, usually " << usual);
      CHECK(here < 0.2);
    }
  }
};

TEST_CASE("cable out for 5 s in a turn, the pilot for 8 s, no radio for 3 s, silence for 100 ms: told, and flown on without a step") {
  const Flown& plain = undisturbed();
  REQUIRE(plain.truth.size() > 1000);
  const Scratch s("unplug");
  // The first turn is from 41 to 49 s, then a straight leg until 109 s.
  const Flown f = fly_peer(s, "manage.progress.item >= 3", scale,
                           {"--unplug-at", "43", "--unplug-for", "5", "--override-at", "70", "--override-until", "78", "--rc-silent-at",
                            "92", "--rc-back-at", "95", "--mute-at", "103", "--mute-for", "0.1"},
                           limit_s);
  require_flown(f);
  for (const char* words : {"the flight controller is back after 5", "the pilot flies: attitude switch, throttle switch",
                            "the pilot hands over", "no frames of the radio: the outputs are frozen", "frames of the radio come again"})
    CHECK_MESSAGE(f.said.find(words) != std::string::npos, f.said);

  const Deviation d{plain.truth, f};
  double back = 0;
  for (const Row& r : f.truth)
    if (r.t > 44 && r.offboard > 0 && back == 0) back = r.t;
  MESSAGE("cable: " << d.worst(43, 66) << " m off the track, lowest " << d.lowest(43, 66) << " m, commands again after " << back - 48
                    << " s, " << d.worst(66, 70) << " m off from 18 s on");
  CHECK(back > 48);
  CHECK(back < 48 + 2 * scale);  // two seconds on the wall
  CHECK(d.lowest(43, 66) > 30);
  CHECK(d.worst(43, 66) < 60);
  CHECK(d.worst(66, 70) < 5);
  d.no_step("cable", 48, 66);

  MESSAGE("pilot: " << d.worst(70, 86) << " m off the track, " << d.worst(88, 92) << " m from 10 s on");
  CHECK(d.worst(70, 86) < 60);
  CHECK(d.worst(88, 92) < 5);
  d.no_step("pilot", 78.1, 88);

  MESSAGE("no radio: " << d.worst(92, 100) << " m off the track; 100 ms of silence: " << d.worst(103, 108) << " m");
  CHECK(d.worst(92, 100) < 20);
  CHECK(d.worst(103, 108) < 5);
  d.no_step("radio", 95.1, 103);
  d.no_step("silence", 103, 106);
}

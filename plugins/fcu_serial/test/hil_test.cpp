// SPDX-License-Identifier: BSD-3-Clause
// The hourglass through the serial protocol: the host, a flight controller in software that behaves as ROSflight's, and sim_aero's aircraft.
// FULMAR_LONG=1 flies it in real time; otherwise one circuit, five times faster.
#include <doctest/doctest.h>

#include <algorithm>

#include "hil.hpp"

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
  const double slack = in_full ? 0 : 0.05;  // one circuit holds few turns to average over
  CHECK(std::abs(horizontal(fcu) - horizontal(sim)) < 0.2 * horizontal(sim) + slack);
  for (const char* key : {"airspeed_mps", "altitude_m", "course_deg", "pitch_deg", "roll_deg"}) {
    MESSAGE(std::string(key) << " " << fcu.tracking(key) << ", simulated " << sim.tracking(key));
    CHECK(fcu.tracking(key) == doctest::Approx(sim.tracking(key)).epsilon(0.2));
  }
}

TEST_CASE("the cable out for 5 s in a turn, and silence for 100 ms: told, and flown on without a step") {
  const Flown& plain = undisturbed();
  REQUIRE(plain.truth.size() > 1000);
  const Scratch s("unplug");
  const double out_s = 43, back_s = 48, gap_s = 100;  // the first turn is from 41 to 49 s
  const Flown f = fly_peer(s, "manage.progress.item >= 3", scale,
                           {"--unplug-at", "43", "--unplug-for", "5", "--mute-at", "100", "--mute-for", "0.1"}, limit_s);
  require_flown(f);
  CHECK_MESSAGE(f.said.find("the flight controller is back after 5") != std::string::npos, f.said);
  double away = 0, late = 0, lowest = 1e9, handed_back_s = 0, in_gap = 0;
  for (const Row& r : f.truth) {
    if (r.t > out_s && r.t < back_s + 30) away = std::max(away, off_track(r, plain.truth)), lowest = std::min(lowest, r.height);
    if (r.t > back_s + 25 && r.t < gap_s) late = std::max(late, off_track(r, plain.truth));
    if (r.t > gap_s && r.t < gap_s + 5) in_gap = std::max(in_gap, off_track(r, plain.truth));
    if (r.t > out_s + 1 && r.offboard > 0 && handed_back_s == 0) handed_back_s = r.t;
  }
  MESSAGE("5 s out: " << away << " m off the track, lowest " << lowest << " m, in control again " << handed_back_s - back_s << " s after the return, "
                      << late << " m off after 25 s; 100 ms: " << in_gap << " m off");
  CHECK(handed_back_s > back_s);
  CHECK(handed_back_s < back_s + 2 * scale + 1);  // two seconds, on the wall
  CHECK(lowest > 30);
  CHECK(away < 150);
  CHECK(late < 5);
  CHECK(in_gap < 5);
  for (const std::size_t channel : {1, 2, 3}) {
    const double usual = largest_step(plain.truth, 30, gap_s, channel), at_return = largest_step(f.truth, out_s + 0.2, back_s + 20, channel),
                 at_gap = largest_step(f.truth, gap_s, gap_s + 2, channel);
    MESSAGE("largest change of command " << channel << " in 10 ms: usually " << usual << ", at the return " << at_return << ", at the gap " << at_gap);
    CHECK(at_return < 0.25);
    CHECK(at_gap < 0.25);
  }
}

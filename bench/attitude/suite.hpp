// SPDX-License-Identifier: BSD-3-Clause
// The attitude benchmark of the Skywalker X8: E. Bohn, E. M. Coates, S. Moe, T. A. Johansen, Deep
// Reinforcement Learning Attitude Control of Fixed-Wing UAVs Using Proximal Policy Optimization, ICUAS 2019.
// Initial states, targets and success of an episode, independent of aircraft and law.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "fulmar/flight/earth/dryden.hpp"
#include "fulmar/random.hpp"

namespace fulmar::attitude {

inline constexpr double deg = std::numbers::pi / 180;
inline constexpr double dt_s = 0.01;
inline constexpr int max_steps = 1500, streak_steps = 100;
inline constexpr double angle_bound_rad = 5 * deg, airspeed_bound_mps = 2;
/// Turbulence at this height above the ground, with this airspeed.
inline constexpr double turbulence_height_m = 100, turbulence_airspeed_mps = 25;

/// Roll, pitch, body rates, rad and rad/s; airspeed, m/s, and its components along body y and z.
struct Start {
  double roll_rad = 0, pitch_rad = 0;
  double airspeed_mps = 0, v_mps = 0, w_mps = 0;
  std::array<double, 3> rate_radps{};
};
struct Target {
  double roll_rad = 0, pitch_rad = 0, airspeed_mps = 0;
};

/// Airspeed at the start. The target is drawn within 3 m/s of it: 14 to 31 m/s, as the published set's 14.0
/// to 30.8.
inline constexpr double slowest_mps = 17, fastest_mps = 28, target_apart_mps = 3;

struct Episode {
  Start start;
  Target target;
  std::uint64_t seed = 0;  ///< of its gusts
};

/// The same for the same seed, whatever the turbulence.
inline Episode episode(std::uint64_t seed, std::uint64_t number) {
  Random random(mix_seed(seed, number));
  const auto within = [&](double most) { return random.uniform(-most, most); };
  Episode e;
  e.start.roll_rad = within(60 * deg);
  e.start.pitch_rad = within(25 * deg);
  e.start.airspeed_mps = random.uniform(slowest_mps, fastest_mps);
  e.start.v_mps = within(5);
  e.start.w_mps = within(5);
  for (double& rate : e.start.rate_radps) rate = within(40 * deg);
  e.target.roll_rad = within(15 * deg);
  e.target.pitch_rad = within(10 * deg);
  e.target.airspeed_mps = e.start.airspeed_mps + within(target_apart_mps);
  e.seed = random.bits();
  return e;
}

/// The commanded airspeed one step later: it moves to the airspeed at which the pitch target holds with a
/// throttle of 85 % in a climb, and 0 in a descent.
inline double next_airspeed(const Target& t) {
  const double theta = t.pitch_rad, Va = t.airspeed_mps;
  if (theta >= 5 * deg) {
    const double end = 26.27 - 41.25 * theta;
    return Va > end ? Va + (end - Va) / 150 : Va;
  }
  if (theta <= -2.5 * deg) {
    const double end = 28.4 - 40.1 * theta;
    return Va < end ? std::min(Va + (-7 * theta - 0.25) * dt_s, end) : Va;
  }
  return Va;
}

/// Counts steps within the bounds.
struct Streak {
  int steps = 0, length = 0;
  /// Errors: roll, pitch, airspeed, wanted minus present. Returns true when this step ends a streak that is
  /// long enough.
  bool step(double roll_error_rad, double pitch_error_rad, double airspeed_error_mps) {
    ++steps;
    const bool within = std::abs(roll_error_rad) <= angle_bound_rad &&
                        std::abs(pitch_error_rad) <= angle_bound_rad &&
                        std::abs(airspeed_error_mps) <= airspeed_bound_mps;
    length = within ? length + 1 : 0;
    return length >= streak_steps;
  }
};

/// Control activity: the mean of |rate| of elevator, aileron (rad) and throttle, 1/s, averaged over the
/// three, from the first command to the end of the episode. The first command itself does not count.
struct Variation {
  double sum = 0;
  int commands = 0;
  std::array<double, 3> last{};
  void step(const std::array<double, 3>& command) {
    for (std::size_t i = 0; commands > 0 && i < 3; ++i) sum += std::abs(command[i] - last[i]);
    last = command;
    ++commands;
  }
  double per_s() const { return commands > 1 ? sum / (3 * dt_s * (commands - 1)) : 0; }
};

struct Result {
  bool success = false;
  int steps = max_steps;  ///< step at which the streak ended
  double variation_per_s = 0;
};

struct Row {
  double success_percent = 0, settling_steps = 0, variation_per_s = 0;
};
struct Published {
  const char* turbulence;
  Row pid;                ///< by the authors
  double policy_percent;  ///< success of their best policy
};
inline constexpr std::array<Published, 4> published{{{"none", {100, 254, 0.29}, 100},
                                                     {"light", {100, 260, 0.48}, 100},
                                                     {"moderate", {93, 419, 0.67}, 100},
                                                     {"severe", {83, 651, 0.80}, 97}}};

/// Success as high as that of the policy; time and activity at most those of the PID.
inline bool within(const Row& row, const Published& bar) {
  return row.success_percent >= bar.policy_percent && row.settling_steps <= bar.pid.settling_steps &&
         row.variation_per_s <= bar.pid.variation_per_s;
}

}  // namespace fulmar::attitude

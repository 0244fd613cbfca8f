// SPDX-License-Identifier: BSD-3-Clause
// lib/libfulmar_sim.so: the model behind C functions, for the Python package beside it, and the reader of
// airframe files for C++ (fulmar/sim/airframe_file.hpp).
//
// Functions that return int return 0, or 1 for an error; `fulmar_sim_error()` of the same thread has its
// text. A call that fails changes nothing. Arrays are row-major, one row per aircraft, with `count` rows.
// `only` selects aircraft by `count` flags; null selects all. Frames: NED from the origin, and body axes.
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <iterator>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "fulmar/sim/airframe_file.hpp"
#include "fulmar/sim/batch.hpp"
#include "tools/fulmar_aero/airframe_file.hpp"
#include "tools/fulmar_sim/messages.hpp"

using namespace fulmar;

struct fulmar_sim {
  sim::Batch batch;
  double dt_s;
  std::vector<Eigen::Vector3d> wind_n;
  bool alone;  // no other thread than the caller's
  std::mutex mutex{};
  pid_t maker = getpid();

  bool is_copy() const { return !alone && getpid() != maker; }
};

namespace {

thread_local std::string last_error;

/// Runs `call`; an exception becomes `last_error` and the result 1.
template <class Call>
int guarded(Call call) noexcept {
  try {
    call();
    return 0;
  } catch (const std::bad_alloc&) {
    last_error = simulation_messages::memory_exhausted.c_str();
  } catch (const std::exception& e) {
    last_error = e.what();
  } catch (...) {
    last_error = simulation_messages::error_unknown.c_str();
  }
  return 1;
}

/// The same for a simulation, one call at a time.
template <class Call>
int guarded(fulmar_sim* all, Call call) noexcept {
  return guarded([&] {
    if (all->is_copy()) throw std::invalid_argument(simulation_messages::other_process().line());
    const std::lock_guard lock(all->mutex);
    call(*all);
  });
}

void demand(bool right, const Diagnostic& message) {
  if (!right) throw std::invalid_argument(message.line());
}

std::string aircraft(std::size_t i) { return "aircraft " + std::to_string(i); }

bool is_meant(const bool* only, std::size_t i) { return !only || only[i]; }

void fly(sim::Simulation& flying, double height_m, double airspeed_mps, double heading_rad) {
  const std::string height = sim::shown(height_m), airspeed = sim::shown(airspeed_mps);
  demand(std::isfinite(height_m) && height_m > 0, simulation_messages::height_invalid(height));
  demand(std::isfinite(airspeed_mps) && airspeed_mps > 0, simulation_messages::airspeed_invalid(airspeed));
  demand(std::isfinite(heading_rad), simulation_messages::heading_not_finite(sim::shown(heading_rad)));
  demand(flying.fly({0, 0, -height_m}, heading_rad, airspeed_mps),
         simulation_messages::level_flight_missing(airspeed, height));
}

}  // namespace

#pragma GCC visibility push(default)
extern "C" {

/// Text of the last error of this thread; valid until its next one.
const char* fulmar_sim_error() { return last_error.c_str(); }
/// Names, with units, of the 26 columns of `rows`, separated by spaces.
const char* fulmar_sim_rows_are() { return sim::row_names; }
/// The same of the 4 columns of `actions`: throttle 0 to 1, deflections in rad.
const char* fulmar_sim_actions_are() { return sim::action_names; }

/// Reads an airframe file, or a shipped one ("fulmar:airframes/anaconda.yaml"), into an Airframe of `size`
/// bytes.
int fulmar_sim_read_airframe(const char* name, void* airframe, std::size_t size) {
  return guarded([&] {
    demand(size == sizeof(Airframe), "libfulmar_sim.so and the headers are of different releases");
    const Airframe a = aero::read_airframe_file(name).airframe;
    std::memcpy(airframe, &a, sizeof a);
  });
}

/// `count` aircraft at rest on the ground, heading north; null for an error. `threads` 1 to 256; `dt_s` in
/// (0, 0.1] s; origin altitude -1000 to 20000 m above mean sea level; `turbulence` 0 (none) to 3 (severe).
fulmar_sim* fulmar_sim_new(const char* airframe, std::size_t count, unsigned threads, double dt_s,
                           double origin_altitude_m, unsigned turbulence, std::uint64_t seed) {
  std::unique_ptr<fulmar_sim> made;
  guarded([&] {
    sim::Simulation::demand_step(dt_s);
    demand(origin_altitude_m >= -1000 && origin_altitude_m <= 20000,
           simulation_messages::altitude_out_of_range(sim::shown(origin_altitude_m)));
    sim::SimulationOptions options;
    options.origin_altitude_m = origin_altitude_m;
    options.weather.turbulence = static_cast<Turbulence>(turbulence);
    made.reset(new fulmar_sim{{sim::read_airframe(airframe), count, options, seed, threads},
                              dt_s,
                              std::vector<Eigen::Vector3d>(count, Eigen::Vector3d::Zero()),
                              threads == 1});
  });
  return made.release();
}

/// Releases the simulation. In a forked process it does nothing.
void fulmar_sim_delete(fulmar_sim* all) {
  if (!all->is_copy()) delete all;  // a fork has no threads to join
}

/// Back to the state after `fulmar_sim_new`; aircraft i has the seed mix_seed(seed, i). The wind stays.
int fulmar_sim_reset(fulmar_sim* all, const bool* only, std::uint64_t seed) {
  return guarded(all, [&](fulmar_sim& s) {
    for (std::size_t i = 0; i < s.batch.size(); ++i) {
      if (!is_meant(only, i)) continue;
      s.batch[i].reset(mix_seed(seed, i));
      s.batch[i].plant().set_wind(s.wind_n[i]);
    }
  });
}

/// Steady level flight above the origin. `starts`, count x 3: height, m; true airspeed, m/s; heading, rad.
int fulmar_sim_start_in_flight(fulmar_sim* all, const bool* only, const double* starts) {
  return guarded(all, [&](fulmar_sim& s) {
    std::vector<std::pair<std::size_t, sim::Simulation>> flying;
    for (std::size_t i = 0; i < s.batch.size(); ++i) {
      if (!is_meant(only, i)) continue;
      flying.emplace_back(i, s.batch[i]);
      try {
        fly(flying.back().second, starts[3 * i], starts[3 * i + 1], starts[3 * i + 2]);
      } catch (const std::invalid_argument& e) {
        throw std::invalid_argument(located(aircraft(i), Diagnostic(e.what())).line());
      }
    }
    for (auto& [i, started] : flying) s.batch[i] = started;
  });
}

/// Writes to `actions`, count x 4, the commands of the last steady flight that each aircraft started in.
int fulmar_sim_trim(fulmar_sim* all, double* actions) {
  return guarded(all, [&](fulmar_sim& s) {
    for (std::size_t i = 0; i < s.batch.size(); ++i) {
      const Actuators a = s.batch[i].trim();
      const double row[] = {a.throttle_frac, a.aileron_rad, a.elevator_rad, a.rudder_rad};
      std::copy(std::begin(row), std::end(row), actions + i * sim::action_columns);
    }
  });
}

/// `wind_n`, count x 3: velocity of the air, north, east, down, m/s, each within +-1000.
int fulmar_sim_set_wind(fulmar_sim* all, const double* wind_n) {
  return guarded(all, [&](fulmar_sim& s) {
    const std::size_t n = s.batch.size();
    for (std::size_t k = 0; k < 3 * n; ++k)
      demand(std::abs(wind_n[k]) <= 1000,
             located(aircraft(k / 3), simulation_messages::wind_out_of_range(sim::shown(wind_n[k]))));
    for (std::size_t i = 0; i < n; ++i) {
      s.wind_n[i] = {wind_n[3 * i], wind_n[3 * i + 1], wind_n[3 * i + 2]};
      s.batch[i].plant().set_wind(s.wind_n[i]);
    }
  });
}

/// `steps` steps of `dt_s` with constant `actions`, count x 4; then writes `rows`, count x 26.
int fulmar_sim_step(fulmar_sim* all, const double* actions, unsigned steps, double* rows) {
  return guarded(all, [&](fulmar_sim& s) {
    const std::size_t n = s.batch.size();
    s.batch.step(std::span(actions, n * sim::action_columns), s.dt_s, steps,
                 std::span(rows, n * sim::row_columns));
  });
}

/// Writes the present state to `rows`, count x 26.
int fulmar_sim_rows(fulmar_sim* all, double* rows) {
  return guarded(all,
                 [&](fulmar_sim& s) { s.batch.rows(std::span(rows, s.batch.size() * sim::row_columns)); });
}

/// Sets position, velocity, attitude, body rate, deflections and propeller speed from `rows`, count x 26.
int fulmar_sim_set_rows(fulmar_sim* all, const bool* only, const double* rows) {
  return guarded(all, [&](fulmar_sim& s) {
    for (const bool set : {false, true})  // check all rows first
      for (std::size_t i = 0; i < s.batch.size(); ++i) {
        if (!is_meant(only, i)) continue;
        const sim::FlightState state = sim::state_of_row(rows + i * sim::row_columns);
        const std::string wrong = set ? "" : sim::Simulation::validation_error(state);
        demand(wrong.empty(), located(aircraft(i), wrong));
        if (set) s.batch[i].set(state);
      }
  });
}

}  // extern "C"
#pragma GCC visibility pop

// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstdio>
#include <exception>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "fulmar/sim/batch.hpp"
#include "tools/fulmar_aero/airframe_file.hpp"
#include "tools/fulmar_sim/fulmar_sim.h"

using namespace fulmar;

struct fulmar_sim {
  sim::Batch batch;
  std::vector<Eigen::Vector3d> wind_n;
};

namespace {

/// `call`, whose exceptions end here as a sentence.
template <class Call>
int guarded(char* error, std::size_t size, Call call) noexcept {
  try {
    call();
    return 0;
  } catch (const std::exception& e) {
    if (error && size) std::snprintf(error, size, "%s", e.what());
  } catch (...) {
    if (error && size) std::snprintf(error, size, "an unknown error");
  }
  return 1;
}

void demand_finite(double value, const char* what) {
  if (!std::isfinite(value)) throw std::invalid_argument(std::string(what) + " is " + std::to_string(value));
}

Turbulence turbulence_of(int word) {
  if (word < 0 || word > static_cast<int>(Turbulence::severe))
    throw std::invalid_argument("turbulence is " + std::to_string(word) +
                                "; valid: 0 none, 1 light, 2 moderate, 3 severe");
  return static_cast<Turbulence>(word);
}

/// A reset makes a plant anew, with the wind of the options: the wind that was set comes back.
void blow(fulmar_sim& all) {
  for (std::size_t i = 0; i < all.batch.size(); ++i) all.batch[i].plant().set_wind(all.wind_n[i]);
}

}  // namespace

std::uint32_t fulmar_sim_abi() { return FULMAR_SIM_ABI; }

const char* fulmar_sim_columns() {
  return "north_m east_m down_m v_north_mps v_east_mps v_down_mps q_w q_x q_y q_z p_radps q_radps r_radps "
         "airspeed_mps alpha_rad beta_rad f_x_mps2 f_y_mps2 f_z_mps2 aileron_rad elevator_rad rudder_rad "
         "propeller_radps on_ground crashed";
}
const char* fulmar_sim_actions() { return "throttle_frac aileron_rad elevator_rad rudder_rad"; }

fulmar_sim* fulmar_sim_new(const char* airframe, std::size_t count, std::uint32_t threads,
                           double origin_altitude_m, int turbulence, std::uint64_t seed, char* error,
                           std::size_t size) {
  std::unique_ptr<fulmar_sim> made;
  guarded(error, size, [&] {
    demand_finite(origin_altitude_m, "origin_altitude_m");
    sim::SimulationOptions options;
    options.origin_altitude_m = origin_altitude_m;
    options.weather.turbulence = turbulence_of(turbulence);
    const Airframe a = aero::read_airframe_file(airframe).airframe;
    made.reset(new fulmar_sim{{a, count, options, seed, threads},
                              std::vector<Eigen::Vector3d>(count, Eigen::Vector3d::Zero())});
  });
  return made.release();
}
void fulmar_sim_delete(fulmar_sim* all) { delete all; }

int fulmar_sim_reset(fulmar_sim* all, std::uint64_t seed, char* error, std::size_t size) {
  return guarded(error, size, [&] {
    for (std::size_t i = 0; i < all->batch.size(); ++i) all->batch[i].reset(mix_seed(seed, i));
    blow(*all);
  });
}

int fulmar_sim_stand(fulmar_sim* all, double heading_rad, char* error, std::size_t size) {
  return guarded(error, size, [&] {
    demand_finite(heading_rad, "heading_rad");
    for (std::size_t i = 0; i < all->batch.size(); ++i) all->batch[i].stand(0, 0, heading_rad);
  });
}

int fulmar_sim_fly(fulmar_sim* all, double height_m, double airspeed_mps, double heading_rad, char* error,
                   std::size_t size) {
  return guarded(error, size, [&] {
    demand_finite(height_m, "height_m");
    demand_finite(airspeed_mps, "airspeed_mps");
    demand_finite(heading_rad, "heading_rad");
    if (!(airspeed_mps > 0)) throw std::invalid_argument("airspeed_mps must be more than 0");
    for (std::size_t i = 0; i < all->batch.size(); ++i)
      if (!all->batch[i].fly({0, 0, -height_m}, heading_rad, airspeed_mps))
        throw std::invalid_argument("aircraft " + std::to_string(i) + ": no steady level flight at " +
                                    std::to_string(airspeed_mps) + " m/s and " + std::to_string(height_m) +
                                    " m height");
  });
}

int fulmar_sim_set_wind(fulmar_sim* all, const double* wind_n, char* error, std::size_t size) {
  return guarded(error, size, [&] {
    for (std::size_t k = 0; k < 3 * all->batch.size(); ++k) demand_finite(wind_n[k], "the wind");
    for (std::size_t i = 0; i < all->batch.size(); ++i)
      all->wind_n[i] = Eigen::Vector3d(wind_n[3 * i], wind_n[3 * i + 1], wind_n[3 * i + 2]);
    blow(*all);
  });
}

int fulmar_sim_step(fulmar_sim* all, const double* actions, double dt_s, std::uint32_t steps, double* rows,
                    char* error, std::size_t size) {
  const std::size_t n = all->batch.size();
  return guarded(error, size, [&] {
    all->batch.step(std::span(actions, n * sim::action_columns), dt_s, steps,
                    std::span(rows, n * sim::row_columns));
  });
}

int fulmar_sim_rows(const fulmar_sim* all, double* rows, char* error, std::size_t size) {
  return guarded(error, size,
                 [&] { all->batch.rows(std::span(rows, all->batch.size() * sim::row_columns)); });
}

int fulmar_sim_set_rows(fulmar_sim* all, const double* rows, char* error, std::size_t size) {
  return guarded(error, size, [&] {
    const std::size_t n = all->batch.size();
    for (std::size_t i = 0; i < n; ++i) {  // on a copy first: all are set, or none
      sim::Simulation tried = all->batch[i];
      try {
        tried.set(sim::state_of_row(rows + i * sim::row_columns));
      } catch (const std::invalid_argument& e) {
        throw std::invalid_argument("aircraft " + std::to_string(i) + ": " + e.what());
      }
    }
    for (std::size_t i = 0; i < n; ++i) all->batch[i].set(sim::state_of_row(rows + i * sim::row_columns));
  });
}

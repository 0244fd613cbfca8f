// SPDX-License-Identifier: BSD-3-Clause
// Motions beyond the validity of the model.
#pragma once
#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>

#include "fulmar/flight/model/aerodynamics.hpp"
#include "fulmar/flight/model/rigid_body.hpp"
#include "fulmar/sim/messages.hpp"

namespace fulmar::sim {

/// Reason for a state beyond the model.
enum class Departure : std::uint8_t {
  none,
  diverged,      ///< not finite, or faster than any aircraft
  beyond_alpha,  ///< angle of attack beyond the airframe's tables
  beyond_beta,   ///< sideslip beyond the airframe's tables
};

/// True also for NaN.
inline bool diverged(const RigidBody& x) {
  constexpr double fastest = 1e5, farthest = 1e8;  // m/s and rad/s; m
  return !(x.v_n.squaredNorm() + x.omega_b.squaredNorm() < fastest * fastest &&
           x.p_n.squaredNorm() < farthest * farthest);
}

/// Below this airspeed, m/s, flow angles are not compared with the tables.
inline constexpr double min_table_speed = 3;

/// True if the flow `v_r` is beyond the tables of an aerodynamic model.
template <class Model>
Departure beyond_tables(const Model& model, const Eigen::Vector3d& v_r) {
  if constexpr (requires { model.alpha_range().holds(0.0) && model.beta_range().holds(0.0); }) {
    if (!std::isfinite(model.alpha_range().max) && !std::isfinite(model.beta_range().max))
      return Departure::none;
    const AirData air(v_r);
    if (air.Va < min_table_speed) return Departure::none;
    if (!model.alpha_range().holds(air.alpha)) return Departure::beyond_alpha;
    if (!model.beta_range().holds(air.beta)) return Departure::beyond_beta;
  }
  return Departure::none;
}

/// "which end at -10 and 20 deg", for the tables that the flow exceeds.
template <class Model>
std::string table_ends(const Model& model, Departure d) {
  std::string text;
  if constexpr (requires { model.alpha_range().holds(0.0) && model.beta_range().holds(0.0); }) {
    const auto& range = d == Departure::beyond_alpha ? model.alpha_range() : model.beta_range();
    constexpr double degree = 57.29577951308232;
    const auto figure = [](double value) {
      char words[32];
      std::snprintf(words, sizeof words, "%.3g", value);
      return std::string(words);
    };
    text = sim_messages::table_ends(figure(range.min * degree), figure(range.max * degree)).line();
  }
  return text;
}

}  // namespace fulmar::sim

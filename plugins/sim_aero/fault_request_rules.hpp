// SPDX-License-Identifier: BSD-3-Clause
// Valid requests for faults, and their effect on the sizes from the parameters. A part of faults.hpp, which
// includes it at its end.
#pragma once
#include <cstdio>

#include "figures.hpp"

namespace fulmar::sim {

/// The range of a fault's size: that of its parameter.
struct SizeRange {
  double min = 0, max = 0;
  const char* unit = "";
  bool any() const { return max > min; }
  bool holds(double size) const { return size >= min && size <= max; }
};

inline SizeRange offset_range(FaultTarget target) {
  static constexpr SensorFaultParams s{};
  const auto of = [](const auto& p) { return SizeRange{p.min, p.max, p.unit}; };
  switch (target) {
    case FaultTarget::gyro: return of(s.gyro_fault_size);
    case FaultTarget::accel: return of(s.accel_fault_size);
    case FaultTarget::gnss_position: return of(s.gnss_position_fault_size);
    case FaultTarget::gnss_velocity: return of(s.gnss_velocity_fault_size);
    case FaultTarget::mag: return of(s.mag_fault_size);
    case FaultTarget::baro: return of(s.baro_fault_size);
    default: return of(s.pitot_fault_size);
  }
}

inline SizeRange size_range(FaultTarget target, FaultKind kind) {
  static constexpr FaultParams p{};
  const auto of = [](const Param& param) { return SizeRange{param.min, param.max, param.unit}; };
  const bool sensor = target <= FaultTarget::pitot;
  switch (kind) {
    case FaultKind::wrong:
    case FaultKind::jumping: return offset_range(target);
    case FaultKind::noisy: return of(p.sensors_that_fail.fault_noise);
    case FaultKind::slow: return of(sensor ? p.sensors_that_fail.fault_time : p.body_that_fails.fault_speed);
    case FaultKind::weak: return of(p.body_that_fails.engine_fault_share);
    case FaultKind::empty: return of(p.body_that_fails.battery_fault_time);
    case FaultKind::growing:
    case FaultKind::melting: return {0, p.body_that_fails.icing_rate.max, p.body_that_fails.icing_rate.unit};
    default: return {};
  }
}

/// Reason to reject a request; empty for a valid one.
inline std::string Faults::refusal(const FaultRequest& r) {
  const auto name = [](auto value) {
    return std::string(detail::Labels<decltype(value)>::found.words[static_cast<std::size_t>(value)]);
  };
  const auto kinds = kinds_of(r.what);
  if (std::find(kinds.begin(), kinds.end(), r.kind) == kinds.end()) {
    std::string valid;
    for (const FaultKind& kind : kinds) valid += (&kind == kinds.data() ? "" : ", ") + name(kind);
    return sim_aero_messages::fault_unknown(name(r.what), name(r.kind), valid);
  }
  const SizeRange range = size_range(r.what, r.kind);
  char limits[64];
  std::snprintf(limits, sizeof limits, "%g to %g%s%s", range.min, range.max, range.unit[0] ? " " : "",
                range.unit);
  if (r.size_ratio != 0 && !range.any())
    return located("size", sim_aero_messages::fault_without_size(name(r.kind)));
  if (r.size_ratio != 0 && !range.holds(r.size_ratio))
    return located("size", sim_aero_messages::fault_size_out_of_range(figures(r.size_ratio, 6), limits));
  if (r.what == FaultTarget::icing && r.kind != FaultKind::none && r.size_ratio == 0)
    return located("size", sim_aero_messages::icing_rate_missing());
  if (!(r.ramp_s >= 0 && r.ramp_s <= 3600))
    return located("ramp", sim_aero_messages::fault_ramp_out_of_range(figures(r.ramp_s, 6)));
  if (!(r.for_s >= 0 && r.for_s <= 1e6))
    return located("for", sim_aero_messages::fault_time_out_of_range(figures(r.for_s, 6)));
  return "";
}

/// The parameters' fault of this target with the requested kind and size. A size of a vector is its length,
/// in the direction of the parameter.
inline Fault Faults::sized(const Fault& of_parameters, const FaultRequest& r) {
  Fault f = of_parameters;
  f.kind = r.kind;
  f.ramp_s = r.ramp_s;
  const double size = r.size_ratio;
  if (r.what == FaultTarget::icing) f.rate = r.kind == FaultKind::melting ? -size : size;
  if (size == 0) return f;
  switch (r.kind) {
    case FaultKind::wrong:
    case FaultKind::jumping: {
      const bool pointless = f.size.norm() == 0;
      f.size = size * (pointless ? Eigen::Vector3d(1, 0, 0) : Eigen::Vector3d(f.size.normalized()));
      break;
    }
    case FaultKind::noisy: f.noise = size; break;
    case FaultKind::slow: f.time_s = f.share = size; break;
    case FaultKind::weak: f.share = size; break;
    case FaultKind::empty: f.time_s = size; break;
    default: break;
  }
  return f;
}

}  // namespace fulmar::sim

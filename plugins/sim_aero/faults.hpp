// SPDX-License-Identifier: BSD-3-Clause
// The faults in force: those of the parameters. A requested fault replaces that of the parameters until its
// time is over or it is withdrawn.
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <string>

#include "fault_params.hpp"
#include "fulmar/eigen.hpp"
#include "fulmar/msg/fault_request.hpp"
#include "fulmar/sim/fault.hpp"
#include "messages.hpp"

namespace fulmar::sim {

constexpr std::size_t fault_targets = 14;
constexpr std::size_t at(FaultTarget target) { return static_cast<std::size_t>(target); }

/// The kinds of a target, in the order of its parameter.
inline std::span<const FaultKind> kinds_of(FaultTarget target) {
  using enum FaultKind;
  static constexpr std::array sensor{none, off, stuck, wrong, slow, noisy, jumping};
  static constexpr std::array surface{none, stuck, hardover_positive, hardover_negative, slow, free, lost};
  static constexpr std::array engine{none, off, weak};
  static constexpr std::array battery{none, empty};
  static constexpr std::array radio{none, off};
  static constexpr std::array icing{none, growing, melting};
  switch (target) {
    case FaultTarget::aileron:
    case FaultTarget::elevator:
    case FaultTarget::rudder: return surface;
    case FaultTarget::engine: return engine;
    case FaultTarget::battery: return battery;
    case FaultTarget::radio: return radio;
    case FaultTarget::icing: return icing;
    default: return sensor;
  }
}
template <class E>
FaultKind kind_of(FaultTarget target, E choice) {
  return kinds_of(target)[static_cast<std::size_t>(choice)];
}

class Faults {
 public:
  /// Sets the parameters at `now_ns`: at the begin of the flight and after each change.
  void set(const FaultParams& p, std::int64_t now_ns) {
    std::array<Fault, fault_targets> next = of_parameters(p);
    for (std::size_t i = 0; i < fault_targets; ++i) {
      next[i].ramp_s = p.sensors_that_fail.fault_ramp;
      next[i].since_ns = next[i].kind == parameters_[i].kind ? parameters_[i].since_ns : now_ns;
    }
    parameters_ = next;
    changed_ = true;
  }

  void answer(const Request<FaultRequest>::One& request, std::int64_t now_ns) {
    const FaultRequest& r = request.value();
    if (const std::string fault = refusal(r); !fault.empty()) return request.refuse(fault);
    Held& held = requests_[at(r.what)];
    held.active = r.kind != FaultKind::none;
    held.until_ns = r.for_s > 0 ? now_ns + std::llround(1e9 * r.for_s) : never;
    held.fault = sized(parameters_[at(r.what)], r);
    held.fault.since_ns = now_ns;
    changed_ = true;
    request.accept();
  }

  /// Returns true when the fault in force has changed or has grown.
  bool advance(std::int64_t now_ns) {
    if (!changed_ && !moving_) return false;
    changed_ = moving_ = false;
    for (std::size_t i = 0; i < fault_targets; ++i) {
      Held& held = requests_[i];
      if (held.active && now_ns > held.until_ns) held.active = false;
      moving_ = moving_ || (held.active && held.until_ns != never);
      Fault& fault = in_force_[i] = held.active ? held.fault : parameters_[i];
      const double age_s = 1e-9 * static_cast<double>(now_ns - fault.since_ns);
      fault.growth = fault.ramp_s > 0 ? std::clamp(age_s / fault.ramp_s, 0.0, 1.0) : 1;
      moving_ = moving_ || (fault.kind != FaultKind::none && fault.growth < 1);
    }
    return true;
  }

  const Fault& operator[](FaultTarget target) const { return in_force_[at(target)]; }

  /// Share of the battery's full voltage.
  double voltage(std::int64_t now_ns) const {
    const Fault& f = (*this)[FaultTarget::battery];
    if (f.kind == FaultKind::none) return 1;
    return std::clamp(1 - 1e-9 * static_cast<double>(now_ns - f.since_ns) / f.time_s, 0.0, 1.0);
  }
  /// Share of the voltage that reaches the motor.
  double power(std::int64_t now_ns) const {
    const Fault& f = (*this)[FaultTarget::engine];
    if (f.kind == FaultKind::off) return 0;
    const double share = f.kind == FaultKind::weak ? 1 + f.growth * (f.share - 1) : 1;
    return share * voltage(now_ns);
  }

 private:
  static constexpr std::int64_t never = std::numeric_limits<std::int64_t>::max();
  struct Held {
    bool active = false;
    std::int64_t until_ns = never;
    Fault fault;
  };

  static std::array<Fault, fault_targets> of_parameters(const FaultParams& p);
  static Fault sized(const Fault& of_parameters, const FaultRequest& request);
  static std::string refusal(const FaultRequest& request);

  std::array<Fault, fault_targets> parameters_, in_force_;
  std::array<Held, fault_targets> requests_;
  bool changed_ = true, moving_ = false;
};

inline std::array<Fault, fault_targets> Faults::of_parameters(const FaultParams& p) {
  std::array<Fault, fault_targets> out;
  const SensorFaultParams& s = p.sensors_that_fail;
  const auto sensor = [&](FaultTarget target, SensorFault kind, const Eigen::Vector3d& size, double scale) {
    out[at(target)] = {kind_of(target, kind), size, scale, s.fault_noise, s.fault_time};
  };
  sensor(FaultTarget::gyro, s.gyro_fault, eigen(s.gyro_fault_size.value), s.gyro_fault_scale);
  sensor(FaultTarget::accel, s.accel_fault, eigen(s.accel_fault_size.value), s.accel_fault_scale);
  sensor(FaultTarget::gnss_position, s.gnss_position_fault, eigen(s.gnss_position_fault_size.value),
         s.gnss_position_fault_scale);
  sensor(FaultTarget::gnss_velocity, s.gnss_velocity_fault, eigen(s.gnss_velocity_fault_size.value),
         s.gnss_velocity_fault_scale);
  sensor(FaultTarget::mag, s.mag_fault, eigen(s.mag_fault_size.value), s.mag_fault_scale);
  sensor(FaultTarget::baro, s.baro_fault, {s.baro_fault_size, 0, 0}, s.baro_fault_scale);
  sensor(FaultTarget::pitot, s.pitot_fault, {s.pitot_fault_size, 0, 0}, s.pitot_fault_scale);
  const BodyFaultParams& b = p.body_that_fails;
  const auto body = [&](FaultTarget target, auto kind) -> Fault& {
    out[at(target)].kind = kind_of(target, kind);
    return out[at(target)];
  };
  body(FaultTarget::aileron, b.aileron_fault.value).share = b.fault_speed;
  body(FaultTarget::elevator, b.elevator_fault.value).share = b.fault_speed;
  body(FaultTarget::rudder, b.rudder_fault.value).share = b.fault_speed;
  body(FaultTarget::engine, b.engine_fault.value).share = b.engine_fault_share;
  body(FaultTarget::battery, b.battery_fault.value).time_s = b.battery_fault_time;
  Fault& ice = out[at(FaultTarget::icing)];
  ice.rate = b.icing_rate;
  ice.kind = ice.rate > 0 ? FaultKind::growing : ice.rate < 0 ? FaultKind::melting : FaultKind::none;
  return out;
}

}  // namespace fulmar::sim

#include "fault_request_rules.hpp"

// SPDX-License-Identifier: BSD-3-Clause
// Conversion of radians to the inputs of the controller's mixer: mode 0, u[0] throttle, u[3] aileron, u[4]
// elevator, u[5] rudder. ROSflight firmware 2.0, command manager and mixer: with the fixed-wing mixers and
// REV_* at 0, u = 1 is the full throw of a positive deflection as in Beard & McLain. Only here `reversed` of
// the airframe reverses a surface.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

#include "fulmar/msg/actuators.hpp"
#include "fulmar/msg/airframe.hpp"
#include "fulmar/msg/aux_outputs.hpp"
#include "link/messages.hpp"
#include "messages.hpp"

namespace fulmar::fcu {

/// Converts deflections in radians to -1..1, with their sign.
struct Throws {
  double aileron = 1, elevator = 1, rudder = 1;  ///< rad at u = 1; negative when reversed

  static Throws of(const Airframe& a) {
    return {one(a.aileron, "aileron"), one(a.elevator, "elevator"), one(a.rudder, "rudder")};
  }

 private:
  static double one(const Surface& s, const char* name) {
    if (!(s.limit_rad > 0.01) || !std::isfinite(s.limit_rad))
      throw std::runtime_error(located("airframe." + std::string(name) + ".limit",
                                       fcu_serial_messages::throw_too_small(name, s.limit_rad))
                                   .line());
    return s.reversed ? -s.limit_rad : s.limit_rad;
  }
};

/// No value when a command is not finite: one NaN makes every output of the controller NaN, that of the motor
/// included.
inline std::optional<OffboardControl> to_offboard(const Actuators& a, const Throws& t) {
  if (!std::isfinite(a.throttle_frac) || !std::isfinite(a.aileron_rad) || !std::isfinite(a.elevator_rad) ||
      !std::isfinite(a.rudder_rad))
    return {};
  OffboardControl c;
  c.u[0] = static_cast<float>(std::clamp(a.throttle_frac, 0.0, 1.0));
  c.u[3] = static_cast<float>(std::clamp(a.aileron_rad / t.aileron, -1.0, 1.0));
  c.u[4] = static_cast<float>(std::clamp(a.elevator_rad / t.elevator, -1.0, 1.0));
  c.u[5] = static_cast<float>(std::clamp(a.rudder_rad / t.rudder, -1.0, 1.0));
  return c;
}

inline std::optional<RosflightAuxCmd> to_aux(const AuxOutputs& a) {
  RosflightAuxCmd c;
  for (std::size_t i = 0; i < c.type_array.size(); ++i) {
    if (a.kinds[i] == AuxKind::off) continue;
    if (!std::isfinite(a.values_ratio[i])) return {};
    c.type_array[i] = static_cast<std::uint8_t>(a.kinds[i]);
    c.aux_cmd_array[i] =
        static_cast<float>(std::clamp(a.values_ratio[i], a.kinds[i] == AuxKind::motor ? 0.0 : -1.0, 1.0));
  }
  return c;
}

/// Stops a motor that is switched off: the firmware keeps the value of a disabled output. `motors`: those
/// commanded so far.
inline void stop_motors(RosflightAuxCmd& c, std::array<bool, 14>& motors) {
  constexpr auto motor = static_cast<std::uint8_t>(AuxKind::motor);
  for (std::size_t i = 0; i < motors.size(); ++i) {
    if (c.type_array[i] != 0) motors[i] = c.type_array[i] == motor;
    if (motors[i]) c.type_array[i] = motor;
  }
}

/// Normalised to length 1, which the firmware does not do. No value for an invalid attitude.
inline std::optional<ExternalAttitude> to_external_attitude(const Quat& q) {
  const double norm = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  if (!(std::abs(norm - 1) < 0.1)) return {};
  return ExternalAttitude{static_cast<float>(q.w / norm), static_cast<float>(q.x / norm),
                          static_cast<float>(q.y / norm), static_cast<float>(q.z / norm)};
}

}  // namespace fulmar::fcu

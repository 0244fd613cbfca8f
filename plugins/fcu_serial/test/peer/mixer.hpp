// SPDX-License-Identifier: BSD-3-Clause
// From ten commands to fourteen outputs, as ROSflight 2.0 does it: two matrices, one for the pilot's commands
// and one for the computer's.
#pragma once
#include <array>
#include <cmath>
#include <cstdint>

#include "params.hpp"

namespace fulmar::fcu::peer {

enum class OutputType : std::uint8_t { aux = 0, servo = 1, motor = 2, gpio = 3 };

using Commands = std::array<float, 10>;
using Outputs14 = std::array<float, 14>;
using Matrix10 = std::array<std::array<float, 10>, 10>;  ///< [input][output]

enum Mixer : std::int32_t { mixer_fixed_wing = 9, mixer_inverted_vtail = 10, mixer_custom = 11 };

struct CannedMixer {
  std::array<OutputType, 10> type{};
  Matrix10 m{};
};

inline CannedMixer canned(std::int32_t choice) {
  CannedMixer c;
  if (choice < mixer_fixed_wing) {  // those of multirotors: motors without a command
    c.type.fill(OutputType::motor);
    return c;
  }
  c.type[0] = c.type[1] = c.type[2] = OutputType::servo;
  c.type[4] = OutputType::motor;
  c.m[0][4] = c.m[3][0] = 1;
  if (choice == mixer_fixed_wing) {
    c.m[4][1] = c.m[5][2] = 1;
  } else {
    c.m[4][1] = -0.5f;
    c.m[4][2] = c.m[5][1] = c.m[5][2] = 0.5f;
  }
  return c;
}

class Mixing {
 public:
  /// Reads PRIMARY_MIXER and SECONDARY_MIXER, and writes the matrix of a canned one into the parameters.
  /// Returns false for an unknown one.
  bool load(Params& p) {
    const std::int32_t choice = p.i(param("PRIMARY_MIXER")), second = p.i(param("SECONDARY_MIXER"));
    valid_ = choice >= 0 && choice <= mixer_custom;
    if (!valid_) {
      type_.fill(OutputType::aux);
      primary_ = secondary_ = {};
      return false;
    }
    if (choice != mixer_custom) save_primary(p, canned(choice));
    read(p, primary_params, primary_);
    for (std::size_t j = 0; j < 10; ++j) type_[j] = static_cast<OutputType>(p.i(mixer_out_params + j));
    if (second != mixer_custom) save(p, secondary_params, canned_secondary(second));
    read(p, secondary_params, secondary_);
    return true;
  }
  bool valid() const { return valid_; }
  OutputType type(std::size_t j) const { return j < 10 ? type_[j] : OutputType::aux; }
  const Matrix10& primary() const { return primary_; }

  /// Rows 0 to 2 by the source of the throttle, 3 to 5 by that of the attitude, the rest primary.
  Outputs14 mix(const Commands& u, bool pilot_throttle, bool pilot_attitude) const {
    Outputs14 out{};
    for (std::size_t j = 0; j < 10; ++j)
      for (std::size_t i = 0; i < 10; ++i) {
        const bool primary = i < 3 ? pilot_throttle : i < 6 ? pilot_attitude : true;
        out[j] += (primary ? primary_ : secondary_)[i][j] * u[i];  // one NaN makes all of it NaN: 0 * NaN
      }
    return out;
  }

 private:
  /// 255 mirrors the primary. The canned V-tail goes in pseudo-inverted here, which doubles its gains: so
  /// does the firmware.
  Matrix10 canned_secondary(std::int32_t choice) const {
    if (choice < 0 || choice > mixer_custom) return primary_;
    Matrix10 m = canned(choice).m;
    if (choice == mixer_inverted_vtail)
      for (std::size_t i : {4u, 5u})
        for (float& gain : m[i]) gain *= 2;
    return m;
  }
  static void save(Params& p, std::size_t base, const Matrix10& m) {
    for (std::size_t j = 0; j < 10; ++j)
      for (std::size_t i = 0; i < 10; ++i) p.set(base + 10 * j + i, m[i][j]);
  }
  static void save_primary(Params& p, const CannedMixer& c) {
    for (std::size_t j = 0; j < 10; ++j) {
      p.set(mixer_out_params + j, static_cast<std::int32_t>(c.type[j]));
      p.set(mixer_pwm_params + j, 50.f);
    }
    save(p, primary_params, c.m);
  }
  static void read(const Params& p, std::size_t base, Matrix10& m) {
    for (std::size_t j = 0; j < 10; ++j)
      for (std::size_t i = 0; i < 10; ++i) m[i][j] = p.f(base + 10 * j + i);
  }

  bool valid_ = false;
  std::array<OutputType, 10> type_{};
  Matrix10 primary_{}, secondary_{};
};

/// Effect of the servos of mixers 9 and 10 on the aircraft, -1..1 and throttle 0..1: the inverse mixer.
struct Deflected {
  double throttle = 0, aileron = 0, elevator = 0, rudder = 0;
};
inline Deflected unmix(std::int32_t choice, const Outputs14& out) {
  const auto servo = [&](std::size_t j) { return 2 * static_cast<double>(out[j]) - 1; };
  Deflected d{static_cast<double>(out[4]), servo(0), servo(1), servo(2)};
  if (choice == mixer_inverted_vtail) {
    d.elevator = servo(2) - servo(1);
    d.rudder = servo(2) + servo(1);
  }
  return d;
}

}  // namespace fulmar::fcu::peer

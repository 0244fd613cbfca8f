// SPDX-License-Identifier: BSD-3-Clause
// The recent truth, so that a sample can be compared with the truth at its own time of validity.
#pragma once
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "fulmar/flight/math/angles.hpp"
#include "fulmar/msg/vehicle_state.hpp"

namespace fulmar::score {

/// The 13 numbers of a VehicleState that are compared.
struct Compared {
  double north = 0, east = 0, height = 0, vel_x = 0, vel_y = 0, vel_z = 0, airspeed = 0, wind_n = 0,
         wind_e = 0;
  double roll = 0, pitch = 0, heading = 0, course = 0;
};

inline Compared compared(const VehicleState& s) {
  const Vec3<Body> v = to_body(s.attitude, s.velocity_mps);
  return {s.position_m.north, s.position_m.east, s.height_m,      v.x,        v.y,         v.z,
          s.airspeed_mps,     s.wind_mps.north,  s.wind_mps.east, s.roll_rad, s.pitch_rad, s.yaw_rad,
          s.course_rad};
}

/// A sample that waits for the truth of its time.
struct Pending {
  bool waits = false;
  std::int64_t time_ns = 0;
  Compared sample;
};

/// Interpolates between two samples; angles take the short way.
inline Compared between(const Compared& a, const Compared& b, double t) {
  const auto mix = [t](double x, double y) { return x + t * (y - x); };
  const auto turn = [t](double x, double y) { return wrap_pi(x + t * wrap_pi(y - x)); };
  return {mix(a.north, b.north),       mix(a.east, b.east),     mix(a.height, b.height),
          mix(a.vel_x, b.vel_x),       mix(a.vel_y, b.vel_y),   mix(a.vel_z, b.vel_z),
          mix(a.airspeed, b.airspeed), mix(a.wind_n, b.wind_n), mix(a.wind_e, b.wind_e),
          turn(a.roll, b.roll),        turn(a.pitch, b.pitch),  turn(a.heading, b.heading),
          turn(a.course, b.course)};
}

class TruthHistory {
 public:
  enum class Found : std::uint8_t { yes, not_yet, too_old };

  void add(std::int64_t time_ns, const Compared& sample) {
    if (count_ > 0 && time_ns <= newest().time_ns) return;
    ring_[count_++ % ring_.size()] = {time_ns, sample};
  }

  Found at(std::int64_t time_ns, Compared& result) const {
    if (count_ == 0 || newest().time_ns < time_ns) return Found::not_yet;
    const std::uint64_t kept = count_ < ring_.size() ? count_ : ring_.size();
    for (std::uint64_t k = 1; k <= kept; ++k) {
      const Entry& before = ring_[(count_ - k) % ring_.size()];
      if (before.time_ns > time_ns) continue;
      result = before.sample;
      if (before.time_ns == time_ns) return Found::yes;
      const Entry& after = ring_[(count_ - k + 1) % ring_.size()];
      const double t =
          static_cast<double>(time_ns - before.time_ns) / static_cast<double>(after.time_ns - before.time_ns);
      result = between(before.sample, after.sample, t);
      return Found::yes;
    }
    return Found::too_old;
  }

 private:
  struct Entry {
    std::int64_t time_ns = 0;
    Compared sample;
  };
  const Entry& newest() const { return ring_[(count_ - 1) % ring_.size()]; }

  std::array<Entry, 64> ring_{};  // 1.28 s at 50 Hz: a fix is never older
  std::uint64_t count_ = 0;
};

}  // namespace fulmar::score

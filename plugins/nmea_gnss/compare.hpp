// SPDX-License-Identifier: BSD-3-Clause
// Difference between the estimate and the reference, for the summary of a flight.
#pragma once
#include <array>
#include <cmath>
#include <cstdint>

#include "fulmar/eigen.hpp"
#include "fulmar/flight/earth/geodesy.hpp"
#include "fulmar/msg/gnss.hpp"
#include "fulmar/msg/vehicle_state.hpp"
#include "fulmar/plugin.hpp"

namespace fulmar::nmea {

/// Estimate minus reference, both at the time of the reference: root mean squares since the first fix.
struct ReferenceDifference {
  double north_m = 0, east_m = 0;  ///< position difference, north and east
  double horizontal_m = 0;         ///< horizontal distance
  double height_m = 0;             ///< height difference
  double horizontal_max_m = 0;     ///< largest horizontal distance
  std::uint32_t samples = 0;       ///< number of compared fixes
};

struct Compare {
  static constexpr const char* doc = "Distance between the estimate and the reference receiver.";
  struct Inputs {
    In<VehicleState> state;
    Queue<Gnss> reference;
  };
  struct Outputs {
    Out<ReferenceDifference> difference;  // at every fix
    Probe horizontal_m;                   // of the last fix
  };
  struct Params {
    Param latency{0, "s", 0, 0.6, "delay from the time of a reference fix to its arrival"};
  };

  Status step(const Tick&, const Inputs& in, const Params& p, Outputs& out) {
    const VehicleState& s = *in.state;
    if (!s.position_valid || !s.origin_valid) return Status::ok;
    if (in.state.fresh()) past_[count_++ % past_.size()] = {in.state.valid_at_ns(), s.position_m};
    know_origin(s);
    for (const auto& fix : in.reference) {
      const FixType kind = fix.value.fix;
      if (kind == FixType::none || kind == FixType::time_only || kind == FixType::dead_reckoning) continue;
      if (Vec3<Ned> then; at(fix.valid_at_ns - std::llround(1e9 * p.latency), then))
        add(fix.value, then, out);
    }
    return Status::ok;
  }

 private:
  struct Past {
    std::int64_t time_ns = 0;
    Vec3<Ned> position_m;
  };

  /// The estimate at a time, interpolated, or extrapolated for a short time. Returns false when it is too
  /// old.
  bool at(std::int64_t time_ns, Vec3<Ned>& result) const {
    const std::uint64_t kept = count_ < past_.size() ? count_ : past_.size();
    for (std::uint64_t k = 1; k <= kept; ++k) {
      const Past& before = past_[(count_ - k) % past_.size()];
      if (before.time_ns > time_ns) continue;
      result = before.position_m;
      if (k == 1 || before.time_ns == time_ns) return true;
      const Past& after = past_[(count_ - k + 1) % past_.size()];
      const double t =
          static_cast<double>(time_ns - before.time_ns) / static_cast<double>(after.time_ns - before.time_ns);
      result = from_eigen<Ned>(eigen(before.position_m) +
                               t * (eigen(after.position_m) - eigen(before.position_m)));
      return true;
    }
    return false;
  }

  void add(const Gnss& fix, const Vec3<Ned>& estimate, Outputs& out) {
    const Eigen::Vector3d error =
        eigen(estimate) - frame_.to_ned(fix.latitude_deg, fix.longitude_deg, fix.altitude_m);
    const double n = ++samples_;
    for (std::size_t i = 0; i < 3; ++i) {
      const double e = error[static_cast<Eigen::Index>(i)];
      mean_square_[i] += (e * e - mean_square_[i]) / n;
    }
    const double horizontal = std::hypot(error.x(), error.y());
    max_m_ = std::max(max_m_, horizontal);
    const auto& m = mean_square_;
    out.difference.publish({std::sqrt(m[0]), std::sqrt(m[1]), std::sqrt(m[0] + m[1]), std::sqrt(m[2]), max_m_,
                            static_cast<std::uint32_t>(samples_)});
    out.horizontal_m = horizontal;
  }

  void know_origin(const VehicleState& s) {
    const LocalFrame::Geodetic o = frame_.origin();
    if (o.lat_deg == s.origin_latitude_deg && o.lon_deg == s.origin_longitude_deg &&
        o.alt_m == s.origin_altitude_m)
      return;
    frame_ = LocalFrame(s.origin_latitude_deg, s.origin_longitude_deg, s.origin_altitude_m);
  }

  std::array<Past, 128> past_{};  // 1.28 s at 100 Hz
  std::uint64_t count_ = 0;
  LocalFrame frame_;
  std::array<double, 3> mean_square_{};
  double samples_ = 0, max_m_ = 0;
};

}  // namespace fulmar::nmea

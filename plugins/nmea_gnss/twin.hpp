// SPDX-License-Identifier: BSD-3-Clause
// The simulated twin of the receiver: the truth with errors and latency, in the same message. Fills the same
// role.
#pragma once
#include <array>
#include <cmath>
#include <cstdint>
#include <stdexcept>

#include "fulmar/eigen.hpp"
#include "fulmar/flight/earth/geodesy.hpp"
#include "fulmar/msg/gnss.hpp"
#include "fulmar/msg/vehicle_state.hpp"
#include "fulmar/plugin.hpp"
#include "fulmar/random.hpp"
#include "messages.hpp"

namespace fulmar::nmea {

struct Twin {
  static constexpr const char* doc = "Simulated receiver: the truth with errors, in the same message.";
  struct Inputs {
    In<VehicleState> truth;
    Optional<Gnss> clock;  // fix of the vehicle: source of the UTC
  };
  struct Outputs {
    OutQueue<Gnss, 16> gnss;
  };
  struct Params {
    Param rate{5, "Hz", 0.1, 20, "rate of the solutions", setup};
    Param latency{0.1, "s", 0, 0.5, "delay from the time of a solution to its arrival", setup};
    Param horizontal_std{0.7,  "m", 0, 100, "standard deviation of the slow horizontal error, each axis",
                         setup};
    Param vertical_std{1.2, "m", 0, 100, "standard deviation of the slow vertical error", setup};
    Param correlation_time{60, "s", 0.1, 1e5, "correlation time of the slow errors", setup};
    Param white_std{0.05, "m", 0, 100, "standard deviation of the white error of a sample, each axis", setup};
    Param speed_std{0.05, "m/s", 0, 10, "standard deviation of the ground speed error, each axis", setup};
  };

  explicit Twin(std::uint64_t seed) : random_(seed) {}

  void configure(const Params& p) {
    if (p.latency * p.rate > static_cast<double>(late_.size() - 1))
      throw std::runtime_error(located("latency", nmea_gnss_messages::latency_too_long(
                                                      p.latency.value, p.rate.value,
                                                      static_cast<double>(late_.size() - 1) / p.rate))
                                   .line());
    period_ns_ = std::llround(1e9 / p.rate);
    latency_ns_ = std::llround(1e9 * p.latency);
    decay_ = std::exp(-1 / (p.rate * p.correlation_time));
    for (std::size_t i = 0; i < 3; ++i) slow_[i] = deviation(p, i) * random_.normal();
  }

  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
    if (in.clock && in.clock->utc_ns != 0) utc_offset_ns_ = in.clock->utc_ns - in.clock.valid_at_ns();
    const std::int64_t taken_ns = in.truth.valid_at_ns();
    if (in.truth->origin_valid && (!started_ || taken_ns >= next_ns_)) {
      next_ns_ = started_ ? next_ns_ + period_ns_ : taken_ns + period_ns_;
      if (next_ns_ <= taken_ns) next_ns_ = taken_ns + period_ns_;  // after a gap
      started_ = true;
      late_[(first_ + count_++) % late_.size()] = {solution(*in.truth, p, taken_ns), taken_ns + latency_ns_};
    }
    while (count_ > 0 && late_[first_].due_ns <= tick.now_ns) {
      out.gnss.push(late_[first_].sample, tick.now_ns);  // stamped on arrival, as by the receiver
      first_ = (first_ + 1) % late_.size();
      --count_;
    }
    return Status::ok;
  }

 private:
  struct Late {
    Gnss sample;
    std::int64_t due_ns = 0;
  };
  static double deviation(const Params& p, std::size_t axis) {
    return axis < 2 ? p.horizontal_std : p.vertical_std;
  }

  Gnss solution(const VehicleState& truth, const Params& p, std::int64_t taken_ns) {
    Eigen::Vector3d p_n = eigen(truth.position_m);
    for (std::size_t i = 0; i < 3; ++i) {  // Gauss-Markov, discretised exactly
      slow_[i] = decay_ * slow_[i] + deviation(p, i) * std::sqrt(1 - decay_ * decay_) * random_.normal();
      p_n[static_cast<Eigen::Index>(i)] += slow_[i] + p.white_std * random_.normal();
    }
    know_origin(truth);
    const LocalFrame::Geodetic g = frame_.from_ned(p_n);
    Gnss out;
    out.latitude_deg = g.lat_deg;
    out.longitude_deg = g.lon_deg;
    out.altitude_m = g.alt_m;
    const double v_n = truth.velocity_mps.north + p.speed_std * random_.normal();
    const double v_e = truth.velocity_mps.east + p.speed_std * random_.normal();
    out.velocity_mps = {v_n, v_e, 0};  // NMEA 0183 has no vertical speed
    out.horizontal_std_m = std::hypot(p.horizontal_std, p.white_std);
    out.vertical_std_m = std::hypot(p.vertical_std, p.white_std);
    if (utc_offset_ns_ != 0) out.utc_ns = taken_ns + utc_offset_ns_;
    out.fix = FixType::fix_3d;
    out.satellites = 12;
    return out;
  }

  void know_origin(const VehicleState& truth) {
    const LocalFrame::Geodetic o = frame_.origin();
    if (o.lat_deg == truth.origin_latitude_deg && o.lon_deg == truth.origin_longitude_deg &&
        o.alt_m == truth.origin_altitude_m)
      return;
    frame_ = LocalFrame(truth.origin_latitude_deg, truth.origin_longitude_deg, truth.origin_altitude_m);
  }

  Random random_;
  LocalFrame frame_;
  std::array<double, 3> slow_{};
  double decay_ = 0;
  std::array<Late, 16> late_{};
  std::size_t first_ = 0, count_ = 0;
  std::int64_t period_ns_ = 1, latency_ns_ = 0, next_ns_ = 0, utc_offset_ns_ = 0;
  bool started_ = false;
};

}  // namespace fulmar::nmea

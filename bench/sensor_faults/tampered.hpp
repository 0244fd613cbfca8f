// SPDX-License-Identifier: BSD-3-Clause
// Stands on the wires between an aircraft and its navigation filter, and spoils one sensor for a while: what
// the simulated aircraft's own faults do not know. Everything else passes as it came, in the same tick.
#pragma once
#include <cmath>
#include <cstdint>
#include <numbers>

#include "fulmar/eigen.hpp"
#include "fulmar/msg/baro.hpp"
#include "fulmar/msg/gnss.hpp"
#include "fulmar/msg/imu.hpp"
#include "fulmar/msg/mag.hpp"
#include "fulmar/msg/pitot.hpp"
#include "fulmar/msg/vehicle_status.hpp"
#include "fulmar/plugin.hpp"
#include "fulmar/random.hpp"

namespace fulmar::tampered {

enum class Kind : std::uint8_t {
  none,
  gnss_jump,      ///< step of the position by `size` m north
  gnss_drift,     ///< drift of the position by `size` m/s north; the velocity stays correct
  gnss_pull,      ///< drift of position and velocity north: `size` m/s, reached by `rate` m/s2
  baro_step,      ///< step by `size` Pa
  baro_drift,     ///< `size` Pa, at `rate` Pa/s
  gyro_drift,     ///< about every axis `size` rad/s, at `rate` rad/s2
  accel_step,     ///< along x and y `size` m/s2 at once
  mag_stuck,      ///< the last sample is repeated
  mag_motor,      ///< `size` T per ampere of the motor, forward and to the right in equal parts
  pitot_scale,    ///< pressure times `size`
  pitot_offset,   ///< pressure plus `size` Pa
  pitot_blocked,  ///< the pressure at the begin stays, with the sensor's noise
  pitot_iced,     ///< pressure decays to zero with the time constant `size` s
  pitot_zeroed,   ///< the present reading becomes the zero
  imu_gap,        ///< no samples
  gyro_clipped,   ///< each axis limited to +-`size` rad/s
  accel_clipped,  ///< each axis limited to +-`size` m/s2
  imu_vibration,  ///< white noise of `size` m/s2, and of a twentieth of it in rad/s
  imu_stamps,     ///< every tenth sample is stamped `size` s too early
  imu_clock,      ///< every sample is stamped `size` s too early
  gnss_stamps,    ///< every other fix is stamped `size` s too early
  baro_stamps     ///< every sample is stamped too early, before the previous one
};

struct Wires {
  struct Inputs {
    Optional<Imu> imu;
    Optional<Gnss> gnss;
    Optional<Mag> mag;
    Optional<Baro> baro;
    Optional<Pitot> pitot;
    Optional<VehicleStatus> status;
  };
  struct Outputs {
    Out<Imu> imu;
    Out<Gnss> gnss;
    Out<Mag> mag;
    Out<Baro> baro;
    Out<Pitot> pitot;
    Probe spoilt_ratio;  ///< 1 from the first changed sample on, and after 0.1 s at a limit
  };
  struct Params {
    Choice<Kind> kind{Kind::none, "what is spoilt", setup};
    Param size{0, "", -1e9, 1e9, "how much, in the unit of the kind", setup};
    Param rate{1, "", 0, 1e9, "how soon, of a pull", setup};
    Param from{0, "s", -1e9, 1e9, "flight time", setup};
    Param lasts{20, "s", 0, 1e9, "then all is as before", setup};
  };

  explicit Wires(std::uint64_t seed) : random_(seed) {}

  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
    since_s_ = tick.now_s() - p.from;
    kind_ = since_s_ >= 0 && since_s_ < p.lasts ? p.kind.value : Kind::none;
    pass(in.imu, out.imu, [&](Imu& s, std::int64_t& at_ns) { return spoil(s, at_ns, p); });
    pass(in.gnss, out.gnss, [&](Gnss& s, std::int64_t& at_ns) { return spoil(s, at_ns, p); });
    pass(in.mag, out.mag, [&](Mag& s, std::int64_t&) { return spoil(s, in, p); });
    pass(in.baro, out.baro, [&](Baro& s, std::int64_t& at_ns) { return spoil(s, at_ns, p); });
    pass(in.pitot, out.pitot, [&](Pitot& s, std::int64_t&) { return spoil(s, p); });
    const bool clips = kind_ == Kind::gyro_clipped || kind_ == Kind::accel_clipped;
    spoilt_ = spoilt_ || (kind_ != Kind::none && !clips);
    out.spoilt_ratio = spoilt_;
    return Status::ok;
  }

 private:
  template <class T, class Spoil>
  static void pass(const Optional<T>& in, Out<T>& out, Spoil spoil) {
    if (!in || !in.fresh()) return;
    T sample = *in;
    std::int64_t at_ns = in.valid_at_ns();
    if (spoil(sample, at_ns)) out.publish(sample, at_ns);
  }
  static std::int64_t ns(double s) { return std::llround(1e9 * s); }
  void clip(Vec3<Body>& v, double limit) {
    bool beyond = false;
    for (double* x : {&v.x, &v.y, &v.z}) {
      beyond = beyond || std::abs(*x) > limit;
      *x = std::clamp(*x, -limit, limit);
    }
    clipped_ = beyond ? clipped_ + 1 : 0;
    spoilt_ = spoilt_ || clipped_ >= 40;
  }

  bool spoil(Imu& s, std::int64_t& at_ns, const Params& p) {
    Vec3<Body>&f = s.specific_force_mps2, &w = s.rate_radps;
    const std::int64_t early_ns = ns(p.size);
    switch (kind_) {
      case Kind::imu_gap: return false;
      case Kind::gyro_clipped: clip(w, p.size); break;
      case Kind::accel_clipped: clip(f, p.size); break;
      case Kind::imu_vibration:
        for (double* x : {&f.x, &f.y, &f.z}) *x += p.size * random_.normal();
        for (double* x : {&w.x, &w.y, &w.z}) *x += 0.05 * p.size * random_.normal();
        break;
      case Kind::gyro_drift:
        for (double* x : {&w.x, &w.y, &w.z}) *x += std::min(p.size.value, p.rate * since_s_);
        break;
      case Kind::accel_step:
        f.x += p.size;
        f.y += p.size;
        break;
      case Kind::imu_stamps: at_ns -= ++imu_count_ % 10 == 0 ? early_ns : 0; break;
      case Kind::imu_clock: at_ns -= early_ns; break;
      default: break;
    }
    return true;
  }
  bool spoil(Gnss& s, std::int64_t& at_ns, const Params& p) {
    const auto move = [&](double north_m) {
      constexpr double radius_m = 6.36e6;  // along the meridian, at middle latitudes
      s.latitude_deg += north_m / radius_m * 180 / std::numbers::pi;
    };
    const double begun_s = std::min(since_s_, p.size / p.rate);  // while the pull still grows
    switch (kind_) {
      case Kind::gnss_jump: move(p.size); break;
      case Kind::gnss_drift: move(p.size * since_s_); break;
      case Kind::gnss_pull:
        move(0.5 * p.rate * begun_s * begun_s + p.size * (since_s_ - begun_s));
        s.velocity_mps.north += p.rate * begun_s;
        break;
      case Kind::gnss_stamps: at_ns -= ++gnss_count_ % 2 == 0 ? ns(p.size) : 0; break;
      default: break;
    }
    return true;
  }
  bool spoil(Mag& s, const Inputs& in, const Params& p) {
    if (kind_ == Kind::mag_stuck)
      s = mag_;
    else
      mag_ = s;
    if (kind_ == Kind::mag_motor && in.status) {
      const double off_tesla = p.size * in.status->battery_amp / std::numbers::sqrt2;
      s.field_tesla.x += off_tesla;
      s.field_tesla.y += off_tesla;
    }
    return true;
  }
  bool spoil(Baro& s, std::int64_t& at_ns, const Params& p) const {
    if (kind_ == Kind::baro_step) s.pressure_pa += p.size;
    if (kind_ == Kind::baro_drift) s.pressure_pa += std::min(p.size.value, p.rate * since_s_);
    if (kind_ == Kind::baro_stamps) at_ns -= ns(p.size);
    return true;
  }
  bool spoil(Pitot& s, const Params& p) {
    if (kind_ == Kind::none) before_pa_ += 0.02 * (s.pressure_pa - before_pa_);
    switch (kind_) {
      case Kind::pitot_scale: s.pressure_pa *= p.size; break;
      case Kind::pitot_offset: s.pressure_pa += p.size; break;
      case Kind::pitot_blocked: s.pressure_pa = before_pa_ + random_.normal(); break;
      case Kind::pitot_iced: s.pressure_pa *= std::exp(-since_s_ / p.size); break;
      case Kind::pitot_zeroed: s.pressure_pa -= before_pa_; break;
      default: break;
    }
    const double speed = std::sqrt(2 * std::abs(s.pressure_pa) / 1.225);
    s.indicated_airspeed_mps = std::copysign(speed, s.pressure_pa);
    return true;
  }

  Random random_;
  Kind kind_ = Kind::none;
  bool spoilt_ = false;
  double since_s_ = 0, before_pa_ = 0;
  Mag mag_;
  std::uint64_t clipped_ = 0, imu_count_ = 0, gnss_count_ = 0;
};

}  // namespace fulmar::tampered

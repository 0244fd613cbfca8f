// SPDX-License-Identifier: BSD-3-Clause
// From the state of the aircraft to what its sensors say, each at its own rate. Beard & McLain, chapter 7.
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "fulmar/eigen.hpp"
#include "fulmar/flight/atmosphere.hpp"
#include "fulmar/flight/geodesy.hpp"
#include "fulmar/msg/baro.hpp"
#include "fulmar/msg/gnss.hpp"
#include "fulmar/msg/imu.hpp"
#include "fulmar/msg/mag.hpp"
#include "fulmar/msg/pitot.hpp"
#include "fulmar/sim/plant.hpp"
#include "presets.hpp"
#include "sensor_faults.hpp"

namespace fulmar::sim {

/// True once per period: integer nanoseconds, so no remainder builds up.
class Due {
 public:
  Due() = default;
  Due(double rate_hz, std::int64_t first_ns) : period_ns_(std::llround(1e9 / rate_hz)), next_ns_(first_ns) {}
  bool operator()(std::int64_t now_ns) {
    if (now_ns < next_ns_) return false;
    do next_ns_ += period_ns_;
    while (next_ns_ <= now_ns);
    return true;
  }

 private:
  std::int64_t period_ns_ = 1, next_ns_ = 0;
};

/// Rounded to the 24 bits of single precision. Not by a cast to float and back: where g++ 12 makes vectors of
/// it, it leaves it out.
inline double to_single(double value) {
  constexpr std::uint64_t lost = (std::uint64_t{1} << 29) - 1;
  return std::bit_cast<double>((std::bit_cast<std::uint64_t>(value) + (lost >> 1) + 1) & ~lost);
}

class Sensors {
 public:
  Sensors(const SensorSpec& spec, double tick_hz, const LocalFrame& frame, const Eigen::Vector3d& field_n,
          std::uint64_t seed)
      : spec_(spec),
        frame_(frame),
        field_n_(field_n),
        imu_random_(mix_seed(seed, 1)),
        gnss_random_(mix_seed(seed, 2)),
        mag_random_(mix_seed(seed, 3)),
        baro_random_(mix_seed(seed, 4)),
        pitot_random_(mix_seed(seed, 5)),
        faults_(spec, tick_hz, seed) {
    const auto dt = [&](double hz) { return 1 / std::min(hz, tick_hz); };
    gyro_ = Noise3(spec.gyro, dt(spec.imu_hz), imu_random_);
    accel_ = Noise3(spec.accel, dt(spec.imu_hz), imu_random_);
    mag_ = Noise3(spec.mag, dt(spec.mag_hz), mag_random_);
    baro_ = Noise(spec.baro, dt(spec.baro_hz), baro_random_);
    pitot_ = Noise(spec.pitot, dt(spec.pitot_hz), pitot_random_);
    pitot_scale_ = 1 + pitot_random_.uniform(-spec.pitot_scale, spec.pitot_scale);
    gnss_position_ = Noise3(spec.gnss_position, dt(spec.gnss_hz), gnss_random_);
    gnss_velocity_ = Noise3(spec.gnss_velocity, dt(spec.gnss_hz), gnss_random_);
  }

  Imu imu(const Plant& plant) {
    Imu out;
    out.rate_radps = sent<Body>(faults_.gyro(plant.state().omega_b + gyro_.next(imu_random_)));
    out.specific_force_mps2 = sent<Body>(faults_.accel(plant.specific_force() + accel_.next(imu_random_)));
    out.temperature_kelvin = spec_.temperature_kelvin;
    return out;
  }

  Mag mag(const Plant& plant) {
    return {sent<Body>(faults_.mag(plant.seen().q_nb.conjugate() * field_n_ + mag_.next(mag_random_)))};
  }

  Baro baro(const Plant& plant) {
    return {sent(faults_.baro(plant.air().pressure_pa + baro_.next(baro_random_))), spec_.temperature_kelvin};
  }

  /// (7.10); the tube takes all of the flow up to 20 degrees off its axis, less beyond, and nothing from 60
  /// degrees on.
  Pitot pitot(const Plant& plant) {
    const Eigen::Vector3d v_r = plant.air_velocity_b();
    const double Va = v_r.norm(), cosine = Va > 0 ? v_r.x() / Va : 1;
    const double taken = std::clamp((cosine - 0.5) / (0.9397 - 0.5), 0.0, 1.0);
    Pitot out;
    out.pressure_pa = sent(faults_.pitot(pitot_scale_ * taken * 0.5 * plant.air().density_kgm3 * Va * Va +
                                         pitot_.next(pitot_random_)));
    out.indicated_airspeed_mps = sent(indicated_airspeed(out.pressure_pa));
    out.temperature_kelvin = spec_.temperature_kelvin;
    return out;
  }

  Gnss gnss(const Plant& plant, std::int64_t utc_ns) {
    const LocalFrame::Geodetic g =
        frame_.from_ned(faults_.position(plant.state().p_n + gnss_position_.next(gnss_random_)));
    Gnss out;
    out.latitude_deg = g.lat_deg;
    out.longitude_deg = g.lon_deg;
    out.altitude_m = g.alt_m;
    out.velocity_mps =
        from_eigen<Ned>(faults_.velocity(plant.seen().v_n + gnss_velocity_.next(gnss_random_)));
    out.horizontal_std_m = spec_.horizontal_std_m;
    out.vertical_std_m = spec_.vertical_std_m;
    out.speed_std_mps = spec_.speed_std_mps;
    out.utc_ns = utc_ns;
    out.fix = FixType::fix_3d;
    out.satellites = 15;
    if (faults_.velocity.off()) out.speed_std_mps = unknown_std;
    if (faults_.position.off()) {  // no solution, as a receiver without sky says it
      out.fix = FixType::none;
      out.satellites = 0;
      out.horizontal_std_m = out.vertical_std_m = unknown_std;
    }
    return out;
  }

  void suffer(const Faults& faults) { faults_.suffer(faults); }
  const SensorFaults& faults() const { return faults_; }

  Eigen::Vector3d gyro_bias() const { return gyro_.bias(); }
  Eigen::Vector3d accel_bias() const { return accel_.bias(); }
  const SensorSpec& spec() const { return spec_; }

 private:
  double sent(double value) const { return spec_.single_precision ? to_single(value) : value; }
  template <class Frame>
  Vec3<Frame> sent(const Eigen::Vector3d& value) const {
    return from_eigen<Frame>(Eigen::Vector3d(sent(value.x()), sent(value.y()), sent(value.z())));
  }

  SensorSpec spec_;
  LocalFrame frame_;
  Eigen::Vector3d field_n_;
  Random imu_random_, gnss_random_, mag_random_, baro_random_,
      pitot_random_;  // one each: dropping a sensor leaves the others as they are
  Noise3 gyro_, accel_, mag_, gnss_position_, gnss_velocity_;
  Noise baro_, pitot_;
  double pitot_scale_ = 1;
  SensorFaults faults_;
};

/// Samples that were taken and are not yet delivered.
template <class T>
class Delay {
 public:
  void push(const T& value, std::int64_t valid_at_ns) {
    items_[(first_ + count_) % items_.size()] = {value, valid_at_ns};
    if (count_ < items_.size())
      ++count_;
    else
      first_ = (first_ + 1) % items_.size();
  }
  struct Item {
    T value;
    std::int64_t valid_at_ns = 0;
  };
  /// The oldest sample, once `delay_ns` have passed since it was valid; else nullptr.
  const Item* pop(std::int64_t now_ns, std::int64_t delay_ns) {
    if (count_ == 0 || now_ns < items_[first_].valid_at_ns + delay_ns) return nullptr;
    const Item* item = &items_[first_];
    first_ = (first_ + 1) % items_.size();
    --count_;
    return item;
  }

 private:
  std::array<Item, 16> items_{};
  std::size_t first_ = 0, count_ = 0;
};

}  // namespace fulmar::sim

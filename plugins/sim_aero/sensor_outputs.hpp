// SPDX-License-Identifier: BSD-3-Clause
// The sensors of the aircraft, each sampled when it is due and published when its sample arrives.
#pragma once
#include <cstdint>
#include <optional>

#include "fulmar/plugin.hpp"
#include "sensors.hpp"

namespace fulmar::sim {

struct SensorSwitches {
  Flag imu_works{true, "operation of the inertial unit; false: silent"};
  Flag gnss_works{true, "operation of the satellite receiver; false: silent"};
  Flag mag_works{true, "operation of the magnetometer; false: silent"};
  Flag baro_works{true, "operation of the barometer; false: silent"};
  Flag pitot_works{true, "operation of the pitot; false: silent"};
};

/// Power-on time of the sensors, and the UTC of flight time 0.
struct SensorClock {
  std::int64_t epoch_ns = 0, power_on_ns = 0, period_ns = 0;
};

class SensorOutputs {
 public:
  SensorOutputs(const SensorSpec& spec, double rate_hz, const SensorClock& clock, const LocalFrame& frame,
                const Eigen::Vector3d& field_n, std::uint64_t seed)
      : sensors_(spec, rate_hz, frame, field_n, seed), clock_(clock) {
    const std::int64_t first_ns = clock.power_on_ns + clock.period_ns;
    imu_ = {spec.imu_timing, rate_hz, first_ns, "imu", mix_seed(seed, 40)};
    gnss_ = {spec.gnss_timing, rate_hz, first_ns, "gnss", mix_seed(seed, 41)};
    mag_ = {spec.mag_timing, rate_hz, first_ns, "mag", mix_seed(seed, 42)};
    baro_ = {spec.baro_timing, rate_hz, first_ns, "baro", mix_seed(seed, 43)};
    pitot_ = {spec.pitot_timing, rate_hz, first_ns, "pitot", mix_seed(seed, 44)};
  }

  void suffer(const Faults& faults) { sensors_.suffer(faults); }
  const Sensors& sensors() const { return sensors_; }

  template <class Outputs>
  void publish(const SensorSwitches& p, const Plant& plant, std::int64_t now_ns, Outputs& out) {
    Sensors& s = sensors_;
    const SensorFaults& faults = s.faults();
    if (imu_.due(now_ns)) {
      const Imu imu = s.imu(plant);
      imu_.take(imu, now_ns, p.imu_works && !faults.imu_off(), out.imu);
    }
    imu_.deliver(now_ns, true, out.imu);
    publish_one(mag_, p.mag_works, faults.mag, now_ns, out.mag, [&] { return s.mag(plant); });
    publish_one(baro_, p.baro_works, faults.baro, now_ns, out.baro, [&] { return s.baro(plant); });
    publish_one(pitot_, p.pitot_works, faults.pitot, now_ns, out.pitot, [&] { return s.pitot(plant); });
    if (gnss_.due(now_ns)) {  // a sample under way when the receiver is switched on again is lost
      const Gnss gnss = s.gnss(plant, clock_.epoch_ns + now_ns, now_ns - clock_.power_on_ns);
      gnss_.take(gnss, now_ns, p.gnss_works || gnss_.delayed(), out.gnss);
    }
    gnss_.deliver(now_ns, p.gnss_works, out.gnss);
  }

 private:
  /// `works` is called when a sample is taken.
  template <class T, class Measure>
  static void publish_one(SensorLine<T>& line, bool works, const Channel& fault, std::int64_t now_ns,
                          Out<T>& port, Measure measure) {
    if (line.due(now_ns)) {
      const T sample = measure();
      line.take(sample, now_ns, works && !fault.off(), port);
    }
    line.deliver(now_ns, true, port);
  }

  Sensors sensors_;
  SensorClock clock_;
  SensorLine<Imu> imu_;
  SensorLine<Gnss> gnss_;
  SensorLine<Mag> mag_;
  SensorLine<Baro> baro_;
  SensorLine<Pitot> pitot_;
};

}  // namespace fulmar::sim

// SPDX-License-Identifier: BSD-3-Clause
// Sensor outputs from the state of the aircraft, each at its own rate. Beard & McLain, chapter 7.
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "fulmar/eigen.hpp"
#include "fulmar/flight/earth/atmosphere.hpp"
#include "fulmar/flight/earth/geodesy.hpp"
#include "fulmar/flight/math/single.hpp"
#include "fulmar/msg/baro.hpp"
#include "fulmar/msg/gnss.hpp"
#include "fulmar/msg/imu.hpp"
#include "fulmar/msg/mag.hpp"
#include "fulmar/msg/pitot.hpp"
#include "fulmar/sim/plant.hpp"
#include "presets.hpp"
#include "sensor_faults.hpp"
#include "sensor_line.hpp"
#include "sensor_place.hpp"

namespace fulmar::sim {

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
    gyro_sheet_ = Sheet(spec.gyro_sheet, dt(spec.imu_hz), mix_seed(seed, 30));
    accel_sheet_ = Sheet(spec.accel_sheet, dt(spec.imu_hz), mix_seed(seed, 31));
    mag_sheet_ = Sheet(spec.mag_sheet, dt(spec.mag_hz), mix_seed(seed, 32));
    baro_sheet_ = Sheet(spec.baro_sheet, dt(spec.baro_hz), mix_seed(seed, 33));
    pitot_sheet_ = Sheet(spec.pitot_sheet, dt(spec.pitot_hz), mix_seed(seed, 34));
    places_ = SensorPlaces(spec, dt(spec.imu_hz), mix_seed(seed, 35));
    if (spec.calibrated) calibrate();
  }

  Imu imu(const Plant& plant) {
    Eigen::Vector3d rate = plant.state().omega_b, force = plant.specific_force();
    if (places_.reach_imu()) places_.imu(plant, rate, force);
    Imu out;
    out.rate_radps = sent<Body>(measured(rate, gyro_, imu_random_, gyro_sheet_, faults_.gyro));
    out.specific_force_mps2 = sent<Body>(measured(force, accel_, imu_random_, accel_sheet_, faults_.accel));
    out.temperature_kelvin = spec_.temperature_kelvin;
    return out;
  }

  Mag mag(const Plant& plant) {
    Eigen::Vector3d field = plant.seen().q_nb.conjugate() * field_n_;
    if (places_.reach_mag()) field += plant.battery_amp() * spec_.mag_per_amp;
    return {sent<Body>(measured(field, mag_, mag_random_, mag_sheet_, faults_.mag))};
  }

  Baro baro(const Plant& plant) {
    double pressure = plant.air().pressure_pa;
    if (spec_.baro_static_port != 0)
      pressure +=
          spec_.baro_static_port * 0.5 * plant.air().density_kgm3 * plant.air_velocity_b().squaredNorm();
    const double output = faults_.baro(pressure + baro_.next(baro_random_));
    return {sent(baro_sheet_.used() ? baro_sheet_.digits(output) : output), spec_.temperature_kelvin};
  }

  /// (7.10). The pitot takes the whole flow up to 20 degrees off its axis, less beyond, and none from 60
  /// degrees on.
  Pitot pitot(const Plant& plant) {
    Eigen::Vector3d v_r = plant.air_velocity_b();
    if (places_.reach_pitot()) v_r += plant.seen().omega_b.cross(spec_.pitot_at);
    const double Va = v_r.norm(), cosine = Va > 0 ? v_r.x() / Va : 1;
    const double taken = std::clamp((cosine - 0.5) / (0.9397 - 0.5), 0.0, 1.0);
    double pressure = pitot_scale_ * taken * 0.5 * plant.air().density_kgm3 * Va * Va;
    if (places_.reach_pitot()) pressure = places_.pitot(plant, v_r, taken, pressure);
    const double output = faults_.pitot(pressure + pitot_.next(pitot_random_));
    Pitot out;
    out.pressure_pa = sent(pitot_sheet_.used() ? pitot_sheet_.digits(output) : output);
    out.indicated_airspeed_mps = sent(indicated_airspeed(out.pressure_pa));
    out.temperature_kelvin = spec_.temperature_kelvin;
    return out;
  }

  /// `on_ns`: time since power-on.
  Gnss gnss(const Plant& plant, std::int64_t utc_ns, std::int64_t on_ns = INT64_MAX) {
    Eigen::Vector3d p_n = plant.state().p_n, v_n = plant.seen().v_n;
    if (places_.reach_antenna()) places_.antenna(plant, p_n, v_n);
    const LocalFrame::Geodetic g = frame_.from_ned(faults_.position(p_n + gnss_position_.next(gnss_random_)));
    Gnss out;
    out.latitude_deg = g.lat_deg;
    out.longitude_deg = g.lon_deg;
    out.altitude_m = g.alt_m;
    out.velocity_mps = from_eigen<Ned>(faults_.velocity(v_n + gnss_velocity_.next(gnss_random_)));
    out.horizontal_std_m = spec_.horizontal_std_m;
    out.vertical_std_m = spec_.vertical_std_m;
    out.speed_std_mps = spec_.speed_std_mps;
    out.utc_ns = utc_ns;
    out.fix = spec_.fix;
    out.satellites = 15;
    const bool searching = static_cast<double>(on_ns) < 1e9 * spec_.gnss_start_up_s;
    if (searching || faults_.velocity.off()) out.speed_std_mps = unknown_std;
    if (searching || faults_.position.off()) {  // no solution, as reported by a receiver without satellites
      out.fix = FixType::none;
      out.satellites = 0;
      out.horizontal_std_m = out.vertical_std_m = unknown_std;
    }
    return out;
  }

  void suffer(const Faults& faults) { faults_.suffer(faults); }
  const SensorFaults& faults() const { return faults_; }

  Eigen::Vector3d gyro_bias() const { return of_both(gyro_, gyro_sheet_); }
  Eigen::Vector3d accel_bias() const { return of_both(accel_, accel_sheet_); }
  const SensorSpec& spec() const { return spec_; }

 private:
  /// Turns the quantity at the sensor into its output.
  static Eigen::Vector3d measured(const Eigen::Vector3d& there, Noise3& noise, Random& random, Sheet& sheet,
                                  Channel& fault) {
    if (!sheet.used()) return fault(there + noise.next(random));
    return sheet.digits(fault(sheet.smooth(sheet.bent(there) + noise.next(random))));
  }
  static Eigen::Vector3d of_both(const Noise3& noise, const Sheet& sheet) {
    return sheet.used() ? Eigen::Vector3d(noise.bias() + sheet.bias()) : noise.bias();
  }
  /// A calibration by the flight controller, standing level. It removes the constant errors of gyroscopes,
  /// accelerometers, barometer and pitot, with the effect of gravity by scale and axis errors.
  void calibrate() {
    const Eigen::Vector3d rest(0, 0, -isa::g0);
    gyro_.calibrate();
    accel_.calibrate();
    baro_.calibrate();
    pitot_.calibrate();
    gyro_sheet_.calibrate(places_.rate_by(rest), Eigen::Vector3d::Zero());
    accel_sheet_.calibrate(rest, rest);
  }

  double sent(double value) const { return spec_.single_precision ? to_single(value) : value; }
  template <class Frame>
  Vec3<Frame> sent(const Eigen::Vector3d& value) const {
    return from_eigen<Frame>(Eigen::Vector3d(sent(value.x()), sent(value.y()), sent(value.z())));
  }

  SensorSpec spec_;
  LocalFrame frame_;
  Eigen::Vector3d field_n_;
  Random imu_random_, gnss_random_, mag_random_, baro_random_,
      pitot_random_;  // separate generators: without a sensor the others produce the same errors
  Noise3 gyro_, accel_, mag_, gnss_position_, gnss_velocity_;
  Noise baro_, pitot_;
  double pitot_scale_ = 1;
  Sheet gyro_sheet_, accel_sheet_, mag_sheet_, baro_sheet_, pitot_sheet_;
  SensorPlaces places_;
  SensorFaults faults_;
};

}  // namespace fulmar::sim

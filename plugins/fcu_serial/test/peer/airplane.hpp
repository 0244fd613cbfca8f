// SPDX-License-Identifier: BSD-3-Clause
// The simulated aircraft behind the software flight controller: the plant and the sensors of sim_aero, moved
// by the controller's outputs.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "firmware.hpp"
#include "fulmar/flight/earth/magnetic_model.hpp"
#include "fulmar/msg/airframe.hpp"
#include "fulmar/sim/plant.hpp"
#include "plugins/sim_aero/sensors.hpp"

namespace fulmar::fcu::peer {

struct World {
  Airframe airframe;
  sim::Weather weather;
  sim::SensorSet sensors = sim::SensorSet::rosflight;
  double latitude_deg = 40.2463724, longitude_deg = -111.6474138, altitude_m = 1387;
  double heading_rad = 0;
  double start_height_m = 0;  ///< 0: on the ground
  std::uint64_t seed = 1;
};

class Airplane {
 public:
  Airplane(const World& world, Firmware& firmware, const Rates& rates)
      : world_(world),
        firmware_(firmware),
        spec_(spec(world.sensors, rates)),
        frame_(world.latitude_deg, world.longitude_deg, world.altitude_m),
        plant_(plant(world)),
        sensors_(spec_, rates.imu, frame_,
                 magnetic_field_ned(world.latitude_deg, world.longitude_deg, world.altitude_m, 2026.0),
                 world.seed),
        dt_(1 / rates.imu) {
    mag_ = sim::Due(rates.mag, 0);
    baro_ = sim::Due(rates.baro, 0);
    pitot_ = sim::Due(rates.pitot, 0);
    gnss_ = sim::Due(rates.gnss, 0);
  }

  /// One period of the inertial unit.
  void step() {
    time_ns_ += std::llround(1e9 * dt_);
    if (!released_ && firmware_.armed()) release();
    if (released_)
      plant_.advance(actuators(), true, dt_);
    else
      plant_.carry(dt_);
    feel();
  }

  Actuators actuators() const {
    const Deflected d = firmware_.deflected();
    const auto angle = [](double u, const Surface& s) { return (s.reversed ? -u : u) * s.limit_rad; };
    const auto sound = [](double v) { return std::isfinite(v) ? v : 0; };
    return {sound(d.throttle), sound(angle(d.aileron, world_.airframe.aileron)),
            sound(angle(d.elevator, world_.airframe.elevator)),
            sound(angle(d.rudder, world_.airframe.rudder))};
  }
  const sim::Plant& plant() const { return plant_; }
  const Airframe& airframe() const { return world_.airframe; }
  double height_m() const { return -plant_.state().p_n.z(); }
  double time_s() const { return 1e-9 * static_cast<double>(time_ns_); }
  bool released() const { return released_; }
  bool pitot_covered = false;

 private:
  static sim::Plant plant(const World& w) {
    sim::Plant p(w.airframe, w.weather, w.altitude_m, mix_seed(w.seed, 10));
    if (w.start_height_m > 0)
      p.fly({0, 0, -w.start_height_m}, w.heading_rad, w.airframe.limits.airspeed_cruise_mps);
    else
      p.stand(0, 0, w.heading_rad);
    return p;
  }
  /// On the ground the gusts restart 5 s before, as in sim_aero, so that both have the same gusts.
  void release() {
    released_ = true;
    if (world_.start_height_m > 0) return;
    plant_ = plant(world_);
    for (double t = 0; t < 5; t += dt_) plant_.carry(dt_);
  }

  /// The sensor set's errors at the rates of the board.
  static sim::SensorSpec spec(sim::SensorSet set, const Rates& r) {
    sim::SensorSpec s = sim::sensor_spec(set);
    s.imu_hz = r.imu;
    s.mag_hz = r.mag;
    s.baro_hz = r.baro;
    s.pitot_hz = r.pitot;
    s.gnss_hz = r.gnss;
    return s;
  }

  void feel() {
    Inputs& in = firmware_.inputs;
    const Imu imu = sensors_.imu(plant_);
    in.accel = {imu.specific_force_mps2.x, imu.specific_force_mps2.y, imu.specific_force_mps2.z};
    in.gyro = {imu.rate_radps.x, imu.rate_radps.y, imu.rate_radps.z};
    if (mag_(time_ns_)) {
      const Mag mag = sensors_.mag(plant_);
      in.mag = {mag.field_tesla.x, mag.field_tesla.y, mag.field_tesla.z};
    }
    if (baro_(time_ns_)) in.baro_pa = sensors_.baro(plant_).pressure_pa;
    if (pitot_(time_ns_)) {
      const double pa = sensors_.pitot(plant_).pressure_pa;
      const double wind_pa = 0.5 * plant_.air().density_kgm3 * plant_.air_velocity_b().squaredNorm();
      in.pitot_pa = pitot_covered ? pa - wind_pa : pa;
    }
    if (gnss_(time_ns_)) gnss_delay_.push(sensors_.gnss(plant_, epoch_ns + time_ns_), time_ns_);
    if (const auto* late = gnss_delay_.pop(time_ns_, std::llround(1e9 * spec_.gnss_latency_s)))
      fix(late->value, late->valid_at_ns);
    in.battery_volt = world_.airframe.propulsion.battery_volt;
    in.battery_amp = plant_.battery_amp();
  }

  void fix(const Gnss& g, std::int64_t valid_ns) {
    RosflightGnss& m = firmware_.inputs.gnss;
    const auto f = [](double v) { return static_cast<float>(v); };
    m.seconds = g.utc_ns / 1000000000;
    m.nanos = static_cast<std::int32_t>(g.utc_ns % 1000000000);
    m.lat = g.latitude_deg;
    m.lon = g.longitude_deg;
    m.height = f(g.altitude_m);
    m.vel_n = f(g.velocity_mps.north);
    m.vel_e = f(g.velocity_mps.east);
    m.vel_d = f(g.velocity_mps.down);
    m.h_acc = f(g.horizontal_std_m);
    m.v_acc = f(g.vertical_std_m);
    m.s_acc = f(g.speed_std_mps);
    m.fix_type = 3;
    m.num_sat = static_cast<std::uint8_t>(g.satellites);
    firmware_.inputs.gnss_age_us = (time_ns_ - valid_ns) / 1000;
  }

  static constexpr std::int64_t epoch_ns = 1767225600000000000;  ///< 2026-01-01
  World world_;
  Firmware& firmware_;
  sim::SensorSpec spec_;
  LocalFrame frame_;
  sim::Plant plant_;
  sim::Sensors sensors_;
  double dt_;
  std::int64_t time_ns_ = 0;
  bool released_ = false;  ///< has been armed once: from then on it is free to move
  sim::Due mag_, baro_, pitot_, gnss_;
  sim::Delay<Gnss> gnss_delay_;
};

}  // namespace fulmar::fcu::peer

// SPDX-License-Identifier: BSD-3-Clause
// The flight in the messages of ROSplane 2.0 and ROSflight 2.0, which also use NED and FRD. Names of the
// ports are those of their topics.
#pragma once
#include <algorithm>

#include "convert.hpp"
#include "fulmar/flight/earth/atmosphere.hpp"
#include "fulmar/msg/actuators.hpp"
#include "fulmar/msg/airframe.hpp"
#include "fulmar/msg/attitude_command.hpp"
#include "fulmar/msg/baro.hpp"
#include "fulmar/msg/controller_internals.hpp"
#include "fulmar/msg/guidance_command.hpp"
#include "fulmar/msg/imu.hpp"
#include "fulmar/msg/mag.hpp"
#include "fulmar/msg/path.hpp"
#include "fulmar/msg/pitot.hpp"
#include "fulmar/msg/plan.hpp"
#include "fulmar/msg/rc.hpp"
#include "fulmar/msg/vehicle_state.hpp"
#include "fulmar/msg/vehicle_status.hpp"
#include "rosplane_messages.hpp"

namespace fulmar::ros_bridge {

inline float f32(double x) { return static_cast<float>(x); }

/// Deflection for a command of 1, rad. ROSplane's anaconda: positive elevator raises the nose, by its gains
/// and REV_ELEVATOR 1.
struct Throws {
  double aileron = 0.35, elevator = 0.35, rudder = 0.35;

  static Throws of(const Airframe& a, bool elevator_up) {
    const double sign = elevator_up ? -1 : 1;
    return {a.aileron.limit_rad, sign * a.elevator.limit_rad, a.rudder.limit_rad};
  }
};

struct Rosplane {
  static constexpr const char* doc = "Output of the flight in the messages of ROSplane and ROSflight 2.0.";
  struct Inputs {
    Optional<VehicleState> state;
    Optional<GuidanceCommand> command;
    Optional<AttitudeCommand> attitude;
    Optional<ControllerInternals> internals;
    Optional<Actuators> actuators;
    Optional<Path> path;
    Optional<Plan> plan;
    Optional<Imu> imu;
    Optional<Mag> mag;
    Optional<Baro> baro;
    Optional<Pitot> pitot;
    Optional<Gnss> gnss;  // also for the UTC of the stamps
    Optional<Rc> rc;
    Optional<VehicleStatus> status;
  };
  struct Outputs {
    Out<RosplaneState> estimated_state;
    Out<RosplaneControllerCommands> controller_command;
    Out<RosplaneControllerInternals> controller_internals;
    Out<RosplaneCurrentPath> current_path;
    OutQueue<RosplaneWaypoint, 64> waypoint_path;
    Out<RosflightCommand> command;
    Out<RosflightAttitude> attitude;
    Out<RosImu> imu_data;
    Out<RosMagneticField> magnetometer;
    Out<RosflightBarometer> baro;
    Out<RosflightAirspeed> airspeed;
    Out<RosflightGnss> gnss;
    Out<RosflightRcRaw> rc_raw;
    Out<RosflightStatus> status;
    Out<RosflightBatteryStatus> battery;
  };
  struct Params {
    Record<Airframe> airframe{"airframe with the throws that are 1 in `command`"};
    Flag elevator_up{true,
                     "sign of the elevator in `command`; true: positive raises the nose, as in the anaconda "
                     "of ROSplane with REV_ELEVATOR 1",
                     setup};
    Count epoch{
        1767225600, 0, 4102444800,
        "UTC of flight time 0 in seconds since 1970, until the first fix; equal to the epoch of the mission",
        setup};
  };

  void configure(const Params& p) { throws_ = Throws::of(*p.airframe, p.elevator_up); }
  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out);

 private:
  void state(const Inputs& in, Outputs& out) const;
  void controller(const Inputs& in, Outputs& out) const;
  void paths(const Tick& tick, const Inputs& in, Outputs& out);
  void waypoints(const Tick& tick, const Plan& plan, Outputs& out);
  void sensors(const Inputs& in, Outputs& out) const;
  void gnss(const Inputs& in, Outputs& out) const;
  void vehicle(const Inputs& in, const Params& p, Outputs& out) const;

  Throws throws_;
  Clock clock_;
  std::uint32_t revision_ = 0, next_ = 0;
  bool reporting_ = false;  // a plan that needs several steps
};

inline Status Rosplane::step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
  clock_.note(in.gnss, p.epoch);
  state(in, out);
  controller(in, out);
  paths(tick, in, out);
  sensors(in, out);
  gnss(in, out);
  vehicle(in, p, out);
  return Status::ok;
}

inline void Rosplane::state(const Inputs& in, Outputs& out) const {
  if (!in.state || !in.state.fresh() || !in.state->attitude_valid) return;
  const VehicleState& s = *in.state;
  const std::int64_t at = in.state.valid_at_ns();
  const RosHeader header = clock_.header(at, {});
  out.attitude.publish({header, as_is(s.attitude), as_is(s.rate_radps)}, at);
  if (!s.position_valid || !s.height_valid) return;  // ROSplane's message has no flag for it
  RosplaneState m;
  m.header = header;
  m.p_n = f32(s.position_m.north);
  m.p_e = f32(s.position_m.east);
  m.p_d = f32(s.position_m.down);
  const Vec3<Body> v = to_body(s.attitude, s.velocity_mps);
  m.v_x = f32(v.x);
  m.v_y = f32(v.y);
  m.v_z = f32(v.z);
  m.p = f32(s.rate_radps.x);
  m.q = f32(s.rate_radps.y);
  m.r = f32(s.rate_radps.z);
  m.phi = f32(s.roll_rad);
  m.theta = f32(s.pitch_rad);
  m.psi = f32(s.yaw_rad);
  m.b_x = f32(s.gyro_bias_radps.x);
  m.b_y = f32(s.gyro_bias_radps.y);
  m.b_z = f32(s.gyro_bias_radps.z);
  m.quat = as_is(s.attitude);
  m.initial_lat = s.origin_latitude_deg;
  m.initial_lon = s.origin_longitude_deg;
  m.initial_alt = s.origin_altitude_m;
  m.w_n = f32(s.wind_mps.north);
  m.w_e = f32(s.wind_mps.east);
  m.va = f32(s.airspeed_mps);
  m.alpha = f32(s.alpha_rad);
  m.beta = f32(s.beta_rad);
  m.chi = f32(s.course_rad);
  out.estimated_state.publish(m, at);
}

inline void Rosplane::controller(const Inputs& in, Outputs& out) const {
  if (in.command && in.command.fresh()) {
    const std::int64_t at = in.command.valid_at_ns();
    RosplaneControllerCommands m;
    m.header = clock_.header(at, {});
    m.va_c = f32(in.command->airspeed_mps);
    m.h_c = f32(in.command->height_m);
    m.chi_c = f32(in.command->course_rad);
    m.phi_ff = f32(in.command->roll_feedforward_rad);
    if (in.attitude) {
      m.theta_c = f32(in.attitude->pitch_rad);
      m.phi_c = f32(in.attitude->roll_rad);
    }
    out.controller_command.publish(m, at);
  }
  if (in.attitude && in.attitude.fresh()) {
    const std::int64_t at = in.attitude.valid_at_ns();
    const bool takeoff = in.internals && in.internals->law == OuterLaw::takeoff;
    const std::uint8_t zone = takeoff ? 0 : 3;
    out.controller_internals.publish(
        {clock_.header(at, {}), f32(in.attitude->pitch_rad), f32(in.attitude->roll_rad), zone}, at);
  }
  if (in.actuators && in.actuators.fresh()) {
    const std::int64_t at = in.actuators.valid_at_ns();
    RosflightCommand m;
    m.header = clock_.header(at, {});
    m.u[0] = f32(in.actuators->throttle_frac);
    m.u[3] = f32(std::clamp(in.actuators->aileron_rad / throws_.aileron, -1.0, 1.0));
    m.u[4] = f32(std::clamp(in.actuators->elevator_rad / throws_.elevator, -1.0, 1.0));
    m.u[5] = f32(std::clamp(in.actuators->rudder_rad / throws_.rudder, -1.0, 1.0));
    out.command.publish(m, at);
  }
}

inline std::array<float, 3> f32(const Vec3<Ned>& v) { return {f32(v.north), f32(v.east), f32(v.down)}; }

inline void Rosplane::paths(const Tick& tick, const Inputs& in, Outputs& out) {
  if (in.path && in.path.fresh()) {
    const Path& path = *in.path;
    const std::int64_t at = in.path.valid_at_ns();
    RosplaneCurrentPath m;
    m.header = clock_.header(at, {});
    m.va_d = f32(path.airspeed_mps);
    if (path.kind == PathKind::line) {
      m.r = f32(path.origin_m);
      m.q = f32(path.direction_ratio);
    } else {
      m.path_type = 0;
      m.c = f32(path.origin_m);
      m.rho = f32(path.radius_m);
      m.lamda = path.turn == Turn::right ? std::int8_t{1} : std::int8_t{-1};
    }
    out.current_path.publish(m, at);
  }
  if (in.plan) waypoints(tick, *in.plan, out);
}

/// A new plan: clears the list, then sends each waypoint, at most 64 messages per step.
inline void Rosplane::waypoints(const Tick& tick, const Plan& plan, Outputs& out) {
  auto& queue = out.waypoint_path;
  if (plan.revision != revision_) {
    revision_ = plan.revision;
    next_ = 0;
    reporting_ = true;
    RosplaneWaypoint clear;
    clear.header = clock_.header(tick.now_ns, {});
    clear.clear_wp_list = true;
    queue.push(clear, tick.now_ns);
  }
  for (; reporting_ && next_ < plan.waypoints.size() && queue.count < queue.items.size(); ++next_) {
    const Waypoint& w = plan.waypoints[next_];
    RosplaneWaypoint m;
    m.header = clock_.header(tick.now_ns, {});
    m.w = f32(w.position_m);
    m.chi_d = f32(w.course_rad);
    m.use_chi = w.has_course;
    m.va_d = f32(w.airspeed_mps > 0 ? w.airspeed_mps : plan.airspeed_mps);
    queue.push(m, tick.now_ns);
  }
  reporting_ = reporting_ && next_ < plan.waypoints.size();
}

inline void Rosplane::sensors(const Inputs& in, Outputs& out) const {
  if (in.imu && in.imu.fresh()) {
    const std::int64_t at = in.imu.valid_at_ns();
    RosImu m;  // as rosflight_io: FRD, covariances 0
    m.header = clock_.header(at, {});
    if (in.state && in.state->attitude_valid) m.orientation = as_is(in.state->attitude);
    m.angular_velocity = as_is(in.imu->rate_radps);
    m.linear_acceleration = as_is(in.imu->specific_force_mps2);
    out.imu_data.publish(m, at);
  }
  if (in.mag && in.mag.fresh()) {
    const std::int64_t at = in.mag.valid_at_ns();
    out.magnetometer.publish({clock_.header(at, {}), as_is(in.mag->field_tesla), {}}, at);
  }
  if (in.baro && in.baro.fresh()) {
    const std::int64_t at = in.baro.valid_at_ns();
    const double p = in.baro->pressure_pa;
    const double altitude = p > 0 ? pressure_altitude(p) : 0;
    out.baro.publish({clock_.header(at, {}), f32(altitude), f32(p), f32(in.baro->temperature_kelvin)}, at);
  }
  if (in.pitot && in.pitot.fresh()) {
    const std::int64_t at = in.pitot.valid_at_ns();
    const Pitot& p = *in.pitot;
    out.airspeed.publish(
        {clock_.header(at, {}), f32(p.indicated_airspeed_mps), f32(p.pressure_pa), f32(p.temperature_kelvin)},
        at);
  }
}

inline std::uint8_t rosflight_fix(FixType fix) {
  if (fix == FixType::rtk_float || fix == FixType::rtk_fixed) return 3;
  return static_cast<std::uint8_t>(
      fix);  // 0 none, 1 dead reckoning, 2 two, 3 three dimensions, 4 combined, 5 time only
}

inline void Rosplane::gnss(const Inputs& in, Outputs& out) const {
  if (!in.gnss || !in.gnss.fresh()) return;
  const Gnss& g = *in.gnss;
  const std::int64_t at = in.gnss.valid_at_ns();
  RosflightGnss m;
  m.header = clock_.header(at, {});
  m.fix_type = rosflight_fix(g.fix);
  m.num_sat = g.satellites;
  m.lat = g.latitude_deg;
  m.lon = g.longitude_deg;
  m.alt = f32(g.altitude_m);
  m.horizontal_accuracy = f32(g.horizontal_std_m);
  m.vertical_accuracy = f32(g.vertical_std_m);
  m.vel_n = f32(g.velocity_mps.north);
  m.vel_e = f32(g.velocity_mps.east);
  m.vel_d = f32(g.velocity_mps.down);
  m.speed_accuracy = f32(g.speed_std_mps);
  m.gnss_unix_seconds = g.utc_ns / second_ns;
  m.gnss_unix_nanos = static_cast<std::int32_t>(g.utc_ns % second_ns);
  out.gnss.publish(m, at);
}

inline std::uint16_t pulse_us(double frac, double middle, double half) {
  return static_cast<std::uint16_t>(std::lround(middle + half * std::clamp(frac, -1.0, 1.0)));
}

inline void Rosplane::vehicle(const Inputs& in, const Params& p, Outputs& out) const {
  if (in.rc && in.rc.fresh()) {  // the order of ROSflight's default channels: roll, pitch, throttle, yaw
    const Rc& rc = *in.rc;
    const std::int64_t at = in.rc.valid_at_ns();
    const auto stick = [](double frac) { return pulse_us(frac, 1500, 500); };
    // the sign of a stick is that of its surface; rudder left is positive
    const double pitch = p.elevator_up ? rc.pitch_frac : -rc.pitch_frac;
    out.rc_raw.publish(
        {clock_.header(at, {}),
         {stick(rc.roll_frac), stick(pitch), pulse_us(rc.throttle_frac, 1000, 1000), stick(-rc.yaw_frac),
          stick(rc.aux1_frac), stick(rc.aux2_frac), stick(rc.aux3_frac), stick(rc.aux4_frac)}},
        at);
  }
  if (!in.status || !in.status.fresh()) return;
  const VehicleStatus& s = *in.status;
  const std::int64_t at = in.status.valid_at_ns();
  RosflightStatus m;
  m.header = clock_.header(at, {});
  m.armed = s.armed;
  m.failsafe = s.failsafe;
  m.offboard = s.offboard;
  const std::uint32_t reasons = s.override_reasons & 0xffffu;
  m.rc_override = static_cast<std::uint16_t>(s.override && reasons == 0 ? 1u : reasons);  // bit 0: the switch
  m.error_code = static_cast<std::uint8_t>(s.errors & 0xffu);
  out.status.publish(m, at);
  out.battery.publish({clock_.header(at, {}), f32(s.battery_volt), f32(s.battery_amp)}, at);
}

}  // namespace fulmar::ros_bridge

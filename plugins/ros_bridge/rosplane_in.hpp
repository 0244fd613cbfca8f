// SPDX-License-Identifier: BSD-3-Clause
// Nodes of ROSplane in the place of components: each component fills a role with the messages of such a node.
// A node that falls silent fails, so that the phase's fallback takes over.
#pragma once
#include "fulmar/msg/plan_edit.hpp"
#include "messages.hpp"
#include "rosplane_out.hpp"

namespace fulmar::ros_bridge {

/// The node has been silent for too long, or has not sent yet.
template <class T>
bool silent(const Optional<T>& port, const Param& timeout) {
  return !port || port.age_s() > timeout;
}

/// The component waits for a node that has never sent; a node that falls silent has failed.
template <class T>
Status silence(const Optional<T>& port) {
  return port ? Status::failed : Status::degraded;
}

/// A hand-over to a silent node is rejected. At the start there is no component to stay with, so it waits for
/// the node.
template <class T, class Outputs>
Status take_over(const Optional<T>& port, const Param& timeout, const Applied<Outputs>& last) {
  return silent(port, timeout) && last.given() ? Status::failed : Status::ok;
}

template <class... F>
bool all_finite(F... values) {
  return (std::isfinite(values) && ...);
}
inline bool all_finite(const std::array<float, 3>& v) { return all_finite(v[0], v[1], v[2]); }

/// A path follower, or signal_generator: /controller_command.
struct RosplaneFollower {
  static constexpr const char* doc = "Guidance commands from the controller commands of a ROSplane node.";
  struct Inputs {
    Optional<RosplaneControllerCommands> controller_command;
  };
  struct Outputs {
    Out<GuidanceCommand> command;
  };
  struct Params {
    Param timeout{0.5, "s", 0.02, 60, "largest age of a message before failure"};
  };
  Status activate(const Tick&, const Inputs& in, const Params& p, const Applied<Outputs>& last) {
    return take_over(in.controller_command, p.timeout, last);
  }
  Status step(const Tick&, const Inputs& in, const Params& p, Outputs& out) {
    if (silent(in.controller_command, p.timeout)) return silence(in.controller_command);
    if (!in.controller_command.fresh()) return Status::ok;
    const RosplaneControllerCommands& c = *in.controller_command;
    if (!all_finite(c.va_c, c.h_c, c.chi_c, c.phi_ff)) return Status::failed;
    GuidanceCommand command;
    command.course_rad = static_cast<double>(c.chi_c);
    command.height_m = static_cast<double>(c.h_c);
    command.airspeed_mps = static_cast<double>(c.va_c);
    command.roll_feedforward_rad = static_cast<double>(c.phi_ff);
    out.command.publish(command);
    return Status::ok;
  }
};

/// A controller: rosflight's /command.
struct RosplaneController {
  static constexpr const char* doc =
      "Actuator commands from a ROSplane controller's command to the flight controller.";
  struct Inputs {
    Optional<RosflightCommand> command;
  };
  struct Outputs {
    Out<Actuators> actuators;
  };
  struct Params {
    Record<Airframe> airframe{"airframe with the throws for a command of 1"};
    Flag elevator_up{true,
                     "sign of the elevator; true: positive raises the nose, as in the anaconda of ROSplane "
                     "with REV_ELEVATOR 1",
                     setup};
    Param timeout{0.1, "s", 0.01, 60, "largest age of a message before failure"};
  };
  void configure(const Params& p) { throws_ = Throws::of(*p.airframe, p.elevator_up); }
  Status activate(const Tick&, const Inputs& in, const Params& p, const Applied<Outputs>& last) {
    return take_over(in.command, p.timeout, last);
  }
  Status step(const Tick&, const Inputs& in, const Params& p, Outputs& out) {
    if (silent(in.command, p.timeout)) return silence(in.command);
    const RosflightCommand& c = *in.command;
    if (c.mode != 0 || !all_finite(c.u[0], c.u[3], c.u[4], c.u[5])) return Status::failed;
    if (!in.command.fresh()) return Status::ok;
    const auto u = [&](std::size_t i, double low) {
      return std::clamp(static_cast<double>(c.u[i]), low, 1.0);
    };
    out.actuators.publish(
        {u(0, 0), throws_.aileron * u(3, -1), throws_.elevator * u(4, -1), throws_.rudder * u(5, -1)});
    return Status::ok;
  }

 private:
  Throws throws_;
};

/// A path manager: /current_path.
struct RosplanePath {
  static constexpr const char* doc = "Path from a ROSplane path manager.";
  struct Inputs {
    Optional<RosplaneCurrentPath> current_path;
  };
  struct Outputs {
    Out<Path> path;
  };
  struct Params {
    Param timeout{1, "s", 0.02, 60, "largest age of a message before failure; the last path stays active"};
  };
  Status step(const Tick&, const Inputs& in, const Params& p, Outputs& out) {
    if (silent(in.current_path, p.timeout)) return Status::degraded;
    if (!in.current_path.fresh()) return Status::ok;
    const RosplaneCurrentPath& c = *in.current_path;
    Path path;
    path.airspeed_mps = static_cast<double>(c.va_d);
    const bool line = c.path_type == 1;
    if (!all_finite(c.va_d) || !(line ? all_finite(c.r) && all_finite(c.q) : all_finite(c.c) && c.rho >= 1))
      return Status::degraded;
    const auto vector = [](const std::array<float, 3>& v) { return Eigen::Vector3d(v[0], v[1], v[2]); };
    if (line) {
      const Eigen::Vector3d q = vector(c.q);
      if (!(q.norm() > 1e-6)) return Status::degraded;
      path.origin_m = from_eigen<Ned>(vector(c.r));
      path.direction_ratio = from_eigen<Ned>(q.normalized());
    } else {
      path.kind = PathKind::orbit;
      path.origin_m = from_eigen<Ned>(vector(c.c));
      path.radius_m = static_cast<double>(c.rho);
      path.turn = c.lamda >= 0 ? Turn::right : Turn::left;
    }
    out.path.publish(path);
    return Status::ok;
  }
};

/// A path planner: /waypoint_path, and the service /add_waypoint.
struct RosplaneWaypoints {
  static constexpr const char* doc = "Plan edits from the waypoints and requests of a ROSplane node.";
  struct Inputs {
    Queue<RosplaneWaypoint> waypoint_path;
    Request<RosplaneAddWaypoint> add_waypoint;
  };
  struct Outputs {
    OutQueue<PlanEdit, 80> edits;
    Probe refused_ratio;  // number of rejected waypoints since the start
  };
  struct Params {};
  Status step(const Tick& tick, const Inputs& in, const Params&, Outputs& out) {
    refused_ += in.waypoint_path.lost();
    for (const auto& sample : in.waypoint_path) {
      PlanEdit clear;
      clear.kind = PlanEditKind::clear;
      const bool taken =
          sample.value.clear_wp_list ? out.edits.push(clear, tick.now_ns) : add(tick, sample.value, out);
      if (!taken) ++refused_;
    }
    for (const auto request : in.add_waypoint) {
      if (add(tick, request.value(), out)) {
        request.accept();
      } else {
        ++refused_;
        request.refuse(ros_bridge_messages::waypoint_not_finite.c_str());
      }
    }
    out.refused_ratio = refused_;
    return Status::ok;
  }

 private:
  template <class M>
  static bool add(const Tick& tick, const M& from, Outputs& out) {
    if (!all_finite(from.w) || !all_finite(from.va_d) || (from.use_chi && !all_finite(from.chi_d)))
      return false;
    const auto at = [&](std::size_t i) { return static_cast<double>(from.w[i]); };
    PlanEdit edit;
    Waypoint& w = edit.waypoint;
    if (from.lla) {
      w.frame = WaypointFrame::geodetic;
      w.latitude_deg = at(0);
      w.longitude_deg = at(1);
      w.altitude_m = at(2);
    } else {
      w.position_m = {at(0), at(1), at(2)};
    }
    w.has_course = from.use_chi;
    w.course_rad = from.use_chi ? static_cast<double>(from.chi_d) : 0;
    w.airspeed_mps = from.va_d > 0 ? static_cast<double>(from.va_d) : 0;
    return out.edits.push(edit, tick.now_ns);
  }

  std::uint32_t refused_ = 0;
};

/// An estimator: /estimated_state.
struct RosplaneEstimator {
  static constexpr const char* doc = "Navigation state from a ROSplane estimator.";
  struct Inputs {
    Optional<RosplaneState> estimated_state;
  };
  struct Outputs {
    Out<VehicleState> state;
  };
  struct Params {
    Param timeout{0.1, "s", 0.01, 60, "largest age of a message before failure"};
  };
  Status activate(const Tick&, const Inputs& in, const Params& p, const Applied<Outputs>& last) {
    return take_over(in.estimated_state, p.timeout, last);
  }
  Status step(const Tick&, const Inputs& in, const Params& p, Outputs& out);
};

inline Status RosplaneEstimator::step(const Tick&, const Inputs& in, const Params& p, Outputs& out) {
  if (silent(in.estimated_state, p.timeout)) return silence(in.estimated_state);
  if (!in.estimated_state.fresh()) return Status::ok;
  const RosplaneState& m = *in.estimated_state;
  const Eigen::Quaterniond q(m.quat.w, m.quat.x, m.quat.y, m.quat.z);
  if (!all_finite(m.p_n, m.p_e, m.p_d, m.v_x, m.v_y, m.v_z, m.p, m.q, m.r, m.phi, m.theta, m.psi, m.va,
                  m.alpha, m.beta, m.chi, m.w_n, m.w_e, m.b_x, m.b_y, m.b_z, q.norm(), m.initial_lat,
                  m.initial_lon, m.initial_alt))
    return Status::failed;
  // before it is initialised, ROSplane's estimator publishes zeros
  if (!(q.norm() > 0.5) || (m.va == 0 && m.v_x == 0 && m.p_d == 0 && m.psi == 0)) return Status::degraded;
  const auto d = [](float x) { return static_cast<double>(x); };
  VehicleState s;
  s.position_m = {d(m.p_n), d(m.p_e), d(m.p_d)};
  s.attitude = from_eigen(q.normalized());
  s.velocity_mps = to_ned(s.attitude, Vec3<Body>{d(m.v_x), d(m.v_y), d(m.v_z)});
  s.roll_rad = d(m.phi);
  s.pitch_rad = d(m.theta);
  s.yaw_rad = d(m.psi);
  s.rate_radps = {d(m.p), d(m.q), d(m.r)};
  s.gyro_bias_radps = {d(m.b_x), d(m.b_y), d(m.b_z)};
  s.height_m = -s.position_m.down;
  s.climb_rate_mps = -s.velocity_mps.down;
  s.ground_speed_mps = std::hypot(s.velocity_mps.north, s.velocity_mps.east);
  s.course_rad = d(m.chi);
  s.airspeed_mps = d(m.va);
  s.alpha_rad = d(m.alpha);
  s.beta_rad = d(m.beta);
  s.wind_mps = {d(m.w_n), d(m.w_e), 0};
  s.origin_latitude_deg = m.initial_lat;
  s.origin_longitude_deg = m.initial_lon;
  s.origin_altitude_m = m.initial_alt;
  s.origin_valid = m.initial_lat != 0 || m.initial_lon != 0;
  s.attitude_valid = s.velocity_valid = s.position_valid = s.height_valid = s.airspeed_valid = s.wind_valid =
      true;
  out.state.publish(s);
  return Status::ok;
}

}  // namespace fulmar::ros_bridge

// SPDX-License-Identifier: BSD-3-Clause
// The flight in standard messages of ROS 2: world ENU, body FLU. Sources: REP 103, 105, 145 and the comments
// of the messages.
#pragma once
#include <algorithm>

#include "convert.hpp"
#include "fulmar/flight/path/curve.hpp"
#include "fulmar/msg/baro.hpp"
#include "fulmar/msg/imu.hpp"
#include "fulmar/msg/mag.hpp"
#include "fulmar/msg/path.hpp"
#include "fulmar/msg/plan.hpp"
#include "fulmar/msg/vehicle_state.hpp"

namespace fulmar::ros_bridge {

struct Standard {
  static constexpr const char* doc =
      "Output of the flight in standard messages of ROS 2: world east-north-up, body forward-left-up.";
  struct Inputs {
    Optional<VehicleState> state;
    Optional<Imu> imu;
    Optional<Mag> mag;
    Optional<Baro> baro;
    Optional<Gnss> gnss;  // also for the UTC of the stamps
    Optional<Plan> plan;
    Optional<Path> path;
  };
  struct Outputs {
    Out<RosPoseStamped> pose;
    Out<RosOdometry> odometry;
    Out<RosTf> tf;
    Out<RosImu> imu;
    Out<RosMagneticField> mag;
    Out<RosFluidPressure> pressure;
    Out<RosNavSatFix> fix;
    Out<RosPath> plan;   // the waypoints
    Out<RosPath> piece;  // the active line, orbit or curve
  };
  struct Params {
    TextParam<48> world{"map", "name of the frame of positions, ENU"};
    TextParam<48> base{"base_link", "name of the body frame, FLU"};
    Flag ned_frames{true, "switch for the additional transforms to <world>_ned and <base>_frd"};
    Count epoch{
        1767225600, 0, 4102444800,
        "UTC of flight time 0 in seconds since 1970, until the first fix; equal to the epoch of the mission",
        setup};
    Param geoid_separation{0, "m", -120, 100,
                           "height of mean sea level above the ellipsoid, added to altitudes of fixes"};
    Param rate_std{0, "rad/s", 0, 10, "standard deviation of body rates, for covariances; 0: unknown"};
    Param force_std{0, "m/s2", 0, 100,
                    "standard deviation of the accelerometers, for covariances; 0: unknown"};
  };

  void configure(const Params& p);
  Status step(const Tick&, const Inputs& in, const Params& p, Outputs& out);

 private:
  void publish_state(const Inputs& in, const Params& p, Outputs& out) const;
  void publish_tf(std::int64_t at_ns, const RosPose& pose, const Params& p, Outputs& out) const;
  void publish_imu(const Inputs& in, const Params& p, Outputs& out) const;
  void publish_fix(const Inputs& in, const Params& p, Outputs& out) const;
  void publish_plan(const Inputs& in, Outputs& out) const;
  void publish_piece(const Inputs& in, Outputs& out) const;
  RosPoseStamped pose_of(const RosHeader& header, const Vec3<Ned>& at, double course_rad) const;

  Clock clock_;
  RosText world_, base_, world_ned_, base_frd_;
};

namespace detail {

inline RosText joined(std::string_view name, std::string_view ending) {
  RosText text;
  const std::size_t n = std::min(name.size(), text.bytes.size() - 1 - ending.size());
  std::copy_n(name.begin(), n, text.bytes.begin());
  std::copy(ending.begin(), ending.end(), text.bytes.begin() + static_cast<std::ptrdiff_t>(n));
  return text;
}

inline bool placed(const VehicleState& s) { return s.attitude_valid && s.position_valid && s.height_valid; }

}  // namespace detail

inline void Standard::configure(const Params& p) {
  world_ = p.world.view();
  base_ = p.base.view();
  world_ned_ = detail::joined(p.world.view(), "_ned");
  base_frd_ = detail::joined(p.base.view(), "_frd");
}

inline Status Standard::step(const Tick&, const Inputs& in, const Params& p, Outputs& out) {
  clock_.note(in.gnss, p.epoch);
  if (in.state && in.state.fresh()) publish_state(in, p, out);
  if (in.imu && in.imu.fresh()) publish_imu(in, p, out);
  if (in.mag && in.mag.fresh()) {
    const std::int64_t at = in.mag.valid_at_ns();
    out.mag.publish({clock_.header(at, base_), flu(in.mag->field_tesla), {}}, at);
  }
  if (in.baro && in.baro.fresh()) {
    const std::int64_t at = in.baro.valid_at_ns();
    out.pressure.publish({clock_.header(at, base_), in.baro->pressure_pa, 0}, at);
  }
  if (in.gnss && in.gnss.fresh()) publish_fix(in, p, out);
  if (in.plan && in.plan.fresh()) publish_plan(in, out);
  if (in.path && in.path.fresh()) publish_piece(in, out);
  return Status::ok;
}

inline void Standard::publish_state(const Inputs& in, const Params& p, Outputs& out) const {
  const VehicleState& s = *in.state;
  if (!detail::placed(s)) return;
  const std::int64_t at = in.state.valid_at_ns();
  const RosHeader header = clock_.header(at, world_);
  const RosPose pose{enu_point(s.position_m), enu_flu(s.attitude)};
  out.pose.publish({header, pose}, at);
  publish_tf(at, pose, p, out);
  if (!s.velocity_valid) return;
  RosOdometry& o = out.odometry.value;  // filled in place: the message is large
  o = {};
  o.header = header;
  o.child_frame_id = base_;
  o.pose.pose = pose;
  put_block(o.pose.covariance, 6, 0, enu_covariance(s.position_std_m));
  put_block(o.pose.covariance, 6, 3, enu_covariance(s.attitude_std_rad));
  o.twist.twist = {flu(to_body(s.attitude, s.velocity_mps)), flu(s.rate_radps)};
  put_block(o.twist.covariance, 6, 0, flu_covariance(s.attitude, s.velocity_std_mps));
  put_block(o.twist.covariance, 6, 3, even_covariance(p.rate_std > 0 ? p.rate_std : unknown_std));
  out.odometry.valid_at_ns = at;
  out.odometry.written = out.odometry.dated = true;
}

inline void Standard::publish_tf(std::int64_t at, const RosPose& pose, const Params& p, Outputs& out) const {
  const RosHeader header = clock_.header(at, world_);
  RosTf tf;
  const RosPoint& o = pose.position;
  tf.transforms.push_back({header, base_, {{o.x, o.y, o.z}, pose.orientation}});
  if (p.ned_frames) {
    tf.transforms.push_back({header, world_ned_, {{}, ros(ned_enu)}});
    tf.transforms.push_back({clock_.header(at, base_), base_frd_, {{}, ros(frd_flu)}});
  }
  out.tf.publish(tf, at);
}

inline void Standard::publish_imu(const Inputs& in, const Params& p, Outputs& out) const {
  const std::int64_t at = in.imu.valid_at_ns();
  RosImu m;
  m.header = clock_.header(at, base_);
  m.orientation_covariance[0] = -1;
  if (in.state && in.state->attitude_valid) {
    m.orientation = enu_flu(in.state->attitude);
    put_block(m.orientation_covariance, 3, 0, enu_covariance(in.state->attitude_std_rad));
  }
  m.angular_velocity = flu(in.imu->rate_radps);
  m.linear_acceleration = flu(in.imu->specific_force_mps2);
  put_block(m.angular_velocity_covariance, 3, 0, even_covariance(p.rate_std));
  put_block(m.linear_acceleration_covariance, 3, 0, even_covariance(p.force_std));
  out.imu.publish(m, at);
}

inline std::int8_t fix_status(FixType fix) {
  switch (fix) {
    case FixType::fix_2d:
    case FixType::fix_3d:
    case FixType::combined: return 0;
    case FixType::rtk_float:
    case FixType::rtk_fixed: return 2;
    default: return -1;
  }
}

inline RosNavSatFix fix_of(const Gnss& g, const RosHeader& header, double geoid_separation_m) {
  RosNavSatFix m;
  m.header = header;
  m.status.status = fix_status(g.fix);
  m.latitude = g.latitude_deg;
  m.longitude = g.longitude_deg;
  m.altitude = g.altitude_m + geoid_separation_m;
  if (g.horizontal_std_m < unknown_std && g.vertical_std_m < unknown_std) {
    m.position_covariance_type = 2;
    put_block(m.position_covariance, 3, 0,
              enu_covariance({g.horizontal_std_m, g.horizontal_std_m, g.vertical_std_m}));
  }
  return m;
}

inline void Standard::publish_fix(const Inputs& in, const Params& p, Outputs& out) const {
  const std::int64_t at = in.gnss.valid_at_ns();
  out.fix.publish(fix_of(*in.gnss, clock_.header(at, base_), p.geoid_separation), at);
}

inline RosPoseStamped Standard::pose_of(const RosHeader& header, const Vec3<Ned>& at,
                                        double course_rad) const {
  return {header, {enu_point(at), enu_heading(course_rad)}};
}

/// Each waypoint with the heading of the leg that ends there; a circuit repeats the first one at its end.
inline void Standard::publish_plan(const Inputs& in, Outputs& out) const {
  const auto& list = in.plan->waypoints;
  RosPath& m = out.plan.value;
  m.header = clock_.header(in.plan.valid_at_ns(), world_);
  m.poses.clear();
  const bool closed = in.plan->end == PlanEnd::circuit && list.size() > 1;
  for (std::size_t i = 0; i < list.size() + (closed ? 1 : 0); ++i) {
    const Waypoint& w = list[i % list.size()];
    const Vec3<Ned>& before = list[(i + list.size() - 1) % list.size()].position_m;
    const double course = std::atan2(w.position_m.east - before.east, w.position_m.north - before.north);
    if (!m.poses.push_back(pose_of(m.header, w.position_m, w.has_course ? w.course_rad : course))) break;
  }
  out.plan.valid_at_ns = in.plan.valid_at_ns();
  out.plan.written = out.plan.dated = true;
}

/// A line: a kilometre of it. An orbit: one turn in steps of 5 degrees, at the heights of a climb if there is
/// one. A curve: from end to end.
inline void Standard::publish_piece(const Inputs& in, Outputs& out) const {
  const Path& path = *in.path;
  RosPath& m = out.piece.value;
  m.header = clock_.header(in.path.valid_at_ns(), world_);
  m.poses.clear();
  if (path.is_curve) {
    const Curve curve = curve_of(path);
    for (int i = 0; i <= 72; ++i)
      m.poses.push_back(pose_of(m.header, curve.point(i / 72.0), curve.course_rad(i / 72.0)));
  } else if (path.kind == PathKind::line) {
    const Vec3<Ned>& q = path.direction_ratio;
    const double length = path.remaining_m < 1000 ? std::max(path.remaining_m, 1.0) : 1000,
                 course = std::atan2(q.east, q.north);
    m.poses.push_back(pose_of(m.header, path.origin_m, course));
    m.poses.push_back(pose_of(m.header, path.origin_m + length * q, course));
  } else {
    const double side = path.turn == Turn::right ? 1 : -1;
    for (int i = 0; i <= 72; ++i) {
      const double arc = 5 * i * std::numbers::pi / 180, azimuth = path.start_rad + side * arc;
      Vec3<Ned> at = path.origin_m;
      at.north += path.radius_m * std::cos(azimuth);
      at.east += path.radius_m * std::sin(azimuth);
      at.down -= path.climb_ratio * path.radius_m * arc;
      m.poses.push_back(pose_of(m.header, at, azimuth + side * std::numbers::pi / 2));
    }
  }
  out.piece.valid_at_ns = in.path.valid_at_ns();
  out.piece.written = out.piece.dated = true;
}

}  // namespace fulmar::ros_bridge

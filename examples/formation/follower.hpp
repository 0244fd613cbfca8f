// SPDX-License-Identifier: BSD-3-Clause
// Keeps a slot relative to a leader. Source: Beard & McLain, Small Unmanned Aircraft (2012), (10.8) for the
// course onto the line of the slot, (9.14) for turns. The rest is the kinematics of a point that is fixed to
// the leader's course.
#pragma once
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

#include "fulmar/eigen.hpp"
#include "fulmar/flight/math/angles.hpp"
#include "fulmar/msg/airframe.hpp"
#include "fulmar/msg/guidance_command.hpp"
#include "other_aircraft.hpp"

namespace fulmar::formation {

/// Position of the aircraft relative to its slot.
struct SlotError {
  double ahead_m = 0;            ///< position error along the track of the slot, ahead positive
  double right_m = 0;            ///< position error to the right of the track of the slot
  double above_m = 0;            ///< position error above the slot
  double rms_m = unknown_std;    ///< distance from the slot since it was reached, root mean square
  double worst_m = unknown_std;  ///< largest distance from the slot since it was reached
  bool reached = false;          ///< true after the slot was reached
  bool evading = false;          ///< true in an evasion of another aircraft
};

struct Follower {
  static constexpr const char* doc = "Guidance that keeps a slot beside a leader.";
  struct Inputs {
    In<VehicleState> state;
    Optional<VehicleState> leader;     // imported, or from Neighbour
    Optional<VehicleState> neighbour;  // aircraft to avoid
  };
  struct Outputs {
    Out<GuidanceCommand> command;
    Out<SlotError> slot;
  };
  struct Params {
    Vector<Body> offset{
        {-20, 20, 0},
        "m",
        -1000,
        1000,
        "position of the slot from the leader: ahead, right, down in the axes of the leader's course"};
    Param separation{10, "m", 1, 500,
                     "minimum distance from any other aircraft and of the slot from the leader"};
    Param look_ahead{2, "s", 0, 10, "horizon of the prediction of the separation"};
    Param timeout{4, "s", 0.02, 60, "largest time without a state of the leader before failure"};
    Param chi_infinity{0.9, "rad", 0.1, 1.4, "approach angle to the line of the slot at large distance"};
    Param k_cross{0.03, "1/m", 0.001, 1,
                  "gain of the approach to the line of the slot, at the reference speed"};
    Param reference_speed{17, "m/s", 1, 200,
                          "ground speed at which k_cross holds; the gain falls with the ground speed"};
    Param k_along{0.25, "1/s", 0.01, 2, "closing speed per distance behind the slot"};
    Param closing_max{5, "m/s", 0.1, 50, "largest closing speed, either way"};
    Param reached{10, "m", 1, 500, "distance from the slot within which it counts as reached"};
    Record<Airframe> airframe{"airframe with the limits of airspeed and bank"};
  };

  void configure(const Params& p) { retune(p); }
  void retune(const Params& p) {
    if (const double far = eigen(p.offset.value).norm(); !(far >= p.separation))
      throw std::runtime_error("offset: the slot is " + std::to_string(far) +
                               " m from the leader, nearer than separation, " +
                               std::to_string(p.separation.value) + " m");
  }
  Status activate(const Tick& tick, const Inputs& in, const Params& p, const Applied<Outputs>& last);
  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out);

 private:
  /// Wind, averaged over the last second: the wind of an estimator is smoother, and gusts displace an
  /// aircraft by metres.
  const Eigen::Vector2d& feel_wind(const Tick& tick, const VehicleState& own) {
    constexpr double second = 1;
    const Eigen::Vector2d now =
        Eigen::Vector2d(own.velocity_mps.north, own.velocity_mps.east) -
        own.airspeed_mps * Eigen::Vector2d(std::cos(own.yaw_rad), std::sin(own.yaw_rad));
    const double dt = 1e-9 * static_cast<double>(tick.dt_ns);
    wind_ += (std::exchange(felt_, true) ? dt / (second + dt) : 1) * (now - wind_);
    return wind_;
  }

  GuidanceCommand last_;
  bool commanded_ = false, felt_ = false;
  Eigen::Vector2d wind_{0, 0};
  SlotError slot_;
  double square_sum_m2_s_ = 0, time_s_ = 0;  // since the slot was reached
};

/// Present state of the slot: a point that is fixed to the leader's course. Horizontal vectors: north, east.
struct Slot {
  Eigen::Vector3d p;   // NED
  Eigen::Vector2d v;   // velocity over ground
  double chi = 0;      // course of v
  double chi_dot = 0;  // turn rate of leader and slot
  double climb_mps = 0;

  Slot(const Motion& leader, const Vec3<Body>& offset)
      : chi(leader.chi), chi_dot(leader.chi_dot), climb_mps(-leader.v.z()) {
    constexpr double slow_mps = 3;
    const double c = std::cos(chi), s = std::sin(chi);
    const Eigen::Vector2d r(c * offset.x - s * offset.y, s * offset.x + c * offset.y);
    p = leader.p + Eigen::Vector3d(r.x(), r.y(), offset.z);
    v = leader.v.head<2>() + chi_dot * Eigen::Vector2d(-r.y(), r.x());
    if (v.norm() > slow_mps) chi = std::atan2(v.y(), v.x());
  }
};

/// Course, airspeed, height and bank that lead into the slot and along its path. `e`: position relative to
/// the slot; `wind`: velocity of the air, north, east.
inline GuidanceCommand into_slot(const VehicleState& own, const Slot& slot, const SlotError& e,
                                 const Eigen::Vector2d& wind, const Follower::Params& p) {
  constexpr double pi = std::numbers::pi, g = 9.80665;
  const double Vg = own.ground_speed_mps, scale = p.reference_speed / std::max(Vg, 0.3 * p.reference_speed);
  const double delta = -p.chi_infinity * (2 / pi) * std::atan(p.k_cross * scale * e.right_m);  // (10.8)
  const double chi_c = slot.chi + delta;
  const double closing = std::clamp(-p.k_along * e.ahead_m, -p.closing_max.value, p.closing_max.value);
  const double Vg_c = std::max((slot.v.norm() + closing) / std::cos(delta), 1.0);
  const double Va_c = (Vg_c * Eigen::Vector2d(std::cos(chi_c), std::sin(chi_c)) - wind).norm();
  const FlightLimits& limits = p.airframe->limits;
  GuidanceCommand c;
  c.course_rad = wrap_pi(chi_c);
  c.height_m = -slot.p.z();
  c.climb_rate_mps = std::clamp(slot.climb_mps, -limits.sink_rate_max_mps, limits.climb_rate_max_mps);
  c.airspeed_mps = std::clamp(Va_c, limits.airspeed_min_mps, limits.airspeed_max_mps);
  // The turn of the slot is fed forward only near its line and along its course.
  const double along = std::abs(angle_difference(slot.chi, own.course_rad));
  const double share = smoothly(std::abs(e.right_m), 40, 20) * smoothly(along, pi / 2, pi / 4);
  const double crab = std::max(std::cos(own.course_rad - own.yaw_rad), 0.5);
  c.roll_feedforward_rad = std::clamp(share * std::atan(Vg * slot.chi_dot / (g * crab)), -limits.roll_max_rad,
                                      limits.roll_max_rad);  // (9.14)
  return c;
}

/// Evasion of an aircraft that is close, or will be. The higher of the two climbs. The lower one does not
/// climb, and does not descend either, as the ground may be near. The aircraft behind slows down. Returns
/// true during an evasion.
inline bool keep_clear(const VehicleState& own, const Motion& other, const Follower::Params& p,
                       GuidanceCommand& c) {
  const Relative to(own, other);
  if (to.nearest(p.look_ahead) >= p.separation) return false;
  if (to.p.z() >= 0) {  // the other aircraft is below, or level
    c.height_m = std::max(c.height_m, -other.p.z() + p.separation);
    c.climb_rate_mps = std::max(c.climb_rate_mps, 0.0);
  } else {
    c.height_m = std::min(c.height_m, own.height_m);
    c.climb_rate_mps = std::min(c.climb_rate_mps, 0.0);
  }
  const bool ahead = to.p.x() * std::cos(own.course_rad) + to.p.y() * std::sin(own.course_rad) > 0;
  if (ahead) c.airspeed_mps = p.airframe->limits.airspeed_min_mps;
  return true;
}

inline bool usable(const VehicleState& own, const Optional<VehicleState>& other, double timeout_s) {
  return other && other.age_s() <= timeout_s && located(*other) && same_origin(own, *other);
}

/// A switch needs a valid leader. At the start there is no previous component, and the follower waits for the
/// leader.
inline Status Follower::activate(const Tick&, const Inputs& in, const Params& p,
                                 const Applied<Outputs>& last) {
  slot_.reached = felt_ = false;
  commanded_ = last.has(last->command);
  if (commanded_) last_ = last->command.value;
  return commanded_ && !usable(*in.state, in.leader, p.timeout) ? Status::failed : Status::ok;
}

inline Status Follower::step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
  const VehicleState& own = *in.state;
  if (!located(own)) {  // slot unknown: straight on, with the last command
    last_.climb_rate_mps = last_.roll_feedforward_rad = 0;
    if (commanded_) out.command.publish(last_);
    return Status::degraded;
  }
  if (!usable(own, in.leader, p.timeout)) return in.leader ? Status::failed : Status::degraded;
  const Motion leader(*in.leader, in.leader.age_s());
  const Slot slot(leader, p.offset.value);
  const Eigen::Vector3d e = eigen(own.position_m) - slot.p;
  slot_.ahead_m = std::cos(slot.chi) * e.x() + std::sin(slot.chi) * e.y();
  slot_.right_m = -std::sin(slot.chi) * e.x() + std::cos(slot.chi) * e.y();
  slot_.above_m = -e.z();
  GuidanceCommand command = into_slot(own, slot, slot_, feel_wind(tick, own), p);
  slot_.evading = keep_clear(own, leader, p, command);
  if (usable(own, in.neighbour, p.timeout))
    slot_.evading |= keep_clear(own, Motion(*in.neighbour, in.neighbour.age_s()), p, command);
  slot_.reached = slot_.reached || e.norm() < p.reached;
  if (slot_.reached) {
    const double dt = 1e-9 * static_cast<double>(tick.dt_ns);
    square_sum_m2_s_ += dt * e.squaredNorm();
    time_s_ += dt;
    slot_.rms_m = time_s_ > 0 ? std::sqrt(square_sum_m2_s_ / time_s_) : e.norm();
    slot_.worst_m = slot_.worst_m == unknown_std ? e.norm() : std::max(slot_.worst_m, e.norm());
  }
  out.command.publish(command);
  out.slot.publish(slot_);
  last_ = command;
  commanded_ = true;
  return slot_.evading ? Status::degraded : Status::ok;
}

}  // namespace fulmar::formation

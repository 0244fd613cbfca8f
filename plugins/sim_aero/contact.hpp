// SPDX-License-Identifier: BSD-3-Clause
// Ground contact of the aircraft's parts, for figures and reports: published at each change.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "fulmar/eigen.hpp"
#include "fulmar/msg/contact_truth.hpp"
#include "fulmar/plugin.hpp"
#include "fulmar/sim/plant.hpp"

namespace fulmar::sim {

class ContactReport {
 public:
  /// `held`: in a hand or on a catapult.
  void publish(const Plant& plant, bool held, std::int64_t now_ns, Out<ContactTruth>& out) {
    const bool touching = plant.on_ground() || held, crashed = plant.crashed(),
               touched = plant.touch().count != count_;
    if (begun_ && touching == last_.touching && crashed == last_.crashed && !touched) return;
    begun_ = true;
    last_.touching = touching;
    last_.crashed = crashed;
    if (touched) note(plant.touch(), now_ns);
    out.publish(last_);
  }

 private:
  void note(const Touch& touch, std::int64_t now_ns) {
    const RigidBody& x = touch.at;
    const Eigen::Matrix3d R = x.q_nb.toRotationMatrix();
    count_ = touch.count;
    last_.part = touch.part;
    last_.touched_s = 1e-9 * static_cast<double>(now_ns);
    last_.position_m = from_eigen<Ned>(x.p_n);
    last_.sink_mps = x.v_n.z();
    last_.ground_speed_mps = std::hypot(x.v_n.x(), x.v_n.y());
    last_.roll_rad = std::atan2(R(2, 1), R(2, 2));
    last_.pitch_rad = std::asin(std::clamp(-R(2, 0), -1.0, 1.0));
    last_.yaw_rad = std::atan2(R(1, 0), R(0, 0));
    last_.course_rad = last_.ground_speed_mps > 0.1 ? std::atan2(x.v_n.y(), x.v_n.x()) : last_.yaw_rad;
  }

  ContactTruth last_;
  std::uint32_t count_ = 0;
  bool begun_ = false;
};

}  // namespace fulmar::sim

// SPDX-License-Identifier: BSD-3-Clause
// A launch without a runway: the aircraft is held by hand or on a catapult. Some time after arming it is
// pushed along its nose with a constant acceleration until the release speed.
#pragma once
#include <cstdint>

#include "fulmar/plugin.hpp"

namespace fulmar::sim {

enum class LaunchKind : std::uint8_t { none, hand, catapult };

struct LaunchParams {
  Choice<LaunchKind> launch{LaunchKind::none,
                            "kind of launch; hand: from 1.5 m high, push over 1.5 m; catapult: from 1 m "
                            "high, over 4 m; none: rolling take-off",
                            setup};
  Param launch_after{5, "s", 0, 3600, "time from the first arming to the launch", setup};
  Param launch_speed{0, "m/s", 0, 60, "ground speed at release; 0: 9 for `hand`, 16 for `catapult`", setup};
  Param launch_pitch{0.2, "rad", 0, 0.8, "pitch of the nose and of the path during the push", setup};
};

class Launch {
 public:
  Launch() = default;
  explicit Launch(const LaunchParams& p)
      : given_(p.launch != LaunchKind::none),
        by_hand_(p.launch == LaunchKind::hand),
        after_s_(p.launch_after) {
    const double length_m = by_hand_ ? 1.5 : 4, usual_mps = by_hand_ ? 9 : 16;
    const double speed_mps = p.launch_speed > 0 ? p.launch_speed.value : usual_mps;
    push_mps2_ = speed_mps * speed_mps / (2 * length_m);
    push_s_ = 2 * length_m / speed_mps;
  }
  bool given() const { return given_; }
  double height_m() const { return by_hand_ ? 1.5 : 1; }
  /// `armed_s`: time since arming. True until the release.
  bool holds(double armed_s) const { return given_ && armed_s < after_s_ + push_s_; }
  /// m/s2 along the nose, during the launch.
  double push_mps2(double armed_s) const { return armed_s < after_s_ ? 0 : push_mps2_; }

 private:
  bool given_ = false, by_hand_ = false;
  double after_s_ = 0, push_mps2_ = 0, push_s_ = 0;
};

}  // namespace fulmar::sim

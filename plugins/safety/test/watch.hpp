// SPDX-License-Identifier: BSD-3-Clause
// A monitor with all of its inputs.
#pragma once
#include <string>

#include "kit.hpp"
#include "plugins/safety/monitor.hpp"

namespace kit {

using namespace fulmar;
using namespace fulmar::safety;

struct Watch : Bench<Monitor> {
  VehicleState state = kit::level();
  VehicleStatus status;
  Actuators actuators;
  Rc rc;
  NavigationHealth health;
  GroundState ground;
  bool has_status = true, has_rc = false, has_health = false, has_throttle = true, has_ground = false;
  std::string reported;
  std::vector<Notice> notices;

  Watch() {
    kit::give_anaconda(params);
    status.armed = status.in_control = true;
    status.battery_volt = 24;
    actuators.throttle_frac = 0.57;
    health.pitot.state = health.gnss_position.state = SensorState::ok;
  }
  void fence(double south = -1000) {
    Fence& f = params.fence.value;
    for (const auto& [n, e] :
         {std::pair{1000.0, -1000.0}, {1000.0, 1000.0}, {south, 1000.0}, {south, -1000.0}}) {
      FencePoint p;
      p.north_m = n;
      p.east_m = e;
      f.corners.push_back(p);
    }
    f.floor_m = 20;
    f.ceiling_m = 120;
    params.fence.is_given = true;
  }
  const SafetyState& fly(double seconds, double dt = 0.02) {
    for (double t = 0; t < seconds - dt / 2; t += dt) {
      set(in.state, state, -dt);
      if (has_status) set(in.status, status, -dt);
      if (has_rc) set(in.rc, rc, -dt);
      if (has_health) set(in.health, health, -dt);
      if (has_throttle) set(in.actuators, actuators, -dt);
      if (has_ground) set(in.ground, ground, -dt);
      REQUIRE(step(dt) == Status::ok);
      REQUIRE(validation_error() == "");
      for (std::uint32_t i = 0; i < out.notices.count; ++i) {
        CHECK(out.notices.items[i].text.view().size() < 96);  // none is cut
        notices.push_back(out.notices.items[i]);
        reported += std::string(out.notices.items[i].text.view()) + "\n";
      }
    }
    return out.safety;
  }
  /// From when on `flag` is raised, s; -1: not within `within_s`.
  double raised_after(bool SafetyState::*flag, double within_s = 20, bool wanted = true) {
    for (double t = 0; t < within_s; t += 0.02)
      if (fly(0.02).*flag == wanted) return t + 0.02;
    return -1;
  }
};

/// The same, standing at home, armed, with a radio and sensors in order.
struct Stands : Watch {
  Stands() {
    state.position_m = {0, 0, 0};
    state.velocity_mps = {};
    state.height_m = state.ground_speed_mps = state.airspeed_mps = 0;
    state.wind_valid = false;
    actuators.throttle_frac = 0;
    ground.contact = Contact::ground;
    has_ground = has_health = true;
  }
  bool reported_of(const char* words) const { return reported.find(words) != std::string::npos; }
};

}  // namespace kit

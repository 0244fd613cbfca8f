// SPDX-License-Identifier: BSD-3-Clause
// The three servos, their surfaces and the mixer between them and aileron, elevator and rudder. Limits and
// faults are those of a servo and its surface: with a mixer, an elevon or a ruddervator (fields as in
// mixer.hpp).
#pragma once
#include "fulmar/flight/model/mixer.hpp"
#include "fulmar/msg/actuators.hpp"
#include "fulmar/sim/drive.hpp"

namespace fulmar::sim {

/// Servos, mixer and surfaces of one airframe. Deflections in rad, signs as in `Actuators`.
class Surfaces {
 public:
  explicit Surfaces(const Airframe& a)
      : mixer_(a.mixer), aileron_(a.aileron), elevator_(a.elevator), rudder_(a.rudder) {}

  void advance(const Deflections& servos, double dt) {
    aileron_.advance(servos.aileron, dt);
    elevator_.advance(servos.elevator, dt);
    rudder_.advance(servos.rudder, dt);
  }
  /// Commands of the servos.
  Deflections commanded(const Actuators& command) const {
    return to_servos(mixer_, {command.aileron_rad, command.elevator_rad, command.rudder_rad});
  }
  Deflections servos() const { return {aileron_.angle(), elevator_.angle(), rudder_.angle()}; }
  Deflections deflections() const { return from_servos(mixer_, servos()); }

  void set(const Deflections& d) {
    const Deflections at = to_servos(mixer_, d);
    aileron_.set(at.aileron);
    elevator_.set(at.elevator);
    rudder_.set(at.rudder);
  }
  void suffer(const Fault& aileron, const Fault& elevator, const Fault& rudder) {
    aileron_.suffer(aileron);
    elevator_.suffer(elevator);
    rudder_.suffer(rudder);
  }
  bool free() const { return aileron_.free() || elevator_.free() || rudder_.free(); }
  void trail_at(const Deflections& d) {
    const Deflections at = to_servos(mixer_, d);
    aileron_.trail_at(at.aileron);
    elevator_.trail_at(at.elevator);
    rudder_.trail_at(at.rudder);
  }

 private:
  Mixer mixer_;
  Drive aileron_, elevator_, rudder_;
};

}  // namespace fulmar::sim

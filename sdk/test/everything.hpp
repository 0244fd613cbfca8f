// SPDX-License-Identifier: BSD-3-Clause
// A component with a port and a parameter of every kind, for the tests of this folder.
#pragma once
#include <stdexcept>
#include <string>

#include "fulmar/msg/actuators.hpp"
#include "fulmar/msg/attitude_command.hpp"
#include "fulmar/msg/plan_edit.hpp"
#include "fulmar/msg/vehicle_state.hpp"
#include "fulmar/testing.hpp"

namespace plugin_test {

using namespace fulmar;

enum class Law : std::uint8_t { hold, takeoff };

struct Gains {
  double roll_ratio = 1;
};

inline const std::string long_reason = [] {
  std::string text = "because";
  while (text.size() < 300) text += " of words";
  return text;
}();
inline const std::string long_word = [] {
  std::string text;
  while (text.size() < 300) text += "\xc3\xbc";  // a letter of two bytes
  return text;
}();

struct Everything {
  static constexpr const char* doc = "every kind of port";
  struct Inputs {
    In<VehicleState> state;
    Optional<AttitudeCommand> attitude;
    Queue<PlanEdit> edits;
    Request<PlanEdit> edit;
  };
  struct Outputs {
    Actuators actuators;
    Out<AttitudeCommand> wish;
    OutQueue<PlanEdit, 2> made;
    Probe roll_error_rad;
  };
  struct Params {
    Param roll_kp{0.5, "rad/rad", 0, 2, "aileron per roll error"};
    Flag on{true, "whether it works"};
    Count n{3, 0, 10, "how many"};
    Choice<Law> law{Law::hold, "which law"};
    TextParam<8> word{"abc", "a word"};
    Vector<Ned> wind{{3, -4, 0}, "m/s", -30, 30, "wind"};
    Record<Gains> gains{"a record"};
    Blob table{"bytes"};
    Param mass{2, "kg", 0, 9, "fixed", setup};
  };

  void configure(const Params& p) {
    if (p.n == 7) throw std::runtime_error("seven is unlucky");
    configured = p.roll_kp;
  }
  void retune(const Params& p) { configured = p.roll_kp; }
  Status activate(const Tick&, const Inputs&, const Params&, const Outputs& last) {
    taken_over = last.actuators.aileron_rad;
    return Status::ok;
  }
  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
    if (in.state->roll_rad > 3) throw std::runtime_error("upside down");
    if (in.state->roll_rad < -3) return Status::failed;
    out.actuators.aileron_rad = p.roll_kp * (in.attitude ? in.attitude->roll_rad - in.state->roll_rad : 0);
    out.roll_error_rad = -in.state->roll_rad;
    if (in.attitude.fresh()) out.wish.publish(*in.attitude, tick.now_ns - 5);
    for (const auto& sample : in.edits) out.made.push(sample.value, sample.valid_at_ns);
    for (auto request : in.edit) {
      if (request.value().index == 100)
        request.refuse(long_reason);
      else if (request.value().index == 101)
        request.refuse(long_word);
      else if (request.value().index > 3)
        request.refuse("there is no waypoint " + std::to_string(request.value().index));
      else
        request.accept();
    }
    last_dt = tick.dt_s();
    return Status::ok;
  }
  double configured = 0, taken_over = 0, last_dt = 0;
};

}  // namespace plugin_test

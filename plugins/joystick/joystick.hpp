// SPDX-License-Identifier: BSD-3-Clause
// A joystick, gamepad, or transmitter on USB. Runs in a separate thread: `run: driver`.
#pragma once
#include <array>
#include <string>

#include "events.hpp"
#include "fulmar/flight/control/sticks.hpp"
#include "messages.hpp"
#include "source.hpp"
#include "transmitter.hpp"

namespace fulmar::hand {

struct AxisParams {
  Count roll_axis{0, -1, 31, "axis of the roll stick, right positive; -1: none", setup};
  Flag roll_reversed{false, "reversal of the roll axis: left positive", setup};
  Count pitch_axis{1, -1, 31, "axis of the pitch stick, pull positive; -1: none", setup};
  Flag pitch_reversed{false, "reversal of the pitch axis: push positive, as with a transmitter on USB",
                      setup};
  Count throttle_axis{2, -1, 31, "axis of the throttle, open positive; -1: none, throttle closed", setup};
  Flag throttle_reversed{false, "reversal of the throttle axis: closed positive, as with a slider", setup};
  Count yaw_axis{3, -1, 31, "axis of the yaw stick, right positive; -1: none", setup};
  Flag yaw_reversed{false, "reversal of the yaw axis: left positive", setup};
  Count aux1_axis{4, -1, 31, "axis of the first switch; -1: none", setup};
  Count aux2_axis{5, -1, 31, "axis of the second switch; -1: none", setup};
  Count aux3_axis{6, -1, 31, "axis of the third switch; -1: none", setup};
  Count aux4_axis{7, -1, 31, "axis of the fourth switch; -1: none", setup};
};

struct ButtonParams {
  Count aux1_button{-1, -1, 63, "button of the first switch, in place of the axis; -1: none", setup};
  Count aux2_button{-1, -1, 63, "button of the second switch, in place of the axis; -1: none", setup};
  Count aux3_button{-1, -1, 63, "button of the third switch, in place of the axis; -1: none", setup};
  Count aux4_button{-1, -1, 63, "button of the fourth switch, in place of the axis; -1: none", setup};
  Flag buttons_latch{true, "toggle mode of the buttons; false: on while pressed", setup};
};

struct Joystick {
  static constexpr const char* doc =
      "A Linux joystick as the pilot's transmitter: frames at 50 Hz. Needs `run: driver`.";
  struct Inputs {};
  struct Outputs {
    OutQueue<Rc, 4> rc;
    OutQueue<Notice, 4> notices;
    Probe unknown_records_ratio;  // number of invalid records since the start
  };
  struct Params {
    TextParam<128> device{Text<128>("/dev/input/js0"),
                          "device file of the joystick, or a pipe of its records"};
    AxisParams axes;
    ButtonParams buttons;
    Param dead_zone{0.02, "", 0, 0.5, "dead zone of the three sticks around their centre", setup};
    Param expo{0, "", 0, 1, "share of the cubic term of the stick curve", setup};
  };

  void configure(const Params& p) {
    path_ = checked_path(p.device.view());
    source_.close("");
    state_ = {};
    transmitter_ = {};
    unknown_reported_ = 0;
  }

  /// Waits at most 20 ms for records, so that a flight faster than real time gets its frames. `degraded`
  /// without a joystick.
  Status step(const Tick& tick, const Inputs&, const Params& p, Outputs& out) {
    if (!source_.is_open() && source_.open(path_)) state_.forget();
    if (source_.is_open())
      listen();
    else
      pause_ms(20);
    const bool link = source_.is_open() && state_.heard();
    if (link || !source_.is_open()) transmitter_.report(link, path_, source_.fault(), out.notices);
    if (transmitter_.due(tick.now_ns)) out.rc.push(link ? frame(p) : Rc{}, on_arrival);
    if (state_.unknown() != unknown_reported_)
      out.unknown_records_ratio = static_cast<double>(unknown_reported_ = state_.unknown());
    return link ? Status::ok : Status::degraded;
  }

 private:
  /// Reads a limited number of records: the others wait for the next step, and the frames are not delayed.
  void listen() {
    std::array<char, 64 * JsEvent::size> bytes;
    int wait_ms = 2;
    for (int i = 0; i < 8; ++i) {
      const std::size_t n = source_.read(bytes, wait_ms);
      state_.take({bytes.data(), n});
      if (n < bytes.size()) break;
      wait_ms = 0;
    }
    if (state_.foreign()) source_.close(joystick_messages::records_foreign.c_str());
  }

  Rc frame(const Params& p) const {
    const AxisParams& a = p.axes;
    const auto stick = [&](std::int64_t axis, bool reversed) {
      return (reversed ? -1 : 1) * shaped(state_.axis(axis, 0), p.dead_zone, p.expo);
    };
    const double open = (a.throttle_reversed ? -1 : 1) * state_.axis(a.throttle_axis, 0);
    const ButtonParams& b = p.buttons;
    const auto lever = [&](std::int64_t axis, std::int64_t button) {
      if (button < 0) return state_.axis(axis, 0);
      return (b.buttons_latch ? state_.presses(button) % 2 == 1 : state_.pressed(button)) ? 1.0 : -1.0;
    };
    Rc rc;
    rc.roll_frac = stick(a.roll_axis, a.roll_reversed);
    rc.pitch_frac = stick(a.pitch_axis, a.pitch_reversed);
    rc.yaw_frac = stick(a.yaw_axis, a.yaw_reversed);
    rc.throttle_frac = state_.has_axis(a.throttle_axis) ? (1 + open) / 2 : 0;
    rc.aux1_frac = lever(a.aux1_axis, b.aux1_button);
    rc.aux2_frac = lever(a.aux2_axis, b.aux2_button);
    rc.aux3_frac = lever(a.aux3_axis, b.aux3_button);
    rc.aux4_frac = lever(a.aux4_axis, b.aux4_button);
    rc.link = true;
    return rc;
  }

  std::string path_;
  Source source_;
  JsState state_;
  Transmitter transmitter_;
  std::uint64_t unknown_reported_ = 0;
};

}  // namespace fulmar::hand

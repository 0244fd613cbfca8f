// SPDX-License-Identifier: BSD-3-Clause
// Records of the Linux joystick interface: from bytes to the state of axes and buttons. Source: the kernel's
// Documentation/input/joydev/joystick-api and linux/joystick.h. No I/O, no allocation.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace fulmar::hand {

/// One record of the kernel, little endian: u32 time, ms; i16 value; u8 type; u8 number.
struct JsEvent {
  static constexpr std::size_t size = 8;
  static constexpr std::uint8_t button = 1, axis = 2, init = 0x80;  ///< init: state at the opening
  std::int16_t value = 0;
  std::uint8_t type = 0, number = 0;

  static JsEvent of(const std::array<std::uint8_t, size>& b) {
    return {static_cast<std::int16_t>(static_cast<std::uint16_t>(b[4] | b[5] << 8)), b[6], b[7]};
  }
};

/// Takes bytes in any pieces. An invalid record is counted and ignored.
class JsState {
 public:
  static constexpr std::size_t max_axes = 32, max_buttons = 64;
  static constexpr std::uint64_t patience = 8;  ///< this many invalid records in a row: not a joystick

  void take(std::span<const char> bytes) {
    for (const char c : bytes) {
      partial_[filled_++] = static_cast<std::uint8_t>(c);
      if (filled_ < JsEvent::size) continue;
      filled_ = 0;
      take(JsEvent::of(partial_));
    }
  }

  bool heard() const { return heard_; }                   ///< a valid record has arrived
  bool foreign() const { return in_a_row_ >= patience; }  ///< the device is not a joystick
  std::uint64_t unknown() const { return unknown_; }
  /// Clears the state after the loss of the device. The count continues.
  void forget() {
    const std::uint64_t unknown = unknown_;
    *this = {};
    unknown_ = unknown;
  }

  /// -1 to 1; `otherwise` for an axis without a record.
  double axis(std::int64_t number, double otherwise) const {
    if (number < 0 || number >= static_cast<std::int64_t>(max_axes)) return otherwise;
    const Axis& a = axes_[static_cast<std::size_t>(number)];
    return a.known ? a.value : otherwise;
  }
  bool has_axis(std::int64_t number) const { return axis(number, 2) != 2; }
  bool pressed(std::int64_t number) const { return of_button(number) && of_button(number)->down; }
  /// Number of presses, without a button that was down at the opening.
  std::uint64_t presses(std::int64_t number) const {
    return of_button(number) ? of_button(number)->presses : 0;
  }

 private:
  struct Axis {
    double value = 0;
    bool known = false;
  };
  struct Button {
    bool down = false;
    std::uint64_t presses = 0;
  };

  const Button* of_button(std::int64_t number) const {
    const bool there = number >= 0 && number < static_cast<std::int64_t>(max_buttons);
    return there ? &buttons_[static_cast<std::size_t>(number)] : nullptr;
  }

  void take(const JsEvent& e) {
    const auto kind = static_cast<std::uint8_t>(e.type & ~JsEvent::init);
    const bool is_axis = kind == JsEvent::axis && e.number < max_axes;
    const bool is_button =
        kind == JsEvent::button && e.number < max_buttons && (e.value == 0 || e.value == 1);
    if (!is_axis && !is_button) {
      ++unknown_;
      ++in_a_row_;
      return;
    }
    in_a_row_ = 0;
    heard_ = true;
    if (is_axis) {
      axes_[e.number] = {e.value <= -32767 ? -1 : e.value / 32767.0, true};  // the kernel's range is +-32767
      return;
    }
    Button& b = buttons_[e.number];
    if (e.value == 1 && !b.down && (e.type & JsEvent::init) == 0) ++b.presses;
    b.down = e.value == 1;
  }

  std::array<std::uint8_t, JsEvent::size> partial_{};
  std::size_t filled_ = 0;
  std::array<Axis, max_axes> axes_{};
  std::array<Button, max_buttons> buttons_{};
  bool heard_ = false;
  std::uint64_t unknown_ = 0, in_a_row_ = 0;
};

}  // namespace fulmar::hand

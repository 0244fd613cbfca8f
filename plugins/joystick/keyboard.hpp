// SPDX-License-Identifier: BSD-3-Clause
// The keys of a terminal as a transmitter. Runs in a separate thread: `run: driver`.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <utility>

#include "source.hpp"
#include "transmitter.hpp"

namespace fulmar::hand {

/// A terminal reports that a key is pressed, and repeats it, but does not report its release. So each press
/// deflects a stick, which then returns.
class Keys {
 public:
  struct Sizes {
    double deflection = 0.25, throttle = 0.05;  ///< per press
    double return_s = 0.5;                      ///< time constant
  };

  void take(std::span<const char> characters, const Sizes& sizes) {
    for (const char c : characters) press(key(c), sizes);
  }

  /// The sticks return with flight time.
  void pass(double dt_s, const Sizes& sizes) {
    const double left = std::exp(-std::max(0.0, dt_s) / sizes.return_s);
    roll_ *= left;
    pitch_ *= left;
    yaw_ *= left;
  }

  Rc frame() const {
    const auto lever = [&](std::size_t i) { return on_[i] ? 1.0 : -1.0; };
    return {roll_, pitch_, yaw_, throttle_, lever(0), lever(1), lever(2), lever(3), true};
  }
  std::uint64_t unknown() const { return unknown_; }

 private:
  /// Letter of an arrow key, which arrives as ESC [ A or ESC O A; 0: incomplete.
  char key(char c) {
    const char before = std::exchange(escape_, '\0');
    if (c == '\x1b') {
      escape_ = c;
      return '\0';
    }
    if (before == '\x1b' && (c == '[' || c == 'O')) {
      escape_ = '[';
      return '\0';
    }
    if (before != '[') return c;
    if ((c >= '0' && c <= '9') || c == ';') {
      escape_ = '[';
      return '\0';  // a key with a modifier
    }
    switch (c) {
      case 'A': return 'w';
      case 'B': return 's';
      case 'C': return 'd';
      case 'D': return 'a';
      default: return '\x7f';  // any other key that is no letter
    }
  }

  void press(char k, const Sizes& sizes) {
    const auto move = [](double& x, double by) { x = std::clamp(x + by, -1.0, 1.0); };
    switch (k) {
      case '\0': return;
      case 'd': return move(roll_, sizes.deflection);
      case 'a': return move(roll_, -sizes.deflection);
      case 's': return move(pitch_, sizes.deflection);  // stick pulled: nose up
      case 'w': return move(pitch_, -sizes.deflection);
      case 'e': return move(yaw_, sizes.deflection);
      case 'q': return move(yaw_, -sizes.deflection);
      case 'r': throttle_ = std::min(1.0, throttle_ + sizes.throttle); return;
      case 'f': throttle_ = std::max(0.0, throttle_ - sizes.throttle); return;
      case 'x': throttle_ = 0; return;
      case ' ': roll_ = pitch_ = yaw_ = 0; return;
      case '1':
      case '2':
      case '3':
      case '4': {
        bool& on = on_[static_cast<std::size_t>(k - '1')];
        on = !on;
        return;
      }
      default: ++unknown_;
    }
  }

  double roll_ = 0, pitch_ = 0, yaw_ = 0, throttle_ = 0;
  std::array<bool, 4> on_{};
  char escape_ = '\0';  ///< ESC, or [ after ESC: an arrow key has begun
  std::uint64_t unknown_ = 0;
};

struct Keyboard {
  static constexpr const char* doc =
      "The keys of a terminal as the pilot's transmitter: frames at 50 Hz. Needs `run: driver`.";
  struct Inputs {};
  struct Outputs {
    OutQueue<Rc, 4> rc;
    OutQueue<Notice, 4> notices;
    Probe unknown_keys_ratio;  // since the start
  };
  struct Params {
    TextParam<128> device{Text<128>("/dev/tty"), "device file of the terminal, or a pipe of characters"};
    Param deflection{0.25, "", 0.01, 1, "change of a stick per key press", setup};
    Param throttle_step{0.05, "", 0.005, 1, "change of the throttle per key press", setup};
    Param return_time{0.5, "s", 0.05, 60, "time constant of the return of a stick to its centre", setup};
  };

  void configure(const Params& p) {
    path_ = checked_path(p.device.view());
    source_.close("");
    keys_ = {};
    transmitter_ = {};
    before_ns_ = never;
    unknown_reported_ = 0;
  }

  /// Waits at most 20 ms for keys. `degraded` without a terminal.
  Status step(const Tick& tick, const Inputs&, const Params& p, Outputs& out) {
    const Keys::Sizes sizes{p.deflection, p.throttle_step, p.return_time};
    if (!source_.is_open() && source_.open(path_)) keys_ = {};
    if (before_ns_ != never) keys_.pass(1e-9 * static_cast<double>(tick.now_ns - before_ns_), sizes);
    before_ns_ = tick.now_ns;
    std::array<char, 256> characters;
    if (source_.is_open())
      keys_.take({characters.data(), source_.read(characters, 2)}, sizes);
    else
      pause_ms(20);
    const bool link = source_.is_open();
    transmitter_.report(link, path_, source_.fault(), out.notices);
    if (transmitter_.due(tick.now_ns)) out.rc.push(link ? keys_.frame() : Rc{}, on_arrival);
    if (keys_.unknown() != unknown_reported_)
      out.unknown_keys_ratio = static_cast<double>(unknown_reported_ = keys_.unknown());
    return link ? Status::ok : Status::degraded;
  }

 private:
  static constexpr std::int64_t never = INT64_MIN;

  std::string path_;
  Source source_;
  Keys keys_;
  Transmitter transmitter_;
  std::int64_t before_ns_ = never;
  std::uint64_t unknown_reported_ = 0;
};

}  // namespace fulmar::hand

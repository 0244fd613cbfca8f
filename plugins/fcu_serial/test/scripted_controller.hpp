// SPDX-License-Identifier: BSD-3-Clause
// A scripted controller: a test acts as controller and loop in turn, and the link has its thread.
#pragma once
#include <array>
#include <cstdint>
#include <ctime>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "plugins/fcu_serial/link/link.hpp"
#include "pty.hpp"

namespace fulmar::fcu::testing {

inline constexpr std::int64_t ms = 1'000'000, second = 1'000'000'000;
inline constexpr int patience_ms = 10'000;  // far longer than any event takes

inline std::int64_t monotonic_ns() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * second + now.tv_nsec;
}

/// A scripted controller: sends frames on request, stores received ones, and answers requests for the time
/// when it has a clock.
class Controller {
 public:
  Pty pty;
  std::map<int, std::vector<Packet>> heard;
  std::function<std::int64_t()> clock_ns;  ///< none: questions stay unanswered
  Parser parser;

  template <class M>
  bool send(const M& message) {
    return pty.write(encode(message, sequence_++, 1, 250).view());
  }
  bool send_imu(std::uint64_t stamp_us) {
    SmallImu imu;
    imu.time_boot_us = stamp_us;
    return send(imu);
  }
  void listen(int wait_ms) {
    std::array<std::uint8_t, 4096> room;
    const std::size_t n = pty.read(room, wait_ms);
    parser.feed({room.data(), n}, [&](const Packet& p) {
      heard[p.id].push_back(p);
      if (!p.is<Timesync>() || !clock_ns) return;
      auto answer = p.as<Timesync>();
      answer.tc1 = clock_ns();
      send(answer);
    });
  }
  /// Receives until the condition holds. Returns false when it never does.
  bool listen_until(const std::function<bool()>& so) {
    for (const std::int64_t end = monotonic_ns() + patience_ms * ms; !so();) {
      if (monotonic_ns() > end) return false;
      listen(5);
    }
    return true;
  }
  std::vector<std::string> asked_for() {
    std::vector<std::string> names;
    for (const Packet& p : heard[ParamRequestRead::id])
      names.emplace_back(text(p.as<ParamRequestRead>().param_id));
    return names;
  }
  void answer_parameter(const std::string& name, std::uint32_t bits) {
    ParamValue value;
    value.param_id = field<16>(name);
    value.param_value = bits;
    pty.write(encode(value, sequence_++, 1, 0).view());
  }

 private:
  std::uint8_t sequence_ = 0;
};

/// Pops from the queue until an event matches.
inline bool pop_until(Link& link, Controller& controller,
                      const std::function<bool(const Received&)>& wanted) {
  for (const std::int64_t end = monotonic_ns() + patience_ms * ms; monotonic_ns() < end;) {
    for (Received r; link.pop(r);) {
      if (wanted(r)) return true;
    }
    controller.listen(1);
  }
  return false;
}
inline auto event_is(LinkEvent event) {
  return [event](const Received& r) { return r.event == event; };
}

inline LinkOptions options_of(const Controller& controller) {
  LinkOptions options;
  options.port = controller.pty.name();
  return options;
}

}  // namespace fulmar::fcu::testing

// SPDX-License-Identifier: BSD-3-Clause
// The other end of a Firmware in virtual time: sends frames, keeps what comes, counts bytes.
#pragma once
#include <string>
#include <vector>

#include "plugins/fcu_serial/test/peer/firmware.hpp"

namespace fulmar::fcu::peer {

struct Companion {
  explicit Companion(const Options& options = {}) : fcu(options) {}

  Firmware fcu;
  std::int64_t now_us = 0;
  std::vector<Packet> packets;
  std::uint64_t bytes = 0;

  template <class M>
  void send(const M& message) {
    fcu.receive(encode(message, sequence_++).view(), now_us);
    collect();
  }
  void wait(double seconds) {
    const std::int64_t end = now_us + static_cast<std::int64_t>(seconds * 1e6);
    while (now_us < end) {
      now_us = std::min(end, now_us + 1000);
      fcu.run(now_us);
      collect();
    }
  }
  /// The same command again and again, at 50 Hz.
  void command(const OffboardControl& m, double seconds) {
    for (double t = 0; t < seconds; t += 0.02) {
      send(m);
      wait(0.02);
    }
  }
  void forget() {
    packets.clear();
    bytes = 0;
  }

  template <class M>
  std::vector<M> all() const {
    std::vector<M> found;
    for (const Packet& p : packets)
      if (p.is<M>()) found.push_back(p.as<M>());
    return found;
  }
  template <class M>
  M last() const {
    const auto found = all<M>();
    return found.empty() ? M{} : found.back();
  }
  std::vector<std::string> texts() const {
    std::vector<std::string> found;
    for (const auto& m : all<Statustext>()) found.emplace_back(text(m.text));
    return found;
  }
  bool said(std::string_view words) const {
    for (const auto& line : texts())
      if (line.find(words) != std::string::npos) return true;
    return false;
  }

 private:
  void collect() {
    const auto sent = fcu.take();
    bytes += sent.size();
    parser_.feed(sent, [this](const Packet& p) { packets.push_back(p); });
  }
  Parser parser_;
  std::uint8_t sequence_ = 0;
};

/// Straight through: throttle, aileron, elevator, rudder.
inline OffboardControl passed(float throttle, float aileron, float elevator, float rudder) {
  OffboardControl m;
  m.u = {throttle, 0, 0, aileron, elevator, rudder};
  return m;
}

/// A fixed wing, calibrated, armed by its switch, the override switch off again.
inline void arm(Companion& c) {
  c.fcu.provision(c.now_us);
  c.send(Heartbeat{});
  c.wait(1.2);
  c.fcu.inputs.rc_us[4] = c.fcu.inputs.rc_us[5] = 2000;
  c.wait(0.1);
  c.fcu.inputs.rc_us[5] = 1000;
  c.wait(0.1);
}

}  // namespace fulmar::fcu::peer

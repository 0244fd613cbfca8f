// SPDX-License-Identifier: BSD-3-Clause
// A link to a software flight controller in virtual time: the functions of Link without a device, a thread or
// a clock.
#pragma once
#include <deque>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "plugins/fcu_serial/link/link.hpp"
#include "plugins/fcu_serial/test/peer/firmware.hpp"

namespace fulmar::fcu::testing {

/// The controller, the wire, and the time. One at a time.
struct World {
  explicit World(const peer::Options& options = {}) : fcu(options) { present = this; }
  ~World() { present = nullptr; }
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  static inline World* present = nullptr;

  peer::Firmware fcu;
  std::int64_t now_ns = 0;
  bool plugged = true;         ///< false: the device is gone
  bool cut = false;            ///< the device is open, but no data passes
  bool passes = true;          ///< false: the device takes no frame
  std::int64_t stands_ns = 0;  ///< the whole computer stops for so long in its next wait
  std::uint64_t bytes = 0, text_bytes = 0, frames = 0;
  std::function<bool(const Packet&)> lost = [](const Packet&) { return false; };
  std::vector<Packet> sent;  ///< by the host
  std::vector<std::int64_t> sent_ns;
  std::deque<Received> queue;
  std::vector<std::string> watched;

  /// Until a time, or an inertial sample when one is waited for.
  bool run(std::int64_t until_ns, bool for_imu) {
    if (for_imu && stands_ns > 0) {
      now_ns += std::exchange(stands_ns, 0);
      fcu.run(now_ns / 1000);
      fcu.take();  // data that arrived meanwhile had no room
      return false;
    }
    while (true) {
      if (for_imu && has_imu()) return true;
      if (now_ns >= until_ns) return false;
      now_ns = std::min(until_ns, now_ns + 100'000);
      fcu.run(now_ns / 1000);
      collect();
    }
  }
  void receive(const Frame& frame) {
    parser_out_.feed(frame.view(), [this](const Packet& p) {
      sent.push_back(p);
      sent_ns.push_back(now_ns);
    });
    if (!cut && plugged) fcu.receive(frame.view(), now_ns / 1000);
    collect();
  }
  template <class M>
  void inject(const M& message, std::int64_t age_ns = 0) {
    Received r;
    r.arrived_ns = now_ns;
    r.valid_at_ns = now_ns - age_ns;
    parser_in_.restart();
    parser_in_.feed(encode(message, 0).view(), [&](const Packet& p) { r.packet = p; });
    queue.push_back(r);
  }
  void happen(LinkEvent event) {
    Received r;
    r.event = event;
    r.arrived_ns = r.valid_at_ns = now_ns;
    queue.push_back(r);
  }
  template <class M>
  std::size_t count() const {
    std::size_t n = 0;
    for (const Packet& p : sent) n += p.is<M>() ? 1 : 0;
    return n;
  }
  template <class M>
  M last() const {
    for (auto p = sent.rbegin(); p != sent.rend(); ++p)
      if (p->is<M>()) return p->template as<M>();
    throw std::runtime_error("nothing of this kind was sent");
  }

 private:
  bool has_imu() const {
    for (const Received& r : queue)
      if (r.event == LinkEvent::packet && r.packet.is<SmallImu>()) return true;
    return false;
  }
  void collect() {
    const auto out = fcu.take();
    if (cut || !plugged) return;
    bytes += out.size();
    parser_in_.feed(out, [this](const Packet& p) {
      ++frames;
      if (lost(p)) return;
      Received r;
      r.packet = p;
      r.arrived_ns = now_ns;
      r.valid_at_ns = now_ns;
      if (p.is<SmallImu>()) r.valid_at_ns = now_ns - 300'000;
      queue.push_back(r);
    });
  }
  Parser parser_in_, parser_out_;
};

struct VirtualLink {
  explicit VirtualLink(const LinkOptions& options) {
    world().watched = options.watched;
    send(Heartbeat{});
    for (const std::string& name : options.watched) {
      ParamRequestRead ask;
      std::copy_n(name.begin(), std::min<std::size_t>(name.size(), 16), ask.param_id.begin());
      send(ask);
    }
  }
  bool wait_imu(std::int64_t until_ns) noexcept { return world().run(until_ns, true); }
  bool pop(Received& out) noexcept {
    if (world().queue.empty()) return false;
    out = world().queue.front();
    world().queue.pop_front();
    return true;
  }
  template <class M>
  bool send(const M& message) {
    if (!world().plugged || !world().passes) return false;
    world().receive(encode(message, sequence_++));
    return true;
  }
  std::int64_t now_ns() const noexcept { return world().now_ns; }
  LinkState state() const noexcept {
    LinkState s;
    s.open = world().plugged;
    s.frames = world().frames;
    s.bytes = world().bytes;
    s.text_bytes = world().text_bytes;
    return s;
  }
  int descriptor() const noexcept { return world().plugged ? 7 : -1; }

 private:
  static World& world() { return *World::present; }
  std::uint8_t sequence_ = 0;
};

}  // namespace fulmar::fcu::testing

// SPDX-License-Identifier: BSD-3-Clause
// A flight controller in virtual time behind a port that rejects, delays, drops, duplicates and corrupts
// frames.
#pragma once
#include <deque>
#include <memory>

#include "fulmar/random.hpp"
#include "plugins/fcu_serial/test/peer/firmware.hpp"
#include "tools/fulmar_fcu/client.hpp"

namespace fulmar::fcu::test {

/// Of a link, both ways.
struct Faults {
  double drop = 0, duplicate = 0, corrupt = 0;  ///< of the frames
  std::int64_t delay_us = 0;
  bool refuse = false;  ///< commands are answered by "no", settings are ignored
  bool mute = false;    ///< questions, settings and commands get lost, the stream goes on
};

class Bench {
 public:
  explicit Bench(const peer::Options& options = {}) : firmware(options) {}

  peer::Firmware firmware;
  Faults faults;
  std::int64_t now_us = 0;
  int opened = 0;
  std::uint64_t seed = 1;
  std::function<void(Frame&)> on_command;  ///< sees what the client sends

  Endpoint endpoint();
  Client client() { return Client(endpoint()); }
  /// Advances the time without a client.
  void idle(std::int64_t us) {
    for (const std::int64_t until = now_us + us; now_us < until; now_us += 500) firmware.run(now_us);
    firmware.take();
  }

 private:
  friend class LossyPort;
  struct Late {
    std::int64_t due_us;
    Frame frame;
  };
  Random random_{1};
  std::deque<Late> in_, out_;
  void carry(const Frame& frame, std::deque<Late>& way);
  void send(Frame frame);
  void advance();
};

class LossyPort final : public Port {
 public:
  explicit LossyPort(Bench& bench) : bench_(bench) {}
  std::size_t read(std::span<std::uint8_t> room, int timeout_ms) override;
  bool write(std::span<const std::uint8_t> bytes) noexcept override;
  int descriptor() const noexcept override { return -1; }

 private:
  Bench& bench_;
};

inline Endpoint Bench::endpoint() {
  random_ = Random(seed);
  return {"/dev/ttyACM0",
          [this]() -> std::unique_ptr<Port> {
            ++opened;
            return std::make_unique<LossyPort>(*this);
          },
          [this] { return now_us * 1000; }};
}

inline void Bench::carry(const Frame& frame, std::deque<Late>& way) {
  if (random_.uniform() < faults.drop) return;
  Late late{now_us + faults.delay_us, frame};
  if (random_.uniform() < faults.corrupt) {
    const auto at = static_cast<std::size_t>(random_.uniform() * static_cast<double>(frame.size));
    late.frame.bytes[std::min(at, frame.size - 1)] ^=
        static_cast<std::uint8_t>(1 + static_cast<int>(random_.uniform() * 254));
  }
  way.push_back(late);
  if (random_.uniform() < faults.duplicate) way.push_back(late);
}

inline void Bench::send(Frame frame) {
  if (on_command) on_command(frame);
  const std::uint8_t id = frame.bytes[5];
  const bool command = id == RosflightCmd::id, question = command || id == ParamSet::id ||
                                                          id == ParamRequestRead::id ||
                                                          id == ParamRequestList::id;
  if (faults.mute && question) return;
  const std::uint8_t code = frame.bytes[6];
  if (faults.refuse && command && code != static_cast<std::uint8_t>(Command::send_version))
    return carry(encode(RosflightCmdAck{code, 0}, 0), in_);
  if (faults.refuse && id == ParamSet::id) return;
  carry(frame, out_);
}

inline void Bench::advance() {
  now_us += 500;
  firmware.run(now_us);
  while (!out_.empty() && out_.front().due_us <= now_us) {
    firmware.receive(out_.front().frame.view(), now_us);
    out_.pop_front();
  }
  Frame frame;
  while (firmware.take(frame)) carry(frame, in_);
}

inline std::size_t LossyPort::read(std::span<std::uint8_t> room, int timeout_ms) {
  std::size_t n = 0;
  for (const std::int64_t until = bench_.now_us + timeout_ms * 1000; n == 0 && bench_.now_us < until;) {
    bench_.advance();
    while (!bench_.in_.empty() && bench_.in_.front().due_us <= bench_.now_us &&
           n + max_frame <= room.size()) {
      const Frame& frame = bench_.in_.front().frame;
      std::copy(frame.view().begin(), frame.view().end(), room.begin() + static_cast<std::ptrdiff_t>(n));
      n += frame.size;
      bench_.in_.pop_front();
    }
  }
  return n;
}

inline bool LossyPort::write(std::span<const std::uint8_t> bytes) noexcept {
  Frame frame;
  frame.size = bytes.size();
  std::copy(bytes.begin(), bytes.end(), frame.bytes.begin());
  bench_.send(frame);
  return true;
}

}  // namespace fulmar::fcu::test

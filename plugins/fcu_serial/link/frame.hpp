// SPDX-License-Identifier: BSD-3-Clause
// MAVLink 1 frames: FE length sequence system component id payload checksum. MAVLink, "Packet Serialization".
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <span>

#include "messages.hpp"

namespace fulmar::fcu {

inline constexpr std::uint8_t frame_magic = 0xfe, modern_magic = 0xfd;  ///< MAVLink 1; MAVLink 2
inline constexpr std::size_t frame_header = 6, frame_overhead = 8, max_frame = max_payload + frame_overhead;
inline constexpr std::uint8_t companion_system = 1, companion_component = 50;

/// One frame as bytes.
struct Frame {
  std::array<std::uint8_t, max_frame> bytes{};
  std::size_t size = 0;
  std::span<const std::uint8_t> view() const { return {bytes.data(), size}; }
};

/// A complete payload. The sender's ids are not reliable: the firmware sends varying ones.
struct Packet {
  std::uint8_t id = 0, system = 0, component = 0, sequence = 0, length = 0;
  std::array<std::uint8_t, max_payload> payload{};

  template <class M>
  bool is() const {
    return id == M::id;
  }
  /// The message; the packet must have its id.
  template <class M>
  M as() const {
    M message{};
    std::memcpy(static_cast<void*>(&message), payload.data(), length_of<M>());
    return message;
  }

 private:
  template <class M>
  static constexpr std::size_t length_of() {
    return fcu::length<M>;
  }
};

inline std::uint16_t frame_crc(std::span<const std::uint8_t> from_length_to_payload, std::uint8_t crc_extra) {
  std::uint16_t crc = 0xffff;
  for (const std::uint8_t b : from_length_to_payload) crc = crc_byte(crc, b);
  return crc_byte(crc, crc_extra);
}

template <class M>
Frame encode(const M& message, std::uint8_t sequence, std::uint8_t system = companion_system,
             std::uint8_t component = companion_component) {
  Frame f;
  f.size = length<M> + frame_overhead;
  const std::array<std::uint8_t, frame_header> header{
      frame_magic, static_cast<std::uint8_t>(length<M>), sequence, system, component, M::id};
  std::copy(header.begin(), header.end(), f.bytes.begin());
  std::memcpy(f.bytes.data() + frame_header, &message, length<M>);
  const std::uint16_t crc = frame_crc({f.bytes.data() + 1, frame_header - 1 + length<M>}, crc_extra<M>);
  f.bytes[f.size - 2] = static_cast<std::uint8_t>(crc & 0xff);
  f.bytes[f.size - 1] = static_cast<std::uint8_t>(crc >> 8);
  return f;
}

/// True when a device without a valid frame probably sends MAVLink 2: one byte in 256 of noise looks like a
/// start.
inline bool talks_mavlink_2(std::uint64_t modern, std::uint64_t bytes) {
  return modern > 4 && modern * 100 > bytes;
}

/// Finds frames in a stream of bytes. After invalid bytes it continues with the next byte, so that a false
/// start costs no later frame.
class Parser {
 public:
  struct Counts {
    std::uint64_t frames = 0;   ///< complete, with a valid checksum
    std::uint64_t bad = 0;      ///< start of a known frame with a wrong checksum
    std::uint64_t unknown = 0;  ///< complete frames of an unknown message, as far as the framing shows
    std::uint64_t skipped = 0;  ///< bytes outside of frames
    std::uint64_t modern = 0;   ///< of them: starts of frames of MAVLink 2
    std::uint64_t missing = 0;  ///< lost frames, by the sequence numbers
  };

  /// Calls `take(const Packet&)` for each frame that these bytes complete.
  template <class Take>
  void feed(std::span<const std::uint8_t> bytes, Take&& take) {
    while (!bytes.empty()) {
      const std::size_t n = std::min(bytes.size(), buffer_.size() - size_);
      std::memcpy(buffer_.data() + size_, bytes.data(), n);
      size_ += n;
      bytes = bytes.subspan(n);
      drain(take);
    }
  }
  const Counts& counts() const { return counts_; }
  /// Drops a partial frame and the sequence number, for a new connection.
  void restart() {
    size_ = 0;
    has_sequence_ = false;
  }

 private:
  template <class Take>
  void drain(Take& take) {
    std::size_t at = 0;
    while (at < size_) {
      const std::size_t used = frame_at(at, take);
      if (used == 0) break;
      at += used;
    }
    size_ -= at;
    std::memmove(buffer_.data(), buffer_.data() + at, size_);
  }

  /// Number of bytes to advance; 0: more are needed.
  template <class Take>
  std::size_t frame_at(std::size_t at, Take& take) {
    const std::uint8_t* p = buffer_.data() + at;
    const std::size_t have = size_ - at;
    if (p[0] == modern_magic) ++counts_.modern;
    if (p[0] != frame_magic) return skip();
    if (have < 2) return 0;
    const std::size_t n = p[1];
    if (n > max_payload) return skip();
    if (have < frame_header) return 0;
    const WireInfo info = wire[p[5]];
    if (info.known && info.length != n) return skip();
    if (have < n + frame_overhead) return 0;
    if (!info.known) {
      // Without its seed the checksum cannot be verified. The bytes that follow show whether it was a frame:
      // continue with the next byte.
      ++counts_.unknown;
      return skip();
    }
    const std::uint16_t crc = frame_crc({p + 1, frame_header - 1 + n}, info.crc_extra);
    if (p[frame_header + n] != (crc & 0xff) || p[frame_header + n + 1] != (crc >> 8)) {
      ++counts_.bad;
      return skip();
    }
    accept(p, n, take);
    return n + frame_overhead;
  }

  template <class Take>
  void accept(const std::uint8_t* p, std::size_t n, Take& take) {
    Packet packet;
    packet.length = static_cast<std::uint8_t>(n);
    packet.sequence = p[2];
    packet.system = p[3];
    packet.component = p[4];
    packet.id = p[5];
    std::memcpy(packet.payload.data(), p + frame_header, n);
    ++counts_.frames;
    count_missing(packet.sequence);
    take(static_cast<const Packet&>(packet));
  }

  /// A frame that arrives twice or after its successor, as over UDP, does not count as 255 lost ones.
  void count_missing(std::uint8_t sequence) {
    const auto between = static_cast<std::uint8_t>(sequence - sequence_ - 1);
    if (has_sequence_ && between >= 256 - max_late) return;
    if (has_sequence_) counts_.missing += between;
    has_sequence_ = true;
    sequence_ = sequence;
  }

  std::size_t skip() {
    ++counts_.skipped;
    return 1;
  }

  static constexpr int max_late = 8;
  std::array<std::uint8_t, 512> buffer_{};
  std::size_t size_ = 0;
  std::uint8_t sequence_ = 0;
  bool has_sequence_ = false;
  Counts counts_;
};

}  // namespace fulmar::fcu

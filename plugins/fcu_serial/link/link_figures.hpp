// SPDX-License-Identifier: BSD-3-Clause
// Counters of the link's thread for the thread of the loop.
#pragma once
#include <algorithm>
#include <atomic>
#include <cstdint>
#include <span>
#include <type_traits>

#include "frame.hpp"
#include "link_state.hpp"
#include "timesync.hpp"

namespace fulmar::fcu {

/// Each figure is consistent; the set may be of several moments.
class LinkFigures {
 public:
  // ---- thread of the link
  void connected() { add(connections_, 1); }
  void rebooted(bool synchronised) {
    add(reboots_, 1);
    put(synchronised_, synchronised);
  }
  void came(std::span<const std::uint8_t> bytes) {
    const auto is_text = [](std::uint8_t c) {
      return (c >= ' ' && c <= '~') || c == '\r' || c == '\n' || c == '\t';
    };
    add(bytes_, bytes.size());
    add(text_bytes_, static_cast<std::uint64_t>(std::count_if(bytes.begin(), bytes.end(), is_text)));
  }
  void counted(const Parser::Counts& counts, std::uint64_t undated) {
    put(frames_, counts.frames);
    put(bad_, counts.bad);
    put(missing_, counts.missing);
    put(modern_, counts.modern);
    put(undated_, undated);
  }
  void heard(std::int64_t host_ns) { put(heard_ns_, host_ns); }
  void lost() { add(lost_in_queue_, 1); }
  void timed(const ClockSync& clock, std::int64_t host_ns) {
    put(round_trip_ns_, clock.round_trip_ns());
    put(offset_ns_, clock.offset_ns(host_ns));
    put(drift_ppm_, clock.drift_ppm());
    put(synchronised_, true);
  }

  // ---- either thread
  LinkState read() const noexcept {
    LinkState s;
    s.heard_ns = get(heard_ns_);
    s.frames = get(frames_);
    s.bad = get(bad_);
    s.missing = get(missing_);
    s.lost_in_queue = get(lost_in_queue_);
    s.bytes = get(bytes_);
    s.text_bytes = get(text_bytes_);
    s.modern = get(modern_);
    s.undated = get(undated_);
    s.connections = get(connections_);
    s.reboots = get(reboots_);
    s.synchronised = get(synchronised_);
    s.round_trip_ns = get(round_trip_ns_);
    s.offset_ns = get(offset_ns_);
    s.drift_ppm = get(drift_ppm_);
    return s;
  }

 private:
  template <class T>
  static void add(std::atomic<T>& figure, std::type_identity_t<T> more) {
    figure.fetch_add(more, std::memory_order_relaxed);
  }
  template <class T>
  static void put(std::atomic<T>& figure, std::type_identity_t<T> value) {
    figure.store(value, std::memory_order_relaxed);
  }
  template <class T>
  static T get(const std::atomic<T>& figure) noexcept {
    return figure.load(std::memory_order_relaxed);
  }

  std::atomic<bool> synchronised_{false};
  std::atomic<std::int64_t> heard_ns_{0}, round_trip_ns_{0}, offset_ns_{0};
  std::atomic<std::uint64_t> frames_{0}, bad_{0}, missing_{0}, lost_in_queue_{0}, bytes_{0}, text_bytes_{0},
      modern_{0}, undated_{0};
  std::atomic<std::uint32_t> connections_{0}, reboots_{0};
  std::atomic<double> drift_ppm_{0};
};

}  // namespace fulmar::fcu

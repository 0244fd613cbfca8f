// SPDX-License-Identifier: BSD-3-Clause
// Sampling times of a sensor, and arrival of its samples.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "figures.hpp"
#include "fulmar/random.hpp"
#include "messages.hpp"
#include "sensor_suite.hpp"

namespace fulmar::sim {

/// True once per period. Integer nanoseconds prevent an accumulated rounding error.
class Due {
 public:
  Due() = default;
  Due(double rate_hz, std::int64_t first_ns) : period_ns_(std::llround(1e9 / rate_hz)), next_ns_(first_ns) {}
  bool operator()(std::int64_t now_ns) {
    if (now_ns < next_ns_) return false;
    do next_ns_ += period_ns_;
    while (next_ns_ <= now_ns);
    return true;
  }

 private:
  std::int64_t period_ns_ = 1, next_ns_ = 0;
};

/// Samples that wait for their delivery.
template <class T>
class Delay {
 public:
  static constexpr std::size_t capacity = 64;
  void push(const T& value, std::int64_t valid_at_ns) {
    items_[(first_ + count_) % items_.size()] = {value, valid_at_ns};
    if (count_ < items_.size())
      ++count_;
    else
      first_ = (first_ + 1) % items_.size();
  }
  struct Item {
    T value;
    std::int64_t valid_at_ns = 0;
  };
  /// The oldest sample, once `delay_ns` have passed since its time stamp; else nullptr.
  const Item* pop(std::int64_t now_ns, std::int64_t delay_ns) {
    if (count_ == 0 || now_ns < items_[first_].valid_at_ns + delay_ns) return nullptr;
    const Item* item = &items_[first_];
    first_ = (first_ + 1) % items_.size();
    --count_;
    return item;
  }

 private:
  std::array<Item, capacity> items_{};
  std::size_t first_ = 0, count_ = 0;
};

/// Timing of one sensor's samples: period, jitter, loss and latency.
template <class T>
class SensorLine {
 public:
  SensorLine() : random_(0) {}
  /// `name` is for the message that rejects a timing.
  SensorLine(const Timing& t, double tick_hz, std::int64_t first_ns, const char* name, std::uint64_t seed)
      : due_(t.rate_hz, first_ns),
        delay_ns_(std::llround(t.latency_s * 1e9)),
        jitter_ns_(t.jitter_s * 1e9),
        shift_to_ns_(first_ns),
        period_s_(1 / std::min(t.rate_hz, tick_hz)),
        random_(seed) {
    if (t.jitter_s > 0.45 / t.rate_hz)
      throw std::runtime_error(
          located("sensor_file",
                  sim_aero_messages::jitter_too_large(name, figures(t.jitter_s), at_most(0.45 / t.rate_hz)))
              .line());
    if (t.latency_s > (Delay<T>::capacity - 1) * period_s_)
      throw std::runtime_error(located("sensor_file", sim_aero_messages::latency_too_large(
                                                          name, figures(t.latency_s),
                                                          at_most((Delay<T>::capacity - 1) * period_s_)))
                                   .line());
    if (t.dropouts_frac > 0) lose(t);
  }

  /// True when a sample is due.
  bool due(std::int64_t now_ns) {
    if (jitter_ns_ <= 0) return due_(now_ns);
    // Each nominal time is early by the jitter, and the sample waits from 0 to twice of it. That is less than
    // a period, but may last until the next sample begins to wait.
    bool taken = false;
    if (waiting_ && now_ns >= shift_to_ns_) {
      taken = true;
      waiting_ = false;
    }
    if (!waiting_ && due_(now_ns)) {
      shift_to_ns_ = now_ns + std::llround(jitter_ns_ * random_.uniform(0, 2));
      waiting_ = taken || shift_to_ns_ > now_ns;
      taken = taken || !waiting_;
    }
    return taken;
  }

  /// Loses, delays or delivers the present sample, and publishes what is due. `sampled`: the sensor has
  /// produced a sample.
  template <class Port>
  void take(const T& sample, std::int64_t now_ns, bool sampled, Port& port) {
    if (!sampled || lost()) return;
    if (delay_ns_ == 0) return port.publish(sample, now_ns);
    under_way_.push(sample, now_ns);
  }
  template <class Port>
  void deliver(std::int64_t now_ns, bool sampled, Port& port) {
    if (delay_ns_ == 0) return;
    if (const auto* late = under_way_.pop(now_ns, delay_ns_); late && sampled)
      port.publish(late->value, late->valid_at_ns);
  }
  bool delayed() const { return delay_ns_ > 0; }

 private:
  /// Gilbert's channel: `dropouts` is the probability of a gap, `length` the mean length of one.
  void lose(const Timing& t) {
    const double samples = std::max(1.0, t.dropout_length_s / period_s_);
    const bool bursts = t.dropout_length_s > period_s_;
    end_ = bursts ? 1 / samples : 1 - t.dropouts_frac;
    begin_ = bursts ? std::min(1.0, end_ * t.dropouts_frac / (1 - t.dropouts_frac)) : t.dropouts_frac;
  }
  bool lost() {
    if (begin_ <= 0) return false;
    const double u = random_.uniform();
    in_gap_ = in_gap_ ? u >= end_ : u < begin_;
    return in_gap_;
  }

  Due due_;
  Delay<T> under_way_;
  std::int64_t delay_ns_ = 0;
  double jitter_ns_ = 0;
  std::int64_t shift_to_ns_ = 0;
  double period_s_ = 1;
  Random random_;
  double begin_ = 0, end_ = 1;  ///< limits of a gap, at each sample
  bool in_gap_ = false, waiting_ = false;
};

}  // namespace fulmar::sim

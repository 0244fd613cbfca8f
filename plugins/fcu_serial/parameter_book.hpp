// SPDX-License-Identifier: BSD-3-Clause
// The controller's parameters for the log. They are requested one by one, so that the line stays free for
// samples, and published when they change. No function allocates.
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <bitset>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>

#include "pitot_zero.hpp"
#include "radio.hpp"
#include "reports.hpp"
#include "state.hpp"

namespace fulmar::fcu {

class ParameterBook {
 public:
  /// Number of parameters, as each answer reports it.
  void expect(std::size_t count) { count_ = std::min(count, most); }
  /// The controller, perhaps another one, may have other values.
  void restart() {
    heard_.reset();
    at_ = 0;
    rounds_ = 0;
    changes_ = 0;
    reported_ = false;
  }
  /// The answer did not reach the reader: it is requested again.
  void forget(std::size_t index) { heard_.reset(std::min(index, most - 1)); }

  /// The parameter to publish for an answer; none when it is known.
  std::optional<ControllerParameter> take(const ParamValue& p) {
    const std::size_t i = p.param_index;
    if (i >= p.param_count || i >= most) return {};
    expect(p.param_count);
    const bool news = !known_[i] || bits_[i] != p.param_value;
    if (known_[i] && news) ++changes_;
    heard_[i] = known_[i] = true;
    bits_[i] = p.param_value;
    if (!news) return {};
    const bool whole = p.param_type == param_int32;
    if (!whole) note_calibration(id_of(p.param_id), static_cast<double>(std::bit_cast<float>(p.param_value)));
    return ControllerParameter{Text<17>(id_of(p.param_id)), text_of(p.param_value, whole), whole,
                               p.param_index, p.param_count};
  }

  /// The parameter to request now.
  std::optional<std::int16_t> next(std::int64_t now_ns) {
    if (now_ns < next_ns_ || rounds_ >= max_rounds || heard_.count() >= count_) return {};
    while (at_ < count_ && heard_[at_]) ++at_;
    if (at_ >= count_) {
      at_ = 0;
      ++rounds_;
      next_ns_ = now_ns + pause_ns;
      return {};
    }
    next_ns_ = now_ns + period_ns;
    return static_cast<std::int16_t>(at_++);
  }

  /// Reports once, when all are known or the requests have ended.
  void report(Notices& out) {
    const bool complete = heard_.count() >= count_;
    if (reported_ || count_ == 0 || (!complete && rounds_ < max_rounds)) return;
    reported_ = true;
    const auto all = static_cast<std::int64_t>(count_),
               lacking = all - static_cast<std::int64_t>(heard_.count());
    if (!complete) out.add(fulmar::Severity::warning, fcu_serial_messages::params_missing, lacking, all);
    if (begun_ && changes_ > 0)
      out.add(fulmar::Severity::warning, fcu_serial_messages::params_changed, changes_);
    if (begun_) return;
    begun_ = true;
    if (complete) out.add(fulmar::Severity::info, fcu_serial_messages::params_logged, all);
    out.add(fulmar::Severity::info, fcu_serial_messages::calibration, figures(0, 3, 3).view(),
            figures(3, 6, 4).view(), figures(6, 7, 1).view());
  }

 private:
  static constexpr std::size_t most = 512;
  static constexpr int max_rounds = 5;
  static constexpr std::int64_t period_ns = 10'000'000, pause_ns = 500'000'000;
  static constexpr std::array<std::string_view, 7> biases{
      "ACC_X_BIAS", "ACC_Y_BIAS", "ACC_Z_BIAS", "GYRO_X_BIAS", "GYRO_Y_BIAS", "GYRO_Z_BIAS", pitot_zero};

  static Text<24> text_of(std::uint32_t bits, bool whole) {
    std::array<char, 24> room{};
    char* const end = room.data() + room.size();
    const auto done = whole ? std::to_chars(room.data(), end, std::bit_cast<std::int32_t>(bits))
                            : std::to_chars(room.data(), end, std::bit_cast<float>(bits));
    return Text<24>(std::string_view(room.data(), static_cast<std::size_t>(done.ptr - room.data())));
  }
  void note_calibration(std::string_view name, double value) {
    for (std::size_t i = 0; i < biases.size(); ++i)
      if (name == biases[i]) bias_[i] = value;
  }
  Line figures(std::size_t first, std::size_t end, int digits) const {
    Line line;
    for (std::size_t i = first; i < end; ++i) (line << (i > first ? " " : "")).fixed(bias_[i], digits);
    return line;
  }

  std::bitset<most> heard_, known_;  ///< since the last restart; since the start
  std::array<std::uint32_t, most> bits_{};
  std::array<double, biases.size()> bias_{};
  std::size_t count_ = 0, at_ = 0;
  std::int64_t next_ns_ = never_ns, changes_ = 0;
  int rounds_ = 0;
  bool reported_ = false, begun_ = false;
};

}  // namespace fulmar::fcu

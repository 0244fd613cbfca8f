// SPDX-License-Identifier: BSD-3-Clause
// Messages of the controller's bits, and a queue of notices for the loop. No function allocates.
#pragma once
#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <string_view>

#include "fulmar/msg/notice.hpp"
#include "fulmar/plugin.hpp"
#include "link/messages.hpp"
#include "messages.hpp"

namespace fulmar::fcu {

/// A line of text, cut when it is full.
class Line {
 public:
  template <std::size_t N, class... Values>
  static Line of(const MessageText<N>& message, const Values&... values) {
    std::array<char, 200> room{};
    const std::size_t size = message.write(room.data(), room.size(), values...);
    return Line() << std::string_view(room.data(), std::min(size, room.size() - 1));
  }
  /// A text that does not fit is cut, and ends in dots.
  Line& operator<<(std::string_view text) {
    for (const char c : text) {
      if (size_ + 1 >= text_.bytes.size()) {
        std::fill_n(text_.bytes.begin() + static_cast<std::ptrdiff_t>(size_) - 3, 3, '.');
        break;
      }
      text_.bytes[size_++] = c >= ' ' && c < 0x7f ? c : '?';
    }
    return *this;
  }
  /// `digits`: number of digits after the point.
  Line& fixed(double value, int digits) {
    std::array<char, 24> room{};  // a value that does not fit is cut
    const auto end =
        std::to_chars(room.data(), room.data() + room.size(), value, std::chars_format::fixed, digits);
    return end.ec == std::errc()
               ? *this << std::string_view(room.data(), static_cast<std::size_t>(end.ptr - room.data()))
               : *this << "?";
  }
  std::string_view view() const { return text_.view(); }
  const Text<96>& text() const { return text_; }

 private:
  Text<96> text_;
  std::size_t size_ = 0;
};

/// Seconds, rounded down to tenths.
inline Fixed tenths_s(std::int64_t ns) { return {static_cast<double>(ns / 100'000'000) / 10, 1}; }

/// Messages of bits.
template <std::size_t N>
using BitMessages = std::array<std::pair<std::uint32_t, MessageText<0>>, N>;

/// Messages of the bits that are set, with commas between them.
template <std::size_t N>
void list_bits(Line& line, std::uint32_t bits, const BitMessages<N>& messages) {
  for (const auto& [bit, message] : messages) {
    if ((bits & bit) == 0) continue;
    if (!line.view().empty()) line << ", ";
    line << message.c_str();
  }
}

inline constexpr BitMessages<6> override_messages{
    {{override_attitude_switch, fcu_serial_messages::attitude_switch},
     {override_throttle_switch, fcu_serial_messages::throttle_switch},
     {override_stick_x, fcu_serial_messages::roll_stick},
     {override_stick_y, fcu_serial_messages::pitch_stick},
     {override_stick_z, fcu_serial_messages::yaw_stick},
     {override_min_throttle, fcu_serial_messages::lower_throttle}}};

/// Messages of the error bits, with the remedy.
inline constexpr BitMessages<8> error_messages{
    {{error_invalid_mixer, fcu_serial_messages::mixer_invalid},
     {error_imu_not_responding, fcu_serial_messages::imu_unresponsive},
     {error_rc_lost, fcu_serial_messages::radio_lost},
     {error_unhealthy_estimator, fcu_serial_messages::estimator_unhealthy},
     {error_time_backwards, fcu_serial_messages::time_backwards},
     {error_uncalibrated_imu, fcu_serial_messages::imu_uncalibrated},
     {error_buffer_overrun, fcu_serial_messages::buffer_overrun},
     {error_invalid_failsafe, fcu_serial_messages::failsafe_invalid}}};

/// Notices that wait for the loop. Above the capacity the last ones are lost; important ones are rare.
class Notices {
 public:
  template <std::size_t N, class... Values>
  void add(fulmar::Severity severity, const MessageText<N>& message, const Values&... values) {
    if (count_ < notices_.size()) notices_[count_++] = {Line::of(message, values...).text(), severity};
  }
  template <std::size_t N>
  void flush(OutQueue<Notice, N>& out, std::int64_t now_ns) {
    for (std::size_t i = 0; i < count_; ++i) out.push(notices_[i], now_ns);
    count_ = 0;
  }
  std::size_t size() const { return count_; }
  const Notice& operator[](std::size_t i) const { return notices_[i]; }
  void clear() { count_ = 0; }

 private:
  std::array<Notice, 32> notices_{};
  std::size_t count_ = 0;
};

/// Passes on the texts of the controller. A repeated one, such as the reason for not arming, is reported
/// every ten seconds.
class Forwarder {
 public:
  void forward(const Statustext& m, std::int64_t now_ns, Notices& notices) {
    // The text ends at its first NUL; the bytes behind it are undefined.
    const auto end = std::find(m.text.begin(), m.text.end(), '\0');
    const Text<51> text(std::string_view(m.text.data(), static_cast<std::size_t>(end - m.text.begin())));
    if (text == last_ && now_ns - reported_ns_ < 10'000'000'000) return;
    last_ = text;
    reported_ns_ = now_ns;
    const fulmar::Severity severity = m.severity <= 2   ? fulmar::Severity::critical
                                      : m.severity == 3 ? fulmar::Severity::error
                                      : m.severity == 4 ? fulmar::Severity::warning
                                                        : fulmar::Severity::info;
    if (text.view() == no_secondary)  // SECONDARY_MIXER 255 is the recommended value, not an error
      return notices.add(fulmar::Severity::info, fcu_serial_messages::secondary_mixer_unset);
    notices.add(severity, fcu_serial_messages::controller_text, text.view());
  }

 private:
  static constexpr std::string_view no_secondary = "Invalid mixer selected for secondary mixer!";
  Text<51> last_;
  std::int64_t reported_ns_ = 0;
};

}  // namespace fulmar::fcu

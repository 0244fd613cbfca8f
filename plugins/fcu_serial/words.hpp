// SPDX-License-Identifier: BSD-3-Clause
// What the controller says in bits, in words; and notices that wait until the loop takes them. Nothing here
// allocates.
#pragma once
#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <string_view>

#include "fulmar/msg/notice.hpp"
#include "fulmar/plugin.hpp"
#include "link/messages.hpp"

namespace fulmar::fcu {

/// A line that grows at its end, cut when it is full.
class Line {
 public:
  /// What does not fit is left out, and dots tell so.
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
  Line& operator<<(std::int64_t number) {
    std::array<char, 20> digits{};
    std::size_t n = 0;
    std::uint64_t rest =
        number < 0 ? 0 - static_cast<std::uint64_t>(number) : static_cast<std::uint64_t>(number);
    do digits[n++] = static_cast<char>('0' + rest % 10);
    while ((rest /= 10) != 0);
    if (number < 0) *this << "-";
    while (n > 0) *this << std::string_view(&digits[--n], 1);
    return *this;
  }
  /// Tenths of a second.
  Line& seconds(std::int64_t ns) { return *this << ns / 1000000000 << "." << ns / 100000000 % 10 << " s"; }
  /// So many digits behind the point.
  Line& fixed(double value, int digits) {
    std::array<char, 24> room{};  // cut: a value that long is no figure
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

/// Words of the bits that are set, with commas between them.
template <std::size_t N>
void list_bits(Line& line, std::uint32_t bits,
               const std::array<std::pair<std::uint32_t, std::string_view>, N>& words) {
  bool first = true;
  for (const auto& [bit, word] : words) {
    if ((bits & bit) == 0) continue;
    if (!first) line << ", ";
    line << word;
    first = false;
  }
}

inline constexpr std::array<std::pair<std::uint32_t, std::string_view>, 6> override_words{
    {{override_attitude_switch, "attitude switch"},
     {override_throttle_switch, "throttle switch"},
     {override_stick_x, "roll stick"},
     {override_stick_y, "pitch stick"},
     {override_stick_z, "yaw stick"},
     {override_min_throttle, "lower throttle"}}};

/// What the error bits mean, and what to do.
inline constexpr std::array<std::pair<std::uint32_t, std::string_view>, 8> error_words{
    {{error_invalid_mixer, "invalid mixer: set PRIMARY_MIXER"},
     {error_imu_not_responding, "its inertial unit does not answer"},
     {error_rc_lost, "no radio: switch the transmitter on"},
     {error_unhealthy_estimator, "its attitude estimate is unhealthy"},
     {error_time_backwards, "its time went backwards: power-cycle it"},
     {error_uncalibrated_imu, "uncalibrated: fulmar fcu calibrate imu"},
     {error_buffer_overrun, "a buffer ran over"},
     {error_invalid_failsafe, "FAILSAFE_THR is not within 0 to 1"}}};

/// Notices that wait for the loop. When there are more, the last ones are lost; what counts comes rarely.
class Notices {
 public:
  void say(fulmar::Severity severity, std::string_view text) { say(severity, Line() << text); }
  void say(fulmar::Severity severity, const Line& line) {
    if (count_ < notices_.size()) notices_[count_++] = {line.text(), severity};
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

/// Passes on the controller's own texts. What it repeats, such as why it does not arm, is told every ten
/// seconds.
class Forwarder {
 public:
  void forward(const Statustext& m, std::int64_t now_ns, Notices& notices) {
    // It ends at its first NUL; what stands behind is anything.
    const auto end = std::find(m.text.begin(), m.text.end(), '\0');
    const Text<51> text(std::string_view(m.text.data(), static_cast<std::size_t>(end - m.text.begin())));
    if (text == last_ && now_ns - reported_ns_ < 10'000'000'000) return;
    last_ = text;
    reported_ns_ = now_ns;
    const fulmar::Severity severity = m.severity <= 2   ? fulmar::Severity::critical
                                      : m.severity == 3 ? fulmar::Severity::error
                                      : m.severity == 4 ? fulmar::Severity::warning
                                                        : fulmar::Severity::info;
    if (text.view() == no_secondary)  // SECONDARY_MIXER 255, as is recommended: nothing is invalid about it
      return notices.say(fulmar::Severity::info,
                         "flight controller: no secondary mixer, the primary one serves for both");
    notices.say(severity, Line() << "flight controller: " << text.view());
  }

 private:
  static constexpr std::string_view no_secondary = "Invalid mixer selected for secondary mixer!";
  Text<51> last_;
  std::int64_t reported_ns_ = 0;
};

}  // namespace fulmar::fcu

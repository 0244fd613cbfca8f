// SPDX-License-Identifier: BSD-3-Clause
// Sentences of a satellite receiver: from bytes to lines, from lines to numbers. No I/O, no allocation, no
// exception. Source: NMEA 0183 as publicly described in the protocol manuals of receivers (u-blox M8,
// Trimble, SiRF); units are converted to SI.
#pragma once
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string_view>

namespace fulmar::nmea {

/// The comma-separated parts of a sentence with a valid checksum; the first is talker and type, "GNGGA".
struct Sentence {
  std::array<std::string_view, 32> parts{};
  std::size_t count = 0;

  std::string_view operator[](std::size_t i) const { return i < count ? parts[i] : std::string_view{}; }
  /// "GGA" for any satellite system; "" for other sentences (depth sounders, proprietary ones).
  std::string_view type() const {
    const std::string_view head = (*this)[0];
    const bool satellites = head.size() == 5 && (head[0] == 'G' || head.substr(0, 2) == "BD");
    return satellites ? head.substr(2) : std::string_view{};
  }
};

inline int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return -1;
}

/// Takes single bytes. A sentence begins at any `$` and needs a checksum: the exclusive or of all bytes
/// between `$` and `*`. Other lines are dropped and counted.
class Lines {
 public:
  /// The sentence that this byte completes; valid until the next call.
  const Sentence* push(char c) {
    if (c == '$') {
      if (length_ > 0) ++bad_;  // the line before was cut
      length_ = 1;
      return nullptr;
    }
    if (length_ == 0) return nullptr;  // between sentences
    if (c == '\r' || c == '\n') {
      const std::size_t n = length_ - 1;
      length_ = 0;
      if (finish(std::string_view(text_.data(), n))) return &sentence_;
      ++bad_;
      return nullptr;
    }
    if (c < ' ' || c > '~' || length_ > text_.size()) {
      length_ = 0;
      ++bad_;
      return nullptr;
    }
    text_[length_ - 1] = c;
    ++length_;
    return nullptr;
  }

  std::uint64_t good() const { return good_; }
  std::uint64_t bad() const { return bad_; }
  void reset() { length_ = 0; }

 private:
  bool finish(std::string_view text) {
    const std::size_t star = text.size() >= 3 ? text.size() - 3 : 0;
    if (text.size() < 3 || text[star] != '*') return false;
    unsigned sum = 0;
    for (std::size_t i = 0; i < star; ++i) sum ^= static_cast<unsigned char>(text[i]);
    const int high = hex_digit(text[star + 1]), low = hex_digit(text[star + 2]);
    if (high < 0 || low < 0 || sum != static_cast<unsigned>(16 * high + low)) return false;
    return split(text.substr(0, star));
  }
  bool split(std::string_view text) {
    sentence_.count = 0;
    for (;;) {
      if (sentence_.count == sentence_.parts.size()) return false;
      const std::size_t comma = text.find(',');
      sentence_.parts[sentence_.count++] = text.substr(0, comma);
      if (comma == std::string_view::npos) break;
      text.remove_prefix(comma + 1);
    }
    ++good_;
    return true;
  }

  std::array<char, 160> text_{};  // the standard has 82; receivers with more digits send longer lines
  std::size_t length_ = 0;        // bytes from the `$` on; 0 outside a sentence
  Sentence sentence_;
  std::uint64_t good_ = 0, bad_ = 0;
};

// ---- numbers. No value when the part is empty or not exactly in its format.

inline std::optional<double> number(std::string_view text) {
  if (text.empty() || text.find_first_not_of("0123456789.-") != std::string_view::npos) return {};
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) return {};
  return value;
}

inline std::optional<double> number(std::string_view text, double min, double max) {
  const auto value = number(text);
  return value && *value >= min && *value <= max ? value : std::nullopt;
}

/// `digits` decimal digits from `from` on.
inline std::optional<int> digits(std::string_view text, std::size_t from, std::size_t count) {
  if (text.size() < from + count) return {};
  int value = 0;
  for (std::size_t i = from; i < from + count; ++i) {
    if (text[i] < '0' || text[i] > '9') return {};
    value = 10 * value + (text[i] - '0');
  }
  return value;
}

/// hhmmss.sss -> nanoseconds since midnight UTC.
inline std::optional<std::int64_t> time_of_day(std::string_view text) {
  const auto h = digits(text, 0, 2), m = digits(text, 2, 2), s = digits(text, 4, 2);
  if (!h || !m || !s || *h > 23 || *m > 59 || *s > 60) return {};
  std::int64_t ns = ((*h * 60LL + *m) * 60 + *s) * 1000000000;
  if (text.size() == 6) return ns;
  if (text[6] != '.' || text.size() > 16) return {};
  std::int64_t unit = 100000000;
  for (std::size_t i = 7; i < text.size(); ++i, unit /= 10) {
    const auto digit = digits(text, i, 1);
    if (!digit) return {};
    ns += *digit * unit;
  }
  return ns;
}

/// ddmmyy -> nanoseconds from 1970 to that midnight. Years 80 to 99 are 1980 to 1999.
inline std::optional<std::int64_t> date(std::string_view text) {
  const auto d = digits(text, 0, 2), m = digits(text, 2, 2), yy = digits(text, 4, 2);
  if (!d || !m || !yy || text.size() != 6 || *m < 1 || *m > 12) return {};
  constexpr std::array<int, 13> before{0,   31,  59,  90,  120, 151, 181,
                                       212, 243, 273, 304, 334, 365};  // days of the year before a month
  const auto month = static_cast<std::size_t>(*m);
  const int year = *yy >= 80 ? 1900 + *yy : 2000 + *yy;
  const bool leap = year % 4 == 0;  // from 1980 to 2079 without exception
  if (*d < 1 || *d > before[month] - before[month - 1] + (leap && month == 2 ? 1 : 0)) return {};
  const int leap_days = (year - 1969) / 4 + (leap && month > 2 ? 1 : 0);
  const std::int64_t days = 365 * (year - 1970) + leap_days + before[month - 1] + *d - 1;
  return days * 86400 * 1000000000;
}

/// (d)ddmm.mmmm and its hemisphere -> degrees, north and east positive.
inline std::optional<double> angle(std::string_view text, std::string_view hemisphere, char positive,
                                   char negative, double max_deg) {
  const auto value = number(text, 0, 100 * max_deg);
  if (!value || hemisphere.size() != 1 || (hemisphere[0] != positive && hemisphere[0] != negative)) return {};
  const double degrees = std::floor(*value / 100), minutes = *value - 100 * degrees;
  const double angle_deg = degrees + minutes / 60;
  if (minutes >= 60 || angle_deg > max_deg) return {};
  return hemisphere[0] == positive ? angle_deg : -angle_deg;
}

// ---- the five sentences

inline constexpr double knot_mps = 1852.0 / 3600;
inline constexpr double degree = std::numbers::pi / 180;

/// Position. Quality 0 is no fix; then the rest may be missing.
struct Gga {
  std::optional<std::int64_t> time_ns;
  std::optional<double> latitude_deg, longitude_deg, altitude_m, hdop;
  int quality = 0, satellites = 0;
};

inline std::optional<Gga> gga(const Sentence& s) {
  const auto quality = digits(s[6], 0, 1);
  if (s.count < 11 || !quality || s[6].size() != 1) return {};
  Gga r;
  r.time_ns = time_of_day(s[1]);
  r.latitude_deg = angle(s[2], s[3], 'N', 'S', 90);
  r.longitude_deg = angle(s[4], s[5], 'E', 'W', 180);
  r.quality = *quality;
  r.satellites = static_cast<int>(number(s[7], 0, 255).value_or(0));
  r.hdop = number(s[8], 0, 99);
  if (s[10] == "M") r.altitude_m = number(s[9], -1e4, 1e6);
  return r;
}

/// Time, date, and velocity over ground.
struct Rmc {
  std::optional<std::int64_t> time_ns, date_ns;
  bool valid = false;
  std::optional<double> speed_mps, course_rad;
};

inline std::optional<Rmc> rmc(const Sentence& s) {
  if (s.count < 10 || (s[2] != "A" && s[2] != "V")) return {};
  Rmc r;
  r.time_ns = time_of_day(s[1]);
  r.date_ns = date(s[9]);
  r.valid = s[2] == "A";
  if (const auto speed = number(s[7], 0, 2000)) r.speed_mps = *speed * knot_mps;
  if (const auto course = number(s[8], 0, 360)) r.course_rad = *course * degree;
  return r;
}

/// Velocity over ground, for receivers without RMC.
struct Vtg {
  std::optional<double> speed_mps, course_rad;
};

inline std::optional<Vtg> vtg(const Sentence& s) {
  if (s.count < 9 || s[9] == "N") return {};
  Vtg r;
  if (const auto course = number(s[1], 0, 360)) r.course_rad = *course * degree;
  if (const auto knots = s[6] == "N" ? number(s[5], 0, 2000) : std::nullopt) r.speed_mps = *knots * knot_mps;
  if (const auto kmh = s[8] == "K" ? number(s[7], 0, 4000) : std::nullopt; kmh && !r.speed_mps)
    r.speed_mps = *kmh / 3.6;
  return r;
}

/// Standard deviations of the position.
struct Gst {
  std::optional<std::int64_t> time_ns;
  std::optional<double> latitude_m, longitude_m, altitude_m;
};

inline std::optional<Gst> gst(const Sentence& s) {
  if (s.count < 9) return {};
  return Gst{time_of_day(s[1]), number(s[6], 1e-6, 1e6), number(s[7], 1e-6, 1e6), number(s[8], 1e-6, 1e6)};
}

/// Type of the fix: 1 none, 2 flat, 3 spatial; with the dilution of the vertical precision.
struct Gsa {
  int mode = 1;
  std::optional<double> vdop;
};

inline std::optional<Gsa> gsa(const Sentence& s) {
  const auto mode = number(s[2], 1, 3);
  if (s.count < 18 || !mode) return {};
  return Gsa{static_cast<int>(*mode), number(s[17], 0, 99)};
}

}  // namespace fulmar::nmea

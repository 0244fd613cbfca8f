// SPDX-License-Identifier: BSD-3-Clause
// Logs for tests, and the unpacked data of their reports.
#pragma once
#include <zlib.h>

#include <bit>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/loader/table.hpp"
#include "core/log/test/log_kit.hpp"
#include "fulmar/msg/vehicle_state.hpp"
#include "fulmar/schema.hpp"
#include "tools/fulmar_report/columns.hpp"

namespace report_test {

using namespace fulmar;
using core::test::Folder;

constexpr std::int64_t ms = 1'000'000;

/// Flight time is log time minus the epoch of the kit.
class Log {
 public:
  explicit Log(const std::filesystem::path& file) : sample({.file = file, .max_message_bytes = 8192}) {
    sample.writer.metadata("fulmar",
                           {{"mission", "test"}, {"epoch_ns", std::to_string(core::test::epoch_ns)}});
  }
  ~Log() { sample.writer.close(); }

  template <class Message>
  void write(const std::string& topic, std::int64_t at_ns, const Message& message) {
    static const core::TypePtr type = core::copy_type(describe<Message>());
    write_as(topic, *type, at_ns, &message);
  }
  void write_as(const std::string& topic, const core::Type& type, std::int64_t at_ns, const void* message) {
    if (!channels_.contains(topic)) channels_[topic] = sample.channel(topic, type);
    sample.write(channels_[topic], at_ns, static_cast<const std::byte*>(message), 0, 0);
  }
  core::test::Sample sample;

 private:
  std::map<std::string, std::uint16_t> channels_;
};

inline VehicleState state(double std) {
  VehicleState s;
  s.attitude_valid = s.velocity_valid = s.position_valid = s.height_valid = s.airspeed_valid = s.wind_valid =
      s.origin_valid = true;
  s.position_std_m = s.velocity_std_mps = s.attitude_std_rad = s.wind_std_mps = {std, std, std};
  s.airspeed_std_mps = std;
  return s;
}

/// RFC 4648 and RFC 1950, the other way round.
inline std::string unpacked(const std::string& text) {
  std::string bytes;
  std::uint32_t word = 0;
  int bits = 0;
  for (const char c : text) {
    if (c == '=') break;
    const int value = c >= 'A' && c <= 'Z'   ? c - 'A'
                      : c >= 'a' && c <= 'z' ? c - 'a' + 26
                      : c >= '0' && c <= '9' ? c - '0' + 52
                      : c == '+'             ? 62
                                             : 63;
    word = word << 6 | static_cast<std::uint32_t>(value);
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes += static_cast<char>(word >> bits & 0xff);
  }
  std::string out(1 << 22, '\0');
  uLongf size = out.size();
  const int code = ::uncompress(reinterpret_cast<Bytef*>(out.data()), &size,
                                reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
  out.resize(code == Z_OK ? size : 0);
  return out;
}
inline report::Columns columns_of(const std::string& text, std::size_t rows, std::size_t columns) {
  const std::string bytes = unpacked(text);
  report::Columns out;
  if (bytes.size() != 4 * rows * (columns + 1)) return out;
  const auto word = [&](std::size_t column, std::size_t row) {
    std::uint32_t all = 0;
    for (std::size_t plane = 4; plane-- > 0;)
      all = all << 8 | static_cast<unsigned char>(bytes[(4 * column + plane) * rows + row]);
    return all;
  };
  std::uint32_t now = 0;
  for (std::size_t row = 0; row < rows; ++row)
    out.t.push_back(static_cast<std::int32_t>(now += word(0, row)));
  for (std::size_t k = 1; k <= columns; ++k) {
    out.values.emplace_back();
    now = 0;
    for (std::size_t row = 0; row < rows; ++row)
      out.values.back().push_back(std::bit_cast<float>(now ^= word(k, row)));
  }
  return out;
}

}  // namespace report_test

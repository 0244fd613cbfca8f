// SPDX-License-Identifier: BSD-3-Clause
// The messages of a ROS 2 node that are not ours: parameters (rcl_interfaces) and the graph (rmw_dds_common). They hold strings and lists
// of any length, so they have no type table; they are written and read by hand, XCDR1 little endian.
#pragma once
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"

namespace fulmar::core::dds {

class CdrOut {
 public:
  template <class T>
  void number(T value) {
    while ((bytes_.size() - header) % sizeof(T) != 0) bytes_.push_back(std::byte{0});
    const auto* first = reinterpret_cast<const std::byte*>(&value);
    bytes_.insert(bytes_.end(), first, first + sizeof(T));
  }
  void flag(bool value) { number<std::uint8_t>(value ? 1 : 0); }
  void count(std::size_t n) { number(static_cast<std::uint32_t>(n)); }
  void text(std::string_view s) {
    count(s.size() + 1);
    const auto* first = reinterpret_cast<const std::byte*>(s.data());
    bytes_.insert(bytes_.end(), first, first + s.size());
    bytes_.push_back(std::byte{0});
  }
  void texts(const std::vector<std::string>& list) {
    count(list.size());
    for (const std::string& s : list) text(s);
  }
  std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  static constexpr std::size_t header = 4;
  std::vector<std::byte> bytes_{std::byte{0}, std::byte{1}, std::byte{0}, std::byte{0}};  // CDR_LE
};

/// Throws Error when the bytes end before the message does.
class CdrIn {
 public:
  explicit CdrIn(std::span<const std::byte> bytes) : bytes_(bytes) {
    if (bytes.size() < header || bytes[0] != std::byte{0} || bytes[1] != std::byte{1}) throw Error("no little-endian CDR");
  }
  template <class T>
  T number() {
    at_ += (sizeof(T) - (at_ - header) % sizeof(T)) % sizeof(T);
    T value;
    std::memcpy(&value, take(sizeof(T)), sizeof(T));
    return value;
  }
  bool flag() { return number<std::uint8_t>() != 0; }
  /// Of elements that take at least so many bytes each: a count that the bytes cannot hold is refused before room is made for it.
  std::size_t count(std::size_t least) {
    const std::size_t n = number<std::uint32_t>();
    if (n * least > bytes_.size() - at_) throw Error("a list counts more than the bytes hold");
    return n;
  }
  std::string text() {
    const std::size_t n = count(1);
    const auto* first = reinterpret_cast<const char*>(take(n));
    if (n == 0 || first[n - 1] != '\0') throw Error("a text does not end in NUL");
    return {first, n - 1};
  }
  std::vector<std::string> texts() {
    std::vector<std::string> list(count(4));
    for (std::string& s : list) s = text();
    return list;
  }
  template <class T>
  std::vector<T> numbers() {
    std::vector<T> list(count(sizeof(T)));
    for (T& x : list) x = number<T>();
    return list;
  }

 private:
  static constexpr std::size_t header = 4;
  const std::byte* take(std::size_t n) {
    if (at_ > bytes_.size() || bytes_.size() - at_ < n) throw Error("the bytes end too early");
    const std::byte* here = bytes_.data() + at_;
    at_ += n;
    return here;
  }
  std::span<const std::byte> bytes_;
  std::size_t at_ = header;
};

/// rcl_interfaces/msg/ParameterType
enum class RclType : std::uint8_t { not_set, boolean, integer, number, text, bytes, booleans, integers, numbers, texts };

/// rcl_interfaces/msg/ParameterValue
struct RclValue {
  RclType type = RclType::not_set;
  bool boolean = false;
  std::int64_t integer = 0;
  double number = 0;
  std::string text;
  std::vector<std::uint8_t> bytes, booleans;
  std::vector<std::int64_t> integers;
  std::vector<double> numbers;
  std::vector<std::string> texts;

  void write(CdrOut& out) const;
  static RclValue read(CdrIn& in);
};

/// rcl_interfaces/msg/Parameter
struct RclParameter {
  std::string name;
  RclValue value;

  void write(CdrOut& out) const;
  static std::vector<RclParameter> read_list(CdrIn& in);
};

/// rcl_interfaces/msg/ParameterDescriptor
struct RclDescriptor {
  std::string name, description, constraints;
  RclType type = RclType::not_set;
  bool read_only = false;
  bool number_range = false, integer_range = false;  // from min to max
  double min = 0, max = 0;

  void write(CdrOut& out) const;
};

}  // namespace fulmar::core::dds

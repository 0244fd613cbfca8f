// SPDX-License-Identifier: BSD-3-Clause
// The messages of a ROS 2 node that are not ours: parameters (rcl_interfaces) and the graph (rmw_dds_common).
// They hold strings and lists of any length, so they have no type table; they are written and read by hand,
// XCDR1 little endian.
#pragma once
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "core/types/cdr_bytes.hpp"

namespace fulmar::core::dds {

/// Throws Error when the bytes end before the message does.
class CdrIn : public CdrReader {
 public:
  using CdrReader::CdrReader;
  bool flag() { return number<std::uint8_t>() != 0; }
  std::string text() { return std::string(ended_text()); }
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
};

/// rcl_interfaces/msg/ParameterType
enum class RclType : std::uint8_t {
  not_set,
  boolean,
  integer,
  number,
  text,
  bytes,
  booleans,
  integers,
  numbers,
  texts
};

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

/// rcl_interfaces/msg/Parameter: its name and value.
using RclParameter = std::pair<std::string, RclValue>;
std::vector<RclParameter> read_parameters(CdrIn& in);

}  // namespace fulmar::core::dds

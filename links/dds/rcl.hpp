// SPDX-License-Identifier: BSD-3-Clause
// Standard messages of a ROS 2 node: parameters (rcl_interfaces) and the graph (rmw_dds_common). They hold
// strings and lists of any length and therefore have no type table; this code encodes and decodes them, XCDR1
// little endian.
#pragma once
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "core/types/cdr_bytes.hpp"

namespace fulmar::core::dds {

/// rcl_interfaces/msg/ParameterType, without the two that no parameter has: bytes, 5, and booleans, 6.
enum class RclType : std::uint8_t { not_set, boolean, integer, number, text, integers = 7, numbers, texts };

/// rcl_interfaces/msg/ParameterValue
struct RclValue {
  RclType type = RclType::not_set;
  bool boolean = false;
  std::int64_t integer = 0;
  double number = 0;
  std::string text;
  std::vector<std::int64_t> integers;
  std::vector<double> numbers;

  void write(CdrOut& out) const;
  static RclValue read(CdrReader& in);
};

/// rcl_interfaces/msg/Parameter: its name and value.
using RclParameter = std::pair<std::string, RclValue>;
std::vector<RclParameter> read_parameters(CdrReader& in);

}  // namespace fulmar::core::dds

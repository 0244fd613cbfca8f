// SPDX-License-Identifier: BSD-3-Clause
// Converts the text of a ROS 2 message definition to a type table, for logs and live views of other programs.
#pragma once
#include <string>

#include "core/types/type.hpp"

namespace fulmar::core {

/// `name`: "fulmar_msgs/msg/VehicleState"; `text`: as written by ros_definition, nested definitions behind
/// `MSG:` lines. The layout is natural alignment in the order of the fields, which may differ from that of
/// the written struct. Units and frames come from the comments. Labels of an enum (in small letters) come
/// from constants 0, 1, 2, ... right before a uint8 field. A text has room for 4095 bytes, an unbounded list
/// for 256 items. Throws Error on a definition that cannot be read.
TypePtr parse_ros_definition(const std::string& name, const std::string& text);

/// The same without a layout, for a reader of one value after the other: an unbounded list has count 0, an
/// unbounded text stride 0.
TypePtr parse_ros_schema(const std::string& name, const std::string& text);

}  // namespace fulmar::core

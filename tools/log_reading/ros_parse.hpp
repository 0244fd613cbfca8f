// SPDX-License-Identifier: BSD-3-Clause
// From the text of a ROS 2 message definition back to a type table: what reads logs and live views that were
// written elsewhere.
#pragma once
#include <string>

#include "core/types/type.hpp"

namespace fulmar::core {

/// `name`: "fulmar_msgs/msg/VehicleState"; `text`: as ros_definition writes it, nested definitions behind
/// `MSG:` lines. The layout is natural alignment in the order of the fields, so it is not that of the struct
/// which was written. Units and frames come from the comments, labels of an enum (in small letters) from
/// constants 0, 1, 2, ... right before a uint8 field. Text has room for 4095 bytes, a list without a bound
/// for 256 items. Throws Error on a definition that cannot be read.
TypePtr parse_ros_definition(const std::string& name, const std::string& text);

/// The same without a layout, for what takes the bytes one value after the other: a list without a bound has
/// count 0, a text without one stride 0.
TypePtr parse_ros_schema(const std::string& name, const std::string& text);

}  // namespace fulmar::core

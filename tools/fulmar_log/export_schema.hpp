// SPDX-License-Identifier: BSD-3-Clause
// Messages of any ROS 2 log as rows of cells, from the definition in the log and XCDR1 bytes, without
// plugins. Lists may have any length; the widest message sets the width of the table. Source: ROS 2 design
// "interface definition"; OMG DDS-XTypes 1.3, 7.4.1.
#pragma once
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/types/type.hpp"

namespace fulmar::core {

/// A field of one message type with its nested fields; a struct that is used several times is in the tree
/// several times.
struct RosField {
  std::string name;
  fulmar_kind kind = FULMAR_STRUCT;  // an enum is its byte
  fulmar_shape shape = FULMAR_SCALAR;
  std::uint32_t count = 1;                                     // of an array
  std::vector<std::pair<std::int64_t, std::string>> labels{};  // constants that name values, in small letters
  std::vector<RosField> fields{};                              // of a structure
  std::uint32_t longest = 0;  // of a list, among the messages that were measured
  std::size_t width = 1;      // cells of one element; set by `lay_out`
  std::string unit{};         // comment behind it in the definition
};

/// `name`: "fulmar_msgs/msg/Mixed"; `text`: of a schema with encoding ros2msg. The result is a structure
/// without a name. Throws Error on an invalid definition.
RosField parse_ros2msg(const std::string& name, const std::string& text);

struct Cell {
  enum class Kind : std::uint8_t {
    none,
    whole,
    natural,
    single,
    real,
    text
  } kind = Kind::none;  // none: beyond the end of a list
  union {
    std::int64_t whole;
    std::uint64_t natural = 0;
    float single;
    double real;
  };
  std::string_view text;  // into the message
};

struct Column {
  std::string name;  // "legs[1].position_m.north"
  const RosField* field = nullptr;
  bool in_list = false;
};

/// Updates the lengths of lists. Throws Error when the bytes of the message do not fit the definition; so
/// does `decode`.
void measure(RosField& root, std::span<const std::byte> message);
/// The columns of all measured messages. Throws Error when there are more than `most`.
std::vector<Column> lay_out(RosField& root, std::size_t most);
/// One cell per column of `lay_out`.
void decode(const RosField& root, std::span<const std::byte> message, std::vector<Cell>& row);

/// "12", "0.1" (the shortest that reads back the same), "nan"; a text unchanged.
std::string cell_text(const Cell& cell);
/// "" when the field has no label for the value.
std::string_view cell_label(const RosField& field, const Cell& cell);

}  // namespace fulmar::core

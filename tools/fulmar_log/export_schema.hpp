// SPDX-License-Identifier: BSD-3-Clause
// Messages of any ROS 2 log as rows of cells: the definition that stands in the log and XCDR1 bytes, nothing from plugins. Lists of any
// length; what is wide in one message is wide in the table. Source: ROS 2 design "interface definition"; OMG DDS-XTypes 1.3, 7.4.1.
#pragma once
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace fulmar::core {

enum class RosKind : std::uint8_t { flag, i8, u8, i16, u16, i32, u32, i64, u64, f32, f64, text, structure };

/// A field, and what is in it.
struct RosField {
  std::string name;
  RosKind kind = RosKind::f64;
  enum class Shape : std::uint8_t { scalar, array, list } shape = Shape::scalar;
  std::uint32_t count = 1;                                     // of an array
  std::vector<std::pair<std::int64_t, std::string>> labels{};  // constants right before a field of whole numbers, in small letters
  std::vector<RosField> fields{};                              // of a structure
  std::uint32_t longest = 0;                                   // of a list, among the messages that were measured
  std::size_t width = 1;                                       // cells of one element; set by `lay_out`
};

/// `name`: "fulmar_msgs/msg/Mixed"; `text`: of a schema with encoding ros2msg. The result is a nameless structure.
/// Throws Error on what is no such definition.
RosField parse_ros2msg(const std::string& name, const std::string& text);

struct Cell {
  enum class Kind : std::uint8_t { none, whole, natural, single, real, text } kind = Kind::none;  // none: beyond the end of a list
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

/// Takes a message's list lengths into account. Throws Error when its bytes do not fit the definition; so does `decode`.
void measure(RosField& root, std::span<const std::byte> message);
/// The columns of all messages that were measured. Throws Error when there are more than `most`.
std::vector<Column> lay_out(RosField& root, std::size_t most);
/// One cell per column of `lay_out`.
void decode(const RosField& root, std::span<const std::byte> message, std::vector<Cell>& row);

/// "12", "0.1" (the shortest that reads back the same), "nan", text as it is.
std::string cell_text(const Cell& cell);
/// "" when the field has no label for the value.
std::string_view cell_label(const RosField& field, const Cell& cell);

}  // namespace fulmar::core

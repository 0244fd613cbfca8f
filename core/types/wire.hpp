// SPDX-License-Identifier: BSD-3-Clause
// The wire forms, derived from a type table: XCDR1 bytes, ROS 2 message text and hash, JSON. No code per
// message.
#pragma once
#include <cstddef>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/types/type.hpp"

namespace fulmar::core {

/// The encapsulation header before every message.
inline constexpr std::size_t cdr_header_bytes = 4;

/// Encodes messages of one type: a 4-byte encapsulation header and the body, little endian. Compiled at load
/// into a flat list of copies.
class CdrEncoder {
 public:
  explicit CdrEncoder(const Type& type);
  /// Appends to `out`.
  void encode(const std::byte* data, std::vector<std::byte>& out) const;
  /// Writes to `out`, which has room for max_size(); returns the bytes written. No allocation.
  std::size_t encode(const std::byte* data, std::byte* out) const noexcept;
  std::size_t max_size() const { return max_size_; }

  /// One step of encoding. Alignment is that of XCDR1: to the element's size, counted from the start of the
  /// body.
  struct Op {
    enum What : std::uint8_t { copy, text, list, loop, dummy } what = copy;
    std::uint8_t align = 1;    // copy: of its first element; list with body 0: of the elements
    std::uint32_t offset = 0;  // in the struct or element that the op belongs to
    std::uint32_t bytes =
        0;  // copy: all; text: room; list with body 0: of one element, its items are copied at once
    std::uint32_t count = 0;   // list: capacity; loop: elements
    std::uint32_t stride = 0;  // list, loop: bytes from one element to the next
    std::uint32_t items = 0;   // list: bytes from offset to the first element
    std::uint32_t body = 0;    // list, loop: number of the following ops that encode one element
  };

 private:
  std::vector<Op> ops_;
  std::size_t max_size_ = 0;
};

/// The inverse; throws Error when the bytes do not fit the type. For tests and tools.
void cdr_decode(const Type& type, const std::byte* bytes, std::size_t size, std::byte* message);

/// "fulmar_msgs/msg/VehicleState", or the foreign message's own ROS name.
std::string ros_name(const Type& type);

/// Text of the .msg definition with nested definitions appended, as `ros2msg` schemas require.
std::string ros_definition(const Type& type);

/// The same without nested definitions: the content of VehicleState.msg in an interface package.
std::string ros_message_text(const Type& type);

/// ROS 2 type hash (REP 2016): "RIHS01_" and the SHA-256 of the canonical description, in hex.
std::string ros_type_hash(const Type& type);

/// JSON of a message. Keys are field names; `_rad` fields are shown as `_deg` in degrees when `degrees` is
/// set. Text is a string, an enum its label; a number that is not finite is null.
nlohmann::json to_json(const Type& type, const std::byte* data, bool degrees);
/// Fields of a message of figures, angles in degrees; null where a figure does not exist (1e9).
nlohmann::json figures_json(const Type& type, const std::byte* data);

/// The same for users: in the order of the fields; angles, angular rates and accelerations in degrees, under
/// their shown names.
nlohmann::ordered_json shown_json(const Type& type, const std::byte* data);
/// "roll_rad" -> "roll_deg", "p_radps" -> "p_degps"; all others stay.
std::string shown_name(const std::string& field);

/// Whether JSON is nested too deep for a recursive parser.
bool json_too_deep(std::string_view text);

}  // namespace fulmar::core

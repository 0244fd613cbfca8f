// SPDX-License-Identifier: BSD-3-Clause
// The host's own copy of a plugin's description of its messages, ports and parameters. Outlives the plugin's
// file.
#pragma once
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/types/kinds.hpp"

namespace fulmar::core {

struct Type;
using TypePtr = std::shared_ptr<const Type>;

struct Field {
  std::string name{};
  std::string unit{};
  TypePtr type{};                                                 // of a struct
  std::vector<std::string> labels{};                              // of an enum
  std::vector<std::pair<std::int64_t, std::string>> constants{};  // of a ROS field: names of its values
  fulmar_kind kind = FULMAR_F64;
  fulmar_shape shape = FULMAR_SCALAR;
  std::uint32_t offset = 0, count = 1, stride = 0, items = 0;
  double min = -std::numeric_limits<double>::infinity(), max = std::numeric_limits<double>::infinity();
  bool appended = false;  // a writer may lack it: its reader then gets zeros
  struct {
    bool required = false;  // the writer must provide it
    bool instead = false;   // alternative to the required fields of the same struct
    bool rising = false;    // a list whose numbers are in ascending order
  } in_record{};
};

/// Field of a struct of the host. `room`: of a text.
Field host_field(const char* name, fulmar_kind kind, std::size_t offset, std::size_t room = 0);

struct Type {
  std::string name{}, frame{}, ros{};
  std::vector<Field> fields{};
  std::uint32_t size = 0, align = 1;
  std::uint64_t hash = 0;  // of all of the above but ranges, including nested types and offsets

  const Field* find(std::string_view field) const;
};

TypePtr host_struct(const std::string& name, std::size_t size, std::size_t align, std::vector<Field> fields);

struct Port {
  std::string name;
  TypePtr type;  // empty for a probe
  fulmar_port_kind kind = FULMAR_IN_VALUE;
  bool optional = false;
  std::uint32_t capacity = 1;
};

struct ParamInfo {
  std::string name, unit, doc, initial_text;
  std::vector<std::string> choices;
  TypePtr type;                         // of a record or vector
  std::vector<std::byte> initial_data;  // of a record
  fulmar_param_kind kind = FULMAR_NUMBER;
  bool live = false, required = false;
  std::uint32_t capacity = 0;
  double initial[3] = {0, 0, 0};
  double min = 0, max = 0;
};

struct ComponentInfo {
  std::string name, doc;
  std::vector<Port> inputs, outputs;
  std::vector<ParamInfo> params;
  bool vehicle = false, resident = false;
  bool retunes = false, activates = false;  // optional calls that the component has

  int input(std::string_view port) const;   // index, or -1
  int output(std::string_view port) const;  // index, or -1
  int param(std::string_view name_) const;  // index, or -1
};

struct PluginInfo {
  std::string file;      // name without folders: "control_slc.so"
  std::string path;      // original path; not for logs
  std::string copy;      // the private copy that is loaded
  std::string script;    // of a file in another language: its private copy; `copy` is then the plugin that
                         // hosts the language
  std::string sha256;    // of the file, hex
  std::string build_id;  // from the linker, hex; "" without one
  std::string version, toolchain, flags;
  std::uint32_t abi_major = 0, abi_minor = 0;
  std::vector<ComponentInfo> components;
};

/// A valid name in a mission file: letters, digits and underscores, the first character no digit.
bool is_identifier(std::string_view name);

/// Bytes of one element.
std::uint32_t element_size(const Field& field);

/// Bytes from a field's offset to its end.
std::uint64_t field_span(const Field& field);

/// A struct's field addressed by a dotted name: "position_m.north", "waypoints[3].airspeed_mps",
/// "waypoints.count" (of a list). Throws Error naming the valid choices. A whole array or list is invalid; a
/// struct or a text is valid: check field->kind.
struct FieldRef {
  const Field* field = nullptr;  // the last one; lives as long as the type
  std::uint32_t offset = 0;      // from the start of the message to the element
  std::string unit;              // inherited from the outer field when the inner one has none
  struct Item {
    std::uint32_t count_offset = 0, index = 0;
  };
  std::vector<Item> items;  // the list items on the path
  /// False when the message has fewer list items than the name needs.
  bool present(const std::byte* message) const noexcept;
};
FieldRef resolve_field(const Type& type, std::string_view dotted);

/// The element at `at` (the start of the message + FieldRef::offset) as a number. Bool and enum count from 0.
/// Text and structs are nan.
inline double number_at(fulmar_kind kind, const std::byte* at) noexcept {
  return with_number(kind, at, [](auto x) { return static_cast<double>(x); });
}
inline double number_at(const Field& field, const std::byte* at) noexcept {
  return number_at(field.kind, at);
}

/// Reason why a writer of type `from` cannot feed a reader of type `to`: names the first field that differs.
/// "" when it can.
std::string incompatibility(const Type& from, const Type& to);

/// Copies the fields that the reader has, and clears those that the writer lacks. Equal tables are copied at
/// once.
struct CopyPlan {
  struct Move {
    std::uint32_t from = 0, to = 0, bytes = 0;
  };
  struct Gap {
    std::uint32_t to = 0, bytes = 0;
  };
  bool whole = true;  // equal tables
  std::vector<Move> moves;
  std::vector<Gap> gaps;   // applied after the moves, which may copy padding
  std::uint32_t size = 0;  // of the reader's struct
  void run(const std::byte* from, std::byte* to) const;
};
CopyPlan copy_plan(const Type& from, const Type& to);

/// Finds the first invalid value in a message: not finite, out of its range, or an invalid label, flag, text
/// end or list count. `check` allocates nothing and returns false on an invalid value; `explain` then names
/// it: "airspeed_mps is nan".
class Guard {
 public:
  explicit Guard(const Type& type);
  bool check(const std::byte* data) const noexcept;
  std::string explain(const std::byte* data) const;
  void explain_to(const std::byte* data, char* text,
                  std::size_t size) const noexcept;  // the same without allocation

 private:
  struct Step {
    enum class Kind : std::uint8_t { finite_f64, finite_f32, range_f64, range, bytes, text, repeat };
    Kind kind = Kind::finite_f64;
    fulmar_kind element = FULMAR_F64;
    std::uint32_t offset = 0, count = 1, stride = 0;
    double min = 0, max = 0;
    // repeat: the steps up to `end` apply to each item; the number at `count_offset` is their count when
    // `counted`
    std::uint32_t count_offset = 0, end = 0;
    bool counted = false;
  };
  struct Compiler;
  static bool run(const Step* step, const Step* end, const std::byte* data) noexcept;

  std::vector<Step> steps_;
  TypePtr type_;  // a copy, for messages
};

}  // namespace fulmar::core

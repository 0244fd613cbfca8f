// SPDX-License-Identifier: BSD-3-Clause
// Text of ROS 2 message definitions -> type tables. Source: ROS 2 design "interface definition"; MCAP's
// registry of well-known schema encodings, `ros2msg`.
#include "tools/log_reading/ros_parse.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <sstream>

#include "core/error.hpp"
#include "core/types/element.hpp"
#include "core/types/text.hpp"
#include "tools/log_reading/messages.hpp"

namespace fulmar::core {
namespace {

constexpr std::uint32_t text_room = 4096;
constexpr std::uint32_t list_room = 256;
constexpr std::uint64_t largest_struct = 1u << 26;
constexpr std::size_t max_fields = 20'000;  // of all structs together
constexpr std::size_t max_name = 256;
constexpr int deepest = 16;

/// Of a number, bool or text.
std::optional<fulmar_kind> ros_kind(std::string_view word) {
  if (word == "byte" || word == "char") return FULMAR_U8;
  for (const KindRow& row : kind_rows)
    if (row.ros == word && row.kind != FULMAR_STRUCT) return row.kind;
  return std::nullopt;
}

std::vector<std::string> ros_kinds() {
  std::vector<std::string> names{"byte", "char"};
  for (const KindRow& row : kind_rows)
    if (row.kind != FULMAR_STRUCT && ros_kind(row.ros) &&
        std::find(names.begin(), names.end(), row.ros) == names.end())
      names.emplace_back(row.ros);
  std::sort(names.begin(), names.end());
  return names;
}

template <class T>
bool read_number(std::string_view text, T& value) {
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  return code == std::errc{} && end == text.data() + text.size();
}

/// Removes the first word from `s` and returns it.
std::string_view take_word(std::string_view& s) {
  s = trimmed(s);
  const std::string_view word = s.substr(0, s.find_first_of(" \t"));
  s = trimmed(s.substr(word.size()));
  return word;
}

/// "geometry_msgs/Point" and "geometry_msgs/msg/Point" are the same; a name without a package belongs to
/// `package`.
std::string full_name(std::string_view name, const std::string& package) {
  const std::size_t slash = name.find('/');
  if (slash == std::string_view::npos) return package + "/msg/" + std::string(name);
  if (name.find('/', slash + 1) != std::string_view::npos) return std::string(name);
  return std::string(name.substr(0, slash)) + "/msg" + std::string(name.substr(slash));
}
std::string package_of(const std::string& full) { return full.substr(0, full.find('/')); }

using Constants = std::vector<std::pair<std::int64_t, std::string>>;  // in small letters

std::uint32_t align_up(std::uint64_t at, std::uint32_t align) {
  return static_cast<std::uint32_t>((at + align - 1) / align * align);
}

class Parser {
 public:
  Parser(const std::string& name, const std::string& text, bool laid_out)
      : hash_seed_(text), laid_out_(laid_out) {
    std::istringstream lines(text);
    std::string line, section = full_name(name, package_of(name));
    sections_[section];
    while (std::getline(lines, line)) {
      const std::string_view words = trimmed(line);
      if (words.starts_with("===")) continue;
      if (words.starts_with("MSG:"))
        section = full_name(trimmed(words.substr(4)), package_of(name));
      else
        sections_[section].push_back(line);
    }
  }

  TypePtr type(const std::string& name, int depth) {
    const auto known = types_.find(name);
    const int inside = known == types_.end() ? 0 : levels_.at(known->second.get());
    if (depth + inside > deepest) throw Error(reading_messages::type_nesting_invalid(name));
    if (known != types_.end()) return known->second;
    const auto section = sections_.find(name);
    if (section == sections_.end()) throw Error(reading_messages::type_definition_missing(name));
    Type made;
    made.name = name.substr(name.rfind('/') + 1);
    if (package_of(name) != "fulmar_msgs") made.ros = name;
    std::uint64_t end = 0;
    Constants constants;
    for (const std::string& line : section->second) read_line(line, name, depth, made, end, constants);
    made.size = align_up(std::max<std::uint64_t>(end, 1), made.align);
    made.hash = std::hash<std::string>{}(name + "\n" + hash_seed_);
    if (const auto frame = frames_.find(name); frame != frames_.end()) made.frame = frame->second;
    int levels = 0;
    for (const Field& f : made.fields)
      if (f.type) levels = std::max(levels, levels_.at(f.type.get()) + 1);
    const TypePtr result = types_[name] = std::make_shared<const Type>(std::move(made));
    levels_[result.get()] = levels;
    return result;
  }

 private:
  [[noreturn]] static void fail(const std::string& name, const std::string& line, const Diagnostic& why) {
    throw Error(located(name, reading_messages::line_fault(trimmed(line), why)));
  }

  void read_line(const std::string& line, const std::string& name, int depth, Type& made, std::uint64_t& end,
                 Constants& constants) {
    const std::size_t hash = line.find('#');
    std::string_view words = trimmed(std::string_view(line).substr(0, hash));
    if (words.empty()) return;
    const std::string_view type_word = take_word(words);
    if (is_constant(words)) {
      constant(words, constants);
      return;
    }
    Field field;
    field.name = std::string(take_word(words));  // a default value may follow
    if (field.name.empty()) fail(name, line, reading_messages::field_incomplete());
    if (field.name.size() > max_name) fail(name, line, reading_messages::field_name_too_long());
    if (++fields_ > max_fields) fail(name, line, reading_messages::too_many_fields());
    const std::string note(hash == std::string::npos ? "" : trimmed(std::string_view(line).substr(hash + 1)));
    std::string_view element = type_word;
    if (!shape(element, field)) fail(name, line, reading_messages::list_length_invalid());
    if (!kind(element, name, note, depth, field))
      fail(name, line, reading_messages::field_type_unknown(element, choices_text(element, ros_kinds())));
    if (primitive_size(field.kind) > 0 && !is_real(field.kind)) take_constants(constants, field);
    constants.clear();
    if (laid_out_) place(field, name, made, end);
    made.fields.push_back(std::move(field));
  }

  /// NAME=1, NAME =1, NAME = 1
  static bool is_constant(std::string_view words) {
    const std::string_view first = take_word(words);
    return first.find('=') != std::string_view::npos || words.starts_with('=');
  }

  static void constant(std::string_view words, Constants& constants) {
    const std::size_t equals = words.find('=');
    std::int64_t value = 0;  // a constant with another value is no label of a field
    if (read_number(trimmed(words.substr(equals + 1)), value))
      constants.emplace_back(value, lower(trimmed(words.substr(0, equals))));
  }

  /// Removes "[3]", "[<=8]", "[]" from the end.
  static bool shape(std::string_view& element, Field& field) {
    const std::size_t open = element.find('[');
    if (open == std::string_view::npos) {
      field.count = 1;
      return true;
    }
    if (element.back() != ']') return false;
    std::string_view inside = element.substr(open + 1, element.size() - open - 2);
    element = element.substr(0, open);
    field.shape = FULMAR_ARRAY;
    if (inside.empty() || inside.starts_with("<=")) field.shape = FULMAR_LIST;
    if (inside.empty()) {
      field.count = 0;
      return true;
    }
    if (inside.starts_with("<=")) inside.remove_prefix(2);
    return read_number(inside, field.count) && field.count > 0;
  }

  bool kind(std::string_view element, const std::string& name, const std::string& note, int depth,
            Field& field) {
    field.unit = note;
    if (element.starts_with("string<=")) {
      if (!read_number(element.substr(8), field.stride) || field.stride > largest_struct / 2) return false;
      ++field.stride;  // the NUL
      element = "string";
    }
    if (const auto known = ros_kind(element)) {
      field.kind = *known;
      if (field.kind != FULMAR_TEXT) field.stride = primitive_size(field.kind);
      return true;
    }
    std::string full = full_name(element, package_of(name));
    if (element == "Header" && !sections_.contains(full)) full = "std_msgs/msg/Header";
    if (!sections_.contains(full)) return false;
    split_frame(full, field);
    field.kind = FULMAR_STRUCT;
    field.type = type(full, depth + 1);
    field.stride = field.type->size;
    return true;
  }

  /// "m/s, ned": the last word is the frame of the struct.
  void split_frame(const std::string& full, Field& field) {
    static constexpr std::array<std::string_view, 3> frames{"ned", "body", "body to ned"};
    const std::size_t comma = field.unit.rfind(", ");
    const std::string last = comma == std::string::npos ? field.unit : field.unit.substr(comma + 2);
    if (std::find(frames.begin(), frames.end(), last) == frames.end()) return;
    frames_[full] = last;
    field.unit = comma == std::string::npos ? "" : field.unit.substr(0, comma);
  }

  /// Labels without the name of the field, if all begin with it. ros_message_text writes an enum as constants
  /// 0, 1, ... of a uint8.
  static void take_constants(Constants& constants, Field& field) {
    const std::string prefix = lower(field.name) + "_";
    const bool prefixed = std::all_of(constants.begin(), constants.end(),
                                      [&](const auto& c) { return c.second.starts_with(prefix); });
    bool counted = field.kind == FULMAR_U8 && field.shape == FULMAR_SCALAR && !constants.empty();
    for (std::size_t i = 0; i < constants.size(); ++i) {
      if (prefixed) constants[i].second.erase(0, prefix.size());
      counted = counted && constants[i].first == static_cast<std::int64_t>(i);
    }
    field.constants = std::move(constants);
    if (!counted) return;
    field.kind = FULMAR_ENUM;
    for (const auto& [value, label] : field.constants) field.labels.push_back(label);
  }

  /// Gives unbounded texts and lists a fixed room.
  static void place(Field& field, const std::string& name, Type& made, std::uint64_t& end) {
    const std::uint32_t own = field.kind == FULMAR_STRUCT ? field.type->align
                              : field.kind == FULMAR_TEXT ? 1
                                                          : primitive_size(field.kind);
    const bool list = field.shape == FULMAR_LIST;
    if (field.stride == 0) field.stride = text_room;
    if (field.count == 0) field.count = list_room;
    const std::uint32_t align = list ? std::max(own, 4u) : own;
    field.offset = align_up(end, align);
    field.items = list ? align_up(4, own) : 0;
    end = std::uint64_t{field.offset} + field.items + std::uint64_t{field.count} * field.stride;
    if (end > largest_struct)
      throw Error(reading_messages::type_too_large(name, field.name, end, largest_struct));
    made.align = std::max(made.align, align);
  }

  std::string hash_seed_;
  std::map<std::string, std::vector<std::string>> sections_;
  std::map<std::string, std::string> frames_;
  std::map<std::string, TypePtr> types_;
  std::map<const Type*, int> levels_;  // of structs inside it
  std::size_t fields_ = 0;
  bool laid_out_;
};

}  // namespace

TypePtr parse_ros_definition(const std::string& name, const std::string& text) {
  if (name.find('/') == std::string::npos) throw Error(reading_messages::type_name_invalid(name));
  return Parser(name, text, true).type(full_name(name, ""), 0);
}

TypePtr parse_ros_schema(const std::string& name, const std::string& text) {
  return Parser(name, text, false).type(full_name(name, ""), 0);
}

}  // namespace fulmar::core

// SPDX-License-Identifier: BSD-3-Clause
// ROS 2 names, message text and type hash of a message. Sources: ROS 2 design "interface definition", REP
// 2016 (RIHS01).
#include <cctype>
#include <map>
#include <set>

#include "core/types/element.hpp"
#include "core/types/sha256.hpp"
#include "core/types/wire.hpp"

namespace fulmar::core {
namespace {

/// "fulmar_msgs/VehicleState": name of a type in a field and a `MSG:` line.
std::string short_name(const Type& type) {
  std::string name = ros_name(type);
  const std::size_t middle = name.find("/msg/");
  return middle == std::string::npos ? name : name.erase(middle, 4);
}

/// The types inside a type, each once, in order of appearance.
void nested_types(const Type& type, std::vector<const Type*>& list, std::set<std::string>& seen) {
  for (const Field& f : type.fields) {
    if (f.kind != FULMAR_STRUCT || !seen.insert(ros_name(*f.type)).second) continue;
    list.push_back(f.type.get());
    nested_types(*f.type, list, seen);
  }
}
std::vector<const Type*> nested_types(const Type& type) {
  std::vector<const Type*> list;
  std::set<std::string> seen{ros_name(type)};
  nested_types(type, list, seen);
  return list;
}

/// A ROS constant: upper-case letters, digits, single underscores; the first character is a letter.
std::string constant_name(std::string_view text) {
  std::string name;
  for (const char c : text) {
    const auto u = static_cast<unsigned char>(c);
    if (std::isalnum(u)) {
      name += static_cast<char>(std::toupper(u));
    } else if (!name.empty() && name.back() != '_') {
      name += '_';
    }
  }
  while (!name.empty() && name.back() == '_') name.pop_back();
  return name;
}

/// Labels of a message's enum fields get the field's name as a prefix when there are several such fields, or
/// when a label does not begin with a letter.
std::string constants(const Field& field, bool prefixed) {
  for (const std::string& label : field.labels)
    prefixed = prefixed || !std::isalpha(static_cast<unsigned char>(label.empty() ? '0' : label[0]));
  std::string text;
  for (std::size_t i = 0; i < field.labels.size(); ++i) {
    text += "uint8 " + constant_name((prefixed ? field.name + "_" : "") + field.labels[i]) + "=" +
            std::to_string(i) + "\n";
  }
  return text;
}

/// Lists of foreign messages are unbounded sequences in ROS; only Fulmar limits their capacity.
bool unbounded(const Type& type, const Field& f) {
  return f.shape == FULMAR_LIST && !type.ros.empty() && !type.ros.starts_with("fulmar_msgs/");
}

std::string field_line(const Type& type, const Field& f) {
  std::string line = f.kind == FULMAR_STRUCT ? short_name(*f.type) : kind_row(f.kind).ros;
  if (f.shape == FULMAR_ARRAY) line += "[" + std::to_string(f.count) + "]";
  if (f.shape == FULMAR_LIST) line += unbounded(type, f) ? "[]" : "[<=" + std::to_string(f.count) + "]";
  line += " " + f.name;
  std::string note = f.unit;
  if (f.kind == FULMAR_STRUCT && !f.type->frame.empty()) note += (note.empty() ? "" : ", ") + f.type->frame;
  return line + (note.empty() ? "" : "  # " + note) + "\n";
}

// ---- type hash

/// type_description_interfaces/msg/FieldType
int type_id(const Type& type, const Field& f) {
  const int shift = f.shape == FULMAR_ARRAY ? 48 : unbounded(type, f) ? 144 : f.shape == FULMAR_LIST ? 96 : 0;
  return kind_row(f.kind).ros_id + shift;
}

std::string field_description(const std::string& name, int id, std::uint32_t capacity,
                              const std::string& nested) {
  return R"({"name": ")" + name + R"(", "type": {"type_id": )" + std::to_string(id) + R"(, "capacity": )" +
         std::to_string(capacity) + R"(, "string_capacity": 0, "nested_type_name": ")" + nested + R"("}})";
}

std::string type_description(const Type& type) {
  std::string fields;
  for (const Field& f : type.fields) {
    const std::string nested = f.kind == FULMAR_STRUCT ? ros_name(*f.type) : "";
    const std::uint32_t capacity = f.shape == FULMAR_SCALAR || unbounded(type, f) ? 0 : f.count;
    fields += (fields.empty() ? "" : ", ") + field_description(f.name, type_id(type, f), capacity, nested);
  }
  if (fields.empty()) fields = field_description("structure_needs_at_least_one_member", 3, 0, "");
  return R"({"type_name": ")" + ros_name(type) + R"(", "fields": [)" + fields + "]}";
}

}  // namespace

std::string ros_name(const Type& type) {
  if (!type.ros.empty()) {
    const std::size_t slash = type.ros.find('/');
    const bool brief = slash != std::string::npos && type.ros.find('/', slash + 1) == std::string::npos;
    return brief ? type.ros.substr(0, slash) + "/msg" + type.ros.substr(slash) : type.ros;
  }
  std::string name;
  for (const char c : type.name) {
    if (std::isalnum(static_cast<unsigned char>(c))) name += c;
  }
  if (!name.empty()) name[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(name[0])));
  return "fulmar_msgs/msg/" + name;
}

std::string ros_message_text(const Type& type) {
  std::size_t enums = 0;
  for (const Field& f : type.fields) enums += f.kind == FULMAR_ENUM;
  std::string text;
  for (const Field& f : type.fields) {
    if (f.kind == FULMAR_ENUM) text += constants(f, enums > 1);
    text += field_line(type, f);
  }
  return text;
}

std::string ros_definition(const Type& type) {
  std::string text = ros_message_text(type);
  for (const Type* nested : nested_types(type))
    text += std::string(80, '=') + "\nMSG: " + short_name(*nested) + "\n" + ros_message_text(*nested);
  return text;
}

std::string ros_type_hash(const Type& type) {
  std::map<std::string, std::string> referenced;  // sorted by name
  for (const Type* nested : nested_types(type)) referenced[ros_name(*nested)] = type_description(*nested);
  std::string list;
  for (const auto& [name, description] : referenced) list += (list.empty() ? "" : ", ") + description;
  return "RIHS01_" + Sha256::of(R"({"type_description": )" + type_description(type) +
                                R"(, "referenced_type_descriptions": [)" + list + "]}");
}

}  // namespace fulmar::core

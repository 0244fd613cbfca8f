// SPDX-License-Identifier: BSD-3-Clause
// Converts a message's field table to a C++ struct with that table; the reverse of
// sdk/include/fulmar/schema.hpp.
#include <algorithm>

#include "tools/fulmar_new/new_source.hpp"

namespace fulmar::core {
namespace {

class Writer {
 public:
  void add(const Type& type) {
    if (known(type) || std::find(done_.begin(), done_.end(), type.name) != done_.end()) return;
    done_.push_back(type.name);
    for (const Field& field : type.fields)
      if (field.type) add(*field.type);
    std::string body;
    if (!type.ros.empty()) body += "  static constexpr const char* ros_type = \"" + type.ros + "\";\n";
    for (const Field& field : type.fields) body += "  " + declared(type, field) + ";\n";
    text_ += "struct " + type.name + " {\n" + body + "};\n\n";
  }
  const std::string& text() const { return text_; }

 private:
  /// Types from the SDK's headers.
  static bool known(const Type& type) {
    return type.name == "Vec3Ned" || type.name == "Vec3Body" || type.name == "Quat";
  }

  std::string element(const Type& type, const Field& field) {
    if (field.kind == FULMAR_TEXT) return "Text<" + std::to_string(field.stride) + ">";
    if (field.kind == FULMAR_ENUM) return enumeration(type, field);
    if (field.kind == FULMAR_BOOL) return "bool";
    if (is_real(field.kind)) return field.kind == FULMAR_F32 ? "float" : "double";
    if (field.kind != FULMAR_STRUCT) return std::string("std::") + kind_row(field.kind).ros + "_t";
    if (field.type->name == "Vec3Ned") return "Vec3<Ned>";
    if (field.type->name == "Vec3Body") return "Vec3<Body>";
    return field.type->name;
  }

  /// The table has the labels of an enum but not its name.
  std::string enumeration(const Type& type, const Field& field) {
    const std::string name = type.name + pascal_case(field.name);
    text_ += "enum class " + name + " : std::uint8_t { ";
    for (std::size_t i = 0; i < field.labels.size(); ++i) text_ += (i > 0 ? ", " : "") + field.labels[i];
    text_ += " };\n";
    return name;
  }

  std::string declared(const Type& type, const Field& field) {
    const std::string item = element(type, field), count = std::to_string(field.count);
    if (field.shape == FULMAR_ARRAY) return "std::array<" + item + ", " + count + "> " + field.name + "{}";
    if (field.shape == FULMAR_LIST) return "List<" + item + ", " + count + "> " + field.name;
    return item + " " + field.name + (field.kind == FULMAR_STRUCT || field.kind == FULMAR_TEXT ? "" : "{}");
  }

  std::vector<std::string> done_;
  std::string text_;
};

}  // namespace

std::string message_source(const Type& type) {
  Writer writer;
  writer.add(type);
  return writer.text();
}

}  // namespace fulmar::core

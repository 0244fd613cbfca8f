// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_inspect/inspect_text.hpp"

#include <cmath>
#include <cstdio>

#include "core/error.hpp"
#include "core/loader/table.hpp"
#include "tools/fulmar_inspect/messages.hpp"

namespace fulmar::core::inspect_text {

std::string number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.12g", x);
  return text;
}

std::string range(double min, double max) {
  if (std::isinf(min) && std::isinf(max)) return "";
  if (std::isinf(min)) return "<= " + number(max);
  return std::isinf(max) ? ">= " + number(min) : number(min) + " .. " + number(max);
}

std::string hash_text(std::uint64_t hash) {
  char text[20];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
  return text;
}

std::string byte_text(std::uint32_t size) { return std::to_string(size) + (size == 1 ? " byte" : " bytes"); }

std::string port_kind(const Port& port) {
  const std::string many = " of " + std::to_string(port.capacity);
  switch (port.kind) {
    case FULMAR_IN_VALUE: return port.optional ? "value, optional" : "value";
    case FULMAR_IN_QUEUE: return "queue" + many;
    case FULMAR_IN_REQUEST: return "request" + many;
    case FULMAR_OUT_VALUE: return "value";
    case FULMAR_OUT_EVENT: return inspect_messages::event_output_kind().line();
    case FULMAR_OUT_QUEUE: return "queue" + many;
    case FULMAR_OUT_PROBE: return "probe";
  }
  return "?";
}

std::string initial_text(const ParamInfo& param) {
  const std::string unit = param.unit.empty() ? "" : " " + param.unit;
  switch (param.kind) {
    case FULMAR_NUMBER:
    case FULMAR_COUNT: return number(param.initial[0]) + unit;
    case FULMAR_FLAG: return param.initial[0] != 0 ? "true" : "false";
    case FULMAR_CHOICE: return param.choices[static_cast<std::size_t>(param.initial[0])];
    case FULMAR_STRING: return "\"" + param.initial_text + "\"";
    case FULMAR_VECTOR:
      return "[" + number(param.initial[0]) + ", " + number(param.initial[1]) + ", " +
             number(param.initial[2]) + "]" + unit;
    case FULMAR_RECORD: return param.type->name + " (file)";
    case FULMAR_BLOB: return "bytes (file)";
  }
  return "?";
}

std::string limits_text(const ParamInfo& param) {
  if (param.kind == FULMAR_CHOICE) return join(param.choices);
  const bool numeric =
      param.kind == FULMAR_NUMBER || param.kind == FULMAR_COUNT || param.kind == FULMAR_VECTOR;
  return numeric ? range(param.min, param.max) : "";
}

std::string element_text(const Field& field) {
  if (field.kind == FULMAR_STRUCT) return field.type->name;
  const std::string word = kind_word(field.kind);
  return field.kind == FULMAR_TEXT ? word + " of " + std::to_string(field.stride) : word;
}

std::string shape_text(const Field& field) {
  if (field.shape == FULMAR_ARRAY) return "[" + std::to_string(field.count) + "]";
  return field.shape == FULMAR_LIST ? "[<=" + std::to_string(field.count) + "]" : "";
}

}  // namespace fulmar::core::inspect_text

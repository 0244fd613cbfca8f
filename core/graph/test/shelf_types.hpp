// SPDX-License-Identifier: BSD-3-Clause
// Ports and parameters described by hand, with the tables of the shared messages.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "core/loader/table.hpp"
#include "core/types/type.hpp"
#include "fulmar/schema.hpp"

namespace fulmar::core::test {

template <class T>
TypePtr type_of() {
  static const TypePtr type = copy_type(::fulmar::describe<T>());
  return type;
}

template <class T>
Port port(const std::string& name, fulmar_port_kind kind, bool optional = false) {
  Port p;
  p.name = name;
  p.type = type_of<T>();
  p.kind = kind;
  p.optional = optional;
  return p;
}
template <class T>
Port in(const std::string& name) {
  return port<T>(name, FULMAR_IN_VALUE);
}
template <class T>
Port optional(const std::string& name) {
  return port<T>(name, FULMAR_IN_VALUE, true);
}
template <class T>
Port out(const std::string& name, fulmar_port_kind kind = FULMAR_OUT_VALUE) {
  return port<T>(name, kind);
}

inline ParamInfo number(const std::string& name, double initial, const std::string& unit, double min,
                        double max, bool live = true) {
  ParamInfo p;
  p.name = name;
  p.unit = unit;
  p.kind = FULMAR_NUMBER;
  p.initial[0] = initial;
  p.min = min;
  p.max = max;
  p.live = live;
  return p;
}
inline ParamInfo choice(const std::string& name, const std::vector<std::string>& choices) {
  ParamInfo p;
  p.name = name;
  p.kind = FULMAR_CHOICE;
  p.choices = choices;
  p.live = true;
  return p;
}
template <class T>
ParamInfo record(const std::string& name, bool required) {
  static const T initial{};
  ParamInfo p;
  p.name = name;
  p.kind = FULMAR_RECORD;
  p.type = type_of<T>();
  p.required = required;
  const auto* bytes = reinterpret_cast<const std::byte*>(&initial);
  p.initial_data.assign(bytes, bytes + sizeof initial);
  return p;
}

}  // namespace fulmar::core::test

// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_live/parameters.hpp"

#include <cmath>
#include <cstdio>
#include <set>

#include "core/graph/params.hpp"
#include "core/graph/quantity.hpp"
#include "tools/fulmar_live/messages.hpp"

namespace fulmar::core {
namespace {

/// Displayed unit of angles and its conversion factor.
std::string shown_unit(const std::string& unit) {
  return unit == "rad" ? "deg" : unit == "rad/s" ? "deg/s" : unit == "rad/s2" ? "deg/s2" : unit;
}
std::string shown_number(const ParamInfo& info, double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.6g", value / unit_factor(shown_unit(info.unit), info.unit));
  return buffer;
}

}  // namespace

std::string shown_value(const ParamInfo& info, const ParamValue& value) {
  const std::string unit = info.unit.empty() ? "" : " " + shown_unit(info.unit);
  if (info.kind == FULMAR_NUMBER) return shown_number(info, value.number[0]) + unit;
  if (info.kind != FULMAR_VECTOR) return value_text(info, value);
  return "[" + shown_number(info, value.number[0]) + ", " + shown_number(info, value.number[1]) + ", " +
         shown_number(info, value.number[2]) + "]" + unit;
}

std::string shown_range(const ParamInfo& info) {
  if (info.kind == FULMAR_CHOICE) return join(info.choices);
  const bool from = std::isfinite(info.min), to = std::isfinite(info.max);
  const bool numeric = info.kind == FULMAR_NUMBER || info.kind == FULMAR_VECTOR || info.kind == FULMAR_COUNT;
  if (!numeric || (!from && !to)) return "";
  const std::string unit = info.unit.empty() ? "" : " " + shown_unit(info.unit);
  if (!to) return "from " + shown_number(info, info.min) + unit;
  if (!from) return "up to " + shown_number(info, info.max) + unit;
  return shown_number(info, info.min) + " .. " + shown_number(info, info.max) + unit;
}

const NamedParam& find_param(const std::vector<NamedParam>& params, const std::string& name) {
  const std::string component = name.substr(0, name.find('.'));
  std::set<std::string> components;
  std::vector<std::string> names;
  for (const NamedParam& p : params) {
    if (p.name == name) return p;
    components.insert(p.component);
    if (p.component == component) names.push_back(p.info.name);
  }
  if (names.empty())
    throw Error(remote_messages::owner_without_parameters(
        component, choices_text(component, {components.begin(), components.end()})));
  if (name.find('.') == std::string::npos)
    throw Error(remote_messages::parameter_name_expected(name, name, join(names)));
  const std::string own = name.substr(component.size() + 1);
  throw Error(remote_messages::parameter_unknown(component, own, choices_text(own, names)));
}

}  // namespace fulmar::core

// SPDX-License-Identifier: BSD-3-Clause
// Parameters as the view of a running flight tells of them.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/graph/graph.hpp"

namespace fulmar::core {

/// {"name": "roll_kp", "kind": "number", ...} of the view -> what a host knows of the parameter. Throws
/// Error.
ParamInfo param_info(const nlohmann::json& param);
ParamValue param_value(const ParamInfo& info, const nlohmann::json& value);

/// For people: angles in degrees, "40 deg"; and "2.9 .. 68.8 deg", "none light severe", "" when everything
/// goes.
std::string shown_value(const ParamInfo& info, const ParamValue& value);
std::string shown_range(const ParamInfo& info);

struct NamedParam {
  std::string component, use, name;  // "slc.roll_kp"
  bool vehicle = false, overlaid = false;
  ParamInfo info;
  ParamValue value;
  std::string text;  // exact
};
std::vector<NamedParam> params_of(const nlohmann::json& view);

/// Throws Error with the nearest name and the choices.
const NamedParam& find_param(const std::vector<NamedParam>& params, const std::string& name);

}  // namespace fulmar::core

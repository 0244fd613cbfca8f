// SPDX-License-Identifier: BSD-3-Clause
// Parameters in the form of the view of a running flight.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/graph/graph.hpp"

namespace fulmar::core {

/// Converts {"name": "roll_kp", "kind": "number", ...} of the view to the host's description of the
/// parameter. Throws Error.
ParamInfo param_info(const nlohmann::json& param);
ParamValue param_value(const ParamInfo& info, const nlohmann::json& value);

struct NamedParam {
  std::string component, use, name;  // "slc.roll_kp"
  bool vehicle = false, overlaid = false;
  ParamInfo info;
  ParamValue value;
  std::string text;  // exact
};
std::vector<NamedParam> params_of(const nlohmann::json& view);

}  // namespace fulmar::core

// SPDX-License-Identifier: BSD-3-Clause
// Parameters of a running flight, with displayed values and names.
#pragma once
#include <string>
#include <vector>

#include "tools/fulmar_save/named_params.hpp"

namespace fulmar::core {

/// Displayed text: angles in degrees, "40 deg"; and the range "2.9 .. 68.8 deg", "none light severe", ""
/// without a limit.
std::string shown_value(const ParamInfo& info, const ParamValue& value);
std::string shown_range(const ParamInfo& info);

/// Throws Error with the nearest name and the choices.
const NamedParam& find_param(const std::vector<NamedParam>& params, const std::string& name);

}  // namespace fulmar::core

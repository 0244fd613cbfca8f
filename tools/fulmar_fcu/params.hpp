// SPDX-License-Identifier: BSD-3-Clause
// The controller's parameters: reading all despite losses, reading one, setting one with a check.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "tools/fulmar_fcu/client.hpp"

namespace fulmar::fcu {

/// Reads all parameters, sorted by index, with repeated requests for lost ones. Throws Error when the list
/// stays incomplete.
std::vector<Param> read_params(Client& client,
                               const std::function<void(std::size_t have, std::size_t all)>& progress = {});

/// Reads one parameter. Throws Error with the nearest names for an unknown one.
Param read_param(Client& client, const std::string& name);
/// Reads those of `names` that exist, with the same time-outs. Missing ones are left out.
std::vector<Param> read_some(Client& client, const std::vector<std::string>& names);

/// Converts a text to a value of this parameter's type. Throws Error "...: FIXED_WING is a whole number, not
/// '1.5'".
std::uint32_t parse_value(const Param& param, const std::string& text);

/// Sets a parameter and reads it back until it has these bits. Throws Error when it does not. Returns false,
/// without sending, when it has them already.
bool set_param(Client& client, const Param& now, std::uint32_t bits);

/// "RC_ARM_CHN" matches "arm", "RC_*", "*CHN".
bool matches(const std::string& name, const std::string& pattern);

}  // namespace fulmar::fcu

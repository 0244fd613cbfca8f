// SPDX-License-Identifier: BSD-3-Clause
// Texts common to both forms of `fulmar inspect`.
#pragma once
#include <string>

#include "core/types/type.hpp"

namespace fulmar::core::inspect_text {

std::string number(double x);
std::string range(double min, double max);         // "0 .. 2", "" when there is none
std::string hash_text(std::uint64_t hash);         // 16 hex digits
std::string byte_text(std::uint32_t size);         // "24 bytes"
std::string port_kind(const Port& port);           // "value, optional", "queue of 16"
std::string initial_text(const ParamInfo& param);  // with its unit
std::string limits_text(const ParamInfo& param);   // range or choices
std::string element_text(const Field& field);      // "f64", "Waypoint"
std::string shape_text(const Field& field);        // "[3]" of an array, "[<=3]" of a list

}  // namespace fulmar::core::inspect_text

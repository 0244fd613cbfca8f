// SPDX-License-Identifier: BSD-3-Clause
// The "Tern", an invented aircraft of 3 kg: its coefficients, and files of it as the tools write them
// (tools/fulmar_aero/test/import), made from these coefficients by equations of their own.
#pragma once
#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "tools/fulmar_aero/import/import.hpp"

namespace fulmar::aero::test {

using namespace imports;

inline const std::string tern_folder = FULMAR_SOURCE_DIR "/tools/fulmar_aero/test/import/";

struct Truth {
  Force force;
  Term term;
  double value;
};
inline const std::vector<Truth> tern{
    {lift, t_zero, 0.25},    {lift, t_alpha, 4.8},     {lift, t_q, 7.5},        {lift, t_elevator, 0.42},
    {pitch, t_zero, 0.06},   {pitch, t_alpha, -0.9},   {pitch, t_q, -13.0},     {pitch, t_elevator, -1.2},
    {side, t_beta, -0.25},   {side, t_p, 0.02},        {side, t_r, 0.2},        {side, t_aileron, 0.01},
    {side, t_rudder, 0.15},  {roll, t_beta, -0.08},    {roll, t_p, -0.48},      {roll, t_r, 0.12},
    {roll, t_aileron, 0.25}, {roll, t_rudder, 0.005},  {yaw, t_beta, 0.08},     {yaw, t_p, -0.05},
    {yaw, t_r, -0.09},       {yaw, t_aileron, -0.008}, {yaw, t_rudder, -0.065}, {drag, t_elevator, 0.012}};

/// AVL prints control derivatives per degree with six decimals: 3e-5 per radian.
inline void is_tern(const Aircraft& a, double within = 6e-5) {
  for (const Truth& truth : tern) {
    const Value& value = a.c[truth.force][truth.term];
    const std::string what = std::string(force_symbol(truth.force)) + " " + std::to_string(int(truth.term)) +
                             " from " + value.from;
    CHECK_MESSAGE(value.known, what);
    CHECK_MESSAGE(std::abs(value.x - truth.value) <= within, what, ": ", value.x, " for ", truth.value);
  }
}

inline std::string text_in(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  REQUIRE_MESSAGE(!text.str().empty(), path);
  return text.str();
}
inline std::string tern_text(const std::string& name) { return text_in(tern_folder + name); }

inline std::string with(std::string text, const std::string& old, const std::string& by) {
  std::size_t at = text.find(old);
  REQUIRE_MESSAGE(at != std::string::npos, old);
  for (; at != std::string::npos; at = text.find(old, at + by.size())) text.replace(at, old.size(), by);
  return text;
}

/// Of texts, without a file.
inline Input read_text(const std::string& text, const std::string& name = "tern", double length_m = 0) {
  return read_any(lines_of(name, text), {length_m});
}
inline Aircraft aircraft(const std::vector<std::string>& texts, const ImportOptions& options = {}) {
  std::vector<Input> inputs;
  for (const std::string& text : texts)
    inputs.push_back(read_text(text, "file_" + std::to_string(inputs.size())));
  return aircraft_of(inputs, options);
}

/// The message of the rejection, "" for none.
template <class F>
std::string refusal(const F& read) {
  try {
    read();
  } catch (const core::Error& fault) {
    return fault.what();
  }
  return "";
}

inline bool says(const std::vector<std::string>& list, const std::string& words) {
  for (const std::string& one : list)
    if (one.find(words) != std::string::npos) return true;
  return false;
}
inline bool says(const std::string& text, const std::string& words) {
  return text.find(words) != std::string::npos;
}

/// The codes of files that are cut off, or have a decimal comma.
inline const std::string incomplete =
    " cell_count_mismatch column_missing control_derivatives_missing control_groups_missing "
    "count_missing decimal_comma derivative_count_mismatch derivative_row_missing "
    "derivative_table_missing document_end_missing drag_table_missing eigenvalue_row_invalid "
    "element_not_closed entries_missing format_unknown gain_count_mismatch labelled_line_missing "
    "labelled_number_missing log_control_missing longitudinal_derivatives_missing pair_missing "
    "polar_heading_missing result_count_mismatch result_name_missing result_row_missing "
    "row_incomplete rows_missing run_unit_unknown tag_not_closed derivatives_missing "
    "result_number_expected three_numbers_expected number_expected ";

inline bool is_incomplete(const std::string& refused) {
  const std::size_t at = refused.find("aero.");
  if (at == std::string::npos) return false;
  const std::string code = refused.substr(at + 5, refused.find_first_of("(\n", at) - at - 5);
  return says(incomplete, " " + code + " ");
}

}  // namespace fulmar::aero::test

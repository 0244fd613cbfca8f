// SPDX-License-Identifier: BSD-3-Clause
// Gains in the section `params` of an airframe file.
#pragma once
#include <string>
#include <vector>

#include "tools/fulmar_aero/airframe_file.hpp"
#include "tools/fulmar_aero/laws.hpp"

namespace fulmar::aero {

struct Gain {
  std::string component, name, unit;
  double value = 0;
};

/// True when the file has parameters of these laws, and the laws with them and their defaults. Throws
/// core::Error for an unknown key or a value out of its range.
struct FileLaws {
  bool given = false;
  Laws laws;
};
FileLaws laws_in(const AirframeFile& file);

/// Gains that `fulmar aero tune` computes, in the order of the file.
std::vector<Gain> computed_gains(const Laws& laws, bool yaw_damper);

/// "1.2", as in a file.
std::string gain_text(double value);
/// The section as YAML.
std::string params_text(const std::vector<Gain>& gains);
/// The file's text with these gains: present values are replaced, missing ones added, all else stays. Throws
/// core::Error when the section has a form that is not edited here.
std::string with_gains(const AirframeFile& file, const std::string& text, const std::vector<Gain>& gains);

}  // namespace fulmar::aero

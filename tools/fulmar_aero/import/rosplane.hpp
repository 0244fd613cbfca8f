// SPDX-License-Identifier: BSD-3-Clause
// A folder of ROSplane's and ROSflight's parameter, gain and mission files.
#pragma once
#include "tools/fulmar_aero/import/airframe_yaml.hpp"

namespace fulmar::aero::imports {

struct OutFile {
  std::string name, text;
};
struct RosplaneSet {
  Imported airframe;
  std::vector<OutFile> files;      ///< airframe, plans and missions, to be written into one folder
  std::vector<std::string> notes;  ///< parts that were read, changed or left out
  std::vector<std::string> doubts;
};

/// Throws core::Error: no aircraft or several, a mission that cannot be read.
RosplaneSet rosplane_set(const std::string& folder);

}  // namespace fulmar::aero::imports

// SPDX-License-Identifier: BSD-3-Clause
// The tool's own eigenvalues beside those of Fulmar's model with what was imported: an axis, a sign, a unit
// or a reference length that was taken wrong shows here.
#pragma once
#include "tools/fulmar_aero/import/airframe_yaml.hpp"

namespace fulmar::aero::imports {

struct ModePair {
  std::string name;                ///< "short period"
  std::complex<double> tool, own;  ///< 1/s
  double off_ratio = 0;  ///< |own - tool| / |tool|; of AVL's, which counts apparent mass, of the sizes
  double max_ratio = 0;  ///< what is allowed; 0: nothing is, it is only shown
  bool agrees() const { return max_ratio <= 0 || off_ratio <= max_ratio; }
};
struct ModeComparison {
  std::vector<ModePair> pairs;
  double airspeed_mps = 0;
  std::string fault;  ///< why there is none, "" when there is
};
ModeComparison compare_modes(const Imported& imported);

}  // namespace fulmar::aero::imports

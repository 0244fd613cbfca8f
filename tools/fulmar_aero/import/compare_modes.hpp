// SPDX-License-Identifier: BSD-3-Clause
// Comparison of the tool's eigenvalues with those of Fulmar's model of the imported aircraft. It shows errors
// of an axis, a sign, a unit or a reference length.
#pragma once
#include "tools/fulmar_aero/import/airframe_yaml.hpp"

namespace fulmar::aero::imports {

struct ModePair {
  std::string name;                ///< "short period"
  std::complex<double> tool, own;  ///< 1/s
  double off_ratio = 0;            ///< |own - tool| / |tool|; for AVL, with apparent mass, of the magnitudes
  double max_ratio = 0;            ///< tolerance; 0: only shown
  bool agrees() const { return max_ratio <= 0 || off_ratio <= max_ratio; }
};
struct ModeComparison {
  std::vector<ModePair> pairs;
  double airspeed_mps = 0;
  std::string fault;  ///< reason why there is no comparison, "" for one
};
ModeComparison compare_modes(const Imported& imported);

}  // namespace fulmar::aero::imports

// SPDX-License-Identifier: BSD-3-Clause
// Plugin of the SDK's estimator; README.md has the equations.
#include <fulmar/flight/navigation/estimator.hpp>

using fulmar::navigation::Ekf;
FULMAR_PLUGIN("1.0.0", Ekf)

// SPDX-License-Identifier: BSD-3-Clause
// Plugin of the estimator; README.md has the equations.
#include "ekf.hpp"

using fulmar::estimator::Ekf;
FULMAR_PLUGIN("1.0.0", Ekf)

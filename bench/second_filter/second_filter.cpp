// SPDX-License-Identifier: BSD-3-Clause
// Plugin of the second formulation of the estimator, for benches: --with PLUGIN.so.
#include "bench/second_filter/published.hpp"

using fulmar::second_filter::Ekf;
FULMAR_PLUGIN("1.0.0", Ekf)

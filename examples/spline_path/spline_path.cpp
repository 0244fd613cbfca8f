// SPDX-License-Identifier: BSD-3-Clause
#include "spline_follower.hpp"
#include "spline_manager.hpp"

FULMAR_PLUGIN("1.0.0", SplineManager, SplineFollower)

// SPDX-License-Identifier: BSD-3-Clause
#include "lqr.hpp"

FULMAR_PLUGIN("1.0.0", Lqr)

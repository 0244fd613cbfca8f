// SPDX-License-Identifier: BSD-3-Clause
#include "l1_guide.hpp"

FULMAR_PLUGIN("1.0.0", L1Guide)

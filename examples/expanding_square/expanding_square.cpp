// SPDX-License-Identifier: BSD-3-Clause
#include "expanding_square.hpp"

FULMAR_PLUGIN("1.0.0", ExpandingSquare)

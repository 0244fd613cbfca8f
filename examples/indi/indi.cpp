// SPDX-License-Identifier: BSD-3-Clause
#include "indi.hpp"

FULMAR_PLUGIN("1.0.0", Indi)

// SPDX-License-Identifier: BSD-3-Clause
#include "my_law.hpp"

FULMAR_PLUGIN("1.0.0", MyLaw)

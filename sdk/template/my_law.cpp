// SPDX-License-Identifier: BSD-3-Clause
#include "my_law.hpp"

FULMAR_PLUGIN("0.1.0", MyLaw)

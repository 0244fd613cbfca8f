// SPDX-License-Identifier: BSD-3-Clause
#include "tampered.hpp"

FULMAR_PLUGIN("1.0.0", fulmar::tampered::Wires)

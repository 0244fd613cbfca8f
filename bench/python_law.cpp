// SPDX-License-Identifier: BSD-3-Clause
// The law of examples/python/my_law.py in C++, with the same ports, as the reference of bench_python.
#include "sdk/template/roles/outer.hpp"

FULMAR_PLUGIN("1.0.0", MyLaw)

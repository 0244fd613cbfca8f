// SPDX-License-Identifier: BSD-3-Clause
// The same kind of law as examples/python/my_law.py in C++, with the same ports: what bench_python compares
// with.
#include "sdk/template/roles/outer.hpp"

FULMAR_PLUGIN("1.0.0", MyLaw)

// SPDX-License-Identifier: BSD-3-Clause
// ROSplane's documented laws as components: what bench_laws compares Fulmar's with.
#include "controller.hpp"
#include "follower.hpp"

using namespace fulmar;
FULMAR_PLUGIN("1.0.0", rosplane::Controller, rosplane::Follower)

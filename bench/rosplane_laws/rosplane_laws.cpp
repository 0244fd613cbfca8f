// SPDX-License-Identifier: BSD-3-Clause
// ROSplane's documented laws as components, as the reference of bench_laws.
#include "controller.hpp"
#include "follower.hpp"

using namespace fulmar;
FULMAR_PLUGIN("1.0.0", rosplane::Controller, rosplane::Follower)

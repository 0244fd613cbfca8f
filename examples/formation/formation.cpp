// SPDX-License-Identifier: BSD-3-Clause
// Several aircraft: what is known of another one, and a slot beside it.
#include "follower.hpp"
#include "neighbour.hpp"

using namespace fulmar::formation;

FULMAR_PLUGIN("1.0.0", Neighbour, Follower)

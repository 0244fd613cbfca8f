// SPDX-License-Identifier: BSD-3-Clause
// Several aircraft: the state of another one, and a slot relative to it.
#include "follower.hpp"
#include "neighbour.hpp"

using namespace fulmar::formation;

FULMAR_PLUGIN("1.0.0", Neighbour, Follower)

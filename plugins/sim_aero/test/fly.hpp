// SPDX-License-Identifier: BSD-3-Clause
// A bench with the aircraft in it, for the tests.
#pragma once
#include "fulmar/testing.hpp"
#include "plugins/sim_aero/aircraft.hpp"
#include "sdk/test/sim/anaconda.hpp"

namespace fulmar::sim {

/// Reads and writes once: the given actuators, or silence.
inline void pass(Bench<Aircraft>& bench, const Actuators* actuators = nullptr) {
  if (bench.read() == Status::failed) throw std::runtime_error(bench.error());
  if (actuators) bench.set(bench.in.actuators, *actuators);
  bench.write();
}

inline void arm(Bench<Aircraft>& bench) { bench.push(bench.in.arm, ArmRequest{true}); }

}  // namespace fulmar::sim

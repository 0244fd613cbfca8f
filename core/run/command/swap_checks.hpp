// SPDX-License-Identifier: BSD-3-Clause
// Checks and rehearsal for the replacement of a component's file between flights.
#pragma once
#include <string>

#include "core/run/component/tape.hpp"
#include "core/run/component/unit.hpp"

namespace fulmar::core {

/// Creates and configures the component in a child and steps it through the last inputs of its predecessor.
/// Throws Error: a constructor that throws, rejected parameters, an output that is not finite, a crash, a
/// hang. `tape` may be nullptr when there was no step yet.
void rehearse(const Component& component, std::int64_t tick_ns, std::uint64_t seed, const Tape* tape);

/// Whether the recorded inputs of one component fit the other.
bool same_inputs(const ComponentInfo& a, const ComponentInfo& b);

/// Whether the inputs from outside, requests and imports, are the same in order.
bool same_entrances(const Component& a, const Component& b);

/// Throws Error when the code of `was` could not be unloaded: `is` would then run it.
void check_unloads(const PluginInfo& was, const ComponentInfo& component);

/// Copies base parameters of the same name and kind from the predecessor. Returns the unexpected changes of
/// parameters by the swap: "keeps law_gain = 7 (new default 5); new: lag = 1 s; gone: lead". `into`: the new
/// values before the copy.
std::string parameter_words(const ComponentInfo& from, const std::vector<ParamValue>& values,
                            const ComponentInfo& to, const std::vector<ParamValue>& into);
void carry_parameters(const ComponentInfo& from, const std::vector<ParamValue>& values,
                      const ComponentInfo& to, std::vector<ParamValue>& into);

/// Why `next` cannot replace `now` in a running flight: other components, roles, wires or order. "" when it
/// can.
std::string structural_difference(const Graph& now, const Graph& next);

/// "my_law.so 1.0.0 (0123456789ab)"
std::string version_words(const PluginInfo& plugin);

}  // namespace fulmar::core

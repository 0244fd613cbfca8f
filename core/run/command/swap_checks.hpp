// SPDX-License-Identifier: BSD-3-Clause
// Replaces the file of a component between flights: what is checked, how it is rehearsed.
#pragma once
#include <string>

#include "core/run/component/tape.hpp"
#include "core/run/component/unit.hpp"

namespace fulmar::core {

/// Creates and configures the component in a child and steps it through what its predecessor saw last. Throws
/// Error with a sentence: a constructor that throws, refused parameters, an output that is not finite, a
/// crash, a hang. `tape` may be nullptr: nobody has stepped yet.
void rehearse(const Component& component, std::int64_t tick_ns, std::uint64_t seed, const Tape* tape);

/// Whether what one has seen can be shown to the other.
bool same_inputs(const ComponentInfo& a, const ComponentInfo& b);

/// Whether what comes in from outside, requests and imported inputs, is the same in order.
bool same_entrances(const Component& a, const Component& b);

/// Throws Error when the code of `was` could not be unloaded, so that `is` would fly it.
void check_unloads(const PluginInfo& was, const ComponentInfo& component);

/// Base parameters of the same name and kind, from the predecessor.
/// What a swap did to the parameters that its user may not expect: "keeps law_gain = 7 (new default 5); new:
/// lag = 1 s; gone: lead". `into`: the newcomer's values before they are carried over.
std::string parameter_words(const ComponentInfo& from, const std::vector<ParamValue>& values,
                            const ComponentInfo& to, const std::vector<ParamValue>& into);
void carry_parameters(const ComponentInfo& from, const std::vector<ParamValue>& values,
                      const ComponentInfo& to, std::vector<ParamValue>& into);

/// Why `next` cannot take the place of `now` in a flight that goes on: other components, roles, wires or
/// order. "" when it can.
std::string structural_difference(const Graph& now, const Graph& next);

/// "my_law.so 1.0.0 (0123456789ab)"
std::string version_words(const PluginInfo& plugin);

}  // namespace fulmar::core

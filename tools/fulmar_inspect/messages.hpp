// SPDX-License-Identifier: BSD-3-Clause
// The messages of this folder: code, arguments, sentence (fulmar/diagnostic.hpp).
#pragma once
#include "fulmar/diagnostic.hpp"

namespace fulmar::inspect_messages {

inline constexpr MessageText driver_thread{"inspect.driver_thread", "in a thread of its own"};
inline constexpr MessageText event_output_kind{"inspect.event_output_kind", "value, not in every step"};
inline constexpr MessageText format_unknown{
    "inspect.format_unknown", {"format", "choices"}, "unknown format '{format}'.{choices}"};
inline constexpr MessageText input_without_source{
    "inspect.input_without_source",
    {"input", "output", "type", "wiring"},
    "{input} has no source; {output} gives {type}. Wire it, as in {wiring}"};
inline constexpr MessageText output_without_reader{
    "inspect.output_without_reader",
    {"output", "input", "type", "wiring"},
    "{output} has no reader; {input} accepts {type}. Wire it, as in {wiring}"};
inline constexpr MessageText rate_in_child{"inspect.rate_in_child", {"rate"}, "{rate}, in a child process"};
inline constexpr MessageText replaced_component_read{
    "inspect.replaced_component_read",
    {"reader", "component", "mission", "successors"},
    "{reader} reads {component}, which steers in {mission} and not here. Connect {reader} to {successors}, "
    "which steers here"};
inline constexpr MessageText report_list_incomplete{
    "inspect.report_list_incomplete",
    {"port", "place"},
    "{port} is missing, which {place} lists. This list replaces that one; add {port} here"};

}  // namespace fulmar::inspect_messages

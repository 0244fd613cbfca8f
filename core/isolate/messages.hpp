// SPDX-License-Identifier: BSD-3-Clause
// The messages of this folder: code, arguments, sentence (fulmar/diagnostic.hpp).
#pragma once
#include "fulmar/diagnostic.hpp"

namespace fulmar::isolate_messages {

inline constexpr MessageText aborted{"isolate.aborted", "aborted"};
inline constexpr MessageText arithmetic_error{"isolate.arithmetic_error", "crashed (arithmetic error)"};
inline constexpr MessageText bus_error{"isolate.bus_error", "crashed (bus error)"};
inline constexpr MessageText child_exited{
    "isolate.child_exited", {"code"}, "ended itself (exit code {code})"};
inline constexpr MessageText child_gone{"isolate.child_gone", "has ended"};
inline constexpr MessageText child_hung{"isolate.child_hung", {"limit"}, "hung: no answer within {limit} ms"};
inline constexpr MessageText child_killed{"isolate.child_killed", {"signal"}, "was killed (signal {signal})"};
inline constexpr MessageText child_program_missing{
    "isolate.child_program_missing",
    "the program fulmar-child is missing, so no component can run in a separate process. Install Fulmar "
    "again, or build it: cmake --build build --target flight"};
inline constexpr MessageText child_stopped{
    "isolate.child_stopped", {"file", "reason", "stage"}, "{file} {reason} while being {stage}"};
inline constexpr MessageText child_version_differs{
    "isolate.child_version_differs",
    "fulmar-child and the host have different versions; build or install both together"};
inline constexpr MessageText component_moved{"isolate.component_moved",
                                             {"file", "component", "index"},
                                             "{file} no longer has the component '{component}' at index "
                                             "{index}: its copy has changed. Start the flight again"};
inline constexpr MessageText component_name_too_long{"isolate.component_name_too_long",
                                                     "the component's name is longer than 255 bytes."};
inline constexpr MessageText constructor_failed{"isolate.constructor_failed",
                                                "the constructor failed and gives no reason"};
inline constexpr MessageText fork_refused{
    "isolate.fork_refused", {"function", "reason"}, "calls {function} in flight; {reason}"};
inline constexpr MessageText host_abi_differs{
    "isolate.host_abi_differs",
    "the host of the script has another ABI; build it with the SDK of this Fulmar"};
inline constexpr MessageText illegal_instruction{"isolate.illegal_instruction",
                                                 "crashed (illegal instruction)"};
inline constexpr MessageText memory_not_shared{
    "isolate.memory_not_shared", {"size", "reason"}, "cannot share {size} bytes with a child: {reason}."};
inline constexpr MessageText not_created{"isolate.not_created", {"reason"}, "cannot be created: {reason}"};
inline constexpr MessageText parameters_not_readable{
    "isolate.parameters_not_readable", {"reason"}, "the parameters cannot be read: {reason}"};
inline constexpr MessageText segmentation_fault{"isolate.segmentation_fault", "crashed (segmentation fault)"};
inline constexpr MessageText stack_overflowed{"isolate.stack_overflowed", "crashed (stack overflow)"};
inline constexpr MessageText tables_differ{"isolate.tables_differ",
                                           {"component"},
                                           "the ports or parameters of '{component}' differ from those that "
                                           "the host read. Make them the same in every load of the plugin"};
inline constexpr MessageText text_too_long{"isolate.text_too_long",
                                           "a text parameter is longer than its capacity"};
inline constexpr MessageText vehicle_not_isolated{
    "isolate.vehicle_not_isolated",
    "a vehicle cannot run in a separate process: remove 'run: process' from the component"};

}  // namespace fulmar::isolate_messages

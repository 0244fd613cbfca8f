// SPDX-License-Identifier: BSD-3-Clause
// The messages of this folder: code, arguments, sentence (fulmar/diagnostic.hpp).
#pragma once
#include "fulmar/diagnostic.hpp"

namespace fulmar::module_messages {

inline constexpr MessageText answer_pending{"module.answer_pending", "<not answered yet>"};
inline constexpr MessageText dotted_name_expected{"module.dotted_name_expected",
                                                  {"name", "kind", "suffix"},
                                                  "'{name}' is not a {kind}; write component.{suffix}"};
inline constexpr MessageText flight_over{"module.flight_over",
                                         "the flight is over; call reset(), or make another Sim"};
inline constexpr MessageText reset_with_log{
    "module.reset_with_log",
    {"log"},
    "the log {log} holds the previous flight. A flight with a log cannot be reset; make another Sim"};
inline constexpr MessageText step_negative{
    "module.step_negative", {"count"}, "step {count}: the number of steps is negative; give 0 or more"};

}  // namespace fulmar::module_messages

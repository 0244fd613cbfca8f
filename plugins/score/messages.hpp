// SPDX-License-Identifier: BSD-3-Clause
// The messages of this folder: code, arguments, sentence (fulmar/diagnostic.hpp).
#pragma once
#include "fulmar/diagnostic.hpp"

namespace fulmar::score_messages {

inline constexpr MessageText answered{"score.answered", {"answer", "time"}, "{answer} at {time} s"};
inline constexpr MessageText answered_because{
    "score.answered_because", {"answer", "time", "cause"}, "{answer} at {time} s ({cause})"};
inline constexpr MessageText crashed{
    "score.crashed",
    {"part", "time", "sink", "bank", "ground_speed", "north", "north_side", "east", "east_side"},
    "{part} touched at {time} s, sink {sink} m/s, bank {bank} deg, {ground_speed} m/s over ground, {north} m "
    "{north_side} and {east} m {east_side}"};
inline constexpr MessageText crashed_after{
    "score.crashed_after", {"crash", "answers"}, "{crash}; before: {answers}"};
inline constexpr MessageText descent{"score.descent", "descent without motor"};
inline constexpr MessageText glide{"score.glide", "glide"};
inline constexpr MessageText go_on{"score.go_on", "go on"};
inline constexpr MessageText home{"score.home", "return home"};
inline constexpr MessageText land{"score.land", "return and land"};
inline constexpr MessageText never_airborne{"score.never_airborne", "never left the ground"};
inline constexpr MessageText part_unknown{"score.part_unknown", "an unknown part"};
inline constexpr MessageText wait{"score.wait", "circle and wait"};
inline constexpr MessageText wings_level{"score.wings_level", "wings level"};

}  // namespace fulmar::score_messages

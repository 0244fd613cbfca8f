// SPDX-License-Identifier: BSD-3-Clause
// The messages of this folder: code, arguments, sentence (fulmar/diagnostic.hpp).
#pragma once
#include "fulmar/diagnostic.hpp"

namespace fulmar::replay_messages {

inline constexpr MessageText baseline_differs{"replay.baseline_differs",
                                              "without the change, too, the replay differs from the log"};
inline constexpr MessageText change_without_effect{
    "replay.change_without_effect",
    {"change", "component", "kind"},
    "{change} would change nothing: {component} is {kind}, and in a replay its samples come out of the log. "
    "Fly the mission anew with fulmar run"};
inline constexpr MessageText estimates_not_compared{
    "replay.estimates_not_compared", {"reason"}, "the estimates are not compared: {reason}"};
inline constexpr MessageText first_tick_missing{
    "replay.first_tick_missing",
    {"tick"},
    "the log begins with tick {tick} of its flight; a replay begins with the first: give the file before it"};
inline constexpr MessageText folder_not_creatable{
    "replay.folder_not_creatable", {"folder"}, "cannot make a folder in {folder}"};
inline constexpr MessageText log_changed{"replay.log_changed",
                                         "the log has changed since its flight began to be replayed"};
inline constexpr MessageText mission_missing{"replay.mission_missing",
                                             "no mission is attached to it: it is not the log of a flight"};
inline constexpr MessageText overrides_not_recorded{
    "replay.overrides_not_recorded",
    "it does not say how its mission was changed on the command line: it is older than replays"};
inline constexpr MessageText plugin_not_recorded{
    "replay.plugin_not_recorded", {"component"}, "it does not say which plugin flew as '{component}'"};
inline constexpr MessageText plugins_not_recorded{"replay.plugins_not_recorded",
                                                  "it does not say which plugins flew"};
inline constexpr MessageText probes_mismatch{
    "replay.probes_mismatch", {"vehicle"}, "the log has other probes of {vehicle}"};
inline constexpr MessageText record_without_log{"replay.record_without_log",
                                                "--record needs --log FILE: the replay's own log holds more"};
inline constexpr MessageText replay_interrupted{"replay.replay_interrupted", "interrupted"};
inline constexpr MessageText replay_log_failed{
    "replay.replay_log_failed", {"reason"}, "the replay's log: {reason}"};
inline constexpr MessageText samples_between_ticks{
    "replay.samples_between_ticks", {"topic"}, "the log has samples of {topic} between two ticks"};
inline constexpr MessageText samples_lost{
    "replay.samples_lost", {"count", "topic"}, "the log has lost {count} samples of {topic}"};
inline constexpr MessageText tick_gap_too_large{
    "replay.tick_gap_too_large",
    {"limit"},
    "the log holds more than {limit} MB between two messages about its ticks"};
inline constexpr MessageText ticks_empty{"replay.ticks_empty", "the log holds no tick"};
inline constexpr MessageText ticks_lost{
    "replay.ticks_lost",
    {"begin", "end"},
    "the log has lost its ticks {begin} to {end}: it can be replayed no further than that"};
inline constexpr MessageText ticks_missing{
    "replay.ticks_missing", "the log has no /fulmar/ticks: it is not a flight's, or older than replays"};
inline constexpr MessageText ticks_not_in_order{"replay.ticks_not_in_order",
                                                "the log's ticks are not in order"};
inline constexpr MessageText too_many_events{
    "replay.too_many_events",
    {"limit"},
    "the log tells of more guards, signals and late results than the {limit} MB that a replay has room for"};
inline constexpr MessageText too_many_samples{
    "replay.too_many_samples",
    {"port"},
    "the log has more samples of {port} in a tick than there is room for"};
inline constexpr MessageText topic_not_in_order{
    "replay.topic_not_in_order", {"topic"}, "the log's {topic} is not in the order of time"};
inline constexpr MessageText topic_type_mismatch{
    "replay.topic_type_mismatch",
    {"topic", "type"},
    "the log's {topic} has other fields than {type} has here: it was written by another version"};

}  // namespace fulmar::replay_messages

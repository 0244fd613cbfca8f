// SPDX-License-Identifier: BSD-3-Clause
// The messages of this folder: code, arguments, sentence (fulmar/diagnostic.hpp).
#pragma once
#include "fulmar/diagnostic.hpp"

namespace fulmar::replay_messages {

inline constexpr MessageText baseline_differs{
    "replay.baseline_differs",
    "the replay differs from the log even without the change, so not every difference comes from the change"};
inline constexpr MessageText change_without_effect{
    "replay.change_without_effect",
    {"change", "component", "kind"},
    "{change} would change nothing: {component} is {kind}, and a replay takes its samples from the log. Fly "
    "the mission again with fulmar run"};
inline constexpr MessageText estimates_not_compared{
    "replay.estimates_not_compared", {"reason"}, "the estimates are not compared: {reason}"};
inline constexpr MessageText file_space_missing{
    "replay.file_space_missing", "there is no space for a temporary file; free some on the disk"};
inline constexpr MessageText first_tick_missing{
    "replay.first_tick_missing",
    {"tick"},
    "the log begins with tick {tick} of its flight, but a replay begins with tick 0. Replay the whole log, "
    "or the first file of a split log"};
inline constexpr MessageText folder_not_creatable{
    "replay.folder_not_creatable",
    {"folder", "reason"},
    "cannot make a folder in {folder}: {reason}. Set TMPDIR to another folder"};
inline constexpr MessageText input_not_repeatable{"replay.input_not_repeatable",
                                                  {"tick", "reason"},
                                                  "the input before tick {tick} is not repeatable: {reason}"};
inline constexpr MessageText log_changed{
    "replay.log_changed",
    "the log has changed since the replay began; replay it when no program writes to it"};
inline constexpr MessageText log_cut_off{
    "replay.log_cut_off",
    {"time_s"},
    "the log is cut off: the comparison ends with its last whole tick, at {time_s} s"};
inline constexpr MessageText log_program_missing{
    "replay.log_program_missing",
    "the program fulmar-log is missing beside this one. Install Fulmar again, or build it: cmake --build "
    "build --target flight"};
inline constexpr MessageText mission_missing{
    "replay.mission_missing",
    "the log has no attached mission: it is not the log of a flight. Name a log that fulmar run wrote"};
inline constexpr MessageText overrides_not_recorded{
    "replay.overrides_not_recorded",
    "the log does not state the command-line changes of its mission: it is older than the replay function. "
    "Fly the mission again"};
inline constexpr MessageText plugin_not_recorded{
    "replay.plugin_not_recorded",
    {"component"},
    "the log does not name the plugin file and checksum of '{component}', so it cannot be replayed. Fly the "
    "mission again"};
inline constexpr MessageText plugin_replaced{
    "replay.plugin_replaced",
    {"component", "plugin", "version", "sha256"},
    "{component}: {plugin} {version} with SHA-256 {sha256} flies in its place"};
inline constexpr MessageText plugins_not_recorded{
    "replay.plugins_not_recorded",
    "the log does not state the plugins of the flight, so it cannot be replayed. Fly the mission again"};
inline constexpr MessageText probes_mismatch{
    "replay.probes_mismatch",
    {"vehicle", "found", "expected", "plugin"},
    "{vehicle}: the log has {found} probes, and the plugin {plugin} has {expected}. Replay the log with the "
    "plugin that recorded it."};
inline constexpr MessageText record_without_log{
    "replay.record_without_log", "--record requires --log FILE: it adds ports to the replay's own log"};
inline constexpr MessageText replay_interrupted{"replay.replay_interrupted", "interrupted"};
inline constexpr MessageText replay_log_failed{
    "replay.replay_log_failed", {"reason"}, "the log of the replay is not complete: {reason}"};
inline constexpr MessageText samples_between_ticks{
    "replay.samples_between_ticks",
    {"topic"},
    "the log has samples of {topic} between two ticks, so it cannot be replayed. Fly the mission again"};
inline constexpr MessageText samples_lost{
    "replay.samples_lost",
    {"count", "topic"},
    "the log lacks {count} samples of {topic}, so the replay would differ; replay a log without losses"};
inline constexpr MessageText tick_gap_too_large{"replay.tick_gap_too_large",
                                                {"limit"},
                                                "the log holds more than {limit} MB between two messages "
                                                "about its ticks, the limit of a replay. Record fewer ports"};
inline constexpr MessageText ticks_empty{
    "replay.ticks_empty",
    "the log holds no tick, so there is nothing to replay. Name the log of a longer flight"};
inline constexpr MessageText ticks_lost{
    "replay.ticks_lost",
    {"begin", "end", "time_s"},
    "the log lacks the ticks {begin} to {end}, after {time_s} s, because it was damaged. A replay requires "
    "every tick. Replay an undamaged copy, or fly the mission again"};
inline constexpr MessageText ticks_missing{"replay.ticks_missing",
                                           "the log has no /fulmar/ticks: it is not the log of a flight, or "
                                           "it is older than the replay function. Fly the mission again"};
inline constexpr MessageText ticks_not_in_order{
    "replay.ticks_not_in_order",
    "the log's ticks are not in order, so it cannot be replayed. Replay the log as fulmar run wrote it"};
inline constexpr MessageText too_many_events{"replay.too_many_events",
                                             {"limit"},
                                             "the log holds more than {limit} MB of guards, signals and late "
                                             "results, the limit of a replay. Replay a shorter flight"};
inline constexpr MessageText too_many_samples{"replay.too_many_samples",
                                              {"port"},
                                              "the log has more samples of {port} in one tick than the port "
                                              "holds. Replay it with the plugin that recorded it"};
inline constexpr MessageText topic_not_in_order{
    "replay.topic_not_in_order",
    {"topic"},
    "the messages of {topic} in the log are not in order of time, so it cannot be replayed. Replay the log "
    "as fulmar run wrote it"};
inline constexpr MessageText topic_type_mismatch{
    "replay.topic_type_mismatch",
    {"topic", "type"},
    "{topic} in the log has other fields than {type} now. Replay the log with the release and the plugins "
    "that wrote it"};

}  // namespace fulmar::replay_messages

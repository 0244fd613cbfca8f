// SPDX-License-Identifier: BSD-3-Clause
// The messages of this folder: code, arguments, sentence (fulmar/diagnostic.hpp).
#pragma once
#include "fulmar/diagnostic.hpp"

namespace fulmar::sensor_log_messages {

inline constexpr MessageText chunk_checksum_wrong{
    "sensor_log.chunk_checksum_wrong", "a chunk is damaged: its checksum is not that of its content"};
inline constexpr MessageText chunk_damaged{"sensor_log.chunk_damaged", "a chunk is damaged"};
inline constexpr MessageText chunk_packing_unsupported{
    "sensor_log.chunk_packing_unsupported",
    {"packing"},
    "a chunk is packed with '{packing}'. Valid: zstd, or none"};
inline constexpr MessageText chunk_too_large{"sensor_log.chunk_too_large", "a chunk of more than 1 GB"};
inline constexpr MessageText column_not_named{
    "sensor_log.column_not_named", {"file"}, "names no column of {file}; valid is one of its first line"};
inline constexpr MessageText column_of_topic_not_named{
    "sensor_log.column_of_topic_not_named",
    {"file"},
    "names no column of {file}, and a topic of this type has no usual one"};
inline constexpr MessageText column_repeated{
    "sensor_log.column_repeated", {"place", "column"}, "{place} names two columns '{column}'"};
inline constexpr MessageText column_unknown{"sensor_log.column_unknown",
                                            {"column", "place", "known"},
                                            "no column '{column}' in {place}; there are {known}"};
inline constexpr MessageText data_cut{"sensor_log.data_cut", "the file ends early, or is damaged"};
inline constexpr MessageText data_without_end{"sensor_log.data_without_end",
                                              "the file ends early: its data has no end"};
inline constexpr MessageText encoding_unsupported{
    "sensor_log.encoding_unsupported",
    {"topic", "encoding", "schema"},
    "'{topic}' is encoded as '{encoding}' with a schema '{schema}'. Valid: cdr with ros2msg"};
inline constexpr MessageText file_cut{"sensor_log.file_cut",
                                      {"file", "byte", "time"},
                                      "{file}: cut off: byte {byte}, at {time}; read up to there"};
inline constexpr MessageText file_damaged{
    "sensor_log.file_damaged",
    {"file", "byte", "reason"},
    "{file} is damaged at byte {byte}: {reason}. Copy it again from its source, or name another file"};
inline constexpr MessageText file_empty{
    "sensor_log.file_empty", {"file"}, "{file} is empty; its first line has to name the columns"};
inline constexpr MessageText file_ends_early{
    "sensor_log.file_ends_early",
    {"place", "time", "wanted"},
    "{place}: the file ends early, at {time}; `use:` wants it to {wanted}"};
inline constexpr MessageText file_kind_unknown{
    "sensor_log.file_kind_unknown",
    {"file"},
    "'{file}' is no kind of file that can be read: *.csv, *.mcap, *.ulg"};
inline constexpr MessageText file_missing{
    "sensor_log.file_missing",
    {"file"},
    "{file} cannot be read; --set recorded.folder=FOLDER says where the files are"};
inline constexpr MessageText file_not_mcap{"sensor_log.file_not_mcap", {"file"}, "{file} is no MCAP file"};
inline constexpr MessageText file_not_named{
    "sensor_log.file_not_named", {"sensor"}, "names no file. Name the file of {sensor}, or remove {sensor}"};
inline constexpr MessageText file_not_ulog{"sensor_log.file_not_ulog", {"file"}, "{file} is no ULog"};
inline constexpr MessageText file_unreadable{"sensor_log.file_unreadable",
                                             {"file", "reason"},
                                             "{file} cannot be read: {reason}. Name a file that can be read"};
inline constexpr MessageText folder_missing{
    "sensor_log.folder_missing",
    {"files"},
    "is not given; --set recorded.folder=FOLDER says where {files} are"};
inline constexpr MessageText format_empty{
    "sensor_log.format_empty", {"file", "type"}, "{file}: the format of '{type}' has no field"};
inline constexpr MessageText format_missing{
    "sensor_log.format_missing", {"file", "type"}, "{file} has no format of '{type}'"};
inline constexpr MessageText format_too_large{"sensor_log.format_too_large",
                                              {"file", "type", "field"},
                                              "{file}: '{type} {field}' is more than a message can hold"};
inline constexpr MessageText last_line_cut{
    "sensor_log.last_line_cut",
    {"place"},
    "{place}: the file ends early: its last line is not ended; every row ends with a line break"};
inline constexpr MessageText log_too_new{"sensor_log.log_too_new",
                                         "the log is of a later kind, which cannot be read"};
inline constexpr MessageText message_cut{
    "sensor_log.message_cut",
    {"count", "left"},
    "a list of {count} items is longer than the message, which has {left} bytes left; the file is damaged, "
    "or its message definition is wrong"};
inline constexpr MessageText message_not_xcdr{"sensor_log.message_not_xcdr",
                                              "the message is no little-endian XCDR1"};
inline constexpr MessageText number_missing{"sensor_log.number_missing", "no number"};
inline constexpr MessageText number_not_valid{"sensor_log.number_not_valid",
                                              {"place", "found", "column"},
                                              "{place}: '{found}' in column '{column}' is no number"};
inline constexpr MessageText recording_ended{
    "sensor_log.recording_ended",
    "the recording has ended, and the mission goes on: its `done:` is vehicle.recording.ended"};
inline constexpr MessageText row_cut{"sensor_log.row_cut",
                                     {"place", "cells", "columns"},
                                     "{place}: {cells} cells where the first line names {columns} columns: "
                                     "the file ends early, or the row is cut"};
inline constexpr MessageText row_left_out{"sensor_log.row_left_out",
                                          {"file", "line", "reasons"},
                                          "{file}: left out 1 row, the first is {line}: {reasons}"};
inline constexpr MessageText row_of_one_cell{
    "sensor_log.row_of_one_cell",
    {"place", "columns"},
    "{place}: 1 cell where the first line names {columns} columns: the file ends early, or the row is cut"};
inline constexpr MessageText row_too_long{
    "sensor_log.row_too_long",
    {"place", "cells", "columns"},
    "{place}: {cells} cells where the first line names {columns} columns"};
inline constexpr MessageText rows_left_out{"sensor_log.rows_left_out",
                                           {"file", "count", "line", "reasons"},
                                           "{file}: left out {count} rows, the first is {line}: {reasons}"};
inline constexpr MessageText rows_unusable{
    "sensor_log.rows_unusable",
    {"file", "count"},
    "{file}: none of its {count} rows has a valid number in each named column. Correct the names of the "
    "columns, or copy the file again if it is incomplete"};
inline constexpr MessageText sensors_missing{"sensor_log.sensors_missing",
                                             "describes no sensor; there are imu, mag, baro, pitot, gnss"};
inline constexpr MessageText times_apart{"sensor_log.times_apart",
                                         {"file", "from", "to", "other", "other_from", "other_to"},
                                         "{file} covers {from} to {to}, but {other} covers {other_from} to "
                                         "{other_to}. Set shift here to add a time offset to {file}."};
inline constexpr MessageText topic_ambiguous{
    "sensor_log.topic_ambiguous", {"topic", "file"}, "'{topic}' has two channels in {file}; one can be read"};
inline constexpr MessageText topic_empty{"sensor_log.topic_empty", {"file"}, "{file} has no message of it"};
inline constexpr MessageText topic_unknown{"sensor_log.topic_unknown",
                                           {"topic", "file", "known"},
                                           "no topic '{topic}' in {file}; there are {known}"};
inline constexpr MessageText topic_unknown_in_cut_file{
    "sensor_log.topic_unknown_in_cut_file",
    {"topic", "file", "known", "byte"},
    "no topic '{topic}' in {file}; there are {known}; the file is cut off at byte {byte}"};
inline constexpr MessageText topics_not_in_file{
    "sensor_log.topics_not_in_file", {"file"}, "{file} has none; bags and ULogs have"};
inline constexpr MessageText type_unknown{
    "sensor_log.type_unknown", {"file", "topic", "type"}, "{file}: {topic} does not say what '{type}' is"};
inline constexpr MessageText use_empty{"sensor_log.use_empty",
                                       "no sample of the recording lies in these times"};
inline constexpr MessageText window_empty{
    "sensor_log.window_empty", {"from", "to"}, "from {from} to {to} is no time; `to` is after `from`"};

}  // namespace fulmar::sensor_log_messages

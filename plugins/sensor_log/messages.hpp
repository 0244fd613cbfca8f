// SPDX-License-Identifier: BSD-3-Clause
// The messages of this folder: code, arguments, sentence (fulmar/diagnostic.hpp).
#pragma once
#include "fulmar/diagnostic.hpp"

namespace fulmar::sensor_log_messages {

inline constexpr MessageText chunk_checksum_wrong{
    "sensor_log.chunk_checksum_wrong", "a chunk is damaged: its checksum is not that of its content"};
inline constexpr MessageText chunk_damaged{"sensor_log.chunk_damaged", "a chunk cannot be unpacked"};
inline constexpr MessageText chunk_packing_unsupported{
    "sensor_log.chunk_packing_unsupported",
    {"file", "packing"},
    "{file}: a chunk is packed with '{packing}'. Valid: zstd, or none. Write the file again with zstd"};
inline constexpr MessageText chunk_too_large{"sensor_log.chunk_too_large", "a chunk is larger than 1 GB"};
inline constexpr MessageText column_not_named{
    "sensor_log.column_not_named",
    {"file"},
    "no column is named. Write a column of the first line of {file} here"};
inline constexpr MessageText column_of_topic_not_named{
    "sensor_log.column_of_topic_not_named",
    {"file"},
    "no column is named, and the type of this topic has no default. Write a field of the topic in {file} "
    "here"};
inline constexpr MessageText column_repeated{
    "sensor_log.column_repeated",
    {"place", "column"},
    "{place}: two columns have the name '{column}'. Rename one of them in the file"};
inline constexpr MessageText column_unknown{"sensor_log.column_unknown",
                                            {"column", "place", "known"},
                                            "no column '{column}' in {place}; there are {known}"};
inline constexpr MessageText data_cut{"sensor_log.data_cut", "the file ends early, or is damaged"};
inline constexpr MessageText data_without_end{"sensor_log.data_without_end",
                                              "the file ends early: the record of its end is missing"};
inline constexpr MessageText encoding_unsupported{
    "sensor_log.encoding_unsupported",
    {"topic", "encoding", "schema"},
    "'{topic}' has the encoding '{encoding}' and the schema encoding '{schema}'. Valid: cdr with ros2msg, as "
    "ROS 2 records. Choose another topic"};
inline constexpr MessageText file_cut{"sensor_log.file_cut",
                                      {"file", "byte", "time"},
                                      "{file} is cut off at byte {byte}, at {time}. It is read up to there"};
inline constexpr MessageText file_damaged{
    "sensor_log.file_damaged",
    {"file", "byte", "reason"},
    "{file} is damaged at byte {byte}: {reason}. Copy it again from its source, or name another file"};
inline constexpr MessageText file_empty{
    "sensor_log.file_empty",
    {"file"},
    "{file} has no line with the names of its columns: write it in front of the rows, or name another file"};
inline constexpr MessageText file_ends_early{"sensor_log.file_ends_early",
                                             {"place", "time", "wanted"},
                                             "{place}: the file ends at {time}, but log.use goes to "
                                             "{wanted}. Reduce `to` of log.use, or copy the complete file"};
inline constexpr MessageText file_kind_unknown{
    "sensor_log.file_kind_unknown",
    {"file"},
    "'{file}' has an ending that cannot be read. Valid: *.csv, *.mcap, *.ulg, *.ulog"};
inline constexpr MessageText file_missing{"sensor_log.file_missing",
                                          {"file"},
                                          "{file} does not exist. Correct its name, or give the folder of "
                                          "the files with --set recorded.folder=FOLDER"};
inline constexpr MessageText file_not_mcap{
    "sensor_log.file_not_mcap",
    {"file"},
    "{file} does not begin as an MCAP file. Name another file, or copy it again from its source"};
inline constexpr MessageText file_not_named{
    "sensor_log.file_not_named",
    {"sensor"},
    "no file is named. Name the file of {sensor}, or remove {sensor}"};
inline constexpr MessageText file_not_ulog{
    "sensor_log.file_not_ulog",
    {"file"},
    "{file} does not begin as a ULog. Name another file, or copy it again from its source"};
inline constexpr MessageText file_unreadable{"sensor_log.file_unreadable",
                                             {"file", "reason"},
                                             "{file} cannot be read: {reason}. Name a file that can be read"};
inline constexpr MessageText folder_missing{
    "sensor_log.folder_missing",
    {"files"},
    "the folder of {files} is not given: add --set recorded.folder=FOLDER"};
inline constexpr MessageText format_empty{
    "sensor_log.format_empty",
    {"file", "type"},
    "{file}: the format of '{type}' has no field, so this topic cannot be read. Choose another topic"};
inline constexpr MessageText format_missing{
    "sensor_log.format_missing",
    {"file", "type"},
    "{file} has no format of '{type}', so this topic cannot be read. Choose another topic"};
inline constexpr MessageText format_too_large{
    "sensor_log.format_too_large",
    {"file", "type", "field"},
    "{file}: '{type} {field}' exceeds the size of a message, 65535 bytes. Choose another topic"};
inline constexpr MessageText last_line_cut{
    "sensor_log.last_line_cut",
    {"place"},
    "{place}: the last row does not end in a line break, so it may be cut. Complete it, or delete it"};
inline constexpr MessageText log_too_new{"sensor_log.log_too_new",
                                         {"file"},
                                         "{file} has flags of a later ULog version, which cannot be read. "
                                         "Name another file, or convert it to CSV"};
inline constexpr MessageText message_cut{
    "sensor_log.message_cut",
    {"count", "left"},
    "a list of {count} items is longer than the message, which has {left} bytes left; the file is damaged, "
    "or its message definition is wrong"};
inline constexpr MessageText message_not_xcdr{"sensor_log.message_not_xcdr",
                                              {"file"},
                                              "{file}: a message is not in little-endian XCDR1. Record the "
                                              "topic with that encoding, or choose another topic"};
inline constexpr MessageText number_missing{"sensor_log.number_missing", "the field is not a number"};
inline constexpr MessageText number_not_valid{
    "sensor_log.number_not_valid",
    {"place", "found", "column"},
    "{place}: '{found}' in column '{column}' is not a number. Correct it, or leave the cell empty"};
inline constexpr MessageText recording_ended{
    "sensor_log.recording_ended",
    "the recording has ended, but the mission continues. Set `done: vehicle.recording.ended` in the mission"};
inline constexpr MessageText row_cut{
    "sensor_log.row_cut",
    {"place", "cells", "columns"},
    "{place} has {cells} cells, but the first line names {columns} columns. Complete the row, or delete it"};
inline constexpr MessageText row_left_out{
    "sensor_log.row_left_out", {"file", "line", "reasons"}, "{file}: 1 row is left out, {line}: {reasons}"};
inline constexpr MessageText row_of_one_cell{
    "sensor_log.row_of_one_cell",
    {"place", "columns"},
    "{place} has 1 cell, but the first line names {columns} columns. Complete the row, or delete it"};
inline constexpr MessageText row_too_long{"sensor_log.row_too_long",
                                          {"place", "cells", "columns"},
                                          "{place} has {cells} cells, but the first line names {columns} "
                                          "columns. Remove cells, or name each column"};
inline constexpr MessageText rows_left_out{"sensor_log.rows_left_out",
                                           {"file", "count", "line", "reasons"},
                                           "{file}: {count} rows are left out, first {line}: {reasons}"};
inline constexpr MessageText rows_unusable{
    "sensor_log.rows_unusable",
    {"file", "count"},
    "{file}: none of its {count} rows has a valid number in each named column. Correct the names of the "
    "columns, or copy the file again if it is incomplete"};
inline constexpr MessageText sensors_missing{
    "sensor_log.sensors_missing",
    "no sensor has a file. Set from.file of at least one: imu, mag, baro, pitot, gnss"};
inline constexpr MessageText times_apart{"sensor_log.times_apart",
                                         {"file", "from", "to", "other", "other_from", "other_to"},
                                         "{file} covers {from} to {to}, but {other} covers {other_from} to "
                                         "{other_to}. Set shift here to add a time offset to {file}"};
inline constexpr MessageText topic_ambiguous{
    "sensor_log.topic_ambiguous",
    {"topic", "file"},
    "'{topic}' has two channels in {file}, and only one can be read. Choose another topic, or write the file "
    "with one channel"};
inline constexpr MessageText topic_empty{
    "sensor_log.topic_empty",
    {"file"},
    "{file} has no message of this topic. Choose another topic, or record it again"};
inline constexpr MessageText topic_unknown{"sensor_log.topic_unknown",
                                           {"topic", "file", "known"},
                                           "no topic '{topic}' in {file}; there are {known}"};
inline constexpr MessageText topic_unknown_in_cut_file{
    "sensor_log.topic_unknown_in_cut_file",
    {"topic", "file", "known", "byte"},
    "no topic '{topic}' in {file}; there are {known}; the file is cut off at byte {byte}"};
inline constexpr MessageText topics_not_in_file{
    "sensor_log.topics_not_in_file",
    {"file"},
    "{file} is a CSV file, which has no topics. Remove this key, or name a file *.mcap or *.ulg"};
inline constexpr MessageText type_unknown{"sensor_log.type_unknown",
                                          {"file", "topic", "type"},
                                          "{file}: the schema of {topic} does not define '{type}'. Choose "
                                          "another topic, or record it with its complete schema"};
inline constexpr MessageText use_empty{
    "sensor_log.use_empty",
    "the recording has no sample in these times. Correct from and to, or remove log.use"};
inline constexpr MessageText window_empty{
    "sensor_log.window_empty",
    {"from", "to"},
    "`to`, {to}, is not after `from`, {from}. Give a later `to`, or an earlier `from`"};

}  // namespace fulmar::sensor_log_messages

// SPDX-License-Identifier: BSD-3-Clause
// The messages of this folder: code, arguments, sentence (fulmar/diagnostic.hpp).
#pragma once
#include "fulmar/diagnostic.hpp"

namespace fulmar::log_messages {

inline constexpr MessageText attachment_checksum_invalid{"log.attachment_checksum_invalid",
                                                         "the checksum of an attachment is wrong"};
inline constexpr MessageText attachment_index_wrong{"log.attachment_index_wrong",
                                                    "an attachment index does not point at an attachment"};
inline constexpr MessageText chunk_checksum_invalid{
    "log.chunk_checksum_invalid", "the checksum of a chunk is wrong; the file is damaged here"};
inline constexpr MessageText chunk_content_invalid{
    "log.chunk_content_invalid", "a chunk holds a record that is not a schema, channel or message"};
inline constexpr MessageText chunk_index_wrong{"log.chunk_index_wrong",
                                               "a chunk index does not point at a chunk"};
inline constexpr MessageText chunk_not_decompressible{"log.chunk_not_decompressible",
                                                      "a chunk does not decompress"};
inline constexpr MessageText chunk_size_differs{"log.chunk_size_differs",
                                                "a chunk has a length other than it states"};
inline constexpr MessageText chunk_too_large{"log.chunk_too_large",
                                             "a chunk states a size of more than 32 MB, the limit"};
inline constexpr MessageText closing_magic_missing{"log.closing_magic_missing",
                                                   "the end of the file is missing"};
inline constexpr MessageText compression_unknown{
    "log.compression_unknown",
    {"found"},
    "a chunk has the compression '{found}'. Write the log again with zstd or without compression"};
inline constexpr MessageText content_not_readable{
    "log.content_not_readable",
    "the file cannot be read, because the disk reports an error. Copy the log to another disk"};
inline constexpr MessageText data_checksum_invalid{"log.data_checksum_invalid",
                                                   "the checksum of the data is wrong"};
inline constexpr MessageText file_truncated{"log.file_truncated",
                                            "the file is incomplete: it ends inside a record"};
inline constexpr MessageText footer_offset_invalid{"log.footer_offset_invalid",
                                                   "the footer does not point at the summary"};
inline constexpr MessageText host_fields_differ{
    "log.host_fields_differ",
    {"topic", "type"},
    "{topic} in the log has other fields than {type} now. Use the release of Fulmar that wrote the log"};
inline constexpr MessageText index_outside_chunk{"log.index_outside_chunk",
                                                 "a message index points outside its chunk"};
inline constexpr MessageText index_target_invalid{"log.index_target_invalid",
                                                  "a message index does not point at its message"};
inline constexpr MessageText log_altered{"log.log_altered",
                                         {"file", "found", "expected"},
                                         "another program changed '{file}': it has {found} bytes in place of "
                                         "{expected}. Let no other program write to a log"};
inline constexpr MessageText log_exists{
    "log.log_exists",
    {"file"},
    "'{file}' exists; a log never overwrites a file. Give another name, or move that file away"};
inline constexpr MessageText log_format_invalid{
    "log.log_format_invalid",
    {"file"},
    "'{file}' is not an MCAP file. Name the log of a flight, which ends in .mcap"};
inline constexpr MessageText log_moved{
    "log.log_moved", {"file", "destination"}, "the file was moved from '{file}{destination}"};
inline constexpr MessageText log_not_readable{
    "log.log_not_readable", {"file", "reason"}, "cannot read '{file}': {reason}. Name the file of a log"};
inline constexpr MessageText log_not_writable{
    "log.log_not_writable", {"file", "reason"}, "cannot write '{file}': {reason}"};
inline constexpr MessageText log_removed{
    "log.log_removed", {"file"}, "'{file}' was removed while it was being written"};
inline constexpr MessageText message_channel_missing{"log.message_channel_missing",
                                                     "a message belongs to no channel"};
inline constexpr MessageText metadata_index_wrong{"log.metadata_index_wrong",
                                                  "a metadata index does not point at metadata"};
inline constexpr MessageText operation_failed{
    "log.operation_failed", {"operation", "file", "reason"}, "cannot {operation} '{file}': {reason}"};
inline constexpr MessageText partial_log_exists{
    "log.partial_log_exists", {"file", "state"}, "'{file}' exists: {state}"};
inline constexpr MessageText record_memory_exhausted{
    "log.record_memory_exhausted", "there is not enough memory for a record of the log. End other programs"};
inline constexpr MessageText record_too_large{"log.record_too_large",
                                              "a record is longer than 256 MB, the limit"};
inline constexpr MessageText record_truncated{"log.record_truncated", "a record ends too early"};
inline constexpr MessageText repair_hint{"log.repair_hint",
                                         ". Copy the log again, or repair it with fulmar log recover"};
inline constexpr MessageText schemas_too_large{"log.schemas_too_large",
                                               "the schemas and channels of the log have more than 32 MB, "
                                               "the limit for reading a log. Write a log with fewer topics"};
inline constexpr MessageText statistics_differ{"log.statistics_differ",
                                               "the statistics differ from the file"};
inline constexpr MessageText summary_checksum_invalid{"log.summary_checksum_invalid",
                                                      "the checksum of the summary is wrong"};
inline constexpr MessageText too_many_channels{"log.too_many_channels",
                                               "a log holds at most 65536 channels; record fewer ports"};
inline constexpr MessageText topic_unknown{
    "log.topic_unknown", {"topic", "choices"}, "the log has no topic '{topic}'.{choices}"};

}  // namespace fulmar::log_messages

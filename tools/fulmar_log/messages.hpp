// SPDX-License-Identifier: BSD-3-Clause
// The messages of this folder: code, arguments, sentence (fulmar/diagnostic.hpp).
#pragma once
#include "fulmar/diagnostic.hpp"

namespace fulmar::log_tool_messages {

inline constexpr MessageText attachment_differs{
    "log_tool.attachment_differs", {"attachment", "line"}, "{attachment} differs from line {line} on"};
inline constexpr MessageText common_estimate_missing{
    "log_tool.common_estimate_missing",
    "the two logs have no estimate (VehicleState) in common; record the same one in both, or name other "
    "logs"};
inline constexpr MessageText common_figure_missing{
    "log_tool.common_figure_missing",
    "the two results have no figure in common; give two results of the same mission"};
inline constexpr MessageText compression_failed{
    "log_tool.compression_failed",
    "the data cannot be compressed; the memory may be too small. Export fewer topics at a time with --topic"};
inline constexpr MessageText disk_write_failed{"log_tool.disk_write_failed",
                                               {"file"},
                                               "'{file}' cannot be written to its end; the disk may be full. "
                                               "Free space, or name a file on another disk with --out"};
inline constexpr MessageText element_index_missing{
    "log_tool.element_index_missing",
    {"path", "first_path", "last_path", "last"},
    "{path} is a list: give one of its elements, {first_path}[0] to {last_path}[{last}]"};
inline constexpr MessageText error_against{"log_tool.error_against", {"topic"}, "error against {topic}"};
inline constexpr MessageText export_exists{
    "log_tool.export_exists",
    {"file"},
    "'{file}' exists; an export overwrites no file. Name another with --out"};
inline constexpr MessageText exportable_message_missing{
    "log_tool.exportable_message_missing",
    {"log", "reason"},
    "no message of '{log}' can be exported: the log is empty or damaged, or its types are not "
    "supported{reason}"};
inline constexpr MessageText field_unknown{"log_tool.field_unknown",
                                           {"field", "choices"},
                                           "'{field}' is not a field of a port in the log.{choices}"};
inline constexpr MessageText field_without_numbers{"log_tool.field_without_numbers",
                                                   " has no number in the log; choose another field"};
inline constexpr MessageText fields_missing{
    "log_tool.fields_missing",
    {"log"},
    "give at least one field after the log, as in fulmar plot {log} nav.state.height_m -o height.svg"};
inline constexpr MessageText figure_conversion_failed{
    "log_tool.figure_conversion_failed",
    {"program", "file"},
    "{program} did not convert the figure to '{file}'. Name a file that ends in .svg instead"};
inline constexpr MessageText figure_format_unknown{
    "log_tool.figure_format_unknown",
    {"file"},
    "'{file}' does not end in a figure format. Valid: .svg, .png, .pdf."};
inline constexpr MessageText figure_not_writable{
    "log_tool.figure_not_writable",
    {"file"},
    "'{file}' cannot be written. Check that its folder exists and is writable, and that the disk has space"};
inline constexpr MessageText file_not_readable{"log_tool.file_not_readable", "the file is not readable"};
inline constexpr MessageText file_not_writable{
    "log_tool.file_not_writable",
    {"file"},
    "'{file}' cannot be written. Check that its folder exists and is writable, and that the disk has space"};
inline constexpr MessageText first_difference{"log_tool.first_difference",
                                              {"time_s", "owner", "topic", "field", "first", "second"},
                                              "First difference at {time_s} s{owner}: {topic} {field} "
                                              "{first} in the first log, {second} in the second."};
inline constexpr MessageText folder_not_creatable{
    "log_tool.folder_not_creatable", {"folder", "reason"}, "the folder '{folder}' cannot be made: {reason}"};
inline constexpr MessageText footer_missing{"log_tool.footer_missing", "the footer is missing"};
inline constexpr MessageText frequency_figures_missing{
    "log_tool.frequency_figures_missing", {"reason"}, "no frequency response: {reason}"};
inline constexpr MessageText input_step_missing{
    "log_tool.input_step_missing",
    {"span", "largest"},
    "the input has no step: it changes by at most {largest} from one sample to the next, and by {span} in "
    "total. Choose a time or a signal with a step"};
inline constexpr MessageText interval_without_numbers{
    "log_tool.interval_without_numbers",
    {"begin", "end"},
    " has no number in this interval; the flight is from {begin} to {end}. Change --from or --to"};
inline constexpr MessageText label_count_mismatch{
    "log_tool.label_count_mismatch",
    {"expected", "found"},
    "--labels requires one name for each field, with commas between them: {expected}, not {found}"};
inline constexpr MessageText list_always_empty{
    "log_tool.list_always_empty", {"path"}, "{path} is a list that is always empty; choose another field"};
inline constexpr MessageText list_longer{"log_tool.list_longer",
                                         "the log has changed during the export: a list is longer than at "
                                         "the first read. Export the log again after the flight"};
inline constexpr MessageText log_after_fields{
    "log_tool.log_after_fields", {"log"}, "'{log}' is a log: give the logs before the fields"};
inline constexpr MessageText log_cut_off{
    "log_tool.log_cut_off", {"fault", "cut"}, "{fault} The log is cut off: {cut}"};
inline constexpr MessageText log_damaged{"log_tool.log_damaged", "all records of the log are damaged"};
inline constexpr MessageText log_exists{
    "log_tool.log_exists",
    {"file"},
    "'{file}' exists; a log never overwrites a file. Name another with --out"};
inline constexpr MessageText log_grown{"log_tool.log_grown", "the file has grown during the recovery"};
inline constexpr MessageText log_incomplete{
    "log_tool.log_incomplete", {"log", "fault"}, "{log} is cut off: {fault}"};
inline constexpr MessageText log_not_recoverable{
    "log_tool.log_not_recoverable",
    {"reason"},
    "the log has no recoverable data: {reason}. Use another copy of the log"};
inline constexpr MessageText log_still_growing{
    "log_tool.log_still_growing",
    {"log"},
    "'{log}' is still being written. The flight gives it its final name; recover the log after the flight"};
inline constexpr MessageText mat_too_large{
    "log_tool.mat_too_large",
    "a MAT file of level 5 holds at most 2 GB per variable; export to npz, or fewer topics"};
inline constexpr MessageText message_encoding_unsupported{
    "log_tool.message_encoding_unsupported",
    "the messages are not encoded as cdr with ros2msg; record the topic again in this encoding"};
inline constexpr MessageText message_type_missing{"log_tool.message_type_missing", "message without a type"};
inline constexpr MessageText messages_too_large{"log_tool.messages_too_large",
                                                {"limit"},
                                                "the messages may have more than {limit} bytes, the limit of "
                                                "this command; record the topic with shorter lists"};
inline constexpr MessageText messages_without_topic{
    "log_tool.messages_without_topic", {"count"}, "{count} messages without a topic"};
inline constexpr MessageText name_count_mismatch{
    "log_tool.name_count_mismatch",
    {"expected", "found"},
    "--names requires one name for each log, with commas between them: {expected}, not {found}"};
inline constexpr MessageText names_count_invalid{
    "log_tool.names_count_invalid",
    "--names requires two names with a comma between them, as in --names old,new"};
inline constexpr MessageText npz_text_too_large{
    "log_tool.npz_text_too_large",
    {"array"},
    "the text of {array} exceeds the size of an npz file; export fewer topics at a time with --topic"};
inline constexpr MessageText npz_too_large{
    "log_tool.npz_too_large",
    "the arrays exceed the 4 GB of an npz file; export fewer topics at a time with --topic"};
inline constexpr MessageText number_missing{
    "log_tool.number_missing", {"field", "interval"}, "{field}{interval}"};
inline constexpr MessageText numbers_missing{
    "log_tool.numbers_missing",
    {"field"},
    "{field} has no number in the selected time; change --from, --to or --phase"};
inline constexpr MessageText output_constant{
    "log_tool.output_constant",
    "the output does not move after the step. Choose another --output, or another time with --from and --to"};
inline constexpr MessageText output_is_log{
    "log_tool.output_is_log", {"file", "remedy"}, "'{file}' is a log of this plot; {remedy}"};
inline constexpr MessageText output_missing{
    "log_tool.output_missing", "give the file of the figure, as in -o figure.svg (or .png, .pdf)"};
inline constexpr MessageText path_is_text{
    "log_tool.path_is_text", {"path"}, "{path} is a text; choose a field with numbers"};
inline constexpr MessageText path_not_list{
    "log_tool.path_not_list", {"path"}, "{path} is not a list; remove the index in brackets"};
inline constexpr MessageText path_not_number{
    "log_tool.path_not_number",
    {"path", "example_path", "example", "choices"},
    "{path} is not a number: give one of its fields, as in {example_path}.{example}. Valid: {choices}."};
inline constexpr MessageText phases_differ{
    "log_tool.phases_differ",
    {"first", "other"},
    "the phases are those of {first}; {other} has other phases or other times"};
inline constexpr MessageText record_kind_differs{"log_tool.record_kind_differs",
                                                 "the kind of a record differs from the summary"};
inline constexpr MessageText record_kind_unknown{"log_tool.record_kind_unknown",
                                                 "the kind of a record is unknown"};
inline constexpr MessageText record_length_differs{"log_tool.record_length_differs",
                                                   "a record is longer than its content"};
inline constexpr MessageText record_overlong{"log_tool.record_overlong",
                                             "a record is longer than the summary states"};
inline constexpr MessageText record_truncated{"log_tool.record_truncated", "the file ends inside a record"};
inline constexpr MessageText response_missing{"log_tool.response_missing",
                                              {"step_fault", "join", "frequency_fault"},
                                              "{step_fault}{join}{frequency_fault}"};
inline constexpr MessageText result_expected{
    "log_tool.result_expected",
    "the file is neither a log nor a result of fulmar run --json: it is not valid JSON. Give another file"};
inline constexpr MessageText sample_gap{
    "log_tool.sample_gap",
    {"series", "begin", "end"},
    "the {series} has no sample from {begin} to {end}; choose a time without a gap with --from and --to"};
inline constexpr MessageText segment_too_short{
    "log_tool.segment_too_short",
    {"segment", "duration", "sample_time", "min_segments"},
    "the segments are {segment} of {duration}, with {sample_time} between samples. At least 16 samples a "
    "segment and {min_segments} segments that overlap by half are required. Choose a longer time, or change "
    "--segment"};
inline constexpr MessageText servos_limited{"log_tool.servos_limited",
                                            ": the figures are not those of small signals"};
inline constexpr MessageText size_invalid{
    "log_tool.size_invalid",
    {"found"},
    "--size {found}: give width and height in millimetres, at most 2000, as in 160x90mm"};
inline constexpr MessageText size_too_small{
    "log_tool.size_too_small", {"width", "height", "reason"}, "--size {width}x{height}mm {reason}"};
inline constexpr MessageText state_names_required{
    "log_tool.state_names_required",
    {"choices"},
    "name the two states to compare, as in nav.state second.state. The log has {choices}"};
inline constexpr MessageText states_missing{
    "log_tool.states_missing",
    "the log has no state of an aircraft (VehicleState); give a log that records one"};
inline constexpr MessageText step_figures_missing{
    "log_tool.step_figures_missing", {"reason"}, "no figures of a step: {reason}"};
inline constexpr MessageText step_samples_missing{
    "log_tool.step_samples_missing",
    "a step response requires samples of input and output in this time. Record both, or choose another time "
    "with --from and --to"};
inline constexpr MessageText step_samples_too_few{
    "log_tool.step_samples_too_few",
    {"before", "after"},
    "the output has {before} samples in the second before the step and {after} after it; at least 1 and 10 "
    "are required. Choose a longer time with --from and --to"};
inline constexpr MessageText subfield_unknown{
    "log_tool.subfield_unknown", {"path", "field", "choices"}, "{path} has no field '{field}'.{choices}"};
inline constexpr MessageText summary_checksum_invalid{"log_tool.summary_checksum_invalid",
                                                      "the checksum of the summary is wrong"};
inline constexpr MessageText summary_missing{"log_tool.summary_missing", "the summary is missing"};
inline constexpr MessageText svg_converter_missing{
    "log_tool.svg_converter_missing",
    {"file"},
    "'{file}' requires a program that converts SVG: apt install librsvg2-bin (rsvg-convert) or inkscape. "
    "Without one, name a file that ends in .svg"};
inline constexpr MessageText time_range_invalid{
    "log_tool.time_range_invalid",
    {"begin", "end"},
    "--from {begin} is not before --to {end}; exchange them or change one"};
inline constexpr MessageText too_few_samples{
    "log_tool.too_few_samples",
    {"series", "count"},
    "the {series} has {count} samples; a frequency response requires at least 10. Choose a longer time with "
    "--from and --to"};
inline constexpr MessageText too_many_curves{
    "log_tool.too_many_curves",
    {"count", "limit"},
    "a panel would have {count} curves; at most {limit} are distinguishable. Plot fewer fields, or divide "
    "them with --panel"};
inline constexpr MessageText too_many_fields{
    "log_tool.too_many_fields",
    "the messages have more than 20000 fields, the limit of an export; export other topics with --topic"};
inline constexpr MessageText too_many_numbers{"log_tool.too_many_numbers",
                                              {"limit"},
                                              "the messages have more than {limit} numbers each, the limit "
                                              "of an export; export other topics with --topic"};
inline constexpr MessageText too_many_states{
    "log_tool.too_many_states", {"names"}, "the command compares two states, not {names}; name two"};
inline constexpr MessageText topic_ambiguous{
    "log_tool.topic_ambiguous", {"name", "choices"}, "{name} is ambiguous: it matches {choices}; name one"};
inline constexpr MessageText topic_type_mismatch{"log_tool.topic_type_mismatch",
                                                 {"topic", "found", "expected", "choices"},
                                                 "{topic} is a {found}, not a {expected}.{choices}"};
inline constexpr MessageText topic_unknown{
    "log_tool.topic_unknown", {"topic", "choices"}, "the log has no topic {topic}.{choices}"};
inline constexpr MessageText value_without_parts{
    "log_tool.value_without_parts",
    {"path", "part"},
    "{path} is one value; it has no '{part}'. Name {path} alone"};

}  // namespace fulmar::log_tool_messages

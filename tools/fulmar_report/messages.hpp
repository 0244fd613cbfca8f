// SPDX-License-Identifier: BSD-3-Clause
// The messages of this folder: code, arguments, sentence (fulmar/diagnostic.hpp).
#pragma once
#include "fulmar/diagnostic.hpp"

namespace fulmar::report_messages {

inline constexpr MessageText compression_failed{"report.compression_failed",
                                                "zlib cannot compress: the memory is not sufficient"};
inline constexpr MessageText log_duplicate{
    "report.log_duplicate", {"log"}, "'{log}' is given twice: name each log once"};
inline constexpr MessageText messages_too_large{
    "report.messages_too_large",
    {"type"},
    "the definition of {type} in the log gives more than 1 MB a message, the limit of a report. Shorten the "
    "lists in the definition, or replace the damaged log"};
inline constexpr MessageText name_count_mismatch{
    "report.name_count_mismatch",
    {"expected", "found"},
    "--names takes one name for each log, separated by commas: {expected}, not {found}"};
inline constexpr MessageText page_not_built{
    "report.page_not_built",
    "this build of Fulmar does not include the page of a flight, which a report requires. Install nodejs and "
    "npm, configure and build again"};
inline constexpr MessageText page_version_mismatch{
    "report.page_version_mismatch",
    "the page has no place for a log: it is of another version. Install or build Fulmar again"};
inline constexpr MessageText report_exists{
    "report.report_exists", {"file"}, "{file} exists already: give another name with -o"};
inline constexpr MessageText report_not_writable{
    "report.report_not_writable", {"file", "reason"}, "{file} cannot be written: {reason}"};
inline constexpr MessageText result_expected{
    "report.result_expected",
    {"file"},
    "'{file}' is not the result of one flight, as fulmar run --json prints it"};
inline constexpr MessageText result_with_logs{
    "report.result_with_logs", "--result requires a report of one log; give one log, or omit --result"};
inline constexpr MessageText too_many_logs{
    "report.too_many_logs", {"limit", "found"}, "a report takes at most {limit} logs, not {found}"};

}  // namespace fulmar::report_messages

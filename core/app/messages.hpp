// SPDX-License-Identifier: BSD-3-Clause
// The messages of this folder: code, arguments, sentence (fulmar/diagnostic.hpp).
#pragma once
#include "fulmar/diagnostic.hpp"

namespace fulmar::app_messages {

inline constexpr MessageText argument_invalid{"app.argument_invalid",
                                              "something was given that makes no sense there"};
inline constexpr MessageText assignment_form_invalid{
    "app.assignment_form_invalid", {"found"}, "'{found}' is not of the form name=value"};
inline constexpr MessageText callable_empty{"app.callable_empty", "there is nothing to call"};
inline constexpr MessageText command_not_started{"app.command_not_started",
                                                 {"command", "program", "reason"},
                                                 "fulmar {command}: {program} cannot be started: {reason}"};
inline constexpr MessageText command_program_missing{
    "app.command_program_missing",
    {"command", "program"},
    "fulmar {command}: the program {program} is missing beside this one"};
inline constexpr MessageText condition_violated{"app.condition_violated", "something is not as it has to be"};
inline constexpr MessageText dds_without_pace{
    "app.dds_without_pace",
    "dds: nothing is exported or imported as fast as the machine allows; fly with --speed real"};
inline constexpr MessageText element_missing{"app.element_missing",
                                             "something was looked for where there is nothing"};
inline constexpr MessageText file_name_empty{
    "app.file_name_empty", {"default_action"}, "'' names no file; without the option {default_action}"};
inline constexpr MessageText folder_not_created{
    "app.folder_not_created", {"folder", "reason"}, "cannot make the folder '{folder}': {reason}"};
inline constexpr MessageText former_mission_kept{"app.former_mission_kept",
                                                 "what flew before stays as it is"};
inline constexpr MessageText internal_error{
    "app.internal_error", {"type", "reason"}, "an error inside Fulmar ({type}): {reason}"};
inline constexpr MessageText length_excessive{"app.length_excessive",
                                              "something would have become longer than anything can be"};
inline constexpr MessageText live_without_pace{
    "app.live_without_pace",
    "--live: no client can follow as fast as the machine allows; fly with --speed real"};
inline constexpr MessageText log_incomplete{
    "app.log_incomplete",
    {"reason", "count", "file"},
    "the log is not whole: {reason}; {count} messages were lost{file}"};
inline constexpr MessageText log_not_recorded{
    "app.log_not_recorded", {"log"}, "--log {log}: the mission says record: off; there is no log to write"};
inline constexpr MessageText log_off{"app.log_off", "no log is written"};
inline constexpr MessageText log_with_gaps{
    "app.log_with_gaps", {"count"}, "the log has gaps: the disk was too slow for {count} messages"};
inline constexpr MessageText memory_exhausted{"app.memory_exhausted", "there is not enough memory for that"};
inline constexpr MessageText message_form_invalid{
    "app.message_form_invalid", "what the other side has said has not the form that it should have"};
inline constexpr MessageText realtime_priority_missing{
    "app.realtime_priority_missing", "the loop runs without real-time priority; --realtime gives it one"};
inline constexpr MessageText realtime_without_pace{
    "app.realtime_without_pace",
    "--realtime would give a CPU to this flight alone: it belongs to --io fcu, or to a simulation with "
    "--speed real"};
inline constexpr MessageText rehearsal_failed{
    "app.rehearsal_failed", {"plugin", "reason"}, "{plugin} fails its rehearsal: {reason}"};
inline constexpr MessageText report_excludes_no_log{
    "app.report_excludes_no_log",
    "--report makes a page of the log, and --no-log leaves that out: give one of them"};
inline constexpr MessageText report_exists{
    "app.report_exists",
    {"file"},
    "'{file}' exists; a report never overwrites a file. Name another with --report FILE.html"};
inline constexpr MessageText report_log_missing{"app.report_log_missing",
                                                "there is no log to make the report of"};
inline constexpr MessageText report_name_invalid{
    "app.report_name_invalid", {"found"}, "--report {found}: give a name that ends in .html, or none"};
inline constexpr MessageText report_not_made{
    "app.report_not_made", {"log"}, "the report of {log} was not made"};
inline constexpr MessageText report_page_missing{
    "app.report_page_missing",
    "this Fulmar was built without the page of a flight, which a report needs: install nodejs and npm, "
    "configure and build again"};
inline constexpr MessageText report_program_missing{"app.report_program_missing",
                                                    {"program"},
                                                    "the program {program} is missing beside this one: it "
                                                    "makes reports; cmake --build build --target flight"};
inline constexpr MessageText report_timed_out{
    "app.report_timed_out", {"log"}, "the report of {log} is not made after 30 minutes"};
inline constexpr MessageText report_without_log{
    "app.report_without_log", "--report: the mission says record: off; there is no log to make it of"};
inline constexpr MessageText result_not_writable{
    "app.result_not_writable", {"reason"}, "the result cannot be written: {reason}"};
inline constexpr MessageText resume_log_missing{
    "app.resume_log_missing",
    {"mission"},
    "--resume: there is no log of the mission {mission}; name one, as in --resume FILE.mcap"};
inline constexpr MessageText seconds_invalid{
    "app.seconds_invalid", {"found"}, "give seconds, above 0 and up to 1e7, not '{found}'"};
inline constexpr MessageText speed_invalid{
    "app.speed_invalid",
    {"found"},
    "--speed '{found}': give real, max, or a multiple of real time, for example 10"};
inline constexpr MessageText value_type_differs{"app.value_type_differs",
                                                "something is not what it was taken for"};
inline constexpr MessageText whole_number_invalid{
    "app.whole_number_invalid", {"found"}, "give a whole number from 0, not '{found}'"};
inline constexpr MessageText with_file_missing{
    "app.with_file_missing",
    {"component", "example"},
    "--with {component}=: a file is missing, as in --with {example}=my_law.so"};

}  // namespace fulmar::app_messages

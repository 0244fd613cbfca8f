// SPDX-License-Identifier: BSD-3-Clause
// The messages of this folder: code, arguments, sentence (fulmar/diagnostic.hpp).
#pragma once
#include "fulmar/diagnostic.hpp"

namespace fulmar::app_messages {

inline constexpr MessageText argument_invalid{"app.argument_invalid", "an argument is invalid"};
inline constexpr MessageText assignment_form_invalid{
    "app.assignment_form_invalid",
    {"option", "found", "form"},
    "{option}: '{found}' is not complete; write {option} {form}"};
inline constexpr MessageText callable_empty{"app.callable_empty", "there is no function to call"};
inline constexpr MessageText command_not_started{"app.command_not_started",
                                                 {"command", "program", "reason"},
                                                 "fulmar {command}: {program} cannot be started: {reason}"};
inline constexpr MessageText command_program_missing{
    "app.command_program_missing",
    {"command", "program"},
    "fulmar {command}: the program {program} is missing beside this one. Install Fulmar again, or build it: "
    "cmake --build build --target flight"};
inline constexpr MessageText command_unknown{
    "app.command_unknown", {"found", "choices"}, "there is no command '{found}'.{choices}"};
inline constexpr MessageText component_crashed{
    "app.component_crashed",
    {"component", "call", "cause"},
    "{component} crashed in its {call} ({cause}). Correct its code, or set 'run: process' for it, which a "
    "crash does not end"};
inline constexpr MessageText component_ended_program{
    "app.component_ended_program",
    {"component", "call"},
    "{component} ended the program in its {call}. Remove its exit call, or set 'run: process' for it"};
inline constexpr MessageText condition_violated{"app.condition_violated",
                                                "a required condition does not hold"};
inline constexpr MessageText dds_without_pace{
    "app.dds_without_pace",
    "dds: nothing is exported or imported at the full speed of the machine; fly with --speed real"};
inline constexpr MessageText element_missing{"app.element_missing", "an index or a key does not exist"};
inline constexpr MessageText end_timed_out{"app.end_timed_out", "ended: the flight did not end in time"};
inline constexpr MessageText end_timed_out_in{
    "app.end_timed_out_in",
    {"call", "component"},
    "ended in the {call} of {component}: the flight did not end in time"};
inline constexpr MessageText ended_by_second_signal{"app.ended_by_second_signal",
                                                    "ended by the second signal"};
inline constexpr MessageText ended_by_second_signal_in{
    "app.ended_by_second_signal_in",
    {"call", "component"},
    "ended by the second signal in the {call} of {component}"};
inline constexpr MessageText ended_by_signal{"app.ended_by_signal", {"signal"}, "ended by {signal}"};
inline constexpr MessageText exit_handler_not_set{"app.exit_handler_not_set", "no room for an exit handler"};
inline constexpr MessageText exit_hangs{"app.exit_hangs", "ended: code of a plugin hangs at its exit"};
inline constexpr MessageText file_crashed{"app.file_crashed",
                                          {"file", "action", "cause"},
                                          "{file} crashed while being {action} ({cause}). Correct the code "
                                          "that runs then, often that of a global object"};
inline constexpr MessageText file_ended_program{
    "app.file_ended_program",
    {"file", "action"},
    "{file} ended the program while being {action}. Remove the exit call that runs then"};
inline constexpr MessageText file_hangs{
    "app.file_hangs", {"file", "action"}, "ended: {file} hangs while being {action}"};
inline constexpr MessageText file_name_empty{
    "app.file_name_empty", {"default_action"}, "'' names no file; without the option {default_action}"};
inline constexpr MessageText flight_over{"app.flight_over",
                                         "The flight has ended, and any log of it is closed."};
inline constexpr MessageText flights_compared{"app.flights_compared", "compared with the flight before"};
inline constexpr MessageText folder_not_created{
    "app.folder_not_created", {"folder", "reason"}, "the folder '{folder}' cannot be created: {reason}"};
inline constexpr MessageText former_mission_kept{"app.former_mission_kept",
                                                 "the former version stays in use"};
inline constexpr MessageText host_crashed{
    "app.host_crashed", {"cause"}, "the host crashed ({cause}). Report it with the command that you used"};
inline constexpr MessageText host_crashed_in{
    "app.host_crashed_in",
    {"file", "cause"},
    "the host crashed in code of {file} ({cause}). Correct that code, for example a thread of its own"};
inline constexpr MessageText internal_error{
    "app.internal_error",
    {"type", "reason"},
    "an error inside Fulmar ({type}): {reason}. Report it with the command that you used"};
inline constexpr MessageText last_frame_not_sent{"app.last_frame_not_sent", "the last frame cannot be sent"};
inline constexpr MessageText length_excessive{"app.length_excessive", "a length exceeds its maximum"};
inline constexpr MessageText live_without_pace{
    "app.live_without_pace",
    "--live: no client can follow at the full speed of the machine; fly with --speed real"};
inline constexpr MessageText log_incomplete{
    "app.log_incomplete",
    {"reason", "count", "file"},
    "the log is incomplete: {reason}; {count} messages are lost, {file} holds the rest"};
inline constexpr MessageText log_lost{
    "app.log_lost", {"reason", "count"}, "the log is incomplete: {reason}; {count} messages are lost"};
inline constexpr MessageText log_not_found{"app.log_not_found", {"file"}, "There is no log {file}"};
inline constexpr MessageText log_not_recorded{"app.log_not_recorded",
                                              {"log"},
                                              "--log {log}: the mission sets record: off, so the host writes "
                                              "no log. Remove --log, or remove record: off"};
inline constexpr MessageText log_off{"app.log_off", "the flight writes no log"};
inline constexpr MessageText log_until_end{"app.log_until_end", {"file"}, "The log until then is {file}"};
inline constexpr MessageText log_with_gaps{"app.log_with_gaps",
                                           {"count"},
                                           "the log has gaps: the disk was too slow for {count} messages. "
                                           "Record fewer ports, or write the log to a faster disk"};
inline constexpr MessageText memory_exhausted{"app.memory_exhausted",
                                              "there is not enough memory for this operation"};
inline constexpr MessageText message_form_invalid{
    "app.message_form_invalid",
    "a received message does not have the required form; use the same release of Fulmar on both sides"};
inline constexpr MessageText output_not_writable{"app.output_not_writable",
                                                 "the output cannot be written; is the disk full?"};
inline constexpr MessageText plugin_ended_program{"app.plugin_ended_program",
                                                  "code of a plugin ended the program. Remove its exit call"};
inline constexpr MessageText program_not_built{
    "app.program_not_built",
    {"program"},
    "the program {program} is missing. Build it: cmake --build build --target tools"};
inline constexpr MessageText programs_beside{
    "app.programs_beside",
    {"programs", "example"},
    "Programs beside this one: {programs} (fulmar {example} --help)"};
inline constexpr MessageText realtime_priority_missing{
    "app.realtime_priority_missing", "the loop runs without real-time priority; --realtime sets it"};
inline constexpr MessageText realtime_without_pace{"app.realtime_without_pace",
                                                   "--realtime would reserve a CPU for this flight alone: it "
                                                   "requires --io fcu, or a simulation with --speed real"};
inline constexpr MessageText rehearsal_failed{
    "app.rehearsal_failed", {"plugin", "reason"}, "{plugin} fails its rehearsal: {reason}"};
inline constexpr MessageText report_excludes_no_log{
    "app.report_excludes_no_log",
    "--report makes a page of the log, and --no-log omits the log: give one of them"};
inline constexpr MessageText report_exists{
    "app.report_exists",
    {"file"},
    "'{file}' exists; a report never overwrites a file. Name another with --report FILE.html"};
inline constexpr MessageText report_log_missing{
    "app.report_log_missing", "no report is made: the flight has no log, for the reason above"};
inline constexpr MessageText report_name_invalid{
    "app.report_name_invalid",
    {"found"},
    "--report {found}: the name does not end in .html; give a name that ends in .html, or none"};
inline constexpr MessageText report_not_made{
    "app.report_not_made",
    {"log"},
    "the report of {log} was not made, for the reason above. Try again with fulmar report {log}"};
inline constexpr MessageText report_page_missing{
    "app.report_page_missing",
    "this build of Fulmar lacks the page of a flight, which a report requires. Install nodejs and npm, then "
    "configure and build again"};
inline constexpr MessageText report_program_missing{
    "app.report_program_missing",
    {"program"},
    "the program {program}, which makes reports, is missing beside this one. Build it: cmake --build build "
    "--target flight"};
inline constexpr MessageText report_timed_out{
    "app.report_timed_out",
    {"log"},
    "the report of {log} is not complete after 30 minutes. Make it with fulmar report {log}"};
inline constexpr MessageText report_without_log{"app.report_without_log",
                                                "--report: the mission sets record: off, but a report "
                                                "requires a log. Remove --report, or remove record: off"};
inline constexpr MessageText result_not_writable{
    "app.result_not_writable", {"reason"}, "the result cannot be written: {reason}"};
inline constexpr MessageText resume_log_missing{
    "app.resume_log_missing",
    {"mission"},
    "--resume: there is no log of the mission {mission}; name one, as in --resume FILE.mcap"};
inline constexpr MessageText seconds_invalid{
    "app.seconds_invalid", {"found"}, "'{found}' is not a number of seconds above 0 and up to 1e7"};
inline constexpr MessageText speed_invalid{
    "app.speed_invalid",
    {"found"},
    "--speed '{found}' is invalid. Valid: real, max, or a multiple of real time, for example 10"};
inline constexpr MessageText thread_ended_program{
    "app.thread_ended_program", "a thread of a component ended the program. Remove its exit call"};
inline constexpr MessageText value_type_differs{"app.value_type_differs",
                                                "a value has another type than expected"};
inline constexpr MessageText whole_number_invalid{
    "app.whole_number_invalid", {"found"}, "'{found}' is not a whole number from 0 up"};
inline constexpr MessageText with_file_missing{
    "app.with_file_missing",
    {"component", "example"},
    "--with {component}=: a file is missing, as in --with {example}=my_law.so"};

}  // namespace fulmar::app_messages

// SPDX-License-Identifier: BSD-3-Clause
// The messages of this folder: code, arguments, sentence (fulmar/diagnostic.hpp).
#pragma once
#include "fulmar/diagnostic.hpp"

namespace fulmar::run_messages {

inline constexpr MessageText aircraft_armed{"run.aircraft_armed", "the aircraft is armed"};
inline constexpr MessageText aircraft_in_air{"run.aircraft_in_air", "the aircraft is in the air"};
inline constexpr MessageText arm_request_missing{
    "run.arm_request_missing",
    {"vehicle"},
    "arm: auto requires a request 'arm' with a field 'armed', which {vehicle} does not have. Set arm: off, "
    "or choose another vehicle."};
inline constexpr MessageText call_refused{
    "run.call_refused", {"function", "reason"}, "calls {function} in flight; {reason}"};
inline constexpr MessageText cannot_take_over{
    "run.cannot_take_over", {"reason"}, "cannot take over: {reason}"};
inline constexpr MessageText choice_unknown{"run.choice_unknown",
                                            {"component", "parameter", "found", "choices"},
                                            "{component}.{parameter}: unknown value '{found}'.{choices}"};
inline constexpr MessageText command_missing{
    "run.command_missing",
    {"port"},
    "no sample on '{port}', although it is stepped and its inputs are fresh"};
inline constexpr MessageText component_missing{
    "run.component_missing",
    {"component"},
    "there is no component '{component}' in this run; remove its line under 'resume' in the mission"};
inline constexpr MessageText component_not_active{
    "run.component_not_active", {"component"}, "{component} is not active in this phase"};
inline constexpr MessageText component_not_created{"run.component_not_created",
                                                   {"component", "reason"},
                                                   "{component}: the component cannot be created: {reason}"};
inline constexpr MessageText component_was_swapped{
    "run.component_was_swapped", "its component was swapped in the meantime; send the command again"};
inline constexpr MessageText concluded{"run.concluded", {"verdict", "cause"}, "{verdict} ({cause})"};
inline constexpr MessageText condition_dead{"run.condition_dead",
                                            {"what", "condition"},
                                            "is stopped: '{what}: {condition}' can no longer become true"};
inline constexpr MessageText constructor_failed{
    "run.constructor_failed", {"component", "reason"}, "{component}: its constructor {reason}"};
inline constexpr MessageText control_given_up{"run.control_given_up",
                                              "a signal ended the control: the pilot has control"};
inline constexpr MessageText driver_missing{"run.driver_missing",
                                            {"option", "mission"},
                                            "--drivers-from {option}: the mission {mission} has no component "
                                            "with 'run: driver'; omit --drivers-from"};
inline constexpr MessageText driver_parameters_fixed{
    "run.driver_parameters_fixed",
    "a driver's parameters cannot change in flight; set them in the mission and start the flight again"};
inline constexpr MessageText end_deferred{
    "run.end_deferred", {"verdict", "reason"}, "{verdict}{reason}; the flight continues until disarmed"};
inline constexpr MessageText ended_by_owner{"run.ended_by_owner", "ended by its owner"};
inline constexpr MessageText ended_by_signal{"run.ended_by_signal", "by a signal"};
inline constexpr MessageText ended_for_restart{"run.ended_for_restart", "ended for a new flight"};
inline constexpr MessageText entrance_unknown{"run.entrance_unknown",
                                              {"component", "kind", "port", "choices"},
                                              "'{component}' accepts no {kind} '{port}'.{choices}"};
inline constexpr MessageText entrances_differ{
    "run.entrances_differ",
    {"plugin"},
    "the new file has other requests or imported inputs than {plugin}. They are fixed when the flight "
    "begins; start the flight again."};
inline constexpr MessageText failsafe{
    "run.failsafe", {"component", "problem"}, "failsafe: {component}: {problem}"};
inline constexpr MessageText failsafe_active{
    "run.failsafe_active",
    "the flight is in its failsafe: no phase can be entered; land, disarm and start the flight again"};
inline constexpr MessageText failsafe_over{"run.failsafe_over",
                                           "no commands until disarmed: the pilot has control"};
inline constexpr MessageText flight_already_paused{
    "run.flight_already_paused", "the flight is already paused; fulmar resume continues it"};
inline constexpr MessageText flight_behind{
    "run.flight_behind",
    {"delay_s"},
    "the flight is {delay_s} s behind the real time: the program was stopped, or the machine is too slow. It "
    "catches up as fast as it can"};
inline constexpr MessageText flight_ended{"run.flight_ended", "the flight has ended; start it again"};
inline constexpr MessageText flight_not_paused{"run.flight_not_paused",
                                               "the flight is not paused; fulmar pause pauses it"};
inline constexpr MessageText guard_not_reset{
    "run.guard_not_reset",
    {"reason"},
    "guard not reset: its process has ended and restarts only on the ground; {reason}"};
inline constexpr MessageText guard_reset{"run.guard_reset", "guard reset"};
inline constexpr MessageText hardware_pace_fixed{
    "run.hardware_pace_fixed", {"reason"}, "this flight is on hardware, io: fcu: {reason}"};
inline constexpr MessageText heap_too_large{
    "run.heap_too_large",
    {"growth_mb", "limit_mb"},
    "its heap grew by {growth_mb} MB in flight; the limit is {limit_mb} MB"};
inline constexpr MessageText host_forked{
    "run.host_forked", {"component"}, "{component} has forked the host; the copy ends"};
inline constexpr MessageText input_empty{"run.input_empty", {"input"}, "input '{input}' has no sample"};
inline constexpr MessageText input_of_stopped{"run.input_of_stopped",
                                              {"input", "component"},
                                              "input '{input}' comes from {component}, which is stopped"};
inline constexpr MessageText input_too_old{"run.input_too_old",
                                           {"input", "age_s", "limit_s"},
                                           "input '{input}' is {age_s} s old, the limit is {limit_s} s"};
inline constexpr MessageText library_build_differs{
    "run.library_build_differs",
    {"file", "build", "program_build"},
    "{file} is from build {build}, this program from build {program_build}: build or install both together"};
inline constexpr MessageText library_invalid{
    "run.library_invalid",
    {"file"},
    "{file} is not the Fulmar library that is needed here; install or build Fulmar again"};
inline constexpr MessageText library_missing{"run.library_missing",
                                             {"files", "target"},
                                             "its library is missing. Searched: {files}. Install the package "
                                             "fulmar, or build it: cmake --build build --target {target}"};
inline constexpr MessageText library_needs{
    "run.library_needs", {"fault", "needs"}, "{fault}. The library needs {needs}"};
inline constexpr MessageText live_view_missing{
    "run.live_view_missing", {"reason"}, "the flight has no live view: {reason}"};
inline constexpr MessageText log_ends_early{"run.log_ends_early", {"fault"}, " The log ends early: {fault}"};
inline constexpr MessageText log_failed{
    "run.log_failed", {"reason"}, "the flight continues without a log: {reason}"};
inline constexpr MessageText log_incomplete{"run.log_incomplete", {"problem", "reason"}, "{problem}{reason}"};
inline constexpr MessageText log_phase_missing{
    "run.log_phase_missing",
    {"reason"},
    "the log names no phase to resume from. Name another log with --resume.{reason}"};
inline constexpr MessageText log_phase_unknown{"run.log_phase_unknown",
                                               {"phase", "mission", "phases"},
                                               "the log ends in the phase '{phase}', which the mission "
                                               "{mission} lacks now; it has {phases}. Resume with "
                                               "the mission of that flight, or add the phase"};
inline constexpr MessageText loop_would_wait{"run.loop_would_wait", "the loop would wait for it"};
inline constexpr MessageText message_size_invalid{
    "run.message_size_invalid",
    {"component", "port", "size", "type", "expected"},
    "{component}.{port}: {size} bytes are not a {type}, which has {expected} bytes. Build the sender with "
    "the definition of this flight"};
inline constexpr MessageText mission_changed{
    "run.mission_changed",
    {"file", "difference"},
    "{file} has changed since this flight began ({difference}): end the flight, and start it again"};
inline constexpr MessageText mission_differs{
    "run.mission_differs",
    {"found", "mission"},
    "the log is of the mission {found}, not of {mission}. Name a log of {mission} with --resume"};
inline constexpr MessageText mission_file_missing{"run.mission_file_missing",
                                                  "this flight was not read from a mission file, so no "
                                                  "component can be swapped. Start the flight from a file"};
inline constexpr MessageText mission_not_done{
    "run.mission_not_done", {"limit"}, "not done within {limit} s of flight"};
inline constexpr MessageText no_candidate{
    "run.no_candidate", {"component"}, "no component of this phase is available: {component} stays active"};
inline constexpr MessageText not_resumed{"run.not_resumed", {"reason"}, "not resumed: {reason}"};
inline constexpr MessageText not_resumed_on_ground{"run.not_resumed_on_ground",
                                                   "not resumed: the aircraft is not armed and in the air"};
inline constexpr MessageText output_added{
    "run.output_added", {"output"}, "the new file has an additional output '{output}'"};
inline constexpr MessageText output_date_wrong{"run.output_date_wrong",
                                               {"output", "date_s", "now_s"},
                                               "output '{output}' has the time {date_s} s, now is {now_s} s"};
inline constexpr MessageText output_removed{
    "run.output_removed", {"output"}, "the new file has no output '{output}'"};
inline constexpr MessageText output_resumed{"run.output_resumed", {"port"}, "publishes '{port}' again"};
inline constexpr MessageText output_silent{"run.output_silent",
                                           {"port", "silent_s"},
                                           "no sample on '{port}' for {silent_s} s, although it is stepped"};
inline constexpr MessageText output_silent_event{
    "run.output_silent_event", {"problem"}, "{problem}: consumers keep its last sample"};
inline constexpr MessageText output_too_long{
    "run.output_too_long",
    {"output", "count", "capacity"},
    "output '{output}' has {count} items; its capacity is {capacity}"};
inline constexpr MessageText output_type_changed{
    "run.output_type_changed", {"output"}, "the message of its output '{output}' has changed"};
inline constexpr MessageText outputs_changed{"run.outputs_changed",
                                             "its outputs differ from the former ones"};
inline constexpr MessageText outputs_differ{"run.outputs_differ",
                                            {"difference"},
                                            "{difference}; the outputs of a flight are fixed when it begins. "
                                            "Start the flight again, or run it with --watch"};
inline constexpr MessageText parameter_default_changed{"run.parameter_default_changed",
                                                       {"parameter", "value", "initial"},
                                                       "{parameter} = {value} (new default {initial})"};
inline constexpr MessageText parameter_not_live{
    "run.parameter_not_live",
    {"component", "parameter"},
    "{component}.{parameter} cannot change in flight: it is a set-up parameter, a record or a file. Set it "
    "in the mission and start the flight again"};
inline constexpr MessageText parameter_set{"run.parameter_set", {"name", "value"}, "{name} = {value}"};
inline constexpr MessageText parameters_added{"run.parameters_added", {"parameters"}, "new: {parameters}"};
inline constexpr MessageText parameters_kept{"run.parameters_kept", {"parameters"}, "keeps {parameters}"};
inline constexpr MessageText parameters_refused{
    "run.parameters_refused",
    "its plugin rejects the parameters and gives no reason; fulmar inspect shows their ranges"};
inline constexpr MessageText parameters_removed{
    "run.parameters_removed", {"parameters"}, "gone: {parameters}"};
inline constexpr MessageText phase_entered{"run.phase_entered", {"phase"}, "phase {phase}"};
inline constexpr MessageText phase_parameters_refused{
    "run.phase_parameters_refused",
    {"phase", "reason"},
    "rejects the parameters of the phase {phase}: {reason}"};
inline constexpr MessageText phase_unknown{
    "run.phase_unknown", {"phase", "choices"}, "there is no phase '{phase}'.{choices}"};
inline constexpr MessageText plugin_not_unloaded{
    "run.plugin_not_unloaded",
    {"plugin"},
    "{plugin} cannot be unloaded, so its old code would run on. End the flight and start fulmar again. A "
    "unique symbol or a thread-local destructor keeps it loaded."};
inline constexpr MessageText plugin_swapped{"run.plugin_swapped",
                                            {"old", "new", "separator", "changes"},
                                            "swapped: {old} -> {new}{separator}{changes}"};
inline constexpr MessageText plugin_unnamed{"run.plugin_unnamed", "another plugin"};
inline constexpr MessageText probe_not_finite{
    "run.probe_not_finite", {"probe"}, "probe '{probe}' is not finite"};
inline constexpr MessageText rate_or_io_differs{"run.rate_or_io_differs", "another rate or another io"};
inline constexpr MessageText realtime_not_permitted{
    "run.realtime_not_permitted",
    {"operation", "reason", "priority", "program"},
    "--realtime: fulmar is not permitted {operation}: {reason}. Allow it in one of three ways. (1) Put two "
    "lines into /etc/security/limits.d/fulmar.conf, '@dialout - rtprio {priority}' and '@dialout - memlock "
    "unlimited', and log in again. (2) Run 'sudo setcap cap_sys_nice,cap_ipc_lock+ep {program}'. (3) Use the "
    "systemd unit fulmar@.service, whose limits allow it"};
inline constexpr MessageText recorded_probes_differ{
    "run.recorded_probes_differ",
    {"component"},
    "the log has fewer probes of {component} than its plugin. Use the plugin that recorded the log."};
inline constexpr MessageText request_refused{
    "run.request_refused", {"request", "reason"}, "{request} refused: {reason}"};
inline constexpr MessageText restart_not_possible{
    "run.restart_not_possible", {"reason"}, "no new flight: {reason}"};
inline constexpr MessageText result_late{
    "run.result_late", {"due_ns"}, "a result is late: due at {due_ns} ns"};
inline constexpr MessageText resumed{"run.resumed", {"state"}, "resumed: {state}"};
inline constexpr MessageText resumed_field_invalid{
    "run.resumed_field_invalid",
    {"field"},
    "{field} is a probe; resume needs a field of a message such as manage.progress.item"};
inline constexpr MessageText resumed_fields_differ{
    "run.resumed_fields_differ",
    {"topic", "type"},
    "{topic} in the log has other fields than {type} now. Resume with the release and the plugins that wrote "
    "the log, or set the parameter with --set"};
inline constexpr MessageText resumed_value_invalid{"run.resumed_value_invalid",
                                                   {"field", "found", "parameter", "min", "max"},
                                                   "{field} was {found} in the log, but {parameter} must be "
                                                   "from {min} to {max}. Set {parameter} with --set"};
inline constexpr MessageText role_output_absent{
    "run.role_output_absent", {"role", "reason"}, "the role {role} published nothing; {reason}"};
inline constexpr MessageText sample_missing{
    "run.sample_missing",
    {"topic", "reason"},
    "the log holds no sample of {topic}. Name a log with --resume that records it.{reason}"};
inline constexpr MessageText samples_unordered{
    "run.samples_unordered",
    {"log", "topic"},
    "'{log}' has samples of {topic} that are not in the order of time; record the log again"};
inline constexpr MessageText signal_refused{
    "run.signal_refused", "the aircraft is armed: a second Ctrl-C within 5 s returns control to the pilot"};
inline constexpr MessageText step_order_differs{"run.step_order_differs", "another order of components"};
inline constexpr MessageText step_without_pause{"run.step_without_pause",
                                                "the flight is not paused; pause it first with fulmar pause"};
inline constexpr MessageText steps_in_progress{"run.steps_in_progress",
                                               "another step command is in progress; send the command again"};
inline constexpr MessageText swap_not_possible{
    "run.swap_not_possible",
    {"component", "reason"},
    "{component} cannot be swapped: {reason}. A component is swapped on the ground, disarmed"};
inline constexpr MessageText text_too_long{"run.text_too_long",
                                           {"kind", "text", "limit"},
                                           "{kind} '{text}' is too long; the limit is {limit} characters"};
inline constexpr MessageText time_budget_exceeded{"run.time_budget_exceeded",
                                                  "exceeded its time budget in 5 consecutive steps"};
inline constexpr MessageText time_not_monotonic{
    "run.time_not_monotonic", {"from_ns", "to_ns"}, "the time of the tick went from {from_ns} to {to_ns} ns"};
inline constexpr MessageText too_many_calls{"run.too_many_calls", "has too many unfinished calls"};
inline constexpr MessageText too_many_commands{
    "run.too_many_commands",
    {"count"},
    "{count} commands wait for the flight; there is no room for more. Send the command again later"};
inline constexpr MessageText too_many_requests{"run.too_many_requests",
                                               {"component", "request", "count"},
                                               "{component}.{request} has {count} requests waiting; there is "
                                               "no room for more. Send the request again later"};
inline constexpr MessageText took_over{"run.took_over", {"component"}, "{component} takes over"};
inline constexpr MessageText topic_fields_differ{
    "run.topic_fields_differ",
    {"topic", "component", "output", "type", "plugin"},
    "{topic} has other fields than {component}.{output}, a {type}: {plugin} recorded it. Record the log "
    "again, or load that plugin with --with {component}=FILE"};
inline constexpr MessageText value_not_carried{"run.value_not_carried",
                                               {"parameter", "found", "min", "max"},
                                               "its parameter '{parameter}' is {found} now, but the new file "
                                               "allows only {min} to {max}. Set it into this range first"};
inline constexpr MessageText value_out_of_range{
    "run.value_out_of_range",
    {"component", "parameter", "found", "min", "max", "unit"},
    "{component}.{parameter}: {found} is outside {min} .. {max}{unit}"};
inline constexpr MessageText value_too_long{
    "run.value_too_long",
    {"component", "parameter", "length", "limit"},
    "{component}.{parameter}: the value has {length} characters; the limit is {limit}"};
inline constexpr MessageText vehicle_failed{"run.vehicle_failed", {"reason"}, "the vehicle failed: {reason}"};
inline constexpr MessageText vehicle_not_swappable{
    "run.vehicle_not_swappable",
    {"component"},
    "{component} is the vehicle: it holds the aircraft, and can change only between flights"};
inline constexpr MessageText verdict_sources_missing{
    "run.verdict_sources_missing", {"owners"}, "no verdict; this flight has no {owners}"};

}  // namespace fulmar::run_messages

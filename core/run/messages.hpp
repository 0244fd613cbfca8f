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
    "arm: auto needs a vehicle with a request 'arm' that has a field 'armed'; {vehicle} has none"};
inline constexpr MessageText call_refused{
    "run.call_refused", {"function", "reason"}, "calls {function} in flight; {reason}"};
inline constexpr MessageText cannot_take_over{
    "run.cannot_take_over", {"reason"}, "cannot take over: {reason}"};
inline constexpr MessageText choice_unknown{"run.choice_unknown",
                                            {"component", "parameter", "found", "choices"},
                                            "{component}.{parameter}: unknown word '{found}'.{choices}"};
inline constexpr MessageText command_missing{
    "run.command_missing", {"port"}, "nothing on '{port}', though it steps and all its inputs come"};
inline constexpr MessageText component_missing{
    "run.component_missing", {"component"}, "there is no component '{component}' in this run"};
inline constexpr MessageText component_not_active{
    "run.component_not_active", {"component"}, "{component} does not fly now"};
inline constexpr MessageText component_not_created{
    "run.component_not_created", {"component", "reason"}, "{component}: cannot be created: {reason}"};
inline constexpr MessageText component_was_swapped{"run.component_was_swapped",
                                                   "its component was swapped meanwhile; ask again"};
inline constexpr MessageText concluded{"run.concluded", {"verdict", "cause"}, "{verdict} ({cause})"};
inline constexpr MessageText condition_dead{"run.condition_dead",
                                            {"what", "condition"},
                                            "was stopped: '{what}: {condition}' cannot come true any more"};
inline constexpr MessageText constructor_failed{
    "run.constructor_failed", {"component", "reason"}, "{component}: its constructor {reason}"};
inline constexpr MessageText control_given_up{"run.control_given_up",
                                              "control given up by a signal: the aircraft is its pilot's"};
inline constexpr MessageText driver_missing{
    "run.driver_missing",
    {"option", "mission"},
    "--drivers-from {option}: the mission {mission} has no component with 'run: driver'"};
inline constexpr MessageText driver_parameters_fixed{"run.driver_parameters_fixed",
                                                     "is a driver: its parameters are fixed in flight"};
inline constexpr MessageText end_deferred{
    "run.end_deferred", {"verdict", "reason"}, "{verdict}{reason}; flies on until disarmed"};
inline constexpr MessageText ended_by_owner{"run.ended_by_owner", "ended by its owner"};
inline constexpr MessageText ended_by_signal{"run.ended_by_signal", "by a signal"};
inline constexpr MessageText ended_for_restart{"run.ended_for_restart", "ended for a new flight"};
inline constexpr MessageText entrance_unknown{"run.entrance_unknown",
                                              {"component", "kind", "port", "choices"},
                                              "'{component}' takes no {kind} '{port}'.{choices}"};
inline constexpr MessageText entrances_differ{"run.entrances_differ",
                                              {"plugin"},
                                              "its requests and imported inputs are not those of {plugin}, "
                                              "and the log of this flight has room for those alone"};
inline constexpr MessageText failsafe{
    "run.failsafe", {"component", "problem"}, "failsafe: {component}: {problem}"};
inline constexpr MessageText failsafe_active{"run.failsafe_active",
                                             "the flight is in its failsafe: no phase can be entered"};
inline constexpr MessageText failsafe_over{"run.failsafe_over",
                                           "silent until disarmed: the aircraft is its pilot's"};
inline constexpr MessageText flight_already_paused{"run.flight_already_paused",
                                                   "the flight is paused already"};
inline constexpr MessageText flight_ended{"run.flight_ended", "the flight has ended"};
inline constexpr MessageText flight_not_paused{"run.flight_not_paused", "the flight is not paused"};
inline constexpr MessageText guard_not_reset{
    "run.guard_not_reset",
    {"reason"},
    "guard not reset: its process has ended, and is started anew on the ground; {reason}"};
inline constexpr MessageText guard_reset{"run.guard_reset", "guard reset"};
inline constexpr MessageText hardware_pace_fixed{
    "run.hardware_pace_fixed", {"reason"}, "this flight is on hardware, io: fcu: {reason}"};
inline constexpr MessageText heap_too_large{
    "run.heap_too_large",
    {"growth_mb", "limit_mb"},
    "its heap has grown by {growth_mb} MB in flight; {limit_mb} MB are allowed"};
inline constexpr MessageText input_empty{"run.input_empty", {"input"}, "input '{input}' has no sample"};
inline constexpr MessageText input_of_stopped{"run.input_of_stopped",
                                              {"input", "component"},
                                              "input '{input}' comes from {component}, which was stopped"};
inline constexpr MessageText input_too_old{"run.input_too_old",
                                           {"input", "age_s", "limit_s"},
                                           "input '{input}' is {age_s} s old, the limit is {limit_s} s"};
inline constexpr MessageText library_build_differs{"run.library_build_differs",
                                                   {"file", "build", "program_build"},
                                                   "{file} is of another build ({build}) than this program "
                                                   "({program_build}): build or install both together"};
inline constexpr MessageText library_invalid{
    "run.library_invalid", {"file"}, "{file} is not Fulmar's library for it"};
inline constexpr MessageText library_missing{
    "run.library_missing",
    {"files", "target"},
    "its library is not there. Searched: {files}. Install the package fulmar, or build it: cmake --build "
    "build --target {target}"};
inline constexpr MessageText library_needs{
    "run.library_needs", {"fault", "needs"}, "{fault}. It needs {needs}"};
inline constexpr MessageText log_failed{
    "run.log_failed", {"reason"}, "the flight goes on without its log: {reason}"};
inline constexpr MessageText log_phase_missing{"run.log_phase_missing", "the log holds no phase"};
inline constexpr MessageText log_phase_unknown{
    "run.log_phase_unknown",
    {"phase", "choices"},
    "it ends in the phase '{phase}', which this mission does not have.{choices}"};
inline constexpr MessageText loop_would_wait{"run.loop_would_wait", "the loop would wait for it"};
inline constexpr MessageText message_size_invalid{"run.message_size_invalid",
                                                  {"component", "port", "size", "type"},
                                                  "{component}.{port}: {size} bytes are no {type}"};
inline constexpr MessageText mission_changed{
    "run.mission_changed",
    {"file", "difference"},
    "{file} has changed since this flight began ({difference}): end it, and fly again"};
inline constexpr MessageText mission_differs{
    "run.mission_differs", {"found", "mission"}, "is a log of the mission {found}, not of {mission}"};
inline constexpr MessageText mission_file_missing{
    "run.mission_file_missing", "this flight was not read from a mission file: nothing can be swapped in it"};
inline constexpr MessageText mission_not_done{
    "run.mission_not_done", {"limit"}, "not done within {limit} s of flight"};
inline constexpr MessageText no_candidate{
    "run.no_candidate", {"component"}, "nobody that this phase names can fly: {component} goes on"};
inline constexpr MessageText not_resumed{"run.not_resumed", {"reason"}, "not resumed: {reason}"};
inline constexpr MessageText not_resumed_on_ground{"run.not_resumed_on_ground",
                                                   "not resumed: the aircraft is not in the air, armed"};
inline constexpr MessageText output_added{
    "run.output_added", {"output"}, "the new file has an output '{output}' more"};
inline constexpr MessageText output_date_wrong{"run.output_date_wrong",
                                               {"output", "date_s", "now_s"},
                                               "output '{output}' is dated {date_s} s, now is {now_s} s"};
inline constexpr MessageText output_removed{
    "run.output_removed", {"output"}, "the new file has no output '{output}'"};
inline constexpr MessageText output_resumed{"run.output_resumed", {"port"}, "speaks on '{port}' again"};
inline constexpr MessageText output_silent{
    "run.output_silent", {"port", "silent_s"}, "nothing on '{port}' for {silent_s} s, though it steps"};
inline constexpr MessageText output_silent_event{
    "run.output_silent_event", {"problem"}, "{problem}: who reads it goes on with the last of it"};
inline constexpr MessageText output_too_long{
    "run.output_too_long",
    {"output", "count", "capacity"},
    "output '{output}' holds {count} items, there is room for {capacity}"};
inline constexpr MessageText output_type_changed{
    "run.output_type_changed", {"output"}, "the message of its output '{output}' has changed"};
inline constexpr MessageText outputs_changed{"run.outputs_changed", "its outputs are not those that it had"};
inline constexpr MessageText outputs_differ{
    "run.outputs_differ",
    {"difference"},
    "{difference}; what leaves a flight is settled when it begins. Start it anew, or fly with --watch"};
inline constexpr MessageText parameter_not_live{
    "run.parameter_not_live",
    {"component", "parameter"},
    "{component}.{parameter} is a set-up parameter: it cannot change in flight"};
inline constexpr MessageText parameter_set{"run.parameter_set", {"name", "value"}, "{name} = {value}"};
inline constexpr MessageText parameters_refused{"run.parameters_refused", "refuses its parameters"};
inline constexpr MessageText phase_entered{"run.phase_entered", {"phase"}, "phase {phase}"};
inline constexpr MessageText phase_parameters_refused{"run.phase_parameters_refused",
                                                      {"phase", "reason"},
                                                      "does not take what the phase {phase} sets: {reason}"};
inline constexpr MessageText phase_unknown{
    "run.phase_unknown", {"phase", "choices"}, "there is no phase '{phase}'.{choices}"};
inline constexpr MessageText plugin_not_unloaded{
    "run.plugin_not_unloaded",
    {"plugin"},
    "{plugin} cannot be unloaded (a unique symbol or a thread-local destructor keeps it): the new file would "
    "fly its code. Restart the host"};
inline constexpr MessageText plugin_swapped{"run.plugin_swapped",
                                            {"old", "new", "separator", "changes"},
                                            "swapped: {old} -> {new}{separator}{changes}"};
inline constexpr MessageText probe_not_finite{
    "run.probe_not_finite", {"probe"}, "probe '{probe}' is not finite"};
inline constexpr MessageText rate_or_io_differs{"run.rate_or_io_differs", "another rate or io"};
inline constexpr MessageText realtime_not_permitted{
    "run.realtime_not_permitted",
    {"operation", "reason", "priority", "program"},
    "--realtime: fulmar is not permitted {operation}: {reason}; allow it by one of: two lines in "
    "/etc/security/limits.d/fulmar.conf, '@dialout - rtprio {priority}' and '@dialout - memlock unlimited', "
    "and a new login; or 'sudo setcap cap_sys_nice,cap_ipc_lock+ep {program}'; or the systemd unit "
    "fulmar@.service, whose limits allow it"};
inline constexpr MessageText recorded_probes_differ{
    "run.recorded_probes_differ", {"component"}, "the log has other probes of {component}"};
inline constexpr MessageText request_refused{
    "run.request_refused", {"request", "reason"}, "{request} refused: {reason}"};
inline constexpr MessageText restart_not_possible{
    "run.restart_not_possible", {"reason"}, "no new flight: {reason}"};
inline constexpr MessageText result_late{
    "run.result_late", {"due_ns"}, "took late a result that was due at {due_ns} ns"};
inline constexpr MessageText resumed{"run.resumed", {"state"}, "resumed: {state}"};
inline constexpr MessageText resumed_field_invalid{
    "run.resumed_field_invalid", {"field"}, "{field} is a probe, and a flight resumes from messages"};
inline constexpr MessageText resumed_fields_differ{
    "run.resumed_fields_differ",
    {"topic", "type"},
    "the log's {topic} has other fields than {type} of this mission"};
inline constexpr MessageText resumed_value_invalid{"run.resumed_value_invalid",
                                                   {"field", "found", "parameter"},
                                                   "{field} was {found}, which {parameter} does not allow"};
inline constexpr MessageText role_output_absent{
    "run.role_output_absent", {"role", "reason"}, "nothing came from the role {role}; {reason}"};
inline constexpr MessageText sample_missing{
    "run.sample_missing", {"topic"}, "the log holds no sample of {topic}"};
inline constexpr MessageText samples_unordered{
    "run.samples_unordered",
    {"log", "topic"},
    "'{log}' has samples of {topic} that are not in the order of time"};
inline constexpr MessageText signal_refused{
    "run.signal_refused", "the aircraft is armed: Ctrl-C once more within 5 s gives up control"};
inline constexpr MessageText step_order_differs{"run.step_order_differs", "another order of steps"};
inline constexpr MessageText step_without_pause{"run.step_without_pause",
                                                "the flight is not paused: nothing to step"};
inline constexpr MessageText steps_in_progress{"run.steps_in_progress",
                                               "other ticks are being flown; ask again"};
inline constexpr MessageText swap_not_possible{
    "run.swap_not_possible",
    {"component", "reason"},
    "{component} cannot be swapped: {reason}. A component is swapped on the ground, disarmed"};
inline constexpr MessageText target_not_active{"run.target_not_active", "does not fly now"};
inline constexpr MessageText text_too_long{
    "run.text_too_long", {"kind", "text", "limit"}, "{kind} '{text}' is longer than {limit} characters"};
inline constexpr MessageText time_budget_exceeded{"run.time_budget_exceeded",
                                                  "was over its time budget in 5 steps in a row"};
inline constexpr MessageText time_not_monotonic{
    "run.time_not_monotonic", {"from_ns", "to_ns"}, "time went from {from_ns} to {to_ns} ns"};
inline constexpr MessageText too_many_calls{"run.too_many_calls", "has too many calls on their way"};
inline constexpr MessageText too_many_commands{
    "run.too_many_commands",
    {"count"},
    "{count} commands are waiting for the flight; there is no room for more"};
inline constexpr MessageText too_many_requests{
    "run.too_many_requests",
    {"component", "request", "count"},
    "{component}.{request} has {count} requests waiting; there is no room for more"};
inline constexpr MessageText took_over{"run.took_over", {"component"}, "{component} takes over"};
inline constexpr MessageText topic_fields_differ{"run.topic_fields_differ",
                                                 {"topic", "component", "output"},
                                                 "{topic} has other fields than {component}.{output}"};
inline constexpr MessageText value_not_carried{
    "run.value_not_carried",
    {"parameter", "found"},
    "its parameter '{parameter}' does not allow the present value {found}"};
inline constexpr MessageText value_out_of_range{"run.value_out_of_range",
                                                {"component", "parameter", "found", "min", "max"},
                                                "{component}.{parameter}: {found} is outside {min} .. {max}"};
inline constexpr MessageText value_too_long{
    "run.value_too_long",
    {"component", "parameter", "length", "limit"},
    "{component}.{parameter}: a value of {length} characters; {limit} are allowed"};
inline constexpr MessageText vehicle_failed{"run.vehicle_failed", {"reason"}, "the vehicle failed: {reason}"};
inline constexpr MessageText vehicle_not_swappable{
    "run.vehicle_not_swappable",
    {"component"},
    "{component} is the vehicle: it holds the aircraft, and is changed when no flight goes on"};
inline constexpr MessageText verdict_sources_missing{
    "run.verdict_sources_missing", {"owners"}, "no verdict; without what {owners} reports"};

}  // namespace fulmar::run_messages

// SPDX-License-Identifier: BSD-3-Clause
// The messages of this folder: code, arguments, sentence (fulmar/diagnostic.hpp).
#pragma once
#include "fulmar/diagnostic.hpp"

namespace fulmar::remote_messages {

inline constexpr MessageText component_unknown{"remote.component_unknown",
                                               {"component", "choices"},
                                               "this flight has no component '{component}'.{choices}"};
inline constexpr MessageText confirmation_required{
    "remote.confirmation_required",
    "the confirmation requires a terminal; without one give --yes. Nothing was written"};
inline constexpr MessageText connection_lost{"remote.connection_lost", "connection lost"};
inline constexpr MessageText connection_rejected{
    "remote.connection_rejected",
    {"address", "status", "reason"},
    "the flight on {address} rejects the connection: {status} {reason}"};
inline constexpr MessageText csv_ports_differ{
    "remote.csv_ports_differ",
    {"field", "first_field"},
    "--csv accepts fields of one port; {field} and {first_field} belong to different ports"};
inline constexpr MessageText encoding_unsupported{"remote.encoding_unsupported",
                                                  {"topic", "encoding"},
                                                  "{topic} has the encoding '{encoding}', but only cdr is "
                                                  "supported. Use the same release of Fulmar on both sides"};
inline constexpr MessageText estimate_absent{"remote.estimate_absent", "no estimate"};
inline constexpr MessageText field_duplicate{
    "remote.field_duplicate", {"field"}, "the field '{field}' is given twice; give it once"};
inline constexpr MessageText field_form_invalid{
    "remote.field_form_invalid",
    {"found"},
    "'{found}' is not of the form field=value; or give all in braces, as in '{{radius_m: 80}'"};
inline constexpr MessageText field_is_scalar{
    "remote.field_is_scalar",
    {"path", "field"},
    "{path} is a single value and has no field '{field}'; give {path} alone"};
inline constexpr MessageText field_missing{
    "remote.field_missing",
    {"request", "suggestion", "choices"},
    "{request} needs a field at least, as in fulmar call {request} {suggestion}=VALUE. Valid: {choices}."};
inline constexpr MessageText field_unknown{
    "remote.field_unknown", {"path", "field", "choices"}, "{path} has no field '{field}'.{choices}"};
inline constexpr MessageText first_sample_awaited{
    "remote.first_sample_awaited", {"port"}, "waiting for the first sample of {port}"};
inline constexpr MessageText flight_closed_connection{
    "remote.flight_closed_connection",
    {"address", "reason"},
    "the flight on {address} has closed the connection: {reason}"};
inline constexpr MessageText flight_ended{
    "remote.flight_ended", {"address"}, "the flight on {address} has ended"};
inline constexpr MessageText flight_expected{
    "remote.flight_expected",
    {"address", "reason"},
    "the server on {address} is not a flight ({reason}): name a flight with --at"};
inline constexpr MessageText flight_not_found{"remote.flight_not_found",
                                              {"address"},
                                              "no flight listens on {address}: start one with fulmar run "
                                              "MISSION --speed real --live 8765, or name it with --at"};
inline constexpr MessageText flight_state{"remote.flight_state",
                                          {"mission", "io", "phase", "time", "state"},
                                          "{mission} (io: {io}), phase {phase}, {time} s, {state}"};
inline constexpr MessageText host_unknown{
    "remote.host_unknown",
    {"host"},
    "the host '{host}' does not exist: give --at HOST:PORT, as in --at 127.0.0.1:8765"};
inline constexpr MessageText index_invalid{
    "remote.index_invalid", {"found"}, "'{found}': an index has the form waypoints[3]"};
inline constexpr MessageText index_out_of_range{
    "remote.index_out_of_range",
    {"path", "size", "last"},
    "{path} has room for {size} elements; the last one is [{last}]"};
inline constexpr MessageText list_expected{
    "remote.list_expected", {"path"}, "{path} is not a list; give it without an index"};
inline constexpr MessageText live_option_of_log{
    "remote.live_option_of_log", "--seconds is for a running flight; for a log give --from and --to"};
inline constexpr MessageText log_expected{
    "remote.log_expected",
    {"file"},
    "{file} is not a log: it does not begin as an MCAP file. Give the log of a flight, which ends in .mcap"};
inline constexpr MessageText log_incomplete{
    "remote.log_incomplete",
    {"log"},
    "{log} is incomplete: it is cut off, or the flight still writes it. fulmar log recover repairs a log, "
    "`fulmar view running` shows the flight"};
inline constexpr MessageText log_is_folder{
    "remote.log_is_folder", {"path"}, "{path} is a folder: give the file of a log"};
inline constexpr MessageText log_missing{
    "remote.log_missing",
    {"log"},
    "the log '{log}' does not exist. Give the file of a log, or 'running' for the flight at --at"};
inline constexpr MessageText log_option_without_log{
    "remote.log_option_without_log",
    {"option", "field"},
    "{option} is for logs: give a log first, as in fulmar plot flight.mcap {field}"};
inline constexpr MessageText map_expected{
    "remote.map_expected", {"found"}, "'{found}' is not a map {{field: value}"};
inline constexpr MessageText message_field_expected{
    "remote.message_field_expected",
    {"message", "port", "suggestion", "choices"},
    "'{message}' is a message: give one of its fields, as in {port}.{suggestion}. Valid: {choices}."};
inline constexpr MessageText mission_file_missing{
    "remote.mission_file_missing",
    {"file"},
    "the file {file} does not exist here: give the mission file with --mission"};
inline constexpr MessageText mission_file_unknown{
    "remote.mission_file_unknown",
    "the flight does not report its mission file: give the file with --mission"};
inline constexpr MessageText nothing_wrong{"remote.nothing_wrong", "nothing is wrong"};
inline constexpr MessageText number_invalid{
    "remote.number_invalid", {"kind", "found"}, "give {kind}, not '{found}'"};
inline constexpr MessageText numeric_field_expected{
    "remote.numeric_field_expected",
    {"field"},
    "{field} is not a number, which a plot requires; give a field that is a number"};
inline constexpr MessageText order_accepted{
    "remote.order_accepted", {"order", "time"}, "{order}: accepted, at {time} s of flight"};
inline constexpr MessageText owner_unknown{
    "remote.owner_unknown", {"owner", "choices"}, "this flight has nothing called '{owner}'.{choices}"};
inline constexpr MessageText owner_without_parameters{
    "remote.owner_without_parameters",
    {"component", "choices"},
    "this flight has no component with parameters called '{component}'.{choices}"};
inline constexpr MessageText page_outdated{"remote.page_outdated",
                                           {"page", "log"},
                                           "{page} exists already and is older than the log: move it away, "
                                           "or use fulmar report {log} -o ANOTHER.html"};
inline constexpr MessageText parameter_name_expected{
    "remote.parameter_name_expected",
    {"name", "component", "choices"},
    "'{name}' is not a parameter: give {component}.NAME. Valid: {choices}."};
inline constexpr MessageText parameter_rejected{
    "remote.parameter_rejected",
    {"parameter", "found", "reason", "other_parameters"},
    "{parameter} is not set to {found}: {reason}{other_parameters}"};
inline constexpr MessageText parameter_unknown{"remote.parameter_unknown",
                                               {"component", "parameter", "choices"},
                                               "{component} has no parameter '{parameter}'.{choices}"};
inline constexpr MessageText parameter_value_missing{
    "remote.parameter_value_missing",
    {"parameter"},
    "'{parameter}' has no value: give NAME VALUE [NAME VALUE ...]"};
inline constexpr MessageText parameters_missing{
    "remote.parameters_missing",
    "give NAME VALUE [NAME VALUE ...], as in fulmar param set slc.roll_limit \"35 deg\""};
inline constexpr MessageText parameters_unchanged{"remote.parameters_unchanged",
                                                  "The files already hold the values of the flight."};
inline constexpr MessageText pattern_unmatched{
    "remote.pattern_unmatched",
    {"pattern"},
    "no parameter of this flight matches '{pattern}'; fulmar param list shows all of them"};
inline constexpr MessageText phase_overlays_parameter{
    "remote.phase_overlays_parameter", ", from the next phase on: this phase sets it to something else"};
inline constexpr MessageText phase_unknown{
    "remote.phase_unknown", {"phase", "choices"}, "this flight has no phase '{phase}'.{choices}"};
inline constexpr MessageText plugin_expected{
    "remote.plugin_expected", {"file"}, "'{file}' is not a plugin: the file of a plugin ends in .so or .py"};
inline constexpr MessageText port_name_expected{
    "remote.port_name_expected",
    {"name", "owner", "choices"},
    "'{name}' is not a port: give {owner}.PORT. Valid: {choices}."};
inline constexpr MessageText port_number_invalid{
    "remote.port_number_invalid",
    {"address", "port"},
    "'{address}': '{port}' is not a port number; give HOST:PORT, as in 127.0.0.1:8765"};
inline constexpr MessageText port_unknown{
    "remote.port_unknown", {"owner", "port", "choices"}, "{owner} has no port '{port}'.{choices}"};
inline constexpr MessageText program_missing{
    "remote.program_missing",
    {"program"},
    "the program {program} is missing beside this one. Install Fulmar again, or build it: cmake --build "
    "build --target flight"};
inline constexpr MessageText program_not_startable{
    "remote.program_not_startable", {"program", "reason"}, "{program} cannot be started: {reason}"};
inline constexpr MessageText program_start_failed{
    "remote.program_start_failed", {"program", "reason"}, "{program} cannot be started: {reason}"};
inline constexpr MessageText request_rejected{
    "remote.request_rejected", {"request", "reason"}, "{request}: refused: {reason}"};
inline constexpr MessageText request_unknown{
    "remote.request_unknown", {"request", "choices"}, "this flight has no request '{request}'.{choices}"};
inline constexpr MessageText restart_accepted{"remote.restart_accepted",
                                              "restart: accepted, a new flight has begun"};
inline constexpr MessageText restarted_flight_missing{
    "remote.restarted_flight_missing",
    {"address"},
    "restart: accepted, but no new flight listens on {address}; read the reason in the terminal of the "
    "flight"};
inline constexpr MessageText sample_absent{"remote.sample_absent", "no sample yet"};
inline constexpr MessageText service_unknown{"remote.service_unknown",
                                             {"address", "service", "choices"},
                                             "the flight on {address} has no service '{service}'.{choices}"};
inline constexpr MessageText stopped_by_guard{"remote.stopped_by_guard", "stopped by a guard"};
inline constexpr MessageText subcommands_not_listed{
    "remote.subcommands_not_listed",
    {"program"},
    "{program} does not list its subcommands; install or build it together with this program"};
inline constexpr MessageText token_rejected{
    "remote.token_rejected",
    {"address", "token_state"},
    "the flight on {address}{token_state}: give it with --token or in FULMAR_TOKEN"};
inline constexpr MessageText trying_again{
    "remote.trying_again", {"reason", "silence"}, "{reason}, {silence} s ago: trying again"};
inline constexpr MessageText vehicle_failsafe{"remote.vehicle_failsafe", "the vehicle's own failsafe"};
inline constexpr MessageText vehicle_silent{"remote.vehicle_silent", "the vehicle is silent"};
inline constexpr MessageText verdict_missing{
    "remote.verdict_missing",
    {"address"},
    "the response of the flight on {address} does not state whether the request is accepted. Use the same "
    "release of Fulmar on both sides"};
inline constexpr MessageText view_missing{
    "remote.view_missing",
    {"address"},
    "the flight on {address} does not report its description. Use the same release of Fulmar on both sides"};
inline constexpr MessageText viewer_not_installed{
    "remote.viewer_not_installed", {"viewer"}, "{viewer} is not installed here: open it by hand."};
inline constexpr MessageText viewer_unknown{
    "remote.viewer_unknown", {"viewer", "choices"}, "there is no viewer '{viewer}'.{choices}"};
inline constexpr MessageText viewer_without_live_view{"remote.viewer_without_live_view",
                                                      "rerun opens logs, not a running flight. For a flight "
                                                      "give --in page, lichtblick, foxglove or plotjuggler"};

}  // namespace fulmar::remote_messages

// SPDX-License-Identifier: BSD-3-Clause
// The messages of this folder: code, arguments, sentence (fulmar/diagnostic.hpp).
#pragma once
#include "fulmar/diagnostic.hpp"

namespace fulmar::remote_messages {

inline constexpr MessageText component_unknown{"remote.component_unknown",
                                               {"component", "choices"},
                                               "this flight has no component '{component}'.{choices}"};
inline constexpr MessageText confirmation_required{"remote.confirmation_required",
                                                   "nothing was written: say --yes, or answer at a terminal"};
inline constexpr MessageText connection_rejected{
    "remote.connection_rejected",
    {"address", "status", "reason"},
    "the flight on {address} refuses the connection: {status} {reason}"};
inline constexpr MessageText csv_ports_differ{
    "remote.csv_ports_differ",
    {"field", "first_field"},
    "--csv takes fields of one port; {field} is of another than {first_field}"};
inline constexpr MessageText encoding_unsupported{
    "remote.encoding_unsupported",
    {"topic", "encoding"},
    "{topic} has the encoding '{encoding}', which is not read here"};
inline constexpr MessageText field_is_scalar{
    "remote.field_is_scalar", {"path", "field"}, "{path} is one value, it has no '{field}'"};
inline constexpr MessageText field_unknown{
    "remote.field_unknown", {"path", "field", "choices"}, "{path} has no field '{field}'.{choices}"};
inline constexpr MessageText flight_expected{
    "remote.flight_expected",
    {"address", "reason"},
    "what listens on {address} is no flight ({reason}): name one with --at"};
inline constexpr MessageText flight_not_found{"remote.flight_not_found",
                                              {"address"},
                                              "no flight listens on {address}: start one with fulmar run "
                                              "MISSION --speed real --live 8765, or name it with --at"};
inline constexpr MessageText host_unknown{
    "remote.host_unknown",
    {"host"},
    "there is no host '{host}': give --at HOST:PORT, as in --at 127.0.0.1:8765"};
inline constexpr MessageText index_invalid{
    "remote.index_invalid", {"found"}, "'{found}': an index is written as in waypoints[3]"};
inline constexpr MessageText index_out_of_range{"remote.index_out_of_range",
                                                {"path", "size", "last"},
                                                "{path} has room for {size}; the last one is [{last}]"};
inline constexpr MessageText list_expected{"remote.list_expected", {"path"}, "{path} is no list"};
inline constexpr MessageText log_expected{
    "remote.log_expected", {"file"}, "{file} is no log: it does not begin as an MCAP file"};
inline constexpr MessageText log_incomplete{"remote.log_incomplete",
                                            {"log"},
                                            "{log} is cut off, or still being written: fulmar log recover "
                                            "makes it whole, `fulmar view running` shows the flight"};
inline constexpr MessageText log_is_folder{
    "remote.log_is_folder", {"path"}, "{path} is a folder: give the file of a log"};
inline constexpr MessageText log_missing{
    "remote.log_missing",
    {"log"},
    "there is no log '{log}'. Give the file of a log, or 'running' for the flight at --at"};
inline constexpr MessageText message_field_expected{
    "remote.message_field_expected",
    {"message", "port", "suggestion", "choices"},
    "'{message}' is a message: give one of its fields, as in {port}.{suggestion}. Valid: {choices}."};
inline constexpr MessageText mission_file_missing{
    "remote.mission_file_missing",
    {"file"},
    "there is no file {file} here: give the mission's with --mission"};
inline constexpr MessageText mission_file_unknown{
    "remote.mission_file_unknown",
    "the flight does not say which file its mission is: give it with --mission"};
inline constexpr MessageText numeric_field_expected{
    "remote.numeric_field_expected", {"field"}, "{field} is no number"};
inline constexpr MessageText owner_unknown{
    "remote.owner_unknown", {"owner", "choices"}, "nothing in this flight is called '{owner}'.{choices}"};
inline constexpr MessageText owner_without_parameters{
    "remote.owner_without_parameters",
    {"component", "choices"},
    "nothing in this flight with parameters is called '{component}'.{choices}"};
inline constexpr MessageText page_outdated{
    "remote.page_outdated",
    {"page", "log"},
    "{page} is there already, and older than the log: move it away, or fulmar report {log} -o ANOTHER.html"};
inline constexpr MessageText parameter_name_expected{
    "remote.parameter_name_expected",
    {"name", "component", "choices"},
    "'{name}' is no parameter: give {component}.NAME. Valid: {choices}."};
inline constexpr MessageText parameter_rejected{
    "remote.parameter_rejected",
    {"parameter", "found", "reason", "other_parameters"},
    "{parameter} is not set to {found}: {reason}{other_parameters}"};
inline constexpr MessageText parameter_unknown{"remote.parameter_unknown",
                                               {"component", "parameter", "choices"},
                                               "{component} has no parameter '{parameter}'.{choices}"};
inline constexpr MessageText pattern_unmatched{
    "remote.pattern_unmatched", {"pattern"}, "no parameter of this flight is called like '{pattern}'"};
inline constexpr MessageText phase_unknown{
    "remote.phase_unknown", {"phase", "choices"}, "this flight has no phase '{phase}'.{choices}"};
inline constexpr MessageText plugin_expected{
    "remote.plugin_expected", {"file"}, "'{file}' is no plugin: a plugin's file ends in .so or .py"};
inline constexpr MessageText port_name_expected{"remote.port_name_expected",
                                                {"name", "owner", "choices"},
                                                "'{name}' is no port: give {owner}.PORT. Valid: {choices}."};
inline constexpr MessageText port_number_invalid{
    "remote.port_number_invalid",
    {"address", "port"},
    "'{address}': '{port}' is no port; give HOST:PORT, as in 127.0.0.1:8765"};
inline constexpr MessageText port_unknown{
    "remote.port_unknown", {"owner", "port", "choices"}, "{owner} has no port '{port}'.{choices}"};
inline constexpr MessageText program_missing{
    "remote.program_missing", {"program"}, "the program {program} is missing beside this one"};
inline constexpr MessageText program_not_startable{
    "remote.program_not_startable", {"program"}, "{program} cannot be started"};
inline constexpr MessageText program_start_failed{
    "remote.program_start_failed", {"program", "reason"}, "{program} cannot be started: {reason}"};
inline constexpr MessageText request_unknown{
    "remote.request_unknown", {"request", "choices"}, "this flight takes no request '{request}'.{choices}"};
inline constexpr MessageText restarted_flight_missing{
    "remote.restarted_flight_missing",
    {"address"},
    "restart: accepted, but no new flight listens on {address}; the terminal of the flight says why"};
inline constexpr MessageText service_unknown{"remote.service_unknown",
                                             {"address", "service", "choices"},
                                             "the flight on {address} has no service '{service}'.{choices}"};
inline constexpr MessageText stopped_by_guard{"remote.stopped_by_guard", "stopped by a guard"};
inline constexpr MessageText subcommands_not_listed{
    "remote.subcommands_not_listed", {"program"}, "{program} does not tell its commands"};
inline constexpr MessageText token_rejected{
    "remote.token_rejected",
    {"address", "token_state"},
    "the flight on {address}{token_state}: give it with --token or in FULMAR_TOKEN"};
inline constexpr MessageText verdict_missing{
    "remote.verdict_missing",
    {"address"},
    "the flight on {address} has answered something else than yes or no"};
inline constexpr MessageText view_missing{
    "remote.view_missing", {"address"}, "the flight on {address} does not say what it is"};

}  // namespace fulmar::remote_messages

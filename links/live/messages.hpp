// SPDX-License-Identifier: BSD-3-Clause
// The messages of this folder: code, arguments, sentence (fulmar/diagnostic.hpp).
#pragma once
#include "fulmar/diagnostic.hpp"

namespace fulmar::live_messages {

inline constexpr MessageText binary_op_unknown{
    "live.binary_op_unknown",
    {"op"},
    "the binary message begins with op {op}. Valid: 1 (data), 2 (service call)."};
inline constexpr MessageText channel_already_advertised{
    "live.channel_already_advertised",
    {"channel"},
    "this client already advertises channel {channel}: choose another id, or send 'unadvertise' first"};
inline constexpr MessageText channel_already_subscribed{
    "live.channel_already_subscribed",
    {"channel"},
    "this client already has a subscription to channel {channel}: use that one, or send 'unsubscribe' first"};
inline constexpr MessageText channel_not_advertised{
    "live.channel_not_advertised",
    {"channel"},
    "this client advertises no channel {channel}: take an id from its own 'advertise' message"};
inline constexpr MessageText channel_unknown{
    "live.channel_unknown",
    {"channel"},
    "there is no channel {channel}: take an id from the server's 'advertise' message"};
inline constexpr MessageText client_too_slow{"live.client_too_slow",
                                             {"count"},
                                             "this connection is too slow for its subscriptions: {count} "
                                             "messages are lost. Unsubscribe from some topics"};
inline constexpr MessageText encoding_unknown{
    "live.encoding_unknown", {"encoding"}, "there is no encoding '{encoding}'. Valid: cdr, json."};
inline constexpr MessageText graph_not_subscribed{
    "live.graph_not_subscribed",
    "the client has no subscription to the connection graph: send 'subscribeConnectionGraph' first"};
inline constexpr MessageText listen_address_invalid{
    "live.listen_address_invalid",
    {"address"},
    "live.listen: '{address}' is not a valid address. Valid: 127.0.0.1 (this computer alone), 0.0.0.0 (all), "
    "or an address of this computer."};
inline constexpr MessageText listen_failed{
    "live.listen_failed",
    {"host", "port", "reason"},
    "live: cannot listen on {host}:{port}: {reason}. Give an address of this computer with live.listen."};
inline constexpr MessageText mission_file_missing{
    "live.mission_file_missing",
    "this flight was not started from a mission file, so its parameters cannot be saved. Write them into a "
    "file by hand"};
inline constexpr MessageText more_refused{
    "live.more_refused", "this message has further faults. Correct those above, and send it again"};
inline constexpr MessageText op_form_invalid{"live.op_form_invalid",
                                             {"reason"},
                                             "the message does not have the form that its op requires: "
                                             "{reason}. The Foxglove WebSocket protocol describes the form"};
inline constexpr MessageText op_unknown{
    "live.op_unknown", {"op", "choices"}, "there is no op '{op}'.{choices}"};
inline constexpr MessageText parameter_name_invalid{
    "live.parameter_name_invalid",
    {"choices"},
    "the name lacks its component; write COMPONENT.PARAMETER.{choices}"};
inline constexpr MessageText parameter_not_record{
    "live.parameter_not_record",
    {"component", "parameter"},
    "{component}.{parameter} is not a record: only the fields of a record can be requested here"};
inline constexpr MessageText parameter_not_removable{
    "live.parameter_not_removable", "the value is missing. A parameter cannot be removed; send a value"};
inline constexpr MessageText parameter_overlaid{"live.parameter_overlaid",
                                                {"parameter", "phase"},
                                                "{parameter} is set, but the phase '{phase}' has another "
                                                "value for it. The new one acts after this phase"};
inline constexpr MessageText parameter_path_unknown{
    "live.parameter_path_unknown", {"parameter", "choices"}, "there is no parameter '{parameter}'.{choices}"};
inline constexpr MessageText parameter_unknown{"live.parameter_unknown",
                                               {"component", "parameter", "choices"},
                                               "there is no parameter '{component}.{parameter}'.{choices}"};
inline constexpr MessageText port_in_use{
    "live.port_in_use",
    {"host", "port"},
    "live: cannot listen on {host}:{port}: another program has the port. End that program, or choose another "
    "port with live.listen (port 0: any that is free)."};
inline constexpr MessageText request_invalid{
    "live.request_invalid", {"reason"}, "the request does not match its message type: {reason}"};
inline constexpr MessageText request_not_object{
    "live.request_not_object",
    "the payload is not a JSON object: send one with the fields of the message type"};
inline constexpr MessageText request_text_missing{
    "live.request_text_missing",
    {"key"},
    "the request has no text '{key}': add \"{key}\": \"...\" to its JSON object"};
inline constexpr MessageText request_too_deep{"live.request_too_deep",
                                              "the JSON is nested too deeply: at most 32 levels are valid"};
inline constexpr MessageText save_answer_invalid{
    "live.save_answer_invalid",
    "fulmar-save did not answer with valid JSON; it is of another version. Build both again: cmake --build "
    "build --target flight"};
inline constexpr MessageText save_in_progress{
    "live.save_in_progress", "parameters of another client are being saved; send the request again"};
inline constexpr MessageText save_not_allowed{
    "live.save_not_allowed", {"reason"}, "this flight writes no parameters into files: {reason}"};
inline constexpr MessageText save_program_failed{"live.save_program_failed",
                                                 {"program", "code"},
                                                 "{program} ended with exit code {code}. The terminal of the "
                                                 "flight shows the reason; correct it, and save again"};
inline constexpr MessageText save_program_killed{
    "live.save_program_killed",
    {"program", "signal"},
    "signal {signal} stopped {program}. Each file that it has written is complete; save again"};
inline constexpr MessageText save_program_missing{
    "live.save_program_missing",
    "the program fulmar-save, which writes parameters into files, is missing beside this one. Build it: "
    "cmake --build build --target flight"};
inline constexpr MessageText save_timed_out{"live.save_timed_out",
                                            {"program", "limit"},
                                            "{program} has not answered within {limit} s; the host stopped "
                                            "it. Each file that it has written is complete; save again"};
inline constexpr MessageText service_unknown{
    "live.service_unknown",
    {"service"},
    "there is no service {service}: take an id from the server's 'advertiseServices' message"};
inline constexpr MessageText subscription_in_use{
    "live.subscription_in_use",
    {"subscription"},
    "this client already has a subscription {subscription}: choose another id, or send 'unsubscribe' first"};
inline constexpr MessageText subscription_unknown{
    "live.subscription_unknown",
    {"subscription"},
    "this client has no subscription {subscription}: take an id from its own 'subscribe' message"};
inline constexpr MessageText too_many_channels{
    "live.too_many_channels",
    {"limit"},
    "a client may advertise at most {limit} channels: send 'unadvertise' for one first"};
inline constexpr MessageText too_many_parameters{
    "live.too_many_parameters",
    {"limit"},
    "one message sets at most {limit} parameters: divide it into several messages"};
inline constexpr MessageText topic_not_imported{"live.topic_not_imported",
                                                {"topic", "choices"},
                                                "'{topic}' accepts no messages: add it to dds.import of the "
                                                "mission, or choose an imported topic.{choices}"};
inline constexpr MessageText topic_type_differs{
    "live.topic_type_differs",
    {"topic", "type", "found"},
    "{topic} has the type {type}, but schemaName is {found}: advertise it with {type}"};

}  // namespace fulmar::live_messages

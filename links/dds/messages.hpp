// SPDX-License-Identifier: BSD-3-Clause
// The messages of this folder: code, arguments, sentence (fulmar/diagnostic.hpp).
#pragma once
#include "fulmar/diagnostic.hpp"

namespace fulmar::dds_messages {

inline constexpr MessageText address_invalid{
    "dds.address_invalid",
    {"address"},
    "dds: '{address}' is not an IPv4 address. Give one such as 127.0.0.1 in dds.interfaces and dds.peers"};
inline constexpr MessageText domain_out_of_range{"dds.domain_out_of_range",
                                                 {"domain", "limit"},
                                                 "dds.domain: {domain} is outside the range of 0 to {limit}"};
inline constexpr MessageText element_not_finite{
    "dds.element_not_finite", "an item of the list is NaN or infinite: give finite numbers"};
inline constexpr MessageText exported_port_unknown{
    "dds.exported_port_unknown", {"port", "choices"}, "dds.export: there is no '{port}' to export.{choices}"};
inline constexpr MessageText interface_unknown{
    "dds.interface_unknown",
    {"place", "address", "addresses"},
    "{place}dds.interfaces: {address} is not an address of this computer. Valid: {addresses}"};
inline constexpr MessageText number_not_finite{"dds.number_not_finite",
                                               "the value is NaN or infinite: give a finite number"};
inline constexpr MessageText parameter_type_invalid{
    "dds.parameter_type_invalid",
    "the value has an unsupported type. Give a bool, an integer, a double, a string, or an array of integers "
    "or doubles"};
inline constexpr MessageText parameter_type_unknown{
    "dds.parameter_type_unknown",
    {"type"},
    "the value has the type {type}. Valid: 0 to 9, as in rcl_interfaces/msg/ParameterType"};
inline constexpr MessageText parameter_unknown{
    "dds.parameter_unknown", {"parameter", "choices"}, "there is no parameter '{parameter}'.{choices}"};
inline constexpr MessageText participant_not_created{
    "dds.participant_not_created",
    {"domain", "addresses"},
    "dds: no participant could be created in domain {domain} on {addresses}. Set dds.interfaces to addresses "
    "of this computer, or choose another dds.domain"};
inline constexpr MessageText peer_reliability_differs{
    "dds.peer_reliability_differs",
    {"topic"},
    "dds: another participant requires reliable delivery of {topic}, but its export has best_effort, so it "
    "gets no data. Remove best_effort, or set that reader to best effort"};
inline constexpr MessageText peer_type_differs{
    "dds.peer_type_differs",
    {"action", "topic", "found", "type"},
    "dds: another participant {action} {topic} with the type {found}; here it is {type}, so no data flows. "
    "Choose another topic name, or use one type"};
inline constexpr MessageText reader_not_created{"dds.reader_not_created",
                                                {"topic"},
                                                "dds: the topic {topic} could not be opened for reading. The "
                                                "error output of Fast DDS on the terminal has the reason"};
inline constexpr MessageText sample_refused{"dds.sample_refused",
                                            {"topic", "port", "reason"},
                                            "dds: a sample of {topic} for {port} is rejected: {reason}. "
                                            "Correct its publisher; further ones are only counted"};
inline constexpr MessageText several_parameters{
    "dds.several_parameters",
    "set_parameters_atomically accepts one parameter a call: use set_parameters for several"};
inline constexpr MessageText too_many_parameters{
    "dds.too_many_parameters",
    {"limit"},
    "the call has more than {limit} parameters: divide it into several calls"};
inline constexpr MessageText too_many_requests{
    "dds.too_many_requests",
    {"count"},
    "{count} requests already wait for an answer: wait for one, then send this one again"};
inline constexpr MessageText topic_not_created{"dds.topic_not_created",
                                               {"topic"},
                                               "dds: the topic {topic} could not be created. The error "
                                               "output of Fast DDS on the terminal has the reason"};
inline constexpr MessageText topic_type_differs{
    "dds.topic_type_differs",
    {"topic", "type", "found"},
    "dds: the topic {topic} is used with two types, {type} and {found}. Change the topic name of one in "
    "dds.export or dds.import"};
inline constexpr MessageText writer_not_created{"dds.writer_not_created",
                                                {"topic"},
                                                "dds: the topic {topic} could not be opened for writing. The "
                                                "error output of Fast DDS on the terminal has the reason"};

}  // namespace fulmar::dds_messages

// SPDX-License-Identifier: BSD-3-Clause
// The messages of this folder: code, arguments, sentence (fulmar/diagnostic.hpp).
#pragma once
#include "fulmar/diagnostic.hpp"

namespace fulmar::dds_messages {

inline constexpr MessageText address_invalid{
    "dds.address_invalid", {"address"}, "dds: '{address}' is not an IPv4 address such as 127.0.0.1"};
inline constexpr MessageText domain_out_of_range{
    "dds.domain_out_of_range", {"domain", "limit"}, "dds: domain {domain} is outside 0 .. {limit}"};
inline constexpr MessageText element_not_finite{"dds.element_not_finite",
                                                "the value holds a number that is not finite"};
inline constexpr MessageText exported_port_unknown{
    "dds.exported_port_unknown", {"port", "choices"}, "dds.export: there is no '{port}' to export.{choices}"};
inline constexpr MessageText interface_unknown{
    "dds.interface_unknown",
    {"place", "address", "addresses"},
    "{place}dds.interfaces: {address} is not an address of this computer. Valid: {addresses}"};
inline constexpr MessageText number_not_finite{"dds.number_not_finite", "the value is not a finite number"};
inline constexpr MessageText parameter_type_invalid{
    "dds.parameter_type_invalid",
    "a parameter is a number, a flag, a text or a list of numbers, and cannot be deleted"};
inline constexpr MessageText parameter_type_unknown{
    "dds.parameter_type_unknown", {"type"}, "there is no parameter type {type}"};
inline constexpr MessageText parameter_unknown{
    "dds.parameter_unknown", {"parameter", "choices"}, "there is no parameter '{parameter}'.{choices}"};
inline constexpr MessageText participant_not_created{
    "dds.participant_not_created",
    {"domain", "addresses"},
    "dds: no participant could be created in domain {domain} on {addresses}; are these addresses of this "
    "computer?"};
inline constexpr MessageText peer_reliability_differs{
    "dds.peer_reliability_differs",
    {"topic"},
    "dds: another participant reads {topic} reliably, but its export has best_effort: the two do not match"};
inline constexpr MessageText peer_type_differs{"dds.peer_type_differs",
                                               {"action", "topic", "found", "type"},
                                               "dds: another participant {action} {topic} with the type "
                                               "{found}; here it is {type}: the two do not match"};
inline constexpr MessageText reader_not_created{
    "dds.reader_not_created", {"topic"}, "dds: the topic {topic} could not be opened for reading"};
inline constexpr MessageText sample_refused{
    "dds.sample_refused",
    {"topic", "port", "reason"},
    "dds: a sample of {topic} for {port} is refused: {reason}. Further ones are only counted"};
inline constexpr MessageText several_parameters{
    "dds.several_parameters",
    "several parameters cannot be set at one instant; set_parameters sets one after another"};
inline constexpr MessageText too_many_parameters{
    "dds.too_many_parameters", {"limit"}, "the call has more than {limit} parameters"};
inline constexpr MessageText too_many_requests{
    "dds.too_many_requests", {"count"}, "{count} requests wait for an answer; there is no room for more"};
inline constexpr MessageText topic_not_created{
    "dds.topic_not_created", {"topic"}, "dds: the topic {topic} could not be created"};
inline constexpr MessageText topic_type_differs{
    "dds.topic_type_differs",
    {"topic", "type", "found"},
    "dds: the topic {topic} has the type {type} here; the type {found} is not possible"};
inline constexpr MessageText writer_not_created{
    "dds.writer_not_created", {"topic"}, "dds: the topic {topic} could not be opened for writing"};

}  // namespace fulmar::dds_messages

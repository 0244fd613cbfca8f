// SPDX-License-Identifier: BSD-3-Clause
// The messages of this folder: code, arguments, sentence (fulmar/diagnostic.hpp).
#pragma once
#include "fulmar/diagnostic.hpp"

namespace fulmar::reading_messages {

inline constexpr MessageText field_incomplete{
    "reading.field_incomplete",
    "a field requires a type and a name, as in float64 height. Correct the definition in the program that "
    "records the message"};
inline constexpr MessageText field_name_too_long{
    "reading.field_name_too_long",
    "the name of the field is longer than 256 characters. Correct the definition in the program that records "
    "the message"};
inline constexpr MessageText field_type_unknown{
    "reading.field_type_unknown",
    {"type", "choices"},
    "the message definition has no type {type}. Correct it in the program that records the "
    "message.{choices}"};
inline constexpr MessageText file_empty{"reading.file_empty", "the file is empty"};
inline constexpr MessageText file_is_directory{"reading.file_is_directory",
                                               "this is a directory; give a log in it"};
inline constexpr MessageText file_missing{"reading.file_missing", "the file does not exist"};
inline constexpr MessageText file_not_readable{
    "reading.file_not_readable", {"file", "reason"}, "cannot read '{file}': {reason}"};
inline constexpr MessageText file_not_regular{"reading.file_not_regular", "this is not a regular file"};
inline constexpr MessageText line_fault{"reading.line_fault", {"line", "reason"}, "'{line}': {reason}"};
inline constexpr MessageText list_length_invalid{
    "reading.list_length_invalid",
    "the length of the list is not valid; write [], [N] or [<=N], where N is a whole number above 0. Correct "
    "the definition in the program that records the message"};
inline constexpr MessageText messages_too_large{
    "reading.messages_too_large",
    {"limit", "time"},
    "more than {limit} MB of messages have the log time {time} s; a comparison cannot hold them. Record "
    "fewer or shorter messages at one time"};
inline constexpr MessageText too_many_fields{
    "reading.too_many_fields",
    "the type has more than 20000 fields, nested ones included. Correct the definition in the program that "
    "records the message"};
inline constexpr MessageText too_many_values{
    "reading.too_many_values",
    {"limit"},
    "a message has more than {limit} values, the limit of this command"};
inline constexpr MessageText type_definition_missing{
    "reading.type_definition_missing",
    {"type"},
    "the message definition lacks the definition of {type}, a part of it. Add it in the program that records "
    "the message"};
inline constexpr MessageText type_name_invalid{
    "reading.type_name_invalid",
    {"type"},
    "'{type}' is not a ROS message type; expected the form package/msg/Name, as in std_msgs/msg/Header"};
inline constexpr MessageText type_nesting_invalid{
    "reading.type_nesting_invalid",
    {"type"},
    "{type} has more than 16 levels of nested types, or contains itself. Correct this definition in the "
    "program that writes it"};
inline constexpr MessageText type_too_large{
    "reading.type_too_large",
    {"type", "field", "end", "limit"},
    "{type} is too large: '{field}' ends at {end} bytes; valid: up to {limit}. Shorten its lists in the "
    "program that records the message"};

}  // namespace fulmar::reading_messages

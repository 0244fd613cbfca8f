// SPDX-License-Identifier: BSD-3-Clause
// The messages of this folder: code, arguments, sentence (fulmar/diagnostic.hpp).
#pragma once
#include "fulmar/diagnostic.hpp"

namespace fulmar::types_messages {

inline constexpr MessageText array_shape{"types.array_shape", {"count"}, "an array of {count}"};
inline constexpr MessageText bytes_invalid{
    "types.bytes_invalid", {"type", "reason"}, "a message is not a valid {type}: {reason}"};
inline constexpr MessageText encapsulation_invalid{
    "types.encapsulation_invalid",
    {"found"},
    "a message has the encapsulation {found}; only 1, plain little-endian CDR, is valid"};
inline constexpr MessageText field_not_struct{
    "types.field_not_struct", {"field", "path"}, "'{field}' has no fields, so '{path}' does not exist."};
inline constexpr MessageText field_not_terminated{
    "types.field_not_terminated", {"field"}, "{field} does not end in NUL"};
inline constexpr MessageText field_too_long{
    "types.field_too_long", {"field", "limit"}, "{field} is longer than {limit} bytes"};
inline constexpr MessageText flag_value_invalid{
    "types.flag_value_invalid", {"field", "value"}, "{field} is {value}, which is neither false nor true"};
inline constexpr MessageText frames_differ{
    "types.frames_differ", {"expected", "found"}, "reader has frame {expected}, writer {found}"};
inline constexpr MessageText index_invalid{
    "types.index_invalid",
    {"found", "path"},
    "'{found}' in '{path}' is not valid; an index is written like waypoints[3]."};
inline constexpr MessageText index_missing{
    "types.index_missing", {"field", "shape", "example"}, "'{field}{shape}: write {example}[0]."};
inline constexpr MessageText index_not_allowed{
    "types.index_not_allowed", {"field"}, "'{field}' is a single value and takes no index."};
inline constexpr MessageText index_out_of_range{
    "types.index_out_of_range",
    {"field", "index", "array", "shape"},
    "'{field}[{index}]' does not exist: '{array}{shape}, counted from 0."};
inline constexpr MessageText label_value_invalid{
    "types.label_value_invalid", {"field", "value"}, "{field} is {value}, which has no label"};
inline constexpr MessageText list_shape{"types.list_shape", {"limit"}, "a list of at most {limit}"};
inline constexpr MessageText list_truncated{
    "types.list_truncated",
    "a list has a larger count than its bytes hold. Correct the message in the program that writes it"};
inline constexpr MessageText message_too_long{
    "types.message_too_long",
    {"found", "expected"},
    "a message has {found} bytes, and its definition ends at {expected}. Correct the definition or "
    "the message in the program that writes it"};
inline constexpr MessageText message_too_short{
    "types.message_too_short",
    {"found"},
    "it has {found} bytes, but its header alone has 4. Correct the program that writes it"};
inline constexpr MessageText message_truncated{
    "types.message_truncated",
    {"found", "required"},
    "a message has {found} bytes, and its definition requires at least {required}. Correct the definition or "
    "the message in the program that writes it"};
inline constexpr MessageText name_unknown{
    "types.name_unknown", {"kind", "name", "choices"}, "there is no {kind} '{name}'.{choices}"};
inline constexpr MessageText name_unknown_in{"types.name_unknown_in",
                                             {"owner", "kind", "name", "choices"},
                                             "{owner} has no {kind} '{name}'.{choices}"};
inline constexpr MessageText reader_differs{"types.reader_differs",
                                            {"subject", "expected", "found"},
                                            "reader has {subject}{expected}, writer {found}"};
inline constexpr MessageText text_not_terminated{
    "types.text_not_terminated",
    "a text does not end in NUL. Correct the message in the program that writes it"};
inline constexpr MessageText too_many_items{"types.too_many_items",
                                            {"field", "count", "capacity"},
                                            "{field} has {count} items; its capacity is {capacity}"};
inline constexpr MessageText value_not_finite{
    "types.value_not_finite", {"field", "value"}, "{field} is {value}"};
inline constexpr MessageText value_out_of_range{"types.value_out_of_range",
                                                {"field", "value", "min", "max"},
                                                "{field} is {value}, outside [{min}, {max}]"};
inline constexpr MessageText writer_field_missing{"types.writer_field_missing",
                                                  {"path", "field"},
                                                  "reader has a field '{path}{field}' that the writer lacks"};

}  // namespace fulmar::types_messages

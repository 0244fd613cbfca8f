// SPDX-License-Identifier: BSD-3-Clause
// The messages of this folder: code, arguments, sentence (fulmar/diagnostic.hpp).
#pragma once
#include "fulmar/diagnostic.hpp"

namespace fulmar::save_messages {

inline constexpr MessageText bracket_unclosed{"save.bracket_unclosed", "a bracket is not closed"};
inline constexpr MessageText change_not_effective{"save.change_not_effective", "the file would not say that"};
inline constexpr MessageText component_unknown{
    "save.component_unknown", {"component", "choices"}, "there is no component '{component}'.{choices}"};
inline constexpr MessageText entry_exists{"save.entry_exists", {"entry"}, "{entry} is there already"};
inline constexpr MessageText file_changed{
    "save.file_changed", {"file"}, "{file} has changed meanwhile; nothing was written to it"};
inline constexpr MessageText file_not_writable{
    "save.file_not_writable", {"file", "reason"}, "{file} cannot be written: {reason}"};
inline constexpr MessageText key_without_value{"save.key_without_value", "a key without a value"};
inline constexpr MessageText list_form_unsupported{
    "save.list_form_unsupported", "a list is changed only when it is written in brackets, [a, b, c]"};
inline constexpr MessageText map_expected{"save.map_expected", {"found"}, "{found} is no map"};
inline constexpr MessageText map_is_alias{
    "save.map_is_alias", {"key", "alias"}, "'{key}' is {alias}, which stands elsewhere"};
inline constexpr MessageText mission_file_missing{
    "save.mission_file_missing", {"file"}, "the mission's file {file} is gone"};
inline constexpr MessageText mission_name_mismatch{
    "save.mission_name_mismatch",
    {"file", "mission", "flown_mission"},
    "{file} is the mission '{mission}', but '{flown_mission}' flies: nothing was written"};
inline constexpr MessageText parameter_kind_unknown{
    "save.parameter_kind_unknown",
    {"parameter", "kind"},
    "the parameter '{parameter}' is of a kind that is not known here: '{kind}'"};
inline constexpr MessageText preview_outdated{
    "save.preview_outdated", "what would be written is not what was shown any more: look again"};
inline constexpr MessageText text_shared{
    "save.text_shared", {"parameters"}, "the same text also gives {parameters}"};
inline constexpr MessageText value_form_unsupported{"save.value_form_unsupported",
                                                    "it is written in a form that is not changed here"};
inline constexpr MessageText yaml_invalid{
    "save.yaml_invalid", {"line", "reason"}, "line {line}: not valid YAML: {reason}"};

}  // namespace fulmar::save_messages

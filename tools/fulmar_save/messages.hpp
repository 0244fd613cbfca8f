// SPDX-License-Identifier: BSD-3-Clause
// The messages of this folder: code, arguments, sentence (fulmar/diagnostic.hpp).
#pragma once
#include "fulmar/diagnostic.hpp"

namespace fulmar::save_messages {

inline constexpr MessageText bracket_unclosed{"save.bracket_unclosed", "a bracket is not closed"};
inline constexpr MessageText change_not_effective{"save.change_not_effective",
                                                  "the changed file would not give this value"};
inline constexpr MessageText component_unknown{"save.component_unknown",
                                               {"component", "choices"},
                                               "the component '{component}' does not exist.{choices}"};
inline constexpr MessageText edit_by_hand{
    "save.edit_by_hand",
    {"parameter", "value", "reason"},
    "{parameter} is now {value}. Write it by hand, because this command cannot: {reason}"};
inline constexpr MessageText entry_exists{"save.entry_exists", {"entry"}, "the key {entry} exists already"};
inline constexpr MessageText file_changed{
    "save.file_changed",
    {"file"},
    "{file} has changed since it was read; nothing was written to it. Save again"};
inline constexpr MessageText file_not_writable{
    "save.file_not_writable", {"file", "reason"}, "{file} cannot be written: {reason}"};
inline constexpr MessageText key_without_value{"save.key_without_value", "a key has no value"};
inline constexpr MessageText list_form_unsupported{
    "save.list_form_unsupported",
    "the list is not in brackets; this command changes a list only in the form [a, b, c]"};
inline constexpr MessageText map_expected{"save.map_expected", {"found"}, "{found} is not a map"};
inline constexpr MessageText map_is_alias{
    "save.map_is_alias", {"key", "alias"}, "'{key}' is {alias}, an alias whose value is defined elsewhere"};
inline constexpr MessageText mission_file_missing{
    "save.mission_file_missing",
    {"file"},
    "the mission file {file} no longer exists; put it back, or save to another file with --mission"};
inline constexpr MessageText mission_name_mismatch{
    "save.mission_name_mismatch",
    {"file", "mission", "flown_mission"},
    "{file} is the mission '{mission}', but the flight has '{flown_mission}': nothing was written. Name the "
    "file of '{flown_mission}' with --mission"};
inline constexpr MessageText option_value_saved{
    "save.option_value_saved",
    {"parameter"},
    "{parameter} was given by --set: the change writes it to the mission"};
inline constexpr MessageText parameter_kind_unknown{"save.parameter_kind_unknown",
                                                    {"parameter", "kind"},
                                                    "the parameter '{parameter}' is of the unknown kind "
                                                    "'{kind}'; use the same release of Fulmar on both sides"};
inline constexpr MessageText preview_outdated{
    "save.preview_outdated", "the change differs from the preview: request the preview again"};
inline constexpr MessageText text_of_other_plugin{
    "save.text_of_other_plugin",
    {"parameter", "plugin"},
    "{parameter} is the same text for {plugin}, which does not fly"};
inline constexpr MessageText text_shared{
    "save.text_shared", {"parameters"}, "the same text also sets {parameters}, so a change would alter both"};
inline constexpr MessageText value_form_unsupported{
    "save.value_form_unsupported",
    "the file has a value of another form here (list, map or alias), which this command does not replace; "
    "edit the file"};
inline constexpr MessageText yaml_invalid{
    "save.yaml_invalid", {"line", "reason"}, "line {line}: not valid YAML: {reason}"};

}  // namespace fulmar::save_messages

// SPDX-License-Identifier: BSD-3-Clause
// The messages of this folder: code, arguments, sentence (fulmar/diagnostic.hpp).
#pragma once
#include "fulmar/diagnostic.hpp"

namespace fulmar::ros2_messages {

inline constexpr MessageText field_name_invalid{
    "ros2.field_name_invalid",
    {"message", "field"},
    "{message}.{field} is not a valid field name in ROS. Rename it in the plugin: lower-case letters, digits "
    "and single underscores, a letter first"};
inline constexpr MessageText file_not_writable{
    "ros2.file_not_writable", {"file", "reason"}, "{file} cannot be written: {reason}"};
inline constexpr MessageText folder_expected{
    "ros2.folder_expected", {"path"}, "{path} exists and is not a folder. Name another folder"};
inline constexpr MessageText folder_in_use{
    "ros2.folder_in_use",
    {"folder"},
    "{folder} holds other files; name a folder that is new, empty, or was written by this command."};
inline constexpr MessageText folder_not_creatable{
    "ros2.folder_not_creatable", {"folder", "reason"}, "{folder} cannot be made: {reason}"};
inline constexpr MessageText message_name_ambiguous{
    "ros2.message_name_ambiguous",
    {"message", "first_source", "second_source"},
    "two different messages are called {message}: one of {first_source} and one of {second_source}. Write a "
    "package for each."};
inline constexpr MessageText message_name_invalid{
    "ros2.message_name_invalid",
    {"message"},
    "'{message}' is not a valid name of a ROS message. Rename it in the plugin: a capital letter, then "
    "letters and digits"};

}  // namespace fulmar::ros2_messages

// SPDX-License-Identifier: BSD-3-Clause
// The messages of this folder: code, arguments, sentence (fulmar/diagnostic.hpp).
#pragma once
#include "fulmar/diagnostic.hpp"

namespace fulmar::new_messages {

inline constexpr MessageText component_always_stepped{
    "new.component_always_stepped", "It is stepped from the start, and what it says is logged."};
inline constexpr MessageText component_unspecified{
    "new.component_unspecified",
    "say what it is: --role ROLE, --template sensor, --template planner, or its ports, as in --in "
    "state=nav.state --out range=Range"};
inline constexpr MessageText file_not_readable{"new.file_not_readable", {"file"}, "cannot read {file}"};
inline constexpr MessageText file_not_writable{"new.file_not_writable", {"file"}, "cannot write {file}"};
inline constexpr MessageText folder_is_file{"new.folder_is_file", {"path"}, "{path} is a file, not a folder"};
inline constexpr MessageText folder_not_creatable{
    "new.folder_not_creatable", {"folder", "reason"}, "cannot make the folder {folder}: {reason}"};
inline constexpr MessageText folder_not_empty{
    "new.folder_not_empty", {"folder"}, "the folder {folder} is not empty"};
inline constexpr MessageText input_type_unknown{
    "new.input_type_unknown",
    {"input", "output", "source"},
    "--in {input}={output}: no component says what {source} carries"};
inline constexpr MessageText mission_unknown{
    "new.mission_unknown",
    {"mission", "choices"},
    "--mission {mission}: there is no such file, and no shipped mission of that name.{choices}"};
inline constexpr MessageText missions_missing{
    "new.missions_missing",
    {"folder", "program"},
    "there are no missions in {folder}, and no source tree above {program}"};
inline constexpr MessageText name_in_use{
    "new.name_in_use",
    {"mission", "kind", "name", "suggestion"},
    "the mission {mission} has a {kind} called '{name}' already. Choose another name, as in my_{suggestion}"};
inline constexpr MessageText output_form_invalid{
    "new.output_form_invalid",
    {"output", "found"},
    "--out {output}={found}: write NAME=Message, as in range=Range, or edits=PlanEdit[] for a queue"};
inline constexpr MessageText output_unknown{"new.output_unknown",
                                            {"input", "output", "mission", "choices"},
                                            "--in {input}={output}: {mission} has no such output.{choices}"};
inline constexpr MessageText phase_of_component{
    "new.phase_of_component",
    {"phase", "replaced", "former", "fallback"},
    "It flies in the phase {phase}; {replaced}{former}{fallback}"};
inline constexpr MessageText plugin_name_invalid{
    "new.plugin_name_invalid",
    {"name"},
    "'{name}' is no name for a plugin: letters, digits and _, a letter first, as in my_law"};
inline constexpr MessageText plugin_name_reserved{
    "new.plugin_name_reserved",
    {"name", "suggestion"},
    "'{name}' means something to the build already. Choose another name, as in my_{suggestion}"};
inline constexpr MessageText port_duplicate{
    "new.port_duplicate", {"port"}, "the port '{port}' is asked for twice"};
inline constexpr MessageText program_path_unknown{
    "new.program_path_unknown", {"reason"}, "cannot tell where this program is: {reason}"};
inline constexpr MessageText role_duplicate{"new.role_duplicate", {"role"}, "--role {role} is there twice"};
inline constexpr MessageText role_input_type_unknown{
    "new.role_input_type_unknown",
    {"role", "input", "source"},
    "roles.{role}.in.{input}: no component says what {source} carries"};
inline constexpr MessageText role_inputs_conflict{
    "new.role_inputs_conflict",
    {"role", "input", "source", "other_source"},
    "roles.{role}.in.{input} is {source}, and another of its roles has it from {other_source}: these roles "
    "cannot be filled by one new component"};
inline constexpr MessageText role_outputs_conflict{"new.role_outputs_conflict",
                                                   {"first_role", "second_role", "output"},
                                                   "the roles {first_role} and {second_role} both have an "
                                                   "output '{output}': one component cannot fill both"};
inline constexpr MessageText role_template_unknown{
    "new.role_template_unknown",
    {"template_name", "role", "choices"},
    "--template {template_name}: the role {role} has none of that name.{choices}"};
inline constexpr MessageText role_unknown{
    "new.role_unknown",
    {"role", "mission", "choices"},
    "--role {role}: {mission} has no such role.{choices} What has no role is asked for by --template sensor, "
    "--template planner, --in and --out"};
inline constexpr MessageText role_with_ports{
    "new.role_with_ports", "--role says all ports: --in and --out are of a component without a role"};
inline constexpr MessageText roles_filled{
    "new.roles_filled", {"plural", "roles"}, "fills the role{plural}`{roles}` of"};
inline constexpr MessageText roles_not_filled{"new.roles_not_filled", "stands beside the roles of"};
inline constexpr MessageText roles_template_missing{
    "new.roles_template_missing",
    {"template_name"},
    "--template {template_name}: there is none for several roles at once"};
inline constexpr MessageText template_input_unknown{
    "new.template_input_unknown",
    {"input", "template_name", "choices"},
    "--in {input}: the template {template_name} has no such input.{choices}"};
inline constexpr MessageText template_ports_mismatch{
    "new.template_ports_mismatch",
    {"template_name", "mission"},
    "--template {template_name} is for other ports than {mission} has"};
inline constexpr MessageText template_source_missing{
    "new.template_source_missing",
    {"template_name", "source", "mission", "input"},
    "--template {template_name} reads {source}, which {mission} does not have: say where it comes from, --in "
    "{input}=OWNER.PORT"};
inline constexpr MessageText template_unknown{
    "new.template_unknown",
    {"template_name", "choices"},
    "--template {template_name}: there is none of that name.{choices}"};
inline constexpr MessageText template_with_outputs{
    "new.template_with_outputs", "--out: a template has its own outputs; change them in the source"};
inline constexpr MessageText templates_missing{
    "new.templates_missing",
    {"folder"},
    "there are no templates in {folder}: install the package fulmar-dev"};
inline constexpr MessageText vehicle_replaced{
    "new.vehicle_replaced", {"replaced"}, "It flies from the start, in place of {replaced}."};
inline constexpr MessageText vehicle_with_roles{"new.vehicle_with_roles", "the vehicle fills its role alone"};

}  // namespace fulmar::new_messages

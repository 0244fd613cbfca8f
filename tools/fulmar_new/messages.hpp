// SPDX-License-Identifier: BSD-3-Clause
// The messages of this folder: code, arguments, sentence (fulmar/diagnostic.hpp).
#pragma once
#include "fulmar/diagnostic.hpp"

namespace fulmar::new_messages {

inline constexpr MessageText component_always_stepped{
    "new.component_always_stepped", "The host steps it from the start, and logs its outputs."};
inline constexpr MessageText component_beside_roles{
    "new.component_beside_roles",
    {"component", "mission", "folder"},
    "{component}: a component beside the roles of the mission {mission}, written to {folder}"};
inline constexpr MessageText component_for_roles{
    "new.component_for_roles",
    {"component", "plural", "roles", "mission", "folder"},
    "{component}: a component for the role{plural}{roles} of the mission {mission}, written to {folder}"};
inline constexpr MessageText component_unspecified{
    "new.component_unspecified",
    "the new component is not specified. Give --role ROLE, --template sensor, --template planner, or its "
    "ports, as in --in state=nav.state --out range=Range"};
inline constexpr MessageText file_not_readable{
    "new.file_not_readable", {"file", "reason"}, "cannot read {file}: {reason}"};
inline constexpr MessageText file_not_writable{
    "new.file_not_writable", {"file", "reason"}, "cannot write {file}: {reason}"};
inline constexpr MessageText folder_is_file{
    "new.folder_is_file",
    {"path"},
    "{path} is a file, not a folder; give another name, or move that file away"};
inline constexpr MessageText folder_not_creatable{
    "new.folder_not_creatable", {"folder", "reason"}, "cannot make the folder {folder}: {reason}"};
inline constexpr MessageText folder_not_empty{
    "new.folder_not_empty",
    {"folder"},
    "the folder {folder} is not empty; give another name, or move that folder away"};
inline constexpr MessageText mission_unknown{
    "new.mission_unknown",
    {"mission", "choices"},
    "--mission {mission}: neither a file nor a shipped mission has that name.{choices}"};
inline constexpr MessageText missions_missing{
    "new.missions_missing",
    {"folder", "program"},
    "the folder {folder} has no missions, and no source tree is above {program}. Install Fulmar again, or "
    "run fulmar new of a source tree"};
inline constexpr MessageText name_in_use{
    "new.name_in_use",
    {"mission", "kind", "name", "suggestion"},
    "the mission {mission} already has a {kind} called '{name}'. Choose another name, as in my_{suggestion}"};
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
    "It is active in the phase {phase}; {replaced}{former}{fallback}"};
inline constexpr MessageText plugin_name_invalid{
    "new.plugin_name_invalid",
    {"name"},
    "'{name}' is not a valid plugin name: letters, digits and _, a letter first, as in my_law"};
inline constexpr MessageText plugin_name_reserved{
    "new.plugin_name_reserved",
    {"name", "suggestion"},
    "'{name}' is a reserved name of the build. Choose another name, as in my_{suggestion}"};
inline constexpr MessageText port_duplicate{
    "new.port_duplicate", {"port"}, "the port '{port}' is given twice; give each port its own name"};
inline constexpr MessageText port_form_invalid{
    "new.port_form_invalid", {"option", "found", "form"}, "{option} {found}: write NAME={form}"};
inline constexpr MessageText program_path_unknown{
    "new.program_path_unknown", {"reason"}, "cannot find the path of this program: {reason}"};
inline constexpr MessageText role_duplicate{
    "new.role_duplicate", {"role"}, "--role {role} is given twice; give it once"};
inline constexpr MessageText role_input_type_unknown{
    "new.role_input_type_unknown",
    {"role", "input", "source"},
    "roles.{role}.in.{input}: no component states the message type of {source}. Connect an output of a "
    "component instead"};
inline constexpr MessageText role_inputs_conflict{
    "new.role_inputs_conflict",
    {"role", "input", "source", "other_source"},
    "roles.{role}.in.{input} is {source}, but another of the given roles takes it from {other_source}. Give "
    "--role for only one of them"};
inline constexpr MessageText role_outputs_conflict{"new.role_outputs_conflict",
                                                   {"first_role", "second_role", "output"},
                                                   "the roles {first_role} and {second_role} both have an "
                                                   "output '{output}'. Give --role for only one of them"};
inline constexpr MessageText role_template_unknown{
    "new.role_template_unknown",
    {"template_name", "role", "choices"},
    "--template {template_name}: the role {role} has no template of that name.{choices}"};
inline constexpr MessageText role_unknown{
    "new.role_unknown",
    {"role", "mission", "choices"},
    "--role {role}: {mission} has no such role.{choices} For a component without a role give --template "
    "sensor, --template planner, --in and --out"};
inline constexpr MessageText role_with_ports{"new.role_with_ports",
                                             "--role defines all ports: --in and --out are for a component "
                                             "without a role. Omit --role, or omit these two"};
inline constexpr MessageText roles_filled{
    "new.roles_filled", {"plural", "roles"}, "fills the role{plural}`{roles}` of"};
inline constexpr MessageText roles_not_filled{"new.roles_not_filled", "fills no role of"};
inline constexpr MessageText roles_template_missing{
    "new.roles_template_missing",
    {"template_name", "roles"},
    "--template {template_name} fills one role, but --role is given for {roles}. Give --role once, or omit "
    "--template"};
inline constexpr MessageText template_input_unknown{
    "new.template_input_unknown",
    {"input", "template_name", "choices"},
    "--in {input}: the template {template_name} has no such input.{choices}"};
inline constexpr MessageText template_ports_mismatch{
    "new.template_ports_mismatch",
    {"template_name", "role", "mission", "of_mission", "of_template"},
    "--template {template_name} does not fit the role {role} of {mission}. Ports of the mission alone: "
    "{of_mission}. Ports of the template alone: {of_template}. Omit --template, or give another --mission"};
inline constexpr MessageText template_source_missing{
    "new.template_source_missing",
    {"template_name", "source", "mission", "input"},
    "--template {template_name} reads {source}, which {mission} does not have: give its source with --in "
    "{input}=OWNER.PORT"};
inline constexpr MessageText template_unknown{
    "new.template_unknown",
    {"template_name", "choices"},
    "--template {template_name}: no template has that name.{choices}"};
inline constexpr MessageText template_with_outputs{
    "new.template_with_outputs", "--out: a template has its own outputs; change them in the source"};
inline constexpr MessageText templates_missing{
    "new.templates_missing",
    {"folder"},
    "the folder {folder} has no templates: install the package fulmar-dev"};
inline constexpr MessageText vehicle_replaced{
    "new.vehicle_replaced", {"replaced"}, "It is active from the start, in place of {replaced}."};
inline constexpr MessageText vehicle_with_roles{
    "new.vehicle_with_roles",
    "the role vehicle cannot be combined with other roles; give --role vehicle alone"};

}  // namespace fulmar::new_messages

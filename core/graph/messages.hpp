// SPDX-License-Identifier: BSD-3-Clause
// The messages of this folder: code, arguments, sentence (fulmar/diagnostic.hpp).
#pragma once
#include "fulmar/diagnostic.hpp"

namespace fulmar::graph_messages {

inline constexpr MessageText age_unlimited{
    "graph.age_unlimited",
    {"component", "input", "reason"},
    "{component}.{input} leads to the vehicle and is accepted at any age{reason}"};
inline constexpr MessageText airframe_map_expected{
    "graph.airframe_map_expected", {"found"}, "expected a map with the fields of an airframe; found {found}"};
inline constexpr MessageText anchor_recursive{
    "graph.anchor_recursive", "this alias stands inside the anchor that it names; remove the alias"};
inline constexpr MessageText assignment_expected{"graph.assignment_expected",
                                                 "expected component.parameter=value"};
inline constexpr MessageText comparison_chained{
    "graph.comparison_chained", "a comparison has two sides; join two comparisons with 'and'"};
inline constexpr MessageText comparison_without_field{
    "graph.comparison_without_field",
    {"left", "symbol", "right"},
    "'{left} {symbol} {right}' compares no field; one side must be a field such as nav.state.height_m"};
inline constexpr MessageText component_of_other_io{
    "graph.component_of_other_io",
    {"component", "io"},
    "{component} exists only with io: {io}; name another component, or set io: {io}"};
inline constexpr MessageText component_rate_too_high{
    "graph.component_rate_too_high",
    {"component", "rate", "mission_rate"},
    "components.{component}.rate: {rate} Hz is above the mission's rate of {mission_rate} Hz"};
inline constexpr MessageText components_share_roles{
    "graph.components_share_roles",
    {"first", "first_roles", "second", "second_roles"},
    "{first} ({first_roles}) and {second} ({second_roles}) share roles and cannot be active together. Choose "
    "one of them in this phase."};
inline constexpr MessageText condition_empty{
    "graph.condition_empty", "the condition is empty; write one such as nav.state.height_m > 30 m"};
inline constexpr MessageText condition_expected{
    "graph.condition_expected", "expected a condition under 'when', such as \"nav.state.height_m > 30 m\""};
inline constexpr MessageText condition_text_invalid{
    "graph.condition_text_invalid",
    {"found"},
    "the condition cannot be read at '{found}'. Valid: fields, numbers with units, comparisons, and, or, "
    "not, parentheses."};
inline constexpr MessageText condition_too_deep{
    "graph.condition_too_deep",
    {"limit"},
    "the condition is nested more than {limit} deep; use fewer parentheses and 'not'"};
inline constexpr MessageText condition_too_long{
    "graph.condition_too_long", {"limit"}, "the condition has more than {limit} parts; use a shorter one"};
inline constexpr MessageText conjunction_expected{
    "graph.conjunction_expected", {"found"}, "expected 'and' or 'or' before '{found}'"};
inline constexpr MessageText connection_cycle{
    "graph.connection_cycle",
    {"path", "component"},
    "the connections form a cycle: {path}{component}. Mark one of them, as in {{from: nav.state, delayed: "
    "true}. It then carries the value of the previous tick"};
inline constexpr MessageText connection_left_out{
    "graph.connection_left_out", {"place", "use"}, "{place} is left out: {use} of --with has no such input"};
inline constexpr MessageText contact_not_measured{
    "graph.contact_not_measured",
    {"place", "field", "status"},
    "{place}.{field}: a flight controller does not measure ground contact. Use an estimate such as "
    "ground.state.contact of safety/Ground, or also require {status}.contact_known."};
inline constexpr MessageText control_character_found{
    "graph.control_character_found",
    {"code"},
    "this line has the control character {code}, which is not valid in a mission; remove it"};
inline constexpr MessageText control_role_invalid{
    "graph.control_role_invalid",
    "control: the role vehicle is not valid here; name the roles whose outputs lead to the vehicle"};
inline constexpr MessageText dds_address_invalid{
    "graph.dds_address_invalid",
    {"key", "found"},
    "dds.{key}: expected an IPv4 address such as 192.168.1.7, found '{found}'"};
inline constexpr MessageText dds_domain_invalid{
    "graph.dds_domain_invalid",
    {"found", "limit"},
    "dds.domain: found {found}; expected a whole number from 0 to {limit}"};
inline constexpr MessageText dds_namespace_invalid{
    "graph.dds_namespace_invalid",
    {"found"},
    "dds.namespace: '{found}' is not valid. Write names of letters, digits and _ with '/' between them, such "
    "as fleet/uav1."};
inline constexpr MessageText dds_port_missing{
    "graph.dds_port_missing",
    "dds.export: 'port' is missing, as in {{port: nav.state, topic: /state, rate: 50 Hz}"};
inline constexpr MessageText dds_port_unknown{
    "graph.dds_port_unknown", {"port", "choices"}, "dds.export: there is no port '{port}'.{choices}"};
inline constexpr MessageText dds_rate_too_low{
    "graph.dds_rate_too_low",
    {"found"},
    "dds.export.rate: {found} Hz is too low; expected at least 1.12e-10 Hz"};
inline constexpr MessageText dds_topic_invalid{
    "graph.dds_topic_invalid",
    {"found"},
    "expected a topic such as /nav/state (letters, digits, _ and /), found '{found}'"};
inline constexpr MessageText dds_topic_repeated{
    "graph.dds_topic_repeated",
    {"topic"},
    "dds.export: the topic {topic} is used twice; give each port its own topic"};
inline constexpr MessageText dds_type_differs{
    "graph.dds_type_differs",
    {"topic", "type", "place", "found"},
    "the topic {topic} already carries {type} ({place}) and cannot carry {found}. Choose another topic."};
inline constexpr MessageText dimension_differs{
    "graph.dimension_differs", {"found", "dimension", "expected"}, "{found} is {dimension}not {expected}"};
inline constexpr MessageText document_repeated{"graph.document_repeated",
                                               "a second document begins here; a file holds one"};
inline constexpr MessageText driver_output_invalid{
    "graph.driver_output_invalid",
    {"place", "output", "plugin"},
    "{place}.run: {plugin} cannot be a driver, because its output '{output}' is not a queue. Use run: tick, "
    "async or process."};
inline constexpr MessageText driver_with_input{"graph.driver_with_input",
                                               {"place", "plugin", "input"},
                                               "{place}.run: {plugin} cannot be a driver, because it has the "
                                               "input '{input}'. Use run: tick, async or process."};
inline constexpr MessageText duration_too_long{
    "graph.duration_too_long", {"found"}, "expected less than 285 years, found {found}"};
inline constexpr MessageText duration_too_short{
    "graph.duration_too_short", {"found"}, "expected at least 1 ns, or 0, found {found}"};
inline constexpr MessageText entry_repeated{"graph.entry_repeated", {"entry"}, "'{entry}' is given twice"};
inline constexpr MessageText epoch_invalid{"graph.epoch_invalid", {"reason"}, "epoch: {reason}"};
inline constexpr MessageText event_fields_missing{"graph.event_fields_missing",
                                                  {"port", "type"},
                                                  "'{port}' is {type}; the verdict needs an output with the "
                                                  "text fields 'word' and 'text', such as score.verdict"};
inline constexpr MessageText extends_cycle{
    "graph.extends_cycle",
    {"chain", "name"},
    "extends: the files extend each other: {chain}{name}. Remove 'extends' from one of them"};
inline constexpr MessageText extends_file_invalid{
    "graph.extends_file_invalid", {"reason"}, "extends: {reason}"};
inline constexpr MessageText failsafe_input_unknown{
    "graph.failsafe_input_unknown", {"input", "choices"}, "failsafe: the vehicle has no '{input}'.{choices}"};
inline constexpr MessageText fallback_already_active{
    "graph.fallback_already_active",
    {"place", "component"},
    "{place}.fallback: {component} is already the active component; name another one, or remove fallback"};
inline constexpr MessageText fences_differ{"graph.fences_differ",
                                           {"component", "other"},
                                           "{component}.fence differs from {other}.fence: the aircraft may "
                                           "leave one of them. Give both the same geofence"};
inline constexpr MessageText field_ambiguous{
    "graph.field_ambiguous",
    {"place", "found", "choices"},
    "{place}'{found}' matches each of {choices}; write the full name"};
inline constexpr MessageText field_name_missing{
    "graph.field_name_missing",
    {"found", "type", "fields"},
    "'{found}' is a whole {type}; name one of its fields. Valid: {fields}."};
inline constexpr MessageText field_not_flag{
    "graph.field_not_flag",
    {"field", "plugin", "choices"},
    "'{field}' of {plugin} is not a flag, which is true or false.{choices}"};
inline constexpr MessageText field_not_list{
    "graph.field_not_list", {"field"}, "'{field}' is not a list; write its name without an index"};
inline constexpr MessageText field_not_number{
    "graph.field_not_number",
    {"field", "kind"},
    "'{field}' is {kind}, not a number; name one number such as nav.state.height_m"};
inline constexpr MessageText field_repeated{
    "graph.field_repeated",
    {"first_key", "place"},
    "this key and '{first_key}' ({place}) name the same field; remove one of them"};
inline constexpr MessageText field_unknown{"graph.field_unknown",
                                           {"place", "field", "type", "choices"},
                                           "{place}unknown field '{field}' of {type}.{choices}"};
inline constexpr MessageText field_without_parts{
    "graph.field_without_parts",
    "this field is a single value and has no parts; remove what follows its name"};
inline constexpr MessageText file_is_folder{
    "graph.file_is_folder", {"path"}, "{path} is a folder, not a file; name a file"};
inline constexpr MessageText file_missing{
    "graph.file_missing", {"file", "hint"}, "there is no file {file}{hint}"};
inline constexpr MessageText file_not_private{
    "graph.file_not_private",
    {"name", "file"},
    "{name} is not loaded: all users can write to it; chmod o-w {file}"};
inline constexpr MessageText file_not_readable{
    "graph.file_not_readable", {"name", "reason"}, "{name} cannot be read: {reason}"};
inline constexpr MessageText file_not_regular{
    "graph.file_not_regular", {"path"}, "{path} is not a regular file; name a file on a disk"};
inline constexpr MessageText file_owner_foreign{"graph.file_owner_foreign",
                                                {"name", "user", "file"},
                                                "{name} is not loaded: it belongs to user {user}. Make "
                                                "yourself or root its owner with 'sudo chown $USER {file}'."};
inline constexpr MessageText file_too_large{
    "graph.file_too_large",
    {"file"},
    "{file} is larger than 16 MB, the limit for a mission, an airframe or a plan"};
inline constexpr MessageText filler_unknown{
    "graph.filler_unknown",
    {"component", "role", "choices"},
    "there is no component '{component}' with the role {role}.{choices}"};
inline constexpr MessageText flag_compared_to_label{
    "graph.flag_compared_to_label", {"field", "found"}, "'{field}' is true or false, not '{found}'"};
inline constexpr MessageText flag_compared_to_number{
    "graph.flag_compared_to_number", {"field", "found"}, "'{field}' is true or false, not {found}"};
inline constexpr MessageText flag_expected{
    "graph.flag_expected", {"found"}, "expected true or false, found {found}"};
inline constexpr MessageText flag_name_expected{
    "graph.flag_name_expected",
    {"found", "choices"},
    "expected a field of an output such as status.armed, found '{found}'.{choices}"};
inline constexpr MessageText flag_output_unknown{"graph.flag_output_unknown",
                                                 {"vehicle", "plugin", "output", "choices"},
                                                 "{vehicle} ({plugin}) has no output '{output}'.{choices}"};
inline constexpr MessageText folder_not_private{
    "graph.folder_not_private",
    {"name", "folder"},
    "{name} is not loaded: all users can replace files in its folder; chmod o-w {folder}"};
inline constexpr MessageText hang_misplaced{
    "graph.hang_misplaced", {"place"}, "{place}.hang: the key is valid only with 'run: process'"};
inline constexpr MessageText hardware_component_missing{
    "graph.hardware_component_missing",
    {"role", "reason", "components"},
    "hardware: with io: fcu the role {role} requires a choice: {reason}. Add --role {role}=COMPONENT "
    "({components}), or --with {role}=FILE for a plugin of your own"};
inline constexpr MessageText hardware_not_allowed{
    "graph.hardware_not_allowed", {"reason"}, "hardware: this mission is for simulation only: {reason}"};
inline constexpr MessageText hardware_plugin_missing{
    "graph.hardware_plugin_missing",
    {"component", "reason"},
    "hardware: with io: fcu the component {component} requires a choice: {reason}. Add --with "
    "{component}=FILE"};
inline constexpr MessageText hardware_reason_missing{
    "graph.hardware_reason_missing",
    "hardware: 'because' is missing; write why the mission is not fit for hardware as it is"};
inline constexpr MessageText hardware_value_invalid{
    "graph.hardware_value_invalid",
    {"found"},
    "hardware: expected yes, {{fit: no, because: \"...\"} or {{with: ROLE, because: \"...\"}, found {found}"};
inline constexpr MessageText imported_input_connected{
    "graph.imported_input_connected",
    {"place"},
    "a connection feeds this input already ({place}); remove one of the two"};
inline constexpr MessageText imported_input_invalid{
    "graph.imported_input_invalid",
    "this input is a request, which a topic cannot feed. Remove it from dds.import; clients call it as a "
    "service."};
inline constexpr MessageText imported_input_unknown{
    "graph.imported_input_unknown", {"plugin", "choices"}, "{plugin} has no such input.{choices}"};
inline constexpr MessageText input_disconnected{
    "graph.input_disconnected",
    {"input"},
    "{input}was disconnected here, but is required; connect another output"};
inline constexpr MessageText input_not_connected{
    "graph.input_not_connected", {"input", "outputs"}, "{input}has no connection; {outputs}"};
inline constexpr MessageText integer_invalid{
    "graph.integer_invalid", {"found"}, "{found} is not a whole number"};
inline constexpr MessageText integer_out_of_range{
    "graph.integer_out_of_range", {"found", "min", "max"}, "{found} is outside {min} .. {max}"};
inline constexpr MessageText integer_too_large{
    "graph.integer_too_large", {"found"}, "{found} is larger than 9e15, the largest whole number here"};
inline constexpr MessageText choice_unknown{
    "graph.choice_unknown", {"found", "choices"}, "unknown value '{found}'.{choices}"};
inline constexpr MessageText item_count_invalid{
    "graph.item_count_invalid", {"count", "noun", "limit"}, "{count}{noun}, but this is a list of {limit}"};
inline constexpr MessageText item_incomplete{
    "graph.item_incomplete", {"type", "missing"}, "this {type} is incomplete; add {missing}"};
inline constexpr MessageText item_index_excessive{"graph.item_index_excessive",
                                                  {"count", "noun", "last"},
                                                  "the list has {count}{noun}, counted from [0] to [{last}]"};
inline constexpr MessageText item_index_invalid{
    "graph.item_index_invalid", {"found"}, "'{found}' is not an index of a list, as in [0]"};
inline constexpr MessageText item_index_missing{
    "graph.item_index_missing", {"path"}, "is a list; name one of its items, as in {path}[0]"};
inline constexpr MessageText key_not_scalar{"graph.key_not_scalar",
                                            "a key must be a word, not a list, a map or nothing"};
inline constexpr MessageText key_repeated{
    "graph.key_repeated", {"key", "line"}, "'{key}' is given twice; the first is in line {line}"};
inline constexpr MessageText key_unknown{
    "graph.key_unknown", {"place", "key", "choices"}, "{place}unknown key '{key}'.{choices}"};
inline constexpr MessageText label_expected{
    "graph.label_expected",
    {"field", "labels"},
    "'{field}' must be compared with one of its labels. Valid: {labels}."};
inline constexpr MessageText label_unknown{
    "graph.label_unknown", {"field", "found", "choices"}, "'{field}' is never '{found}'.{choices}"};
inline constexpr MessageText labels_differ{
    "graph.labels_differ",
    {"left", "right"},
    "'{left}' and '{right}' have different labels and cannot be compared. Compare each with a label."};
inline constexpr MessageText latency_misplaced{
    "graph.latency_misplaced", {"place"}, "{place}.latency: the key is valid only with 'run: async'"};
inline constexpr MessageText latency_missing{"graph.latency_missing",
                                             "'run: async' requires a latency above 0, as in latency: 200 "
                                             "ms. The outputs of the component appear after this time"};
inline constexpr MessageText list_empty{"graph.list_empty",
                                        "the list is empty and has no item to set; give the whole list"};
inline constexpr MessageText list_not_rising{
    "graph.list_not_rising",
    {"found", "reason"},
    "each value must be larger than the one before it, but {found}{reason}"};
inline constexpr MessageText live_address_invalid{
    "graph.live_address_invalid",
    {"found"},
    "live.listen: expected an address and a port such as 127.0.0.1:8765, found '{found}'"};
inline constexpr MessageText live_option_invalid{
    "graph.live_option_invalid",
    {"found"},
    "--live {found}: expected an address and a port such as 127.0.0.1:8765, or off"};
inline constexpr MessageText live_tiles_invalid{
    "graph.live_tiles_invalid",
    {"found"},
    "live.tiles: '{found}' is not a tile address. Write http:// or https://, a host, and a path with {{z}, "
    "{{x} and {{y} once each. Not valid in it: blanks, quotes, and any of , ; < > \\ #. Example: "
    "https://tile.example.org/{{z}/{{x}/{{y}.png"};
inline constexpr MessageText live_tiles_missing{
    "graph.live_tiles_missing",
    "live.attribution names the source of live.tiles. Set live.tiles, or remove live.attribution."};
inline constexpr MessageText live_token_missing{
    "graph.live_token_missing",
    {"host"},
    "live.listen: other computers can reach {host}. Set a token in FULMAR_TOKEN or live.token, which every "
    "client must then present. Otherwise listen on 127.0.0.1"};
inline constexpr MessageText map_expected{"graph.map_expected",
                                          {"place", "keys", "found"},
                                          "{place}expected a map with the keys {keys}; found {found}"};
inline constexpr MessageText memory_exhausted{
    "graph.memory_exhausted", "there is not enough memory to read this file; end other programs"};
inline constexpr MessageText memory_size_invalid{
    "graph.memory_size_invalid",
    {"found"},
    "'{found}' is not an amount of memory; write a number above 0 and up to 1e6 with kB, MB or GB, as in "
    "64 MB"};
inline constexpr MessageText message_types_differ{
    "graph.message_types_differ",
    {"output", "type", "component", "input", "reason"},
    "{output} and {component}.{input} have different versions of {type}: {reason}. Build both plugins with "
    "the same Fulmar."};
inline constexpr MessageText message_types_mismatch{
    "graph.message_types_mismatch",
    {"component", "input", "type", "output", "found"},
    "{component}.{input} takes {type}, but {output} is {found}. Connect an output of type {type}"};
inline constexpr MessageText mission_name_invalid{
    "graph.mission_name_invalid",
    {"found"},
    "mission: '{found}' is not valid; a name has no '/', tab or line break"};
inline constexpr MessageText mission_parameter_misplaced{
    "graph.mission_parameter_misplaced",
    {"place", "parameter", "key"},
    "{place}.{parameter}: the value comes from the mission's '{key}'; set it there"};
inline constexpr MessageText mission_rate_invalid{
    "graph.mission_rate_invalid",
    {"component", "rate", "min", "max", "plugin"},
    "components.{component}: the mission's rate of {rate} Hz is outside {min} .. {max} Hz of {plugin}; "
    "change 'rate' of the mission"};
inline constexpr MessageText more_faults{
    "graph.more_faults", {"limit"}, "there are more faults than these {limit}"};
inline constexpr MessageText name_invalid{
    "graph.name_invalid",
    {"found"},
    "'{found}' is not a name. A name has letters, digits and _, and no digit in front."};
inline constexpr MessageText name_too_long{
    "graph.name_too_long",
    {"name", "length", "limit"},
    "'{name}' has {length} characters; the limit for a name is {limit}"};
inline constexpr MessageText number_compared_to_label{
    "graph.number_compared_to_label",
    {"field", "found"},
    "'{field}' is a number and cannot be compared with '{found}'; compare it with a number"};
inline constexpr MessageText number_count_invalid{
    "graph.number_count_invalid",
    {"count", "names", "found"},
    "expected {count} numbers [{names}], found {found} of them"};
inline constexpr MessageText number_invalid{"graph.number_invalid", {"found"}, "'{found}' is not a number"};
inline constexpr MessageText number_not_finite{
    "graph.number_not_finite", {"found"}, "{found} is not a finite number"};
inline constexpr MessageText number_not_representable{
    "graph.number_not_representable", {"found"}, "{found} is too large or too small for a number"};
inline constexpr MessageText number_too_large{
    "graph.number_too_large", {"found"}, "{found} is too large for a number"};
inline constexpr MessageText operand_expected{
    "graph.operand_expected", {"found"}, "expected a field or a number before '{found}'"};
inline constexpr MessageText operand_fault{"graph.operand_fault", {"field", "fault"}, "'{field}': {fault}"};
inline constexpr MessageText operand_missing{"graph.operand_missing",
                                             "the condition ends where a field or a number is expected"};
inline constexpr MessageText operand_not_boolean{
    "graph.operand_not_boolean", {"operand"}, "'{operand}' is not true or false; compare it with a value"};
inline constexpr MessageText operand_not_field{
    "graph.operand_not_field",
    {"found"},
    "'{found}' is not a field; a field is written like nav.state.height_m"};
inline constexpr MessageText operand_not_scalar{
    "graph.operand_not_scalar",
    {"operand", "kind"},
    "'{operand}' is {kind}; a condition takes a number, a label, or true or false"};
inline constexpr MessageText operand_unordered{
    "graph.operand_unordered", {"operand"}, "'{operand}' has no order; compare it with == or !="};
inline constexpr MessageText operands_incomparable{
    "graph.operands_incomparable",
    {"left", "right"},
    "'{left}' and '{right}' are of different kinds and cannot be compared. Compare two numbers, two labels, "
    "or two true/false fields."};
inline constexpr MessageText operator_invalid{
    "graph.operator_invalid", {"found", "remedy"}, "a condition has no operator '{found}'; {remedy}"};
inline constexpr MessageText output_name_invalid{
    "graph.output_name_invalid",
    {"place", "found"},
    "{place}.out: '{found}' is not an output name. Write letters, digits and _, and '?' at the end when it "
    "is optional."};
inline constexpr MessageText output_not_provided{
    "graph.output_not_provided",
    {"input", "role", "output"},
    "{input}requires {role}.{output}, which no component with the role {role} provides in this run. Connect "
    "another output, or choose another component."};
inline constexpr MessageText output_repeated{"graph.output_repeated",
                                             {"place", "output"},
                                             "{place}.out: '{output}' is given twice, with '?' and without"};
inline constexpr MessageText outputs_not_in_flight{
    "graph.outputs_not_in_flight",
    {"keys"},
    "without {keys}: the component or its output is not in this flight"};
inline constexpr MessageText parameter_in_record{
    "graph.parameter_in_record",
    {"use", "parameter", "suggestion", "record"},
    "{use} has no parameter '{parameter}'. Did you mean {suggestion}, a field of the record '{record}'?"};
inline constexpr MessageText parameter_missing{
    "graph.parameter_missing",
    {"component", "parameter", "description", "remedy"},
    "components.{component}: the parameter '{parameter}' is missing{description}{remedy}"};
inline constexpr MessageText parameter_name_expected{
    "graph.parameter_name_expected",
    {"found"},
    "expected a parameter such as manage.first_item, found '{found}'"};
inline constexpr MessageText parameter_not_live{
    "graph.parameter_not_live",
    {"parameter"},
    "{parameter} is not a live parameter. Only live parameters can be set by resume; remove this one."};
inline constexpr MessageText parameter_not_number{
    "graph.parameter_not_number", {"parameter"}, "{parameter} is not a number; resume sets only numbers"};
inline constexpr MessageText parenthesis_unclosed{"graph.parenthesis_unclosed", "a ')' is missing"};
inline constexpr MessageText parenthesis_unopened{"graph.parenthesis_unopened", "a ')' has no matching '('"};
inline constexpr MessageText path_not_accessible{
    "graph.path_not_accessible", {"path", "reason"}, "{path} cannot be examined: {reason}"};
inline constexpr MessageText phase_parameter_fixed{
    "graph.phase_parameter_fixed",
    {"place", "parameter", "live"},
    "{place}.{parameter}: the parameter is fixed when the flight begins; a phase can set only live "
    "parameters. Live: {live}."};
inline constexpr MessageText phase_parameter_unknown{"graph.phase_parameter_unknown",
                                                     {"component", "parameter", "choices"},
                                                     "{component} has no parameter '{parameter}'.{choices}"};
inline constexpr MessageText phase_set_repeated{
    "graph.phase_set_repeated",
    {"component"},
    "'set' of {component} is given twice; give it at one of its roles"};
inline constexpr MessageText phase_settings_lost{
    "graph.phase_settings_lost",
    {"role", "component", "phase", "parameters"},
    "--role {role}={component}: {component} also has the role in the phase {phase}, which sets {parameters}; "
    "{component} has no such live parameter. Name another component"};
inline constexpr MessageText phase_unreachable{
    "graph.phase_unreachable",
    {"phase", "first_phase"},
    "phases.{phase}: no transition leads here from {first_phase}, where the flight begins. Add a transition, "
    "or remove the phase"};
inline constexpr MessageText phase_vehicle_fixed{
    "graph.phase_vehicle_fixed",
    "the vehicle does not change in flight; choose it with io or with --role vehicle=NAME. A phase can 'set' "
    "live parameters of the active vehicle"};
inline constexpr MessageText plugin_component_unknown{
    "graph.plugin_component_unknown",
    {"reason", "name", "plugin", "component"},
    "{reason} Name one, as in --with {name}={plugin}/{component}"};
inline constexpr MessageText plugin_file_missing{
    "graph.plugin_file_missing",
    {"plugin"},
    "there is no plugin file '{plugin}'; correct the path, or build the plugin"};
inline constexpr MessageText plugin_name_too_long{"graph.plugin_name_too_long",
                                                  {"component", "kind", "name", "plugin", "length", "limit"},
                                                  "components.{component}: the {kind} '{name}' of {plugin} "
                                                  "has {length} characters; the limit for a name is {limit}"};
inline constexpr MessageText plugin_not_admitted{
    "graph.plugin_not_admitted",
    {"plugin", "state"},
    "{plugin}{state}. Give it with --with to load it all the same."};
inline constexpr MessageText plugin_path_invalid{"graph.plugin_path_invalid",
                                                 {"path", "state"},
                                                 "'{path}{state}. The file of a plugin ends in .so or .py. "
                                                 "The name of a component follows it, as in my_law.so/Law"};
inline constexpr MessageText plugin_unknown{"graph.plugin_unknown",
                                            {"plugin", "folders", "choices"},
                                            "there is no plugin '{plugin}'. Searched in {folders}.{choices}"};
inline constexpr MessageText plugin_without_components{
    "graph.plugin_without_components", {"plugin"}, "{plugin} has no component; name another plugin"};
inline constexpr MessageText port_expected{
    "graph.port_expected", {"found"}, "expected a port such as nav.state, found '{found}'"};
inline constexpr MessageText port_name_expected{
    "graph.port_name_expected", {"example", "found"}, "expected a port such as {example}, found '{found}'"};
inline constexpr MessageText port_not_provided{
    "graph.port_not_provided",
    {"component", "port"},
    "no component provides {component}.{port} in this run; name another output"};
inline constexpr MessageText probe_not_connectable{
    "graph.probe_not_connectable",
    {"output"},
    "{output} is a probe: a number for observation, not a message to connect"};
inline constexpr MessageText probe_without_fields{
    "graph.probe_without_fields",
    {"component", "probe"},
    "'{component}.{probe}' is a probe: one number, without fields"};
inline constexpr MessageText program_not_installed{"graph.program_not_installed",
                                                   ": 'fulmar:' names files of an installed Fulmar, and this "
                                                   "one is not installed; write the path of the file"};
inline constexpr MessageText quantity_negative{
    "graph.quantity_negative", {"value"}, "{value} is negative; expected 0 or more"};
inline constexpr MessageText quantity_not_positive{
    "graph.quantity_not_positive", {"value"}, "{value} is not above 0"};
inline constexpr MessageText rate_out_of_range{
    "graph.rate_out_of_range", {"found"}, "rate: {found} is outside 0.1 .. 100000 Hz"};
inline constexpr MessageText record_field_hint{
    "graph.record_field_hint", {"example"}, "; to change one thing in a record, name it, as in {example}"};
inline constexpr MessageText record_incomplete{
    "graph.record_incomplete",
    {"place", "type", "missing", "hint"},
    "{place}this record is not a whole {type}, missing: {missing}{hint}"};
inline constexpr MessageText record_map_expected{"graph.record_map_expected",
                                                 {"type", "found"},
                                                 "expected a map with the fields of {type}, found {found}"};
inline constexpr MessageText record_pattern_invalid{
    "graph.record_pattern_invalid",
    {"reason"},
    "{reason}. Valid: all, nav.*, or nav.*,outer.attitude@100Hz."};
inline constexpr MessageText record_port_unknown{"graph.record_port_unknown",
                                                 {"pattern", "suggestion"},
                                                 "record.ports: '{pattern}' matches no port.{suggestion}"};
inline constexpr MessageText record_rate_invalid{"graph.record_rate_invalid",
                                                 "a rate is from 0.001 to 1e6 Hz"};
inline constexpr MessageText removed_connection_missing{
    "graph.removed_connection_missing",
    {"place", "input", "suggestion"},
    "{place}.in: there is no connection '{input}' to remove{suggestion}"};
inline constexpr MessageText removed_key_missing{"graph.removed_key_missing",
                                                 {"place", "base", "key", "suggestion"},
                                                 "{place}{base} has no '{key}' to remove{suggestion}"};
inline constexpr MessageText request_source_invalid{
    "graph.request_source_invalid",
    {"component", "input", "output"},
    "{component}.{input} is a request, but {output} is published in every step. Connect an output that can "
    "stay silent: an event or a queue."};
inline constexpr MessageText role_ambiguous{
    "graph.role_ambiguous",
    {"role", "components"},
    "{role} is the role of several components: {components}. Name one of them"};
inline constexpr MessageText role_empty{
    "graph.role_empty", {"role"}, "no component fills the role {role}; name a component in its place"};
inline constexpr MessageText role_filled_by_other{"graph.role_filled_by_other",
                                                  {"component", "roles", "role", "choices"},
                                                  "{component} has the role {roles}, not {role}.{choices}"};
inline constexpr MessageText role_groups_overlap{
    "graph.role_groups_overlap",
    {"place", "roles", "other", "other_roles"},
    "{place}the roles {roles} overlap with {other_roles} of {other}. Give both the same roles, or one of "
    "them a single role."};
inline constexpr MessageText role_filler_hint{
    "graph.role_filler_hint", {"role"}, "; add 'fills: {role}' to a component"};
inline constexpr MessageText role_input_unknown{
    "graph.role_input_unknown",
    {"role", "suggestion"},
    "no component that fills {role} has such an input. Did you mean '{suggestion}'?"};
inline constexpr MessageText role_inputs_conflict{
    "graph.role_inputs_conflict",
    {"component", "input"},
    "components.{component}: its roles feed '{input}' from different outputs; write the valid one under the "
    "component's own 'in'"};
inline constexpr MessageText role_name_taken{
    "graph.role_name_taken", {"role"}, "roles.{role}: a component has the same name; rename one of them"};
inline constexpr MessageText role_not_filled{
    "graph.role_not_filled", {"role", "reason"}, "roles.{role}: no component fills this role{reason}"};
inline constexpr MessageText role_not_filled_by{"graph.role_not_filled_by",
                                                {"component", "role", "choices"},
                                                "{component} does not have the role {role}.{choices}"};
inline constexpr MessageText role_output_differs{
    "graph.role_output_differs",
    {"component", "output", "other", "reason"},
    "components.{component}: its '{output}' differs from that of {other}: {reason}. Build both plugins with "
    "the same Fulmar."};
inline constexpr MessageText role_output_missing{
    "graph.role_output_missing",
    {"place", "role", "output", "type", "found"},
    "{place}the role {role} requires an output '{output}' of type {type}{found}"};
inline constexpr MessageText role_outputs_clash{
    "graph.role_outputs_clash",
    {"place", "output"},
    "{place}two of these roles have an output '{output}'; one component cannot fill both"};
inline constexpr MessageText save_not_enabled{
    "graph.save_not_enabled",
    {"host"},
    "values cannot be saved: other computers can reach {host}. Set live: {{save: on} to allow it."};
inline constexpr MessageText save_off{
    "graph.save_off",
    "the mission does not allow to save values. Remove live: {{save: off}, or edit the file by hand."};
inline constexpr MessageText seed_invalid{
    "graph.seed_invalid", {"found"}, "seed: expected a whole number from 0, found {found}"};
inline constexpr MessageText setting_hidden{
    "graph.setting_hidden",
    {"parameter", "value", "phases"},
    "--set {parameter}={value} has no effect in {phases}: a phase sets this parameter"};
inline constexpr MessageText simulated_input{
    "graph.simulated_input",
    {"component", "input", "port"},
    "{component}.{input} takes vehicle.{port}, which exists only in simulation. Connect another output, "
    "because {component} steers the aircraft or decides its phase."};
inline constexpr MessageText simulated_output{"graph.simulated_output",
                                              {"place"},
                                              "{place} exists only in simulation; a transition on hardware "
                                              "cannot use it. Use an output of a component"};
inline constexpr MessageText source_missing{"graph.source_missing",
                                            "'from' is missing, as in {{from: nav.state, max_age: 0.5 s}"};
inline constexpr MessageText still_named{
    "graph.still_named",
    {"name", "places"},
    "this file removes {name}, but these still name it: {places}. Change or remove them, too"};
inline constexpr MessageText stored_file_missing{
    "graph.stored_file_missing",
    {"file"},
    "the log holds no file {file}, so its mission cannot be read; use the log as fulmar run wrote it"};
inline constexpr MessageText summary_key_reserved{
    "graph.summary_key_reserved", {"key"}, "'{key}' is a key of every result; choose another name"};
inline constexpr MessageText summary_of_probe{
    "graph.summary_of_probe",
    {"probe"},
    "'{probe}' is a probe; a summary needs a message such as score.tracking"};
inline constexpr MessageText text_field_missing{
    "graph.text_field_missing",
    {"port", "type"},
    "'{port}' is {type}; 'tell' needs an output with a text field 'text', such as vehicle.notices"};
inline constexpr MessageText text_too_long{
    "graph.text_too_long", {"size", "limit"}, "the text has {size} bytes; the limit is {limit}"};
inline constexpr MessageText three_numbers_expected{
    "graph.three_numbers_expected", {"names", "found"}, "expected three numbers [{names}], found {found}"};
inline constexpr MessageText time_invalid{
    "graph.time_invalid",
    {"found"},
    "'{found}' is not a UTC time from 1970 to 2200 such as 2026-01-01T00:00Z"};
inline constexpr MessageText too_many_entries{
    "graph.too_many_entries", {"count", "limit"}, "{count} entries exceed the limit of {limit} in a mission"};
inline constexpr MessageText transition_key_missing{
    "graph.transition_key_missing",
    {"key"},
    "'{key}' is missing, as in {{to: cruise, when: \"nav.state.height_m > 30 m\"}"};
inline constexpr MessageText unit_examples{
    "graph.unit_examples", {"quantity", "examples"}, "{quantity} is written with {examples}"};
inline constexpr MessageText unit_missing{
    "graph.unit_missing", {"found", "hint"}, "{found} has no unit; {hint}"};
inline constexpr MessageText unit_not_accepted{
    "graph.unit_not_accepted", {"unit"}, "the unit here is {unit}"};
inline constexpr MessageText unit_unknown{
    "graph.unit_unknown", {"unit", "hint"}, "unknown unit '{unit}'{hint}"};
inline constexpr MessageText units_differ{
    "graph.units_differ",
    {"left", "left_unit", "right", "right_unit"},
    "'{left}' is in {left_unit} and '{right}' in {right_unit}; they cannot be compared"};
inline constexpr MessageText use_missing{
    "graph.use_missing", "'use' is missing; it names the plugin, as in use: control_slc/Outer"};
inline constexpr MessageText value_exceeds_field{
    "graph.value_exceeds_field", {"found"}, "{found} is too large for this field, which ends at 3.4e38"};
inline constexpr MessageText value_not_valid{
    "graph.value_not_valid", {"expected", "found"}, "expected {expected}, found {found}"};
inline constexpr MessageText value_out_of_range{"graph.value_out_of_range",
                                                {"found", "min", "max", "unit", "hint"},
                                                "{found} is outside {min} .. {max}{unit}{hint}"};
inline constexpr MessageText value_too_large{
    "graph.value_too_large", {"found", "max", "unit", "hint"}, "{found} is above {max}{unit}{hint}"};
inline constexpr MessageText value_too_small{
    "graph.value_too_small", {"found", "min", "unit", "hint"}, "{found} is below {min}{unit}{hint}"};
inline constexpr MessageText vehicle_expected{"graph.vehicle_expected",
                                              {"place", "plugin"},
                                              "{place}{plugin} is not a vehicle and cannot fill the role "
                                              "vehicle: it has 'step' in place of 'read' and 'write'"};
inline constexpr MessageText vehicle_flag_invalid{
    "graph.vehicle_flag_invalid", {"flag", "reason"}, "roles.vehicle.flags.{flag}: {reason}"};
inline constexpr MessageText vehicle_flags_missing{
    "graph.vehicle_flags_missing",
    {"vehicle", "plugin", "flags", "output", "example", "choices"},
    "with io: fcu the vehicle must report whether it is armed, on the ground and in control. {vehicle} "
    "({plugin}) has no flag {flags} in an output '{output}'. Name its own flags at the role vehicle, as in "
    "flags: {{{example}}.{choices}"};
inline constexpr MessageText vehicle_missing{
    "graph.vehicle_missing", "no component is a vehicle; a mission requires one, such as use: sim_aero"};
inline constexpr MessageText vehicle_role_invalid{
    "graph.vehicle_role_invalid",
    {"place", "plugin", "role"},
    "{place}{plugin} is a vehicle and can fill only the role vehicle, not {role}"};
inline constexpr MessageText vehicle_roles_shared{
    "graph.vehicle_roles_shared",
    {"place"},
    "{place}the vehicle fills only the role vehicle; remove its other roles"};
inline constexpr MessageText vehicle_run_invalid{
    "graph.vehicle_run_invalid",
    {"place"},
    "{place}.run: a vehicle runs in the loop; only 'run: tick' is valid"};
inline constexpr MessageText vehicle_without_flags{"graph.vehicle_without_flags",
                                                   " It has no flag in any output."};
inline constexpr MessageText vehicles_repeated{
    "graph.vehicles_repeated", {"vehicles"}, "a mission has one vehicle; found {vehicles}"};
inline constexpr MessageText yaml_invalid{"graph.yaml_invalid", {"reason"}, "not valid YAML: {reason}"};
inline constexpr MessageText yaml_text_too_large{
    "graph.yaml_text_too_large",
    {"limit"},
    "the file has more than {limit} MB of text when all aliases are filled in"};
inline constexpr MessageText yaml_too_deep{
    "graph.yaml_too_deep", {"limit"}, "the file is nested more than {limit} deep"};
inline constexpr MessageText yaml_too_many_values{
    "graph.yaml_too_many_values",
    {"limit"},
    "the file has more than {limit} values when all aliases are filled in"};

}  // namespace fulmar::graph_messages

// SPDX-License-Identifier: BSD-3-Clause
// The messages of this folder: code, arguments, sentence (fulmar/diagnostic.hpp).
#pragma once
#include "fulmar/diagnostic.hpp"

namespace fulmar::loader_messages {

inline constexpr MessageText checksum_not_available{"loader.checksum_not_available",
                                                    "SHA-256 is not available."};
inline constexpr MessageText choice_count_invalid{
    "loader.choice_count_invalid",
    {"parameter", "count"},
    "{parameter} has {count} choices, which is outside the valid range"};
inline constexpr MessageText component_count_invalid{
    "loader.component_count_invalid",
    {"count"},
    "the plugin has {count} components, which is outside the valid range"};
inline constexpr MessageText component_repeated{
    "loader.component_repeated", {"component"}, "the plugin has two components '{component}'"};
inline constexpr MessageText copy_not_readable{"loader.copy_not_readable", {"file"}, "cannot read {file}"};
inline constexpr MessageText default_not_choice{
    "loader.default_not_choice", {"parameter"}, "{parameter} has a default that is none of its choices"};
inline constexpr MessageText default_not_flag{
    "loader.default_not_flag", {"parameter"}, "{parameter} has a default that is neither 0 nor 1"};
inline constexpr MessageText default_out_of_range{
    "loader.default_out_of_range", {"parameter"}, "{parameter} has a default outside its range"};
inline constexpr MessageText default_outside_memory{"loader.default_outside_memory",
                                                    "the default lies outside the plugin's memory"};
inline constexpr MessageText default_too_long{
    "loader.default_too_long",
    {"parameter", "capacity"},
    "{parameter} has a default that does not fit into {capacity} bytes"};
inline constexpr MessageText elements_overlap{
    "loader.elements_overlap", {"field"}, "{field} has elements that overlap"};
inline constexpr MessageText elf_header_truncated{"loader.elf_header_truncated",
                                                  "is not a plugin: its ELF header is truncated"};
inline constexpr MessageText elf_missing{"loader.elf_missing", "is not a plugin: not an ELF shared object"};
inline constexpr MessageText elf_not_shared{"loader.elf_not_shared",
                                            "is not a plugin: an ELF file, but not a shared object"};
inline constexpr MessageText entry_outside_memory{"loader.entry_outside_memory",
                                                  "the entry lies outside the plugin's memory"};
inline constexpr MessageText entry_symbol_missing{
    "loader.entry_symbol_missing", {"file", "symbol"}, "{file} has no symbol {symbol}: not a Fulmar plugin"};
inline constexpr MessageText field_alignment_invalid{
    "loader.field_alignment_invalid", {"field"}, "field '{field}' is aligned more strictly than the struct"};
inline constexpr MessageText field_name_invalid{
    "loader.field_name_invalid", {"found"}, "'{found}' is not a valid name for a field"};
inline constexpr MessageText field_not_aligned{
    "loader.field_not_aligned", {"field"}, "{field} is not aligned"};
inline constexpr MessageText field_outside_struct{
    "loader.field_outside_struct", {"field"}, "field '{field}' reaches beyond the struct"};
inline constexpr MessageText field_repeated{
    "loader.field_repeated", {"type", "field"}, "{type} has two fields '{field}'"};
inline constexpr MessageText field_shape_unknown{
    "loader.field_shape_unknown",
    {"field", "shape"},
    "{field} has shape {shape}, which this host does not support"};
inline constexpr MessageText field_without_elements{
    "loader.field_without_elements", {"field"}, "{field} has room for no element"};
inline constexpr MessageText fields_overlap{
    "loader.fields_overlap", {"field", "next_field"}, "fields '{field}' and '{next_field}' overlap"};
inline constexpr MessageText file_fault{"loader.file_fault", {"file", "fault"}, "{file} {fault}"};
inline constexpr MessageText file_not_readable{
    "loader.file_not_readable", {"file", "reason"}, "cannot read {file}: {reason}."};
inline constexpr MessageText float_mode_changed{"loader.float_mode_changed",
                                                "has changed the floating-point mode of the process"};
inline constexpr MessageText function_missing{
    "loader.function_missing", {"owner", "function"}, "{owner} lacks the function {function}"};
inline constexpr MessageText function_outside_code{
    "loader.function_outside_code",
    {"function", "owner"},
    "the function {function} of {owner} lies outside the plugin's code"};
inline constexpr MessageText items_overlap_count{
    "loader.items_overlap_count", {"field"}, "{field} has items that overlap its count"};
inline constexpr MessageText label_count_invalid{
    "loader.label_count_invalid",
    {"field", "count"},
    "{field} is an enum with {count} labels, which is outside the valid range"};
inline constexpr MessageText machine_differs{
    "loader.machine_differs", {"found", "expected"}, "is built for {found}, this host is {expected}"};
inline constexpr MessageText name_invalid{"loader.name_invalid",
                                          {"item", "found"},
                                          "{item} is '{found}': letters, digits and underscores are valid"};
inline constexpr MessageText parameter_repeated{
    "loader.parameter_repeated", {"owner", "parameter"}, "{owner} has two parameters '{parameter}'"};
inline constexpr MessageText pipe_not_created{
    "loader.pipe_not_created", {"reason"}, "cannot create a pipe: {reason}."};
inline constexpr MessageText plugin_abi_differs{
    "loader.plugin_abi_differs",
    {"file", "plugin_abi", "host_abi"},
    "{file} is built for ABI {plugin_abi}; this host has ABI {host_abi}"};
inline constexpr MessageText plugin_changes_float_mode{
    "loader.plugin_changes_float_mode",
    {"plugin"},
    "{plugin} changes the floating-point mode when it is loaded (built with -ffast-math?)"};
inline constexpr MessageText plugin_crashed{"loader.plugin_crashed",
                                            {"plugin", "stage", "signal", "output"},
                                            "{plugin} crashed while being {stage} (signal {signal}){output}"};
inline constexpr MessageText plugin_ended_process{
    "loader.plugin_ended_process",
    {"plugin", "stage", "code", "output"},
    "{plugin} ended the process while being {stage} (exit code {code}){output}"};
inline constexpr MessageText plugin_in_use{
    "loader.plugin_in_use", {"plugin"}, "{plugin} is still in use and cannot be unloaded"};
inline constexpr MessageText plugin_missing{
    "loader.plugin_missing", {"plugin", "file"}, "{plugin} does not exist: no file {file}"};
inline constexpr MessageText plugin_not_loadable{
    "loader.plugin_not_loadable", {"plugin", "reason"}, "{plugin} cannot be loaded: {reason}"};
inline constexpr MessageText plugin_not_mappable{
    "loader.plugin_not_mappable",
    {"plugin", "reason"},
    "{plugin} cannot be mapped: the plugin store may lie on a file system that forbids execution; set "
    "FULMAR_STORE ({reason})"};
inline constexpr MessageText plugin_not_readable{
    "loader.plugin_not_readable", {"plugin", "reason"}, "{plugin} cannot be read: {reason}"};
inline constexpr MessageText plugin_not_regular{"loader.plugin_not_regular",
                                                {"plugin", "file"},
                                                "{plugin} is not a plugin: {file} is not a regular file"};
inline constexpr MessageText plugin_still_resident{
    "loader.plugin_still_resident",
    {"plugin"},
    "{plugin} is still resident after unloading (a unique symbol or a thread-local destructor keeps it); "
    "restart the host"};
inline constexpr MessageText plugin_too_large{
    "loader.plugin_too_large", {"plugin"}, "{plugin} is not a plugin: it is larger than 1 GiB"};
inline constexpr MessageText plugin_truncated{
    "loader.plugin_truncated",
    {"expected", "found"},
    "is truncated: its header states {expected} bytes, the file has {found}"};
inline constexpr MessageText port_is_input{
    "loader.port_is_input", {"port"}, "{port} is an input among the outputs"};
inline constexpr MessageText port_is_output{
    "loader.port_is_output", {"port"}, "{port} is an output among the inputs"};
inline constexpr MessageText port_kind_unknown{
    "loader.port_kind_unknown",
    {"port", "kind"},
    "{port} has the unknown kind {kind}: build the plugin again with the SDK of this host"};
inline constexpr MessageText port_repeated{
    "loader.port_repeated", {"owner", "kind", "port"}, "{owner} has two {kind}{port}'"};
inline constexpr MessageText probe_not_started{
    "loader.probe_not_started", {"plugin", "reason"}, "{plugin} cannot be probed: {reason}"};
inline constexpr MessageText probe_program_missing{"loader.probe_program_missing",
                                                   {"program"},
                                                   "the program fulmar-probe is missing beside {program}: "
                                                   "the host cannot test plugins before it loads them."};
inline constexpr MessageText probe_timed_out{
    "loader.probe_timed_out", {"plugin", "stage", "limit"}, "{plugin} did not finish {stage} within {limit}"};
inline constexpr MessageText program_headers_damaged{
    "loader.program_headers_damaged",
    "is damaged or incomplete (its ELF program headers are wrong); build or copy it again"};
inline constexpr MessageText program_not_started{
    "loader.program_not_started", {"program", "reason"}, "cannot start {program}: {reason}."};
inline constexpr MessageText queue_size_invalid{
    "loader.queue_size_invalid",
    {"port", "capacity"},
    "{port} is a queue with room for {capacity} items, which is outside the valid range"};
inline constexpr MessageText range_empty{
    "loader.range_empty", {"parameter"}, "{parameter} has an empty range"};
inline constexpr MessageText required_library_missing{"loader.required_library_missing",
                                                      {"plugin", "library"},
                                                      "{plugin} requires {library}, which is missing"};
inline constexpr MessageText required_symbol_missing{
    "loader.required_symbol_missing",
    {"plugin", "symbol"},
    "{plugin} requires the symbol {symbol}, which no library provides"};
inline constexpr MessageText required_version_missing{
    "loader.required_version_missing",
    {"plugin", "version"},
    "{plugin} requires {version}, which this system does not have"};
inline constexpr MessageText scalar_count_invalid{
    "loader.scalar_count_invalid", {"field", "count"}, "{field} is one value but has count {count}"};
inline constexpr MessageText script_changes_float_mode{
    "loader.script_changes_float_mode",
    {"script"},
    "{script} changes the floating-point mode when it is loaded"};
inline constexpr MessageText script_host_invalid{
    "loader.script_host_invalid",
    {"script", "plugin"},
    "{script} cannot be opened: the plugin {plugin} hosts no scripts"};
inline constexpr MessageText script_host_missing{
    "loader.script_host_missing",
    {"script", "plugin", "folders"},
    "{script} requires the plugin {plugin}, which is missing. Searched in {folders}. The build makes this "
    "plugin where the development packages of the language are installed."};
inline constexpr MessageText script_not_opened{
    "loader.script_not_opened", {"file"}, "{file} cannot be opened; its host gives no reason"};
inline constexpr MessageText store_fault{"loader.store_fault", {"reason"}, "{reason}."};
inline constexpr MessageText store_not_created{
    "loader.store_not_created", {"folder"}, "the plugin store {folder} (FULMAR_STORE) cannot be created"};
inline constexpr MessageText store_not_folder{
    "loader.store_not_folder", {"folder"}, "the plugin store {folder} is not a folder."};
inline constexpr MessageText store_not_private{"loader.store_not_private",
                                               {"folder"},
                                               "other users can write to the plugin store {folder}; chmod "
                                               "700 it, or set FULMAR_STORE to another folder."};
inline constexpr MessageText store_not_writable{
    "loader.store_not_writable", {"folder"}, "cannot write into the plugin store {folder}"};
inline constexpr MessageText store_owner_foreign{
    "loader.store_owner_foreign",
    {"folder"},
    "the plugin store {folder} belongs to another user; set FULMAR_STORE to a folder of your own."};
inline constexpr MessageText store_suffix_invalid{
    "loader.store_suffix_invalid", {"suffix"}, "the plugin store keeps no {suffix} files."};
inline constexpr MessageText stored_plugin_missing{
    "loader.stored_plugin_missing",
    {"file", "version", "sha256", "store"},
    "the plugin store {store} no longer holds {file} {version} with SHA-256 {sha256}, which the flight used. "
    "Put that file back, or choose another with --with"};
inline constexpr MessageText struct_alignment_invalid{
    "loader.struct_alignment_invalid",
    {"type", "alignment", "size"},
    "{type} has an alignment of {alignment} and a size of {size}, which is not valid"};
inline constexpr MessageText struct_size_invalid{
    "loader.struct_size_invalid",
    {"type", "size"},
    "{type} has a size of {size} bytes, which is outside the valid range"};
inline constexpr MessageText table_outside_memory{
    "loader.table_outside_memory", {"elements"}, "{elements} lie outside the plugin's memory"};
inline constexpr MessageText table_stride_invalid{
    "loader.table_stride_invalid",
    {"elements", "stride", "minimum"},
    "{elements} have a stride of {stride} bytes; an aligned stride of at least {minimum} bytes is required"};
inline constexpr MessageText temporary_store_missing{"loader.temporary_store_missing",
                                                     "no folder for private copies of plugins"};
inline constexpr MessageText text_memory_exhausted{
    "loader.text_memory_exhausted", {"size"}, "there is no memory for a text of {size} bytes"};
inline constexpr MessageText text_missing{
    "loader.text_missing", {"item"}, "{item} is missing (a null pointer)"};
inline constexpr MessageText text_not_terminated{
    "loader.text_not_terminated", {"item"}, "{item} does not end in NUL"};
inline constexpr MessageText text_outside_memory{
    "loader.text_outside_memory", {"item"}, "{item} lies outside the plugin's memory"};
inline constexpr MessageText too_many_fields{
    "loader.too_many_fields", {"type", "count", "limit"}, "{type} has {count} fields; the limit is {limit}"};
inline constexpr MessageText too_many_parameters{"loader.too_many_parameters",
                                                 {"owner", "count", "limit"},
                                                 "{owner} has {count} parameters; the limit is {limit}"};
inline constexpr MessageText too_many_ports{"loader.too_many_ports",
                                            {"ports", "count", "limit"},
                                            "{ports}: {count} ports exceed the limit of {limit}"};
inline constexpr MessageText type_missing{"loader.type_missing", {"item"}, "{item} has no type"};
inline constexpr MessageText type_name_missing{"loader.type_name_missing", "the type has no name"};
inline constexpr MessageText type_outside_memory{"loader.type_outside_memory",
                                                 "the type lies outside the plugin's memory"};
inline constexpr MessageText type_too_deep{
    "loader.type_too_deep", {"item", "limit"}, "{item} nests deeper than {limit} levels"};
inline constexpr MessageText unique_symbol_shared{
    "loader.unique_symbol_shared",
    {"plugin", "symbol", "other"},
    "{plugin} has the unique symbol {symbol}, as has the loaded {other}. One plugin would use the data of "
    "the other. Build both with -fno-gnu-unique, or as fulmar_add_plugin does"};
inline constexpr MessageText word_size_differs{"loader.word_size_differs",
                                               "is built for another word size or byte order"};

}  // namespace fulmar::loader_messages

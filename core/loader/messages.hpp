// SPDX-License-Identifier: BSD-3-Clause
// The messages of this folder: code, arguments, sentence (fulmar/diagnostic.hpp).
#pragma once
#include "fulmar/diagnostic.hpp"

namespace fulmar::loader_messages {

inline constexpr MessageText checksum_not_available{
    "loader.checksum_not_available",
    "OpenSSL does not compute SHA-256 here; allow SHA-256 in its configuration (openssl.cnf)"};
inline constexpr MessageText choice_count_invalid{"loader.choice_count_invalid",
                                                  {"parameter", "count"},
                                                  "{parameter} has {count} choices; 1 to 1024 are valid"};
inline constexpr MessageText component_count_invalid{
    "loader.component_count_invalid", {"count"}, "the plugin has {count} components; 1 to 256 are valid"};
inline constexpr MessageText component_repeated{
    "loader.component_repeated",
    {"component"},
    "the plugin has two components '{component}'; rename one of them"};
inline constexpr MessageText copy_not_readable{
    "loader.copy_not_readable",
    {"file"},
    "cannot read {file}, the private copy of a script; start the flight again to make a new copy"};
inline constexpr MessageText default_not_choice{
    "loader.default_not_choice",
    {"parameter"},
    "{parameter} has a default that is none of its choices; set one of them as its default in the plugin"};
inline constexpr MessageText default_not_flag{
    "loader.default_not_flag",
    {"parameter"},
    "{parameter} has a default that is neither 0 nor 1; set one of the two in the plugin"};
inline constexpr MessageText default_out_of_range{
    "loader.default_out_of_range",
    {"parameter", "found", "min", "max"},
    "{parameter} has the default {found} in the plugin; its range is {min} to {max}"};
inline constexpr MessageText default_outside_memory{
    "loader.default_outside_memory",
    "the default lies outside the plugin's memory; point initial_data at static data of the plugin"};
inline constexpr MessageText default_too_long{"loader.default_too_long",
                                              {"parameter", "capacity"},
                                              "{parameter} has a default that does not fit into {capacity} "
                                              "bytes; shorten it, or state a capacity up to 65536"};
inline constexpr MessageText elements_overlap{
    "loader.elements_overlap",
    {"field"},
    "{field} has elements that overlap; state a stride of at least the size of an element"};
inline constexpr MessageText elf_header_truncated{
    "loader.elf_header_truncated", "is not a plugin: its ELF header is truncated. Build or copy it again"};
inline constexpr MessageText elf_missing{
    "loader.elf_missing",
    "is not a plugin: not an ELF shared object. Name the .so file that the build makes"};
inline constexpr MessageText elf_not_shared{
    "loader.elf_not_shared", "is not a plugin: an ELF file, but not a shared object. Link it with -shared"};
inline constexpr MessageText entry_outside_memory{
    "loader.entry_outside_memory",
    "the entry lies outside the plugin's memory; build the plugin again with the SDK of this host"};
inline constexpr MessageText entry_symbol_missing{"loader.entry_symbol_missing",
                                                  {"file", "symbol"},
                                                  "{file} has no symbol {symbol}: not a Fulmar plugin. Name "
                                                  "another file, or add FULMAR_PLUGIN to its source"};
inline constexpr MessageText field_alignment_invalid{
    "loader.field_alignment_invalid",
    {"field"},
    "field '{field}' is aligned more strictly than the struct; give the struct the alignment of this field"};
inline constexpr MessageText field_name_invalid{
    "loader.field_name_invalid",
    {"found"},
    "'{found}' is not a valid name for a field; write letters, digits and underscores, no digit first"};
inline constexpr MessageText field_not_aligned{
    "loader.field_not_aligned",
    {"field"},
    "{field} is not aligned; its offset and stride must be multiples of the alignment of its elements"};
inline constexpr MessageText field_outside_struct{
    "loader.field_outside_struct",
    {"field"},
    "field '{field}' reaches beyond the struct; correct the offset of the field or the size of the struct"};
inline constexpr MessageText field_repeated{
    "loader.field_repeated", {"type", "field"}, "{type} has two fields '{field}'; rename one of them"};
inline constexpr MessageText field_shape_unknown{"loader.field_shape_unknown",
                                                 {"field", "shape"},
                                                 "{field} has shape {shape}, which this host does not "
                                                 "support; build the plugin again with the SDK of this host"};
inline constexpr MessageText field_without_elements{
    "loader.field_without_elements",
    {"field"},
    "{field} has room for no element; state a count of 1 or more"};
inline constexpr MessageText fields_overlap{
    "loader.fields_overlap",
    {"field", "next_field"},
    "fields '{field}' and '{next_field}' overlap; correct their offsets"};
inline constexpr MessageText file_fault{"loader.file_fault", {"file", "fault"}, "{file} {fault}"};
inline constexpr MessageText file_not_readable{
    "loader.file_not_readable", {"file", "reason"}, "cannot read {file}: {reason}."};
inline constexpr MessageText float_mode_changed{"loader.float_mode_changed",
                                                "has changed the floating-point mode of the process"};
inline constexpr MessageText function_missing{
    "loader.function_missing",
    {"owner", "function"},
    "{owner} lacks the function {function}; set it in the table of the plugin"};
inline constexpr MessageText function_outside_code{
    "loader.function_outside_code",
    {"function", "owner"},
    "the function {function} of {owner} lies outside the plugin's code; point at a function of the plugin, "
    "or at none"};
inline constexpr MessageText items_overlap_count{
    "loader.items_overlap_count",
    {"field"},
    "{field} has items that overlap its count; state an items offset of at least 4 bytes"};
inline constexpr MessageText label_count_invalid{
    "loader.label_count_invalid",
    {"field", "count"},
    "{field} is an enum with {count} labels; 1 to 256 are valid"};
inline constexpr MessageText machine_differs{
    "loader.machine_differs",
    {"found", "expected"},
    "is built for {found}, this host is {expected}. Build it for {expected}"};
inline constexpr MessageText name_invalid{
    "loader.name_invalid",
    {"item", "found"},
    "{item} is '{found}'; write letters, digits and underscores, no digit first"};
inline constexpr MessageText parameter_repeated{
    "loader.parameter_repeated",
    {"owner", "parameter"},
    "{owner} has two parameters '{parameter}'; rename one of them"};
inline constexpr MessageText pipe_not_created{
    "loader.pipe_not_created", {"reason"}, "cannot create a pipe: {reason}."};
inline constexpr MessageText plugin_abi_differs{"loader.plugin_abi_differs",
                                                {"file", "plugin_abi", "host_abi"},
                                                "{file} is built for ABI {plugin_abi}; this host has ABI "
                                                "{host_abi}. Build the plugin with the SDK of this host"};
inline constexpr MessageText plugin_changes_float_mode{
    "loader.plugin_changes_float_mode",
    {"plugin"},
    "{plugin} changes the floating-point mode when it is loaded. Compile and link it without -ffast-math, "
    "and set no mode in its global code"};
inline constexpr MessageText plugin_crashed{"loader.plugin_crashed",
                                            {"plugin", "stage", "signal", "output"},
                                            "{plugin} crashed while being {stage} (signal {signal}){output}. "
                                            "Correct the code that runs then, often that of a global object"};
inline constexpr MessageText plugin_ended_process{
    "loader.plugin_ended_process",
    {"plugin", "stage", "code", "output"},
    "{plugin} ended the process while being {stage} (exit code {code}){output}. Correct the code that runs "
    "then, so that it does not exit"};
inline constexpr MessageText plugin_in_use{
    "loader.plugin_in_use",
    {"plugin"},
    "{plugin} is still in use and cannot be unloaded; end its flight first"};
inline constexpr MessageText plugin_missing{
    "loader.plugin_missing",
    {"plugin", "file"},
    "{plugin} does not exist: no file {file}. Correct the path, or build the plugin"};
inline constexpr MessageText plugin_not_loadable{
    "loader.plugin_not_loadable",
    {"plugin", "reason"},
    "{plugin} cannot be loaded: {reason}. Build or copy it again"};
inline constexpr MessageText plugin_not_mappable{
    "loader.plugin_not_mappable",
    {"plugin", "reason"},
    "{plugin} cannot be mapped: {reason}. The plugin store may forbid execution; set FULMAR_STORE to a "
    "folder on a file system that allows it"};
inline constexpr MessageText plugin_not_readable{
    "loader.plugin_not_readable", {"plugin", "reason"}, "{plugin} cannot be read: {reason}"};
inline constexpr MessageText plugin_not_regular{
    "loader.plugin_not_regular",
    {"plugin", "file"},
    "{plugin} is not a plugin: {file} is not a regular file. Name a .so or .py file"};
inline constexpr MessageText plugin_still_resident{
    "loader.plugin_still_resident",
    {"plugin"},
    "{plugin} is still resident after unloading (a unique symbol or a thread-local destructor keeps it); "
    "restart the host"};
inline constexpr MessageText plugin_too_large{"loader.plugin_too_large",
                                              {"plugin"},
                                              "{plugin} is not a plugin: it is larger than 1 GiB. Name a .so "
                                              "or .py file, or build it without debug information"};
inline constexpr MessageText plugin_truncated{
    "loader.plugin_truncated",
    {"expected", "found"},
    "is truncated: its header states {expected} bytes, the file has {found}. Copy or build it again"};
inline constexpr MessageText port_is_input{
    "loader.port_is_input",
    {"port"},
    "{port} is an input among the outputs; move it to the inputs of the component"};
inline constexpr MessageText port_is_output{
    "loader.port_is_output",
    {"port"},
    "{port} is an output among the inputs; move it to the outputs of the component"};
inline constexpr MessageText port_kind_unknown{
    "loader.port_kind_unknown",
    {"port", "kind"},
    "{port} has the unknown kind {kind}: build the plugin again with the SDK of this host"};
inline constexpr MessageText port_repeated{
    "loader.port_repeated", {"owner", "kind", "port"}, "{owner} has two {kind}{port}'; rename one of them"};
inline constexpr MessageText probe_not_started{
    "loader.probe_not_started", {"plugin", "reason"}, "{plugin} cannot be probed: {reason}"};
inline constexpr MessageText probe_program_missing{
    "loader.probe_program_missing",
    {"program"},
    "the program fulmar-probe is missing beside {program}, so no plugin can be tested and loaded. Install "
    "Fulmar again, or build it: cmake --build build --target flight"};
inline constexpr MessageText probe_timed_out{
    "loader.probe_timed_out",
    {"plugin", "stage", "limit"},
    "{plugin} did not finish {stage} within {limit}. Shorten the code that runs then, or set a longer time "
    "in FULMAR_PROBE_SECONDS"};
inline constexpr MessageText program_headers_damaged{
    "loader.program_headers_damaged",
    "is damaged or incomplete (its ELF program headers are wrong); build or copy it again"};
inline constexpr MessageText program_not_started{
    "loader.program_not_started", {"program", "reason"}, "cannot start {program}: {reason}."};
inline constexpr MessageText queue_size_invalid{
    "loader.queue_size_invalid",
    {"port", "capacity"},
    "{port} is a queue with room for {capacity} items; 1 to 65536 are valid"};
inline constexpr MessageText range_empty{
    "loader.range_empty", {"parameter"}, "{parameter} has an empty range; its min must not be above its max"};
inline constexpr MessageText required_library_missing{
    "loader.required_library_missing",
    {"plugin", "library"},
    "{plugin} requires {library}, which is missing. Install that library, or add its folder to "
    "LD_LIBRARY_PATH"};
inline constexpr MessageText required_symbol_missing{
    "loader.required_symbol_missing",
    {"plugin", "symbol"},
    "{plugin} requires the symbol {symbol}, which no library provides. Define it, or link the library that "
    "defines it"};
inline constexpr MessageText required_version_missing{
    "loader.required_version_missing",
    {"plugin", "version"},
    "{plugin} requires {version}, which this system does not have. Build the plugin on this system"};
inline constexpr MessageText scalar_count_invalid{
    "loader.scalar_count_invalid",
    {"field", "count"},
    "{field} is one value but has count {count}; set count to 1, or the shape to an array or a list"};
inline constexpr MessageText script_changes_float_mode{
    "loader.script_changes_float_mode",
    {"script"},
    "{script} changes the floating-point mode when it is loaded; remove the import or the call that changes "
    "it"};
inline constexpr MessageText script_host_invalid{
    "loader.script_host_invalid",
    {"script", "plugin"},
    "{script} cannot be opened: the plugin {plugin} hosts no scripts. Remove the {plugin}.so that is not of "
    "Fulmar from the plugin folders"};
inline constexpr MessageText script_host_missing{
    "loader.script_host_missing",
    {"script", "plugin", "folders"},
    "{script} requires the plugin {plugin}, which is missing. Searched in {folders}. Install the development "
    "packages of the language, then configure and build Fulmar again"};
inline constexpr MessageText script_not_opened{"loader.script_not_opened",
                                               {"file"},
                                               "{file} cannot be opened; its host gives no reason. Load the "
                                               "script alone in its language to find the fault"};
inline constexpr MessageText store_fault{
    "loader.store_fault", {"reason"}, "{reason}. Set FULMAR_STORE to a folder of your own that is writable"};
inline constexpr MessageText store_not_created{
    "loader.store_not_created", {"folder"}, "the plugin store {folder} (FULMAR_STORE) cannot be created"};
inline constexpr MessageText store_not_folder{
    "loader.store_not_folder",
    {"folder"},
    "the plugin store {folder} is not a folder; remove that file or link, or set FULMAR_STORE to a folder"};
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
    "{type} has an alignment of {alignment} and a size of {size}; valid is a power of 2 up to 64 that "
    "divides the size"};
inline constexpr MessageText struct_size_invalid{
    "loader.struct_size_invalid",
    {"type", "size"},
    "{type} has a size of {size} bytes; 1 to 67108864 are valid"};
inline constexpr MessageText table_outside_memory{"loader.table_outside_memory",
                                                  {"elements"},
                                                  "{elements} lie outside the plugin's memory; correct their "
                                                  "pointer and their count in the table of the plugin"};
inline constexpr MessageText table_stride_invalid{
    "loader.table_stride_invalid",
    {"elements", "stride", "minimum"},
    "{elements} have a stride of {stride} bytes; an aligned stride of at least {minimum} bytes is required"};
inline constexpr MessageText temporary_store_missing{
    "loader.temporary_store_missing", "cannot make a temporary folder for private copies of plugins"};
inline constexpr MessageText text_memory_exhausted{
    "loader.text_memory_exhausted",
    {"size"},
    "there is no memory for a text of {size} bytes; end other programs"};
inline constexpr MessageText text_missing{
    "loader.text_missing", {"item"}, "{item} is missing (a null pointer); point it at a text in the plugin"};
inline constexpr MessageText text_not_terminated{
    "loader.text_not_terminated",
    {"item"},
    "{item} has no NUL in its first 4096 bytes; shorten it, or end it with NUL"};
inline constexpr MessageText text_outside_memory{
    "loader.text_outside_memory",
    {"item"},
    "{item} lies outside the plugin's memory; point it at a static text of the plugin"};
inline constexpr MessageText too_many_fields{
    "loader.too_many_fields", {"type", "count", "limit"}, "{type} has {count} fields; the limit is {limit}"};
inline constexpr MessageText too_many_parameters{"loader.too_many_parameters",
                                                 {"owner", "count", "limit"},
                                                 "{owner} has {count} parameters; the limit is {limit}"};
inline constexpr MessageText too_many_ports{"loader.too_many_ports",
                                            {"ports", "count", "limit"},
                                            "{ports}: {count} ports exceed the limit of {limit}"};
inline constexpr MessageText type_missing{
    "loader.type_missing", {"item"}, "{item} has no type; set one in the table of the plugin"};
inline constexpr MessageText type_name_missing{"loader.type_name_missing",
                                               "the type has no name; set one in the table of the plugin"};
inline constexpr MessageText type_outside_memory{
    "loader.type_outside_memory",
    "the type lies outside the plugin's memory; point at a static type of the plugin"};
inline constexpr MessageText type_too_deep{
    "loader.type_too_deep",
    {"item", "limit"},
    "{item} nests deeper than {limit} levels; use fewer structs inside structs"};
inline constexpr MessageText unique_symbol_shared{
    "loader.unique_symbol_shared",
    {"plugin", "symbol", "other"},
    "{plugin} has the unique symbol {symbol}, as has the loaded {other}. One plugin would use the data of "
    "the other. Build both with -fno-gnu-unique, or as fulmar_add_plugin does"};
inline constexpr MessageText word_size_differs{
    "loader.word_size_differs", "is built for another word size or byte order; build it for this computer"};

}  // namespace fulmar::loader_messages

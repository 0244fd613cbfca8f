// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_new/new_command.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>

#include "core/error.hpp"
#include "tools/fulmar_new/messages.hpp"
#include "tools/fulmar_new/new_beside.hpp"
#include "tools/fulmar_new/new_contract.hpp"
#include "tools/fulmar_new/new_mission.hpp"
#include "tools/fulmar_new/new_places.hpp"
#include "tools/fulmar_new/new_source.hpp"

namespace fulmar::core {
namespace fs = std::filesystem;
namespace {

std::string read_text(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw Error(new_messages::file_not_readable(file.string(), std::strerror(errno)));
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

void write_text(const fs::path& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary);
  out << text;
  out.close();
  if (!out) throw Error(new_messages::file_not_writable(file.string(), std::strerror(errno)));
}

std::string replaced(std::string text, const std::vector<std::pair<std::string, std::string>>& words) {
  for (const auto& [from, to] : words)
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
      text.replace(at, from.size(), to);
  return text;
}

void check_name(const std::string& name) {
  const auto good = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  };
  const bool letter_first = !name.empty() && !(name[0] >= '0' && name[0] <= '9') && name[0] != '_';
  if (!letter_first || name.size() > 60 || !std::all_of(name.begin(), name.end(), good))
    throw Error(new_messages::plugin_name_invalid(name));
  static const std::vector<std::string> taken = {
      "all",           "clean",      "help", "install", "package",  "test",  "edit_cache",
      "rebuild_cache", "fulmar_sdk", "std",  "fulmar",  "messages", "class", "struct",
      "double",        "float",      "int",  "bool",    "char",     "new",   "delete",
      "this",          "auto",       "void", "main",    "template"};
  if (std::find(taken.begin(), taken.end(), name) != taken.end())
    throw Error(new_messages::plugin_name_reserved(name, name));
}

void check_free(const MissionView& mission, const std::string& name) {
  const char* what = mission.text.component(name) ? "component" : mission.text.role(name) ? "role" : nullptr;
  if (what) throw Error(new_messages::name_in_use(mission.graph.mission, what, name, name));
}

/// The mission of --mission: a file, or the name of a shipped one.
fs::path mission_file(const NewOptions& options, const Places& places) {
  const std::string name = options.mission.empty() ? "hourglass" : options.mission;
  std::error_code code;
  if (fs::is_regular_file(name, code)) return name;
  const fs::path shipped = places.missions / (name.ends_with(".yaml") ? name : name + ".yaml");
  if (fs::is_regular_file(shipped, code)) return shipped;
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(places.missions, code))
    if (entry.path().extension() == ".yaml" &&
        read_text(entry.path()).find("\nmission:") != std::string::npos)
      names.push_back(entry.path().stem());
  std::sort(names.begin(), names.end());
  throw Error(new_messages::mission_unknown(name, choices_text(name, names)));
}

/// Name of the struct. A name of the SDK is excluded: `In<Path>` inside the struct would mean the struct.
std::string type_name(const std::string& name, const fs::path& include) {
  const std::string type = pascal_case(name);
  std::error_code code;
  for (const auto& entry : fs::recursive_directory_iterator(include / "fulmar", code)) {
    if (entry.path().extension() != ".hpp") continue;
    const std::string text = read_text(entry.path());
    for (const char* kind : {"struct ", "class ", "enum class ", "using "})
      for (const char* end : {" {", " :", ";", " ="})
        if (text.find(kind + type + end) != std::string::npos) return type + "Component";
  }
  return type;
}

/// The first lines of a template name its ports: "// ports in: state VehicleState, ..." and "// ports out:
/// ...".
std::string ports_line(const std::string& source, const std::string& which) {
  const std::string key = "// ports " + which + ": ";
  const std::size_t at = source.find(key);
  if (at == std::string::npos) return "";
  return ", " + source.substr(at + key.size(), source.find('\n', at) - at - key.size()) + ",";
}

/// Ports that differ between a template and a contract, as "name Message".
struct PortsApart {
  std::vector<std::string> of_mission, of_template;
  bool known = true;  // the template names its ports
  bool none() const { return known && of_mission.empty() && of_template.empty(); }
};

PortsApart ports_apart(const std::string& source, const Contract& contract) {
  const std::string in = ports_line(source, "in"), out = ports_line(source, "out");
  PortsApart apart;
  apart.known = !in.empty() && !out.empty();
  const auto there = [](const std::string& list, const std::string& port) {
    return list.find(", " + port + ",") != std::string::npos;
  };
  std::string given = ",";
  for (const ContractInput& input : contract.inputs) {
    const std::string port = input.name + " " + input.type->name;
    given += " " + port + ",";
    // otherwise a further wire of the mission's role would be left out without a report
    if (input.kind != FULMAR_IN_REQUEST && !there(in, port)) apart.of_mission.push_back(port);
  }
  for (const ContractOutput& output : contract.outputs)
    if (const std::string port = output.name + " " + output.type_name; !output.optional && !there(out, port))
      apart.of_mission.push_back(port);
  for (std::size_t at = in.find(", "); at != std::string::npos && at + 2 < in.size();
       at = in.find(", ", at + 2))
    if (const std::string port = in.substr(at + 2, in.find(',', at + 2) - at - 2); !there(given, port))
      apart.of_template.push_back(port);
  return apart;
}

/// The ports of one side, for a message.
std::string port_words(const std::vector<std::string>& ports) { return ports.empty() ? "none" : join(ports); }

std::string contract_table(const Contract& contract) {
  std::string text = "| port | message | wired |\n|---|---|---|\n";
  for (const ContractInput& input : contract.inputs)
    text += "| in `" + input.name + "` | `" + input.type->name + "` | " +
            (input.from.owner.empty() ? "by the host" : "from `" + input.from.text() + "`") + " |\n";
  for (const ContractOutput& output : contract.outputs)
    text += "| out `" + output.name + "` | `" + output.type_name + "` | " +
            (output.optional ? "optional" : "") + " |\n";
  return text;
}

struct Project {
  fs::path folder;
  std::vector<std::pair<std::string, std::string>> files;  // name -> text
};

using Words = std::vector<std::pair<std::string, std::string>>;

/// A role may have several templates: "vehicle", and "vehicle_point_mass" for --template point_mass.
fs::path role_template(const NewOptions& options, const Places& places, const std::string& role) {
  const fs::path folder = places.templates / "roles";
  if (options.from_template.empty()) return folder / role;
  const fs::path file = folder / (role + "_" + options.from_template);
  std::error_code code;
  if (fs::is_regular_file(file.string() + ".hpp", code)) return file;
  throw Error(new_messages::role_template_unknown(options.from_template, role,
                                                  role == "vehicle" ? " Valid: point_mass." : ""));
}

/// The SDK's template for the request, if there is one: header and test.
std::optional<NewSource> template_source(const NewOptions& options, const Places& places,
                                         const Contract& contract, const Words& names) {
  fs::path file;
  if (contract.roles.empty())
    file = options.from_template.empty() ? fs::path() : places.templates / "beside" / options.from_template;
  else if (contract.roles.size() == 1)
    file = role_template(options, places, contract.roles[0].name);
  std::error_code code;
  const std::string header = file.string() + ".hpp";
  if (file.empty() || !fs::is_regular_file(header, code)) return {};
  const auto filled = [&] {
    return NewSource{replaced(without_template_lines(read_text(header)), names),
                     replaced(read_text(file.string() + "_test.cpp"), names)};
  };
  if (contract.roles.empty()) return filled();
  const PortsApart apart = ports_apart(read_text(header), contract);
  if (apart.none()) return filled();
  if (options.from_template.empty()) return {};
  throw Error(new_messages::template_ports_mismatch(options.from_template, contract.roles[0].name,
                                                    contract.mission, port_words(apart.of_mission),
                                                    port_words(apart.of_template)));
}

/// One sentence each: the place of the component in the mission, and the phases in which it is active.
std::string what_text(const Contract& contract) {
  if (contract.roles.empty()) return new_messages::roles_not_filled().line();
  return new_messages::roles_filled(contract.roles.size() > 1 ? "s " : " ", contract.role_words()).line();
}
std::string flies_text(const Contract& contract, const char* quote) {
  const auto quoted = [&](const std::string& word) { return quote + word + quote; };
  if (contract.roles.empty()) return new_messages::component_always_stepped().line();
  if (contract.vehicle()) return new_messages::vehicle_replaced(quoted(contract.shipped_words())).line();
  return new_messages::phase_of_component(
             quoted(contract.phase), quoted(contract.shipped_words()),
             *quote ? ", which flew there before," : "",
             contract.roles.size() > 1 ? " take over if it fails." : " takes over if it fails.")
      .line();
}

Project make_project(const NewOptions& options, const Places& places, const MissionView& mission,
                     const Contract& contract) {
  const std::string type = type_name(options.name, places.include);
  const Words names{{"my_law", options.name}, {"MyLaw", type}};
  NewComponent component{options.name, {}};
  std::optional<NewSource> source = template_source(options, places, contract, names);
  if (!source) {
    source = write_source(contract, options.name, type, places.include);
    for (const ContractOutput& output : contract.outputs)
      if (!contract.vehicle() && !contract.roles.empty() && !output.optional)
        component.references.push_back(output.name);
  }
  const bool system = places.prefix == "/usr" || places.prefix == "/usr/local";
  Words words = names;
  for (const auto& [from, to] : Words{{"@what@", what_text(contract)},
                                      {"@mission@", contract.mission},
                                      {"@prefix@", system ? "" : places.prefix.string()},
                                      {"@program@", program_word()},
                                      {"@flies@", flies_text(contract, "`")},
                                      {"@contract@", contract_table(contract)}})
    words.emplace_back(from, to);

  Project project{options.folder.empty() ? fs::path(options.name) : fs::path(options.folder), {}};
  project.files = {{options.name + ".hpp", source->header},
                   {options.name + "_test.cpp", source->test},
                   {"mission.yaml", write_mission(mission, contract, component)}};
  for (const auto& [from, to] : Words{{"my_law.cpp", options.name + ".cpp"},
                                      {"CMakeLists.txt", "CMakeLists.txt"},
                                      {"CMakePresets.json", "CMakePresets.json"},
                                      {"README.md", "README.md"},
                                      {"clang-format", ".clang-format"},
                                      {"gitignore", ".gitignore"}})
    project.files.emplace_back(to, replaced(read_text(places.templates / from), words));
  return project;
}

/// Existing files are never overwritten.
void write_project(const Project& project) {
  std::error_code code;
  if (fs::exists(project.folder, code) && !fs::is_directory(project.folder, code))
    throw Error(new_messages::folder_is_file(project.folder.string()));
  if (fs::exists(project.folder, code) && !fs::is_empty(project.folder, code))
    throw Error(new_messages::folder_not_empty(project.folder.string()));
  fs::create_directories(project.folder, code);
  if (code) throw Error(new_messages::folder_not_creatable(project.folder.string(), code.message()));
  for (const auto& [name, text] : project.files) write_text(project.folder / name, text);
}

void report(const Project& project, const Contract& contract, const std::string& name) {
  const std::string folder = project.folder.string();
  const Diagnostic made =
      contract.roles.empty()
          ? new_messages::component_beside_roles(name, contract.mission, folder)
          : new_messages::component_for_roles(name, contract.roles.size() > 1 ? "s " : " ",
                                              contract.role_words(), contract.mission, folder);
  std::printf("%s\n", made.text.c_str());
  for (const ContractInput& input : contract.inputs)
    std::printf("  in   %-12s %-18s %s\n", input.name.c_str(), input.type->name.c_str(),
                input.from.owner.empty() ? "from the host" : ("from " + input.from.text()).c_str());
  for (const ContractOutput& output : contract.outputs) {
    const ContractFeed* feed = nullptr;
    for (const ContractFeed& known : contract.feeds)
      if (known.output == output.name) feed = &known;
    std::printf("  out  %-12s %-18s%s\n", output.name.c_str(), output.type_name.c_str(),
                output.optional ? " optional"
                : feed          ? (" to " + feed->to.text()).c_str()
                                : "");
  }
  std::printf("%s\n", flies_text(contract, "").c_str());
  std::printf(
      "Next:\n  cd %s && cmake --preset default && cmake --build build\n  ctest --test-dir build "
      "--output-on-failure\n  %s run "
      "mission.yaml\n",
      shell_word(project.folder.string()).c_str(), program_word().c_str());
}

/// The requested contract: of roles, of a template, or of ports.
Contract asked_contract(const NewOptions& options, const Places& places, const MissionView& mission) {
  if (!options.roles.empty()) {
    if (!options.in.empty() || !options.out.empty()) throw Error(new_messages::role_with_ports());
    if (!options.from_template.empty() && options.roles.size() > 1)
      throw Error(new_messages::roles_template_missing(options.from_template, join(options.roles)));
    return read_contract(mission, options.roles);
  }
  if (options.from_template.empty()) {
    if (options.in.empty() && options.out.empty()) throw Error(new_messages::component_unspecified());
    return ports_contract(mission, options.in, options.out);
  }
  if (!options.out.empty()) throw Error(new_messages::template_with_outputs());
  const fs::path file = places.templates / "beside" / (options.from_template + ".hpp");
  std::error_code code;
  if (!fs::is_regular_file(file, code))
    throw Error(new_messages::template_unknown(options.from_template,
                                               choices_text(options.from_template, {"planner", "sensor"})));
  const std::string type = type_name(options.name, places.include);
  return template_contract(mission, options.from_template, replaced(read_text(file), {{"MyLaw", type}}),
                           options.in);
}

}  // namespace

int new_command(const NewOptions& options) {
  check_name(options.name);
  const Places places = find_places(this_program());
  const MissionView mission = view_mission(mission_file(options, places));
  const Contract contract = asked_contract(options, places, mission);
  check_free(mission, options.name);
  const Project project = make_project(options, places, mission, contract);
  write_project(project);
  report(project, contract, options.name);
  return 0;
}

}  // namespace fulmar::core

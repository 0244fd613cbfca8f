// SPDX-License-Identifier: BSD-3-Clause
// Writes the bill of materials. Keys and words: CycloneDX 1.5 JSON schema (bom-1.5.schema.json).
#include "core/log/sbom.hpp"

#include <link.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "core/loader/build_id.hpp"
#include "core/loader/library.hpp"

namespace fulmar::core {
namespace {

using nlohmann::json;

constexpr const char* host_ref = "fulmar";

struct Mapped {
  std::string name;  // of the file, without folders; "" of the program itself
  std::string build_id;
  friend auto operator<=>(const Mapped&, const Mapped&) = default;
};

std::string build_id_of(const dl_phdr_info& object) {
  for (int i = 0; i < object.dlpi_phnum; ++i) {
    const ElfW(Phdr)& segment = object.dlpi_phdr[i];
    if (segment.p_type != PT_NOTE) continue;
    const auto* notes = reinterpret_cast<const std::byte*>(object.dlpi_addr + segment.p_vaddr);
    if (const std::string id = build_id_in_notes({notes, static_cast<std::size_t>(segment.p_memsz)});
        !id.empty())
      return id;
  }
  return "";
}

// The first object is the program. The kernel's own page (linux-vdso.so.1) is no file.
std::vector<Mapped> mapped_objects() {
  std::vector<Mapped> all;
  const auto add = [](dl_phdr_info* object, std::size_t, void* list) {
    auto& found = *static_cast<std::vector<Mapped>*>(list);
    const char* slash = std::strrchr(object->dlpi_name, '/');
    const std::string name = found.empty() ? "" : slash != nullptr ? slash + 1 : object->dlpi_name;
    const bool virtual_page = name.rfind("linux-", 0) == 0;
    if (!virtual_page) found.push_back({name, build_id_of(*object)});
    return 0;
  };
  ::dl_iterate_phdr(add, &all);
  return all;
}

// Copies of plugins are called by their SHA-256. Those of the flight are told under their own names; others
// are not of this flight.
bool is_copy(const std::string& name) {
  return name.size() == 67 && name.ends_with(".so") && name.find_first_not_of("0123456789abcdef") == 64;
}

// An array of one: braces round a single value mean an array to one compiler and the value to another.
json list(json only) {
  json all = json::array();
  all.push_back(std::move(only));
  return all;
}

json hash(const std::string& content) { return {{"alg", "SHA-256"}, {"content", content}}; }

json property(const std::string& name, const std::string& value) {
  return {{"name", "fulmar:" + name}, {"value", value}};
}

json host(const std::string& build_id) {
  json component = {
      {"type", "application"}, {"bom-ref", host_ref}, {"name", "fulmar"}, {"version", FULMAR_VERSION}};
  component["licenses"] = list(json{{"license", json{{"id", "BSD-3-Clause"}}}});
  if (build_id.empty())
    component["hashes"] = list(hash(sha256_file("/proc/self/exe")));
  else
    component["properties"] = list(property("build_id", build_id));
  return component;
}

std::string ref_of(const PluginInfo& plugin) { return "plugin:" + plugin.sha256; }

json plugin_component(const PluginInfo& plugin) {
  json component = {
      {"type", "library"}, {"bom-ref", ref_of(plugin)}, {"name", plugin.file}, {"version", plugin.version}};
  component["hashes"] = list(hash(plugin.sha256));
  json& properties = component["properties"] = json::array();
  properties.push_back(
      property("abi", std::to_string(plugin.abi_major) + "." + std::to_string(plugin.abi_minor)));
  if (!plugin.build_id.empty()) properties.push_back(property("build_id", plugin.build_id));
  for (const ComponentInfo& part : plugin.components) properties.push_back(property("component", part.name));
  if (!plugin.flags.empty()) properties.push_back(property("flags", plugin.flags));
  properties.push_back(property("toolchain", plugin.toolchain));
  return component;
}

json library_component(const Mapped& library) {
  const std::string ref =
      "library:" + library.name + (library.build_id.empty() ? "" : ":" + library.build_id);
  json component = {{"type", "library"}, {"bom-ref", ref}, {"name", library.name}};
  if (!library.build_id.empty()) component["properties"] = list(property("build_id", library.build_id));
  return component;
}

}  // namespace

std::string sbom_text(const std::vector<const PluginInfo*>& plugins) {
  std::vector<Mapped> objects = mapped_objects();
  std::map<std::pair<std::string, std::string>, const PluginInfo*> sorted;
  for (const PluginInfo* plugin : plugins) sorted[{plugin->file, plugin->sha256}] = plugin;
  json components = json::array(), needed = json::array();
  std::set<std::string> refs;  // one content under two names is one component
  for (const auto& [key, plugin] : sorted) {
    if (!refs.insert(ref_of(*plugin)).second) continue;
    components.push_back(plugin_component(*plugin));
    needed.push_back(ref_of(*plugin));
  }
  const std::string program_id = objects.empty() ? "" : objects.front().build_id;
  std::set<Mapped> libraries(objects.empty() ? objects.end() : objects.begin() + 1, objects.end());
  for (const Mapped& library : libraries) {
    if (library.name.empty() || is_copy(library.name)) continue;
    components.push_back(library_component(library));
    needed.push_back(components.back()["bom-ref"]);
  }
  std::sort(needed.begin(), needed.end());
  json bom = {{"bomFormat", "CycloneDX"}, {"specVersion", "1.5"}, {"version", 1}};
  bom["metadata"] = {{"component", host(program_id)}};
  bom["components"] = std::move(components);
  bom["dependencies"] = list(json{{"ref", host_ref}, {"dependsOn", std::move(needed)}});
  return bom.dump(1) + "\n";
}

}  // namespace fulmar::core

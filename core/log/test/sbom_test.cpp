// SPDX-License-Identifier: BSD-3-Clause
// The bill of materials keeps the rules of CycloneDX 1.5 that apply to it, and names what is really there.
#include "core/log/sbom.hpp"

#include <doctest/doctest.h>

#include <cstdio>
#include <nlohmann/json.hpp>
#include <set>

#include "core/loader/build_id.hpp"

namespace sbom_test {

using namespace fulmar::core;
using nlohmann::json;

namespace {

PluginInfo law(char digit, const std::string& file) {
  PluginInfo plugin;
  plugin.file = file;
  plugin.path = "/somewhere/" + file;
  plugin.copy = "/store/copy.so";
  plugin.sha256 = std::string(64, digit);
  plugin.build_id = "0123456789abcdef0123456789abcdef01234567";
  plugin.version = "1.2.0";
  plugin.toolchain = "gcc 12.2.0";
  plugin.flags = "NDEBUG";
  plugin.abi_major = 1;
  plugin.components.resize(2);
  plugin.components[0].name = "Outer";
  plugin.components[1].name = "Inner";
  return plugin;
}

json of(const std::vector<const PluginInfo*>& plugins) { return json::parse(sbom_text(plugins)); }

std::string property(const json& component, const std::string& name) {
  std::string all;
  for (const json& p : component.value("properties", json::array()))
    if (p["name"] == name) all += (all.empty() ? "" : " ") + p["value"].get<std::string>();
  return all;
}

const json* named(const json& bom, const std::string& name) {
  for (const json& c : bom["components"])
    if (c["name"] == name) return &c;
  return nullptr;
}

// What bom-1.5.schema.json asks of the parts that are used here: closed objects, required keys, enumerations
// and patterns.
void check_component(const json& c) {
  static const std::set<std::string> keys = {"type",   "bom-ref",  "name",      "version",
                                             "hashes", "licenses", "properties"};
  static const std::set<std::string> types = {"application",
                                              "framework",
                                              "library",
                                              "container",
                                              "platform",
                                              "operating-system",
                                              "device",
                                              "device-driver",
                                              "firmware",
                                              "file",
                                              "machine-learning-model",
                                              "data"};
  for (const auto& item : c.items()) CHECK_MESSAGE(keys.count(item.key()) == 1, item.key());
  CHECK(types.count(c.at("type")) == 1);
  CHECK(c.at("name").is_string());
  CHECK_FALSE(c.at("bom-ref").get<std::string>().empty());
  if (c.contains("version")) CHECK(c["version"].is_string());
  // the schema's pattern for the content of a hash: 32, 40, 64, 96 or 128 hexadecimal digits
  const auto is_hash = [](const std::string& text) {
    const std::size_t n = text.size();
    return (n == 32 || n == 40 || n == 64 || n == 96 || n == 128) &&
           text.find_first_not_of("0123456789abcdefABCDEF") == std::string::npos;
  };
  for (const json& h : c.value("hashes", json::array())) {
    CHECK(h.size() == 2);
    CHECK(h.at("alg") == "SHA-256");
    CHECK(is_hash(h.at("content").get<std::string>()));
  }
  for (const json& p : c.value("properties", json::array())) {
    CHECK(p.size() == 2);
    CHECK(p.at("name").is_string());
    CHECK(p.at("value").is_string());
  }
}

}  // namespace

TEST_CASE("the bill of materials has the shape of CycloneDX 1.5") {
  const PluginInfo a = law('a', "a.so"), b = law('b', "b.so");
  const json bom = of({&b, &a, &a});
  CHECK(bom.at("bomFormat") == "CycloneDX");
  CHECK(bom.at("specVersion") == "1.5");
  CHECK(bom.at("version") == 1);
  for (const auto& item : bom.items())
    CHECK_MESSAGE(std::set<std::string>(
                      {"bomFormat", "specVersion", "version", "metadata", "components", "dependencies"})
                          .count(item.key()) == 1,
                  item.key());
  CHECK(bom["metadata"].size() == 1);
  check_component(bom["metadata"].at("component"));
  std::set<std::string> refs{bom["metadata"]["component"]["bom-ref"]};
  for (const json& c : bom["components"]) {
    check_component(c);
    CHECK_MESSAGE(refs.insert(c["bom-ref"]).second, c["bom-ref"]);  // unique in the document
  }
  REQUIRE(bom["dependencies"].size() == 1);
  CHECK(bom["dependencies"][0].at("ref") == bom["metadata"]["component"]["bom-ref"]);
  for (const json& ref : bom["dependencies"][0].at("dependsOn")) CHECK(refs.count(ref) == 1);
  CHECK(bom["dependencies"][0]["dependsOn"].size() == bom["components"].size());
}

TEST_CASE(
    "a plugin is named with version, SHA-256, build id, toolchain and components, and without its folders") {
  const PluginInfo a = law('a', "a.so");
  const json bom = of({&a});
  const json* c = named(bom, "a.so");
  REQUIRE(c != nullptr);
  CHECK((*c)["version"] == "1.2.0");
  CHECK((*c)["hashes"][0]["content"] == std::string(64, 'a'));
  CHECK(property(*c, "fulmar:build_id") == a.build_id);
  CHECK(property(*c, "fulmar:toolchain") == "gcc 12.2.0");
  CHECK(property(*c, "fulmar:component") == "Outer Inner");
  CHECK(property(*c, "fulmar:abi") == "1.0");
  CHECK(bom.dump().find('/') == std::string::npos);
}

TEST_CASE("the libraries of this process are in it, with the build id that readelf reads from the file") {
  const json bom = of({});
  const json* c = named(bom, "libc.so.6");
  REQUIRE(c != nullptr);
  std::FILE* pipe = ::popen(
      "readelf -n \"$(grep -o '/.*/libc\\.so\\.6' /proc/self/maps | head -n 1)\" | sed -n 's/.*Build ID: "
      "//p'",
      "r");
  REQUIRE(pipe != nullptr);
  char id[128] = "";
  const int read = std::fscanf(pipe, "%127s", id);
  ::pclose(pipe);
  if (read == 1) CHECK(property(*c, "fulmar:build_id") == id);
  CHECK(named(bom, "linux-vdso.so.1") == nullptr);
}

TEST_CASE("the same software gives the same text, in whatever order it is named") {
  const PluginInfo a = law('a', "a.so"), b = law('b', "b.so");
  CHECK(sbom_text({&a, &b}) == sbom_text({&b, &a, &b}));
  CHECK(sbom_text({&a}) != sbom_text({&b}));
}

TEST_CASE("notes are read with their padding, and bent ones give nothing") {
  // two notes, the first of another owner with 3 bytes of content: the second begins at the next multiple of
  // 4
  const unsigned char notes[] = {4, 0, 0, 0, 3, 0, 0, 0, 9, 0, 0, 0, 'X', 'Y', 'Z', 0,   1, 2,    3,
                                 0, 4, 0, 0, 0, 2, 0, 0, 0, 3, 0, 0, 0,   'G', 'N', 'U', 0, 0xab, 0x0c};
  const auto bytes = std::as_bytes(std::span(notes));
  CHECK(build_id_in_notes(bytes) == "ab0c");
  CHECK(build_id_in_notes(bytes.first(bytes.size() - 1)) == "");
  CHECK(build_id_in_notes(bytes.first(30)) == "");
  CHECK(build_id_in_notes({}) == "");
  unsigned char huge[sizeof notes];
  std::copy(std::begin(notes), std::end(notes), huge);
  huge[3] = 0xff;  // a name of 4 GB
  CHECK(build_id_in_notes(std::as_bytes(std::span(huge))) == "");
  CHECK(build_id(bytes) == "");
}

}  // namespace sbom_test

// SPDX-License-Identifier: BSD-3-Clause
// Which plugin files a mission may load: the list, the content, and who may have written them. The files are
// copies of no plugin at all: what is refused is refused before anything opens it.
#include "core/graph/trust.hpp"

#include <doctest/doctest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>

#include "core/graph/catalogue.hpp"
#include "core/loader/store.hpp"
#include "shelf.hpp"

namespace trust_test {

using namespace fulmar::core;
namespace fs = std::filesystem;

namespace {

// A mission in a folder of its own that holds build/law.so and other.so, and a folder of named plugins.
struct Place {
  test::Folder folder;
  std::string report;

  Place() {
    for (const char* name : {"build", "named", "open"}) fs::create_directory(folder.path / name);
    put("build/law.so", "a law");
    put("other.so", "another");
    put("named/control.so", "a plugin");
    setenv("FULMAR_PLUGIN_PATH", (folder.path / "named").c_str(), 1);
  }
  ~Place() { unsetenv("FULMAR_PLUGIN_PATH"); }

  fs::path put(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder.path / name, std::ios::binary) << bytes;
    ::chmod((folder.path / name).c_str(), 0644);
    return folder.path / name;
  }
  Trust trust(const std::string& plugins) {
    const std::string file = folder.write("m.yaml", "mission: m\n" + plugins);
    Report faults;
    const MissionText text = parse_mission(file, {}, faults);
    Trust made(text, faults);
    report = faults.text();
    return made;
  }
  // What is said of a file; "" when it may be loaded.
  std::string said(const std::string& plugins, const std::string& name) {
    const Trust made = trust(plugins);
    REQUIRE(report.empty());
    try {
      made.check(folder.path / name);
      return "";
    } catch (const Error& fault) {
      return fault.what();
    }
  }
};

std::string hash_of(const std::string& text) { return sha256_hex(text.data(), text.size()); }

}  // namespace

TEST_CASE("without a list every private file may be loaded, whatever it holds") {
  Place place;
  CHECK(place.said("", "build/law.so") == "");
  CHECK(place.trust("").check(place.folder.path / "other.so").sha256.empty());
}

TEST_CASE("with a list the files on it may be loaded: by path, by folder, by name") {
  Place place;
  CHECK(place.said("plugins: {allow: [build/law.so]}\n", "build/law.so") == "");
  CHECK(place.said("plugins: {allow: [\"build/*\"]}\n", "build/law.so") == "");
  CHECK(place.said("plugins: {allow: [other.so]}\n", "other.so") == "");
  CHECK(place.said("plugins: {allow: [control]}\n", "named/control.so") == "");
  CHECK(place.said("plugins: {allow: [control.so]}\n", "named/control.so") == "");
  CHECK(place.said("plugins: {allow: [{file: build/law.so}]}\n", "build/../build/law.so") == "");
}

TEST_CASE("a file that is not on the list is refused with what would have to be written") {
  Place place;
  CHECK(place.said("plugins:\n  allow: [control, other.so]\n", "build/law.so") ==
        "law.so is not among the plugins that this mission allows: control, other.so. Write {file: "
        "build/law.so, sha256: " +
            hash_of("a law") + "} into plugins.allow (m.yaml:3) if you trust it");
  CHECK(place.said("plugins: {allow: []}\n", "named/control.so") ==
        "control.so is not among the plugins that this mission allows: none. Write control into "
        "plugins.allow (m.yaml:2) if you trust it");
}

TEST_CASE(
    "a name means an installed plugin, not a file of that name beside the mission; a folder means its own "
    "files alone") {
  Place place;
  place.put("control.so", "an impostor");
  fs::create_directory(place.folder.path / "build" / "deep");
  place.put("build/deep/x.so", "deep");
  CHECK(place.said("plugins: {allow: [control]}\n", "control.so").rfind("control.so is not among", 0) == 0);
  CHECK(place.said("plugins: {allow: [\"build/*\"]}\n", "build/deep/x.so").rfind("x.so is not among", 0) ==
        0);
}

TEST_CASE("a link counts as what it leads to") {
  Place place;
  fs::create_symlink(place.folder.path / "other.so", place.folder.path / "build" / "link.so");
  CHECK(place.said("plugins: {allow: [\"build/*\"]}\n", "build/link.so").rfind("other.so is not among", 0) ==
        0);
  CHECK(place.said("plugins: {allow: [other.so]}\n", "build/link.so") == "");
}

TEST_CASE("listed content is asked for; a file may be listed with several, and without any") {
  Place place;
  const std::string a(64, 'a'), b(64, 'b');
  CHECK(place.trust("plugins: {allow: [{file: other.so, sha256: " + a + "}]}\n")
            .check(place.folder.path / "other.so")
            .sha256 == std::vector<std::string>{a});
  CHECK(place
            .trust("plugins: {allow: [{file: other.so, sha256: " + a +
                   "}, {file: other.so, sha256: " + std::string(64, 'B') + "}]}\n")
            .check(place.folder.path / "other.so")
            .sha256 == std::vector<std::string>{a, b});
  for (const std::string& list :
       {"{file: other.so, sha256: " + a + "}, other.so", "other.so, {file: other.so, sha256: " + a + "}"})
    CHECK(place.trust("plugins: {allow: [" + list + "]}\n")
              .check(place.folder.path / "other.so")
              .sha256.empty());
}

TEST_CASE("what all may write is refused, listed or not") {
  Place place;
  const fs::path real = fs::canonical(place.folder.path);
  ::chmod((real / "build/law.so").c_str(), 0646);
  const std::string fault =
      "law.so is not loaded: everybody may write to it; chmod o-w " + (real / "build/law.so").string();
  CHECK(place.said("", "build/law.so") == fault);
  CHECK(place.said("plugins: {allow: [build/law.so]}\n", "build/law.so") == fault);
  place.put("open/x.so", "x");
  ::chmod((real / "open").c_str(), 0777);
  CHECK(place.said("", "open/x.so") ==
        "x.so is not loaded: everybody may replace files in its folder; chmod o-w " +
            (real / "open").string());
  ::chmod((real / "open").c_str(), 01777);  // as /tmp: others cannot replace it
  CHECK(place.said("", "open/x.so") == "");
}

TEST_CASE("a file of another user is refused") {
  if (::geteuid() != 0) {
    MESSAGE("only root can give a file away: not tried");
    return;
  }
  Place place;
  REQUIRE(::chown((place.folder.path / "other.so").c_str(), 4711, 4711) == 0);
  unsetenv("SUDO_UID");
  CHECK(place.said("", "other.so") ==
        "other.so is not loaded: it belongs to the user 4711, neither to you nor to root; chown it: " +
            (fs::canonical(place.folder.path) / "other.so").string());
  setenv("SUDO_UID", "4711", 1);
  CHECK(place.said("", "other.so") == "");
  unsetenv("SUDO_UID");
}

TEST_CASE("faults of the list are told with their line") {
  Place place;
  const auto fault = [&](const std::string& plugins) {
    place.trust(plugins);
    return place.report;
  };
  CHECK(fault("plugins: all\n") == "m.yaml:2: plugins: expected a map with the keys allow; found 'all'");
  CHECK(fault("plugins: {alow: []}\n") ==
        "m.yaml:2: plugins: unknown key 'alow'. Did you mean 'allow'? Valid: allow.\n"
        "m.yaml:2: plugins: 'allow' is missing, as in {allow: [control_slc, my_law.so]}");
  CHECK(fault("plugins: {allow: control}\n") ==
        "m.yaml:2: plugins.allow: expected a list such as [control_slc, my_law.so], found 'control'");
  CHECK(fault("plugins:\n  allow:\n    - {file: x.so, sha256: abc}\n") ==
        "m.yaml:4: plugins.allow.sha256: expected 64 hexadecimal digits, found 'abc'");
  CHECK(fault("plugins: {allow: [{sha256: " + std::string(64, 'a') + "}]}\n") ==
        "m.yaml:2: plugins.allow: 'file' is missing, as in {file: my_law.so, sha256: ...}");
  CHECK(fault("plugins: {allow: [control/Outer]}\n") ==
        "m.yaml:2: plugins.allow: 'control/Outer' is no file of a plugin; write the name of a plugin "
        "(control_slc), a file "
        "(build/my_law.so) or a folder (build/*)");
  CHECK(fault("plugins: {allow: [\"bu*ld/x.so\"]}\n") ==
        "m.yaml:2: plugins.allow: 'bu*ld/x.so': a '*' stands alone for the files of a folder, as in build/*");
}

TEST_CASE("a mission asks before it opens a file, and says where the file is used") {
  Place place;
  const std::string file = place.folder.write(
      "m.yaml", "mission: m\nplugins: {allow: [other.so]}\ncomponents:\n  mine: {use: build/law.so}\n");
  const std::string store = (place.folder.path / "store").string();
  setenv("FULMAR_STORE", store.c_str(), 1);
  setenv("FULMAR_PROBE", "/nowhere/fulmar-probe", 1);
  std::string said;
  try {
    load_mission(file);
  } catch (const Error& fault) {
    said = fault.what();
  }
  CHECK(
      said.find(
          "m.yaml:4: components.mine: law.so is not among the plugins that this mission allows: other.so.") !=
      std::string::npos);
  CHECK_FALSE(fs::exists(store));
  unsetenv("FULMAR_PROBE");
  unsetenv("FULMAR_STORE");
}

}  // namespace trust_test

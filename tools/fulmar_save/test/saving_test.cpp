// SPDX-License-Identifier: BSD-3-Clause
// Parameters that a client writes into the mission's file: shown first, and then exactly those lines. The
// live view starts the program fulmar-save for it.
#include "links/live/saving.hpp"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "links/live/test/mock.hpp"

namespace saving_test {

namespace fs = std::filesystem;
using namespace fulmar::core;
using namespace fulmar::core::live;
using namespace fulmar::core::test;

namespace {

const std::string text =
    "mission: mock <1>\n"
    "components:\n"
    "  slc: {use: control_slc/Outer, params: {roll_kp: 0.5, law: climb, note: 40 deg}}  # mine\n";

/// A mission's file, gone with this, and the flight of it.
struct Folder {
  fs::path path = fs::temp_directory_path() / ("fulmar-saving-" + std::to_string(::getpid()));
  fs::path file = path / "m.yaml";
  FlightView view;
  Folder() {
    fs::remove_all(path);
    fs::create_directories(path);
    put(text);
    view = MockControl().view();
    view.file = file.string();
    ComponentView& slc = view.components[0];
    slc.params.resize(2);
  }
  ~Folder() { fs::remove_all(path); }
  void put(const std::string& content) const { std::ofstream(file, std::ios::binary) << content; }
  std::string content() const {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
};

bool holds(const std::string& words, const std::string& part) {
  CAPTURE(words);
  CHECK(words.find(part) != std::string::npos);
  return words.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE_FIXTURE(Folder, "the lines are shown, and nothing is written; with their mark they are") {
  const SaveAnswer shown = save(view, "slc", "");
  CHECK(shown.accepted);
  CHECK(shown.reason == "");
  const std::string difference =
      "m.yaml:3\n"
      "-   slc: {use: control_slc/Outer, params: {roll_kp: 0.5, law: climb, note: 40 deg}}  # mine\n"
      "+   slc: {use: control_slc/Outer, params: {roll_kp: 0.55, law: climb, note: 40 deg}}  # mine\n";
  CHECK(shown.lines == difference);
  CHECK(shown.mark.size() == 64);
  CHECK(content() == text);
  const SaveAnswer wrote = save(view, "slc", shown.mark);
  CHECK(wrote.accepted);
  CHECK(wrote.lines == "written: " + file.string());
  CHECK(wrote.mark == "");
  std::string expected = text;
  expected.replace(expected.find("0.5"), 3, "0.55");
  CHECK(content() == expected);
  const SaveAnswer again = save(view, "slc", "");
  CHECK(again.accepted);
  CHECK((again.lines.empty() && again.mark.empty()));
  CHECK_FALSE(save(view, "slc", shown.mark).accepted);  // twice
  CHECK(content() == expected);
}

TEST_CASE_FIXTURE(Folder,
                  "what is not what was shown is not written: another file, another value, another mark") {
  const SaveAnswer shown = save(view, "", "");
  put(text + "# more\n");
  holds(save(view, "", shown.mark).reason, "save.preview_outdated");
  CHECK(content() == text + "# more\n");
  put(text);
  view.components[0].params[0].base.number[0] = 0.6;
  holds(save(view, "", shown.mark).reason, "save.preview_outdated");
  holds(save(view, "", "0").reason, "save.preview_outdated");
  CHECK(content() == text);
}

TEST_CASE_FIXTURE(Folder, "why nothing can be written is one sentence") {
  view.set = {"slc.roll_kp"};
  CHECK(save(view, "slc", "").reason == "save.option_value_saved(slc.roll_kp)");
  holds(save(view, "scl", "").reason, "save.component_unknown(scl,  [slc] slc, plan)");
  FlightView other = view;
  other.no_save = "graph.save_off";
  const SaveAnswer off = save(other, "slc", "");
  CHECK_FALSE(off.accepted);
  CHECK((off.lines.empty() && off.mark.empty()));
  CHECK(off.reason == "live.save_not_allowed(graph.save_off)");
  other = view;
  other.file = "";
  CHECK(save(other, "", "").reason == "live.mission_file_missing");
  put("mission: another\n");
  CHECK(save(view, "", "").reason == "save.mission_name_mismatch(" + file.string() + ", another, mock <1>)");
  put("mission: [\n");
  CHECK_FALSE(save(view, "", "").accepted);
  fs::remove(file);
  CHECK(save(view, "", "").reason == "save.mission_file_missing(" + file.string() + ")");
}

TEST_CASE_FIXTURE(
    Folder, "the elements of a vector have the names that its type has, also where the file lacks one") {
  Type type;
  type.fields.resize(3);
  for (std::size_t i = 0; i < 3; ++i) type.fields[i].name = std::vector{"front", "right", "down"}[i];
  ParameterView& arm = view.components[0].params[0];
  arm.info.name = "arm";
  arm.info.kind = FULMAR_VECTOR;
  arm.info.type = std::make_shared<const Type>(type);
  arm.info.unit = "m";
  arm.base.number[0] = 0.25;
  arm.base.number[1] = 0.1;
  arm.base.number[2] = 0.5;
  view.components[0].params.resize(1);
  put("mission: mock <1>\ncomponents:\n  slc: {params: {arm: {front: 20 cm, down: 0.5 m}}}\n");
  const std::string after =
      "mission: mock <1>\ncomponents:\n  slc: {params: {arm: {front: 25 cm, down: 0.5 m, right: 0.1 m}}}\n";
  const SaveAnswer shown = save(view, "", "");
  CHECK(shown.reason == "");
  REQUIRE(save(view, "", shown.mark).accepted);
  CHECK(content() == after);
}

TEST_CASE_FIXTURE(Folder, "a file that cannot be written is reported, and stays as it is") {
  const SaveAnswer shown = save(view, "", "");
  // No user can write a file in a folder of /proc.
  FlightView link = view;
  const int held = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  fs::remove(file);
  link.file = "/proc/" + std::to_string(::getpid()) + "/fd/" + std::to_string(held);
  const SaveAnswer seen = save(link, "", "");
  REQUIRE(seen.accepted);
  const SaveAnswer answer = save(link, "", seen.mark);
  ::close(held);
  CHECK_FALSE(answer.accepted);
  holds(answer.reason, "save.file_not_writable(" + link.file + ", ");
}

}  // namespace saving_test

// SPDX-License-Identifier: BSD-3-Clause
// Parameters written back into mission and airframe files: the expected texts are written by hand.
#include "tools/fulmar_save/param_file.hpp"

#include <doctest/doctest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <limits>
#include <sstream>

#include "tools/fulmar_save/yaml_edit.hpp"

namespace param_file_test {

namespace fs = std::filesystem;
using namespace fulmar::core;

namespace {

struct Folder {
  fs::path path = fs::temp_directory_path() / ("fulmar-param-file-test-" + std::to_string(getpid()));
  Folder() { fs::create_directories(path); }
  ~Folder() { fs::remove_all(path); }
  fs::path file(const std::string& name, const std::string& text) const {
    std::ofstream(path / name, std::ios::binary) << text;
    return path / name;
  }
};

SavedParam number(const std::string& name, double value, const std::string& unit = "",
                  const std::string& component = "slc") {
  SavedParam p;
  p.component = component;
  p.use = "control_slc/Outer";
  p.info.name = name;
  p.info.unit = unit;
  p.info.live = true;
  p.info.min = -std::numeric_limits<double>::infinity();
  p.info.max = -p.info.min;
  p.value.number[0] = value;
  return p;
}
SavedParam vector(const std::string& name, double a, double b, double c, const std::string& unit) {
  SavedParam p = number(name, a, unit);
  p.info.kind = FULMAR_VECTOR;
  p.value.number[1] = b;
  p.value.number[2] = c;
  return p;
}
SavedParam text(const std::string& name, const std::string& value) {
  SavedParam p = number(name, 0);
  p.info.kind = FULMAR_STRING;
  p.info.capacity = 64;
  p.value.text = value;
  return p;
}
SavedParam choice(const std::string& name, std::int64_t value) {
  SavedParam p = number(name, 0);
  p.info.kind = FULMAR_CHOICE;
  p.info.choices = {"none", "light", "severe"};
  p.value.integer = value;
  return p;
}

/// The mission after saving, when nothing else changes and nothing is refused.
std::string saved(const std::string& mission, const std::vector<SavedParam>& params) {
  const Folder folder;
  const fs::path file = folder.file("m.yaml", mission);
  const SavePlan plan = plan_save(file, params, {});
  for (const std::string& sentence : plan.refused) FAIL_CHECK(sentence);
  if (plan.files.empty()) return mission;
  REQUIRE(plan.files.size() == 1);
  write_edit(plan.files[0]);
  std::stringstream now;
  now << std::ifstream(file, std::ios::binary).rdbuf();
  return now.str();
}
/// Before and after the values are saved.
struct Edit {
  std::string before;
  std::vector<SavedParam> params;
  std::string after;
};
void check_edits(const std::vector<Edit>& edits) {
  for (const Edit& edit : edits) CHECK(saved(edit.before, edit.params) == edit.after);
}
std::string refused(const std::string& mission, const std::vector<SavedParam>& params) {
  const Folder folder;
  const SavePlan plan = plan_save(folder.file("m.yaml", mission), params, {});
  CHECK(plan.files.empty());
  return plan.refused.size() == 1 ? plan.refused[0] : "";
}

}  // namespace

TEST_CASE("a value is replaced where it stands: unit, comment and layout stay") {
  check_edits(
      {{"components:\n  slc:\n    params:\n      roll_limit: 40 deg   # not more\n      roll_kp:   0.5\n",
        {number("roll_limit", 0.7330382858376184, "rad"), number("roll_kp", 0.625, "rad/rad")},
        "components:\n  slc:\n    params:\n      roll_limit: 42 deg   # not more\n      roll_kp:   0.625\n"},
       {"components:\r\n  slc: {use: x, params: {speed: 60 km/h, roll_kp: 1}, rate: 100 Hz}\r\n",
        {number("speed", 25, "m/s")},
        "components:\r\n  slc: {use: x, params: {speed: 90 km/h, roll_kp: 1}, rate: 100 Hz}\r\n"}});
}

TEST_CASE("what the file says already is left alone, to the last digit of its writer") {
  const std::string mission =
      "components: {slc: {params: {roll_limit: 40.0 deg, wind: [3.0, 4, 0], law: 'light'}}}";
  CHECK(saved(mission, {number("roll_limit", 0.6981317007977318, "rad"), vector("wind", 3, 4, 0, "m/s"),
                        choice("law", 1)}) == mission);
  CHECK(saved(mission, {number("roll_limit", 0.6981317007977318, "rad"), number("unsaid", 0, "m")}) ==
        mission);
}

TEST_CASE("quotes stay quotes, and text that YAML would misread gets some") {
  check_edits(
      {{"components: {slc: {params: {a: \"40 deg\", b: 'x', c: plain, d: word}}}",
        {number("a", 0.7330382858376184, "rad"), text("b", "it's"), text("c", "on"), text("d", "a: b # c")},
        "components: {slc: {params: {a: \"42 deg\", b: 'it''s', c: \"on\", d: \"a: b # c\"}}}"},
       {"components: {slc: {params: {law: none}}}",
        {choice("law", 2)},
        "components: {slc: {params: {law: severe}}}"}});
}

TEST_CASE("of a vector only the elements that differ are written, each in its unit") {
  check_edits({{"components: {slc: {params: {wind: [3.0, -4 m/s, 36 km/h]  # n e d\n}}}",
                {vector("wind", 3, -5.5, 5, "m/s")},
                "components: {slc: {params: {wind: [3.0, -5.5 m/s, 18 km/h]  # n e d\n}}}"},
               {"components:\n  slc:\n    params:\n      wind: {north: 3, east: 4}  # calm\n",
                {vector("wind", 3, 2, 1, "m/s")},
                "components:\n  slc:\n    params:\n      wind: {north: 3, east: 2, down: 1 m/s}  # calm\n"}});
}

TEST_CASE("a value that stands nowhere is added to the mission where it belongs") {
  const SavedParam p = number("roll_limit", 0.7330382858376184, "rad");
  check_edits(
      {{"mission: m\ncomponents:\n  slc:\n    params:\n      roll_kp: 1    # fine\n      # the end\n  "
        "tecs: {}\n",
        {p},
        "mission: m\ncomponents:\n  slc:\n    params:\n      roll_kp: 1    # fine\n      roll_limit: 42 "
        "deg\n      # the end\n  tecs: {}\n"},
       {"components:\n  slc: {use: x, params: {a: 1}}  # here\n",
        {p},
        "components:\n  slc: {use: x, params: {a: 1, roll_limit: 42 deg}}  # here\n"},
       {"components:\n  slc: {use: x}\n",
        {p},
        "components:\n  slc: {use: x, params: {roll_limit: 42 deg}}\n"},
       {"components:\n  slc: {params: {}}\n", {p}, "components:\n  slc: {params: {roll_limit: 42 deg}}\n"},
       {"components:\n  slc:\n    params:\n    rate: 1 Hz\n",
        {p},
        "components:\n  slc:\n    params: {roll_limit: 42 deg}\n    rate: 1 Hz\n"},
       {"components:\n  tecs: {}\ndone: a\n",
        {p},
        "components:\n  tecs: {}\n  slc: {params: {roll_limit: 42 deg}}\ndone: a\n"},
       {"mission: m", {p}, "mission: m\ncomponents: {slc: {params: {roll_limit: 42 deg}}}\n"},
       {"components:\n  slc: {\n    params: {a: 1,  # one\n             b: 2  # two, {\n    }}\n",
        {p, number("gain", 0.3, "rad/rad")},
        "components:\n  slc: {\n    params: {a: 1,  # one\n             b: 2, roll_limit: 42 deg, gain: 0.3  "
        "# two, {\n    }}\n"}});
}

TEST_CASE("an alias is replaced by the value; an anchor whose aliases others use is left alone") {
  const std::string mission = "components:\n  slc: {params: {roll_kp: &k 0.5, pitch_kp: *k}}\n";
  check_edits({{mission,
                {number("pitch_kp", 0.75, "rad/rad"), number("roll_kp", 0.5, "rad/rad")},
                "components:\n  slc: {params: {roll_kp: &k 0.5, pitch_kp: 0.75}}\n"}});
  CHECK(refused(mission, {number("roll_kp", 0.75, "rad/rad")}) ==
        "m.yaml: save.edit_by_hand(slc.roll_kp, 0.75, save.text_shared(components.slc.params.pitch_kp))");
  CHECK(refused("x: &g {roll_kp: 1}\ncomponents: {slc: {params: *g}}\n", {number("yaw_kp", 2)}) ==
        "m.yaml: save.edit_by_hand(slc.yaw_kp, 2, save.map_is_alias(params, *g))");
}

TEST_CASE("a value is written into the file that it came from: what the mission extends, or the airframe") {
  const Folder folder;
  folder.file("plane.yaml",
              "mass: 4.5 kg\nparams:\n  control_slc/Outer:\n    course_kp: 2   # 1.15 rad/s\n  "
              "control_slc/Inner:\n    course_kp: 7\n");
  folder.file("common.yaml",
              "components:\n  slc: {params: {climb_kff: 0.05}}\nroles: {r: {out: {truth?: T}}}\n");
  const fs::path mission = folder.file(
      "m.yaml", "extends: common.yaml\nairframe: plane.yaml\ncomponents:\n  slc: {params: {thrust: 50 N}}\n");
  const SavePlan plan = plan_save(
      mission,
      {number("course_kp", 2.5, "rad/rad"), number("climb_kff", 0.06, "1/m"), number("thrust", 55.5, "N")},
      {});
  CHECK(plan.refused.empty());
  CHECK(plan.changed == std::vector<std::string>{"slc.course_kp", "slc.climb_kff", "slc.thrust"});
  REQUIRE(plan.files.size() == 3);
  CHECK(diff_text(plan.files[0]) ==
        "m.yaml:4\n-   slc: {params: {thrust: 50 N}}\n+   slc: {params: {thrust: 55.5 N}}\n");
  CHECK(diff_text(plan.files[1]) ==
        "common.yaml:2\n-   slc: {params: {climb_kff: 0.05}}\n+   slc: {params: {climb_kff: 0.06}}\n");
  CHECK(diff_text(plan.files[2]) ==
        "plane.yaml:4\n-     course_kp: 2   # 1.15 rad/s\n+     course_kp: 2.5   # 1.15 rad/s\n");
}

TEST_CASE(
    "gains that the airframe gives to two plugins by one text are written when one of the two flies, which "
    "is told") {
  const Folder folder;
  folder.file("plane.yaml",
              "params:\n  control_slc/Outer: &gains\n    course_kp: 2\n  control_slc/Autotune: *gains\n");
  const fs::path mission = folder.file("m.yaml", "airframe: plane.yaml\n");
  const std::vector<SavedParam> now{number("course_kp", 2.5, "rad/rad")};
  const SavePlan plan = plan_save(mission, now, {"control_slc/Outer", "control_tecs/Autotune"});
  CHECK(plan.refused.empty());
  REQUIRE(plan.files.size() == 1);
  CHECK(diff_text(plan.files[0]) == "plane.yaml:3\n-     course_kp: 2\n+     course_kp: 2.5\n");
  CHECK(plan.also == std::vector<std::string>{"plane.yaml: save.text_of_other_plugin(slc.course_kp, "
                                              "control_slc/Autotune)"});
  for (const char* other : {"control_slc/Autotune", "control_slc"}) {
    const SavePlan both = plan_save(mission, now, {"control_slc/Outer", other});
    CHECK(both.files.empty());
    CHECK(both.also.empty());
    REQUIRE(both.refused.size() == 1);
    CHECK(both.refused[0] ==
          "plane.yaml: save.edit_by_hand(slc.course_kp, 2.5, "
          "save.text_shared(params.control_slc/Autotune.course_kp))");
  }
  // another place of that text is no parameter of the airframe
  folder.file("plane.yaml",
              "params:\n  control_slc/Outer:\n    course_kp: &k 2\n  x: {y: {course_kp: *k}}\n");
  CHECK(plan_save(mission, now, {"control_slc/Outer"}).refused.size() == 1);
}

TEST_CASE("what a mission extends may extend another: a value is found in each, and the nearest counts") {
  const Folder folder;
  folder.file("far.yaml", "components:\n  slc: {params: {a: 1, b: 2}}\n");
  folder.file("near.yaml", "extends: far.yaml\ncomponents:\n  slc: {params: {b: 3}}\n");
  const fs::path mission = folder.file("m.yaml", "extends: near.yaml\n");
  CHECK(plan_save(mission, {number("a", 1), number("b", 3)}, {}).files.empty());
  const SavePlan plan = plan_save(mission, {number("a", 4), number("b", 5)}, {});
  REQUIRE(plan.files.size() == 2);
  CHECK(diff_text(plan.files[0]).find("+   slc: {params: {b: 5}}") != std::string::npos);
  CHECK(diff_text(plan.files[1]).find("+   slc: {params: {a: 4, b: 2}}") != std::string::npos);
  folder.file("far.yaml", "extends: near.yaml\n");
  CHECK(plan_save(mission, {number("b", 3)}, {}).files.empty());  // a circle ends
}

TEST_CASE("an added line is shown as one, and a file that has changed meanwhile is not written") {
  const Folder folder;
  const fs::path mission =
      folder.file("m.yaml", "components:\n  slc:\n    params:\n      a: 1\n  tecs: {}\n");
  const SavePlan plan = plan_save(mission, {number("b", 2)}, {});
  REQUIRE(plan.files.size() == 1);
  CHECK(diff_text(plan.files[0]) == "m.yaml:5\n+       b: 2\n");
  folder.file("m.yaml", "mission: other\n");
  CHECK_THROWS_WITH_AS(write_edit(plan.files[0]), ("save.file_changed(" + mission.string() + ")").c_str(),
                       Error);
}

TEST_CASE("writing leaves other files alone, and keeps the mode of its own and the link to it") {
  const Folder folder;
  const fs::path mission = folder.file("m.yaml", "components:\n  slc:\n    params:\n      a: 1\n");
  const fs::path copy = folder.file("m.yaml.new", "mine\n");
  fs::permissions(mission, fs::perms::owner_all | fs::perms::group_read);
  fs::create_symlink("m.yaml", folder.path / "link.yaml");
  const auto text = [](const fs::path& file) {
    std::stringstream now;
    now << std::ifstream(file, std::ios::binary).rdbuf();
    return now.str();
  };
  const auto names = [&] {
    std::vector<std::string> list;
    for (const auto& entry : fs::directory_iterator(folder.path)) list.push_back(entry.path().filename());
    std::sort(list.begin(), list.end());
    return list;
  };
  const std::vector<std::string> there = names();
  write_edit(plan_save(folder.path / "link.yaml", {number("a", 2)}, {}).files.at(0));
  CHECK(text(mission) == "components:\n  slc:\n    params:\n      a: 2\n");
  CHECK(text(copy) == "mine\n");
  CHECK(fs::status(mission).permissions() == (fs::perms::owner_all | fs::perms::group_read));
  CHECK(fs::is_symlink(folder.path / "link.yaml"));
  CHECK(names() == there);
}

TEST_CASE("what cannot be written whole leaves the file as it was, and nothing beside it") {
  const Folder folder;
  const std::string before = "components:\n  slc:\n    params:\n      a: 1\n";
  const fs::path mission = folder.file("m.yaml", before);
  const FileEdit edit = plan_save(mission, {number("a", 2)}, {}).files.at(0);
  rlimit usual{};
  REQUIRE(::getrlimit(RLIMIT_FSIZE, &usual) == 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{10, usual.rlim_max};
  ::setrlimit(RLIMIT_FSIZE, &small);  // as if the disk were full after ten bytes
  std::string said;
  try {
    write_edit(edit);
  } catch (const Error& e) {
    said = e.what();
  }
  ::setrlimit(RLIMIT_FSIZE, &usual);
  std::signal(SIGXFSZ, handler);
  CHECK(said == "save.file_not_writable(" + mission.string() + ", File too large)");
  std::stringstream now;
  now << std::ifstream(mission, std::ios::binary).rdbuf();
  CHECK(now.str() == before);
  CHECK(std::distance(fs::directory_iterator(folder.path), fs::directory_iterator()) == 1);
}

TEST_CASE("a file that is read-only is left alone, by an administrator too") {
  const Folder folder;
  const std::string before = "components:\n  slc:\n    params:\n      a: 1\n";
  const fs::path mission = folder.file("m.yaml", before);
  const FileEdit edit = plan_save(mission, {number("a", 2)}, {}).files.at(0);
  fs::permissions(mission, fs::perms::owner_read);
  CHECK_THROWS_AS(write_edit(edit), Error);
  std::stringstream now;
  now << std::ifstream(mission, std::ios::binary).rdbuf();
  CHECK(now.str() == before);
}

TEST_CASE("block scalars and broken files are refused") {
  CHECK(refused("components:\n  slc:\n    params:\n      note: |\n        a\n", {text("note", "b")}) ==
        "m.yaml: save.edit_by_hand(slc.note, b, save.value_form_unsupported)");
  CHECK(refused("components:\n  slc:\n    params:\n      wind:\n        - 1\n        - 2\n        - 3\n",
                {vector("wind", 1, 2, 4, "m")}) ==
        "m.yaml: save.edit_by_hand(slc.wind, [1 m, 2 m, 4 m], save.list_form_unsupported)");
  const Folder folder;
  CHECK_THROWS_AS(plan_save(folder.file("m.yaml", "a: {b\n"), {number("x", 1)}, {}), Error);
}

TEST_CASE(
    "what stands in a file of the installation is written into the mission, which begins where that ends") {
  const Folder folder;
  const fs::path mission = folder.file("m.yaml", "mission: mine\nextends: fulmar:missions/hourglass.yaml\n");
  const SavePlan plan =
      plan_save(mission, {number("course_kp", 2.25, "rad/rad"), number("course_ki", 0, "rad/(rad s)")}, {});
  CHECK(plan.refused.empty());
  REQUIRE(plan.files.size() == 1);
  const std::string after =
      "mission: mine\nextends: fulmar:missions/hourglass.yaml\n"
      "components: {slc: {params: {course_kp: 2.25}}}\n";
  CHECK(plan.files[0].after == after);
  write_edit(plan.files[0]);
  const SavePlan again = plan_save(mission, {number("course_kp", 2.5, "rad/rad")}, {});
  REQUIRE(again.files.size() == 1);
  CHECK(again.files[0].after.find("{course_kp: 2.5}") != std::string::npos);
  folder.file("m.yaml", "mission: mine\nairframe: fulmar:airframes/anaconda.yaml\n");
  const SavePlan of_airframe = plan_save(mission, {number("course_kp", 2.25, "rad/rad")}, {});
  REQUIRE(of_airframe.files.size() == 1);
  CHECK(of_airframe.files[0].path == mission);
}

TEST_CASE("a shipped mission keeps every byte but those of the value") {
  const fs::path source = fs::path(FULMAR_SOURCE_DIR) / "configs";
  const SavePlan plan =
      plan_save(source / "missions/hourglass.yaml", {number("course_kp", 2.25, "rad/rad")}, {});
  REQUIRE(plan.files.size() == 1);
  CHECK(plan.files[0].path.filename() == "anaconda.yaml");
  CHECK(plan.files[0].after.size() == plan.files[0].before.size() + 1);
  CHECK(diff_text(plan.files[0]).find("+     course_kp: 2.25          # 1.21 rad/s") != std::string::npos);
}

}  // namespace param_file_test

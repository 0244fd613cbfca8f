// SPDX-License-Identifier: BSD-3-Clause
// The law in C: its numbers computed by hand, and a flight to the end of its mission.
#include <doctest/doctest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "core/loader/library.hpp"
#include "sdk/test/said.hpp"

using namespace fulmar::core;
namespace fs = std::filesystem;

namespace {

// A copy of the example's folder whose build/ holds the plugin.
struct Project {
  fs::path path = fs::temp_directory_path() / ("fulmar-c-law-test-" + std::to_string(::getpid()));
  Project() {
    fs::create_directories(path / "examples" / "c_law" / "build");
    fs::create_directory_symlink(FULMAR_SOURCE_DIR "/configs", path / "configs");
    fs::copy_file(FULMAR_SOURCE_DIR "/examples/c_law/mission.yaml", mission());
    fs::copy_file(C_LAW_FOLDER "/c_law.so", path / "examples" / "c_law" / "build" / "c_law.so");
  }
  ~Project() { fs::remove_all(path); }
  fs::path mission() const { return path / "examples" / "c_law" / "mission.yaml"; }
};

std::string output_of(const std::string& command) {
  const fulmar::test::Said printed = fulmar::test::shell(command);
  CHECK(printed.code == 0);
  return printed.out;
}

}  // namespace

TEST_CASE("the law in C computes the result of its equations") {
  const auto library = Library::open(C_LAW_FOLDER "/c_law.so");
  const ComponentInfo& info = library->info().components.at(0);
  const fulmar_component& law = library->functions(0);
  fulmar_error error{};
  void* self = law.create(1, &error);
  std::vector<fulmar_value> values(info.params.size());
  for (std::size_t i = 0; i < values.size(); ++i) values[i].number[0] = info.params[i].initial[0];
  REQUIRE(law.configure(self, values.data(), &error) == FULMAR_OK);
  const double state[] = {60, 3.1, 15};           // height, course (just east of south), airspeed
  const double command[] = {-3.1, 65, 17, 0.05};  // course (just west of south), height, airspeed, roll
  fulmar_input inputs[2]{};
  inputs[0].data = state;
  inputs[1].data = command;
  double attitude[3], probe = 0;
  fulmar_output outputs[2]{};
  outputs[0].data = attitude;
  outputs[1].data = &probe;
  const fulmar_tick tick{0, 10'000'000, 0};
  REQUIRE(law.step(self, &tick, inputs, outputs, &error) == FULMAR_OK);
  CHECK(attitude[0] == doctest::Approx(0.05 + 1.2 * (2 * M_PI - 6.2)));
  CHECK(attitude[1] == doctest::Approx(0.02 + 0.03 * 5));
  CHECK(attitude[2] == doctest::Approx(0.4 + 0.1 * 2));
  CHECK(probe == 5);
  CHECK(outputs[1].count == 1);
  values[static_cast<std::size_t>(info.param("roll_max"))].number[0] = 0.1;
  REQUIRE(law.retune(self, values.data(), &error) == FULMAR_OK);
  REQUIRE(law.step(self, &tick, inputs, outputs, &error) == FULMAR_OK);
  CHECK(attitude[0] == doctest::Approx(0.1));
  law.destroy(self);
}

TEST_CASE("the mission of the law in C is flown to its end, and no guard fires") {
  const Project project;
  const std::string program = std::string(FULMAR_BIN_DIR "/fulmar ");
  const auto result =
      nlohmann::json::parse(output_of(program + "run " + project.mission().string() + " --json --no-log"));
  CHECK(result["result"] == "flown");
  CHECK(result["guards"].empty());
  double cruised = 0;
  for (const auto& phase : result["phases"])
    if (phase["name"] == "cruise") cruised = phase["to_s"].get<double>() - phase["from_s"].get<double>();
  CHECK(cruised > 30);  // this law was active
}

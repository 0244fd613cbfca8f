// SPDX-License-Identifier: BSD-3-Clause
// Plugins built against the headers of revision 0f1b247, in the present host: their tables, their steps, a
// flight.
#include <doctest/doctest.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/loader/library.hpp"
#include "sdk/test/said.hpp"

namespace abi_1_test {

using namespace fulmar::core;
namespace fs = std::filesystem;

namespace {

std::shared_ptr<Library> plugin(const std::string& name) {
  return Library::open(ABI_1_PLUGINS "/" + name + ".so");
}

/// One component of a plugin, called like in the host: fields are found by name in its tables.
struct Rig {
  explicit Rig(std::shared_ptr<Library> plugin)
      : library(std::move(plugin)), info(library->info().components.at(0)), table(library->functions(0)) {
    self = table.create(1, &error);
    REQUIRE(self != nullptr);
    for (const Port& port : info.inputs) in_data.emplace_back(port.type->size);
    for (const Port& port : info.outputs) out_data.emplace_back(port.type ? port.type->size : sizeof(double));
    last_data = out_data;
    inputs.resize(info.inputs.size()), last.resize(info.outputs.size()), outputs.resize(info.outputs.size());
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      if (info.inputs[i].kind != FULMAR_IN_VALUE) continue;
      inputs[i].data = in_data[i].data();
      inputs[i].sequence = inputs[i].count = 1;
    }
    for (std::size_t i = 0; i < outputs.size(); ++i) outputs[i].data = out_data[i].data();
    for (const ParamInfo& param : info.params) {
      fulmar_value value{};
      std::memcpy(value.number, param.initial, sizeof value.number);
      value.integer = static_cast<std::int64_t>(param.initial[0]);
      value.data = param.initial_data.data(), value.size = param.initial_data.size();
      values.push_back(value);
    }
  }
  ~Rig() { table.destroy(self); }
  Rig(const Rig&) = delete;
  Rig& operator=(const Rig&) = delete;

  fulmar_value& value(const std::string& param) {
    return values[static_cast<std::size_t>(info.param(param))];
  }
  void set(const std::string& port, const std::string& field, double number) {
    const auto i = static_cast<std::size_t>(info.input(port));
    std::memcpy(&in_data[i][info.inputs[i].type->find(field)->offset], &number, sizeof number);
  }
  double get(const std::string& port, const std::string& field = "") const {
    const auto i = static_cast<std::size_t>(info.output(port));
    double number = 0;
    std::memcpy(&number, &out_data[i][field.empty() ? 0 : info.outputs[i].type->find(field)->offset],
                sizeof number);
    return number;
  }
  std::uint32_t count(const std::string& port) const {
    return outputs[static_cast<std::size_t>(info.output(port))].count;
  }
  /// Sets the last applied output of the role: one field, the others zero.
  void apply(const std::string& port, const std::string& field, double number) {
    const auto i = static_cast<std::size_t>(info.output(port));
    std::memcpy(&last_data[i][info.outputs[i].type->find(field)->offset], &number, sizeof number);
    last[i].data = last_data[i].data();
  }
  fulmar_answer ask(const std::string& port, double number) {
    const auto i = static_cast<std::size_t>(info.input(port));
    fulmar_answer answer{};
    const std::int64_t stamp = 0;
    inputs[i].data = &number, inputs[i].stamps_ns = &stamp, inputs[i].answers = &answer, inputs[i].count = 1;
    CHECK(step() == FULMAR_OK);
    inputs[i] = {};
    return answer;
  }
  std::uint32_t configure() { return table.configure(self, values.data(), &error); }
  std::uint32_t retune() { return table.retune(self, values.data(), &error); }
  std::uint32_t activate() { return table.activate(self, &tick, inputs.data(), last.data(), &error); }
  std::uint32_t step() {
    for (fulmar_output& out : outputs) out.count = 0;
    return table.step(self, &tick, inputs.data(), outputs.data(), &error);
  }

  std::vector<fulmar_value> values;
  fulmar_error error{};
  fulmar_tick tick{0, 10'000'000, 0};

  std::shared_ptr<Library> library;
  const ComponentInfo& info;
  const fulmar_component& table;
  void* self = nullptr;
  std::vector<std::vector<std::byte>> in_data, out_data, last_data;
  std::vector<fulmar_input> inputs, last;
  std::vector<fulmar_output> outputs;
};

/// Course just east of south, command just west of it; 5 m too low and 2 m/s too slow.
void set_scene(Rig& rig) {
  rig.set("state", "height_m", 60), rig.set("state", "course_rad", 3.1), rig.set("state", "airspeed_mps", 15);
  rig.set("command", "height_m", 65), rig.set("command", "course_rad", -3.1);
  rig.set("command", "airspeed_mps", 17), rig.set("command", "roll_feedforward_rad", 0.05);
}

std::vector<std::string> names_of(const std::vector<ParamInfo>& params) {
  std::vector<std::string> names;
  for (const ParamInfo& param : params) names.push_back(param.name);
  return names;
}

}  // namespace

TEST_CASE("an old law in C: its tables, and the numbers of its equations") {
  const auto library = plugin("abi_1_c_law");
  CHECK(library->info().abi_major == 1);
  CHECK(library->info().abi_minor == 2);
  Rig rig(library);
  CHECK(rig.info.name == "CLaw");
  CHECK(names_of(rig.info.params) == std::vector<std::string>{"course_kp", "height_kp", "airspeed_kp",
                                                              "throttle_trim", "pitch_trim", "roll_max",
                                                              "pitch_max"});
  CHECK_FALSE(rig.info.activates);
  REQUIRE(rig.configure() == FULMAR_OK);
  set_scene(rig);
  REQUIRE(rig.step() == FULMAR_OK);
  CHECK(rig.get("attitude", "roll_rad") == doctest::Approx(0.05 + 1.2 * (2 * M_PI - 6.2)));
  CHECK(rig.get("attitude", "pitch_rad") == doctest::Approx(0.02 + 0.03 * 5));
  CHECK(rig.get("attitude", "throttle_frac") == doctest::Approx(0.4 + 0.1 * 2));
  CHECK(rig.get("height_error_m") == 5);
  CHECK(rig.count("height_error_m") == 1);
}

// The same source twice: as built then, and built again with the present SDK.
TEST_CASE(
    "a law in C++ of then, and its source built today: tables, parameters, hand-over, requests and steps") {
  for (const char* name : {"abi_1_cpp_law", "abi_1_cpp_law_rebuilt"}) {
    CAPTURE(name);
    Rig rig(plugin(name));
    CHECK(rig.info.name == "CppLaw");
    CHECK(rig.info.activates);
    CHECK(names_of(rig.info.params) == std::vector<std::string>{"course_kp", "height_kp", "airspeed_kp",
                                                                "airspeed_ki", "roll_max", "feedforward",
                                                                "height", "unused", "trim"});
    CHECK(rig.info.params[6].choices == std::vector<std::string>{"hold", "ignore"});
    CHECK_FALSE(rig.info.params[7].live);
    REQUIRE(rig.info.inputs.size() == 3);
    CHECK(rig.info.inputs[2].kind == FULMAR_IN_REQUEST);
    REQUIRE(rig.info.outputs.size() == 2);
    CHECK(rig.info.outputs[1].kind == FULMAR_OUT_PROBE);

    rig.value("unused").integer = 7;
    CHECK(rig.configure() == FULMAR_FAILED);
    CHECK(std::string(rig.error.text) == "seven is unlucky");
    rig.value("unused").integer = 3;
    const double trim[] = {0.45, 0.03};  // the record as the host reads it: throttle, pitch
    rig.value("trim").data = trim, rig.value("trim").size = sizeof trim, rig.value("trim").integer = 1;
    REQUIRE(rig.configure() == FULMAR_OK);

    set_scene(rig);
    REQUIRE(rig.step() == FULMAR_OK);
    const double first = 0.05 * 2 * 0.01;  // integral of one step
    CHECK(rig.get("attitude", "roll_rad") == doctest::Approx(0.05 + 1.2 * (2 * M_PI - 6.2)));
    CHECK(rig.get("attitude", "pitch_rad") == doctest::Approx(0.03 + 0.03 * 5));
    CHECK(rig.get("attitude", "throttle_frac") == doctest::Approx(0.45 + 0.1 * 2 + first));
    CHECK(std::abs(rig.get("throttle_integral_frac") - first) < 1e-9);
    CHECK(rig.count("throttle_integral_frac") == 1);

    rig.apply("attitude", "throttle_frac", 0.9);
    REQUIRE(rig.activate() == FULMAR_OK);
    REQUIRE(rig.step() == FULMAR_OK);
    CHECK(rig.get("attitude", "throttle_frac") == doctest::Approx(0.9 + first));

    CHECK(rig.ask("restart", 0.125).verdict == FULMAR_ACCEPTED);
    CHECK(std::abs(rig.get("throttle_integral_frac") - 0.125 - first) < 1e-9);
    const fulmar_answer refused = rig.ask("restart", 0.75);
    CHECK(refused.verdict == FULMAR_REFUSED);
    const std::string reason = "an integral is at most 0.5";  // of the plugin, which is the old build
    CHECK(std::string(refused.reason) == reason);

    rig.value("feedforward").integer = 0, rig.value("height").integer = 1,
    rig.value("roll_max").number[0] = 0.0625;
    REQUIRE(rig.retune() == FULMAR_OK);
    REQUIRE(rig.step() == FULMAR_OK);
    CHECK(rig.get("attitude", "roll_rad") == 0.0625);
    CHECK(rig.get("attitude", "pitch_rad") == 0.03);
  }
}

TEST_CASE("old messages have the form of the present ones: an old law takes over from a present one") {
  const auto today = Library::open(FULMAR_PLUGIN_DIR "/control_slc.so");
  const ComponentInfo& outer = today->info().components.at(0);
  for (const char* name : {"abi_1_cpp_law", "abi_1_cpp_law_rebuilt"}) {
    const auto library = plugin(name);
    const ComponentInfo& law = library->info().components.at(0);
    for (const char* port : {"state", "command"}) {  // appended fields do not prevent it
      const auto then = static_cast<std::size_t>(law.input(port)),
                 now = static_cast<std::size_t>(outer.input(port));
      CHECK(incompatibility(*law.inputs[then].type, *outer.inputs[now].type) == "");
      CHECK(incompatibility(*outer.inputs[now].type, *law.inputs[then].type) == "");
    }
    CHECK(law.outputs[0].type->hash == outer.outputs[0].type->hash);
  }
}

namespace {

/// Flies a mission of this folder with an old plugin beside it; returns its result.
nlohmann::json flown(const std::string& mission, const std::string& law) {
  const fs::path folder = fs::temp_directory_path() / ("fulmar-abi-1-test-" + std::to_string(::getpid()));
  const fs::path home = folder / "core" / "test" / "abi_1";
  fs::create_directories(home);
  fs::create_directory_symlink(FULMAR_SOURCE_DIR "/configs", folder / "configs");
  fs::copy_file(ABI_1_SOURCES "/" + mission, home / mission);
  fs::copy_file(ABI_1_PLUGINS "/" + law, home / law);
  const std::string command = FULMAR_BIN_DIR "/fulmar run " + (home / mission).string() + " --json --no-log";
  const fulmar::test::Said said = fulmar::test::shell(command);
  CHECK(said.code == 0);
  fs::remove_all(folder);
  return nlohmann::json::parse(said.out);
}

}  // namespace

TEST_CASE("an old law flies a present mission to its end, and no guard fires") {
  const auto result = flown("mission.yaml", "abi_1_cpp_law.so");
  CHECK(result["result"] == "flown");
  CHECK(result["guards"].empty());
  double cruised = 0;
  for (const auto& phase : result["phases"])
    if (phase["name"] == "cruise") cruised = phase["to_s"].get<double>() - phase["from_s"].get<double>();
  CHECK(cruised > 30);  // this law was active
}

TEST_CASE("the present laws follow an old guide, whose message has fewer fields") {
  const auto result = flown("guided.yaml", "abi_1_guide.so");
  CHECK(result["result"] == "flown");
  CHECK(result["guards"].empty());
  CHECK(std::abs(result["state"]["course_deg"].get<double>() - 0.8 * 180 / M_PI) < 5);  // and held
  CHECK(std::abs(result["state"]["airspeed_mps"].get<double>() - 17) < 1);
}

}  // namespace abi_1_test

// SPDX-License-Identifier: BSD-3-Clause
// The maiden flight of docs/hardware.md, step by step, with the commands of that page, on the software flight
// controller in virtual time. The pilot takes off, hands over for a while, and takes back.
#include <doctest/doctest.h>

#include <map>
#include <sstream>

#include "core/app/test/unlogged.hpp"
#include "core/app/test/virtual_controller.hpp"

using namespace fulmar::core;
using namespace fulmar::core::through_controller;
namespace fs = std::filesystem;

namespace maiden_flight_test {

constexpr double deg = pi / 180;

/// step -> its command, as one line.
std::map<int, std::string> commands() {
  std::ifstream page(FULMAR_SOURCE_DIR "/docs/hardware.md");
  std::map<int, std::string> list;
  bool inside = false, goes_on = false;
  int step = 0;
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with("### ")) inside = line == "### Maiden flight";
    if (!inside) continue;
    if (line.size() > 2 && std::isdigit(static_cast<unsigned char>(line[0])) && line[1] == '.')
      step = line[0] - '0';
    if (goes_on || line.starts_with("       fulmar run ")) list[step] += line;
    goes_on = !list[step].empty() && list[step].ends_with("\\");
    if (goes_on) list[step].pop_back();
  }
  std::erase_if(list, [](const auto& entry) { return entry.second.empty(); });
  return list;
}

/// Arguments of a command line; quotes join them.
std::vector<std::string> words(const std::string& command) {
  std::vector<std::string> list(1);
  bool quoted = false;
  for (const char c : command) {
    if (c == '"') quoted = !quoted;
    if (c == ' ' && !quoted && !list.back().empty()) list.emplace_back();
    if (c != '"' && (c != ' ' || quoted)) list.back() += c;
  }
  return list;
}

/// The mission of a command with its settings, on the software controller.
Graph mission_of(const std::string& command, const fs::path& folder, double pilot_height_m) {
  const std::vector<std::string> w = words(command);
  REQUIRE(w.size() >= 5);
  REQUIRE(w[0] + " " + w[1] == "fulmar run");
  CHECK(w[3] + " " + w[4] == "--io fcu");
  Overrides overrides;
  for (std::size_t i = 5; i + 1 < w.size(); ++i)
    if (w[i] == "--set") {
      const auto at = w[i + 1].find('=');
      overrides.set.emplace_back(w[i + 1].substr(0, at), w[i + 1].substr(at + 1));
    }
  const fs::path file = folder / "maiden.yaml";
  std::ofstream(file)
      << "mission: maiden\nextends: " FULMAR_SOURCE_DIR "/" << w[2]
      << "\narm: off\nlive: off\nseed: 3\ncomponents:\n"
      << "  sim: {fills: vehicle, use: " FULMAR_TEST_PLUGIN_DIR
         "/fcu_virtual.so, in: {state: nav.state}, params: {sensors: null, start_heading: null, "
         "pilot_height: "
      << pilot_height_m << " m}}\n";
  return load_mission(file.string(), overrides);
}

/// One flight of the page. The pilot has control until the hand-over.
class Maiden {
 public:
  Maiden(int step, const fs::path& folder, double pilot_height_m = 80)
      : f_(mission_of(commands().at(step), folder, pilot_height_m), test::unlogged()) {
    if (pilot_height_m > 0) take_back();
  }
  bool wait(double seconds) {
    const double until = f_.row().t_s + seconds;
    return f_.fly_while([until](const Row& r) { return r.t_s < until; });
  }
  void take_back() {
    f_.set("pilot_from", -100);
    f_.set("pilot_until", 1e9);
  }
  void hand_over() { f_.set("pilot_until", -100); }
  /// The pilot takes off and climbs, then flies straight for a while.
  bool pilot_climbs() {
    return f_.fly_while([](const Row& r) { return r.height_m < 75 && r.t_s < 120; }) && wait(10) &&
           f_.row().height_m > 70 && !f_.row().host;
  }
  /// Rows of a hand-over of this duration.
  std::vector<Row> given(double seconds) {
    hand_over();
    wait(0.5);  // until the next frame of the radio, and the hand-over
    f_.rows.clear();
    wait(seconds);
    std::vector<Row> rows;
    for (const Row& r : f_.rows)
      if (r.host) rows.push_back(r);
    CHECK(rows.size() > 0.9 * 400 * seconds);
    return rows;
  }
  Row now() const { return f_.row(); }
  Flown& flown() { return f_; }

 private:
  Flown f_;
};

double max_bank_deg(const std::vector<Row>& rows) {
  double most = 0;
  for (const Row& r : rows) most = std::max(most, std::abs(r.roll_rad) / deg);
  return most;
}

TEST_CASE("the page prints a command for each step in which the computer flies") {
  const auto list = commands();
  for (const int step : {2, 3, 4, 5, 6}) CHECK_MESSAGE(list.count(step) == 1, step);
}

TEST_CASE("step 2: the computer observes, and the pilot has control all the time") {
  const test::OwnStore folder;
  Maiden m(2, folder.path);
  REQUIRE(m.pilot_climbs());
  REQUIRE(m.wait(20));
  for (const Row& r : m.flown().rows) REQUIRE_FALSE(r.host);
  CHECK(m.now().attitude_valid);
  CHECK(m.flown().sticks() < 0.01);
}

TEST_CASE("step 3: handed over for 2, 5 and 10 s it keeps its wings level") {
  const test::OwnStore folder;
  Maiden m(3, folder.path);
  REQUIRE(m.pilot_climbs());
  for (const double seconds : {2.0, 5.0, 10.0}) {
    CAPTURE(seconds);
    const double height_m = m.now().height_m;
    const auto rows = m.given(seconds);
    CHECK(max_bank_deg(rows) < 10);
    CHECK(std::abs(rows.back().height_m - height_m) < 5);
    m.take_back();
    REQUIRE(m.wait(6));
  }
}

TEST_CASE("step 4: it keeps height and speed with level wings") {
  const test::OwnStore folder;
  Maiden m(4, folder.path);
  REQUIRE(m.pilot_climbs());
  const auto rows = m.given(40);
  CHECK(max_bank_deg(rows) < 10);
  for (const Row& r : rows) REQUIRE(std::abs(r.height_m - rows.front().height_m) < 5);
}

TEST_CASE("step 5: the path is flown with little bank, step 6: as in any flight") {
  for (const int step : {5, 6}) {
    CAPTURE(step);
    const test::OwnStore folder;
    Maiden m(step, folder.path);
    REQUIRE(m.pilot_climbs());
    const auto rows = m.given(120);
    CHECK(max_bank_deg(rows) < (step == 5 ? 28 : 55));
    const Hourglass plan;
    double nearest_m = 1e9;
    for (const Row& r : rows) nearest_m = std::min(nearest_m, plan.distance_m(r.north_m, r.east_m));
    CHECK(nearest_m < 5);
    CHECK(rows.back().height_m == doctest::Approx(70).epsilon(0.05));
  }
}

TEST_CASE("step 7: armed on the ground and switched to the computer it takes off") {
  const test::OwnStore folder;
  Maiden m(6, folder.path, 0);
  REQUIRE(m.wait(60));
  CHECK(m.now().host);
  CHECK(m.now().height_m > 60);
}

}  // namespace maiden_flight_test

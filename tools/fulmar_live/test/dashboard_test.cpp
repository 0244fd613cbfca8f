// SPDX-License-Identifier: BSD-3-Clause
// The screen of `fulmar watch` from given messages.
#include "tools/fulmar_live/dashboard.hpp"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tools/fulmar_live/table.hpp"

namespace dashboard_test {

using fulmar::core::Dashboard;
using fulmar::core::PlotSize;
using nlohmann::json;
using nlohmann::ordered_json;

namespace {

json component(const char* name, const char* role, bool active, double mean_us, double most_us) {
  return {{"name", name}, {"role", role},       {"active", active},       {"stopped", false},
          {"steps", 100}, {"step_us", mean_us}, {"step_max_us", most_us}, {"budget_us", 250.0}};
}

json view() {
  return {{"mission", "hourglass"},
          {"io", "sim"},
          {"phase", "cruise"},
          {"now_ns", 83'449'000'000},
          {"armed", true},
          {"paused", false},
          {"speed", 1.0},
          {"over", false},
          {"components",
           {component("sim", "vehicle", true, 21.4, 80), component("ekf", "nav", true, 45.2, 120),
            component("slc", "outer", true, 3.14, 9), component("tecs", "outer", false, 0, 0),
            component("mine", "guide, inner", true, 2, 301)}}};
}

ordered_json state() {
  return {{"position_m", {{"north", 123.4}, {"east", -0.4}, {"down", -70.2}}},
          {"position_std_m", {{"north", 0.3}, {"east", 0.4}, {"down", 1}}},
          {"roll_deg", -12.34},
          {"pitch_deg", 3.1},
          {"yaw_deg", -45},
          {"height_m", 70.2},
          {"climb_rate_mps", -0.04},
          {"ground_speed_mps", 18.2},
          {"course_deg", -90.4},
          {"airspeed_mps", 16.1},
          {"wind_mps", {{"north", -3}, {"east", -4}, {"down", 0}}},  // blows to the south-west
          {"attitude_valid", true},
          {"velocity_valid", true},
          {"position_valid", true},
          {"height_valid", true},
          {"airspeed_valid", true},
          {"wind_valid", true}};
}

const std::map<std::string, std::string> topics = {{"/nav/state", "VehicleState"},
                                                   {"/vehicle/truth", "VehicleState"},
                                                   {"/guide/command", "GuidanceCommand"},
                                                   {"/outer/attitude", "AttitudeCommand"},
                                                   {"/a/attitude", "AttitudeCommand"},
                                                   {"/manage/progress", "Progress"},
                                                   {"/vehicle/status", "VehicleStatus"},
                                                   {"/nav/health", "NavigationHealth"},
                                                   {"/vehicle/gnss", "Gnss"},
                                                   {"/vehicle/rc", "Rc"},
                                                   {"/nav/other", "Other"},
                                                   {"/fulmar/event", "Event"}};

ordered_json event(const char* words, const char* severity = "info") {
  return {{"code", "phase_entered"},
          {"severity", severity},
          {"component", ""},
          {"name", "cruise"},
          {"words", words}};
}

Dashboard board() {
  Dashboard b;
  b.take_view(view());
  b.choose(topics);
  b.take("/nav/state", 83.4, state());
  b.take("/guide/command", 83.4,
         {{"height_m", 75}, {"airspeed_mps", 16}, {"climb_rate_mps", 0.5}, {"course_deg", 268.8}});
  b.take("/outer/attitude", 83.4, {{"roll_deg", -11.8}, {"pitch_deg", 2.9}, {"throttle_frac", 0.434}});
  b.take("/manage/progress", 83.4, {{"item", 2}, {"items", 4}, {"distance_m", 123.4}});
  b.take("/vehicle/status", 83.4,
         {{"in_control", true},
          {"health", "ok"},
          {"battery_volt", 11.84},
          {"battery_amp", 12.3},
          {"battery_frac", 0.871}});
  b.take("/nav/health", 83.4,
         {{"gyro", {{"state", "ok"}}}, {"gnss_position", {{"state", "ok"}}}, {"mag", {{"state", "never"}}}});
  b.take("/vehicle/gnss", 83.4, {{"satellites", 12}, {"fix", "fix_3d"}});
  b.take("/vehicle/rc", 83.4, {{"link", true}});
  b.take("/fulmar/event", -5, event("phase hold"));
  b.take("/fulmar/event", 13.05, event("phase cruise"));
  return b;
}

PlotSize size(int columns, int rows, bool colours = false) { return {columns, rows, colours}; }

std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> list;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) list.push_back(line);
  return list;
}
bool has(const std::string& text, const std::string& what) { return text.find(what) != std::string::npos; }

}  // namespace

TEST_CASE("what is shown of each type is the topic of a role, and no truth") {
  Dashboard b;
  b.take_view(view());
  const std::vector<std::string> chosen = b.choose(topics);
  const auto is = [&](const char* topic) { return std::count(chosen.begin(), chosen.end(), topic) == 1; };
  CHECK(is("/nav/state"));
  CHECK(is("/outer/attitude"));
  CHECK(is("/fulmar/event"));
  CHECK_FALSE(is("/vehicle/truth"));
  CHECK_FALSE(is("/a/attitude"));
  CHECK_FALSE(is("/nav/other"));
  CHECK(Dashboard().choose({{"/sim/truth", "VehicleState"}}) == std::vector<std::string>{"/sim/truth"});
  CHECK_FALSE(b.whole());
  CHECK(board().whole());
}

TEST_CASE("a flight is on one screen of 80 x 24") {
  const std::string text = board().text(size(80, 24));
  CHECK(text == R"(hourglass  cruise  1:23.4  armed  real time
height    70.2 → 75.0 m   roll      -12.3 → -11.8°  north     123 m
airspeed  16.1 → 16.0 m/s pitch     3.1 → 2.9°      east      0 m
climb     0.0 → 0.5 m/s   course    270 → 269°      ground    18.2 m/s
throttle  43 %            heading   315°            waypoint  2 of 4, 123 m
battery   87 %, 11.8 V    current   12.3 A          wind from 53°, 5.0 m/s
control   autopilot; radio there
estimator valid; position within 0.5 m (1 sigma)
sensors   gyro, gnss position, 12 satellites, fix 3d
roles     vehicle sim, nav ekf, outer slc, guide mine, inner mine
slowest   ekf 45 (120) us, sim 21 (80) us, slc 3.1 (9) us, mine 2.0 (301) us of
          250
0:13.1   phase cruise
-0:05.0   phase hold
)");
}

TEST_CASE("a narrow terminal gets the same words in more lines, a low one the last events all the same") {
  const std::string wide = board().text(size(200, 60)), narrow = board().text(size(30, 60));
  for (const std::string& line : lines(narrow)) CHECK(fulmar::core::width_of(line) <= 30);
  for (const char* what :
       {"70.2 → 75.0 m", "2 of 4, 123 m", "53°, 5.0 m/s", "autopilot", "hourglass", "phase hold"}) {
    CHECK(has(wide, what));
    CHECK(has(narrow, what));
  }
  const std::vector<std::string> low = lines(board().text(size(80, 10)));
  REQUIRE(low.size() == 9);
  CHECK(low[0] == lines(wide)[0]);
  CHECK(low[8] == "-0:05.0   phase hold");
}

TEST_CASE("what is old or not valid is not shown as what is") {
  Dashboard b = board();
  b.take("/vehicle/rc", 83.6, {{"link", true}});
  CHECK(has(b.text(size(80, 24)), "70.2 → 75.0 m"));
  ordered_json blind = state();
  blind["position_valid"] = false;
  blind["height_valid"] = false;
  b.take("/nav/state", 86, blind);
  const std::string text = b.text(size(80, 24));
  CHECK(has(text, "height    -  "));
  CHECK(has(text, "airspeed  16.1 m/s "));  // without a command in the last two seconds
  CHECK(has(text, "estimator no position, height"));
  CHECK(has(text, "control   remote.vehicle_silent\n"));
  CHECK_FALSE(has(text, "123.4"));
}

TEST_CASE("what has gone wrong is told: guards, sensors, the vehicle, the link") {
  Dashboard b = board();
  json guarded = view();
  guarded["components"][2]["stopped"] = true;
  guarded["paused"] = true;
  guarded["over"] = true;
  b.take_view(guarded);
  b.take("/nav/health", 83.5, {{"gyro", {{"state", "ok"}}}, {"baro", {{"state", "stuck"}}}});
  b.take("/vehicle/status", 83.5, {{"failsafe", true}, {"health", "degraded"}, {"battery_frac", 0.1}});
  b.take("/vehicle/rc", 83.5, {{"link", false}});
  b.take("/vehicle/gnss", 83.5, {{"satellites", 3}, {"fix", "none"}});
  const std::string text = b.text(size(100, 24));
  CHECK(has(text, "1:23.5  armed  paused  over\n"));
  CHECK(has(text, "outer nobody (stopped: slc)"));
  for (const char* row : {"sensors   baro stuck, 3 satellites, none; ok: gyro\n",
                          "control   remote.vehicle_failsafe, vehicle degraded; no radio\n"})
    CHECK_MESSAGE(has(text, row), row);

  Dashboard hardware;
  json real = view();
  real["io"] = "fcu";
  hardware.take_view(real);
  hardware.choose(
      {{"/fcu/link", "LinkStatus"}, {"/vehicle/status", "VehicleStatus"}, {"/safety/state", "SafetyState"}});
  hardware.take("/vehicle/status", 1, {{"override", true}, {"health", "ok"}});
  ordered_json link = {
      {"open", true}, {"heard_age_s", 0.02}, {"imu_rate_hz", 399.6}, {"round_trip_s", 0.0021}};
  hardware.take("/fcu/link", 1, link);
  hardware.take("/safety/state", 1, {{"airborne", true}, {"radio_lost", true}, {"answer", "home"}});
  CHECK(has(hardware.text(size(80, 24)), "hardware"));
  for (const char* row : {"control   pilot; link 400 Hz, 2.1 ms\n", "safety    radio lost; answer: home\n"})
    CHECK_MESSAGE(has(hardware.text(size(80, 24)), row), row);
  link["heard_age_s"] = 3;
  hardware.take("/fcu/link", 2, link);
  CHECK(has(hardware.text(size(80, 24)), "; link lost\n"));
}

TEST_CASE("a lost connection stands where the flight's name was, and all else is pale") {
  const std::string lost = "connection lost, 1 s ago", bold = "\x1b[1m", green = "\x1b[32m",
                    plain = "\x1b[0m\n";
  const std::string text = board().text(size(80, 24, true), lost);
  CHECK(text.starts_with(bold + "! " + lost + plain));
  CHECK_FALSE(has(text, "hourglass"));
  CHECK_FALSE(has(text, green));
  CHECK(has(board().text(size(80, 24, true)), green + "autopilot; radio there" + plain));
}

TEST_CASE("events: the newest above, what is bad marked, a slider's many values as one") {
  Dashboard b = board();
  for (const char* value : {"slc.roll_kp = 1", "slc.roll_kp = 2"}) {
    ordered_json set = event(value);
    set["code"] = "parameter_set";
    set["component"] = "slc";
    set["name"] = "roll_kp";
    b.take("/fulmar/event", 14, set);
  }
  b.take("/fulmar/event", 15, event("the motor has stopped", "error"));
  const std::vector<std::string> all = lines(b.text(size(80, 30)));
  REQUIRE(all.size() == 16);
  CHECK(all[12] == "0:15.0 ! the motor has stopped");
  CHECK(all[13] == "0:14.0   slc.roll_kp = 2");
  CHECK(all[14] == "0:13.1   phase cruise");
}

TEST_CASE("no text of the flight commands the terminal") {
  const std::string bad =
      "\x1b[2J\x1b]0;mine\x07\xc2\x9b"
      "2J\n\tend";
  Dashboard b;
  json hostile = view();
  hostile["mission"] = hostile["phase"] = bad;
  for (json& c : hostile["components"]) {
    c["name"] = bad;
    c["role"] = bad;
  }
  b.take_view(hostile);
  b.choose(topics);
  b.take("/nav/health", 1, {{bad, {{"state", bad}}}});
  b.take("/vehicle/status", 1, {{"health", bad}});
  b.take("/vehicle/gnss", 1, {{"satellites", 3}, {"fix", bad}});
  b.take("/fulmar/event", 1, event(bad.c_str(), bad.c_str()));
  ordered_json coded = event("");
  coded["code"] = coded["component"] = coded["cause"] = bad;
  b.take("/fulmar/event", 1, coded);
  for (const std::string& text : {b.text(size(80, 60)), b.text(size(80, 60), bad)}) {
    CHECK(has(text, "?[2J?]0;mine??2J  end"));
    for (const char* control : {"\x1b", "\x07", "\xc2\x9b", "\t"}) CHECK_FALSE(has(text, control));
  }
  CHECK(lines(b.text(size(800, 60))).size() ==
        lines(board().text(size(800, 60))).size());  // not a separate line
}

}  // namespace dashboard_test

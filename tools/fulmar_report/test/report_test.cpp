// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_report/report.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/log/events.hpp"
#include "fulmar/msg/guidance_command.hpp"
#include "fulmar/msg/rc.hpp"
#include "tools/fulmar_report/test/report_kit.hpp"

namespace report_test {

using nlohmann::json;

namespace {

constexpr std::uint64_t epoch = core::test::epoch_ns;

void write_event(Log& log, std::int64_t at_ns, core::Code code, const char* name, const char* words) {
  core::Event e = core::event_of(code, "slc", name);
  core::put(e.words, words);
  log.write_as(core::Event::topic, *core::host_type<core::Event>(), at_ns, &e);
}

void write_event(Log& log, std::int64_t at_ns, const core::Event& e) {
  log.write_as(core::Event::topic, *core::host_type<core::Event>(), at_ns, &e);
}

/// Two seconds at 50 Hz from one second before the flight on.
void write_flight(const std::filesystem::path& file, const char* parameters, const char* words = "stopped") {
  Log log(file);
  log.sample.writer.attach("parameters.json", "application/json", parameters, epoch);
  for (int i = 0; i < 100; ++i) {
    VehicleState s = state(1);
    s.height_m = 0.1 * i;
    s.position_valid = i >= 50;
    log.write("/nav/state", i * 20 * ms - 1000 * ms, s);
    log.write("/vehicle/truth", i * 20 * ms - 1000 * ms, state(0));
  }
  write_event(log, 500 * ms, core::Code::phase_entered, "cruise", "phase cruise");
  write_event(log, 500 * ms, core::Code::guard, "", words);
  write_event(log, 600 * ms, core::Code::request_taken, "edit", "no news");
}

/// Each under the name of its file without its ending.
std::vector<report::ReportedLog> logs_of(const std::vector<std::string>& files) {
  std::vector<report::ReportedLog> logs;
  for (const std::string& file : files)
    logs.push_back(report::read_log(file, std::filesystem::path(file).stem().string(), 10));
  return logs;
}
json parsed(const std::vector<std::string>& files) {
  return json::parse(report::report_json(logs_of(files), 1));
}

const report::ShownTopic& topic(const std::vector<report::ShownTopic>& all, const std::string& name) {
  for (const report::ShownTopic& t : all)
    if (t.topic == name) return t;
  FAIL(name << " is not there");
  return all.front();
}

}  // namespace

TEST_CASE("streams are thinned to the rate, slow topics to 2 Hz, events are complete") {
  const Folder folder;
  const std::string file = folder.path / "a.mcap";
  {
    Log log(file);
    for (int i = 0; i < 200; ++i) {
      VehicleState s = state(1);
      s.height_m = i;
      s.height_valid = i > 100;
      log.write("/nav/state", i * 10 * ms, s);
      log.write("/vehicle/truth", i * 10 * ms, s);
      log.write("/vehicle/rc", i * 10 * ms, Rc{});
      if (i >= 50 && i < 53) write_event(log, 500 * ms, core::Code::notice, "", "at once");
    }
  }
  const auto all = report::shown_topics(file, epoch, 10, {"/vehicle/truth"});
  REQUIRE(all.size() == 3);
  const report::ShownTopic& state_topic = topic(all, "/nav/state");
  CHECK(state_topic.count == 200);
  CHECK(state_topic.columns.t.size() == 20);
  CHECK(state_topic.columns.t[1] == 1000);
  const auto column = [&](const char* field) {
    const auto at = std::find(state_topic.fields.begin(), state_topic.fields.end(), field);
    REQUIRE(at != state_topic.fields.end());
    return state_topic.columns.values[static_cast<std::size_t>(at - state_topic.fields.begin())];
  };
  CHECK(column("height_m")[7] == 70.f);
  CHECK(column("height_valid")[10] == 0.f);
  CHECK(column("height_valid")[11] == 1.f);
  CHECK(topic(all, "/vehicle/rc").messages.size() == 4);
  CHECK(topic(all, core::Event::topic).messages.size() == 3);
  CHECK(topic(report::shown_topics(file, epoch, 1000), "/nav/state").columns.t.size() == 200);
  const json halved = topic_json(state_topic, 2), events = topic_json(topic(all, core::Event::topic), 2);
  CHECK(halved["rows"] == 10);
  CHECK(columns_of(halved["data"], 10, state_topic.fields.size()).t[1] == 2000);
  CHECK(events["rows"] == 3);
  CHECK(columns_of(events["t"], 3, 0).t == std::vector<std::int32_t>{5000, 5000, 5000});
}

TEST_CASE("a guide with lateral accelerations commands no course") {
  const Folder folder;
  const std::string file = folder.path / "a.mcap";
  {
    Log log(file);
    GuidanceCommand c;
    c.course_rad = 1;
    c.height_m = 70;
    log.write("/guide/command", 0, c);
    c.lateral = LateralMode::acceleration;
    log.write("/guide/command", 1000 * ms, c);
  }
  const report::ShownTopic shown = topic(report::shown_topics(file, epoch, 10), "/guide/command");
  REQUIRE(shown.fields[0] == "course_rad");
  CHECK(shown.columns.values[0][0] == 1.f);
  CHECK(std::isnan(shown.columns.values[0][1]));
  CHECK(shown.columns.values[1][1] == 70.f);
}

TEST_CASE("phases, guards, parameters that differ, and where a log ends") {
  const Folder folder;
  const std::string a = folder.path / "a.mcap", b = folder.path / "b.mcap";
  write_flight(a, R"({"slc": {"course_kp": 1.2, "law": "slc"}, "ekf": {"x": [1, 2, 3]}})");
  write_flight(b, R"({"slc": {"course_kp": 1.9, "law": "slc"}, "ekf": {"x": [1, 2, 3]}, "new": {"y": 1}})");
  const json all = parsed({a, b});
  CHECK(all["parameters"] == json::parse(R"([{"name": "new.y", "values": [null, 1]},
                                             {"name": "slc.course_kp", "values": [1.2, 1.9]}])"));
  const json& log = all["logs"][0];
  CHECK(log["name"] == "a");
  CHECK(log["begin_s"] == -1.0);
  CHECK(log["end_s"] == 0.98);
  CHECK(log["fault"] == "");
  CHECK(log["phases"] == json::parse(R"([{"name": "cruise", "from_s": 0.5, "to_s": 0.98, "because": ""}])"));
  REQUIRE(log["told"]["rows"].size() == 1);  // a phase and an accepted request are not listed
  CHECK(log["told"]["rows"][0]["words"] == "stopped");
  CHECK(log["told"]["rows"][0]["severity"] == "warning");
  CHECK(log["told"]["rows"][0]["component"] == "slc");
  CHECK(log["estimates"][0]["reference"] == "/vehicle/truth");
  CHECK(log["steps"].is_null());
  for (const json& t : log["topics"]) CHECK(t["topic"] != "/vehicle/truth");
  CHECK(parsed({a})["parameters"].empty());

  const std::string bytes = core::test::contents(a), cut = folder.path / "cut.mcap";
  core::test::store(cut, bytes.substr(0, bytes.size() / 2));
  const json half = parsed({cut})["logs"][0];
  CHECK(half["fault"].get<std::string>().starts_with("byte "));
}

TEST_CASE("the verdict of a flight is its last event, and a truncated log has none") {
  const Folder folder;
  const std::string file = folder.path / "a.mcap";
  write_flight(file, "{}");
  CHECK(parsed({file})["logs"][0]["verdict"]["words"] == "");
  const std::string ended = folder.path / "b.mcap";
  {
    Log log(ended);
    core::Event phase = core::event_of(core::Code::phase_entered, "", "home");
    core::put(phase.cause, "guard.safety.answer == home");
    write_event(log, 100 * ms, phase);
    core::Event early = core::event_of(core::Code::concluded);  // of an armed aircraft, on its way
    core::put(early.words, "done: x; flies on until disarmed");
    write_event(log, 400 * ms, early);
    core::Event last = core::event_of(core::Code::concluded, "", "failed");
    last.severity = core::Severity::error;
    core::put(last.words, "crashed: nose touched (y)");
    write_event(log, 500 * ms, last);
    write_event(log, 500 * ms, early);
  }
  const json log = parsed({ended})["logs"][0];
  CHECK(log["verdict"] == json{{"words", "crashed: nose touched (y)"}, {"severity", "error"}});
  CHECK(log["phases"][0]["because"] == "guard.safety.answer == home");
}

TEST_CASE("no text of a log ends its element") {
  const Folder folder;
  const std::string file = folder.path / "a.mcap";
  write_flight(file, R"({"<img>": {"</script>": 1}})", "</script><b>");
  std::vector<report::ReportedLog> logs = logs_of({file});
  logs[0].name = "<!--";
  const std::string text = report::report_json(logs, 1);
  const std::string html = report::with_logs("<script>LOG_OF_THE_FLIGHT</script>", text);
  CHECK(html.find('<', 1) == html.size() - 9);
  const json inside = json::parse(html.substr(8, html.size() - 17));
  CHECK(inside["logs"][0]["name"] == "<!--");
  CHECK(inside["logs"][0]["told"]["rows"][0]["words"] == "</script><b>");
  CHECK_THROWS_WITH_AS(report::with_logs("<p>", text), doctest::Contains("report.page_version_mismatch"),
                       core::Error);
}

TEST_CASE("a large report is thinned until it fits, or to the limit") {
  const Folder folder;
  const std::string file = folder.path / "a.mcap";
  {
    Log log(file);
    for (int i = 0; i < 3000; ++i) {
      VehicleState s = state(1);
      s.height_m = std::sin(1e4 * i);
      s.roll_rad = std::cos(1e5 * i);
      log.write("/nav/state", i * 100 * ms, s);
    }
  }
  const std::vector<report::ReportedLog> logs = logs_of({file});
  const std::size_t whole = report::report_json(logs, 1).size();
  CHECK(report::fitted_json(logs, whole).every_nth == 1);
  const report::Fitted half = report::fitted_json(logs, whole - 1);
  CHECK(half.every_nth == 2);
  CHECK(half.json.size() < whole);
  CHECK(report::fitted_json(logs, 1).every_nth == 64);
}

TEST_CASE("names are those of the files, with their folders where two are equal") {
  using Names = std::vector<std::string>;
  CHECK(report::short_names({"/x/a.mcap", "b.mcap"}) == Names{"a.mcap", "b.mcap"});
  CHECK(report::short_names({"/x/a.mcap", "/y/a.mcap"}) == Names{"x/a.mcap", "y/a.mcap"});
  CHECK(report::short_names({"/x/z/a.mcap", "/y/z/a.mcap"}) == Names{"/x/z/a.mcap", "/y/z/a.mcap"});
}

TEST_CASE("a file that is not a log is rejected; a log without messages is a report without topics") {
  const Folder folder;
  const std::string text = folder.path / "a.txt", empty = folder.path / "empty.mcap";
  core::test::store(text, "time,height\n0,1\n");
  CHECK_THROWS_AS(report::read_log(text, "a", 10), core::Error);
  { const Log log(empty); }
  const json log = parsed({empty})["logs"][0];
  CHECK(log["topics"].empty());
  CHECK(log["ticks"].is_null());
  CHECK(log["end_s"] == 0);
}

}  // namespace report_test

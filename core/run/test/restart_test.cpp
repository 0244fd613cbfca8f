// SPDX-License-Identifier: BSD-3-Clause
// A host that is started again while its aircraft flies: the state that it takes from its predecessor's log.
#include "core/run/state/resume.hpp"
#include "core/run/test/commands.hpp"
#include "core/run/test/craft.hpp"

namespace restart_test {

namespace {

const std::string two_phases =
    "resume: {law_a.heirloom: law.command.u_frac}\n"
    "phases:\n  first: {next: [{to: second, when: \"vehicle.status.tick_s > 0.2 s\"}]}\n"
    "  second: {next: [{to: first, when: \"vehicle.status.tick_s > 1000 s\"}]}\n";

/// The log of a host that ended at `t_s` of the flight: the content of the file at that time.
fs::path cut_log(const Graph& g, double t_s) {
  const fs::path whole = folder().path / "whole.mcap", cut = folder().path / "cut.mcap.part";
  fs::remove(whole);
  Printed printed;
  FlightOptions o = listening(printed);
  o.log = true;
  o.log_file = whole;
  Flight flight(g, o);
  fly_until(flight, t_s);
  flight.finish();
  std::ifstream in(whole, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  std::ofstream(cut, std::ios::binary) << bytes.substr(0, bytes.size() * 6 / 10);
  return cut;
}

}  // namespace

TEST_CASE("a truncated log gives the phase, fields and arming of its time") {
  const Graph g = craft(two_phases);
  const Resume r = read_resume(g, cut_log(g, 6));
  CHECK(r.phase == "second");
  CHECK(r.armed);
  REQUIRE(r.params.size() == 1);
  CHECK(r.params[0].value.number[0] == 1);  // the law commands 1 from 1 s on
  CHECK(r.text() == "phase second, law_a.heirloom = 1");
  CHECK(r.missing.empty());
  const Graph early = craft(two_phases, {{"craft.arm_at", "100"}});
  CHECK_FALSE(read_resume(early, cut_log(early, 6)).armed);
}

TEST_CASE("a log that does not fit is rejected with a sentence; a missing field is reported") {
  const Graph g = craft(two_phases);
  const fs::path log = cut_log(g, 3);
  const auto fault = [&](const Graph& other) {
    try {
      read_resume(other, log);
    } catch (const Error& e) {
      return std::string(e.what()).substr(log.string().size());
    }
    return std::string();
  };
  Graph renamed = g;
  renamed.mission = "crafty";
  CHECK(fault(renamed) == ": run.mission_differs(craft, crafty)");
  Graph phases = g;
  phases.phases[1].name = "third";
  CHECK(fault(phases) == ": run.log_phase_unknown(second, craft, first, third)");
  const Graph more = craft("record: {ports: [craft.remark]}\n" + two_phases);
  const Resume r = read_resume(more, cut_log(more, 3));
  CHECK(r.phase == "second");
  REQUIRE(r.missing.size() == 1);
  CHECK(r.missing[0].starts_with(
      "resume.law_a.heirloom: run.log_incomplete(log.topic_unknown(/law/command,  [] "
      "/fulmar/event, /fulmar/ticks, /vehicle/status, /vehicle/applied, "
      "/craft/remark, /rosout), run.log_ends_early(byte "));
  fs::resize_file(log, 3000);
  CHECK(fault(g).starts_with(": run.log_phase_missing(run.log_ends_early(byte "));
}

TEST_CASE(
    "a flight resumes when its vehicle is armed in its first second, and begins at the beginning otherwise") {
  const Graph g = craft(two_phases);
  Resume resume = read_resume(g, cut_log(g, 3));
  for (const bool asked : {true, false})
    for (const double arm_at : {0.15, 1.1}) {
      const Graph next = craft(
          "phases:\n  first: {next: [{to: second, when: \"vehicle.status.tick_s > 1000 s\"}]}\n  second: "
          "{}\n",
          {{"craft.arm_at", std::to_string(arm_at)}});
      Printed printed;
      FlightOptions o = listening(printed);
      resume.if_armed = !asked;
      o.resume = resume;
      Flight flight(next, o);
      CHECK(fly_until(flight, 0.1));
      CHECK(flight.phase() == (asked ? "second" : "first"));
      CHECK(applied(next, flight) == doctest::Approx(asked ? 1 : 0.1));
      CHECK(fly_until(flight, 1.5));
      const bool resumed = asked || arm_at < 1;
      CHECK(flight.phase() == (resumed ? "second" : "first"));
      CHECK(applied(next, flight) == 1);
      CHECK(printed.count("run.resumed(phase second, law_a.heirloom = 1") == (resumed ? 1 : 0));
      CHECK(printed.count("run.not_resumed_on_ground") == (resumed ? 0 : 1));
      CHECK(printed.count("phase_entered(") + printed.count("run.resumed(phase ") == (asked     ? 2
                                                                                      : resumed ? 3
                                                                                                : 1));
    }
}

namespace {

/// The flight resumes in the second phase, with a parameter that the first one overlays with another value.
Resume into_second(double heirloom) {
  Resume resume;
  resume.phase = "second";
  resume.params.push_back({"law_a", "heirloom", {}});
  resume.params[0].value.number[0] = heirloom;
  return resume;
}

const std::string overlaid_first =
    "phases:\n  first: {law: {use: law_a, set: {heirloom: 0.9}}, next: [{to: second, when: "
    "\"vehicle.status.tick_s > 1000 s\"}]}\n  second: {}\n";

}  // namespace

TEST_CASE("a flight that resumes has the overlay of its present phase, not of the first") {
  const Graph g = craft(overlaid_first);
  Printed printed;
  FlightOptions o = listening(printed);
  o.resume = into_second(0.4);
  Flight flight(g, o);
  CHECK(fly_until(flight, 0.1));
  CHECK(flight.phase() == "second");
  CHECK(applied(g, flight) == doctest::Approx(0.4));
}

TEST_CASE(
    "a parameter of a log that cannot be set any more is reported, and the flight continues without it") {
  const Graph g = craft(overlaid_first);
  Printed printed;
  FlightOptions o = listening(printed);
  o.resume = into_second(7);
  o.resume->if_armed = true;  // in a tick
  Flight flight(g, o);
  CHECK(fly_until(flight, 1));
  CHECK(flight.phase() == "second");
  CHECK(printed.count("run.phase_entered(") + printed.count("run.resumed(phase ") ==
        3);  // the first, the resumed one, and the second: all in the first tick
  CHECK(printed.count("law_a: run.not_resumed(run.value_out_of_range(law_a, heirloom, 7, ") == 1);
  CHECK(applied(g, flight) == doctest::Approx(1).epsilon(0.01));
}

TEST_CASE("the newest log of a mission is found, truncated or complete, unless it is too old") {
  const fs::path place = folder().path / "newest";
  fs::create_directories(place);
  Graph g = craft(two_phases);
  g.record_file = (place / "run.mcap").string();
  CHECK(newest_log(g, 0).empty());
  const auto now = fs::file_time_type::clock::now();
  const fs::path log = cut_log(g, 3);
  const auto put = [&](const char* name, int age_s) {
    fs::copy_file(log, place / name);
    fs::last_write_time(place / name, now - std::chrono::seconds(age_s));
  };
  put("run.mcap", 2000);
  put("run-2.mcap.part", 1000);
  put("other.mcap", 1);
  put("run-3.txt", 1);
  CHECK(newest_log(g, 0).filename() == "run-2.mcap.part");
  CHECK(newest_log(g, 600).empty());
  put("run-3.mcap", 100);
  CHECK(newest_log(g, 600).filename() == "run-3.mcap");
  std::ofstream(place / "run-4.mcap.part") << "begun, and nothing in it";
  CHECK(newest_log(g, 600).filename() == "run-3.mcap");
}

TEST_CASE("a noted log in another folder is found, and is preferred to an older one in the default folder") {
  const fs::path place = folder().path / "noted", elsewhere = folder().path / "elsewhere";
  fs::create_directories(place);
  fs::create_directories(elsewhere);
  Graph g = craft(two_phases);
  g.record_file = (place / "run.mcap").string();
  const auto now = fs::file_time_type::clock::now();
  const fs::path log = cut_log(g, 3);
  const auto put = [&](const fs::path& file, int age_s) {
    fs::copy_file(log, file);
    fs::last_write_time(file, now - std::chrono::seconds(age_s));
  };
  put(place / "run.mcap", 300);
  put(elsewhere / "mine.mcap.part", 100);
  CHECK(newest_log(g, 600).filename() == "run.mcap");
  note_newest_log(g, elsewhere / "mine.mcap");
  CHECK(newest_log(g, 600) == elsewhere / "mine.mcap.part");
  put(place / "run-2.mcap", 50);
  CHECK(newest_log(g, 600).filename() == "run-2.mcap");
}

TEST_CASE("the second in which an aircraft may turn out to fly begins with its vehicle's first sample") {
  for (const std::string lift_at : {"1.3", "1.9"}) {  // its first sample is at 0.8 s
    CAPTURE(lift_at);
    const fs::path file = folder().path / "late.yaml";
    std::ofstream(file)
        << "mission: late\nroles:\n"
           "  vehicle: {in: {command: law.command}, out: {gear: Gear, state: State}, flags: "
           "{armed: gear.motors_live, on_ground: gear.wheels.down, in_control: gear.obeys}}\n"
           "  law:     {in: {state: vehicle.state}, out: {command: Command}}\n"
           "components:\n  craft: {fills: vehicle, use: craft/Strange, params: {speak_at: 0.8 "
           "s, lift_at: "
        << lift_at << " s}}\n  law_a: {fills: law, use: craft/Hoarder}\n"
        << "phases:\n  first: {next: [{to: second, when: \"vehicle.state.tick_s > 1000 s\"}]}\n  second: "
           "{}\n";
    Printed printed;
    FlightOptions o = listening(printed);
    o.resume = into_second(0.4);
    o.resume->if_armed = true;
    Flight flight(load_mission(file.string()), o);
    CHECK(fly_until(flight, 2.5));
    CHECK(flight.phase() == (lift_at == "1.3" ? "second" : "first"));
  }
}

}  // namespace restart_test

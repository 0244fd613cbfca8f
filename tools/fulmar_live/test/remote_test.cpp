// SPDX-License-Identifier: BSD-3-Clause
// The subcommands for a running flight, as a user types them, with the live view of a mock flight at 400 Hz.
#include <cstring>
#include <nlohmann/json.hpp>

#include "core/app/program.hpp"
#include "tools/fulmar_live/ports.hpp"
#include "tools/fulmar_live/test/typed.hpp"

namespace remote_test {

using nlohmann::json;

namespace {

/// A flight whose names contain terminal commands.
struct HostileControl : test::MockControl {
  FlightView view() const override {
    FlightView v = MockControl::view();
    const std::string clear = "\x1b[2J", title = "\x1b]0;mine\x07",
                      eight_bits =
                          "\xc2\x9b"
                          "2J";
    v.mission += clear;
    v.phase.now += title;
    v.io += eight_bits;
    for (std::string& phase : v.phase.all) phase += clear;
    for (ComponentView& c : v.components) {
      c.name += clear;
      c.use += title;
      c.role += eight_bits;
      for (ParameterView& p : c.params) {
        p.info.name += clear;
        p.info.doc += title;
        p.info.unit += eight_bits;
      }
      for (PortView& p : c.outputs) p.name += title;
      for (PortView& p : c.inputs) p.name += title;
    }
    return v;
  }
  void enter_phase(const std::string&, Answer answer) override { answer("no\x1b[2J, \x07no"); }
};

}  // namespace

TEST_CASE("a flight that listens is opened as a page, or where --in says") {
  const MockFlight flight;
  CHECK(typed(flight, "view").out == "http://" + flight.at() + "/\n");
  const std::string link = typed(flight, "view running --in lichtblick").out;
  CHECK(link.starts_with("lichtblick://open?ds=foxglove-websocket&ds.url=ws%3A%2F%2F127.0.0.1%3A" +
                         std::to_string(flight.server->port()) + "%2F\n"));
  const MockFlight guarded("secret");
  CHECK(typed(guarded, "view").code == 1);
  CHECK(typed(guarded, "view --token secret").out == "http://" + guarded.at() + "/?token=secret\n");
}

TEST_CASE("what another computer says does not command the terminal") {
  std::vector<TapChannel> channels = test::mock_channels();
  for (TapChannel& channel : channels) channel.topic += "\x1b[2J";
  Tap tap{channels};
  HostileControl control;
  LiveOptions options;
  options.port = 0;
  LiveServer server(tap, control, options);
  for (const char* words : {"list", "param list", "echo nothing", "phase cruise", "call nothing",
                            "param get nothing.x", "swap nothing x.so"}) {
    CAPTURE(words);
    const Result r =
        shell("FULMAR_LIVE=127.0.0.1:" + std::to_string(server.port()) + " " + program + " " + words);
    CHECK(r.out.size() + r.err.size() > 20);
    for (const char* bad : {"\x1b", "\x07", "\xc2\x9b"}) {
      CHECK(r.out.find(bad) == std::string::npos);
      CHECK(r.err.find(bad) == std::string::npos);
    }
  }
}

TEST_CASE("what libraries throw is told in words for people") {
  CHECK(sentence_of(std::bad_alloc()) == "app.memory_exhausted");
  const std::error_code too_long = std::make_error_code(std::errc::filename_too_long);
  CHECK(sentence_of(fs::filesystem_error("status", "a/b", too_long)) == "'a/b': " + too_long.message());
  std::string said;
  try {
    json(3).at("x");
  } catch (const std::exception& fault) {
    said = sentence_of(fault);
  }
  CHECK(said == "app.message_form_invalid");
}

TEST_CASE("without a flight every word says what to do") {
  for (const char* words :
       {"list", "watch", "echo nav.state", "plot a.b.c", "view", "param list", "param set a.b 1", "call a.b",
        "phase x", "swap a b", "reset", "pause", "resume", "step", "step 5", "speed max", "restart"}) {
    const Result r = shell(program + " " + words + " --at 127.0.0.1:1");
    CHECK(r.code == 1);
    CHECK(r.err == "remote.flight_not_found(127.0.0.1:1)\n");
  }
  CHECK(shell(program + " list --at 127.0.0.1:0x").err == "remote.port_number_invalid(127.0.0.1:0x, 0x)\n");
  CHECK(shell(program + " complete port x --at 127.0.0.1:1").out == "");
}

TEST_CASE("addresses are read as people write them") {
  CHECK(parse_target("uav:1234").text() == "uav:1234");
  CHECK(parse_target("uav").text() == "uav:8765");
  CHECK(parse_target(":1234").text() == "127.0.0.1:1234");
  CHECK(parse_target("[::1]:1234").text() == "[::1]:1234");
  CHECK(parse_target("::1").text() == "[::1]:8765");
  CHECK_THROWS_AS(parse_target("uav:99999"), Error);
}

TEST_CASE("a token is asked for, and taken from the command line or the environment") {
  const MockFlight flight("secret");
  const std::string at = program + " reset --at " + flight.at();
  CHECK(shell("FULMAR_TOKEN=secret " + at).out == "reset: accepted\n");
  CHECK(shell(at + " --token secret").code == 0);
  const Result wrong = shell(at + " --token sesame");
  CHECK(wrong.code == 1);
  CHECK(wrong.err == "remote.token_rejected(" + flight.at() + ",  refuses this token)\n");
}

TEST_CASE("list names components, ports with their rates, requests and phases") {
  const MockFlight flight;
  const Result r = typed(flight, "list");
  CHECK(r.code == 0);
  const std::string table =
      "remote.flight_state(mock <1>, sim, cruise, 0.0, not armed)\nphases: hold, cruise\n"
      "\nslc: control_slc/Outer, fills outer, flies\n  slc.leg  Leg\n"
      "\nplan: path/Planner, waits\n  plan.mixed    Mixed\n  plan.add_leg  Leg    request\n  plan.edits    "
      "Mixed  imported\n";
  CHECK(r.out == table);
  const json view = json::parse(typed(flight, "list --json --rates").out);
  CHECK(view["components"][0]["params"][0]["name"] == "roll_kp");
  CHECK(view["rates_hz"]["/slc/leg"].get<double>() == doctest::Approx(400).epsilon(0.2));
  CHECK(view["rates_hz"]["/fulmar/ticks"].get<double>() == doctest::Approx(10).epsilon(0.3));
}

// Sample i at i * 2.5 ms has a course of i * 0.001 rad.
TEST_CASE("echo prints fields in degrees, whole messages, JSON lines and CSV, as many as are asked for") {
  const MockFlight flight;
  const auto course_deg = [](double time_s) { return time_s / 0.0025 * 0.001 * 57.29577951308232; };
  Result r = typed(flight, "echo slc.leg.course_deg --count 3");
  CHECK(r.code == 0);
  REQUIRE(lines(r.out).size() == 3);
  for (const std::string& line : lines(r.out)) {
    double time_s = 0, value = 0;
    REQUIRE(std::sscanf(line.c_str(), "%lf s  slc.leg.course_deg %lf", &time_s, &value) == 2);
    CHECK(value == doctest::Approx(course_deg(time_s)).epsilon(1e-4));
  }
  r = typed(flight, "echo slc.leg --count 1");
  CHECK(r.out.find("  kind: orbit\n") != std::string::npos);
  const std::string position = "  position_m: {north: 1, east: 2, down: 3}\n";
  CHECK(r.out.find(position) != std::string::npos);

  r = typed(flight, "echo slc.leg.position_m.east slc.leg.course_rad --count 4 --json");
  REQUIRE(lines(r.out).size() == 4);
  const json second = json::parse(lines(r.out)[1]);
  CHECK(json::parse(lines(r.out)[0])["value"] == 2.0);
  CHECK(second["port"] == "slc.leg.course_deg");
  CHECK(second["value"].get<double>() == doctest::Approx(course_deg(second["time_s"])).epsilon(1e-9));

  CHECK(typed(flight, "echo slc.leg --count 0")
            .err.starts_with("--count: remote.number_invalid(a whole number from 1, 0)\n"));
  CHECK(typed(flight, "echo slc.leg --rate 0")
            .err.starts_with("--rate: remote.number_invalid(a number above 0, 0)\n"));

  r = typed(flight, "echo slc.leg --csv --count 2 --rate 20");
  const Words rows = lines(r.out);
  REQUIRE(rows.size() == 3);
  CHECK(rows[0] == "time_s,kind,has_course,course_deg,position_m.north,position_m.east,position_m.down");
  CHECK(rows[1].ends_with(",1.0,2.0,3.0"));
  CHECK(std::stod(rows[2]) - std::stod(rows[1]) == doctest::Approx(0.05).epsilon(1e-6));
}

TEST_CASE("echo says that it waits when a port stays silent, and of which") {
  const MockFlight flight;
  Result r;
  for (const int seconds : {4, 16, 64}) {  // it never ends by itself, and a loaded machine may need long
    r = shell("FULMAR_LIVE=" + flight.at() + " timeout " + std::to_string(seconds) + " " + program +
              " echo plan.add_leg slc.leg.course_deg --rate 1");
    if (!r.err.empty() && lines(r.out).size() >= 2) break;
  }
  CHECK(r.code == 124);
  CHECK(r.err == "remote.first_sample_awaited(plan.add_leg)\n");
  CHECK(lines(r.out).size() >= 2);
}

TEST_CASE("names that are not there are answered with the nearest and the choices") {
  const MockFlight flight;
  const auto said = [&](const std::string& words) {
    const Result r = typed(flight, words);
    CHECK(r.code == 1);
    return r.err;
  };
  CHECK(said("echo slx.leg") == "remote.owner_unknown(slx,  [slc] fulmar, plan, slc)\n");
  CHECK(said("echo slc.lag") == "remote.port_unknown(slc, lag,  [leg] leg)\n");
  CHECK(said("echo slc") == "remote.port_name_expected(slc, slc, leg)\n");
  CHECK(said("echo slc.leg.corse_deg") ==
        "remote.field_unknown(slc.leg, corse_deg,  [course_deg] kind, has_course, course_deg, position_m)\n");
  CHECK(said("plot slc.leg") ==
        "remote.message_field_expected(slc.leg, slc.leg, kind, kind, has_course, course_deg, position_m)\n");
  CHECK(said("param get slc.rol_kp")
            .starts_with(
                "remote.parameter_unknown(slc, rol_kp,  [roll_kp] roll_kp, law, note, wind, count, on)"));
  CHECK(said("phase cruse") == "remote.phase_unknown(cruse,  [cruise] hold, cruise)\n");
  CHECK(said("call plan.add_log a=1") ==
        "remote.request_unknown(plan.add_log,  [plan.add_leg] plan.add_leg)\n");
  CHECK(said("swap sls x.so") == "remote.component_unknown(sls,  [slc] slc, plan)\n");
}

TEST_CASE("parameters are listed with range and kind, read, and set as in a mission file") {
  const MockFlight flight;
  const std::string row = "slc.roll_kp  0.55 rad/rad  0 .. 2 rad/rad  live";
  CHECK(lines(typed(flight, "param list slc.roll*").out) == Words{row});
  CHECK(lines(typed(flight, "param list slc").out).size() == 6);
  CHECK(typed(flight, "param get slc.roll_kp").out == "0.55 rad/rad\n");
  CHECK(json::parse(typed(flight, "param get slc.law --json").out)["choices"] == json{"climb", "takeoff"});

  Result r = typed(flight, "param set slc.roll_kp 0.75 slc.wind '[1, 2, -3]'");
  CHECK(r.code == 0);
  CHECK(r.out == "slc.roll_kp: 0.55 rad/rad -> 0.75\nslc.wind: [3, -4, 0] rad/rad -> [1, 2, -3]\n");
  CHECK(flight.heard("set slc.roll_kp 0.75"));
  CHECK(flight.heard("set slc.wind [1, 2, -3]"));
  CHECK(typed(flight, "param get slc.roll_kp").out == "0.75 rad/rad\n");
  CHECK(typed(flight, "param set slc.law takeoff").out ==
        "slc.law: climb -> takeoffremote.phase_overlays_parameter\n");

  r = typed(flight, "param set slc.roll_kp 9");
  CHECK(r.code == 1);
  CHECK(r.err == "remote.parameter_rejected(slc.roll_kp, 9, 9 is outside 0 .. 2 rad/rad, )\n");
  CHECK(typed(flight, "param set slc.roll_kp").err == "remote.parameter_value_missing(slc.roll_kp)\n");
  CHECK(typed(flight, "param set slc.roll_kp").code == 2);
  CHECK(typed(flight, "param set").code == 2);
  r = typed(flight, "param set slc.wind '[1, 1, 1]' slc.roll_kp 9 slc.count 8");
  CHECK(r.err ==
        "remote.parameter_rejected(slc.roll_kp, 9, 9 is outside 0 .. 2 rad/rad, ; already set: slc.wind; "
        "not tried: slc.count)\n");
  CHECK(typed(flight, "param set --help").out.find("NAME VALUE [NAME VALUE ...]") != std::string::npos);
  CHECK(typed(flight, "param set slc.roll_kp -1").code == 0);  // no option
}

TEST_CASE("what flies is saved to the mission's file when that is agreed to, and comments stay") {
  const MockFlight flight;
  const Folder folder;
  const fs::path file = folder.path / "m.yaml";
  const std::string before =
      "mission: mock <1>\ncomponents:\n  slc:\n    params: {roll_kp: 0.5, note: '40 deg', wind: [3, -4, 0]}  "
      "# gains\n";
  const std::string after =
      "mission: mock <1>\ncomponents:\n  slc:\n    params: {roll_kp: 0.625, note: '40 deg', wind: [3, -4, "
      "0], count: 7, on: true}  # "
      "gains\n";
  std::ofstream(file) << before;
  REQUIRE(typed(flight, "param set slc.roll_kp 0.625").code == 0);
  Result r = typed(flight, "param save slc --dry-run --mission " + file.string());
  CHECK(r.code == 0);
  CHECK(r.out == "m.yaml:4\n- " + lines(before)[3] + "\n+ " + lines(after)[3] + "\n");
  CHECK(content(file) == before);
  r = typed(flight, "param save --mission " + file.string() + " </dev/null");
  CHECK(r.code == 1);
  CHECK(r.err == "remote.confirmation_required\n");
  CHECK(typed(flight, "param save --yes --mission " + file.string()).code == 0);
  CHECK(content(file) == after);
  CHECK(typed(flight, "param save --yes --mission " + file.string()).out == "remote.parameters_unchanged\n");
  const fs::path other = folder.path / "other.yaml";
  std::ofstream(other) << "components:\n  slc:\n    params: {roll_kp: 0.5}\n";
  r = typed(flight, "param save --yes --mission " + other.string());
  CHECK(r.code == 1);
  CHECK(r.err == "save.mission_name_mismatch(" + other.string() + ", other, mock <1>)\n");
  CHECK(content(other) == "components:\n  slc:\n    params: {roll_kp: 0.5}\n");
  CHECK(typed(flight, "param save").err == "remote.mission_file_unknown\n");
}

TEST_CASE("requests, phases and swaps are asked for; a refusal is told and is exit code 1") {
  const MockFlight flight;
  Result r =
      typed(flight, "call plan.add_leg kind=line course_rad='20 deg' has_course=true position_m='[1, 2, 3]'");
  CHECK(r.code == 0);
  CHECK(r.out == "plan.add_leg: accepted\n");
  CHECK(flight.leg() == "plan.add_leg: kind 0, course 1 0.349066, position 1 2 3");  // 20 deg
  const std::string line = "'{kind: line, course_rad: 0.5}'", twice = "'{kind: line, kind: orbit}'";
  CHECK(typed(flight, "call plan/add_leg " + line).code == 0);
  CHECK(flight.leg() == "plan.add_leg: kind 0, course 0 0.5, position 0 0 0");
  r = typed(flight, "call plan.add_leg '{\"kind\": \"orbit\"}'");
  CHECK(r.code == 1);
  CHECK(r.err == "remote.request_rejected(plan.add_leg, no orbits here)\n");
  r = typed(flight, "call plan.add_leg kind");
  CHECK(r.code == 2);
  CHECK(r.err == "remote.field_form_invalid(kind)\n");
  for (const char* nothing : {"call plan.add_leg", "call plan.add_leg '{}'"}) {
    r = typed(flight, nothing);
    CHECK(r.code == 2);
    CHECK(r.err == "remote.field_missing(plan.add_leg, kind, kind, has_course, course_rad, position_m)\n");
  }
  CHECK_FALSE(flight.heard("request plan.add_leg {}"));
  const std::string kinds = "kind=line kind=orbit";
  CHECK(typed(flight, "call plan.add_leg " + kinds).err == "remote.field_duplicate(kind)\n");
  CHECK(typed(flight, "call plan.add_leg " + twice).code == 1);
  CHECK(typed(flight, "phase hold").out == "phase hold: accepted\n");
  r = typed(flight, "swap slc some.so");
  CHECK(r.code == 1);
  CHECK(r.err == "remote.request_rejected(swap slc, mock.vehicle_armed)\n");
  CHECK(flight.heard("swap slc some.so"));
  const Folder folder;  // a file of that name in this folder is no plugin
  fs::create_directories(folder.path / "control_slc");
  std::ofstream(folder.path / "my.so") << "x";
  const auto swapped = [&](const std::string& word) {
    shell("cd " + folder.path.string() + " && FULMAR_LIVE=" + flight.at() + " " + program + " swap slc " +
          word);
  };
  for (const char* word : {"control_slc", "control_slc/Outer", "my.so", "./my.so/Law"}) swapped(word);
  std::ofstream(folder.path / "table.txt") << "x";
  r = typed(flight, "swap slc " + (folder.path / "table.txt").string());
  CHECK(r.code == 1);
  CHECK(r.err == "remote.plugin_expected(" + (folder.path / "table.txt").string() + ")\n");
  CHECK_FALSE(flight.heard("swap slc " + (folder.path / "table.txt").string()));
  for (const std::string& file :
       {std::string("control_slc"), std::string("control_slc/Outer"), (folder.path / "my.so").string(),
        (folder.path / "./my.so").string() + "/Law"})
    CHECK_MESSAGE(flight.heard("swap slc " + file), file);
}

TEST_CASE("the clock of a simulation is stopped, stepped and hurried, and list tells of it") {
  const MockFlight flight;
  CHECK(typed(flight, "pause").out == "remote.order_accepted(pause, 0.0000)\n");
  CHECK(lines(typed(flight, "list").out).at(0) ==
        "remote.flight_state(mock <1>, sim, cruise, 0.0, not armed, paused)");
  const Result twice = typed(flight, "pause");
  CHECK(twice.code == 1);
  CHECK(twice.err == "remote.request_rejected(pause, mock.paused_already)\n");
  CHECK(typed(flight, "step").code == 0);
  CHECK(flight.heard("step 1"));
  CHECK(typed(flight, "step 400").out == "remote.order_accepted(step 400, 0.0000)\n");
  CHECK(flight.heard("step 400"));
  CHECK(typed(flight, "resume").code == 0);
  CHECK(flight.heard("resume"));
  CHECK(typed(flight, "speed real").code == 0);
  CHECK(typed(flight, "speed max").code == 0);
  CHECK(flight.heard("speed max"));
  CHECK(typed(flight, "speed 2.5").code == 0);
  CHECK(flight.heard("speed 2.5"));
  for (const char* wrong : {"step 0", "step 1.5", "step many"}) {
    const Result r = typed(flight, wrong);
    CHECK(r.code == 2);
    CHECK(r.err == std::string("tap.step_count_invalid(") + (wrong + std::strlen("step ")) + ", 1000000)\n");
  }
  for (const char* wrong : {"speed warp", "speed 0", "speed 1e9"}) {
    const Result r = typed(flight, wrong);
    CHECK(r.code == 2);
    CHECK(r.err == std::string("tap.speed_invalid(") + (wrong + std::strlen("speed ")) + ")\n");
  }
  CHECK(typed(flight, "speed").code == 2);
}

TEST_CASE("a plot that is no terminal's is a picture at the end") {
  const MockFlight flight;
  const Result r = typed(flight, "plot slc.leg.course_deg plan.mixed.speed_mps --seconds 0.5");
  CHECK(r.code == 0);
  CHECK(r.out.find("1 slc.leg.course_deg  ") == 0);
  CHECK(r.out.find(" deg\n2 plan.mixed.speed_mps  ") != std::string::npos);
  CHECK(r.out.find('\x1b') == std::string::npos);
  CHECK(lines(r.out).size() == 23);
  CHECK(r.out.find("\xE2\xA0") != std::string::npos);  // braille
}

TEST_CASE("the first word that is a log makes a plot one of logs; options of the other are refused") {
  const MockFlight flight;
  const Result lost = typed(flight, "plot lost.mcap slc.leg.course_deg -o lost.svg");
  CHECK(lost.code == 1);
  CHECK(lost.err.find("reading.file_not_readable(lost.mcap, reading.file_missing)") != std::string::npos);
  const Result live = typed(flight, "plot slc.leg.course_deg --over slc.leg.course_deg");
  CHECK(live.code == 2);
  CHECK(live.err.find("remote.log_option_without_log(--over, slc.leg.course_deg)") != std::string::npos);
  const Result seconds = typed(flight, "plot lost.mcap slc.leg.course_deg -o lost.svg --seconds 3");
  CHECK(seconds.code == 2);
  CHECK(seconds.err.find("remote.live_option_of_log") != std::string::npos);
  CHECK(typed(flight, "plot lost.mcap -o lost.svg").code == 2);
}

TEST_CASE("the end of a flight ends echo and is told") {
  auto flight = std::make_unique<MockFlight>();
  Session session(flight->target());
  session.subscribe("/slc/leg");
  REQUIRE(session.next(std::chrono::seconds(5)).has_value());
  flight->server.reset();
  CHECK_THROWS_AS(
      {
        while (session.next(std::chrono::seconds(5))) {
        }
      },
      FlightEnded);
}

}  // namespace remote_test

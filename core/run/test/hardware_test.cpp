// SPDX-License-Identifier: BSD-3-Clause
// Flights with io: fcu on a vehicle that represents hardware (craft.cpp): control, the end of such a flight,
// its reports.
#include <atomic>

#include "core/log/events.hpp"
#include "core/log/test/read_mcap.hpp"
#include "core/run/test/commands.hpp"
#include "core/run/test/craft.hpp"

namespace hardware_test {

TEST_CASE("while the vehicle does not obey, its controllers start again in every step") {
  const std::vector<std::pair<std::string, std::string>> set = {
      {"craft.arm_at", "1"}, {"craft.pilot_from", "2"}, {"craft.pilot_until", "4"}};
  for (const bool held : {true, false}) {
    const Graph g = craft(held ? "control: [law]\n" : "", set);
    Printed notes;
    Flight flight(g, listening(notes));
    CHECK(fly_until(flight, 0.9));
    CHECK(hoard(g, flight) == doctest::Approx(held ? 0.0025 : 0.9025));  // not armed yet
    CHECK(fly_until(flight, 1.9));
    CHECK(hoard(g, flight) == doctest::Approx(held ? 0.905 : 1.9025));
    CHECK(fly_until(flight, 3.9975));
    CHECK(hoard(g, flight) == doctest::Approx(held ? 0.0025 : 4));
    CHECK(fly_until(flight, 4));
    CHECK(hoard(g, flight) == doctest::Approx(held ? 0.005 : 4.0025));
    CHECK(fly_until(flight, 4.5));
    CHECK(hoard(g, flight) == doctest::Approx(held ? 0.505 : 4.5025));
  }
}

TEST_CASE("in simulation the controllers are free before arming, also without in_control") {
  const Graph g = craft("control: [law]\n", {{"craft.arm_at", "1"}, {"craft.pilot_from", "2"}}, "sim");
  Printed notes;
  Flight flight(g, listening(notes));
  CHECK(fly_until(flight, 1.5));
  CHECK(hoard(g, flight) == doctest::Approx(1.5025));
  CHECK(fly_until(flight, 2.5));
  CHECK(hoard(g, flight) == doctest::Approx(0.0025));

  const Graph silent = mission(std::string("control: [law]\n") + one_phase);
  Flight other(silent, options(0.5));
  CHECK(other.run().outcome == Outcome::flown);
}

TEST_CASE("while the vehicle does not obey, or the computer stands still, no output is expected") {
  const auto count = [](const std::vector<std::pair<std::string, std::string>>& set, double until_s) {
    const Graph g = craft(
        "  echo: {use: craft/Echo, in: {state: vehicle.status}}\nphases:\n  fly: {law: law_a}\n"
        "failed: \"echo.echo.tick_s < -1 s\"\n",
        set);
    Printed notes;
    Flight flight(g, listening(notes));
    CHECK(fly_until(flight, until_s));
    return notes.count("run.output_silent_event(run.output_silent(echo, ");
  };
  CHECK(count({{"echo.mute_from", "1.2"}}, 2.15) == 0);
  CHECK(count({{"echo.mute_from", "1.2"}}, 2.25) == 1);
  CHECK(count({{"craft.pilot_from", "1"}, {"craft.pilot_until", "5"}, {"echo.mute_from", "1.2"}}, 5.9) == 0);
  CHECK(count({{"craft.pilot_from", "1"}, {"craft.pilot_until", "5"}, {"echo.mute_from", "1.2"}}, 6.1) == 1);
  CHECK(count({{"craft.jump_at", "2"}, {"echo.mute_from", "1.9"}, {"echo.mute_until", "12.3"}}, 13) == 0);
}

TEST_CASE("a controller in another thread starts again once, when control returns") {
  const Graph g = craft(
      "  law_b: {fills: law, use: craft/Hoarder, run: async, latency: 10 ms}\nphases:\n  fly: {law: "
      "law_b}\ncontrol: [law]\n",
      {{"craft.pilot_from", "1"}, {"craft.pilot_until", "3"}});
  Printed notes;
  FlightOptions o = listening(notes);
  Flight flight(g, o);
  while (flight.now_ns() < 3'500'000'000 && flight.step())
    let_others_sleep();  // hardware does not wait for a thread
  CHECK(value(g, flight, "law_b", "activations_ratio", "") == 2);
  CHECK(hoard(g, flight, "law_b") < 0.6);
  CHECK(notes.count("law_b") == 0);
}

TEST_CASE(
    "a controller that refuses to begin while the pilot flies is not lost; one that refuses afterwards is") {
  for (const bool late : {false, true}) {
    const Graph g = craft("control: [law]\n", {{"craft.pilot_from", "1"},
                                               {"craft.pilot_until", "2"},
                                               {"law_a.refuse_from", "1.5"},
                                               {"law_a.refuse_until", late ? "2.5" : "1.8"}});
    Printed notes;
    Flight flight(g, listening(notes));
    CHECK(fly_until(flight, 2.2));
    CHECK((notes.count("refuses to take over") > 0) == late);
    CHECK(applied(g, flight) == doctest::Approx(late ? -0.25 : 0.2025));
  }
}

TEST_CASE("a mission that is done while armed flies on until the aircraft is disarmed, and reports it once") {
  const Graph g =
      craft("done: \"vehicle.status.tick_s > 1 s\"\ntimeout: 1.5 s\n", {{"craft.disarm_at", "3"}});
  Printed notes;
  Flight flight(g, listening(notes));
  CHECK(fly_until(flight, 2.9));
  CHECK(notes.count("run.end_deferred(done: , vehicle.status.tick_s > 1 s)") == 1);
  CHECK(obeyed(g, flight));
  while (flight.step()) {
  }
  const FlightResult r = flight.finish();
  CHECK(r.last_ns == 3'000'000'000);
  CHECK(r.outcome == Outcome::flown);
  CHECK(r.reason == "vehicle.status.tick_s > 1 s");
}

TEST_CASE("a mission that fails while armed continues until disarmed; disarmed it ends at once") {
  for (const double disarm_at : {2.0, 0.5}) {
    const Graph g =
        craft("failed: \"vehicle.status.tick_s > 1 s\"\n", {{"craft.disarm_at", std::to_string(disarm_at)}});
    Printed notes;
    Flight flight(g, listening(notes));
    while (flight.step()) {
    }
    const FlightResult r = flight.finish();
    CHECK(r.outcome == Outcome::failed);
    CHECK(r.reason == "vehicle.status.tick_s > 1 s");
    CHECK(1e-9 * static_cast<double>(r.last_ns) == doctest::Approx(disarm_at > 1 ? 2 : 1.0025));
    CHECK(notes.count("run.end_deferred(failed: , vehicle.status.tick_s > 1 s)") == (disarm_at > 1 ? 1 : 0));
  }
}

TEST_CASE("a duration does not end the flight of an armed aircraft") {
  const Graph g = craft("", {{"craft.disarm_at", "2"}});
  Printed notes;
  FlightOptions o = listening(notes);
  o.duration_s = 1;
  const FlightResult r = Flight(g, o).run();
  CHECK(r.last_ns == 2'000'000'000);
  CHECK(r.outcome == Outcome::flown);
  CHECK(r.reason == "duration reached");
  const Graph bench = craft("", {{"craft.arm_at", "5"}});
  CHECK(Flight(bench, o).run().last_ns == 1'000'000'000);
}

TEST_CASE(
    "after a failsafe an armed aircraft hears nothing more, and the flight has failed when it is disarmed") {
  const Graph g =
      craft("done: \"vehicle.status.tick_s > 4 s\"\n", {{"law_a.fail_at", "1"}, {"craft.disarm_at", "5"}});
  Printed notes;
  Flight flight(g, listening(notes));
  CHECK(fly_until(flight, 1.4));
  CHECK(applied(g, flight) == -0.25);
  CHECK(fly_until(flight, 1.6));
  CHECK_FALSE(obeyed(g, flight));
  CHECK(fly_until(flight, 4.9));
  CHECK_FALSE(obeyed(g, flight));
  CHECK(notes.count("run.failsafe_over") == 1);
  while (flight.step()) {
  }
  const FlightResult r = flight.finish();
  CHECK(r.last_ns == 5'000'000'000);
  CHECK(r.outcome == Outcome::failed);
  CHECK(r.reason == "run.failsafe(law_a, says that it failed)");
}

TEST_CASE(
    "a signal is refused while armed; repeated within five seconds the aircraft is its pilot's at once") {
  const Graph g = craft("");
  std::atomic<int> interrupt{0};
  Printed notes;
  FlightOptions o = listening(notes);
  o.interrupt = &interrupt;
  Flight flight(g, o);
  for (const double t : {1.0, 7.0}) {  // six seconds between them: both are first ones
    CHECK(fly_until(flight, t));
    interrupt = 2;
    CHECK(fly_until(flight, t + 1));
    CHECK(interrupt == 0);
    CHECK(obeyed(g, flight));
  }
  CHECK(notes.count("run.signal_refused") == 2);
  CHECK(fly_until(flight, 11.9));
  interrupt = 15;
  CHECK(fly_until(flight, 11.91));
  CHECK(interrupt == 15);  // the next one finds the first unanswered
  CHECK_FALSE(obeyed(g, flight));
  CHECK(applied(g, flight) != -0.25);  // value of the failsafe
  CHECK(fly_until(flight, 12.5));
  CHECK_FALSE(obeyed(g, flight));
  CHECK(applied(g, flight) != -0.25);
  while (flight.step()) {
  }
  const FlightResult r = flight.finish();
  CHECK(1e-9 * static_cast<double>(r.last_ns) == doctest::Approx(11.9025 + 1).epsilon(1e-9));
  CHECK(r.outcome == Outcome::interrupted);
  CHECK(r.reason == "run.control_given_up");
}

TEST_CASE(
    "a signal ends a flight on hardware at once when the aircraft is not armed, and one that is silent after "
    "a failsafe when repeated") {
  std::atomic<int> interrupt{2};
  Printed notes;
  FlightOptions o = listening(notes);
  o.interrupt = &interrupt;
  const Graph unarmed = craft("", {{"craft.arm_at", "5"}});
  const FlightResult r = Flight(unarmed, o).run();
  CHECK(r.ticks == 1);
  CHECK(r.outcome == Outcome::interrupted);

  interrupt = 0;
  const Graph g = craft("", {{"law_a.fail_at", "1"}});
  Flight flight(g, o);
  CHECK(fly_until(flight, 5));
  interrupt = 2;
  CHECK(fly_until(flight, 6));
  CHECK(interrupt == 0);
  interrupt = 2;
  CHECK_FALSE(fly_until(flight, 6.1));
  CHECK(flight.finish().outcome == Outcome::failed);
}

TEST_CASE(
    "what a vehicle tells stands on the terminal and in the log, with its severity; any bytes become one "
    "line") {
  const Graph g = craft("tell: [vehicle.notices, craft.remark]\n", {{"craft.note_at", "0.5"}});
  Printed notes;
  FlightOptions o = listening(notes);
  o.log = true;
  o.log_file = folder().path / "told.mcap";
  Flight flight(g, o);
  fly_until(flight, 1);
  flight.finish();
  const std::vector<std::string> lines{
      "    0.00 s  run.phase_entered(flight)", "    0.50 s  craft: all is well",
      "    0.50 s  craft: bell  rings",
      "    0.50 s  craft: changed"};  // once, though it is written in every tick
  CHECK(notes.lines == lines);
  CHECK(notes.warnings == std::vector<bool>{false, false, true, false});
  const WholeLog file = read_mcap(o.log_file);
  const std::uint16_t channel = file.channel("/fulmar/event");
  std::vector<std::string> causes;  // a label of the component, for clients that do not use texts
  for (const auto& m : file.messages)
    if (m.channel == channel)
      if (const Event e = HostTopic<Event>(file).read(m.data); e.code == Code::notice)
        causes.emplace_back(e.name.data());
  CHECK(causes == std::vector<std::string>{"", "alarm", ""});
}

TEST_CASE(
    "what cannot be controlled or told is refused with a sentence, and a vehicle that has nothing to tell is "
    "not at fault") {
  const auto fault = [](const std::string& tail) {
    try {
      craft(tail);
    } catch (const Error& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  CHECK(fault("control: [lawn]\n") ==
        "craft.yaml:11: control: types.name_unknown(role, lawn,  [law] vehicle, law)");
  CHECK(fault("control: [vehicle]\n") == "craft.yaml:11: graph.control_role_invalid");
  CHECK(
      fault("control: law\n") ==
      "craft.yaml:11: control: graph.value_not_valid(a list of roles such as [guide, outer, inner], 'law')");
  CHECK(fault("tell: [vehicle.status]\n") ==
        "craft.yaml:11: tell: graph.text_field_missing(vehicle.status, State)");
  CHECK(fault("tell: [notices]\n") ==
        "craft.yaml:11: tell: graph.port_name_expected(vehicle.notices, notices)");
  CHECK(fault("tell: [vehicle.notes]\n")
            .find("types.name_unknown_in(the role vehicle, output, notes,  [notices] status, applied, "
                  "notices)") != std::string::npos);
  CHECK(fault("tell: [vehicle.notices]\n").empty());
  const fs::path file = folder().path / "quiet.yaml";
  std::ofstream(file) << "roles:\n  vehicle: {out: {status: Arm, notices?: Note}}\ncomponents:\n  cart: "
                         "{fills: vehicle, use: lab/Cart}\n"
                         "tell: [vehicle.notices]\n";
  CHECK(load_mission(file.string()).report.empty());
}

// ---- protection of the aircraft

namespace {

/// The craft again, with flags of other names (craft.cpp: Strange).
Graph strange(const std::string& flags, const std::string& io = "fcu", const std::string& out = "gear: Gear",
              const std::string& tail = "") {
  const fs::path file = folder().path / "strange.yaml";
  std::ofstream(file) << "mission: strange\nio: " << io << "\nfailsafe: {u_frac: -0.25, for: 0.5 s}\nroles:\n"
                      << "  vehicle: {in: {command: law.command}, out: {" << out << "}" << flags << "}\n"
                      << "  law:     {in: {state: vehicle.state}, out: {command: Command}}\n"
                      << "components:\n  craft: {fills: vehicle, use: craft/Strange}\n"
                      << "  law_a: {fills: law, use: craft/Hoarder, run: tick}\n"
                      << tail;
  return load_mission(file.string());
}

const std::string its_flags =
    ",\n    flags: {armed: gear.motors_live, on_ground: gear.wheels.down, in_control: gear.obeys}";
const std::string its_ports = "gear: Gear, state: State";

std::string refusal(const std::string& flags, const std::string& io = "fcu",
                    const std::string& out = its_ports) {
  try {
    strange(flags, io, out);
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

}  // namespace

TEST_CASE("in the air 'failed' is a warning, and 'done' is none") {
  for (const std::string end : {"failed", "done"}) {
    Printed notes;
    const Graph g = craft(end + ": \"vehicle.status.tick_s > 0.1 s\"\n");
    Flight flight(g, listening(notes));
    CHECK(fly_until(flight, 0.2));
    REQUIRE(notes.count("run.end_deferred(" + end + ": , vehicle.status.tick_s > 0.1 s)") == 1);
    for (std::size_t i = 0; i < notes.lines.size(); ++i)
      if (notes.lines[i].find("run.end_deferred(") != std::string::npos)
        CHECK(notes.warnings[i] == (end == "failed"));
  }
}

TEST_CASE("a vehicle that needs a command gets the failsafe's, even if none was ever given") {
  const fs::path file = folder().path / "demanding.yaml";
  std::ofstream(file) << "mission: demanding\nfailsafe: {u_frac: -0.25, for: 0.5 s}\nroles:\n"
                         "  vehicle: {in: {command: law.command}, out: {status: State, applied: Received}}\n"
                         "  law:     {in: {state: vehicle.status}, out: {command: Command}}\n"
                         "components:\n  craft: {fills: vehicle, use: craft/Demanding}\n"
                         "  law_a: {fills: law, use: craft/Hoarder, params: {fail_at: -1 s}}\n";
  const Graph g = load_mission(file.string());
  Printed notes;
  Flight flight(g, listening(notes));
  CHECK(fly_until(flight, 0.1));
  CHECK(notes.count("failsafe") == 1);
  CHECK(obeyed(g, flight));
  CHECK(applied(g, flight) == -0.25);
}

TEST_CASE("a flag of any name protects the aircraft once the mission names it") {
  const Graph g = strange(its_flags, "fcu", its_ports, "done: \"vehicle.state.tick_s > 1 s\"\n");
  std::atomic<int> interrupt{0};
  Printed notes;
  FlightOptions o = listening(notes);
  o.interrupt = &interrupt;
  Flight flight(g, o);
  CHECK(fly_until(flight, 1.5));  // done, and armed: it continues
  CHECK(notes.count("run.end_deferred(done: , vehicle.state.tick_s > 1 s)") == 1);
  interrupt = 2;
  CHECK(fly_until(flight, 2));
  CHECK(interrupt == 0);
  CHECK(notes.count("run.signal_refused") == 1);
  CHECK_THROWS_WITH(swap(flight, "law_a", FULMAR_TEST_PLUGIN_DIR "/craft.so"),
                    "run.swap_not_possible(law_a, run.aircraft_armed)");
  while (flight.step()) {  // it disarms in the air at 3 s
  }
  CHECK(flight.finish().last_ns == 3'000'000'000);
}

TEST_CASE("disarmed in the air nothing is swapped, by the flag that the mission names") {
  const Graph g = strange(its_flags, "fcu", its_ports);
  Printed notes;
  Flight flight(g, listening(notes));
  CHECK(fly_until(flight, 3.5));
  CHECK_THROWS_WITH(swap(flight, "law_a", FULMAR_TEST_PLUGIN_DIR "/craft.so"),
                    "run.swap_not_possible(law_a, run.aircraft_in_air)");
}

TEST_CASE(
    "on hardware a vehicle that does not say what protects its aircraft is refused, with what to write") {
  const std::string all =
      " Its flags: applied.present, gear.motors_live, gear.obeys, state.armed, state.on_ground, "
      "state.in_control.";
  CHECK(refusal("") ==
        "strange.yaml:5: roles.vehicle: graph.vehicle_flags_missing(craft, craft/Strange, armed, on_ground, "
        "in_control, status, armed: PORT.FIELD, on_ground: PORT.FIELD, in_control: PORT.FIELD,  Its flags: "
        "applied.present, gear.motors_live, gear.obeys, state.armed, state.on_ground, state.in_control.)");
  CHECK(refusal(", flags: {armed: gear.motors_live, in_control: gear.obeys}")
            .find("graph.vehicle_flags_missing(craft, craft/Strange, on_ground, status, on_ground: "
                  "PORT.FIELD,  Its flags: applied.present, gear.motors_live, gear.obeys, state.armed, "
                  "state.on_ground, state.in_control.)") != std::string::npos);
  CHECK(refusal("", "sim") == "");  // a simulated aircraft needs no protection
}

TEST_CASE("an invalid flag is rejected with the choices, in simulation too") {
  const std::string all =
      " Its flags: applied.present, gear.motors_live, gear.obeys, state.armed, state.on_ground, "
      "state.in_control.";
  const auto fault = [](const std::string& armed) {
    return refusal(", flags: {armed: " + armed + "}", "sim");
  };
  const std::string at = "strange.yaml:5: graph.vehicle_flag_invalid(armed, ";
  CHECK(fault("state.tick_s") == at + "graph.field_not_flag(state.tick_s, craft/Strange, " + all + "))");
  CHECK(fault("geer.obeys") ==
        at + "graph.flag_output_unknown(craft, craft/Strange, geer,  [gear] applied, gear, state))");
  CHECK(fault("armed") == at + "graph.flag_name_expected(armed, " + all + "))");
  CHECK(fault("gear.obey") ==
        at + "types.name_unknown_in(Gear, field, obey,  [obeys] wheels, motors_live, obeys))");
  CHECK(refusal(", flags: {arm: gear.obeys}", "sim")
            .find("graph.key_unknown(roles.vehicle.flags: , arm,  [] armed, on_ground, in_control)") !=
        std::string::npos);
  CHECK(fault("lamps.red") ==
        at + "graph.flag_output_unknown(craft, craft/Strange, lamps,  [] applied, gear, state))");
  CHECK(refusal(", flags: {armed: lamps.red}", "sim", its_ports + ", lamps?: Lamps") == "");
  CHECK(refusal(", flags: {armed: lamps.red}", "fcu", its_ports + ", lamps?: Lamps")
            .find("graph.vehicle_flags_missing(craft, craft/Strange, armed, on_ground, in_control, status, "
                  "armed: PORT.FIELD, on_ground: PORT.FIELD, in_control: PORT.FIELD,  Its flags: "
                  "applied.present, gear.motors_live, gear.obeys, state.armed, state.on_ground, "
                  "state.in_control.)") != std::string::npos);
}

TEST_CASE(
    "a vehicle that has not said anything yet counts as disarmed, on the ground and in control: a host can "
    "be ended at its desk") {
  const Graph g = strange(its_flags, "fcu", its_ports, "control: [law]\n");
  Overrides mute = g.source.overrides;
  mute.set = {{"craft.speak_at", "1e6"}};
  const Graph silent = load_mission(g.source.file, mute);
  std::atomic<int> interrupt{0};
  Printed notes;
  FlightOptions o = listening(notes);
  o.interrupt = &interrupt;
  Flight flight(silent, o);
  CHECK(fly_until(flight, 1));
  interrupt = 2;
  CHECK_FALSE(flight.step());
  const FlightResult r = flight.finish();
  CHECK(r.outcome == Outcome::interrupted);
  CHECK(r.reason == "run.ended_by_signal");
}

TEST_CASE("in simulation a loss of control is detected, even without a flag armed") {
  const Graph g = strange(",\n    flags: {armed: state.armed, in_control: gear.obeys}", "sim", its_ports,
                          "control: [law]\n");
  Printed notes;
  Flight flight(g, listening(notes));
  CHECK(fly_until(flight, 2.9));
  CHECK(hoard(g, flight) == doctest::Approx(2.9025));
  CHECK(fly_until(flight, 3.5));  // it obeys up to 3 s
  CHECK(hoard(g, flight) == doctest::Approx(0.0025));
}

}  // namespace hardware_test

// SPDX-License-Identifier: BSD-3-Clause
// Messages for a wrong mission.
#include "core/graph/mission.hpp"

#include <doctest/doctest.h>
#include <sys/stat.h>

#include "core/graph/test/shelf.hpp"

namespace mission_test {

using namespace std::string_literals;
using namespace fulmar::core;
using namespace fulmar::core::test;

namespace {

std::string broken(const std::string& text) {
  Mission mission;
  mission.text = text;
  return mission.faults();
}

const std::string keys =
    "mission, extends, io, airframe, origin, rate, seed, arm, done, failed, flown, verdict, timeout, epoch, "
    "progress, "
    "summary, failsafe, roles, "
    "components, phases, record, control, tell, resume, live, dds, hardware";

}  // namespace

TEST_CASE("keys of the file are known, given once and of the right type") {
  CHECK(changed("rate: 400 Hz", "rat: 400 Hz") == "5: graph.key_unknown(, rat,  [rate] " + keys + ")");
  CHECK(changed("seed: 7", "seed: 7\nseed: 8") == "7: graph.key_repeated(seed, 6)");
  CHECK(changed("rate: 400 Hz", "rate: 400 m") ==
        "5: rate: graph.dimension_differs(400 m, a length, , a frequency)");
  CHECK(changed("rate: 400 Hz", "rate: 400") ==
        "5: rate: graph.unit_missing(400, graph.unit_examples(a frequency, Hz, kHz, 1/s))");
  CHECK(changed("rate: 400 Hz", "rate: [1]") ==
        "5: rate: graph.value_not_valid(a number with a unit, such as 10 Hz, a list)");
  CHECK(changed("rate: 400 Hz", "rate: 0 Hz") == "5: rate: graph.quantity_not_positive(0 Hz)");
  CHECK(changed("rate: 400 Hz", "rate: .nan") == "5: rate: graph.number_not_finite(.nan)");
  CHECK(changed("seed: 7", "seed: -7") == "6: graph.seed_invalid('-7')");
  CHECK(changed("seed: 7", "epoch: 2026-13-01T00:00Z") ==
        "6: graph.epoch_invalid(graph.time_invalid(2026-13-01T00:00Z))");
  CHECK(changed("seed: 7", "timeout: -3 s") == "6: timeout: graph.quantity_negative(-3 s)");
  // rounded to 0 it would mean never
  CHECK(changed("seed: 7", "timeout: 1e-300 s") == "6: timeout: graph.duration_too_short('1e-300 s')");
  CHECK(changed("io: sim", "io: simulator") == "2: io: graph.choice_unknown(simulator,  [] sim, fcu)");
  CHECK(changed("arm: auto", "arm: atuo") == "7: arm: graph.choice_unknown(atuo,  [auto] auto, off)");
  CHECK(changed("mission: hourglass", "mission: a/b") == "1: graph.mission_name_invalid(a/b)");
  CHECK(changed("progress: [", "progress: x #[") ==
        "9: progress: graph.value_not_valid(a list of fields such as [nav.state.height_m], 'x')");
  CHECK(changed("\ncomponents:", "\ncomponents: []\ncomponent:")
            .find("\n20: components: graph.value_not_valid(a map of names, a list)\n21: "
                  "graph.key_unknown(, component, ") != std::string::npos);
  CHECK(changed("  follow:", "  fol-low:").find("components: graph.name_invalid(fol-low)") !=
        std::string::npos);
}

TEST_CASE("a name that is too long for the log is rejected with its line, one of the maximum length is not") {
  const std::string c47(47, 'c'), c48(48, 'c'), p63(63, 'p'), p64(64, 'p');
  const auto printed = [](const std::string& text) {
    return changed("\ncomponents:\n", "\ncomponents:\n  " + text + "\n");
  };
  CHECK(printed(c47 + ": {use: score}").find("graph.name_too_long(") == std::string::npos);
  CHECK(printed(c48 + ": {use: score}").find("21: components: graph.name_too_long(" + c48 + ", 48, 47)") !=
        std::string::npos);
  const auto role = [](const std::string& name) {
    return changed("\nroles:\n", "\nroles:\n  " + name + ": {in: {}, out: {}}\n");
  };
  CHECK(role(c47).find("graph.name_too_long(") == std::string::npos);
  CHECK(role(c48).find("roles: graph.name_too_long(" + c48 + ", 48, 47)") != std::string::npos);
  const auto phase = [](const std::string& name) {
    return changed("\nphases:\n", "\nphases:\n  " + name + ": {}\n");
  };
  CHECK(phase(p63).find("graph.name_too_long(") == std::string::npos);
  CHECK(phase(p64).find("phases: graph.name_too_long(" + p64 + ", 64, 63)") != std::string::npos);
  for (const std::size_t size : {std::size_t{63}, std::size_t{64}}) {
    Mission mission;
    mission.shelf.plugins.at("score")->components.at(0).params.push_back({});
    mission.shelf.plugins.at("score")->components.at(0).params.back().name = std::string(size, 'q');
    const std::string faults = mission.faults();
    const std::string fault =
        "graph.plugin_name_too_long(score, parameter, " + std::string(size, 'q') + ", score";
    CHECK((faults.find(fault) != std::string::npos) == (size == 64));
    CHECK((faults.find(", 64, 63)") != std::string::npos) == (size == 64));
  }
}

TEST_CASE("broken YAML is reported in one sentence with its line") {
  CHECK(broken("a: [1, 2\nb: 3\n") ==
        "hourglass.yaml:2: graph.yaml_invalid(a '[' is not closed, or a ',' is missing)");
  CHECK(broken("a: {x: 1\nb: 2") ==
        "hourglass.yaml:2: graph.yaml_invalid(a '{' is not closed, or a ',' is missing)");
  CHECK(broken("mission: x\nio: sim\n\trate: 3\n") ==
        "hourglass.yaml:3: graph.yaml_invalid(a tab indents this line; YAML wants spaces)");
  CHECK(broken("mission: x\n  io: sim\n") ==
        "hourglass.yaml:2: graph.yaml_invalid(a ':' stands where none can: look at the indentation and at "
        "the line above; text that holds ': ' needs quotes)");
  CHECK(
      broken("a: @x") ==
      "hourglass.yaml:1: graph.yaml_invalid(a character that cannot begin a value; put the text in quotes)");
  CHECK(broken("a: &a [*a]") == "hourglass.yaml:1: graph.anchor_recursive");
  CHECK(broken("") == "hourglass.yaml:1: graph.map_expected(, " + keys + ", nothing)");
  CHECK(broken("- a\n") == "hourglass.yaml:1: graph.map_expected(, " + keys + ", a list)");
  CHECK(broken("mission: x\n---\nio: sim\n") ==
        "hourglass.yaml: graph.vehicle_missing\nhourglass.yaml:3: graph.document_repeated");
  Mission mission;
  CHECK_THROWS_WITH_AS(load_mission("no/such.yaml", {}, mission.shelf), "graph.file_missing(no/such.yaml, )",
                       Error);
  CHECK_THROWS_WITH_AS(load_mission(mission.folder.path.string(), {}, mission.shelf),
                       ("graph.file_is_folder(" + mission.folder.path.string() + ")").c_str(), Error);
}

TEST_CASE("an endless file, or one without data, is no file and is not waited for") {
  Mission mission;
  const auto reported = [&](const std::string& file) {
    try {
      load_mission(file, {}, mission.shelf);
    } catch (const Error& fault) {
      return std::string(fault.what());
    }
    return std::string();
  };
  const std::string pipe = mission.folder.path / "pipe.yaml";
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  CHECK(reported(pipe) == "graph.file_not_regular(" + pipe + ")");
  CHECK(reported("/dev/zero") == "graph.file_not_regular(/dev/zero)");
  // a regular file of size 0, with 8 bytes for each possible page of memory
  CHECK(reported("/proc/self/pagemap").find("graph.file_too_large(/proc/self/pagemap)") == 0);
  CHECK(reported("/proc/kmsg") != "");
  const std::filesystem::path loop = mission.folder.path / "loop.yaml";
  std::filesystem::create_symlink(loop, loop);
  CHECK(reported(loop) ==
        "graph.file_not_readable(" + loop.string() + ", Too many levels of symbolic links)");
  mission.replace("airframe: anaconda.yaml", "airframe: pipe.yaml");
  CHECK(mission.faults() == "hourglass.yaml:3: airframe: graph.file_not_regular(pipe.yaml)");
}

TEST_CASE("an unknown plugin or component is reported with similar names") {
  CHECK(changed("use: control_slc/Outer", "use: control_scl/Outer") ==
        "28: components.slc: graph.plugin_unknown(control_scl, shelf,  [control_slc] control_slc, "
        "control_tecs, estimator_ekf, fcu_serial, my_law, path, score, sim_aero)");
  CHECK(changed("use: control_slc/Outer", "use: control_slc/Oter") ==
        "28: components.slc: types.name_unknown_in(the plugin control_slc, component, Oter,  [Outer] Outer, "
        "Inner)");
  CHECK(changed("use: control_slc/Outer,", "") == "28: components.slc: graph.use_missing");
}

TEST_CASE("an output of a role exists once, with '?' or without") {
  const std::string twice = "out: {command: GuidanceCommand, command?: GuidanceCommand}";
  CHECK(changed("out: {command: GuidanceCommand}", twice) ==
        "16: graph.output_repeated(roles.guide, command)");
}

TEST_CASE("roles are filled by components with the outputs of the contract") {
  CHECK(changed("fills: guide,", "fills: giude,") ==
        "16: graph.role_not_filled(guide, graph.role_filler_hint(guide))\n27: components.follow: "
        "types.name_unknown(role, giude,  [guide] vehicle, nav, guide, outer, inner)");
  const std::string other_outputs = "out: {state: Gnss, extra: Imu}}";
  CHECK(
      changed("out: {state: VehicleState}}", other_outputs) ==
      "23: graph.role_output_missing(components.ekf: , nav, state, Gnss, ; its 'state' is VehicleState)\n23: "
      "graph.role_output_missing(components.ekf: , nav, extra, Imu, ; it has state: VehicleState)\n24: "
      "graph.role_output_missing(components.truth: , nav, state, Gnss, ; its 'state' is VehicleState)\n24: "
      "graph.role_output_missing(components.truth: , nav, extra, Imu, ; it has state: VehicleState)");
  const std::string truth = ", use: sim_aero/TruthState";
  CHECK(changed("fills: nav" + truth, "fills: vehicle" + truth)
            .find("24: graph.vehicle_expected(components.truth: , sim_aero/TruthState)") !=
        std::string::npos);
  CHECK(changed("\n  nav:     {in", "\n  slc:     {out: {}}\n  nav:     {in") ==
        "15: graph.role_name_taken(slc)\n15: graph.role_not_filled(slc, graph.role_filler_hint(slc))");
}

TEST_CASE("faults of a named file have that file and its line") {
  Mission mission;
  mission.folder.write("plans/hourglass.yaml", "airspeed: 17 m/s\nwaypoints:\n  - {position_m: [1, 2]}\n");
  mission.folder.write(
      "anaconda.yaml",
      "mass: 4.5\nparams:\n  control_slc/Inner: {roll_kp: 7, roll_ki: 3}\n  control_slc/Iner: {}\n"s +
          all_but_mass);
  CHECK(mission.faults() ==
        "anaconda.yaml:1: mass: graph.unit_missing(4.5, graph.unit_examples(a mass, kg, gram, "
        "lb))\nanaconda.yaml:3: params.control_slc/Inner.roll_kp: graph.value_out_of_range(7, 0, 2,  "
        "rad/rad, )\nanaconda.yaml:3: params.control_slc/Inner: types.name_unknown_in(control_slc/Inner, "
        "parameter, roll_ki,  [roll_kp] roll_kp, roll_limit, airframe)\nanaconda.yaml:4: params: "
        "types.name_unknown_in(the plugin control_slc, component, Iner,  [Inner] Outer, "
        "Inner)\nplans/hourglass.yaml:3: waypoints[0].position_m: graph.number_count_invalid(3, north, east, "
        "down, 2)");
}

TEST_CASE("rates, budgets and run modes are those of this build") {
  CHECK(changed("rate: 100 Hz}\n  tecs", "rate: 1000 Hz, budget: 3}\n  tecs") ==
        "28: components.slc.budget: graph.unit_missing(3, graph.unit_examples(a time, s, ms, us, ns, min, "
        "h))\n28: graph.component_rate_too_high(slc, 1000, 400)");
  CHECK(changed("rate: 100 Hz}\n  tecs", "run: process}\n  tecs") == "");
  CHECK(changed("rate: 100 Hz}\n  tecs", "run: tick, hang: 5 ms}\n  tecs") ==
        "28: graph.hang_misplaced(components.slc)");
  CHECK(changed("rate: 100 Hz}\n  tecs", "memory: 5 m}\n  tecs") ==
        "28: components.slc.memory: graph.memory_size_invalid(5 m)");
  CHECK(changed("rate: 100 Hz}\n  tecs", "run: fast, latency: 20 ms}\n  tecs") ==
        "28: components.slc.run: graph.choice_unknown(fast,  [] tick, process, async, driver)\n28: "
        "graph.latency_misplaced(components.slc)");
}

TEST_CASE("phases name existing phases, roles and fillers, and all can be reached") {
  CHECK(changed("to: takeoff", "to: take_off") ==
        "36: phases.hold.next.to: types.name_unknown(phase, take_off,  [takeoff] hold, takeoff, cruise, "
        "research)\n37: graph.phase_unreachable(takeoff, hold)");
  CHECK(changed("outer: slc, next", "outer: ekf, next") ==
        "36: phases.hold.outer: graph.role_filled_by_other(ekf, nav, outer,  [] slc, tecs, mine)");
  CHECK(changed("outer: slc, next", "outer: plan, next") ==
        "36: phases.hold.outer: graph.role_not_filled_by(plan, outer,  [] slc, tecs, mine)");
  CHECK(changed("outer: slc, next", "outer: scl, next") ==
        "36: phases.hold.outer: graph.filler_unknown(scl, outer,  [slc] slc, tecs, mine)");
  const auto hold = [](const std::string& more) {
    return changed("outer: slc, next", more + ", outer: slc, next");
  };
  CHECK(hold("guid: follow") ==
        "36: graph.key_unknown(phases.hold: , guid,  [guide] next, vehicle, nav, guide, outer, inner)");
  CHECK(hold("vehicle: sim") == "36: phases.hold.vehicle: graph.phase_vehicle_fixed");
  for (const char* other : {"vehicle: {use: fcu, set: {wind_ned: [1, 0, 0]}}",
                            "vehicle: {use: sim, set: {wind_ned: [1, 0, 0]}, fallback: sim}"})
    CHECK(hold(other).find("graph.phase_vehicle_fixed") != std::string::npos);
  const std::string wind = "set: {wind_ned: [1, 0, 0]}}";
  CHECK(hold("vehicle: {" + wind) == "");
  CHECK(hold("vehicle: {use: sim, " + wind) == "");
  CHECK(hold("vehicle: {set: {rate: 50 Hz}}") ==
        "36: graph.phase_parameter_fixed(phases.hold.vehicle.set, rate, wind_ned, turbulence)");
  CHECK(changed("law: takeoff", "law: takeof") ==
        "37: phases.takeoff.outer.set.law: graph.choice_unknown(takeof,  [takeoff] normal, takeoff)");
  CHECK(changed("law: takeoff", "span: 3") ==
        "37: graph.phase_parameter_fixed(phases.takeoff.outer.set, span, course_kp, law)");
  for (const char* record : {"airframe.mass: 5 kg", "airframe: anaconda.yaml"})
    CHECK(changed("law: takeoff", record)
              .find("graph.phase_parameter_fixed(phases.takeoff.outer.set, airframe") != std::string::npos);
  CHECK(changed("law: takeoff", "laww: takeoff") ==
        "37: phases.takeoff.outer.set: graph.phase_parameter_unknown(slc, laww,  [law] course_kp, law)");
  CHECK(changed("fallback: tecs", "fallback: mine") ==
        "39: graph.fallback_already_active(phases.research.outer, mine)");
  CHECK(changed("to: research, when", "to: cruise, when") == "39: graph.phase_unreachable(research, hold)");
  CHECK(changed("{to: cruise, when: \"nav.state.height_m > 20 m\"}", "{when: \"vehicle.status.armed\"}") ==
        "36: phases.hold.next: graph.transition_key_missing(to)");
  CHECK(changed("height_m < 3 m", "height_m < 3 s") ==
        "36: phases.hold.next.when: graph.operand_fault(nav.state.height_m, graph.dimension_differs(3 s, a "
        "time, , a length))");
}

TEST_CASE("figures and conditions name existing fields") {
  CHECK(changed("circuits >= 2", "circuits >= two") ==
        "8: done: graph.number_compared_to_label(manage.progress.circuits, two)");
  CHECK(changed("nav.state.airspeed_mps,", "nav.state.airspeed,")
            .starts_with(
                "9: progress: types.name_unknown_in(VehicleState, field, airspeed,  [] position_m, "
                "velocity_mps, attitude, roll_rad, pitch_rad, yaw_rad, rate_radps, specific_force_mps2, "
                "height_m, climb_rate_mps, ground_speed_mps, course_rad, airspeed_mps, alpha_rad, beta_rad, "
                "wind_mps, gyro_bias_radps, accel_bias_mps2, position_std_m, velocity_std_mps, "
                "attitude_std_rad, wind_std_mps, airspeed_std_mps, origin_latitude_deg, "
                "origin_longitude_deg, origin_altitude_m, origin_valid, attitude_valid, velocity_valid, "
                "position_valid, height_valid, airspeed_valid, wind_valid, reset_count, reset_position_m, "
                "reset_velocity_mps, reset_yaw_rad, airspeed_from_model)"));
  CHECK(changed("score.tracking,", "score.traking,") ==
        "10: summary.tracking_rmse: types.name_unknown_in(score (score/Score), output, traking,  [tracking] "
        "tracking, estimation)");
  CHECK(changed("score.tracking,", "score.tracking.item,") ==
        "10: summary.tracking_rmse: graph.port_name_expected(score.tracking, score.tracking.item)");
  CHECK(changed("throttle_frac: 0", "throtle_frac: 0") ==
        "11: graph.failsafe_input_unknown(throtle_frac,  [throttle_frac] for, throttle_frac, aileron_rad, "
        "elevator_rad, rudder_rad)");
  CHECK(changed("throttle_frac: 0, for: 2 s", "throttle: 150 %, for: 2 m") ==
        "11: failsafe.for: graph.dimension_differs(2 m, a length, , a time)\n11: failsafe.throttle: "
        "graph.value_out_of_range(150 %, -100, 100,  %, )");
  CHECK(changed("seed: 7", "record: {ports: [\"nav.*\", nav.stat, \"x*\"]}") ==
        "6: graph.record_port_unknown(nav.stat,  Did you mean 'nav.state'?)\n6: "
        "graph.record_port_unknown(x*, )");
}

TEST_CASE("ten faults give ten sentences in the order of the file") {
  Mission mission;
  mission.replace("io: sim", "io: sum")
      .replace("rate: 400 Hz", "rate: 400 m")
      .replace("seed: 7", "seed: x")
      .replace("circuits >= 2", "circuits >= two");
  mission.replace("score.tracking,", "scor.tracking,")
      .replace("throttle_frac", "throtle_frac")
      .replace("turbulence: light", "turbulence: lite");
  mission.replace("rate: 100 Hz}\n  slc", "rate: 100 m}\n  slc")
      .replace("law: takeoff", "law: 3")
      .replace("fallback: tecs", "fallback: tec");
  CHECK(mission.faults() ==
        "hourglass.yaml:2: io: graph.choice_unknown(sum,  [sim] sim, fcu)\nhourglass.yaml:5: rate: "
        "graph.dimension_differs(400 m, a length, , a frequency)\nhourglass.yaml:6: "
        "graph.seed_invalid('x')\nhourglass.yaml:8: done: "
        "graph.number_compared_to_label(manage.progress.circuits, two)\nhourglass.yaml:10: "
        "summary.tracking_rmse: types.name_unknown(role or component, scor,  [score] vehicle, nav, guide, "
        "outer, inner, sim, ekf, truth, plan, manage, follow, slc, tecs, attitude, mine, "
        "score)\nhourglass.yaml:11: graph.failsafe_input_unknown(throtle_frac,  [throttle_frac] for, "
        "throttle_frac, aileron_rad, elevator_rad, rudder_rad)\nhourglass.yaml:21: "
        "components.sim.params.turbulence: graph.choice_unknown(lite,  [] none, light, "
        "moderate)\nhourglass.yaml:27: components.follow.rate: graph.dimension_differs(100 m, a length, , a "
        "frequency)\nhourglass.yaml:37: phases.takeoff.outer.set.law: graph.choice_unknown(3,  [] normal, "
        "takeoff)\nhourglass.yaml:39: phases.research.outer.fallback: graph.filler_unknown(tec, outer,  "
        "[tecs] slc, tecs, mine)");
}

TEST_CASE("the command line is checked like the file") {
  Mission mission;
  Overrides overrides;
  overrides.io = "boat";
  overrides.roles = {{"nva", "truth"}, {"nav", "slc"}, {"nav", "x"}};
  overrides.set = {
      {"slc.course_kp", "9"},   {"slc", "9"},           {"slx.a", "1"},   {"slc.course_kpp", "9"},
      {"sim.wind_ned", "[1,2"}, {"sim.turbulence", ""}, {"fcu.port", "x"}};
  CHECK(mission.faults(overrides) ==
        "--role nva=truth: types.name_unknown(role, nva,  [nav] vehicle, nav, guide, outer, inner)\n--role "
        "nav=slc: graph.role_filled_by_other(slc, outer, nav,  [] ekf, truth)\n--role nav=x: "
        "graph.filler_unknown(x, nav,  [] ekf, truth)\n--set slc.course_kp=9: slc.course_kp: "
        "graph.value_out_of_range(9, 0, 3,  rad/rad, )\n--set slc=9: graph.assignment_expected\n--set "
        "slx.a=1: types.name_unknown(component, slx,  [slc] sim, ekf, truth, plan, manage, follow, slc, "
        "tecs, attitude, mine, score)\n--set slc.course_kpp=9: slc: types.name_unknown_in(control_slc/Outer, "
        "parameter, course_kpp,  [course_kp] course_kp, law, span, airframe)\n--set sim.wind_ned=[1,2: "
        "graph.yaml_invalid(a '[' is not closed, or a ',' is missing)\n--set sim.turbulence=: "
        "sim.turbulence: graph.value_not_valid(one of none, light, moderate, nothing)\n--set fcu.port=x: "
        "graph.component_of_other_io(fcu, fcu)\n--io boat: graph.choice_unknown(boat,  [] sim, fcu)");
}

// Days from 1970-01-01 by `date -u -d ... +%s`.
TEST_CASE("the epoch is a time in UTC") {
  CHECK(parse_utc_ns("1970-01-01T00:00Z") == 0);
  CHECK(parse_utc_ns("2026-01-01T00:00Z") == 1767225600'000000000);
  CHECK(parse_utc_ns("2024-02-29T23:59:59.5Z") == 1709251199'500000000);
  for (const char* text : {"", "2026-01-01", "2026-01-01T00:00", "2026-01-01T24:00Z", "2026-01-01T00:00:60Z",
                           "2026-01-01T00:00xZ"})
    CHECK_THROWS_AS(parse_utc_ns(text), Error);
}

TEST_CASE("a phase may be reached by `any` alone") {
  Mission mission;
  mission.replace("to: research, when", "to: cruise, when");
  mission.replace("{to: hold, when: \"vehicle.status.override\"}",
                  "{to: research, when: \"vehicle.status.override\"}");
  CHECK(mission.faults() == "");
}

}  // namespace mission_test

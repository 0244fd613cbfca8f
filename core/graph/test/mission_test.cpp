// SPDX-License-Identifier: BSD-3-Clause
// What a wrong mission is told, word by word.
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
  CHECK(changed("rate: 400 Hz", "rat: 400 Hz") ==
        "5: unknown key 'rat'. Did you mean 'rate'? Valid: " + keys + ".");
  CHECK(changed("seed: 7", "seed: 7\nseed: 8") == "7: 'seed' is given twice; the first is in line 6");
  CHECK(changed("rate: 400 Hz", "rate: 400 m") == "5: rate: 400 m is a length, not a frequency");
  CHECK(changed("rate: 400 Hz", "rate: 400") ==
        "5: rate: 400 has no unit; a frequency is written with Hz, kHz, 1/s");
  CHECK(changed("rate: 400 Hz", "rate: [1]") ==
        "5: rate: expected a number with a unit, such as 10 Hz, found a list");
  CHECK(changed("rate: 400 Hz", "rate: 0 Hz") == "5: rate: 0 Hz is not above 0");
  CHECK(changed("rate: 400 Hz", "rate: .nan") == "5: rate: .nan is not a finite number");
  CHECK(changed("seed: 7", "seed: -7") == "6: seed: expected a whole number from 0, found '-7'");
  CHECK(changed("seed: 7", "epoch: 2026-13-01T00:00Z") ==
        "6: epoch: '2026-13-01T00:00Z' is not a time such as 2026-01-01T00:00Z");
  CHECK(changed("seed: 7", "timeout: -3 s") == "6: timeout: -3 s is negative");
  // rounded to 0 it would mean never
  CHECK(changed("seed: 7", "timeout: 1e-300 s") ==
        "6: timeout: expected at least 1 ns, or 0, found '1e-300 s'");
  CHECK(changed("io: sim", "io: simulator") == "2: io: unknown word 'simulator'. Valid: sim, fcu.");
  CHECK(changed("arm: auto", "arm: atuo") ==
        "7: arm: unknown word 'atuo'. Did you mean 'auto'? Valid: auto, off.");
  CHECK(changed("mission: hourglass", "mission: a/b") ==
        "1: mission: a name without '/' is wanted, found 'a/b'");
  CHECK(changed("progress: [", "progress: x #[") ==
        "9: progress: expected a list of fields such as [nav.state.height_m], found 'x'");
  CHECK(changed("\ncomponents:", "\ncomponents: []\ncomponent:")
            .find("\n20: components: expected a map of names, found a list\n21: unknown key 'component'.") !=
        std::string::npos);
  CHECK(changed("  follow:", "  fol-low:")
            .find("components: 'fol-low' is not a name; names are letters, digits and _") !=
        std::string::npos);
}

TEST_CASE("a name that the log has no room for is refused with its line, one that just fits is not") {
  const std::string c47(47, 'c'), c48(48, 'c'), p63(63, 'p'), p64(64, 'p');
  const auto said = [](const std::string& text) {
    return changed("\ncomponents:\n", "\ncomponents:\n  " + text + "\n");
  };
  CHECK(said(c47 + ": {use: score}").find("characters") == std::string::npos);
  CHECK(said(c48 + ": {use: score}")
            .find("21: components: '" + c48 + "' has 48 characters; a name has 47 at most") !=
        std::string::npos);
  const auto role = [](const std::string& name) {
    return changed("\nroles:\n", "\nroles:\n  " + name + ": {in: {}, out: {}}\n");
  };
  CHECK(role(c47).find("characters") == std::string::npos);
  CHECK(role(c48).find("roles: '" + c48 + "' has 48 characters; a name has 47 at most") != std::string::npos);
  const auto phase = [](const std::string& name) {
    return changed("\nphases:\n", "\nphases:\n  " + name + ": {}\n");
  };
  CHECK(phase(p63).find("characters") == std::string::npos);
  CHECK(phase(p64).find("phases: '" + p64 + "' has 64 characters; a name has 63 at most") !=
        std::string::npos);
  for (const std::size_t size : {std::size_t{63}, std::size_t{64}}) {
    Mission mission;
    mission.shelf.plugins.at("score")->components.at(0).params.push_back({});
    mission.shelf.plugins.at("score")->components.at(0).params.back().name = std::string(size, 'q');
    const std::string faults = mission.faults();
    const std::string sentence = "components.score: the parameter '" + std::string(size, 'q') + "' of score";
    CHECK((faults.find(sentence) != std::string::npos) == (size == 64));
    CHECK((faults.find(" has 64 characters; a name has 63 at most") != std::string::npos) == (size == 64));
  }
}

TEST_CASE("broken YAML is told in one sentence with its line") {
  CHECK(broken("a: [1, 2\nb: 3\n") ==
        "hourglass.yaml:2: not valid YAML: a '[' is not closed, or a ',' is missing");
  CHECK(broken("a: {x: 1\nb: 2") ==
        "hourglass.yaml:2: not valid YAML: a '{' is not closed, or a ',' is missing");
  CHECK(broken("mission: x\nio: sim\n\trate: 3\n") ==
        "hourglass.yaml:3: not valid YAML: a tab indents this line; YAML wants spaces");
  CHECK(broken("mission: x\n  io: sim\n") ==
        "hourglass.yaml:2: not valid YAML: a ':' stands where none can: look at the indentation and at the "
        "line above; text that holds ': "
        "' needs quotes");
  CHECK(broken("a: @x") ==
        "hourglass.yaml:1: not valid YAML: a character that cannot begin a value; put the text in quotes");
  CHECK(broken("a: &a [*a]") == "hourglass.yaml:1: an anchor contains itself");
  CHECK(broken("") == "hourglass.yaml:1: expected a map with the keys " + keys + "; found nothing");
  CHECK(broken("- a\n") == "hourglass.yaml:1: expected a map with the keys " + keys + "; found a list");
  CHECK(broken("mission: x\n---\nio: sim\n") ==
        "hourglass.yaml: no component is a vehicle; a mission needs one, such as use: "
        "sim_aero\nhourglass.yaml:3: a second document begins "
        "here; a file holds one");
  Mission mission;
  CHECK_THROWS_WITH_AS(load_mission("no/such.yaml", {}, mission.shelf), "there is no file no/such.yaml",
                       Error);
  CHECK_THROWS_WITH_AS(load_mission(mission.folder.path.string(), {}, mission.shelf),
                       (mission.folder.path.string() + " is a folder, not a file").c_str(), Error);
}

TEST_CASE("what never ends, or has nothing to give yet, is no file and is not waited for") {
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
  CHECK(reported(pipe) == pipe + " is not a file");
  CHECK(reported("/dev/zero") == "/dev/zero is not a file");
  // a regular file of no size, with 8 bytes for each page of memory that there could be
  CHECK(reported("/proc/self/pagemap").find("/proc/self/pagemap is larger than 16 MB") == 0);
  CHECK(reported("/proc/kmsg") != "");
  mission.replace("airframe: anaconda.yaml", "airframe: pipe.yaml");
  CHECK(mission.faults() == "hourglass.yaml:3: airframe: pipe.yaml is not a file");
}

TEST_CASE("a plugin or component that is not there is told with its neighbours") {
  CHECK(changed("use: control_slc/Outer", "use: control_scl/Outer") ==
        "28: components.slc: there is no plugin 'control_scl'. Searched in shelf. Did you mean "
        "'control_slc'? Valid: control_slc, "
        "control_tecs, estimator_ekf, "
        "fcu_serial, my_law, path, score, sim_aero.");
  CHECK(changed("use: control_slc/Outer", "use: control_slc/Oter") ==
        "28: components.slc: the plugin control_slc has no component 'Oter'. Did you mean 'Outer'? Valid: "
        "Outer, Inner.");
  CHECK(changed("use: control_slc/Outer,", "") ==
        "28: components.slc: 'use' is missing; it names the plugin, as in use: control_slc/Outer");
}

TEST_CASE("an output of a role is there once, with '?' or without") {
  CHECK(changed("out: {command: GuidanceCommand}",
                "out: {command: GuidanceCommand, command?: GuidanceCommand}") ==
        "16: roles.guide.out: 'command' is there twice, with '?' and without");
}

TEST_CASE("roles are filled by components that keep the contract") {
  CHECK(changed("fills: guide,", "fills: giude,") ==
        "16: roles.guide: no component fills it; write 'fills: guide' at one\n"
        "27: components.follow: there is no role 'giude'. Did you mean 'guide'? Valid: vehicle, nav, guide, "
        "outer, inner.");
  CHECK(
      changed("out: {state: VehicleState}}", "out: {state: Gnss, extra: Imu}}") ==
      "23: components.ekf: the role nav wants an output 'state' of type Gnss; its 'state' is VehicleState\n"
      "23: components.ekf: the role nav wants an output 'extra' of type Imu; it has state: VehicleState\n"
      "24: components.truth: the role nav wants an output 'state' of type Gnss; its 'state' is VehicleState\n"
      "24: components.truth: the role nav wants an output 'extra' of type Imu; it has state: VehicleState");
  CHECK(changed("fills: nav, use: sim_aero/TruthState", "fills: vehicle, use: sim_aero/TruthState")
            .find("24: components.truth: sim_aero/TruthState is not a vehicle: it has 'step' in place of "
                  "'read' and 'write'") != std::string::npos);
  CHECK(changed("\n  nav:     {in", "\n  slc:     {out: {}}\n  nav:     {in") ==
        "15: roles.slc: there is a component of that name too; rename one of them\n15: roles.slc: no "
        "component fills it; write 'fills: "
        "slc' at one");
}

TEST_CASE("faults of a named file tell that file and its line") {
  Mission mission;
  mission.folder.write("plans/hourglass.yaml", "airspeed: 17 m/s\nwaypoints:\n  - {position_m: [1, 2]}\n");
  mission.folder.write(
      "anaconda.yaml",
      "mass: 4.5\nparams:\n  control_slc/Inner: {roll_kp: 7, roll_ki: 3}\n  control_slc/Iner: {}\n"s +
          all_but_mass);
  CHECK(mission.faults() ==
        "anaconda.yaml:1: mass: 4.5 has no unit; a mass is written with kg, gram, lb\n"
        "anaconda.yaml:3: params.control_slc/Inner.roll_kp: 7 is outside 0 .. 2 rad/rad\n"
        "anaconda.yaml:3: params.control_slc/Inner: control_slc/Inner has no parameter 'roll_ki'. Did you "
        "mean 'roll_kp'? Valid: roll_kp, "
        "roll_limit, airframe.\n"
        "anaconda.yaml:4: params: the plugin control_slc has no component 'Iner'. Did you mean 'Inner'? "
        "Valid: Outer, Inner.\n"
        "plans/hourglass.yaml:3: waypoints[0].position_m: expected 3 numbers [north, east, down], found 2");
}

TEST_CASE("rates, budgets and run modes are those that this build has") {
  CHECK(changed("rate: 100 Hz}\n  tecs", "rate: 1000 Hz, budget: 3}\n  tecs") ==
        "28: components.slc.budget: 3 has no unit; a time is written with s, ms, us, ns, min, h\n28: "
        "components.slc.rate: 1000 Hz is above "
        "the mission's rate of 400 Hz");
  CHECK(changed("rate: 100 Hz}\n  tecs", "run: process}\n  tecs") == "");
  CHECK(changed("rate: 100 Hz}\n  tecs", "run: tick, hang: 5 ms}\n  tecs") ==
        "28: components.slc.hang: belongs to 'run: process'");
  CHECK(changed("rate: 100 Hz}\n  tecs", "memory: 5 m}\n  tecs") ==
        "28: components.slc.memory: '5 m' is no amount of memory; write it with kB, MB or GB, as in 64 MB");
  CHECK(changed("rate: 100 Hz}\n  tecs", "run: fast, latency: 20 ms}\n  tecs") ==
        "28: components.slc.run: unknown word 'fast'. Valid: tick, process, async, driver.\n28: "
        "components.slc.latency: belongs to 'run: "
        "async'");
}

TEST_CASE("phases name phases, roles and fillers that exist, and all can be reached") {
  CHECK(changed("to: takeoff", "to: take_off") ==
        "36: phases.hold.next.to: there is no phase 'take_off'. Did you mean 'takeoff'? Valid: hold, "
        "takeoff, cruise, research.\n"
        "37: phases.takeoff: no transition leads here from hold, where the flight begins");
  CHECK(changed("outer: slc, next", "outer: ekf, next") ==
        "36: phases.hold.outer: ekf fills nav, not outer. Valid: slc, tecs, mine.");
  CHECK(changed("outer: slc, next", "outer: plan, next") ==
        "36: phases.hold.outer: plan does not fill outer. Valid: slc, tecs, mine.");
  CHECK(changed("outer: slc, next", "outer: scl, next") ==
        "36: phases.hold.outer: there is no component 'scl' that fills outer. Did you mean 'slc'? Valid: "
        "slc, tecs, mine.");
  CHECK(changed("outer: slc, next", "guid: follow, outer: slc, next") ==
        "36: phases.hold: unknown key 'guid'. Did you mean 'guide'? Valid: next, vehicle, nav, guide, outer, "
        "inner.");
  CHECK(changed("outer: slc, next", "vehicle: sim, outer: slc, next") ==
        "36: phases.hold.vehicle: the vehicle does not change in flight; choose it with io or with --role "
        "vehicle=NAME. A phase can 'set' live parameters of the one that flies");
  for (const char* other : {"vehicle: {use: fcu, set: {wind_ned: [1, 0, 0]}}",
                            "vehicle: {use: sim, set: {wind_ned: [1, 0, 0]}, fallback: sim}"})
    CHECK(changed("outer: slc, next", std::string(other) + ", outer: slc, next")
              .find("the vehicle does not change in flight") != std::string::npos);
  CHECK(changed("outer: slc, next", "vehicle: {set: {wind_ned: [1, 0, 0]}}, outer: slc, next") == "");
  CHECK(changed("outer: slc, next", "vehicle: {use: sim, set: {wind_ned: [1, 0, 0]}}, outer: slc, next") ==
        "");
  CHECK(changed("outer: slc, next", "vehicle: {set: {rate: 50 Hz}}, outer: slc, next") ==
        "36: phases.hold.vehicle.set.rate: is fixed when the flight begins; a phase can set live parameters "
        "alone. Live: wind_ned, turbulence.");
  CHECK(changed("law: takeoff", "law: takeof") ==
        "37: phases.takeoff.outer.set.law: unknown word 'takeof'. Did you mean 'takeoff'? Valid: normal, "
        "takeoff.");
  CHECK(changed("law: takeoff", "span: 3") ==
        "37: phases.takeoff.outer.set.span: is fixed when the flight begins; a phase can set live parameters "
        "alone. Live: course_kp, law.");
  for (const char* record : {"airframe.mass: 5 kg", "airframe: anaconda.yaml"})
    CHECK(changed("law: takeoff", record).find(": is fixed when the flight begins; a phase can set live") !=
          std::string::npos);
  CHECK(changed("law: takeoff", "laww: takeoff") ==
        "37: phases.takeoff.outer.set: slc has no parameter 'laww'. Did you mean 'law'? Valid: course_kp, "
        "law.");
  CHECK(changed("fallback: tecs", "fallback: mine") ==
        "39: phases.research.outer.fallback: mine is the component that fills the role already");
  CHECK(changed("to: research, when", "to: cruise, when") ==
        "39: phases.research: no transition leads here from hold, where the flight begins");
  CHECK(changed("{to: cruise, when: \"nav.state.height_m > 20 m\"}", "{when: \"vehicle.status.armed\"}") ==
        "36: phases.hold.next: 'to' is missing, as in {to: cruise, when: \"nav.state.height_m > 30 m\"}");
  CHECK(changed("height_m < 3 m", "height_m < 3 s") ==
        "36: phases.hold.next.when: 'nav.state.height_m': 3 s is a time, not a length");
}

TEST_CASE("what is shown and decided names fields that exist") {
  CHECK(changed("circuits >= 2", "circuits >= two") ==
        "8: done: 'manage.progress.circuits' is a number and cannot be compared with 'two'");
  CHECK(changed("nav.state.airspeed_mps,", "nav.state.airspeed,")
            .starts_with("9: progress: VehicleState has no field 'airspeed'."));
  CHECK(changed("score.tracking,", "score.traking,") ==
        "10: summary.tracking_rmse: score (score/Score) has no output 'traking'. Did you mean 'tracking'? "
        "Valid: tracking, estimation.");
  CHECK(changed("score.tracking,", "score.tracking.item,") ==
        "10: summary.tracking_rmse: expected a port such as score.tracking, found 'score.tracking.item'");
  CHECK(changed("throttle_frac: 0", "throtle_frac: 0") ==
        "11: failsafe: the vehicle takes no 'throtle_frac'. Did you mean 'throttle_frac'? Valid: for, "
        "throttle_frac, aileron_rad, "
        "elevator_rad, rudder_rad.");
  CHECK(
      changed("throttle_frac: 0, for: 2 s", "throttle: 150 %, for: 2 m") ==
      "11: failsafe.for: 2 m is a length, not a time\n11: failsafe.throttle: 150 % is outside -100 .. 100 %");
  CHECK(changed("seed: 7", "record: {ports: [\"nav.*\", nav.stat, \"x*\"]}") ==
        "6: record.ports: 'nav.stat' matches no port. Did you mean 'nav.state'?\n6: record.ports: 'x*' "
        "matches no port.");
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
        "hourglass.yaml:2: io: unknown word 'sum'. Did you mean 'sim'? Valid: sim, fcu.\n"
        "hourglass.yaml:5: rate: 400 m is a length, not a frequency\n"
        "hourglass.yaml:6: seed: expected a whole number from 0, found 'x'\n"
        "hourglass.yaml:8: done: 'manage.progress.circuits' is a number and cannot be compared with 'two'\n"
        "hourglass.yaml:10: summary.tracking_rmse: there is no role or component 'scor'. Did you mean "
        "'score'? Valid: vehicle, nav, guide, "
        "outer, inner, sim, ekf, truth, plan, "
        "manage, follow, slc, tecs, attitude, mine, score.\n"
        "hourglass.yaml:11: failsafe: the vehicle takes no 'throtle_frac'. Did you mean 'throttle_frac'? "
        "Valid: for, throttle_frac, "
        "aileron_rad, elevator_rad, rudder_rad.\n"
        "hourglass.yaml:21: components.sim.params.turbulence: unknown word 'lite'. Valid: none, light, "
        "moderate.\n"
        "hourglass.yaml:27: components.follow.rate: 100 m is a length, not a frequency\n"
        "hourglass.yaml:37: phases.takeoff.outer.set.law: unknown word '3'. Valid: normal, takeoff.\n"
        "hourglass.yaml:39: phases.research.outer.fallback: there is no component 'tec' that fills outer. "
        "Did you mean 'tecs'? Valid: slc, "
        "tecs, mine.");
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
        "--role nva=truth: there is no role 'nva'. Did you mean 'nav'? Valid: vehicle, nav, guide, outer, "
        "inner.\n"
        "--role nav=slc: slc fills outer, not nav. Valid: ekf, truth.\n"
        "--role nav=x: there is no component 'x' that fills nav. Valid: ekf, truth.\n"
        "--set slc.course_kp=9: slc.course_kp: 9 is outside 0 .. 3 rad/rad\n"
        "--set slc=9: expected component.parameter=value\n"
        "--set slx.a=1: there is no component 'slx'. Did you mean 'slc'? Valid: sim, ekf, truth, plan, "
        "manage, follow, slc, tecs, "
        "attitude, mine, score.\n"
        "--set slc.course_kpp=9: slc: control_slc/Outer has no parameter 'course_kpp'. Did you mean "
        "'course_kp'? Valid: course_kp, law, "
        "span, airframe.\n"
        "--set sim.wind_ned=[1,2: not valid YAML: a '[' is not closed, or a ',' is missing\n"
        "--set sim.turbulence=: sim.turbulence: expected one of none, light, moderate, found nothing\n"
        "--set fcu.port=x: fcu exists only with io: fcu\n"
        "--io boat: unknown word 'boat'. Valid: sim, fcu.");
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

TEST_CASE("a phase may be reached from any other alone") {
  Mission mission;
  mission.replace("to: research, when", "to: cruise, when");
  mission.replace("{to: hold, when: \"vehicle.status.override\"}",
                  "{to: research, when: \"vehicle.status.override\"}");
  CHECK(mission.faults() == "");
}

}  // namespace mission_test

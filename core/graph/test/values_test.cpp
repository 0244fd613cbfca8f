// SPDX-License-Identifier: BSD-3-Clause
// Values of parameters: their sources, their checks, and the overlays of phases.
#include <doctest/doctest.h>

#include <cstring>

#include "core/graph/params.hpp"
#include "core/graph/test/shelf.hpp"
#include "core/graph/test/shelf_types.hpp"
#include "core/types/named.hpp"
#include "fulmar/msg/actuators.hpp"
#include "fulmar/msg/airframe.hpp"
#include "fulmar/msg/origin.hpp"
#include "fulmar/msg/plan.hpp"

namespace values_test {

using namespace fulmar;
using namespace fulmar::core;
using namespace fulmar::core::test;

TEST_CASE("two geofences that differ are reported, one for all is not") {
  const auto warnings = [](const std::string& lat) {
    Mission mission;
    for (const char* plugin : {"estimator_ekf", "path"})
      mission.shelf.plugins[plugin]->components[0].params.push_back(record<Origin>("fence", false));
    const auto fence = [](const std::string& at) { return "fence: {lat: " + at + ", lon: 2, alt_msl: 3 m}"; };
    mission.replace("fills: nav, use: estimator_ekf",
                    "fills: nav, use: estimator_ekf, params: {" + fence("1") + "}");
    Overrides o;
    o.set.emplace_back("plan.fence", fence(lat).substr(7));
    return mission.load(o).source.warnings;
  };
  CHECK(warnings("1").empty());
  REQUIRE(warnings("1.5").size() == 1);
  CHECK(warnings("1.5")[0].find("graph.fences_differ(plan, ekf)") != std::string::npos);
}

TEST_CASE("an origin at a pole, where north turns within a flight, is rejected by its line") {
  CHECK(changed("lat: 40.2463724", "lat: 89.5") == "");
  for (const char* const lat : {"lat: -90", "lat: 89.6"})
    CHECK(changed("lat: 40.2463724", lat).find("origin.lat: ") != std::string::npos);
}

TEST_CASE("parameters exist, fit and lie in their range") {
  CHECK(changed("turbulence: light", "turbulence: lihgt") ==
        "21: components.sim.params.turbulence: graph.choice_unknown(lihgt,  [light] none, light, moderate)");
  CHECK(changed("turbulence: light", "turbulnce: light") ==
        "21: components.sim.params: types.name_unknown_in(sim_aero/Aircraft, parameter, turbulnce,  "
        "[turbulence] rate, epoch, wind_ned, turbulence, airframe, origin)");
  CHECK(changed("[3, -4, 0]", "[3, -4]") ==
        "21: components.sim.params.wind_ned: graph.three_numbers_expected(north, east, down, 2 items)");
  CHECK(changed("[3, -4, 0]", "[3 kt, -40 m/s, .inf]") ==
        "21: components.sim.params.wind_ned.east: graph.value_out_of_range(-40 m/s, -30, 30,  m/s, )\n21: "
        "components.sim.params.wind_ned.down: graph.number_not_finite(.inf)");
  const auto with_params = [](const std::string& use, const std::string& params) {
    return changed(use, "params: {" + params + "}, " + use);
  };
  const std::string too_large = "roll_kp: 9, roll_limit: 80 deg";
  CHECK(with_params("use: control_slc/Inner", too_large) ==
        "30: components.attitude.params.roll_kp: graph.value_out_of_range(9, 0, 2,  rad/rad, )\n30: "
        "components.attitude.params.roll_limit: graph.value_out_of_range(80 deg, 0, 60,  deg, )");
  CHECK(with_params("use: estimator_ekf", "use_mag: 3, skip: 1.5, gate: {}") ==
        "23: components.ekf.params.use_mag: graph.flag_expected('3')\n23: components.ekf.params.skip: "
        "graph.integer_invalid(1.5)\n23: components.ekf.params.gate: graph.value_not_valid(a number in rad, "
        "a map)");
  CHECK(changed("plans/hourglass.yaml", "plans/hourglas.yaml") ==
        "25: components.plan.params.plan: graph.file_missing(plans/hourglas.yaml, . Did you mean "
        "'plans/hourglass.yaml'?)");
  CHECK(changed("turbulence: light", "rate: 100 Hz") ==
        "21: graph.mission_parameter_misplaced(components.sim.params, rate, rate)");
  CHECK(changed("airframe: anaconda.yaml\n", "") ==
        "20: graph.parameter_missing(sim, airframe, , ; give the mission's 'airframe')\n29: "
        "graph.parameter_missing(attitude, airframe, , ; give the mission's 'airframe')");
  CHECK(changed("airframe: anaconda.yaml", "airframe: annaconda.yaml") ==
        "3: airframe: graph.file_missing(annaconda.yaml, . Did you mean 'anaconda.yaml'?)");
  CHECK(changed("alt_msl: 1387 m", "alt_msl: 1387, latt: 3") ==
        "4: origin.alt_msl: graph.unit_missing(1387, graph.unit_examples(a length, m, cm, mm, km, ft, in, "
        "nmi))\n4: graph.field_unknown(origin: , latt, Origin,  Did you mean 'lat'? [] lat_deg, lon_deg, "
        "alt_msl_m)");
  CHECK(changed("alt_msl: 1387 m", "alt: 1387 m")
            .find("graph.field_unknown(origin: , alt, Origin,  Did you mean 'alt_msl'? [] lat_deg, lon_deg, "
                  "alt_msl_m)") != std::string::npos);
  const std::string altitude = "alt_msl: 1387 m";
  CHECK(changed(altitude, altitude + ", given: true")
            .find("graph.field_unknown(origin: , given, Origin,  [] lat_deg, lon_deg, alt_msl_m)") !=
        std::string::npos);
  CHECK(changed("rate: 400 Hz", "rate: 4000 Hz") ==
        "5: graph.mission_rate_invalid(sim, 4000, 50, 2000, sim_aero/Aircraft)");
}

TEST_CASE("a phase overlays live parameters of the vehicle in use, and changes no vehicle") {
  const auto with = [](const std::string& what, const Overrides& overrides = {}) {
    Mission mission;
    mission.replace("  cruise:   {outer: tecs", "  cruise:   {vehicle: " + what + ", outer: tecs");
    mission.replace("  fcu: ", "  spare: {fills: vehicle, use: sim_aero, only: sim}\n  fcu: ");
    return std::pair(mission.faults(overrides),
                     mission.faults(overrides).empty() ? mission.load(overrides) : Graph());
  };
  for (const char* use : {"use: sim, ", ""}) {
    const auto [faults, graph] = with("{" + std::string(use) + "set: {wind_ned: {east: 7}}}");
    REQUIRE(faults == "");
    CHECK(graph.phases[0].roles[0].set.empty());
    const Assignment& lost = graph.phases[2].roles[0];
    CHECK(nth(graph.components, lost.component).name == "sim");
    REQUIRE(lost.set.size() == 1);
    CHECK(lost.set[0].value.number[0] == 3);  // the mission's base: fields that an overlay omits stay
    CHECK(lost.set[0].value.number[1] == 7);
  }
  const std::string wind = "set: {wind_ned: [0, 0, 0]}}";
  const std::string fallback = "{set: {turbulence: light}, fallback: spare}";
  for (const std::string& changes : {"{use: spare, " + wind, fallback})
    CHECK(with(changes).first.find("graph.phase_vehicle_fixed") != std::string::npos);
  CHECK(with("{set: {rate: 200 Hz}}")
            .first.find("graph.phase_parameter_fixed(phases.cruise.vehicle.set, rate, ") !=
        std::string::npos);
  CHECK(with("{set: {wind: 3}}")
            .first.find("graph.phase_parameter_unknown(sim, wind,  [] wind_ned, turbulence)") !=
        std::string::npos);
  Overrides hardware;
  hardware.io = "fcu";
  CHECK(with("{use: sim, " + wind, hardware).first.find("graph.phase_vehicle_fixed") != std::string::npos);
  CHECK(with("{" + wind, hardware).first.find("graph.phase_parameter_unknown(fcu, wind_ned,  [] none)") !=
        std::string::npos);
  Overrides spare;  // as with any role: it takes the parameters that it has
  spare.roles = {{"vehicle", "spare"}};
  CHECK(with("{use: sim, " + wind, spare).second.phases[2].roles[0].set.size() == 1);
}

TEST_CASE("an overlay belongs to the phase and the component of its place") {
  Mission mission;
  const Graph graph = mission.load();
  const Assignment& takeoff = graph.phases[1].roles[3];
  REQUIRE(takeoff.set.size() == 1);
  CHECK(takeoff.set[0].param == component(graph, "slc").info().param("law"));
  CHECK(takeoff.set[0].value.integer == 1);
  CHECK(param(graph, "slc", "law").integer == 0);
  CHECK(graph.phases[0].roles[3].set.empty());
}

TEST_CASE(
    "parameters come from the declaration, the airframe file, the mission and the command line, in this "
    "order") {
  Mission mission;
  CHECK(param(mission.load(), "attitude", "roll_limit").number[0] == 0.7853981634);  // declared
  CHECK(param(mission.load(), "attitude", "roll_kp").number[0] == 0.7);              // airframe file
  CHECK(param(mission.load(), "tecs", "course_kp").number[0] == 1.1);  // the plugin's first component
  mission.replace("{fills: inner,", "{fills: inner, params: {roll_kp: 0.8},");
  CHECK(param(mission.load(), "attitude", "roll_kp").number[0] == 0.8);
  Overrides overrides;
  overrides.set = {{"attitude.roll_kp", "0.9"}};
  CHECK(param(mission.load(overrides), "attitude", "roll_kp").number[0] == 0.9);
}

TEST_CASE("mission-wide values reach every component with a parameter for them") {
  Mission mission;
  mission.replace("seed: 7", "epoch: 2026-06-01T12:00Z");
  const Graph graph = mission.load();
  CHECK(param(graph, "sim", "rate").number[0] == 400);
  CHECK(param(graph, "sim", "epoch").number[0] == 1780315200);  // date -u -d 2026-06-01T12:00 +%s
  CHECK(param(graph, "score", "epoch").integer == 1780315200);
  for (const char* owner : {"sim", "attitude", "slc"}) {
    CHECK(value<Airframe>(param(graph, owner, "airframe")).mass_kg == 4.5);
    CHECK(param(graph, owner, "airframe").integer == 1);
  }
  for (const char* owner : {"sim", "ekf", "plan"}) {
    const auto origin = value<Origin>(param(graph, owner, "origin"));
    CHECK(origin.given);
    CHECK(origin.lat_deg == 40.2463724);
    CHECK(origin.alt_msl_m == 1387);
  }
  CHECK(value<Plan>(param(graph, "plan", "plan")).waypoints.count == 3);
  CHECK(param(graph, "plan", "plan").text == "hourglass.yaml");
  CHECK(param(graph, "sim", "wind_ned").number[1] == -4);
}

TEST_CASE("without an origin the default is used and does not count as given") {
  Mission mission;
  mission.replace("origin: {", "#origin: {");
  const Graph graph = mission.load();
  CHECK_FALSE(value<Origin>(param(graph, "sim", "origin")).given);
  CHECK(param(graph, "sim", "origin").integer == 0);
}

TEST_CASE("records may be in the mission itself") {
  Mission mission;
  mission.replace("{plan: plans/hourglass.yaml}",
                  "{plan: {airspeed: 40 kt, waypoints: [{position_m: [1, 2, -3]}]}}");
  const Plan plan = value<Plan>(param(mission.load(), "plan", "plan"));
  CHECK(plan.airspeed_mps == doctest::Approx(20.5777777778));
  CHECK(plan.waypoints[0].position_m.down == -3);
}

TEST_CASE("the failsafe is the struct that the vehicle gets") {
  Mission mission;
  mission.replace("throttle_frac: 0, for: 2 s", "throttle: 10 %, elevator: -5 deg, for: 3 s");
  const Graph graph = mission.load();
  CHECK(graph.failsafe_ns == 3'000'000'000);
  REQUIRE(graph.failsafe.size() == 1);
  REQUIRE(graph.failsafe[0].size() == sizeof(Actuators));
  Actuators actuators;
  std::memcpy(&actuators, graph.failsafe[0].data(), sizeof actuators);
  CHECK(actuators.throttle_frac == 0.1);
  CHECK(actuators.elevator_rad == doctest::Approx(-0.0872664625997));
  CHECK(actuators.aileron_rad == 0);
}

TEST_CASE("the values of parameters are printed in the form of a mission file") {
  Mission mission;
  const Graph graph = mission.load();
  const auto text = [&](const char* owner, const char* name) {
    const Component& c = component(graph, owner);
    return value_text(c.info().params.at(static_cast<std::size_t>(c.info().param(name))),
                      param(graph, owner, name));
  };
  CHECK(text("attitude", "roll_kp") == "0.7 rad/rad");
  CHECK(text("sim", "turbulence") == "light");
  CHECK(text("sim", "wind_ned") == "[3, -4, 0]");
  CHECK(text("sim", "airframe") == "anaconda.yaml");
  CHECK(text("ekf", "use_mag") == "true");
  CHECK(text("ekf", "skip") == "0");
}

TEST_CASE("an airframe's parameters of a plugin without a component are those of its first component alone") {
  Mission mission;
  mission.folder.write("anaconda.yaml", std::string("name: Anaconda\nmass: 4.5 kg\n") + all_but_mass +
                                            "params:\n  control_slc: {course_kp: 1.3}\n");
  REQUIRE(mission.faults() == "");  // the second has no such parameter
  const Graph graph = mission.load();
  CHECK(param(graph, "slc", "course_kp").number[0] == 1.3);
  CHECK(param(graph, "tecs", "course_kp").number[0] == 0.9);
}

TEST_CASE("a count beyond the exact range of a double is rejected, even without a range") {
  Mission mission;
  mission.shelf.plugins["estimator_ekf"]->components[0].params[1].max = 1e300;
  mission.replace("use: estimator_ekf, ", "use: estimator_ekf, params: {skip: 9e15}, ");
  CHECK(param(mission.load(), "ekf", "skip").integer == 9'000'000'000'000'000);
  mission.replace("skip: 9e15", "skip: 1e16");
  CHECK(mission.faults().find("components.ekf.params.skip: graph.integer_too_large(1e16)") !=
        std::string::npos);
}

}  // namespace values_test

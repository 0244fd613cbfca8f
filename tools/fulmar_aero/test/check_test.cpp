// SPDX-License-Identifier: BSD-3-Clause
// `fulmar aero check`: each likely mistake is found, and no sound airframe has a fault.
#include <algorithm>

#include "tools/fulmar_aero/test/aero_kit.hpp"

namespace check_test {

using namespace fulmar::aero::test;
using doctest::Approx;
using nlohmann::json;

namespace {

/// The finding of a key in "faults" or "warnings"; null when there is none.
json finding(const json& result, const char* list, const std::string& key) {
  for (const json& one : result[list])
    if (one["key"] == key) return one;
  return {};
}

struct Mistake {
  const char *old, *by, *list, *key, *says;
};

void is_found(const Mistake& mistake) {
  const Folder folder;
  const std::string file = folder.write("a.yaml", changed("anaconda", mistake.old, mistake.by));
  const Answer answer = call("check --json " + file);
  const json result = answer.json(), found = finding(result, mistake.list, mistake.key);
  CHECK(answer.code == (result["faults"].empty() ? 0 : 1));
  REQUIRE_MESSAGE(!found.is_null(), mistake.by, " is not found: ", answer.out);
  CHECK_MESSAGE(found["sentence"].get<std::string>().find(mistake.says) != std::string::npos, found.dump());
  CHECK(found["file"] == file);
  // the line is that of what was changed
  std::istringstream text(text_of(file));
  std::string line;
  for (int i = 0; i < found["line"].get<int>(); ++i) std::getline(text, line);
  const std::string key = mistake.key, last = key.substr(key.rfind('.') + 1);
  CHECK_MESSAGE(line.find(last) != std::string::npos, line, " has no ", last);
}

}  // namespace

TEST_CASE("the shipped airframes have no fault") {
  for (const char* name : {"anaconda", "aerosonde"}) {
    const Answer answer =
        call(std::string("check --json --altitude '1457 m' configs/airframes/") + name + ".yaml");
    CHECK_MESSAGE(answer.code == 0, answer.out);
    CHECK(answer.json()["values_checked"].get<int>() > 90);
    CHECK(answer.json()["figures"]["static_margin_ratio"].get<double>() == Approx(2.74 / 5.61));
  }
  const Answer text = call("check configs/airframes/aerosonde.yaml");
  CHECK(
      text.says("warning  configs/airframes/aerosonde.yaml:20: aero.pitch.alpha: "
                "aero.static_margin_high(0.488)"));
  CHECK(text.says("no fault, 1 warning"));
}

TEST_CASE("a limit that the file leaves out is told as the default that it is") {
  const Folder folder;
  std::string text = changed("anaconda", "parasite_drag: 0.043", "parasite_drag: 0.14");
  const std::string with_limit = folder.write("with.yaml", text);
  const std::size_t at = text.find("  airspeed_max: 27 m/s"), end = text.find('\n', at);
  REQUIRE(at != std::string::npos);
  text.erase(at, end + 1 - at);
  const auto sentence = [](const std::string& file) {
    return finding(call("check --json " + file).json(), "faults", "limits.airspeed_max")["sentence"]
        .get<std::string>();
  };
  CHECK(sentence(with_limit).find("aero.level_flight_impossible(27, ") == 0);
  CHECK(sentence(with_limit).find("default") == std::string::npos);
  const std::string without = sentence(folder.write("without.yaml", text));
  CHECK(without.find("aero.level_flight_impossible(25, ") == 0);
  CHECK(without.ends_with(", aero.limit_defaulted(25 m/s))"));
}

TEST_CASE("a derivative of the wrong sign is found, with what it would do" * doctest::test_suite("amounts")) {
  for (const Mistake& mistake :
       {Mistake{"p: -0.51", "p: 0.51", "faults", "aero.roll.p",
                "aero.derivative_sign_wrong(Cl_p, 0.51, negative, "},
        {"alpha: -2.74", "alpha: 2.74", "faults", "aero.pitch.alpha",
         "aero.derivative_sign_wrong(Cm_alpha, 2.74, negative, "},
        {"q: -38.21", "q: 38.21", "faults", "aero.pitch.q",
         "aero.derivative_sign_wrong(Cm_q, 38.2, negative, "},
        {"r: -0.1541", "r: 0.1541", "faults", "aero.yaw.r",
         "aero.derivative_sign_wrong(Cn_r, 0.154, negative, "},
        {"beta: 0.1301", "beta: -0.1301", "faults", "aero.yaw.beta",
         "aero.derivative_sign_wrong(Cn_beta, -0.13, positive, "},
        {"beta: -0.98", "beta: 0.98", "faults", "aero.side.beta",
         "aero.derivative_sign_wrong(CY_beta, 0.98, negative, "},
        {"beta: -0.13,", "beta: 0.13,", "warnings", "aero.roll.beta",
         "aero.derivative_sign_wrong(Cl_beta, 0.13, negative, "},
        {"aileron: 0.17", "aileron: -0.17", "faults", "aero.roll.aileron",
         "aero.derivative_sign_wrong(Cl_da, -0.17, positive, "},
        {"elevator: -0.99", "elevator: 0.99", "faults", "aero.pitch.elevator",
         "aero.derivative_sign_wrong(Cm_de, 0.99, negative, "},
        {"rudder: -0.069", "rudder: 0.069", "faults", "aero.yaw.rudder",
         "aero.derivative_sign_wrong(Cn_dr, 0.069, negative, "},
        {"rudder: 0.19", "rudder: -0.19", "warnings", "aero.side.rudder",
         "aero.derivative_sign_wrong(CY_dr, -0.19, positive, "},
        {"elevator: 0.13}", "elevator: -0.47351}", "warnings", "aero.lift.elevator",
         "aero.derivative_sign_wrong(CL_de, -0.474, positive, "},
        {"beta: -0.13,", "beta: -0.00195,", "warnings", "aero.roll.beta",
         "aero.derivative_unusual(Cl_beta, -0.00195, -0.28, -0.005, "},
        {"aileron: -0.011", "aileron: 0.011", "warnings", "aero.yaw.aileron", "aero.proverse_yaw(0.011, "},
        {"aileron: -0.011", "aileron: -0.06", "warnings", "aero.yaw.aileron",
         "aero.adverse_yaw_high(-0.06, "}})
    is_found(mistake);
}

TEST_CASE("a lift at no angle of attack that belongs to another angle is found, to either side") {
  for (const Mistake& mistake : {Mistake{"zero: 0.506", "zero: 0.8", "warnings", "aero.lift.zero",
                                         "aero.zero_lift_unusual(0.8, -8.2 deg, 0.506)"},  // 0.8 / 5.61
                                 {"zero: 0.506", "zero: -0.45", "warnings", "aero.lift.zero",
                                  "aero.zero_lift_unusual(-0.45, 4.6 deg, -0.744)"}})
    is_found(mistake);
}

TEST_CASE("degrees for radians and other units are found, with what was likely meant" *
          doctest::test_suite("amounts")) {
  for (const Mistake& mistake :
       {Mistake{"elevator: -0.99", "elevator: -0.0173", "faults", "aero.pitch.elevator",
                "aero.derivative_unusual(Cm_de, -0.0173, -2.8, -0.15, aero.derivative_per_degree(-0.991))"},
        {"elevator: 0.13}", "elevator: 0.0023}", "faults", "aero.lift.elevator",
         "aero.derivative_per_degree(0.132)"},
        {"lift:  {zero: 0.506, alpha: 5.61", "lift:  {zero: 0.506, alpha: 0.0979", "faults",
         "aero.lift.alpha", "aero.derivative_per_degree(5.61)"},
        {"aileron: 0.17", "aileron: 9.74", "faults", "aero.roll.aileron",
         "aero.derivative_converted_twice(0.17)"},
        {"stall_alpha: 15 deg", "stall_alpha_rad: 15", "faults", "wing.stall_alpha",
         "aero.angle_too_large(15, 859 deg, 46 deg, aero.angle_in_degrees(15))"},
        {"rudder:   {limit: 40 deg, rate_limit: 500 deg/s", "rudder:   {limit: 40 deg, rate_limit_radps: 500",
         "warnings", "rudder.rate_limit", "aero.servo_rate_unusual(500)"},
        {"roll_max: 45 deg", "roll_max_rad: 45", "faults", "limits.roll_max",
         "aero.angle_too_large(45, 2578 deg, 86 deg, aero.angle_in_degrees(45))"},
        {"xx_kgm2: 0.24855, yy_kgm2: 0.3784, zz_kgm2: 0.618", "xx_kgm2: 2485.5, yy_kgm2: 3784, zz_kgm2: 6180",
         "faults", "inertia.xx", "aero.inertia_unit_suspect(kg cm^2, 0.249)"},
        {"mass: 4.5 kg", "mass: 4500 kg", "faults", "mass", "aero.mass_unit_suspect)"},
        {"area_m2: 0.52", "area_m2: 5.6", "faults", "wing.chord",
         "aero.wing_dimensions_inconsistent(0.0873)"},
        {"q: -38.21", "q: -1.3", "warnings", "aero.pitch.q", "aero.rate_by_span(-11.5)"}})
    is_found(mistake);
}

TEST_CASE("drag that is counted twice, left out, or drives is found" * doctest::test_suite("amounts")) {
  for (const Mistake& mistake : {Mistake{"drag:  {elevator", "drag:  {zero: 0.043, elevator", "warnings",
                                         "aero.drag.zero", "aero.parasite_drag_doubled(0.043)"},
                                 {"drag:  {elevator", "drag:  {alpha: 0.132, elevator", "warnings",
                                  "aero.drag.alpha", "aero.induced_drag_doubled"},
                                 {"parasite_drag: 0.043", "parasite_drag: 0", "faults", "aero.parasite_drag",
                                  "aero.coefficient_zero(CD_p)"},
                                 {"drag:  {elevator: 0.0135}", "drag:  {elevator: 0.2}", "faults",
                                  "aero.drag.elevator", "aero.elevator_drag_excessive("},
                                 {"drag:  {elevator: 0.0135}", "drag:  {elevator: 0.0135, beta: -0.0058}",
                                  "warnings", "aero.drag.beta", "aero.drag_sided(-0.0058)"},
                                 {"pitch: {zero", "pitch: {beta: 0.16, zero", "warnings", "aero.pitch.beta",
                                  "aero.cross_derivative_nonzero(0.16)"}})
    is_found(mistake);
}

TEST_CASE("what cannot be flown is found" * doctest::test_suite("amounts")) {
  for (const Mistake& mistake :
       {Mistake{"battery: 24 V", "battery: 8 V", "faults", "limits.airspeed_cruise",
                "aero.level_flight_impossible(17, aero.thrust_insufficient("},
        {"airspeed_min: 12 m/s", "airspeed_min: 8 m/s", "faults", "limits.airspeed_min",
         "aero.level_flight_impossible(8, aero.wing_stalls("},
        {"airspeed_max: 27 m/s", "airspeed_max: 37 m/s", "faults", "limits.airspeed_max",
         "aero.level_flight_impossible(37, aero.thrust_insufficient("},
        {"pitch: {zero: 0.135", "pitch: {zero: 1.35", "faults", "limits.airspeed_cruise",
         "aero.level_flight_impossible(17, aero.surface_throw_exceeded(84.2 deg, elevator, 40.0 deg, "},
        {"climb_rate_max: 5 m/s", "climb_rate_max: 14 m/s", "warnings", "limits.climb_rate_max",
         "aero.flight_impossible(aero.flight_condition(steady climb of 55.4 deg, 17, 0), "
         "aero.thrust_insufficient("},
        {"roll_max: 45 deg", "roll_max: 75 deg", "warnings", "limits.roll_max", "aero.wing_stalls("},
        {"trim: 0.1212 rad", "trim: -0.1212 rad", "warnings", "elevator.trim", "aero.elevator_trim_unusual("},
        {"aileron:  {limit: 40 deg", "aileron:  {limit: 5 deg", "warnings", "aero.roll.aileron",
         "aero.roll_power_low(0.0291, "},
        {"xz_kgm2: 0.06", "xz_kgm2: 0.2", "warnings", "inertia", "aero.inertia_moments_impossible("}})
    is_found(mistake);
}

TEST_CASE("the traps of the Skywalker X8's published model are found") {
  std::ifstream in(FULMAR_REFERENCE_DATA "/aero/x8/x8_param.json");
  if (!in) {
    MESSAGE("skipped: no " FULMAR_REFERENCE_DATA "/aero/x8/x8_param.json");
    return;
  }
  const json x = json::parse(in);
  std::ostringstream out;
  const auto v = [&](const char* key) { return x[key].dump(); };
  // As a hand that copies everything would write it. The motor, which has another model there, is the
  // Anaconda's.
  out << "name: x8\nmass: " << v("mass") << " kg\ninertia: {xx_kgm2: " << v("Jx") << ", yy_kgm2: " << v("Jy")
      << ", zz_kgm2: " << v("Jz") << ", xz_kgm2: " << v("Jxz") << "}\nwing: {area_m2: " << v("S_wing")
      << ", span_m: " << v("b") << ", chord_m: " << v("c") << ", oswald: " << v("e")
      << ", stall_alpha_rad: " << v("a_0") << ", stall_sharpness: " << v("M")
      << "}\naero:\n  parasite_drag: " << v("C_D_p") << "\n  lift: {zero: " << v("C_L_0")
      << ", alpha: " << v("C_L_alpha") << ", q: " << v("C_L_q") << ", elevator: " << v("C_L_delta_e")
      << "}\n  drag: {zero: " << v("C_D_0") << ", alpha: " << v("C_D_alpha1") << ", beta: " << v("C_D_beta1")
      << ", elevator: " << v("C_D_delta_e") << "}\n  side: {beta: " << v("C_Y_beta") << ", p: " << v("C_Y_p")
      << ", r: " << v("C_Y_r") << ", aileron: " << v("C_Y_delta_a") << "}\n  roll: {beta: " << v("C_l_beta")
      << ", p: " << v("C_l_p") << ", r: " << v("C_l_r") << ", aileron: " << v("C_l_delta_a")
      << "}\n  pitch: {zero: " << v("C_m_0") << ", alpha: " << v("C_m_alpha") << ", q: " << v("C_m_q")
      << ", elevator: " << v("C_m_delta_e") << "}\n  yaw: {beta: " << v("C_n_beta") << ", p: " << v("C_n_p")
      << ", r: " << v("C_n_r") << ", aileron: " << v("C_n_delta_a") << "}\n";
  std::string motor = text_of(FULMAR_SOURCE_DIR "/configs/airframes/anaconda.yaml");
  motor = motor.substr(motor.find("propulsion:"), motor.find("# Throws") - motor.find("propulsion:"));
  out << motor << "aileron: {limit: 30 deg}\nelevator: {limit: 30 deg}\nrudder: {limit: 30 deg}\n"
      << "limits: {airspeed_min: 13 m/s, airspeed_cruise: 18 m/s, airspeed_max: 24 m/s}\n";
  const Folder folder;
  const std::string file = folder.write("x8.yaml", out.str());
  const Answer answer = call("check --json " + file);
  INFO(answer.out);
  CHECK(answer.code == 1);
  const json result = answer.json();
  const auto says = [&](const char* list, const char* key, const char* sentence) {
    const json found = finding(result, list, key);
    REQUIRE_MESSAGE(!found.is_null(), key);
    CHECK_MESSAGE(found["sentence"].get<std::string>().find(sentence) != std::string::npos, found.dump());
  };
  says("warnings", "inertia", "aero.inertia_moments_impossible(");  // Jxz as published
  says("warnings", "inertia.xx", "aero.gyration_radius_unusual(");  // longer than a rod's, nearly
  says("warnings", "aero.pitch.q", "aero.rate_by_span(-7.65)");
  says("warnings", "aero.drag.beta", "aero.drag_sided(");                 // C_D_beta1
  says("warnings", "aero.drag.zero", "aero.parasite_drag_doubled(");      // C_D_0 beside C_D_p
  says("warnings", "aero.drag.alpha", "aero.induced_drag_doubled");       // C_D_alpha1
  says("faults", "aero.drag.elevator", "aero.elevator_drag_excessive(");  // C_D_delta_e de^2
  says("warnings", "aero.yaw.rudder",
       "aero.rudder_derivative_zero(Cn_dr, aero.rudder_ineffective)");  // elevons alone
  CHECK(result["figures"]["static_margin_ratio"].get<double>() ==
        Approx(0.2524 / 4.02033).epsilon(1e-4).scale(0));
  CHECK(finding(result, "faults", "limits.airspeed_cruise").is_null());  // and it flies, without a rudder
}

TEST_CASE(
    "the X8 has one fault, its Dutch roll, and each trap of its published coefficients has its sentence") {
  const Answer shipped = call("check --json configs/airframes/x8.yaml");
  const json result = shipped.json();
  CHECK_MESSAGE(shipped.code == 1, shipped.out);
  REQUIRE_MESSAGE(result["faults"].size() == 1, shipped.out);
  CHECK(result["figures"]["static_margin_ratio"].get<double>() == Approx(0.2524 / 4.0203282));
  CHECK(result["figures"]["on_skids_ratio"].get<double>() == Approx(1));  // it does not roll for a take-off
  const auto says = [](const json& from, const char* list, const char* key, const char* what) {
    const json found = finding(from, list, key);
    REQUIRE_MESSAGE(!found.is_null(), key, " is not found: ", from.dump());
    CHECK_MESSAGE(found["sentence"].get<std::string>().find(what) != std::string::npos, found.dump());
  };
  says(result, "faults", "aero.yaw",
       "aero.mode_unstable(Dutch roll, ");  // by its product of inertia, as published
  says(result, "warnings", "inertia", "aero.inertia_moments_impossible(");
  says(result, "warnings", "aero.drag.beta", "aero.sideslip_drag_asymmetric(-0.00584, 0.148, 1.1 deg)");
  says(result, "warnings", "aero.yaw.rudder", "aero.rudder_derivative_zero(Cn_dr, aero.rudder_missing)");
  const Folder folder;
  const std::string published = folder.write("x8.yaml", changed("x8", "q: -7.6512739", "q: -1.3012370"));
  says(call("check --json " + published).json(), "warnings", "aero.pitch.q", "aero.rate_by_span(-7.65)");
}

TEST_CASE("the static margin counts the tables, by their slope at cruise") {
  const Folder folder;
  const std::string text = text_of(FULMAR_SOURCE_DIR "/configs/airframes/x8.yaml");
  const auto with = [&](const std::string& table) {
    std::string all = text;
    const std::size_t at = all.find("propulsion:");
    all.insert(at, table);
    const Answer answer = call("check --json " + folder.write("t.yaml", all));
    return answer.json()["figures"]["static_margin_ratio"].get<double>();
  };
  // cruise takes 0.03 rad of angle of attack: the first segment
  const std::string pitching =
      "  tables:\n    - {coefficient: pitch, over: alpha, at: [-0.2, 0.1, 0.3], values: [0.03, 0, 1]}\n";
  const std::string lifting =
      "  tables:\n    - {coefficient: lift, over: alpha, at: [-0.2, 0.1, 0.3], values: [-0.3, 0, 1]}\n";
  CHECK(with(pitching) == Approx((0.2524 + 0.1) / 4.0203282));
  CHECK(with(lifting) == Approx(0.2524 / (4.0203282 + 1)));
}

TEST_CASE("tables that cannot be read are refused with their line") {
  const Folder folder;
  const std::string text = text_of(FULMAR_SOURCE_DIR "/configs/airframes/x8.yaml");
  const auto refused = [&](const std::string& table, const std::string& says) {
    std::string all = text;
    const std::size_t at = all.find("propulsion:");
    const auto line = std::count(all.begin(), all.begin() + std::ptrdiff_t(at), '\n') + 2;
    all.insert(at, "  tables:\n    - " + table + "\n");
    const std::string file = folder.write("t.yaml", all);
    const Answer answer = call("check " + file);
    CHECK(answer.code == 4);
    CHECK_MESSAGE(answer.says(file + ":" + std::to_string(line) + ": " + says), answer.out);
  };
  refused("{coefficient: pitch, over: alpha, at: [0, 0.2, 0.1], values: [1, 2, 3]}",
          "aero.tables[0].at[2]: graph.list_not_rising(0.1,  comes after 0.2)");
  refused("{coefficient: pitch, over: alpha, at: [0, 0.1, 0.1], values: [1, 2, 3]}",
          "aero.tables[0].at[2]: graph.list_not_rising(0.1,  is there twice)");
  refused("{coefficient: pitch, over: alpha, at: [0, 0.1], values: [1, 2, 3]}",
          "aero.table_invalid(0, values: flight.table_values_mismatched(3, 2))");
  refused("{coefficient: pitch, over: alpha, at: [-5, 5], values: [1, 2]}",
          "aero.table_invalid(0, at: flight.table_angle_large(-5))");
  refused("{over: alpha, at: [0, 1]}",
          "aero.tables[0]: graph.item_incomplete(CoefficientTable, coefficient, values)");
  refused("{coefficient: pitch, over: aleph, at: [0, 1], values: [1, 2]}", "aero.tables[0].over: ");
  refused("{coefficient: pitch, over: alpha, at: [0, 1], value: [1, 2]}",
          "graph.field_unknown(aero.tables[0]: , value, CoefficientTable, ");
}

}  // namespace check_test

// SPDX-License-Identifier: BSD-3-Clause
// `fulmar aero import` as a user runs it: the airframe file, the eigenvalues compared with the log's, exit
// codes; and the files and conversions of the shared reference data, if present.
#include <nlohmann/json.hpp>

#include "tools/fulmar_aero/import/compare_modes.hpp"
#include "tools/fulmar_aero/import/rosplane.hpp"
#include "tools/fulmar_aero/test/aero_kit.hpp"
#include "tools/fulmar_aero/test/import_kit.hpp"

namespace import_test {

using namespace fulmar::aero::test;
using namespace fulmar::aero;
using doctest::Approx;
using nlohmann::json;

namespace {

const std::vector<std::string> logs{tern_folder + "tern_e.log", tern_folder + "tern_a.log",
                                    tern_folder + "tern_r.log"};
const std::string log_words = logs[0] + " " + logs[1] + " " + logs[2];

/// Stored next to the source tree, not in it.
std::string shared(const std::string& name) {
  const char* const folder = std::getenv("FULMAR_AERO_DATA");
  const std::string path =
      (folder ? std::string(folder) : FULMAR_SOURCE_DIR "/../shared/data/aero") + "/" + name;
  return std::filesystem::exists(path) ? path : "";
}
bool no_shared() {
  if (!shared("expected/expected_import.json").empty()) return false;
  MESSAGE("skipped: no reference data (FULMAR_AERO_DATA)");
  return true;
}

std::string key_of(const std::string& expected) {
  std::string key = expected.substr(2);
  return "C" + (key.compare(0, 3, "ell") == 0 ? "l" + key.substr(3) : key);
}

Imported imported(const std::vector<std::string>& files) { return imported_from(files, {}, "imported.yaml"); }

}  // namespace

TEST_CASE("an XFLR5 log, trimmed and linearised by the simulator's model, has the log's eigenvalues") {
  const ModeComparison modes = compare_modes(imported(logs));
  REQUIRE(modes.pairs.size() == 5);
  for (const ModePair& pair : modes.pairs) {
    if (pair.name == "phugoid") continue;
    const bool spiral = pair.name == "spiral";
    CHECK_MESSAGE(std::abs(pair.own - pair.tool) <= 0.01 * std::abs(pair.tool), pair.name, " ",
                  pair.own.real());
    CHECK_MESSAGE(pair.agrees(), pair.name);
    CHECK((pair.max_ratio == 0.01 || spiral));
  }
}

TEST_CASE("a log whose eigenvalues are not those of its derivatives fails") {
  const Folder folder;
  for (const std::array<const char*, 3>& change : {std::array<const char*, 3>{"-14.65+", "-12.65+", "roll"},
                                                   {"-0.7844+", "-0.7044+", "Dutch roll"},
                                                   {"-6.783+", "-6.983+", "short period"}}) {
    const std::string text = with(tern_text("tern_e.log"), change[0], change[1]);
    const Answer answer = call("import " + folder.write("e.log", text) + " " + logs[1] + " " + logs[2] +
                               " -o " + (folder.path / "a.yaml").string());
    CHECK(answer.code == 1);
    CHECK_MESSAGE(answer.says("aero.eigenvalue_difference_large(1)"), change[2], answer.out);
  }
  // a wrong inertia
  const Answer answer =
      call("import " + log_words + " --inertia 0.2 0.25 0.35 0.02 -o " + (folder.path / "a.yaml").string());
  CHECK(answer.code == 1);
}

TEST_CASE("a log's eigenvalues beside another tool's derivatives are shown, and accuse nobody") {
  const ModeComparison modes = compare_modes(imported({tern_folder + "tern.st", logs[0]}));
  REQUIRE(modes.pairs.size() == 5);
  for (const ModePair& pair : modes.pairs) CHECK(pair.max_ratio == 0);
  CHECK(compare_modes(imported({logs[0], tern_folder + "tern.st"})).pairs[0].max_ratio == 0.01);
}

TEST_CASE("AVL's eigenvalues count apparent mass, and are compared by size") {
  const Folder folder;
  const std::string run = folder.write("a.run",
                                       " Run case  1:  x\n alpha -> alpha = 3.0\n velocity  =   15.0  m/s\n "
                                       "density =   1.225 kg/m^3\n X_cg  =  0.07 m\n Y_cg = 0.0 m\n"
                                       " Z_cg = -0.01 m\n mass =   3.0 kg\n Ixx = 0.15 kg-m^2\n Iyy = 0.2 "
                                       "kg-m^2\n Izz = 0.32 kg-m^2\n Izx = -0.02 kg-m^2\n");
  const std::string eig = folder.write(
      "a.eig",
      "# x\n#   Run case     Eigenvalue\n 1 -14.5 0.0\n 1 -0.8 5.0\n 1 -0.8 -5.0\n 1 -6.9 7.3\n 1 -6.9 -7.3\n"
      " 1 0.07 0.0\n 1 -0.02 0.74\n 1 -0.02 -0.74\n");
  const Imported set = imported({tern_folder + "tern.st", run, eig});
  CHECK(set.aircraft.xz.x == Approx(0.02));
  const ModeComparison modes = compare_modes(set);
  REQUIRE(modes.pairs.size() == 5);
  CHECK(modes.airspeed_mps == 15);
  for (const ModePair& pair : modes.pairs) {
    CHECK(pair.max_ratio == (pair.name == "roll"                               ? 0.2
                             : pair.name == "phugoid" || pair.name == "spiral" ? 0
                                                                               : 0.1));
    CHECK(pair.off_ratio == Approx(std::abs(std::abs(pair.own) / std::abs(pair.tool) - 1)));
  }
  CHECK(compare_modes(imported({tern_folder + "tern.st", eig})).fault.find("give the .run file") !=
        std::string::npos);
  const std::string feet =
      with(with(text_of(run), "15.0  m/s", "49.2126 ft/s"), "1.225 kg/m^3", "0.00237689 slug/ft^3");
  const Input in_feet = read_any(lines_of("a.run", feet), {});
  CHECK(in_feet.modes.airspeed_mps == Approx(15).epsilon(1e-4));
  CHECK(in_feet.modes.density_kgm3 == Approx(1.225).epsilon(1e-3));
}

TEST_CASE("the airframe file says where every number is from, what was assumed, and flies") {
  const Folder folder;
  const std::string out = (folder.path / "tern.yaml").string();
  const Answer answer = call("import " + log_words + " -o " + out);
  CHECK_MESSAGE(answer.code == 0, answer.out);
  for (const char* words : {"assumed  propulsion", "assumed  throws", "assumed  gear",
                            "assumed  parasite drag 0.03", "DOUBTFUL aero.friction_missing("})
    CHECK_MESSAGE(answer.says(words), words);
  const std::string text = text_of(out);
  CHECK(says(text, "    alpha: -0.9"));
  CHECK(says(text, "# tern_e.log:44 Cma"));
  CHECK(says(text, "# tern_r.log:"));
  CHECK(read_airframe_file(out).airframe.mass_kg == Approx(3));
  CHECK(call("trim " + out).code == 0);
  CHECK(call("check " + out).code == 0);
  // the same again, to the byte, and to the screen
  CHECK(call("import " + log_words + " -o " + out).code == 0);
  CHECK(text_of(out) == text);
  CHECK(call("import " + log_words).says("# tern_e.log:44 Cma"));
  const json all = call("import --json " + log_words).json();
  CHECK(all["coefficients"]["Cm_alpha"]["value"] == -0.9);
  CHECK(all["modes"].size() == 5);
  CHECK(all["check"]["faults"].empty());
}

TEST_CASE("what the command line says counts, and what it cannot mean is refused") {
  const json all = call(
                       "import --json --mass '4 kg' --inertia 0.2 0.3 0.4 --parasite-drag 0.05 --cruise '20 "
                       "m/s' --name Gull " +
                       tern_folder + "tern.stab")
                       .json();
  CHECK(all["check"]["airframe"] == "Gull");
  CHECK(all["coefficients"]["CD_p"]["value"] == 0.05);
  CHECK(all["check"]["figures"]["wing_loading_kgpm2"].get<double>() == Approx(10));
  CHECK(call("import " + tern_folder + "tern.st " + tern_folder + "tern.st").code == 4);
  CHECK(call("import --mass '4 m' " + tern_folder + "tern.st").code == 2);
  CHECK(call("import --length-unit cubit " + tern_folder + "tern.st").code == 2);
  CHECK(call("import " + tern_folder).says("aero.input_is_folder"));
  CHECK(call("import no_such.st").code == 4);
  const Answer none = call("import " + tern_folder + "tern.mass");
  CHECK(none.code == 4);
  CHECK(none.says("aero.derivatives_missing("));
}

TEST_CASE(
    "check looks at a file of another tool, with its lines, and tells how far it is from small aircraft") {
  CHECK(call("check " + tern_folder + "tern.st").code == 0);
  const Answer aerosonde = call("check --json configs/airframes/aerosonde.yaml");
  const json figures = aerosonde.json()["figures"];
  CHECK(figures["class_CL_alpha_off_ratio"] == 0);
  const Folder folder;
  const std::string far = folder.write("a.yaml", changed("aerosonde", "rudder: -0.069", "rudder: -0.165"));
  CHECK(call("check --json " + far).json()["figures"]["class_Cn_dr_off_ratio"].get<double>() ==
        Approx(0.045 / 0.09));
  CHECK(call("check " + far).says("aero.derivative_outside_class(Cn_dr, -0.165, -0.12, -0.03, 0.5)"));
  // lift at the analysed angle
  const std::string shifted = folder.write("a.yaml", changed("aerosonde", "zero: 0.23", "zero: 0.63"));
  CHECK(call("check " + shifted).says("aero.zero_lift_unusual("));
  CHECK(!call("check configs/airframes/aerosonde.yaml").says("aero.zero_lift_unusual("));
  // another aircraft's coefficients
  const Answer anaconda = call("check configs/airframes/anaconda.yaml");
  CHECK(anaconda.says("aero.coefficients_copied(17, 22, Aerosonde)"));
  CHECK(anaconda.says("aero.pitch_coefficient_digit(0.135, Aerosonde, 0.0135)"));
  CHECK(!call("check configs/airframes/aerosonde.yaml").says("aero.coefficients_copied("));
}

TEST_CASE("24: the first edition's table of the Aerosonde contradicts itself") {
  const Folder folder;
  CHECK(call("check " + folder.write("a.yaml", changed("aerosonde", "rudder: 0.19", "rudder: -0.17")))
            .says("aero.rudder_signs_equal(-0.17, -0.069)"));
}

TEST_CASE("conversions of the reference data agree within rounding") {
  if (no_shared()) return;
  const json expected = json::parse(text_of(shared("expected/expected_import.json")));
  int compared = 0;
  for (const auto& item : expected.items()) {
    const std::string& name = item.key();
    const json& one = item.value();
    if (one.contains("error")) continue;
    std::vector<std::string> files{shared(name)};
    if (name.find('{') != std::string::npos)
      files = {shared("xflr5/merlin_T7_e.log"), shared("xflr5/merlin_T7_a.log"),
               shared("xflr5/merlin_T7_r.log")};
    const Aircraft a = imported(files).aircraft;
    constexpr std::array<const char*, terms> names{"0", "alpha",   "beta",    "p",       "q",
                                                   "r", "delta_a", "delta_e", "delta_r", "delta_f"};
    for (std::size_t force = 0; force < forces; ++force)
      for (std::size_t term = 0; term < terms; ++term)
        for (const auto& coefficient : one["coef"].items()) {
          const std::string& key = coefficient.key();
          const json& value = coefficient.value();
          if (key_of(key) != std::string(force_symbol(Force(force))) + "_" + names[term] || value.is_null())
            continue;
          if (force == drag && (term == t_p || term == t_alpha)) continue;
          const double x = value.get<double>();
          CHECK_MESSAGE(std::abs(a.c[force][term].x - x) <= 2e-5 * std::max(1.0, std::abs(x)), name, " ",
                        key);
          ++compared;
        }
    CHECK_MESSAGE(std::abs(a.converted_parasite - one["coef"]["C_D_p"].get<double>()) < 2e-6, name);
  }
  CHECK(compared > 250);
}

TEST_CASE(
    "Merlin's eigenvalues, of XFLR5 within 1 %, of AVL within 10 and 20 %; moments moved as AVL moves them") {
  if (no_shared()) return;
  for (const ModePair& pair :
       compare_modes(imported({shared("xflr5/merlin_T7_e.log"), shared("xflr5/merlin_T7_a.log"),
                               shared("xflr5/merlin_T7_r.log")}))
           .pairs)
    CHECK_MESSAGE((pair.name == "phugoid" || pair.off_ratio < 0.01), pair.name);
  const std::string mass = shared("avl/geometry/merlin.mass");
  const ModeComparison avl =
      compare_modes(imported({shared("avl/out/merlin_a2.st"), mass, shared("avl/out/merlin_a2.run"),
                              shared("avl/out/merlin_a2.eig")}));
  CHECK(avl.pairs.size() == 5);
  for (const ModePair& pair : avl.pairs) CHECK_MESSAGE(pair.agrees(), pair.name);
  // AVL's own run about a point 0.02 m aft and 0.03 m up, brought back to the centre of gravity
  const Aircraft back = imported({shared("avl/out/merlinref_dx020_dz030_a2.st"), mass}).aircraft,
                 right = imported({shared("avl/out/merlin_a2.st"), mass}).aircraft;
  for (const auto& place : {std::pair{pitch, t_zero},
                            {pitch, t_alpha},
                            {roll, t_beta},
                            {yaw, t_beta},
                            {pitch, t_elevator},
                            {yaw, t_rudder},
                            {roll, t_rudder}}) {
    const Force force = place.first;
    const Term term = place.second;
    CHECK_MESSAGE(
        std::abs(back.c[force][term].x - right.c[force][term].x) < (term == t_alpha ? 5e-3 : 1.5e-3),
        force_symbol(force), " ", int(term), " ", back.c[force][term].x);
  }
  // rates, of the body derivatives, which have all that the transfer needs
  const Aircraft back_sb = imported({shared("avl/out/merlinref_dx020_dz030_a2.sb"), mass}).aircraft,
                 right_sb = imported({shared("avl/out/merlin_a2.sb"), mass}).aircraft;
  for (const auto& place : {std::pair{lift, t_q},
                            {pitch, t_q},
                            {side, t_p},
                            {side, t_r},
                            {roll, t_p},
                            {roll, t_r},
                            {yaw, t_p},
                            {yaw, t_r}}) {
    const double x = back_sb.c[place.first][place.second].x,
                 expected = right_sb.c[place.first][place.second].x;
    CHECK_MESSAGE(std::abs(x - expected) < 2e-5 * std::max(1.0, std::abs(expected)),
                  force_symbol(place.first), " ", int(place.second), " ", x, " for ", expected);
  }
}

TEST_CASE("every file of the reference data is read, is told to be of no use, or is refused with a reason") {
  if (no_shared()) return;
  const std::string root = std::filesystem::path(shared("expected")).parent_path().string();
  int files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
    const std::string path = entry.path().string();
    if (!entry.is_regular_file() || says(path, "/expected/") || says(path, "LICENSE") || says(path, ".md"))
      continue;
    ++files;
    Input input;
    const std::string sentence = refusal([&] { input = read_any(read_lines(path), {}); });
    if (!sentence.empty()) {
      CHECK_MESSAGE(
          (sentence == "aero.format_unknown(" + path + ")" || says(sentence, ": aero.log_type_mismatch(")),
          sentence);
      continue;
    }
    const bool used = !input.analyses.empty() || input.body.mass_kg.known || !input.polar.empty() ||
                      !input.modes.empty() || !input.gains.empty();
    CHECK_MESSAGE(used != !input.unused.empty(), path, ": ", input.unused);
  }
  CHECK(files > 100);
  CHECK(call("check '" + shared("vspaero/v2.1_ovsp3.7.0_UNCONVERGED/merlin_DegenGeom.stab") + "'").code == 1);
}

TEST_CASE("ROSflight's hand-copied files: what is wrong in each is found" * doctest::test_suite("amounts")) {
  if (no_shared()) return;
  const auto checked = [](const std::string& name) { return call("check " + shared("ros_params/" + name)); };
  const Answer xflr5 = checked("xflr5_anaconda_dynamics.yaml");
  for (const char* words :
       {":54: aero.lift.elevator: aero.derivative_sign_wrong(CL_de, -0.474, positive, ",
        "aero.derivative_sign_wrong(Cl_da, -0.344, positive, ",
        "aero.derivative_sign_wrong(Cn_dr, 0.0918, negative, ",
        "aero.derivative_sign_wrong(CY_dr, -0.228, positive, ", "aero.zero_lift_unusual(0.602, "})
    CHECK_MESSAGE(xflr5.says(words), words, xflr5.out);
  CHECK(xflr5.code == 1);
  // a dihedral effect near 0 is reported; it is no fault, and the set is imported unchanged
  const Folder folder;
  const Answer openvsp = call("import " + shared("ros_params/openvsp_anaconda_dynamics.yaml") + " -o " +
                              (folder.path / "a.yaml").string());
  CHECK_MESSAGE(openvsp.says("aero.roll.beta: aero.derivative_unusual(Cl_beta, -0.00195, "), openvsp.out);
  CHECK(!openvsp.says("FAULT"));
  CHECK(openvsp.code == 0);
  CHECK(openvsp.says("DOUBTFUL aero.lift_at_start_alpha(0.623, 3, "));
  CHECK(checked("openvsp_anaconda_dynamics.yaml").says("aero.zero_lift_unusual(0.623, -7.0 deg, 0.358)"));
  CHECK(checked("anaconda_dynamics.yaml").says("aero.coefficients_copied(17, 22, Aerosonde)"));
  CHECK(checked("anaconda_dynamics.yaml").says("aero.pitch_coefficient_digit(0.135, Aerosonde, 0.0135)"));
  CHECK(checked("aerosonde_dynamics.yaml").says("aero.coefficient_zero(CD_p)"));
  CHECK(checked("skyhunter_dynamics_0c486c1parent.yaml").says("aero.coefficient_zero(CD_p)"));
  const Aircraft mended = imported({shared("ros_params/xflr5_anaconda_dynamics.yaml")}).aircraft;
  CHECK(mended.c[lift][t_elevator].x == 0.47351);
  CHECK(mended.c[roll][t_aileron].x == 0.34438);
  CHECK(mended.c[yaw][t_rudder].x == -0.09178);
  const Aircraft x8 = imported({shared("x8/x8_param.json")}).aircraft;
  CHECK(x8.c[pitch][t_q].x == Approx(-1.3012370370370372 * 2.1 / 0.35714285714285715));
  CHECK(x8.elevons);
}

TEST_CASE(
    "a folder of ROSplane becomes an airframe with its gains, a plan and a mission, and doubtful signs are "
    "told") {
  const Folder folder;
  const auto in = folder.path / "ros";
  std::filesystem::create_directories(in);
  std::string aircraft =
      "/fixedwing_forces_and_moments:\n  ros__parameters:\n    mass: 4.5\n    wing_s: 0.5\n    wing_b: 2.0\n "
      "   wing_c: 0.25\n    wing_M: 50.0\n";
  for (const char* row : {"D_prop: 0.38",       "CT_0: 0.063",     "CT_1: -0.027",      "CT_2: -0.31",
                          "CQ_0: 0.0061",       "CQ_1: -0.011",    "CQ_2: -0.012",      "KQ: 0.017",
                          "R_motor: 0.042",     "I_0: 1.5",        "V_max: 24.0",       "C_L_O: 0.25",
                          "C_L_alpha: 5.0",     "C_L_q: 7.7",      "C_L_delta_e: 0.4",  "C_D_p: 0.035",
                          "C_m_O: 0.05",        "C_m_alpha: -1.0", "C_m_q: -13.0",      "C_m_delta_e: -1.5",
                          "C_ell_beta: -0.06",  "C_ell_p: -0.5",   "C_ell_r: 0.12",     "C_ell_delta_a: 0.3",
                          "C_n_beta: 0.08",     "C_n_p: -0.05",    "C_n_r: -0.09",      "C_n_delta_a: -0.007",
                          "C_n_delta_r: -0.07", "C_Y_beta: -0.25", "C_Y_delta_r: 0.15", "Jxx: 0.25",
                          "Jyy: 0.38",          "Jzz: 0.6",        "Jxz: 0.05"})
    aircraft += std::string("    ") + row + "\n";
  std::ofstream(in / "bird_dynamics.yaml") << aircraft;
  std::ofstream(in / "gains.yaml") << "autopilot:\n  ros__parameters:\n    c_kp: 2.5\n    r_kp: 0.6\n    "
                                      "p_kp: -0.15\n    a_kp: 0.02\n    p_ff: 0.0\n    R_min: 60.0\n";
  std::ofstream(in / "loop.yaml")
      << "wp:\n  w: [400.0, -250.0, -70.0]\n  chi_d: 1.15\n  lla: False\n  use_chi: False\n  va_d: 16.0\n"
         "wp:\n  w: [-400, -50, -80]\n  chi_d: 0\n  lla: False\n  use_chi: True\n  va_d: 16.0\n";
  const RosplaneSet set = rosplane_set(in.string());
  REQUIRE(set.files.size() == 3);
  CHECK(set.airframe.file.airframe.limits.airspeed_cruise_mps == 16);
  const std::string airframe = set.files[0].text, plan = set.files[1].text;
  for (const char* words : {"roll_kp: 0.41888", "pitch_kp: 0.10472", "course_kp: 2.5", "altitude_kp: 0.02"})
    CHECK_MESSAGE(says(airframe, words), words);
  CHECK(says(set.doubts, "gains.yaml:5: aero.gain_sign_reversed(p_kp, -0.15, "));
  CHECK(says(set.doubts, "aero.gain_undeclared(p_ff)"));
  CHECK(says(set.doubts, "aero.autopilot_node_renamed"));
  CHECK(says(plan, "turn_radius: 60 m"));
  for (const char* waypoint :
       {"{north: 400 m, east: -250 m, up: 70 m}", "{north: -400 m, east: -50 m, up: 80 m, course: 0 rad}"})
    CHECK_MESSAGE(says(plan, waypoint), waypoint);
  std::ofstream(in / "second.yaml") << aircraft;
  CHECK(says(refusal([&] { rosplane_set(in.string()); }), "aero.aircraft_duplicate("));
  std::filesystem::remove(in / "second.yaml");
  std::ofstream(in / "loop.yaml") << "wp:\n  w: [400.0, -250.0]\n  va_d: 16.0\n";
  CHECK(says(refusal([&] { rosplane_set(in.string()); }),
             "loop.yaml:2: aero.waypoint_position_invalid(w: [400.0, -250.0])"));
  std::filesystem::remove(in / "bird_dynamics.yaml");
  CHECK(says(refusal([&] { rosplane_set(in.string()); }), "aero.rosflight_file_missing"));
}

TEST_CASE("imported sets fly the hourglass with computed gains" * doctest::test_suite("amounts")) {
  const Folder folder;
  const std::string out = (folder.path / "tern.yaml").string();
  REQUIRE(call("import " + tern_folder + "tern.st " + tern_folder + "tern.mass -o " + out).code == 0);
  const Answer flown = call("tune --write --verify --altitude '1457 m' " + out);
  CHECK_MESSAGE(flown.says("aero.hourglass_result(flown"), flown.out);
  if (no_shared()) return;
  for (const char* name : {"ros_params/xflr5_anaconda_dynamics.yaml",
                           "ros_params/openvsp_anaconda_dynamics.yaml", "x8/x8_param.json"}) {
    call("import " + shared(name) + " -o " + out);
    const Answer answer = call("tune --write --verify --altitude '1457 m' " + out);
    CHECK_MESSAGE(answer.says("aero.hourglass_result(flown"), name, answer.out);
  }
}

}  // namespace import_test

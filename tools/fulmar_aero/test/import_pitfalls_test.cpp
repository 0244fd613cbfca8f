// SPDX-License-Identifier: BSD-3-Clause
// Errors of derivatives that are copied by hand, one test each, and damaged files.
#include "tools/fulmar_aero/import/rosflight.hpp"
#include "tools/fulmar_aero/test/import_kit.hpp"

namespace import_pitfalls_test {

using namespace fulmar::aero::test;
using namespace fulmar::aero::imports;
using doctest::Approx;

namespace {

const std::string flt =
    "\n ##################\n\n MACH_o:\t 0.0\n ALPHA_o:\t 3.0\n BETA_o: 0.0\n U_o: 15.0\n\n CLo: 0.501327\n "
    "CDo: 0.051000\n";

/// .stab of a version whose CD is that of the vortices alone.
std::string without_friction() {
  std::string text = tern_text("tern.stab");
  const double CL = 0.25 + 4.8 * 3 * std::numbers::pi / 180, AR = 1.6 * 1.6 / 0.4;
  const double induced = CL * CL / (std::numbers::pi * 0.9 * AR);
  char total[32], part[32];
  std::snprintf(total, sizeof total, "%12.7f", induced + 0.021);
  std::snprintf(part, sizeof part, "%12.7f", induced);
  return with(text, total, part);
}

}  // namespace

TEST_CASE("1: XFLR5's CZde and CXde point down and forward") {
  const Aircraft a = aircraft({tern_text("tern_e.log")});
  CHECK(a.c[lift][t_elevator].x == Approx(0.42));
  CHECK(a.c[drag][t_elevator].x == Approx(0.012));
  CHECK(says(a.c[lift][t_elevator].from, "CZde, sign turned"));
}

TEST_CASE("2: AVL's control derivatives are per degree") {
  const Aircraft a = aircraft({tern_text("tern.st")});
  CHECK(a.c[pitch][t_elevator].x == Approx(-0.020944 * 180 / std::numbers::pi));
}

TEST_CASE("3: CL and Cm are those of the analysed angle, and the model wants 0; deflections count") {
  const Aircraft a = aircraft({tern_text("tern.st")});
  CHECK(a.c[lift][t_zero].x == Approx(0.25).epsilon(1e-4));
  CHECK(a.c[pitch][t_zero].x == Approx(0.06).epsilon(1e-4));
  const Aircraft deflected =
      aircraft({with(tern_text("tern.st"), "elevator        =   0.00000", "elevator        =   2.00000")});
  CHECK(deflected.c[lift][t_zero].x == Approx(0.25 - 0.42 * 2 * std::numbers::pi / 180).epsilon(1e-4));
  CHECK(deflected.c[pitch][t_zero].x == Approx(0.06 + 1.2 * 2 * std::numbers::pi / 180).epsilon(1e-4));
}

TEST_CASE(
    "4: what CD means depends on VSPAERO's version, and a .flt counts only where the .stab has no friction") {
  CHECK(aircraft({tern_text("tern.stab")}).parasite.x == Approx(0.021).epsilon(1e-4));
  CHECK(aircraft({tern_text("tern.stab"), flt}).parasite.x == Approx(0.021).epsilon(1e-4));
  const Aircraft old = aircraft({without_friction(), flt});
  CHECK(std::abs(old.converted_parasite) < 1e-5);
  const double induced = 0.501327 * 0.501327 / (std::numbers::pi * 0.9 * 6.4);
  CHECK(old.parasite.x == Approx(0.051 - induced));
  CHECK(says(old.parasite.from, "CDo"));
  const Aircraft none = aircraft({without_friction()});
  CHECK(none.parasite.x == 0.03);
  CHECK(says(none.parasite.from, "assumption"));
  CHECK(says(none.warnings, "aero.friction_missing("));
  ImportOptions options;
  options.parasite_drag = 0.04;
  CHECK(aircraft({without_friction()}, options).parasite.x == 0.04);
}

TEST_CASE("5: CS is of the airflow, CFy of the body") {
  CHECK(aircraft({tern_text("tern.stab")}).c[side][t_beta].x == Approx(-0.25));
}

TEST_CASE("6: CMx and CMz have the other sign; version 2 has them alone") {
  std::string text;
  std::istringstream in(tern_text("tern.stab"));
  for (std::string line; std::getline(in, line);)
    if (line.compare(0, 5, "CMl  ") != 0 && line.compare(0, 5, "CMm  ") != 0 &&
        line.compare(0, 5, "CMn  ") != 0)
      text += line + "\n";
  CHECK(!says(text, "\nCMl "));
  is_tern(aircraft({text}), 1e-6);
}

TEST_CASE("7: AVL's stability axes, and its control columns in body axes until controls have two digits") {
  is_tern(aircraft({tern_text("tern.st")}));
  is_tern(aircraft({tern_text("tern_new.st")}));
  is_tern(aircraft({tern_text("tern.sb")}));
}

TEST_CASE("8: AVL's geometric axes turn signs, and a file without the line is refused") {
  is_tern(aircraft({tern_text("tern_geometric.st")}));
  const std::string none = with(tern_text("tern.st"), "Standard axis orientation,  X fwd, Z down", "");
  CHECK(says(refusal([&] { aircraft({none}); }), "aero.axis_orientation_missing"));
}

TEST_CASE("9: the sign of a control is what it does, turned as a whole, and told") {
  const Aircraft a = aircraft({tern_text("tern.stab")});
  is_tern(a, 1e-6);
  CHECK(says(a.notes, "aero.control_sign_turned(rudder, 'RUDDER', "));
  CHECK(says(a.notes, "aero.control_sign_turned(aileron, 'AILERON', "));
  CHECK(!says(a.notes, "aero.control_sign_turned(elevator"));
  // gains of a set-up: per radian of the surfaces, not of the group
  const std::string set_up =
      "Sref = 0.4\nNumberOfControlGroups = 1\nELEVATOR GROUP\nA_Surf0,A_Surf1\n2, -2\n0\nWakeIters = 3\n";
  const Aircraft geared = aircraft({tern_text("tern.stab"), set_up});
  CHECK(geared.c[pitch][t_elevator].x == Approx(-0.6));
  CHECK(says(geared.notes, "divided by its gain 2"));
}

TEST_CASE("10: a group belongs to its row, whatever its name; halves of pairs are joined") {
  // first and second name exchanged, numbers not: the columns go with the rows
  std::string text = with(tern_text("tern.stab"), "AILERON ", "@@@@@@@ ");
  text = with(text, "ELEVATOR GROUP", "AILERON GROUP ");
  text = with(text, "@@@@@@@ ", "ELEVATOR");
  CHECK(says(refusal([&] { aircraft({text}); }),
             "aero.control_ineffective(Cl, 0, aero.control_column_swapped(1.2))"));
  // names without information: roles by the response
  text = with(with(with(tern_text("tern.stab"), "AILERON ", "ONE     "), "ELEVATOR GROUP", "A 2 deg group "),
              "RUDDER ", "THREE  ");
  is_tern(aircraft({text}), 1e-6);

  // a slat with a named elevator is no second elevator
  const Aircraft slat = aircraft({with(tern_text("tern.stab"), "RUDDER ", "SLAT   ")});
  CHECK(slat.c[pitch][t_elevator].x == Approx(-1.2));
  Control more;
  more.name = "slat";
  for (Value& value : more.of) value = {0, "here"};
  more.of[pitch].x = -0.3;
  Control elevator = more;
  elevator.name = "elevator";
  elevator.of[pitch].x = -1;
  const ControlColumns two = control_columns({more, elevator});
  CHECK(two.of[1][pitch].x == -1);
  CHECK(says(two.notes, "'slat' is left out"));

  Control left, right;
  left.name = "left";
  right.name = "right";
  for (std::size_t i = 0; i < forces; ++i) left.of[i] = right.of[i] = {0, "here"};
  left.of[pitch].x = right.of[pitch].x = -0.1;
  left.of[lift].x = right.of[lift].x = 0.2;
  left.of[roll].x = 0.06;
  right.of[roll].x = -0.06;
  left.of[yaw].x = -0.002;
  right.of[yaw].x = 0.002;
  const ControlColumns elevons = control_columns({left, right});
  CHECK(elevons.elevons);
  CHECK(elevons.of[1][pitch].x == Approx(-0.2));
  CHECK(elevons.of[1][lift].x == Approx(0.4));
  CHECK(elevons.of[0][roll].x == Approx(0.12));
  CHECK(elevons.of[0][yaw].x == Approx(-0.004));
  CHECK(std::abs(elevons.of[1][roll].x) < 1e-12);
  // a V-tail, its right half with the other sense
  left.of[yaw].x = 0.08;
  right.of[yaw].x = 0.08;
  left.of[roll].x = 0.01;
  right.of[roll].x = 0.01;
  right.of[pitch].x = 0.1;
  right.of[lift].x = -0.2;
  const ControlColumns tail = control_columns({left, right});
  CHECK(tail.v_tail);
  CHECK(tail.of[1][pitch].x == Approx(-0.2));
  CHECK(tail.of[2][yaw].x == Approx(-0.16));
  CHECK(says(refusal([&] { control_columns({left}); }), "aero.control_pair_incomplete('left')"));
  left.of[roll].x = left.of[yaw].x = left.of[pitch].x = 0;
  left.name = "aileron";
  CHECK(says(refusal([&] { control_columns({left}); }), "aero.control_ineffective("));
}

TEST_CASE("11: a polar of VSPAERO 6.2 has 21 numbers under 20 names") {
  const std::string polar =
      "     Beta          Mach           AoA        Re/1e6            CL           CDo           CDi         "
      "CDtot            CS           L/D"
      "             E           CFx           CFy           CFz           CMx           CMy           CMz    "
      "       CMl           CMm"
      "           CMn \n"
      " 0.0E+00 0.0E+00 0.0E+00 1.0E+01 2.5E-01 2.2E-02 3.0E-03 2.5E-02 0 1 1 0 0 0 0 0 0 0 0 0 4.5E+01\n"
      " 0.0E+00 0.0E+00 3.0E+00 1.0E+01 5.0E-01 2.3E-02 1.4E-02 3.7E-02 0 1 1 0 0 0 0 0 0 0 0 0 4.5E+01\n";
  const Input input = read_text(polar);
  REQUIRE(input.polar.size() == 2);
  CHECK(input.polar[1].CL == 0.5);
  CHECK(input.polar[1].CD.x == 0.037);
  CHECK(aircraft({without_friction(), polar}).parasite.x ==
        Approx(0.037 - 0.25 / (std::numbers::pi * 0.9 * 6.4)));
  CHECK(says(refusal([&] { read_text(with(polar, " 0 0 4.5E+01\n 0.0", " 0\n 0.0")); }),
             "tern:2: aero.row_incomplete(20, 19)"));
  // version 7: banners above the heading, and names with "tot"
  const Input seven = read_text(
      "  Surface Integration -->\n   Surf-Surf\n Beta Mach AoA CLo CLi CLtot CDo CDi CDtot\n 0 0 3 0 .5 .5 "
      ".02 .014 .034\n");
  REQUIRE(seven.polar.size() == 1);
  CHECK(seven.polar[0].CL == 0.5);
}

TEST_CASE("12: of a sweep the analysis near trim, or the one that was asked for") {
  is_tern(aircraft({tern_text("tern_sweep.stab")}), 1e-6);
  const Aircraft a = aircraft({tern_text("tern_sweep.stab")});
  CHECK(says(a.notes, "aero.analysis_chosen(4, 4.0 deg, "));
  ImportOptions options;
  options.alpha_rad = -3 * std::numbers::pi / 180;
  CHECK(says(aircraft({tern_text("tern_sweep.stab")}, options).notes,
             "aero.analysis_chosen(4, -2.0 deg, --alpha)"));
}

TEST_CASE("13: an analysis that has not converged is told") {
  CHECK(aircraft({tern_text("tern.stab")}).warnings.empty());
  std::string text = tern_text("tern.stab");
  const std::size_t row = text.find("\nCMm ", text.find("Derivative:")),
                    third = text.find("0.0000000", row + 30);
  text.replace(third, 9, "0.1600000");
  CHECK(says(aircraft({text}).warnings, "aero.analysis_not_converged(Cm_beta (file_0:"));
  const std::string history =
      "Sref_  0.4 Lunit^2\nSolver Case: 1 \n\n  Iter      Mach       AoA      Beta       CL         CDo\n"
      "        1   0.0   3.0   0.0   0.45   0.02\n        2   0.0   3.0   0.0   0.47   0.02\n\n";
  CHECK(says(read_text(history).notes, "CL still changed by 0.02"));
  CHECK(read_text(with(history, "0.47 ", "0.4505 ")).notes.empty());
}

TEST_CASE("14: XFLR5's chord of q is the plane's, which only Mw tells") {
  CHECK(aircraft({tern_text("tern_e.log")}).chord_m.x == Approx(0.26).epsilon(1e-4));
}

TEST_CASE(
    "15: logs of several groups make one aircraft; the wrong one, a failed one and a cut one are refused") {
  is_tern(aircraft({tern_text("tern_e.log"), tern_text("tern_a.log"), tern_text("tern_r.log")}), 6e-5);
  const Aircraft alone = aircraft({tern_text("tern_e.log")});
  CHECK(!alone.c[roll][t_aileron].known);
  const std::string log = tern_text("tern_a.log");
  CHECK(says(refusal([&] {
               aircraft({log, with(tern_text("tern_e.log"), "Alpha=3.8", "Alpha=4.8")});
             }),
             "aero.trim_mismatch(4.82 deg, 14.52, file_0, 3.82 deg, 14.52)"));
  std::string failed = log.substr(0, log.find("      Longitudinal derivatives"));
  failed += "       Unsuccessfull attempt to trim the model for control position=0.00 - skipping.\n";
  CHECK(says(refusal([&] { aircraft({failed}); }), "aero.xflr5_trim_missing"));
  CHECK(says(refusal([&] {
               aircraft({with(failed.substr(0, failed.find("Unsucc")), "Type 7 - Stability",
                              "Type 1 - Fixed speed")});
             }),
             "aero.log_type_mismatch(Type 1 - Fixed speed polar)"));
  // the same group twice: the first counts, and a difference is reported
  const Aircraft twice = aircraft({log, with(log, "CLde=", "CLde= 1")});
  CHECK(says(twice.notes, "the first is taken"));
}

TEST_CASE("16: other encodings and line ends are read, decimal commas are refused with their line") {
  std::string latin = tern_text("tern_e.log");
  latin = with(with(latin, "\xc2\xb2", "\xb2"), "\xc2\xb0", "\xb0");
  const Aircraft plain = aircraft({tern_text("tern_e.log")}), other = aircraft({with(latin, "\n", "\r\n")});
  CHECK(other.c[pitch][t_alpha].x == plain.c[pitch][t_alpha].x);
  CHECK(other.xx.x == plain.xx.x);
  CHECK(other.area_m2.x == 0.4);
  for (const char* file : {"tern_e.log", "tern.st", "tern.sb", "tern.stab"}) {
    std::string comma = tern_text(file);
    for (std::size_t i = 1; i + 1 < comma.size(); ++i)
      if (comma[i] == '.' && std::isdigit(comma[i - 1]) && std::isdigit(comma[i + 1])) comma[i] = ',';
    const std::string sentence = refusal([&] { aircraft({comma}); });
    CHECK_MESSAGE(says(sentence, "aero.decimal_comma("), file, ": ", sentence);
    CHECK(says(sentence, "file_0:"));
  }
}

TEST_CASE("17, 18: rates have no dimension and angles are radians, whatever the steps were") {
  const Aircraft a = aircraft({with(tern_text("tern.stab"), "+1.000 deg", "+0.010 deg")});
  CHECK(a.c[roll][t_p].x == Approx(-0.48));
  CHECK(a.c[lift][t_alpha].x == Approx(4.8));
  CHECK(says(a.notes, "VSPAERO 7"));
}

TEST_CASE("19: moments go from the tool's reference to the centre of gravity") {
  // Tern's table: 2 kg at x 0.02, z 0.01 and 1 kg at 0.17, -0.05: together at 0.07, -0.01, as the analysis
  const Aircraft same = aircraft({tern_text("tern.st"), tern_text("tern.mass")});
  CHECK(same.mass_kg.x == Approx(3));
  CHECK(same.xx.x == Approx(0.110 + 2 * 0.02 * 0.02 + 1 * 0.04 * 0.04));
  CHECK(same.yy.x == Approx(0.110 + 2 * (0.05 * 0.05 + 0.02 * 0.02) + (0.1 * 0.1 + 0.04 * 0.04)));
  CHECK(same.xz.x == Approx(0.005 + 2 * -0.05 * 0.02 + 0.1 * -0.04));
  is_tern(same);
  const Aircraft moved =
      aircraft({tern_text("tern.st"), with(tern_text("tern.mass"), "0.02  0.0", "0.0326  0.0")});
  const double dx = 0.0084, a = 3 * std::numbers::pi / 180, CL = 0.25 + 4.8 * a,
               CD_vortex = CL * CL / (std::numbers::pi * 0.9 * 6.4);
  const double normal = CL * std::cos(a) + CD_vortex * std::sin(a);
  CHECK(moved.c[yaw][t_beta].x == Approx(0.08 + (-0.25 + 0.021) * dx / 1.6).epsilon(1e-3));
  CHECK(moved.c[pitch][t_elevator].x == Approx(-1.2 + 0.42 * dx / 0.26).epsilon(1e-3));
  const double Cm = moved.c[pitch][t_zero].x + moved.c[pitch][t_alpha].x * a;
  CHECK(Cm == Approx(0.06 - 0.9 * a + normal * dx / 0.26).epsilon(1e-3));
  CHECK(moved.c[pitch][t_alpha].x == Approx(-0.9 + 4.8 * dx / 0.26).epsilon(0.01));
  CHECK(says(moved.notes, "aero.reference_moved(0.0084, "));
  // with a yaw rate the old point slips, and with a pitch rate it meets the air from above
  CHECK(moved.c[side][t_r].x == Approx(0.2 + 2 * dx / 1.6 * (-0.25 + 0.021)).epsilon(1e-4));
  const double Cn_r = -0.09 + 2 * dx / 1.6 * 0.08;
  CHECK(moved.c[yaw][t_r].x == Approx(Cn_r + moved.c[side][t_r].x * dx / 1.6).epsilon(1e-3));
  CHECK(moved.c[lift][t_q].x ==
        Approx(7.5 - 2 * dx / 0.26 * ((4.8 + CD_vortex) * std::cos(a) + 2 * CL * std::sin(a))).epsilon(1e-4));
  // there and back is where it was
  Analysis there = read_text(tern_text("tern.sb")).analyses[0];
  const Analysis here = there;
  move_reference(there, 0.03, -0.02);
  CHECK(std::abs(there.slope[q][pitch].x - here.slope[q][pitch].x) > 0.1);
  // 0.02 m lower: the old point, above it, slips to the right with a roll to the right
  CHECK(there.slope[p][yaw].x ==
        Approx(here.slope[p][yaw].x + 2 * 0.02 / 1.6 * 0.08 + there.slope[p][side].x * 0.03 / 1.6));
  move_reference(there, -0.03, 0.02);
  for (std::size_t by = 0; by < bys; ++by)
    for (const Force force : {lift, side, roll, pitch, yaw})
      CHECK_MESSAGE(std::abs(there.slope[by][force].x - here.slope[by][force].x) < 1e-9, by_symbol(By(by)),
                    force_symbol(force));
  const Aircraft far =
      aircraft({tern_text("tern.st"), with(tern_text("tern.mass"), "0.02  0.0", "0.2500  0.0")});
  CHECK(says(far.warnings, "aero.reference_moved_far("));
}

TEST_CASE("20: another reference chord, span and area are brought to the first file's") {
  std::string other =
      with(tern_text("tern.stab"), "Cref_                   0.2600000", "Cref_                   0.2400000");
  const Aircraft a =
      aircraft({tern_text("tern_e.log"), tern_text("tern_a.log"), tern_text("tern_r.log"), other});
  is_tern(a, 6e-5);
  CHECK(says(a.notes, "aero.derivatives_differ("));
  ImportOptions options;
  options.controls_from = "file_1";
  CHECK(aircraft({tern_text("tern.st"), other}, options).c[pitch][t_elevator].x ==
        Approx(-1.2 * 0.24 / 0.26));
  CHECK(says(refusal([&] {
               aircraft({tern_text("tern.st"), with(other, "Sref_                   0.4000000",
                                                    "Sref_                   4.3000000")});
             }),
             "aero.reference_mismatch(area, 4.3,  m2, file_1:4 Sref_, 0.4,  m2, file_0)"));
}

TEST_CASE("21: feet and inches") {
  const Input feet = read_text(tern_text("tern.st"), "tern.st", 0.3048);
  CHECK(feet.analyses[0].area_m2.x == Approx(0.4 * 0.3048 * 0.3048));
  CHECK(feet.analyses[0].span_m.x == Approx(1.6 * 0.3048));
  CHECK(*length_in(lines_of("a", "Lunit = 2.0 in\n")) == Approx(0.0508));
  CHECK(says(refusal([&] { length_in(lines_of("a.mass", "\nLunit = 2.0 cubit\n")); }),
             "a.mass:2: Lunit: aero.mass_file_unit_unknown(cubit, valid: m, cm, mm, in, ft)"));
  const Aircraft slugs = aircraft({with(tern_text("tern.stab"), "Rho_                    1.2250000",
                                        "Rho_                    0.0023770")});
  CHECK(slugs.span_m.x == Approx(1.6 * 0.3048));
  CHECK(says(slugs.notes, "slug/ft3"));
  // Tern's log has grams and millimetres
  const Aircraft log = aircraft({tern_text("tern_e.log")});
  CHECK(log.mass_kg.x == Approx(3));
  CHECK(log.span_m.x == Approx(1.6));
}

TEST_CASE("22: ROSflight's letter O, its C_D_p, and inertia that stands in another node or in a comment") {
  const std::string ros =
      "#Jx .27   #orig Jx: 0.24855\n#Jy .367\n#Jz .638\n#Jxz .057\n#start alpha is 3deg up\n#trim at about "
      "15 m/s\n"
      "/old/node:\n  ros__parameters:\n    mass: 4.5\n    wing_s: 0.5\n    wing_b: 2.0\n    wing_c: 0.25\n   "
      " wing_M: 50.0\n"
      "    C_L_O: 0.6\n    C_L_alpha: 5.0\n    C_L_q: 7.7\n    C_L_delta_a: .00008\n    C_L_delta_e: -.47\n  "
      "  C_D_O: 0.027\n"
      "    C_D_alpha: 0.4\n    C_D_p: 0.035\n    C_D_delta_e: -.023\n    C_m_O: 0.01\n    C_m_alpha: -1.0\n  "
      "  C_m_q: -13.0\n"
      "    C_m_delta_e: -1.5\n    C_ell_beta: -.05\n    C_ell_p: -0.5 # check the sign on this\n    "
      "C_ell_delta_a: -.34\n    C_n_beta: .08\n    C_n_r: -.06\n"
      "    C_n_delta_a: -.007\n    C_n_delta_r: .09\n    C_Y_beta: -.2\n    C_Y_delta_r: -.22\n";
  const Lines lines = lines_of("bird_dynamics.yaml", ros);
  REQUIRE(is_rosflight(lines));
  const Aircraft raw = rosflight_aircraft(lines, false), mended = rosflight_aircraft(lines, true);
  CHECK(raw.parasite.x == 0.035);
  CHECK(!raw.c[drag][t_p].known);
  CHECK(!raw.c[drag][t_zero].known);
  CHECK(!raw.c[lift][t_aileron].known);
  CHECK(raw.c[lift][t_zero].x == 0.6);
  CHECK(raw.xx.x == 0.27);
  CHECK(raw.xz.x == 0.057);
  CHECK(raw.cruise_mps == 15);
  CHECK(says(raw.c[lift][t_zero].from, "bird_dynamics.yaml:14 C_L_O"));
  CHECK(says(raw.notes, "aero.sign_doubted(# check the sign on this)"));
  CHECK(says(raw.notes, "aero.parameter_node_unknown("));
  CHECK(says(raw.warnings, "aero.lift_at_start_alpha(0.6, 3, "));
  CHECK(raw.c[lift][t_elevator].x == -0.47);
  CHECK(raw.c[roll][t_aileron].x == -0.34);
  CHECK(mended.c[lift][t_elevator].x == 0.47);
  CHECK(mended.c[drag][t_elevator].x == 0.023);
  CHECK(mended.c[roll][t_aileron].x == 0.34);
  CHECK(mended.c[yaw][t_aileron].x == 0.007);
  CHECK(mended.c[yaw][t_rudder].x == -0.09);
  CHECK(mended.c[side][t_rudder].x == 0.22);
  CHECK(mended.c[pitch][t_elevator].x == -1.5);
  CHECK(mended.warnings.size() == raw.warnings.size() + 3);
  CHECK(
      says(refusal([&] { rosflight_aircraft(lines_of("b.yaml", with(ros, "    wing_b: 2.0\n", "")), true); }),
           "aero.key_missing(wing_b)"));
  CHECK(says(refusal([&] {
               rosflight_aircraft(lines_of("b.yaml", with(ros, "C_m_q: -13.0", "C_m_q: -13,0")), true);
             }),
             "b.yaml:25"));
}

TEST_CASE("two versions in one file are refused, and other tables of version 4.1 are let be") {
  std::string no_groups;
  std::istringstream in(tern_text("tern.stab"));
  for (std::string line; std::getline(in, line);) {
    if (line.find("+1.000 deg") != std::string::npos && line.compare(0, 5, "Alpha") != 0 &&
        line.compare(0, 4, "Beta") != 0)
      continue;
    std::istringstream numbers(line);
    std::string first;
    numbers >> first;
    const bool row = line.size() > 100 && first[0] == 'C' && first != "Case" && first != "Coef";
    no_groups += (row ? line.substr(0, line.size() - 40) : line) + "\n";
  }
  CHECK(aircraft({no_groups}).c[roll][t_p].x == Approx(-0.48));
  CHECK(says(refusal([&] { aircraft({tern_text("tern.stab") + no_groups}); }),
             "aero.control_groups_mismatch(0, 3)"));
  is_tern(aircraft({tern_text("tern.stab") + "CFx_p   0.1\nCMm_(q + alpha_dot)   0.2\n"}), 1e-6);
}

TEST_CASE("23: what XFLR5 knows badly is told") {
  CHECK(says(aircraft({tern_text("tern_e.log")}).notes, "aero.lateral_derivatives_uncertain"));
  CHECK(!says(aircraft({tern_text("tern.st")}).notes, "aero.lateral_derivatives_uncertain"));
}

TEST_CASE("what is broken or foreign is refused with the line and what was expected") {
  CHECK(says(refusal([] { read_text("alpha,CL\n0,0.5\n"); }), "aero.format_unknown("));
  CHECK(says(refusal([] { aircraft({tern_text("tern.mass")}); }), "aero.derivatives_missing("));
  const std::string german = with(tern_text("tern_e.log"), "Longitudinal derivatives", "Laengsstabilitaet");
  CHECK(says(refusal([&] { aircraft({german}); }), "aero.longitudinal_derivatives_missing"));
  CHECK(says(refusal([&] { aircraft({with(tern_text("tern.st"), "Sref =", "Saaa =")}); }),
             "aero.pair_missing(Sref, AVL)"));
  CHECK(says(refusal([&] { aircraft({with(tern_text("tern.st"), "CLa =   4.800000", "CLa = **********")}); }),
             "file_0:40: CLa: aero.number_expected('**********')"));
  CHECK(says(refusal([&] { aircraft({with(tern_text("tern.st"), "CLa =   4.800000", "CLa =        NaN")}); }),
             "aero.number_expected('NaN')"));
  CHECK(says(refusal([&] { aircraft({with(tern_text("tern.stab"), "Bref_", "Xref_")}); }),
             "aero.heading_key_missing(Bref_)"));
  CHECK(
      says(refusal([&] { aircraft({with(tern_text("tern.st"), "Beta  =   0.00000", "Beta  =   5.00000")}); }),
           "aero.avl_sideslip(5)"));
  CHECK(says(refusal([&] {
               aircraft({with(tern_text("tern_e.log"), "g\n\n   ___Center", "stone\n\n   ___Center")});
             }),
             "aero.log_unit_unknown(stone)"));
  // one group more than columns: the file is of no one version
  const std::string mixed =
      with(tern_text("tern.stab"), "RUDDER                 +1.000 deg",
           "RUDDER                 +1.000 deg        0 0 0 0 0 0 0 0 0 0 0 0\nFLAP        "
           "           +1.000 deg");
  CHECK(says(refusal([&] { aircraft({mixed}); }), "aero.derivative_count_mismatch(12, 4, 11)"));
  const std::string short_row = "# mass table: mass x y z Ixx Iyy Izz\n1.0 0.1\n";
  CHECK(says(refusal([&] { read_text(short_row); }), "tern:2: aero.mass_row_incomplete(2)"));
  CHECK(read_text(" Calculated polar for: NACA 2412\n").unused == "aero.polar_of_airfoil");
}

}  // namespace import_pitfalls_test

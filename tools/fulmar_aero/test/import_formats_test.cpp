// SPDX-License-Identifier: BSD-3-Clause
// Formats other than AVL, XFLR5, OpenVSP; and each format cut off, with decimal commas, and of other tools.
#include "tools/fulmar_aero/import/airframe_yaml.hpp"
#include "tools/fulmar_aero/import/rosflight.hpp"
#include "tools/fulmar_aero/test/import_kit.hpp"

namespace import_formats_test {

using namespace fulmar::aero::test;
using namespace fulmar::aero::imports;
using doctest::Approx;

namespace {

std::string jsbsim_text() {
  const auto product = [](const char* name, const std::string& more, double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", value);
    return std::string("<function name=\"") + name +
           "\"><product><property>aero/qbar-psf</property><property>metrics/Sw-sqft</property>" + more +
           "<value>" + text + "</value></product></function>\n";
  };
  const std::string b = "<property>metrics/bw-ft</property>", c = "<property>metrics/cbarw-ft</property>";
  return "<?xml version=\"1.0\"?>\n<!-- x --><fdm_config name=\"gull\">\n<metrics><wingarea "
         "unit=\"FT2\">10</wingarea><wingspan unit=\"FT\">8</wingspan>"
         "<chord unit=\"FT\">1.25</chord></metrics>\n<mass_balance><ixx unit=\"SLUG*FT2\">0.5</ixx><iyy "
         "unit=\"SLUG*FT2\">0.6</iyy>"
         "<izz unit=\"SLUG*FT2\">1.0</izz><emptywt "
         "unit=\"LBS\">20</emptywt></mass_balance>\n<aerodynamics>\n<axis name=\"LIFT\">" +
         product("CLo", "", 0.25) + product("CLalpha", "<property>aero/alpha-rad</property>", 4.8) +
         "</axis><axis name=\"DRAG\">" + product("CDo", "", 0.03) + "</axis>\n<axis name=\"ROLL\">" +
         product("Clp", b + "<property>aero/bi2vel</property><property>velocities/p-aero-rad_sec</property>",
                 -0.5) +
         product("Clda", b + "<property>fcs/left-aileron-pos-rad</property>", 0.2) +
         "</axis>\n<axis name=\"PITCH\">" +
         product("Cmq", c + "<property>aero/ci2vel</property><property>velocities/q-aero-rad_sec</property>",
                 -12) +
         product("Cmq_by_span",
                 c + "<property>aero/bi2vel</property><property>velocities/q-aero-rad_sec</property>", -0.1) +
         product("Cmalpha", c + "<property>aero/alpha-rad</property>", -0.9) +
         "</axis>\n</aerodynamics></fdm_config>\n";
}

/// A function of JSBSim with a table in it.
std::string with_table(const std::string& axis, const std::string& variables, const std::string& data,
                       const std::string& more = "") {
  return with(jsbsim_text(), "<axis name=\"" + axis + "\">",
              "<axis name=\"" + axis +
                  "\"><function name=\"tabled\"><product><property>aero/qbar-area</property>" + more +
                  "<table>" + variables + "<tableData>" + data + "</tableData></table></product></function>");
}

const char* const by_alpha = "<independentVar lookup=\"row\">aero/alpha-deg</independentVar>";

const char* const results_text =
    "Results_Name,Mass_Properties\nResults_Timestamp,1700000000\nTotal_CG,0.070000,0.000000,-0.010000\n"
    "Total_Ixx,1.5e-01\nTotal_Ixy,0\nTotal_Ixz,2.0e-02\nTotal_Iyy,2.0e-01\nTotal_Iyz,0\nTotal_Izz,3.2e-01\n"
    "Total_Mass,3.000000000000000000e+00\nResults_Name,Parasite_Drag\nComp_CD,0.01,0.012\nComp_Label,Wing,"
    "Body\n"
    "FC_Sref,4.0e-01\nNum_Comp,2\nTotal_CD_Total,2.2e-02\nResults_Name,CompGeom\nTotal_Wet_Area,3\n";

const char* const drag_text =
    "PARASITE DRAG BUILD UP DATA \n\nMach, Altitude (m), Vinf (m/s), Sref (m^2)\n0.04, 0.0, 15.0, 0.4 \n\n"
    "Component Name,S_wet (m^2),L_ref (m),t/c or d/l,FF,FF Eqn Type,Re,% Lam,Cf,Q (Interference Factor),f "
    "(m^2),Cd,% Total \n"
    "Wing,0.80, 0.26, 0.12,1.20, Hoerner,250000.0, 0.0,0.0063, 1.0,0.006, 0.0151, 72.0 \n\n"
    "Excrescences, Type, Input\n\n"
    " , , , , , , , , , Geometry Sub-Total:, 0.006, 0.0151, 72.0 \n"
    " , , , , , , , , , Excrescence Sub-Total:, 0.002, 0.0059, 28.0 \n"
    " , , , , , , , , , Totals:, 0.008, 0.0210, 100.0 \n";

const char* const mass_text =
    "...Mass Properties...\n2 Num Comps\n\n3.000000             Total Mass\n0.07 0.0 -0.01       Center of "
    "Gravity\n"
    "0.15 0.2 0.32       Ixx, Iyy, Izz\n0.0 0.02 0.0       Ixy, Ixz, Iyz\n0.01             Volume\n";

const char* const run_text =
    " Run case  1:  x\n alpha -> alpha = 3.0\n velocity  =   15.0  m/s\n density =   1.225 kg/m^3\n X_cg  =  "
    "0.07 m\n Y_cg = 0.0 m\n Z_cg = -0.01 m\n mass =   3.0 kg\n Ixx = 0.15 kg-m^2\n Iyy = 0.2 kg-m^2\n Izz "
    "= 0.32 kg-m^2\n Izx = -0.02 kg-m^2\n";

const char* const eig_text =
    "# x\n#   Run case     Eigenvalue\n 1 -14.5 0.0\n 1 -0.8 5.0\n 1 -0.8 -5.0\n 1 -6.9 7.3\n 1 -6.9 -7.3\n"
    " 1 0.07 0.0\n 1 -0.02 0.74\n 1 -0.02 -0.74\n";

const char* const set_up_text =
    "Sref = 0.4\nNumberOfControlGroups = 2\nELEVATOR GROUP\nA_Surf0,A_Surf1\n1.5, -1.5\n0.0\nRUDDER\n"
    "B_Surf0\n1.5\n0.0\nWakeIters = 3\n";

const char* const flt_text =
    " ##################\n\n MACH_o:\t 0.0\n ALPHA_o:\t 3.0\n BETA_o: 0.0\n U_o: 15.0\n\n CLo: 0.501327\n "
    "CDo: 0.051000\n";

const char* const plane_xml =
    "<?xml version=\"1.0\"?>\n<explane version=\"1.0\">\n<Units>\n"
    "<length_unit_to_meter>0.001</length_unit_to_meter>\n<mass_unit_to_kg>0.5</mass_unit_to_kg>\n</Units>\n"
    "<Plane>\n<Name>Tern</Name>\n<Inertia>\n<Point_Mass>\n<Mass>4.0</Mass>\n"
    "<coordinates>20.5, 0.0, 10.5</coordinates>\n</Point_Mass>\n<Point_Mass>\n<Mass>2.0</Mass>\n"
    "<coordinates>170.5, 0.0, -50.5</coordinates>\n</Point_Mass>\n</Inertia>\n</Plane>\n</explane>\n";

const char* const plane_polar =
    "xflr5 v6.54\n\n Plane name :   Tern\n Polar name :   T1\n\n  alpha      Beta       CL          CDi      "
    "  CDv        CD\n  1.000   0.000   0.333   0.0061   0.0200   0.0261\n  3.000   0.000   0.501   0.0139   "
    "0.0210   0.0349\n";

const char* const rosflight_text =
    "/fixedwing_forces_and_moments:\n  ros__parameters:\n    mass: 4.5\n    wing_s: 0.5\n    wing_b: 2.0\n   "
    " "
    "wing_c: 0.25\n    wing_M: 50.0\n    C_D_p: 0.035\n    C_L_O: 0.25\n    C_L_alpha: 5.0\n    C_L_q: 7.7\n "
    "  "
    " C_L_delta_e: 0.4\n    C_m_O: 0.05\n    C_m_alpha: -1.0\n    C_m_q: -13.0\n    C_m_delta_e: -1.5\n    "
    "C_ell_beta: -0.06\n    C_ell_p: -0.5\n    C_ell_r: 0.12\n    C_ell_delta_a: 0.3\n    C_n_beta: 0.08\n   "
    " "
    "C_n_p: -0.05\n    C_n_r: -0.09\n    C_n_delta_a: -0.007\n    C_n_delta_r: -0.07\n    C_Y_beta: -0.25\n  "
    "  "
    "C_Y_delta_r: 0.15\n    Jxx: 0.25\n    Jyy: 0.38\n    Jzz: 0.6\n    Jxz: 0.05\n";

struct Format {
  std::string name, text;
};
/// What has derivatives, as one file of an aircraft.
std::vector<Format> derivative_files() {
  std::vector<Format> all;
  for (const char* file : {"tern.st", "tern_new.st", "tern.sb", "tern.sm", "tern_mrf.st", "tern_mrf.sb",
                           "tern.stab", "tern_e.log"})
    all.push_back({file, tern_text(file)});
  return all;
}
std::vector<Format> whole_files() {
  return {{"gull.xml", jsbsim_text()},
          {"tabled.xml", with_table("PITCH", by_alpha, "\n-10 0.1\n0 0.0\n12 -0.2\n",
                                    "<property>metrics/cbarw-ft</property>")},
          {"bird_dynamics.yaml", rosflight_text}};
}
std::vector<Format> supplements() {
  return {{"run", run_text},         {"eig", eig_text},    {"set_up", set_up_text},
          {"flt", flt_text},         {"mass", mass_text},  {"drag", drag_text},
          {"results", results_text}, {"plane", plane_xml}, {"polar", plane_polar}};
}

Aircraft whole(const std::string& text, const std::string& name) {
  const Lines lines = lines_of(name, text);
  return is_jsbsim(lines) ? jsbsim_aircraft(lines) : rosflight_aircraft(lines, true);
}

bool same(const Aircraft& a, const Aircraft& b) {
  for (std::size_t force = 0; force < forces; ++force)
    for (std::size_t term = 0; term < terms; ++term)
      if (a.c[force][term].known != b.c[force][term].known || a.c[force][term].x != b.c[force][term].x)
        return false;
  return a.area_m2.x == b.area_m2.x && a.chord_m.x == b.chord_m.x && a.span_m.x == b.span_m.x &&
         a.mass_kg.x == b.mass_kg.x && a.xx.x == b.xx.x && a.xz.x == b.xz.x && a.zz.x == b.zz.x &&
         a.parasite.x == b.parasite.x && a.more_aero == b.more_aero;
}

bool same(const Input& a, const Input& b) {
  const auto body = [](const Input& i) {
    return std::vector<double>{i.body.mass_kg.x, i.body.xx.x,    i.body.yy.x,    i.body.zz.x,
                               i.body.xz.x,      i.body.cg_m[0], i.body.cg_m[2], double(i.body.has_cg)};
  };
  if (body(a) != body(b) || a.gains != b.gains || a.modes.unsorted != b.modes.unsorted) return false;
  if (a.modes.airspeed_mps != b.modes.airspeed_mps) return false;
  if (a.polar.empty() && !b.polar.empty() && !a.body.mass_kg.known) return false;
  if (a.polar.size() > b.polar.size()) return false;
  for (std::size_t i = 0; i < a.polar.size(); ++i)  // fewer points are reported where they are far
    if (a.polar[i].CD.x != b.polar[i].CD.x || a.polar[i].CL != b.polar[i].CL) return false;
  return true;
}

/// Rejected, correct, or reported: a supplement is not used, or a warning is given.
template <class Make, class Whole>
void refused_or_right(const std::string& what, const Make& make, const Whole& right, int& refused) {
  auto part = right;
  const std::string sentence = refusal([&] { part = make(); });
  if (!sentence.empty()) {
    ++refused;
    CHECK_MESSAGE(is_incomplete(sentence), what, ": ", sentence);
    return;
  }
  bool reported = false;
  if constexpr (std::is_same_v<Whole, Input>)
    reported = !part.unused.empty() || !part.doubts.empty();
  else
    reported = part.warnings.size() > right.warnings.size() || (right.xx.known && !part.xx.known);  // assumed
  CHECK_MESSAGE((reported || same(part, right)), what);
}

/// After every line, and in the middle of every line.
template <class Use>
void cut_everywhere(const Format& format, const Use& use) {
  std::size_t begin = 0;
  for (std::size_t end = format.text.find('\n'); end != std::string::npos;
       begin = end + 1, end = format.text.find('\n', end + 1)) {
    use(format.name + " cut at " + std::to_string(end), format.text.substr(0, end + 1));
    use(format.name + " cut in " + std::to_string(end), format.text.substr(0, (begin + end) / 2));
  }
}

template <class Use>
void commas_everywhere(const Format& format, const Use& use) {
  for (std::size_t i = 1; i + 1 < format.text.size(); ++i) {
    const auto digit = [&](std::size_t at) { return format.text[at] >= '0' && format.text[at] <= '9'; };
    if (format.text[i] != '.' || !digit(i - 1) || !digit(i + 1)) continue;
    std::string text = format.text;
    text[i] = ',';
    use(format.name + " with a comma at " + std::to_string(i), text);
  }
}

}  // namespace

TEST_CASE("JSBSim's XML as far as it is products; anything else is refused by its name") {
  const std::string xml = jsbsim_text();
  const Aircraft a = jsbsim_aircraft(lines_of("gull.xml", xml));
  CHECK(a.name == "gull");
  CHECK(a.area_m2.x == Approx(0.9290304));
  CHECK(a.span_m.x == Approx(2.4384));
  CHECK(a.mass_kg.x == Approx(9.0718474));
  CHECK(a.xx.x == Approx(0.5 * 1.3558179));
  CHECK(a.parasite.x == 0.03);
  CHECK(a.c[lift][t_alpha].x == 4.8);
  CHECK(a.c[roll][t_p].x == -0.5);
  CHECK(a.c[roll][t_aileron].x == 0.2);
  CHECK(a.c[pitch][t_q].x == Approx(-12 - 0.1 * 8 / 1.25));
  CHECK(a.c[pitch][t_alpha].x == -0.9);
  const auto refused = [&](const char* old, const char* by) {
    return refusal([&] { jsbsim_aircraft(lines_of("gull.xml", with(xml, old, by))); });
  };
  CHECK(says(refused("<value>0.25</value>", "<sum><value>1</value></sum>"),
             "function 'CLo': aero.function_factor_unsupported(<sum>)"));
  CHECK(says(refused("fcs/left-aileron-pos-rad", "aero/alphadot-rad_sec"),
             "aero.function_factor_unsupported(the property 'aero/alphadot-rad_sec')"));
  CHECK(says(refused("name=\"LIFT\"", "name=\"X\""), "aero.axis_unsupported(X)"));
  CHECK(says(refused("\"LBS\"", "\"STONE\""), "aero.element_unit_unknown(emptywt, STONE, KG, LBS)"));
  CHECK(says(refused("</axis>\n</aerodynamics></fdm_config>", ""), ":13: aero.element_not_closed(axis)"));
  CHECK(says(refused("aero/ci2vel", "metrics/Sw-sqft"), "aero.function_factors_invalid"));
}

TEST_CASE("JSBSim's tables over states are the airframe's, by their units and the lengths of moments") {
  const auto read = [](const std::string& text) { return jsbsim_aircraft(lines_of("gull.xml", text)); };
  // a pitching moment over the span becomes one over the chord: 8 / 1.25
  const Aircraft a = read(with_table("PITCH", by_alpha, "\n-10 0.1\n0 0.0\n10 -0.2\n",
                                     "<value>0.5</value><property>metrics/bw-ft</property>"));
  const std::string row =
      "coefficient: pitch, over: alpha, at: [-0.1745329, 0, 0.1745329], values: [0.32, 0, -0.64]}  # "
      "gull.xml:";
  CHECK(says(a.more_aero, row));
  const fulmar::aero::AirframeFile file = written(a, {}, "gull.yaml").file;
  REQUIRE(file.airframe.aero.tables.size() == 1);
  CHECK(file.airframe.aero.tables[0].values_ratio[2] == Approx(-0.64));
  CHECK(file.airframe.wing.oswald_ratio == 0.9);
  // over two states, drag over alpha and elevator: then the induced drag is in it
  const Aircraft two = read(with_table(
      "DRAG",
      std::string(by_alpha) + "<independentVar lookup=\"column\">fcs/elevator-pos-rad</independentVar>",
      "\n     -0.3   0.3\n-5   0.01   0.02\n\n10   0.05   0.08\n"));
  const std::string both =
      "over: alpha, at: [-0.08726646, 0.1745329], and_over: elevator, and_at: [-0.3, 0.3], "
      "values: [0.01, 0.02, 0.05, 0.08]";
  CHECK(says(two.more_aero, both));
  CHECK(two.oswald.x > 1e5);
  const fulmar::aero::AirframeFile flown = written(two, {}, "gull.yaml").file;
  CHECK(flown.airframe.wing.oswald_ratio > 1e5);
  // the square of the lift gives Oswald's factor: K = 1 / (pi e AR)
  const std::string squared =
      with(jsbsim_text(), "<axis name=\"DRAG\">",
           "<axis name=\"DRAG\"><function "
           "name=\"CDi\"><product><property>aero/qbar-area</property><value>0.06</value>"
           "<property>aero/cl-squared</property></product></function>");
  CHECK(read(squared).oswald.x == Approx(1 / (std::numbers::pi * 0.06 * 6.4)));
  // a linear one is Fulmar's own term
  const Aircraft linear =
      read(with(jsbsim_text(), "<axis name=\"LIFT\"><function name=\"CLo\">",
                "<axis name=\"DRAG\"><function name=\"CDalpha\"><product><property>aero/qbar-"
                "area</property><property>-aero/alpha-rad</property><value>-0.3</value></product>"
                "</function></axis><axis name=\"LIFT\"><function name=\"CLo\">"));
  CHECK(linear.c[drag][t_alpha].x == 0.3);
  CHECK(linear.oswald.x > 1e5);
  const auto refused = [&](const std::string& axis, const std::string& variables, const std::string& data,
                           const std::string& more = "") {
    return refusal([&] { read(with_table(axis, variables, data, more)); });
  };
  CHECK(says(refused("LIFT", by_alpha, "\n1 0.1\n1 0.2\n"), "table_points_not_increasing(1, 1)"));
  CHECK(says(refused("LIFT", by_alpha, "\n1 0.1\n2\n"),
             "function 'tabled': aero.table_row_invalid(2 numbers, 2)"));
  CHECK(says(refused("LIFT", by_alpha, "\n1 0.1\n2 0.2 x\n"), "aero.table_row_invalid(2 numbers, 2 0.2 x)"));
  CHECK(says(refused("LIFT", by_alpha, "\n1 0,1\n2 0,2\n"), "aero.decimal_comma(0,1)"));
  CHECK(says(refused("LIFT", by_alpha, "\n"), "aero.table_empty"));
  CHECK(says(refused("LIFT", "", "\n1 2\n"), "aero.table_variable_missing"));
  CHECK(says(refused("LIFT", "<independentVar>aero/h_b-mac-ft</independentVar>", "\n1 2\n"),
             "aero.table_axis_unsupported(aero/h_b-mac-ft, aero/alpha-rad, "));
  const char* const third = "<independentVar lookup=\"table\">aero/alpha-rad</independentVar>";
  CHECK(says(refused("LIFT", third, "\n1 2\n"), "aero.table_states_unsupported"));
  CHECK(says(refused("LIFT", by_alpha, "\n1 0.1\n2 0.2\n", "<property>aero/beta-rad</property>"),
             "aero.function_product_unsupported"));
  std::string many = "\n";
  for (int i = 0; i < 33; ++i) many += std::to_string(i) + " 0.1\n";
  CHECK(says(refused("LIFT", by_alpha, many), "aero.table_too_large(33, 1)"));
}

TEST_CASE("AVL's machine-readable form and SM are the same aircraft, with the lines of the file") {
  is_tern(aircraft({tern_text("tern_mrf.st")}));
  is_tern(aircraft({tern_text("tern_mrf.sb")}));
  is_tern(aircraft({tern_text("tern.sm")}));
  const Aircraft a = aircraft({tern_text("tern_mrf.st")});
  CHECK(says(a.c[lift][t_alpha].from, "file_0:32 CLa"));
  CHECK(a.name == "Tern");
  const std::string deflected = with(tern_text("tern_mrf.st"), "  0.000000000000000E+00  elevator",
                                     "  2.000000000000000E+00  elevator");
  CHECK(aircraft({deflected}).c[lift][t_zero].x ==
        Approx(0.25 - 0.42 * 2 * std::numbers::pi / 180).epsilon(1e-4));
  const std::string less = with(tern_text("tern_mrf.st"), "  4.800000000000000E+00  0.000000000000000E+00  |",
                                "  4.800000000000000E+00  |");
  CHECK(says(refusal([&] { aircraft({less}); }), "file_0:32: aero.value_count_mismatch(2, CLa, CLb, 1)"));
  for (const std::string count : {"300", "2.5"})
    CHECK(says(refusal([&] {
                 aircraft(
                     {with(tern_text("tern_mrf.st"), "   3  | # control", " " + count + "  | # control")});
               }),
               "aero.count_out_of_range(" + count + ")"));
  // an intermediate version: the axes of Cld and Cnd are unknown
  std::string between;
  std::istringstream in(tern_text("tern_new.st"));
  for (std::string line; std::getline(in, line);)
    if (!says(line, "force CD")) between += line + "\n";
  CHECK(says(aircraft({between}).warnings, "aero.derivative_axes_unknown"));
  CHECK(!says(aircraft({tern_text("tern_new.st")}).warnings, "axes"));
  CHECK(says(
      read_text("SURF\nVERSION 1.0\nStandard\n  1.0 2.0 3.0      | Sref, Cref, Bref\n   3  | # surfaces\n")
          .unused,
      "aero.total_derivatives_missing(ST, SB or SM)"));
}

TEST_CASE("OpenVSP's results as CSV: mass, parasite drag, derivatives") {
  const Input input = read_text(results_text);
  CHECK(input.body.mass_kg.x == 3);
  CHECK(input.body.xz.x == 0.02);
  CHECK(input.body.cg_m[0] == 0.07);
  REQUIRE(input.polar.size() == 1);
  CHECK(input.polar[0].CD.x == 0.022);
  CHECK(says(input.polar[0].CD.from, "tern:16 Total_CD_Total"));
  CHECK(says(input.notes, "aero.results_unused(CompGeom)"));
  CHECK(read_text(results_text, "tern", 0.01).body.xx.x == Approx(0.15e-4));
  CHECK(read_text(drag_text).polar.at(0).CD.x == 0.021);
  CHECK(says(refusal([] { read_text(with(results_text, "Total_CG,0.070000,", "Total_CG,")); }),
             "tern:3: Total_CG: aero.result_count_mismatch(3, 2)"));
  CHECK(says(refusal([] { read_text(with(results_text, "2.2e-02", "nan")); }),
             "tern:16: Total_CD_Total: aero.result_number_expected(nan)"));
  CHECK(says(refusal([] { read_text(with(results_text, "Total_Izz,3.2e-01\n", "")); }),
             "aero.result_row_missing(Total_Izz, Mass_Properties)"));
  CHECK(says(read_text("Results_Name,CompGeom\nTotal_Wet_Area,3\n").unused, "results_missing(CompGeom)"));
  // the rows of a .stab, as ReadStabFile names them
  std::string text =
      "Results_Name,VSPAERO_Stab\nFC_Sref_,0.4\nFC_Cref_,0.26\nFC_Bref_,1.6\nFC_Xcg_,0.07\n"
      "FC_Ycg_,0\nFC_Zcg_,-0.01\nFC_AoA_,3\nFC_Beta_,0\nFC_Rho_,1.225\nFC_Vinf_,15\n";
  std::istringstream in(tern_text("tern.stab"));
  bool table = false;
  for (std::string line; std::getline(in, line);) {
    table = table || says(line, "Derivative:");
    const std::vector<std::string> words = words_of(line);
    if (!table || words.size() < 12 || words[0][0] != 'C' || words[0] == "Coef") continue;
    constexpr std::array<const char*, 11> columns{
        "Total", "Alpha", "Beta", "p", "q", "r", "Mach", "U", "AILERON", "ELEVATOR GROUP", "RUDDER"};
    for (std::size_t k = 0; k < columns.size(); ++k)
      text += words[0] + "_" + columns[k] + "," + words[k + 1] + "\n";
  }
  is_tern(aircraft({text}), 1e-6);
  CHECK(says(refusal([&] { aircraft({with(text, "FC_Sref_,0.4", "FC_Sref_,0")}); }),
             "FC_Sref_: aero.positive_value_expected(0)"));
  CHECK(says(refusal([&] { aircraft({with(text, "FC_Beta_,0", "FC_Beta_,4")}); }),
             "result_sideslip(FC_Beta_)"));
}

TEST_CASE("a file that is cut off is refused, told, or is the same without its tail") {
  int refused = 0;
  for (const Format& format : derivative_files()) {
    const int before = refused;
    const Aircraft full = aircraft({format.text});
    cut_everywhere(format, [&](const std::string& what, const std::string& text) {
      refused_or_right(
          what, [&] { return aircraft({text}); }, full, refused);
    });
    CHECK_MESSAGE(refused - before > 20, format.name);
  }
  for (const Format& format : whole_files()) {
    const int before = refused;
    const Aircraft full = whole(format.text, format.name);
    cut_everywhere(format, [&](const std::string& what, const std::string& text) {
      if (is_jsbsim(lines_of("", text)) || is_rosflight(lines_of("", text)))
        refused_or_right(
            what, [&] { return whole(text, format.name); }, full, refused);
    });
    CHECK_MESSAGE((refused - before > 5 || says(format.name, ".yaml")), format.name);
  }
  for (const Format& format : supplements()) {
    const Input full = read_text(format.text, format.name);
    CHECK_MESSAGE((full.unused.empty() && full.doubts.empty()), format.name, full.unused);
    cut_everywhere(format, [&](const std::string& what, const std::string& text) {
      refused_or_right(
          what, [&] { return read_text(text, format.name); }, full, refused);
    });
  }
}

TEST_CASE("one number with a decimal comma is refused, or is one that is not used") {
  int refused = 0;
  for (const Format& format : derivative_files()) {
    if (says(format.name, ".log") || says(format.name, "new")) continue;  // all are of the same reader
    const Aircraft full = aircraft({format.text});
    commas_everywhere(format, [&](const std::string& what, const std::string& text) {
      refused_or_right(
          what, [&] { return aircraft({text}); }, full, refused);
    });
  }
  for (const Format& format : whole_files()) {
    const Aircraft full = whole(format.text, format.name);
    commas_everywhere(format, [&](const std::string& what, const std::string& text) {
      refused_or_right(
          what, [&] { return whole(text, format.name); }, full, refused);
    });
  }
  for (const Format& format : supplements()) {
    const int before = refused;
    const Input full = read_text(format.text, format.name);
    commas_everywhere(format, [&](const std::string& what, const std::string& text) {
      refused_or_right(
          what, [&] { return read_text(text, format.name); }, full, refused);
    });
    CHECK_MESSAGE(refused > before, format.name);
  }
  CHECK(refused > 300);
}

}  // namespace import_formats_test

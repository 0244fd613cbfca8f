// SPDX-License-Identifier: BSD-3-Clause
// `fulmar aero vlm`: drawings, rejections, files of AVL and XFLR5, and the Petrel in flight.
#include "tools/fulmar_aero/airframe_file.hpp"
#include "tools/fulmar_aero/test/aero_kit.hpp"
#include "tools/fulmar_aero/vlm/aircraft.hpp"
#include "tools/fulmar_aero/vlm/planform.hpp"

namespace command_test {

using namespace fulmar::aero;
using fulmar::aero::test::Answer;
using fulmar::aero::test::call;
using fulmar::aero::test::Folder;
using fulmar::aero::test::text_of;

namespace {

const std::string petrel = FULMAR_SOURCE_DIR "/configs/drawings/petrel.yaml";
const std::string merlin = FULMAR_SOURCE_DIR "/tools/fulmar_aero/vlm/test/merlin.yaml";

std::string with(std::string text, const std::string& old, const std::string& by) {
  const std::size_t at = text.find(old);
  REQUIRE(at != std::string::npos);
  return text.replace(at, old.size(), by);
}
int line_of(const std::string& text, const std::string& what) {
  return 1 + int(std::count(text.begin(), text.begin() + std::ptrdiff_t(text.find(what)), '\n'));
}

const char* const avl_text =
    "Merlin's wing\n0.0\n0 0 0.0\n0.51348 0.25928 2.0\n0.085 0 -0.02\n0.020\nSURFACE\nwing\n6 1.0 10 "
    "1.0\nYDUPLICATE\n0\n"
    "ANGLE\n2.0\nSECTION\n0 0 0 0.28 0\nNACA\n2412\nSECTION\n0.005 0.55 0.0288 0.26 0\nNACA\n2412\nCONTROL\n"
    "aileron -1.0 0.75 0 0 0 -1.0\nSECTION # a remark\n0.024 1.0 0.0524 0.2 0\nNACA\n2412\nCONTROL\naileron "
    "-1.0 0.75 0 0 0 -1.0\n"
    "SURFACE\nhtail\n4 1.0 6 1.0\nYDUPLICATE\n0\nANGLE\n-1.5\nTRANSLATE\n0.9 0 0\nSECTION\n0 0 0 0.16 "
    "0\nCONTROL\n"
    "elevator 1.0 0.65 0 0 0 1.0\nSECTION\n0.01 0.3 0 0.14 0\nCONTROL\nelevator 1.0 0.65 0 0 0 1.0\n";

const char* const xml_text =
    "<?xml version=\"1.0\"?>\n<explane "
    "version=\"1.0\">\n<Units><length_unit_to_meter>0.001</length_unit_to_meter>"
    "<mass_unit_to_kg>0.001</mass_unit_to_kg></Units>\n<Plane>\n<Name>Merlin</"
    "Name>\n<Inertia><Point_Mass><Tag>all</Tag>"
    "<Mass>4500</Mass><coordinates>85, 0, -20</coordinates></Point_Mass></Inertia>\n<wing><Name>wing</Name>"
    "<Position>0, 0, "
    "0</Position><Tilt_angle>2.0</Tilt_angle><Symetric>true</Symetric><isFin>false</isFin>\n<Sections>\n"
    "<Section><y_position>0</y_position><Chord>280</Chord><xOffset>0</xOffset><Dihedral>3</"
    "Dihedral><Twist>0</Twist>"
    "<x_number_of_panels>6</x_number_of_panels><y_number_of_panels>5</y_number_of_panels>\n"
    "<Left_Side_FoilName>NACA 2412</Left_Side_FoilName><Right_Side_FoilName>NACA "
    "2412</Right_Side_FoilName></Section>\n"
    "<Section><y_position>1000</y_position><Chord>200</Chord><xOffset>24</xOffset><Dihedral>0</"
    "Dihedral><Twist>-1</Twist>\n"
    "<Left_Side_FoilName>NACA 2412</Left_Side_FoilName><Right_Side_FoilName>NACA "
    "2412</Right_Side_FoilName></Section>\n"
    "</Sections></wing>\n<wing><Name>fin</Name><Position>880, 0, 0</Position><isFin>true</isFin><Sections>\n"
    "<Section><y_position>0</y_position><Chord>180</Chord><Left_Side_FoilName>NACA 0012</Left_Side_FoilName>"
    "<Right_Side_FoilName>NACA "
    "0012</Right_Side_FoilName></Section>\n<Section><y_position>240</y_position><Chord>120</Chord>"
    "<xOffset>50</xOffset><Left_Side_FoilName>NACA 0012</Left_Side_FoilName><Right_Side_FoilName>NACA "
    "0012</Right_Side_FoilName>"
    "</Section></Sections></wing>\n</Plane>\n</explane>\n";

}  // namespace

TEST_CASE("what is wrong with a drawing is told with its line") {
  const Folder folder;
  const std::string good = text_of(petrel);
  struct Bad {
    const char *old, *by, *at, *sentence;
  };
  const std::vector<Bad> all{
      {"reference: {area", "# {area", nullptr, "aero.reference_missing"},
      {"chord: 0.16 m", "chord: -0.16 m", "chord: 0.16 m",
       "graph.value_out_of_range(-0.16 m, 0.001, 1000,  m, )"},
      {"y: 0.9 m", "y: 0.3 m", "y: 0.9 m", "aero.sections_crossing(0.45 m, 0.3 m)"},
      {"y: 0.9 m", "y: -0.9 m", "y: 0.9 m", "aero.section_on_left(-0.9 m)"},
      {"to: 0.86 m", "to: 1.2 m", "to: 0.86 m", "aero.control_outside_surface(0.5 m, 1.2 m, wing, "},
      {"to: 0.86 m", "to: 0.4 m", "to: 0.86 m", "aero.control_reversed(0.4 m, 0.5 m)"},
      {"controls:\n      - {drives: aileron",
       "controls:\n      - {drives: aileron, from: 0.4 m, to: 0.6 m, hinge: 0.7}\n      - {drives: aileron",
       nullptr, "surfaces[0].controls[1]: aero.controls_overlap(0.5 m, 0.86 m, 0, 0.4 m, 0.6 m, wing)"},
      {"incidence: 2 deg", "incidense: 2 deg", "incidence: 2 deg",
       "graph.field_unknown(surfaces[0]: , incidense, LiftingSurface,  Did you mean 'incidence'? "},
      {"spanwise: 20", "spanwise: 0", "spanwise: 20", "graph.value_out_of_range(0, 1, 200, , )"},
      {"spanwise: 20", "spanwise: -1", "spanwise: 20", "graph.value_out_of_range(-1, 1, 200, , )"},
      {"spanwise: 20", "spanwise: 1000000", "spanwise: 20", "graph.value_out_of_range(1000000, 1, 200, , )"},
      {"chordwise: 8", "chordwise: 0", "chordwise: 8", "graph.value_out_of_range(0, 1, 40, , )"},
      {"chordwise: 8\n    spanwise: 20", "chordwise: 40\n    spanwise: 60", "  - name: wing", ", 4000)"},
      {"airfoil: wing}", "airfoil: wink}", "airfoil: wing}",
       "aero.airfoil_unknown(wink,  [wing] wing, tail)"},
      {"naca: \"2412\"", "naca: \"24x2\"", "naca: \"2412\"", "aero.naca_digits_invalid(24x2)"},
      {"naca: \"2412\", ", "", "naca: \"2412\"", "aero.airfoil_shape_invalid(wing, 0)"},
      {"drives: rudder", "drives: elevator", "drives: rudder", "aero.surface_upright(fin)"},
      {"drives: elevator", "drives: rudder", "drives: elevator", "aero.surface_flat(tailplane)"},
      {"drives: elevator", "drives: spoiler", "drives: elevator", "spoiler"},
      {"area: 0.3969 m^2", "area: 3.969 m^2", "reference:", "aero.reference_area_mismatch(3.969, "},
      {"span: 1.8 m", "span: 0.9 m", "reference:", "aero.reference_span_mismatch(0.9 m, 1.8 m)"},
      {"name: tailplane", "name: wing", "  - name: tailplane", "aero.name_repeated(wing)"},
      {"area: 0.3969 m^2", "area: 0.3969 m",
       "reference:", "graph.dimension_differs(0.3969 m, a length, , an area)"},
      {"drives: aileron", "drives: flap", "surfaces:", "aero.aileron_control_missing"},
      {"airspeed_cruise: 15 m/s", "airspeed_cruise: 4 m/s",
       "limits:", "aero.cruise_lift_unreachable(4, 2.5, "},
  };
  for (const Bad& bad : all) {
    CAPTURE(bad.by);
    const std::string file = folder.write("bad.yaml", with(good, bad.old, bad.by));
    const Answer answer = call("vlm " + file);
    CHECK(answer.code == 4);
    CHECK_MESSAGE(answer.says(bad.sentence), answer.out);
    if (bad.at) {
      const int line = line_of(good, bad.at);
      const bool there = answer.says("bad.yaml:" + std::to_string(line)) ||
                         answer.says("bad.yaml:" + std::to_string(line + 1));
      CHECK_MESSAGE(there, answer.out << " line " << line);
    }
  }
}

TEST_CASE("the Petrel: mass, trim, check; the file says what was computed") {
  const Folder folder;
  const std::string out = (folder.path / "petrel.yaml").string();
  const Answer answer = call("vlm " + petrel + " --json -o " + out);
  REQUIRE_MESSAGE(answer.code == 0, answer.out);
  const auto json = answer.json();
  CHECK(json["mass_kg"].get<double>() == doctest::Approx(2.5).epsilon(1e-9));
  CHECK(json["warning"] == "");
  const AirframeFile file = read_airframe_file(out);
  const fulmar::Airframe& a = file.airframe;
  const auto& d = json["derivatives"];
  CHECK(a.aero.lift.alpha_ratio == doctest::Approx(d["alpha"]["CL"].get<double>()).epsilon(1e-4));
  CHECK(a.aero.pitch.q_ratio == doctest::Approx(d["q"]["Cm"].get<double>()).epsilon(1e-4));
  CHECK(a.aero.yaw.rudder_ratio == doctest::Approx(d["rudder"]["Cn"].get<double>()).epsilon(1e-4));
  CHECK(a.aero.roll.aileron_ratio == doctest::Approx(d["aileron"]["Cl"].get<double>()).epsilon(1e-4));
  const double alpha = json["alpha_deg"].get<double>() * 0.017453292519943295;
  CHECK(a.aero.lift.zero_ratio + a.aero.lift.alpha_ratio * alpha ==
        doctest::Approx(d["value"]["CL"].get<double>()).epsilon(1e-4));
  CHECK(a.aero.pitch.zero_ratio + a.aero.pitch.alpha_ratio * alpha ==
        doctest::Approx(d["value"]["Cm"].get<double>()).epsilon(1e-3));
  CHECK(a.aero.side.beta_ratio ==
        doctest::Approx(json["lattice"]["beta"]["CY"].get<double>() - a.aero.parasite_drag_ratio -
                        (d["alpha"]["CL"].get<double>() - json["lattice"]["alpha"]["CL"].get<double>()))
            .epsilon(1e-3));
  // body and propeller take static margin
  CHECK(d["alpha"]["Cm"].get<double>() > json["lattice"]["alpha"]["Cm"].get<double>() + 0.05);
  CHECK(a.wing.oswald_ratio > 0.75);
  CHECK(a.wing.oswald_ratio < 1);
  CHECK(a.limits.airspeed_min_mps > 11);
  CHECK(a.limits.airspeed_min_mps < 14);
  const Answer check = call("check " + out);
  CHECK_MESSAGE(check.code == 0, check.out);
  CHECK_MESSAGE(check.says("no fault, no warning"), check.out);
  // the trims are the steady flight's
  const auto trim = call("trim " + out + " --json").json();
  CHECK(a.elevator.trim_rad ==
        doctest::Approx(trim["elevator_deg"].get<double>() * 0.017453292519943295).epsilon(0.02));
  CHECK(a.limits.throttle_cruise_frac == doctest::Approx(trim["throttle_frac"].get<double>()).epsilon(0.002));
}

TEST_CASE("more panels change little, and few are told when they do" * doctest::test_suite("amounts")) {
  const auto list = call("vlm " + petrel + " --convergence --json").json()["convergence"];
  REQUIRE(list.size() == 4);
  for (const char* over : {"alpha", "q"})
    CHECK(list[2]["derivatives"][over]["Cm"].get<double>() ==
          doctest::Approx(list[3]["derivatives"][over]["Cm"].get<double>()).epsilon(0.01));
  CHECK(list[2]["panels"].get<int>() < list[3]["panels"].get<int>());
  const Folder folder;
  // a second wing a few centimetres above the first: panels are longer than they are apart
  const std::string text = text_of(petrel);
  const std::size_t wing = text.find("  - name: wing\n"), end = text.find("    controls:", wing);
  std::string second = with(text.substr(wing, end - wing), "name: wing", "name: second");
  second = with(with(second, "    mass: 0.62 kg\n", ""), "    mirror: true\n",
                "    mirror: true\n    z: 0.02 m\n");
  const Answer answer = call(
      "vlm " + folder.write("few.yaml", with(text, "  - name: tailplane", second + "  - name: tailplane")));
  CHECK(answer.code == 0);
  CHECK_MESSAGE(answer.says("warning  aero.lattice_not_converged("), answer.out);
  // a hinge among few panels: the lift is right, the power of the control is not
  const Answer coarse =
      call("vlm " + folder.write("coarse.yaml", with(with(text, "chordwise: 6", "chordwise: 2"),
                                                     "chordwise: 8", "chordwise: 3")));
  CHECK_MESSAGE(coarse.says("aero.control_not_converged(Cm_elevator, "), coarse.out);
  CHECK(!coarse.says("aero.lattice_not_converged"));
  CHECK(!call("vlm " + petrel).says("not_converged"));
}

TEST_CASE("surfaces of an AVL file: the same flow as drawn") {
  const Folder folder;
  folder.write("wing.avl", avl_text);
  auto g = std::make_unique<Geometry>();
  add_planform((folder.path / "wing.avl").string(), "wing.avl", *g);
  CHECK(g->reference.area_m2 == 0.51348);
  CHECK(g->reference.span_m == 2);
  CHECK(g->reference.chord_m == 0.25928);
  REQUIRE(g->surfaces.size() == 2);
  CHECK(g->surfaces[0].mirror);
  REQUIRE(g->surfaces[0].controls.size() == 1);
  CHECK(g->surfaces[0].controls[0].from_m == doctest::Approx(std::hypot(0.55, 0.0288)).epsilon(1e-12));
  CHECK(g->surfaces[0].sections[2].chord_m == 0.2);
  CHECK(g->surfaces[1].sections[1].x_m == doctest::Approx(0.91).epsilon(1e-12));
  CHECK(g->airfoils.size() == 1);
  const SixDerivatives d =
      Vlm(lattice_of(*g), g->reference, {0.085, 0, -0.02}).derivatives({.alpha = 0.0349});
  // without its fin Merlin lifts and pitches as with it
  CHECK(d.alpha.CL == doctest::Approx(5.0611).epsilon(0.02));
  CHECK(d.alpha.Cm == doctest::Approx(-1.1128).epsilon(0.04));
  CHECK(d.control[to_elevator].Cm == doctest::Approx(-1.5377).epsilon(0.06));
  CHECK(d.control[to_aileron].Cl > 0.2);

  struct Bad {
    const char *old, *by, *sentence;
  };
  for (const Bad& bad :
       {Bad{"CONTROL\nelevator", "CONTROL\ncanard", "aero.control_name_unknown(canard)"},
        Bad{"0 0 0.0\n0.51", "1 0 0.0\n0.51", "wing.avl:3: aero.symmetry_plane_unsupported"},
        Bad{"elevator 1.0", "elevator 2.0", "aero.control_gain_unsupported(elevator, 2)"},
        Bad{"ANGLE\n-1.5", "NOWAKE\n-1.5", "aero.planform_keyword_unsupported(NOWAKE)"},
        Bad{"CONTROL\nelevator", "CONTROL\nrudder", "aero.control_section_single(rudder)"},
        Bad{"0.024 1.0", "0.024 one",
            "aero.planform_numbers_missing(0.024 one 0.0524 0.2 0, 5, Xle Yle Zle Chord Ainc)"},
        Bad{"0 0 0 0.28 0", "0 0 0 -0.28 0", "aero.section_chord_invalid(-0.28)"},
        Bad{"NACA\n2412", "NACA\n24x2", "aero.naca_digits_invalid(24x2)"},
        Bad{"NACA\n2412", "AFILE\nnone.dat", "none.dat: aero.airfoil_not_readable"}}) {
    CAPTURE(bad.by);
    folder.write("bad.avl", with(avl_text, bad.old, bad.by));
    auto other = std::make_unique<Geometry>();
    CHECK_THROWS_WITH(add_avl((folder.path / "bad.avl").string(), "wing.avl", *other),
                      doctest::Contains(bad.sentence));
  }
  std::filesystem::create_directory(folder.path / "none.dat");
  auto other = std::make_unique<Geometry>();
  CHECK_THROWS_WITH(add_avl((folder.path / "bad.avl").string(), "wing.avl", *other),
                    "none.dat: aero.airfoil_not_readable");
  CHECK_THROWS_WITH(add_avl((folder.path / "none.dat").string(), "wing.avl", *other),
                    "graph.file_is_folder(wing.avl)");
  CHECK_THROWS_WITH(add_xflr5((folder.path / "none.dat").string(), "plane.xml", *other),
                    "graph.file_is_folder(plane.xml)");
}

TEST_CASE("surfaces, masses and units of an XFLR5 file") {
  const Folder folder;
  folder.write("plane.xml", xml_text);
  auto g = std::make_unique<Geometry>();
  add_planform((folder.path / "plane.xml").string(), "plane.xml", *g);
  REQUIRE(g->surfaces.size() == 2);
  const LiftingSurface &wing = g->surfaces[0], &fin = g->surfaces[1];
  CHECK(wing.incidence_rad == doctest::Approx(2 * 0.017453292519943295).epsilon(1e-9));
  CHECK(wing.sections[1].y_m == doctest::Approx(std::cos(3 * 0.017453292519943295)).epsilon(1e-9));
  CHECK(wing.sections[1].z_m == doctest::Approx(std::sin(3 * 0.017453292519943295)).epsilon(1e-9));
  CHECK(wing.sections[1].chord_m == doctest::Approx(0.2).epsilon(1e-9));
  CHECK(wing.sections[1].twist_rad == doctest::Approx(-0.017453292519943295).epsilon(1e-9));
  CHECK_FALSE(fin.mirror);
  CHECK(fin.sections[1].z_m == doctest::Approx(0.24).epsilon(1e-9));
  CHECK(fin.sections[1].x_m == doctest::Approx(0.93).epsilon(1e-9));
  CHECK(std::abs(fin.sections[1].y_m) < 1e-12);
  REQUIRE(g->masses.size() == 1);
  CHECK(g->masses[0].mass_kg == doctest::Approx(4.5).epsilon(1e-9));
  CHECK(g->masses[0].z_m == doctest::Approx(-0.02).epsilon(1e-9));
  for (const auto& [old, by, sentence] :
       {std::array{"NACA 2412</Left", "Clark Y</Left", "aero.airfoil_pair_unsupported"},
        std::array{"<Symetric>true", "<Symetric>false", "aero.asymmetric_wing_unsupported"},
        std::array{"<Chord>280", "<Chord>x",
                   "plane.xml:9: aero.element_numbers_invalid(Chord, x, 1,  number)"},
        std::array{"<Chord>280</Chord>", "", "plane.xml:9: aero.element_missing(Section, Chord)"},
        std::array{"<Chord>280", "<Chord>-200", "plane.xml:9: aero.chord_not_positive(-0.2)"},
        std::array{"</Plane>", "</Plain>", "</Plain> ends <Plane>"},
        std::array{"<Name>Merlin</Name>", "<has_body>true</has_body>", "aero.plane_body_unsupported"}}) {
    const std::string why = sentence;
    CAPTURE(why);
    folder.write("bad.xml", with(xml_text, old, by));
    auto other = std::make_unique<Geometry>();
    CHECK_THROWS_WITH(add_xflr5((folder.path / "bad.xml").string(), "plane.xml", *other),
                      doctest::Contains(why.c_str()));
  }
}

TEST_CASE("a drawing names a file of another program, and controls on it") {
  const Folder folder;
  folder.write("plane.xml", xml_text);
  folder.write("wing.avl", avl_text);
  const std::string rest = text_of(merlin).substr(text_of(merlin).find("masses:"));
  const Answer avl =
      call("vlm " + folder.write("a.yaml", "name: merlin\nplanform: wing.avl\n" + rest) + " --json");
  REQUIRE_MESSAGE(avl.code == 0, avl.out);
  CHECK(avl.json()["mass_kg"] == 4.5);
  const Answer both =
      call("vlm " + folder.write("b.yaml", "name: merlin\nplanform: wing.avl\nsurfaces: []\n" + rest));
  CHECK(both.code == 4);
  CHECK(both.says("b.yaml:2: aero.surfaces_and_planform"));
  const Answer none = call("vlm " + folder.write("c.yaml", "name: merlin\nplanform: plane.xml\n" + rest));
  CHECK(none.code == 4);
  CHECK(none.says("aero.reference_missing"));
  const Answer where =
      call("vlm " + folder.write("d.yaml",
                                 "name: m\nplanform: wing.avl\ncontrols:\n  - {surface: winc, "
                                 "control: {drives: flap, from: 0 m, to: 0.3 m}}\n" +
                                     rest));
  CHECK(where.code == 4);
  CHECK_MESSAGE(where.says("d.yaml:4: aero.surface_unknown(controls[0], 'winc',  [wing] wing, htail)"),
                where.out);
}

TEST_CASE("the mean line of a coordinate file") {
  const Folder folder;
  std::string text = "NACA 2412\n";  // without thickness above: the mean line plus and minus 0.06 sin
  const auto mean = [](double x) {
    return x < 0.4 ? 0.125 * (0.8 * x - x * x) : 0.02 / 0.36 * (0.2 + 0.8 * x - x * x);
  };
  for (int i = 40; i >= -40; --i) {
    const double x = std::abs(i) / 40.0;
    text += std::to_string(x) + " " +
            std::to_string(mean(x) + (i < 0 ? -1 : 1) * 0.06 * std::sin(3.14159265 * x)) + "\n";
  }
  Airfoil a;
  read_camber(folder.write("a.dat", text), "a.dat", a);
  CHECK(a.thickness_frac == doctest::Approx(0.12).epsilon(0.01));
  REQUIRE(a.camber_x_frac.size() == 21);
  for (std::size_t i = 0; i < 21; ++i) CHECK(std::abs(a.camber_z_frac[i] - mean(a.camber_x_frac[i])) < 2e-5);
  CHECK_THROWS_WITH(read_camber(folder.write("b.dat", text + "2.0 x\n"), "b.dat", a),
                    doctest::Contains("aero.airfoil_point_invalid(b.dat, 83, 2.0 x)"));
}

TEST_CASE("from a drawing to a flown mission: vlm, then fly" * doctest::test_suite("amounts")) {
  const Folder folder;
  const std::string out = (folder.path / "petrel.yaml").string();
  REQUIRE(call("vlm " + petrel + " -o " + out).code == 0);
  const Answer answer = call("fly " + out + " --write");
  CHECK_MESSAGE(answer.code == 0, answer.out);
  CHECK(answer.says("no fault, no warning"));
  CHECK(answer.says("aero.flight_condition(steady level flight, 15, 0)"));
  CHECK(answer.says("Dutch roll"));
  CHECK(answer.says("aero.hourglass_result(flown"));
  CHECK(text_of(out).find("params:") != std::string::npos);
}

TEST_CASE("fly ends at what has a fault") {
  const Folder folder;
  const Answer answer =
      call("fly " + folder.write("a.yaml", with(text_of(FULMAR_SOURCE_DIR "/configs/airframes/anaconda.yaml"),
                                                "aileron: 0.17, ", "aileron: -0.17, ")));
  CHECK(answer.code == 1);
  CHECK(answer.says("aero.flight_skipped(check)"));
  CHECK_FALSE(answer.says("aero.hourglass"));
}

}  // namespace command_test

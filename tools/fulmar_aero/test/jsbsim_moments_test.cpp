// SPDX-License-Identifier: BSD-3-Clause
// JSBSim's moments about the centre of gravity, compared with products of forces and arms.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "fulmar/flight/math/tables.hpp"
#include "tools/fulmar_aero/findings.hpp"
#include "tools/fulmar_aero/import/import.hpp"
#include "tools/fulmar_aero/import/rosflight.hpp"
#include "tools/fulmar_aero/test/import_kit.hpp"

namespace jsbsim_moments_test {
using namespace fulmar::aero;
using namespace fulmar::aero::imports;
using doctest::Approx;
using fulmar::aero::test::refusal;
using fulmar::aero::test::says;

namespace {

std::string function(const std::string& name, const std::string& factors) {
  return "<function name=\"" + name + "\"><product><property>aero/qbar-area</property>" + factors +
         "</product></function>";
}
std::string term(const std::string& name, const std::string& lengths, const std::string& state,
                 const std::string& value) {
  return function(name, lengths + (state.empty() ? "" : "<property>" + state + "</property>") + "<value>" +
                            value + "</value>");
}

/// A gull of 8 by 1.25 ft; places in inches, `lifting` as functions.
std::string gull(const std::string& point, const std::string& centre, const std::string& lifting) {
  const std::string b = "<property>metrics/bw-ft</property>", c = "<property>metrics/cbarw-ft</property>";
  const auto place = [](const std::string& name, const std::string& xyz) {
    return xyz.empty() ? "" : "<location name=\"" + name + "\" unit=\"IN\">" + xyz + "</location>";
  };
  return "<fdm_config name=\"gull\"><metrics><wingarea>10</wingarea><wingspan>8</wingspan>"
         "<chord>1.25</chord>" +
         place("AERORP", point) + "</metrics>\n<mass_balance><ixx>0.5</ixx><iyy>0.6</iyy><izz>1.0</izz>" +
         "<emptywt>14</emptywt>" + place("CG", centre) +
         "</mass_balance>\n<aerodynamics><axis name=\"LIFT\">" + lifting + "</axis><axis name=\"DRAG\">" +
         term("CD0", "", "", "0.03") + "</axis><axis name=\"SIDE\">" +
         term("CYb", "", "aero/beta-rad", "-0.5") + "</axis><axis name=\"PITCH\">" +
         term("Cma", c, "aero/alpha-rad", "-0.3") + term("Cmde", c, "fcs/elevator-pos-rad", "-1.2") +
         term("Cmq", c + "<property>aero/ci2vel</property>", "velocities/q-aero-rad_sec", "-12") +
         "</axis><axis name=\"ROLL\">" + term("Clb", b, "aero/beta-rad", "-0.06") +
         term("Clda", b, "fcs/left-aileron-pos-rad", "0.2") +
         term("Clp", b + "<property>aero/bi2vel</property>", "velocities/p-aero-rad_sec", "-0.45") +
         "</axis><axis name=\"YAW\">" + term("Cnb", b, "aero/beta-rad", "0.08") +
         term("Cnr", b + "<property>aero/bi2vel</property>", "velocities/r-aero-rad_sec", "-0.1") +
         "</axis></aerodynamics></fdm_config>\n";
}
const std::string straight = term("CL0", "", "", "0.25") + term("CLa", "", "aero/alpha-rad", "4.8") +
                             term("CLde", "", "fcs/elevator-pos-rad", "0.4");
const std::string table = function(
    "CLa",
    "<table><independentVar>aero/alpha-rad</independentVar><tableData>\n-0.2 -0.75\n0 0.25\n0.24 1.4\n</"
    "tableData></table>");
const std::string behind = "<x>38</x><y>0</y><z>2</z>", ahead = "<x>35</x><y>0</y><z>6</z>";

Aircraft read(const std::string& text) { return jsbsim_aircraft(lines_of("gull.xml", text)); }

/// Along the body's axes at this angle, times their arms: 3 in aft, 4 in below.
double pitching(double CL, double CD, double x) {
  const double N = CL * std::cos(x) + CD * std::sin(x), A = CD * std::cos(x) - CL * std::sin(x);
  const double aft = 3 * 0.0254, up = -4 * 0.0254;
  return (A * up - N * aft) / (1.25 * 0.3048);
}

}  // namespace

TEST_CASE("moments of JSBSim are about AERORP, and move to the centre of gravity") {
  const Aircraft at_once = read(gull(behind, behind, straight)), a = read(gull(behind, ahead, straight));
  CHECK(at_once.c[pitch][t_alpha].x == -0.3);
  const auto whole = [](double x) {
    const double CL = 0.25 + 4.8 * x, CD = 0.03 + CL * CL / (std::numbers::pi * 6.4 * 0.9);
    return pitching(CL, CD, x);
  };
  const double b = 8 * 0.3048, h = 1e-5;
  CHECK(a.c[pitch][t_zero].x / whole(0) == Approx(1));
  CHECK((a.c[pitch][t_alpha].x + 0.3) / ((whole(h) - whole(-h)) / (2 * h)) == Approx(1).epsilon(1e-6));
  CHECK((a.c[pitch][t_elevator].x + 1.2) / pitching(0.4, 0, 0) == Approx(1));
  CHECK(a.c[yaw][t_beta].x == Approx(0.08 + 0.5 * 3 * 0.0254 / b));
  CHECK(a.c[roll][t_beta].x == Approx(-0.06 + 0.5 * 4 * 0.0254 / b));
  CHECK(a.c[pitch][t_q].x == -12);  // no force by rates, no moment of it
  CHECK(says(a.c[pitch][t_alpha].from, "gull.xml:3 Cma, moved"));
  CHECK(says(a.notes.back(), "aero.moments_moved(0.0762, -0.102)"));
  CHECK(says(read(gull("", ahead, straight)).notes.back(), "aero.moment_reference_missing(AERORP)"));
  CHECK(says(read(gull(behind, "", straight)).notes.back(), "aero.moment_reference_missing(CG)"));
  CHECK(says(read(gull(behind, "<x>38</x><y>1</y><z>2</z>", straight)).warnings.back(),
             "aero.moment_reference_beside"));
  CHECK(says(refusal([] { read(gull("<x>1</x><z>0</z>", ahead, straight)); }),
             "aero.child_element_missing(location, y)"));
}

TEST_CASE("a lift that is a table has a line that laws are made from; what is left of it moves as a table") {
  const Aircraft a = read(gull(behind, ahead, table)), still = read(gull(behind, behind, table));
  CHECK(still.c[lift][t_alpha].x == Approx((1.4 - 0.25) / 0.24));
  CHECK(still.c[lift][t_zero].x == Approx(0.25));
  const fulmar::Airframe moved = written(a, {}, "gull.yaml").file.airframe;
  REQUIRE(moved.aero.tables.size() == 2);
  const auto total = [&](const fulmar::Derivatives& d, std::size_t of, double x) {
    const fulmar::TablePoint<double> at{0, x, 0, 0, 0, 0, 0};
    return d.zero_ratio + d.alpha_ratio * x + fulmar::value_of<double>(moved.aero.tables[of], at);
  };
  for (const double x : {-0.2, -0.01, 0.0, 0.01, 0.24}) {
    CAPTURE(x);
    const double CL = x < 0 ? 0.25 + 5 * x : 0.25 + (1.4 - 0.25) / 0.24 * x;
    CHECK(total(moved.aero.lift, 0, x) == Approx(CL).epsilon(1e-6));
    // what is straight stays so: the arm above times CL_alpha x^2 is left out, 1.3 x^2 here
    const double CD = 0.03 + 0.25 * (2 * CL - 0.25) / (std::numbers::pi * 6.4 * 0.9);
    CHECK(std::abs(total(moved.aero.pitch, 1, x) - (-0.3 * x + pitching(CL, CD, x))) < 1.4 * x * x + 1e-6);
  }
}

TEST_CASE("the check looks at the slopes of tables at cruise") {
  const Imported plain = written(read(gull(behind, behind, straight)), {}, "gull.yaml");
  const auto findings = [&](double slope) {
    std::string text = plain.text;
    const std::string aero = "aero:\n";
    text.insert(text.find(aero) + aero.size(),
                "  tables: [{coefficient: lift, over: alpha, at: [-0.4, 0.4], values: [" +
                    std::to_string(-0.4 * slope) + ", " + std::to_string(0.4 * slope) + "]}]\n");
    const AirframeFile file = airframe_of_text(text, "gull.yaml");
    Findings f(file);
    check_derivatives(f);
    check_stability(f);
    double margin = 0;
    for (const Figure& figure : f.figures())
      if (figure.key == "static_margin_ratio") margin = figure.value;
    return std::pair<double, bool>(margin, f.has("aero.lift.alpha_ratio"));
  };
  CHECK(findings(1).first == Approx(0.3 / 5.8));
  CHECK(findings(-1).first == Approx(0.3 / 3.8));
  CHECK_FALSE(findings(1).second);
  CHECK(findings(-5).second);  // -0.2 in all: a fault as without a table
  CHECK(findings(3).second);
}

TEST_CASE("more tables than an airframe has, with those of the moments, are refused") {
  std::string five;
  for (int i = 0; i < 5; ++i) five += table;
  CHECK(read(gull(behind, behind, five)).notes.size() > 0);
  CHECK(says(refusal([&] { read(gull(behind, ahead, five)); }), "aero.too_many_moment_tables(10)"));
}

}  // namespace jsbsim_moments_test

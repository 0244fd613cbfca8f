// SPDX-License-Identifier: BSD-3-Clause
// Pages of `fulmar aero see`, read back from where their curves are drawn, beside what other commands say.
#include "tools/fulmar_aero/see/test/page_kit.hpp"
#include "tools/fulmar_aero/test/aero_kit.hpp"

namespace fulmar::aero::test {
namespace {

const std::string airframes = FULMAR_SOURCE_DIR "/configs/airframes/",
                  petrel_drawing = FULMAR_SOURCE_DIR "/configs/drawings/petrel.yaml";

/// Anaconda and Petrel, of which the second one is drawn: made once.
const std::string& both() {
  static const std::string page = [] {
    const Folder folder;
    const std::string out = (folder.path / "both.html").string();
    const Answer answer = call("see " + airframes + "anaconda.yaml " + petrel_drawing + " -o " + out);
    CHECK_MESSAGE(answer.code == 0, answer.out);
    CHECK(answer.says("written: "));
    return text_of(out);
  }();
  return page;
}

nlohmann::json json_of(const std::string& words) {
  const Answer answer = call(words + " --json");
  REQUIRE_MESSAGE(answer.code == 0, answer.out);
  return answer.json();
}

TEST_CASE("the page keeps what pages keep, and has both sets in every chart of figures") {
  check_page(both());
  const std::vector<ReadChart> charts = read_charts(both());
  for (const char* title :
       {"Lift", "Drag", "Pitching moment", "Lift to drag", "Polar", "Angle of attack in level flight",
        "Elevator in level flight", "Throttle in level flight", "Climb at full throttle"}) {
    const ReadChart chart = chart_named(charts, title);
    INFO(title);
    CHECK(chart.all("line s0").size() >= 1);
    CHECK(chart.all("line s1").size() >= 1);
    CHECK(std::count(chart.legend.begin(), chart.legend.end(), "anaconda") == 1);
    CHECK(std::count(chart.legend.begin(), chart.legend.end(), "petrel") == 1);
  }
  CHECK(both().find("aero.surfaces_not_in_file(anaconda)") != std::string::npos);
  CHECK(both().find("petrel: surfaces and lattice") != std::string::npos);
}

TEST_CASE("trim curves lie where `trim --json` says") {
  const std::vector<ReadChart> charts = read_charts(both());
  struct Row {
    const char *title, *key;
  };
  for (const double speed : {12.0, 17.0, 26.0}) {
    const nlohmann::json trim =
        json_of("trim " + airframes + "anaconda.yaml --airspeed '" + std::to_string(speed) + " m/s'");
    for (const Row& row :
         {Row{"Angle of attack in level", "alpha_deg"}, Row{"Elevator in level", "elevator_deg"},
          Row{"Throttle in level", "throttle_frac"}}) {
      INFO(row.title << " at " << speed);
      const ReadChart chart = chart_named(charts, row.title);
      const double wanted = trim.at(row.key).get<double>();
      // there is a point at that speed itself, but for half a pixel
      double nearest = 1e9, value = 0;
      for (const ChartPoint& p : chart.all("line s0").at(0).points())
        if (std::abs(p.x - speed) < nearest) {
          nearest = std::abs(p.x - speed);
          value = p.y;
        }
      CHECK(nearest < 0.5 * chart.x_per_px);
      CHECK(std::abs(value - wanted) < 0.5 * chart.y_per_px);
    }
    const ReadChart glide = chart_named(charts, "Lift to drag in level");
    const double ratio = trim.at("lift_newton").get<double>() / trim.at("drag_newton").get<double>();
    CHECK(std::abs(value_at(glide.all("line s0").at(0).points(), speed) - ratio) < glide.y_per_px);
  }
}

TEST_CASE("modes lie where `modes --json` says") {
  const ReadChart all = chart_named(read_charts(both()), "Modes in level flight");
  const ReadChart slow = chart_named(read_charts(both()), "Phugoid and spiral");
  const auto is_drawn = [](const ReadChart& chart, double real, double imag) {
    for (const ReadCurve& line : chart.all("line s0"))
      for (const ChartPoint& p : line.points())
        if (std::abs(p.x - real) < 0.5 * chart.x_per_px && std::abs(p.y - imag) < 0.5 * chart.y_per_px)
          return true;
    return false;
  };
  const nlohmann::json modes =
      json_of("modes " + airframes + "anaconda.yaml --airspeed '12..27 m/s' --step '5 m/s'");
  REQUIRE(modes.at("speeds").size() == 4);
  for (const nlohmann::json& at : modes.at("speeds"))
    for (const nlohmann::json& mode : at.at("modes")) {
      const double real = mode.at("real_per_s").get<double>(), imag = mode.at("imag_radps").get<double>();
      INFO(at.at("airspeed_mps") << " m/s " << mode.at("mode"));
      CHECK(is_drawn(all, real, imag));
      const std::string name = mode.at("mode").get<std::string>();
      CHECK(is_drawn(slow, real, imag) == (name == "phugoid" || name == "spiral"));
    }
  for (const char* name : {"short period", "phugoid", "Dutch roll", "roll", "spiral"})
    CHECK(std::count(all.legend.begin(), all.legend.end(), name) == 1);
}

TEST_CASE("polars are those of the file's coefficients") {
  const std::vector<ReadChart> charts = read_charts(both());
  const double degree = 3.14159265358979 / 180;
  for (const double alpha :
       {-4.0, 0.0, 6.0}) {  // the file's figures; (4.9) of Beard & McLain is straight there
    INFO(alpha);
    const double CL = 0.506 + 5.61 * alpha * degree, AR = 2.08 * 2.08 / 0.52,
                 CD = 0.043 + CL * CL / (3.14159265358979 * 0.9 * AR), Cm = 0.135 - 2.74 * alpha * degree;
    const auto near = [&](const char* title, double wanted) {
      const ReadChart chart = chart_named(charts, title);
      CHECK(std::abs(value_at(chart.all("line s0").at(0).points(), alpha) - wanted) < chart.y_per_px);
    };
    near("Lift", CL);
    near("Drag", CD);
    near("Pitching moment", Cm);
    near("Lift to drag", CL / CD);
  }
}

TEST_CASE("the envelope ends where trim ends") {
  const ReadChart chart = chart_named(read_charts(both()), "Climb at full throttle");
  const std::vector<ReadCurve> lines = chart.all("line s0");
  REQUIRE(lines.size() == 2);
  const std::string trim = "trim " + airframes + "anaconda.yaml --airspeed '20 m/s' --climb '";
  const auto is_flown = [&](double rate) { return call(trim + std::to_string(rate) + " m/s'").code == 0; };
  const double climb = value_at(lines[0].points(), 20), glide = value_at(lines[1].points(), 20),
               px = chart.y_per_px;
  CHECK(climb > 3);
  CHECK(is_flown(climb - px));
  CHECK_FALSE(is_flown(climb + px));
  CHECK(glide < -1);
  CHECK(is_flown(glide + px));
  CHECK_FALSE(is_flown(glide - px));
  // level flight ends where full throttle no longer climbs, and the wing stalls where `trim` says so
  const nlohmann::json checked = json_of("check " + airframes + "anaconda.yaml").at("figures");
  CHECK(std::abs(value_at(lines[0].points(), checked.at("fastest_airspeed_mps").get<double>())) < px);
  const ChartPoint stall = chart.all("mark s0").at(0).points().at(0);  // the upper corner of its mark
  CHECK(std::abs(stall.x - checked.at("stall_airspeed_mps").get<double>()) < chart.x_per_px);
}

TEST_CASE("lift over the span adds up to the lattice's lift, and stalls where vlm says" *
          doctest::test_suite("amounts")) {
  const std::vector<ReadChart> charts = read_charts(both());
  const ReadChart load = chart_named(charts, "Lift over the span");
  const nlohmann::json vlm = json_of("vlm " + petrel_drawing);
  double lift = 0;
  for (const ReadCurve& line : load.all("line s1")) {
    const std::vector<ChartPoint> points = line.points();
    for (std::size_t i = 1; i < points.size(); ++i)
      lift += 0.5 * (points[i].y + points[i - 1].y) * (points[i].x - points[i - 1].x);
    CHECK(std::abs(points.front().y - points.back().y) < 2 * load.y_per_px);  // left and right are alike
  }
  const double CL = vlm.at("lattice").at("value").at("CL").get<double>();
  CHECK(lift * 0.2228 / 0.3969 == doctest::Approx(CL).epsilon(0.02));
  // whatever the chord is to which it refers
  const Folder folder;
  std::string text = text_of(petrel_drawing);
  const std::string chord = "chord: 0.2228 m}";
  REQUIRE(text.find(chord) != std::string::npos);
  text.replace(text.find(chord), chord.size(), "chord: 0.26 m}");
  const std::string other = folder.write("other.yaml", text), page = (folder.path / "p.html").string();
  REQUIRE(call("see " + other + " -o " + page).code == 0);
  double same = 0;
  for (const ReadCurve& line : chart_named(read_charts(text_of(page)), "Lift over the span").all("line s0")) {
    const std::vector<ChartPoint> points = line.points();
    for (std::size_t i = 1; i < points.size(); ++i)
      same += 0.5 * (points[i].y + points[i - 1].y) * (points[i].x - points[i - 1].x);
  }
  CHECK(same * 0.26 == doctest::Approx(lift * 0.2228).epsilon(0.01));
  // at the stall one section has its most lift, and none has more by a step of angle
  const ReadChart stall = chart_named(charts, "Sections where");
  const std::vector<ChartPoint> cl = stall.all("line s1").at(0).points(),
                                most = stall.all("line s1 thin").at(0).points();
  double nearest = 1e9;
  for (std::size_t i = 0; i < cl.size(); ++i) nearest = std::min(nearest, most.at(i).y - cl[i].y);
  CHECK(nearest < stall.y_per_px);
  CHECK(nearest > -0.02);
}

TEST_CASE("a drawing whose surfaces are in another program's file is seen as if they stood in it") {
  const Folder folder;
  const std::string drawn = text_of(FULMAR_SOURCE_DIR "/tools/fulmar_aero/vlm/test/merlin.yaml");
  std::string rest = drawn.substr(drawn.find("masses:"));
  const std::string cruise = "airspeed_cruise: 16";
  rest.replace(rest.find(cruise), cruise.size(), "airspeed_cruise: 20");
  const auto section = [](const std::string& at, const std::string& more) {
    return "SECTION\n" + at + "\n" + more;
  };
  const std::string aileron = "CONTROL\naileron -1 0.75 0 0 0 -1\n",
                    elevator = "CONTROL\nelevator 1 0.6 0 0 0 1\n";
  folder.write("wing.avl",
               "Gull\n0\n0 0 0\n0.545 0.25 2.2\n0.07 0 0\n0.02\nSURFACE\nwing\n4 1 8 1\nYDUPLICATE\n0\n"
               "ANGLE\n2\n" +
                   section("0 0 0 0.3 0", "") + section("0.02 0.5 0 0.25 0", aileron) +
                   section("0.05 1.1 0 0.2 0", aileron) +
                   "SURFACE\ntail\n4 1 4 1\nYDUPLICATE\n0\nTRANSLATE\n0.9 0 0\n" +
                   section("0 0 0 0.15 0", elevator) + section("0.01 0.35 0 0.12 0", elevator));
  const std::string drawing = folder.write("far.yaml", "name: gull\nplanform: wing.avl\n" + rest);
  const std::string out = (folder.path / "p.html").string();
  const Answer answer = call("see " + drawing + " -o " + out);
  REQUIRE_MESSAGE(answer.code == 0, answer.out);
  const std::string page = text_of(out);
  check_page(page);
  const ReadChart above = chart_named(read_charts(page), "surfaces and lattice");
  double right = -10, left = 10, wing_tip_x = 10;  // y to the right along the page's x
  for (const ReadCurve& curve : above.all("line s0"))
    for (const ChartPoint& point : curve.points()) {
      right = std::max(right, point.x);
      left = std::min(left, point.x);
      if (point.x > 1.099) wing_tip_x = std::min(wing_tip_x, std::abs(point.y));
    }
  CHECK(std::abs(right - 1.1) < 2 * above.x_per_px);
  CHECK(std::abs(left + 1.1) < 2 * above.x_per_px);
  CHECK(std::abs(wing_tip_x - 0.05) < 2 * above.y_per_px);
  CHECK(chart_named(read_charts(page), "Lift over the span").all("line s0").size() >= 1);
  // the file that is named is read from beside the drawing; without it a sentence has its line
  folder.write("none.yaml", "name: gull\nplanform: wind.avl\n" + rest);
  const Answer none = call("see " + (folder.path / "none.yaml").string() + " -o " + out);
  CHECK(none.code == 4);
  CHECK(none.says("none.yaml:2: aero.planform_missing(wind.avl)"));
}

TEST_CASE("a hostile name stays text; two of one name are told apart by their files") {
  const Folder folder;
  const std::string evil = "</title><script>x</script>";
  const std::string a =
      folder.write("a.yaml", changed("aerosonde", "name: aerosonde", "name: \"" + evil + "\""));
  const std::string b = folder.write("b&.yaml", text_of(a)), out = (folder.path / "p.html").string();
  const Answer answer = call("see " + a + " '" + b + "' -o " + out);
  REQUIRE_MESSAGE(answer.code == 0, answer.out);
  const std::string page = text_of(out);
  CHECK(page.find("<script") == std::string::npos);
  CHECK(page.find("<title>&lt;/title&gt;&lt;script&gt;x&lt;/script&gt;") != std::string::npos);
  CHECK(page.find("b&amp;.yaml)") != std::string::npos);
  CHECK(unbalanced(page) == "");
}

TEST_CASE("an aircraft without level flight is shown as far as it goes") {
  const Folder folder;
  const std::string out = (folder.path / "p.html").string();
  const std::string heavy = folder.write("heavy.yaml", changed("anaconda", "mass: 4.5 kg", "mass: 400 kg"));
  const Answer answer = call("see " + heavy + " " + airframes + "x8.yaml -o " + out);
  CHECK(answer.code == 1);
  CHECK(answer.says("aero.flight_impossible(aero.flight_condition(steady level flight, 17, 0), "));
  const std::string page = text_of(out);
  check_page(page);
  CHECK(page.find("<p class=\"fault\">" + heavy +
                  ": aero.flight_impossible(aero.flight_condition(steady level "
                  "flight, 17, 0)") != std::string::npos);
  CHECK(chart_named(read_charts(page), "Elevator in level").all("line s0").empty());
  CHECK(chart_named(read_charts(page), "Elevator in level").all("line s1").size() == 1);
  // alone it has no curve there, and a sentence in its place
  CHECK(call("see " + heavy + " -o " + out).code == 1);
  CHECK(text_of(out).find("<p>aero.level_flight_missing</p>") != std::string::npos);
}

TEST_CASE("what cannot be seen is refused in a sentence") {
  const Folder folder;
  for (const char* words : {"see", "see a b c d e f g"}) CHECK_MESSAGE(call(words).code == 2, words);
  CHECK(call("see " + airframes + "x8.yaml --altitude 99999 -o " + folder.path.string() + "/p.html").code ==
        2);
  const Answer missing = call("see nowhere.yaml -o " + folder.path.string() + "/p.html");
  CHECK(missing.code == 4);
  CHECK(missing.says("nowhere.yaml"));
  const std::string drawing = folder.write("d.yaml", "name: a\nsurfaces: []\n");
  CHECK(call("see " + drawing + " -o " + folder.path.string() + "/p.html").code == 4);
  CHECK_FALSE(std::filesystem::exists(folder.path / "p.html"));
  // an airframe is not replaced by its own page
  const std::string mine = folder.write("mine.yaml", text_of(airframes + "x8.yaml")), before = text_of(mine);
  for (const std::string word : {"see ", "fly "}) {
    const Answer own = call(word + mine + " -o " + folder.path.string() + "/./mine.yaml");
    CHECK(own.code == 4);
    CHECK(own.says("aero.page_is_input(" + folder.path.string() + "/./mine.yaml)"));
    CHECK(text_of(mine) == before);
  }
  const Answer unwritten = call("see " + airframes + "x8.yaml -o " + folder.path.string() + "/no/p.html");
  CHECK(unwritten.code != 0);
  CHECK(unwritten.says("aero.picture_not_writable(" + folder.path.string() + "/no/p.html)"));
}

TEST_CASE("the same files give the same page" * doctest::test_suite("amounts")) {
  const std::string first = both();
  const Folder folder;
  const std::string out = (folder.path / "again.html").string();
  REQUIRE(call("see " + airframes + "anaconda.yaml " + petrel_drawing + " -o " + out).code == 0);
  CHECK(text_of(out) == first);
}

}  // namespace
}  // namespace fulmar::aero::test

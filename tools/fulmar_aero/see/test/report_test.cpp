// SPDX-License-Identifier: BSD-3-Clause
// The page that `fulmar aero fly` leaves.
#include "tools/fulmar_aero/see/test/page_kit.hpp"
#include "tools/fulmar_aero/test/aero_kit.hpp"

namespace fulmar::aero::test {
namespace {

TEST_CASE("what was printed stands on the page, and the track goes round the plan" *
          doctest::test_suite("amounts")) {
  const Folder folder;
  const std::string airframe = (folder.path / "petrel.yaml").string(),
                    report = (folder.path / "report.html").string();
  REQUIRE(call("vlm " FULMAR_SOURCE_DIR "/configs/drawings/petrel.yaml -o " + airframe).code == 0);
  const Answer answer = call("fly " + airframe + " --write -o " + report);
  REQUIRE_MESSAGE(answer.code == 0, answer.out);
  const std::string page = text_of(report);
  const std::string& printed = answer.out;
  check_page(page);
  CHECK(page.find("<strong>aero.flight_acceptable</strong>") != std::string::npos);
  CHECK(page.find("class=\"fault\"") == std::string::npos);
  for (const char* figure : {"position", "height", "airspeed", "roll", "pitch", "course", "least airspeed"}) {
    const std::size_t at =
        printed.find(std::string("\n  ") + figure, printed.find("aero.hourglass_result(flown)"));
    REQUIRE(at != std::string::npos);
    const double value = std::stod(printed.substr(at + 19));
    char text[32];
    std::snprintf(text, sizeof text, "</th><td>%.2f</td>", value);
    CHECK_MESSAGE(page.find("<th>" + std::string(figure) + ", ") != std::string::npos, figure);
    CHECK_MESSAGE(page.find(text) != std::string::npos, figure);
  }
  CHECK(page.find("<th>control_slc/Inner.roll_kp</th>") != std::string::npos);
  CHECK(page.find("<th>TECS height</th>") != std::string::npos);
  const std::vector<ReadChart> charts = read_charts(page);
  const ReadChart ground = chart_named(charts, "Ground track");
  CHECK(std::abs(ground.x_per_px / ground.y_per_px - 1) < 0.01);
  const std::vector<ChartPoint> flown = ground.all("line s0").at(0).points();
  const double k = (15.0 * 15) / (17 * 17);  // the plan for 15 m/s
  for (const auto& [north, east] : {std::pair{400, -250}, {-400, -50}, {-400, -250}, {400, -50}}) {
    double nearest = 1e9;
    for (const ChartPoint& p : flown)
      nearest = std::min(nearest, std::hypot(p.x - k * east, p.y - k * north));
    CHECK(nearest < 50);  // corners are flown as fillets
    CHECK(nearest > 2);
  }
  // cruise: where it was commanded to be
  for (const char* title : {"Height", "Airspeed"}) {
    const ReadChart chart = chart_named(charts, title);
    const double t = 100, off = value_at(chart.all("line s0").at(0).points(), t) -
                                value_at(chart.all("line s1").at(0).points(), t);
    CHECK_MESSAGE(std::abs(off) < 2, title);
  }
  CHECK(value_at(chart_named(charts, "Height").all("line s0").at(0).points(), 100) ==
        doctest::Approx(70).epsilon(0.03));
  const std::vector<ChartPoint> roll = chart_named(charts, "Roll").all("line s0").at(0).points();
  double most = 0;
  for (const ChartPoint& p : roll) most = std::max(most, std::abs(p.y));
  CHECK(most > 15);  // degrees
  CHECK(most < 60);
}

TEST_CASE("a flight that does not come about has a page that says why") {
  const Folder folder;
  const std::string report = (folder.path / "report.html").string();
  const Answer answer =
      call("fly " + folder.write("a.yaml", changed("anaconda", "aileron: 0.17, ", "aileron: -0.17, ")) +
           " -o " + report);
  CHECK(answer.code == 1);
  CHECK(answer.says("aero.flight_skipped(check)"));
  const std::string page = text_of(report);
  check_page(page);
  CHECK(page.find("<strong>aero.flight_skipped(check)</strong>") != std::string::npos);
  CHECK(page.find("<p class=\"fault\">Fault: ") != std::string::npos);
  CHECK(page.find("Ground track") == std::string::npos);
}

}  // namespace
}  // namespace fulmar::aero::test

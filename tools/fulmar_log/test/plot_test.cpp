// SPDX-License-Identifier: BSD-3-Clause
// fulmar plot of logs: the figure is read back and compared with the log's export.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <sstream>

#include "tools/fulmar_log/export_log.hpp"
#include "tools/fulmar_log/test/plotted_log.hpp"

namespace plot_test {

/// A column of `fulmar log export --to csv`.
struct Exported {
  std::vector<std::string> head;
  std::vector<std::vector<double>> rows;
  std::vector<double> column(const std::string& name) const {
    const auto at = std::find(head.begin(), head.end(), name) - head.begin();
    REQUIRE(std::size_t(at) < head.size());
    std::vector<double> values;
    for (const auto& row : rows) values.push_back(row[std::size_t(at)]);
    return values;
  }
};
Exported exported(const std::string& log, const std::string& topic, const std::filesystem::path& out) {
  core::export_log(log, core::ExportForm::csv, out, {topic});
  std::string file = topic.substr(1);
  std::replace(file.begin(), file.end(), '/', '.');
  std::istringstream text(core::test::contents(out / (file + ".csv")));
  Exported all;
  for (std::string line; std::getline(text, line);) {
    std::vector<std::string> cells;
    std::istringstream in(line);
    for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
    if (all.head.empty()) {
      all.head = cells;
      continue;
    }
    all.rows.emplace_back();
    for (const std::string& cell : cells) all.rows.back().push_back(std::strtod(cell.c_str(), nullptr));
  }
  return all;
}

/// A figure is drawn to a thousandth of a millimetre; its scale is read from numbers as far apart as they go.
void check_same(const ReadPanel& panel, const std::vector<Point>& points, const std::vector<double>& x,
                const std::vector<double>& y, double factor) {
  REQUIRE(points.size() == x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    CHECK(std::abs(points[i].x - x[i]) < 0.002 * panel.x_per_mm);
    CHECK(std::abs(points[i].y - factor * y[i]) < 0.002 * panel.y_per_mm);
  }
}

TEST_CASE("the values of a figure are those of the log's export, radians in degrees, a panel per unit") {
  const Folder folder;
  const std::string log = Flight{}.write(folder.path / "a.mcap");
  const Exported csv = exported(log, "/nav/state", folder.path / "csv");
  const ReadFigure f =
      drawn({.words = {log, "nav.state.height_m", "nav.state.roll_rad", "nav.state.position_m.east",
                       "nav.state.rates_degps.north", "slc.error_m"}});
  CHECK(f.title == "a");
  CHECK(f.x_words == "time [s]");
  CHECK(f.wide_mm == 160);
  CHECK(f.high_mm == 190);
  REQUIRE(f.panels.size() == 3);
  CHECK(f.panels[0].y_words == "[m]");
  CHECK(f.panels[1].y_words == "roll [deg]");
  CHECK(f.panels[2].y_words == "rates north [deg/s]");
  CHECK(f.panels[0].legend ==
        std::vector<std::string>{"nav.state.height_m", "nav.state.position_m.east", "slc.error_m"});
  CHECK(f.panels[1].legend == std::vector<std::string>{"nav.state.roll_deg"});
  const std::vector<double> t = csv.column("valid_s");
  CHECK(t[1] == doctest::Approx(0.099));
  check_same(f.panels[0], f.panels[0].curves[0].points(), t, csv.column("height_m"), 1);
  check_same(f.panels[0], f.panels[0].curves[1].points(), t, csv.column("position_m.east"), 1);
  check_same(f.panels[1], f.panels[1].curves[0].points(), t, csv.column("roll_rad"), 1 / degree);
  check_same(f.panels[2], f.panels[2].curves[0].points(), t, csv.column("rates_radps.north"), 1 / degree);
  const Exported probes = exported(log, "/slc/probes", folder.path / "csv2");
  check_same(f.panels[0], f.panels[0].curves[2].points(), probes.column("valid_s"), probes.column("error_m"),
             1);
}

TEST_CASE("an angle that jumps by a turn and a value that is no number part a curve; a flag holds") {
  const Folder folder;
  Flight flight;
  flight.change = [](int i, State& s) {
    if (i == 20) s.height_m = nowhere;
  };
  const std::string log = flight.write(folder.path / "a.mcap");
  const std::string svg =
      svg_of({.words = {log, "nav.state.yaw_deg", "nav.state.height_m", "nav.state.mode"}});
  const ReadFigure f = read_figure(svg);
  REQUIRE(f.panels.size() == 3);
  std::size_t turns = 0;
  for (int i = 1; i < 61; ++i) turns += std::abs(Flight::at(i).yaw_rad - Flight::at(i - 1).yaw_rad) > 3;
  CHECK(turns == 4);
  CHECK(f.panels[0].curves[0].parts.size() == turns + 1);
  CHECK(f.panels[0].curves[0].points().size() == 61);
  REQUIRE(f.panels[1].curves[0].parts.size() == 2);
  CHECK(f.panels[1].curves[0].parts[0].size() == 20);
  CHECK(f.panels[1].curves[0].parts[1].size() == 40);
  CHECK(f.panels[2].y_words == "mode");
  const std::vector<Point> mode = f.panels[2].curves[0].points();
  REQUIRE(mode.size() == 62);  // one corner
  CHECK(mode[30].y == doctest::Approx(0).scale(1));
  CHECK(mode[31].y == doctest::Approx(0).scale(1));
  CHECK(mode[31].x == doctest::Approx(3.099).epsilon(1e-4));
  CHECK(mode[32].x == doctest::Approx(3.099).epsilon(1e-4));
  CHECK(mode[32].y == doctest::Approx(1).epsilon(1e-3));
}

TEST_CASE(
    "of a long flight what can be seen is drawn: peaks of one sample stay, and each point is a sample") {
  const Folder folder;
  Flight flight;
  flight.samples = 20000;
  flight.hz = 400;
  flight.change = [](int i, State& s) {
    s.height_m = i == 7003 ? 500 : i == 15009 ? -300 : 100 + std::sin(i);
  };
  const std::string log = flight.write(folder.path / "a.mcap");
  const ReadFigure f = drawn({.words = {log, "nav.state.height_m"}});
  const std::vector<Point> points = f.panels[0].curves[0].points();
  CHECK(points.size() < 4 * 1500);
  CHECK(points.size() > 1000);
  const ReadPanel& panel = f.panels[0];
  const auto high = std::max_element(points.begin(), points.end(), [](auto a, auto b) { return a.y < b.y; });
  const auto low = std::min_element(points.begin(), points.end(), [](auto a, auto b) { return a.y < b.y; });
  CHECK(std::abs(high->y - 500) < 0.002 * panel.y_per_mm);
  CHECK(std::abs(high->x - (7003 / 400.0 - 0.001)) < 0.002 * panel.x_per_mm);
  CHECK(std::abs(low->y + 300) < 0.002 * panel.y_per_mm);
  CHECK(std::abs(low->x - (15009 / 400.0 - 0.001)) < 0.002 * panel.x_per_mm);
  CHECK(std::is_sorted(points.begin(), points.end(), [](auto a, auto b) { return a.x < b.x; }));
  int strangers = 0;
  for (const Point& p : points) {
    const int i = static_cast<int>(std::lround((p.x + 0.001) * 400));
    State s = Flight::at(i);
    flight.change(i, s);
    strangers += std::abs(p.y - s.height_m) > 0.002 * panel.y_per_mm;
  }
  CHECK(strangers == 0);
  CHECK(points.front().x < 0.01);
  CHECK(points.back().x > 49.98);
}

TEST_CASE("phases are bands of all panels, with their names; texts of a log are no markup") {
  const Folder folder;
  Flight flight;
  flight.phases = {"climb", "<b>\"&\x01\xff", "land"};
  const std::string log = flight.write(folder.path / "a<&>.mcap");
  const std::string svg = svg_of({.words = {log, "nav.state.height_m", "nav.state.roll_deg"}});
  CHECK(svg.find("<b>") == std::string::npos);
  CHECK(svg.find('\x01') == std::string::npos);
  CHECK(svg.find('\xff') == std::string::npos);
  const ReadFigure f = read_figure(svg);
  CHECK(f.title == "a&lt;&amp;&gt;");
  const std::string escaped = "&lt;b&gt;&quot;&amp; ?";
  CHECK(f.phase_words == std::vector<std::string>{"climb", escaped, "land"});
  for (const ReadPanel& panel : f.panels) {
    REQUIRE(panel.bands.size() == 3);
    CHECK(panel.bands[0].name == "climb");
    CHECK(panel.bands[0].to == doctest::Approx(2.1).epsilon(1e-3));
    CHECK(panel.bands[1].from == doctest::Approx(2.1).epsilon(1e-3));
    CHECK(panel.bands[1].to == doctest::Approx(4.1).epsilon(1e-3));
    CHECK(panel.bands[2].to == doctest::Approx(5.999).epsilon(1e-3));
  }
  CHECK(drawn({.words = {log, "nav.state.height_m"}, .no_phases = true}).panels[0].bands.size() == 0);
  const ReadFigure part = drawn({.words = {log, "nav.state.height_m"}, .from_s = 1.5, .to_s = 3.0});
  REQUIRE(part.panels[0].bands.size() == 2);
  CHECK(part.panels[0].bands[0].from == doctest::Approx(1.5).epsilon(1e-3));
  CHECK(part.panels[0].curves[0].points().front().x == doctest::Approx(1.599).epsilon(1e-3));
  CHECK(part.panels[0].curves[0].points().back().x == doctest::Approx(2.999).epsilon(1e-3));
}

TEST_CASE(
    "a track has one scale; a field of another port is interpolated; a dot names each curve's own port") {
  const Folder folder;
  const std::string log = Flight{}.write(folder.path / "a.mcap");
  const ReadFigure f = drawn({.words = {log, "nav.state.position_m.north"},
                              .over = "nav.state.position_m.east",
                              .size = "120x100mm"});
  CHECK(f.wide_mm == 120);
  CHECK(f.high_mm == 100);
  CHECK(f.x_words == "position east [m]");
  CHECK(f.panels[0].y_words == "position north [m]");
  CHECK(f.panels[0].bands.size() == 0);
  CHECK(f.panels[0].x_per_mm == doctest::Approx(f.panels[0].y_per_mm).epsilon(1e-4));
  for (const Point& p : f.panels[0].curves[0].points())
    CHECK(std::hypot(p.x / 30, p.y / 50) == doctest::Approx(1).epsilon(1e-3));
  // the probe has every second sample: 0.01 m a sample, so that the others lie in the middle
  const ReadFigure other = drawn({.words = {log, "nav.state.height_m"}, .over = "slc.error_m"});
  const std::vector<Point> points = other.panels[0].curves[0].points();
  REQUIRE(points.size() == 61);
  for (int i = 0; i < 61; ++i)
    CHECK(std::abs(points[std::size_t(i)].x - 0.01 * i) < 0.004 * other.panels[0].x_per_mm);
  const ReadFigure own = drawn({.words = {log, "nav.state.position_m.north"}, .over = ".position_m.east"});
  CHECK(own.panels[0].curves[0].points().size() == f.panels[0].curves[0].points().size());
  CHECK(refused({.words = {log, "slc.error_m"}, .over = ".position_m.east", .out = "x.svg"}) ==
        log + ": log_tool.subfield_unknown(slc, position_m,  [] error_m)");
}

TEST_CASE("a track of north over east has the plan behind it, unless it is not wanted") {
  const Folder folder;
  Flight flight;
  flight.route = {{-40, 60}, {-40, -60}, {45, 0}};
  const std::string log = flight.write(folder.path / "a.mcap");
  LogPlotArguments words{.words = {log, "nav.state.position_m.north"}, .over = ".position_m.east"};
  const ReadFigure f = drawn(words);
  CHECK(f.panels[0].legend == std::vector<std::string>{"nav.state.position_m.north", "plan"});
  REQUIRE(f.panels[0].curves.size() == 2);
  CHECK(f.panels[0].curves[0].name == "plan");  // under the other one
  const std::vector<Point> plan = f.panels[0].curves[0].points();
  REQUIRE(plan.size() == 3);
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(std::abs(plan[i].x - flight.route[i][0]) < 0.01 * f.panels[0].x_per_mm);
    CHECK(std::abs(plan[i].y - flight.route[i][1]) < 0.01 * f.panels[0].y_per_mm);
  }
  words.no_plan = true;
  CHECK(drawn(words).panels[0].curves.size() == 1);
  CHECK(drawn({.words = {log, "nav.state.position_m.down"}, .over = ".position_m.east"})
            .panels[0]
            .curves.size() == 1);
}

TEST_CASE(
    "several logs in one figure, by name; panels as they are asked for; units in the legend where they "
    "differ") {
  const Folder folder;
  Flight flight;
  const std::string a = flight.write(folder.path / "a.mcap");
  flight.change = [](int, State& s) { s.height_m += 7; };
  const std::string b = flight.write(folder.path / "b.mcap");
  const ReadFigure f = drawn({.words = {a, b, "nav.state.height_m"},
                              .panels = {"nav.state.roll_deg,nav.state.height_m", "slc.error_m"},
                              .names = "old,new"});
  REQUIRE(f.panels.size() == 3);
  CHECK(f.panels[0].y_words == "height [m]");
  CHECK(f.panels[0].legend == std::vector<std::string>{"old", "new"});
  const std::vector<Point> first = f.panels[0].curves[0].points(), second = f.panels[0].curves[1].points();
  REQUIRE(first.size() == second.size());
  for (std::size_t i = 0; i < first.size(); ++i)
    CHECK(std::abs(second[i].y - first[i].y - 7) < 0.004 * f.panels[0].y_per_mm);
  CHECK(f.panels[1].y_words == "");
  CHECK(f.panels[1].legend ==
        std::vector<std::string>{"old: nav.state.roll_deg [deg]", "new: nav.state.roll_deg [deg]",
                                 "old: nav.state.height_m [m]", "new: nav.state.height_m [m]"});
  CHECK(f.panels[2].curves.size() == 2);
  const ReadFigure labelled = drawn({.words = {a, b, "nav.state.height_m"},
                                     .panels = {"nav.state.roll_deg,slc.error_m"},
                                     .labels = "height,roll angle,error"});
  CHECK(labelled.panels[0].legend == std::vector<std::string>{"a", "b"});
  CHECK(labelled.panels[1].legend == std::vector<std::string>{"a: roll angle [deg]", "b: roll angle [deg]",
                                                              "a: error [m]", "b: error [m]"});
  CHECK(drawn({.words = {a, "slc.error_m"}, .labels = "<e>"}).panels[0].legend.at(0) == "&lt;e&gt;");
  CHECK(drawn({.words = {a, b, "slc.error_m"}}).panels[0].legend == std::vector<std::string>{"a", "b"});
  std::vector<std::string> notes;
  flight.phases = {"climb"};
  const std::string c = flight.write(folder.path / "c.mcap");
  plot::log_figure({.words = {a, c, "slc.error_m"}}, notes);
  REQUIRE(notes.size() == 1);
  CHECK(notes[0] == "log_tool.phases_differ(" + a + ", " + c + ")");
}

}  // namespace plot_test

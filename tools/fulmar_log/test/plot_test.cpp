// SPDX-License-Identifier: BSD-3-Clause
// fulmar plot of logs: the figure is read back, and held against the log's export.
#include <doctest/doctest.h>
#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <sstream>

#include "core/log/events.hpp"
#include "core/log/test/log_kit.hpp"
#include "tools/fulmar_log/export_log.hpp"
#include "tools/fulmar_log/log_field.hpp"
#include "tools/fulmar_log/plot_log.hpp"
#include "tools/fulmar_log/test/figure_kit.hpp"

namespace plot_test {

using namespace fulmar;
using core::test::Folder;
using plot::LogPlotWords;

constexpr double degree = std::numbers::pi / 180;
constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();

struct State {
  double height_m, roll_rad, yaw_rad;
  core::test::Vector position_m, rates_radps;
  std::array<char, 8> name;
  core::test::Items<double, 4> levels_volt;
  std::uint8_t mode;
};
core::TypePtr state_type() {
  using namespace core::test;
  using Levels = Items<double, 4>;
  return make_type(
      "State", sizeof(State), 8,
      {number("height_m", offsetof(State, height_m), "m"),
       number("roll_rad", offsetof(State, roll_rad), "rad"),
       number("yaw_rad", offsetof(State, yaw_rad), "rad"),
       nested("position_m", vector_type(), offsetof(State, position_m), "m"),
       nested("rates_radps", vector_type(), offsetof(State, rates_radps), "rad/s"),
       scalar("name", FULMAR_TEXT, offsetof(State, name), 8),
       list(number("levels_volt", offsetof(State, levels_volt), "V"), 4, offsetof(Levels, items)),
       label("mode", {"idle", "fly"}, offsetof(State, mode))});
}

/// Samples of /nav/state and /slc/probes, 1 ms old, at `hz` from 0 s on; the phases that are named, in equal
/// parts of the time.
struct Flight {
  int samples = 61;
  double hz = 10;
  std::vector<std::string> phases{"climb", "cruise"};
  std::vector<std::array<double, 2>> route{};  // x, y
  std::function<void(int, State&)> change = [](int, State&) {};

  static State at(int i) {
    const double a = 0.1 * i;
    return {100 + 10 * std::sin(a),
            0.3 * std::cos(a),
            std::remainder(0.4 * i, 2 * std::numbers::pi),
            {50 * std::cos(a), 30 * std::sin(a), -100},
            {0.1 * a, -0.02 * a, 0.5},
            {"plane"},
            {static_cast<std::uint32_t>(i % 3), {1.5 + i, 2.5, 0, 0}},
            std::uint8_t(i > 30)};
  }
  void write_route(core::test::Sample& log) const {
    using namespace core::test;
    using Poses = Items<std::array<double, 2>, 4>;
    const auto point = make_type("Point", 16, 8, {number("x", 0), number("y", 8)});
    const auto pose = make_type("Pose", 16, 8, {nested("position", point, 0)});
    const auto stamped = make_type("PoseStamped", 16, 8, {nested("pose", pose, 0)});
    const auto path =
        make_type("Path", sizeof(Poses), 8, {list(nested("poses", stamped, 0), 4, offsetof(Poses, items))});
    Poses poses{};
    for (const auto& at : route) poses.items[poses.count++] = at;
    log.write(log.channel("/scene/route", *path), 0, reinterpret_cast<const std::byte*>(&poses));
  }
  std::string write(const std::filesystem::path& file) const {
    core::test::Sample log({.file = file, .max_message_bytes = 4096});
    const std::uint16_t state = log.channel("/nav/state", *state_type()),
                        probes = log.channel(
                            "/slc/probes",
                            *core::test::make_type("Probes", 8, 8, {core::test::number("error_m", 0)})),
                        events = log.channel(core::Event::topic, *core::host_type<core::Event>());
    if (!route.empty()) write_route(log);
    std::size_t phase = 0;
    for (int i = 0; i < samples; ++i) {
      const std::int64_t now = std::llround(1e9 * i / hz);
      if (phase < phases.size() && std::size_t(i) * phases.size() >= phase * std::size_t(samples)) {
        const core::Event e = core::event_of(core::Code::phase_entered, "", phases[phase++]);
        log.write(events, now, reinterpret_cast<const std::byte*>(&e));
      }
      State s = at(i);
      change(i, s);
      const double error = 0.01 * i;
      log.write(state, now, reinterpret_cast<const std::byte*>(&s), 0, 1'000'000);
      if (i % 2 == 0) log.write(probes, now, reinterpret_cast<const std::byte*>(&error), 0, 1'000'000);
    }
    log.writer.close();
    return file.string();
  }
};

std::string svg_of(const LogPlotWords& words) {
  std::vector<std::string> notes;
  const std::string svg = chart::figure_svg(plot::log_figure(words, notes));
  CHECK(ill_formed(svg) == "");
  CHECK(notes.size() == 0);
  return svg;
}
ReadFigure drawn(const LogPlotWords& words) { return read_figure(svg_of(words)); }

std::string refused(const LogPlotWords& words) {
  try {
    plot::plot_log_command(words);
  } catch (const core::Error& e) {
    return e.what();
  }
  return "";
}

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
  CHECK(f.phase_words == std::vector<std::string>{"climb", "&lt;b&gt;&quot;&amp; ?", "land"});
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
        log + ": slc has no field 'position_m'. Valid: error_m.");
}

TEST_CASE("a track of north over east has the plan behind it, unless it is not wanted") {
  const Folder folder;
  Flight flight;
  flight.route = {{-40, 60}, {-40, -60}, {45, 0}};
  const std::string log = flight.write(folder.path / "a.mcap");
  LogPlotWords words{.words = {log, "nav.state.position_m.north"}, .over = ".position_m.east"};
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
  CHECK(notes[0] == "the phases are those of " + a + "; " + c + " had others, or at other times");
}

TEST_CASE("what cannot be drawn is told in a sentence with what there is") {
  const Folder folder;
  const std::string log = Flight{}.write(folder.path / "a.mcap");
  const auto says = [&](const std::string& field) {
    return refused({.words = {log, field}, .out = "x.svg"});
  };
  CHECK(says("nav.stat.height_m") == log +
                                         ": 'nav.stat.height_m' is no field of a port in it. Did you mean "
                                         "'nav.state'? Valid: fulmar.event, nav.state, slc.probes.");
  CHECK(
      says("nav.state.heigth_m") ==
      log +
          ": nav.state has no field 'heigth_m'. Did you mean 'height_m'? Valid: height_m, roll_deg, yaw_deg, "
          "position_m, rates_degps, name, levels_volt, mode.");
  const std::string is_structure =
      " is no number: give one of its fields, as in nav.state.position_m.north. Valid: "
      "north, east, down.";
  CHECK(says("nav.state.position_m") == log + ": nav.state.position_m" + is_structure);
  CHECK(
      says("nav.state")
          .starts_with(log + ": nav.state is no number: give one of its fields, as in nav.state.height_m."));
  CHECK(says("nav.state.name") == log + ": nav.state.name is a text, no number");
  const std::string is_list =
      ": nav.state.levels_volt is a list: give one of its elements, nav.state.levels_volt[0] "
      "to nav.state.levels_volt[1]";
  for (const char* field : {"nav.state.levels_volt", "nav.state.levels_volt[2]", "nav.state.levels_volt[x]"})
    CHECK(says(field) == log + is_list);
  CHECK(says("nav.state.height_m.x") == log + ": nav.state.height_m is one value, it has no 'x'");
  CHECK(says("nav.state.height_m[0]") == log + ": nav.state.height_m is no list");
  CHECK(drawn({.words = {log, "nav.state.levels_volt[1]"}}).panels[0].y_words == "levels[1] [V]");
  CHECK(refused({.words = {log, "nav.state.height_m"}, .out = "x.svg", .from_s = 100}) ==
        log + ": nav.state.height_m has no number in that time; the flight is from 0.0 s to 6.0 s");
  CHECK(refused({.words = {log, "nav.state.height_m"}, .out = "x.svg", .from_s = 3, .to_s = 2}) ==
        "--from 3 is not before --to 2");
  CHECK(refused({.words = {log}, .out = "x.svg"}).starts_with("give at least one field behind the log"));
  CHECK(refused({.words = {log, "slc.error_m", log}, .out = "x.svg"}) ==
        "'" + log + "' is a log: logs stand before the fields");
  CHECK(refused({.words = {log, "slc.error_m"}, .out = "x.svg", .names = "a,b"}) ==
        "--names takes a name for each log, with commas between them: 1, not 2");
  CHECK(refused({.words = {log, "slc.error_m"}, .out = "x.svg", .labels = "a,b"}) ==
        "--labels takes a name for each field, with commas between them: 1, not 2");
  for (const char* size : {"160", "160x", "0x90mm", "160x90cm", "160x9000mm", "x", "-1x5mm", "nanxnanmm"})
    CHECK(refused({.words = {log, "slc.error_m"}, .out = "x.svg", .size = size}) ==
          std::string("--size ") + size +
              ": give width and height in millimetres, at most 2000, as in 160x90mm");
  const std::string small = refused({.words = {log, "slc.error_m"}, .out = "x.svg", .size = "20x20mm"});
  CHECK(small.starts_with("--size 20x20mm has no room for its axes and 1 panel; it takes at least "));
  std::string enough = small.substr(small.rfind(' ') + 1);
  CHECK(drawn({.words = {log, "slc.error_m"}, .size = enough}).high_mm > 20);
  CHECK(refused({.words = {log, "slc.error_m"}}) ==
        "give the figure's file, as in -o figure.svg (or .png, .pdf)");
  CHECK(refused({.words = {log, "slc.error_m"}, .out = log})
            .starts_with("'" + log + "' is a log that is drawn"));
  CHECK(refused({.words = {log, "slc.error_m"}, .out = "x.jpg"}) ==
        "'x.jpg' ends in nothing that a figure can be. Valid: .svg, .png, .pdf.");
  const std::string nowhere_file = (folder.path / "none" / "x.svg").string();
  CHECK(refused({.words = {log, "slc.error_m"}, .out = nowhere_file}) ==
        "'" + nowhere_file + "' cannot be written");
  const std::string missing = (folder.path / "b.mcap").string();
  CHECK(refused({.words = {missing, "slc.error_m"}, .out = "x.svg"}).find("there is no such file") !=
        std::string::npos);
  CHECK(plot::names_a_log(missing));
  CHECK(plot::names_a_log("flight.mcap.part"));
  CHECK_FALSE(plot::names_a_log("nav.state.height_m"));
  std::string panel = "slc.error_m";
  for (std::size_t i = 0; i < chart::max_curves; ++i) panel += ",slc.error_m";
  CHECK(refused({.words = {log}, .panels = {panel}, .out = "x.svg"}) ==
        "a panel would have 37 curves; 36 can be told apart");
}

TEST_CASE("a log that was cut off is drawn as far as it goes, and told") {
  const Folder folder;
  Flight flight;
  flight.samples = 601;
  const std::string whole = flight.write(folder.path / "a.mcap"),
                    cut = (folder.path / "b.mcap.part").string();
  const std::string bytes = core::test::contents(whole);
  core::test::store(cut, bytes.substr(0, bytes.size() / 2));
  std::vector<std::string> notes;
  const ReadFigure f =
      read_figure(chart::figure_svg(plot::log_figure({.words = {cut, "nav.state.height_m"}}, notes)));
  REQUIRE(notes.size() == 1);
  CHECK(notes[0].starts_with(cut + " is cut off: byte "));
  const std::vector<Point> points = f.panels[0].curves[0].points();
  CHECK(points.size() > 50);
  CHECK(points.back().x > 5);
  CHECK(points.back().x < 55);
  core::test::store(cut, bytes.substr(0, 900));
  const std::string none = refused({.words = {cut, "nav.state.height_m"}, .out = "x.svg"});
  CHECK(none.starts_with(cut + ": 'nav.state.height_m' is no field of a port in it."));
  CHECK(none.find(" The log is cut off: byte ") != std::string::npos);
}

TEST_CASE("the numbers of a log are completed as they are typed") {
  const Folder folder;
  const std::string log = Flight{}.write(folder.path / "a.mcap");
  using Words = std::vector<std::string>;
  CHECK(core::numbers_beginning(log, "") == Words{"fulmar.event.", "nav.state.", "slc."});
  CHECK(core::numbers_beginning(log, "n") == Words{"nav.state."});
  CHECK(core::numbers_beginning(log, "nav.state.r") ==
        Words{"nav.state.roll_deg", "nav.state.rates_degps.north", "nav.state.rates_degps.east",
              "nav.state.rates_degps.down"});
  CHECK(core::numbers_beginning(log, "nav.state.n").empty());
  CHECK(core::numbers_beginning(log, "slc.e") == Words{"slc.error_m"});
}

struct Path {
  std::string before = std::getenv("PATH");
  explicit Path(const std::string& folder) { ::setenv("PATH", folder.c_str(), 1); }
  ~Path() { ::setenv("PATH", before.c_str(), 1); }
};

TEST_CASE("a PNG is made by a program that is there; without one the package is named") {
  const Folder folder;
  const std::string out = (folder.path / "x.png").string(), svg = "<svg/>\n";
  const auto says = [&] {
    try {
      plot::write_figure(out, svg);
    } catch (const core::Error& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  const Path only(folder.path.string());
  CHECK(says() ==
        "'" + out +
            "' takes a program that draws SVG: apt install librsvg2-bin (rsvg-convert) or inkscape; "
            "without one name a file that ends in .svg");
  const auto make_program = [&](const std::string& name, const std::string& does) {
    const std::string file = (folder.path / name).string();
    core::test::store(file, "#!/bin/sh\n" + does + "\n");
    ::chmod(file.c_str(), 0755);
    return file;
  };
  const std::string broken = make_program("inkscape", "exit 3");
  CHECK(says() == broken + " has not made '" + out + "' of the figure");
  make_program("rsvg-convert",
               "test \"$1 $2 $3 $4 $5 $6 $7\" = \"-d 300 -p 300 -f png -o\" && read all < \"$9\" && echo "
               "\"$all\" > \"$8\"");
  CHECK(says() == "");
  CHECK(core::test::contents(out) == svg);
  CHECK_FALSE(std::filesystem::exists(out + ".svg.part"));
}

}  // namespace plot_test

// SPDX-License-Identifier: BSD-3-Clause
// fulmar plot of logs: the figure is read back, and held against the log's export.
#include <doctest/doctest.h>
#include <sys/stat.h>

#include <algorithm>
#include <cstdlib>
#include <numbers>
#include <set>
#include <sstream>

#include "core/log/events.hpp"
#include "core/log/test/log_kit.hpp"
#include "tools/fulmar_log/export_log.hpp"
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
  std::string write(const std::filesystem::path& file) const {
    core::test::Sample log({.file = file, .max_message_bytes = 4096});
    const std::uint16_t state = log.channel("/nav/state", *state_type()),
                        probes = log.channel(
                            "/slc/probes",
                            *core::test::make_type("Probes", 8, 8, {core::test::number("error_m", 0)})),
                        events = log.channel(core::Event::topic, *core::host_type<core::Event>());
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

}  // namespace plot_test

// SPDX-License-Identifier: BSD-3-Clause
// fulmar plot: rejected commands and their messages, a log that was cut off, completion, PNG.
#include <doctest/doctest.h>
#include <sys/stat.h>

#include <cstdlib>

#include "tools/fulmar_log/log_field.hpp"
#include "tools/fulmar_log/test/plotted_log.hpp"

namespace plot_test {

TEST_CASE("a field that cannot be drawn is refused with the fields that exist") {
  const Folder folder;
  const std::string log = Flight{}.write(folder.path / "a.mcap");
  const auto says = [&](const std::string& field) {
    return refused({.words = {log, field}, .out = "x.svg"});
  };
  CHECK(says("nav.stat.height_m") ==
        log +
            ": log_tool.field_unknown(nav.stat.height_m,  [nav.state] fulmar.event, nav.state, slc.probes)");
  CHECK(says("nav.state.heigth_m") ==
        log +
            ": log_tool.subfield_unknown(nav.state, heigth_m,  [height_m] height_m, roll_deg, yaw_deg, "
            "position_m, rates_degps, name, levels_volt, mode)");
  const std::string is_structure =
      "log_tool.path_not_number(nav.state.position_m, nav.state.position_m, north, north, east, down)";
  CHECK(says("nav.state.position_m") == log + ": " + is_structure);
  CHECK(says("nav.state")
            .starts_with(log + ": log_tool.path_not_number(nav.state, nav.state, height_m, height_m, "
                               "roll_deg, yaw_deg, position_m, rates_degps, name, levels_volt, mode)"));
  CHECK(says("nav.state.name") == log + ": log_tool.path_is_text(nav.state.name)");
  const std::string is_list =
      ": log_tool.element_index_missing(nav.state.levels_volt, nav.state.levels_volt, nav.state.levels_volt, "
      "1)";
  for (const char* field : {"nav.state.levels_volt", "nav.state.levels_volt[2]", "nav.state.levels_volt[x]"})
    CHECK(says(field) == log + is_list);
  CHECK(says("nav.state.height_m.x") == log + ": log_tool.value_without_parts(nav.state.height_m, x)");
  CHECK(says("nav.state.height_m[0]") == log + ": log_tool.path_not_list(nav.state.height_m)");
  CHECK(drawn({.words = {log, "nav.state.levels_volt[1]"}}).panels[0].y_words == "levels[1] [V]");
  CHECK(refused({.words = {log, "nav.state.height_m"}, .out = "x.svg", .from_s = 100}) ==
        log +
            ": log_tool.number_missing(nav.state.height_m, log_tool.interval_without_numbers(0.0 s, 6.0 s))");
  CHECK(refused({.words = {log, "nav.state.height_m"}, .out = "x.svg", .from_s = 3, .to_s = 2}) ==
        "log_tool.time_range_invalid(3, 2)");
  CHECK(refused({.words = {log}, .out = "x.svg"}).starts_with("log_tool.fields_missing("));
  CHECK(refused({.words = {log, "slc.error_m", log}, .out = "x.svg"}) ==
        "log_tool.log_after_fields(" + log + ")");
  CHECK(refused({.words = {log, "slc.error_m"}, .out = "x.svg", .names = "a,b"}) ==
        "log_tool.name_count_mismatch(1, 2)");
  CHECK(refused({.words = {log, "slc.error_m"}, .out = "x.svg", .labels = "a,b"}) ==
        "log_tool.label_count_mismatch(1, 2)");
  for (const char* size : {"160", "160x", "0x90mm", "160x90cm", "160x9000mm", "x", "-1x5mm", "nanxnanmm"})
    CHECK(refused({.words = {log, "slc.error_m"}, .out = "x.svg", .size = size}) ==
          std::string("log_tool.size_invalid(") + size + ")");
  const std::string small = refused({.words = {log, "slc.error_m"}, .out = "x.svg", .size = "20x20mm"});
  CHECK(small.starts_with("log_tool.size_too_small(20, 20, chart.figure_too_small(1,  panel, "));
  const std::size_t high = small.rfind(", "), wide = small.rfind(", ", high - 1);  // its last two arguments
  const std::string enough = small.substr(wide + 2, high - wide - 2) + "x" +
                             std::to_string(std::stoi(small.substr(high + 2))) + "mm";
  CHECK(drawn({.words = {log, "slc.error_m"}, .size = enough}).high_mm > 20);
  CHECK(refused({.words = {log, "slc.error_m"}}) == "log_tool.output_missing");
  CHECK(refused({.words = {log, "slc.error_m"}, .out = log}) ==
        "log_tool.output_is_log(" + log + ", log_tool.output_missing)");
  CHECK(refused({.words = {log, "slc.error_m"}, .out = "x.jpg"}) == "log_tool.figure_format_unknown(x.jpg)");
  const std::string nowhere_file = (folder.path / "none" / "x.svg").string();
  CHECK(refused({.words = {log, "slc.error_m"}, .out = nowhere_file}) ==
        "log_tool.figure_not_writable(" + nowhere_file + ")");
  const std::string missing = (folder.path / "b.mcap").string();
  CHECK(refused({.words = {missing, "slc.error_m"}, .out = "x.svg"})
            .find("reading.file_not_readable(" + missing + ", reading.file_missing)") != std::string::npos);
  CHECK(plot::names_a_log(missing));
  CHECK(plot::names_a_log("flight.mcap.part"));
  CHECK_FALSE(plot::names_a_log("nav.state.height_m"));
  std::string panel = "slc.error_m";
  for (std::size_t i = 0; i < chart::max_curves; ++i) panel += ",slc.error_m";
  CHECK(refused({.words = {log}, .panels = {panel}, .out = "x.svg"}) == "log_tool.too_many_curves(37, 36)");
}

TEST_CASE("a log that was cut off is drawn as far as it goes, and reported") {
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
  CHECK(notes[0].starts_with("log_tool.log_incomplete(" + cut + ", byte "));
  const std::vector<Point> points = f.panels[0].curves[0].points();
  CHECK(points.size() > 50);
  CHECK(points.back().x > 5);
  CHECK(points.back().x < 55);
  core::test::store(cut, bytes.substr(0, 900));
  const std::string none = refused({.words = {cut, "nav.state.height_m"}, .out = "x.svg"});
  CHECK(none.starts_with("log_tool.log_cut_off(" + cut + ": log_tool.field_unknown(nav.state.height_m, "));
  CHECK(none.find("), byte ") != std::string::npos);
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
  CHECK(says() == "log_tool.svg_converter_missing(" + out + ")");
  const auto make_program = [&](const std::string& name, const std::string& does) {
    const std::string file = (folder.path / name).string();
    core::test::store(file, "#!/bin/sh\n" + does + "\n");
    ::chmod(file.c_str(), 0755);
    return file;
  };
  const std::string broken = make_program("inkscape", "exit 3");
  CHECK(says() == "log_tool.figure_conversion_failed(" + broken + ", " + out + ")");
  make_program("rsvg-convert",
               "test \"$1 $2 $3 $4 $5 $6 $7\" = \"-d 300 -p 300 -f png -o\" && read all < \"$9\" && echo "
               "\"$all\" > \"$8\"");
  CHECK(says() == "");
  CHECK(core::test::contents(out) == svg);
  CHECK_FALSE(std::filesystem::exists(out + ".svg.part"));
}

}  // namespace plot_test

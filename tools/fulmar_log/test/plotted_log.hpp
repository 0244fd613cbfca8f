// SPDX-License-Identifier: BSD-3-Clause
// A log to plot, and its figure.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "core/log/events.hpp"
#include "core/log/test/log_kit.hpp"
#include "tools/fulmar_log/plot_log.hpp"
#include "tools/fulmar_log/test/figure_kit.hpp"

namespace plot_test {

using namespace fulmar;
using core::test::Folder;
using plot::LogPlotArguments;

constexpr double degree = std::numbers::pi / 180;
constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();

struct State {
  double height_m, roll_rad, yaw_rad;
  core::test::Vector position_m, rates_radps;
  std::array<char, 8> name;
  core::test::Items<double, 4> levels_volt;
  std::uint8_t mode;
};
inline core::TypePtr state_type() {
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

inline std::string svg_of(const LogPlotArguments& words) {
  std::vector<std::string> notes;
  const std::string svg = chart::figure_svg(plot::log_figure(words, notes));
  CHECK(ill_formed(svg) == "");
  CHECK(notes.size() == 0);
  return svg;
}
inline ReadFigure drawn(const LogPlotArguments& words) { return read_figure(svg_of(words)); }

inline std::string refused(const LogPlotArguments& words) {
  try {
    plot::plot_log_command(words);
  } catch (const core::Error& e) {
    return e.what();
  }
  return "";
}

}  // namespace plot_test

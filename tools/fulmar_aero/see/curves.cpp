// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_aero/see/curves.hpp"

#include <algorithm>
#include <cmath>

#include "tools/fulmar_aero/flight_model.hpp"
#include "tools/fulmar_aero/mode_words.hpp"
#include "tools/fulmar_aero/see/messages.hpp"
#include "tools/fulmar_aero/words.hpp"

namespace fulmar::aero {
namespace {

std::vector<PolarPoint> polar_of(const AircraftModel& m) {
  const Airframe& a = m.airframe();
  const double Va = a.limits.airspeed_cruise_mps, rho = detail::density_of(m),
               qS = 0.5 * rho * Va * Va * a.wing.area_m2;
  const double last = a.wing.stall_alpha_rad / degree + 6;
  std::vector<PolarPoint> points;
  for (int i = 0; - 10 + 0.5 * i <= last; ++i) {
    const double alpha = (-10 + 0.5 * i) * degree, c = std::cos(alpha), s = std::sin(alpha);
    const Load load = m.aerodynamic().load({Va * c, 0, Va * s}, Eigen::Vector3d::Zero(), {}, rho);
    points.push_back({alpha, (load.force_b.x() * s - load.force_b.z() * c) / qS,
                      (-load.force_b.x() * c - load.force_b.z() * s) / qS,
                      load.moment_b.y() / (qS * a.wing.chord_m)});
  }
  return points;
}

/// Some 25 round numbers, and both ends.
std::vector<double> speeds_between(double first, double last) {
  const double span = last - first, power = std::pow(10.0, std::floor(std::log10(span / 25)));
  double step = 10 * power;
  for (const double one : {5.0, 2.0, 1.0})
    if (span / (one * power) <= 30) step = one * power;
  std::vector<double> speeds{first};
  for (double i = std::ceil(first / step + 0.05); i * step < last - 0.05 * step; ++i)
    speeds.push_back(i * step);
  speeds.push_back(last);
  return speeds;
}

std::optional<LevelPoint> level_at(const AircraftModel& m, double airspeed) {
  LevelPoint p{airspeed, fly(m, {.airspeed_mps = airspeed}), {}, {}};
  if (!p.flight.found()) return std::nullopt;
  p.forces = forces_of(m, p.flight);
  p.modes = modes_in(m, p.flight);
  return p;
}

/// An airspeed with level flight, preferably cruise; 0: none.
double some_level_speed(const AircraftModel& m) {
  const double cruise = m.airframe().limits.airspeed_cruise_mps;
  for (const double part : {1.0, 1.15, 0.85, 1.3, 0.7, 1.6, 2.0, 0.5})
    if (fly(m, {.airspeed_mps = part * cruise}).found()) return part * cruise;
  return 0;
}

const ChartAxis airspeed_axis{"airspeed", "m/s"}, alpha_axis{"angle of attack", "deg"};

/// One line for each set, from its points.
template <class Points, class X, class Y>
void add_line(Chart& chart, const AircraftCurves& set, int style, const Points& points, const X& x,
              const Y& y) {
  ChartLine line{.name = set.title, .style = style, .points = {}};
  for (const auto& p : points) line.points.push_back({x(p), y(p)});
  chart.lines.push_back(line);
}

/// One mode of a kind over the airspeed: a pair, or of two that do not oscillate the slower or the faster
/// one.
ChartLine locus(const AircraftCurves& set, int style, ModeKind kind, bool faster) {
  ChartLine line{.name = "", .style = style, .points = {}, .mark = Mark(int(kind) + 1), .growing = true};
  bool two = false;
  for (const LevelPoint& p : set.points) {
    ChartPoint at{std::nan(""), std::nan("")};
    int n = 0;
    for (const Mode& mode : p.modes) {
      if (mode.kind != kind) continue;
      const double real = mode.eigenvalue.real();
      if (n == 0 || (faster ? real < at.x : real > at.x)) at = {real, mode.eigenvalue.imag()};
      ++n;
    }
    two = two || n > 1;
    line.points.push_back(at);
  }
  if (faster && !two) line.points.clear();  // equal to the other line
  return line;
}

constexpr ModeKind mode_kinds[] = {ModeKind::short_period, ModeKind::phugoid, ModeKind::dutch_roll,
                                   ModeKind::roll,         ModeKind::spiral,  ModeKind::roll_spiral};

}  // namespace

AircraftCurves curves_of(const AirframeFile& file, double altitude_m) {
  const AircraftModel m(file.airframe, altitude_m);
  AircraftCurves set;
  set.title = file.title();
  set.altitude_m = altitude_m;
  set.stall_mps = stall_speed(m);
  set.polar = polar_of(m);
  const double cruise = file.airframe.limits.airspeed_cruise_mps;
  set.cruise = level_at(m, cruise);
  if (!set.cruise) set.none = no_flight(file, m, fly(m, {.airspeed_mps = cruise}));
  const double inside = some_level_speed(m);
  if (inside == 0) return set;
  set.level = level_speeds(m, inside);
  for (const double Va : speeds_between(set.level->slowest_mps, set.level->fastest_mps))
    if (std::optional<LevelPoint> point = level_at(m, Va)) set.points.push_back(std::move(*point));
  for (const double Va : speeds_between(set.level->slowest_mps, 1.15 * set.level->fastest_mps))
    set.envelope.push_back({Va, climb_rate(m, Va), glide_rate(m, Va)});
  return set;
}

std::vector<Chart> polar_charts(const std::vector<AircraftCurves>& sets) {
  std::vector<Chart> charts{
      {.title = "Lift", .x = alpha_axis, .y = {"lift coefficient CL", "-"}, .lines = {}, .keys = {}},
      {.title = "Drag",
       .x = alpha_axis,
       .y = {"drag coefficient CD", "-"},
       .lines = {},
       .keys = {},
       .with_zero = true},
      {.title = "Pitching moment",
       .x = alpha_axis,
       .y = {"moment coefficient Cm", "-"},
       .lines = {},
       .keys = {}},
      {.title = "Lift to drag", .x = alpha_axis, .y = {"CL/CD", "-"}, .lines = {}, .keys = {}},
      {.title = "Polar",
       .x = {"drag coefficient CD", "-"},
       .y = {"lift coefficient CL", "-"},
       .lines = {},
       .keys = {}}};
  for (std::size_t i = 0; i < sets.size(); ++i) {
    const auto alpha = [](const PolarPoint& p) { return p.alpha_rad / degree; };
    const auto CL = [](const PolarPoint& p) { return p.CL; };
    const auto CD = [](const PolarPoint& p) { return p.CD; };
    const auto add = [&](std::size_t chart, const auto& x, const auto& y) {
      add_line(charts[chart], sets[i], int(i), sets[i].polar, x, y);
    };
    add(0, alpha, CL);
    add(1, alpha, CD);
    add(2, alpha, [](const PolarPoint& p) { return p.Cm; });
    add(3, alpha, [](const PolarPoint& p) { return p.CL / p.CD; });
    add(4, CD, CL);
  }
  return charts;
}

std::vector<Chart> trim_charts(const std::vector<AircraftCurves>& sets) {
  struct Row {
    const char *title, *words, *unit;
    double (*value)(const LevelPoint&);
  };
  constexpr Row rows[] = {{"Angle of attack in level flight", "angle of attack", "deg",
                           [](const LevelPoint& p) { return p.flight.alpha_rad / degree; }},
                          {"Elevator in level flight", "elevator, trailing edge down", "deg",
                           [](const LevelPoint& p) { return p.flight.input(model::elevator) / degree; }},
                          {"Throttle in level flight", "throttle, of full", "-",
                           [](const LevelPoint& p) { return p.flight.input(model::throttle); }},
                          {"Lift to drag in level flight", "L/D", "-",
                           [](const LevelPoint& p) { return p.forces.lift_newton / p.forces.drag_newton; }}};
  std::vector<Chart> charts;
  for (const Row& row : rows) {
    Chart chart{.title = row.title,
                .x = airspeed_axis,
                .y = {row.words, row.unit},
                .lines = {},
                .keys = {},
                .empty = aero_messages::level_flight_missing().line()};
    for (std::size_t i = 0; i < sets.size(); ++i) {
      add_line(
          chart, sets[i], int(i), sets[i].points, [](const LevelPoint& p) { return p.airspeed_mps; },
          row.value);
      if (sets[i].cruise)
        chart.lines.push_back({.name = "",
                               .style = int(i),
                               .points = {{sets[i].cruise->airspeed_mps, row.value(*sets[i].cruise)}},
                               .mark = Mark::circle,
                               .joined = false});
    }
    chart.keys.push_back(
        {.name = "cruise", .style = no_style, .points = {}, .mark = Mark::circle, .joined = false});
    charts.push_back(chart);
  }
  return charts;
}

Chart envelope_chart(const std::vector<AircraftCurves>& sets) {
  Chart chart{.title = "Climb at full throttle, and glide without (below)",
              .x = airspeed_axis,
              .y = {"rate of climb", "m/s"},
              .lines = {},
              .keys = {},
              .with_zero = true,
              .empty = aero_messages::level_flight_missing().line()};
  for (std::size_t i = 0; i < sets.size(); ++i) {
    const auto speed = [](const EnvelopePoint& p) { return p.airspeed_mps; };
    add_line(chart, sets[i], int(i), sets[i].envelope, speed,
             [](const EnvelopePoint& p) { return p.climb_mps; });
    add_line(chart, sets[i], int(i), sets[i].envelope, speed,
             [](const EnvelopePoint& p) { return p.glide_mps; });
    chart.lines.back().name = "";
    if (sets[i].stall_mps > 0 && sets[i].level)
      chart.lines.push_back({.name = "",
                             .style = int(i),
                             .points = {{sets[i].stall_mps, 0}},
                             .mark = Mark::diamond,
                             .joined = false});
  }
  chart.keys.push_back(
      {.name = "stall", .style = no_style, .points = {}, .mark = Mark::diamond, .joined = false});
  return chart;
}

std::vector<Chart> mode_charts(const std::vector<AircraftCurves>& sets) {
  Chart all{.title = "Modes in level flight, marks grow with the airspeed",
            .x = {"real part", "1/s"},
            .y = {"imaginary part", "rad/s"},
            .lines = {},
            .keys = {},
            .unstable = true,
            .with_zero = true,
            .empty = aero_messages::level_flight_missing().line()};
  Chart slow = all;
  slow.title = "Phugoid and spiral";
  for (const ModeKind kind : mode_kinds) {
    bool there = false;
    const bool is_slow = kind == ModeKind::phugoid || kind == ModeKind::spiral;
    for (std::size_t i = 0; i < sets.size(); ++i)
      for (const bool faster : {false, true}) {
        const ChartLine line = locus(sets[i], int(i), kind, faster);
        const bool any = std::any_of(line.points.begin(), line.points.end(),
                                     [](const ChartPoint& p) { return std::isfinite(p.x); });
        if (!any) continue;
        there = true;
        all.lines.push_back(line);
        if (is_slow) slow.lines.push_back(line);
      }
    if (!there) continue;
    const ChartLine key{.name = mode_name(kind),
                        .style = no_style,
                        .points = {},
                        .mark = Mark(int(kind) + 1),
                        .joined = false};
    all.keys.push_back(key);
    if (is_slow) slow.keys.push_back(key);
  }
  for (std::size_t i = 0; i < sets.size(); ++i)
    for (Chart* chart : {&all, &slow})
      chart->keys.push_back({.name = sets[i].title, .style = int(i), .points = {}});
  return {all, slow};
}

std::vector<std::vector<std::string>> mode_rows(const std::vector<AircraftCurves>& sets) {
  std::vector<std::vector<std::string>> rows{
      {"mode", "eigenvalue, 1/s", "frequency, rad/s", "damping", "period, s", "half or double, s"}};
  for (const AircraftCurves& set : sets)
    for (const Mode& mode : set.cruise ? set.cruise->modes : std::vector<Mode>{}) {
      const bool pair = mode.oscillates();
      rows.push_back(
          {(sets.size() > 1 ? set.title + ", " : "") + mode_name(mode.kind),
           fixed(mode.eigenvalue.real(), 4) + (pair ? " ± " + fixed(mode.eigenvalue.imag(), 4) + "i" : ""),
           pair ? fixed(mode.natural_radps(), 3) : "", pair ? fixed(mode.damping_ratio(), 3) : "",
           pair ? fixed(mode.period_s(), 2) : "",
           (mode.stable() ? "half " : "double ") + fixed(mode.half_or_double_s(), 2)});
    }
  return rows;
}

}  // namespace fulmar::aero

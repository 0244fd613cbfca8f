// SPDX-License-Identifier: BSD-3-Clause
// `fulmar aero see`: aircraft side by side on a page.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/app/program.hpp"
#include "core/graph/shipped.hpp"
#include "core/types/text.hpp"
#include "tools/fulmar_aero/commands.hpp"
#include "tools/fulmar_aero/see/curves.hpp"
#include "tools/fulmar_aero/see/messages.hpp"
#include "tools/fulmar_aero/see/page.hpp"
#include "tools/fulmar_aero/vlm/span_load.hpp"
#include "tools/fulmar_aero/words.hpp"

namespace fulmar::aero {
namespace {

struct Drawn {
  GeometryFile geometry;
  Aircraft aircraft;
  std::vector<SurfaceLoad> loads;
};
struct Seen {
  AirframeFile file;
  std::optional<Drawn> drawn;
  AircraftCurves curves;
};

bool is_drawing(const std::string& name) {
  core::Report report;
  const core::Node root = core::parse_yaml(core::read_source(core::named_file({}, name), name), report);
  report.throw_if_any();
  return root.find("surfaces") || root.find("planform") || root.find("reference");
}

Seen look_at(const std::string& name, double altitude_m) {
  Seen seen;
  if (is_drawing(name)) {
    Drawn drawn{read_geometry_file(name), {}, {}};
    drawn.aircraft = aircraft_of(drawn.geometry);
    drawn.loads = span_loads(drawn.geometry, drawn.aircraft);
    // through the text, so that the page shows exactly the output of `fulmar aero vlm -o`
    seen.file = airframe_of_text(airframe_yaml(drawn.geometry, drawn.aircraft), name);
    seen.drawn = std::move(drawn);
  } else {
    seen.file = read_airframe_file(name);
  }
  seen.curves = curves_of(seen.file, altitude_m);
  return seen;
}

/// Two of the same name get the names of their files.
void report_apart(std::vector<Seen>& all) {
  const auto same = [&](const Seen& one) {
    return std::count_if(all.begin(), all.end(),
                         [&](const Seen& s) { return s.file.title() == one.file.title(); }) > 1;
  };
  for (Seen& one : all)
    if (same(one)) one.curves.title = one.file.title() + " (" + one.file.name + ")";
}

const char* limit_name(TrimLimit limit) {
  switch (limit) {
    case TrimLimit::stall: return "stall";
    case TrimLimit::elevator: return "elevator at its stop";
    case TrimLimit::aileron: return "aileron at its stop";
    case TrimLimit::rudder: return "rudder at its stop";
    case TrimLimit::throttle_high: return "full throttle";
    case TrimLimit::throttle_low: return "no throttle";
    default: return "no balance found";
  }
}

std::string at_speed(double value, int decimals, double airspeed) {
  return fixed(value, decimals) + " at " + fixed(airspeed, 1) + " m/s";
}

/// The largest value over the points, and its place.
template <class Points, class Value>
std::string max_of(const Points& points, int decimals, const Value& value) {
  double most = -1e300, at = 0;
  for (const auto& p : points)
    if (value(p) > most) {
      most = value(p);
      at = p.airspeed_mps;
    }
  return most > -1e300 ? at_speed(most, decimals, at) : "-";
}

using Rows = std::vector<std::vector<std::string>>;

template <class Text>
void add_row(Rows& rows, const std::vector<Seen>& all, const std::string& name, const Text& text) {
  rows.push_back({name});
  for (const Seen& s : all) rows.back().push_back(text(s));
}

Rows head(const std::vector<Seen>& all) {
  Rows rows{{""}};
  for (const Seen& s : all) rows[0].push_back(s.curves.title);
  return rows;
}

Rows figure_rows(const std::vector<Seen>& all) {
  Rows rows = head(all);
  const auto row = [&](const char* name, const auto& text) { add_row(rows, all, name, text); };
  const auto of_airframe = [&](const char* name, const auto& value) {
    row(name, [&](const Seen& s) { return figures(value(s.file.airframe), 4); });
  };
  of_airframe("mass, kg", [](const Airframe& a) { return a.mass_kg; });
  of_airframe("wing area, m²", [](const Airframe& a) { return a.wing.area_m2; });
  of_airframe("span, m", [](const Airframe& a) { return a.wing.span_m; });
  of_airframe("aspect ratio",
              [](const Airframe& a) { return a.wing.span_m * a.wing.span_m / a.wing.area_m2; });
  of_airframe("wing loading, kg/m²", [](const Airframe& a) { return a.mass_kg / a.wing.area_m2; });
  row("static margin, of the chord", [](const Seen& s) {
    const Aerodynamics& c = s.file.airframe.aero;
    return fixed(-c.pitch.alpha_ratio / c.lift.alpha_ratio, 3);
  });
  row("stall, m/s",
      [](const Seen& s) { return s.curves.stall_mps > 0 ? fixed(s.curves.stall_mps, 1) : "-"; });
  const auto level = [&](const char* name, double LevelSpeeds::*speed, TrimLimit LevelSpeeds::*why) {
    row(name, [&](const Seen& s) {
      return s.curves.level
                 ? fixed((*s.curves.level).*speed, 1) + " (" + limit_name((*s.curves.level).*why) + ")"
                 : std::string("-");
    });
  };
  level("slowest level flight, m/s", &LevelSpeeds::slowest_mps, &LevelSpeeds::below);
  level("fastest level flight, m/s", &LevelSpeeds::fastest_mps, &LevelSpeeds::above);
  row("most L/D in level flight", [](const Seen& s) {
    return max_of(s.curves.points, 1,
                  [](const LevelPoint& p) { return p.forces.lift_newton / p.forces.drag_newton; });
  });
  row("most rate of climb, m/s", [](const Seen& s) {
    return max_of(s.curves.envelope, 1, [](const EnvelopePoint& p) { return p.climb_mps; });
  });
  row("flattest sink without throttle, m/s up", [](const Seen& s) {
    return max_of(s.curves.envelope, 2, [](const EnvelopePoint& p) { return p.glide_mps; });
  });
  const auto cruise = [&](const char* name, const auto& text) {
    row(name, [&](const Seen& s) { return s.curves.cruise ? text(*s.curves.cruise) : std::string("-"); });
  };
  cruise("cruise, m/s", [](const LevelPoint& p) { return figures(p.airspeed_mps, 4); });
  cruise("angle of attack in cruise, deg",
         [](const LevelPoint& p) { return fixed(p.flight.alpha_rad / degree, 2); });
  cruise("elevator in cruise, deg",
         [](const LevelPoint& p) { return fixed(p.flight.input(model::elevator) / degree, 2); });
  cruise("throttle in cruise, of full",
         [](const LevelPoint& p) { return fixed(p.flight.input(model::throttle), 3); });
  return rows;
}

Rows derivative_rows(const std::vector<Seen>& all) {
  struct Named {
    const char* name;
    Derivatives Aerodynamics::*of;
    double Derivatives::*over;
  };
  using A = Aerodynamics;
  using D = Derivatives;
  constexpr Named names[] = {
      {"CL_0", &A::lift, &D::zero_ratio},      {"CL_alpha", &A::lift, &D::alpha_ratio},
      {"CL_q", &A::lift, &D::q_ratio},         {"CL_elevator", &A::lift, &D::elevator_ratio},
      {"Cm_0", &A::pitch, &D::zero_ratio},     {"Cm_alpha", &A::pitch, &D::alpha_ratio},
      {"Cm_q", &A::pitch, &D::q_ratio},        {"Cm_elevator", &A::pitch, &D::elevator_ratio},
      {"CY_beta", &A::side, &D::beta_ratio},   {"CY_rudder", &A::side, &D::rudder_ratio},
      {"Cl_beta", &A::roll, &D::beta_ratio},   {"Cl_p", &A::roll, &D::p_ratio},
      {"Cl_r", &A::roll, &D::r_ratio},         {"Cl_aileron", &A::roll, &D::aileron_ratio},
      {"Cn_beta", &A::yaw, &D::beta_ratio},    {"Cn_p", &A::yaw, &D::p_ratio},
      {"Cn_r", &A::yaw, &D::r_ratio},          {"Cn_aileron", &A::yaw, &D::aileron_ratio},
      {"Cn_rudder", &A::yaw, &D::rudder_ratio}};
  Rows rows = head(all);
  add_row(rows, all, "CD_p; e", [](const Seen& s) {
    return fixed(s.file.airframe.aero.parasite_drag_ratio, 4) + "; " +
           fixed(s.file.airframe.wing.oswald_ratio, 3);
  });
  for (const Named& n : names)
    add_row(rows, all, n.name, [&](const Seen& s) { return fixed(s.file.airframe.aero.*n.of.*n.over, 4); });
  return rows;
}

ChartLine from_above(const std::vector<PlaneLine>& lines, const std::string& name, int style, double x0) {
  ChartLine out{.name = name, .style = style, .points = {}};
  for (const PlaneLine& line : lines) {
    for (const Eigen::Vector2d& p : line.places) out.points.push_back({p.y(), x0 - p.x()});
    out.points.push_back({std::nan(""), std::nan("")});
  }
  return out;
}

Chart plan_chart(const std::string& title) {
  return {.title = title, .x = {"right", "m"}, .y = {"forward", "m"}, .lines = {}, .keys = {}, .even = true};
}

/// Of one drawing, with its panels.
Chart lattice_chart(const Seen& s, int style) {
  const Drawn& d = *s.drawn;
  Chart chart = plan_chart(s.curves.title + ": surfaces and lattice, from above");
  const double centre = d.aircraft.mass.centre.x(), neutral = centre - d.aircraft.whole.alpha.Cm /
                                                                           d.aircraft.whole.alpha.CL *
                                                                           d.aircraft.airframe.wing.chord_m;
  chart.lines.push_back(
      from_above(lattice_lines(*d.geometry.geometry), "bound vortices and strips", style, 0));
  chart.lines.back().thin = true;
  chart.lines.push_back(from_above(outlines(*d.geometry.geometry), "", style, 0));
  chart.lines.back().closed = true;
  chart.lines.push_back({.name = "centre of gravity",
                         .style = no_style,
                         .points = {{0, -centre}},
                         .mark = Mark::circle,
                         .joined = false,
                         .size = 1.8});
  chart.lines.push_back({.name = "neutral point",
                         .style = no_style,
                         .points = {{0, -neutral}},
                         .mark = Mark::cross,
                         .joined = false,
                         .size = 1.8});
  return chart;
}

Chart outline_chart(const std::vector<Seen>& all) {
  Chart chart = plan_chart("From above, about the centres of gravity");
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all[i].drawn) {
      chart.lines.push_back(from_above(outlines(*all[i].drawn->geometry.geometry), all[i].curves.title,
                                       int(i), all[i].drawn->aircraft.mass.centre.x()));
      chart.lines.back().closed = true;
    }
  return chart;
}

/// Spanwise lift distribution, and the section that stalls first.
std::vector<Chart> load_charts(const std::vector<Seen>& all) {
  Chart load{.title = "Lift over the span, in cruise",
             .x = {"right", "m"},
             .y = {"cl c / chord of reference", "-"},
             .lines = {},
             .keys = {},
             .with_zero = true};
  Chart stall{.title = "Sections where the first one stalls (pale: their most lift)",
              .x = {"right", "m"},
              .y = {"lift coefficient cl", "-"},
              .lines = {},
              .keys = {}};
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!all[i].drawn) continue;
    const Drawn& d = *all[i].drawn;
    std::string name = all[i].curves.title;  // once in the legend
    for (const SurfaceLoad& surface : d.loads) {
      ChartLine cruise{.name = name, .style = int(i), .points = {}}, cl = cruise, most = cruise;
      for (const LoadStation& s : surface.stations) {
        cruise.points.push_back({s.y_m, s.cl_cruise_ratio * s.chord_m / d.aircraft.airframe.wing.chord_m});
        cl.points.push_back({s.y_m, s.cl_stall_ratio});
        most.points.push_back({s.y_m, s.cl_max_ratio});
      }
      most.thin = true;
      most.name = name = "";
      load.lines.push_back(cruise);
      stall.lines.push_back(cl);
      stall.lines.push_back(most);
    }
  }
  return {load, stall};
}

std::string charts_html(const std::vector<Chart>& charts) {
  std::string out = "<div class=\"charts\">\n";
  for (const Chart& chart : charts) out += chart_html(chart);
  return out + "</div>\n";
}

std::string drawings_html(const std::vector<Seen>& all) {
  std::string out = "<h2>Planform and lift over the span</h2>\n";
  std::vector<Chart> charts;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].drawn)
      charts.push_back(lattice_chart(all[i], int(i)));
    else
      out += sentence_html(aero_messages::surfaces_not_in_file(all[i].curves.title).line());
  }
  if (charts.size() > 1) charts.push_back(outline_chart(all));
  if (!charts.empty())
    for (Chart& chart : load_charts(all)) charts.push_back(std::move(chart));
  return out + (charts.empty() ? "" : charts_html(charts));
}

std::string body_of(const std::vector<Seen>& all, double altitude_m) {
  std::vector<AircraftCurves> sets;
  std::string missing;
  for (const Seen& s : all) {
    sets.push_back(s.curves);
    if (!s.curves.cruise) missing += "<p class=\"fault\">" + in_html(s.curves.none) + "</p>\n";
  }
  std::vector<Chart> trims = trim_charts(sets);
  trims.push_back(envelope_chart(sets));
  return sentence_html("In still standard air, " + fixed(altitude_m, 0) + " m above the sea.") + missing +
         table_html(figure_rows(all)) + drawings_html(all) + "<h2>Polars</h2>\n" +
         sentence_html("All surfaces in the middle, no rates; moment about the centre of gravity.") +
         charts_html(polar_charts(sets)) + "<h2>Trim and envelope</h2>\n" + charts_html(trims) +
         "<h2>Modes</h2>\n" + charts_html(mode_charts(sets)) + sentence_html("In cruise:") +
         table_html(mode_rows(sets)) + "<h2>Derivatives</h2>\n" +
         sentence_html("Per radian, of p b/2V, q c/2V, r b/2V; body axes.") +
         table_html(derivative_rows(all));
}

}  // namespace

int see_command(const std::vector<std::string>& files, const FlightOptions& options, const std::string& out) {
  const double altitude_m = options.altitude_m();
  refuse_as_page(out, files);
  std::vector<Seen> all;
  for (const std::string& file : files) all.push_back(look_at(file, altitude_m));
  report_apart(all);
  std::string title;
  for (const Seen& s : all) title += (title.empty() ? "" : ", ") + s.file.title();
  write_page(out, page_html(title, body_of(all, altitude_m)));
  print_text("written: " + core::for_terminal(out) + "\n");
  bool flies = true;
  for (const Seen& s : all) {
    if (!s.curves.cruise) std::fprintf(stderr, "%s\n", core::for_terminal(s.curves.none).c_str());
    flies = flies && s.curves.cruise;
  }
  return flies ? core::ExitCode::done : core::ExitCode::failed;
}

}  // namespace fulmar::aero

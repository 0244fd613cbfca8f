// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_aero/see/fly_report.hpp"

#include <cmath>

#include "tools/fulmar_aero/see/curves.hpp"
#include "tools/fulmar_aero/see/page.hpp"
#include "tools/fulmar_aero/words.hpp"

namespace fulmar::aero {
namespace {

std::string fault_html(const std::string& sentence) {
  return "<p class=\"fault\">" + in_html(sentence) + "</p>\n";
}

std::string check_html(const Findings& findings) {
  std::vector<std::vector<std::string>> rows{{"figure", "value"}};
  for (const Figure& figure : findings.figures())
    if (!figure.name.empty()) rows.push_back({figure.name, figure.text});
  std::string out =
      "<h2>Check</h2>\n" + sentence_html(std::to_string(findings.values()) + " values checked: " +
                                         std::to_string(findings.count(Verdict::fault)) + " faults, " +
                                         std::to_string(findings.count(Verdict::warning)) + " warnings.");
  for (const Finding& one : findings.list())
    out += fault_html((one.verdict == Verdict::fault ? "Fault: " : "Warning: ") + one.where.text() + ": " +
                      shown_field(one.field) + ": " + one.sentence);
  return out + table_html(rows);
}

std::string trim_html(const LevelPoint& p) {
  const SteadyFlight& f = p.flight;
  return table_html({{"in cruise", "value"},
                     {"airspeed, m/s", figures(p.airspeed_mps, 4)},
                     {"angle of attack, deg", fixed(f.alpha_rad / degree, 2)},
                     {"sideslip, deg", fixed(f.beta_rad / degree, 2)},
                     {"aileron, deg", fixed(f.input(model::aileron) / degree, 2)},
                     {"elevator, deg", fixed(f.input(model::elevator) / degree, 2)},
                     {"rudder, deg", fixed(f.input(model::rudder) / degree, 2)},
                     {"throttle, of full", fixed(f.input(model::throttle), 3)},
                     {"CL; CD", fixed(p.forces.lift_ratio, 3) + "; " + fixed(p.forces.drag_ratio, 4)},
                     {"lift to drag", fixed(p.forces.lift_newton / p.forces.drag_newton, 1)}});
}

std::string gains_html(const TuneOutcome& t) {
  std::vector<std::vector<std::string>> rows{{"gain", "computed", "unit"}};
  const bool both = t.shipped_gains.size() == t.gains.size();
  if (both) rows[0].insert(rows[0].begin() + 2, "in the file");
  for (std::size_t i = 0; i < t.gains.size(); ++i) {
    const Gain& g = t.gains[i];
    rows.push_back({g.component + "." + g.name, gain_text(g.value), g.unit});
    if (both) rows.back().insert(rows.back().begin() + 2, gain_text(t.shipped_gains[i].value));
  }
  return "<h2>Gains</h2>\n" + table_html(rows);
}

std::string margins_html(const std::string& title, const Judged& judged) {
  const auto number = [](double x, int decimals) {
    return std::isfinite(x) ? fixed(x, decimals) : std::string("-");
  };
  std::vector<std::vector<std::string>> rows{{"loop", "bandwidth, rad/s", "damping", "gain margin, dB",
                                              "phase margin, deg", "delay margin, ms", "least kept"}};
  for (const LoopFigures& f : judged.loops)
    rows.push_back({f.name, bandwidth_words(f), fixed(f.damping_ratio, 2), number(f.min_gain_db(), 1),
                    number(f.min_phase_rad() / degree, 0), number(1000 * f.min_delay_s(), 0),
                    min_margins.kept(f) ? "yes" : "no"});
  return sentence_html(title + ": the lesser of the margins at actuator and sensor; the least are " +
                       fixed(min_margins.gain_db, 0) + " dB and " + fixed(min_margins.phase_rad / degree, 0) +
                       " deg.") +
         table_html(rows);
}

/// Commanded and actual values over time.
template <class Commands, class Of, class Flown>
Chart over_time(const char* title, ChartAxis y, const FlightTrack& track, const Commands& commands,
                const Of& of, const Flown& flown) {
  Chart chart{.title = title, .x = {"flight time", "s"}, .y = std::move(y), .lines = {}, .keys = {}};
  ChartLine wanted{.name = "commanded", .style = 1, .points = {}},
      there{.name = "flown", .style = 0, .points = {}};
  for (const auto& c : commands) wanted.points.push_back({c.time_s, of(c)});
  for (const TrackPoint& p : track.truth) there.points.push_back({p.time_s, flown(p)});
  chart.lines = {there, wanted};
  return chart;
}

Chart ground_track(const TuneFlight& flight) {
  Chart chart{.title = "Ground track",
              .x = {"east", "m"},
              .y = {"north", "m"},
              .lines = {},
              .keys = {},
              .even = true};
  ChartLine plan{.name = "plan", .style = 1, .points = {}, .closed = true},
      flown{.name = "flown", .style = 0, .points = {}};
  for (const auto& [north, east] : flight.corners_m) plan.points.push_back({east, north});
  for (const TrackPoint& p : flight.track.truth) flown.points.push_back({p.east_m, p.north_m});
  chart.lines = {flown, plan};
  return chart;
}

std::string flight_html(const TuneFlight& flight) {
  std::vector<std::vector<std::string>> rows{{"figure", "value", "bound", "kept"}};
  for (const FlownFigure& f : flight.figures)
    rows.push_back({f.name + ", " + f.unit, std::isfinite(f.value) ? fixed(f.value, 2) : "-",
                    (f.least ? "at least " : "at most ") + figures(f.bound), f.kept() ? "yes" : "no"});
  const FlightTrack& t = flight.track;
  std::string out = "<h2>The hourglass in light turbulence</h2>\n" +
                    sentence_html("Result: " + flight.result + ".") + table_html(rows) +
                    "<div class=\"charts\">\n" + chart_html(ground_track(flight));
  out += chart_html(over_time(
      "Height", {"height", "m"}, t, t.commands, [](const CommandPoint& c) { return c.height_m; },
      [](const TrackPoint& p) { return p.height_m; }));
  out += chart_html(over_time(
      "Airspeed", {"airspeed", "m/s"}, t, t.commands, [](const CommandPoint& c) { return c.airspeed_mps; },
      [](const TrackPoint& p) { return p.airspeed_mps; }));
  out += chart_html(over_time(
      "Roll", {"roll", "deg"}, t, t.attitudes, [](const AttitudePoint& a) { return a.roll_rad / degree; },
      [](const TrackPoint& p) { return p.roll_rad / degree; }));
  out += chart_html(over_time(
      "Pitch", {"pitch", "deg"}, t, t.attitudes, [](const AttitudePoint& a) { return a.pitch_rad / degree; },
      [](const TrackPoint& p) { return p.pitch_rad / degree; }));
  return out + "</div>\n";
}

}  // namespace

std::string fly_report_html(const FlyRecord& r) {
  const std::vector<AircraftCurves> sets{curves_of(*r.file, r.altitude_m)};
  const AircraftCurves& curves = sets[0];
  std::string body = "<p><strong>" + in_html(r.verdict) + "</strong></p>\n";
  if (r.tuned)
    for (const std::string& sentence : r.tuned->faults) body += fault_html(sentence);
  body += check_html(*r.findings) + "<h2>Trim</h2>\n" +
          (curves.cruise ? trim_html(*curves.cruise) : fault_html(curves.none)) + "<div class=\"charts\">\n";
  for (const Chart& chart : trim_charts(sets)) body += chart_html(chart);
  body += chart_html(envelope_chart(sets)) + "</div>\n<h2>Modes</h2>\n<div class=\"charts\">\n";
  for (const Chart& chart : mode_charts(sets)) body += chart_html(chart);
  body += "</div>\n" + table_html(mode_rows(sets));
  if (r.tuned && !r.tuned->gains.empty()) {
    body += gains_html(*r.tuned) + "<h2>Margins</h2>\n" + margins_html("Computed gains", r.tuned->computed);
    if (r.tuned->shipped) body += margins_html("Gains in the file", *r.tuned->shipped);
  }
  if (r.tuned && r.tuned->flown) body += flight_html(*r.tuned->flown);
  return page_html(curves.title + ": from check to flight", body);
}

}  // namespace fulmar::aero

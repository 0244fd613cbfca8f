// SPDX-License-Identifier: BSD-3-Clause
// Curves of an aircraft over angle of attack and airspeed, and their charts.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "tools/chart/chart.hpp"
#include "tools/fulmar_aero/airframe_file.hpp"
#include "tools/fulmar_aero/envelope.hpp"
#include "tools/fulmar_aero/flight_words.hpp"
#include "tools/fulmar_aero/modes_svg.hpp"

namespace fulmar::aero {

using chart::Chart;
using chart::chart_html;
using chart::ChartAxis;
using chart::ChartLine;
using chart::ChartPoint;
using chart::in_html;
using chart::Mark;
using chart::no_style;
using chart::style_sample;

/// Coefficients with zero deflections and rates, at cruise airspeed; Cm about the centre of gravity.
struct PolarPoint {
  double alpha_rad = 0, CL = 0, CD = 0, Cm = 0;
};

/// Level flight at an airspeed.
struct LevelPoint {
  double airspeed_mps = 0;
  SteadyFlight flight;
  FlightForces forces;
  std::vector<Mode> modes;
};

/// m/s; NaN for none.
struct EnvelopePoint {
  double airspeed_mps = 0, climb_mps = 0, glide_mps = 0;
};

struct AircraftCurves {
  std::string title;
  double altitude_m = 0, stall_mps = 0;
  std::vector<PolarPoint> polar;
  std::optional<LevelSpeeds> level;  ///< none: no level flight, see `none`
  std::vector<LevelPoint> points;    ///< from the slowest to the fastest level flight
  std::vector<EnvelopePoint> envelope;
  std::optional<LevelPoint> cruise;
  std::string none;  ///< reason why there is no level flight in cruise
};
AircraftCurves curves_of(const AirframeFile& file, double altitude_m);

/// One line for each set in each chart.
std::vector<Chart> polar_charts(const std::vector<AircraftCurves>& sets);
std::vector<Chart> trim_charts(const std::vector<AircraftCurves>& sets);
Chart envelope_chart(const std::vector<AircraftCurves>& sets);
/// All modes, and those near the origin.
std::vector<Chart> mode_charts(const std::vector<AircraftCurves>& sets);

/// Rows for `table_html`: mode, eigenvalue, frequency, damping, time to half or double.
std::vector<std::vector<std::string>> mode_rows(const std::vector<AircraftCurves>& sets);

}  // namespace fulmar::aero

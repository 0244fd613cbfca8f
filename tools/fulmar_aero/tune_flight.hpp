// SPDX-License-Identifier: BSD-3-Clause
// The hourglass, run by `fulmar run` with gains that are in no file yet.
#pragma once
#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tools/fulmar_aero/airframe_file.hpp"
#include "tools/fulmar_aero/flight_track.hpp"

namespace fulmar::aero {

struct FlownFigure {
  std::string name, unit;
  double value = 0, bound = 0;
  bool least = false;  ///< the bound is a minimum, not a maximum
  bool kept() const { return least ? value >= bound : value <= bound; }
};
struct TuneFlight {
  std::string result;   ///< "flown", or its end
  std::string stalled;  ///< a sentence for a stall of the wing; else empty
  std::vector<FlownFigure> figures;
  FlightTrack track;
  std::vector<std::array<double, 2>> corners_m;  ///< of the plan: north, east
};

/// `text`: airframe file with the gains. Near 17 m/s the plan is the shipped one. Else the same shape is
/// scaled with the square of the airspeed, so that turns have the same bank.
TuneFlight fly_hourglass(const Airframe& airframe, const std::string& text, double airspeed_mps);

/// A sentence for a stall of the wing; else empty. A short excess in a gust or after a throw is no stall.
std::string stall_of(const FlightTrack& track, const Airframe& a);

std::string flight_text(const TuneFlight& flight);
nlohmann::json tune_flight_json(const TuneFlight& flight);
std::vector<std::string> flight_faults(const TuneFlight& flight, const std::string& title);

}  // namespace fulmar::aero

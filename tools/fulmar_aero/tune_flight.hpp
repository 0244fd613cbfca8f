// SPDX-License-Identifier: BSD-3-Clause
// The hourglass, flown by `fulmar run` with gains that stand in no file yet.
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
  bool least = false;  ///< the bound is the least, not the most
  bool kept() const { return least ? value >= bound : value <= bound; }
};
struct TuneFlight {
  std::string result;   ///< "flown", or what became of it
  std::string stalled;  ///< when its wing stalled, in a sentence; empty when it did not
  std::vector<FlownFigure> figures;
  FlightTrack track;
  std::vector<std::array<double, 2>> corners_m;  ///< of the plan: north, east
};

/// `text`: of the airframe's file, with the gains. The plan is the shipped one near its 17 m/s, else the same
/// shape grown with the square of the airspeed, so that turns have the same bank.
TuneFlight fly_hourglass(const Airframe& airframe, const std::string& text, double airspeed_mps);

/// When the wing stalled, in a sentence; empty when it did not. A wing that a gust takes beyond its most lift
/// for a moment has not, nor one that is just thrown.
std::string stall_of(const FlightTrack& track, const Airframe& a);

std::string flight_text(const TuneFlight& flight);
nlohmann::json tune_flight_json(const TuneFlight& flight);
std::vector<std::string> flight_faults(const TuneFlight& flight, const std::string& title);

}  // namespace fulmar::aero

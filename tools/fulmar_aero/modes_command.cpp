// SPDX-License-Identifier: BSD-3-Clause
#include <fstream>

#include "core/app/program.hpp"
#include "core/error.hpp"
#include "tools/fulmar_aero/commands.hpp"
#include "tools/fulmar_aero/flight_model.hpp"
#include "tools/fulmar_aero/flight_words.hpp"
#include "tools/fulmar_aero/messages.hpp"
#include "tools/fulmar_aero/mode_words.hpp"
#include "tools/fulmar_aero/modes_svg.hpp"
#include "tools/fulmar_aero/words.hpp"

namespace fulmar::aero {
namespace {

struct Sweep {
  std::vector<ModesAtSpeed> found;
  std::vector<std::pair<double, std::string>> missing;  // airspeed, reason
};

Sweep sweep_over(const AirframeFile& file, const FlightOptions& options, const std::string& step) {
  const AircraftModel m(file.airframe, options.altitude_m());
  FlightOptions one = options;
  Sweep sweep;
  for (const double airspeed : options.airspeeds(file.airframe, step)) {
    one.airspeed = core::number_text(airspeed);
    const SteadyFlight flight = fly(m, one.condition(file.airframe));
    if (flight.found())
      sweep.found.push_back({airspeed, modes_in(m, flight)});
    else
      sweep.missing.emplace_back(airspeed, no_flight(file, m, flight));
  }
  return sweep;
}

/// Null for an absent value.
nlohmann::json when(bool there, double value) { return there ? nlohmann::json(value) : nlohmann::json(); }

nlohmann::json mode_json(const Mode& mode) {
  constexpr std::array<const char*, 8> names{"u", "w", "q", "pitch", "v", "p", "r", "roll"};
  nlohmann::json shares;
  for (std::size_t i = 0; i < names.size(); ++i) shares[names[i]] = mode.participation[i];
  return {{"mode", mode_name(mode.kind)},
          {"real_per_s", mode.eigenvalue.real()},
          {"imag_radps", mode.eigenvalue.imag()},
          {"natural_frequency_radps", when(mode.oscillates(), mode.natural_radps())},
          {"damping_ratio", when(mode.oscillates(), mode.damping_ratio())},
          {"period_s", when(mode.oscillates(), mode.period_s())},
          {"stable", mode.stable()},
          {"time_constant_s", mode.time_constant_s()},
          {"time_to_half_s", when(mode.stable(), mode.half_or_double_s())},
          {"time_to_double_s", when(!mode.stable(), mode.half_or_double_s())},
          {"participation_ratio", shares}};
}

nlohmann::json sweep_json(const AirframeFile& file, const FlightOptions& options, const Sweep& sweep) {
  nlohmann::json speeds = nlohmann::json::array(), missing = nlohmann::json::array();
  for (const ModesAtSpeed& at : sweep.found) {
    nlohmann::json modes = nlohmann::json::array();
    for (const Mode& mode : at.modes) modes.push_back(mode_json(mode));
    speeds.push_back({{"airspeed_mps", at.airspeed_mps}, {"modes", modes}});
  }
  for (const auto& [airspeed, why] : sweep.missing)
    missing.push_back({{"airspeed_mps", airspeed}, {"reason", why}});
  return {{"airframe", file.title()},
          {"altitude_m", options.altitude_m()},
          {"speeds", speeds},
          {"not_flown", missing}};
}

std::string sweep_text(const AirframeFile& file, const FlightOptions& options, const Sweep& sweep) {
  std::string text = file.title() + ": modes, " + fixed(options.altitude_m(), 0) + " m above the sea\n";
  for (const ModesAtSpeed& at : sweep.found) {
    text += "\n" + figures(at.airspeed_mps, 4) + " m/s\n" + mode_heading();
    for (const Mode& mode : at.modes) text += mode_line(mode);
  }
  return text;
}

void write_picture(const AirframeFile& file, const FlightOptions& options, const Sweep& sweep,
                   const std::string& name) {
  std::ofstream out(name, std::ios::binary);
  out << modes_svg(file.title() + ", modes at " + figures(sweep.found.front().airspeed_mps, 4) + " to " +
                       figures(sweep.found.back().airspeed_mps, 4) + " m/s (large), " +
                       fixed(options.altitude_m(), 0) + " m above the sea",
                   sweep.found);
  if (!out.flush()) throw core::Error(aero_messages::picture_not_writable(name));
}

}  // namespace

const char* mode_name(ModeKind kind) {
  switch (kind) {
    case ModeKind::short_period: return "short period";
    case ModeKind::phugoid: return "phugoid";
    case ModeKind::dutch_roll: return "Dutch roll";
    case ModeKind::roll: return "roll";
    case ModeKind::spiral: return "spiral";
    case ModeKind::roll_spiral: return "roll and spiral";
  }
  return "";
}

std::string mode_heading() {
  return "  " + padded("mode", 16) + right("eigenvalue, 1/s", 20) + right("frequency", 14) +
         right("damping", 10) + right("period", 10) + right("half or double", 18) + "\n";
}

std::string mode_line(const Mode& m) {
  const double real = m.eigenvalue.real(), imag = m.eigenvalue.imag();
  const std::string eigenvalue =
      m.oscillates() ? fixed(real, 4) + " +- " + fixed(imag, 4) + "i" : fixed(real, 4);
  return "  " + padded(mode_name(m.kind), 16) + right(eigenvalue, 20) +
         right(m.oscillates() ? fixed(m.natural_radps(), 3) + " rad/s" : "-", 14) +
         right(m.oscillates() ? fixed(m.damping_ratio(), 3) : "-", 10) +
         right(m.oscillates() ? fixed(m.period_s(), 2) + " s" : "-", 10) +
         right((m.stable() ? "half " : "double ") + fixed(m.half_or_double_s(), 2) + " s", 18) + "\n";
}

int modes_command(const FlightOptions& options, const std::string& step, const std::string& svg) {
  const AirframeFile file = read_airframe_file(options.airframe);
  const Sweep sweep = sweep_over(file, options, step);
  if (options.json) print_object(sweep_json(file, options, sweep));
  if (!options.json && !sweep.found.empty()) print_text(sweep_text(file, options, sweep));
  if (!options.json)
    for (const auto& [airspeed, why] : sweep.missing) std::fprintf(stderr, "%s\n", why.c_str());
  if (sweep.found.empty()) return core::ExitCode::failed;
  if (!svg.empty()) write_picture(file, options, sweep, svg);
  return core::ExitCode::done;
}

}  // namespace fulmar::aero

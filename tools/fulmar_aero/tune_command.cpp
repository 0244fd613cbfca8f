// SPDX-License-Identifier: BSD-3-Clause
#include <CLI/CLI.hpp>
#include <fstream>

#include "core/app/program.hpp"
#include "core/graph/quantity.hpp"
#include "core/graph/shipped.hpp"
#include "core/types/text.hpp"
#include "tools/fulmar_aero/commands.hpp"
#include "tools/fulmar_aero/flight_model.hpp"
#include "tools/fulmar_aero/flight_words.hpp"
#include "tools/fulmar_aero/gains.hpp"
#include "tools/fulmar_aero/gains_file.hpp"
#include "tools/fulmar_aero/messages.hpp"
#include "tools/fulmar_aero/tune_outcome.hpp"
#include "tools/fulmar_aero/words.hpp"

namespace fulmar::aero {
namespace {

struct BandwidthName {
  const char *name, *actuator;
  double Bandwidths::*value;
  int input;  ///< index of the lag
};
constexpr std::array<BandwidthName, 5> bandwidth_names{
    {{"roll", "aileron", &Bandwidths::roll, model::aileron},
     {"pitch", "elevator", &Bandwidths::pitch, model::elevator},
     {"course", "aileron", &Bandwidths::course, model::aileron},
     {"height", "elevator", &Bandwidths::height, model::elevator},
     {"airspeed", "throttle", &Bandwidths::airspeed, model::throttle}}};

double quantity(const char* option, const std::string& text, const std::string& unit, double least,
                double most) {
  try {
    const double value = core::quantity_in(text, unit, core::UnitRule::optional);
    if (value >= least && value <= most) return value;
    throw CLI::ValidationError(
        option, aero_messages::tuning_out_of_range(text, figures(least), figures(most, 4), unit).line());
  } catch (const core::Error& fault) {
    throw CLI::ValidationError(option, fault.what());
  }
}

Bandwidths bandwidths(const TuneOptions& options) {
  Bandwidths out;
  for (const std::string& one : options.bandwidths) {
    const std::size_t equals = one.find('=');
    const std::string name = one.substr(0, equals);
    std::vector<std::string> names;
    const BandwidthName* found = nullptr;
    for (const BandwidthName& b : bandwidth_names) {
      names.emplace_back(b.name);
      if (name == b.name) found = &b;
    }
    if (equals == std::string::npos || !found)
      throw CLI::ValidationError(
          "--bandwidth", aero_messages::bandwidth_loop_unknown(one, core::choices_text(name, names)).line());
    out.*found->value = quantity("--bandwidth", one.substr(equals + 1), "rad/s", 0.01, 1000);
  }
  return out;
}

std::string milliseconds(double s) { return figures(1000 * s) + " ms"; }

/// Message for a bandwidth beyond the actuator's lag; "" for none.
std::string beyond_actuators(const AirframeFile& file, const Plant& plant, const Bandwidths& given) {
  for (const BandwidthName& b : bandwidth_names) {
    const double w = given.*b.value, lag = plant.lag_s(b.input), most = max_bandwidth(lag);
    if (w <= most) continue;
    const std::string own = std::string(b.input == model::throttle ? "motor " : "servo ") +
                            milliseconds(lag - 0.5 * plant.step_s - plant.delay_s);
    const char* const field = b.input == model::throttle ? "propulsion" : b.actuator;
    return fulmar::located(file.title(), aero_messages::bandwidth_too_high(
                                             b.name, figures(w), b.actuator, own,
                                             milliseconds(0.5 * plant.step_s), milliseconds(plant.delay_s),
                                             milliseconds(lag), figures(most), file.where(field).text()))
        .line();
  }
  return "";
}

std::string heading(const AirframeFile& file, const Plant& plant, const Bandwidths& w) {
  return file.title() + ": about " + condition_words(plant.flight.condition, plant.altitude_m) + "\n" +
         aero_messages::tuning_assumptions(milliseconds(plant.step_s), milliseconds(plant.delay_s),
                                           milliseconds(plant.lag_s(model::aileron)),
                                           milliseconds(plant.lag_s(model::elevator)),
                                           milliseconds(plant.lag_s(model::throttle)))
             .line() +
         "\nchosen, rad/s: roll " + figures(w.roll) + ", pitch " + figures(w.pitch) + ", course " +
         figures(w.course) + ", height " + figures(w.height) + ", airspeed " + figures(w.airspeed) + "\n";
}

nlohmann::json gains_json(const std::vector<Gain>& gains, const std::vector<Gain>& shipped) {
  nlohmann::json out;
  for (std::size_t i = 0; i < gains.size(); ++i)
    out[gains[i].component][gains[i].name] = {
        {"computed", gains[i].value},
        {"shipped", shipped.empty() ? nlohmann::json(nullptr) : nlohmann::json(shipped[i].value)},
        {"unit", gains[i].unit}};
  return out;
}

void write_file(const AirframeFile& file, const std::string& text) {
  if (core::is_shipped_name(file.name))
    throw core::Error(located(file.name, aero_messages::shipped_file_read_only()));
  std::ofstream out(file.name);
  out << text;
  out.close();
  if (!out) throw core::Error(located(file.name, aero_messages::output_not_writable()));
}

/// The file's text with the gains, read again as a check.
std::string text_with(const AirframeFile& file, const std::vector<Gain>& gains) {
  const std::string text = with_gains(file, file.root.file->text, gains);
  AirframeFile read = file;
  core::Report report;
  read.root = core::parse_yaml(core::make_source(text, file.name), report);
  report.throw_if_any();
  std::vector<Gain> found = computed_gains(laws_in(read).laws, true);
  for (const Gain& gain : gains)
    for (const Gain& other : found)
      if (gain.component == other.component && gain.name == other.name &&
          gain_text(gain.value) != gain_text(other.value))
        throw core::Error(
            located(file.name, aero_messages::gain_form_unsupported(gain.component, gain.name)));
  return text;
}

}  // namespace

TuneOutcome tune_outcome(const FlightOptions& options, const TuneOptions& tune_options) {
  const AirframeFile file = read_airframe_file(options.airframe);
  const FileLaws shipped = laws_in(file);
  const Bandwidths given = bandwidths(tune_options);
  const AircraftModel m(file.airframe, options.altitude_m());
  const SteadyFlight flight = fly(m, options.condition(file.airframe));
  TuneOutcome outcome;
  const auto failed = [&](const std::string& sentence) {
    outcome.code = core::ExitCode::failed;
    outcome.faults.push_back(sentence);
    return outcome;
  };
  if (!flight.found()) return failed(no_flight(file, m, flight));
  Plant plant{file.airframe, linearised(m, flight), flight, m.altitude_m()};
  if (!tune_options.step.empty()) plant.step_s = quantity("--step", tune_options.step, "s", 0.001, 0.1);
  if (!tune_options.delay.empty()) plant.delay_s = quantity("--delay", tune_options.delay, "s", 0, 1);
  if (const std::string sentence = beyond_actuators(file, plant, given); !sentence.empty())
    return failed(sentence);

  const Tuning tuning = tune(plant, shipped.laws, given);
  outcome.gains = computed_gains(tuning.laws, tuning.yaw_damper);
  if (shipped.given) outcome.shipped_gains = computed_gains(shipped.laws, tuning.yaw_damper);
  outcome.computed = judge(plant, tuning.laws);
  if (shipped.given) outcome.shipped = judge(plant, shipped.laws);
  outcome.faults = outcome.computed.faults(file.title());
  for (const std::string& sentence : tuning.beyond) outcome.faults.push_back(file.title() + ": " + sentence);
  const std::string text = tune_options.write || tune_options.verify ? text_with(file, outcome.gains) : "";
  if (tune_options.verify) {
    outcome.flown = fly_hourglass(file.airframe, text, plant.flight.condition.airspeed_mps);
    for (const std::string& sentence : flight_faults(*outcome.flown, file.title()))
      outcome.faults.push_back(sentence);
  }
  if (options.json) {
    print_object({{"airframe", file.title()},
                  {"trim", flight_json(m, flight)},
                  {"step_s", plant.step_s},
                  {"delay_s", plant.delay_s},
                  {"gains", gains_json(outcome.gains, outcome.shipped_gains)},
                  {"computed", loops_json(outcome.computed)},
                  {"shipped", outcome.shipped ? loops_json(*outcome.shipped) : nlohmann::json(nullptr)},
                  {"flight", outcome.flown ? tune_flight_json(*outcome.flown) : nlohmann::json(nullptr)},
                  {"faults", outcome.faults}});
  } else {
    print_text(heading(file, plant, tuning.chosen) + loops_text("computed", outcome.computed));
    if (outcome.shipped) print_text(loops_text("shipped", *outcome.shipped));
    print_text("\n" + gains_text(outcome.gains, outcome.shipped_gains));
    if (outcome.flown) print_text(flight_text(*outcome.flown));
  }
  // insufficient gains are not written
  if (!outcome.faults.empty())
    outcome.code = core::ExitCode::failed;
  else if (tune_options.write)
    write_file(file, text);
  return outcome;
}

int tune_command(const FlightOptions& options, const TuneOptions& tune_options) {
  const TuneOutcome outcome = tune_outcome(options, tune_options);
  for (const std::string& sentence : outcome.faults)
    std::fprintf(stderr, "%s\n", core::for_terminal(sentence).c_str());
  return outcome.code;
}

}  // namespace fulmar::aero

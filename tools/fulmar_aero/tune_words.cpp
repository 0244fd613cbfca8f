// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_aero/tune_words.hpp"

#include "core/types/text.hpp"
#include "tools/fulmar_aero/messages.hpp"
#include "tools/fulmar_aero/words.hpp"

namespace fulmar::aero {
namespace {

std::string margin_words(const Margins& m) {
  const auto number = [](double x) { return std::isfinite(x) ? fixed(x, 0) : std::string("-"); };
  const auto db = [](double x) { return std::isfinite(x) ? fixed(x, 1) : std::string("-"); };
  return right(db(m.gain_db), 7) + right(db(m.reduction_db), 6) + right(number(m.phase_rad / degree), 6) +
         right(number(1000 * m.delay_s), 6);
}

nlohmann::json finite(double x) { return std::isfinite(x) ? nlohmann::json(x) : nlohmann::json(nullptr); }

/// A loop below 0 dB has no crossover.
nlohmann::json more_than_none(double radps) {
  return radps > 0 ? nlohmann::json(radps) : nlohmann::json(nullptr);
}

nlohmann::json margin_json(const std::string& at, const Margins& m) {
  return {{"at", at},
          {"gain_db", finite(m.gain_db)},
          {"reduction_db", finite(m.reduction_db)},
          {"phase_deg", finite(m.phase_rad / degree)},
          {"delay_s", finite(m.delay_s)},
          {"crossover_radps", more_than_none(m.crossover_radps)}};
}

void add_faults(const std::string& loop, const std::string& at, const Margins& m,
                std::vector<std::string>& all) {
  if (m.gain_db < min_margins.gain_db)
    all.push_back(aero_messages::gain_increase_small(loop, at, fixed(m.gain_db, 1)));
  if (m.reduction_db < min_margins.gain_db)
    all.push_back(aero_messages::gain_reduction_small(loop, at, fixed(m.reduction_db, 1)));
  if (m.phase_rad < min_margins.phase_rad)
    all.push_back(aero_messages::phase_margin_small(loop, at, fixed(m.phase_rad / degree, 0)));
}

}  // namespace

Judged judge(const Plant& plant, const Laws& laws) {
  Judged out;
  LoopReport slc = evaluate(plant, laws, OuterScheme::slc);
  const LoopReport tecs = evaluate(plant, laws, OuterScheme::tecs);
  out.unstable = std::max(slc.unstable, tecs.unstable);
  out.loops = std::move(slc.loops);
  for (const LoopFigures& f : tecs.loops)
    if (f.name.rfind("TECS", 0) == 0) out.loops.push_back(f);
  return out;
}

std::vector<std::string> Judged::faults(const std::string& title) const {
  std::vector<std::string> all;
  if (unstable > 0) all.push_back(aero_messages::closed_loops_unstable(unstable));
  for (const LoopFigures& f : loops) {
    add_faults(f.name, f.actuator, f.at_actuator, all);
    add_faults(f.name, f.sensor, f.at_sensor, all);
  }
  for (std::string& one : all) one = title + ": " + one;
  return all;
}

std::string bandwidth_words(const LoopFigures& f) {
  return f.bandwidth_radps > 0 ? fixed(f.bandwidth_radps, 2) : "-";
}

std::string loops_text(const std::string& title, const Judged& judged) {
  std::string text = "\n" + padded(title, 34) +
                     "at the actuator: dB   phase delay    at the sensor: dB   phase delay\n  " +
                     padded("loop", 14) + "rad/s  damping   " + padded("", 12) +
                     "   up  down   deg    ms    " + padded("", 8) + "   up  down   deg    ms\n";
  for (const LoopFigures& f : judged.loops)
    text += "  " + padded(f.name, 13) + right(bandwidth_words(f), 6) + right(fixed(f.damping_ratio, 2), 8) +
            "    " + padded(f.actuator, 13) + margin_words(f.at_actuator) + "    " + padded(f.sensor, 9) +
            margin_words(f.at_sensor) + "\n";
  if (judged.unstable > 0) text += "  not stable: " + std::to_string(judged.unstable) + " poles grow\n";
  return text;
}

nlohmann::json loops_json(const Judged& judged) {
  nlohmann::json loops = nlohmann::json::object();
  for (const LoopFigures& f : judged.loops)
    loops[f.name] = {{"bandwidth_radps", more_than_none(f.bandwidth_radps)},
                     {"damping_ratio", f.damping_ratio},
                     {"at_actuator", margin_json(f.actuator, f.at_actuator)},
                     {"at_sensor", margin_json(f.sensor, f.at_sensor)}};
  return {{"loops", loops}, {"unstable_poles", judged.unstable}};
}

std::string gains_text(const std::vector<Gain>& gains, const std::vector<Gain>& shipped) {
  std::string text = "params:\n", component;
  for (std::size_t i = 0; i < gains.size(); ++i) {
    const Gain& gain = gains[i];
    if (gain.component != component) text += "  " + gain.component + ":\n";
    component = gain.component;
    const std::string line = "    " + gain.name + ": " + gain_text(gain.value);
    text += shipped.empty() ? line + "\n"
                            : padded(line, 30) + "  # shipped " + gain_text(shipped[i].value) + "\n";
  }
  return text;
}

}  // namespace fulmar::aero

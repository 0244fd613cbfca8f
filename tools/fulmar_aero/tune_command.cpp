// SPDX-License-Identifier: BSD-3-Clause
#include "core/app/program.hpp"
#include "core/graph/shipped.hpp"
#include "core/types/text.hpp"
#include "tools/fulmar_aero/commands.hpp"
#include "tools/fulmar_aero/flight_model.hpp"
#include "tools/fulmar_aero/flight_words.hpp"
#include "tools/fulmar_aero/gains.hpp"
#include "tools/fulmar_aero/gains_file.hpp"
#include "tools/fulmar_aero/words.hpp"

namespace fulmar::aero {
namespace {

std::string margin_words(const Margins& m) {
  const auto db = [](double x) { return std::isfinite(x) ? fixed(x, 1) : std::string("-"); };
  return right(db(m.gain_db), 6) + right(db(m.reduction_db), 7) +
         right(std::isfinite(m.phase_rad) ? fixed(m.phase_rad / degree, 0) : "-", 6) +
         right(std::isfinite(m.delay_s) ? fixed(1000 * m.delay_s, 0) : "-", 6);
}

std::string loops_text(const std::string& title, const std::vector<LoopFigures>& loops) {
  std::string text = "\n" + title + "\n" + padded("", 16) + "bandwidth  damping   " +
                     padded("at the", 15) + "gain dB        phase delay   " + padded("at the sensor", 13) + "\n" +
                     padded("  loop", 16) + "    rad/s            " + padded("actuator", 15) +
                     "up   down    deg    ms\n";
  for (const LoopFigures& f : loops) {
    text += "  " + padded(f.name, 14) + right(fixed(f.bandwidth_radps, 2), 9) + right(fixed(f.damping_ratio, 2), 9) + "   " +
            padded(f.actuator, 13) + margin_words(f.at_actuator) + "   " + padded(f.sensor, 9) +
            margin_words(f.at_sensor) + "\n";
  }
  return text;
}

std::vector<LoopFigures> all_loops(const Plant& plant, const Laws& laws, int& unstable) {
  LoopReport slc = evaluate(plant, laws, OuterScheme::slc), tecs = evaluate(plant, laws, OuterScheme::tecs);
  unstable = slc.unstable + tecs.unstable;
  for (const LoopFigures& f : tecs.loops)
    if (f.name.rfind("TECS", 0) == 0) slc.loops.push_back(f);
  return slc.loops;
}

}  // namespace

int tune_command(const FlightOptions& options, const TuneOptions& tune_options) {
  const AirframeFile file = read_airframe_file(options.airframe);
  const FileLaws shipped = laws_in(file);
  const AircraftModel m(file.airframe, options.altitude_m());
  const SteadyFlight flight = fly(m, options.condition(file.airframe));
  if (!flight.found()) {
    std::fprintf(stderr, "%s\n", no_flight(file, m, flight).c_str());
    return core::ExitCode::failed;
  }
  const Plant plant{file.airframe, linearised(m, flight), flight, m.altitude_m(), 0.01, 0};
  const Tuning tuning = tune(plant, shipped.laws, {});
  int unstable = 0, unstable_shipped = 0;
  const auto loops = all_loops(plant, tuning.laws, unstable);
  print_text(loops_text("computed", loops));
  std::printf("unstable %d; thrust %g; a1 %g a2 %g\n", unstable, plant.thrust_newton(), -plant.linear.A(9,9), plant.linear.B(9,0));
  if (shipped.given) print_text(loops_text("shipped", all_loops(plant, shipped.laws, unstable_shipped)));
  std::printf("unstable %d\n", unstable_shipped);
  print_text(params_text(computed_gains(tuning.laws, tuning.yaw_damper)));
  (void)tune_options;
  return core::ExitCode::done;
}

}  // namespace fulmar::aero

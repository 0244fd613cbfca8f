// SPDX-License-Identifier: BSD-3-Clause
// Flies configs/missions/autotune.yaml from gains that are wrong by a factor, and evaluates the result with
// the linear model of the airframe, which the autotune does not use.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "core/run/flight.hpp"
#include "core/run/test/output_of.hpp"
#include "fulmar/msg/autotune_report.hpp"
#include "fulmar/msg/vehicle_state.hpp"
#include "tools/fulmar_aero/flight_model.hpp"
#include "tools/fulmar_aero/gains_file.hpp"
#include "tools/fulmar_aero/loops.hpp"

namespace fulmar::autotune {

namespace fs = std::filesystem;

inline constexpr std::array<const char*, 3> axes{"roll", "pitch", "yaw damper"};
inline constexpr double degree = std::numbers::pi / 180;

struct Aircraft {
  const char* name;
  double airspeed_mps, turn_radius_m;
};
inline constexpr std::array<Aircraft, 3> aircraft{
    {{"anaconda", 17, 50}, {"aerosonde", 25, 110}, {"x8", 18, 60}}};

struct Case {
  Aircraft of = aircraft[0];
  double factor = 1;
  std::string turbulence = "light";
  double wind_mps = 5;  ///< from the north-west
  unsigned seed = 1;
  std::string params{};  ///< further parameters of the component: ", time_limit: 60 s"
  std::string sim{};     ///< further parameters of the aircraft
};

struct Flown {
  bool done = false, crashed = false;
  AutotuneReport report{};
  std::array<Margins, 3> truth{};  ///< with the gains at the end, at the surface
  int unstable = 0;                ///< poles of the linear model with them
  double roll_rad = 0, pitch_rad = 0,
         height_m = 0;  ///< largest during the tuning; height and pitch relative to its begin
};

inline AutotuneVerdict verdict(const AutotuneReport& r, std::size_t axis) {
  return axis == 0 ? r.roll : axis == 1 ? r.pitch : r.yaw;
}

inline AutotuneReason reason(const AutotuneReport& r, std::size_t axis) {
  return axis == 0 ? r.roll_reason : axis == 1 ? r.pitch_reason : r.yaw_reason;
}

inline fs::path airframe_of(const Case& c) {
  return std::string(FULMAR_SOURCE_DIR "/configs/airframes/") + c.of.name + ".yaml";
}

inline aero::InnerLaw scaled(aero::InnerLaw law, double by) {
  for (aero::Number* n :
       {&law.roll_kp, &law.roll_ki, &law.roll_kd, &law.pitch_kp, &law.pitch_ki, &law.pitch_kd, &law.yaw_kd})
    n->value = std::clamp(n->value * by, n->min, n->max);
  return law;
}

/// Until the tuning is requested, the shipped gains are active. The X8 has no wheels: it is thrown.
inline fs::path mission_of(const Case& c, const aero::InnerLaw& law, const fs::path& folder) {
  const fs::path file = folder / "autotune.yaml";
  const bool thrown = std::string_view(c.of.name) == "x8";
  const auto gain = [](const char* name, double value) {
    return std::string(name) + ": " + std::to_string(value);
  };
  std::ofstream(file) << "mission: autotune\nextends: " FULMAR_SOURCE_DIR
                         "/configs/missions/autotune.yaml\nlive: off\ntimeout: 300 s\n"
                      << "airframe: " << airframe_of(c).string()
                      << "\ndone: {when: attitude.report.done, for: 2 s}\ncomponents:\n"
                      << "  sim: {params: {truth_rate: 100 Hz, turbulence: " << c.turbulence
                      << ", wind_ned: [" << c.wind_mps * std::numbers::sqrt2 / 2 << ", "
                      << -c.wind_mps * std::numbers::sqrt2 / 2 << ", 0]"
                      << (thrown ? ", launch: catapult, launch_after: 5 s" : "") << c.sim << "}}\n"
                      << (thrown ? "  slc: {params: {launch_acceleration: 15 m/s2, launch_delay: 0.3 s}}\n"
                                 : "")
                      << "  start: {fills: inner, use: control_slc/Inner, rate: 100 Hz}\n"
                      << "  plan: {params: {plan.airspeed: " << c.of.airspeed_mps
                      << " m/s, plan.turn_radius: " << c.of.turn_radius_m << " m}}\n"
                      << "  attitude: {params: {" << gain("roll_kp", law.roll_kp) << ", "
                      << gain("roll_ki", law.roll_ki) << ", " << gain("roll_kd", law.roll_kd) << ", "
                      << gain("pitch_kp", law.pitch_kp) << ", " << gain("pitch_ki", law.pitch_ki) << ", "
                      << gain("pitch_kd", law.pitch_kd) << ", " << gain("yaw_kd", law.yaw_kd) << c.params
                      << "}}\n"
                      << "phases:\n  hold: {inner: start"
                      << (thrown ? ", outer: {use: slc, set: {law: takeoff}}" : "")
                      << "}\n  takeoff: {inner: start}\n  cruise: {inner: start}\n";
  return file;
}

/// Margins of the linear model in steady level flight, one loop broken at its surface with the others closed.
inline void judge(const Case& c, const aero::AirframeFile& file, aero::InnerLaw law, Flown& out) {
  constexpr double altitude_m = 1457;
  const AutotuneReport& r = out.report;
  law.roll_kp.value = r.kp_ratio[0];
  law.roll_ki.value = r.ki_ratio[0];
  law.roll_kd.value = r.kd_ratio[0];
  law.pitch_kp.value = r.kp_ratio[1];
  law.pitch_ki.value = r.ki_ratio[1];
  law.pitch_kd.value = r.kd_ratio[1];
  law.yaw_kd.value = r.kd_ratio[2];
  const AircraftModel m(file.airframe, altitude_m);
  SteadyCondition condition;
  condition.airspeed_mps = c.of.airspeed_mps;
  const SteadyFlight flight = aero::fly(m, condition);
  const aero::Plant plant{file.airframe, aero::linearised(m, flight), flight, altitude_m};
  aero::Laws laws = aero::laws_in(file).laws;
  laws.inner = law;
  const aero::LoopReport loops = aero::evaluate(plant, laws, aero::OuterScheme::none);
  out.unstable = loops.unstable;
  for (const aero::LoopFigures& f : loops.loops)
    for (std::size_t i = 0; i < axes.size(); ++i)
      if (f.name == axes[i]) out.truth[i] = f.at_actuator;
}

inline Flown fly(const Case& c, const fs::path& folder) {
  const aero::AirframeFile file = aero::read_airframe_file(airframe_of(c).string());
  const aero::InnerLaw law = scaled(aero::laws_in(file).laws.inner, c.factor);
  core::Overrides overrides;
  overrides.seed = c.seed;
  const core::Graph graph = core::load_mission(mission_of(c, law, folder).string(), overrides);
  core::FlightOptions options;
  options.log = false;
  core::Flight flight(graph, options);
  const core::Source reported = core::output_of(graph, "attitude", "report"),
                     truth = core::output_of(graph, "sim", "truth");
  Flown out;
  bool begun = false;
  double begun_m = 0, begun_pitch = 0;
  while (flight.step()) {
    const auto* const r = reinterpret_cast<const AutotuneReport*>(flight.sample(reported));
    const auto* const x = reinterpret_cast<const VehicleState*>(flight.sample(truth));
    if (!r || !x) continue;
    out.report = *r;
    if (r->stage == AutotuneStage::idle || r->done) continue;
    if (!begun) {
      begun = true;
      begun_m = x->height_m;
      begun_pitch = x->pitch_rad;
    }
    out.roll_rad = std::max(out.roll_rad, std::abs(x->roll_rad));
    out.pitch_rad = std::max(out.pitch_rad, std::abs(x->pitch_rad - begun_pitch));
    out.height_m = std::max(out.height_m, std::abs(x->height_m - begun_m));
  }
  out.crashed = flight.finish().outcome != core::Outcome::flown;
  out.done = out.report.done;
  judge(c, file, law, out);
  return out;
}

/// The axis has its initial gains.
inline bool went_back(const AutotuneReport& r, std::size_t i) {
  return r.kp_ratio[i] == r.before_kp_ratio[i] && r.ki_ratio[i] == r.before_ki_ratio[i] &&
         r.kd_ratio[i] == r.before_kd_ratio[i];
}

/// Guarantee of the autotune for one axis: measured margins, or the old gains.
inline bool promised(const AutotuneReport& r, std::size_t i) {
  if (verdict(r, i) != AutotuneVerdict::kept) return went_back(r, i);
  return 20 * std::log10(r.gain_margin_ratio[i]) >= 6 - 1e-9 && r.phase_margin_rad[i] >= 45 * degree;
}

}  // namespace fulmar::autotune

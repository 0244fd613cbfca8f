// SPDX-License-Identifier: BSD-3-Clause
// One flight at the edge of the envelope, with another aircraft than that of the laws, evaluated by the
// truth.
#pragma once
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "core/run/flight.hpp"
#include "core/run/test/output_of.hpp"
#include "fulmar/msg/airframe.hpp"
#include "fulmar/msg/controller_internals.hpp"
#include "fulmar/msg/vehicle_state.hpp"
#include "fulmar/msg/vehicle_status.hpp"
#include "fulmar/random.hpp"

namespace fulmar::envelope_bench {

inline constexpr std::array laws{"slc", "tecs", "errors"};
inline constexpr std::array turbulences{"none", "light", "moderate", "severe"};

/// An aircraft, and its static margin in the model of the laws; 0: that of its file.
struct Kind {
  const char *name, *airframe;
  double static_margin_ratio, mass_ratio, drag_ratio;
};
inline constexpr std::array<Kind, 5> kinds{{{"anaconda", "anaconda", 0, 1, 1},
                                            {"aerosonde", "aerosonde", 0, 1, 1},
                                            {"x8", "x8", 0, 1, 1},
                                            {"anaconda, margin 15 %", "anaconda", 0.15, 1, 1},
                                            {"aerosonde, margin 10 %, less drag", "aerosonde", 0.1, 1, 0.7}}};

/// Differences from the nominal case, all drawn from the seed.
struct Dispersion {
  std::uint64_t seed = 1;
  const Kind* kind = nullptr;
  const char *law = "", *turbulence = "";
  double mass_ratio = 1, engine_share = 1, cg_aft_ratio = 0, wind_mps = 0, wind_from_rad = 0;
  std::array<double, 3> gust_mps{};  ///< body axes, every 20 s; none: 0
};

inline Dispersion dispersion(std::uint64_t seed) {
  constexpr double gust = 16, turn = 2 * std::numbers::pi;
  Random random(mix_seed(seed, 7));
  Dispersion d;
  d.seed = seed;
  d.kind = &kinds[seed % kinds.size()];
  d.law = laws[seed / kinds.size() % laws.size()];
  d.turbulence = turbulences[std::min<std::size_t>(static_cast<std::size_t>(random.uniform(0, 4)), 3)];
  d.mass_ratio = random.uniform(0.85, 1.15);
  d.engine_share = random.uniform(0.75, 1);
  d.cg_aft_ratio = random.uniform(-0.1, 0.2);
  d.wind_mps = random.uniform(0, 5);
  d.wind_from_rad = random.uniform(0, turn);
  const double axis = random.uniform(0, 8);  // half of the flights have none
  const double size = random.uniform(0, 1) < 0.5 ? gust : -gust;
  if (axis < 1)
    d.gust_mps[0] = size;
  else if (axis < 2)
    d.gust_mps[1] = size;
  else if (axis < 4)
    d.gust_mps[2] = size;
  return d;
}

/// The aircraft in the parameters of the laws.
inline Airframe known(const Kind& kind, const Airframe& file) {
  Airframe a = file;
  if (kind.static_margin_ratio > 0)
    a.aero.pitch.alpha_ratio = -kind.static_margin_ratio * a.aero.lift.alpha_ratio;
  a.aero.parasite_drag_ratio *= kind.drag_ratio;
  return a;
}

/// The simulated aircraft. A centre of gravity further aft reduces the static margin, of which at least 2 %
/// remain: an unstable aircraft is out of scope.
inline Airframe flown(const Airframe& nominal, const Dispersion& d) {
  Airframe a = nominal;
  a.mass_kg *= d.mass_ratio;
  for (double* const J : {&a.inertia.xx_kgm2, &a.inertia.yy_kgm2, &a.inertia.zz_kgm2, &a.inertia.xz_kgm2})
    *J *= d.mass_ratio;
  const double margin = -a.aero.pitch.alpha_ratio / a.aero.lift.alpha_ratio;
  const double aft = std::min(d.cg_aft_ratio, margin - 0.02);
  a.aero.pitch.alpha_ratio += aft * a.aero.lift.alpha_ratio;
  a.aero.pitch.zero_ratio += aft * a.aero.lift.zero_ratio;
  a.aero.pitch.elevator_ratio += aft * a.aero.lift.elevator_ratio;
  return a;
}

/// A trivial type, which can be sent through a pipe.
struct Flown {
  std::uint64_t seed = 0;
  bool ended = false, crashed = false;
  double crash_s = 0;
  double stalled_s = 0;  ///< longest time in which alpha stayed beyond the airframe's stall
  double stalled_at_s = 0;
  double lowest_m = 1e9;  ///< in cruise
  int reported = 0;       ///< stalls reported by the law
  int lost_height = 0;
  double calm_m = 0;  ///< RMS of the height error, cruise
};

class Watched {
 public:
  Watched(const core::Graph& graph, const Dispersion& d, double stall_rad)
      : stall_rad_(stall_rad), flight_(graph, unlogged()) {
    out_.seed = d.seed;
    truth_ = output_of(graph, "sim", "truth");
    internals_ = output_of(graph, d.law, "internals");
  }
  Flown fly() {
    while (flight_.step()) look();
    const core::FlightResult r = flight_.finish();
    out_.crashed = r.reason.find("crashed") != std::string::npos;
    out_.ended = r.outcome == core::Outcome::flown || r.reason.find("timeout") != std::string::npos;
    if (out_.crashed) out_.crash_s = 1e-9 * static_cast<double>(r.last_ns);
    out_.calm_m = n_ > 0 ? std::sqrt(squares_ / n_) : 0;
    return out_;
  }

 private:
  static core::FlightOptions unlogged() {
    core::FlightOptions o;
    o.log = false;
    return o;
  }
  void look() {
    const auto* const x = reinterpret_cast<const VehicleState*>(flight_.sample(truth_));
    const auto* const said = reinterpret_cast<const ControllerInternals*>(flight_.sample(internals_));
    if (!x || !said || flight_.phase() != "cruise") return;
    const double now = 1e-9 * static_cast<double>(flight_.now_ns());
    if (x->alpha_rad < stall_rad_) since_s_ = now;
    if (now - since_s_ > out_.stalled_s) {
      out_.stalled_s = now - since_s_;
      out_.stalled_at_s = now;
    }
    out_.lowest_m = std::min(out_.lowest_m, x->height_m);
    out_.reported += said->stalled && !before_.stalled;
    out_.lost_height += said->height_uncontrolled && !before_.height_uncontrolled;
    before_ = *said;
    squares_ += said->height_error_m * said->height_error_m;
    ++n_;
  }

  double stall_rad_;
  core::Flight flight_;
  core::Source truth_, internals_;
  ControllerInternals before_;
  Flown out_;
  double since_s_ = 0, squares_ = 0, n_ = 0;
};

inline std::string text(double x) {
  char t[40];
  std::snprintf(t, sizeof t, "%.9g", x);
  return t;
}

inline core::Overrides overrides(const Dispersion& d, const Airframe& file) {
  core::Overrides o;
  o.seed = d.seed;
  o.roles = {{"outer", d.law}};
  const Airframe nominal = known(*d.kind, file), body = flown(nominal, d);
  for (const char* component : {"sim", "slc", "tecs", "errors", "attitude"}) {
    const bool sim = std::string(component) == "sim";
    const Airframe& a = sim ? body : nominal;
    const std::string of = std::string(component) + ".airframe.";
    o.set.emplace_back(of + "aero.pitch.alpha_ratio", text(a.aero.pitch.alpha_ratio));
    o.set.emplace_back(of + "aero.parasite_drag_ratio", text(a.aero.parasite_drag_ratio));
    if (!sim) continue;
    o.set.emplace_back(of + "aero.pitch.zero_ratio", text(a.aero.pitch.zero_ratio));
    o.set.emplace_back(of + "aero.pitch.elevator_ratio", text(a.aero.pitch.elevator_ratio));
    o.set.emplace_back(of + "mass_kg", text(a.mass_kg));
    o.set.emplace_back(of + "inertia.xx_kgm2", text(a.inertia.xx_kgm2));
    o.set.emplace_back(of + "inertia.yy_kgm2", text(a.inertia.yy_kgm2));
    o.set.emplace_back(of + "inertia.zz_kgm2", text(a.inertia.zz_kgm2));
    o.set.emplace_back(of + "inertia.xz_kgm2", text(a.inertia.xz_kgm2));
  }
  const double scale = file.limits.airspeed_min_mps / 12;  // turns of a faster aircraft are wider
  o.set.emplace_back("plan.plan.turn_radius_m", text(50 * scale * scale));
  o.set.emplace_back("plan.plan.airspeed_mps", text(file.limits.airspeed_min_mps));
  o.set.emplace_back("sim.engine_fault", "weak");
  o.set.emplace_back("sim.engine_fault_share", text(d.engine_share));
  o.set.emplace_back("sim.turbulence", d.turbulence);
  o.set.emplace_back("sim.wind_speed", text(d.wind_mps));
  o.set.emplace_back("sim.wind_from", text(d.wind_from_rad));
  if (d.gust_mps != std::array<double, 3>{}) {
    o.set.emplace_back("sim.gust", "[" + text(d.gust_mps[0]) + ", " + text(d.gust_mps[1]) + ", " +
                                       text(d.gust_mps[2]) + "]");
    o.set.emplace_back("sim.gust_at", "40");
    o.set.emplace_back("sim.gust_every", "20");
  }
  return o;
}

}  // namespace fulmar::envelope_bench

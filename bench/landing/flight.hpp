// SPDX-License-Identifier: BSD-3-Clause
// One flight from runway to runway with another aircraft than that of the laws, evaluated by the truth.
#pragma once
#include <array>
#include <cmath>
#include <deque>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/run/flight.hpp"
#include "core/run/test/output_of.hpp"
#include "fulmar/flight/earth/geodesy.hpp"
#include "fulmar/flight/math/angles.hpp"
#include "fulmar/flight/model/steady_flight.hpp"
#include "fulmar/msg/actuators.hpp"
#include "fulmar/msg/contact_truth.hpp"
#include "fulmar/msg/gnss.hpp"
#include "fulmar/msg/ground_state.hpp"
#include "fulmar/msg/landing_progress.hpp"
#include "fulmar/msg/vehicle_state.hpp"
#include "fulmar/random.hpp"

namespace fulmar::landing_bench {

inline constexpr double deg = std::numbers::pi / 180;
inline constexpr double runway_heading_rad = 135 * deg;  // of the mission; its threshold is the origin

/// Differences from the nominal case, all drawn from the seed.
struct Dispersion {
  std::uint64_t seed = 1;
  double wind_mps = 0, wind_off_rad = 0;  ///< direction of its origin, to the right of the runway's heading
  double mass_ratio = 1, delay_s = 0;
  bool ublox = false, slow_servos = false;
  // Only in harder draws.
  std::string aircraft = "anaconda", mission = "mission", sensors;  ///< sensors: "" for those of `ublox`
  double cg_share = 0;                                              ///< aft, of the chord
  double engine_share = 1, slope_rad = 0, height_off_m = 0;
  bool moderate = false;
  std::vector<std::pair<const char*, double>> derivatives;  ///< factors of the derivatives
};

/// `max_wind_mps` at most `max_off_rad` off the runway.
inline Dispersion dispersion(std::uint64_t seed, double max_wind_mps = 12, double max_off_rad = 30 * deg) {
  Dispersion d;
  Random random(mix_seed(seed, 1));
  d.seed = seed;
  d.wind_mps = random.uniform(0, max_wind_mps);
  d.wind_off_rad = random.uniform(-max_off_rad, max_off_rad);
  d.mass_ratio = random.uniform(0.9, 1.1);
  d.delay_s = random.uniform(0, 0.1);
  d.ublox = seed % 2 == 0;
  d.slow_servos = seed / 2 % 2 == 0;
  for (const char* name : {"lift.alpha", "lift.q", "lift.elevator", "side.beta", "side.rudder", "roll.beta",
                           "roll.p", "roll.r", "roll.aileron", "roll.rudder", "pitch.alpha", "pitch.q",
                           "pitch.elevator", "yaw.beta", "yaw.p", "yaw.r", "yaw.aileron", "yaw.rudder"})
    d.derivatives.emplace_back(name, random.uniform(0.8, 1.2));
  return d;
}

/// The same, with further draws of aircraft, centre of gravity, motor, slope, height, sensors, turbulence.
inline Dispersion hard_dispersion(std::uint64_t seed, double max_height_off_m = 6) {
  Dispersion d = dispersion(seed);
  Random random(mix_seed(seed, 2));
  constexpr std::array aircraft{"anaconda", "aerosonde", "x8"};
  constexpr std::array sensors{"rosflight", "ublox", "mems_budget"};
  d.aircraft = aircraft[seed % aircraft.size()];
  d.mission = "hard_" + d.aircraft;
  d.sensors = sensors[seed / aircraft.size() % sensors.size()];
  d.cg_share = random.uniform(-0.1, 0.2);
  d.engine_share = random.uniform(0.75, 1);
  d.slope_rad = random.uniform(-1.5, 1.5) * deg;
  d.height_off_m = random.uniform(-max_height_off_m, max_height_off_m);
  d.moderate = random.uniform(0, 1) < 0.3;
  return d;
}

/// Value of the file; `airframe` is the model of the laws.
inline double& derivative(Aerodynamics& a, const std::string& name) {
  const std::string of = name.substr(0, name.find('.')), over = name.substr(name.find('.') + 1);
  Derivatives& d = of == "lift"    ? a.lift
                   : of == "side"  ? a.side
                   : of == "roll"  ? a.roll
                   : of == "pitch" ? a.pitch
                                   : a.yaw;
  if (over == "alpha") return d.alpha_ratio;
  if (over == "beta") return d.beta_ratio;
  if (over == "p") return d.p_ratio;
  if (over == "q") return d.q_ratio;
  if (over == "r") return d.r_ratio;
  if (over == "aileron") return d.aileron_ratio;
  return over == "elevator" ? d.elevator_ratio : d.rudder_ratio;
}

inline Airframe dispersed(const Airframe& nominal, const Dispersion& d) {
  Airframe a = nominal;
  a.mass_kg *= d.mass_ratio;
  for (double* const J : {&a.inertia.xx_kgm2, &a.inertia.yy_kgm2, &a.inertia.zz_kgm2, &a.inertia.xz_kgm2})
    *J *= d.mass_ratio;
  for (const auto& [name, ratio] : d.derivatives) derivative(a.aero, name) *= ratio;
  // Moments about a centre of gravity further aft by that share of the chord, Etkin & Reid, 2.3.
  a.aero.pitch.alpha_ratio += a.aero.lift.alpha_ratio * d.cg_share;
  a.aero.pitch.zero_ratio += a.aero.lift.zero_ratio * d.cg_share;
  a.aero.pitch.elevator_ratio += a.aero.lift.elevator_ratio * d.cg_share;
  return a;
}

/// Results of a flight; a trivial type, which can be sent through a pipe.
struct Landed {
  std::uint64_t seed = 0;
  bool flown = false, crashed = false, touched = false;
  double min_over_stall = 1e9;  ///< 1 s mean of the true airspeed over this aircraft's stall, aloft
  double sink_mps = 0;          ///< at the touch-down
  double cross_m = 0;           ///< distance from the centre line, right positive, at the touch-down
  double receiver_m = 0;        ///< error of the receiver across the runway, at the touch-down
  double along_m = 0;           ///< behind the threshold, at the touch-down
  double yaw_off_rad = 0;       ///< yaw to the right of the runway, at the touch-down
  double roll_rad = 0;
  double roll_out_m = 0;  ///< largest distance from the centre line during the roll
  std::uint32_t go_arounds = 0;
  double recognised_s = 1e9;  ///< from the true touch-down to the estimated one
  double early_m = 0;         ///< largest height above the place of the touch-down at an earlier detection
  double nose_down_s = 0;     ///< longest time with more than half of the elevator down, after the touch-down
  double stopped_m = 0;       ///< behind the threshold
  double beside_receiver_m() const { return std::abs(cross_m + receiver_m); }
};

class Watched {
 public:
  Watched(const core::Graph& graph, const Airframe& flown, std::uint64_t seed, const std::string& log)
      : flown_(flown), max_lift_(max_lift(flown).coefficient), flight_(graph, logged_to(log)) {
    out_.seed = seed;
    truth_ = output_of(graph, "sim", "truth");
    contact_ = output_of(graph, "sim", "contact");
    gnss_ = output_of(graph, "sim", "gnss");
    progress_ = output_of(graph, "land", "progress");
    ground_ = output_of(graph, "ground", "state");
    actuators_ = output_of(graph, "attitude", "actuators");
  }

  Landed fly() {
    while (flight_.step()) {
      const auto* const x = at<VehicleState>(truth_);
      const auto* const contact = at<ContactTruth>(contact_);
      if (x && contact && flight_.now_ns() > 0) look(*x, contact->touching);
    }
    const core::FlightResult result = flight_.finish();
    out_.flown = result.outcome == core::Outcome::flown && result.guards.empty();
    // A touch-down that is a crash ends the flight in that tick.
    out_.crashed =
        result.outcome != core::Outcome::flown && result.reason.find("crashed") != std::string::npos;
    if (out_.crashed) {
      out_.sink_mps = -before_.climb_rate_mps;
      out_.touched = true;
    }
    return out_;
  }

 private:
  static core::FlightOptions logged_to(const std::string& file) {
    core::FlightOptions o;
    o.log = !file.empty();
    o.log_file = file;
    return o;
  }
  template <class T>
  const T* at(const core::Source& source) const {
    return reinterpret_cast<const T*>(flight_.sample(source));
  }
  static double cross(double north, double east) {
    return std::cos(runway_heading_rad) * east - std::sin(runway_heading_rad) * north;
  }

  void look(const VehicleState& x, bool touching) {
    const LandingProgress p =
        at<LandingProgress>(progress_) ? *at<LandingProgress>(progress_) : LandingProgress{};
    out_.go_arounds = p.go_arounds;
    const double c = cross(x.position_m.north, x.position_m.east);
    recognise(x);
    const bool landing = p.stage == LandingStage::approach || p.stage >= LandingStage::flare;
    receiver(x);
    if (touching && flight_.phase() == "takeoff") {
      recent_.clear();
      sum_ = 0;
    }
    if (!touching && !landing_begun(p) && !out_.touched) aloft(x);
    if (touching && landing && p.stage != LandingStage::go_around && flight_.phase() != "takeoff" &&
        !out_.touched) {
      out_.touched = true;
      out_.sink_mps = -before_.climb_rate_mps;
      out_.cross_m = c;
      out_.along_m = std::cos(runway_heading_rad) * x.position_m.north +
                     std::sin(runway_heading_rad) * x.position_m.east;
      out_.receiver_m = receiver_m_;
      out_.yaw_off_rad = angle_difference(before_.yaw_rad, runway_heading_rad);
      out_.roll_rad = before_.roll_rad;
    }
    if (out_.touched) rolling(x, c);
    before_ = x;
  }
  static double along(const VehicleState& x) {
    return std::cos(runway_heading_rad) * x.position_m.north +
           std::sin(runway_heading_rad) * x.position_m.east;
  }
  void rolling(const VehicleState& x, double c) {
    out_.roll_out_m = std::max(out_.roll_out_m, std::abs(c));
    out_.stopped_m = std::max(out_.stopped_m, along(x));
    if (touched_s_ < 0) touched_s_ = now_s();
    if (estimated_ && out_.recognised_s == 1e9) out_.recognised_s = std::max(now_s() - touched_s_, 0.0);
    const auto* const u = at<Actuators>(actuators_);
    const bool down = u && u->elevator_rad > 0.5 * flown_.elevator.limit_rad && x.airspeed_mps > 8;
    nose_down_s_ = down ? nose_down_s_ + 0.0025 : 0;
    out_.nose_down_s = std::max(out_.nose_down_s, nose_down_s_);
  }
  /// A detection before the true touch-down counts if it is still valid then.
  void recognise(const VehicleState& x) {
    const auto* const g = at<GroundState>(ground_);
    const bool was = estimated_;
    estimated_ = g && g->lift_offs > 0 && g->contact == Contact::ground;
    if (estimated_ && !was && !out_.touched) early_height_m_ = x.height_m;
    if (early_height_m_ < 1e9 && out_.touched) {
      out_.early_m = std::max(out_.early_m, early_height_m_ - x.height_m);
      early_height_m_ = 1e9;
    }
  }
  double now_s() const { return 1e-9 * static_cast<double>(flight_.now_ns()); }
  /// The airspeed is no longer evaluated from the flare on.
  static bool landing_begun(const LandingProgress& p) {
    return p.stage == LandingStage::flare || p.stage == LandingStage::roll_out ||
           p.stage == LandingStage::stopped;
  }
  void aloft(const VehicleState& x) {
    constexpr std::size_t second = 400;
    recent_.push_back(x.airspeed_mps);
    sum_ += x.airspeed_mps;
    if (recent_.size() > second) {
      sum_ -= recent_.front();
      recent_.pop_front();
    }
    if (recent_.size() < second) return;
    const double rho = standard_air(x.origin_altitude_m + x.height_m).density_kgm3;
    const double stall = std::sqrt(2 * flown_.mass_kg * isa::g0 / (rho * flown_.wing.area_m2 * max_lift_));
    out_.min_over_stall = std::min(out_.min_over_stall, sum_ / second / stall);
  }
  /// Mean error of the receiver over a second, across the runway.
  void receiver(const VehicleState& x) {
    const auto* const g = at<Gnss>(gnss_);
    if (!g || g->utc_ns == last_fix_) return;
    last_fix_ = g->utc_ns;
    const Eigen::Vector3d p_n = frame_.to_ned(g->latitude_deg, g->longitude_deg, g->altitude_m);
    const double off = cross(p_n.x(), p_n.y()) - cross(x.position_m.north, x.position_m.east);
    receiver_m_ += 0.1 * (off - receiver_m_);
  }

  Airframe flown_;
  double max_lift_;
  core::Flight flight_;
  core::Source truth_, contact_, gnss_, progress_, ground_, actuators_;
  bool estimated_ = false;
  double nose_down_s_ = 0, touched_s_ = -1, early_height_m_ = 1e9;
  LocalFrame frame_{40.2463724, -111.6474138, 1387};
  Landed out_;
  VehicleState before_;
  std::deque<double> recent_;
  double sum_ = 0, receiver_m_ = 0;
  std::int64_t last_fix_ = 0;
};

/// `set`: parameters of any component in addition to the dispersion; `log`: a file, or "".
inline Landed fly(const Dispersion& d, const Airframe& nominal,
                  const std::vector<std::pair<std::string, std::string>>& set = {},
                  const std::string& log = "") {
  core::Overrides o;
  o.seed = d.seed;
  const Airframe a = dispersed(nominal, d);
  const double from = runway_heading_rad + d.wind_off_rad, back = -d.wind_mps;
  const std::string file = "sim.sensor_file", body = "sim.airframe.";
  o.set = {{file, std::string(FULMAR_SOURCE_DIR "/configs/sensors/") +
                      (!d.sensors.empty() ? d.sensors
                       : d.ublox          ? "ublox"
                                          : "rosflight") +
                      ".yaml"},
           {"sim.wind_ned", "[" + std::to_string(back * std::cos(from)) + ", " +
                                std::to_string(back * std::sin(from)) + ", 0]"},
           {body + "mass_kg", std::to_string(a.mass_kg)},
           {body + "inertia.xx_kgm2", std::to_string(a.inertia.xx_kgm2)},
           {body + "inertia.yy_kgm2", std::to_string(a.inertia.yy_kgm2)},
           {body + "inertia.zz_kgm2", std::to_string(a.inertia.zz_kgm2)},
           {body + "inertia.xz_kgm2", std::to_string(a.inertia.xz_kgm2)}};
  for (const char* sensor : {"gnss", "baro", "mag", "pitot"}) {
    const double own =
        (d.sensors.empty() ? d.ublox : d.sensors != "rosflight") && std::string(sensor) == "gnss" ? 0.15 : 0;
    o.set.emplace_back(file + "." + sensor + ".timing.latency_s", std::to_string(own + d.delay_s));
  }
  Airframe changed = a;
  for (const auto& [name, ratio] : d.derivatives)
    o.set.emplace_back(body + "aero." + name + "_ratio", std::to_string(derivative(changed.aero, name)));
  if (d.slow_servos) {
    for (const char* surface : {"aileron", "elevator", "rudder"})
      o.set.emplace_back("sim." + std::string(surface) + "_fault", "slow");
    o.set.emplace_back("sim.fault_speed", "0.5");
  }
  if (d.engine_share < 1) {
    o.set.emplace_back("sim.engine_fault", "weak");
    o.set.emplace_back("sim.engine_fault_share", std::to_string(d.engine_share));
  }
  if (d.slope_rad != 0) {
    o.set.emplace_back("sim.ground_slope", std::to_string(std::abs(d.slope_rad)));
    const double rises = d.slope_rad > 0 ? runway_heading_rad : runway_heading_rad - std::numbers::pi;
    o.set.emplace_back("sim.ground_slope_towards", std::to_string(rises));
  }
  if (d.height_off_m != 0) o.set.emplace_back("land.runway.up_m", std::to_string(d.height_off_m));
  if (d.moderate) o.set.emplace_back("sim.turbulence", "moderate");
  for (const auto& one : set) o.set.push_back(one);
  const std::string mission = FULMAR_SOURCE_DIR "/bench/landing/" + d.mission + ".yaml";
  return Watched(core::load_mission(mission, o), a, d.seed, log).fly();
}

}  // namespace fulmar::landing_bench

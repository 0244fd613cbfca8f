// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_aero/gains.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <string>

#include "tools/fulmar_aero/flight_model.hpp"
#include "tools/fulmar_aero/words.hpp"

namespace fulmar::aero {
namespace {

/// The printed number, so that the file holds the same value.
double rounded(double x) { return std::stod(figures(x, 2)); }

/// Figures of the airframe, and the relations of plugins/control_slc/README.md, "Gains from bandwidths".
struct Relations {
  const Plant& plant;
  double Va, scale;  ///< scale: factor of the gains in the inner law at this airspeed

  explicit Relations(const Plant& plant_)
      : plant(plant_),
        Va(plant_.flight.condition.airspeed_mps),
        scale(std::pow(plant_.airframe.limits.airspeed_cruise_mps / Va, 2)) {}

  double a1() const { return -plant.linear.A(model::p, model::p); }
  double a2() const { return plant.linear.B(model::p, model::aileron); }

  void roll(double w, InnerLaw& p) const {
    constexpr double damping = 1;
    const double rate = (2 * damping * w - a1()) / a2();
    // an airframe with more damping: its slower pole is at w
    const double kp = rate >= 0 ? w * w / a2() : w * (a1() - w) / a2();
    p.roll_kp.value = kp / scale;
    p.roll_kd.value = std::max(rate, 0.0) / scale;
    p.roll_ki.value = kp / scale * 0.01 * w;
    p.roll_kff.value = a1() / a2() / std::sqrt(scale);
  }

  /// Of w and q, with the rate fed back.
  Eigen::Matrix2d short_period(double kd) const {
    constexpr std::array<int, 2> states{model::w, model::q};
    Eigen::Matrix2d M = plant.linear.A(states, states);
    M.col(1) += kd * elevator();
    return M;
  }
  Eigen::Vector2d elevator() const {
    return {plant.linear.B(model::w, model::elevator), plant.linear.B(model::q, model::elevator)};
  }
  /// `share`: share of the rate feedback that damps the short period fully.
  void pitch(double w, double share, InnerLaw& p) const {
    constexpr double damping = 1.0, most = 2.0;
    double kd = 0;
    const auto damped = [&](double k) {
      const Eigen::Matrix2d M = short_period(k);
      return -M.trace() >= 2 * damping * std::sqrt(std::max(M.determinant(), 0.0));
    };
    while (kd < most && !damped(kd)) kd += 0.005;
    kd *= share;
    p.pitch_kd.value = kd / scale;
    const double turn = short_period(kd).fullPivLu().solve(elevator())(1);  // steady -q per elevator
    p.pitch_kp.value = w / turn / scale;
    p.pitch_ki.value = p.pitch_kp.value * 0.1 * w;
  }

  void course(double w, OuterLawNumbers& p) const {
    const double Vc = plant.airframe.limits.airspeed_cruise_mps;
    p.course_kp.value = w * Vc / isa::g0;  // at Vc; proportional to the ground speed
  }
  void height(double w, SlcLaw& p) const {
    p.altitude_kp.value = w / Va;
    p.altitude_ki.value = w / Va * w / 17;  // corner at w/17
    p.altitude_kd.value = 0.5 / Va;
  }
  void airspeed(double w, SlcLaw& p) const {
    const double m = plant.airframe.mass_kg, T = plant.thrust_newton();
    p.airspeed_kp.value = w * m / T;
    p.airspeed_ki.value = p.airspeed_kp.value * 0.1 * std::max(w, 1.0);
    p.climb_kff.value = m * isa::g0 / (Va * T);
    p.thrust.value = T;
  }
  void tecs(double height, double airspeed, TecsLaw& p) const {
    const double T = plant.thrust_newton();
    p.thrust.value = T;
    p.altitude_gain.value = 0.8 * height;
    p.airspeed_gain.value = airspeed;
    // with more thrust than weight the throttle controls the airspeed
    p.speed_weight.value = T > plant.airframe.mass_kg * isa::g0 ? 0.1 : 0.4;
  }
};

const LoopFigures* find_loop(const LoopReport& report, const std::string& name) {
  for (const LoopFigures& f : report.loops)
    if (f.name == name) return &f;
  return nullptr;
}

/// True when the bandwidth leaves less than the wanted margins.
bool too_fast(const LoopReport& report, const std::string& name) {
  const LoopFigures* f = find_loop(report, name);
  return f && !wanted_margins.kept(*f);
}

/// Rounds to two digits. A value outside of the parameter's range is reported.
template <class Law>
void round_law(Law& law, const Law& was, std::vector<std::string>& beyond) {
  for (const Named<Law>& one : parameters_of(law)) {
    if (!one.number) continue;
    Number& n = law.*one.number;
    const double wanted = n.value == (was.*one.number).value ? n.value : rounded(n.value);
    n.value = std::clamp(wanted, n.min, n.max);
    if (wanted > n.max || wanted < n.min)
      beyond.push_back(std::string(one.name) + " would be " + figures(wanted) + " " + n.unit +
                       ", and its range is " + figures(n.min) + " .. " + figures(n.max));
  }
}

constexpr double slower = 0.94;
constexpr int max_tries = 60;

/// One design: gains from bandwidths, which are reduced by the margins.
class Design {
 public:
  Design(const Plant& plant, const Laws& start, const Bandwidths& given)
      : plant_(plant), start_(start), relations_(plant), given_(given) {
    out_.laws = start;
    Bandwidths& w = out_.chosen;
    const double roll_lag = plant.lag_s(model::aileron), pitch_lag = plant.lag_s(model::elevator);
    w.roll = given.roll > 0 ? given.roll : 0.18 / roll_lag;
    w.pitch = given.pitch > 0 ? given.pitch : std::min(0.5 * w.roll, 0.09 / pitch_lag);
    w.course = given.course > 0 ? given.course : 0.12 * w.roll;
    w.height = given.height > 0 ? given.height : 0.35 * w.pitch;
    w.airspeed =
        given.airspeed > 0 ? given.airspeed : std::min(0.2 / plant.lag_s(model::throttle), 2.0 * w.height);
    start_takeoff();
    first_ = w;
    out_.yaw_damper = rudder_acts(plant.airframe) && plant.airframe.rudder.limit_rad > 0;
  }

  Tuning run() {
    if (!out_.yaw_damper) out_.laws.inner.yaw_kd.value = 0;
    relations_.pitch(out_.chosen.pitch, damping_share_, out_.laws.inner);
    relations_.roll(out_.chosen.roll, out_.laws.inner);
    if (out_.yaw_damper) damp_yaw();
    inner();
    if (given_.course <= 0) out_.chosen.course = std::min(out_.chosen.course, 0.12 * out_.chosen.roll);
    outer();
    total_energy();
    round_law(out_.laws.inner, start_.inner, out_.beyond);
    round_law(out_.laws.slc, start_.slc, out_.beyond);
    round_law(out_.laws.tecs, start_.tecs, out_.beyond);
    return std::move(out_);
  }

 private:
  /// The laws rotate slightly above the least airspeed; a higher value in the file stays.
  void start_takeoff() {
    const FlightLimits& limits = plant_.airframe.limits;
    const double V = std::min(1.1 * limits.airspeed_min_mps, limits.airspeed_cruise_mps);
    for (Number* one : {&out_.laws.slc.takeoff_airspeed, &out_.laws.tecs.takeoff_airspeed})
      if (one->value < limits.airspeed_min_mps || one->value > limits.airspeed_cruise_mps) one->value = V;
  }

  void damp_yaw() {
    InnerLaw& p = out_.laws.inner;
    for (const Mode& mode : modes_in(plant_.linear))
      if (mode.kind == ModeKind::dutch_roll) p.yaw_washout.value = 0.1 * mode.natural_radps();
    double best = -1, gain = 0;
    for (double kd = 0; kd < 3; kd += 0.01) {
      p.yaw_kd.value = kd / relations_.scale;
      const double damping = dutch_roll_damping(plant_, p);
      if (damping > best) {
        best = damping;
        gain = kd;
      }
      if (damping >= 0.7 || damping < best - 0.05) break;
    }
    p.yaw_kd.value = gain / relations_.scale;
  }

  /// Limited: when a reduction does not help, another loop is the cause.
  static bool fall(double& w, double given, double first) {
    if (given > 0 || w < 0.3 * first) return false;
    w *= slower;
    return true;
  }

  /// Smallest ratio to the wanted margins: 1 or more when all loops have them, below 0 when unstable.
  static double merit(const LoopReport& report, std::initializer_list<const char*> names) {
    if (report.unstable > 0) return -1;
    double least = 1e9;
    for (const char* name : names)
      if (const LoopFigures* f = find_loop(report, name))
        least = std::min({least, f->min_gain_db() / wanted_margins.gain_db,
                          f->min_phase_rad() / wanted_margins.phase_rad});
    return least;
  }

  /// Pitch and yaw damper are reduced from the chosen value. Roll may have to be raised: the ailerons
  /// stabilise an unstable Dutch roll, which needs gain.
  void inner() {
    Bandwidths& w = out_.chosen;
    const double start = w.roll;
    double best = -2, best_roll = w.roll, best_damping = 0;
    // Rate feedback beyond that of the relation: the relation may give none where the Dutch roll needs it.
    const auto at = [&](double roll) {
      for (const double more : {0.0, 0.02, 0.04, 0.07, 0.1, 0.15}) {
        set_roll(roll, more);
        const double found = merit(evaluate(plant_, out_.laws, OuterScheme::none), {"roll", "yaw damper"});
        if (found > best) {
          best = found;
          best_roll = roll;
          best_damping = more;
        }
        if (found >= 1) return true;
      }
      return false;
    };
    settle_pitch_and_yaw();
    bool done = at(start) || given_.roll > 0;
    for (double roll = start * slower; !done && roll > 0.4 * start; roll *= slower) done = at(roll);
    for (double roll = start / slower; !done && roll < 3 * start; roll /= slower) done = at(roll);
    w.roll = best_roll;
    set_roll(best_roll, best_damping);
    roll_has_margins_ = best >= 1;
    settle_pitch_and_yaw();
  }

  void set_roll(double w, double more_damping) {
    relations_.roll(w, out_.laws.inner);
    out_.laws.inner.roll_kd.value += more_damping / relations_.scale;
  }

  void settle_pitch_and_yaw() {
    Bandwidths& w = out_.chosen;
    for (int i = 0; i < max_tries; ++i) {
      relations_.pitch(w.pitch, damping_share_, out_.laws.inner);
      const LoopReport now = evaluate(plant_, out_.laws, OuterScheme::none);
      bool again = false;
      if (too_fast(now, "pitch")) {
        again |= fall(w.pitch, given_.pitch, first_.pitch);
        // Because of the delay the rate feedback alone may be too high.
        if (w.pitch < 0.7 * first_.pitch || !again) again |= fall(damping_share_, 0, 0.3);
      }
      if (too_fast(now, "yaw damper")) {
        out_.laws.inner.yaw_kd.value *= slower;
        again = true;
      }
      if (!again) return;
    }
  }

  void outer() {
    Bandwidths& w = out_.chosen;
    Laws& l = out_.laws;
    l.slc.airspeed_kff.value = l.tecs.airspeed_kff.value = throttle_per_speed();
    for (int i = 0; i < max_tries; ++i) {
      relations_.course(w.course, l.slc);
      relations_.height(w.height, l.slc);
      relations_.airspeed(w.airspeed, l.slc);
      const LoopReport now = evaluate(plant_, l, OuterScheme::slc);
      bool again = false;
      if (too_fast(now, "course") || (roll_has_margins_ && too_fast(now, "roll")))
        again |= fall(w.course, given_.course, first_.course);
      if (too_fast(now, "height") || too_fast(now, "pitch"))
        again |= fall(w.height, given_.height, first_.height);
      if (too_fast(now, "airspeed")) again |= fall(w.airspeed, given_.airspeed, first_.airspeed);
      if (!again) break;
    }
    l.tecs.course_kp.value = l.slc.course_kp.value;
  }

  void total_energy() {
    Laws& l = out_.laws;
    double height = out_.chosen.height, airspeed = 0.6 * out_.chosen.airspeed;
    for (int i = 0; i < max_tries; ++i) {
      relations_.tecs(height, airspeed, l.tecs);
      const LoopReport now = evaluate(plant_, l, OuterScheme::tecs);
      bool again = false;
      if (too_fast(now, "TECS height") || too_fast(now, "pitch"))
        again |= fall(height, 0, out_.chosen.height);
      if (too_fast(now, "TECS airspeed")) again |= fall(airspeed, 0, out_.chosen.airspeed);
      if (!again) return;
    }
  }

  /// In level flight, 1/(m/s).
  double throttle_per_speed() const {
    const AircraftModel m(plant_.airframe, plant_.altitude_m);
    const double V = plant_.flight.condition.airspeed_mps, h = 0.05 * V;
    const SteadyFlight fast = fly(m, {.airspeed_mps = V + h}), slow = fly(m, {.airspeed_mps = V - h});
    const auto throttle_of = [&](const SteadyFlight& f) {
      return f.found() ? f.input(model::throttle) : plant_.flight.input(model::throttle);
    };
    const double span = (fast.found() ? h : 0) + (slow.found() ? h : 0);
    return span > 0 ? std::max((throttle_of(fast) - throttle_of(slow)) / span, 0.0) : 0;
  }

  const Plant& plant_;
  const Laws& start_;
  Relations relations_;
  Bandwidths given_, first_;
  Tuning out_;
  double damping_share_ = 1;       ///< of pitch
  bool roll_has_margins_ = false;  ///< with an open course loop
};

}  // namespace

double max_bandwidth(double lag_s) { return 0.5 / lag_s; }

Tuning tune(const Plant& plant, const Laws& start, const Bandwidths& given) {
  return Design(plant, start, given).run();
}

}  // namespace fulmar::aero

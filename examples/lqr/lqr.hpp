// SPDX-License-Identifier: BSD-3-Clause
// A linear-quadratic regulator from course, height and airspeed to surfaces and throttle, with integrals of
// these three errors: u = u_ref - K (x - x_ref), K = R^-1 B' X. Stevens, Lewis & Johnson, Aircraft Control
// and Simulation (2016), chapter 5. Weights by the rule of Bryson & Ho, Applied Optimal Control (1975): one
// over the square of the acceptable value.
#pragma once
#include <algorithm>
#include <cmath>
#include <fulmar/flight/control/outer_law.hpp>
#include <fulmar/flight/math/filters.hpp>
#include <fulmar/msg/actuators.hpp>
#include <fulmar/msg/origin.hpp>
#include <fulmar/plugin.hpp>

#include "plant.hpp"
#include "riccati.hpp"

using namespace fulmar;

struct Lqr {  // fills the roles `outer` and `inner` at once
  static constexpr const char* doc =
      "Course, height and airspeed hold by a linear-quadratic regulator on the surfaces.";
  using X = Plant;  // indices of states and inputs
  using State = Plant::State;
  using Input = Plant::Input;
  using Gain = Eigen::Matrix<double, X::m, X::n>;

  struct Inputs {
    In<VehicleState> state;
    In<GuidanceCommand> command;
  };
  struct Outputs {
    AttitudeCommand attitude;  // commands from the errors of course and height
    Actuators actuators;
    Probe bump_ratio;       // largest remaining difference of a switch, over the actuators
    Probe saturated_ratio;  // number of actuators at their limits
  };
  struct Params {
    Param airspeed{1, "m/s", 0.05, 20, "acceptable airspeed error; its weight is the inverse square"};
    Param height{1, "m", 0.05, 50, "acceptable height error"};
    Param course{0.1, "rad", 0.005, 2, "acceptable course error"};
    Param sideslip{0.3, "rad", 0.005, 2, "acceptable sideslip"};
    Param alpha{0.3, "rad", 0.005, 2, "acceptable error of the angle of attack"};
    Param roll{0.4, "rad", 0.005, 3, "acceptable roll error"};
    Param pitch{0.3, "rad", 0.005, 3, "acceptable pitch error"};
    Param rate{3, "rad/s", 0.05, 20, "acceptable roll, pitch and yaw rate"};
    Param integral{8, "s", 0.5, 100, "acceptable duration of an error of height, airspeed or course"};
    Param throttle{0.3, "ratio", 0.01, 5, "acceptable use of the throttle"};
    Param aileron{0.1, "rad", 0.01, 5, "acceptable use of the aileron"};
    Param elevator{0.2, "rad", 0.01, 5, "acceptable use of the elevator"};
    Param rudder{0.1, "rad", 0.01, 5, "acceptable use of the rudder"};
    Param bank{6, "rad/s", 0.5, 20, "natural frequency of the response to the bank of the guidance"};
    Param fade{1, "s", 0.05, 20, "time constant of the bumpless transfer"};
    Record<Airframe> airframe{"airframe of the linear model, with limits and throws"};
    Record<Origin> origin{"origin of the local frame; its altitude sets the air density"};
  };

  const Plant& plant() const { return plant_; }
  const Gain& gain() const { return K_; }

  static constexpr const char* airframe_missing = "the regulator requires an airframe";

  void configure(const Params& params) {
    if (!params.airframe.given()) throw std::runtime_error(airframe_missing);
    plant_ = Plant::linearised(*params.airframe, standard_air(params.origin->alt_msl_m).density_kgm3);
    if (!weigh(params)) throw std::runtime_error("no gain was found for these weights");
    x_ = plant_.x0;
  }

  void retune(const Params& params) {  // without a solution the gain stays unchanged
    if (weigh(params) && take_up_ == TakeUp::nothing) take_up_ = TakeUp::bump;
  }

  Status activate(const Tick&, const Inputs& in, const Params& params, const Applied<Outputs>& last) {
    const Actuators& u = last->actuators;
    const double most = params.airframe->limits.roll_max_rad;
    u_ << u.throttle_frac, u.elevator_rad, u.aileron_rad, u.rudder_rad;
    take_up_ = last.has(u) ? TakeUp::integrals : TakeUp::nothing;
    integrals_.setZero();
    bump_.setZero();
    x_ = plant_.x0;
    bank_.reset_to(in.state->attitude_valid ? std::clamp(in.state->roll_rad, -most, most) : 0);
    known_ = knowledge(*in.state, *in.command);
    return Status::ok;
  }

  Status step(const Tick& tick, const Inputs& in, const Params& params, Outputs& out) {
    const VehicleState& s = *in.state;
    const GuidanceCommand& command = *in.command;
    const double dt = std::clamp(tick.dt_s(), 0.0, 0.1);
    if (standing(s)) return wait(params, out);
    const unsigned known = knowledge(s, command);
    if (known != known_ && known_ != 0 && take_up_ == TakeUp::nothing) take_up_ = TakeUp::bump;
    known_ = known;  // a change of validity steps no surface
    refer(s, command, params, dt);
    if (s.attitude_valid)
      deviate(s, command);
    else
      predict(*params.airframe, dt);
    const FlightLimits& limits = params.airframe->limits;
    const Input scale = surface_scale(s, limits);
    if (take_up_ == TakeUp::integrals) {
      ask(limits, out.attitude);
      take_up_integrals(scale);
    }
    ask(limits, out.attitude);
    if (take_up_ != TakeUp::nothing) bump_ += u_ - law(scale);
    take_up_ = TakeUp::nothing;
    const Input u = law(scale);
    apply(u, *params.airframe, out);
    integrate(u, scale, dt);
    bump_ *= std::exp(-dt / params.fade);
    return enough_known(s) ? Status::ok : Status::degraded;
  }

 private:
  enum class TakeUp : std::uint8_t { nothing, bump, integrals };

  bool weigh(const Params& p) {
    const double T = p.integral;
    State x;
    x << p.airspeed, p.alpha, p.pitch, p.rate, p.height, p.sideslip, p.roll, p.rate, p.rate, p.course,
        T * p.height, T * p.airspeed, T * p.course;
    const Input u{p.throttle, p.elevator, p.aileron, p.rudder};
    const Eigen::Matrix<double, X::n, X::n> Q = x.cwiseAbs2().cwiseInverse().asDiagonal();
    const Eigen::Matrix<double, X::m, X::m> R = u.cwiseAbs2().cwiseInverse().asDiagonal();
    Eigen::Matrix<double, X::n, X::n> solution;
    if (!riccati<X::n, X::m>(plant_.A, plant_.B, Q, R, solution)) return false;
    const Gain weighed = u.cwiseAbs2().asDiagonal() * plant_.B.transpose();
    K_ = times(weighed, solution);
    integral_limits_ = 0.5 * x.tail<3>();
    return true;
  }

  static bool on_course(const VehicleState& s, const GuidanceCommand& c) {
    return c.lateral == LateralMode::course && s.velocity_valid;
  }
  static unsigned knowledge(const VehicleState& s, const GuidanceCommand& c) {
    return 1u + (s.attitude_valid ? 2u : 0u) + (s.height_valid ? 4u : 0u) + (s.airspeed_valid ? 8u : 0u) +
           (s.wind_valid ? 16u : 0u) + (on_course(s, c) ? 32u : 0u) +
           (c.lateral == LateralMode::acceleration ? 64u : 0u);
  }

  Status wait(const Params& params, Outputs& out) {
    const Airframe& a = *params.airframe;
    bank_.reset_to(0);
    integrals_.setZero();
    bump_.setZero();
    x_ = plant_.x0;
    take_up_ = TakeUp::nothing;
    out.attitude = {};
    u_ = {0, a.elevator.trim_rad, a.aileron.trim_rad, a.rudder.trim_rad};
    apply(u_, a, out);
    return Status::ok;
  }

  /// Reference: the commanded coordinated turn, B&M (9.14), and climb. Without an attitude: wings level.
  void refer(const VehicleState& s, const GuidanceCommand& c, const Params& params, double dt) {
    const Airframe& a = *params.airframe;
    const FlightLimits& limits = a.limits;
    const double Va = std::clamp(c.airspeed_mps, limits.airspeed_min_mps, limits.airspeed_max_mps);
    const bool turns = c.lateral == LateralMode::acceleration;
    double bank = turns ? std::atan(c.lateral_acceleration_mps2 / isa::g0) : c.roll_feedforward_rad;
    if (!s.attitude_valid || (!turns && !s.velocity_valid)) bank = 0;
    const double phi =
        bank_.step(std::clamp(bank, -limits.roll_max_rad, limits.roll_max_rad), params.bank, 1, dt);
    const double gamma =
        s.height_valid
            ? std::clamp(c.climb_rate_mps, -limits.sink_rate_max_mps, limits.climb_rate_max_mps) / Va
            : 0;
    const double rho = plant_.rho_kgm3;
    const TurnTrim turn = turn_trim(a, phi, Va, rho), level = turn_trim(a, 0, plant_.x0(X::V), rho);
    x_ref_ = plant_.x0;
    x_ref_(X::V) = Va;
    x_ref_(X::alpha) += turn.alpha_rad - level.alpha_rad;
    x_ref_(X::theta) = x_ref_(X::alpha) * std::cos(phi) + gamma;
    x_ref_(X::phi) = phi;
    const TurnRates rates = turn_rates(phi, x_ref_(X::theta), Va);
    x_ref_(X::p) = rates.p_radps + bank_.rate();
    x_ref_(X::q) = rates.q_radps;
    x_ref_(X::r) = rates.r_radps;
    u_ref_ = plant_.u0;
    u_ref_(X::elevator) += turn.elevator_rad - level.elevator_rad;
    // Inputs for zero sideslip at this roll rate: the rows of roll and yaw of A x + B u = 0.
    u_ref_.tail<2>() -=
        plant_.B.block<2, 2>(X::p, X::aileron).inverse() * plant_.A.block<2, 1>(X::p, X::p) * bank_.rate();
    u_ref_(X::throttle) +=
        ((turn.drag_newton - level.drag_newton) / a.mass_kg + isa::g0 * gamma) / plant_.B(X::V, X::throttle);
  }

  /// x - x_ref. The deviation of an unknown state is 0.
  void deviate(const VehicleState& s, const GuidanceCommand& c) {
    dx_.setZero();
    e_.setZero();
    dx_(X::theta) = s.pitch_rad - x_ref_(X::theta);
    dx_(X::phi) = s.roll_rad - x_ref_(X::phi);
    dx_(X::p) = s.rate_radps.x - x_ref_(X::p);
    dx_(X::q) = s.rate_radps.y - x_ref_(X::q);
    dx_(X::r) = s.rate_radps.z - x_ref_(X::r);
    if (s.airspeed_valid) dx_(X::V) = e_(1) = s.airspeed_mps - x_ref_(X::V);
    if (s.airspeed_valid && s.wind_valid) dx_(X::alpha) = s.alpha_rad - x_ref_(X::alpha);
    if (s.airspeed_valid && s.wind_valid) dx_(X::beta) = s.beta_rad - x_ref_(X::beta);
    x_ = x_ref_ + dx_;
    if (s.height_valid) e_(0) = s.height_m - c.height_m;
    if (!on_course(s, c)) integrals_(2) = 0;
    // A bank turns the course by g tan(phi) / Vg: at a high ground speed the same bank stands for more course
    // error.
    if (on_course(s, c))
      e_(2) = angle_difference(s.course_rad, c.course_rad) *
              std::clamp(s.ground_speed_mps / plant_.x0(X::V), 0.5, 2.0);
  }

  /// Without an attitude, the model predicts the state from the present surfaces, so that the aircraft levels
  /// with the reference.
  void predict(const Airframe& airframe, double dt) {
    constexpr int parts = 10;  // Euler's method: the fastest mode takes 30 ms
    for (int i = 0; i < parts; ++i) x_ += dt / parts * Plant::derivative(airframe, x_, u_, plant_.rho_kgm3);
    e_.setZero();
    dx_ = x_ - x_ref_;
    dx_(X::h) = dx_(X::chi) = 0;
    if (!(dx_.norm() < 10)) {
      x_ = x_ref_;
      dx_.setZero();  // the model does not hold so far from the reference
    }
  }

  /// Errors of height and course count as far as the resulting pitch and bank are within limits.
  void ask(const FlightLimits& limits, AttitudeCommand& attitude) {
    dx_.tail<3>() = integrals_;
    const double level = x_ref_(X::theta), Va = x_ref_(X::V);
    attitude.pitch_rad = asked(X::elevator, X::theta, 0, X::h,
                               std::max(limits.pitch_min_rad, level - limits.sink_rate_max_mps / Va),
                               std::min(limits.pitch_max_rad, level + limits.climb_rate_max_mps / Va));
    attitude.roll_rad = asked(X::aileron, X::phi, 2, X::chi, -limits.roll_max_rad, limits.roll_max_rad);
  }
  double asked(int row, int angle, int i, int error, double least, double most) {
    const double slope = K_(row, error) / K_(row, angle);
    const double free = x_ref_(angle) - K_(row, X::int_h + i) / K_(row, angle) * integrals_(i);
    const double wanted = free - slope * e_(i);
    const double given = std::clamp(wanted, least, most);
    dx_(error) = given == wanted || slope <= 0 ? e_(i) : (free - given) / slope;
    beyond_(i) = wanted > most ? 1 : wanted < least ? -1 : 0;
    return given;
  }

  /// The effect of surfaces grows with dynamic pressure.
  Input surface_scale(const VehicleState& s, const FlightLimits& limits) const {
    const double Va = scheduling_airspeed(s, limits), V0 = plant_.x0(X::V);
    const double scale = std::clamp(plant_.rho_kgm3 * V0 * V0 / (air_density(s) * Va * Va), 0.4, 2.5);
    return {1, scale, scale, scale};
  }

  Input law(const Input& scale) const { return u_ref_ - scale.cwiseProduct(K_ * dx_) + bump_; }

  /// Three integrals take up the previous commands of throttle, elevator and aileron. The rest fades.
  void take_up_integrals(const Input& scale) {
    const Input missing = (u_ - law(scale)).cwiseQuotient(scale);
    const Eigen::Vector3d i = K_.topRightCorner<3, 3>().inverse() * -missing.head<3>();
    integrals_ = i.cwiseMin(integral_limits_).cwiseMax(-integral_limits_);
    if ((known_ & 32u) == 0) integrals_(2) = 0;  // no course: the integral would drift
  }

  void apply(const Input& u, const Airframe& a, Outputs& out) {
    most_ << 1, a.elevator.limit_rad, a.aileron.limit_rad, a.rudder.limit_rad;
    least_ = -most_;
    least_(X::throttle) = 0;
    u_ = u.cwiseMin(most_).cwiseMax(least_);
    out.actuators = {u_(X::throttle), u_(X::aileron), u_(X::elevator), u_(X::rudder)};
    out.attitude.throttle_frac = u_(X::throttle);
    out.bump_ratio = bump_.cwiseAbs().maxCoeff();
    out.saturated_ratio = static_cast<double>((u.array() != u_.array()).count());
  }

  /// An integral grows unless it drives an actuator, or the commanded pitch or bank, further into a limit.
  void integrate(const Input& u, const Input& scale, double dt) {
    for (int i = 0; i < 3; ++i) {
      const Input push = -e_(i) * scale.cwiseProduct(K_.col(X::int_h + i));
      bool deepens = beyond_(i) * -e_(i) > 0;
      for (int k = 0; k < X::m; ++k)
        deepens = deepens || (u(k) > most_(k) && push(k) > 0) || (u(k) < least_(k) && push(k) < 0);
      if (!deepens) integrals_(i) += e_(i) * dt;
    }
  }

  Plant plant_;
  Gain K_ = Gain::Zero();
  State x_ = State::Zero(), x_ref_ = State::Zero(), dx_ = State::Zero();
  Input u_ref_ = Input::Zero(), u_ = Input::Zero(), bump_ = Input::Zero();
  Input least_ = Input::Zero(), most_ = Input::Zero();
  Eigen::Vector3d e_ = Eigen::Vector3d::Zero(),
                  integrals_ = Eigen::Vector3d::Zero();  // height, airspeed, course
  Eigen::Vector3d integral_limits_ = Eigen::Vector3d::Zero(), beyond_ = Eigen::Vector3d::Zero();
  SecondOrder bank_;
  unsigned known_ = 0;
  TakeUp take_up_ = TakeUp::nothing;
};

// SPDX-License-Identifier: BSD-3-Clause
// The shipped laws as linear sampled systems: response of each output to a sine of each input, near steady
// level flight. The discretisation is that of the code, step by step. test/laws_test.cpp compares with the
// components themselves.
#pragma once
#include <Eigen/Core>
#include <complex>
#include <vector>

#include "fulmar/flight/model/aircraft_model.hpp"
#include "fulmar/msg/airframe.hpp"

namespace fulmar::aero {

using Complex = std::complex<double>;

/// Inputs of the laws: differences from steady flight, rad, rad/s, m, m/s, m/s2, rad.
namespace sensor {
enum : int { roll, pitch, p, q, r, course, height, climb, airspeed, acceleration, sideslip };
inline constexpr int count = 11;
}  // namespace sensor
/// Commands of the outer law to the inner one: rad, rad, share of full throttle.
namespace command {
enum : int { roll, pitch, throttle };
inline constexpr int count = 3;
}  // namespace command
/// Commands of guidance: rad, m, m/s.
namespace goal {
enum : int { course, height, airspeed };
inline constexpr int count = 3;
}  // namespace goal

/// A parameter of a law: its default and range are those of the component.
struct Number {
  double value;
  const char* unit;
  double min, max;
  operator double() const { return value; }  // NOLINT(google-explicit-constructor): as fulmar::Param
};
template <class Law>
struct Named {
  const char* name;
  Number Law::*number;  ///< nullptr: a parameter that affects no loop
};

/// control_slc/Inner
struct InnerLaw {
  Number roll_kp{1.2, "rad/rad", 0, 20}, roll_ki{0.1, "rad/(rad s)", 0, 10}, roll_kd{0.02, "rad s/rad", 0, 5},
      roll_kff{0.15, "rad s/rad", 0, 5}, roll_from_sideslip{0, "rad/rad", -5, 5};
  Number pitch_kp{4.0, "rad/rad", 0, 20}, pitch_ki{2.0, "rad/(rad s)", 0, 40},
      pitch_kd{0.5, "rad s/rad", 0, 10}, turn_kff{1.0, "ratio", 0, 2};
  Number yaw_kd{0.3, "rad s/rad", 0, 5}, yaw_washout{0.6, "rad/s", 0.01, 10};
  Number command_filter{0.04, "s", 0.005, 1}, airspeed_smoothing{0.5, "s", 0, 10},
      scale_limit{2.5, "ratio", 1, 10};
};
/// Parameters common to both outer laws.
struct OuterLawNumbers {
  Number course_kp{2.0, "rad/rad", 0, 10}, course_ki{0.0, "rad/(rad s)", 0, 2},
      roll_smoothing{0.1, "s", 0, 2}, airspeed_smoothing{0.5, "s", 0, 10},
      takeoff_airspeed{13.0, "m/s", 3, 60};
};
/// control_slc/Outer
struct SlcLaw : OuterLawNumbers {
  Number altitude_kp{0.09, "rad/m", 0, 1}, altitude_ki{0.01, "rad/(m s)", 0, 0.5},
      altitude_kd{0.03, "rad s/m", 0, 0.5};
  Number airspeed_kp{0.15, "1/(m/s)", 0, 1}, airspeed_ki{0.06, "1/m", 0, 1},
      airspeed_kff{0.03, "1/(m/s)", 0, 0.2}, climb_kff{0.04, "1/(m/s)", 0, 0.5}, thrust{50.0, "N", 1, 10000};
};
/// control_tecs/Outer
struct TecsLaw : OuterLawNumbers {
  Number altitude_gain{1.2, "1/s", 0, 5}, airspeed_gain{1.2, "1/s", 0, 5},
      acceleration_filter{0.25, "s", 0, 5}, airspeed_filter{0.5, "s", 0, 10},
      speed_weight{0.4, "ratio", 0, 2};
  Number throttle_damping{0.5, "ratio", 0, 5}, throttle_integral{0.6, "1/s", 0, 5},
      pitch_damping{0.6, "ratio", 0, 5}, pitch_integral{0.2, "1/s", 0, 5},
      airspeed_kff{0.03, "1/(m/s)", 0, 0.2}, thrust{50.0, "N", 1, 10000};
};
/// All parameters by name, in the order of `fulmar inspect`.
const std::vector<Named<InnerLaw>>& parameters_of(const InnerLaw&);
const std::vector<Named<SlcLaw>>& parameters_of(const SlcLaw&);
const std::vector<Named<TecsLaw>>& parameters_of(const TecsLaw&);

/// Flight condition of the laws.
struct LawPoint {
  const Airframe* airframe = nullptr;
  double Va_mps = 0, density_kgpm3 = 0, pitch_rad = 0;
  double step_s = 0.01;
};

struct InnerResponse {
  Eigen::Matrix<Complex, model::inputs, sensor::count> of_sensors =
      Eigen::Matrix<Complex, model::inputs, sensor::count>::Zero();
  Eigen::Matrix<Complex, model::inputs, command::count> of_commands =
      Eigen::Matrix<Complex, model::inputs, command::count>::Zero();
};
struct OuterResponse {
  Eigen::Matrix<Complex, command::count, sensor::count> of_sensors =
      Eigen::Matrix<Complex, command::count, sensor::count>::Zero();
  Eigen::Matrix<Complex, command::count, goal::count> of_goals =
      Eigen::Matrix<Complex, command::count, goal::count>::Zero();
};

/// At z = exp(s step).
InnerResponse response(const InnerLaw& p, const LawPoint& at, Complex z);
OuterResponse response(const SlcLaw& p, const LawPoint& at, Complex z);
OuterResponse response(const TecsLaw& p, const LawPoint& at, Complex z);

/// The three laws of one aircraft.
struct Laws {
  InnerLaw inner;
  SlcLaw slc;
  TecsLaw tecs;
};

}  // namespace fulmar::aero

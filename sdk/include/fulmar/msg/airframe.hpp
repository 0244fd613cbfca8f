// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "fulmar/message.hpp"
#include "fulmar/msg/aero_data.hpp"
#include "fulmar/msg/gear.hpp"
#include "fulmar/msg/propulsion_parts.hpp"

namespace fulmar {

/// Inertia about the centre of gravity, body axes. Products of inertia with y vanish by symmetry. xz is the
/// integral of x z dm: its negative is the element of the inertia matrix, as in Beard & McLain.
struct Inertia {
  double xx_kgm2 = 1, yy_kgm2 = 1, zz_kgm2 = 1, xz_kgm2 = 0;
};

struct Wing {
  double area_m2 = 1;                 ///< wing area S
  double span_m = 1;                  ///< wing span b
  double chord_m = 1;                 ///< mean aerodynamic chord c
  double oswald_ratio = 0.9;          ///< Oswald efficiency e
  double stall_alpha_rad = 0.2618;    ///< stall angle of attack, alpha0 of the blending function, Beard &
                                      ///< McLain (4.9)
  double stall_sharpness_ratio = 50;  ///< sharpness of the stall, M of the blending function
};

/// One coefficient and its derivatives: value = c0 + alpha a + beta b + (p b/2V) p + (q c/2V) q + (r b/2V) r
/// + surfaces. Radians.
struct Derivatives {
  double zero_ratio = 0, alpha_ratio = 0, beta_ratio = 0;
  double p_ratio = 0, q_ratio = 0, r_ratio = 0;
  double aileron_ratio = 0, elevator_ratio = 0, rudder_ratio = 0;
  double flap_ratio = 0;
};

/// Beard & McLain, chapter 4. Drag: parasite + induced CL^2/(pi e AR) + all terms of `drag`; an airframe with
/// a linear polar instead of an induced one sets drag.zero and drag.alpha, the others leave them 0.
struct Aerodynamics {
  double parasite_drag_ratio = 0;    ///< parasite drag C_D_p
  Derivatives lift, drag, side;      ///< coefficients CL, CD, CY and their derivatives
  Derivatives roll, pitch, yaw;      ///< coefficients Cl, Cm, Cn and their derivatives
  DragSquared drag_squared;          ///< drag over the squares of sideslip and deflections
  double pitch_stalled_ratio = 0;    ///< pitching moment Cm_fp of separated flow: Cm = Cm_fp sign(alpha)
                                     ///< sin^2(alpha); 0: the derivatives hold there
  double wash_frac = 0;              ///< share of elevator and rudder in the slipstream of the propeller
  List<CoefficientTable, 8> tables;  ///< tables of coefficients
};

/// Motor and propeller as a disc, Beard & McLain, Small Unmanned Aircraft (2012), section 4.3. The exit speed
/// of the air is Va + throttle (exit speed - Va).
struct DiscMotor {
  double area_m2 = 0;           ///< area of the propeller disc S_prop; 0: no disc
  double efficiency_ratio = 1;  ///< efficiency C_prop
  double exit_speed_mps = 0;    ///< exit speed k_motor at full throttle
  double torque_ratio = 0;      ///< torque over the square of the propeller speed, k_T_P, N m s^2
  double speed_radps = 1;       ///< propeller speed at full throttle, k_Omega
};

/// Electric motor and propeller, Beard & McLain, supplement to chapter 4: thrust and torque over the advance
/// ratio. With `disc` that model is used instead.
struct Propulsion {
  double propeller_diameter_m = 0.3;                   ///< diameter of the propeller
  double ct0_ratio = 0, ct1_ratio = 0, ct2_ratio = 0;  ///< thrust coefficient: CT0 + CT1 J + CT2 J^2
  double cq0_ratio = 0, cq1_ratio = 0, cq2_ratio = 0;  ///< torque coefficient: CQ0 + CQ1 J + CQ2 J^2
  double torque_constant_ratio = 0.01;                 ///< torque constant K_Q, N m/A; also V s/rad
  double resistance_ohm = 0.05;                        ///< resistance of the motor
  double no_load_amp = 1;                              ///< no-load current of the motor
  double battery_volt = 12;                            ///< voltage of the full battery, at full throttle
  double time_constant_s = 0.05;                       ///< time constant of the speed of motor and propeller
  double propeller_inertia_kgm2 = 0;                   ///< inertia of a propeller with its rotating parts,
                                                       ///< about its axis; 0: no gyroscopic moment and no
                                                       ///< reaction to speed changes
  List<PropellerPlace, 8> propellers;                  ///< places of the propellers, each with its own
                                                       ///< motor; empty: one on the x axis
  Battery pack;                                        ///< losses of the battery; `battery_volt` is its full
                                                       ///< voltage
  DiscMotor disc;                                      ///< disc model of motor and propeller
};

/// One control surface: throw, response of its servo, and data for its hardware.
struct Surface {
  double limit_rad = 0.5;              ///< largest deflection, either way
  double rate_limit_radps = 10;        ///< largest rate of the deflection
  double time_constant_s = 0.02;       ///< time constant of the servo
  double trim_rad = 0;                 ///< deflection in trimmed cruise: the feed-forward of the inner loop
  bool reversed = false;               ///< reversal of the servo on the real aircraft; not used in
                                       ///< simulation
  double min_rad = -10;                ///< lower stop of the servo; below -9: at the largest deflection
  double max_rad = 10;                 ///< upper stop of the servo; above 9: at the largest deflection
  double dead_band_rad = 0;            ///< width of the band in which a changed command does not move it
  double natural_frequency_radps = 0;  ///< natural frequency of a second-order servo, in place of the time
                                       ///< constant; 0: none
  double damping_ratio = 1;            ///< damping ratio of a second-order servo
};

/// Layout of the surfaces that the servos move. Beard & McLain, section 4.2.
enum class Mixer : std::uint8_t {
  conventional,
  elevons,  ///< `aileron` is the left one, `elevator` the right one
  v_tail    ///< `elevator` is the left ruddervator, `rudder` the right one
};

struct FlightLimits {
  double airspeed_min_mps = 10, airspeed_cruise_mps = 15, airspeed_max_mps = 25;  ///< minimum, cruise and
                                                                                  ///< maximum true airspeed
  double roll_max_rad = 0.785, pitch_max_rad = 0.35, pitch_min_rad = -0.35;  ///< limits of roll and pitch
  double climb_rate_max_mps = 4, sink_rate_max_mps = 3;  ///< limits of climb and sink rate
  double throttle_cruise_frac = 0.5;                     ///< throttle in level cruise
};

/// One aircraft: a parameter `Record<Airframe> airframe` is filled from the mission's `airframe:`.
struct Airframe {
  Text<32> name;
  double mass_kg = 1;  ///< mass of the aircraft
  Inertia inertia;
  Wing wing;
  Aerodynamics aero;
  Propulsion propulsion;
  Surface aileron, elevator, rudder;
  Mixer mixer = Mixer::conventional;  ///< layout of the surfaces
  FlightLimits limits;
  Gear gear;
  Surface flap;  ///< flaps; without effect if no coefficient has a derivative over them
};

/// Fields without a valid default: the aircraft would fly as another one.
template <>
inline constexpr std::array<std::string_view, 8> required_fields<Airframe>{
    "mass_kg", "inertia", "wing", "aero", "propulsion", "aileron", "elevator", "rudder"};
template <>
inline constexpr std::array<std::string_view, 3> required_fields<Inertia>{"xx_kgm2", "yy_kgm2", "zz_kgm2"};
template <>
inline constexpr std::array<std::string_view, 3> required_fields<Wing>{"area_m2", "span_m", "chord_m"};
template <>
inline constexpr std::array<std::string_view, 2> required_fields<Aerodynamics>{"lift", "pitch"};
template <>
inline constexpr std::array<std::string_view, 1> required_fields<Derivatives>{"alpha_ratio"};
template <>
inline constexpr std::array<std::string_view, 1> required_fields<Propulsion>{"ct0_ratio"};
template <>
inline constexpr std::string_view instead_field<Propulsion>{"disc"};
template <>
inline constexpr std::array<std::string_view, 3> required_fields<DiscMotor>{"area_m2", "exit_speed_mps",
                                                                            "speed_radps"};
template <>
inline constexpr std::array<std::string_view, 1> required_fields<Surface>{"limit_rad"};

/// From an insect to an airliner: a value outside is an error of sign or unit.
template <>
inline constexpr std::array<FieldRange, 1> field_ranges<Airframe>{{{"mass_kg", 1e-4, 1e6}}};
template <>
inline constexpr std::array<FieldRange, 3> field_ranges<Inertia>{
    {{"xx_kgm2", 1e-9, 1e9}, {"yy_kgm2", 1e-9, 1e9}, {"zz_kgm2", 1e-9, 1e9}}};
template <>
inline constexpr std::array<FieldRange, 3> field_ranges<Wing>{
    {{"area_m2", 1e-4, 1e4}, {"span_m", 1e-2, 1e3}, {"chord_m", 1e-3, 1e2}}};
template <>
inline constexpr std::array<FieldRange, 1> field_ranges<Aerodynamics>{{{"wash_frac", 0, 1}}};
template <>
inline constexpr std::array<FieldRange, 3> field_ranges<DiscMotor>{
    {{"area_m2", 1e-6, 1e3}, {"exit_speed_mps", 1e-3, 1e3}, {"speed_radps", 1e-3, 1e5}}};
template <>
inline constexpr std::array<FieldRange, 1> field_ranges<Propulsion>{{{"propeller_inertia_kgm2", 0, 1e4}}};
template <>
inline constexpr std::array<FieldRange, 6> field_ranges<Surface>{{{"limit_rad", 0, 1.6},
                                                                  {"min_rad", -10, 1.6},
                                                                  {"max_rad", -1.6, 10},
                                                                  {"dead_band_rad", 0, 1.6},
                                                                  {"natural_frequency_radps", 0, 1e4},
                                                                  {"damping_ratio", 0, 100}}};

}  // namespace fulmar

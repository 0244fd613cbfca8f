// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "fulmar/message.hpp"
#include "fulmar/msg/gear.hpp"
#include "fulmar/msg/propulsion_parts.hpp"

namespace fulmar {

/// Inertia about the centre of gravity, body axes. Products of inertia with y vanish by symmetry. xz is the
/// integral of x z dm: its negative is the element of the inertia matrix, as in Beard & McLain.
struct Inertia {
  double xx_kgm2 = 1, yy_kgm2 = 1, zz_kgm2 = 1, xz_kgm2 = 0;
};

struct Wing {
  double area_m2 = 1;                 ///< S
  double span_m = 1;                  ///< b
  double chord_m = 1;                 ///< c, mean aerodynamic
  double oswald_ratio = 0.9;          ///< e
  double stall_alpha_rad = 0.2618;    ///< alpha0 of the blending function, Beard & McLain (4.9)
  double stall_sharpness_ratio = 50;  ///< M of the blending function
};

/// One coefficient and its derivatives: value = c0 + alpha a + beta b + (p b/2V) p + (q c/2V) q + (r b/2V) r
/// + surfaces. Radians.
struct Derivatives {
  double zero_ratio = 0, alpha_ratio = 0, beta_ratio = 0;
  double p_ratio = 0, q_ratio = 0, r_ratio = 0;
  double aileron_ratio = 0, elevator_ratio = 0, rudder_ratio = 0;
};

/// Beard & McLain, chapter 4. Drag: parasite + induced CL^2/(pi e AR) + all terms of `drag`; an airframe with
/// a linear polar instead of an induced one sets drag.zero and drag.alpha, the others leave them 0.
struct Aerodynamics {
  double parasite_drag_ratio = 0;  ///< C_D_p
  Derivatives lift, drag, side;    ///< CL, CD, CY
  Derivatives roll, pitch, yaw;    ///< Cl, Cm, Cn
};

/// Electric motor and propeller, Beard & McLain, supplement to chapter 4: thrust and torque over the advance
/// ratio.
struct Propulsion {
  double propeller_diameter_m = 0.3;
  double ct0_ratio = 0, ct1_ratio = 0, ct2_ratio = 0;  ///< thrust coefficient: CT0 + CT1 J + CT2 J^2
  double cq0_ratio = 0, cq1_ratio = 0, cq2_ratio = 0;  ///< torque coefficient
  double torque_constant_ratio = 0.01;                 ///< K_Q, N m/A; also V s/rad
  double resistance_ohm = 0.05;
  double no_load_amp = 1;
  double battery_volt = 12;            ///< at full throttle
  double time_constant_s = 0.05;       ///< of motor and propeller spinning up
  List<PropellerPlace, 8> propellers{};  ///< each with a motor of its own; empty: one, on the x axis
  Battery pack{};                        ///< what its battery loses; `battery_volt` is its voltage when full
};

/// One control surface: how far it moves, how its servo follows, and what hardware needs to drive it.
struct Surface {
  double limit_rad = 0.5;  ///< throw, either way
  double rate_limit_radps = 10;
  double time_constant_s = 0.02;
  double trim_rad = 0;    ///< deflection in trimmed cruise: the feed-forward of the inner loop
  bool reversed = false;  ///< of the servo on the real aircraft; a simulated one knows its own sense
  double min_rad = -10;   ///< where its servo stops, if not at the throw; below -9 it does
  double max_rad = 10;
  double dead_band_rad = 0;            ///< width within which a changed command does not move it
  double natural_frequency_radps = 0;  ///< of a servo of second order, in place of the time constant; 0: none
  double damping_ratio = 1;
};

/// What the servos move. Beard & McLain, section 4.2.
enum class Mixer : std::uint8_t {
  conventional,
  elevons,  ///< `aileron` is the left one, `elevator` the right one
  v_tail    ///< `elevator` is the left ruddervator, `rudder` the right one
};

struct FlightLimits {
  double airspeed_min_mps = 10, airspeed_cruise_mps = 15, airspeed_max_mps = 25;
  double roll_max_rad = 0.785, pitch_max_rad = 0.35, pitch_min_rad = -0.35;
  double climb_rate_max_mps = 4, sink_rate_max_mps = 3;
  double throttle_cruise_frac = 0.5;
};

/// One aircraft: a parameter `Record<Airframe> airframe` is filled from the mission's `airframe:`.
struct Airframe {
  Text<32> name;
  double mass_kg = 1;
  Inertia inertia;
  Wing wing;
  Aerodynamics aero;
  Propulsion propulsion;
  Surface aileron, elevator, rudder;
  Mixer mixer = Mixer::conventional;
  FlightLimits limits;
  Gear gear;
};

/// What no aircraft is without: its defaults would fly as some other one.
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
inline constexpr std::array<std::string_view, 1> required_fields<Surface>{"limit_rad"};

/// From an insect to an airliner: what lies outside is a slip of sign or unit.
template <>
inline constexpr std::array<FieldRange, 1> field_ranges<Airframe>{{{"mass_kg", 1e-4, 1e6}}};
template <>
inline constexpr std::array<FieldRange, 3> field_ranges<Inertia>{
    {{"xx_kgm2", 1e-9, 1e9}, {"yy_kgm2", 1e-9, 1e9}, {"zz_kgm2", 1e-9, 1e9}}};
template <>
inline constexpr std::array<FieldRange, 3> field_ranges<Wing>{
    {{"area_m2", 1e-4, 1e4}, {"span_m", 1e-2, 1e3}, {"chord_m", 1e-3, 1e2}}};
template <>
inline constexpr std::array<FieldRange, 6> field_ranges<Surface>{{{"limit_rad", 0, 1.6},
                                                                  {"min_rad", -10, 1.6},
                                                                  {"max_rad", -1.6, 10},
                                                                  {"dead_band_rad", 0, 1.6},
                                                                  {"natural_frequency_radps", 0, 1e4},
                                                                  {"damping_ratio", 0, 100}}};

}  // namespace fulmar

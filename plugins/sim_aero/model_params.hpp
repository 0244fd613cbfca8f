// SPDX-License-Identifier: BSD-3-Clause
// Additions to the airframe's derivatives as live parameters, to change the model in flight. All 0: the
// airframe of the file.
#pragma once
#include <array>

#include "fulmar/msg/airframe.hpp"
#include "fulmar/plugin.hpp"

namespace fulmar::sim {

struct LiftAdditions {
  Param add_lift_zero{0, "", -5, 5, "addition to CL_0"};
  Param add_lift_alpha{0, "", -50, 50, "addition to CL_alpha"};
  Param add_lift_beta{0, "", -50, 50, "addition to CL_beta"};
  Param add_lift_p{0, "", -200, 200, "addition to CL_p"};
  Param add_lift_q{0, "", -200, 200, "addition to CL_q"};
  Param add_lift_r{0, "", -200, 200, "addition to CL_r"};
  Param add_lift_aileron{0, "", -10, 10, "addition to CL_da"};
  Param add_lift_elevator{0, "", -10, 10, "addition to CL_de"};
  Param add_lift_rudder{0, "", -10, 10, "addition to CL_dr"};
  Param add_lift_flap{0, "", -10, 10, "addition to CL_df"};
  std::array<double, 10> values() const {
    return {add_lift_zero, add_lift_alpha,   add_lift_beta,     add_lift_p,      add_lift_q,
            add_lift_r,    add_lift_aileron, add_lift_elevator, add_lift_rudder, add_lift_flap};
  }
};

struct DragAdditions {
  Param add_drag_zero{0, "", -5, 5, "addition to CD_0"};
  Param add_drag_alpha{0, "", -50, 50, "addition to CD_alpha"};
  Param add_drag_beta{0, "", -50, 50, "addition to CD_beta"};
  Param add_drag_p{0, "", -200, 200, "addition to CD_p"};
  Param add_drag_q{0, "", -200, 200, "addition to CD_q"};
  Param add_drag_r{0, "", -200, 200, "addition to CD_r"};
  Param add_drag_aileron{0, "", -10, 10, "addition to CD_da"};
  Param add_drag_elevator{0, "", -10, 10, "addition to CD_de"};
  Param add_drag_rudder{0, "", -10, 10, "addition to CD_dr"};
  Param add_drag_flap{0, "", -10, 10, "addition to CD_df"};
  std::array<double, 10> values() const {
    return {add_drag_zero, add_drag_alpha,   add_drag_beta,     add_drag_p,      add_drag_q,
            add_drag_r,    add_drag_aileron, add_drag_elevator, add_drag_rudder, add_drag_flap};
  }
};

struct SideAdditions {
  Param add_side_zero{0, "", -5, 5, "addition to CY_0"};
  Param add_side_alpha{0, "", -50, 50, "addition to CY_alpha"};
  Param add_side_beta{0, "", -50, 50, "addition to CY_beta"};
  Param add_side_p{0, "", -200, 200, "addition to CY_p"};
  Param add_side_q{0, "", -200, 200, "addition to CY_q"};
  Param add_side_r{0, "", -200, 200, "addition to CY_r"};
  Param add_side_aileron{0, "", -10, 10, "addition to CY_da"};
  Param add_side_elevator{0, "", -10, 10, "addition to CY_de"};
  Param add_side_rudder{0, "", -10, 10, "addition to CY_dr"};
  Param add_side_flap{0, "", -10, 10, "addition to CY_df"};
  std::array<double, 10> values() const {
    return {add_side_zero, add_side_alpha,   add_side_beta,     add_side_p,      add_side_q,
            add_side_r,    add_side_aileron, add_side_elevator, add_side_rudder, add_side_flap};
  }
};

struct RollAdditions {
  Param add_roll_zero{0, "", -5, 5, "addition to Cl_0"};
  Param add_roll_alpha{0, "", -50, 50, "addition to Cl_alpha"};
  Param add_roll_beta{0, "", -50, 50, "addition to Cl_beta"};
  Param add_roll_p{0, "", -200, 200, "addition to Cl_p"};
  Param add_roll_q{0, "", -200, 200, "addition to Cl_q"};
  Param add_roll_r{0, "", -200, 200, "addition to Cl_r"};
  Param add_roll_aileron{0, "", -10, 10, "addition to Cl_da"};
  Param add_roll_elevator{0, "", -10, 10, "addition to Cl_de"};
  Param add_roll_rudder{0, "", -10, 10, "addition to Cl_dr"};
  Param add_roll_flap{0, "", -10, 10, "addition to Cl_df"};
  std::array<double, 10> values() const {
    return {add_roll_zero, add_roll_alpha,   add_roll_beta,     add_roll_p,      add_roll_q,
            add_roll_r,    add_roll_aileron, add_roll_elevator, add_roll_rudder, add_roll_flap};
  }
};

struct PitchAdditions {
  Param add_pitch_zero{0, "", -5, 5, "addition to Cm_0"};
  Param add_pitch_alpha{0, "", -50, 50, "addition to Cm_alpha"};
  Param add_pitch_beta{0, "", -50, 50, "addition to Cm_beta"};
  Param add_pitch_p{0, "", -200, 200, "addition to Cm_p"};
  Param add_pitch_q{0, "", -200, 200, "addition to Cm_q"};
  Param add_pitch_r{0, "", -200, 200, "addition to Cm_r"};
  Param add_pitch_aileron{0, "", -10, 10, "addition to Cm_da"};
  Param add_pitch_elevator{0, "", -10, 10, "addition to Cm_de"};
  Param add_pitch_rudder{0, "", -10, 10, "addition to Cm_dr"};
  Param add_pitch_flap{0, "", -10, 10, "addition to Cm_df"};
  std::array<double, 10> values() const {
    return {add_pitch_zero, add_pitch_alpha,   add_pitch_beta,     add_pitch_p,      add_pitch_q,
            add_pitch_r,    add_pitch_aileron, add_pitch_elevator, add_pitch_rudder, add_pitch_flap};
  }
};

struct YawAdditions {
  Param add_yaw_zero{0, "", -5, 5, "addition to Cn_0"};
  Param add_yaw_alpha{0, "", -50, 50, "addition to Cn_alpha"};
  Param add_yaw_beta{0, "", -50, 50, "addition to Cn_beta"};
  Param add_yaw_p{0, "", -200, 200, "addition to Cn_p"};
  Param add_yaw_q{0, "", -200, 200, "addition to Cn_q"};
  Param add_yaw_r{0, "", -200, 200, "addition to Cn_r"};
  Param add_yaw_aileron{0, "", -10, 10, "addition to Cn_da"};
  Param add_yaw_elevator{0, "", -10, 10, "addition to Cn_de"};
  Param add_yaw_rudder{0, "", -10, 10, "addition to Cn_dr"};
  Param add_yaw_flap{0, "", -10, 10, "addition to Cn_df"};
  std::array<double, 10> values() const {
    return {add_yaw_zero, add_yaw_alpha,   add_yaw_beta,     add_yaw_p,      add_yaw_q,
            add_yaw_r,    add_yaw_aileron, add_yaw_elevator, add_yaw_rudder, add_yaw_flap};
  }
};

struct ModelParams {
  Param add_parasite_drag{0, "", -1, 1, "addition to CD_p of the airframe"};
  LiftAdditions lift;
  DragAdditions drag;
  SideAdditions side;
  RollAdditions roll;
  PitchAdditions pitch;
  YawAdditions yaw;
};

/// Airframe and derivatives that a group of ten additions belongs to.
struct ModelAddition {
  Derivatives Aerodynamics::*to;
  std::array<double, 10> add;
};
inline std::array<ModelAddition, 6> additions(const ModelParams& p) {
  using A = Aerodynamics;
  return {{{&A::lift, p.lift.values()},
           {&A::drag, p.drag.values()},
           {&A::side, p.side.values()},
           {&A::roll, p.roll.values()},
           {&A::pitch, p.pitch.values()},
           {&A::yaw, p.yaw.values()}}};
}

/// Writes the derivatives of `file` plus the additions into `a`, a copy of `file` that may hold other
/// additions. Returns true for a change.
inline bool add_to(const Airframe& file, const ModelParams& p, Airframe& a) {
  using D = Derivatives;
  constexpr std::array<double D::*, 10> names{
      &D::zero_ratio, &D::alpha_ratio,   &D::beta_ratio,     &D::p_ratio,      &D::q_ratio,
      &D::r_ratio,    &D::aileron_ratio, &D::elevator_ratio, &D::rudder_ratio, &D::flap_ratio};
  bool changed = false;
  const auto put = [&](double& at, double value) {
    changed = changed || at != value;
    at = value;
  };
  put(a.aero.parasite_drag_ratio, file.aero.parasite_drag_ratio + p.add_parasite_drag);
  for (const ModelAddition& one : additions(p))
    for (std::size_t i = 0; i < names.size(); ++i)
      put(a.aero.*(one.to).*(names[i]), file.aero.*(one.to).*(names[i]) + one.add[i]);
  return changed;
}

}  // namespace fulmar::sim

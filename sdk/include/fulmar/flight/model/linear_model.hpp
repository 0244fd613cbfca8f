// SPDX-License-Identifier: BSD-3-Clause
// The model about a steady flight: d(x - x*)/dt = A (x - x*) + B (u - u*), by automatic differentiation of
// the simulator's model. Beard & McLain, Small Unmanned Aircraft (2012), section 5.5.
#pragma once
#include <Eigen/Core>
#include <array>
#include <concepts>

#include "fulmar/flight/math/dual.hpp"
#include "fulmar/flight/model/aircraft_model.hpp"

namespace fulmar {

/// A, 12 x 12, and B, 12 x 4, in the order and units of model::State and model::Input.
struct LinearModel {
  Eigen::Matrix<double, model::states, model::states> A;
  Eigen::Matrix<double, model::states, model::inputs> B;
};

/// A part of the model with these states and inputs.
template <std::size_t N, std::size_t M>
struct LinearBlock {
  Eigen::Matrix<double, int(N), int(N)> A;
  Eigen::Matrix<double, int(N), int(M)> B;
};

namespace model {
inline constexpr std::array<int, 4> longitudinal_states{u, w, q, pitch}, lateral_states{v, p, r, roll};
inline constexpr std::array<int, 2> longitudinal_inputs{elevator, throttle}, lateral_inputs{aileron, rudder};
/// States of the motion, which does not depend on place and heading. The change of density with height is
/// neglected.
inline constexpr std::array<int, 8> motion_states{u, w, q, pitch, v, p, r, roll};
inline constexpr std::array<int, 4> all_inputs{aileron, elevator, rudder, throttle};
}  // namespace model

/// By automatic differentiation; a template, so that only its users compile it.
template <std::same_as<AircraftModel> Model>
LinearModel linear_model(const Model& m, const model::StateVector<double>& x,
                         const model::InputVector<double>& input) {
  constexpr int n = model::states + model::inputs;
  using D = Dual<n>;
  model::StateVector<D> x_dual;
  model::InputVector<D> u_dual;
  for (int i = 0; i < model::states; ++i) x_dual(i) = D::variable(x(i), i);
  for (int i = 0; i < model::inputs; ++i) u_dual(i) = D::variable(input(i), model::states + i);
  const model::StateVector<D> rate = m.template rate<D>(x_dual, u_dual);
  LinearModel out;
  for (int i = 0; i < model::states; ++i) {
    for (int k = 0; k < model::states; ++k) out.A(i, k) = rate(i).d[std::size_t(k)];
    for (int k = 0; k < model::inputs; ++k) out.B(i, k) = rate(i).d[std::size_t(model::states + k)];
  }
  return out;
}

/// Rows and columns of these states and inputs; couplings to others are neglected.
template <std::size_t N, std::size_t M>
LinearBlock<N, M> block_of(const LinearModel& all, const std::array<int, N>& states,
                           const std::array<int, M>& inputs) {
  return {all.A(states, states), all.B(states, inputs)};
}
/// u, w, q, theta; elevator, throttle.
inline LinearBlock<4, 2> longitudinal(const LinearModel& all) {
  return block_of(all, model::longitudinal_states, model::longitudinal_inputs);
}
/// v, p, r, phi; aileron, rudder.
inline LinearBlock<4, 2> lateral(const LinearModel& all) {
  return block_of(all, model::lateral_states, model::lateral_inputs);
}

}  // namespace fulmar

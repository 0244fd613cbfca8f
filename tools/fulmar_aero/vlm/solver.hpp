// SPDX-License-Identifier: BSD-3-Clause
// The flow about a lattice: circulations by one factorisation, forces by Kutta-Joukowski on the bound
// vortices with all induced velocities, and their exact derivatives.
#pragma once
#include <Eigen/Core>

#include "tools/fulmar_aero/vlm/lattice.hpp"

namespace fulmar::aero {

/// Angle of attack and sideslip, rad; body rates as p b/2V, q c/2V, r b/2V; deflections, rad.
struct FlowState {
  double alpha = 0, beta = 0, p = 0, q = 0, r = 0;
  std::array<double, controls> deflection{};
};

/// CL, CD (along the stream), CY, and moments about body axes x forward, y right, z down: Cl, Cm, Cn.
struct Six {
  double CL = 0, CD = 0, CY = 0, Cl = 0, Cm = 0, Cn = 0;
};

struct SixDerivatives {
  Six value, alpha, beta, p, q, r;
  std::array<Six, controls> control;
};

class Vlm {
 public:
  /// `about`: reference of moments and rates. `wake_alpha`: angle of the wake to x, rad; behind the trailing
  /// edge the wake is straight. Throws core::Error when no flow is found.
  Vlm(const Lattice& lattice, const ReferenceQuantities& reference, const Eigen::Vector3d& about,
      double wake_alpha = 0);

  Six forces(const FlowState& state) const;
  SixDerivatives derivatives(const FlowState& state) const;
  /// Induced drag and lift in the wake's plane far behind. Drela (2014), section 5.6.
  struct FarField {
    double CL = 0, CD = 0, CY = 0;
  };
  FarField far_field(const FlowState& state) const;
  /// Lift coefficient of each strip: 2 Gamma / (V c).
  Eigen::VectorXd strip_lift(const FlowState& state) const;

 private:
  struct Basis {
    Eigen::VectorXd weight;  ///< of the solutions
    Eigen::Vector3d stream, omega;
  };
  Basis basis(const FlowState& state) const;
  Basis change(const FlowState& state, int which) const;
  Six coefficients(const Basis& now, const Basis* change, const FlowState& state, int which) const;

  Lattice lattice_;
  ReferenceQuantities reference_;
  Eigen::Vector3d about_;
  double wake_alpha_;
  /// Columns: the stream's three components, the three rates, and the three components for each control.
  Eigen::MatrixXd circulation_;
  std::array<Eigen::MatrixXd, 3> induced_;  ///< at the bound vortices
};

}  // namespace fulmar::aero

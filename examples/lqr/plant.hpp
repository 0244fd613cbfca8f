// SPDX-License-Identifier: BSD-3-Clause
// Linear model of a fixed-wing aircraft near level flight: x' = A x + B u, by central differences of the
// SDK's flight model. Beard & McLain, Small Unmanned Aircraft (2012): (3.14)-(3.17) and chapter 4, linearised
// as in section 5.5.
#pragma once
#include <Eigen/Core>
#include <cmath>
#include <fulmar/flight/math/attitude.hpp>
#include <fulmar/flight/model/trim.hpp>
#include <stdexcept>

struct Plant {
  enum : int {
    V,
    alpha,
    theta,
    q,
    h,
    beta,
    phi,
    p,
    r,
    chi,
    int_h,
    int_V,
    int_chi,
    n
  };                                                      // indices of the state
  enum : int { throttle, elevator, aileron, rudder, m };  // indices of the input
  using State = Eigen::Matrix<double, n, 1>;
  using Input = Eigen::Matrix<double, m, 1>;

  Eigen::Matrix<double, n, n> A;
  Eigen::Matrix<double, n, m> B;
  State x0 = State::Zero();  // level flight at the cruise speed, without wind
  Input u0 = Input::Zero();
  double rho_kgm3 = 0;

  /// x' from the equations of motion. They do not depend on course and height. The propeller has its steady
  /// speed, the surfaces are at their commands.
  static State derivative(const fulmar::Airframe& a, const State& x, const Input& u, double rho) {
    Eigen::Matrix3d J = Eigen::Vector3d(a.inertia.xx_kgm2, a.inertia.yy_kgm2, a.inertia.zz_kgm2).asDiagonal();
    J(0, 2) = J(2, 0) = -a.inertia.xz_kgm2;
    const Eigen::Vector3d v_b =
        x(V) * Eigen::Vector3d(std::cos(x(alpha)) * std::cos(x(beta)), std::sin(x(beta)),
                               std::sin(x(alpha)) * std::cos(x(beta)));  // (2.7)
    const Eigen::Vector3d omega_b(x(p), x(q), x(r));
    fulmar::RigidBody body;
    body.q_nb = fulmar::quaternion_from({x(phi), x(theta), 0});
    body.v_n = body.q_nb * v_b;
    body.omega_b = omega_b;
    const fulmar::Propeller propeller(a.propulsion);
    const double Omega = propeller.steady_speed(u(throttle), x(V), rho);
    fulmar::Load load = fulmar::Aerodynamic(a).load(v_b, omega_b, {u(aileron), u(elevator), u(rudder)}, rho);
    load.force_b.x() += propeller.thrust(Omega, x(V), rho);
    load.moment_b.x() -= propeller.torque(Omega, x(V), rho);
    const fulmar::RigidBodyRate d =
        fulmar::rate_of(body, load, {a.mass_kg, J}, Eigen::Vector3d(0, 0, fulmar::isa::g0));
    const Eigen::Vector3d a_b = body.q_nb.conjugate() * d.v_n - omega_b.cross(v_b);  // (3.15)

    State dot = State::Zero();
    dot(V) = v_b.dot(a_b) / x(V);
    dot(alpha) = (v_b.x() * a_b.z() - v_b.z() * a_b.x()) / (v_b.x() * v_b.x() + v_b.z() * v_b.z());
    dot(beta) = (a_b.y() - std::sin(x(beta)) * dot(V)) / (x(V) * std::cos(x(beta)));
    dot(phi) = x(p) + std::tan(x(theta)) * (std::sin(x(phi)) * x(q) + std::cos(x(phi)) * x(r));  // (3.16)
    dot(theta) = std::cos(x(phi)) * x(q) - std::sin(x(phi)) * x(r);
    dot(p) = d.omega_b.x();
    dot(q) = d.omega_b.y();
    dot(r) = d.omega_b.z();
    dot(h) = -body.v_n.z();
    dot(chi) = (body.v_n.x() * d.v_n.y() - body.v_n.y() * d.v_n.x()) / body.v_n.head<2>().squaredNorm();
    return dot;
  }

  static constexpr const char* level_flight_missing = "this airframe has no level flight at its cruise speed";

  /// Linearised at level flight, cruise speed, and air density `rho`.
  static Plant linearised(const fulmar::Airframe& airframe, double rho) {
    const fulmar::Trim trim = fulmar::trimmed_flight(airframe, airframe.limits.airspeed_cruise_mps, rho);
    if (!trim.found) throw std::runtime_error(level_flight_missing);
    Plant plant;
    plant.rho_kgm3 = rho;
    plant.x0(V) = airframe.limits.airspeed_cruise_mps;
    plant.x0(alpha) = trim.alpha_rad;
    plant.x0(beta) = trim.beta_rad;
    plant.x0(theta) = trim.pitch_rad;
    plant.u0 << trim.throttle_frac, trim.deflections.elevator, trim.deflections.aileron,
        trim.deflections.rudder;
    const double d = 1e-5;
    for (int k = 0; k < n; ++k) {
      const State dx = d * State::Unit(k);
      plant.A.col(k) = (derivative(airframe, plant.x0 + dx, plant.u0, rho) -
                        derivative(airframe, plant.x0 - dx, plant.u0, rho)) /
                       (2 * d);
    }
    for (int k = 0; k < m; ++k) {
      const Input du = d * Input::Unit(k);
      plant.B.col(k) = (derivative(airframe, plant.x0, plant.u0 + du, rho) -
                        derivative(airframe, plant.x0, plant.u0 - du, rho)) /
                       (2 * d);
    }
    plant.A(int_h, h) = plant.A(int_V, V) = plant.A(int_chi, chi) = 1;
    return plant;
  }
};

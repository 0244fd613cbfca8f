// SPDX-License-Identifier: BSD-3-Clause
// Modes of motion of a linear model, identified by the states that participate in them, not by order or size.
// Participation factors: Perez-Arriaga, Verghese & Schweppe, "Selective modal analysis", IEEE Trans. PAS-101
// (1982): |left eigenvector times right eigenvector|, which does not depend on units. Modes: Etkin & Reid,
// Dynamics of Flight (1996), chapter 6.
#pragma once
#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <concepts>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

#include "fulmar/flight/model/linear_model.hpp"

namespace fulmar {

/// If two modes of a kind are real, the faster one is first.
enum class ModeKind : std::uint8_t { short_period, phugoid, dutch_roll, roll, spiral, roll_spiral };

/// One mode of motion: an eigenvalue of A, or a pair, with the participation of each state.
struct Mode {
  ModeKind kind = ModeKind::short_period;
  std::complex<double> eigenvalue;        ///< 1/s; of a pair the one above the real axis
  std::array<double, 8> participation{};  ///< of model::motion_states; sum 1

  bool oscillates() const { return eigenvalue.imag() > 0; }
  bool stable() const { return eigenvalue.real() < 0; }
  double natural_radps() const { return std::abs(eigenvalue); }
  double damping_ratio() const { return -eigenvalue.real() / std::abs(eigenvalue); }
  /// Time of a decay to 1/e, or of a growth to e.
  double time_constant_s() const { return 1 / std::abs(eigenvalue.real()); }
  /// Time to half, or, for an unstable mode, to double.
  double half_or_double_s() const { return std::numbers::ln2 / std::abs(eigenvalue.real()); }
  double period_s() const { return 2 * std::numbers::pi / eigenvalue.imag(); }
};

namespace detail {

using MotionMatrix = Eigen::Matrix<double, 8, 8>;

/// Eigenvalues with their participations; one entry for a pair.
template <std::same_as<MotionMatrix> Matrix>
std::vector<Mode> modes_without_names(const Matrix& A) {
  const Eigen::EigenSolver<Matrix> solver(A);
  const Eigen::Matrix<std::complex<double>, 8, 8> V = solver.eigenvectors(), W = V.inverse();
  std::vector<Mode> modes;
  for (int i = 0; i < 8; ++i) {
    const std::complex<double> eigenvalue = solver.eigenvalues()(i);
    if (eigenvalue.imag() < 0) continue;
    Mode mode;
    mode.eigenvalue = eigenvalue;
    double sum = 0;
    for (int k = 0; k < 8; ++k) sum += std::abs(V(k, i) * W(i, k));
    if (!std::isfinite(sum) || sum == 0) sum = std::numeric_limits<double>::infinity();  // no eigenvectors
    for (int k = 0; k < 8; ++k) {
      const double share = std::abs(V(k, i) * W(i, k)) / sum;
      mode.participation[std::size_t(k)] = std::isfinite(share) ? share : 0;
    }
    modes.push_back(mode);
  }
  return modes;
}

/// Takes from `from` the modes, `order` eigenvalues together, in which the states `in` participate most. The
/// rest stays. In the order of `from`.
inline std::vector<Mode> take(std::vector<Mode>& from, int order, const std::vector<std::size_t>& in) {
  double most = -1;
  unsigned best = 0;
  for (unsigned set = 0; set < 1U << from.size(); ++set) {
    int size = 0;
    double share = 0;
    for (std::size_t i = 0; i < from.size(); ++i) {
      if (!(set >> i & 1U)) continue;
      const int weight = from[i].oscillates() ? 2 : 1;
      size += weight;
      for (const std::size_t k : in) share += weight * from[i].participation[k];
    }
    if (size == order && share > most) {
      most = share;
      best = set;
    }
  }
  std::vector<Mode> taken, rest;
  for (std::size_t i = 0; i < from.size(); ++i) (best >> i & 1U ? taken : rest).push_back(from[i]);
  from = rest;
  return taken;
}

inline void name_modes(std::vector<Mode> modes, ModeKind kind, std::vector<Mode>& out) {
  std::stable_sort(modes.begin(), modes.end(), [](const Mode& a, const Mode& b) {
    return std::abs(a.eigenvalue) > std::abs(b.eigenvalue);
  });
  for (Mode& mode : modes) {
    mode.kind = kind;
    out.push_back(mode);
  }
}

}  // namespace detail

/// The modes, in the order of `ModeKind`. Each kind but roll and spiral is a pair, or two real modes without
/// oscillation. Roll and spiral may be one pair (`roll_spiral`). A template, so that only its users compile
/// the eigenvectors, which takes longer than most files.
template <std::same_as<LinearModel> Model>
std::vector<Mode> modes_of(const Model& all) {
  // indices in model::motion_states
  constexpr std::size_t u = 0, w = 1, q = 2, pitch = 3, v = 4, p = 5, r = 6;
  const detail::MotionMatrix A = all.A(model::motion_states, model::motion_states);
  std::vector<Mode> lateral = detail::modes_without_names(A), out;
  std::vector<Mode> longitudinal = detail::take(lateral, 4, {u, w, q, pitch});
  detail::name_modes(detail::take(longitudinal, 2, {w, q}), ModeKind::short_period, out);
  detail::name_modes(longitudinal, ModeKind::phugoid, out);
  detail::name_modes(detail::take(lateral, 2, {v, r}), ModeKind::dutch_roll, out);
  if (lateral.size() == 1) {
    detail::name_modes(lateral, ModeKind::roll_spiral, out);
  } else {
    detail::name_modes(detail::take(lateral, 1, {p}), ModeKind::roll, out);
    detail::name_modes(lateral, ModeKind::spiral, out);
  }
  return out;
}

}  // namespace fulmar

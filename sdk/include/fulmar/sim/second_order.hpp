// SPDX-License-Identifier: BSD-3-Clause
// x'' = omega^2 (aim - x) - 2 zeta omega x' with bounded |x'|, solved exactly for a constant aim over a step:
// in closed form below the rate limit, along a line at the limit. E.g. Ogata, Modern Control Engineering,
// section 5.3.
#pragma once
#include <algorithm>
#include <cmath>

namespace fulmar::sim {

/// Second-order servo: position in any unit, `omega` in rad/s, damping ratio `zeta`.
class SecondOrder {
 public:
  /// `omega` 0: no second-order servo.
  SecondOrder(double omega, double zeta) : omega_(omega), zeta_(zeta) {}

  bool given() const { return omega_ > 0; }
  double rate() const { return v_; }
  void rest() { v_ = 0; }

  /// Moves from `x` towards `aim` for `dt`; returns the new x.
  double advance(double x, double aim, double max_rate, double dt) {
    // short enough for at most one extremum of the rate in each
    const int pieces = std::max(1, static_cast<int>(std::ceil(omega_ * dt)));
    const Piece piece = piece_of(dt / pieces);
    double e = x - aim;
    for (int i = 0; i < pieces; ++i) advance_piece(e, max_rate, piece);
    return e + aim;
  }

 private:
  /// The free motion over h: e' = ee e + ev v, v' = ve e + vv v.
  struct Piece {
    double h = -1, ee = 1, ev = 0, ve = 0, vv = 1;
  };

  Piece piece_of(double h) {
    if (h != kept_.h) kept_ = free_motion(h);
    return kept_;
  }

  Piece free_motion(double h) const {
    const double sigma = zeta_ * omega_, square = omega_ * omega_ * (zeta_ * zeta_ - 1), s = square * h * h;
    // cosh and sinh(w h) / w of w^2 = square, or cos and sin for a negative square
    double c = 1, sh = h;
    if (s > 1e-12) {
      const double w = std::sqrt(square);
      c = std::cosh(w * h);
      sh = std::sinh(w * h) / w;
    } else if (s < -1e-12) {
      const double w = std::sqrt(-square);
      c = std::cos(w * h);
      sh = std::sin(w * h) / w;
    }
    const double decay = std::exp(-sigma * h);
    return {h, decay * (c + sigma * sh), decay * sh, -decay * omega_ * omega_ * sh, decay * (c - sigma * sh)};
  }

  double acceleration(double e, double v) const { return -omega_ * omega_ * e - 2 * zeta_ * omega_ * v; }

  void advance_piece(double& e, double most, const Piece& piece) {
    double left = piece.h;
    for (int turn = 0; turn < 8 && left > 0; ++turn) {
      if (std::abs(v_) >= most && acceleration(e, v_) * v_ > 0) {
        v_ = std::copysign(most, v_);
        const double leaves = -2 * zeta_ * v_ / omega_;  // position of the free deceleration
        const double time = acceleration(e, v_) * v_ > 0 ? (leaves - e) / v_ : 0;
        if (time > 0) {
          e += v_ * std::min(left, time);
          left -= std::min(left, time);
          if (left <= 0) return;
          e = leaves;
        }
      }
      const double free = time_to_bound(e, most, turn == 0 && left == piece.h ? piece : free_motion(left));
      const Piece p = free == piece.h ? piece : free_motion(free);
      const double e0 = e;
      e = p.ee * e0 + p.ev * v_;
      v_ = p.ve * e0 + p.vv * v_;
      left -= free;
      if (left > 0) v_ = std::copysign(most, v_);
    }
  }

  /// Time until the rate reaches its limit, within the piece; the whole piece if it does not.
  double time_to_bound(double e, double most, const Piece& whole) const {
    const auto rate = [&](double t) {
      const Piece p = free_motion(t);
      return p.ve * e + p.vv * v_;
    };
    const auto slope = [&](double t) {
      const Piece p = free_motion(t);
      return acceleration(p.ee * e + p.ev * v_, p.ve * e + p.vv * v_);
    };
    most *= 1 + 1e-9;  // tolerance for rounding at the limit
    const double a0 = acceleration(e, v_), v1 = whole.ve * e + whole.vv * v_;
    const double a1 = acceleration(whole.ee * e + whole.ev * v_, v1);
    double until = whole.h;
    if (std::abs(v1) <= most) {  // unless it is beyond in between
      if (a0 * a1 >= 0 || std::abs(v_) + std::abs(a0) * whole.h <= most) return whole.h;
      until = root(0, whole.h, [&](double t) { return slope(t) * a0; });
      if (std::abs(rate(until)) <= most) return whole.h;
    }
    return root(0, until, [&](double t) { return most - std::abs(rate(t)); });
  }

  /// Root of f, which is positive before and negative after it.
  template <class F>
  static double root(double low, double high, F&& f) {
    for (int i = 0; i < 50; ++i) {
      const double middle = 0.5 * (low + high);
      (f(middle) > 0 ? low : high) = middle;
    }
    return high;
  }

  double omega_, zeta_;
  double v_ = 0;
  Piece kept_;
};

}  // namespace fulmar::sim

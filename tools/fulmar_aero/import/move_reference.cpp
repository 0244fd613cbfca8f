// SPDX-License-Identifier: BSD-3-Clause
// Moments and rates about another point: rigid-body kinematics, exact for a linear analysis. README.md has
// the equations.
#include <cmath>
#include <numbers>

#include "tools/fulmar_aero/import/aircraft.hpp"

namespace fulmar::aero::imports {
namespace {

constexpr const char* moved = ", moved to the centre of gravity";

void add_to(Value& value, double x) {
  if (!value.known) return;
  value.x += x;
  if (value.from.find(moved) == std::string::npos) value.from += moved;
}

/// Along the body's axes at the analysed angle: what is normal to x, and what points aft.
struct Plane {
  double normal, aft;
};

class Move {
 public:
  Move(const Analysis& a, double dx, double dz)
      : dx_(dx),
        dz_(dz),
        c_(a.chord_m.x),
        b_(a.span_m.x),
        cs_(std::cos(a.alpha_rad.x)),
        sn_(std::sin(a.alpha_rad.x)) {
    // a force without a moment in the tool gets none here
    CL_ = a.base[lift].x;
    CD_ = a.base[drag].x - a.drag_without_moment;
    CL_a_ = a.slope[alpha][lift].x;
    CY_b_ = a.slope[beta][side].x + a.drag_without_moment;
    const Value& given = a.slope[alpha][drag];
    const double AR = b_ * b_ / a.area_m2.x;
    CD_a_ = given.known ? given.x : 2 * CL_ * CL_a_ / (std::numbers::pi * usual_oswald * AR);
  }

  void rates(Analysis& a) {
    // with q, angle of attack and speed of the old point differ from those of the new one
    const double by_alpha = -2 / c_ * (dx_ * cs_ + dz_ * sn_), by_speed = 4 / c_ * (dz_ * cs_ - dx_ * sn_);
    add_to(a.slope[q][lift], by_alpha * (CL_a_ + CD_) + by_speed * CL_);
    CD_q_ = by_alpha * (CD_a_ - CL_) + by_speed * CD_;  // for unknown derivatives only the change
    add_to(a.slope[q][drag], CD_q_);
    add_to(a.slope[q][pitch], by_alpha * a.slope[alpha][pitch].x + by_speed * a.base[pitch].x);
    // with p and r its sideslip differs
    for (const Force force : {side, roll, yaw}) {
      const double of_beta = force == side ? CY_b_ : a.slope[beta][force].x;
      add_to(a.slope[p][force], -2 * dz_ / b_ * of_beta);
      add_to(a.slope[r][force], 2 * dx_ / b_ * of_beta);
    }
  }

  void moments(Analysis& a) const {
    add_to(a.base[pitch], pitching(turned(CL_, CD_)));
    const Plane by_alpha{turned(CL_a_ + CD_, CD_a_ - CL_)};
    add_to(a.slope[alpha][pitch], pitching(by_alpha));
    const double CD_q = a.slope[q][drag].known ? a.slope[q][drag].x : CD_q_;
    add_to(a.slope[q][pitch], pitching(turned(a.slope[q][lift].x, CD_q)));
    sideways(a.slope[beta], CY_b_);
    for (const By by : {p, r}) sideways(a.slope[by], a.slope[by][side].x);
    for (Control& control : a.controls) {
      add_to(control.of[pitch], pitching(turned(control.of[lift].x, control.of[drag].x)));
      sideways(control.of, control.of[side].x);
    }
  }

 private:
  Plane turned(double CL, double CD) const { return {CL * cs_ + CD * sn_, -CL * sn_ + CD * cs_}; }
  double pitching(const Plane& force) const { return (force.normal * dx_ - force.aft * dz_) / c_; }
  void sideways(Column& column, double CY) const {
    add_to(column[yaw], CY * dx_ / b_);
    add_to(column[roll], -CY * dz_ / b_);
  }

  double dx_, dz_, c_, b_, cs_, sn_;
  double CL_ = 0, CD_ = 0, CL_a_ = 0, CD_a_ = 0, CY_b_ = 0, CD_q_ = 0;
};

}  // namespace

void move_reference(Analysis& a, double dx, double dz) {
  Move move(a, dx, dz);
  move.rates(a);  // by the slopes about the old point
  move.moments(a);
  a.reference_m[0] += dx;
  a.reference_m[2] += dz;
}

}  // namespace fulmar::aero::imports

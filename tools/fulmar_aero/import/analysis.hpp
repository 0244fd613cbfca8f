// SPDX-License-Identifier: BSD-3-Clause
// Results of the readers of other tools' files, in one set of conventions. Every reader converts axes, signs
// and units of its tool to those of Beard & McLain (Small Unmanned Aircraft, 2012, chapter 4), at the
// analysed angle of attack.
#pragma once
#include <array>
#include <complex>
#include <string>
#include <vector>

#include "core/error.hpp"

namespace fulmar::aero::imports {

/// A number with its origin: "merlin.st:40 CLa".
struct Value {
  double x = 0;
  std::string from;
  bool known = false;

  Value() = default;
  Value(double number, std::string source) : x(number), from(std::move(source)), known(true) {}
};

/// CL, CD in the axes of the airflow, CY, Cl, Cm, Cn in body axes.
enum Force : std::uint8_t { lift, drag, side, roll, pitch, yaw, forces };
/// Per radian, and per p b/2V, q c/2V, r b/2V.
enum By : std::uint8_t { alpha, beta, p, q, r, bys };

using Column = std::array<Value, forces>;

/// One control of an analysis, per radian of its surfaces.
struct Control {
  std::string name;  ///< as in the file; "" without one
  Column of;
  double at_rad = 0;  ///< deflection in the analysis
  core::Where where;
};

/// Printed eigenvalues of the tool, 1/s; of a pair the one above the real axis.
struct PrintedModes {
  std::vector<std::complex<double>> longitudinal, lateral, unsorted;
  double airspeed_mps = 0;  ///< 0: not given
  double density_kgm3 = 1.225;
  std::string from;
  bool apparent_mass = false;  ///< AVL includes it (amass.f): no exact reference
  bool empty() const { return longitudinal.empty() && lateral.empty() && unsorted.empty(); }
};

/// One point of a drag polar, for the friction that a potential flow lacks.
struct PolarPoint {
  double alpha_rad = 0, CL = 0;
  Value CD;  ///< with friction
};

/// The forces of one analysed flow and their derivatives.
struct Analysis {
  Value area_m2, chord_m, span_m;
  std::array<double, 3> reference_m{};  ///< moments about it: x aft, y right, z up
  bool has_reference = false;
  Value alpha_rad;
  double airspeed_mps = 0, density_kgm3 = 0;  ///< 0: not given
  Column base;
  std::array<Column, bys> slope;
  std::vector<Control> controls;
  /// Part of the drag that is in the forces and has no moment: AVL's CDp.
  double drag_without_moment = 0;
  bool weak_lateral = false;  ///< XFLR5: Cl_beta, Cn_p, Cn_da and CY_p are unreliable
  bool rate_noise = false;    ///< VSPAERO 7 with its small steps
};

/// Mass, centre of gravity (x aft, y right, z up) and inertia about it: xz is the integral of x z dm.
struct Body {
  Value mass_kg, xx, yy, zz, xz;
  std::array<double, 3> cg_m{};
  bool has_cg = false;
};

/// Content of one file.
struct Input {
  std::string file, what;  ///< "AVL stability derivatives (.st)"
  std::string title;       ///< name of the aircraft, "" without one
  std::vector<Analysis> analyses;
  Body body;
  std::vector<PolarPoint> polar;
  PrintedModes modes;
  double airspeed_mps = 0;
  std::vector<std::pair<std::string, double>> gains;  ///< of control groups, mean gain of their surfaces
  std::vector<std::string> notes;                     ///< for the user
  std::vector<std::string> doubts;                    ///< possible causes of a wrong aircraft
  std::string unused;                                 ///< reason why it is not used, "" when it is
};

const char* force_symbol(Force force);  ///< "Cl" for the rolling moment
const char* by_symbol(By by);           ///< "alpha"

/// Conversion of a column and a row from stability axes at `alpha`, Etkin & Reid, Dynamics of Flight (1996),
/// appendix A: Cl = Cl' cos - Cn' sin, Cn = Cl' sin + Cn' cos.
void turn_moments(Column& column, double alpha);
/// The same for the rates and the columns p' and r' themselves.
void turn_rates(std::array<Column, bys>& slope, double alpha);

}  // namespace fulmar::aero::imports

// SPDX-License-Identifier: BSD-3-Clause
// From the analyses of other tools to one aircraft in Fulmar's conventions.
#pragma once
#include "tools/fulmar_aero/import/analysis.hpp"

namespace fulmar::aero::imports {

/// Factor of a coefficient, in the order of the airframe file.
enum Term : std::uint8_t {
  t_zero,
  t_alpha,
  t_beta,
  t_p,
  t_q,
  t_r,
  t_aileron,
  t_elevator,
  t_rudder,
  t_flap,
  terms
};

enum class Role : std::uint8_t { aileron, elevator, rudder, flap, mixed };

/// Values from the caller, in addition to the files.
struct ImportOptions {
  double mass_kg = 0, length_m = 0, cruise_mps = 0;  ///< 0: not given
  std::array<double, 4> inertia{};                   ///< xx, yy, zz, xz; all 0: not given
  double parasite_drag = 0;                          ///< 0: not given
  double alpha_rad = -100;  ///< selects the nearest analysis of a sweep; -100: not given
  std::string name;
  // files with priority for drag, and for the columns of the controls
  std::string drag_from, controls_from;
};

/// Typical ratio of the span efficiency to that of the elliptic wing; the drag polar is CD_p + CL^2/(pi e
/// AR).
constexpr double usual_oswald = 0.9;

struct Aircraft {
  std::string name;
  Value area_m2, chord_m, span_m, mass_kg, xx, yy, zz, xz;
  std::array<std::array<Value, terms>, forces> c;
  Value parasite, oswald{usual_oswald, "assumption, usual"};
  Value stall_alpha, stall_sharpness;  ///< unknown: the defaults of the writer
  bool elevons = false, v_tail = false;
  std::vector<std::string> sources;   ///< one line per file
  std::vector<std::string> notes;     ///< conversions and doubts
  std::vector<std::string> warnings;  ///< possible causes of a wrong aircraft
  PrintedModes modes;
  double cruise_mps = 0, density_kgm3 = 1.225;
  double converted_parasite = 0;  ///< CD - CL^2/(pi e AR) of the analysis, before any replacement
  std::string parts;              ///< YAML of propulsion and mixer, if the source has them; else ""
  std::string surfaces;           ///< with `parts`: "limit: 40 deg, ..." of every surface
  std::string more_aero;          ///< lines of YAML within `aero`, such as drag_squared
};

/// Throws core::Error: contradictions, no derivatives, a control of unknown effect.
Aircraft aircraft_of(const std::vector<Input>& inputs, const ImportOptions& options);

/// The columns of aileron, elevator, rudder and flaps from all controls, with signs by their effect: positive
/// aileron rolls right, positive elevator takes the nose down, positive rudder takes it left.
struct ControlColumns {
  std::array<Column, 4> of;  ///< by Role
  std::array<bool, 4> known{};
  bool elevons = false, v_tail = false;
  std::vector<std::string> notes;
};
ControlColumns control_columns(const std::vector<Control>& controls);
Role role_of(const Control& control);

/// Moves the reference of moments and rates to a point `dx_m` further aft and `dz_m` further up. A rate at
/// the new point is that rate and another angle of attack, sideslip and speed at the old one.
void move_reference(Analysis& analysis, double dx_m, double dz_m);

}  // namespace fulmar::aero::imports

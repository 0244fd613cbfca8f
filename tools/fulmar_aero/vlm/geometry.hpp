// SPDX-License-Identifier: BSD-3-Clause
// A drawing of an aircraft: surfaces of sections, bodies, masses. Axes of the drawing: x aft, y right, z up,
// from any origin, metres.
#pragma once
#include <memory>
#include <numbers>
#include <string>

#include "core/graph/yaml.hpp"
#include "fulmar/msg/airframe.hpp"

namespace fulmar::aero {

inline constexpr double pi = std::numbers::pi;

/// A section's shape, by one of `naca`, `alpha_zero` and a camber line, and its polar
/// cd = cd_min (Re/reynolds)^-0.2 + cd_rise (cl - cl_at_cd_min)^2.
struct Airfoil {
  Text<32> name;
  Text<8> naca;                                   ///< four digits
  double alpha_zero_rad = 1e9;                    ///< of a section with only a known angle of zero lift
  List<double, 64> camber_x_frac, camber_z_frac;  ///< the mean line over the chord
  double thickness_frac = 0.12;                   ///< of the chord
  double cd_min_ratio = 0;                        ///< 0: of a flat plate with that thickness
  double cl_at_cd_min_ratio = 0, cd_rise_ratio = 0.01;
  double reynolds_ratio = 0;  ///< Reynolds number of cd_min; 0: independent of it
  double cl_max_ratio = 1.2;
};

/// Place of the leading edge, and the section.
struct WingSection {
  double x_m = 0, y_m = 0, z_m = 0, chord_m = 0;
  double twist_rad = 0;  ///< nose up
  Text<32> airfoil;      ///< default: a flat plate
};

enum class Drives : std::uint8_t { aileron, elevator, rudder, flap, elevons, v_tail };

/// A part of the trailing edge, between two places along the span. They are metres from the first section
/// along the surface, so that a fin and a wing with dihedral have the same form.
struct ControlSurface {
  Drives drives = Drives::elevator;
  double from_m = 0, to_m = 0;
  double hinge_frac = 0.75;  ///< of the chord
};

enum class Spacing : std::uint8_t { cosine, uniform, tip };

/// A control on a surface of another file.
struct NamedControl {
  Text<32> surface;
  ControlSurface control;
};

struct LiftingSurface {
  Text<32> name;
  bool mirror = false;                        ///< with a second half on the left
  double x_m = 0, z_m = 0;                    ///< added to all its sections
  double incidence_rad = 0;                   ///< added to all twists
  std::int32_t chordwise = 8, spanwise = 20;  ///< panels, of one half
  Spacing chord_spacing = Spacing::cosine, span_spacing = Spacing::cosine;
  double mass_kg = 0;  ///< of both halves, as a thin sheet of even weight
  List<WingSection, 32> sections;
  List<ControlSurface, 16> controls;
};

/// A fuselage or nacelle: an ellipsoid with respect to its moments.
struct Body {
  Text<32> name;
  double x_m = 0, y_m = 0, z_m = 0;  ///< of its nose
  double length_m = 0, width_m = 0, height_m = 0;
  double mass_kg = 0;       ///< of even density
  bool mirror = false;      ///< another one on the other side, of the same mass
  double drag_area_m2 = 0;  ///< of parts outside the body, such as a gear: added to that of its skin
};

/// A point or a box, with its edges along the axes.
struct MassPart {
  Text<32> name;
  double mass_kg = 0;
  double x_m = 0, y_m = 0, z_m = 0;  ///< of its centre
  double length_m = 0, width_m = 0, height_m = 0;
  bool mirror = false;
  Inertia own{0, 0, 0, 0};  ///< about its centre, in place of the box
};

/// A propeller in front of or behind the body, for its forces in oblique flow.
struct PropellerPart {
  double x_m = 0, y_m = 0, z_m = 0;
  std::int32_t blades = 2;
  double blade_chord_m = 0;  ///< at three quarters of the radius
};

/// Reference quantities of the coefficients.
struct ReferenceQuantities {
  double area_m2 = 0, span_m = 0, chord_m = 0;
};

struct Geometry {
  Text<32> name;
  double altitude_m = 0;  ///< of the standard atmosphere in cruise
  Text<160> planform;     ///< an .avl or .xml file in the folder of the drawing, in place of `surfaces`
  ReferenceQuantities reference;
  List<Airfoil, 16> airfoils;
  List<LiftingSurface, 16> surfaces;
  List<NamedControl, 16> controls;  ///< on surfaces of `planform`
  List<Body, 8> bodies;
  List<MassPart, 64> masses;
  List<PropellerPart, 8> propellers;
  double oswald_ratio = 0;  ///< replaces the computed one; 0: computed
  // as in the airframe
  Mixer mixer = Mixer::conventional;
  Propulsion propulsion;
  Surface aileron, elevator, rudder, flap;
  FlightLimits limits;
  Gear gear;
};

struct GeometryFile {
  std::string name;  ///< as given
  std::unique_ptr<Geometry> geometry;
  core::Node root;

  /// Place of the item of a list: where("surfaces", 2), where("surfaces", 2, "sections", 0).
  core::Where where(const std::string& list, std::size_t i, const std::string& inner = "",
                    std::size_t k = 0) const;
};

/// Throws core::Error with file:line for all faults: missing, unknown or out of range, sections that cross,
/// controls outside their wing, airfoils without a shape.
GeometryFile read_geometry_file(const std::string& name);

/// Slope dz/dx of the mean line at x of the chord; for alpha_zero its tangent. Camber of NACA four digits:
/// Abbott & von Doenhoff, Theory of Wing Sections (1959), (6.4).
double camber_slope(const Airfoil& airfoil, double x_frac);

}  // namespace fulmar::aero

namespace fulmar {

template <>
inline constexpr std::array<std::string_view, 1> required_fields<aero::Airfoil>{"name"};
template <>
inline constexpr std::array<std::string_view, 1> rising_fields<aero::Airfoil>{"camber_x_frac"};
template <>
inline constexpr std::array<std::string_view, 2> required_fields<aero::WingSection>{"y_m", "chord_m"};
template <>
inline constexpr std::array<std::string_view, 3> required_fields<aero::ControlSurface>{"drives", "from_m",
                                                                                       "to_m"};
template <>
inline constexpr std::array<std::string_view, 2> required_fields<aero::NamedControl>{"surface", "control"};
template <>
inline constexpr std::array<std::string_view, 2> required_fields<aero::LiftingSurface>{"name", "sections"};
template <>
inline constexpr std::array<std::string_view, 4> required_fields<aero::Body>{"name", "length_m", "width_m",
                                                                             "height_m"};
template <>
inline constexpr std::array<std::string_view, 3> required_fields<aero::MassPart>{"name", "mass_kg", "x_m"};
template <>
inline constexpr std::array<std::string_view, 2> required_fields<aero::PropellerPart>{"x_m", "blade_chord_m"};
template <>
inline constexpr std::array<std::string_view, 3> required_fields<aero::ReferenceQuantities>{
    "area_m2", "span_m", "chord_m"};
template <>
inline constexpr std::array<std::string_view, 6> required_fields<aero::Geometry>{
    "name", "propulsion", "aileron", "elevator", "rudder", "limits"};

template <>
inline constexpr std::array<FieldRange, 5> field_ranges<aero::Airfoil>{{{"thickness_frac", 0.001, 0.4},
                                                                        {"cd_min_ratio", 0, 0.2},
                                                                        {"cd_rise_ratio", 0, 0.2},
                                                                        {"reynolds_ratio", 0, 1e9},
                                                                        {"cl_max_ratio", 0.3, 4}}};
template <>
inline constexpr std::array<FieldRange, 2> field_ranges<aero::WingSection>{
    {{"chord_m", 1e-3, 1e3}, {"twist_rad", -0.8, 0.8}}};
template <>
inline constexpr std::array<FieldRange, 1> field_ranges<aero::ControlSurface>{{{"hinge_frac", 0, 0.99}}};
template <>
inline constexpr std::array<FieldRange, 4> field_ranges<aero::LiftingSurface>{
    {{"chordwise", 1, 40}, {"spanwise", 1, 200}, {"incidence_rad", -0.8, 0.8}, {"mass_kg", 0, 1e6}}};
template <>
inline constexpr std::array<FieldRange, 5> field_ranges<aero::Body>{{{"length_m", 1e-3, 1e3},
                                                                     {"width_m", 1e-3, 1e3},
                                                                     {"height_m", 1e-3, 1e3},
                                                                     {"mass_kg", 0, 1e6},
                                                                     {"drag_area_m2", 0, 1e3}}};
template <>
inline constexpr std::array<FieldRange, 4> field_ranges<aero::MassPart>{
    {{"mass_kg", 0, 1e6}, {"length_m", 0, 1e3}, {"width_m", 0, 1e3}, {"height_m", 0, 1e3}}};
template <>
inline constexpr std::array<FieldRange, 2> field_ranges<aero::PropellerPart>{
    {{"blades", 1, 12}, {"blade_chord_m", 1e-4, 10}}};
template <>
inline constexpr std::array<FieldRange, 3> field_ranges<aero::ReferenceQuantities>{
    {{"area_m2", 1e-4, 1e4}, {"span_m", 1e-2, 1e3}, {"chord_m", 1e-3, 1e2}}};
template <>
inline constexpr std::array<FieldRange, 2> field_ranges<aero::Geometry>{
    {{"altitude_m", -1000, 20000}, {"oswald_ratio", 0, 1.5}}};

}  // namespace fulmar

// SPDX-License-Identifier: BSD-3-Clause
// The messages of this folder: code, arguments, sentence (fulmar/diagnostic.hpp).
#pragma once
#include "fulmar/diagnostic.hpp"

namespace fulmar::aero_messages {

inline constexpr MessageText aileron_control_missing{
    "aero.aileron_control_missing",
    "surfaces: no control drives the aileron, which the aircraft requires for roll. Add a control with "
    "drives: aileron (or elevons) to a wing"};
inline constexpr MessageText airfoil_missing{"aero.airfoil_missing",
                                             {"airfoil"},
                                             "an XFLR5 file has no shape of the airfoil '{airfoil}'. Add an "
                                             "airfoil of this name to `airfoils` of the geometry file"};
inline constexpr MessageText airfoil_not_readable{
    "aero.airfoil_not_readable",
    "the airfoil file is missing, or not readable. Correct the name after AFILE, which is relative to the "
    "folder of the .avl file, or add the file"};
inline constexpr MessageText airfoil_order_invalid{
    "aero.airfoil_order_invalid",
    "the points must go from the trailing edge over the top to the nose, and below back to the trailing "
    "edge. Sort them; at least 10 are required"};
inline constexpr MessageText airfoil_pair_unsupported{
    "aero.airfoil_pair_unsupported",
    "a section with two airfoils is not supported. Give Left_Side_FoilName and Right_Side_FoilName the same "
    "airfoil"};
inline constexpr MessageText airfoil_point_invalid{
    "aero.airfoil_point_invalid",
    {"file", "line", "found"},
    "{file}:{line}: '{found}' is not a point; expected x and z for a chord of 1, as in 0.25 0.06"};
inline constexpr MessageText airfoil_shape_invalid{
    "aero.airfoil_shape_invalid",
    {"airfoil", "count"},
    "'{airfoil}' has {count} shapes; give exactly one of naca (four digits), alpha_zero and camber_x_frac "
    "with camber_z_frac"};
inline constexpr MessageText airfoil_unknown{
    "aero.airfoil_unknown", {"airfoil", "choices"}, "the airfoil '{airfoil}' does not exist.{choices}"};
inline constexpr MessageText alpha_zero_out_of_range{
    "aero.alpha_zero_out_of_range", {"found"}, "{found} rad is outside -0.35 .. 0.35 rad"};
inline constexpr MessageText asymmetric_wing_unsupported{
    "aero.asymmetric_wing_unsupported",
    "a wing on one side only is not supported; set its <Symetric> to true"};
inline constexpr MessageText avl_header_incomplete{
    "aero.avl_header_incomplete",
    "the file has fewer than the six header lines of an AVL geometry: name, Mach, iYsym, Sref, Xref, CDp. "
    "Complete it, or give another file"};
inline constexpr MessageText bracket_not_closed{"aero.bracket_not_closed",
                                                "'<' has no '>'; add it, or complete the file"};
inline constexpr MessageText camber_count_mismatch{
    "aero.camber_count_mismatch",
    {"places", "heights"},
    "camber_x_frac has {places} places and camber_z_frac {heights} heights; the counts must be equal and at "
    "least 2"};
inline constexpr MessageText chord_not_positive{
    "aero.chord_not_positive",
    {"found"},
    "the <Chord> of the section is {found} m; expected a length above 0"};
inline constexpr MessageText control_gain_unsupported{
    "aero.control_gain_unsupported",
    {"control", "gain"},
    "CONTROL {control}: the gain {gain} is not supported; valid: 1, -1"};
inline constexpr MessageText control_hinge_unsupported{
    "aero.control_hinge_unsupported",
    {"control", "hinge"},
    "CONTROL {control}: the hinge at {hinge} of the chord is not supported; valid: above 0 and below 1"};
inline constexpr MessageText control_incomplete{
    "aero.control_incomplete", "CONTROL: expected name, gain, Xhinge, three numbers of the hinge and SgnDup"};
inline constexpr MessageText control_mirror_missing{
    "aero.control_mirror_missing",
    {"surface"},
    "this control requires a surface on each side, and '{surface}' has one. Set mirror: true for "
    "'{surface}', or choose another drives"};
inline constexpr MessageText control_name_unknown{
    "aero.control_name_unknown",
    {"control"},
    "CONTROL '{control}': the name does not identify the control surface. Begin it with one of these: "
    "aileron, elevator, rudder, flap, elevon"};
inline constexpr MessageText control_not_converged{
    "aero.control_not_converged",
    {"derivative", "found", "full"},
    "not converged: with a sixth of the panels {derivative} is {found} instead of {full}; give its surface "
    "more panels along the chord and the span"};
inline constexpr MessageText control_outside_surface{
    "aero.control_outside_surface",
    {"begin", "end", "surface", "length"},
    "from {begin} to {end} is outside its surface '{surface}'; valid: 0 m to {length}"};
inline constexpr MessageText control_reversed{
    "aero.control_reversed",
    {"end", "begin"},
    "the control ends at {end} and begins at {begin}; set to above from"};
inline constexpr MessageText control_section_single{"aero.control_section_single",
                                                    {"control"},
                                                    "CONTROL '{control}' is at this section alone. Repeat "
                                                    "the line at the next section, where the control ends"};
inline constexpr MessageText controls_misplaced{"aero.controls_misplaced",
                                                "controls: this key requires a planform file. Without one, "
                                                "move each control to `controls` of its surface"};
inline constexpr MessageText controls_overlap{
    "aero.controls_overlap",
    {"begin", "end", "index", "other_begin", "other_end", "surface"},
    "from {begin} to {end} overlaps controls[{index}], which is from {other_begin} to {other_end} of "
    "'{surface}'. Change from or to of one of the two"};
inline constexpr MessageText cruise_condition_unsuitable{
    "aero.cruise_condition_unsuitable",
    ". Increase airspeed_cruise or the area of the wing, or reduce the mass"};
inline constexpr MessageText cruise_lift_unreachable{
    "aero.cruise_lift_unreachable",
    {"airspeed", "mass", "lift_coefficient", "hint"},
    "limits.airspeed_cruise: at {airspeed} m/s level flight of {mass} kg requires CL {lift_coefficient}. "
    "These surfaces reach it at no angle within 25 deg{hint}"};
inline constexpr MessageText duplicate_plane_unsupported{
    "aero.duplicate_plane_unsupported", "YDUPLICATE: a plane other than y = 0 is not supported; set it to 0"};
inline constexpr MessageText element_missing{
    "aero.element_missing", {"parent", "element"}, "<{parent}> has no <{element}>; add it"};
inline constexpr MessageText element_numbers_invalid{"aero.element_numbers_invalid",
                                                     {"element", "found", "count", "noun"},
                                                     "<{element}>: expected {count}{noun}; found '{found}'"};
inline constexpr MessageText elevator_control_missing{
    "aero.elevator_control_missing",
    "surfaces: no control drives the elevator, which the aircraft requires for trim. Add a control with "
    "drives: elevator (or elevons, v_tail)"};
inline constexpr MessageText elevator_leading_up{
    "aero.elevator_leading_up", "elevator: positive is trailing edge up, which takes the nose down here"};
inline constexpr MessageText flow_not_solvable{
    "aero.flow_not_solvable",
    "surfaces: the flow about these panels has no solution, because two panels may coincide. Move one of two "
    "surfaces in the same place"};
inline constexpr MessageText geometry_incomplete{
    "aero.geometry_incomplete", {"missing"}, "the geometry is incomplete; add the missing: {missing}"};
inline constexpr MessageText geometry_map_expected{
    "aero.geometry_map_expected",
    {"found"},
    "expected a map with the keys of a geometry, such as surfaces and reference; found {found}"};
inline constexpr MessageText keyword_value_missing{
    "aero.keyword_value_missing", {"keyword"}, "the file ends after {keyword}; add the line with its values"};
inline constexpr MessageText lattice_not_converged{
    "aero.lattice_not_converged",
    {"lift_slope", "full_lift_slope", "margin", "full_margin"},
    "not converged: with a sixth of the panels CL_alpha is {lift_slope} instead of {full_lift_slope} and the "
    "static margin {margin} instead of {full_margin}. Give more panels, or move a tail away from the height "
    "at which the wing's wake meets it"};
inline constexpr MessageText lift_not_of_wings{
    "aero.lift_not_of_wings",
    {"lift_slope", "lift"},
    "; their lift is not that of wings (CL_alpha {lift_slope}, CL {lift} at 25 deg), because a vortex passes "
    "a control point of another surface. Make winglets sections of their wing, move a tail out of the wing's "
    "wake, or change `spanwise`"};
inline constexpr MessageText lift_slope_unsupported{
    "aero.lift_slope_unsupported",
    "CLAF: a lift slope other than that of a flat plate is not supported; valid: 1"};
inline constexpr MessageText line_outside_surface{
    "aero.line_outside_surface",
    {"found"},
    "'{found}' is outside a SURFACE; add a SURFACE before it, or remove it"};
inline constexpr MessageText mass_missing{
    "aero.mass_missing", "the total mass is not above 0; give surfaces, bodies or masses a mass"};
inline constexpr MessageText naca_digits_invalid{
    "aero.naca_digits_invalid",
    {"found"},
    "NACA '{found}' is not supported; expected four digits, as in 2412"};
inline constexpr MessageText name_repeated{
    "aero.name_repeated", {"name"}, "the name '{name}' exists twice; rename one of the two"};
inline constexpr MessageText plane_body_unsupported{
    "aero.plane_body_unsupported",
    "the body of the plane is not supported; describe it in `bodies` of the geometry file"};
inline constexpr MessageText plane_element_open{
    "aero.plane_element_open",
    {"element", "line"},
    "<{element}> of line {line} does not end; add </{element}>, or complete the file"};
inline constexpr MessageText plane_missing{
    "aero.plane_missing",
    "the file has no <explane> with a <Plane>: XFLR5 exports it as `Export plane to xml`"};
inline constexpr MessageText plane_nesting_excessive{
    "aero.plane_nesting_excessive",
    "the elements are nested deeper than 20 levels; an end tag may be missing. Close the outer elements"};
inline constexpr MessageText planform_format_unsupported{
    "aero.planform_format_unsupported", "the format is not supported. Valid: AVL's .avl, XFLR5's .xml"};
inline constexpr MessageText planform_keyword_unsupported{
    "aero.planform_keyword_unsupported",
    {"found"},
    "'{found}' is not supported here; valid: SURFACE, YDUPLICATE, ANGLE, TRANSLATE, SCALE, COMPONENT, "
    "SECTION, NACA, AFILE, CLAF, CDCL, CONTROL"};
inline constexpr MessageText planform_missing{"aero.planform_missing",
                                              {"planform"},
                                              "planform: the file '{planform}' does not exist. Correct the "
                                              "path, which is relative to the folder of this geometry file"};
inline constexpr MessageText planform_numbers_missing{
    "aero.planform_numbers_missing",
    {"found", "count", "names"},
    "'{found}': expected at least {count} numbers: {names}"};
inline constexpr MessageText planform_truncated{
    "aero.planform_truncated", {"expected"}, "the file ends before {expected}; add this line"};
inline constexpr MessageText point_mass_unplaced{"aero.point_mass_unplaced",
                                                 "<Point_Mass> has no <coordinates>; add them as x, y, z"};
inline constexpr MessageText propeller_thrust_missing{
    "aero.propeller_thrust_missing",
    "propellers: propulsion.ct0 is missing or not above 0. Set it to the static thrust coefficient; the "
    "propeller speed follows from it"};
inline constexpr MessageText reference_area_mismatch{
    "aero.reference_area_mismatch",
    {"reference", "surface"},
    "reference.area: {reference} m^2, but the largest surface has {surface} m^2, both halves. Correct one of "
    "the two"};
inline constexpr MessageText reference_chord_mismatch{
    "aero.reference_chord_mismatch",
    {"reference", "ratio"},
    "reference.chord: {reference}, but area over span is {ratio}. Correct chord, area or span"};
inline constexpr MessageText reference_missing{
    "aero.reference_missing", "reference: the key is missing; add it with area, span and chord"};
inline constexpr MessageText reference_span_mismatch{
    "aero.reference_span_mismatch",
    {"reference", "surfaces"},
    "reference.span: {reference}, but the surfaces span {surfaces}. Correct one of the two"};
inline constexpr MessageText rudder_leading_right{
    "aero.rudder_leading_right", "rudder: positive is trailing edge right, which takes the nose left here"};
inline constexpr MessageText section_chord_invalid{
    "aero.section_chord_invalid", {"chord"}, "SECTION: the chord is {chord}; expected a value above 0"};
inline constexpr MessageText section_on_left{
    "aero.section_on_left",
    {"y"},
    "{y} is on the left; a surface with mirror gives its right half. Set y to 0 or more, or remove mirror"};
inline constexpr MessageText section_repeated{
    "aero.section_repeated", "the section has the same y and z as the section before it; move or remove it"};
inline constexpr MessageText sections_crossing{
    "aero.sections_crossing",
    {"previous", "next"},
    "this section goes back from y = {previous} to {next}. Sort the sections from the root to the tip"};
inline constexpr MessageText sections_too_few{
    "aero.sections_too_few",
    {"surface", "count"},
    "the surface '{surface}' has {count} sections; at least 2 are required, at the root and at the tip"};
inline constexpr MessageText servo_reversal_needed{"aero.servo_reversal_needed", "reverse the servo, too"};
inline constexpr MessageText surface_flat{"aero.surface_flat",
                                          {"surface"},
                                          "'{surface}' is flat, where rudder and v_tail have no effect. Move "
                                          "this control to an upright or inclined surface"};
inline constexpr MessageText surface_name_missing{
    "aero.surface_name_missing", "SURFACE: the file ends before the name; add it on the next line"};
inline constexpr MessageText surface_unknown{
    "aero.surface_unknown",
    {"place", "surface", "choices"},
    "{place}.surface: the surface {surface} does not exist.{choices}"};
inline constexpr MessageText surface_upright{"aero.surface_upright",
                                             {"surface"},
                                             "'{surface}' is upright, where only a rudder has an effect. Set "
                                             "drives: rudder, or move this control to another surface"};
inline constexpr MessageText surfaces_and_planform{
    "aero.surfaces_and_planform",
    "planform: the geometry gives surfaces as well; remove planform or surfaces"};
inline constexpr MessageText surfaces_missing{
    "aero.surfaces_missing", "surfaces: the key is missing; add it, or a planform as in planform: wing.avl"};
inline constexpr MessageText symmetric_fin_unsupported{
    "aero.symmetric_fin_unsupported",
    "a fin that extends up and down is not supported; replace it by two fins"};
inline constexpr MessageText symmetry_plane_unsupported{
    "aero.symmetry_plane_unsupported",
    "planes of symmetry are not supported. Set iYsym and iZsym to 0, and add YDUPLICATE 0 to each surface "
    "that represents one half only"};
inline constexpr MessageText too_many_airfoils{
    "aero.too_many_airfoils", "the planform has more than 16 airfoils. Use one airfoil for several sections"};
inline constexpr MessageText too_many_control_parts{
    "aero.too_many_control_parts",
    "the surface has more than 16 parts of controls (a part is between two sections). Remove sections within "
    "controls"};
inline constexpr MessageText too_many_controls{
    "aero.too_many_controls", "the surface has more than 16 controls. Merge or remove controls"};
inline constexpr MessageText too_many_masses{"aero.too_many_masses",
                                             "the planform has more than 64 masses. Merge or remove masses"};
inline constexpr MessageText too_many_panels{
    "aero.too_many_panels",
    {"count", "surface", "own", "limit"},
    "surfaces: the surfaces have {count} panels; valid: at most {limit}. Reduce chordwise or spanwise, first "
    "of '{surface}', which has {own} (both halves)"};
inline constexpr MessageText too_many_sections{
    "aero.too_many_sections", "the surface has more than 32 sections. Remove sections, or split the surface"};
inline constexpr MessageText too_many_surfaces{
    "aero.too_many_surfaces", "the planform has more than 16 surfaces. Merge or remove surfaces"};
inline constexpr MessageText wing_missing{"aero.wing_missing", "surfaces: the list is empty; add a wing"};
inline constexpr MessageText wing_sections_missing{"aero.wing_sections_missing",
                                                   "the wing has no <Sections>; add at least two sections"};

}  // namespace fulmar::aero_messages

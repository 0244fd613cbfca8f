// SPDX-License-Identifier: BSD-3-Clause
// The messages of this folder: code, arguments, sentence (fulmar/diagnostic.hpp).
#pragma once
#include "fulmar/diagnostic.hpp"

namespace fulmar::aero_messages {

inline constexpr MessageText aerodynamics_element_unsupported{
    "aero.aerodynamics_element_unsupported",
    {"element"},
    "<{element}> in <aerodynamics> is not supported. Remove it, or move its functions into an <axis>"};
inline constexpr MessageText aircraft_duplicate{
    "aero.aircraft_duplicate",
    {"first_file"},
    "the file holds a second aircraft; the first one is in {first_file}. Give the folder of one aircraft, or "
    "remove one of the two files"};
inline constexpr MessageText aircraft_not_mergeable{
    "aero.aircraft_not_mergeable",
    "the file holds a whole aircraft and cannot be merged with other files; give this file alone"};
inline constexpr MessageText analysis_chosen{
    "aero.analysis_chosen",
    {"count", "alpha", "criterion"},
    "the file has {count} analyses; the one at alpha {alpha} is used, nearest to {criterion}"};
inline constexpr MessageText analysis_not_converged{
    "aero.analysis_not_converged",
    {"coefficient", "found"},
    "{coefficient} is {found}, and a symmetric aircraft has 0: the analysis has not converged. Repeat it "
    "with more iterations or a smaller tolerance"};
inline constexpr MessageText autopilot_node_renamed{
    "aero.autopilot_node_renamed",
    "ROSplane 2.0 has no node 'autopilot': it ignores these gains and flies its defaults. Rename the key to "
    "'controller'"};
inline constexpr MessageText avl_derivatives_missing{
    "aero.avl_derivatives_missing",
    "expected 'Stability-axis derivatives...' or 'Geometry-axis derivatives...' up to this line; found "
    "neither. Write the file again with ST or SB of AVL"};
inline constexpr MessageText avl_sideslip{
    "aero.avl_sideslip",
    {"found"},
    "Beta is {found} deg; expected 0. Run AVL again without sideslip, and write the file again"};
inline constexpr MessageText axis_element_unsupported{
    "aero.axis_element_unsupported",
    {"element"},
    "<{element}> in <axis> is not supported; valid: <function>. Remove it"};
inline constexpr MessageText axis_orientation_missing{
    "aero.axis_orientation_missing",
    "expected the line 'Standard axis orientation, X fwd, Z down' or 'Geometric axis orientation, X aft, Z "
    "up', which gives the signs; found neither. Write the file again with AVL"};
inline constexpr MessageText axis_unsupported{
    "aero.axis_unsupported",
    {"axis"},
    "<axis>: the name '{axis}' is not supported; valid: LIFT, DRAG, SIDE, ROLL, PITCH, YAW"};
inline constexpr MessageText cell_count_mismatch{
    "aero.cell_count_mismatch",
    {"expected", "found"},
    "the row has {found} cells, and its heading {expected}. Export the table again from OpenVSP, with "
    "decimal points instead of commas"};
inline constexpr MessageText child_element_missing{
    "aero.child_element_missing", {"parent", "element"}, "<{parent}> has no <{element}>; add it"};
inline constexpr MessageText column_missing{
    "aero.column_missing",
    {"column", "heading"},
    "the heading '{heading}' has no column '{column}'. Export the polar again with this column"};
inline constexpr MessageText control_column_swapped{
    "aero.control_column_swapped",
    {"moment"},
    ", and another moment is {moment}. Check that this column is the one of this control"};
inline constexpr MessageText control_derivatives_missing{
    "aero.control_derivatives_missing",
    "expected the derivatives by the controls ('name d1 ...') up to this line; found none. The file is "
    "incomplete; write it again with AVL"};
inline constexpr MessageText control_gain_zero{
    "aero.control_gain_zero",
    ". Set the gain of the control to a value other than 0, and run the analysis again"};
inline constexpr MessageText control_groups_mismatch{
    "aero.control_groups_mismatch",
    {"found", "first"},
    "this analysis has {found} groups of controls, and the first one of the file {first}. Keep only the "
    "analyses of one aircraft in the file"};
inline constexpr MessageText control_groups_missing{
    "aero.control_groups_missing",
    {"count"},
    "expected {count} groups of controls with four lines each (NumberOfControlGroups); found fewer up to "
    "this line. Write the file again with OpenVSP"};
inline constexpr MessageText control_ineffective{
    "aero.control_ineffective",
    {"coefficient", "found", "hint"},
    "the control has no effect: its {coefficient} is {found}{hint}"};
inline constexpr MessageText control_pair_incomplete{
    "aero.control_pair_incomplete",
    {"control"},
    "{control} pitches as much as it rolls or yaws, as one half of a pair does. In the analysis, add its "
    "mirror as a control, or name a group of both aileron, elevator or rudder"};
inline constexpr MessageText control_sign_turned{
    "aero.control_sign_turned",
    {"role", "control", "effect"},
    "{role}: the sign of {control} is turned as a whole; a positive deflection now {effect}"};
inline constexpr MessageText count_missing{
    "aero.count_missing",
    {"item"},
    "the file ends before the number of {item}; it is incomplete. Write it again with AVL"};
inline constexpr MessageText count_out_of_range{
    "aero.count_out_of_range",
    {"found"},
    "the count is {found}; expected a whole number from 0 to 100. Write the file again with AVL"};
inline constexpr MessageText decimal_comma{
    "aero.decimal_comma", {"found"}, "'{found}...' has a decimal comma; save the file with decimal points"};
inline constexpr MessageText density_unit_unknown{
    "aero.density_unit_unknown", {"unit"}, "Density: the unit '{unit}' is unknown; valid: kg/m3, slug/ft3"};
inline constexpr MessageText derivative_axes_unknown{
    "aero.derivative_axes_unknown",
    "the axes of Cld and Cnd are unknown for this version of AVL; body axes are assumed. Give the .sb file "
    "of AVL, too, with --controls-from"};
inline constexpr MessageText derivative_count_mismatch{
    "aero.derivative_count_mismatch",
    {"expected", "groups", "found"},
    "expected {expected} numbers (total, alpha, beta, p, q, r, Mach, U and {groups} groups of controls); "
    "found {found}. Run VSPAERO again to write the file"};
inline constexpr MessageText derivative_row_missing{
    "aero.derivative_row_missing",
    {"row"},
    "expected the row '{row}' of the derivatives up to this line; found none. Run VSPAERO again with its "
    "stability option (-stab)"};
inline constexpr MessageText derivative_table_missing{
    "aero.derivative_table_missing",
    "expected a table of derivatives ('Coef Total Alpha Beta p q r ...') up to this line; found none. Run "
    "VSPAERO again with -stab, not with -pstab, -qstab or -rstab"};
inline constexpr MessageText derivatives_differ{
    "aero.derivatives_differ",
    {"first", "other", "differences"},
    "{first} and {other} differ, and the first is used: {differences}"};
inline constexpr MessageText derivatives_missing{
    "aero.derivatives_missing",
    {"files"},
    "the files have no derivatives. Give one of these files, too: .st or .sb of AVL, stability log of XFLR5, "
    ".stab of VSPAERO{files}"};
inline constexpr MessageText document_end_missing{
    "aero.document_end_missing",
    {"end_tag"},
    "expected '{end_tag}' up to this line; found none. The file is incomplete; export it again from XFLR5"};
inline constexpr MessageText drag_table_missing{
    "aero.drag_table_missing",
    "expected a table with a column 'Cd' and a row 'Totals' up to this line; found none. Export the parasite "
    "drag again from OpenVSP"};
inline constexpr MessageText eigenvalue_difference_large{
    "aero.eigenvalue_difference_large",
    {"limit"},
    ", more than {limit} %: a value of the import is wrong; check units, mass and inertia"};
inline constexpr MessageText eigenvalue_form_invalid{
    "aero.eigenvalue_form_invalid",
    "Eigenvalue: expected 'real + imaginary i'; found a number without '+'. Export the log again from XFLR5"};
inline constexpr MessageText eigenvalue_row_invalid{
    "aero.eigenvalue_row_invalid",
    {"found"},
    "expected 'case real imaginary'; found '{found}'. Write the file again with AVL"};
inline constexpr MessageText element_nesting_excessive{
    "aero.element_nesting_excessive",
    "the elements are nested deeper than 50 levels; an end tag may be missing. Close the outer elements, or "
    "remove levels"};
inline constexpr MessageText element_not_closed{
    "aero.element_not_closed", {"element"}, "<{element}> has no end. Add </{element}>, or complete the file"};
inline constexpr MessageText element_unit_unknown{
    "aero.element_unit_unknown",
    {"element", "unit", "choices"},
    "<{element}>: the unit '{unit}' is unknown; valid: {choices}"};
inline constexpr MessageText encoding_unsupported{"aero.encoding_unsupported",
                                                  "the file is UTF-16; save it as UTF-8 or plain text"};
inline constexpr MessageText end_tag_missing{"aero.end_tag_missing",
                                             {"element"},
                                             "expected '</{element}>' up to this line; found none. The file "
                                             "is incomplete; export it again from XFLR5"};
inline constexpr MessageText entries_missing{
    "aero.entries_missing",
    {"count", "item"},
    "expected {count} {item}; the file ends before them. It is incomplete; write it again with AVL"};
inline constexpr MessageText file_duplicate{"aero.file_duplicate", "the file is given twice; name it once"};
inline constexpr MessageText file_empty{"aero.file_empty",
                                        "the file is empty; write it again with the program that made it"};
inline constexpr MessageText format_unknown{
    "aero.format_unknown",
    {"file"},
    "{file}:1: the file format is unknown. Valid for AVL: .st .sb .mass .run .eig. Valid for XFLR5: "
    "stability log, plane polar, plane or polar XML. Valid for VSPAERO: .stab .polar .flt .history .vspaero, "
    "mass properties, parasite drag, results as CSV. Valid alone, as a whole aircraft: ROSflight "
    "(..._dynamics.yaml), JSBSim (XML) or pyfly (JSON)"};
inline constexpr MessageText friction_missing{
    "aero.friction_missing",
    {"found", "assumed"},
    "the analysis is without friction: CD - CL^2/(pi e AR) is {found}. CD_p {assumed} is assumed; small "
    "aircraft have 0.02 to 0.05. Set --parasite-drag, or give a polar with friction"};
inline constexpr MessageText friction_small{
    "aero.friction_small",
    {"found", "source"},
    "CD_p is {found} ({source}), less than the friction of a smooth plate: the analysis has too little "
    "induced drag for this span; the mesh may be coarse. Set --parasite-drag, or give a polar"};
inline constexpr MessageText function_factor_unsupported{
    "aero.function_factor_unsupported",
    {"found"},
    "{found} is not supported; expected one <product> of a <value>, aero/qbar-psf, metrics/Sw-sqft, "
    "metrics/bw-ft or cbarw-ft, aero/bi2vel or ci2vel, and a state or a <table>"};
inline constexpr MessageText function_factors_invalid{
    "aero.function_factors_invalid",
    "the product requires aero/qbar-psf and metrics/Sw-sqft once each. Moments also require one of "
    "metrics/bw-ft and cbarw-ft; rates require one of aero/bi2vel and ci2vel"};
inline constexpr MessageText function_product_unsupported{
    "aero.function_product_unsupported",
    "the product has more than one state or table. Keep one of them, or write one table over both states"};
inline constexpr MessageText gain_count_mismatch{
    "aero.gain_count_mismatch",
    {"expected", "surfaces", "found"},
    "expected {expected} gains, one for each surface of '{surfaces}'; found {found}. Correct this line"};
inline constexpr MessageText gain_sign_reversed{
    "aero.gain_sign_reversed",
    {"gain", "found", "used"},
    "{gain} is {found}: the sign is that of a surface with the other sense. Fulmar's gains are positive; "
    "{used} rad is used"};
inline constexpr MessageText gain_undeclared{
    "aero.gain_undeclared",
    {"gain"},
    "no node of ROSplane 2.0 declares {gain}, so ROSplane ignores it; remove it"};
inline constexpr MessageText gains_duplicate{
    "aero.gains_duplicate",
    {"first_file"},
    "the file holds a second set of gains; the first one is in {first_file}. Give the folder of one "
    "aircraft, or remove one of the two files"};
inline constexpr MessageText heading_alpha_missing{
    "aero.heading_alpha_missing",
    "expected 'AoA_' in the heading of this analysis; found none. Run VSPAERO again to write the file"};
inline constexpr MessageText heading_key_missing{
    "aero.heading_key_missing",
    {"key"},
    "expected '{key}' in the heading of this analysis; found none. Run VSPAERO again to write the file"};
inline constexpr MessageText heading_number_expected{
    "aero.heading_number_expected",
    "expected a number behind this name; found none. Run VSPAERO again to write the file"};
inline constexpr MessageText heading_number_missing{
    "aero.heading_number_missing",
    {"key"},
    "expected '{key} number' in the heading of this analysis; found none. Run VSPAERO again to write the "
    "file"};
inline constexpr MessageText heading_reference_missing{
    "aero.heading_reference_missing",
    "expected 'Sref_', 'Cref_' and 'Bref_' in a heading; found none. Run VSPAERO again to write the file"};
inline constexpr MessageText inertia_not_positive{"aero.inertia_not_positive",
                                                  "xx, yy and zz must be above 0"};
inline constexpr MessageText inertia_values_expected{
    "aero.inertia_values_expected",
    {"found"},
    "expected 3 or 4 numbers, xx yy zz [xz] in kg m^2; found {found}"};
inline constexpr MessageText input_is_folder{"aero.input_is_folder",
                                             "the path is a folder; give the files in it"};
inline constexpr MessageText json_invalid{
    "aero.json_invalid", "the text is not valid JSON from this line on. Correct it, or save the file again"};
inline constexpr MessageText json_object_expected{
    "aero.json_object_expected",
    "expected a JSON object with the coefficients of pyfly (S_wing, b, c, mass, ...); found another value"};
inline constexpr MessageText key_missing{"aero.key_missing", {"key"}, "the file has no key '{key}'; add it"};
inline constexpr MessageText labelled_line_missing{
    "aero.labelled_line_missing",
    {"label"},
    "expected a line '{label}' up to this line; found none. Export the mass properties again from OpenVSP"};
inline constexpr MessageText labelled_number_missing{
    "aero.labelled_number_missing",
    {"key"},
    "expected '{key} number' up to this line; found none. Run VSPAERO again to write the file"};
inline constexpr MessageText lateral_derivatives_uncertain{
    "aero.lateral_derivatives_uncertain",
    "Cl_beta, Cn_p, Cn_da and CY_p of XFLR5 are uncertain by a factor of 2; prefer those of another tool"};
inline constexpr MessageText lift_at_start_alpha{
    "aero.lift_at_start_alpha",
    {"value", "alpha", "corrected"},
    "C_L_O {value} is CL at the {alpha} deg of the heading, not at 0 deg, where it would be {corrected}; the "
    "value is kept"};
inline constexpr MessageText lift_squared_invalid{"aero.lift_squared_invalid",
                                                  "aero/cl-squared is valid once, in drag, with a positive "
                                                  "factor. Remove this function, or correct its factor"};
inline constexpr MessageText line_end{"aero.line_end", "the end of the line"};
inline constexpr MessageText location_unit_unknown{
    "aero.location_unit_unknown", {"unit"}, "<location>: the unit '{unit}' is unknown; valid: FT, IN, M"};
inline constexpr MessageText log_airspeed_not_positive{
    "aero.log_airspeed_not_positive",
    {"found"},
    "VInf is {found} m/s; expected a value above 0. Repeat the stability analysis in XFLR5"};
inline constexpr MessageText log_chord_unknown{
    "aero.log_chord_unknown",
    "Cma is 0, so the mean chord cannot be computed from Mw and Cma. Move the centre of gravity in XFLR5, "
    "and repeat the stability analysis"};
inline constexpr MessageText log_control_missing{
    "aero.log_control_missing",
    "expected 'Control derivatives' or the modes up to this line; found neither. The log is incomplete; "
    "export it again from XFLR5"};
inline constexpr MessageText log_reference_not_positive{
    "aero.log_reference_not_positive",
    {"density", "area", "span"},
    "Density {density} kg/m3, Reference Area {area} m2 and Reference length {span} m must be above 0. "
    "Correct the plane or the analysis in XFLR5"};
inline constexpr MessageText log_type_mismatch{
    "aero.log_type_mismatch",
    {"found"},
    "the log is of '{found}'. Give the log of a stability analysis of XFLR5, 'Type 7 - Stability polar'"};
inline constexpr MessageText log_unit_unknown{
    "aero.log_unit_unknown",
    {"unit"},
    "the unit '{unit}' is unknown. Set the units of XFLR5 to m, kg and m/s, and export the log again"};
inline constexpr MessageText log_value_missing{
    "aero.log_value_missing",
    {"key"},
    "expected '{key} = number' up to this line; found none. Export the log again from XFLR5"};
inline constexpr MessageText longitudinal_derivatives_missing{
    "aero.longitudinal_derivatives_missing",
    "expected 'Longitudinal derivatives' up to this line; found none. The log is incomplete; export it again "
    "from XFLR5"};
inline constexpr MessageText markup_not_closed{
    "aero.markup_not_closed",
    {"opening"},
    "'{opening}' has no end in the rest of the file. Close it, or complete the file"};
inline constexpr MessageText mass_file_unit_unknown{
    "aero.mass_file_unit_unknown", {"unit", "choices"}, "the unit '{unit}' is unknown; {choices}"};
inline constexpr MessageText mass_row_incomplete{
    "aero.mass_row_incomplete",
    {"count"},
    "the row has {count} numbers; expected at least 4 of 'mass x y z [Ixx Iyy Izz Ixy Ixz Iyz]'"};
inline constexpr MessageText mass_rows_missing{
    "aero.mass_rows_missing",
    "expected rows 'mass x y z Ixx Iyy Izz' up to this line; found none. Add a row for each part"};
inline constexpr MessageText mass_sum_not_positive{
    "aero.mass_sum_not_positive",
    {"mass"},
    "the sum of the masses is {mass}; expected a value above 0. Correct the first number of the rows"};
inline constexpr MessageText moment_reference_beside{
    "aero.moment_reference_beside",
    "the places AERORP and CG have different y; the roll and yaw moments of this offset are left out. Give "
    "both the same y"};
inline constexpr MessageText moment_reference_missing{
    "aero.moment_reference_missing",
    {"element"},
    "the file has no <location> {element}; the centre of gravity is assumed as the reference of the moments"};
inline constexpr MessageText moments_moved{
    "aero.moments_moved",
    {"aft", "up"},
    "moments are moved from AERORP to the centre of gravity: forces act {aft} m behind and {up} m above it"};
inline constexpr MessageText number_expected{
    "aero.number_expected", {"found"}, "expected a number; found {found}"};
inline constexpr MessageText number_not_finite{"aero.number_not_finite",
                                               "the value is inf or nan; a finite number is required"};
inline constexpr MessageText option_not_positive{
    "aero.option_not_positive", {"found"}, "'{found}' is not above 0"};
inline constexpr MessageText pair_missing{"aero.pair_missing",
                                          {"key", "program"},
                                          "expected '{key} = number' up to this line; found none. The file "
                                          "is cut, or of another version of {program}. Write it again with "
                                          "{program}"};
inline constexpr MessageText parameter_node_unknown{
    "aero.parameter_node_unknown",
    {"node"},
    "the parameters are those of the node '{node}', which rosflight_sim does not have; valid: "
    "/fixedwing_forces_and_moments, /**"};
inline constexpr MessageText point_mass_incomplete{
    "aero.point_mass_incomplete", "<Point_Mass> requires <Mass> and <coordinates>; add the missing one"};
inline constexpr MessageText polar_heading_missing{
    "aero.polar_heading_missing",
    "expected a heading 'alpha Beta CL CDi CDv CD ...' up to this line; found none. Export the polar of the "
    "plane again from XFLR5"};
inline constexpr MessageText polar_of_airfoil{
    "aero.polar_of_airfoil",
    "the polar is that of an airfoil, not of an aircraft; give the polar of the plane"};
inline constexpr MessageText positive_value_expected{
    "aero.positive_value_expected", {"found"}, "the value is {found}; expected a value above 0"};
inline constexpr MessageText reference_mismatch{
    "aero.reference_mismatch",
    {"quantity", "found", "unit", "source", "first_value", "first_unit", "first_file"},
    "the {quantity} is {found}{unit} ({source}), but {first_value}{first_unit} in {first_file}. Give files "
    "of one aircraft, with one unit of length"};
inline constexpr MessageText reference_moved{"aero.reference_moved",
                                             {"aft", "up"},
                                             "moments and rates are moved from the reference point to the "
                                             "centre of gravity, {aft} m aft and {up} m up"};
inline constexpr MessageText reference_moved_far{
    "aero.reference_moved_far",
    {"aft", "up", "ratio"},
    "moments and rates are moved from the reference point to the centre of gravity, {aft} m aft and {up} m "
    "up, {ratio} of the chord. Check the unit of length of the files and their origin"};
inline constexpr MessageText result_count_mismatch{
    "aero.result_count_mismatch",
    {"expected", "found"},
    "expected {expected} numbers; found {found}. Numbers require decimal points, not commas"};
inline constexpr MessageText result_name_missing{
    "aero.result_name_missing",
    "Results_Name: the second cell, the name of the result, is empty. Export the results again from OpenVSP"};
inline constexpr MessageText result_number_expected{
    "aero.result_number_expected", {"found"}, "expected a number; found '{found}'"};
inline constexpr MessageText result_row_missing{
    "aero.result_row_missing",
    {"key", "result"},
    "expected '{key},number' of {result} up to this line; found none. Export the results again from OpenVSP"};
inline constexpr MessageText result_sideslip{
    "aero.result_sideslip",
    {"key"},
    "{key} is not 0: this analysis has a sideslip. Run VSPAERO again with {key} 0"};
inline constexpr MessageText results_missing{"aero.results_missing",
                                             {"found"},
                                             "the file has none of Parasite_Drag, Mass_Properties and "
                                             "VSPAERO_Stab; it has {found}. Export one of the three"};
inline constexpr MessageText results_unused{
    "aero.results_unused", {"results"}, "results that are not used: {results}"};
inline constexpr MessageText rosflight_file_missing{
    "aero.rosflight_file_missing",
    "the folder has no ROSflight file with wing_s, C_L_alpha, ... Copy the file ..._dynamics.yaml of the "
    "aircraft into it"};
inline constexpr MessageText rosplane_folder_expected{
    "aero.rosplane_folder_expected",
    "the path is not a folder; give the folder with the parameter files of ROSplane or ROSflight"};
inline constexpr MessageText row_incomplete{"aero.row_incomplete",
                                            {"expected", "found"},
                                            "expected {expected} numbers, as many as the heading has names; "
                                            "found {found}. The file is incomplete; export the polar again"};
inline constexpr MessageText rows_missing{"aero.rows_missing",
                                          "expected rows of numbers below this heading; found none. Export "
                                          "the polar again with at least one converged point"};
inline constexpr MessageText run_unit_unknown{"aero.run_unit_unknown",
                                              {"unit"},
                                              "the unit '{unit}' is unknown. Load a .mass file with Lunit, "
                                              "Munit and Tunit in AVL, and save the run case again"};
inline constexpr MessageText sign_doubted{
    "aero.sign_doubted", {"comment"}, "the author doubts the value: '{comment}'"};
inline constexpr MessageText straight_analysis_missing{
    "aero.straight_analysis_missing",
    "all analyses of the file have a sideslip. Run VSPAERO again with Beta 0"};
inline constexpr MessageText sweep_heading_missing{"aero.sweep_heading_missing",
                                                   "expected a heading 'Beta Mach AoA ...' up to this line; "
                                                   "found none. Run VSPAERO again to write the file"};
inline constexpr MessageText table_axis_unsupported{
    "aero.table_axis_unsupported",
    {"property", "choices"},
    "a table over '{property}' is not supported; valid: {choices}"};
inline constexpr MessageText table_element_unsupported{
    "aero.table_element_unsupported",
    {"element"},
    "<{element}> in a table is not supported; valid: <independentVar>, <tableData>. Remove it"};
inline constexpr MessageText table_empty{
    "aero.table_empty", "the table has no values; write one row for each point, or remove the table"};
inline constexpr MessageText table_points_not_increasing{
    "aero.table_points_not_increasing",
    {"previous", "next"},
    "the points of the table do not increase: {next} follows {previous}. Sort its rows and columns by their "
    "points"};
inline constexpr MessageText table_row_invalid{
    "aero.table_row_invalid",
    {"expected", "found"},
    "expected {expected} in this row of the table; found '{found}'"};
inline constexpr MessageText table_states_unsupported{
    "aero.table_states_unsupported",
    "a table over three variables is not supported; give a table over one or two"};
inline constexpr MessageText table_too_large{
    "aero.table_too_large",
    {"rows", "columns"},
    "the table has {rows} by {columns} points; valid: at most 32 by 16 points and 256 values. Remove points"};
inline constexpr MessageText table_variable_missing{
    "aero.table_variable_missing",
    "the table does not name its variable; add <independentVar>PROPERTY</independentVar> before its values"};
inline constexpr MessageText tag_not_closed{
    "aero.tag_not_closed", "the tag that begins here has no '>'. Close it, or complete the file"};
inline constexpr MessageText text_expected{
    "aero.text_expected",
    "the file is not text. Binary projects (.xfl, .vsp3) are not supported; export text from them"};
inline constexpr MessageText three_numbers_expected{"aero.three_numbers_expected",
                                                    {"element", "found"},
                                                    "<{element}>: expected three numbers; found '{found}'"};
inline constexpr MessageText too_few_waypoints{
    "aero.too_few_waypoints", "the mission has fewer than two waypoints; add waypoints under wp"};
inline constexpr MessageText too_many_files{
    "aero.too_many_files", "the folder has more than 500 YAML files; give the folder of one aircraft"};
inline constexpr MessageText too_many_moment_tables{
    "aero.too_many_moment_tables",
    {"count"},
    "AERORP and CG differ, so each force table also makes moment tables: {count} tables in total, at most 8 "
    "are valid. Remove tables of lift, drag or side force, or replace them by derivatives"};
inline constexpr MessageText too_many_tables{
    "aero.too_many_tables",
    "this is the ninth table; an airframe has at most 8. Remove a table, or replace one by a derivative"};
inline constexpr MessageText total_derivatives_missing{
    "aero.total_derivatives_missing",
    {"files"},
    "an airframe requires the total derivatives; write them with {files} of AVL and give that file"};
inline constexpr MessageText total_mass_not_positive{
    "aero.total_mass_not_positive",
    {"found"},
    "Total Mass is {found}; expected a value above 0. Give the parts a mass or a density in OpenVSP"};
inline constexpr MessageText trim_mismatch{
    "aero.trim_mismatch",
    {"alpha", "airspeed", "first_file", "first_alpha", "first_airspeed"},
    "the trim is {alpha} and {airspeed} m/s, but {first_file} has {first_alpha} and {first_airspeed} m/s. "
    "Give logs of one aircraft at one trim"};
inline constexpr MessageText trim_value_missing{
    "aero.trim_value_missing",
    {"key"},
    "expected '{key}= number' up to this line; found none. Export the log again from XFLR5"};
inline constexpr MessageText unnamed_control{"aero.unnamed_control", {"place"}, "the control of {place}"};
inline constexpr MessageText value_count_mismatch{
    "aero.value_count_mismatch",
    {"expected", "names", "found"},
    "expected {expected} numbers for '{names}'; found {found}. Write the file again with AVL"};
inline constexpr MessageText waypoint_position_invalid{
    "aero.waypoint_position_invalid",
    {"found"},
    "expected three numbers, as in w: [north, east, down]; found '{found}'"};
inline constexpr MessageText xflr5_trim_missing{
    "aero.xflr5_trim_missing",
    "XFLR5 found no angle without pitching moment, so the log has no derivatives. Give the aircraft a "
    "trimmed attitude (centre of gravity, tail setting) and run the stability analysis again"};

}  // namespace fulmar::aero_messages

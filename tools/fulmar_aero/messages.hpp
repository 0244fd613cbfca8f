// SPDX-License-Identifier: BSD-3-Clause
// The messages of this folder: code, arguments, sentence (fulmar/diagnostic.hpp).
#pragma once
#include "fulmar/diagnostic.hpp"

namespace fulmar::aero_messages {

inline constexpr MessageText adverse_yaw_high{
    "aero.adverse_yaw_high",
    {"value", "ratio"},
    "Cn_da is {value}, {ratio} of Cl_da: the adverse yaw is very high; aircraft have up to 0.15 of Cl_da"};
inline constexpr MessageText aerodynamics_element_unsupported{
    "aero.aerodynamics_element_unsupported",
    {"element"},
    "<aerodynamics>: <{element}> is not supported; expected only <axis>"};
inline constexpr MessageText aileron_control_missing{
    "aero.aileron_control_missing",
    "surfaces: no control drives the aileron; the aircraft requires one for roll"};
inline constexpr MessageText aileron_without_roll{
    "aero.aileron_without_roll", {"place"}, "the aileron gives no roll moment ({place})"};
inline constexpr MessageText aircraft_duplicate{
    "aero.aircraft_duplicate",
    {"first_file"},
    "the file holds a second aircraft in addition to {first_file}; expected the folder of one aircraft"};
inline constexpr MessageText aircraft_not_mergeable{
    "aero.aircraft_not_mergeable",
    "the file holds a whole aircraft and cannot be merged with other files; give it alone"};
inline constexpr MessageText airfoil_missing{
    "aero.airfoil_missing",
    {"airfoil"},
    "the airfoil '{airfoil}' is not in this file; give an airfoil of that name in the drawing"};
inline constexpr MessageText airfoil_not_readable{"aero.airfoil_not_readable",
                                                  "the airfoil's coordinates cannot be read"};
inline constexpr MessageText airfoil_order_invalid{
    "aero.airfoil_order_invalid",
    "the points do not go from the trailing edge over the top to the trailing edge"};
inline constexpr MessageText airfoil_pair_unsupported{"aero.airfoil_pair_unsupported",
                                                      "a section with two airfoils is not supported"};
inline constexpr MessageText airfoil_point_invalid{
    "aero.airfoil_point_invalid",
    {"file", "line", "found"},
    "{file}:{line}: '{found}' is not a point of a section of chord 1"};
inline constexpr MessageText airfoil_shape_invalid{
    "aero.airfoil_shape_invalid",
    {"airfoil", "count"},
    "'{airfoil}' has {count} shapes; give exactly one of naca (four digits), alpha_zero and camber_x_frac "
    "with camber_z_frac"};
inline constexpr MessageText airfoil_unknown{
    "aero.airfoil_unknown", {"airfoil", "choices"}, "the airfoil '{airfoil}' does not exist.{choices}"};
inline constexpr MessageText airframe_map_expected{
    "aero.airframe_map_expected", {"found"}, "expected a map with the fields of an airframe; found {found}"};
inline constexpr MessageText airspeed_out_of_range{
    "aero.airspeed_out_of_range", {"found"}, "'{found}' is outside 1 .. 200 m/s"};
inline constexpr MessageText airspeed_range_reversed{
    "aero.airspeed_range_reversed", {"found"}, "'{found}': the first speed is above the last one"};
inline constexpr MessageText airspeeds_not_increasing{
    "aero.airspeeds_not_increasing",
    {"minimum", "cruise", "maximum"},
    "the airspeeds {minimum}, {cruise} and {maximum} m/s do not increase from minimum to maximum"};
inline constexpr MessageText alpha_zero_out_of_range{
    "aero.alpha_zero_out_of_range", {"found"}, "{found} rad is outside -0.35 .. 0.35 rad"};
inline constexpr MessageText altitude_out_of_range{
    "aero.altitude_out_of_range", {"found"}, "'{found}' is outside -1000 .. 20000 m"};
inline constexpr MessageText analysis_chosen{
    "aero.analysis_chosen",
    {"count", "alpha", "criterion"},
    "the file has {count} analyses; the one at alpha {alpha} is used, nearest to {criterion}"};
inline constexpr MessageText analysis_not_converged{"aero.analysis_not_converged",
                                                    {"coefficient", "found"},
                                                    "{coefficient} is {found}, and a symmetric aircraft has "
                                                    "0: the analysis has not converged; tighten the solver"};
inline constexpr MessageText angle_in_degrees{
    "aero.angle_in_degrees", {"angle"}, ". The value may be in degrees; write '{angle} deg'"};
inline constexpr MessageText angle_too_large{
    "aero.angle_too_large", {"angle", "in_degrees", "hint"}, "the angle is {angle} rad, {in_degrees}{hint}"};
inline constexpr MessageText area_unit_suspect{"aero.area_unit_suspect", "The area may be in another unit"};
inline constexpr MessageText aspect_ratio_unusual{
    "aero.aspect_ratio_unusual",
    {"aspect_ratio"},
    "the aspect ratio b^2/S is {aspect_ratio}; wings have 2 to 40"};
inline constexpr MessageText asymmetric_wing_unsupported{"aero.asymmetric_wing_unsupported",
                                                         "a wing that is not symmetric is not supported"};
inline constexpr MessageText autopilot_node_renamed{
    "aero.autopilot_node_renamed",
    "the gains are those of the node 'autopilot', and the node is 'controller': ROSplane flies its defaults"};
inline constexpr MessageText avl_derivatives_missing{
    "aero.avl_derivatives_missing",
    "expected 'Stability-axis derivatives...' or 'Geometry-axis derivatives...'; found neither"};
inline constexpr MessageText avl_header_incomplete{
    "aero.avl_header_incomplete",
    "the file is not an AVL geometry: the header of an AVL geometry has six lines"};
inline constexpr MessageText avl_sideslip{"aero.avl_sideslip",
                                          "the analysis has a sideslip; expected Beta = 0"};
inline constexpr MessageText axis_element_unsupported{
    "aero.axis_element_unsupported",
    {"element"},
    "<axis>: <{element}> is not supported; expected <function>"};
inline constexpr MessageText axis_orientation_missing{
    "aero.axis_orientation_missing",
    "expected the line 'Standard axis orientation, X fwd, Z down' or 'Geometric axis orientation, X aft, Z "
    "up'. Without it the signs are unknown"};
inline constexpr MessageText axis_unsupported{
    "aero.axis_unsupported",
    {"axis"},
    "the axis '{axis}' is not supported; valid: LIFT, DRAG, SIDE, ROLL, PITCH, YAW"};
inline constexpr MessageText bandwidth_loop_unknown{
    "aero.bandwidth_loop_unknown",
    {"found", "choices"},
    "'{found}' does not begin with a loop, as in \"roll=8 rad/s\".{choices}"};
inline constexpr MessageText bandwidth_too_high{
    "aero.bandwidth_too_high",
    {"loop", "found", "actuator", "actuator_lag", "half_step", "delay", "lag", "limit", "place"},
    "{loop}: {found} rad/s is above the limit of the {actuator}. Its lag is {lag}: {actuator_lag}, half a "
    "step {half_step} and delay {delay}. This lag allows at most {limit} rad/s ({place})"};
inline constexpr MessageText bracket_not_closed{"aero.bracket_not_closed", "'<' has no '>'"};
inline constexpr MessageText braking_insufficient{
    "aero.braking_insufficient",
    {"required", "available", "place"},
    "the flight requires a braking force of {required} N, and the propeller brakes with {available} N at "
    "zero throttle{place}"};
inline constexpr MessageText camber_count_mismatch{
    "aero.camber_count_mismatch",
    {"places", "heights"},
    "camber_x_frac has {places} places and camber_z_frac {heights} heights; the counts must be equal and at "
    "least 2"};
inline constexpr MessageText cell_count_mismatch{
    "aero.cell_count_mismatch",
    {"expected", "found"},
    "expected {expected} cells, as many as the heading has; found {found}. The file may have decimal commas "
    "or be incomplete"};
inline constexpr MessageText child_element_missing{
    "aero.child_element_missing", {"parent", "element"}, "<{parent}>: expected <{element}>; found none"};
inline constexpr MessageText chord_not_positive{"aero.chord_not_positive", "the chord is not above 0"};
inline constexpr MessageText climb_too_steep{
    "aero.climb_too_steep", {"found"}, "'{found}' is steeper than 80 deg at this airspeed"};
inline constexpr MessageText climb_unit_invalid{
    "aero.climb_unit_invalid",
    {"found"},
    "'{found}' is neither an angle, as in \"5 deg\", nor a rate, as in \"2 m/s\""};
inline constexpr MessageText closed_loops_unstable{
    "aero.closed_loops_unstable", {"count"}, "the closed loops are unstable: {count} of their poles grow"};
inline constexpr MessageText coefficient_zero{
    "aero.coefficient_zero",
    {"symbol"},
    "{symbol} is 0, which no aircraft has; the coefficient may be missing"};
inline constexpr MessageText coefficients_copied{
    "aero.coefficients_copied",
    {"same", "total", "aircraft"},
    "{same} of {total} coefficients are exactly those of the {aircraft}, but wing area or span is not. The "
    "coefficients may be copies"};
inline constexpr MessageText column_missing{"aero.column_missing",
                                            {"column", "heading"},
                                            "expected a column '{column}' in the heading; found '{heading}'"};
inline constexpr MessageText command_unknown{"aero.command_unknown",
                                             {"command", "choices"},
                                             "fulmar aero: the command '{command}' does not exist.{choices}"};
inline constexpr MessageText component_unknown{
    "aero.component_unknown",
    {"component", "choices"},
    "params: the component '{component}' does not exist.{choices}"};
inline constexpr MessageText control_column_swapped{
    "aero.control_column_swapped",
    {"moment"},
    ", and another moment is {moment}; the column may be that of another control"};
inline constexpr MessageText control_derivatives_missing{
    "aero.control_derivatives_missing",
    "expected the derivatives by the controls ('name d1 ...') up to this line; found none. The file may be "
    "incomplete"};
inline constexpr MessageText control_gain_unsupported{
    "aero.control_gain_unsupported",
    {"control"},
    "CONTROL {control}: the gain is not supported; valid: 1, -1"};
inline constexpr MessageText control_gain_zero{"aero.control_gain_zero",
                                               "; its gains may be 0, or the file may be of another run"};
inline constexpr MessageText control_groups_mismatch{
    "aero.control_groups_mismatch",
    {"found", "first"},
    "this analysis has {found} groups of controls, and the first one {first}; expected one version and one "
    "aircraft in a file"};
inline constexpr MessageText control_groups_missing{
    "aero.control_groups_missing",
    {"count"},
    "expected {count} groups of controls with four lines each; the file may be incomplete"};
inline constexpr MessageText control_hinge_unsupported{
    "aero.control_hinge_unsupported",
    {"control", "hinge"},
    "CONTROL {control}: the hinge at {hinge} of the chord is not supported; valid: above 0 and below 1"};
inline constexpr MessageText control_incomplete{
    "aero.control_incomplete", "CONTROL: expected name, gain, Xhinge, three numbers of the hinge and SgnDup"};
inline constexpr MessageText control_ineffective{
    "aero.control_ineffective",
    {"coefficient", "found", "hint"},
    "the control has no effect: its {coefficient} is {found}{hint}"};
inline constexpr MessageText control_mirror_missing{
    "aero.control_mirror_missing",
    {"surface"},
    "this control requires a surface on each side, and '{surface}' has no mirror"};
inline constexpr MessageText control_name_unknown{
    "aero.control_name_unknown",
    {"control"},
    "CONTROL '{control}': the name does not identify the control surface; valid: aileron, elevator, rudder, "
    "flap, elevon"};
inline constexpr MessageText control_not_converged{
    "aero.control_not_converged",
    {"derivative", "found", "full"},
    "not converged: with a sixth of the panels {derivative} is {found} instead of {full}; give its surface "
    "more panels along the chord and the span"};
inline constexpr MessageText control_outside_surface{
    "aero.control_outside_surface",
    {"begin", "end", "surface", "length"},
    "from {begin} to {end} is outside its surface '{surface}', which is {length} long"};
inline constexpr MessageText control_pair_incomplete{
    "aero.control_pair_incomplete",
    {"control"},
    "{control} pitches as much as it rolls or yaws, as one half of a pair does. Give its mirror as a "
    "separate control, or both in one group named aileron, elevator or rudder"};
inline constexpr MessageText control_reversed{
    "aero.control_reversed", {"end", "begin"}, "the control ends at {end} and begins at {begin}"};
inline constexpr MessageText control_section_single{
    "aero.control_section_single",
    {"control"},
    "CONTROL '{control}' is at this section alone; a control extends from one section to the next"};
inline constexpr MessageText controls_misplaced{
    "aero.controls_misplaced", "controls: without a planform file, the controls belong in their surface"};
inline constexpr MessageText controls_overlap{
    "aero.controls_overlap", {"index"}, "the control overlaps controls[{index}] of the same surface"};
inline constexpr MessageText count_missing{
    "aero.count_missing", {"item"}, "expected the number of {item}; the file may be incomplete"};
inline constexpr MessageText count_out_of_range{"aero.count_out_of_range",
                                                "the count is out of range; valid: 0 to 100"};
inline constexpr MessageText cross_derivative_nonzero{
    "aero.cross_derivative_nonzero",
    {"value"},
    "the value is {value}, and a symmetric aircraft has 0: the analysis has not converged, or the column is "
    "another one"};
inline constexpr MessageText cruise_lift_unreachable{
    "aero.cruise_lift_unreachable",
    {"airspeed", "mass", "lift_coefficient", "hint"},
    "limits.airspeed_cruise: at {airspeed} m/s level flight of {mass} kg requires CL {lift_coefficient}. "
    "These surfaces reach it at no angle within 25 deg{hint}"};
inline constexpr MessageText cruise_lift_unusual{"aero.cruise_lift_unusual",
                                                 {"lift_coefficient"},
                                                 "CL in cruise is {lift_coefficient}; the usual range is 0.2 "
                                                 "to 0.9. Mass, area or airspeed is in another unit"};
inline constexpr MessageText cruise_throttle_invalid{
    "aero.cruise_throttle_invalid",
    {"throttle"},
    "the cruise throttle is {throttle}; valid: a fraction of full throttle, 0 to 1"};
inline constexpr MessageText dead_band_unusual{
    "aero.dead_band_unusual",
    {"dead_band"},
    "the dead band is {dead_band}; servos have 0.1 to 1 deg. The value may be in degrees"};
inline constexpr MessageText decimal_comma{
    "aero.decimal_comma", {"found"}, "'{found}...' has a decimal comma; save the file with decimal points"};
inline constexpr MessageText density_unit_unknown{
    "aero.density_unit_unknown", {"unit"}, "Density: the unit '{unit}' is unknown"};
inline constexpr MessageText derivative_axes_unknown{
    "aero.derivative_axes_unknown",
    "the axes of Cld and Cnd are unknown for this version of AVL; body axes are assumed. Give its SB, too, "
    "with --controls-from"};
inline constexpr MessageText derivative_converted_twice{
    "aero.derivative_converted_twice",
    {"corrected"},
    ": the value may be converted from degrees twice; it would then be {corrected} per rad"};
inline constexpr MessageText derivative_count_mismatch{
    "aero.derivative_count_mismatch",
    {"expected", "groups", "found"},
    "expected {expected} numbers: total, alpha, beta, p, q, r, Mach, U and {groups} groups of controls; "
    "found {found}"};
inline constexpr MessageText derivative_omitted{
    "aero.derivative_omitted", {"symbol"}, "{symbol} is 0; the coefficient may be missing"};
inline constexpr MessageText derivative_per_degree{
    "aero.derivative_per_degree",
    {"corrected"},
    ": the value may be per degree; it would then be {corrected} per rad"};
inline constexpr MessageText derivative_row_missing{
    "aero.derivative_row_missing",
    {"row"},
    "expected the row '{row}' of the derivatives up to this line; found none. The file may be incomplete, or "
    "VSPAERO ran without its stability option (-stab)"};
inline constexpr MessageText derivative_sign_wrong{"aero.derivative_sign_wrong",
                                                   {"symbol", "value", "sign", "consequence"},
                                                   "{symbol} is {value}, and {sign} is right: {consequence}"};
inline constexpr MessageText derivative_table_missing{
    "aero.derivative_table_missing",
    "expected a table of derivatives ('Coef Total Alpha Beta p q r ...') up to this line; found none. The "
    "file may be incomplete, or of a run with -pstab, -qstab or -rstab"};
inline constexpr MessageText derivative_unusual{"aero.derivative_unusual",
                                                {"symbol", "value", "low", "high", "hint"},
                                                "{symbol} is {value}; aircraft have {low} to {high}{hint}"};
inline constexpr MessageText derivatives_differ{
    "aero.derivatives_differ",
    {"first", "other", "differences"},
    "{first} and {other} differ, and the first is used: {differences}"};
inline constexpr MessageText derivatives_missing{"aero.derivatives_missing",
                                                 {"files"},
                                                 "the files have no derivatives; expected AVL's .st or .sb, "
                                                 "XFLR5's stability log, or VSPAERO's .stab{files}"};
inline constexpr MessageText document_end_missing{
    "aero.document_end_missing",
    {"end_tag"},
    "expected '{end_tag}' up to this line; found none. The file may be incomplete"};
inline constexpr MessageText drag_sided{
    "aero.drag_sided",
    {"value"},
    "the value is {value}: the drag of a symmetric aircraft cannot increase to one side and decrease to the "
    "other. A term of the square belongs in drag_squared"};
inline constexpr MessageText drag_table_missing{
    "aero.drag_table_missing", "expected a table with a column 'Cd' and a row 'Totals'; found none"};
inline constexpr MessageText duplicate_plane_unsupported{"aero.duplicate_plane_unsupported",
                                                         "YDUPLICATE: only y = 0 is supported"};
inline constexpr MessageText eigenvalue_difference_large{
    "aero.eigenvalue_difference_large", {"limit"}, ", more than {limit} %: a value of the import is wrong"};
inline constexpr MessageText eigenvalue_form_invalid{"aero.eigenvalue_form_invalid",
                                                     "Eigenvalue: expected 'real + imaginary i'"};
inline constexpr MessageText eigenvalue_row_invalid{
    "aero.eigenvalue_row_invalid", {"found"}, "expected 'case real imaginary'; found '{found}'"};
inline constexpr MessageText element_nesting_excessive{"aero.element_nesting_excessive",
                                                       "elements are nested deeper than 50"};
inline constexpr MessageText element_not_closed{
    "aero.element_not_closed", {"element"}, "<{element}> does not end; the file may be incomplete"};
inline constexpr MessageText element_numbers_invalid{"aero.element_numbers_invalid",
                                                     {"element", "found", "count", "noun"},
                                                     "<{element}>: expected {count}{noun}; found '{found}'"};
inline constexpr MessageText element_unit_unknown{
    "aero.element_unit_unknown",
    {"element", "unit", "choices"},
    "<{element}>: the unit '{unit}' is unknown; valid: {choices}"};
inline constexpr MessageText elevator_control_missing{
    "aero.elevator_control_missing",
    "surfaces: no control drives the elevator; the aircraft requires one for trim"};
inline constexpr MessageText elevator_drag_excessive{
    "aero.elevator_drag_excessive",
    {"change", "parasite_drag"},
    "full elevator reduces CD by {change}, more than the parasite drag {parasite_drag}: the elevator would "
    "drive the aircraft. The term is linear; the value may be that of a square, CD_de de^2"};
inline constexpr MessageText elevator_leading_up{
    "aero.elevator_leading_up", "elevator: positive is trailing edge up, which takes the nose down here"};
inline constexpr MessageText elevator_trim_unusual{
    "aero.elevator_trim_unusual",
    {"trim", "required"},
    "the trim is {trim}, and level cruise requires {required}"};
inline constexpr MessageText elevator_without_pitch{
    "aero.elevator_without_pitch", {"place"}, "the elevator gives no pitch moment ({place})"};
inline constexpr MessageText encoding_unsupported{"aero.encoding_unsupported",
                                                  "the file is UTF-16; save it as UTF-8 or plain text"};
inline constexpr MessageText end_tag_missing{
    "aero.end_tag_missing", {"element"}, "expected '</{element}>'; the file may be incomplete"};
inline constexpr MessageText entries_missing{
    "aero.entries_missing", {"count", "item"}, "expected {count} {item}; the file may be incomplete"};
inline constexpr MessageText entry_form_unsupported{
    "aero.entry_form_unsupported",
    {"entry"},
    "this command cannot edit the form of {entry}; the file is unchanged"};
inline constexpr MessageText equilibrium_missing{"aero.equilibrium_missing",
                                                 "no angles and deflections balance all forces and moments; "
                                                 "`fulmar aero check` may report the wrong coefficient"};
inline constexpr MessageText file_duplicate{"aero.file_duplicate", "the file is given twice"};
inline constexpr MessageText file_empty{"aero.file_empty", "the file is empty"};
inline constexpr MessageText flight_acceptable{"aero.flight_acceptable", "flown; the gains are in the file"};
inline constexpr MessageText flight_condition{
    "aero.flight_condition",
    {"condition", "airspeed", "altitude"},
    "{condition} at {airspeed} m/s, {altitude} m above mean sea level"};
inline constexpr MessageText flight_folder_missing{
    "aero.flight_folder_missing", {"folder"}, "the folder for the flight does not exist: {folder}"};
inline constexpr MessageText flight_impossible{"aero.flight_impossible",
                                               {"condition", "reason", "default_hint"},
                                               "no {condition}: {reason}{default_hint}"};
inline constexpr MessageText flight_skipped{
    "aero.flight_skipped", {"command"}, "not flown: `fulmar aero {command}` has failed"};
inline constexpr MessageText flight_unacceptable{"aero.flight_unacceptable", "flown, with faults"};
inline constexpr MessageText flow_not_solvable{
    "aero.flow_not_solvable", "the flow about these panels has no solution: two panels may coincide"};
inline constexpr MessageText format_unknown{
    "aero.format_unknown",
    {"file"},
    "{file}:1: the file format is unknown. Valid for AVL: .st .sb .mass .run .eig. Valid for XFLR5: "
    "stability log, plane polar, plane or polar XML. Valid for VSPAERO: .stab .polar .flt .history .vspaero, "
    "mass properties, parasite drag, results as CSV. Valid alone, as a whole aircraft: ROSflight "
    "(..._dynamics.yaml), JSBSim (XML) or pyfly (JSON)"};
inline constexpr MessageText forward_thrust_missing{
    "aero.forward_thrust_missing", "the propellers together give no forward thrust; check tilt and toe"};
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
inline constexpr MessageText fulmar_program_missing{
    "aero.fulmar_program_missing",
    "fulmar aero tune --verify: the program fulmar is missing beside this one"};
inline constexpr MessageText function_factor_unsupported{
    "aero.function_factor_unsupported",
    {"found"},
    "{found} is not supported; expected one <product> of a <value>, aero/qbar-psf, metrics/Sw-sqft, "
    "metrics/bw-ft or cbarw-ft, aero/bi2vel or ci2vel, and a state or a <table>"};
inline constexpr MessageText function_factors_invalid{
    "aero.function_factors_invalid",
    "expected the dynamic pressure and S once, b or c once in moments alone, and bi2vel or ci2vel with rates "
    "alone"};
inline constexpr MessageText function_product_unsupported{
    "aero.function_product_unsupported",
    "expected at most one state or one table; a product of two is not supported"};
inline constexpr MessageText gain_count_mismatch{
    "aero.gain_count_mismatch",
    {"expected", "surfaces", "found"},
    "expected {expected} gains, one for each surface of '{surfaces}'; found {found}"};
inline constexpr MessageText gain_form_unsupported{
    "aero.gain_form_unsupported",
    {"component", "gain"},
    "this command cannot edit the form of {component}.{gain}; the file is unchanged"};
inline constexpr MessageText gain_increase_small{
    "aero.gain_increase_small",
    {"loop", "place", "margin"},
    "{loop}, broken at the {place}: the gain margin is {margin} dB upwards; at least 6 dB are required"};
inline constexpr MessageText gain_reduction_small{
    "aero.gain_reduction_small",
    {"loop", "place", "margin"},
    "{loop}, broken at the {place}: the gain margin is {margin} dB downwards; at least 6 dB are required"};
inline constexpr MessageText gain_sign_reversed{
    "aero.gain_sign_reversed",
    {"gain", "found", "used"},
    "{gain} is {found}: the sign is that of a surface with the other sense. Fulmar's gains are positive; "
    "{used} rad is used"};
inline constexpr MessageText gain_undeclared{
    "aero.gain_undeclared", {"gain"}, "{gain} is not declared by any node of ROSplane 2.0, which ignores it"};
inline constexpr MessageText gains_duplicate{
    "aero.gains_duplicate",
    {"first_file"},
    "the file holds gains, as {first_file} does; expected the folder of one aircraft"};
inline constexpr MessageText geometry_incomplete{
    "aero.geometry_incomplete", {"missing"}, "the geometry is incomplete, missing: {missing}"};
inline constexpr MessageText geometry_map_expected{
    "aero.geometry_map_expected", {"found"}, "expected a map with the parts of an aircraft; found {found}"};
inline constexpr MessageText gyration_radius_unusual{
    "aero.gyration_radius_unusual",
    {"radius", "ratio", "hint"},
    "the radius of gyration is {radius} m, {ratio} of the span; aircraft have 0.08 to 0.2, a bare rod "
    "0.29{hint}"};
inline constexpr MessageText heading_alpha_missing{
    "aero.heading_alpha_missing", "expected 'AoA_' in the heading of this analysis; found none"};
inline constexpr MessageText heading_key_missing{
    "aero.heading_key_missing", {"key"}, "expected '{key}' in the heading of this analysis; found none"};
inline constexpr MessageText heading_number_expected{"aero.heading_number_expected",
                                                     "expected a number; found none"};
inline constexpr MessageText heading_number_missing{
    "aero.heading_number_missing",
    {"key"},
    "expected '{key} number' in the heading of this analysis; found none"};
inline constexpr MessageText heading_reference_missing{
    "aero.heading_reference_missing",
    "expected 'Sref_', 'Cref_' and 'Bref_' in a heading; found none. The reference quantities are missing"};
inline constexpr MessageText hourglass_bound_missed{
    "aero.hourglass_bound_missed",
    {"figure", "found", "unit", "bound"},
    "{figure} on the hourglass is {found} {unit}; required: {bound}"};
inline constexpr MessageText hourglass_not_flown{
    "aero.hourglass_not_flown", {"result"}, "the hourglass was not flown: {result}"};
inline constexpr MessageText hourglass_result{
    "aero.hourglass_result", {"result"}, "hourglass in light turbulence: {result}"};
inline constexpr MessageText induced_drag_doubled{
    "aero.induced_drag_doubled",
    "this term must be 0: drag always includes CL^2/(pi e AR), and C_D_alpha counts it twice. Set it to 0 "
    "and fit C_D_0 and e"};
inline constexpr MessageText inertia_moments_impossible{
    "aero.inertia_moments_impossible",
    {"smallest", "middle", "largest", "xz", "xx", "yy"},
    "the principal moments are {smallest}, {middle} and {largest} kg m^2. The largest is more than the sum "
    "of the others, which no body has. xz ({xz}) may be wrong, or xx ({xx}) exchanged with yy ({yy})"};
inline constexpr MessageText inertia_not_definite{
    "aero.inertia_not_definite",
    {"moment", "limit"},
    "the inertia is not positive definite: one principal moment is {moment} kg m^2. The magnitude of xz must "
    "be less than {limit}"};
inline constexpr MessageText inertia_not_positive{"aero.inertia_not_positive",
                                                  "xx, yy and zz must be above 0"};
inline constexpr MessageText inertia_not_positive_definite{
    "aero.inertia_not_positive_definite",
    {"xz_squared", "xx_zz"},
    "inertia: the tensor is not positive definite: xz^2 = {xz_squared} must be less than xx zz = {xx_zz}. No "
    "body has such an inertia"};
inline constexpr MessageText inertia_unit_suspect{
    "aero.inertia_unit_suspect",
    {"unit", "corrected"},
    ". The value may be in {unit}; it would then be {corrected} kg m^2"};
inline constexpr MessageText inertia_values_expected{"aero.inertia_values_expected",
                                                     "expected xx yy zz [xz] in kg m^2"};
inline constexpr MessageText input_is_folder{"aero.input_is_folder",
                                             "the path is a folder; give the files in it"};
inline constexpr MessageText json_invalid{"aero.json_invalid",
                                          "the file is not valid JSON; it may be incomplete"};
inline constexpr MessageText json_object_expected{"aero.json_object_expected",
                                                  "expected a JSON object of coefficients"};
inline constexpr MessageText key_missing{
    "aero.key_missing", {"key"}, "expected the key '{key}', which is missing"};
inline constexpr MessageText keyword_value_missing{
    "aero.keyword_value_missing", {"keyword"}, "the file ends after {keyword}"};
inline constexpr MessageText labelled_line_missing{
    "aero.labelled_line_missing", {"label"}, "expected a line '{label}'; found none"};
inline constexpr MessageText labelled_number_missing{
    "aero.labelled_number_missing", {"key"}, "expected '{key} number'; found none"};
inline constexpr MessageText lattice_not_converged{
    "aero.lattice_not_converged",
    {"lift_slope", "full_lift_slope", "margin", "full_margin"},
    "not converged: with a sixth of the panels CL_alpha is {lift_slope} instead of {full_lift_slope} and the "
    "static margin {margin} instead of {full_margin}. Give more panels, or move a tail away from the height "
    "at which the wing's wake meets it"};
inline constexpr MessageText level_flight_impossible{
    "aero.level_flight_impossible",
    {"airspeed", "reason", "default_hint"},
    "no level flight at {airspeed} m/s: {reason}{default_hint}"};
inline constexpr MessageText level_flight_missing{"aero.level_flight_missing", "no level flight exists"};
inline constexpr MessageText lift_not_of_wings{
    "aero.lift_not_of_wings",
    {"lift_slope", "lift"},
    "; their lift is not that of wings (CL_alpha {lift_slope}, CL {lift} at 25 deg), because a vortex passes "
    "a control point of another surface. Make winglets sections of their wing, move a tail out of the wing's "
    "wake, or change `spanwise`"};
inline constexpr MessageText lift_slope_unsupported{
    "aero.lift_slope_unsupported",
    "CLAF: a lift slope other than that of a flat plate is not supported; valid: 1"};
inline constexpr MessageText lift_squared_invalid{
    "aero.lift_squared_invalid", "aero/cl-squared is valid once, in drag, with a positive factor"};
inline constexpr MessageText limit_defaulted{
    "aero.limit_defaulted",
    {"default_value"},
    "; the file does not set this limit, and the default is {default_value}"};
inline constexpr MessageText line_end{"aero.line_end", "the end of the line"};
inline constexpr MessageText line_outside_surface{
    "aero.line_outside_surface", {"found"}, "'{found}' is outside a SURFACE"};
inline constexpr MessageText location_unit_unknown{
    "aero.location_unit_unknown", {"unit"}, "<location>: the unit '{unit}' is unknown; valid: FT, IN, M"};
inline constexpr MessageText log_airspeed_not_positive{"aero.log_airspeed_not_positive",
                                                       "VInf: expected a value above 0 m/s"};
inline constexpr MessageText log_chord_unknown{"aero.log_chord_unknown",
                                               "Cma is 0; the chord cannot be computed from it"};
inline constexpr MessageText log_control_missing{
    "aero.log_control_missing",
    "expected 'Control derivatives' or the modes up to this line; found neither. The log may be incomplete"};
inline constexpr MessageText log_reference_not_positive{"aero.log_reference_not_positive",
                                                        "density, area and span must be above 0"};
inline constexpr MessageText log_type_mismatch{
    "aero.log_type_mismatch",
    {"found"},
    "the log is of '{found}'; expected the log of a stability analysis, 'Type 7 - Stability polar'"};
inline constexpr MessageText log_unit_unknown{
    "aero.log_unit_unknown", {"unit"}, "the unit '{unit}' is unknown"};
inline constexpr MessageText log_value_missing{
    "aero.log_value_missing", {"key"}, "expected '{key} = number' up to this line; found none"};
inline constexpr MessageText longitudinal_derivatives_missing{
    "aero.longitudinal_derivatives_missing",
    "expected 'Longitudinal derivatives' up to this line; found none. The log may be incomplete"};
inline constexpr MessageText markup_not_closed{
    "aero.markup_not_closed", {"opening"}, "{opening} does not end; the file may be incomplete"};
inline constexpr MessageText mass_file_unit_unknown{
    "aero.mass_file_unit_unknown", {"unit", "choices"}, "the unit '{unit}' is unknown; {choices}"};
inline constexpr MessageText mass_missing{
    "aero.mass_missing", "the total mass is not above 0; give surfaces, bodies or masses a mass"};
inline constexpr MessageText mass_row_incomplete{
    "aero.mass_row_incomplete",
    {"count"},
    "expected 'mass x y z Ixx Iyy Izz [Ixy Ixz Iyz]'; found {count} numbers"};
inline constexpr MessageText mass_rows_missing{"aero.mass_rows_missing",
                                               "expected rows 'mass x y z Ixx Iyy Izz'; found none"};
inline constexpr MessageText mass_sum_not_positive{
    "aero.mass_sum_not_positive", {"mass"}, "the sum of the masses is {mass}; expected a value above 0"};
inline constexpr MessageText mass_unit_suspect{"aero.mass_unit_suspect",
                                               "The mass may be in grams, or the area in ft^2"};
inline constexpr MessageText minimum_airspeed_low{
    "aero.minimum_airspeed_low",
    {"airspeed", "stall_airspeed"},
    "the minimum airspeed is {airspeed} m/s, and the wing stalls at {stall_airspeed} m/s; 1.2 times the "
    "stall airspeed is usual"};
inline constexpr MessageText mode_damping_low{
    "aero.mode_damping_low",
    {"mode", "damping_ratio", "limit", "consequence"},
    "the damping ratio of the {mode} is {damping_ratio}, less than {limit}: {consequence}"};
inline constexpr MessageText mode_unstable{"aero.mode_unstable",
                                           {"mode", "doubling_time", "consequence"},
                                           "the {mode} doubles in {doubling_time} s: {consequence}"};
inline constexpr MessageText moment_reference_beside{
    "aero.moment_reference_beside",
    "AERORP and CG are not in one plane; the roll and yaw moments of this offset are left out"};
inline constexpr MessageText moment_reference_missing{
    "aero.moment_reference_missing",
    {"element"},
    "the file has no place {element}; the centre of gravity is assumed as the reference of the moments"};
inline constexpr MessageText moments_moved{
    "aero.moments_moved",
    {"aft", "up"},
    "moments are moved from AERORP to the centre of gravity: forces act {aft} m behind and {up} m above it"};
inline constexpr MessageText naca_digits_invalid{
    "aero.naca_digits_invalid", {"found"}, "NACA '{found}' does not have four digits"};
inline constexpr MessageText name_repeated{"aero.name_repeated", {"name"}, "the name '{name}' exists twice"};
inline constexpr MessageText number_expected{
    "aero.number_expected", {"found"}, "expected a number; found {found}"};
inline constexpr MessageText number_not_finite{"aero.number_not_finite", "the number is not finite"};
inline constexpr MessageText option_not_positive{
    "aero.option_not_positive", {"found"}, "'{found}' is not above 0"};
inline constexpr MessageText oswald_factor_unusual{
    "aero.oswald_factor_unusual", {"factor"}, "Oswald's factor is {factor}; wings have 0.6 to 1"};
inline constexpr MessageText output_not_writable{"aero.output_not_writable", "the file cannot be written"};
inline constexpr MessageText pack_resistance_unusual{
    "aero.pack_resistance_unusual",
    {"ratio"},
    "the resistance is {ratio} times that of the motors; the value may be in milliohm"};
inline constexpr MessageText page_is_input{
    "aero.page_is_input", {"page"}, "'{page}' is an input of the page; name another file with -o"};
inline constexpr MessageText pair_missing{"aero.pair_missing",
                                          {"key"},
                                          "expected '{key} = number' up to this line; found none. The file "
                                          "may be incomplete or of another version"};
inline constexpr MessageText paired_servos_differ{
    "aero.paired_servos_differ",
    {"left", "right", "part"},
    "'{left}' and '{right}' are the left and the right {part}, and their servos differ: one moves "
    "differently from the other"};
inline constexpr MessageText parameter_node_unknown{
    "aero.parameter_node_unknown",
    {"node"},
    "the parameters are those of the node '{node}', which the simulator does not have"};
inline constexpr MessageText parameter_unknown{"aero.parameter_unknown",
                                               {"parameter", "choices"},
                                               "the parameter '{parameter}' does not exist.{choices}"};
inline constexpr MessageText params_empty{
    "aero.params_empty", "params: the key has no entries; remove the key, and the command writes it"};
inline constexpr MessageText parasite_drag_doubled{
    "aero.parasite_drag_doubled",
    {"parasite_drag"},
    "parasite drag counts twice, here and as parasite_drag {parasite_drag}: C_D_0 and C_D_p belong to two "
    "different polars. Keep one"};
inline constexpr MessageText phase_margin_small{
    "aero.phase_margin_small",
    {"loop", "place", "margin"},
    "{loop}, broken at the {place}: the phase margin is {margin} deg; at least 45 deg are required"};
inline constexpr MessageText picture_not_writable{
    "aero.picture_not_writable", {"file"}, "'{file}' cannot be written"};
inline constexpr MessageText pitch_coefficient_digit{
    "aero.pitch_coefficient_digit",
    {"found", "aircraft", "original"},
    "Cm_0 is {found}, ten times the {aircraft}'s {original}, and other coefficients are the same. A digit "
    "may be missing"};
inline constexpr MessageText pitch_limits_reversed{"aero.pitch_limits_reversed",
                                                   "the minimum pitch is not below the maximum"};
inline constexpr MessageText pitch_power_low{"aero.pitch_power_low",
                                             {"alpha", "required", "limit"},
                                             "maximum lift, at {alpha}, requires {required} of elevator, "
                                             "which moves {limit}: the aircraft cannot slow to the stall"};
inline constexpr MessageText pitch_rate_doubled{
    "aero.pitch_rate_doubled",
    {"corrected"},
    ": the rate may be q c/V instead of q c/2V; the value would then be {corrected}"};
inline constexpr MessageText pitch_rate_drag_unusual{
    "aero.pitch_rate_drag_unusual", {"found"}, "the value is {found}; the usual value is about 0"};
inline constexpr MessageText plane_body_unsupported{
    "aero.plane_body_unsupported",
    "the body of the plane is not supported; give it in `bodies` of the drawing"};
inline constexpr MessageText plane_element_open{
    "aero.plane_element_open", {"element", "line"}, "<{element}> of line {line} does not end"};
inline constexpr MessageText plane_missing{
    "aero.plane_missing",
    "the file has no <explane> with a <Plane>: XFLR5 exports it as `Export plane to xml`"};
inline constexpr MessageText plane_nesting_excessive{"aero.plane_nesting_excessive",
                                                     "elements are nested deeper than 20"};
inline constexpr MessageText planform_format_unsupported{
    "aero.planform_format_unsupported", "the format is not supported. Valid: AVL's .avl, XFLR5's .xml"};
inline constexpr MessageText planform_keyword_unsupported{
    "aero.planform_keyword_unsupported",
    {"found"},
    "'{found}' is not supported here; valid: SURFACE, YDUPLICATE, ANGLE, TRANSLATE, SCALE, COMPONENT, "
    "SECTION, NACA, AFILE, CLAF, CDCL, CONTROL"};
inline constexpr MessageText planform_missing{
    "aero.planform_missing",
    {"planform"},
    "planform: the file '{planform}' does not exist beside the geometry file"};
inline constexpr MessageText planform_not_readable{"aero.planform_not_readable", "the file cannot be read"};
inline constexpr MessageText planform_numbers_missing{
    "aero.planform_numbers_missing",
    {"found", "count", "names"},
    "'{found}': expected numbers, at least {count}: {names}"};
inline constexpr MessageText planform_truncated{
    "aero.planform_truncated", {"expected"}, "expected {expected}; found the end of the file"};
inline constexpr MessageText point_mass_incomplete{"aero.point_mass_incomplete",
                                                   "<Point_Mass>: expected <Mass> and <coordinates>"};
inline constexpr MessageText point_mass_unplaced{"aero.point_mass_unplaced",
                                                 "the point mass has no coordinates"};
inline constexpr MessageText polar_heading_missing{
    "aero.polar_heading_missing", "expected a heading 'alpha Beta CL CDi CDv CD ...'; found none"};
inline constexpr MessageText polar_of_airfoil{
    "aero.polar_of_airfoil",
    "the polar is that of an airfoil, not of an aircraft; the plane's polar has the drag"};
inline constexpr MessageText positive_value_expected{"aero.positive_value_expected",
                                                     "expected a value above 0"};
inline constexpr MessageText propeller_thrust_missing{
    "aero.propeller_thrust_missing",
    "propellers: propulsion.ct0 is missing or not above 0; the propeller speed follows from it"};
inline constexpr MessageText propeller_without_thrust{
    "aero.propeller_without_thrust", {"place"}, "the propeller has no thrust ({place})"};
inline constexpr MessageText proverse_yaw{
    "aero.proverse_yaw",
    {"value", "ratio"},
    "Cn_da is {value}, {ratio} of Cl_da: the aileron would yaw into the turn, and adverse yaw (negative) is "
    "usual. The value may be in stability axes or in XFLR5's axes"};
inline constexpr MessageText rate_by_span{
    "aero.rate_by_span",
    {"corrected"},
    ": the value may belong with the span b/2V instead of the chord c/2V; it would then be {corrected}"};
inline constexpr MessageText reference_area_mismatch{
    "aero.reference_area_mismatch",
    {"reference", "surface"},
    "reference.area: {reference} m^2, but the largest surface has {surface} m^2, both halves"};
inline constexpr MessageText reference_chord_mismatch{
    "aero.reference_chord_mismatch",
    {"reference", "ratio"},
    "reference.chord: {reference}, but area over span is {ratio}"};
inline constexpr MessageText reference_mismatch{
    "aero.reference_mismatch",
    {"quantity", "found", "unit", "source", "first_value", "first_unit", "first_file"},
    "the {quantity} is {found}{unit} ({source}), but {first_value}{first_unit} in {first_file}: expected "
    "files of one aircraft, with one unit of length"};
inline constexpr MessageText reference_missing{
    "aero.reference_missing", "the geometry is incomplete, missing: reference (area, span, chord)"};
inline constexpr MessageText reference_moved{"aero.reference_moved",
                                             {"aft", "up"},
                                             "moments and rates are moved from the reference point to the "
                                             "centre of gravity, {aft} m aft and {up} m up"};
inline constexpr MessageText reference_moved_far{
    "aero.reference_moved_far",
    {"aft", "up", "ratio"},
    "moments and rates are moved from the reference point to the centre of gravity, {aft} m aft and {up} m "
    "up, {ratio} of the chord. Check the unit of length of the files and their origin"};
inline constexpr MessageText reference_span_mismatch{
    "aero.reference_span_mismatch",
    {"reference", "surfaces"},
    "reference.span: {reference}, but the surfaces span {surfaces}"};
inline constexpr MessageText result_count_mismatch{
    "aero.result_count_mismatch",
    {"expected", "found"},
    "expected {expected} numbers; found {found}. Numbers require decimal points, not commas"};
inline constexpr MessageText result_name_missing{"aero.result_name_missing",
                                                 "Results_Name: expected the name of a result"};
inline constexpr MessageText result_number_expected{
    "aero.result_number_expected", {"found"}, "expected a number; found '{found}'"};
inline constexpr MessageText result_row_missing{
    "aero.result_row_missing",
    {"key", "result"},
    "expected '{key},number' of {result} up to this line; found none. The file may be incomplete"};
inline constexpr MessageText result_sideslip{
    "aero.result_sideslip", {"key"}, "this analysis has a sideslip; expected {key} 0"};
inline constexpr MessageText results_missing{
    "aero.results_missing",
    {"found"},
    "the file has none of Parasite_Drag, Mass_Properties and VSPAERO_Stab; it has {found}"};
inline constexpr MessageText results_unused{
    "aero.results_unused", {"results"}, "results that are not used: {results}"};
inline constexpr MessageText roll_power_low{
    "aero.roll_power_low",
    {"helix", "rate"},
    "full aileron holds only p b/2V = {helix}, {rate} deg/s; the recommended value is 0.07"};
inline constexpr MessageText roll_rate_doubled{
    "aero.roll_rate_doubled",
    {"corrected"},
    ": the rate may be p b/V instead of p b/2V; the value would then be {corrected}"};
inline constexpr MessageText rosflight_file_missing{
    "aero.rosflight_file_missing", "the folder has no ROSflight file with wing_s, C_L_alpha, ..."};
inline constexpr MessageText rosplane_folder_expected{
    "aero.rosplane_folder_expected", "expected a folder with the parameter files of ROSplane or ROSflight"};
inline constexpr MessageText row_incomplete{"aero.row_incomplete",
                                            {"expected", "found"},
                                            "expected {expected} numbers, as many as the heading has names; "
                                            "found {found}. The file may be incomplete"};
inline constexpr MessageText rows_missing{"aero.rows_missing",
                                          "expected rows of numbers below the heading; found none"};
inline constexpr MessageText rudder_derivative_zero{
    "aero.rudder_derivative_zero", {"symbol", "hint"}, "{symbol} is 0{hint}"};
inline constexpr MessageText rudder_ineffective{"aero.rudder_ineffective",
                                                ": the rudder has no effect; the aircraft turns without it"};
inline constexpr MessageText rudder_leading_right{
    "aero.rudder_leading_right", "rudder: positive is trailing edge right, which takes the nose left here"};
inline constexpr MessageText rudder_missing{
    "aero.rudder_missing",
    ": the aircraft has no rudder and no yaw control; it turns with the ailerons alone"};
inline constexpr MessageText rudder_signs_equal{
    "aero.rudder_signs_equal",
    {"side", "yaw"},
    "CY_dr is {side} and Cn_dr {yaw}: the same sign, as with a rudder in front of the centre of gravity. One "
    "of them has the wrong sign"};
inline constexpr MessageText run_unit_unknown{
    "aero.run_unit_unknown",
    {"unit"},
    "the unit '{unit}' is unknown; a .mass file gives AVL its units (Lunit, Munit, Tunit)"};
inline constexpr MessageText section_chord_invalid{
    "aero.section_chord_invalid", {"chord"}, "SECTION: the chord is {chord}; expected a value above 0"};
inline constexpr MessageText section_on_left{
    "aero.section_on_left", {"y"}, "{y} is on the left; a surface with mirror gives its right half"};
inline constexpr MessageText section_repeated{"aero.section_repeated",
                                              "the section has the same y and z as the section before it"};
inline constexpr MessageText sections_crossing{"aero.sections_crossing",
                                               {"previous", "next"},
                                               "the sections cross: this one goes back from y = {previous} "
                                               "to {next}; sections go from the root to the tip"};
inline constexpr MessageText sections_too_few{
    "aero.sections_too_few",
    {"surface", "count"},
    "the sections of '{surface}' number {count}; a surface requires at least 2, from the root to the tip"};
inline constexpr MessageText servo_damping_unusual{
    "aero.servo_damping_unusual",
    {"damping_ratio"},
    "the damping ratio is {damping_ratio}; servos have 0.5 to 2"};
inline constexpr MessageText servo_frequency_in_degrees{"aero.servo_frequency_in_degrees",
                                                        ". The value may be in deg/s"};
inline constexpr MessageText servo_frequency_in_hertz{
    "aero.servo_frequency_in_hertz",
    {"corrected"},
    ". The value may be in Hz; it would then be {corrected} rad/s"};
inline constexpr MessageText servo_frequency_unusual{
    "aero.servo_frequency_unusual",
    {"frequency", "hint"},
    "the natural frequency is {frequency} rad/s; servos have 30 to 200{hint}"};
inline constexpr MessageText servo_range_small{"aero.servo_range_small",
                                               {"minimum", "maximum", "throw_limit"},
                                               "the servo moves from {minimum} to {maximum}, but controllers "
                                               "command up to the throw, {throw_limit} either way"};
inline constexpr MessageText servo_rate_not_positive{
    "aero.servo_rate_not_positive", "the rate limit is not above 0; the servo does not move"};
inline constexpr MessageText servo_rate_unusual{
    "aero.servo_rate_unusual",
    {"rate"},
    "the rate limit is {rate} rad/s; servos have 3 to 15 rad/s. The value may be in deg/s"};
inline constexpr MessageText servo_reversal_needed{"aero.servo_reversal_needed", "reverse the servo, too"};
inline constexpr MessageText shipped_file_read_only{
    "aero.shipped_file_read_only",
    "files of the installation are read-only; copy the file and name the copy"};
inline constexpr MessageText sideslip_drag_asymmetric{
    "aero.sideslip_drag_asymmetric",
    {"linear", "square", "sideslip"},
    "CD_beta is {linear} beside a square of {square}: drag is least at {sideslip} of sideslip. A symmetric "
    "aircraft has the minimum at 0. Set CD_beta to 0; it is the remainder of a fit"};
inline constexpr MessageText sign_doubted{
    "aero.sign_doubted", {"comment"}, "the author doubts the value: '{comment}'"};
inline constexpr MessageText speed_step_invalid{
    "aero.speed_step_invalid", {"limit"}, "the step must be above 0 and give at most {limit} speeds"};
inline constexpr MessageText squared_drag_negative{
    "aero.squared_drag_negative", {"found"}, "the value is {found}: the deflection would drive the aircraft"};
inline constexpr MessageText stall_airspeed_required{
    "aero.stall_airspeed_required", {"airspeed"}, "; this CL requires {airspeed} m/s"};
inline constexpr MessageText stall_angle_low{
    "aero.stall_angle_low",
    {"alpha"},
    "the stall angle is {alpha}; wings stall at 10 to 18 deg. With this value the wing stalls in cruise"};
inline constexpr MessageText stall_in_flight{
    "aero.stall_in_flight",
    {"time", "airspeed", "bank", "limit"},
    "stalled at {time} s: at {airspeed} m/s and {bank} of bank, the angle of attack exceeds the {limit} of "
    "maximum lift and stays there"};
inline constexpr MessageText standing_bank_unusual{
    "aero.standing_bank_unusual",
    {"bank"},
    "the aircraft stands on one side, with a bank of {bank}; a contact may have the wrong sign of y"};
inline constexpr MessageText standing_pitch_unusual{
    "aero.standing_pitch_unusual",
    {"pitch"},
    "the aircraft stands with a pitch of {pitch}; check z (down) of all contacts"};
inline constexpr MessageText static_margin_high{
    "aero.static_margin_high",
    {"margin"},
    "the static margin -Cm_alpha/CL_alpha is {margin} of the chord; the usual range is 0.05 to 0.3. The "
    "aircraft is very stable in pitch, or the chord is not the mean chord"};
inline constexpr MessageText static_margin_low{
    "aero.static_margin_low",
    {"margin"},
    "the static margin -Cm_alpha/CL_alpha is {margin} of the chord; the usual range is 0.05 to 0.3. The "
    "aircraft is hardly stable in pitch"};
inline constexpr MessageText straight_analysis_missing{
    "aero.straight_analysis_missing", "all analyses have a sideslip; expected one with Beta_ 0"};
inline constexpr MessageText surface_flat{
    "aero.surface_flat", {"surface"}, "'{surface}' is flat; a rudder is ineffective there"};
inline constexpr MessageText surface_name_missing{"aero.surface_name_missing",
                                                  "SURFACE: the name is missing"};
inline constexpr MessageText surface_throw_exceeded{
    "aero.surface_throw_exceeded",
    {"required", "surface", "throw_limit", "place"},
    "the flight requires {required} of {surface}, which moves {throw_limit} either way ({place})"};
inline constexpr MessageText surface_unknown{
    "aero.surface_unknown",
    {"place", "surface", "choices"},
    "{place}.surface: the surface {surface} does not exist.{choices}"};
inline constexpr MessageText surface_upright{
    "aero.surface_upright", {"surface"}, "'{surface}' is upright; only a rudder is effective there"};
inline constexpr MessageText surfaces_and_planform{
    "aero.surfaces_and_planform", "planform: the geometry gives surfaces as well; give one of the two"};
inline constexpr MessageText surfaces_missing{
    "aero.surfaces_missing",
    "the geometry is incomplete, missing: surfaces, or a planform as in planform: wing.avl"};
inline constexpr MessageText surfaces_not_in_file{
    "aero.surfaces_not_in_file",
    {"airframe"},
    "{airframe}: an airframe file has no surfaces; give its geometry file to show them"};
inline constexpr MessageText sweep_heading_missing{"aero.sweep_heading_missing",
                                                   "expected a heading 'Beta Mach AoA ...'; found none"};
inline constexpr MessageText symmetric_fin_unsupported{
    "aero.symmetric_fin_unsupported", "a fin that extends up and down is not supported; give two fins"};
inline constexpr MessageText symmetry_plane_unsupported{
    "aero.symmetry_plane_unsupported",
    "planes of symmetry are not supported; give both halves with YDUPLICATE 0"};
inline constexpr MessageText table_axis_unsupported{
    "aero.table_axis_unsupported",
    {"property", "choices"},
    "a table over '{property}' is not supported; valid: {choices}"};
inline constexpr MessageText table_element_unsupported{
    "aero.table_element_unsupported", {"element"}, "<{element}> in a table is not supported"};
inline constexpr MessageText table_empty{
    "aero.table_empty", "the table has no values; write one row for each point, or remove the table"};
inline constexpr MessageText table_invalid{
    "aero.table_invalid", {"index", "reason"}, "aero.tables[{index}].{reason}"};
inline constexpr MessageText table_points_not_increasing{
    "aero.table_points_not_increasing",
    {"previous", "next"},
    "the points of the table do not increase: {next} follows {previous}"};
inline constexpr MessageText table_row_invalid{
    "aero.table_row_invalid",
    {"expected", "found"},
    "expected {expected} in this row of the table; found '{found}'"};
inline constexpr MessageText table_states_unsupported{"aero.table_states_unsupported",
                                                      "a table over three states is not supported"};
inline constexpr MessageText table_too_large{
    "aero.table_too_large",
    {"rows", "columns"},
    "the table has {rows} by {columns} points; valid: at most 32 by 16 points and 256 values"};
inline constexpr MessageText table_variable_missing{
    "aero.table_variable_missing",
    "the table does not name its variable; add <independentVar>PROPERTY</independentVar> before its values"};
inline constexpr MessageText tag_not_closed{"aero.tag_not_closed",
                                            "a tag does not end; the file may be incomplete"};
inline constexpr MessageText text_expected{
    "aero.text_expected",
    "the file is not text. Binary projects (.xfl, .vsp3) are not supported; export text from them"};
inline constexpr MessageText three_numbers_expected{"aero.three_numbers_expected",
                                                    {"element", "found"},
                                                    "<{element}>: expected three numbers; found '{found}'"};
inline constexpr MessageText throw_too_small{
    "aero.throw_too_small", {"throw_limit"}, "the throw is only {throw_limit}; surfaces move 15 to 45 deg"};
inline constexpr MessageText thrust_insufficient{
    "aero.thrust_insufficient",
    {"required", "available", "place"},
    "the flight requires {required} N of thrust, and full throttle gives {available} N{place}"};
inline constexpr MessageText thrust_off_centre{
    "aero.thrust_off_centre",
    {"direction", "arm"},
    "the propellers together turn the nose {direction}: their thrust acts {arm} m beside the centre of "
    "gravity. One propeller may have the wrong sign of y"};
inline constexpr MessageText time_constant_unusual{
    "aero.time_constant_unusual",
    {"time_constant"},
    "the time constant is {time_constant} s; servos have 0.01 to 0.1 s. The value may be in ms"};
inline constexpr MessageText too_few_waypoints{"aero.too_few_waypoints", "expected at least two waypoints"};
inline constexpr MessageText too_many_airfoils{"aero.too_many_airfoils",
                                               "the planform has more than 16 airfoils"};
inline constexpr MessageText too_many_control_parts{"aero.too_many_control_parts",
                                                    "the surface has more than 16 parts of controls"};
inline constexpr MessageText too_many_controls{"aero.too_many_controls",
                                               "the surface has more than 16 controls"};
inline constexpr MessageText too_many_files{
    "aero.too_many_files", "the folder has more than 500 YAML files; give the folder of one aircraft"};
inline constexpr MessageText too_many_masses{"aero.too_many_masses", "the planform has more than 64 masses"};
inline constexpr MessageText too_many_moment_tables{
    "aero.too_many_moment_tables",
    {"count"},
    "AERORP and CG differ. The tables of the force moments about the centre of gravity make {count} tables "
    "in total; an airframe has at most 8"};
inline constexpr MessageText too_many_panels{
    "aero.too_many_panels",
    {"count", "surface", "own", "limit"},
    "surfaces: the surfaces have {count} panels, of which '{surface}' has {own} (chordwise times spanwise, "
    "both halves); valid: at most {limit}"};
inline constexpr MessageText too_many_sections{"aero.too_many_sections",
                                               "the surface has more than 32 sections"};
inline constexpr MessageText too_many_surfaces{"aero.too_many_surfaces",
                                               "the planform has more than 16 surfaces"};
inline constexpr MessageText too_many_tables{"aero.too_many_tables",
                                             "this is the ninth table; an airframe has at most 8"};
inline constexpr MessageText total_derivatives_missing{
    "aero.total_derivatives_missing", {"files"}, "an airframe requires the total derivatives, AVL's {files}"};
inline constexpr MessageText total_mass_not_positive{"aero.total_mass_not_positive",
                                                     "Total Mass: expected a value above 0"};
inline constexpr MessageText trim_beyond_throw{"aero.trim_beyond_throw",
                                               {"trim", "throw_limit"},
                                               "the trim is {trim}, beyond the throw of {throw_limit}"};
inline constexpr MessageText trim_mismatch{
    "aero.trim_mismatch",
    {"alpha", "airspeed", "first_file", "first_alpha", "first_airspeed"},
    "the trim is {alpha} and {airspeed} m/s, but {first_file} has {first_alpha} and {first_airspeed} m/s: "
    "expected logs of one aircraft in one attitude"};
inline constexpr MessageText trim_value_missing{
    "aero.trim_value_missing", {"key"}, "expected '{key}= number' up to this line; found none"};
inline constexpr MessageText tuning_assumptions{
    "aero.tuning_assumptions",
    {"step", "delay", "aileron", "elevator", "throttle"},
    "assumed: a step of {step}, delay {delay}; with the servos' lag, aileron {aileron}, elevator {elevator}, "
    "throttle {throttle}"};
inline constexpr MessageText tuning_out_of_range{"aero.tuning_out_of_range",
                                                 {"found", "minimum", "maximum", "unit"},
                                                 "'{found}' is outside {minimum} .. {maximum} {unit}"};
inline constexpr MessageText turn_out_of_range{
    "aero.turn_out_of_range",
    {"found"},
    "'{found}' is outside the range of turns; give a bank up to 80 deg or a radius from 1 m"};
inline constexpr MessageText turn_unit_invalid{
    "aero.turn_unit_invalid",
    {"found"},
    "'{found}' is neither a bank, as in \"30 deg\", nor a radius, as in \"80 m\""};
inline constexpr MessageText turning_bias{
    "aero.turning_bias",
    {"value"},
    "the value is {value}, and a symmetric aircraft has 0: the aircraft would turn without a control input"};
inline constexpr MessageText unnamed_control{"aero.unnamed_control", {"place"}, "the control of {place}"};
inline constexpr MessageText value_count_mismatch{"aero.value_count_mismatch",
                                                  {"expected", "names", "found"},
                                                  "expected {expected} numbers for '{names}'; found {found}"};
inline constexpr MessageText value_not_positive{
    "aero.value_not_positive",
    {"found", "unit"},
    "{found}{unit} is not above 0; the aircraft model requires a positive value"};
inline constexpr MessageText waypoint_position_invalid{
    "aero.waypoint_position_invalid", {"found"}, "w: expected three numbers in brackets; found '{found}'"};
inline constexpr MessageText wing_dimensions_inconsistent{
    "aero.wing_dimensions_inconsistent",
    {"ratio"},
    "chord times span is {ratio} of the area; the same wing has 0.7 to 1.5. One of the three is wrong or in "
    "another unit"};
inline constexpr MessageText wing_loading_unusual{
    "aero.wing_loading_unusual",
    {"loading", "hint"},
    "the wing loading is {loading} kg/m2; small aircraft have 1 to 60. {hint}"};
inline constexpr MessageText wing_missing{"aero.wing_missing",
                                          "surfaces: an aircraft requires at least a wing"};
inline constexpr MessageText wing_sections_missing{"aero.wing_sections_missing", "the wing has no sections"};
inline constexpr MessageText wing_stalls{"aero.wing_stalls",
                                         {"required", "maximum", "alpha", "hint", "place"},
                                         "the wing stalls: the flight requires CL {required}, and the "
                                         "maximum is {maximum} at {alpha}{hint} ({place})"};
inline constexpr MessageText xflr5_trim_missing{
    "aero.xflr5_trim_missing",
    "XFLR5 found no angle without pitching moment, so the log has no derivatives. Give the aircraft a "
    "trimmed attitude (centre of gravity, tail setting) and run the stability analysis again"};
inline constexpr MessageText yaw_power_low{
    "aero.yaw_power_low",
    {"sideslip"},
    "full rudder holds only {sideslip} of sideslip; 5 deg or more are usual"};
inline constexpr MessageText zero_lift_unusual{
    "aero.zero_lift_unusual",
    {"lift_coefficient", "alpha", "corrected"},
    "CL_0 is {lift_coefficient}: the angle of zero lift is {alpha}; the usual range is -5 to 0 deg. The "
    "value may be CL at the analysed angle, as tools print it. CL_0 is CL - CL_alpha alpha; for an analysis "
    "at 3 deg it would be {corrected}"};

}  // namespace fulmar::aero_messages

// SPDX-License-Identifier: BSD-3-Clause
// One reader per kind of file. The kind is recognised by the content, never by the ending.
#pragma once
#include <functional>

#include "tools/fulmar_aero/import/lines.hpp"

namespace fulmar::aero::imports {

struct ReadOptions {
  double length_m = 0;  ///< unit of length for files that do not state theirs; 0: a metre, unless known
};

// Each throws core::Error with file and line.
Input read_avl_derivatives(const Lines& lines, const ReadOptions& options);  ///< .st and .sb
bool is_avl_mrf(const Lines& lines);
Lines avl_plain_of_mrf(const Lines& lines);  ///< the same derivatives in the other printed form
Input read_avl_masses(const Lines& lines);   ///< .mass
Input read_avl_run(const Lines& lines);      ///< .run
Input read_avl_modes(const Lines& lines);    ///< .eig
Input read_xflr5_log(const Lines& lines);
Input read_xflr5_polar(const Lines& lines);  ///< of a plane, as text
Input read_xflr5_xml(const Lines& lines);    ///< plane or polar
Input read_vspaero_stab(const Lines& lines, const ReadOptions& options);
Input read_vspaero_flt(const Lines& lines);
Input read_vspaero_polar(const Lines& lines);
Input read_vspaero_history(const Lines& lines);
Input read_vspaero_setup(const Lines& lines);  ///< .vspaero
Input read_vsp_masses(const Lines& lines, const ReadOptions& options);
Input read_vsp_drag(const Lines& lines);                                 ///< the parasite drag tool's CSV
Input read_vsp_results(const Lines& lines, const ReadOptions& options);  ///< "Results_Name,..." blocks

/// The length in m of `Lunit` in a .mass or of the units in a .run; no value for another file.
std::optional<double> length_in(const Lines& lines);

/// Recognises and reads a file; throws core::Error with the known kinds for an unknown one.
Input read_any(const Lines& lines, const ReadOptions& options);

}  // namespace fulmar::aero::imports

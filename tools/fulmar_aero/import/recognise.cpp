// SPDX-License-Identifier: BSD-3-Clause
// Recognises the kind of a file by its content.
#include "tools/fulmar_aero/import/messages.hpp"
#include "tools/fulmar_aero/import/readers.hpp"

namespace fulmar::aero::imports {
namespace {

Input unused(const Lines& lines, const std::string& what, const std::string& why) {
  Input input;
  input.file = lines.file;
  input.what = what;
  input.unused = why;
  return input;
}

/// AVL's geometry has a heading of numbers under its title, and SURFACE somewhere.
bool avl_geometry(const Lines& lines) {
  for (const std::string& text : lines.all)
    if (const std::string word = lower(trimmed(text));
        begins(word, "surf") && word.find('=') == std::string::npos)
      return lines.find("SECTION") || lines.find("section");
  return false;
}

bool avl_masses(const Lines& lines) {
  if (lines.has("Lunit") || lines.has("Munit")) return true;
  bool header = false;
  for (const std::string& text : lines.all) {
    const std::string word = lower(trimmed(text));
    if (begins(word, "#") && word.find("mass") != std::string::npos && word.find("ixx") != std::string::npos)
      header = true;
  }
  return header;
}

}  // namespace

namespace {

Input read_known(const Lines& lines, const ReadOptions& options) {
  const auto has = [&](const char* text) { return lines.has(text); };
  // AVL
  if (is_avl_mrf(lines)) return read_avl_derivatives(avl_plain_of_mrf(lines), options);
  if (lines.has("VERSION 1.0") && (has("| # surfaces") || has("| surfaces") || has("| # bodies")))
    return unused(lines, "AVL's machine-readable forces",
                  aero_messages::total_derivatives_missing("ST, SB or SM"));
  if (has("Vortex Lattice Output")) return read_avl_derivatives(lines, options);
  if (has("Run case") && has("->") && has("X_cg")) return read_avl_run(lines);
  if (has("Run case") && has("Eigenvalue")) return read_avl_modes(lines);
  if (has("Control Hinge Moments")) return unused(lines, "AVL hinge moments", "an airframe has none");
  if (has("Surface Forces") || has("Strip Forces") || has("Element Forces") || has("Shear/q"))
    return unused(lines, "AVL forces of surfaces and strips", aero_messages::total_derivatives_missing("ST"));
  if (has(" the ") && has(" psi ") && has("|"))
    return unused(lines, "AVL system matrix", "the eigenvalues (.eig) say the same");
  // XFLR5
  if (has("Launching Analysis") || has("Longitudinal derivatives")) return read_xflr5_log(lines);
  if (has("<explane") || has("<Plane_Polar")) return read_xflr5_xml(lines);
  if (has("Plane name") && has("Polar name")) return read_xflr5_polar(lines);
  if (has("Calculated polar for"))
    return unused(lines, "polar of an airfoil", aero_messages::polar_of_airfoil());
  // OpenVSP
  if (has("Results_Name,")) return read_vsp_results(lines, options);
  if (has("Solver Case") || (has("Sref_") && has("Iter "))) return read_vspaero_history(lines);
  if (has("Sref_") || (has("Base Aero") && has("CFx")) || has("Base_Aero"))
    return read_vspaero_stab(lines, options);
  if (has("MACH_o:")) return read_vspaero_flt(lines);
  if (has("NumberOfControlGroups") || (has("WakeIters") && has("Sref"))) return read_vspaero_setup(lines);
  if (has("Beta") && has("Mach") && has("AoA") && has("CDtot")) return read_vspaero_polar(lines);
  if (has("PARASITE DRAG")) return read_vsp_drag(lines);
  if (has("Total Mass")) return read_vsp_masses(lines, options);
  if (avl_masses(lines)) return read_avl_masses(lines);
  if (avl_geometry(lines))
    return unused(lines, "AVL geometry",
                  "it is a drawing; `fulmar aero vlm` or AVL computes derivatives from it");
  throw core::Error(aero_messages::format_unknown(lines.file));
}

}  // namespace

Input read_any(const Lines& lines, const ReadOptions& options) {
  Input input = read_known(lines, options);
  // all of these tools end the last line
  if (!lines.text.empty() && lines.text.back() != '\n' && input.unused.empty())
    input.doubts.push_back("its last line has no end: is it cut off?");
  return input;
}

}  // namespace fulmar::aero::imports

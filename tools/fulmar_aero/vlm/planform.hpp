// SPDX-License-Identifier: BSD-3-Clause
// Surfaces from files of other programs. Unknown content is rejected with file:line, never left out.
#pragma once
#include <string>
#include <vector>

#include "tools/fulmar_aero/vlm/geometry.hpp"

namespace fulmar::aero {

/// Adds airfoils, surfaces with their controls, and the reference quantities of AVL's geometry file (AVL 3.40
/// user primer), or surfaces, sheets and point masses of a plane that XFLR5 6 exported as XML. `path` is
/// opened; messages name it `name`. Throws core::Error.
void add_planform(const std::string& path, const std::string& name, Geometry& geometry);
void add_avl(const std::string& path, const std::string& name, Geometry& geometry);
void add_xflr5(const std::string& path, const std::string& name, Geometry& geometry);

/// The mean line of a coordinate file in Selig's order: from the trailing edge over the upper side to the
/// trailing edge.
void read_camber(const std::string& path, const std::string& name, Airfoil& airfoil);

/// Shape by `naca` or a coordinate file; equal ones are one airfoil. Returns its name.
Text<32> add_airfoil(Geometry& geometry, const Airfoil& airfoil, const std::string& where);

}  // namespace fulmar::aero

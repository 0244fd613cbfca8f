// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_aero/vlm/span_load.hpp"

#include <algorithm>
#include <cmath>

namespace fulmar::aero {
namespace {

bool is_fin(const Strip& s) { return std::abs(s.b.y() - s.a.y()) < 0.3 * s.width; }

/// Maximum lift coefficient of the section, interpolated between its two airfoils; that of a flat plate
/// without one.
double section_cl_max(const Geometry& g, const Strip& s) {
  const auto of = [&](int i) { return i < 0 ? 0.8 : g.airfoils[std::size_t(i)].cl_max_ratio; };
  return (1 - s.share) * of(s.airfoil_in) + s.share * of(s.airfoil_out);
}

/// Length of the chord at an edge of a strip, from the adjacent sections.
double chord_at(const LiftingSurface& surface, const Eigen::Vector3d& edge) {
  const double y = std::abs(edge.y()), z = edge.z() - surface.z_m;
  double best = 1e300, chord = 0;
  for (std::size_t i = 1; i < surface.sections.size(); ++i) {
    const WingSection &in = surface.sections[i - 1], &out = surface.sections[i];
    const double to_in = std::hypot(y - std::abs(in.y_m), z - in.z_m),
                 to_out = std::hypot(y - std::abs(out.y_m), z - out.z_m);
    const double length = std::hypot(out.y_m - in.y_m, out.z_m - in.z_m);
    if (to_in + to_out - length >= best) continue;
    best = to_in + to_out - length;
    chord = in.chord_m + to_in / (to_in + to_out) * (out.chord_m - in.chord_m);
  }
  return chord;
}

}  // namespace

std::vector<SurfaceLoad> span_loads(const GeometryFile& file, const Aircraft& aircraft) {
  const Geometry& g = *file.geometry;
  const Lattice lattice = lattice_of(g);
  const Vlm vlm(lattice, g.reference, aircraft.mass.centre, aircraft.alpha_rad);
  const Eigen::VectorXd cruise = vlm.strip_lift({.alpha = aircraft.alpha_rad}),
                        stall = vlm.strip_lift({.alpha = aircraft.airframe.wing.stall_alpha_rad});
  std::vector<SurfaceLoad> all(g.surfaces.size());
  for (std::size_t i = 0; i < lattice.strips.size(); ++i) {
    const Strip& s = lattice.strips[i];
    if (is_fin(s)) continue;
    all[std::size_t(s.surface)].stations.push_back(
        {s.mid.y(), s.chord, cruise[Eigen::Index(i)], stall[Eigen::Index(i)], section_cl_max(g, s)});
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i].name = std::string(g.surfaces[i].name.view());
    std::sort(all[i].stations.begin(), all[i].stations.end(),
              [](const LoadStation& a, const LoadStation& b) { return a.y_m < b.y_m; });
  }
  std::erase_if(all, [](const SurfaceLoad& load) { return load.stations.empty(); });
  return all;
}

std::vector<PlaneLine> outlines(const Geometry& g) {
  std::vector<PlaneLine> all;
  for (const LiftingSurface& surface : g.surfaces)
    for (const double side : {1.0, -1.0}) {
      if (side < 0 && !surface.mirror) continue;
      PlaneLine line;
      for (const WingSection& s : surface.sections)
        line.places.emplace_back(surface.x_m + s.x_m, side * s.y_m);
      for (std::size_t i = surface.sections.size(); i-- > 0;) {
        const WingSection& s = surface.sections[i];
        line.places.emplace_back(surface.x_m + s.x_m + s.chord_m, side * s.y_m);
      }
      all.push_back(line);
    }
  return all;
}

std::vector<PlaneLine> lattice_lines(const Geometry& g) {
  const Lattice lattice = lattice_of(g);
  std::vector<PlaneLine> all;
  for (const Panel& p : lattice.panels) all.push_back({{p.a.head<2>(), p.b.head<2>()}});
  for (const Strip& s : lattice.strips)
    for (const Eigen::Vector3d& edge : {s.a, s.b}) {
      const double chord = chord_at(g.surfaces[std::size_t(s.surface)], edge);
      all.push_back({{edge.head<2>(), {edge.x() - chord, edge.y()}}});
    }
  return all;
}

}  // namespace fulmar::aero

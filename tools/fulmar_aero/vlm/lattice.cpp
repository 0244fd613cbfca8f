// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_aero/vlm/lattice.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace fulmar::aero {
namespace {

using Eigen::Vector3d;

/// Borders, vortices and control points over the chord, 0 to 1. Cosine: equal steps of an angle, in which the
/// vortex is a quarter and the control point three quarters of a panel behind its border; so one panel has
/// them at 1/4 and 3/4.
struct Chordwise {
  std::vector<double> border, vortex, control;
};
Chordwise chordwise(int n, Spacing spacing) {
  Chordwise out;
  const auto cosine = [](double angle) { return 0.5 * (1 - std::cos(angle)); };
  const double step = pi / (4 * n + 2);
  for (int i = 0; i < n; ++i) {
    if (spacing == Spacing::uniform) {
      out.border.push_back(double(i) / n);
      out.vortex.push_back((i + 0.25) / n);
      out.control.push_back((i + 0.75) / n);
    } else {
      const double begin = (4 * i + 1) * step;
      out.border.push_back(i == 0 ? 0 : cosine(begin));
      out.vortex.push_back(cosine(begin + step));
      out.control.push_back(cosine(begin + 3 * step));
    }
  }
  out.border.push_back(1);
  return out;
}

/// Parameter of the spanwise spacing: strips are equal steps of it.
double angle_of(double part, Spacing spacing) {
  part = std::clamp(part, 0.0, 1.0);
  if (spacing == Spacing::uniform) return part;
  return spacing == Spacing::cosine ? std::acos(1 - 2 * part) / pi : std::asin(part) * 2 / pi;
}
double part_of(double angle, Spacing spacing) {
  if (spacing == Spacing::uniform) return angle;
  return spacing == Spacing::cosine ? 0.5 * (1 - std::cos(pi * angle)) : std::sin(0.5 * pi * angle);
}

/// One place along the span.
struct Station {
  Vector3d lead;
  double chord, twist, share;
  std::size_t inner;  ///< the section before it
};

class SurfaceMesh {
 public:
  SurfaceMesh(const Geometry& g, int index, double density)
      : geometry_(g), surface_(g.surfaces[std::size_t(index)]), index_(index) {
    const auto many = [&](int n) { return std::max(1, int(std::lround(n * density))); };
    chord_ = chordwise(many(surface_.chordwise), surface_.chord_spacing);
    along_.push_back(0);
    for (std::size_t i = 1; i < surface_.sections.size(); ++i)
      along_.push_back(along_.back() + std::hypot(surface_.sections[i].y_m - surface_.sections[i - 1].y_m,
                                                  surface_.sections[i].z_m - surface_.sections[i - 1].z_m));
    strips_ = many(surface_.spanwise);
  }

  void add(Lattice& lattice) const {
    std::vector<double> breaks = along_;
    for (const ControlSurface& c : surface_.controls)
      for (const double at : {c.from_m, c.to_m}) breaks.push_back(std::clamp(at, 0.0, along_.back()));
    std::sort(breaks.begin(), breaks.end());
    const Spacing spacing = surface_.span_spacing;
    for (std::size_t k = 1; k < breaks.size(); ++k) {
      if (breaks[k] - breaks[k - 1] < 1e-6 * along_.back()) continue;
      const double from = angle_of(breaks[k - 1] / along_.back(), spacing),
                   to = angle_of(breaks[k] / along_.back(), spacing);
      const int n = std::max(1, int(std::lround(strips_ * (to - from))));
      const auto place = [&](double i) {
        return along_.back() * part_of(from + (to - from) * i / n, spacing);
      };
      for (int i = 0; i < n; ++i) {
        add_strip(lattice, place(i), place(i + 0.5), place(i + 1), false);
        if (surface_.mirror) add_strip(lattice, place(i), place(i + 0.5), place(i + 1), true);
      }
    }
  }

 private:
  Station station(double s, double within) const {
    std::size_t i = 0;  // the interval in which `within` lies
    while (i + 2 < along_.size() && along_[i + 1] <= within) ++i;
    const WingSection &in = surface_.sections[i], &out = surface_.sections[i + 1];
    const double t = (s - along_[i]) / (along_[i + 1] - along_[i]);
    const auto mix = [t](double x, double y) { return x + t * (y - x); };
    return {{surface_.x_m + mix(in.x_m, out.x_m), mix(in.y_m, out.y_m), surface_.z_m + mix(in.z_m, out.z_m)},
            mix(in.chord_m, out.chord_m),
            surface_.incidence_rad + mix(in.twist_rad, out.twist_rad),
            t,
            i};
  }

  int airfoil(const WingSection& section) const {
    for (std::size_t i = 0; i < geometry_.airfoils.size(); ++i)
      if (geometry_.airfoils[i].name == section.airfoil) return int(i);
    return -1;
  }

  double slope(const Strip& strip, double x) const {
    const auto of = [&](int i) { return i < 0 ? 0 : camber_slope(geometry_.airfoils[std::size_t(i)], x); };
    return (1 - strip.share) * of(strip.airfoil_in) + strip.share * of(strip.airfoil_out);
  }

  void add_strip(Lattice& lattice, double s0, double s, double s1, bool left) const {
    const Station begin = station(s0, s), mid = station(s, s), end = station(s1, s);
    const auto at = [left](const Station& st, double part) {
      return Vector3d(st.lead.x() + part * st.chord, left ? -st.lead.y() : st.lead.y(), st.lead.z());
    };
    // positive circulation is from left to right, on a fin from below to above, so the left half is reversed
    const Station &first = left ? end : begin, &last = left ? begin : end;
    Strip strip;
    strip.a = at(first, 1);
    strip.b = at(last, 1);
    strip.mid = at(mid, 1);
    strip.chord = mid.chord;
    strip.width = std::hypot(strip.b.y() - strip.a.y(), strip.b.z() - strip.a.z());
    strip.surface = index_;
    strip.share = mid.share;
    strip.airfoil_in = airfoil(surface_.sections[mid.inner]);
    strip.airfoil_out = airfoil(surface_.sections[mid.inner + 1]);
    const int number = int(lattice.strips.size());
    lattice.strips.push_back(strip);
    for (std::size_t i = 0; i < chord_.vortex.size(); ++i) {
      Panel p;
      p.a = at(first, chord_.vortex[i]);
      p.b = at(last, chord_.vortex[i]);
      p.centre = at(mid, chord_.vortex[i]);
      p.control = at(mid, chord_.control[i]);
      p.edge_a = strip.a.x();
      p.edge_b = strip.b.x();
      p.strip = number;
      p.surface = index_;
      const Vector3d span = (p.b - p.a).normalized();
      const Vector3d up = Vector3d::UnitX().cross(Vector3d(0, span.y(), span.z()).normalized());
      const double angle = mid.twist - std::atan(slope(strip, chord_.control[i]));
      p.normal = (std::cos(angle) * Vector3d::UnitX() - std::sin(angle) * up).cross(span).normalized();
      for (Vector3d& turned : p.turned) turned.setZero();
      for (const ControlSurface& c : surface_.controls)
        if (s > c.from_m && s < c.to_m) turn(lattice, p, c, i, begin, end, left);
      lattice.panels.push_back(p);
    }
  }

  /// A panel that the hinge divides turns by the part behind the hinge.
  void turn(Lattice& lattice, Panel& p, const ControlSurface& c, std::size_t i, const Station& begin,
            const Station& end, bool left) const {
    const double from = chord_.border[i], to = chord_.border[i + 1];
    const double part = std::clamp((to - c.hinge_frac) / (to - from), 0.0, 1.0);
    Vector3d hinge = end.lead - begin.lead + Vector3d(c.hinge_frac * (end.chord - begin.chord), 0, 0);
    if (left) hinge = Vector3d(-hinge.x(), hinge.y(), -hinge.z());  // mirrored and reversed
    // the trailing edge moves along -normal
    const Vector3d down = part * hinge.normalized().cross(p.normal);
    const auto sign = [](double x) { return x < 0 ? -1.0 : 1.0; };
    const double lowers = sign(p.normal.z()), to_left = sign(p.normal.y());
    const auto put = [&](Control control, double gain) {
      p.turned[control] += gain * down;
      lattice.has[control] = true;
    };
    switch (c.drives) {
      case Drives::aileron: put(to_aileron, left ? lowers : -lowers); break;
      case Drives::elevator: put(to_elevator, lowers); break;
      case Drives::rudder: put(to_rudder, to_left); break;
      case Drives::flap: put(to_flap, lowers); break;
      case Drives::elevons:
        put(to_elevator, lowers);
        put(to_aileron, left ? lowers : -lowers);
        break;
      case Drives::v_tail:
        put(to_elevator, lowers);
        put(to_rudder, to_left);
        break;
    }
  }

  const Geometry& geometry_;
  const LiftingSurface& surface_;
  int index_;
  Chordwise chord_;
  std::vector<double> along_;
  int strips_ = 1;
};

}  // namespace

Lattice lattice_of(const Geometry& geometry, double density) {
  Lattice lattice;
  for (std::size_t i = 0; i < geometry.surfaces.size(); ++i)
    SurfaceMesh(geometry, int(i), density).add(lattice);
  return lattice;
}

}  // namespace fulmar::aero

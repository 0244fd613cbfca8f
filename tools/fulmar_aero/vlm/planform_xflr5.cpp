// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/graph/yaml.hpp"
#include "core/types/text.hpp"
#include "tools/fulmar_aero/vlm/messages.hpp"
#include "tools/fulmar_aero/vlm/planform.hpp"
#include "tools/fulmar_aero/words.hpp"

namespace fulmar::aero {
namespace {

/// An element of XFLR5's XML; its attributes are not used.
struct Element {
  std::string tag, text;
  int line = 1;
  std::vector<Element> inside;

  const Element* find(const char* name) const {
    for (const Element& e : inside)
      if (e.tag == name) return &e;
    return nullptr;
  }
};

class XmlReader {
 public:
  XmlReader(const std::string& text, const std::string& name) : text_(text), name_(name) {}

  /// Reads the content up to the end tag of `out`.
  void fill(Element& out, int depth = 0) {
    if (depth > 20) fail(aero_messages::plane_nesting_excessive());
    for (;;) {
      const std::size_t open = text_.find('<', at_);
      if (open == std::string::npos) {
        if (!out.tag.empty()) fail(aero_messages::plane_element_open(out.tag, out.line));
        return;
      }
      out.text += text_.substr(at_, open - at_);
      move_to(open);
      const bool comment = text_.compare(open, 4, "<!--") == 0;
      const std::size_t close = comment ? text_.find("-->", open) : text_.find('>', open);
      if (close == std::string::npos) fail(aero_messages::bracket_not_closed());
      const std::string tag = text_.substr(open + 1, close - open - 1);
      move_to(close + (comment ? 3 : 1));
      if (tag.empty() || tag[0] == '?' || tag[0] == '!') continue;
      if (tag[0] == '/') {
        if (tag.substr(1) != out.tag) fail("</" + tag.substr(1) + "> ends <" + out.tag + ">");
        return;
      }
      Element one;
      one.tag = tag.substr(0, tag.find_first_of(" \t\r\n/"));
      one.line = line_;
      if (tag.back() != '/') fill(one, depth + 1);
      out.inside.push_back(std::move(one));
    }
  }

 private:
  void move_to(std::size_t at) {
    line_ += int(std::count(text_.begin() + std::ptrdiff_t(at_), text_.begin() + std::ptrdiff_t(at), '\n'));
    at_ = at;
  }
  [[noreturn]] void fail(const Diagnostic& sentence) const {
    throw core::Error(located(core::Where{name_, line_}, sentence));
  }
  const std::string& text_;
  std::string name_;
  std::size_t at_ = 0;
  int line_ = 1;
};

class Xflr5Plane {
 public:
  Xflr5Plane(const std::string& name, Geometry& g) : name_(name), geometry_(g) {}

  void read(const Element& document) {
    const Element* const root = document.find("explane");
    const Element* const plane = root ? root->find("Plane") : nullptr;
    if (!plane) throw core::Error(located(name_, aero_messages::plane_missing()));
    if (const Element* const units = root->find("Units")) {
      metre_ = number(*units, "length_unit_to_meter", 1);
      kilogram_ = number(*units, "mass_unit_to_kg", 1);
    }
    if (word(*plane, "has_body") == "true" && geometry_.bodies.empty())
      fail(*plane, aero_messages::plane_body_unsupported());
    if (const Element* const inertia = plane->find("Inertia")) add_masses(*inertia);
    for (const Element& e : plane->inside)
      if (e.tag == "wing") add_wing(e);
  }

 private:
  [[noreturn]] void fail(const Element& at, const Diagnostic& sentence) const {
    throw core::Error(located(core::Where{name_, at.line}, sentence));
  }
  static std::string word(const Element& in, const char* tag) {
    const Element* const e = in.find(tag);
    return e ? std::string(core::trimmed(e->text)) : "";
  }
  double number(const Element& in, const char* tag, double missing) const {
    const Element* const e = in.find(tag);
    if (!e) {
      if (std::isnan(missing)) fail(in, aero_messages::element_missing(in.tag, tag));
      return missing;
    }
    return numbers(*e, 1)[0];
  }
  std::vector<double> numbers(const Element& e, std::size_t n) const {
    std::string text = e.text;
    std::replace(text.begin(), text.end(), ',', ' ');
    std::istringstream in(text);
    std::vector<double> out;
    for (double x = 0; in >> x;) out.push_back(x);
    if (out.size() != n || !in.eof())
      fail(e, aero_messages::element_numbers_invalid(e.tag, core::trimmed(e.text), n,
                                                     n == 1 ? " number" : " numbers"));
    return out;
  }

  void add_masses(const Element& inertia) {
    for (const Element& e : inertia.inside) {
      if (e.tag != "Point_Mass") continue;
      const Element* const at = e.find("coordinates");
      if (!at) fail(e, aero_messages::point_mass_unplaced());
      const auto x = numbers(*at, 3);
      MassPart m;
      m.name = std::string_view(word(e, "Tag"));
      m.mass_kg = kilogram_ * number(e, "Mass", std::nan(""));
      m.x_m = metre_ * x[0];
      m.y_m = metre_ * x[1];
      m.z_m = metre_ * x[2];
      if (!geometry_.masses.push_back(m)) fail(e, aero_messages::too_many_masses());
    }
  }

  void add_wing(const Element& e) {
    LiftingSurface s;
    s.name = std::string_view(word(e, "Name"));
    const bool fin = word(e, "isFin") == "true", two = word(e, "isDoubleFin") == "true";
    if (word(e, "isSymFin") == "true") fail(e, aero_messages::symmetric_fin_unsupported());
    s.mirror = fin ? two : word(e, "Symetric") == "true";
    if (!fin && !s.mirror) fail(e, aero_messages::asymmetric_wing_unsupported());
    const Element* const position = e.find("Position");
    const auto at = position ? numbers(*position, 3) : std::vector<double>{0, 0, 0};
    s.incidence_rad = fin ? 0 : number(e, "Tilt_angle", 0) * degree;
    if (const Element* const inertia = e.find("Inertia"))
      s.mass_kg = kilogram_ * number(*inertia, "Volume_Mass", 0);
    const Element* const sections = e.find("Sections");
    if (!sections) fail(e, aero_messages::wing_sections_missing());
    // y_position is along the surface; the dihedral of a section holds up to the next one
    double y = fin ? metre_ * at[1] : 0, z = 0, along = 0, dihedral = 0;
    int spanwise = 0;
    for (const Element& one : sections->inside) {
      if (one.tag != "Section") continue;
      const double next = metre_ * number(one, "y_position", std::nan("")), step = next - along;
      if (fin) {
        z += step;
      } else if (s.sections.size() > 0 || step > 0) {
        y += step * std::cos(dihedral);
        z += step * std::sin(dihedral);
      }
      along = next;
      dihedral = number(one, "Dihedral", 0) * degree;
      WingSection w;
      w.x_m = metre_ * (at[0] + number(one, "xOffset", 0));
      w.y_m = y;
      w.z_m = metre_ * at[2] + z;
      w.chord_m = metre_ * number(one, "Chord", std::nan(""));
      w.twist_rad = number(one, "Twist", 0) * degree;
      if (!(w.chord_m > 0)) fail(one, aero_messages::chord_not_positive(w.chord_m));
      w.airfoil = foil(one);
      if (!s.sections.push_back(w)) fail(one, aero_messages::too_many_sections());
      s.chordwise = std::clamp(int(number(one, "x_number_of_panels", 8)), 1, 40);
      spanwise += std::clamp(int(number(one, "y_number_of_panels", 5)), 1, 100);
    }
    s.spanwise = std::clamp(spanwise, 4, 200);
    if (!geometry_.surfaces.push_back(s)) fail(e, aero_messages::too_many_surfaces());
  }

  /// "NACA 2412" is known; any other shape must be in the drawing, under the same name.
  Text<32> foil(const Element& section) {
    const std::string name = word(section, "Right_Side_FoilName");
    if (name != word(section, "Left_Side_FoilName")) fail(section, aero_messages::airfoil_pair_unsupported());
    for (const Airfoil& one : geometry_.airfoils)
      if (one.name.view() == name) return one.name;
    Airfoil airfoil;
    airfoil.name = std::string_view(name);
    const std::string digits = name.rfind("NACA ", 0) == 0 ? name.substr(5) : "";
    if (digits.size() != 4 || digits.find_first_not_of("0123456789") != std::string::npos)
      fail(section, aero_messages::airfoil_missing(name));
    airfoil.naca = std::string_view(digits);
    airfoil.thickness_frac = std::max(0.01, std::stoi(digits.substr(2)) / 100.0);
    return add_airfoil(geometry_, airfoil, name_);
  }

  std::string name_;
  Geometry& geometry_;
  double metre_ = 1, kilogram_ = 1;
};

}  // namespace

void add_xflr5(const std::string& path, const std::string& name, Geometry& geometry) {
  const std::string all = core::read_source(path, name)->text;
  Element document;
  XmlReader(all, name).fill(document);
  Xflr5Plane(name, geometry).read(document);
}

}  // namespace fulmar::aero

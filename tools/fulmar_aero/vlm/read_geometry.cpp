// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/graph/record.hpp"
#include "core/graph/shipped.hpp"
#include "core/loader/table.hpp"
#include "core/types/text.hpp"
#include "fulmar/schema.hpp"
#include "tools/fulmar_aero/vlm/geometry.hpp"
#include "tools/fulmar_aero/vlm/messages.hpp"
#include "tools/fulmar_aero/vlm/planform.hpp"
#include "tools/fulmar_aero/words.hpp"

namespace fulmar::aero {
namespace {

std::string metres(double x) { return figures(x, 5) + " m"; }
std::string quoted(std::string_view text) { return "'" + std::string(text) + "'"; }

/// Rules beyond the types, each fault with its line.
class GeometryRules {
 public:
  GeometryRules(const GeometryFile& file, core::Report& report)
      : file_(file), g_(*file.geometry), report_(report) {}

  void check() {
    for (std::size_t i = 0; i < g_.airfoils.size(); ++i) airfoil(i);
    for (std::size_t i = 0; i < g_.surfaces.size(); ++i) surface(i);
    if (g_.surfaces.empty()) add(file_.where("surfaces", 0), aero_messages::wing_missing());
    if (report_.empty()) reference();
    if (report_.empty()) panels();
  }

 private:
  void add(const core::Where& where, Diagnostic message) { report_.add(where, std::move(message)); }

  void airfoil(std::size_t i) {
    const Airfoil& a = g_.airfoils[i];
    const std::string own = "airfoils[" + std::to_string(i) + "]";
    const core::Where where = file_.where("airfoils", i);
    for (std::size_t k = 0; k < i; ++k)
      if (g_.airfoils[k].name == a.name)
        add(where, located(own, aero_messages::name_repeated(a.name.view())));
    const int shapes =
        int(!a.naca.view().empty()) + int(a.alpha_zero_rad < 1e8) + int(!a.camber_x_frac.empty());
    if (shapes != 1) add(where, located(own, aero_messages::airfoil_shape_invalid(a.name.view(), shapes)));
    if (const std::string_view digits = a.naca.view();
        !digits.empty() &&
        (digits.size() != 4 || digits.find_first_not_of("0123456789") != std::string_view::npos))
      add(where, located(own + ".naca", aero_messages::naca_digits_invalid(digits)));
    if (a.camber_x_frac.size() != a.camber_z_frac.size() || a.camber_x_frac.size() == 1)
      add(where,
          located(own, aero_messages::camber_count_mismatch(a.camber_x_frac.size(), a.camber_z_frac.size())));
    if (a.alpha_zero_rad < 1e8 && std::abs(a.alpha_zero_rad) > 0.35)
      add(where, located(own + ".alpha_zero",
                         aero_messages::alpha_zero_out_of_range(core::number_text(a.alpha_zero_rad))));
  }

  void surface(std::size_t i) {
    const LiftingSurface& s = g_.surfaces[i];
    const std::string own = "surfaces[" + std::to_string(i) + "]";
    for (std::size_t k = 0; k < i; ++k)
      if (g_.surfaces[k].name == s.name)
        add(file_.where("surfaces", i), located(own + ".name", aero_messages::name_repeated(s.name.view())));
    if (s.sections.size() < 2)
      return add(file_.where("surfaces", i),
                 located(own, aero_messages::sections_too_few(s.name.view(), s.sections.size())));
    sections(i, own);
    controls(i, own);
  }

  void sections(std::size_t i, const std::string& own) {
    const LiftingSurface& s = g_.surfaces[i];
    double before_y = 0, before_z = 0;
    for (std::size_t k = 0; k < s.sections.size(); ++k) {
      const WingSection& now = s.sections[k];
      const core::Where where = file_.where("surfaces", i, "sections", k);
      const std::string path = own + ".sections[" + std::to_string(k) + "]";
      if (s.mirror && now.y_m < 0)
        add(where, located(path + ".y", aero_messages::section_on_left(metres(now.y_m))));
      if (!now.airfoil.view().empty() &&
          std::none_of(g_.airfoils.begin(), g_.airfoils.end(),
                       [&](const Airfoil& a) { return a.name == now.airfoil; })) {
        std::vector<std::string> names;
        for (const Airfoil& a : g_.airfoils) names.emplace_back(a.name.view());
        add(where,
            located(path + ".airfoil",
                    aero_messages::airfoil_unknown(
                        now.airfoil.view(), core::choices_text(std::string(now.airfoil.view()), names))));
      }
      if (k == 0) continue;
      const WingSection& last = s.sections[k - 1];
      const double dy = now.y_m - last.y_m, dz = now.z_m - last.z_m, length = std::hypot(dy, dz);
      if (length < 1e-6)
        add(where, located(path, aero_messages::section_repeated()));
      else if (k > 1 && dy * before_y + dz * before_z < -1e-6 * length)
        add(where, located(path, aero_messages::sections_crossing(metres(last.y_m), metres(now.y_m))));
      before_y = length < 1e-6 ? 0 : dy / length;
      before_z = length < 1e-6 ? 0 : dz / length;
    }
  }

  void controls(std::size_t i, const std::string& own) {
    const LiftingSurface& s = g_.surfaces[i];
    double span = 0, across = 0, up = 0;
    for (std::size_t k = 1; k < s.sections.size(); ++k) {
      const double dy = s.sections[k].y_m - s.sections[k - 1].y_m,
                   dz = s.sections[k].z_m - s.sections[k - 1].z_m;
      span += std::hypot(dy, dz);
      across += std::abs(dy);
      up += std::abs(dz);
    }
    for (std::size_t k = 0; k < s.controls.size(); ++k) {
      const ControlSurface& c = s.controls[k];
      const core::Where where = file_.where("surfaces", i, "controls", k);
      const std::string path = own + ".controls[" + std::to_string(k) + "]";
      if (!(c.from_m >= 0 && c.to_m <= span * (1 + 1e-3)))
        add(where, located(path, aero_messages::control_outside_surface(metres(c.from_m), metres(c.to_m),
                                                                        s.name.view(), metres(span))));
      else if (!(c.to_m > c.from_m))
        add(where, located(path, aero_messages::control_reversed(metres(c.to_m), metres(c.from_m))));
      for (std::size_t j = 0; j < k; ++j)
        if (c.from_m < s.controls[j].to_m - 1e-9 && s.controls[j].from_m < c.to_m - 1e-9)
          add(where, located(path, aero_messages::controls_overlap(
                                       metres(c.from_m), metres(c.to_m), j, metres(s.controls[j].from_m),
                                       metres(s.controls[j].to_m), s.name.view())));
      const bool pair =
          c.drives == Drives::aileron || c.drives == Drives::elevons || c.drives == Drives::v_tail;
      if (pair && !s.mirror)
        add(where, located(path + ".drives", aero_messages::control_mirror_missing(s.name.view())));
      const bool needs_across = c.drives != Drives::rudder,
                 needs_up = c.drives == Drives::rudder || c.drives == Drives::v_tail;
      if (needs_across && across < 0.05 * span)
        add(where, located(path + ".drives", aero_messages::surface_upright(s.name.view())));
      if (needs_up && up < 0.05 * span)
        add(where, located(path + ".drives", aero_messages::surface_flat(s.name.view())));
    }
  }

  /// The lattice is a full matrix of the panels, which needs memory and time.
  void panels() {
    constexpr std::int64_t most = 4000;
    std::int64_t sum = 0, largest = 0;
    std::size_t at = 0;
    for (std::size_t i = 0; i < g_.surfaces.size(); ++i) {
      const LiftingSurface& s = g_.surfaces[i];
      const std::int64_t own = std::int64_t{s.chordwise} * s.spanwise * (s.mirror ? 2 : 1);
      sum += own;
      if (own <= largest) continue;
      largest = own;
      at = i;
    }
    if (sum <= most) return;
    add(file_.where("surfaces", at),
        aero_messages::too_many_panels(sum, g_.surfaces[at].name.view(), largest, most));
  }

  /// Detects an error of a unit or of half and whole: coefficients would be those of an aircraft of another
  /// size.
  void reference() {
    double area = 0, span = 0;
    for (const LiftingSurface& s : g_.surfaces) {
      double own = 0, reach = 0;
      for (std::size_t k = 1; k < s.sections.size(); ++k)
        own += 0.5 * (s.sections[k].chord_m + s.sections[k - 1].chord_m) *
               std::abs(s.sections[k].y_m - s.sections[k - 1].y_m);
      for (const WingSection& w : s.sections) reach = std::max(reach, std::abs(w.y_m));
      area = std::max(area, s.mirror ? 2 * own : own);
      span = std::max(span, 2 * reach);
    }
    const core::Node::Entry* at = nullptr;
    for (const core::Node::Entry& entry : file_.root.entries)
      if (entry.key == "reference") at = &entry;
    const core::Where where = at ? at->where() : core::Where{file_.name, 0};
    const auto far = [](double said, double drawn) { return said < 0.6 * drawn || said > 1.7 * drawn; };
    if (far(g_.reference.area_m2, area))
      add(where,
          aero_messages::reference_area_mismatch(core::number_text(g_.reference.area_m2), figures(area, 5)));
    if (far(g_.reference.span_m, span))
      add(where, aero_messages::reference_span_mismatch(metres(g_.reference.span_m), metres(span)));
    if (far(g_.reference.chord_m * g_.reference.span_m, g_.reference.area_m2))
      add(where, aero_messages::reference_chord_mismatch(metres(g_.reference.chord_m),
                                                         metres(g_.reference.area_m2 / g_.reference.span_m)));
  }

  const GeometryFile& file_;
  const Geometry& g_;
  core::Report& report_;
};

/// Surfaces are in the drawing or in a planform file, not in both.
void complete(GeometryFile& file, core::Report& report) {
  Geometry& g = *file.geometry;
  const std::string planform(g.planform.view());
  const auto says = [&](const char* key) { return file.root.find(key) != nullptr; };
  const core::Where whole{file.name, 0};
  if (planform.empty()) {
    if (!says("surfaces")) report.add(whole, aero_messages::surfaces_missing());
    if (!says("reference")) report.add(whole, aero_messages::reference_missing());
    if (says("controls")) report.add(file.where("controls", 0), aero_messages::controls_misplaced());
    return;
  }
  const core::Where where = file.root.find("planform")->where();
  if (says("surfaces")) return report.add(where, aero_messages::surfaces_and_planform());
  const std::string elsewhere =
      core::named_file(std::filesystem::path(file.root.file->path).parent_path(), planform).string();
  if (std::error_code fault; !std::filesystem::is_regular_file(elsewhere, fault))
    return report.add(where, aero_messages::planform_missing(planform));
  const ReferenceQuantities own = g.reference;
  add_planform(elsewhere, planform, g);
  if (says("reference")) g.reference = own;
  if (!(g.reference.area_m2 > 0)) report.add(whole, aero_messages::reference_missing());
  for (std::size_t i = 0; i < g.controls.size(); ++i) {
    std::vector<std::string> names;
    LiftingSurface* found = nullptr;
    for (LiftingSurface& s : g.surfaces) {
      names.emplace_back(s.name.view());
      if (s.name == g.controls[i].surface) found = &s;
    }
    const std::string path = "controls[" + std::to_string(i) + "]";
    if (!found)
      report.add(file.where("controls", i),
                 aero_messages::surface_unknown(
                     path, quoted(g.controls[i].surface.view()),
                     core::choices_text(std::string(g.controls[i].surface.view()), names)));
    else if (!found->controls.push_back(g.controls[i].control))
      report.add(file.where("controls", i), located(path, aero_messages::too_many_controls()));
  }
}

}  // namespace

core::Where GeometryFile::where(const std::string& list, std::size_t i, const std::string& inner,
                                std::size_t k) const {
  core::Where at{name, 0};
  const core::Node* node = root.find(list);
  if (!node) return at;
  at = node->where();
  if (i >= node->items.size()) return at;
  at = node->items[i].where();
  if (const core::Node* const deep = inner.empty() ? nullptr : node->items[i].find(inner);
      deep && k < deep->items.size())
    at = deep->items[k].where();
  return at;
}

GeometryFile read_geometry_file(const std::string& name) {
  GeometryFile file;
  file.name = name;
  file.geometry = std::make_unique<Geometry>();
  core::Report report;
  file.root = core::parse_yaml(core::read_source(core::named_file({}, name), name), report);
  if (report.empty() && !file.root.is(core::Node::Kind::map))
    report.add({name, 0}, aero_messages::geometry_map_expected(core::found_words(file.root)));
  const auto type = core::copy_type(describe<Geometry>());
  if (report.empty())
    core::fill_record(*type, file.root, reinterpret_cast<std::byte*>(file.geometry.get()), "", report);
  if (report.empty())
    if (const std::vector<std::string> missing = core::missing_in_record(*type, file.root); !missing.empty())
      report.add({name, 0}, aero_messages::geometry_incomplete(core::join(missing)));
  if (report.empty()) complete(file, report);
  if (report.empty()) GeometryRules(file, report).check();
  report.throw_if_any();
  return file;
}

double camber_slope(const Airfoil& airfoil, double x) {
  if (const std::string_view digits = airfoil.naca.view(); !digits.empty()) {
    const double m = (digits[0] - '0') / 100.0, p = (digits[1] - '0') / 10.0;
    if (m == 0 || p == 0) return 0;
    return 2 * m * (p - x) / (x < p ? p * p : (1 - p) * (1 - p));
  }
  if (!airfoil.camber_x_frac.empty()) {
    std::size_t i = 1;
    while (i + 1 < airfoil.camber_x_frac.size() && airfoil.camber_x_frac[i] < x) ++i;
    return (airfoil.camber_z_frac[i] - airfoil.camber_z_frac[i - 1]) /
           (airfoil.camber_x_frac[i] - airfoil.camber_x_frac[i - 1]);
  }
  return airfoil.alpha_zero_rad < 1e8 ? std::tan(airfoil.alpha_zero_rad) : 0;
}

}  // namespace fulmar::aero

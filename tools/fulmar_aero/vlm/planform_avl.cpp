// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <sstream>

#include "core/error.hpp"
#include "core/graph/yaml.hpp"
#include "core/types/text.hpp"
#include "tools/fulmar_aero/vlm/messages.hpp"
#include "tools/fulmar_aero/vlm/planform.hpp"
#include "tools/fulmar_aero/words.hpp"

namespace fulmar::aero {
namespace {

struct AvlControl {
  std::string name;
  double gain = 1, hinge = 0, duplicate = 1;
  int line = 0;
};

class AvlFile {
 public:
  AvlFile(const std::string& path, const std::string& name, Geometry& g)
      : path_(path), name_(name), geometry_(g) {
    std::istringstream in(core::read_source(path, name)->text);
    std::string text;
    for (int number = 1; std::getline(in, text); ++number) {
      const std::string line(core::trimmed(text.substr(0, text.find_first_of("#!"))));
      if (!line.empty()) lines_.push_back({line, number});
    }
  }

  void read() {
    header();
    while (at_ < lines_.size()) {
      const std::string key = keyword();
      if (key == "SURF")
        begin_surface();
      else if (!surface_)
        fail(aero_messages::line_outside_surface(lines_[at_].text));
      else if (key == "SECT")
        add_section();
      else if (!sections_.empty() &&
               (key == "NACA" || key == "AFIL" || key == "CONT" || key == "CLAF" || key == "CDCL"))
        add_to_section(key);
      else
        add_to_surface(key);
    }
    end_surface();
  }

 private:
  struct Line {
    std::string text;
    int number;
  };

  [[noreturn]] void fail(const Diagnostic& sentence) const {
    const int number = lines_.empty() ? 0 : lines_[std::min(at_, lines_.size() - 1)].number;
    throw core::Error(located(core::Where{name_, number}, sentence));
  }
  /// Keywords differ in the first four letters, as in AVL.
  std::string keyword() const {
    std::string key = lines_[at_].text.substr(0, 4);
    for (char& c : key) c = char(std::toupper(static_cast<unsigned char>(c)));
    return key;
  }
  std::vector<double> numbers(std::size_t least, const char* what) {
    if (at_ >= lines_.size()) fail(aero_messages::planform_truncated(what));
    std::istringstream in(lines_[at_].text);
    std::vector<double> out;
    for (std::string word; in >> word;) {
      char* end = nullptr;
      const double value = std::strtod(word.c_str(), &end);
      if (*end || !std::isfinite(value)) break;
      out.push_back(value);
    }
    if (out.size() < least) fail(aero_messages::planform_numbers_missing(lines_[at_].text, least, what));
    ++at_;
    return out;
  }

  void header() {
    if (lines_.size() < 6) fail(aero_messages::avl_header_incomplete());
    at_ = 1;
    numbers(1, "the Mach number");
    if (const auto symmetry = numbers(3, "iYsym iZsym Zsym"); symmetry[0] != 0 || symmetry[1] != 0) {
      --at_;
      fail(aero_messages::symmetry_plane_unsupported());
    }
    const auto r = numbers(3, "Sref Cref Bref");
    geometry_.reference = {r[0], r[2], r[1]};
    numbers(3, "Xref Yref Zref");
    if (at_ < lines_.size() && !std::isalpha(static_cast<unsigned char>(lines_[at_].text[0])))
      numbers(1, "CDp");
  }

  static Spacing spacing(double code) {
    return std::abs(code) < 0.5 ? Spacing::uniform : code < -1.5 ? Spacing::tip : Spacing::cosine;
  }

  void begin_surface() {
    end_surface();
    if (++at_ >= lines_.size()) fail(aero_messages::surface_name_missing());
    LiftingSurface s;
    s.name = std::string_view(lines_[at_++].text);
    const auto n = numbers(2, "Nchord Cspace");
    s.chordwise = std::clamp(int(n[0]), 1, 40);
    s.chord_spacing = spacing(n[1]) == Spacing::uniform ? Spacing::uniform : Spacing::cosine;
    s.spanwise = n.size() > 2 ? std::clamp(int(n[2]), 1, 200) : 20;
    if (n.size() > 3) s.span_spacing = spacing(n[3]);
    if (!geometry_.surfaces.push_back(s)) fail(aero_messages::too_many_surfaces());
    surface_ = &geometry_.surfaces[geometry_.surfaces.size() - 1];
  }

  void add_to_surface(const std::string& key) {
    ++at_;
    if (key == "YDUP") {
      if (numbers(1, "Ydupl")[0] != 0) {
        --at_;
        fail(aero_messages::duplicate_plane_unsupported());
      }
      surface_->mirror = true;
    } else if (key == "ANGL") {
      surface_->incidence_rad = numbers(1, "dAinc")[0] * degree;
    } else if (key == "TRAN") {
      const auto d = numbers(3, "dX dY dZ");
      shift_ = {d[0], d[1], d[2]};
    } else if (key == "SCAL") {
      const auto d = numbers(3, "Xscale Yscale Zscale");
      scale_ = {d[0], d[1], d[2]};
    } else if (key == "COMP" || key == "INDE") {
      numbers(1, "the component");  // only affects the core of vortices
    } else {
      --at_;
      fail(aero_messages::planform_keyword_unsupported(lines_[at_].text));
    }
  }

  void add_section() {
    ++at_;
    const auto n = numbers(5, "Xle Yle Zle Chord Ainc");
    WingSection w;
    w.x_m = n[0] * scale_[0] + shift_[0];
    w.y_m = n[1] * scale_[1] + shift_[1];
    w.z_m = n[2] * scale_[2] + shift_[2];
    w.chord_m = n[3] * scale_[0];
    w.twist_rad = n[4] * degree;
    if (!(w.chord_m > 0)) {
      --at_;
      fail(aero_messages::section_chord_invalid(core::number_text(w.chord_m)));
    }
    if (!surface_->sections.push_back(w)) fail(aero_messages::too_many_sections());
    sections_.emplace_back();
    polars_.emplace_back();
  }

  void add_to_section(const std::string& key) {
    WingSection& w = surface_->sections[surface_->sections.size() - 1];
    if (key == "CONT") return add_control();
    ++at_;
    if (at_ >= lines_.size()) fail(aero_messages::keyword_value_missing(key));
    Airfoil& foil = polars_.back();
    if (key == "NACA") {
      foil.naca = std::string_view(lines_[at_].text);
      if (lines_[at_].text.size() != 4 ||
          lines_[at_].text.find_first_not_of("0123456789") != std::string::npos)
        fail(aero_messages::naca_digits_invalid(lines_[at_].text));
      foil.name = std::string_view("naca" + lines_[at_].text);
      foil.thickness_frac = std::max(0.01, std::stoi(lines_[at_].text.substr(2)) / 100.0);
      ++at_;
    } else if (key == "AFIL") {
      const std::string file = lines_[at_].text;
      read_camber((std::filesystem::path(path_).parent_path() / file).string(), file, foil);
      foil.name = std::string_view(std::filesystem::path(file).stem().string());
      ++at_;
    } else if (key == "CLAF") {
      if (std::abs(numbers(1, "CLaf")[0] - 1) > 1e-6) {
        --at_;
        fail(aero_messages::lift_slope_unsupported());
      }
    } else {
      const auto p = numbers(6, "CL1 CD1 CL2 CD2 CL3 CD3");
      foil.cd_min_ratio = p[3];
      foil.cl_at_cd_min_ratio = p[2];
      foil.cd_rise_ratio = std::max(
          0.0, 0.5 * ((p[1] - p[3]) / std::pow(p[0] - p[2], 2) + (p[5] - p[3]) / std::pow(p[4] - p[2], 2)));
    }
    w.airfoil = foil.name;
  }

  void add_control() {
    // either on the same line or on the next
    std::istringstream in(lines_[at_].text.find(' ') == std::string::npos && at_ + 1 < lines_.size()
                              ? lines_[++at_].text
                              : lines_[at_].text.substr(lines_[at_].text.find(' ')));
    AvlControl c;
    double x = 0, y = 0, z = 0;
    c.line = lines_[at_].number;
    if (!(in >> c.name >> c.gain >> c.hinge >> x >> y >> z >> c.duplicate))
      fail(aero_messages::control_incomplete());
    if (std::abs(std::abs(c.gain) - 1) > 1e-6)
      fail(aero_messages::control_gain_unsupported(c.name, core::number_text(c.gain)));
    if (!(c.hinge > 0 && c.hinge < 1))
      fail(aero_messages::control_hinge_unsupported(c.name, core::number_text(c.hinge)));
    drives(c);  // its name is known
    sections_.back().push_back(c);
    ++at_;
  }

  Drives drives(const AvlControl& c) const {
    std::string low;
    for (const char x : c.name) low += char(std::tolower(static_cast<unsigned char>(x)));
    const auto begins = [&](const char* word) { return low.rfind(word, 0) == 0; };
    if (begins("elevon")) return Drives::elevons;
    if (begins("ail")) return Drives::aileron;
    if (begins("elev")) return Drives::elevator;
    if (begins("rud")) return Drives::rudder;
    if (begins("flap")) return Drives::flap;
    throw core::Error(located(core::Where{name_, c.line}, aero_messages::control_name_unknown(c.name)));
  }

  /// The control of that name at an adjacent section.
  const AvlControl* partner(std::size_t i, int step, const AvlControl& c) const {
    const std::size_t at = i + std::size_t(step);  // before the first: beyond the last
    if (at >= sections_.size()) return nullptr;
    for (const AvlControl& other : sections_[at])
      if (other.name == c.name) return &other;
    return nullptr;
  }

  void end_surface() {
    if (!surface_) return;
    for (std::size_t i = 0; i < surface_->sections.size(); ++i)
      if (!polars_[i].name.view().empty())
        surface_->sections[i].airfoil = add_airfoil(geometry_, polars_[i], name_);
    double along = 0;
    for (std::size_t i = 0; i < surface_->sections.size(); ++i) {
      for (const AvlControl& c : sections_[i])
        if (!partner(i, 1, c) && !partner(i, -1, c))
          throw core::Error(
              located(core::Where{name_, c.line}, aero_messages::control_section_single(c.name)));
      if (i + 1 == surface_->sections.size()) break;
      const WingSection &in = surface_->sections[i], &out = surface_->sections[i + 1];
      const double end = along + std::hypot(out.y_m - in.y_m, out.z_m - in.z_m);
      for (const AvlControl& c : sections_[i])
        if (const AvlControl* const other = partner(i, 1, c))
          if (!surface_->controls.push_back({drives(c), along, end, 0.5 * (c.hinge + other->hinge)}))
            fail(aero_messages::too_many_control_parts());
      along = end;
    }
    surface_ = nullptr;
    sections_.clear();
    polars_.clear();
    shift_ = {0, 0, 0};
    scale_ = {1, 1, 1};
  }

  std::string path_, name_;
  Geometry& geometry_;
  std::vector<Line> lines_;
  std::size_t at_ = 0;
  LiftingSurface* surface_ = nullptr;
  std::vector<std::vector<AvlControl>> sections_;
  std::vector<Airfoil> polars_;
  std::array<double, 3> shift_{0, 0, 0}, scale_{1, 1, 1};
};

}  // namespace

void add_avl(const std::string& path, const std::string& name, Geometry& geometry) {
  AvlFile(path, name, geometry).read();
}

Text<32> add_airfoil(Geometry& geometry, const Airfoil& airfoil, const std::string& where) {
  for (const Airfoil& one : geometry.airfoils)
    if (one.name == airfoil.name) return one.name;  // an airfoil of that name in the drawing has priority
  if (!geometry.airfoils.push_back(airfoil))
    throw core::Error(located(where, aero_messages::too_many_airfoils()));
  return airfoil.name;
}

void read_camber(const std::string& path, const std::string& name, Airfoil& airfoil) {
  std::istringstream in;
  try {
    in.str(core::read_source(path, name)->text);
  } catch (const core::Error&) {
    throw core::Error(located(name, aero_messages::airfoil_not_readable()));
  }
  std::vector<std::array<double, 2>> points;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    std::istringstream words(line);
    double x = 0, z = 0;
    if (words >> x >> z && std::abs(x) < 1.1 && std::abs(z) < 1)
      points.push_back({x, z});
    else if (number > 1 && !core::trimmed(line).empty())
      throw core::Error(aero_messages::airfoil_point_invalid(name, number, line));
  }
  const auto nose =
      std::min_element(points.begin(), points.end(), [](auto& a, auto& b) { return a[0] < b[0]; });
  if (points.size() < 10 || nose == points.begin() || nose + 1 == points.end())
    throw core::Error(located(name, aero_messages::airfoil_order_invalid()));
  std::vector<std::array<double, 2>> top(points.begin(), nose + 1), bottom(nose, points.end());
  std::reverse(top.begin(), top.end());
  const auto height = [](const std::vector<std::array<double, 2>>& side, double x) {
    std::size_t i = 1;
    while (i + 1 < side.size() && side[i][0] < x) ++i;
    const double width = side[i][0] - side[i - 1][0];
    return width > 0 ? side[i - 1][1] + (x - side[i - 1][0]) / width * (side[i][1] - side[i - 1][1])
                     : side[i][1];
  };
  airfoil.thickness_frac = 0.001;
  for (int i = 0; i <= 20; ++i) {
    const double x = i / 20.0, up = height(top, x), low = height(bottom, x);
    airfoil.camber_x_frac.push_back(x);
    airfoil.camber_z_frac.push_back(0.5 * (up + low));
    airfoil.thickness_frac = std::max(airfoil.thickness_frac, std::abs(up - low));
  }
}

void add_planform(const std::string& path, const std::string& name, Geometry& geometry) {
  const std::string end = std::filesystem::path(name).extension().string();
  if (end == ".avl") return add_avl(path, name, geometry);
  if (end == ".xml") return add_xflr5(path, name, geometry);
  throw core::Error(located(name, aero_messages::planform_format_unsupported()));
}

}  // namespace fulmar::aero

// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_aero/import/compare_modes.hpp"

#include <algorithm>
#include <cmath>

#include "tools/fulmar_aero/flight_model.hpp"
#include "tools/fulmar_aero/mode_words.hpp"
#include "tools/fulmar_aero/words.hpp"

namespace fulmar::aero::imports {
namespace {

/// Height of the standard atmosphere with this density.
double height_of(double density) {
  double low = -2000, high = 15000;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (standard_air(middle).density_kgm3 > density ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

bool lateral(ModeKind kind) {
  return kind == ModeKind::dutch_roll || kind == ModeKind::roll || kind == ModeKind::spiral ||
         kind == ModeKind::roll_spiral;
}

/// The nearest remaining one, by distance over size; pairs to pairs, real ones to real ones.
std::optional<std::complex<double>> take_nearest(std::vector<std::complex<double>>& from,
                                                 const std::complex<double>& to) {
  std::size_t best = from.size();
  double least = 1e9;
  for (std::size_t i = 0; i < from.size(); ++i) {
    if ((from[i].imag() > 0) != (to.imag() > 0)) continue;
    const double distance = std::abs(from[i] - to) / std::abs(to);
    if (distance < least) {
      least = distance;
      best = i;
    }
  }
  if (best == from.size()) return {};
  const std::complex<double> value = from[best];
  from.erase(from.begin() + std::ptrdiff_t(best));
  return value;
}

/// Tolerance for a log without friction, and for AVL with its apparent mass. 0: only shown, as for a log with
/// another tool's derivatives. The damping of the phugoid depends on friction and thrust, which no log has.
double allowed(ModeKind kind, bool apparent_mass, bool same_file) {
  if (kind == ModeKind::phugoid || (!apparent_mass && !same_file)) return 0;
  if (!apparent_mass) return 0.01;
  if (kind == ModeKind::short_period || kind == ModeKind::dutch_roll) return 0.10;
  return kind == ModeKind::roll ? 0.20 : 0;
}

}  // namespace

ModeComparison compare_modes(const Imported& imported) {
  ModeComparison out;
  const PrintedModes& printed = imported.aircraft.modes;
  if (printed.empty()) return out;
  out.airspeed_mps = printed.airspeed_mps;
  if (!(printed.airspeed_mps > 0)) {
    out.fault = "the airspeed of the eigenvalues is not known; give the .run file of the same case";
    return out;
  }
  Airframe airframe = imported.file.airframe;
  // the drag of the analysis before any replacement: the flight of the analysis is compared
  airframe.aero.parasite_drag_ratio = imported.aircraft.converted_parasite;
  const AircraftModel model(airframe, height_of(printed.density_kgm3));
  const SteadyFlight level = fly(model, {printed.airspeed_mps});
  if (!level.found()) {
    out.fault =
        "there is no level flight at " + figures(printed.airspeed_mps, 4) + " m/s with what was imported";
    return out;
  }
  std::vector<std::complex<double>> longitudinal = printed.longitudinal, sideways = printed.lateral,
                                    any = printed.unsorted;
  std::vector<Mode> modes = modes_in(model, level);
  // the fast modes are matched first
  std::stable_sort(modes.begin(), modes.end(), [](const Mode& a, const Mode& b) {
    return std::abs(a.eigenvalue) > std::abs(b.eigenvalue);
  });
  const auto file_of = [](const std::string& place) { return place.substr(0, place.find(':')); };
  const bool same_file = file_of(imported.aircraft.c[pitch][t_alpha].from) == file_of(printed.from);
  for (const Mode& mode : modes) {
    std::vector<std::complex<double>>& from = !any.empty()         ? any
                                              : lateral(mode.kind) ? sideways
                                                                   : longitudinal;
    const auto tool = take_nearest(from, mode.eigenvalue);
    if (!tool) continue;
    ModePair pair{mode_name(mode.kind), *tool, mode.eigenvalue, 0,
                  allowed(mode.kind, printed.apparent_mass, same_file)};
    pair.off_ratio = printed.apparent_mass ? std::abs(std::abs(pair.own) / std::abs(pair.tool) - 1)
                                           : std::abs(pair.own - pair.tool) / std::abs(pair.tool);
    // a spiral near 0 is a small difference of large numbers, printed with five digits
    if (mode.kind == ModeKind::spiral && std::abs(pair.own - pair.tool) < 0.003) pair.max_ratio = 0;
    out.pairs.push_back(pair);
  }
  return out;
}

}  // namespace fulmar::aero::imports

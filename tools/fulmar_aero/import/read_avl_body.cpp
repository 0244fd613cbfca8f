// SPDX-License-Identifier: BSD-3-Clause
// AVL's mass table (.mass), run cases (.run) and eigenvalues (.eig).
#include <cmath>
#include <complex>

#include "tools/fulmar_aero/import/messages.hpp"
#include "tools/fulmar_aero/import/readers.hpp"

namespace fulmar::aero::imports {
namespace {

constexpr std::size_t avl_modes = 8;

struct MassUnits {
  double length = 1, mass = 1;
  bool said = false;
};

MassUnits units_of(const Lines& lines) {
  MassUnits units;
  for (std::size_t i = 0; i < lines.all.size(); ++i) {
    const std::string text = trimmed(lines.all[i]);
    for (const char* key : {"Lunit", "Munit"}) {
      if (!begins(text, key)) continue;
      const std::size_t equals = lines.all[i].find('=');
      if (equals == std::string::npos) refuse(lines.where(i), std::string(key) + ": expected '='");
      std::size_t end = 0;
      const double number = number_at(lines, i, equals + 1, key, &end);
      const std::vector<std::string> rest = words_of(lines.all[i].substr(end));
      const std::string unit = rest.empty() ? "" : rest[0];
      const bool length = std::string(key) == "Lunit";
      const std::optional<double> factor = length ? length_unit(unit) : mass_unit(unit);
      if (!factor)
        refuse(lines.where(i),
               fulmar::located(std::string(key), aero_messages::mass_file_unit_unknown(
                                                     unit, length ? "valid: m, cm, mm, in, ft"
                                                                  : "valid: kg, g, lb, oz, slug")));
      (length ? units.length : units.mass) = number * *factor;
      units.said = true;
    }
  }
  return units;
}

/// mass x y z Ixx Iyy Izz Ixy Ixz Iyz
using MassRow = std::array<double, 10>;

/// Factors or summands of a `*` or `+` line, for all rows below it.
void change_rows(const std::vector<double>& values, MassRow& row, double otherwise) {
  row.fill(otherwise);
  for (std::size_t k = 0; k < values.size() && k < row.size(); ++k) row[k] = values[k];
}

std::vector<MassRow> mass_rows(const Lines& lines) {
  std::vector<MassRow> rows;
  MassRow times, plus;
  times.fill(1);
  plus.fill(0);
  for (std::size_t i = 0; i < lines.all.size(); ++i) {
    const std::string text = trimmed(lines.all[i]);
    if (text.empty() || text[0] == '#' || text[0] == '!' || text.find('=') != std::string::npos) continue;
    const std::size_t begin = lines.all[i].find(text[0]);
    if (text[0] == '*') {
      change_rows(numbers_at(lines, i, begin + 1), times, 1);
      continue;
    }
    if (text[0] == '+' && (text.size() < 2 || text[1] == ' ')) {
      change_rows(numbers_at(lines, i, begin + 1), plus, 0);
      continue;
    }
    const std::vector<double> values = numbers_at(lines, i, begin);
    if (values.size() < 4) refuse(lines.where(i), aero_messages::mass_row_incomplete(values.size()));
    MassRow row{};
    for (std::size_t k = 0; k < row.size(); ++k)
      row[k] = (k < values.size() ? values[k] : 0) * times[k] + plus[k];
    rows.push_back(row);
  }
  return rows;
}

/// Together about their common centre of gravity: the parallel axis theorem.
Body sum_of(const std::vector<MassRow>& rows, const MassUnits& units, const std::string& from) {
  double mass = 0, x = 0, y = 0, z = 0;
  for (const MassRow& row : rows) {
    mass += row[0];
    x += row[0] * row[1];
    y += row[0] * row[2];
    z += row[0] * row[3];
  }
  x /= mass;
  y /= mass;
  z /= mass;
  double xx = 0, yy = 0, zz = 0, xz = 0;
  for (const MassRow& row : rows) {
    const double dx = row[1] - x, dy = row[2] - y, dz = row[3] - z;
    xx += row[4] + row[0] * (dy * dy + dz * dz);
    yy += row[5] + row[0] * (dx * dx + dz * dz);
    zz += row[6] + row[0] * (dx * dx + dy * dy);
    xz += row[8] + row[0] * dx * dz;  // both axes change sign (x aft, z up), so xz stays
  }
  const double inertia = units.mass * units.length * units.length;
  Body body;
  body.mass_kg = {mass * units.mass, from};
  body.xx = {xx * inertia, from};
  body.yy = {yy * inertia, from};
  body.zz = {zz * inertia, from};
  body.xz = {xz * inertia, from};
  body.cg_m = {x * units.length, y * units.length, z * units.length};
  body.has_cg = true;
  return body;
}

/// SI factor of "ft/s", "slug/ft^3", "slug-ft^2", the units behind the numbers of a .run.
double run_factor(const Lines& lines, const Pair& pair, const std::string& key) {
  std::optional<double> factor;
  const std::size_t slash = pair.unit.find('/');
  if (key == "velocity")
    factor = length_unit(pair.unit.substr(0, slash));
  else if (key == "density") {
    const std::optional<double> mass = mass_unit(pair.unit.substr(0, slash));
    const std::string volume = slash == std::string::npos ? "" : pair.unit.substr(slash + 1);
    const std::optional<double> length = length_unit(volume.substr(0, volume.find('^')));
    if (mass && length) factor = *mass / std::pow(*length, 3);
  } else if (key == "mass")
    factor = mass_unit(pair.unit);
  else if (begins(key, "I"))
    factor = inertia_unit(pair.unit);
  else
    factor = length_unit(pair.unit);
  if (!factor)
    refuse(lines.where(pair.line), fulmar::located(key, aero_messages::run_unit_unknown(pair.unit)));
  return *factor;
}

}  // namespace

std::optional<double> length_in(const Lines& lines) {
  if (lines.has("Lunit")) return units_of(lines).length;
  if (lines.has("Run case") && lines.has("X_cg")) {
    const Pairs pairs(lines, 0, lines.all.size(), "AVL");
    if (pairs.has("X_cg")) return length_unit(pairs.pair("X_cg").unit);
  }
  return {};
}

Input read_avl_masses(const Lines& lines) {
  Input input;
  input.file = lines.file;
  input.what = "AVL mass table";
  const MassUnits units = units_of(lines);
  const std::vector<MassRow> rows = mass_rows(lines);
  if (rows.empty()) refuse({lines.file, int(lines.all.size())}, aero_messages::mass_rows_missing());
  double mass = 0;
  for (const MassRow& row : rows) mass += row[0];
  if (!(mass > 0)) refuse({lines.file, 0}, aero_messages::mass_sum_not_positive(mass));
  input.body = sum_of(rows, units, lines.place(0, "mass table"));
  if (!units.said) input.notes.push_back("it does not say its units; taken as kg and m");
  return input;
}

Input read_avl_run(const Lines& lines) {
  Input input;
  input.file = lines.file;
  input.what = "AVL run case";
  std::size_t last = lines.all.size();
  if (const auto first = lines.find("Run case"))
    if (const auto second = lines.find("Run case", *first + 1)) {
      last = *second;
      input.notes.push_back("it has several run cases; the first is taken");
    }
  const Pairs pairs(lines, 0, last, "AVL");
  const auto in_si = [&](const char* key) {
    const Pair& pair = pairs.pair(key);
    return Value(pair.value * run_factor(lines, pair, key), lines.place(pair.line, key));
  };
  const double mass = pairs.value("mass").x;
  if (!(mass > 0) || pairs.value("Ixx").x <= 0 || !mass_unit(pairs.pair("mass").unit)) {
    input.unused = "it has no mass in units; AVL reads one with MASS and applies it with MSET";
    return input;
  }
  Body& body = input.body;
  body.mass_kg = in_si("mass");
  body.xx = in_si("Ixx");
  body.yy = in_si("Iyy");
  body.zz = in_si("Izz");
  body.xz = in_si("Izx");
  body.xz.x = -body.xz.x;  // the element of the matrix, not the integral of x z dm
  body.cg_m = {in_si("X_cg").x, in_si("Y_cg").x, in_si("Z_cg").x};
  body.has_cg = true;
  input.airspeed_mps = in_si("velocity").x;
  input.modes.airspeed_mps = input.airspeed_mps;
  input.modes.density_kgm3 = in_si("density").x;
  return input;
}

Input read_avl_modes(const Lines& lines) {
  Input input;
  input.file = lines.file;
  input.what = "AVL eigenvalues";
  std::optional<double> run;
  for (std::size_t i = 0; i < lines.all.size(); ++i) {
    if (trimmed(lines.all[i]).empty() || trimmed(lines.all[i])[0] == '#') continue;
    const std::vector<double> values = numbers_at(lines, i, 0);
    if (values.size() != 3)
      refuse(lines.where(i), aero_messages::eigenvalue_row_invalid(trimmed(lines.all[i])));
    if (run && values[0] != *run) break;
    run = values[0];
    if (values[2] >= 0) input.modes.unsorted.push_back({values[1], values[2]});
  }
  std::size_t all = 0;
  for (const std::complex<double>& one : input.modes.unsorted) all += one.imag() > 0 ? 2 : 1;
  if (all != avl_modes && all > 0)
    input.doubts.push_back("it has " + std::to_string(all) +
                           " eigenvalues of the first case, and AVL writes 8: "
                           "is it cut off?");
  input.modes.from = lines.place(0);
  input.modes.apparent_mass = true;
  if (input.modes.unsorted.empty()) input.unused = "it has no eigenvalues";
  return input;
}

}  // namespace fulmar::aero::imports

// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_fcu/mag_fit.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <sstream>

#include "core/error.hpp"
#include "core/graph/yaml.hpp"
#include "tools/fulmar_fcu/messages.hpp"
#include "tools/fulmar_fcu/words.hpp"

namespace fulmar::fcu {

namespace {

constexpr std::array<const char*, MagGuide::sides> side_words{
    "nose down", "nose up", "left wing up", "right wing up", "upright (level)", "upside down"};

double dot(const Vector3& a, const Vector3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector3 cross(const Vector3& a, const Vector3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Vector3 column(const Matrix3& A, std::size_t i) { return {A[0][i], A[1][i], A[2][i]}; }

std::string percent(double ratio) { return fixed(100 * ratio, 1) + " %"; }

bool three_numbers(std::string line, Vector3& out) {
  for (char& c : line)
    if (c == ',' || c == ';' || c == '\t' || c == '\r') c = ' ';
  std::istringstream words(line);
  std::string word;
  for (double& number : out) {
    if (!(words >> word)) return false;
    const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (code != std::errc{} || end != word.data() + word.size() || !std::isfinite(number)) return false;
  }
  return !(words >> word);
}

}  // namespace

Vector3 uncorrected(const Vector3& reported, const Matrix3& A, const Vector3& b) {
  const Vector3 x = column(A, 0), y = column(A, 1), z = column(A, 2), yz = cross(y, z);
  const double size = dot(x, yz);  // Cramer's rule
  return {dot(reported, yz) / size + b[0], dot(reported, cross(z, x)) / size + b[1],
          dot(reported, cross(x, y)) / size + b[2]};
}

double determinant(const Matrix3& A) { return dot(A[0], cross(A[1], A[2])); }

std::string objection(const EllipsoidFit& fit, double micro) {
  if (!fit.ok()) return fcu_messages::fit_failed(fit.fault).line();
  if (fit.coverage_ratio < 0.75) return fcu_messages::coverage_low(percent(fit.coverage_ratio)).line();
  if (fit.uncertainty_ratio > 0.03) return fcu_messages::fit_uncertain(percent(fit.uncertainty_ratio)).line();
  if (fit.residual_ratio > 0.06) return fcu_messages::fit_scatter_high(percent(fit.residual_ratio)).line();
  if (fit.stretch_ratio > 2) return fcu_messages::axes_unequal(fixed(fit.stretch_ratio, 1)).line();
  const double field = fit.field / micro;
  if (field < 15 || field > 100) return fcu_messages::field_implausible(fixed(field, 0)).line();
  return "";
}

std::vector<Vector3> read_samples(const std::string& path) {
  std::istringstream file(core::read_source(path, path)->text);
  std::vector<Vector3> out;
  std::string line;
  for (int n = 1; std::getline(file, line); ++n) {
    Vector3 m{};
    if (line.empty() || line[0] == '#') continue;
    if (three_numbers(line, m))
      out.push_back(m);
    else if (n > 1)
      throw core::Error(fcu_messages::sample_line_invalid(path, n));
  }
  return out;
}

std::string samples_text(const std::vector<Vector3>& samples) {
  std::ostringstream out;
  out.precision(9);
  out << "x_tesla,y_tesla,z_tesla\n";
  for (const Vector3& m : samples) out << m[0] << "," << m[1] << "," << m[2] << "\n";
  return out.str();
}

void MagGuide::turn(const Vector3& accel, const Vector3& gyro, double dt_s) {
  const double g = std::sqrt(dot(accel, accel));
  std::size_t axis = 0;
  for (const std::size_t i : {1u, 2u})
    if (std::fabs(accel[i]) > std::fabs(accel[axis])) axis = i;
  if (std::fabs(g - 9.81) > 1.5 || std::fabs(accel[axis]) < 0.9 * g) {
    side_ = -1;
    return;
  }
  // at rest the accelerometer measures up: +x nose up, +y right wing up, +z upside down
  static constexpr std::array<std::array<int, 2>, 3> side_of{{{0, 1}, {2, 3}, {4, 5}}};
  side_ = side_of[axis][accel[axis] > 0 ? 1 : 0];
  if (dt_s > 0 && dt_s < 0.5) angle_rad_ += dot(gyro, accel) / g * dt_s;
}

void MagGuide::take(const Vector3& m) {
  const bool finite = std::isfinite(m[0]) && std::isfinite(m[1]) && std::isfinite(m[2]);
  if (side_ < 0 || !finite) return;
  const double turn = angle_rad_ / (2 * std::numbers::pi);
  const auto part = static_cast<std::size_t>((turn - std::floor(turn)) * parts) % parts;
  int& n = count_[static_cast<std::size_t>(side_)][part];
  if (n >= most) return;
  ++n;
  samples_.push_back(m);
}

int MagGuide::parts_of(int side) const {
  const auto& counts = count_[static_cast<std::size_t>(side)];
  return static_cast<int>(std::count_if(counts.begin(), counts.end(), [](int n) { return n >= enough; }));
}

int MagGuide::done_sides() const {
  int n = 0;
  for (int side = 0; side < sides; ++side) n += parts_of(side) >= parts - 1 ? 1 : 0;
  return n;
}

std::string MagGuide::text() const {
  std::string out = std::to_string(done_sides()) + " of 6 sides done. ";
  if (side_ >= 0 && parts_of(side_) < parts - 1)
    return fcu_messages::side_in_progress(out, side_words[static_cast<std::size_t>(side_)], parts_of(side_))
        .line();
  if (done()) return out.substr(0, out.size() - 1);
  out += "Next, lay it: ";
  bool first = true;
  for (int side = 0; side < sides; ++side) {
    if (parts_of(side) >= parts - 1) continue;
    out += (first ? "" : ", ") + std::string(side_words[static_cast<std::size_t>(side)]);
    first = false;
  }
  return out + ".";
}

}  // namespace fulmar::fcu

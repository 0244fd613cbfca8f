// SPDX-License-Identifier: BSD-3-Clause
// See response.hpp: the frequency response.
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdio>
#include <limits>
#include <numbers>
#include <string>
#include <unsupported/Eigen/FFT>

#include "core/error.hpp"
#include "tools/fulmar_log/messages.hpp"
#include "tools/fulmar_log/response.hpp"

namespace fulmar::response {
namespace {

using core::Error;
using Complex = std::complex<double>;

constexpr double min_power = 1e-3;  // of the largest density of the input
constexpr std::size_t min_segments = 3;

std::string seconds(double s) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f s", s);
  return text;
}

/// Typical time between two samples.
double interval(const Series& s, const char* what) {
  if (s.t_s.size() < 10) throw Error(log_tool_messages::too_few_samples(what, s.t_s.size()));
  std::vector<double> steps;
  for (std::size_t i = 1; i < s.t_s.size(); ++i) steps.push_back(s.t_s[i] - s.t_s[i - 1]);
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

void check_whole(const Series& s, double dt, const char* what) {
  for (std::size_t i = 1; i < s.t_s.size(); ++i)
    if (s.t_s[i] - s.t_s[i - 1] > 5.5 * dt)
      throw Error(log_tool_messages::sample_gap(what, seconds(s.t_s[i - 1]), seconds(s.t_s[i])));
}

/// Values at n times from begin_s on, by linear interpolation.
std::vector<double> even(const Series& s, double begin_s, double dt, std::size_t n) {
  std::vector<double> x;
  x.reserve(n);
  std::size_t i = 1;
  for (std::size_t k = 0; k < n; ++k) {
    const double t = begin_s + static_cast<double>(k) * dt;
    while (i + 1 < s.t_s.size() && s.t_s[i] < t) ++i;
    const double share = std::clamp((t - s.t_s[i - 1]) / (s.t_s[i] - s.t_s[i - 1]), 0.0, 1.0);
    x.push_back(s.x[i - 1] + share * (s.x[i] - s.x[i - 1]));
  }
  return x;
}

/// Sums over the segments, by frequency. Their common factor cancels in every quotient.
struct Spectra {
  std::vector<double> xx, yy;
  std::vector<Complex> xy;
  std::size_t segments = 0;

  Spectra(const std::vector<double>& x, const std::vector<double>& y, std::size_t length)
      : xx(length / 2), yy(length / 2), xy(length / 2) {
    std::vector<double> window(length);
    for (std::size_t i = 0; i < length; ++i)
      window[i] =
          0.5 * (1 - std::cos(2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(length)));
    for (std::size_t begin = 0; begin + length <= x.size(); begin += length / 2, ++segments) {
      const std::vector<Complex> X = transformed(x, begin, window), Y = transformed(y, begin, window);
      for (std::size_t k = 0; k < xx.size(); ++k) {
        xx[k] += std::norm(X[k]);
        yy[k] += std::norm(Y[k]);
        xy[k] += std::conj(X[k]) * Y[k];
      }
    }
  }

 private:
  Eigen::FFT<double> fft_;
  std::vector<Complex> transformed(const std::vector<double>& x, std::size_t begin,
                                   const std::vector<double>& window) {
    std::vector<double> part(window.size());
    for (std::size_t i = 0; i < window.size(); ++i) part[i] = window[i] * x[begin + i];
    std::vector<Complex> out;
    fft_.fwd(out, part);
    return out;
  }
};

}  // namespace

FrequencyResponse frequency_response(const Series& input, const Series& output, double segment_s) {
  const double dx = interval(input, "input"), dy = interval(output, "output"), dt = std::max(dx, dy);
  check_whole(input, dx, "input");
  check_whole(output, dy, "output");
  const double begin_s = std::max(input.t_s.front(), output.t_s.front()),
               end_s = std::min(input.t_s.back(), output.t_s.back());
  const auto n = end_s > begin_s ? static_cast<std::size_t>((end_s - begin_s) / dt + 1e-6) + 1 : 0;
  const double samples = segment_s > 0 ? segment_s / dt : static_cast<double>(n) / 4;
  const auto length = 2 * static_cast<std::size_t>(samples / 2);  // even: it overlaps by half
  if (length < 16 || n < 2 * length)
    throw Error(log_tool_messages::segment_too_short(seconds(static_cast<double>(length) * dt),
                                                     seconds(std::max(0.0, end_s - begin_s)), seconds(dt),
                                                     min_segments));
  const Spectra s(even(input, begin_s, dt, n), even(output, begin_s, dt, n), length);
  FrequencyResponse out{1 / dt, static_cast<double>(length) * dt, s.segments, {}};
  const auto last = static_cast<std::size_t>(0.4 * static_cast<double>(length));
  const double most = *std::max_element(s.xx.begin() + 2, s.xx.end());
  const double averages = static_cast<double>(n / length);  // number of independent segments
  for (std::size_t k = 2; k < std::min(last + 1, s.xx.size()); ++k) {
    if (!(s.xx[k] > min_power * most)) continue;
    const Complex H = s.xy[k] / s.xx[k];
    Frequency f;
    f.hz = static_cast<double>(k) / out.segment_s;
    f.gain = std::abs(H);
    f.phase_rad = std::arg(H);
    if (!out.at.empty())
      f.phase_rad +=
          2 * std::numbers::pi * std::round((out.at.back().phase_rad - f.phase_rad) / (2 * std::numbers::pi));
    f.coherence = s.yy[k] > 0 ? std::min(1.0, std::norm(s.xy[k]) / (s.xx[k] * s.yy[k])) : 0;
    if (f.coherence > 0) f.gain_std = std::sqrt((1 - f.coherence) / (2 * averages * f.coherence));
    out.at.push_back(f);
  }
  return out;
}

}  // namespace fulmar::response

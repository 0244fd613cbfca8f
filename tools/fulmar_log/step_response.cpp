// SPDX-License-Identifier: BSD-3-Clause
// See response.hpp: figures of a step.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "core/error.hpp"
#include "tools/fulmar_log/messages.hpp"
#include "tools/fulmar_log/response.hpp"

namespace fulmar::response {
namespace {

using core::Error;

std::string rounded(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", x);
  return text;
}

/// Mean of the samples from a to b; the nearest one before a when there is none.
double mean(const Series& s, double a_s, double b_s) {
  double sum = 0;
  std::size_t n = 0;
  for (std::size_t i = 0; i < s.x.size(); ++i)
    if (s.t_s[i] >= a_s && s.t_s[i] <= b_s) {
      sum += s.x[i];
      ++n;
    }
  if (n > 0) return sum / static_cast<double>(n);
  const auto after = std::upper_bound(s.t_s.begin(), s.t_s.end(), a_s) - s.t_s.begin();
  return s.x[static_cast<std::size_t>(std::max<std::ptrdiff_t>(after, 1) - 1)];
}

struct Jump {
  std::size_t to = 0;  // the first sample behind it
  double by = 0;
};

double jump(const Series& s, std::size_t i) { return s.x[i] - s.x[i - 1]; }

/// The first of the largest jumps; it must be half of the whole range of the input.
Jump first_jump(const Series& input) {
  double largest = 0;
  for (std::size_t i = 1; i < input.x.size(); ++i) largest = std::max(largest, std::abs(jump(input, i)));
  const auto [low, high] = std::minmax_element(input.x.begin(), input.x.end());
  const double range = *high - *low;  // 0: the input has no step
  if (largest == 0 || largest < 0.5 * range)
    throw Error(log_tool_messages::input_step_missing(rounded(range), rounded(largest)));
  for (std::size_t i = 1;; ++i)
    if (std::abs(jump(input, i)) > 0.999 * largest) return {i, jump(input, i)};
}

/// Time, from `from` on, at which the output first passes `level` of the way; linear between samples.
std::optional<double> passes(const Series& y, const std::vector<double>& way, std::size_t from,
                             double level) {
  for (std::size_t i = from; i < way.size(); ++i) {
    if (way[i] < level) continue;
    if (i == 0 || way[i - 1] >= level) return y.t_s[i];
    const double share = (level - way[i - 1]) / (way[i] - way[i - 1]);
    return y.t_s[i - 1] + share * (y.t_s[i] - y.t_s[i - 1]);
  }
  return std::nullopt;
}

/// Time at which it last enters the band; empty when that is within the last fifth, which defines the band.
std::optional<double> settles(const Series& y, const std::vector<double>& way, double begin_s, double end_s,
                              double band) {
  std::size_t last = way.size();
  for (std::size_t i = 0; i < way.size(); ++i)
    if (y.t_s[i] >= begin_s && std::abs(way[i] - 1) > band) last = i;
  if (last == way.size()) return begin_s;
  if (last + 1 == way.size() || y.t_s[last] > end_s - 0.2 * (end_s - begin_s)) return std::nullopt;
  const double out = std::abs(way[last] - 1), in = std::abs(way[last + 1] - 1);
  const bool same_side = (way[last] > 1) == (way[last + 1] > 1);
  const double share = (out - band) / (same_side ? out - in : out + in);
  return y.t_s[last] + share * (y.t_s[last + 1] - y.t_s[last]);
}

}  // namespace

StepFigures step_figures(const Series& input, const Series& output, double band) {
  if (input.x.empty() || output.x.empty()) throw Error(log_tool_messages::step_samples_missing());
  const Jump step = first_jump(input);
  StepFigures f;
  f.at_s = input.t_s[step.to];
  f.until_s = std::min(input.t_s.back(), output.t_s.back());
  for (std::size_t i = step.to + 1; i < input.x.size(); ++i)
    if (std::abs(jump(input, i)) >= 0.5 * std::abs(step.by)) {
      f.until_s = std::min(f.until_s, input.t_s[i - 1]);
      break;
    }
  Series y;  // from a second before the step to its end
  for (std::size_t i = 0; i < output.x.size(); ++i)
    if (output.t_s[i] >= f.at_s - 1 && output.t_s[i] <= f.until_s) {
      y.t_s.push_back(output.t_s[i]);
      y.x.push_back(output.x[i]);
    }
  const auto after = std::upper_bound(y.t_s.begin(), y.t_s.end(), f.at_s) - y.t_s.begin();
  const auto begin = static_cast<std::size_t>(after);
  if (y.x.size() - begin < 10 || begin == 0)
    throw Error(log_tool_messages::step_samples_too_few(begin, y.x.size() - begin));
  const double before_s = input.t_s[step.to - 1];  // the last time before the step
  f.input_change = mean(input, f.at_s, f.until_s) - mean(input, before_s - 1, before_s);
  f.output_before = mean(y, y.t_s.front(), f.at_s);
  f.output_after = mean(y, f.until_s - 0.2 * (f.until_s - f.at_s), f.until_s);
  if (f.output_change() == 0) throw Error(log_tool_messages::output_constant());
  std::vector<double> way;  // 0 before, 1 at the end
  for (const double x : y.x) way.push_back((x - f.output_before) / f.output_change());
  const std::optional<double> low = passes(y, way, begin, 0.1), high = passes(y, way, begin, 0.9);
  if (low && high) f.rise_s = *high - *low;
  const auto peak = std::max_element(way.begin() + after, way.end());
  f.overshoot_percent = 100 * std::max(0.0, *peak - 1);
  f.peak_s = y.t_s[static_cast<std::size_t>(peak - way.begin())] - f.at_s;
  if (const auto settled = settles(y, way, f.at_s, f.until_s, band)) f.settling_s = *settled - f.at_s;
  return f;
}

}  // namespace fulmar::response

// SPDX-License-Identifier: BSD-3-Clause
#include "core/tap/pace.hpp"

#include <charconv>
#include <cstdio>

#include "core/error.hpp"
#include "core/tap/messages.hpp"

namespace fulmar::core {
namespace {

constexpr std::uint64_t max_ticks = 1'000'000;
// a tick may take at most 100 times as long as in reality: orders are only read between ticks
constexpr double slowest = 0.01, fastest = 1e6;

}  // namespace

std::optional<double> speed_of(const std::string& text) {
  if (text == "real") return 1;
  if (text == "max") return 0;
  double speed = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), speed);
  const bool whole = code == std::errc{} && end == text.data() + text.size();
  return whole && speed > 0 && speed <= fastest ? std::optional(speed) : std::nullopt;
}

std::string speed_text(double speed) {
  if (speed == 0) return "max";
  if (speed == 1) return "real";
  char text[32];
  std::snprintf(text, sizeof text, "%g", speed);
  return text;
}

PaceOrder step_order(const std::string& ticks) {
  std::uint64_t n = 0;
  const auto [end, code] = std::from_chars(ticks.data(), ticks.data() + ticks.size(), n);
  if (code != std::errc{} || end != ticks.data() + ticks.size() || n < 1 || n > max_ticks)
    throw Error(tap_messages::step_count_invalid(ticks, max_ticks));
  return {PaceOrder::What::step, n, 0};
}

PaceOrder speed_order(const std::string& speed) {
  const std::optional<double> number = speed_of(speed);
  if (!number || (*number > 0 && *number < slowest)) throw Error(tap_messages::speed_invalid(speed));
  return {PaceOrder::What::speed, 0, *number};
}

PaceOrder restart_order(const std::string& seed) {
  PaceOrder order{PaceOrder::What::restart};
  if (seed.empty()) return order;
  std::uint64_t n = 0;
  const auto [end, code] = std::from_chars(seed.data(), seed.data() + seed.size(), n);
  if (code != std::errc{} || end != seed.data() + seed.size()) throw Error(tap_messages::seed_invalid(seed));
  order.seed = n;
  return order;
}

}  // namespace fulmar::core

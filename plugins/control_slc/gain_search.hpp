// SPDX-License-Identifier: BSD-3-Clause
// Gains of one axis from a record of its loop. The law is linear in its gains, so the loop with other gains
// follows from the measurement, L' = L + dC Y/U, without a model of the aircraft.
#pragma once
#include "loop_lines.hpp"

namespace fulmar::slc {

struct AxisGains {
  double kp = 0, ki = 0, kd = 0;
  bool damper() const { return kp == 0 && ki == 0; }
  bool operator==(const AxisGains&) const = default;
};

struct MarginsWanted {
  double gain_db = 8, phase_rad = 0.96, delay_s = 0;
  bool kept(const Margins& m) const {
    return m.min_gain_db() >= gain_db && m.phase_rad >= phase_rad && m.delay_s >= delay_s;
  }
};

/// The loop with gains `to`, computed from a record with gains `from`. A damper (kp 0) acts on a washed-out
/// rate that the record does not hold, so its loop is scaled by its gain.
inline std::array<Complex, Lines::count> loop_with(const LoopRecord& r, const AxisGains& from,
                                                   const AxisGains& to) {
  std::array<Complex, Lines::count> out;
  for (std::size_t i = 0; i < Lines::count; ++i) {
    if (from.damper()) {
      out[i] = r.loop[i] * (to.kd / from.kd);
      continue;
    }
    const Complex integral = r.step_s / (1.0 - std::polar(1.0, -Lines::radps(i) * r.step_s));
    out[i] = r.loop[i] + r.scale * ((to.kp - from.kp + (to.ki - from.ki) * integral) * r.attitude[i] +
                                    (to.kd - from.kd) * r.rate[i]);
  }
  return out;
}

/// Attitude loop: the highest kp that leaves the margins, ki in its ratio to it, kd within twice and half of
/// its old ratio.
/// Damper: of the gains that leave the margins, the one whose loop is nearest to damper_loop at its peak, the
/// dutch roll. The resonance is then reduced to 1 / (1 + damper_loop).
class GainSearch {
 public:
  void begin(const LoopRecord& record, const AxisGains& from, const MarginsWanted& wanted) {
    record_ = record;
    from_ = from;
    wanted_ = wanted;
    next_ = 0;
    found_ = false;
    best_off_ = 1e300;
  }
  /// Tries one candidate. Returns true when all have been tried.
  bool step() {
    const bool damper = from_.damper();
    if (next_ >= (damper ? factors : factors * dampings)) return true;
    if (damper)
      try_damper({0, 0, from_.kd * factor(next_)});
    else
      try_attitude({from_.kp * factor(next_ % factors), from_.ki * factor(next_ % factors),
                    from_.kd * factor(next_ % factors) * damping(next_ / factors)});
    ++next_;
    return false;
  }
  bool found() const { return found_; }
  const AxisGains& best() const { return best_; }

 private:
  static constexpr double damper_loop = 1.25;
  static constexpr int factors = 33, dampings = 7;
  static double factor(int i) { return std::pow(10, (i - 16) * 0.05); }  // 1 dB apart, 0.16 to 6.3
  /// Ratio to the old kd / kp: 1 first, then 2 dB more, less, ... to 6 dB.
  static double damping(int i) { return std::pow(10, 0.1 * ((i + 1) / 2) * (i % 2 == 1 ? 1 : -1)); }

  void try_attitude(const AxisGains& g) {
    if (found_ && g.kp <= best_.kp * 1.05) return;
    if (!wanted_.kept(margins_of(loop_with(record_, from_, g)))) return;
    best_ = g;
    found_ = true;
  }
  void try_damper(const AxisGains& g) {
    const auto loop = loop_with(record_, from_, g);
    double peak = 0;
    for (std::size_t i = 0; i < Lines::count; ++i) peak = std::max(peak, std::abs(loop[i]));
    const double off = std::abs(std::log(peak / damper_loop));
    if (!(off < best_off_) || !wanted_.kept(margins_of(loop))) return;
    best_ = g;
    found_ = true;
    best_off_ = off;
  }

  LoopRecord record_;
  AxisGains from_, best_;
  MarginsWanted wanted_;
  double best_off_ = 1e300;
  int next_ = 0;
  bool found_ = false;
};

}  // namespace fulmar::slc

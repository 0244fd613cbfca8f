// SPDX-License-Identifier: BSD-3-Clause
// How far a recording lies from the median of NASA's simulators, and how far they lie from it themselves.
#pragma once
#include <algorithm>
#include <functional>

#include "cases.hpp"

namespace fulmar::six_dof {

struct Signal {
  const char* name;  ///< with its unit
  double floor;      ///< of the bar
};
inline constexpr std::array<Signal, 9> signals{{{"altitude_m", 0.01},
                                                {"roll_deg", 1e-3},
                                                {"pitch_deg", 1e-3},
                                                {"yaw_deg", 1e-3},
                                                {"rotation_deg", 1e-3},
                                                {"p_degps", 1e-3},
                                                {"q_degps", 1e-3},
                                                {"r_degps", 1e-3},
                                                {"airspeed_mps", 0.01}}};

struct Figure {
  const char* signal;
  double departure = 0, bar = 0;
  bool within() const { return departure <= bar; }
};

inline double median(std::vector<double> v) {
  std::sort(v.begin(), v.end());
  const std::size_t n = v.size();
  return n % 2 == 1 ? v[n / 2] : 0.5 * (v[n / 2 - 1] + v[n / 2]);
}

namespace detail {

inline std::vector<const Recording*> reporting(const std::vector<Recording>& all, Column c, int without) {
  std::vector<const Recording*> out;
  for (const Recording& r : all)
    if (r.has(c) && r.simulator != without) out.push_back(&r);
  return out;
}

/// `difference(recording, i)` is a vector from the first simulator to a recording. The median is taken by
/// component: angles may jump, but their differences do not.
template <class Difference>
Figure figure(const Signal& signal, const Recording& ours, const std::vector<const Recording*>& theirs,
              Difference difference) {
  Figure out{signal.name};
  double spread = 0;
  for (std::size_t i = 0; i < samples; ++i) {
    std::array<std::vector<double>, 3> component;
    for (const Recording* r : theirs) {
      const Eigen::Vector3d d = difference(*r, i);
      for (std::size_t k = 0; k < 3; ++k) component[k].push_back(d(static_cast<Eigen::Index>(k)));
    }
    const Eigen::Vector3d middle(median(component[0]), median(component[1]), median(component[2]));
    for (const Recording* r : theirs) spread = std::max(spread, (difference(*r, i) - middle).norm());
    out.departure = std::max(out.departure, (difference(ours, i) - middle).norm());
  }
  out.bar = std::max(3 * spread, signal.floor);
  return out;
}

inline Eigen::Quaterniond attitude(const Recording& r, std::size_t i) {
  return quaternion_from({degree * r.of[roll][i], degree * r.of[pitch][i], degree * r.of[yaw][i]});
}

}  // namespace detail

/// Attitude is compared twice. Euler angles, with differences the short way, are those of the report. The
/// rotation between two attitudes has no singularity: near a pitch of 90 degrees roll and yaw of the
/// simulators, and so the bar of these angles, are useless.
inline std::vector<Figure> compared(const Recording& ours, const std::vector<Recording>& all, const Case& c) {
  std::vector<Figure> out;
  const auto plain = [&](const Signal& signal, Column column, bool angle, int without) {
    const auto theirs = detail::reporting(all, column, without);
    const Recording& first = *theirs.front();
    out.push_back(detail::figure(signal, ours, theirs, [&](const Recording& r, std::size_t i) {
      const double d = r.of[column][i] - first.of[column][i];
      return Eigen::Vector3d(angle ? std::remainder(d, 360) : d, 0, 0);
    }));
  };
  plain(signals[0], altitude, false, c.faulty);
  plain(signals[1], roll, true, c.faulty);
  plain(signals[2], pitch, true, c.faulty);
  plain(signals[3], yaw, true, c.faulty);
  const auto theirs = detail::reporting(all, roll, c.faulty);
  const Recording& first = *theirs.front();
  out.push_back(detail::figure(signals[4], ours, theirs, [&](const Recording& r, std::size_t i) {
    return Eigen::Vector3d(log_map(detail::attitude(first, i).conjugate() * detail::attitude(r, i)) / degree);
  }));
  plain(signals[5], p, false, c.faulty);
  plain(signals[6], q, false, c.faulty);
  plain(signals[7], r, false, c.faulty);
  plain(signals[8], airspeed, false, c.faulty ? c.faulty : c.faulty_airspeed);
  return out;
}

/// The median of the simulators' first rows.
inline Start start_of(const std::vector<Recording>& all, const Case& c) {
  const auto first = [&](Column column) {
    std::vector<double> values;
    for (const Recording* r : detail::reporting(all, column, c.faulty))
      values.push_back(r->of[column].front());
    return median(values);
  };
  Start s;
  s.place = {degree * first(lat), degree * first(lon), first(altitude)};
  s.v_l = {first(v_north), first(v_east), first(v_down)};
  s.euler = {degree * first(roll), degree * first(pitch), degree * first(yaw)};
  s.omega_b = degree * Eigen::Vector3d(first(p), first(q), first(r));
  return s;
}

}  // namespace fulmar::six_dof

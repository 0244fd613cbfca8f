// SPDX-License-Identifier: BSD-3-Clause
// Table of bench_consistency for the flights with one set of sensors in one kind of air.
#pragma once
#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <vector>

#include "fulmar/flight/navigation/consistency.hpp"
#include "fulmar/msg/filter_check.hpp"

namespace fulmar::consistency {

/// Statistics of all flights with one set of sensors in one kind of air.
struct Table {
  std::vector<std::string> order;
  std::map<std::string, Channel> channels;
  std::map<std::string, Innovations> innovations;
  std::vector<Nees> flights;

  Channel& channel(const std::string& name) {
    const auto [at, is_new] = channels.try_emplace(name);
    if (is_new) order.push_back(name);
    return at->second;
  }
  void judge(const VehicleState& x, const VehicleState& s, const FilterCheck& check,
             const Vec3<Ned>& mean_wind_mps, Nees& nees) {
    constexpr double degree = 0.017453292519943295;
    const Nees::Errors e = Nees::errors(x, s), std = Nees::claims(s);
    static const std::array<const char*, 9> names{
        "attitude about north, deg", "attitude about east, deg", "attitude about down, deg",
        "velocity north, m/s",       "velocity east, m/s",       "velocity down, m/s",
        "position north, m",         "position east, m",         "position down, m"};
    for (int i = 0; i < 9; ++i) {
      const double unit = i < 3 ? degree : 1;
      channel(names[static_cast<std::size_t>(i)]).add(e(i) / unit, std(i) / unit);
    }
    channel("wind north, m/s").add(x.wind_mps.north - s.wind_mps.north, s.wind_std_mps.north);
    channel("wind east, m/s").add(x.wind_mps.east - s.wind_mps.east, s.wind_std_mps.east);
    channel("mean wind north, m/s")
        .add(mean_wind_mps.north - check.mean_wind_mps.north, check.mean_wind_std_mps.north);
    channel("mean wind east, m/s")
        .add(mean_wind_mps.east - check.mean_wind_mps.east, check.mean_wind_std_mps.east);
    channel("airspeed, m/s").add(x.airspeed_mps - s.airspeed_mps, s.airspeed_std_mps);
    nees.add(Nees::of(e, std, check.correlation_ratio));
  }
};

}  // namespace fulmar::consistency

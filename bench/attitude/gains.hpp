// SPDX-License-Identifier: BSD-3-Clause
// The Skywalker X8 and its gains, out of configs/airframes/x8.yaml.
#pragma once
#include <yaml-cpp/yaml.h>

#include <stdexcept>
#include <string>

#include "bench/attitude/flown.hpp"
#include "sdk/test/flight/airframe_file.hpp"

namespace fulmar::attitude {

/// Descents of the benchmark go beyond the airspeed that the file allows a mission.
inline const Airframe& x8() {
  static const Airframe airframe = [] {
    Airframe a = test::airframe_file("x8");
    a.limits.airspeed_max_mps = 40;
    return a;
  }();
  return airframe;
}

struct Wrong : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Into the parameter of that name. The numbers of the file are in SI.
template <class P>
bool set_one(P& params, const std::string& name, double value) {
  using Table = detail::ParamTable<P>;
  std::size_t i = 0;
  bool found = false;
  auto one = [&](auto& param) {
    if constexpr (std::is_same_v<std::remove_cvref_t<decltype(param)>, Param>) {
      if (name == Table::table[i].name) {
        if (!(value >= param.min && value <= param.max))
          throw Wrong(name + " is " + sim::shown(value) + " and must be in [" + sim::shown(param.min) + ", " +
                      sim::shown(param.max) + "]");
        param.value = value;
        found = true;
      }
    }
    ++i;
  };
  detail::for_each_param(params, one);
  return found;
}

inline void set(Gains& gains, const std::string& component, const std::string& name, double value) {
  const bool found = component == "Inner"      ? set_one(gains.inner, name, value)
                     : component == "Airspeed" ? set_one(gains.airspeed, name, value)
                                               : false;
  if (!found)
    throw Wrong("there is no parameter " + component + "." + name + "; components: Airspeed, Inner");
}

/// Those of the file.
inline Gains shipped_gains() {
  Gains gains;
  const YAML::Node params = YAML::LoadFile(FULMAR_SOURCE_DIR "/configs/airframes/x8.yaml")["params"];
  for (const char* component : {"Airspeed", "Inner"})
    for (const auto& entry : params[std::string("control_slc/") + component])
      set(gains, component, entry.first.as<std::string>(), std::stod(entry.second.as<std::string>()));
  return gains;
}

}  // namespace fulmar::attitude

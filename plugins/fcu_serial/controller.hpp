// SPDX-License-Identifier: BSD-3-Clause
// Properties of the flight controller: firmware, system id, and the parameters that the plugin needs.
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "greeting.hpp"
#include "radio.hpp"

namespace fulmar::fcu {

class Controller {
 public:
  void meet(const Greeting& g) {
    parameters_ = g.parameters;
    version_ = Text<50>(g.version);
    for (std::size_t i = 0; i < watched_parameters.size(); ++i)
      if (g.parameters[i]) map_.take(watched_parameters[i], *g.parameters[i]);
  }
  /// Called with each inertial sample: its SYS_ID and its clock, which is 0 at boot.
  void packet_from(std::uint8_t system, std::uint64_t clock_us) {
    system_ = system;
    clock_us_ = clock_us;
  }
  /// True when the firmware differs from the known one.
  bool other_version(const Text<50>& version) {
    if (version == version_) return false;
    const bool known = !version_.view().empty();
    version_ = version;
    return known;
  }
  /// A watched parameter whose value has changed. `known`: there was a value before.
  struct Change {
    std::string_view name;
    std::int32_t value = 0;
    bool known = false;
  };
  std::optional<Change> take(const ParamValue& p) {
    const std::string_view name = id_of(p.param_id);
    const auto at = static_cast<std::size_t>(
        std::find(watched_parameters.begin(), watched_parameters.end(), name) - watched_parameters.begin());
    if (at == watched_parameters.size()) return {};
    const std::int32_t value = watched_bits(name, p);
    const bool known = parameters_[at].has_value();
    if (known && *parameters_[at] == value) return {};
    parameters_[at] = value;
    map_.take(name, value);
    return Change{watched_parameters[at], value, known};
  }

  const RcMap& map() const { return map_; }
  std::uint8_t system() const { return system_; }
  std::uint64_t clock_us() const { return clock_us_; }

 private:
  std::array<std::optional<std::int32_t>, watched_parameters.size()> parameters_;
  RcMap map_;
  Text<50> version_;
  std::uint8_t system_ = 1;  ///< the controller accepts no other
  std::uint64_t clock_us_ = 0;
};

}  // namespace fulmar::fcu

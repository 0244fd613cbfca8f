// SPDX-License-Identifier: BSD-3-Clause
// The compared quantities of two states: one row of the table each.
#pragma once
#include <cstddef>
#include <vector>

#include "fulmar/flight/earth/geodesy.hpp"
#include "fulmar/msg/gnss.hpp"
#include "fulmar/msg/vehicle_state.hpp"

namespace fulmar::states {

struct Quantity {
  const char *key, *words, *unit;  // "roll_deg", "roll", "deg"
  double scale = 1;                // to that unit
  bool angle = false;
  double (*value)(const VehicleState&) = nullptr;
  double (*std)(const VehicleState&) = nullptr;  // reported standard deviation; nullptr: states have none
  bool (*valid)(const VehicleState&) = nullptr;

  /// Of two states in one frame, in the quantity's unit.
  double difference(const VehicleState& of, const VehicleState& from) const;
  bool is_valid(const VehicleState& state) const;
  bool has_claim(const VehicleState& state) const;
  double claim(const VehicleState& state) const { return scale * std(state); }
};

const std::vector<Quantity>& quantities();

/// Clears the validity flags of values that are not finite; returns false when there was one.
bool drop_not_finite(VehicleState& state);

/// Transforms the positions of states and fixes to a common origin.
class CommonFrame {
 public:
  /// `state` relative to the origin of `base`; the axes of the two frames are assumed to be parallel.
  VehicleState seen_from(const VehicleState& state, const VehicleState& base);
  /// A fix as a state: fields that the receiver does not measure are invalid.
  VehicleState seen_from(const Gnss& fix, const VehicleState& base);

 private:
  const LocalFrame& frame_of(const VehicleState& base);
  LocalFrame frame_;
  double lat_deg_ = 0, lon_deg_ = 0, alt_m_ = 0;
  bool known_ = false;
};

}  // namespace fulmar::states

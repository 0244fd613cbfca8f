// SPDX-License-Identifier: BSD-3-Clause
// State of another aircraft from received messages: for conditions of phases, for results, and for laws that
// fly relative to it.
#pragma once
#include "other_aircraft.hpp"

namespace fulmar::formation {

enum class Hearing : std::uint8_t {
  never,         ///< no message yet
  heard,         ///< all messages usable
  silent,        ///< no recent message
  lost,          ///< messages without a valid position
  other_origin,  ///< position from another origin, or without an origin
};

/// Link and distance to another aircraft.
struct Sight {
  Hearing hearing = Hearing::never;       ///< state of the link
  double age_s = unknown_std;             ///< age of the last state of the other aircraft
  double distance_m = unknown_std;        ///< present distance
  double least_distance_m = unknown_std;  ///< smallest distance so far with both aircraft in the air
};

struct Neighbour {
  static constexpr const char* doc = "Receiver for the state of another aircraft: link, distance and state.";
  struct Inputs {
    In<VehicleState> state;
    Optional<VehicleState> heard;  // imported
  };
  struct Outputs {
    Out<VehicleState> other;  // as received, while it is usable; valid at the time of sending
    Sight sight;
  };
  struct Params {
    Param timeout{2, "s", 0.02, 60, "largest time without a message before the link counts as lost"};
    Param latency{0, "s", 0, 5, "transmission delay of the state of the other aircraft"};
    Param airborne{5, "m", 0, 1000, "height of both aircraft above which the minimum distance counts"};
  };

  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out);

 private:
  Sight sight_;
};

inline Hearing hearing(const VehicleState& own, const Optional<VehicleState>& heard, double timeout_s) {
  if (!heard) return Hearing::never;
  if (heard.age_s() > timeout_s) return Hearing::silent;
  if (!located(*heard)) return Hearing::lost;
  return same_origin(own, *heard) ? Hearing::heard : Hearing::other_origin;
}

inline Status Neighbour::step(const Tick&, const Inputs& in, const Params& p, Outputs& out) {
  const VehicleState& own = *in.state;
  sight_.hearing = hearing(own, in.heard, p.timeout);
  sight_.age_s = in.heard ? in.heard.age_s() + p.latency : unknown_std;
  sight_.distance_m = unknown_std;
  const bool heard = sight_.hearing == Hearing::heard;
  if (heard && located(own)) {
    sight_.distance_m = Relative(own, Motion(*in.heard, sight_.age_s)).distance();
    if (own.height_m > p.airborne && in.heard->height_m > p.airborne)
      sight_.least_distance_m = std::min(sight_.least_distance_m, sight_.distance_m);
  }
  if (heard && in.heard.fresh())
    out.other.publish(*in.heard, in.heard.valid_at_ns() - std::llround(1e9 * p.latency));
  out.sight = sight_;
  return heard ? Status::ok : Status::degraded;
}

}  // namespace fulmar::formation

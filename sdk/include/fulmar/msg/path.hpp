// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "fulmar/message.hpp"

namespace fulmar {

enum class PathKind : std::uint8_t { line, orbit };
enum class Turn : std::uint8_t { right, left };  ///< seen from above: right is clockwise

/// The piece of path to be followed now. Beard & McLain, chapter 10. Fields of further kinds are appended.
struct Path {
  PathKind kind = PathKind::line;
  Turn turn = Turn::right;             ///< orbit
  Vec3<Ned> origin_m;                  ///< line: a point on it; orbit: its centre
  Vec3<Ned> direction_ratio{1, 0, 0};  ///< line: unit vector along it
  double radius_m = 50;                ///< orbit
  double climb_ratio = 0;              ///< orbit: metres up per metre of arc flown; 0 is level
  double start_rad = 0;      ///< orbit: azimuth, from the centre, at which `origin_m.down` is the height
  double airspeed_mps = 15;  ///< to be flown on it
  double remaining_m = unknown_std;  ///< along this piece to the next one
  double next_curvature_ratio =
      0;  ///< 1/m of the next piece, right positive, 0 for a line: lets a follower roll in time
};

}  // namespace fulmar

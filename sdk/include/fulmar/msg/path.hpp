// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "fulmar/message.hpp"

namespace fulmar {

enum class PathKind : std::uint8_t { line, orbit };
enum class Turn : std::uint8_t { right, left };  ///< seen from above: right is clockwise

/// The geometry of one piece, from where it begins.
struct PathPiece {
  PathKind kind = PathKind::line;
  Turn turn = Turn::right;             ///< orbit
  Vec3<Ned> origin_m;                  ///< line: where it begins; orbit: its centre
  Vec3<Ned> direction_ratio{1, 0, 0};  ///< line: unit vector along it
  double radius_m = 50;                ///< orbit
  double climb_ratio = 0;              ///< orbit: metres up per metre of arc flown
  double start_rad = 0;  ///< orbit: azimuth, from the centre, where it begins, at the height of the centre
  double airspeed_mps = 15;
  double length_m = unknown_std;  ///< known to have one curvature for so long; unknown_std: for ever
  bool is_curve = false;          ///< a Bezier curve: the fields above are its tangent where it begins
  std::array<Vec3<Ned>, 4> control_m;
};

/// The piece of path to be followed now. Beard & McLain, chapter 10.
/// A cubic Bezier curve (fulmar/flight/path/curve.hpp) is published as the line or orbit that touches it
/// where the aircraft is, beside its four control points: so who knows lines and orbits alone follows it as
/// well.
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
  bool is_curve = false;               ///< what is to be followed is the curve of `control_m`
  std::array<Vec3<Ned>, 4> control_m;  ///< of a cubic Bezier curve: begin, two handles, end
  bool has_next = false;               ///< false: nobody knows, or there is none
  PathPiece next;  ///< what begins after `remaining_m`: lets a law that looks ahead turn the corner
};

/// A plugin that fills the fields before it alone says nothing of curves and of what comes next.
template <>
inline constexpr std::string_view appended_from<Path> = "is_curve";

}  // namespace fulmar

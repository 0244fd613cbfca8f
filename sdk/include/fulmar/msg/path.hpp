// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "fulmar/message.hpp"

namespace fulmar {

enum class PathKind : std::uint8_t { line, orbit };
enum class Turn : std::uint8_t { right, left };  ///< seen from above: right is clockwise

/// Geometry of one piece of path, from its start.
struct PathPiece {
  PathKind kind = PathKind::line;      ///< kind of the piece
  Turn turn = Turn::right;             ///< orbit: direction of the turn
  Vec3<Ned> origin_m;                  ///< line: its start; orbit: its centre
  Vec3<Ned> direction_ratio{1, 0, 0};  ///< line: unit vector along it
  double radius_m = 50;                ///< orbit: radius
  double climb_ratio = 0;              ///< orbit: climb per metre of arc
  double start_rad = 0;                ///< orbit: azimuth of its start from the centre, at the height of the
                                       ///< centre
  double airspeed_mps = 15;            ///< true airspeed on the piece
  double length_m = unknown_std;       ///< length of constant curvature; unknown_std: unlimited
  bool is_curve = false;               ///< true for a Bezier curve: the fields above are its tangent at its
                                       ///< start
  std::array<Vec3<Ned>, 4> control_m;  ///< control points of the Bezier curve
};

/// The piece of path to be followed now. Beard & McLain, chapter 10. A cubic Bezier curve
/// (fulmar/flight/path/curve.hpp) is published as the tangent line or orbit at the aircraft, beside its four
/// control points, so that a follower of lines and orbits follows it too.
struct Path {
  PathKind kind = PathKind::line;      ///< kind of the piece
  Turn turn = Turn::right;             ///< orbit: direction of the turn
  Vec3<Ned> origin_m;                  ///< line: a point on it; orbit: its centre
  Vec3<Ned> direction_ratio{1, 0, 0};  ///< line: unit vector along it
  double radius_m = 50;                ///< orbit: radius
  double climb_ratio = 0;              ///< orbit: climb per metre of arc; 0 is level
  double start_rad = 0;                ///< orbit: azimuth from the centre at which `origin_m.down` is the
                                       ///< height
  double airspeed_mps = 15;            ///< true airspeed on the piece
  double remaining_m = unknown_std;    ///< distance along this piece to the next one
  double next_curvature_ratio = 0;     ///< curvature of the next piece, 1/m, right positive, 0 for a line:
                                       ///< for an early bank command
  bool is_curve = false;               ///< true: the curve of `control_m` is to be followed
  std::array<Vec3<Ned>, 4> control_m;  ///< control points of the cubic Bezier curve: start, two handles, end
  bool has_next = false;               ///< true if `next` is known
  PathPiece next;                      ///< piece after `remaining_m`, for laws with a look-ahead
};

/// An older plugin fills only the fields before it, and publishes neither curves nor the next piece.
template <>
inline constexpr std::string_view appended_from<Path> = "is_curve";

}  // namespace fulmar

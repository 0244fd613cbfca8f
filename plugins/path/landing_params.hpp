// SPDX-License-Identifier: BSD-3-Clause
// Parameters of a landing: the way onto the runway, the conditions of a go-around, and the effect of wind.
#pragma once
#include "fulmar/plugin.hpp"
#include "runway_site.hpp"

namespace fulmar::path {

/// The circle, the final approach and the glide slope.
struct PatternParams {
  Param glide_slope{0.07, "rad", 0.02, 0.3, "angle of the glide slope"};
  Param aim{50, "m", 0, 500,
            "distance from the threshold to the point where the glide slope meets the runway"};
  Param final_length{400, "m", 50, 10000, "length of the final approach, from its circle to the threshold"};
  Param circle_radius{70, "m", 10, 2000, "radius of the circle before the final approach"};
  Choice<Turn> circle{Turn::left, "turn direction of the circle before the final approach"};
};

inline Pattern pattern_of(const PatternParams& p) {
  return {p.glide_slope, p.aim, p.final_length, p.circle_radius, p.circle};
}

/// Conditions before the decision height.
struct GoAroundLimits {
  Param decision_height{12, "m", 1, 100, "height above the runway below which no go-around starts"};
  Param cross_limit{8, "m", 0.5, 100,
                    "cross-track error that starts a go-around below twice the decision height"};
  Param height_limit{6, "m", 0.5, 100,
                     "glide slope error that starts a go-around below twice the decision height"};
};

/// Effect of wind on an approach: stay on the circle, or approach with a warning.
enum class WindAnswer : std::uint8_t { refuse, warn };

struct WindLimits {
  Choice<WindAnswer> wind{WindAnswer::refuse,
                          "answer to wind beyond crosswind_limit or too strong for the runway length; "
                          "refuse: stay on the circle; warn: land with a warning"};
  Param wind_wait{180, "s", 0, 86400,
                  "time on the circle after which a refused approach is flown with a warning; at once below "
                  "a fifth of the charge"};
  Param crosswind_limit{0.55, "ratio", 0, 2, "largest ratio of crosswind to approach airspeed for a landing"};
};

}  // namespace fulmar::path

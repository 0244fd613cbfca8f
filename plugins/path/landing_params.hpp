// SPDX-License-Identifier: BSD-3-Clause
// Parameters of a landing: the way onto the runway, what ends an approach, and what the wind does to it.
#pragma once
#include "fulmar/plugin.hpp"
#include "runway_site.hpp"

namespace fulmar::path {

/// The circle, the final approach and the glide slope.
struct PatternParams {
  Param glide_slope{0.07, "rad", 0.02, 0.3,
                    "of the approach; what touches down with a late flare is its sink"};
  Param aim{50, "m", 0, 500, "from the threshold to where the glide slope meets the runway"};
  Param final_length{400, "m", 50, 10000, "of the final approach, from its circle to the threshold"};
  Param circle_radius{70, "m", 10, 2000, "of the circle that leads onto it"};
  Choice<Turn> circle{Turn::left, "how that circle is flown"};
};

inline Pattern pattern_of(const PatternParams& p) {
  return {p.glide_slope, p.aim, p.final_length, p.circle_radius, p.circle};
}

/// What is looked at before the decision height.
struct GoAroundLimits {
  Param decision_height{12, "m", 1, 100, "above the runway, down to where it may go around"};
  Param cross_limit{8, "m", 0.5, 100, "farther from the centre line below twice that height: go around"};
  Param height_limit{6, "m", 0.5, 100, "farther from the glide slope below twice that height: go around"};
};

/// What the wind does to an approach: refuse it and stay on the circle, or fly it with a warning.
enum class WindAnswer : std::uint8_t { refuse, warn };

struct WindLimits {
  Choice<WindAnswer> wind{WindAnswer::refuse,
                          "an approach in more wind than crosswind_limit, or than the runway is long "
                          "enough for: refuse: stay on "
                          "the circle; warn: fly it with a warning"};
  Param wind_wait{180, "s", 0, 86400,
                  "after so long on the circle a refused approach is flown with a warning, as with less "
                  "than a fifth of the charge"};
  Param crosswind_limit{0.55, "ratio", 0, 2, "crosswind over approach airspeed, up to which it lands"};
};

}  // namespace fulmar::path

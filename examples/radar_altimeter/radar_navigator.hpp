// SPDX-License-Identifier: BSD-3-Clause
// The shipped estimator with a radar altimeter. The SDK provides alignment, gaps, origin and outputs.
#pragma once
#include "radar_measurement.hpp"

struct RadarNavigator {  // fills the role `nav`
  static constexpr const char* doc = "The shipped estimator with a radar altimeter.";
  struct Inputs {
    navigation::Inputs sensors;
    Queue<RadarRange> range;
  };
  struct Outputs {
    navigation::Outputs nav;
    Probe radar_ratio, radar_refused_ratio;  // last innovation over its std; number of rejected ranges
  };
  struct Params {
    navigation::Params nav;
    RadarMeasurement::Params radar;
  };

  void configure(const Params& p) { ekf_.configure(p.nav); }
  void retune(const Params& p) { ekf_.retune(p.nav); }
  Status activate(const Tick& tick, const Inputs& in, const Params& p, const Applied<Outputs>& last) {
    return ekf_.activate(tick, in.sensors, p.nav, last.part(last->nav));
  }
  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
    return ekf_.step(tick, in.sensors, p.nav, out.nav, [&](Navigator& navigator) {
      for (const auto& range : in.range) radar_.fuse(navigator, range.value, range.valid_at_s(), p.radar);
      out.radar_ratio = radar_.aid.ratio;
      out.radar_refused_ratio = radar_.aid.refused;
    });
  }

 private:
  navigation::Ekf ekf_;
  RadarMeasurement radar_;
};

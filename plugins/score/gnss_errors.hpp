// SPDX-License-Identifier: BSD-3-Clause
// The errors of the receiver's positions.
#pragma once
#include "fulmar/msg/gnss.hpp"
#include "fulmar/plugin.hpp"
#include "mean_square.hpp"
#include "score_messages.hpp"
#include "truth_frame.hpp"
#include "truth_history.hpp"

namespace fulmar::score {

class GnssErrors {
 public:
  void fix(const Optional<Gnss>& gnss, const TruthFrame& frame, const TruthHistory& history) {
    if (gnss.fresh() && gnss->fix != FixType::none && gnss->fix != FixType::time_only) {
      const Vec3<Ned> p = frame.at(gnss->latitude_deg, gnss->longitude_deg, gnss->altitude_m);
      pending_ = {true, gnss.valid_at_ns(), {}};
      pending_.sample.north = p.north;
      pending_.sample.east = p.east;
    }
    if (!pending_.waits) return;
    Compared truth;
    const TruthHistory::Found found = history.at(pending_.time_ns, truth);
    if (found == TruthHistory::Found::not_yet) return;
    pending_.waits = false;
    if (found == TruthHistory::Found::too_old) return;
    north_.add(pending_.sample.north - truth.north);
    east_.add(pending_.sample.east - truth.east);
  }
  bool any() const { return north_.count > 0; }
  GnssError rms() const { return {north_.rms(), east_.rms()}; }

 private:
  Pending pending_;
  MeanSquare north_, east_;
};

}  // namespace fulmar::score

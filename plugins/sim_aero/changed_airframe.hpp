// SPDX-License-Identifier: BSD-3-Clause
// The airframe in flight: that of the file with the additions of the parameters and ice.
#pragma once
#include "fulmar/msg/airframe.hpp"
#include "icing.hpp"
#include "model_params.hpp"

namespace fulmar::sim {

class ChangedAirframe {
 public:
  ChangedAirframe() = default;
  explicit ChangedAirframe(const Airframe& file) : file_(file), changed_(file) {}

  const Airframe& file() const { return file_; }
  /// Returns true when the additions differ from those before.
  bool add(const ModelParams& p) { return add_to(file_, p, changed_); }
  /// Returns true when the amount of ice differs from that before.
  bool freeze(double rate, double dt) { return icing_.advance(rate, dt); }
  double ice() const { return icing_.ice(); }
  Airframe now(const BodyFaultParams& p) const { return iced(changed_, icing_.ice(), p); }

 private:
  Airframe file_, changed_;
  Icing icing_;
};

}  // namespace fulmar::sim

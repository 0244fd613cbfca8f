// SPDX-License-Identifier: BSD-3-Clause
// Combines the sentences of one epoch, which have the same time, to one Gnss sample.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "fulmar/msg/gnss.hpp"
#include "nmea.hpp"

namespace fulmar::nmea {

inline FixType fix_type(int quality, int mode) {
  switch (quality) {
    case 1:  // satellites alone
    case 2:  // differential
    case 3:  // precise positioning service
    case 8:  // the receiver's own simulator
      return mode == 2 ? FixType::fix_2d : FixType::fix_3d;
    case 4: return FixType::rtk_fixed;
    case 5: return FixType::rtk_float;
    case 6: return FixType::dead_reckoning;
    default:  // 0 none, 7 manual input
      return FixType::none;
  }
}

/// Combines sentences to fixes. The kinds of sentences are taken from the last epochs: a fix is emitted as
/// soon as all of them are present. `emit` is called with each complete Gnss.
class Epochs {
 public:
  /// `range_std_m`: standard deviation of one range. It converts dilutions of precision to metres for a
  /// receiver without GST.
  explicit Epochs(double range_std_m = 3) : range_std_m_(range_std_m) {}

  template <class Emit>
  void take(const Sentence& s, Emit&& emit) {
    const std::string_view type = s.type();
    if (type == "GGA") {
      if (const auto r = gga(s)) join(kind_gga, r->time_ns, emit).gga = r;
    } else if (type == "RMC") {
      if (const auto r = rmc(s)) join(kind_rmc, r->time_ns, emit).rmc = r;
    } else if (type == "GST") {
      if (const auto r = gst(s)) join(kind_gst, r->time_ns, emit).gst = r;
    } else if (type == "VTG" && !(expected() & kind_rmc)) {
      now_.vtg = vtg(s);
      if (now_.vtg) now_.have |= kind_vtg;
    } else if (type == "GSA") {
      if (const auto r = gsa(s)) gsa_ = r;
    }
    const unsigned wanted = expected();
    if (wanted != 0 && (now_.have & wanted) == wanted) finish(emit);
  }

  /// The line is silent: emits the present epoch.
  template <class Emit>
  void flush(Emit&& emit) {
    finish(emit);
  }

  void reset() { *this = Epochs(range_std_m_); }

 private:
  static constexpr unsigned kind_gga = 1, kind_rmc = 2, kind_gst = 4, kind_vtg = 8;
  struct Epoch {
    std::optional<std::int64_t> time_ns;
    unsigned have = 0;
    bool emitted = false;
    std::optional<Gga> gga;
    std::optional<Rmc> rmc;
    std::optional<Gst> gst;
    std::optional<Vtg> vtg;
  };

  /// Kinds of the last epochs: a kind that is garbled once is still expected.
  unsigned expected() const {
    unsigned all = 0;
    for (const unsigned have : past_) all |= have;
    return all & kind_rmc ? all & ~kind_vtg : all;  // VTG repeats values of RMC
  }

  /// Assigns a sentence to an epoch. A new time begins an epoch; so does a repeated kind without a time.
  template <class Emit>
  Epoch& join(unsigned kind, std::optional<std::int64_t> time_ns, Emit&& emit) {
    const bool another = now_.time_ns != time_ns || (!time_ns && (now_.have & kind));
    if (another && (now_.have & ~kind_vtg)) {
      finish(emit);
      if (now_.have & kind_gga) past_[past_count_++ % past_.size()] = now_.have;
      now_ = {};
    }
    now_.time_ns = time_ns;
    now_.have |= kind;
    return now_;
  }

  template <class Emit>
  void finish(Emit&& emit) {
    if (now_.emitted || !now_.gga) return;
    now_.emitted = true;
    emit(sample());
  }

  Gnss sample() const {
    const Gga& g = *now_.gga;
    Gnss out;
    out.satellites = static_cast<std::uint8_t>(g.satellites);
    if (now_.rmc && now_.rmc->date_ns && now_.time_ns) out.utc_ns = *now_.rmc->date_ns + *now_.time_ns;
    const FixType fix = fix_type(g.quality, gsa_ ? gsa_->mode : 3);
    if (fix == FixType::none || !g.latitude_deg || !g.longitude_deg || !g.altitude_m) return out;
    out.fix = fix;
    out.latitude_deg = *g.latitude_deg;
    out.longitude_deg = *g.longitude_deg;
    out.altitude_m = *g.altitude_m;
    add_deviations(g, out);
    add_velocity(out);
    return out;
  }

  void add_deviations(const Gga& g, Gnss& out) const {
    const bool reported = now_.gst && now_.gst->latitude_m && now_.gst->longitude_m;
    if (reported) {  // standard deviation of one axis, as in all messages
      const double n = *now_.gst->latitude_m, e = *now_.gst->longitude_m;
      out.horizontal_std_m = std::sqrt((n * n + e * e) / 2);
    } else if (g.hdop) {
      out.horizontal_std_m = *g.hdop * range_std_m_ / std::numbers::sqrt2;
    }
    if (now_.gst && now_.gst->altitude_m) {
      out.vertical_std_m = *now_.gst->altitude_m;
    } else if (gsa_ && gsa_->vdop) {
      out.vertical_std_m = *gsa_->vdop * range_std_m_;
    }
  }

  /// NMEA has no vertical speed and no standard deviation of a velocity: `down` stays 0 and `speed_std_mps`
  /// unknown.
  void add_velocity(Gnss& out) const {
    std::optional<double> v, chi;
    if (now_.rmc && now_.rmc->valid) {
      v = now_.rmc->speed_mps;
      chi = now_.rmc->course_rad;
    } else if (!now_.rmc && now_.vtg) {
      v = now_.vtg->speed_mps;
      chi = now_.vtg->course_rad;
    }
    if (v && chi) out.velocity_mps = {*v * std::cos(*chi), *v * std::sin(*chi), 0};
  }

  double range_std_m_;
  Epoch now_;
  std::optional<Gsa> gsa_;  // without a time: the last one is used
  std::array<unsigned, 4> past_{};
  std::size_t past_count_ = 0;
};

}  // namespace fulmar::nmea

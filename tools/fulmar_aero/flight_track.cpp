// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_aero/flight_track.hpp"

#include "core/loader/table.hpp"
#include "core/log/reader.hpp"
#include "core/types/wire.hpp"
#include "fulmar/msg/attitude_command.hpp"
#include "fulmar/msg/guidance_command.hpp"
#include "fulmar/msg/vehicle_state.hpp"
#include "fulmar/schema.hpp"
#include "tools/log_reading/log_file.hpp"

namespace fulmar::aero {
namespace {

/// The messages of one topic, thinned.
template <class Message>
class Thinned {
 public:
  explicit Thinned(const char* topic) : topic_(topic), type_(core::copy_type(describe<Message>())) {}

  /// True when the message is to be kept; `value` then holds it.
  bool takes(const core::McapFile& log, const core::McapFile::Message& m) {
    if (m.log_ns < next_ns_ || log.channels.at(m.channel).topic != topic_) return false;
    next_ns_ =
        m.log_ns + std::uint64_t(track_step_s * 1e9) - 1'000'000;  // times of ticks do not divide evenly
    core::cdr_decode(*type_, m.data.data(), m.data.size(), reinterpret_cast<std::byte*>(&value));
    return true;
  }
  Message value;

 private:
  std::string topic_;
  core::TypePtr type_;
  std::uint64_t next_ns_ = 0;
};

}  // namespace

FlightTrack track_of(const std::filesystem::path& log) {
  core::McapStream stream(log);
  FlightTrack track;
  Thinned<VehicleState> truth("/vehicle/truth");
  Thinned<GuidanceCommand> command("/guide/command");
  Thinned<AttitudeCommand> attitude("/outer/attitude");
  std::uint64_t epoch_ns = 0;
  bool first = true;
  while (const core::McapFile::Message* m = stream.next()) {
    if (first) epoch_ns = core::log_epoch_ns(stream.log(), m->log_ns);
    first = false;
    const double t = 1e-9 * double(std::int64_t(m->log_ns - epoch_ns));
    if (truth.takes(stream.log(), *m)) {
      const VehicleState& x = truth.value;
      track.truth.push_back({t, x.position_m.north, x.position_m.east, x.height_m, x.airspeed_mps, x.roll_rad,
                             x.pitch_rad, x.alpha_rad});
    } else if (command.takes(stream.log(), *m)) {
      track.commands.push_back({t, command.value.height_m, command.value.airspeed_mps});
    } else if (attitude.takes(stream.log(), *m)) {
      track.attitudes.push_back({t, attitude.value.roll_rad, attitude.value.pitch_rad});
    }
  }
  return track;
}

}  // namespace fulmar::aero

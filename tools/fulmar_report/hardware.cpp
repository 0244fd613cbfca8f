// SPDX-License-Identifier: BSD-3-Clause
// See hardware.hpp.
#include "tools/fulmar_report/hardware.hpp"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <tuple>

#include "core/log/reader.hpp"
#include "fulmar/message.hpp"
#include "fulmar/msg/vehicle_status.hpp"
#include "plugins/fcu_serial/reports.hpp"
#include "tools/fulmar_log/states.hpp"

namespace fulmar::report {
namespace {

using core::McapFile;
using nlohmann::json;

constexpr std::string_view greeting = "connected: ";
/// Parameters that a calibration sets.
constexpr std::string_view calibrated[] = {"ACC_X_BIAS",  "ACC_Y_BIAS",   "ACC_Z_BIAS",     "GYRO_X_BIAS",
                                           "GYRO_Y_BIAS", "GYRO_Z_BIAS",  "MAG_X_BIAS",     "MAG_Y_BIAS",
                                           "MAG_Z_BIAS",  "MAG_CAL_A00",  "MAG_CAL_A11",    "MAG_CAL_A22",
                                           "BARO_BIAS",   "GROUND_LEVEL", "DIFF_PRESS_BIAS"};

/// The messages with room for longer texts, as a log may contain them.
struct LoggedNotice {
  Text<4096> text;
};
struct LoggedParameter {
  Text<4096> name, value;
};

/// In control, by the status.
const char* pilot_of(const VehicleStatus& s) {
  if (!s.armed) return "disarmed";
  if (s.failsafe) return "failsafe";
  if (s.override) return "pilot";
  return s.in_control ? "computer" : "neither";
}

class ControllerReading {
 public:
  explicit ControllerReading(const std::filesystem::path& log) : stream_(log) {}

  json run() {
    while (const McapFile::Message* m = stream_.next()) take(*m);
    if (!link_) return nullptr;
    return {{"firmware", firmware_.empty() ? json() : json(firmware_)},
            {"calibration", calibration_.empty() ? json() : json(calibration_)},
            {"parameters_changed", changed_},
            {"link", link_json(*link_)},
            {"battery", battery()},
            {"radio_age_max_s", radio_age_s_ < 0 ? json() : json(radio_age_s_)},
            {"who_flew_s", flown_.empty() ? json() : json(flown_)}};
  }

 private:
  template <class Message>
  std::optional<Message> read(const McapFile::Message& m, const char* type) {
    const McapFile::Channel& channel = stream_.log().channels.at(m.channel);
    const std::string& name = stream_.log().schemas.at(channel.schema).name;
    if (!name.ends_with(std::string("/") + type)) return std::nullopt;
    auto& readers = std::get<std::map<std::uint16_t, states::MessageReader<Message>>>(readers_);
    auto at = readers.find(m.channel);
    if (at == readers.end())
      at = readers.emplace(m.channel, states::MessageReader<Message>(stream_.log(), m.channel)).first;
    return at->second.read(m.data);
  }

  void take(const McapFile::Message& m) {
    if (const auto s = read<VehicleStatus>(m, "VehicleStatus")) return status(*s, m.publish_ns);
    if (const auto l = read<fcu::LinkStatus>(m, "LinkStatus")) return void(link_ = *l);
    if (const auto p = read<LoggedParameter>(m, "ControllerParameter")) return parameter(*p);
    if (const auto n = read<LoggedNotice>(m, "Notice"); n && n->text.view().starts_with(greeting))
      firmware_ = n->text.view().substr(greeting.size());
  }

  void status(const VehicleStatus& s, std::uint64_t at_ns) {
    if (who_ && at_ns > since_ns_) flown_[who_] += 1e-9 * static_cast<double>(at_ns - since_ns_);
    who_ = pilot_of(s);
    since_ns_ = at_ns;
    if (s.armed && s.rc_age_s < 1e9) radio_age_s_ = std::max(radio_age_s_, s.rc_age_s);
    if (s.battery_volt <= 0) return;
    if (first_volt_ < 0) first_volt_ = s.battery_volt;
    last_volt_ = s.battery_volt;
    min_volt_ = std::min(min_volt_, s.battery_volt);
    max_amp_ = std::max(max_amp_, s.battery_amp);
  }

  void parameter(const LoggedParameter& p) {
    const std::string name(p.name.view()), value(p.value.view());
    if (const auto before = parameters_.find(name); before != parameters_.end() && before->second != value)
      ++changed_;
    parameters_[name] = value;
    if (std::find(std::begin(calibrated), std::end(calibrated), name) != std::end(calibrated))
      calibration_[name] = value;
  }

  static json link_json(const fcu::LinkStatus& l) {
    return {{"frames", l.frames},           {"bad", l.bad},
            {"missing", l.missing},         {"dropped", l.dropped},
            {"unusable", l.unusable},       {"commands", l.commands},
            {"unsent", l.unsent},           {"reboots", l.reboots},
            {"connections", l.connections}, {"imu_gaps", l.imu_gaps},
            {"worst_gap_s", l.worst_gap_s}, {"round_trip_s", l.round_trip_s}};
  }
  json battery() const {
    if (first_volt_ < 0) return nullptr;
    return {{"first_volt", first_volt_},
            {"last_volt", last_volt_},
            {"least_volt", min_volt_},
            {"most_amp", max_amp_}};
  }

  template <class Message>
  using Readers = std::map<std::uint16_t, states::MessageReader<Message>>;

  core::McapStream stream_;
  std::tuple<Readers<VehicleStatus>, Readers<fcu::LinkStatus>, Readers<LoggedParameter>,
             Readers<LoggedNotice>>
      readers_;
  std::optional<fcu::LinkStatus> link_;  // the last
  std::string firmware_;
  std::map<std::string, std::string> parameters_, calibration_;
  std::size_t changed_ = 0;
  std::map<std::string, double> flown_;
  const char* who_ = nullptr;
  std::uint64_t since_ns_ = 0;
  double radio_age_s_ = -1, first_volt_ = -1, last_volt_ = 0, min_volt_ = 1e9, max_amp_ = 0;
};

}  // namespace

json hardware_of(const std::filesystem::path& log) { return ControllerReading(log).run(); }

}  // namespace fulmar::report

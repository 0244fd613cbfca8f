// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_fcu/status.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "tools/fulmar_fcu/messages.hpp"
#include "tools/fulmar_fcu/words.hpp"

namespace fulmar::fcu {

namespace {

constexpr double deg = 180 / std::numbers::pi;

struct Euler {
  double roll_deg = 0, pitch_deg = 0, yaw_deg = 0;
};

Euler euler(const AttitudeQuaternion& q) {
  const double w = q.q1, x = q.q2, y = q.q3, z = q.q4;
  return {std::atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y)) * deg,
          std::asin(std::clamp(2 * (w * y - z * x), -1.0, 1.0)) * deg,
          std::atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)) * deg};
}

std::array<std::uint16_t, 8> channels(const RcChannels& rc) {
  return {rc.chan1_raw, rc.chan2_raw, rc.chan3_raw, rc.chan4_raw,
          rc.chan5_raw, rc.chan6_raw, rc.chan7_raw, rc.chan8_raw};
}

std::string line(const std::string& what, const std::string& value) {
  return what + std::string(what.size() < 13 ? 13 - what.size() : 1, ' ') + value + "\n";
}

std::string listed(const std::vector<std::string>& words) {
  return words.empty() ? "none" : core::join(words);
}

std::string age_words(double age_s) {
  return age_s > 1e6 ? "never heard" : age_s < 1.05 ? "" : fixed(age_s, 1) + " s old";
}

std::string with_age(const std::string& text, double age_s) {
  return age_s < 1.05 ? text : text + "  (" + age_words(age_s) + ")";
}

std::string radio_text(const Client& client) {
  const auto rc = client.last<RcChannels>();
  const double age_s = client.age_s<RcChannels>();
  if (!rc) return line("radio", "no frame was ever heard");
  std::string out;
  for (const std::uint16_t us : channels(*rc)) out += std::to_string(us) + " ";
  return line(
      "radio",
      out + "us" + (age_s > 0.5 ? "  STOPPED " + fixed(age_s, 1) + " s ago: the outputs are frozen" : ""));
}

std::string gnss_text(const Client& client) {
  const auto g = client.last<RosflightGnss>();
  if (!g) return line("GNSS", "not heard");
  std::string out = fix_words(g->fix_type) + ", " + std::to_string(g->num_sat) + " satellites";
  if (g->fix_type >= 2 && g->fix_type != 5)
    out += ", " + fixed(g->lat, 7) + " " + fixed(g->lon, 7) + ", " + fixed(g->height, 1) + " m, +-" +
           fixed(g->h_acc, 1) + " m";
  return line("GNSS", with_age(out, client.age_s<RosflightGnss>()));
}

std::string air_text(const Client& client) {
  std::string out;
  if (const auto baro = client.last<SmallBaro>())
    out += fixed(baro->pressure, 0) + " Pa, " + fixed(baro->altitude, 1) + " m ISA, " +
           fixed(baro->temperature - 273.15, 1) + " degC";
  if (const auto dp = client.last<DiffPressure>())
    out += (out.empty() ? "" : "; ") + fixed(dp->velocity, 1) + " m/s indicated";
  return line("air", out.empty() ? "no barometer, no airspeed sensor heard" : out);
}

std::string sensors_text(const Client& client) {
  std::string out;
  const auto q = client.last<AttitudeQuaternion>();
  if (q && !finite(*q)) {
    out += line("attitude", fcu_messages::attitude_not_finite());
  } else if (q) {
    const Euler e = euler(*q);
    out +=
        line("attitude", with_age("roll " + fixed(e.roll_deg, 1) + "  pitch " + fixed(e.pitch_deg, 1) +
                                      "  yaw " + fixed(e.yaw_deg, 1) + " deg (yaw drifts: no compass in it)",
                                  client.age_s<AttitudeQuaternion>()));
  }
  out += air_text(client) + gnss_text(client);
  const auto battery = client.last<RosflightBatteryStatus>();
  out += line("battery", battery ? fixed(battery->battery_voltage, 2) + " V, " +
                                       fixed(battery->battery_current, 1) + " A"
                                 : "not heard");
  return out;
}

struct Kind {
  std::uint8_t id;
  const char* name;
};
constexpr std::array<Kind, 8> kinds{{{SmallImu::id, "IMU"},
                                     {SmallMag::id, "mag"},
                                     {SmallBaro::id, "baro"},
                                     {DiffPressure::id, "airspeed"},
                                     {RosflightGnss::id, "GNSS"},
                                     {SmallRange::id, "range"},
                                     {RcChannels::id, "radio"},
                                     {RosflightStatus::id, "status"}}};

std::string link_text(const Client& client, const Meter& meter) {
  std::string rates;
  for (const Kind& kind : kinds)
    if (client.count_of(kind.id) > 0)
      rates +=
          (rates.empty() ? "" : ", ") + std::string(kind.name) + " " + fixed(meter.rate(client, kind.id), 0);
  return line("rates", rates + " Hz") +
         line("link", fixed(meter.bytes_per_s(client) / 1000, 1) + " kB/s, " +
                          fixed(100 * meter.loss_ratio(client), 1) + " % of the frames lost");
}

}  // namespace

void Meter::restart(const Client& client) {
  for (std::size_t i = 0; i < count_.size(); ++i) count_[i] = client.count_of(static_cast<std::uint8_t>(i));
  bytes_ = client.bytes();
  parser_ = client.counts();
  since_ns_ = client.now_ns();
}

double Meter::span_s(const Client& client) const {
  return std::max(1e-3, static_cast<double>(client.now_ns() - since_ns_) * 1e-9);
}

double Meter::rate(const Client& client, std::uint8_t id) const {
  return static_cast<double>(client.count_of(id) - count_[id]) / span_s(client);
}

double Meter::bytes_per_s(const Client& client) const {
  return static_cast<double>(client.bytes() - bytes_) / span_s(client);
}

double Meter::loss_ratio(const Client& client) const {
  const auto missing = static_cast<double>(client.counts().missing - parser_.missing);
  const auto frames = static_cast<double>(client.counts().frames - parser_.frames);
  return missing + frames > 0 ? missing / (missing + frames) : 0;
}

bool finite(const AttitudeQuaternion& q) {
  return std::isfinite(q.q1 + q.q2 + q.q3 + q.q4 + q.rollspeed + q.pitchspeed + q.yawspeed);
}

std::string control_words(const RosflightStatus& status, double rc_age_s) {
  if (status.failsafe != 0) return fcu_messages::failsafe_in_control().line();
  if (rc_age_s > 0.5) return fcu_messages::outputs_frozen().line();
  if ((status.rc_override & (override_by_pilot | override_inactive)) == 0 && status.offboard != 0)
    return "the computer";
  return "the pilot (" + core::join(override_words(status.rc_override)) + ")";
}

std::string status_text(const Client& client, const Meter& meter) {
  const auto status = client.last<RosflightStatus>();
  const auto heartbeat = client.last<Heartbeat>();
  std::string out =
      line("controller",
           (client.version().empty() ? "firmware not told" : "ROSflight " + client.version()) +
               (heartbeat ? heartbeat->type == 1 ? ", fixed wing" : ", NOT set up as a fixed wing" : "") +
               ", on " + client.name());
  if (status) {
    std::string state = status->armed != 0 ? "ARMED" : "disarmed";
    if (status->failsafe != 0) state += ", FAILSAFE";
    state += ", loop " + std::to_string(status->loop_time_us) + " us";
    if (status->num_errors > 0)
      state += ", " + std::to_string(status->num_errors) + " sensor faults at start";
    out += line("state", with_age(state, client.age_s<RosflightStatus>()));
    out += line("flies", control_words(*status, client.age_s<RcChannels>()));
    out += line("errors", listed(error_words(status->error_code)));
  }
  out += radio_text(client) + sensors_text(client) + link_text(client, meter);
  const std::size_t n = client.said().size();
  for (std::size_t i = n > 3 ? n - 3 : 0; i < n; ++i)
    out += line("said", severity_word(client.said()[i].severity) + ": " + client.said()[i].text);
  return out;
}

std::string status_json(const Client& client, const Meter& meter) {
  nlohmann::json out{
      {"port", client.name()},
      {"version", client.version().empty() ? nlohmann::json() : nlohmann::json(client.version())}};
  if (const auto s = client.last<RosflightStatus>()) {
    out["armed"] = s->armed != 0;
    out["failsafe"] = s->failsafe != 0;
    out["offboard"] = s->offboard != 0;
    out["override"] = override_words(s->rc_override);
    out["errors"] = error_words(s->error_code);
    out["loop_time_us"] = s->loop_time_us;
    out["sensor_faults"] = s->num_errors;
  }
  if (const auto rc = client.last<RcChannels>())
    out["radio"] = {{"channels_us", channels(*rc)}, {"age_s", client.age_s<RcChannels>()}};
  if (const auto b = client.last<RosflightBatteryStatus>())
    out["battery"] = {{"volt", b->battery_voltage}, {"amp", b->battery_current}};
  if (const auto g = client.last<RosflightGnss>())
    out["gnss"] = {
        {"fix", fix_words(g->fix_type)}, {"satellites", g->num_sat}, {"lat_deg", g->lat}, {"lon_deg", g->lon},
        {"height_m", g->height},         {"h_acc_m", g->h_acc}};
  if (const auto q = client.last<AttitudeQuaternion>(); q && finite(*q)) {
    const Euler e = euler(*q);
    out["attitude"] = {{"roll_deg", e.roll_deg}, {"pitch_deg", e.pitch_deg}, {"yaw_deg", e.yaw_deg}};
  }
  for (const Kind& kind : kinds) out["rates_hz"][kind.name] = meter.rate(client, kind.id);
  out["link"] = {{"kB_per_s", meter.bytes_per_s(client) / 1000}, {"loss_ratio", meter.loss_ratio(client)}};
  return out.dump(1);
}

std::string version_json(const Client& client) {
  return nlohmann::json{{"version", client.version()}}.dump(1);
}

}  // namespace fulmar::fcu

// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_fcu/board_bench.hpp"

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "tools/fulmar_fcu/status.hpp"
#include "tools/fulmar_fcu/words.hpp"

namespace fulmar::fcu {

namespace {

/// Statistics of the packets of some seconds.
class Listener {
 public:
  explicit Listener(BoardReport& report) : r_(report) {
    r_.streams = {
        {"inertial", SmallImu::id, -1, {}},          {"attitude", AttitudeQuaternion::id, -1, {}},
        {"outputs", RosflightOutputRaw::id, -1, {}}, {"magnetometer", SmallMag::id, -1, {}},
        {"barometer", SmallBaro::id, -1, {}},        {"pitot", DiffPressure::id, -1, {}},
        {"gnss", RosflightGnss::id, -1, {}},         {"battery", RosflightBatteryStatus::id, -1, {}},
        {"radio", RcChannels::id, -1, {}},           {"status", RosflightStatus::id, -1, {}}};
  }

  void take(const Packet& p, double now_s) {
    for (Stream& s : r_.streams) {
      if (s.id != p.id) continue;
      if (s.last_s >= 0) s.interval_s.add(now_s - s.last_s);
      s.last_s = now_s;
    }
    if (p.is<SmallImu>()) inertial(p.as<SmallImu>());
    if (p.is<SmallMag>()) field(p.as<SmallMag>());
    if (p.is<SmallBaro>()) add("barometer_pa", "Pa", p.as<SmallBaro>().pressure);
    if (p.is<DiffPressure>()) add("pitot_pa", "Pa", p.as<DiffPressure>().diff_pressure);
    if (p.is<RosflightGnss>()) fix(p.as<RosflightGnss>());
    if (p.is<RosflightBatteryStatus>()) {
      add("battery_volt", "V", p.as<RosflightBatteryStatus>().battery_voltage);
      add("battery_amp", "A", p.as<RosflightBatteryStatus>().battery_current);
    }
  }

 private:
  void add(const char* name, const char* unit, double value) {
    if (!std::isfinite(value)) return;
    auto at = std::find_if(r_.channels.begin(), r_.channels.end(), [&](auto& c) { return c.name == name; });
    if (at == r_.channels.end()) at = r_.channels.insert(at, {name, unit, {}});
    at->value.add(value);
  }
  void inertial(const SmallImu& m) {
    add("accel_x_mps2", "m/s2", m.xacc);
    add("accel_y_mps2", "m/s2", m.yacc);
    add("accel_z_mps2", "m/s2", m.zacc);
    add("gyro_x_radps", "rad/s", m.xgyro);
    add("gyro_y_radps", "rad/s", m.ygyro);
    add("gyro_z_radps", "rad/s", m.zgyro);
    add("imu_kelvin", "K", m.temperature);
    if (clock_us_ > 0 && m.time_boot_us > clock_us_) clocks_us_.push_back(m.time_boot_us - clock_us_);
    clock_us_ = m.time_boot_us;
  }
  void field(const SmallMag& m) {
    add("mag_x_tesla", "T", m.xmag);
    add("mag_y_tesla", "T", m.ymag);
    add("mag_z_tesla", "T", m.zmag);
  }
  void fix(const RosflightGnss& m) {
    constexpr double metres_per_deg = 111'320;
    if (m.fix_type != 3) return;
    if (!began_) first_lat_ = m.lat;
    if (!began_) first_lon_ = m.lon;
    began_ = true;
    add("gnss_north_m", "m", (m.lat - first_lat_) * metres_per_deg);
    add("gnss_east_m", "m", (m.lon - first_lon_) * metres_per_deg * std::cos(m.lat * 0.017453292519943295));
    add("gnss_height_m", "m", m.height);
    add("gnss_satellites", "", m.num_sat);
    add("gnss_horizontal_std_m", "m", m.h_acc);
  }

 public:
  /// Counts samples that the board took but that did not arrive, by the usual step of its clock.
  void finish() {
    if (clocks_us_.empty()) return;
    std::vector<std::uint64_t> sorted = clocks_us_;
    std::sort(sorted.begin(), sorted.end());
    const double usual = static_cast<double>(sorted[sorted.size() / 2]);
    for (const std::uint64_t step : clocks_us_)
      r_.imu_lost +=
          static_cast<std::uint64_t>(std::max(0.0, std::round(static_cast<double>(step) / usual) - 1));
    r_.imu_gap_s = 1e-6 * static_cast<double>(sorted.back());
  }

 private:
  BoardReport& r_;
  std::uint64_t clock_us_ = 0;
  std::vector<std::uint64_t> clocks_us_;
  double first_lat_ = 0, first_lon_ = 0;
  bool began_ = false;
};

void ask_round_trips(Client& client, int questions, BoardReport& r) {
  for (int i = 0; i < questions; ++i) {
    if (const auto ns = client.round_trip_ns(1))
      r.round_trips_s.push_back(1e-9 * static_cast<double>(*ns));
    else
      ++r.unanswered;
  }
  std::sort(r.round_trips_s.begin(), r.round_trips_s.end());
}

std::string digits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.5g", value);
  return text;
}

}  // namespace

BoardReport measure_board(Client& client, double seconds, int questions) {
  BoardReport r;
  r.port = client.name();
  r.version = client.version();
  ask_round_trips(client, questions, r);
  Listener listener(r);
  const Parser::Counts before = client.counts();
  const std::uint64_t bytes = client.bytes();
  const std::int64_t begun_ns = client.now_ns();
  client.on_packet = [&](const Packet& p) {
    listener.take(p, 1e-9 * static_cast<double>(client.now_ns() - begun_ns));
  };
  client.pump(static_cast<std::int64_t>(seconds * 1e9));
  client.on_packet = {};
  listener.finish();
  r.seconds = 1e-9 * static_cast<double>(client.now_ns() - begun_ns);
  r.bytes_per_s = static_cast<double>(client.bytes() - bytes) / r.seconds;
  r.frames = client.counts().frames - before.frames;
  r.missing = client.counts().missing - before.missing;
  r.bad = client.counts().bad - before.bad;
  return r;
}

double quantile(const std::vector<double>& sorted, double share) {
  if (sorted.empty()) return 0;
  const auto at = static_cast<std::size_t>(share * static_cast<double>(sorted.size()));
  return sorted[std::min(at, sorted.size() - 1)];
}

nlohmann::json board_json(const BoardReport& r) {
  using nlohmann::json;
  const auto trip = [&](double share) {
    return r.round_trips_s.empty() ? json() : json(quantile(r.round_trips_s, share));
  };
  json out{
      {"port", r.port},
      {"version", r.version.empty() ? json() : json(r.version)},
      {"at", r.at.empty() ? json() : json(r.at)},
      {"seconds", r.seconds},
      {"link",
       {{"bytes_per_s", r.bytes_per_s},
        {"frames", r.frames},
        {"missing", r.missing},
        {"bad", r.bad},
        {"unanswered", r.unanswered},
        {"round_trip_s", {{"least", trip(0)}, {"median", trip(0.5)}, {"p99", trip(0.99)}, {"most", trip(1)}}},
        {"imu_lost", r.imu_lost},
        {"imu_gap_s", r.imu_gap_s}}},
      {"streams", json::object()},
      {"noise", json::object()}};
  for (const Stream& s : r.streams) {
    if (s.last_s < 0) {
      out["streams"][s.name] = nullptr;
      continue;
    }
    const Spread& i = s.interval_s;
    out["streams"][s.name] = {{"rate_hz", i.count() > 0 ? json(1 / i.mean()) : json()},
                              {"gap_s", i.count() > 0 ? json(i.most()) : json()},
                              {"jitter_std_s", i.count() > 1 ? json(i.deviation()) : json()}};
  }
  for (const Channel& c : r.channels)
    out["noise"][c.name] = {
        {"mean", c.value.mean()}, {"std", c.value.deviation()}, {"samples", c.value.count()}};
  return out;
}

std::string board_markdown(const BoardReport& r) {
  const double sent = static_cast<double>(r.frames + r.missing);
  std::string out = "# Flight controller at " + r.port + "\n\n| | |\n|---|---|\n";
  const auto row = [&](const std::string& name, const std::string& value) {
    out += "| " + name + " | " + value + " |\n";
  };
  row("firmware", r.version.empty() ? "not told" : r.version);
  if (!r.at.empty()) row("time", r.at);
  row("listened for", fixed(r.seconds, 1) + " s");
  row("link", fixed(r.bytes_per_s / 1000, 1) + " kB/s, " + std::to_string(r.missing) + " of " +
                  std::to_string(r.frames + r.missing) + " frames lost (" +
                  fixed(sent > 0 ? 100 * static_cast<double>(r.missing) / sent : 0, 2) + " %), " +
                  std::to_string(r.bad) + " damaged");
  row("round trip", r.round_trips_s.empty()
                        ? "no answer"
                        : fixed(1e3 * quantile(r.round_trips_s, 0.5), 2) + " ms (median), " +
                              fixed(1e3 * quantile(r.round_trips_s, 0.99), 2) + " ms (99 %), " +
                              fixed(1e3 * r.round_trips_s.back(), 2) + " ms (most); " +
                              std::to_string(r.unanswered) + " without an answer");
  row("inertial samples lost",
      std::to_string(r.imu_lost) + ", longest gap " + fixed(1e3 * r.imu_gap_s, 1) + " ms");
  out += "\n| message | rate, Hz | longest gap, ms | jitter, ms |\n|---|---|---|---|\n";
  for (const Stream& s : r.streams) {
    const Spread& i = s.interval_s;
    out += "| " + s.name;
    out += i.count() == 0 ? std::string(" | - | - | - |\n")
                          : " | " + fixed(1 / i.mean(), 1) + " | " + fixed(1e3 * i.most(), 1) + " | " +
                                fixed(1e3 * i.deviation(), 2) + " |\n";
  }
  out += "\n| sensor at rest | mean | standard deviation | unit | samples |\n|---|---|---|---|---|\n";
  for (const Channel& c : r.channels)
    out += "| " + c.name + " | " + digits(c.value.mean()) + " | " + digits(c.value.deviation()) + " | " +
           c.unit + " | " + std::to_string(c.value.count()) + " |\n";
  return out;
}

}  // namespace fulmar::fcu

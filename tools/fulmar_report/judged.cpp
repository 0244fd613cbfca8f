// SPDX-License-Identifier: BSD-3-Clause
// See judged.hpp.
#include "tools/fulmar_report/judged.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/error.hpp"
#include "core/log/events.hpp"
#include "fulmar/msg/filter_check.hpp"
#include "fulmar/msg/navigation_health.hpp"
#include "tools/fulmar_log/compare_command.hpp"
#include "tools/fulmar_log/quantities.hpp"

namespace fulmar::report {
namespace {

using core::McapFile;
using nlohmann::json;

/// One sensor of NavigationHealth, which repeats an innovation until the next measurement.
struct Watched {
  const char* words;
  SensorHealth NavigationHealth::*sensor;
  bool of_fixes;  // FilterCheck has these by axis
};
constexpr Watched watched[] = {{"GNSS position, larger axis", &NavigationHealth::gnss_position, true},
                               {"GNSS height", &NavigationHealth::gnss_height, true},
                               {"GNSS velocity, largest axis", &NavigationHealth::gnss_velocity, true},
                               {"magnetometer", &NavigationHealth::mag, false},
                               {"barometer", &NavigationHealth::baro, false},
                               {"airspeed", &NavigationHealth::pitot, false}};

JudgedSeries series_of(const std::string& words, const std::string& unit, std::size_t columns) {
  JudgedSeries s;
  s.words = words;
  s.unit = unit;
  s.columns.values.resize(columns);
  return s;
}

void add_ratio(JudgedSeries& series, std::int64_t ns, double ratio) {
  if (!std::isfinite(ratio)) return;
  series.columns.t.push_back(tenths_of_ms(ns));
  series.columns.values[0].push_back(static_cast<float>(ratio));
  series.all.add(ratio);
  series.claimed.add(ratio, 1);
}

class InnovationReading {
 public:
  explicit InnovationReading(const states::StateLog& log) : log_(log) {
    for (const char* axis : {"GNSS position north", "GNSS position east", "GNSS position down",
                             "GNSS velocity north", "GNSS velocity east", "GNSS velocity down"})
      of_check_.push_back(series_of(axis, "", 1));
    for (const Watched& w : watched) of_health_.push_back(series_of(w.words, "", 1));
  }
  void run() {
    core::McapStream stream(log_.file);
    while (const McapFile::Message* m = stream.next()) {
      const auto type = log_.types.find(stream.log().channels.at(m->channel).topic);
      if (type == log_.types.end()) continue;
      if (type->second == "FilterCheck") take_check(stream.log(), *m);
      if (type->second == "NavigationHealth") take_health(stream.log(), *m);
    }
  }
  std::vector<JudgedSeries> take() {
    std::vector<JudgedSeries> out;
    const bool by_axis = of_check_[0].all.n > 0;
    for (JudgedSeries& s : of_check_)
      if (s.all.n > 0) out.push_back(std::move(s));
    for (std::size_t i = 0; i < of_health_.size(); ++i)
      if (of_health_[i].all.n > 0 && !(by_axis && watched[i].of_fixes))
        out.push_back(std::move(of_health_[i]));
    return out;
  }

 private:
  template <class Message>
  using Reader = std::optional<std::pair<std::uint16_t, states::MessageReader<Message>>>;

  /// Reads the first topic of its type: with several filters in a log the active one comes first.
  template <class Message>
  std::optional<Message> read(Reader<Message>& reader, const McapFile& log, const McapFile::Message& m) {
    if (!reader) reader.emplace(m.channel, states::MessageReader<Message>(log, m.channel));
    if (reader->first != m.channel) return std::nullopt;
    return reader->second.read(m.data);
  }
  std::int64_t flight_ns(const McapFile::Message& m) const {
    return static_cast<std::int64_t>(m.publish_ns - log_.epoch_ns);
  }
  void take_check(const McapFile& log, const McapFile::Message& m) {
    const std::optional<FilterCheck> check = read(check_reader_, log, m);
    if (!check) return;
    const Vec3<Ned>&p = check->position_innovation_ratio, &v = check->velocity_innovation_ratio;
    const double ratios[] = {p.north, p.east, p.down, v.north, v.east, v.down};
    for (std::size_t i = 0; i < of_check_.size(); ++i) add_ratio(of_check_[i], flight_ns(m), ratios[i]);
  }
  void take_health(const McapFile& log, const McapFile::Message& m) {
    const std::optional<NavigationHealth> health = read(health_reader_, log, m);
    if (!health) return;
    for (std::size_t i = 0; i < of_health_.size(); ++i) {
      const SensorHealth& sensor = (*health).*watched[i].sensor;
      const std::uint32_t count = sensor.accepted + sensor.refused;
      if (count != counts_[i]) add_ratio(of_health_[i], flight_ns(m), sensor.innovation_ratio);
      counts_[i] = count;
    }
  }

  const states::StateLog& log_;
  std::vector<JudgedSeries> of_check_, of_health_;
  Reader<FilterCheck> check_reader_;
  Reader<NavigationHealth> health_reader_;
  std::array<std::uint32_t, std::size(watched)> counts_{};
};

JudgedEstimate judged_estimate(const states::StateLog& log, const std::string& topic) {
  const states::Side side = states::usual_side(log, topic);
  JudgedEstimate out;
  out.topic = topic;
  out.truth = !side.truth.empty();
  out.reference = out.truth ? side.truth : side.fixes;
  if (out.reference.empty()) return out;
  for (const states::Quantity& q : states::quantities()) out.series.push_back(series_of(q.words, q.unit, 2));
  out.judged = states::judge(side, [&](std::int64_t ns, std::size_t quantity, double error, double claim) {
    Columns& c = out.series[quantity].columns;
    c.t.push_back(tenths_of_ms(ns));
    c.values[0].push_back(static_cast<float>(error));
    c.values[1].push_back(static_cast<float>(claim));
  });
  for (std::size_t i = 0; i < out.series.size(); ++i) {
    out.series[i].all = out.judged.errors.all[i];
    out.series[i].claimed = out.judged.errors.claimed[i];
  }
  std::erase_if(out.series, [](const JudgedSeries& s) { return s.all.n == 0; });
  return out;
}

}  // namespace

std::vector<JudgedEstimate> judged_estimates(const states::StateLog& log) {
  std::vector<JudgedEstimate> out;
  for (const states::StateLog::Topic& topic : log.estimates) {
    JudgedEstimate e = judged_estimate(log, topic.name);
    const auto exact = [](const JudgedSeries& s) { return s.all.squares == 0; };
    if (!e.series.empty() && !std::all_of(e.series.begin(), e.series.end(), exact))
      out.push_back(std::move(e));
  }
  return out;
}

std::vector<JudgedSeries> innovations(const states::StateLog& log) {
  InnovationReading reading(log);
  reading.run();
  return reading.take();
}

json tick_times(const std::filesystem::path& log) {
  core::McapStream stream(log);
  std::unique_ptr<core::HostTopic<core::Ticks>> topic;
  std::vector<double> periods_ms;
  while (const McapFile::Message* m = stream.next()) {
    if (stream.log().channels.at(m->channel).topic != core::Ticks::topic) continue;
    if (!topic) topic = std::make_unique<core::HostTopic<core::Ticks>>(stream.log());
    if (!topic->same()) return nullptr;
    const core::Ticks ticks = topic->read(m->data);
    for (std::uint32_t i = 0; i < ticks.periods && i < core::Ticks::most; ++i)
      if (ticks.period_ns[i] > 0) periods_ms.push_back(1e-6 * ticks.period_ns[i]);
  }
  if (periods_ms.empty()) return nullptr;
  double sum = 0;
  for (const double p : periods_ms) sum += p;
  const std::size_t n = periods_ms.size();
  const auto at_99 = periods_ms.begin() + static_cast<std::ptrdiff_t>((n - 1) * 99 / 100);
  std::nth_element(periods_ms.begin(), at_99, periods_ms.end());
  return {{"n", n},
          {"mean_ms", sum / static_cast<double>(n)},
          {"p99_ms", *at_99},
          {"max_ms", *std::max_element(periods_ms.begin(), periods_ms.end())}};
}

json judged_json(const JudgedSeries& series, std::size_t most) {
  const Columns kept = thinned_to_peaks(series.columns, most);
  json out{{"words", series.words},     {"unit", series.unit},           {"n", series.all.n},
           {"mean", series.all.mean()}, {"rms", series.all.rms()},       {"largest", series.all.most},
           {"rows", kept.t.size()},     {"columns", kept.values.size()}, {"data", packed(kept)}};
  if (!series.has_claim()) return out;
  out["claimed"] = series.claimed.claim();
  out["within_1"] = series.claimed.share_1();
  out["within_2"] = series.claimed.share_2();
  return out;
}

json judged_json(const JudgedEstimate& estimate, std::size_t most) {
  json rows = json::array();
  for (const JudgedSeries& s : estimate.series) rows.push_back(judged_json(s, most));
  json out{{"topic", estimate.topic},
           {"reference", estimate.reference},
           {"truth", estimate.truth},
           {"pairs", estimate.judged.errors.pairs},
           {"rows", std::move(rows)}};
  const states::Errors& e = estimate.judged.errors;
  if (e.nees_n > 0) out["nees"] = {{"mean", e.nees.mean()}, {"inside", e.nees.inside()}};
  return out;
}

}  // namespace fulmar::report

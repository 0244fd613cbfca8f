// SPDX-License-Identifier: BSD-3-Clause
#include "core/app/report.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>
#include <numbers>

#include "core/run/verdict.hpp"
#include "core/types/wire.hpp"

namespace fulmar::core {
namespace {

using nlohmann::json;

double seconds(std::int64_t ns) { return 1e-9 * static_cast<double>(ns); }
json or_null(const std::string& text) { return text.empty() ? json(nullptr) : json(text); }

/// Roles that several components have filled: the figures cover all of them.
std::vector<std::string> shared_roles(const FlightResult& result) {
  std::vector<std::string> roles;
  for (std::size_t i = 0; i < result.tenures.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (result.tenures[i].role == result.tenures[k].role &&
          std::find(roles.begin(), roles.end(), result.tenures[i].role) == roles.end())
        roles.push_back(result.tenures[i].role);
  return roles;
}

void add_tenures(std::string& out, const FlightResult& result) {
  const std::vector<std::string> roles = shared_roles(result);
  if (!roles.empty()) out += "\nwho flew\n";
  for (const std::string& role : roles)
    for (const Tenure& t : result.tenures)
      if (t.role == role)
        out += fmt::format("  {:<22} {:10.1f} s to {:.1f} s\n", role + ": " + t.component, seconds(t.from_ns),
                           seconds(t.to_ns));
}

TypePtr type_of(const Graph& graph, const Source& source) {
  if (source.kind == Source::Kind::component)
    return graph.components[static_cast<std::size_t>(source.index)]
        .info()
        .outputs[static_cast<std::size_t>(source.output)]
        .type;
  return graph.roles[static_cast<std::size_t>(source.index)]
      .outputs[static_cast<std::size_t>(source.output)]
      .type;
}

json summary_of(const Graph& graph, const Flight& flight, const Source& source) {
  const std::byte* const message = source.kind == Source::Kind::none ? nullptr : flight.sample(source);
  return message ? figures_json(*type_of(graph, source), message) : json(nullptr);
}

double flight_time_s(const FlightResult& result) {
  return result.ticks > 0 ? seconds(result.last_ns - result.first_ns) : 0;
}
double speedup(const FlightResult& result) {
  return result.ticks > 1 && result.wall.took_s > 0 ? flight_time_s(result) / result.wall.took_s : 0;
}

json steps_json(const FlightResult& result) {
  json all = json::object();
  for (const ComponentStats& c : result.components) {
    if (c.time.count() == 0) continue;
    all[c.name] = {{"mean", c.time.mean_us()},
                   {"p50", c.time.quantile_us(0.5)},
                   {"p99", c.time.quantile_us(0.99)},
                   {"max", c.time.max_us()}};
  }
  return all;
}

/// "roll_deg" -> "roll" and "deg"; for a table.
std::pair<std::string, std::string> split_unit(const std::string& key) {
  static const std::pair<const char*, const char*> units[] = {
      {"_radps", "rad/s"}, {"_mps2", "m/s2"}, {"_mps", "m/s"}, {"_deg", "deg"},
      {"_m", "m"},         {"_s", "s"},       {"_frac", ""},   {"_ratio", ""}};
  for (const auto& [suffix, unit] : units)
    if (key.ends_with(suffix) && key != suffix)
      return {key.substr(0, key.size() - std::strlen(suffix)), unit};
  return {key, ""};
}

void add_figures(std::string& out, const std::string& title, const json& figures) {
  out += "\n" + title + (figures.is_null() ? ": no figures\n" : "\n");
  if (!figures.is_object()) return;
  for (const auto& [key, value] : figures.items()) {
    const auto [name, unit] = split_unit(key);
    const std::string text =
        value.is_number_float() ? fmt::format("{:.3f}", value.get<double>()) : value.dump();
    out += fmt::format("  {:<22} {:>10} {}\n", name, text, unit);
  }
}

std::string dds_table(const DdsStats& dds) {
  std::string out = fmt::format("\nDDS: {} samples sent, {} received, {} refused, {} lost\n", dds.sent,
                                dds.received, dds.refused, dds.lost);
  for (const DdsStats::Import& i : dds.imports)
    out += fmt::format("  {:<22} {} samples, latency mean {:.2f} ms, max {:.2f} ms\n", i.port, i.received,
                       1e3 * i.latency_mean_s, 1e3 * i.latency_max_s);
  return out;
}

json dds_json(const DdsStats& dds) {
  json imports = json::object();
  for (const DdsStats::Import& i : dds.imports)
    imports[i.port] = {{"topic", i.topic},
                       {"received", i.received},
                       {"refused", i.refused},
                       {"lost", i.lost},
                       {"latency_mean_s", i.latency_mean_s},
                       {"latency_max_s", i.latency_max_s}};
  return {{"sent", dds.sent},
          {"received", dds.received},
          {"refused", dds.refused},
          {"lost", dds.lost},
          {"imports", imports}};
}

json tenures_json(const FlightResult& result) {
  json all = json::object();
  for (const Tenure& t : result.tenures)
    all[t.role].push_back(
        {{"component", t.component}, {"from_s", seconds(t.from_ns)}, {"to_s", seconds(t.to_ns)}});
  return all;
}

/// False for a figure that its message marks as invalid, as `height_valid` does for `height_m`.
bool present(const Shown& shown, const std::byte* message) {
  if (!shown.field.present(message)) return false;
  if (!shown.type) return true;
  const std::string path = shown.text.substr(shown.text.find('.', shown.text.find('.') + 1) + 1);
  const std::string flag = split_unit(path.substr(0, path.find('.'))).first + "_valid";
  const Field* valid = shown.type->find(flag);
  return !valid || number_at(*valid, message + valid->offset) != 0;
}

}  // namespace

std::string progress_line(const Graph& graph, const Flight& flight) {
  std::string line = fmt::format("{:8.1f} s  {:<10}", seconds(flight.now_ns()), flight.phase());
  for (const Shown& shown : graph.judge.progress) {
    const std::byte* message = flight.sample(shown.from);
    std::string name = shown.text.substr(shown.text.rfind('.') + 1);
    std::string unit = shown.field.unit;
    if (!message || !present(shown, message)) {
      line += "  " + split_unit(name).first + " -";
      continue;
    }
    double value = number_at(*shown.field.field, message + shown.field.offset);
    if (unit == "rad") {
      value *= 180 / std::numbers::pi;
      unit = "deg";
      name = name.substr(0, name.size() - 4);
    }
    line += fmt::format("  {} {:.{}f}{}{}", split_unit(name).first, value,
                        is_real(shown.field.field->kind) ? 1 : 0, unit.empty() ? "" : " ", unit);
  }
  return flight.paused() ? line + "  paused" : line;
}

json result_json(const Graph& graph, const Flight& flight, const FlightResult& result) {
  json j;
  j["mission"] = graph.mission;
  j["io"] = io_word(graph.io);
  j["seed"] = graph.seed;
  j["result"] = result_word(result);
  j["reason"] = reason_of(result);
  j["verdict"] = verdict_of(graph, flight, result);
  j["flight_time_s"] = flight_time_s(result);
  j["wall_time_s"] = result.wall.took_s;
  j["speedup"] = speedup(result);
  j["phases"] = json::array();
  for (const PhaseVisit& p : result.phases)
    j["phases"].push_back({{"name", p.name},
                           {"from_s", seconds(p.from_ns)},
                           {"to_s", seconds(p.to_ns)},
                           {"because", or_null(p.because)}});
  j["who_flew"] = tenures_json(result);
  j["guards"] = json::array();
  for (const GuardEvent& g : result.guards)
    j["guards"].push_back(
        {{"at_s", seconds(g.at_ns)}, {"component", g.component}, {"what", g.what}, {"action", g.action}});
  j["log"] = or_null(result.log.file.string());
  j["log_sha256"] = result.log.file.empty() ? json(nullptr) : json(result.log.sha256);
  j["log_dropped"] = result.log.dropped;
  j["log_error"] = or_null(result.log.error);
  j["step_time_us"] = steps_json(result);
  j["allocations"] = json::object();
  for (const ComponentStats& c : result.components) j["allocations"][c.name] = c.allocations;
  j["misses"] = json::object();
  for (const ComponentStats& c : result.components)
    if (c.misses > 0) j["misses"][c.name] = c.misses;
  for (const auto& [key, source] : graph.judge.summary) j[key] = summary_of(graph, flight, source);
  j["live"] = nullptr;
  if (result.live)
    j["live"] = {{"sent", result.live->sent},
                 {"dropped", result.live->dropped},
                 {"lost", result.live->lost},
                 {"refused", result.live->refused},
                 {"wrong_tokens", result.live->wrong_tokens}};
  j["dds"] = result.dds ? dds_json(*result.dds) : json(nullptr);
  j["behind_max_s"] = result.wall.behind_max_s;
  j["not_reproducible"] = {"behind_max_s", "dds", "live", "log", "speedup", "step_time_us", "wall_time_s"};
  return j;
}

std::string result_table(const Graph& graph, const Flight& flight, const FlightResult& result) {
  std::string out =
      fmt::format("\n{}: {} ({})\n", graph.mission, verdict_of(graph, flight, result), reason_of(result));
  out += fmt::format("  {:.1f} s of flight in {:.2f} s: {:.0f} times real time\n", flight_time_s(result),
                     result.wall.took_s, speedup(result));
  if (result.wall.behind_max_s > 0.5)
    out += fmt::format("  up to {:.1f} s behind the clock on the wall\n", result.wall.behind_max_s);
  for (const auto& [key, source] : graph.judge.summary)
    add_figures(out, key, summary_of(graph, flight, source));
  out += "\nphases\n";
  for (const PhaseVisit& p : result.phases)
    out += fmt::format("  {:<22} {:10.1f} s to {:.1f} s\n", p.name, seconds(p.from_ns), seconds(p.to_ns));
  add_tenures(out, result);
  if (!result.guards.empty()) out += "\nguards\n";
  for (const GuardEvent& g : result.guards)
    out += fmt::format("  {:10.2f} s  {}: {}: {}\n", seconds(g.at_ns), g.component, g.what, g.action);
  out += "\nstep time              p50       p99       max us\n";
  for (const ComponentStats& c : result.components)
    if (c.time.count() > 0)
      out += fmt::format("  {:<14} {:9.2f} {:9.2f} {:9.1f}\n", c.name, c.time.quantile_us(0.5),
                         c.time.quantile_us(0.99), c.time.max_us());
  for (const ComponentStats& c : result.components)
    if (c.allocations > 0)
      out += fmt::format("  {} takes memory in flight: {} allocations in {} steps\n", c.name, c.allocations,
                         c.steps);
  for (const ComponentStats& c : result.components)
    if (c.misses > 0) out += fmt::format("  {}: {} results were late, or samples lost\n", c.name, c.misses);
  if (result.live && result.live->sent > 0)
    out += fmt::format("\nlive view: {} messages, {} dropped for clients that were slow\n", result.live->sent,
                       result.live->dropped + result.live->lost);
  if (result.dds) out += dds_table(*result.dds);
  if (!result.log.file.empty())
    out += fmt::format("\nlog {} ({:.1f} MB, {} messages, {} dropped)\n", result.log.file.string(),
                       1e-6 * static_cast<double>(result.log.bytes), result.log.messages, result.log.dropped);
  return out;
}

}  // namespace fulmar::core

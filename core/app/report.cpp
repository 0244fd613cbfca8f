// SPDX-License-Identifier: BSD-3-Clause
#include "core/app/report.hpp"

#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <numbers>

#include "core/types/wire.hpp"

namespace fulmar::core {
namespace {

std::string format(const char* pattern, ...) __attribute__((format(printf, 1, 2)));
std::string format(const char* pattern, ...) {
  char text[512];
  va_list arguments;
  va_start(arguments, pattern);
  std::vsnprintf(text, sizeof text, pattern, arguments);
  va_end(arguments);
  return text;
}

const char* word(Outcome outcome) {
  switch (outcome) {
    case Outcome::flown: return "flown";
    case Outcome::interrupted: return "interrupted";
    default: return "failed";
  }
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

nlohmann::json summary_of(const Graph& graph, const Flight& flight, const Source& source) {
  const std::byte* message = flight.sample(source);
  if (!message) return nullptr;
  return to_json(*type_of(graph, source), message, true);
}

double flight_time_s(const FlightResult& result) {
  return result.ticks > 0 ? 1e-9 * static_cast<double>(result.last_ns - result.first_ns) : 0;
}
double speedup(const FlightResult& result) {
  return result.ticks > 1 && result.wall_s > 0 ? flight_time_s(result) / result.wall_s : 0;
}

nlohmann::json steps_json(const FlightResult& result) {
  nlohmann::json all = nlohmann::json::object();
  for (const ComponentStats& c : result.components) {
    if (c.time.count() == 0) continue;
    all[c.name] = {
        {"p50", c.time.quantile_us(0.5)}, {"p99", c.time.quantile_us(0.99)}, {"max", c.time.max_us()}};
  }
  return all;
}

/// "roll_deg" -> "roll" and "deg"; for a table.
std::pair<std::string, std::string> split_unit(const std::string& key) {
  static const std::pair<const char*, const char*> units[] = {
      {"_radps", "rad/s"}, {"_mps2", "m/s2"}, {"_mps", "m/s"}, {"_deg", "deg"},
      {"_m", "m"},         {"_s", "s"},       {"_frac", ""},   {"_ratio", ""}};
  for (const auto& [suffix, unit] : units) {
    const std::string s = suffix;
    if (key.size() > s.size() && key.compare(key.size() - s.size(), s.size(), s) == 0)
      return {key.substr(0, key.size() - s.size()), unit};
  }
  return {key, ""};
}

void add_figures(std::string& out, const std::string& title, const nlohmann::json& figures) {
  out += "\n" + title + (figures.is_null() ? ": no figures\n" : "\n");
  if (!figures.is_object()) return;
  for (const auto& [key, value] : figures.items()) {
    const auto [name, unit] = split_unit(key);
    if (value.is_number_float())
      out += format("  %-22s %10.3f %s\n", name.c_str(), value.get<double>(), unit.c_str());
    else
      out += format("  %-22s %10s %s\n", name.c_str(), value.dump().c_str(), unit.c_str());
  }
}

}  // namespace

namespace {

std::string dds_table(const DdsStats& dds) {
  std::string out =
      format("\nDDS: %llu samples sent, %llu received, %llu refused, %llu lost\n",
             static_cast<unsigned long long>(dds.sent), static_cast<unsigned long long>(dds.received),
             static_cast<unsigned long long>(dds.refused), static_cast<unsigned long long>(dds.lost));
  for (const DdsStats::Import& i : dds.imports)
    out += format("  %-22s %llu samples, latency mean %.2f ms, max %.2f ms\n", i.port.c_str(),
                  static_cast<unsigned long long>(i.received), 1e3 * i.latency_mean_s, 1e3 * i.latency_max_s);
  return out;
}

nlohmann::json dds_json(const DdsStats& dds) {
  nlohmann::json imports = nlohmann::json::object();
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

}  // namespace

std::string progress_line(const Graph& graph, const Flight& flight) {
  std::string line =
      format("%8.1f s  %-10s", 1e-9 * static_cast<double>(flight.now_ns()), flight.phase().c_str());
  for (const Shown& shown : graph.progress) {
    const std::byte* message = flight.sample(shown.from);
    std::string name = shown.text.substr(shown.text.rfind('.') + 1);
    std::string unit = shown.field.unit;
    if (!message) {
      line += "  " + split_unit(name).first + " -";
      continue;
    }
    double value = number_at(*shown.field.field, message + shown.field.offset);
    if (unit == "rad") value *= 180 / std::numbers::pi, unit = "deg", name = name.substr(0, name.size() - 4);
    const bool whole = !is_real(shown.field.field->kind);
    line += format("  %s %.*f%s%s", split_unit(name).first.c_str(), whole ? 0 : 1, value,
                   unit.empty() ? "" : " ", unit.c_str());
  }
  return line;
}

nlohmann::json result_json(const Graph& graph, const Flight& flight, const FlightResult& result) {
  nlohmann::json j;
  j["mission"] = graph.mission;
  j["io"] = io_word(graph.io);
  j["seed"] = graph.seed;
  j["result"] = word(result.outcome);
  j["reason"] = result.reason;
  j["flight_time_s"] = flight_time_s(result);
  j["wall_time_s"] = result.wall_s;
  j["speedup"] = speedup(result);
  j["phases"] = nlohmann::json::array();
  for (const PhaseVisit& p : result.phases)
    j["phases"].push_back({{"name", p.name},
                           {"from_s", 1e-9 * static_cast<double>(p.from_ns)},
                           {"to_s", 1e-9 * static_cast<double>(p.to_ns)}});
  j["guards"] = nlohmann::json::array();
  for (const GuardEvent& g : result.guards)
    j["guards"].push_back({{"at_s", 1e-9 * static_cast<double>(g.at_ns)},
                           {"component", g.component},
                           {"what", g.what},
                           {"action", g.action}});
  const bool logged = !result.log.file.empty();
  j["log"] = logged ? nlohmann::json(result.log.file.string()) : nlohmann::json(nullptr);
  j["log_sha256"] = logged ? nlohmann::json(result.log.sha256) : nlohmann::json(nullptr);
  j["log_dropped"] = result.log.dropped;
  j["log_error"] = result.log.error.empty() ? nlohmann::json(nullptr) : nlohmann::json(result.log.error);
  j["step_time_us"] = steps_json(result);
  j["allocations"] = nlohmann::json::object();
  for (const ComponentStats& c : result.components) j["allocations"][c.name] = c.allocations;
  j["misses"] = nlohmann::json::object();
  for (const ComponentStats& c : result.components)
    if (c.misses > 0) j["misses"][c.name] = c.misses;
  for (const auto& [key, source] : graph.summary) j[key] = summary_of(graph, flight, source);
  j["live"] = nullptr;
  if (result.live)
    j["live"] = {{"sent", result.live->sent},
                 {"dropped", result.live->dropped},
                 {"lost", result.live->lost},
                 {"refused", result.live->refused}};
  j["dds"] = result.dds ? dds_json(*result.dds) : nlohmann::json(nullptr);
  j["not_reproducible"] = {"dds", "live", "log", "speedup", "step_time_us", "wall_time_s"};
  return j;
}

std::string result_table(const Graph& graph, const Flight& flight, const FlightResult& result) {
  std::string out =
      format("\n%s: %s (%s)\n", graph.mission.c_str(), word(result.outcome), result.reason.c_str());
  out += format("  %.1f s of flight in %.2f s: %.0f times real time\n", flight_time_s(result), result.wall_s,
                speedup(result));
  for (const auto& [key, source] : graph.summary) add_figures(out, key, summary_of(graph, flight, source));
  out += "\nphases\n";
  for (const PhaseVisit& p : result.phases)
    out += format("  %-22s %10.1f s to %.1f s\n", p.name.c_str(), 1e-9 * static_cast<double>(p.from_ns),
                  1e-9 * static_cast<double>(p.to_ns));
  if (!result.guards.empty()) out += "\nguards\n";
  for (const GuardEvent& g : result.guards)
    out += format("  %10.2f s  %s: %s: %s\n", 1e-9 * static_cast<double>(g.at_ns), g.component.c_str(),
                  g.what.c_str(), g.action.c_str());
  out += "\nstep time              p50       p99       max us\n";
  for (const ComponentStats& c : result.components)
    if (c.time.count() > 0)
      out += format("  %-14s %9.2f %9.2f %9.1f\n", c.name.c_str(), c.time.quantile_us(0.5),
                    c.time.quantile_us(0.99), c.time.max_us());
  for (const ComponentStats& c : result.components)
    if (c.allocations > 0)
      out += format("  %s takes memory in flight: %llu allocations in %llu steps\n", c.name.c_str(),
                    static_cast<unsigned long long>(c.allocations), static_cast<unsigned long long>(c.steps));
  for (const ComponentStats& c : result.components)
    if (c.misses > 0)
      out += format("  %s: %llu results were late, or samples lost\n", c.name.c_str(),
                    static_cast<unsigned long long>(c.misses));
  if (result.live && result.live->sent > 0)
    out += format("\nlive view: %llu messages, %llu dropped for clients that were slow\n",
                  static_cast<unsigned long long>(result.live->sent),
                  static_cast<unsigned long long>(result.live->dropped + result.live->lost));
  if (result.dds) out += dds_table(*result.dds);
  if (!result.log.file.empty())
    out += format("\nlog %s (%.1f MB, %llu messages, %llu dropped)\n", result.log.file.c_str(),
                  1e-6 * static_cast<double>(result.log.bytes),
                  static_cast<unsigned long long>(result.log.messages),
                  static_cast<unsigned long long>(result.log.dropped));
  if (result.log.files > 1) out += format("  in %zu files\n", result.log.files);
  return out;
}

}  // namespace fulmar::core

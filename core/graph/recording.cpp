// SPDX-License-Identifier: BSD-3-Clause
// Recording rules: the section `record:` of a mission, and `--record PORTS[@RATE]`, which the command line
// adds.
#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/graph/messages.hpp"
#include "core/graph/mission.hpp"
#include "core/graph/quantity.hpp"

namespace fulmar::core {
namespace {

/// "100 Hz" or "all"; throws Error.
std::int64_t period_of(const std::string& rate) try {
  if (rate == "all") return 0;
  const double hz = quantity_in(rate, "Hz", UnitRule::required);
  if (!(hz >= 1e-3 && hz <= 1e6)) throw Error(graph_messages::record_rate_invalid());
  return std::llround(1e9 / hz);
} catch (const Error& fault) {
  throw Error(graph_messages::record_pattern_invalid(fault.what()));
}

std::vector<std::string> keys_of(const Node& map) {
  std::vector<std::string> keys;
  for (const Node::Entry& entry : map.entries) keys.push_back(entry.key);
  return keys;
}

class RecordReader {
 public:
  RecordReader(MissionText& mission, Report& report) : m_(mission), report_(report) {}

  void read(const Keys& mission) {
    const Node* node = mission.get("record");
    if (!node) return;
    if (node->is(Node::Kind::scalar)) {
      m_.record = node->text != "off";
      if (m_.record) is_a(Node::Kind::map, *node, "record", "'off' or a map {file, ports, rate}", report_);
      return;
    }
    const Keys keys(*node, "record", {"file", "ports", "rate"}, report_);
    m_.record_file = keys.text("file").value_or("");
    const auto rate = keys.positive("rate", "Hz");
    const std::int64_t period = rate ? std::llround(1e9 / *rate) : 0;
    const Node* ports = keys.get("ports");
    if (!ports) {
      if (rate) add_rule("*", period, keys.where("rate"));
      return;
    }
    if (ports->is(Node::Kind::sequence)) {
      for (const Node& item : ports->items)
        if (const auto text =
                scalar_text(item, "record.ports", "a port or a pattern such as \"nav.*\"", report_))
          add_rule(*text, period, item.where());
    } else if (is_a(Node::Kind::map, *ports, "record.ports", "a list of ports or a map {port: rate}",
                    report_)) {
      const std::vector<std::string> names = keys_of(*ports);
      const Keys rates(*ports, "record.ports", names, report_);
      for (const std::string& name : names) {
        const bool all = ports->find(name)->text == "all";
        const auto hz = all ? std::nullopt : rates.positive(name, "Hz");
        add_rule(name, hz ? std::llround(1e9 / *hz) : 0, rates.where(name));
      }
    }
  }

 private:
  void add_rule(const std::string& pattern, std::int64_t period_ns, const Where& where) {
    m_.record_rules.push_back({{pattern}, period_ns});
    m_.tap.record.push_back(where);
  }

  MissionText& m_;
  Report& report_;
};

}  // namespace

std::uint64_t parse_bytes(const std::string& text, const Where& where, const std::string& path,
                          Report& report) {
  double number = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), number);
  std::string unit(end, text.data() + text.size());
  unit.erase(0, unit.find_first_not_of(' '));
  for (const auto& [name, factor] : {std::pair{"kB", 1e3}, std::pair{"MB", 1e6}, std::pair{"GB", 1e9}})
    if (code == std::errc{} && unit == name && number > 0 && number <= 1e6)
      return static_cast<std::uint64_t>(number * factor);
  report.add(where, located(path, graph_messages::memory_size_invalid(text)));
  return 0;
}

void read_recording(const Keys& mission, MissionText& text, Report& report) {
  RecordReader(text, report).read(mission);
}

void add_record_options(MissionText& mission, const std::vector<std::string>& options, Report& report) {
  if (options.empty()) return;
  mission.record = true;
  std::vector<RecordRule> rules;
  std::vector<Where> places;
  for (const std::string& text : options) {
    const std::string option = "--record " + text;
    const std::size_t at = text.find('@');
    try {
      const std::int64_t period = at == std::string::npos ? 0 : period_of(text.substr(at + 1));
      const std::string ports = text.substr(0, at);
      for (std::size_t from = 0; from <= ports.size();) {
        const std::size_t comma = std::min(ports.find(',', from), ports.size());
        const std::string port = ports.substr(from, comma - from);
        rules.push_back({{port == "all" ? "*" : port}, period});
        places.push_back({option, 0});
        from = comma + 1;
      }
    } catch (const Error& fault) {
      report.add({option, 0}, fault.diagnostic);
    }
  }
  if (mission.record_rules.empty()) {
    // the rest keeps its default
    rules.push_back({{"*"}, RecordRule::usual});
    places.push_back({"--record", 0});
  }
  mission.record_rules.insert(mission.record_rules.begin(), rules.begin(), rules.end());
  mission.tap.record.insert(mission.tap.record.begin(), places.begin(), places.end());
}

}  // namespace fulmar::core

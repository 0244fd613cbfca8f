// SPDX-License-Identifier: BSD-3-Clause
// Reads the keys of a mission file. resolve.cpp checks their combination.
#include "core/graph/mission.hpp"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>

#include "core/graph/extends.hpp"
#include "core/graph/messages.hpp"
#include "core/graph/quantity.hpp"
#include "core/graph/shipped.hpp"
#include "core/types/names.hpp"
#include "core/types/text.hpp"

namespace fulmar::core {
namespace fs = std::filesystem;
namespace {

const std::vector<std::string> mission_keys = {
    "mission",    "extends", "io",      "airframe", "origin", "rate",     "seed",    "arm",      "done",
    "failed",     "flown",   "verdict", "timeout",  "epoch",  "progress", "summary", "failsafe", "roles",
    "components", "phases",  "record",  "control",  "tell",   "resume",   "live",    "dds",      "hardware"};
const std::vector<std::string> component_keys = {"fills", "use",     "in",     "params",  "rate",   "only",
                                                 "run",   "latency", "budget", "max_age", "memory", "hang"};

constexpr std::size_t max_names = 1000;  // of roles, components, phases: each is compared with all others
constexpr const char* default_epoch = "2026-01-01T00:00Z";

/// Nothing for an unknown word.
std::optional<Io> io_of(const std::string& word) {
  const auto at = std::find(io_words.begin(), io_words.end(), word);
  if (at == io_words.end()) return std::nullopt;
  return static_cast<Io>(at - io_words.begin());
}

class MissionReader {
 public:
  MissionReader(MissionText& mission, Report& report) : m_(mission), report_(report) {}

  void read(const Node& root) {
    const Keys keys(root, "", mission_keys, report_);
    if (!root.is(Node::Kind::map)) return;
    scalars(keys);
    if (const Node* node = keys.get("airframe")) m_.node.airframe = *node;
    if (const Node* node = keys.get("origin")) m_.node.origin = *node;
    shown(keys);
    failsafe(keys);
    each(keys, "roles", component_room, &MissionReader::role);
    each(keys, "components", component_room, &MissionReader::component);
    each(keys, "phases", name_room, &MissionReader::phase);
    read_recording(keys, m_, report_);
    read_live(keys, m_, report_);
    read_dds(keys, m_, report_);
    read_hardware(keys, m_, report_);
  }

 private:
  void each(const Keys& keys, const std::string& key, std::size_t room,
            void (MissionReader::*read_entry)(const Node::Entry&)) {
    const std::vector<Node::Entry>& entries = keys.entries(key, "a map of names");
    if (entries.size() > max_names)
      return report_.add(keys.where(key),
                         located(key, graph_messages::too_many_entries(entries.size(), max_names)));
    for (const Node::Entry& entry : entries) {
      if (entry.key.size() >= room)
        report_.add(entry.where(),
                    located(key, graph_messages::name_too_long(entry.key, entry.key.size(), room - 1)));
      if (is_name(entry.key))
        (this->*read_entry)(entry);
      else
        report_.add(entry.where(), located(key, graph_messages::name_invalid(entry.key)));
    }
  }

  void scalars(const Keys& keys) {
    m_.mission = keys.text("mission").value_or(m_.file->path.stem().string());
    if (m_.mission.find_first_of("/\n\r\t") != std::string::npos)
      report_.add(keys.where("mission"), graph_messages::mission_name_invalid(m_.mission));
    m_.io = io_of(keys.word("io", io_words).value_or("sim")).value_or(Io::sim);
    m_.rate_hz = keys.positive("rate", "Hz").value_or(400);
    if (keys.has("rate")) m_.rate_where = keys.where("rate");
    if (m_.rate_hz > 100'000 || m_.rate_hz < 0.1)
      report_.add(m_.rate_where, graph_messages::rate_out_of_range(trimmed(keys.get("rate")->text)));
    m_.timeout_ns = keys.duration_ns("timeout").value_or(3600'000'000'000);
    m_.arm = keys.word("arm", {"auto", "off"}).value_or("off") == "auto";
    if (const Node* node = keys.get("seed")) seed(*node);
    try {
      m_.epoch_ns = parse_utc_ns(keys.text("epoch").value_or(default_epoch));
    } catch (const Error& fault) {
      report_.add(keys.where("epoch"), graph_messages::epoch_invalid(fault.what()));
    }
  }

  void seed(const Node& node) {
    const std::string& text = node.text;
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), m_.seed);
    if (!node.is(Node::Kind::scalar) || code != std::errc{} || end != text.data() + text.size())
      report_.add(node.where(), graph_messages::seed_invalid(found_words(node)));
  }

  /// A condition that ends or judges the flight: "..." or {when: "...", for: 60 s}.
  void ending(const Keys& keys, const std::string& key, std::optional<Word>& word, std::int64_t& for_ns) {
    const Node* node = keys.get(key);
    if (!node || !node->is(Node::Kind::map)) {
      if (const auto text = keys.text(key)) word = Word{*text, node->where()};
      return;
    }
    const Keys parts(*node, key, {"when", "for"}, report_);
    if (const auto text = parts.text("when"))
      word = Word{*text, parts.get("when")->where()};
    else
      report_.add(node->where(), located(key, graph_messages::condition_expected()));
    for_ns = parts.duration_ns("for").value_or(0);
  }

  void shown(const Keys& keys) {
    ending(keys, "done", m_.judge.done, m_.done_for_ns);
    ending(keys, "failed", m_.judge.failed, m_.failed_for_ns);
    ending(keys, "flown", m_.judge.flown, m_.flown_for_ns);
    if (const auto port = keys.text("verdict")) m_.judge.verdict = Word{*port, keys.get("verdict")->where()};
    list(keys, "progress", "a list of fields such as [nav.state.height_m]",
         "a field such as nav.state.height_m", m_.judge.progress);
    list(keys, "control", "a list of roles such as [guide, outer, inner]", "the name of a role", m_.control);
    list(keys, "tell", "a list of ports such as [vehicle.notices]", "a port such as vehicle.notices",
         m_.report);
    map(keys, "summary", "a map {name: component.port}", "a port such as score.tracking", m_.judge.summary);
    map(keys, "resume", "a map {component.parameter: component.port.field}",
        "a field such as manage.progress.item", m_.resume);
  }

  void list(const Keys& keys, const std::string& key, const std::string& wanted,
            const std::string& item_wanted, std::vector<Word>& out) {
    for (const Node& item : keys.items(key, wanted))
      if (const auto text = scalar_text(item, key, item_wanted, report_))
        out.push_back({*text, item.where()});
  }

  void map(const Keys& keys, const std::string& key, const std::string& wanted,
           const std::string& item_wanted, std::vector<std::pair<std::string, Word>>& out) {
    for (const Node::Entry& entry : keys.entries(key, wanted))
      if (const auto text = scalar_text(entry.value, key + "." + entry.key, item_wanted, report_))
        out.push_back({entry.key, {*text, entry.where()}});
  }

  void failsafe(const Keys& keys) {
    const Node* node = keys.get("failsafe");
    if (!node) return;
    m_.node.failsafe = *node;
    m_.failsafe_ns = 2'000'000'000;
    Node own = *node;  // the other keys are fields: they are checked against the vehicle's inputs later
    std::erase_if(own.entries, [](const Node::Entry& entry) { return entry.key != "for"; });
    m_.failsafe_ns = Keys(own, "failsafe", {"for"}, report_).duration_ns("for").value_or(m_.failsafe_ns);
  }

  /// "nav.state"; nothing and a fault for any other form.
  std::optional<PortName> port_name(const Node& node, const std::string& path) {
    const auto text = scalar_text(node, path, "a port such as nav.state", report_);
    if (!text) return std::nullopt;
    return parse_port_name(*text, node.where(), path, report_);
  }

  std::vector<WireText> wires(const Keys& keys) {
    std::vector<WireText> list;
    for (const Node::Entry& entry : keys.entries("in", "a map {input: component.output}"))
      list.push_back(read_wire(entry, keys.path("in") + "." + entry.key));
    return list;
  }

  /// `from` is empty when it cannot be read: the input still counts as wired, without a second fault.
  WireText read_wire(const Node::Entry& entry, const std::string& path) {
    WireText wire;
    wire.name = entry.key;
    wire.where = entry.where();
    if (entry.value.text == "null" && entry.value.is(Node::Kind::null)) {
      wire.cut = true;
    } else if (entry.value.is(Node::Kind::map)) {
      const Keys keys(entry.value, path, {"from", "max_age", "delayed"}, report_);
      if (!keys.has("from")) {
        report_.add(entry.where(), located(path, graph_messages::source_missing()));
        return wire;
      }
      wire.from = port_name(*keys.get("from"), path + ".from").value_or(PortName{});
      wire.max_age_ns = max_age_ns(keys);
      wire.delayed = keys.flag("delayed").value_or(false);
    } else {
      wire.from = port_name(entry.value, path).value_or(PortName{});
    }
    return wire;
  }

  /// 0: `off`, a sample of any age is accepted.
  static std::optional<std::int64_t> max_age_ns(const Keys& keys) {
    const Node* const node = keys.get("max_age");
    if (node && node->is(Node::Kind::scalar) && node->text == "off") return 0;
    return keys.duration_ns("max_age");
  }

  void role(const Node::Entry& entry) {
    const std::string path = "roles." + entry.key;
    const bool vehicle = entry.key == "vehicle";
    std::vector<std::string> valid = {"in", "out"};
    if (vehicle) valid.push_back("flags");
    const Keys keys(entry.value, path, valid, report_);
    RoleText role;
    role.name = entry.key;
    role.where = entry.where();
    role.in = wires(keys);
    for (const Node::Entry& port : keys.entries("out", "a map {output: Type}")) {
      RoleOutText text;
      text.optional = port.key.ends_with('?');
      text.name = text.optional ? port.key.substr(0, port.key.size() - 1) : port.key;
      text.where = port.where();
      const auto type = scalar_text(port.value, path + ".out." + port.key,
                                    "the name of a message type such as VehicleState", report_);
      if (!is_name(text.name))
        report_.add(port.where(), graph_messages::output_name_invalid(path, port.key));
      else if (find_named(role.out, text.name))
        report_.add(port.where(), graph_messages::output_repeated(path, text.name));
      else if (type) {
        text.type = *type;
        role.out.push_back(text);
      }
    }
    if (const Node* flags = keys.get("flags"); flags && vehicle) vehicle_flags(*flags, path + ".flags", role);
    m_.roles.push_back(std::move(role));
  }

  /// Protection of the aircraft: the vehicle's fields that hold its flags.
  void vehicle_flags(const Node& node, const std::string& path, RoleText& role) {
    const std::vector<std::string> names = {"armed", "on_ground", "in_control"};
    const Keys flags(node, path, names, report_);
    for (const std::string& name : names)
      if (const auto text = flags.text(name)) role.flags.push_back({name, {*text, flags.where(name)}});
  }

  void component(const Node::Entry& entry) {
    const std::string path = "components." + entry.key;
    const Keys keys(entry.value, path, component_keys, report_);
    ComponentText c;
    c.name = entry.key;
    c.where = entry.where();
    c.fills = fills(keys);
    c.use = keys.word_at("use");
    if (!keys.has("use") && entry.value.is(Node::Kind::map))
      report_.add(entry.where(), located(path, graph_messages::use_missing()));
    c.only = io_of(keys.word("only", io_words).value_or(""));
    if (!keys.has("only") && c.fills_role("vehicle")) c.only = io_of(c.name);
    c.in = wires(keys);
    check_cuts(path, c);
    c.params = params(keys, "params");
    c.rate_hz = keys.positive("rate", "Hz").value_or(0);
    c.where_rate = keys.where("rate");
    c.budget_ns = keys.duration_ns("budget").value_or(0);
    c.max_age_ns = max_age_ns(keys);
    run_mode(keys, path, c);
    m_.components.push_back(std::move(c));
  }

  /// A null removes a wire that one of the roles brings. A wire of a lower layer is already removed.
  void check_cuts(const std::string& path, const ComponentText& c) {
    std::vector<std::string> there;
    for (const WireText& wire : c.in)
      if (!wire.cut) there.push_back(wire.name);
    for (const Word& fills : c.fills)
      if (const RoleText* role = m_.role(fills.text))
        for (const WireText& wire : role->in) there.push_back(wire.name);
    for (const WireText& wire : c.in) {
      if (!wire.cut || std::find(there.begin(), there.end(), wire.name) != there.end()) continue;
      const std::string near = nearest(wire.name, there);
      report_.add(wire.where, graph_messages::removed_connection_missing(
                                  path, wire.name, near.empty() ? "" : ". Did you mean '" + near + "'?"));
    }
  }

  /// A role, or a list of them.
  std::vector<Word> fills(const Keys& keys) {
    const Node* const node = keys.get("fills");
    if (!node) return {};
    if (!node->is(Node::Kind::sequence)) return {keys.word_at("fills")};
    std::vector<Word> list;
    const std::string path = keys.path("fills");
    for (const Node& item : node->items) {
      const auto text = scalar_text(item, path, "a role such as outer", report_);
      if (!text) continue;
      const Word word{*text, item.where()};
      const auto same = [&](const Word& other) { return other.text == word.text; };
      if (std::any_of(list.begin(), list.end(), same))
        report_.add(word.where, located(path, graph_messages::entry_repeated(word.text)));
      else
        list.push_back(word);
    }
    return list;
  }

  /// Values of parameters, as a map; missing when there is none.
  Node params(const Keys& keys, const std::string& key) {
    const Node* node = keys.get(key);
    const bool good =
        node && is_a(Node::Kind::map, *node, keys.path(key), "a map {parameter: value}", report_);
    return good ? *node : Node{};
  }

  void run_mode(const Keys& keys, const std::string& path, ComponentText& c) {
    static const std::vector<std::string> modes = {"tick", "process", "async", "driver"};
    const auto at = std::find(modes.begin(), modes.end(), keys.word("run", modes).value_or(""));
    if (at != modes.end()) c.run = static_cast<RunMode>(at - modes.begin());
    if (keys.has("latency") && c.run != RunMode::async)
      report_.add(keys.where("latency"), graph_messages::latency_misplaced(path));
    // on hardware a child may be the default: `hang` may then stand alone
    if (keys.has("hang") && c.run && c.run != RunMode::process)
      report_.add(keys.where("hang"), graph_messages::hang_misplaced(path));
    c.latency_ns = keys.duration_ns("latency").value_or(0);
    if (const auto hang = keys.duration_ns("hang"); hang && *hang > 0) c.hang_ns = *hang;
    if (c.run == RunMode::async && c.latency_ns == 0)
      report_.add(keys.has("latency") ? keys.where("latency") : keys.where("run"),
                  located(path, graph_messages::latency_missing()));
    if (const auto text = keys.text("memory"))
      c.memory_bytes = parse_bytes(*text, keys.where("memory"), path + ".memory", report_);
  }

  void phase(const Node::Entry& entry) {
    const std::string path = "phases." + entry.key;
    std::vector<std::string> valid = {"next"};
    if (entry.key != "any")
      for (const RoleText& role : m_.roles) valid.push_back(role.name);
    const Node nothing, &node = entry.value.is(Node::Kind::null) ? nothing : entry.value;
    for (const Node::Entry& item : node.entries)
      if (!m_.role(item.key) &&
          report_.still_named({"roles." + item.key}, item.where(), path + "." + item.key))
        valid.push_back(item.key);
    const Keys keys(node, path, valid, report_);
    PhaseText phase;
    phase.name = entry.key;
    phase.where = entry.where();
    transitions(keys, phase.next);
    for (const Node::Entry& item : node.entries)
      if (item.key != "next" && entry.key != "any" && m_.role(item.key))
        assignment(item, path + "." + item.key, phase);
    if (entry.key == "any")
      m_.any = std::move(phase.next);
    else
      m_.phases.push_back(std::move(phase));
  }

  void transitions(const Keys& phase, std::vector<TransitionText>& out) {
    const std::string path = phase.path("next");
    for (const Node& item : phase.items("next", "a list such as [{to: cruise, when: \"...\"}]")) {
      const Keys keys(item, path, {"to", "when", "for"}, report_);
      if (!item.is(Node::Kind::map)) continue;
      TransitionText t;
      t.where = item.where();
      for (const char* key : {"to", "when"})
        if (!keys.has(key))
          report_.add(item.where(), located(path, graph_messages::transition_key_missing(key)));
      t.to = keys.word_at("to");
      t.when = keys.word_at("when");
      t.for_ns = keys.duration_ns("for").value_or(0);
      out.push_back(std::move(t));
    }
  }

  void assignment(const Node::Entry& entry, const std::string& path, PhaseText& phase) {
    AssignmentText a;
    a.role = entry.key;
    a.where = entry.where();
    if (entry.value.is(Node::Kind::map)) {
      const Keys keys(entry.value, path, {"use", "set", "fallback"}, report_);
      a.use = keys.word_at("use");
      a.fallback = keys.word_at("fallback");
      a.set = params(keys, "set");
    } else {
      const auto name =
          scalar_text(entry.value, path, "the name of a component, or {use, set, fallback}", report_);
      a.use = {name.value_or(""), entry.where()};
    }
    phase.roles.push_back(std::move(a));
  }

  MissionText& m_;
  Report& report_;
};

}  // namespace

std::optional<PortName> parse_port_name(const std::string& text, const Where& where, const std::string& path,
                                        Report& report) {
  const auto dot = text.find('.');
  if (dot != std::string::npos && is_name(text.substr(0, dot)) && is_name(text.substr(dot + 1)))
    return PortName{text.substr(0, dot), text.substr(dot + 1)};
  report.add(where, located(path, graph_messages::port_expected(text)));
  return std::nullopt;
}

std::int64_t parse_utc_ns(const std::string& text) {
  int year = 0, month = 0, day = 0, hour = 0, minute = 0, used = 0;
  double second = 0;
  const auto wrong = [&] { return Error(graph_messages::time_invalid(text)); };
  if (std::sscanf(text.c_str(), "%4d-%2d-%2dT%2d:%2d%n", &year, &month, &day, &hour, &minute, &used) < 5)
    throw wrong();
  std::string rest = text.substr(static_cast<std::size_t>(used));
  if (!rest.ends_with('Z')) throw wrong();
  rest.pop_back();
  if (!rest.empty()) {
    const auto [end, code] = std::from_chars(rest.data() + 1, rest.data() + rest.size(), second);
    if (rest[0] != ':' || code != std::errc{} || end != rest.data() + rest.size() ||
        !(second >= 0 && second < 60))
      throw wrong();
  }
  const std::chrono::year_month_day date{std::chrono::year(year),
                                         std::chrono::month(static_cast<unsigned>(month)),
                                         std::chrono::day(static_cast<unsigned>(day))};
  if (year < 1970 || year > 2200 || !date.ok() || hour < 0 || hour > 23 || minute < 0 || minute > 59)
    throw wrong();
  const std::int64_t days = std::chrono::sys_days(date).time_since_epoch().count();
  return (days * 86400 + hour * 3600 + minute * 60) * 1'000'000'000 + std::llround(second * 1e9);
}

MissionText parse_mission(const std::string& file, const Overrides& overrides, Report& report) {
  MissionText mission;
  const fs::path path = is_shipped_name(file) ? named_file({}, file) : fs::path(file);
  mission.file = std::make_shared<SourceFile>(
      SourceFile{path, path.filename().string(), read_source(path, file, overrides.files.get())->text});
  mission.files.push_back(mission.file);
  std::vector<Node> below;
  const Node root = layered_tree(mission.file, overrides.files.get(), mission.files, below, report);
  MissionReader(mission, report).read(root);
  for (const Node& layer : below) {
    Report unsaid;  // its faults are also found in the whole mission
    MissionText& text = mission.below.emplace_back();
    text.file = layer.file;
    MissionReader(text, unsaid).read(layer);
  }
  if (!root.is(Node::Kind::map)) report.throw_if_any();  // further faults would only follow from it
  if (overrides.io) {
    if (const auto io = io_of(*overrides.io))
      mission.io = *io;
    else
      report.add({"--io " + *overrides.io, 0},
                 graph_messages::choice_unknown(*overrides.io, choices_text(*overrides.io, io_words)));
  }
  if (overrides.seed) mission.seed = *overrides.seed;
  if (overrides.arm) mission.arm = *overrides.arm == "auto";
  mission.arm = mission.arm && mission.io == Io::sim;
  add_record_options(mission, overrides.record, report);
  return mission;
}

}  // namespace fulmar::core

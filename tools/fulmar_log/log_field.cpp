// SPDX-License-Identifier: BSD-3-Clause
// See log_field.hpp.
#include "tools/fulmar_log/log_field.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>

#include "core/error.hpp"
#include "core/types/named.hpp"
#include "core/types/wire.hpp"
#include "tools/fulmar_log/messages.hpp"

namespace fulmar::core {
namespace {

constexpr std::string_view probes = ".probes";

/// "positions_m[2].north" -> "positions_m[2]", "north"
std::vector<std::string> path_parts(const std::string& path) {
  std::vector<std::string> parts;
  std::istringstream in(path);
  for (std::string part; std::getline(in, part, '.');) parts.push_back(part);
  return parts;
}
std::string part_name(const std::string& part) { return part.substr(0, part.find('[')); }
std::string part_index(const std::string& part) { return part.substr(part_name(part).size()); }

std::string shown_path(const std::string& path) {
  std::string all;
  for (const std::string& part : path_parts(path))
    all += (all.empty() ? "" : ".") + shown_name(part_name(part)) + part_index(part);
  return all;
}

std::vector<std::string> shown_fields(const RosField& structure) {
  std::vector<std::string> names;
  for (const RosField& f : structure.fields) names.push_back(shown_name(f.name));
  return names;
}
const RosField* field_named(const RosField& structure, const std::string& name) {
  for (const RosField& f : structure.fields)
    if (f.name == name || shown_name(f.name) == name) return &f;
  return nullptr;
}

/// "nav.state"; a probe follows the name of its component alone.
std::string port_of_topic(const std::string& topic) {
  const std::string port = dotted_topic(topic);
  return port.ends_with(probes) ? port.substr(0, port.size() - probes.size()) : port;
}

/// True when "[2]" is a valid index.
bool is_element(const std::string& index, std::uint32_t count) {
  std::uint32_t i = 0;
  const char* const end = index.data() + index.size();
  const auto [at, code] = std::from_chars(index.data() + 1, end, i);
  return code == std::errc{} && at + 1 == end && *at == ']' && i < count;
}

std::string why_no_number(const Table& table, const std::string& path) {
  const RosField* at = &table.root;
  std::string walked = port_of_topic(table.topic);
  for (const std::string& part : path_parts(path)) {
    if (at->fields.empty()) return log_tool_messages::value_without_parts(walked, part).line();
    const std::string name = part_name(part), index = part_index(part);
    const RosField* const found = field_named(*at, name);
    if (!found)
      return log_tool_messages::subfield_unknown(walked, name, choices_text(name, shown_fields(*at))).line();
    walked += "." + shown_name(found->name);
    const bool one = found->shape == FULMAR_SCALAR;
    const std::uint32_t count = found->shape == FULMAR_LIST ? found->longest : found->count;
    if (one && !index.empty()) return log_tool_messages::path_not_list(walked).line();
    if (!one && count == 0) return log_tool_messages::list_always_empty(walked).line();
    if (!one && !is_element(index.empty() ? "[]" : index, count))
      return log_tool_messages::element_index_missing(walked, walked, walked, count - 1).line();
    walked += index;
    at = found;
  }
  if (at->fields.empty()) return log_tool_messages::path_is_text(walked).line();
  const std::vector<std::string> inside = shown_fields(*at);
  return log_tool_messages::path_not_number(walked, walked, inside.front(), join(inside)).line();
}

struct UnitName {
  std::string_view suffix, unit;
};
constexpr std::array unit_names{
    UnitName{"mps", "m/s"},  UnitName{"mps2", "m/s2"},   UnitName{"m", "m"},           UnitName{"s", "s"},
    UnitName{"deg", "deg"},  UnitName{"degps", "deg/s"}, UnitName{"degps2", "deg/s2"}, UnitName{"pa", "Pa"},
    UnitName{"volt", "V"},   UnitName{"amp", "A"},       UnitName{"newton", "N"},      UnitName{"ns", "ns"},
    UnitName{"kelvin", "K"}, UnitName{"ratio", "1"},     UnitName{"hz", "Hz"},         UnitName{"kg", "kg"},
    UnitName{"frac", "1"},   UnitName{"percent", "%"},   UnitName{"pas", "Pa s"},      UnitName{"ms", "ms"}};

/// The unit at the end of a name, or nullptr.
const UnitName* unit_in_name(const std::string& name) {
  const std::size_t bar = name.rfind('_');
  if (bar == std::string::npos) return nullptr;
  for (const UnitName& u : unit_names)
    if (name.substr(bar + 1) == u.suffix) return &u;
  return nullptr;
}

/// In logs of Fulmar the comment behind a field is its unit; in others it may be a sentence.
bool reads_as_unit(const std::string& note) {
  return !note.empty() && note.size() <= 12 && note.find_first_of(" ,;:") == std::string::npos;
}

void describe_number(const Table& table, LogNumber& n) {
  const std::string& path = table.columns[n.column].name;
  const RosField* at = &table.root;
  std::string note;
  for (const std::string& part : path_parts(path)) {
    const std::string own = part_name(part), read = shown_name(own);
    const RosField* const inner = field_named(*at, own);
    if (inner && reads_as_unit(inner->unit)) note = inner->unit;
    if (inner) at = inner;
    const UnitName* const named = unit_in_name(read);
    if (named) n.unit = named->unit;
    n.words +=
        (n.words.empty() ? "" : " ") + (named ? read.substr(0, read.rfind('_')) : read) + part_index(part);
    if (read == own) continue;
    n.factor = 180 / std::numbers::pi;
    n.angle = own.ends_with("_rad");
  }
  if (n.factor == 1 && !note.empty()) n.unit = note;
  std::replace(n.words.begin(), n.words.end(), '_', ' ');
  n.angle = n.angle || n.unit == "deg";
  const fulmar_kind kind = at->kind;
  n.held = kind != FULMAR_F32 && kind != FULMAR_F64;
}

}  // namespace

std::string dotted_topic(std::string topic) {
  std::replace(topic.begin(), topic.end(), '/', '.');
  return topic.starts_with('.') ? topic.substr(1) : topic;
}

LogPlace place_in_log(const LogInfo& info, const std::string& log, const std::string& field) {
  std::vector<std::string> ports;
  LogPlace found;
  const auto consider = [&](const std::string& topic, const std::string& port) {
    if ((field == port || field.starts_with(port + ".")) && topic.size() > found.topic.size())
      found = {topic, field.substr(std::min(field.size(), port.size() + 1))};
  };
  for (const LogInfo::Topic& t : info.topics) {
    ports.push_back(dotted_topic(t.topic));
    consider(t.topic, ports.back());
  }
  for (std::size_t i = 0; found.topic.empty() && i < ports.size(); ++i)
    if (ports[i].ends_with(probes))
      consider(info.topics[i].topic, ports[i].substr(0, ports[i].size() - probes.size()));
  if (found.topic.empty())
    throw Error(located(log, log_tool_messages::field_unknown(
                                 field, choices_text(field.substr(0, field.rfind('.')), ports))));
  return found;
}

double number_of_cell(const Cell& cell) {
  switch (cell.kind) {
    case Cell::Kind::whole: return static_cast<double>(cell.whole);
    case Cell::Kind::natural: return static_cast<double>(cell.natural);
    case Cell::Kind::single: return static_cast<double>(cell.single);
    case Cell::Kind::real: return cell.real;
    default: return std::numeric_limits<double>::quiet_NaN();
  }
}

LogNumber number_in_log(const Tables& tables, const LogPlace& place, const std::string& log) {
  LogNumber n;
  while (tables.list().at(n.table).topic != place.topic) ++n.table;
  const Table& table = tables.list()[n.table];
  const auto is_meant = [&](const Column& c) {
    return c.name == place.column || shown_path(c.name) == place.column;
  };
  const auto found = std::find_if(table.columns.begin(), table.columns.end(), is_meant);
  if (found == table.columns.end() || found->field->kind == FULMAR_TEXT)
    throw Error(located(log, why_no_number(table, place.column)));
  n.column = static_cast<std::size_t>(found - table.columns.begin());
  n.name = port_of_topic(place.topic) + "." + shown_path(found->name);
  describe_number(table, n);
  return n;
}

std::vector<std::string> numbers_beginning(const std::string& log, const std::string& prefix) {
  std::vector<std::string> found;
  const auto consider = [&](const std::string& word) {
    if (word.starts_with(prefix)) found.push_back(word);
  };
  std::vector<std::string> topics;
  for (const LogInfo::Topic& t : read_info(log).topics) {
    const std::string port = port_of_topic(t.topic) + ".";
    if (prefix.starts_with(port))
      topics.push_back(t.topic);
    else
      consider(port);
  }
  if (topics.empty()) return found;
  const Tables tables(log, topics);
  for (const Table& table : tables.list())
    for (const Column& column : table.columns)
      if (column.field->kind != FULMAR_TEXT)
        consider(port_of_topic(table.topic) + "." + shown_path(column.name));
  return found;
}

}  // namespace fulmar::core

// SPDX-License-Identifier: BSD-3-Clause
// See export_table.hpp.
#include "tools/fulmar_log/export_table.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "tools/log_reading/log_file.hpp"

namespace fulmar::core {
namespace {

constexpr std::size_t max_columns = 10'000;

/// "/nav/state" -> "nav.state": a name for a file and for an array.
std::string table_name(const std::string& topic, const std::vector<Table>& others) {
  std::string name;
  for (const char c : topic.substr(0, 100)) {
    const bool plain =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
    if (plain) name += c;
    if (!plain && !name.empty()) name += c == '/' ? '.' : '_';
  }
  if (name.empty()) name = "topic";
  const auto taken = [&](const std::string& n) {
    return std::any_of(others.begin(), others.end(), [&](const Table& t) { return t.name == n; });
  };
  std::string unique = name;
  for (int i = 2; taken(unique); ++i) unique = name + "_" + std::to_string(i);
  return unique;
}

}  // namespace

Tables::Source Tables::add(const McapFile& log, std::uint16_t channel) {
  const McapFile::Channel& c = log.channels.at(channel);
  const bool named = std::find(topics_.begin(), topics_.end(), c.topic) != topics_.end();
  if (!topics_.empty() && !named) return {};
  const auto schema = log.schemas.find(c.schema);
  const std::string encoding = schema == log.schemas.end() ? "none" : schema->second.encoding;
  if (c.encoding != "cdr" || encoding != "ros2msg")
    return {-1, "its messages are encoded as '" + c.encoding + "' with a schema of '" + encoding +
                    "'; what is read is cdr with ros2msg"};
  try {
    RosField root = parse_ros2msg(schema->second.name, schema->second.text);
    tables_.push_back({c.topic, table_name(c.topic, tables_), std::move(root), {}});
    return {static_cast<int>(tables_.size()) - 1, ""};
  } catch (const Error& e) {
    return {-1, e.what()};
  }
}

Tables::Tables(const std::filesystem::path& log, const std::vector<std::string>& topics)
    : file_(log), topics_(topics) {
  McapStream stream(log);
  std::uint64_t first_ns = std::numeric_limits<std::uint64_t>::max();
  while (const McapFile::Message* m = stream.next()) {
    first_ns = std::min(first_ns, m->log_ns);
    auto at = sources_.find(m->channel);
    if (at == sources_.end()) at = sources_.emplace(m->channel, add(stream.log(), m->channel)).first;
    Source& source = at->second;
    if (source.table < 0 || !source.why.empty()) continue;
    Table& table = tables_[static_cast<std::size_t>(source.table)];
    try {
      measure(table.root, m->data);
      ++table.rows;
    } catch (const Error& e) {
      source.why = e.what();
    }
  }
  fault_ = stream.log().fault;
  epoch_ns_ = log_epoch_ns(stream.log(), first_ns);
  for (const std::string& topic : topics_) stream.log().channel(topic);
  lay_out_all();
  for (const auto& [channel, source] : sources_) {
    if (source.why.empty()) continue;
    const std::string sentence = stream.log().channels.at(channel).topic + ": " + source.why;
    if (!topics_.empty()) throw Error(located(log.string(), sentence));
    left_out_.push_back(sentence);
  }
}

void Tables::lay_out_all() {
  for (auto& [channel, source] : sources_) {
    if (source.table < 0 || !source.why.empty()) continue;
    Table& table = tables_[static_cast<std::size_t>(source.table)];
    try {
      table.columns = lay_out(table.root, max_columns);
    } catch (const Error& e) {
      source.why = e.what();
    }
  }
  for (auto& [channel, source] : sources_) {
    if (!source.why.empty() && source.table >= 0) tables_[static_cast<std::size_t>(source.table)].rows = 0;
  }
}

void Tables::rows(const std::function<bool(std::size_t)>& wanted,
                  const std::function<void(const Row&)>& take) const {
  McapStream stream(file_);
  std::vector<Cell> cells;
  while (const McapFile::Message* m = stream.next()) {
    const auto at = sources_.find(m->channel);
    if (at == sources_.end() || at->second.table < 0 || !at->second.why.empty()) continue;
    const auto table = static_cast<std::size_t>(at->second.table);
    if (!wanted(table)) continue;
    decode(tables_[table].root, m->data, cells);
    take({table, static_cast<std::int64_t>(m->log_ns - epoch_ns_),
          static_cast<std::int64_t>(m->publish_ns - epoch_ns_), &cells});
  }
}

}  // namespace fulmar::core

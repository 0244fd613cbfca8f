// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_report/report.hpp"

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <vector>

#include "core/error.hpp"

namespace fulmar::report {
namespace {

using nlohmann::json;

constexpr std::string_view place = "LOG_OF_THE_FLIGHT";

std::uint64_t epoch_of(const core::McapFile& log) {
  for (const auto& m : log.metadata)
    if (m.name == "fulmar")
      for (const auto& [key, value] : m.pairs)
        if (key == "epoch_ns") return std::strtoull(value.c_str(), nullptr, 10);
  return 0;
}

json metadata_of(const core::McapFile& log) {
  json all = json::object();
  for (const auto& m : log.metadata)
    for (const auto& [key, value] : m.pairs) all[m.name][key] = value;
  return all;
}

double seconds(std::uint64_t ns, std::uint64_t epoch_ns) {
  const auto since = static_cast<std::int64_t>(ns - epoch_ns);
  return std::round(static_cast<double>(since) * 1e-5) / 1e4;  // tenths of a millisecond
}

void append(std::string& to, std::span<const std::byte> message) {
  const auto size = static_cast<std::uint32_t>(message.size());
  for (int shift = 0; shift < 32; shift += 8) to += static_cast<char>((size >> shift) & 0xff);
  to.append(reinterpret_cast<const char*>(message.data()), message.size());
}

struct Topic {
  std::size_t count = 0;
  std::uint64_t kept_ns = 0;
  json t = json::array();
  std::string data;
};

}  // namespace

std::string base64(std::string_view bytes) {
  constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t left = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k)
      word = word << 8 | (k < left ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) out += k <= left ? letters[(word >> (18 - 6 * k)) & 63] : '=';
  }
  return out;
}

std::string compressed(const std::string& bytes) {
  uLongf size = ::compressBound(bytes.size());
  std::string out(size, '\0');
  const int code = ::compress2(reinterpret_cast<Bytef*>(out.data()), &size,
                               reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(), 6);
  if (code != Z_OK) throw core::Error("zlib cannot compress: there is not enough memory");
  out.resize(size);
  return out;
}

std::string log_json(const core::McapFile& log, const std::string& name, double rate_hz) {
  const std::uint64_t epoch_ns = epoch_of(log);
  std::map<std::uint16_t, Topic> topics;
  std::uint64_t first_ns = ~std::uint64_t{0}, last_ns = 0;
  for (const auto& m : log.messages) {
    ++topics[m.channel].count;
    first_ns = std::min(first_ns, m.log_ns), last_ns = std::max(last_ns, m.log_ns);
  }
  // Of the whole log: what came in one burst and then no more is no stream.
  const double most =
      1.05 * (1 + rate_hz * 1e-9 * static_cast<double>(last_ns - std::min(first_ns, last_ns)));
  const double gap_ns = 0.99e9 / rate_hz;
  for (const auto& m : log.messages) {
    Topic& topic = topics[m.channel];
    const bool thinned = static_cast<double>(topic.count) > most;
    if (thinned && !topic.t.empty() && static_cast<double>(m.log_ns - topic.kept_ns) < gap_ns) continue;
    topic.kept_ns = m.log_ns;
    topic.t.push_back(seconds(m.log_ns, epoch_ns));
    append(topic.data, m.data);
  }
  json list = json::array();
  for (auto& [id, topic] : topics) {
    const auto& channel = log.channels.at(id);
    const auto& schema = log.schemas.at(channel.schema);
    if (channel.encoding != "cdr" || schema.encoding != "ros2msg") continue;
    list.push_back({{"topic", channel.topic},
                    {"type", schema.name},
                    {"schema", schema.text},
                    {"count", topic.count},
                    {"t", std::move(topic.t)},
                    {"data", base64(compressed(topic.data))}});
  }
  const json metadata = metadata_of(log);
  const json whole = {{"name", name},
                      {"mission", metadata.value("/fulmar/mission"_json_pointer, "")},
                      {"epoch_ns", std::to_string(epoch_ns)},
                      {"begin_s", topics.empty() ? 0 : seconds(first_ns, epoch_ns)},
                      {"end_s", topics.empty() ? 0 : seconds(last_ns, epoch_ns)},
                      {"fault", log.fault},
                      {"metadata", metadata},
                      {"topics", std::move(list)}};
  return whole.dump(-1, ' ', false, json::error_handler_t::replace);
}

/// No text of the log may end the element that holds it.
std::string with_log(const std::string& page, const std::string& json_text) {
  const std::size_t at = page.find(place);
  if (at == std::string::npos) throw core::Error("the page has no place for a log: it is of another version");
  std::string safe;
  safe.reserve(json_text.size());
  for (const char c : json_text) {
    if (c == '<')
      safe += "\\u003c";
    else
      safe += c;
  }
  return page.substr(0, at) + safe + page.substr(at + place.size());
}

}  // namespace fulmar::report

// SPDX-License-Identifier: BSD-3-Clause
// Where a flight's samples lie in its log.
#pragma once
#include <cstdint>
#include <string>

#include "core/graph/graph.hpp"
#include "core/log/reader.hpp"
#include "tools/fulmar_replay/survey.hpp"

namespace fulmar::core {

bool has_topic(const McapFile& file, const std::string& topic);
/// The channel of a topic whose messages are of this type. Throws Error.
std::uint16_t channel_of(const McapFile& file, const std::string& topic, const Type& type);
/// Under which of its two names the log has an output: a role's topic, or, where that has another filler's
/// fields, its own.
std::string topic_in(const McapFile& file, const Graph& graph, const Component& component,
                     std::size_t output);
/// How many samples of a channel the log has lost, as a sentence; "": none.
std::string gap_in(const Survey& survey, std::uint16_t channel);
/// Throws Error when messages of a channel stand behind later ones: they could not enter at their ticks.
void check_order(const Survey& survey, std::uint16_t channel);

inline std::int64_t flight_ns(std::uint64_t log_ns, std::int64_t epoch_ns) {
  return static_cast<std::int64_t>(log_ns) - epoch_ns;
}

}  // namespace fulmar::core

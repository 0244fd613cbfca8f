// SPDX-License-Identifier: BSD-3-Clause
// Places of a flight's samples in its log.
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
/// Topic of an output in the log: the role's, or the component's own one where the role's has the fields of
/// another component.
std::string topic_in(const McapFile& file, const Graph& graph, const Component& component,
                     std::size_t output);
/// Number of lost samples of a channel, as a sentence; "": none.
std::string gap_in(const Survey& survey, std::uint16_t channel);
/// Throws Error when messages of a channel are out of order: they could not enter at their ticks.
void check_order(const Survey& survey, std::uint16_t channel);

inline std::int64_t flight_ns(std::uint64_t log_ns, std::int64_t epoch_ns) {
  return static_cast<std::int64_t>(log_ns) - epoch_ns;
}

}  // namespace fulmar::core

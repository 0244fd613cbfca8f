// SPDX-License-Identifier: BSD-3-Clause
// What the views of a report draw of a log, topic by topic.
#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/log/reader.hpp"
#include "core/types/type.hpp"
#include "tools/fulmar_report/columns.hpp"

namespace fulmar::report {

struct ShownTopic {
  std::string topic, type, schema;    ///< "/nav/state", "fulmar_msgs/msg/VehicleState", its definition
  std::uint64_t count = 0;            ///< messages in the log
  std::vector<std::string> fields;    ///< whose values are the columns; none: the messages as they are
  Columns columns;                    ///< without fields the times alone
  std::vector<std::string> messages;  ///< CDR
  bool whole = false;                 ///< every message counts
};

/// A log's topics that are looked at, at most `rate_hz` messages of each per second; what is slow by its
/// nature (health, status) at most 2 per second; events and plans all. What cannot be read is left out, and
/// so are the topics named in `without`.
std::vector<ShownTopic> shown_topics(const std::filesystem::path& log, std::uint64_t epoch_ns, double rate_hz,
                                     const std::vector<std::string>& without = {});

/// {topic, type, schema, count, rows, fields, data, t}: `data` is packed() of the columns or of the messages;
/// of messages `t` is packed() of their times. Of streams only every `every_nth`.
nlohmann::json topic_json(const ShownTopic& topic, std::size_t every_nth);

}  // namespace fulmar::report

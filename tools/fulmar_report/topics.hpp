// SPDX-License-Identifier: BSD-3-Clause
// Topics of a log for the views of a report.
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
  std::vector<std::string> fields;    ///< fields of the columns; empty: complete messages
  Columns columns;                    ///< only times without fields
  std::vector<std::string> messages;  ///< CDR
  bool whole = false;                 ///< every message is kept
};

/// The used topics of a log with at most `rate_hz` messages per second; slow ones (health, status) at most 2
/// per second; all events and plans. Unreadable topics and those in `without` are left out.
std::vector<ShownTopic> shown_topics(const std::filesystem::path& log, std::uint64_t epoch_ns, double rate_hz,
                                     const std::vector<std::string>& without = {});

/// {topic, type, schema, count, rows, fields, data, t}: `data` is packed() of the columns or of the messages;
/// for messages `t` is packed() of their times. Streams have every `every_nth` message.
nlohmann::json topic_json(const ShownTopic& topic, std::size_t every_nth);

}  // namespace fulmar::report

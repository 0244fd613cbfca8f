// SPDX-License-Identifier: BSD-3-Clause
// A log as one HTML file that a browser shows without anything else: the messages, thinned out, inside the
// page that is built for it (web/src/report.ts).
#pragma once
#include <filesystem>
#include <string>

#include "core/log/reader.hpp"

namespace fulmar::report {

/// What the page reads, JSON: {name, mission, epoch_ns, duration_s, fault, metadata: {name: {key: value}},
/// topics: [{topic, type, schema, count, t: [seconds of flight], data}]}. `data` holds the messages as they
/// are in the log, each behind its length (4 bytes, little endian), together compressed (zlib), in base64. A
/// topic that came more often than `rate_hz` on the average of the log is thinned out to that; others are
/// whole.
std::string log_json(const core::McapFile& log, const std::string& name, double rate_hz);

/// `page` with the JSON in it. Throws Error when the page has no place for it.
std::string with_log(const std::string& page, const std::string& json);

std::string base64(std::string_view bytes);
/// As RFC 1950 has it, which browsers call "deflate".
std::string compressed(const std::string& bytes);

}  // namespace fulmar::report

// SPDX-License-Identifier: BSD-3-Clause
// A whole log, for tests.
#pragma once
#include <deque>
#include <vector>

#include "core/log/reader.hpp"

namespace fulmar::core {

struct WholeLog : McapFile {
  std::vector<Message> messages;              // in file order
  std::deque<std::vector<std::byte>> memory;  // content of the messages; moving keeps it in place
};

/// Throws Error when the file cannot be read or is no MCAP file.
inline WholeLog read_mcap(const std::filesystem::path& file) {
  McapStream stream(file);
  WholeLog log;
  while (const McapFile::Message* m = stream.next()) {
    log.messages.push_back(*m);
    log.messages.back().data = log.memory.emplace_back(m->data.begin(), m->data.end());
  }
  static_cast<McapFile&>(log) = stream.take_log();
  return log;
}

}  // namespace fulmar::core

// SPDX-License-Identifier: BSD-3-Clause
// Differences between two logs: messages, attachments and metadata.
#pragma once
#include "tools/log_reading/message_diff.hpp"

namespace fulmar::core {

struct LogDiff : MessageDiff {
  std::vector<std::string> metadata,
      attachments;  // "fulmar: seed is 7 and 8", "mission.yaml differs at line 4"

  bool equal() const { return messages_equal() && metadata.empty() && attachments.empty(); }
};

/// Throws Error for a file that is no log.
LogDiff diff_logs(const std::filesystem::path& a, const std::filesystem::path& b,
                  const DiffOptions& options = {});

}  // namespace fulmar::core

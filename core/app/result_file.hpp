// SPDX-License-Identifier: BSD-3-Clause
// Standard output of `fulmar run --json`.
#pragma once
#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/app/messages.hpp"
#include "core/say.hpp"

namespace fulmar::core {

/// With --json standard output carries the result alone: output of components goes to standard error.
class ResultFile {
 public:
  explicit ResultFile(bool as_json) {
    if (!as_json) return;
    const int own = fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 3);
    if (own < 0) return;  // there is no standard output
    file_.reset(fdopen(own, "w"));
    dup2(STDERR_FILENO, STDOUT_FILENO);
  }
  ResultFile(const ResultFile&) = delete;
  ResultFile& operator=(const ResultFile&) = delete;
  ~ResultFile() {
    if (!file_) return;
    std::fflush(stdout);
    dup2(fileno(file_.get()), STDOUT_FILENO);
  }
  /// One result alone, or {"flights": [...]}. Returns false when it cannot be written, which is reported.
  bool write(const std::vector<nlohmann::json>& results) {
    return results.empty() || write(results.size() == 1 ? results[0] : nlohmann::json{{"flights", results}});
  }
  bool write(const nlohmann::json& result) {
    if (!file_) return true;
    std::fprintf(file_.get(), "%s\n",
                 result.dump(2, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
    const bool written = std::fflush(file_.get()) == 0 && std::ferror(file_.get()) == 0;
    if (!written) warn(app_messages::result_not_writable(std::strerror(errno)));
    return written;
  }

 private:
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_{nullptr, &std::fclose};
};

}  // namespace fulmar::core

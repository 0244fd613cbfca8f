// SPDX-License-Identifier: BSD-3-Clause
#include "tools/log_reading/log_file.hpp"

#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>

#include "core/error.hpp"
#include "tools/log_reading/messages.hpp"

namespace fulmar::core {

namespace fs = std::filesystem;

void check_log_file(const std::string& file) {
  std::error_code fault;
  const auto refuse = [&](const Diagnostic& why) {
    throw Error(reading_messages::file_not_readable(file, why));
  };
  const fs::file_status status = fs::status(file, fault);
  if (!fs::exists(status))
    refuse(status.type() == fs::file_type::not_found ? reading_messages::file_missing()
                                                     : Diagnostic(fault.message()));
  if (fs::is_directory(status)) refuse(reading_messages::file_is_directory());
  if (!fs::is_regular_file(status)) refuse(reading_messages::file_not_regular());
  if (access(file.c_str(), R_OK) != 0) refuse(std::strerror(errno));
  if (fs::file_size(file, fault) == 0) refuse(reading_messages::file_empty());
}

std::uint64_t log_epoch_ns(const McapFile& log, std::uint64_t first_ns) {
  for (const McapFile::Metadata& m : log.metadata)
    for (const auto& [key, text] : m.pairs) {
      std::uint64_t ns = 0;
      const bool epoch = m.name == "fulmar" && key == "epoch_ns";
      if (epoch && std::from_chars(text.data(), text.data() + text.size(), ns).ec == std::errc{}) return ns;
    }
  // The attachments of a Fulmar log have the time of the epoch.
  return log.library == "fulmar" && !log.attachments.empty() ? log.attachments[0].log_ns : first_ns;
}

}  // namespace fulmar::core

// SPDX-License-Identifier: BSD-3-Clause
#include "core/log/log_file.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "core/error.hpp"

namespace fulmar::core {

namespace fs = std::filesystem;

void check_log_file(const std::string& file) {
  std::error_code fault;
  const auto refuse = [&](const std::string& why) { throw Error("cannot read '" + file + "': " + why); };
  const fs::file_status status = fs::status(file, fault);
  if (!fs::exists(status)) refuse(status.type() == fs::file_type::not_found ? "there is no such file" : fault.message());
  if (fs::is_directory(status)) refuse("it is a directory");
  if (!fs::is_regular_file(status)) refuse("it is no file");
  if (access(file.c_str(), R_OK) != 0) refuse(std::strerror(errno));
  if (fs::file_size(file, fault) == 0) refuse("it is empty");
}

}  // namespace fulmar::core

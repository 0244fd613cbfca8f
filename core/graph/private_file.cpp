// SPDX-License-Identifier: BSD-3-Clause
// Checks the possible writers of a plugin file.
#include "core/graph/private_file.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "core/error.hpp"
#include "core/graph/messages.hpp"

namespace fulmar::core {
namespace {

namespace fs = std::filesystem;

fs::path real_path(const fs::path& file) {
  std::error_code code;
  const fs::path path = fs::weakly_canonical(fs::absolute(file), code);
  return code ? file.lexically_normal() : path;
}

struct stat status_of(const fs::path& path) {
  struct stat info {};
  if (::stat(path.c_str(), &info) != 0)
    throw Error(graph_messages::path_not_accessible(path.string(), std::strerror(errno)));
  return info;
}

// Root acts for the user of sudo.
bool is_trusted_owner(uid_t owner) {
  if (owner == 0 || owner == ::geteuid()) return true;
  const char* caller = ::geteuid() == 0 ? std::getenv("SUDO_UID") : nullptr;
  return caller != nullptr && std::to_string(owner) == caller;
}

void check_folder(const fs::path& folder, const std::string& name) {
  const struct stat info = status_of(folder);
  if ((info.st_mode & S_IWOTH) != 0 && (info.st_mode & S_ISVTX) == 0)
    throw Error(graph_messages::folder_not_private(name, folder.string()));
}

}  // namespace

void check_private_file(const fs::path& file) {
  const fs::path path = real_path(file);
  const std::string name = file.filename().string();
  const struct stat info = status_of(path);
  if ((info.st_mode & S_IWOTH) != 0) throw Error(graph_messages::file_not_private(name, path.string()));
  if (!is_trusted_owner(info.st_uid))
    throw Error(graph_messages::file_owner_foreign(name, info.st_uid, path.string()));
  check_folder(path.parent_path(), name);
}

}  // namespace fulmar::core

// SPDX-License-Identifier: BSD-3-Clause
// Who may have written a plugin file.
#include "core/graph/private_file.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "core/error.hpp"

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
    throw Error(path.string() + " cannot be looked at: " + std::strerror(errno));
  return info;
}

// Root acts for the user who called sudo.
bool is_trusted_owner(uid_t owner) {
  if (owner == 0 || owner == ::geteuid()) return true;
  const char* caller = ::geteuid() == 0 ? std::getenv("SUDO_UID") : nullptr;
  return caller != nullptr && std::to_string(owner) == caller;
}

void check_folder(const fs::path& folder, const std::string& name) {
  const struct stat info = status_of(folder);
  if ((info.st_mode & S_IWOTH) != 0 && (info.st_mode & S_ISVTX) == 0)
    throw Error(name + " is not loaded: everybody may replace files in its folder; chmod o-w " +
                folder.string());
}

}  // namespace

void check_private_file(const fs::path& file) {
  const fs::path path = real_path(file);
  const std::string name = file.filename().string();
  const struct stat info = status_of(path);
  if ((info.st_mode & S_IWOTH) != 0)
    throw Error(name + " is not loaded: everybody may write to it; chmod o-w " + path.string());
  if (!is_trusted_owner(info.st_uid))
    throw Error(name + " is not loaded: it belongs to the user " + std::to_string(info.st_uid) +
                ", neither to you nor to root; chown it: " + path.string());
  check_folder(path.parent_path(), name);
}

}  // namespace fulmar::core

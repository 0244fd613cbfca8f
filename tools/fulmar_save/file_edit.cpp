// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_save/file_edit.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string_view>
#include <system_error>
#include <vector>

#include "core/error.hpp"
#include "core/graph/yaml.hpp"
#include "tools/fulmar_save/messages.hpp"

namespace fulmar::core {
namespace fs = std::filesystem;
namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    lines.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return lines;
}

bool write_all(int file, std::string_view text) {
  while (!text.empty()) {
    const ssize_t n = ::write(file, text.data(), text.size());
    if (n < 0 && errno != EINTR) return false;
    text.remove_prefix(static_cast<std::size_t>(std::max<ssize_t>(n, 0)));
  }
  return true;
}

}  // namespace

// Changes replace or add single lines, so the next equal line ends a difference.
std::string diff_text(const FileEdit& edit) {
  const std::vector<std::string> old = lines_of(edit.before), now = lines_of(edit.after);
  std::string text;
  std::size_t i = 0, j = 0;
  while (i < old.size() || j < now.size()) {
    if (i < old.size() && j < now.size() && old[i] == now[j]) {
      ++i;
      ++j;
      continue;
    }
    const bool added = i >= old.size() || (now.size() - j > old.size() - i &&
                                           std::find(now.begin() + static_cast<std::ptrdiff_t>(j), now.end(),
                                                     old[i]) != now.end());
    text += edit.name + ":" + std::to_string(j + 1) + "\n";
    if (!added) text += "- " + old[i++] + "\n";
    if (j < now.size()) text += "+ " + now[j++] + "\n";
  }
  return text;
}

void write_edit(const FileEdit& edit) {
  if (read_source(edit.path, edit.path.string())->text != edit.before)
    throw Error(save_messages::file_changed(edit.path.string()));
  std::error_code fault;
  const fs::path target = fs::canonical(edit.path, fault);
  const auto mode = static_cast<mode_t>(fs::status(target, fault).permissions());
  std::string fresh = (target.parent_path() / ("." + target.filename().string() + ".XXXXXX"))
                          .string();  // a name that does not exist
  const auto failed = [&](int code) {
    throw Error(save_messages::file_not_writable(edit.path.string(), std::strerror(code)));
  };
  if (fault) failed(fault.value());
  if ((mode & (S_IWUSR | S_IWGRP | S_IWOTH)) == 0) failed(EACCES);  // root could still write it
  const int file = ::mkostemp(fresh.data(), O_CLOEXEC);
  if (file < 0) failed(errno);
  // The data are synchronised to disk before the rename: otherwise a power failure could leave an empty file.
  int code = write_all(file, edit.after) && ::fchmod(file, mode) == 0 && ::fsync(file) == 0 ? 0 : errno;
  if (::close(file) != 0 && code == 0) code = errno;
  if (code == 0 && ::rename(fresh.c_str(), target.c_str()) != 0) code = errno;
  if (code == 0) return;
  ::unlink(fresh.c_str());
  failed(code);
}

}  // namespace fulmar::core

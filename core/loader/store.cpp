// SPDX-License-Identifier: BSD-3-Clause
// SHA-256 and the store of private copies.
#include "core/loader/store.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <vector>

#include "core/error.hpp"
#include "core/loader/file_sum.hpp"
#include "core/loader/messages.hpp"

namespace fulmar::core {
namespace {

namespace fs = std::filesystem;
constexpr std::size_t max_copies = 128;             // the least recently used copies are removed
constexpr const char* suffixes[] = {".so", ".py"};  // of what is kept

// Throws with the system's reason.
[[noreturn]] void fail(const Diagnostic& what) {
  throw Error(located(what, loader_messages::store_fault(std::strerror(errno))));
}

// Throws when another user owns the folder or may write to it: that user could swap the code between check
// and load.
void check_private(const fs::path& folder) {
  struct stat info {};
  if (::lstat(folder.c_str(), &info) != 0 || !S_ISDIR(info.st_mode))
    throw Error(loader_messages::store_not_folder(folder.string()));
  if (info.st_uid != ::geteuid()) throw Error(loader_messages::store_owner_foreign(folder.string()));
  if ((info.st_mode & (S_IWGRP | S_IWOTH)) != 0)
    throw Error(loader_messages::store_not_private(folder.string()));
}

// Makes the folder with mode 0700 unless it exists. Returns false when that is impossible.
bool make_private(const fs::path& folder) {
  std::error_code fault;
  if (fs::exists(folder, fault)) return true;
  if (folder.has_parent_path() && !fs::exists(folder.parent_path(), fault) &&
      !make_private(folder.parent_path()))
    return false;
  return ::mkdir(folder.c_str(), 0700) == 0 || errno == EEXIST;
}

// Lives as long as the process.
struct TemporaryFolder {
  fs::path path;
  TemporaryFolder() {
    std::string name = (fs::temp_directory_path() / "fulmar-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) fail(loader_messages::temporary_store_missing());
    path = name;
  }
  ~TemporaryFolder() {
    std::error_code fault;
    fs::remove_all(path, fault);
  }
};

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

fs::path store_folder() {
  if (const std::string chosen = environment("FULMAR_STORE"); !chosen.empty()) {
    if (!make_private(chosen)) fail(loader_messages::store_not_created(chosen));
    return chosen;
  }
  const std::string cache = environment("XDG_CACHE_HOME"), home = environment("HOME");
  if (const fs::path root = !cache.empty() ? fs::path(cache)
                            : home.empty() ? fs::path()
                                           : fs::path(home) / ".cache";
      root.is_absolute()) {
    const fs::path folder = root / "fulmar" / "plugins";
    if (make_private(folder) && ::access(folder.c_str(), W_OK) == 0) return folder;
  }
  static const TemporaryFolder temporary;
  return temporary.path;
}

// Writes a temporary file and renames it, so that no process reads an incomplete copy.
void write_copy(const fs::path& path, std::span<const std::byte> bytes) {
  std::string name = path.string() + ".XXXXXX";
  const int file = ::mkostemp(name.data(), O_CLOEXEC);
  if (file < 0) fail(loader_messages::store_not_writable(path.parent_path().string()));
  std::FILE* out = ::fdopen(file, "wb");
  const bool written = out != nullptr && std::fwrite(bytes.data(), 1, bytes.size(), out) == bytes.size() &&
                       std::fflush(out) == 0 && ::fchmod(file, 0400) == 0 &&
                       ::rename(name.c_str(), path.c_str()) == 0;
  const int fault = errno;
  out != nullptr ? std::fclose(out) : ::close(file);
  if (written) return;
  ::unlink(name.c_str());
  errno = fault;
  fail("cannot write " + path.string());
}

bool is_suffix(const std::string& text) {
  return std::find(std::begin(suffixes), std::end(suffixes), text) != std::end(suffixes);
}

bool is_sha256(const std::string& text) {
  return text.size() == 64 && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

bool holds(const fs::path& copy, const std::string& sha256) {
  std::error_code fault;
  return fs::is_regular_file(fs::symlink_status(copy, fault)) && sha256_file(copy) == sha256;
}

void mark_used(const fs::path& copy) { ::utimensat(AT_FDCWD, copy.c_str(), nullptr, 0); }

// Removes only the name: a mapped library keeps its file.
void prune(const fs::path& folder) {
  std::error_code fault;
  std::vector<std::pair<fs::file_time_type, fs::path>> copies;
  for (const auto& entry : fs::directory_iterator(folder, fault))
    if (is_suffix(entry.path().extension().string()))
      copies.emplace_back(entry.last_write_time(fault), entry.path());
  if (copies.size() <= max_copies) return;
  std::sort(copies.begin(), copies.end());
  for (std::size_t i = 0; i + max_copies < copies.size(); ++i) fs::remove(copies[i].second, fault);
}

}  // namespace

fs::path keep_copy(std::span<const std::byte> bytes, const std::string& sha256, const std::string& suffix) {
  if (!is_suffix(suffix)) throw Error(loader_messages::store_suffix_invalid(suffix));
  const fs::path folder = store_folder();
  check_private(folder);
  const fs::path copy = fs::absolute(folder) / (sha256 + suffix);
  std::error_code fault;
  if (fs::file_size(copy, fault) == bytes.size() && !fault && holds(copy, sha256)) {
    mark_used(copy);
    return copy;
  }
  write_copy(copy, bytes);
  prune(folder);
  return copy;
}

std::optional<fs::path> find_in_store(const std::string& sha256) {
  if (!is_sha256(sha256)) return std::nullopt;
  const fs::path folder = store_folder();
  check_private(folder);
  for (const char* suffix : suffixes) {
    const fs::path copy = fs::absolute(folder) / (sha256 + suffix);
    if (!holds(copy, sha256)) continue;
    mark_used(copy);
    return copy;
  }
  return std::nullopt;
}

fs::path version_that_flew(const std::string& file, const std::string& version, const std::string& sha256) {
  if (const auto copy = find_in_store(sha256)) return *copy;
  throw Error(loader_messages::stored_plugin_missing(file, version, sha256, store_folder().string()));
}

}  // namespace fulmar::core

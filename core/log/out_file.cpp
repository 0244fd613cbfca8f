// SPDX-License-Identifier: BSD-3-Clause
// Linux: write(2), and rename that never replaces.
#include "core/log/out_file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "core/error.hpp"
#include "core/log/messages.hpp"

namespace fulmar::core {

OutFile::OutFile(const std::filesystem::path& file, bool held) : file_(file), name_(file.string() + ".part") {
  if (!held) refuse(file_);
  fd_ = ::open(name_.c_str(), O_WRONLY | O_CLOEXEC | (held ? 0 : O_CREAT | O_EXCL), 0644);
  if (fd_ < 0) throw Error(log_messages::log_not_writable(name_.string(), std::strerror(errno)));
  ::flock(fd_, LOCK_EX | LOCK_NB);  // the lock ends with this process; a file system without locks is no
                                    // error
}

bool OutFile::hold(const std::filesystem::path& file) {
  const std::string part = file.string() + ".part";
  const int fd = ::open(part.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
  if (fd < 0 && errno == EEXIST) return false;
  if (fd < 0) throw Error(log_messages::log_not_writable(part, std::strerror(errno)));
  ::close(fd);
  std::error_code none;
  if (!std::filesystem::exists(std::filesystem::symlink_status(file, none))) return true;
  ::unlink(part.c_str());  // the previous owner of the name has finished meanwhile
  return false;
}

void OutFile::let_go(const std::filesystem::path& file) {
  const std::string part = file.string() + ".part";
  std::error_code none;
  if (std::filesystem::file_size(part, none) == 0 && !none) ::unlink(part.c_str());
}

bool OutFile::grows(const std::filesystem::path& file) {
  const int fd = ::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (fd < 0) return false;
  const bool held = ::flock(fd, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  ::close(fd);
  return held;
}

void OutFile::refuse(const std::filesystem::path& file) {
  const std::string part = file.string() + ".part";
  std::error_code none;
  if (std::filesystem::exists(std::filesystem::symlink_status(file, none)))  // a broken link counts, too
    throw Error(log_messages::log_exists(file.string()));
  if (std::filesystem::exists(std::filesystem::symlink_status(part, none)))
    throw Error(log_messages::partial_log_exists(
        part, grows(part) ? "another run is writing it; wait for its end, or give another name"
                          : "a run was interrupted; move it away, or run fulmar log recover on it"));
}

OutFile::~OutFile() {
  if (fd_ >= 0) ::close(fd_);
}

bool OutFile::failed(const char* what) {
  fail(log_messages::operation_failed(what, name_.string(), std::strerror(errno)));
  return false;
}

void OutFile::fail(const Diagnostic& why) {
  if (error_.empty()) error_ = why;
}

bool OutFile::still_there() {
  struct stat about {
  }, named{};
  if (::fstat(fd_, &about) != 0) return failed("examine");
  if (about.st_nlink == 0) {
    fail(log_messages::log_removed(name_.string()));
    name_.clear();
    return false;
  }
  const bool there = ::stat(name_.c_str(), &named) == 0;
  if (!there && errno != ENOENT && errno != ENOTDIR) return failed("examine");
  if (!there || named.st_dev != about.st_dev || named.st_ino != about.st_ino) {
    note_move();
    return false;
  }
  if (static_cast<std::uint64_t>(about.st_size) == size_) return true;
  fail(log_messages::log_altered(name_.string(), about.st_size, size_));
  return false;
}

/// Asks the kernel for the current path.
void OutFile::note_move() {
  std::error_code none;
  const std::filesystem::path now =
      std::filesystem::read_symlink("/proc/self/fd/" + std::to_string(fd_), none);
  fail(log_messages::log_moved(name_.string(), none ? "'" : "' to '" + now.string() + "'"));
  name_ = now;
}

bool OutFile::append(const void* block, std::size_t size) {
  if (!still_there()) return false;
  const char* at = static_cast<const char*>(block);
  for (std::size_t left = size; left > 0;) {
    const ssize_t n = ::write(fd_, at, left);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) {
      failed("write");
      // Truncate the partial block: a reader finds whole records up to the end.
      if (::ftruncate(fd_, static_cast<off_t>(size_)) == 0) ::lseek(fd_, static_cast<off_t>(size_), SEEK_SET);
      return false;
    }
    at += n;
    left -= static_cast<std::size_t>(n);
  }
  size_ += size;
  crc_ = static_cast<std::uint32_t>(::crc32_z(crc_, static_cast<const Bytef*>(block), size));
  sha_.add(block, size);
  return true;
}

bool OutFile::sync() { return ::fdatasync(fd_) == 0 || errno == EINVAL || errno == EROFS || failed("store"); }

bool OutFile::finish() {
  const int closed = ::close(fd_);
  fd_ = -1;
  if (closed != 0) return failed("close");
  int named = ::renameat2(AT_FDCWD, name_.c_str(), AT_FDCWD, file_.c_str(), RENAME_NOREPLACE);
  if (named != 0 && (errno == EINVAL || errno == ENOSYS)) {  // a file system without this flag
    errno = EEXIST;
    named = std::filesystem::exists(file_) ? -1 : std::rename(name_.c_str(), file_.c_str());
  }
  if (named != 0) return failed("rename");
  name_ = file_;
  return true;
}

}  // namespace fulmar::core

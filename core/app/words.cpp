// SPDX-License-Identifier: BSD-3-Clause
#include "core/app/words.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <time.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>

#include "fulmar/quiet_thread.hpp"

namespace fulmar::core {
namespace {

constexpr int room_bytes = 256 * 1024;
constexpr int patience_ms = 1000;

// The thread lives until the process ends; so its data has no destructor.
std::atomic<int> reader{STDERR_FILENO};  // previous target of standard error
std::atomic<int> left{-1};               // the read end of the pipe
std::atomic<bool> passing{false};        // the thread is forwarding text

bool wait_for(int descriptor, short event, int limit_ms) noexcept {
  pollfd p{descriptor, event, 0};
  return poll(&p, 1, limit_ms) > 0 && (p.revents & event) != 0;
}

/// Writes all of the data. Returns false when there is no room for the given time, or no reader.
bool write_all(int descriptor, const char* data, std::size_t size, int limit_ms) noexcept {
  while (size > 0) {
    if (!wait_for(descriptor, POLLOUT, limit_ms)) return false;
    const ssize_t n = write(descriptor, data, size);
    if (n < 0 && errno != EINTR && errno != EAGAIN) return false;
    if (n > 0) {
      data += n;
      size -= static_cast<std::size_t>(n);
    }
  }
  return true;
}

void pass_on() noexcept {
  static char buffer[4096];
  while (true) {
    if (!wait_for(left, POLLIN, -1)) return;  // standard error has been closed
    passing = true;
    const ssize_t n = read(left, buffer, sizeof buffer);
    if (n > 0) write_all(reader, buffer, static_cast<std::size_t>(n), -1);
    passing = false;
  }
}

bool nothing_left() noexcept {
  int bytes = 0;
  return ioctl(left, FIONREAD, &bytes) != 0 || (bytes == 0 && !passing);
}

}  // namespace

void print_without_waiting() {
  if (left >= 0) return;
  int ends[2];
  const int own = fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 3);
  if (own < 0) return;  // there is no standard error, and so no reader
  if (pipe2(ends, O_CLOEXEC | O_NONBLOCK) != 0) {
    close(own);
    return;
  }
  fcntl(ends[1], F_SETPIPE_SZ, room_bytes);  // less when that is not permitted
  reader = own;
  left = ends[0];
  dup2(ends[1], STDERR_FILENO);
  close(ends[1]);
  quiet_thread("fulmar-words", pass_on).detach();
  std::atexit(pass_on_words);
}

void pass_on_words() noexcept {
  const timespec pause{0, 1'000'000};
  for (int i = 0; i < patience_ms && left >= 0 && !nothing_left(); ++i) nanosleep(&pause, nullptr);
}

bool words_on_terminal() noexcept { return isatty(reader) != 0; }

void write_last_words(const char* text) noexcept {
  char buffer[1024];
  for (ssize_t n = 0; left >= 0 && (n = read(left, buffer, sizeof buffer)) > 0;)
    if (!write_all(reader, buffer, static_cast<std::size_t>(n), patience_ms)) break;
  write_all(reader, text, std::strlen(text), patience_ms);
}

}  // namespace fulmar::core

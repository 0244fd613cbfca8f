// SPDX-License-Identifier: BSD-3-Clause
// Spawned, never forked: the host has threads. posix_spawn runs nothing of the host's between the two
// processes.
#include "core/isolate/process.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "core/error.hpp"
#include "core/isolate/shared.hpp"
#include "core/loader/home.hpp"

extern char** environ;

namespace fulmar::core {
namespace {

namespace fs = std::filesystem;

// The host's own; when it is a test or a tool elsewhere, FULMAR_CHILD says where.
fs::path child_program() {
  if (const char* chosen = std::getenv("FULMAR_CHILD"); chosen != nullptr && *chosen != '\0') return chosen;
  const fs::path found = own_program("fulmar-child");
  if (found.empty())
    throw Error("the program fulmar-child is missing: no component can run in a process of its own.");
  return found;
}

// All pages at once, so that none is missing in flight.
std::byte* map(int descriptor, std::size_t at, std::size_t size) {
  void* data = ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_POPULATE, descriptor,
                      static_cast<off_t>(at));
  return data == MAP_FAILED ? nullptr : static_cast<std::byte*>(data);
}

[[noreturn]] void no_memory(std::size_t size) {
  throw Error("cannot share " + std::to_string(size) + " bytes with a child: " + std::strerror(errno) + ".");
}

// Standard input is empty; what a component prints goes to the host's standard error, so that the host's
// output stays its own.
struct Files {
  posix_spawn_file_actions_t actions;
  explicit Files(int memory) {
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, memory,
                                     shared_descriptor);  // first: it may be one of the standard three
    if (::fcntl(STDERR_FILENO, F_GETFD) < 0)
      posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, STDERR_FILENO, STDOUT_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
#if __GLIBC_PREREQ(2, 34)
    posix_spawn_file_actions_addclosefrom_np(&actions, shared_descriptor + 1);
#endif
  }
  ~Files() { posix_spawn_file_actions_destroy(&actions); }
  Files(const Files&) = delete;
  Files& operator=(const Files&) = delete;
};

// Signals as they are by default; a group of its own, so that the terminal's interrupt is the host's alone.
struct Attributes {
  posix_spawnattr_t attributes;
  Attributes() {
    posix_spawnattr_init(&attributes);
    sigset_t none, all;
    sigemptyset(&none);
    sigfillset(&all);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setsigdefault(&attributes, &all);
    posix_spawnattr_setpgroup(&attributes, 0);
    posix_spawnattr_setflags(&attributes,
                             POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
  }
  ~Attributes() { posix_spawnattr_destroy(&attributes); }
  Attributes(const Attributes&) = delete;
  Attributes& operator=(const Attributes&) = delete;
};

}  // namespace

SharedMemory::SharedMemory(std::size_t size) : size_(size), whole_(size) {
  descriptor_ = ::memfd_create("fulmar-child", MFD_CLOEXEC | MFD_ALLOW_SEALING);
  if (descriptor_ < 0) no_memory(size);
  const bool sized = ::ftruncate(descriptor_, static_cast<off_t>(size)) == 0;
  if (sized) ::fcntl(descriptor_, F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_SEAL);
  data_ = sized ? map(descriptor_, 0, size) : nullptr;
  if (data_) return;
  const int fault = errno;
  ::close(descriptor_);
  errno = fault;
  no_memory(size);
}

SharedMemory::~SharedMemory() {
  ::munmap(data_, size_);
  ::close(descriptor_);
}

SharedMemory::Window::Window(SharedMemory& memory, std::size_t at, std::size_t size) : size_(size) {
  if (size == 0) return;
  if (at + size > memory.whole_) {
    if (::ftruncate(memory.descriptor_, static_cast<off_t>(at + size)) != 0) no_memory(size);
    memory.whole_ = at + size;
  }
  data_ = map(memory.descriptor_, at, size);
  if (!data_) no_memory(size);
}

SharedMemory::Window::~Window() {
  if (data_) ::munmap(data_, size_);
}

Process::Process(const std::vector<std::string>& words, const SharedMemory& memory) {
  std::string program = child_program().string();
  std::vector<std::string> kept = words;
  std::vector<char*> arguments{program.data()};
  for (std::string& word : kept) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const Files files(memory.descriptor());
  const Attributes attributes;
  const int fault = ::posix_spawn(&pid_, program.c_str(), &files.actions, &attributes.attributes,
                                  arguments.data(), environ);
  if (fault != 0) throw Error("cannot start " + program + ": " + std::strerror(fault) + ".");
}

Process::~Process() {
  if (ended()) return;
  kill();
  siginfo_t how{};
  while (::waitid(P_PID, static_cast<id_t>(pid_), &how, WEXITED) != 0 && errno == EINTR) continue;
}

bool Process::ended() noexcept {
  if (reaped_) return true;
  siginfo_t how{};
  if (::waitid(P_PID, static_cast<id_t>(pid_), &how, WEXITED | WNOHANG | WNOWAIT) == 0) {
    if (how.si_pid == 0) return false;
    ::kill(-pid_, SIGKILL);  // while the zombie still keeps the number of the group
    ::waitid(P_PID, static_cast<id_t>(pid_), &how, WEXITED | WNOHANG);
    (how.si_code == CLD_EXITED ? exit_code_ : signal_) = how.si_status;
  } else if (errno == EINTR) {
    return false;
  }
  reaped_ = true;
  return true;
}

void Process::kill() noexcept {
  if (reaped_) return;
  ::kill(-pid_, SIGKILL);
  ::kill(pid_, SIGKILL);  // it may have left its group
}

bool Process::wait(std::int64_t limit_ns) noexcept {
  const std::int64_t end = monotonic_ns() + limit_ns;
  for (long pause_ns = 20'000; !ended(); pause_ns = pause_ns < 1'000'000 ? 2 * pause_ns : pause_ns) {
    if (monotonic_ns() > end) return false;
    const timespec pause{0, pause_ns};
    ::nanosleep(&pause, nullptr);
  }
  return true;
}

}  // namespace fulmar::core

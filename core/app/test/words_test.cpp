// SPDX-License-Identifier: BSD-3-Clause
// A paced flight and the reader of its standard error: a slow or stopped reader delays nothing, and an active
// one gets the whole text.
#include <doctest/doctest.h>
#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <string>
#include <thread>
#include <vector>

namespace {

using namespace std::chrono_literals;

/// The program with a pipe for standard error; its standard output is discarded.
struct Host {
  int ends[2] = {-1, -1};
  pid_t process = -1;
  explicit Host(std::vector<std::string> words, bool full = false) {
    REQUIRE(pipe2(ends, O_CLOEXEC) == 0);
    if (full) fill();
    std::vector<char*> arguments;
    static std::string name = FULMAR_BIN_DIR "/fulmar";
    arguments.push_back(name.data());
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    process = fork();
    if (process == 0) {
      dup2(open("/dev/null", O_WRONLY), STDOUT_FILENO);
      dup2(ends[1], STDERR_FILENO);
      execv(arguments[0], arguments.data());
      _exit(127);
    }
    close(ends[1]);
  }
  ~Host() {
    if (process > 0) {
      kill(process, SIGKILL);
      waitpid(process, nullptr, 0);
    }
    close(ends[0]);
  }
  /// Fills the pipe, as for a reader that has stopped before the first byte.
  void fill() {
    const std::string page(4096, '.');
    fcntl(ends[1], F_SETPIPE_SZ, 4096);
    fcntl(ends[1], F_SETFL, O_NONBLOCK);
    while (write(ends[1], page.data(), page.size()) > 0) continue;
    fcntl(ends[1], F_SETFL, 0);
  }
  std::string read_all() {
    std::string text;
    char buffer[4096];
    for (ssize_t n = 0; (n = read(ends[0], buffer, sizeof buffer)) > 0;)
      text.append(buffer, static_cast<std::size_t>(n));
    return text;
  }
  /// The exit code, or -1 when it has not ended in time.
  int wait(std::chrono::seconds limit) {
    int status = 0;
    for (const auto end = std::chrono::steady_clock::now() + limit; std::chrono::steady_clock::now() < end;) {
      if (waitpid(process, &status, WNOHANG) == process) {
        process = -1;
        return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
      }
      std::this_thread::sleep_for(20ms);
    }
    return -1;
  }
};

const std::string hourglass = FULMAR_SOURCE_DIR "/configs/missions/hourglass.yaml";

}  // namespace

TEST_CASE("a stopped reader of standard error does not stop a paced flight") {
  Host host({"run", hourglass, "--no-log", "--speed", "20", "--duration", "20"}, true);
  CHECK(host.wait(60s) == 0);  // flown, without a byte read
}

TEST_CASE("a reader gets the whole text of a paced flight, from the first byte to the last") {
  Host host({"run", hourglass, "--no-log", "--speed", "50", "--duration", "20"});
  const std::string text = host.read_all();
  CHECK(host.wait(60s) == 0);
  CHECK(text.find("hourglass: simulation, seed 7\n") == 0);
  std::size_t at = 0;
  for (const char* words :
       {"run.phase_entered(hold)\n", "run.phase_entered(takeoff)\n", "run.phase_entered(cruise)\n"}) {
    CAPTURE(words);
    at = text.find(words, at);
    CHECK(at != std::string::npos);
  }
}

TEST_CASE("the last message of a program that ends at once comes after the buffered ones") {
  if (!FULMAR_CRASH_TESTS) {
    MESSAGE("skipped: the sanitizers report crashes by themselves");
    return;
  }
  Host host({"run", hourglass, "--no-log", "--speed", "1"});
  std::string text;
  char buffer[4096];
  while (text.find("run.phase_entered(takeoff)") == std::string::npos) {
    const ssize_t n = read(host.ends[0], buffer, sizeof buffer);
    REQUIRE(n > 0);
    text.append(buffer, static_cast<std::size_t>(n));
  }
  kill(host.process, SIGABRT);  // as a component does
  text += host.read_all();
  CHECK(text.find("app.host_crashed(abort)") != std::string::npos);
  CHECK(host.wait(60s) == 128 + SIGABRT);
}

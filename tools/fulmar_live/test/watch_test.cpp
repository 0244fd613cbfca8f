// SPDX-License-Identifier: BSD-3-Clause
// `fulmar watch` at a terminal and without one, with a mock flight in a separate process.
#include <doctest/doctest.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <string>
#include <thread>

#include "links/live/server.hpp"
#include "links/live/test/mock.hpp"

namespace watch_test {

using namespace fulmar::core;

namespace {

/// A mock flight that can be stopped like one on a computer that hangs.
class FlightProcess {
 public:
  explicit FlightProcess(std::uint16_t port = 0) {
    std::array<int, 2> report{};
    REQUIRE(pipe(report.data()) == 0);
    pid_ = fork();
    if (pid_ == 0) fly(port, report[1]);
    close(report[1]);
    REQUIRE(read(report[0], &port_, sizeof port_) == sizeof port_);
    close(report[0]);
  }
  ~FlightProcess() { end(); }
  FlightProcess(const FlightProcess&) = delete;
  FlightProcess& operator=(const FlightProcess&) = delete;
  void end() {
    if (pid_ <= 0) return;
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
    pid_ = 0;
  }
  void send(int signal) const { kill(pid_, signal); }
  std::uint16_t port() const { return port_; }

 private:
  [[noreturn]] static void fly(std::uint16_t port, int report) {
    Tap tap{test::mock_channels()};
    test::MockControl control;
    LiveOptions options;
    options.port = port;
    const LiveServer server(tap, control, options);
    const std::uint16_t chosen = server.port();
    if (write(report, &chosen, sizeof chosen) != sizeof chosen) _exit(1);
    for (int i = 0;; ++i) {
      test::mock_tick(tap, i);
      std::this_thread::sleep_for(std::chrono::microseconds(2500));
    }
  }
  pid_t pid_ = 0;
  std::uint16_t port_ = 0;
};

/// A terminal of 100 x 12 in which it runs.
class Terminal {
 public:
  explicit Terminal(std::uint16_t port) {
    winsize size{12, 100, 0, 0};
    pid_ = forkpty(&fd_, nullptr, nullptr, &size);
    if (pid_ == 0) {
      execl(FULMAR_BIN_DIR "/fulmar", "fulmar", "watch", "--at", std::to_string(port).c_str(), nullptr);
      _exit(127);
    }
  }
  ~Terminal() {
    if (pid_ > 0) {
      kill(pid_, SIGKILL);
      waitpid(pid_, nullptr, 0);
    }
    close(fd_);
  }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;
  /// Whether it has written this since the last call, or does before long.
  bool shows(const std::string& what) {
    std::array<char, 4096> buffer{};
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (std::chrono::steady_clock::now() < end) {
      if (const std::size_t at = said_.find(what); at != std::string::npos) {
        last_ = said_.substr(0, at + what.size());
        said_.erase(0, at + what.size());
        return true;
      }
      fd_set ready;
      FD_ZERO(&ready);
      FD_SET(fd_, &ready);
      timeval patience{1, 0};
      if (select(fd_ + 1, &ready, nullptr, nullptr, &patience) <= 0) continue;
      const ssize_t got = read(fd_, buffer.data(), buffer.size());
      if (got <= 0) return false;
      said_.append(buffer.data(), static_cast<std::size_t>(got));
    }
    return false;
  }
  const std::string& last() const { return last_; }
  void send(int signal) const { kill(pid_, signal); }
  int code() {
    int status = 0;
    waitpid(std::exchange(pid_, 0), &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }

 private:
  pid_t pid_ = 0;
  int fd_ = -1;
  std::string said_, last_;
};

}  // namespace

TEST_CASE(
    "a flight that is gone, or silent, is told within a second and found again; Ctrl-C leaves no trace") {
  FlightProcess flight;
  Terminal terminal(flight.port());
  REQUIRE(terminal.shows("\x1b[?1049h\x1b[?25l\x1b[?7l"));
  REQUIRE(terminal.shows("mock <1>  cruise  "));
  CHECK(terminal.last().find("lost") == std::string::npos);

  flight.send(SIGSTOP);  // silent, and no connection is closed
  REQUIRE(terminal.shows("! remote.trying_again(remote.connection_lost, "));
  CHECK(terminal.shows(")"));
  CHECK((terminal.last() == "0)" || terminal.last() == "1)"));
  REQUIRE(terminal.shows("(remote.connection_lost, 3)"));
  flight.send(SIGCONT);
  REQUIRE(terminal.shows("mock <1>  cruise  "));

  flight.end();
  REQUIRE(terminal.shows("remote.flight_ended(127.0.0.1:" + std::to_string(flight.port()) + "), 0)"));
  const FlightProcess next(flight.port());
  REQUIRE(terminal.shows("mock <1>  cruise  "));

  terminal.send(SIGINT);
  CHECK(terminal.shows("\x1b[?7h\x1b[?25h\x1b[?1049l"));
  CHECK(terminal.code() == 130);
}

TEST_CASE("where there is no terminal it prints what is there once, without colours") {
  const FlightProcess flight;
  FILE* pipe = popen((FULMAR_BIN_DIR "/fulmar watch --at " + std::to_string(flight.port())).c_str(), "r");
  REQUIRE(pipe != nullptr);
  std::string text;
  std::array<char, 4096> buffer{};
  for (std::size_t n = 0; (n = fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
    text.append(buffer.data(), n);
  CHECK(pclose(pipe) == 0);
  CHECK(text.starts_with("mock <1>  cruise  0:0"));
  CHECK(text.find("\nslowest   slc 3.5 (9) us\n") != std::string::npos);
  CHECK(text.find('\x1b') == std::string::npos);
}

}  // namespace watch_test

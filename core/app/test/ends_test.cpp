// SPDX-License-Identifier: BSD-3-Clause
// The program `fulmar` when a flight does not end by itself: it reports the component and the place of the
// log, and sends the last frame to the vehicle's device, for each crashing thread and each kind of end.
#include <fcntl.h>
#include <sys/syscall.h>
#include <sys/wait.h>

#include <chrono>
#include <csignal>
#include <set>
#include <thread>

#include "core/run/test/lab.hpp"
#include "links/dds/test/domain.hpp"

namespace ends_test {

using namespace lab;

namespace {

fs::path device() { return folder().path / "device"; }
fs::path log_file() { return folder().path / "end.mcap"; }

/// The program with the laboratory's mission, and its output.
class Program {
 public:
  explicit Program(const std::string& tail, std::vector<std::string> words = {},
                   const std::string& log = log_file()) {
    for (const fs::path& old : {device(), log_file(), fs::path(log_file().string() + ".part")})
      fs::remove(old);
    mission("  sim: {fills: vehicle, use: lab/Cart, params: {device: " + device().string() + "}}\n" + tail);
    const std::string program = std::string(FULMAR_BIN_DIR) + "/fulmar", printed = said_.string();
    words.insert(words.begin(), {program, "run", (folder().path / "lab.yaml").string(), "--log", log});
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    pid_ = fork();
    REQUIRE(pid_ >= 0);
    if (pid_ > 0) return;
    const int to = open(printed.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
    dup2(to, STDOUT_FILENO);
    dup2(to, STDERR_FILENO);
    if (chdir(folder().path.c_str()) != 0) _exit(126);
    execv(program.c_str(), arguments.data());
    _exit(127);
  }
  ~Program() {
    if (pid_ <= 0) return;
    kill(pid_, SIGKILL);
    wait();
  }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  /// The exit code, or 128 plus the signal, as in a shell.
  int wait() {
    int status = 0;
    waitpid(pid_, &status, 0);
    pid_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }
  std::string printed() const { return text(said_); }
  pid_t pid() const { return pid_; }

  /// Waits until the log has begun.
  bool logs() const {
    for (int i = 0; i < 2000 && !fs::exists(log_file().string() + ".part"); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return thread("fulmar-log") > 0;
  }
  /// Thread by name; waits until it exists.
  pid_t thread(const std::string& name) const {
    for (int i = 0; i < 2000; ++i) {
      for (const auto& [id, found] : threads())
        if (found == name) return id;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return -1;
  }
  std::vector<std::pair<pid_t, std::string>> threads() const {
    std::vector<std::pair<pid_t, std::string>> all;
    std::error_code gone;
    for (const auto& task : fs::directory_iterator("/proc/" + std::to_string(pid_) + "/task", gone)) {
      std::string name = text(task.path() / "comm");
      name.erase(name.find_last_not_of('\n') + 1);
      all.emplace_back(std::stoi(task.path().filename().string()), name);
    }
    return all;
  }
  /// Signals that a thread blocks.
  std::uint64_t blocked(pid_t thread) const {
    std::istringstream lines(
        text("/proc/" + std::to_string(pid_) + "/task/" + std::to_string(thread) + "/status"));
    for (std::string line; std::getline(lines, line);)
      if (line.starts_with("SigBlk:")) return std::stoull(line.substr(7), nullptr, 16);
    return 0;
  }

 private:
  static std::string text(const fs::path& file) {
    std::ifstream in(file);
    return {(std::istreambuf_iterator<char>(in)), {}};
  }
  pid_t pid_ = -1;
  fs::path said_ = folder().path / "said";
};

std::size_t occurrences(const std::string& text, const std::string& word) {
  std::size_t n = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++n;
  return n;
}

double last_frame() {
  double u = 0;
  std::ifstream(device(), std::ios::binary).read(reinterpret_cast<char*>(&u), sizeof u);
  return u;
}

constexpr double failsafe = -0.25;  // of the mission

std::string law(const std::string& fault, const std::string& mode = "") {
  return "  one: {fills: law, use: lab/Law, " + mode + "params: {fault: " + fault + ", fault_at: 0.1 s}}\n" +
         with_fallback;
}

/// Most of the threads that a host can have beside the loop.
const std::string everything =
    "  think: {use: lab/Thinker, run: async, latency: 20 ms, in: {signal: vehicle.signal}}\n"
    "  ticker: {use: lab/Ticker, run: driver}\n"
    "live: {listen: 127.0.0.1:0}\ndds: {domain: " +
    std::to_string(fulmar::core::test::own_domain()) +
    ", export: [vehicle.signal]}\nrecord: {ports: [\"*\"]}\n";

}  // namespace

TEST_CASE("a component that ends the host is reported, and the device gets the last frame") {
  struct End {
    const char *fault, *mode, *reported;
    int code;
  };
  const std::string async = "run: async, latency: 10 ms, ";
  for (const End& end :
       {End{"crashes", "", "app.component_crashed(one, step, segmentation fault)", 128 + SIGSEGV},
        End{"aborts", "", "app.component_crashed(one, step, abort)", 128 + SIGABRT},
        End{"divides", "", "app.component_crashed(one, step, arithmetic fault)", 128 + SIGFPE},
        End{"overflows", "", "app.component_crashed(one, step, ", 128 + SIGSEGV},
        End{"exits", "", "app.component_ended_program(one, step)", 1},
        End{"quits", "", "app.component_ended_program(one, step)", 1},
        End{"thread_crashes", "", "app.host_crashed_in(lab.so, segmentation fault)", 128 + SIGSEGV},
        End{"thread_quits", "", "app.thread_ended_program", 1},
        End{"crashes", async.c_str(), "app.component_crashed(one, step, segmentation fault)", 128 + SIGSEGV},
        End{"aborts", async.c_str(), "app.component_crashed(one, step, abort)", 128 + SIGABRT},
        End{"divides", async.c_str(), "app.component_crashed(one, step, arithmetic fault)", 128 + SIGFPE},
        End{"overflows", async.c_str(), "app.component_crashed(one, step, ", 128 + SIGSEGV},
        End{"quits", async.c_str(), "app.component_ended_program(one, step)", 1}}) {
    if (!FULMAR_CRASH_TESTS && end.code != 1) continue;  // a sanitized build handles crashes by itself
    CAPTURE(end.fault);
    CAPTURE(end.mode);
    Program program(law(end.fault, end.mode));
    CHECK(program.wait() == end.code);
    const std::string printed = program.printed();
    CHECK_MESSAGE(printed.find(end.reported) != std::string::npos, printed);
    CHECK(printed.find("app.log_until_end(" + log_file().string() + ".part)") != std::string::npos);
    CHECK(fs::exists(log_file().string() + ".part"));
    CHECK(last_frame() == failsafe);
  }
}

TEST_CASE("when several threads end the program, one reason is reported, complete and once") {
  if (!FULMAR_CRASH_TESTS) return;
  for (int i = 0; i < 3; ++i) {
    Program program(law("threads_terminate", ""));
    CHECK(program.wait() == 128 + SIGABRT);
    const std::string printed = program.printed(), crashed = "_crashed(";
    const auto at = printed.find(crashed);
    REQUIRE(at != std::string::npos);
    CHECK(printed.find(crashed, at + 1) == std::string::npos);
    CHECK(printed.find("app.log_until_end(" + log_file().string() + ".part)\n", at) != std::string::npos);
    CHECK(last_frame() == failsafe);
  }
}

TEST_CASE("a signal that a component raises is handled, beside the loop as in it") {
  const std::string async = "run: async, latency: 10 ms, ";
  for (const std::string& mode : {std::string(), async}) {
    CAPTURE(mode);
    Program usr1(law("raises_usr1", mode));
    CHECK(usr1.wait() == 128 + SIGUSR1);
    CHECK_MESSAGE(usr1.printed().find("app.ended_by_signal(SIGUSR1)") != std::string::npos, usr1.printed());
    CHECK(last_frame() == failsafe);
    Program term(law("raises_term", mode));
    CHECK(term.wait() == 130);
    CHECK_MESSAGE(term.printed().find("interrupted") != std::string::npos, term.printed());
    CHECK(fs::exists(log_file()));
  }
}

TEST_CASE("the report of a log gives its present place: the complete name, not the one before a move") {
  if (FULMAR_CRASH_TESTS) {
    Program program(law("crashes"), {}, "end.mcap");
    CHECK(program.wait() == 128 + SIGSEGV);
    CHECK_MESSAGE(
        program.printed().find("app.log_until_end(" + log_file().string() + ".part)") != std::string::npos,
        program.printed());
  }
  Program program(one_phase, {"--speed", "real"}, "end.mcap");
  const fs::path part = log_file().string() + ".part";
  REQUIRE(program.logs());
  fs::rename(part, folder().path / "elsewhere");
  kill(program.pid(), SIGQUIT);
  CHECK(program.wait() == 128 + SIGQUIT);
  const std::string printed = program.printed();
  CHECK_MESSAGE(
      printed.find("app.ended_by_signal(SIGQUIT). app.log_not_found(" + part.string()) != std::string::npos,
      printed);
  CHECK(printed.find("app.log_until_end") == std::string::npos);
}

TEST_CASE("a fork of the host that exits is not the host") {
  Program program(law("forks"), {"--duration", "0.3"});
  CHECK(program.wait() == 0);
  CHECK_MESSAGE(program.printed().find("ended_program") == std::string::npos, program.printed());
  CHECK(last_frame() == 0);
}

TEST_CASE("a copy of the host that returns from a step ends, and the host flies on alone") {
  for (const std::string& mode : {""s, "run: async, latency: 10 ms, "s}) {
    CAPTURE(mode);
    Program program(law("clones_on", mode), {"--duration", "0.3"});
    CHECK(program.wait() == 0);
    const std::string printed = program.printed();
    CHECK_MESSAGE(occurrences(printed, "flown") == 1, printed);
    CHECK(occurrences(printed, "run.host_forked(one)") == 1);
    CHECK(last_frame() == 0);
  }
}

TEST_CASE("a copy of the host that a signal ends does not act as the host: no last frame, no report") {
  if (!FULMAR_CRASH_TESTS) return;
  Program program(law("clones_end"), {"--duration", "0.15"});
  CHECK(program.wait() == 0);
  const std::string printed = program.printed();
  CHECK_MESSAGE(printed.find("crashed") == std::string::npos, printed);
  CHECK(printed.find("ended_by") == std::string::npos);
  CHECK(printed.find("guard") == std::string::npos);  // each copy ended by its signal
  CHECK(last_frame() == 0);
}

TEST_CASE("only the main thread of the host takes a signal, and all threads take those of a crash") {
  Program program(everything + std::string(one_phase), {"--speed", "real"});
  for (const char* const name : {"fulmar-log", "fulmar-live", "fulmar-async", "fulmar-driver", "fulmar-words",
                                 "fulmar-dds-out", "fulmar-dds-in"}) {
    CAPTURE(name);
    CHECK(program.thread(name) > 0);
  }
  std::uint64_t crashes = 0;
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT})
    crashes |= std::uint64_t{1} << (signal - 1);
  constexpr std::uint64_t interrupt = std::uint64_t{1} << (SIGINT - 1);
  for (const auto& thread : program.threads()) {
    CAPTURE(thread.second);
    std::uint64_t blocked = program.blocked(thread.first);
    // a thread blocks all signals while it is created, or creates one
    for (int i = 0; i < 1000 && (blocked & crashes) != 0; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      blocked = program.blocked(thread.first);
    }
    CHECK((blocked & crashes) == 0);
    if (thread.first != program.pid()) CHECK((blocked & interrupt) != 0);
  }
}

TEST_CASE("a crash of any thread of the host is reported, and its device gets the last frame") {
  if (!FULMAR_CRASH_TESTS) return;
  for (const char* const name : {"fulmar-log", "fulmar-live", "fulmar-dds-out", "fulmar-words"}) {
    CAPTURE(name);
    Program program(everything + std::string(one_phase), {"--speed", "real"});
    const pid_t thread = program.thread(name);
    REQUIRE(thread > 0);
    REQUIRE(program.logs());
    REQUIRE(syscall(SYS_tgkill, program.pid(), thread, SIGSEGV) == 0);
    CHECK(program.wait() == 128 + SIGSEGV);
    CHECK(program.printed().find("app.host_crashed(segmentation fault). app.log_until_end(") !=
          std::string::npos);
    CHECK(last_frame() == failsafe);
  }
}

TEST_CASE(
    "whichever signal ends the host, the device gets the last frame, and it is told where the log lies") {
  struct End {
    int signal;
    const char* name;
  };
  for (const End& end :
       {End{SIGQUIT, "SIGQUIT"}, End{SIGUSR1, "SIGUSR1"}, End{SIGUSR2, "SIGUSR2"}, End{SIGXCPU, "SIGXCPU"},
        End{SIGVTALRM, "SIGVTALRM"}, End{SIGIO, "SIGIO"}, End{SIGRTMIN, "SIGRTMIN"},
        End{SIGRTMIN + 5, "SIGRTMIN+5"}, End{SIGRTMAX, "SIGRTMIN+30"}}) {
    CAPTURE(end.name);
    Program program(one_phase, {"--speed", "real"});
    REQUIRE(program.logs());
    kill(program.pid(), end.signal);
    CHECK(program.wait() == 128 + end.signal);
    CHECK_MESSAGE(program.printed().find("app.ended_by_signal("s + end.name + "). app.log_until_end(") !=
                      std::string::npos,
                  program.printed());
    CHECK(last_frame() == failsafe);
  }
}

TEST_CASE("a paced flight that stood still reports it, at once and in its result") {
  Program program(one_phase, {"--speed", "real", "--duration", "3"});
  // The first event comes before the clock runs; the line of progress comes after it.
  for (int i = 0; i < 2000 && program.printed().find("s  fly") == std::string::npos; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  kill(program.pid(), SIGSTOP);
  std::this_thread::sleep_for(std::chrono::milliseconds(1500));
  kill(program.pid(), SIGCONT);
  CHECK(program.wait() == 0);
  const std::string printed = program.printed();
  CHECK_MESSAGE(printed.find("s  run.flight_behind(1.") != std::string::npos, printed);
  CHECK_MESSAGE(printed.find("  up to 1.") != std::string::npos, printed);
}

TEST_CASE("a crash after the flight names the plugin and does not point to a missing log") {
  if (!FULMAR_CRASH_TESTS) return;
  Program program(law("parts"), {"--duration", "0.3"});
  CHECK(program.wait() == 128 + SIGSEGV);
  const std::string printed = program.printed();
  CHECK_MESSAGE(printed.find("app.file_crashed(lab.so, unloaded, segmentation fault). app.flight_over\n") !=
                    std::string::npos,
                printed);
  CHECK(printed.find(".part") == std::string::npos);
  CHECK(fs::exists(log_file()));
}

}  // namespace ends_test

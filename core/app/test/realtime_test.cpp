// SPDX-License-Identifier: BSD-3-Clause
// Real-time priority: the threads that have it in a flight, and the message when it is not permitted.
#include "core/run/component/realtime.hpp"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <grp.h>
#include <sched.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include "core/error.hpp"

namespace fs = std::filesystem;
using namespace fulmar::core;

namespace {

/// Runs `work` in a child and returns its output: this process stays unchanged.
template <class Work>
std::string in_child(Work&& work) {
  int ends[2];
  REQUIRE(pipe(ends) == 0);
  const pid_t child = fork();
  if (child == 0) {
    const std::string words = work();
    _exit(write(ends[1], words.data(), words.size()) == static_cast<ssize_t>(words.size()) ? 0 : 1);
  }
  close(ends[1]);
  std::string words;
  char buffer[4096];
  for (ssize_t n = 0; (n = read(ends[0], buffer, sizeof buffer)) > 0;)
    words.append(buffer, static_cast<std::size_t>(n));
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  CHECK(WIFEXITED(status));
  return words;
}

/// The message for a user without rights and limits.
std::string as_nobody(rlim_t priorities, rlim_t memory) {
  return in_child([&]() -> std::string {
    if (getuid() == 0 && (setgroups(0, nullptr) != 0 || setgid(65534) != 0 || setuid(65534) != 0))
      return "cannot become nobody";
    const rlimit priority{priorities, priorities}, locked{memory, memory};
    if (setrlimit(RLIMIT_RTPRIO, &priority) != 0 || setrlimit(RLIMIT_MEMLOCK, &locked) != 0)
      return "cannot lower a limit";
    try {
      take_real_time(70);
    } catch (const Error& fault) {
      return fault.what();
    }
    return "taken";
  });
}

std::string policy_of(pid_t thread) {
  const int policy = sched_getscheduler(thread);
  sched_param p{};
  sched_getparam(thread, &p);
  if (policy == SCHED_OTHER) return "ordinary";
  return ((policy & ~SCHED_RESET_ON_FORK) == SCHED_FIFO ? "fifo " : "other ") +
         std::to_string(p.sched_priority) + (policy & SCHED_RESET_ON_FORK ? " not inherited" : "");
}

std::string first_line(const fs::path& file) {
  std::string line;
  std::getline(std::ifstream(file) >> std::ws, line);
  return line;
}

/// name -> policy, of every thread of a process
std::map<std::string, std::string> threads_of(pid_t process) {
  std::map<std::string, std::string> threads;
  std::error_code fault;
  for (const auto& entry : fs::directory_iterator("/proc/" + std::to_string(process) + "/task", fault))
    threads[first_line(entry.path() / "comm")] = policy_of(std::stoi(entry.path().filename().string()));
  return threads;
}

long locked_kb(pid_t process) {
  std::ifstream status("/proc/" + std::to_string(process) + "/status");
  for (std::string line; std::getline(status, line);)
    if (line.rfind("VmLck:", 0) == 0) return std::strtol(line.c_str() + 6, nullptr, 10);
  return -1;
}

std::vector<pid_t> children_of(pid_t parent) {
  std::vector<pid_t> children;
  for (const auto& entry : fs::directory_iterator("/proc")) {
    const std::string name = entry.path().filename().string();
    if (name.find_first_not_of("0123456789") != std::string::npos) continue;
    std::ifstream status(entry.path() / "status");
    for (std::string line; std::getline(status, line);)
      if (line == "PPid:\t" + std::to_string(parent)) children.push_back(std::stoi(name));
  }
  return children;
}

bool permitted() {
  return in_child([] {
           try {
             take_real_time(usual_priority);
             return std::string("yes");
           } catch (const Error&) {
             return std::string("no");
           }
         }) == "yes";
}

}  // namespace

TEST_CASE("without permission one sentence names the missing right and its remedy") {
  const std::string nothing = as_nobody(0, 64 * 1024);
  // This program started again prints the sentence itself.
  if (getenv("FULMAR_TEST_SENTENCE") != nullptr) {
    std::printf("<%s>", nothing.c_str());
    return;
  }
  CHECK(nothing.find("run.realtime_not_permitted(to lock its memory (limit 64 kB), ") == 0);
  const std::string memory_alone = as_nobody(0, RLIM_INFINITY);
  if (memory_alone != "cannot lower a limit")  // a hard limit of this machine for every user
    CHECK(memory_alone.find("run.realtime_not_permitted(to run with priority 70 (limit 0), ") == 0);
  std::FILE* const again = popen(
      "FULMAR_TEST_SENTENCE=1 FULMAR_MESSAGES=sentences /proc/$PPID/exe -tc='without permission*'", "r");
  REQUIRE(again != nullptr);
  std::string out(1u << 16, '\0');
  out.resize(std::fread(out.data(), 1, out.size(), again));
  pclose(again);
  const std::size_t begin = out.find('<');
  REQUIRE(begin != std::string::npos);
  const std::string sentence = out.substr(begin, out.find('>', begin) - begin);
  for (const char* way :
       {"/etc/security/limits.d/fulmar.conf", "'@dialout - rtprio 70'", "'@dialout - memlock unlimited'",
        "setcap cap_sys_nice,cap_ipc_lock+ep ", "fulmar@.service"})
    CHECK_MESSAGE(sentence.find(way) != std::string::npos, way);
  CHECK(sentence.find('\n') == std::string::npos);
}

TEST_CASE("memory that would not suffice later is not reported as enough") {
  rlimit here{};
  REQUIRE(getrlimit(RLIMIT_MEMLOCK, &here) == 0);
  const rlim_t gigabyte = std::min<rlim_t>(
      here.rlim_max, rlim_t{1} << 30);  // more than this process has now, less than a flight may need
  CHECK(as_nobody(0, gigabyte)
            .find("run.realtime_not_permitted(to lock its memory (limit " + std::to_string(gigabyte / 1024) +
                  " kB)") != std::string::npos);
}

TEST_CASE("the thread that requests priority gets it, and threads that it starts later do not") {
  if (!permitted()) {
    MESSAGE("not permitted here: not tried");
    return;
  }
  const std::string words = in_child([] {
    take_real_time(61);
    take_real_time(62);
    std::string inherited;
    std::thread([&] { inherited = policy_of(0); }).join();
    return policy_of(0) + "\n" + inherited + (locked_kb(getpid()) > 0 ? "\nlocked" : "\nnot locked");
  });
  CHECK(words == "fifo 62 not inherited\nordinary\nlocked");
}

TEST_CASE("in flight the loop has it, its isolated component has one less, the log's thread has none") {
  if (!permitted()) {
    MESSAGE("not permitted here: not tried");
    return;
  }
  const fs::path folder = fs::temp_directory_path() / ("fulmar-realtime-test-" + std::to_string(getpid()));
  fs::create_directories(folder);
  std::ofstream(folder / "mission.yaml")
      << "mission: trial\nextends: " FULMAR_SOURCE_DIR
         "/configs/missions/common.yaml\nairframe: " FULMAR_SOURCE_DIR
         "/configs/airframes/anaconda.yaml\norigin: {lat: 40.2463724, lon: -111.6474138, alt_msl: 1387 m}\n"
         "components:\n  plan: {params: {plan: " FULMAR_SOURCE_DIR
         "/configs/plans/hourglass.yaml}}\n  slc: {run: process, hang: 5 s}\n";
  const pid_t host = fork();
  if (host == 0) {
    const int null = open("/dev/null", O_WRONLY);
    dup2(null, 1);
    dup2(null, 2);
    if (chdir(folder.c_str()) != 0) _exit(126);
    execl(FULMAR_BIN_DIR "/fulmar", "fulmar", "run", "mission.yaml", "--speed", "real", "--duration", "60",
          "--realtime=75", nullptr);
    _exit(127);
  }
  // the flight has begun once its log's thread exists
  std::map<std::string, std::string> threads;
  for (int i = 0; i < 3000 && threads.count("fulmar-log") == 0; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    threads = threads_of(host);
  }
  CHECK(threads["fulmar"] == "fifo 75 not inherited");
  CHECK(threads["fulmar-log"] == "ordinary");
  CHECK(locked_kb(host) > 1000);
  const std::vector<pid_t> children = children_of(host);
  REQUIRE(children.size() == 1);
  CHECK(policy_of(children[0]) == "fifo 74 not inherited");
  kill(host, SIGTERM);
  int status = 0;
  waitpid(host, &status, 0);
  CHECK(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 130);
  fs::remove_all(folder);
}

TEST_CASE(
    "the loop's thread stays on one CPU; threads that it creates may leave it, and it does after the "
    "flight") {
  const auto cpus = [] {
    cpu_set_t set;
    CPU_ZERO(&set);
    REQUIRE(sched_getaffinity(0, sizeof set, &set) == 0);
    return CPU_COUNT(&set);
  };
  const int before = cpus();
  stay_on_one_cpu();
  CHECK(cpus() == 1);
  int there = 0;
  std::thread([&] {
    leave_cpu_of_loop();
    there = cpus();
  }).join();
  CHECK(there == before);
  CHECK(cpus() == 1);
  leave_cpu_of_loop();
  CHECK(cpus() == before);
  stay_on_one_cpu();  // a second flight in the same program
  CHECK(cpus() == 1);
  leave_cpu_of_loop();
  CHECK(cpus() == before);
}

// SPDX-License-Identifier: BSD-3-Clause
// Latency from an inertial sample at a flight controller's port to the command of that tick at the same port,
// at 400 Hz, with the shipped controllers in every tick and the log written. It is compared with a bare echo
// on the same pseudo-terminal in the same run, with and without real-time priority. The figures are valid on
// an idle machine.
// bench_fcu_latency [--json] [--seconds N]
#include <poll.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <vector>

#include "plugins/fcu_serial/test/peer/endpoint.hpp"
#include "plugins/fcu_serial/test/peer/firmware.hpp"

using namespace fulmar::fcu;
using namespace fulmar::fcu::peer;
namespace fs = std::filesystem;

namespace {

std::int64_t now_ns() {
  timespec t{};
  ::clock_gettime(CLOCK_MONOTONIC, &t);
  return std::int64_t{t.tv_sec} * 1'000'000'000 + t.tv_nsec;
}

bool real_time(int priority) {
  const sched_param p{priority};
  return ::sched_setscheduler(0, priority > 0 ? SCHED_FIFO : SCHED_OTHER, &p) == 0;
}

// ---- the two responders

/// Answers each frame at once with a frame of a command's size.
[[noreturn]] void echo(const std::string& port) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  const int fd = ::open(port.c_str(), O_RDWR | O_NOCTTY);
  std::array<std::uint8_t, length<SmallImu> + frame_overhead> in{};
  const Frame out = encode(OffboardControl{}, 0);
  while (fd >= 0 && ::read(fd, in.data(), in.size()) > 0)
    if (::write(fd, out.bytes.data(), out.size) < 0) break;
  std::_Exit(0);
}

/// The shipped mission with commands in every tick.
std::string mission(const fs::path& folder) {
  const std::string configs = FULMAR_SOURCE_DIR "/configs/", file = (folder / "latency.yaml").string();
  std::ofstream(file)
      << "mission: latency\nextends: " << configs << "missions/common.yaml\nairframe: " << configs
      << "airframes/anaconda.yaml\norigin: {lat: 40.2463724, lon: -111.6474138, alt_msl: 1387 m}\n"
      << "done: \"manage.progress.circuits >= 2\"\ncomponents:\n"
      << "  plan: {params: {plan: " << configs << "plans/hourglass.yaml}}\n"
      << "  attitude: {fills: inner, use: control_slc/Inner, rate: 400 Hz}\n";
  return file;
}

pid_t fly(const fs::path& folder, const std::string& port, bool real) {
  const pid_t child = ::fork();
  if (child != 0) return child;
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  real_time(0);
  const std::string file = mission(folder), log = (folder / "latency.mcap").string(),
                    set = "fcu.port=" + port;
  if (!std::freopen((folder / "host.txt").c_str(), "w", stderr) || !std::freopen("/dev/null", "w", stdout))
    std::_Exit(1);
  ::execl(FULMAR_BIN_DIR "/fulmar", "fulmar", "run", file.c_str(), "--io", "fcu", "--set", set.c_str(),
          "--log", log.c_str(), real ? "--realtime" : nullptr, nullptr);
  std::_Exit(127);
}

void end(pid_t child) {
  for (int k = 0; k < 20; ++k) {
    if (::waitpid(child, nullptr, WNOHANG) == child) return;
    if (k == 0) ::kill(child, SIGTERM);
    ::poll(nullptr, 0, 100);
  }
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
}

// ---- the controller

struct Figures {
  std::vector<double> trip_us, interval_us;
  int samples = 0, unanswered = 0;
};

class Controller {
 public:
  Controller() : port_("") {
    firmware_.provision();
    firmware_.run(12'000'000);
    firmware_.take();
    begun_ns_ = now_ns() - 12'000'000'000;
  }
  std::string port() const { return port_.name(); }

  /// Measures for that time; the first second does not count. `alone`: only inertial samples are sent.
  Figures measure(double seconds, bool alone) {
    Figures f;
    const std::int64_t first_ns = now_ns() + 1'000'000'000,
                       last_ns = first_ns + static_cast<std::int64_t>(1e9 * seconds);
    sent_ns_ = arrived_ns_ = 0;
    while (now_ns() < last_ns) {
      wait();
      receive(f, now_ns() >= first_ns);
      firmware_.run(clock_us());
      transmit(f, alone, now_ns() >= first_ns);
    }
    return f;
  }
  /// Waits for commands of the host.
  bool wait_for_commands(double seconds) {
    const auto before = firmware_.commands();
    Figures none;
    for (const std::int64_t last_ns = now_ns() + static_cast<std::int64_t>(1e9 * seconds);
         now_ns() < last_ns;) {
      wait();
      receive(none, false);
      firmware_.run(clock_us());
      transmit(none, false, false);
      if (firmware_.commands() > before + 400) return true;
    }
    return false;
  }

 private:
  std::int64_t clock_us() const { return (now_ns() - begun_ns_) / 1000; }

  void wait() {
    const std::int64_t left_ns = std::max<std::int64_t>(0, begun_ns_ + 1000 * firmware_.next_us() - now_ns());
    const timespec time{left_ns / 1'000'000'000, left_ns % 1'000'000'000};
    pollfd p{port_.attended() ? port_.descriptor() : -1, POLLIN, 0};
    ::ppoll(&p, 1, &time, nullptr);
  }
  void receive(Figures& f, bool counts) {
    std::array<std::uint8_t, 512> room;
    const std::size_t n = port_.read(room);
    const std::int64_t at_ns = now_ns();
    if (n == 0) return;
    parser_.feed({room.data(), n}, [&](const Packet& p) {
      if (!p.is<OffboardControl>()) return;
      if (counts && sent_ns_ > 0) f.trip_us.push_back(1e-3 * static_cast<double>(at_ns - sent_ns_));
      if (counts && arrived_ns_ > 0) f.interval_us.push_back(1e-3 * static_cast<double>(at_ns - arrived_ns_));
      sent_ns_ = 0;
      arrived_ns_ = at_ns;
    });
    firmware_.receive({room.data(), n}, clock_us());
  }
  void transmit(Figures& f, bool alone, bool counts) {
    Frame frame;
    std::vector<std::uint8_t> rest;
    while (firmware_.take(frame)) {
      if (frame.bytes[5] != SmallImu::id) {
        rest.insert(rest.end(), frame.bytes.begin(),
                    frame.bytes.begin() + static_cast<std::ptrdiff_t>(frame.size));
        continue;
      }
      if (counts) {
        ++f.samples;
        if (sent_ns_ > 0)
          ++f.unanswered;  // within its period: the answer counts from the oldest sample without one
      }
      if (sent_ns_ == 0) sent_ns_ = now_ns();
      port_.write(frame.view());
    }
    if (!alone && !rest.empty()) port_.write(rest);
  }

  Terminal port_;
  Firmware firmware_;
  Parser parser_;
  std::int64_t begun_ns_ = 0, sent_ns_ = 0, arrived_ns_ = 0;
};

// ---- figures

double quantile(std::vector<double> v, double q) {
  if (v.empty()) return NAN;
  const auto at = v.begin() + static_cast<std::ptrdiff_t>(q * static_cast<double>(v.size() - 1));
  std::nth_element(v.begin(), at, v.end());
  return *at;
}

nlohmann::json trip(const Figures& f) {
  return {{"p50_us", quantile(f.trip_us, 0.5)},
          {"p99_us", quantile(f.trip_us, 0.99)},
          {"max_us", quantile(f.trip_us, 1)},
          {"samples", f.samples},
          {"unanswered", f.unanswered}};
}

/// Gaps and jitter of the loop, measured by the controller.
nlohmann::json loop(const Figures& f) {
  std::vector<double> jitter;
  int gaps = 0;
  for (const double us : f.interval_us) {
    jitter.push_back(std::abs(us - 2500));
    if (us > 5000) ++gaps;
  }
  return {{"jitter_p50_us", quantile(jitter, 0.5)},
          {"jitter_p99_us", quantile(jitter, 0.99)},
          {"longest_gap_us", quantile(f.interval_us, 1)},
          {"gaps_over_5_ms", gaps}};
}

nlohmann::json run(const fs::path& folder, double seconds, bool real) {
  if (real && !real_time(85)) return nullptr;
  Controller controller;
  const auto echoed = [&] {
    const pid_t child = ::fork();
    if (child == 0) {
      if (real) real_time(80);
      echo(controller.port());
    }
    Figures f = controller.measure(seconds / 2, true);
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    return f;
  };
  Figures bare = echoed();
  const pid_t host = fly(folder, controller.port(), real);
  if (!controller.wait_for_commands(30)) {
    end(host);
    std::ifstream said(folder / "host.txt");
    throw std::runtime_error("the host sends no commands: " +
                             std::string(std::istreambuf_iterator<char>(said), {}));
  }
  const Figures whole = controller.measure(seconds, false);
  end(host);
  const Figures after = echoed();
  bare.trip_us.insert(bare.trip_us.end(), after.trip_us.begin(), after.trip_us.end());
  bare.samples += after.samples;
  bare.unanswered += after.unanswered;
  real_time(0);
  nlohmann::json excess;
  for (const auto& [name, q] : {std::pair{"p50_us", 0.5}, {"p99_us", 0.99}, {"max_us", 1.0}})
    excess[name] = quantile(whole.trip_us, q) - quantile(bare.trip_us, q);
  return {{"echo", trip(bare)}, {"host", trip(whole)}, {"excess", excess}, {"loop", loop(whole)}};
}

void print(const char* title, const nlohmann::json& r) {
  if (r.is_null()) return static_cast<void>(std::printf("%s: not allowed here\n", title));
  std::printf("%s\n%-34s %9s %9s %9s\n", title, "", "p50 us", "p99 us", "max us");
  for (const auto& [key, words] :
       {std::pair{"echo", "bare echo"}, {"host", "sample to command"}, {"excess", "excess"}})
    std::printf("  %-32s %9.1f %9.1f %9.1f\n", words, r[key]["p50_us"].get<double>(),
                r[key]["p99_us"].get<double>(), r[key]["max_us"].get<double>());
  const auto& l = r["loop"];
  std::printf(
      "  jitter of the commands' period    %9.1f %9.1f; longest gap %.1f ms, %d above 5 ms; %d of %d samples "
      "unanswered in their period\n",
      l["jitter_p50_us"].get<double>(), l["jitter_p99_us"].get<double>(),
      1e-3 * l["longest_gap_us"].get<double>(), l["gaps_over_5_ms"].get<int>(),
      r["host"]["unanswered"].get<int>(), r["host"]["samples"].get<int>());
}

}  // namespace

int main(int argc, char** argv) try {
  bool json = false;
  double seconds = 20;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--json") == 0)
      json = true;
    else if (std::strcmp(argv[i], "--seconds") == 0 && i + 1 < argc)
      seconds = std::atof(argv[++i]);
    else {
      std::fprintf(stderr, "bench_fcu_latency [--json] [--seconds N]\n");
      return 2;
    }
  }
  ::prctl(PR_SET_TIMERSLACK, 1000UL, 0UL, 0UL, 0UL);
  const fs::path folder = fs::temp_directory_path() / ("fulmar_latency_" + std::to_string(::getpid()));
  fs::create_directories(folder);
  const nlohmann::json plain = run(folder, seconds, false);
  fs::remove(folder / "latency.mcap");
  const nlohmann::json real = run(folder, seconds, true);
  fs::remove_all(folder);
  if (json) {
    std::printf("%s\n", nlohmann::json{{"plain", plain}, {"realtime", real}}.dump(2).c_str());
  } else {
    print("without real-time priority", plain);
    print("with SCHED_FIFO", real);
  }
  return 0;
} catch (const std::exception& e) {
  std::fprintf(stderr, "bench_fcu_latency: %s\n", e.what());
  return 1;
}

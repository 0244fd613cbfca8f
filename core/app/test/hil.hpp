// SPDX-License-Identifier: BSD-3-Clause
// Hardware in the loop without hardware: the host and the program fcu_peer as two processes, connected by a
// pseudo-terminal.
#pragma once
#include <fcntl.h>
#include <sched.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "core/app/test/standstill.hpp"

extern char** environ;

namespace fulmar::fcu::testing {

namespace fs = std::filesystem;

inline double wall_s() {
  timespec t{};
  clock_gettime(CLOCK_MONOTONIC, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}
inline void nap(double seconds) {
  const timespec t{static_cast<time_t>(seconds), static_cast<long>(1e9 * (seconds - std::floor(seconds)))};
  nanosleep(&t, nullptr);
}

/// A program with its output in files; killed when it goes out of scope.
class Process {
 public:
  Process(const std::vector<std::string>& words, fs::path out, fs::path err)
      : out_(std::move(out)), err_(std::move(err)) {
    std::vector<char*> argv;
    for (const auto& w : words) argv.push_back(const_cast<char*>(w.c_str()));
    argv.push_back(nullptr);
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, 1, out_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    posix_spawn_file_actions_addopen(&files, 2, err_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    if (posix_spawn(&pid_, argv[0], &files, nullptr, argv.data(), environ) != 0) pid_ = -1;
    posix_spawn_file_actions_destroy(&files);
  }
  ~Process() {
    if (running()) {
      signal(SIGKILL);
      ::waitpid(pid_, nullptr, 0);
    }
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  bool running() {
    if (pid_ < 0 || done_) return false;
    int status = 0;
    if (::waitpid(pid_, &status, WNOHANG) != pid_) return true;
    done_ = true;
    code_ = WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
    return false;
  }
  void signal(int number) const { ::kill(pid_, number); }
  int wait(double seconds) {
    for (const double end = wall_s() + seconds; running() && wall_s() < end;) nap(0.02);
    return code_;
  }
  int code() const { return code_; }  ///< -1 while it runs
  static std::string text(const fs::path& file) {
    std::ostringstream all;
    all << std::ifstream(file).rdbuf();
    return all.str();
  }
  std::string out() const { return text(out_); }
  std::string err() const { return text(err_); }

 private:
  fs::path out_, err_;
  pid_t pid_ = -1;
  bool done_ = false;
  int code_ = -1;
};

/// Whether this process may have real-time priority.
inline bool realtime_allowed() {
  const sched_param some{1}, none{0};
  const bool allowed = ::sched_setscheduler(0, SCHED_FIFO, &some) == 0;
  if (allowed) ::sched_setscheduler(0, SCHED_OTHER, &none);
  return allowed;
}

/// The number of "key" after "block" in a JSON text; NaN without one.
inline double number(const std::string& json, const std::string& block, const std::string& key) {
  const auto at = json.find('"' + block + '"');
  const auto found = at == std::string::npos ? at : json.find('"' + key + "\":", at);
  return found == std::string::npos ? NAN : std::atof(json.c_str() + found + key.size() + 3);
}

/// The peer's truth, a row per 10 ms.
struct Row {
  double t, north, east, height, roll, pitch, yaw, airspeed, throttle, aileron, elevator, rudder, armed,
      offboard, override, commands;
  std::array<double, 4> u;  ///< the last command: throttle, aileron, elevator, rudder
};
inline std::vector<Row> rows(const fs::path& file) {
  std::vector<Row> all;
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream s(line);
    Row r{};
    s >> r.t >> r.north >> r.east >> r.height >> r.roll >> r.pitch >> r.yaw >> r.airspeed >> r.throttle >>
        r.aileron >> r.elevator >> r.rudder >> r.armed >> r.offboard >> r.override >> r.commands >> r.u[0] >>
        r.u[1] >> r.u[2] >> r.u[3];
    if (s && r.t >= 0) all.push_back(r);
  }
  return all;
}

/// A folder for one flight, and the hourglass with the end condition `done`. The log has every sample of the
/// flown ports.
struct Scratch {
  fs::path folder;
  explicit Scratch(const char* name)
      : folder(fs::temp_directory_path() / ("fulmar_hil_" + std::to_string(getpid()) + "_" + name)) {
    fs::create_directories(folder);
  }
  ~Scratch() { fs::remove_all(folder); }
  fs::path log() const { return folder / "flight.mcap"; }
  std::string mission(const std::string& done) const {
    const std::string configs = std::string(FULMAR_SOURCE_DIR) + "/configs/",
                      file = (folder / "hil.yaml").string();
    std::ofstream(file)
        << "mission: hil\nextends: " << configs << "missions/common.yaml\nairframe: " << configs
        << "airframes/anaconda.yaml\norigin: {lat: 40.2463724, lon: -111.6474138, alt_msl: 1387 m}\nseed: 7\n"
        << "record: {file: " << log().string() << ", ports: [nav.state, inner.actuators]}\n"
        << "done: \"" << done << "\"\ncomponents:\n"
        << "  sim:  {params: {sensors: rosflight, wind_ned: [3.5355, -3.5355, 0], turbulence: light, "
           "start_heading: 135 deg}}\n"
        << "  plan: {params: {plan: " << configs << "plans/hourglass.yaml}}\n";
    return file;
  }
};

struct Flown {
  int code = -1;
  std::string json, printed, peer;
  std::vector<Row> truth;
  double wall = 0;
  bool measured = true;    ///< false: the machine was too slow for the flight
  double stood_still = 0;  ///< wall time, s: largest delay of the peer or of a test thread on any CPU
  double tracking(const char* key) const { return number(json, "tracking_rmse", key); }
};

/// End of a flight, its speed over real time, and its time limit on the wall clock.
struct Plan {
  std::string done;     ///< of the mission
  double duration = 0;  ///< s from arming on; 0: until it is done
  double scale = 1, limit_s = 0;
};

/// The pilot disarms when the host reports `done`.
inline Flown fly_peer(const Scratch& s, const Plan& plan, const std::vector<std::string>& peer_words,
                      bool log) {
  fs::remove(s.log());
  const auto file = [&](const char* name) { return s.folder / name; };
  const std::string port = file("fcu").string(), factor = std::to_string(plan.scale);
  std::vector<std::string> words{
      FULMAR_BIN_DIR "/fcu_peer", "--link", port, "--scale", factor, "--mission-seed", "7", "--truth",
      file("truth.csv").string()};
  words.insert(words.end(), peer_words.begin(), peer_words.end());
  const bool realtime = realtime_allowed();  // then the load of the machine has no effect
  if (realtime) words.emplace_back("--realtime");
  Process peer(words, file("peer.out"), file("peer.err"));
  for (int k = 0; k < 250 && !fs::exists(port); ++k) nap(0.02);
  Flown f;
  const double begun = wall_s();
  std::vector<std::string> flight{
      FULMAR_BIN_DIR "/fulmar", "run",   s.mission(plan.done),      "--io", "fcu", "--json", "--set",
      "fcu.port=" + port,       "--set", "fcu.time_scale=" + factor};
  if (!log) flight.emplace_back("--no-log");
  if (plan.duration > 0)
    flight.insert(flight.end(), {"--duration", std::to_string(plan.duration + 2)});  // armed after 2 s
  if (realtime) flight.emplace_back("--realtime");
  const Standstill machine(realtime);
  Process host(flight, file("host.json"), file("host.err"));
  bool reported = false;
  while (host.running() && wall_s() - begun < plan.limit_s) {
    nap(0.1);
    if (reported || host.err().find("run.end_deferred(") == std::string::npos) continue;
    reported = true;
    peer.signal(SIGUSR1);
  }
  f.code = host.wait(1);
  f.wall = wall_s() - begun;
  peer.signal(SIGTERM);
  peer.wait(5);
  f.json = host.out();
  f.printed = host.err();
  f.peer = peer.out() + peer.err();
  f.truth = rows(file("truth.csv"));
  const double late = number(f.peer, "worst_late_ms", "worst_late_wall_ms");
  f.stood_still = std::max(machine.worst_s(), std::isnan(late) ? 0 : 1e-3 * late);
  return f;
}

/// A flight during which the machine did not stand still; a flight with a standstill is not judged and is
/// repeated.
inline Flown fly_undisturbed(const Scratch& s, const Plan& plan,
                             const std::vector<std::string>& peer_words = {}, bool log = false) {
  static std::atomic<int> left = 8;  // number of flights that may be repeated, in all tests together
  // The controller drops a command after 100 ms of its time.
  const double most_s = 0.075 / plan.scale;
  std::string held_up;
  for (int k = 1; k == 1 || (k <= 4 && left > 0); ++k) {
    Flown f = fly_peer(s, plan, peer_words, log);
    if (f.stood_still <= most_s) return f;
    --left;
    held_up += (k == 1 ? "" : ", ") + std::to_string(std::lround(1e3 * f.stood_still)) + " ms";
  }
  Flown none;
  none.measured = false;
  none.printed = "this machine stood still in each flight, at worst for " + held_up + " of " +
                 std::to_string(std::lround(1e3 * most_s)) +
                 " ms that are allowed: nothing can be said of the flight controller's link";
  return none;
}

/// The same mission in the simulator, with the delays between a command and the servos of that flight.
inline Flown fly_sim(const Scratch& s, const Plan& plan) {
  Flown f;
  std::vector<std::string> words{FULMAR_BIN_DIR "/fulmar",
                                 "run",
                                 s.mission(plan.done),
                                 "--set",
                                 "sim.mux_rate=111",
                                 "--set",
                                 "sim.pwm_resolution=1e-6",
                                 "--set",
                                 "sim.link_latency=1e-3",
                                 "--no-log",
                                 "--json"};
  if (plan.duration > 0) words.insert(words.end(), {"--duration", std::to_string(plan.duration)});
  Process host(words, s.folder / "sim.json", s.folder / "sim.err");
  f.code = host.wait(120);
  f.json = host.out();
  f.printed = host.err();
  return f;
}

}  // namespace fulmar::fcu::testing

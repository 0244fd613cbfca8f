// SPDX-License-Identifier: BSD-3-Clause
// Cost of recording and observing for the loop, and size of the log.
//
// bench_tap [--json] [--seconds N] [--rounds N] [--each]
//   flies in real time, alternately: without output; with every port at its full rate into a log, to two
//   clients that subscribe to everything, and four ports to a DDS reader. Processor time of the loop's thread
//   alone, per tick, including the pause until the next one. --each: also log, clients and DDS separately.
//   Exits 1 when a message was dropped.
// bench_tap --sizes [--json]
//   flies as fast as possible: megabytes of log per minute of flight, with every port at full rate and by
//   default
#include <sched.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/run/flight.hpp"
#include "links/dds/participant.hpp"
#include "tools/fulmar_live/session.hpp"

using namespace fulmar::core;
using nlohmann::json;
namespace fs = std::filesystem;

namespace {

constexpr const char* mission = "configs/missions/hourglass.yaml";
const std::vector<std::pair<std::string, std::string>> exported = {  // port, type
    {"nav.state", "VehicleState"},
    {"vehicle.imu", "Imu"},
    {"inner.actuators", "Actuators"},
    {"guide.command", "GuidanceCommand"}};

std::string topic_of(std::string port) {
  std::replace(port.begin(), port.end(), '.', '/');
  return "/" + port;
}

// ---- the clients: this program in further processes

int print(const json& result) {
  std::printf("%s\n", result.dump().c_str());
  return 0;
}

int be_client(const std::string& port) {
  std::uint64_t all = 0, states = 0;
  try {
    Session session(parse_target("127.0.0.1:" + port));
    for (const auto& [topic, channel] : session.channels()) session.subscribe(topic);
    for (;;) {
      const auto sample = session.next(std::chrono::seconds(1));
      if (!sample) continue;
      ++all;
      if (sample->topic == "/nav/state") ++states;
    }
  } catch (const FlightEnded&) {
  }
  return print({{"all", all}, {"nav.state", states}});
}

/// Reads until no data has arrived for two seconds.
int be_reader(const std::string& domain) {
  using std::chrono::steady_clock;
  constexpr auto pause = std::chrono::seconds(2), patience = std::chrono::seconds(30);
  DdsOptions options;
  options.domain = std::stoi(domain);
  dds::Participant participant(options, [](const std::string&, const std::string&, bool, bool) {});
  dds::Waker waker;
  std::vector<std::unique_ptr<dds::Reader>> readers;
  for (const auto& [port, type] : exported)
    readers.push_back(participant.reader({.topic = dds::dds_topic("rt", "", topic_of(port)),
                                          .type = dds::dds_type("fulmar_msgs/msg/" + type),
                                          .max_bytes = 1024,
                                          .depth = 400,
                                          .type_hash = {}},
                                         waker));
  std::uint64_t all = 0, states = 0;
  for (auto heard = steady_clock::now();
       steady_clock::now() - heard < (all > 0 ? std::chrono::seconds(pause) : patience);) {
    waker.wait(std::chrono::milliseconds(50));
    for (std::size_t i = 0; i < readers.size(); ++i)
      while (const std::size_t n = readers[i]->take(64, [](const dds::Reader::Sample&) {})) {
        all += n;
        states += i == 0 ? n : 0;
        heard = steady_clock::now();
      }
  }
  return print({{"all", all}, {"nav.state", states}});
}

/// A further process of this program.
class Process {
 public:
  explicit Process(const std::string& words)
      : pipe_(popen(("/proc/" + std::to_string(getpid()) + "/exe " + words).c_str(), "r")) {}
  Process(Process&& other) noexcept : pipe_(std::exchange(other.pipe_, nullptr)) {}
  Process& operator=(Process&&) = delete;
  ~Process() {
    if (pipe_) pclose(pipe_);
  }
  /// Its output after its end; null when that is no JSON.
  json result() {
    std::string text;
    for (int c = 0; pipe_ && (c = std::fgetc(pipe_)) != EOF;) text += static_cast<char>(c);
    const json parsed = json::parse(text, nullptr, false);
    return parsed.is_discarded() ? json(nullptr) : parsed;
  }

 private:
  FILE* pipe_;
};

// ---- flights

/// Clients: of "log", "live", "dds".
using Sinks = std::vector<std::string>;
bool has(const Sinks& sinks, const char* name) {
  return std::find(sinks.begin(), sinks.end(), name) != sinks.end();
}

struct Scratch {
  fs::path folder = fs::temp_directory_path() / ("fulmar-bench-tap-" + std::to_string(getpid()));
  Scratch() { fs::create_directories(folder); }
  ~Scratch() {
    std::error_code ignored;
    fs::remove_all(folder, ignored);
  }
};

Graph graph_of(const Sinks& sinks) {
  Graph graph = load_mission(mission);
  graph.record_rules = {{{"*"}, 0}};
  graph.live.on = has(sinks, "live");
  graph.live.host = "127.0.0.1";
  graph.live.port = 0;
  graph.dds.on = has(sinks, "dds");
  graph.dds.domain = 1 + static_cast<int>(getpid() % 200);
  for (const auto& [port, type] : exported)
    graph.dds.exports.push_back({.port = port, .topic = topic_of(port), .where = {}});
  return graph;
}

std::int64_t thread_cpu_ns() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return std::int64_t{t.tv_sec} * 1'000'000'000 + t.tv_nsec;
}

double quantile(std::vector<double>& v, double q) {
  if (v.empty()) return 0;
  const auto at = v.begin() + static_cast<std::ptrdiff_t>(q * static_cast<double>(v.size() - 1));
  std::nth_element(v.begin(), at, v.end());
  return *at;
}

/// Both loops run on the same processor, so that neither has an advantage; threads started before stay free.
void stay_on_last_cpu() {
  cpu_set_t allowed, last;
  if (sched_getaffinity(0, sizeof allowed, &allowed) != 0) return;
  int cpu = CPU_SETSIZE - 1;
  while (cpu > 0 && !CPU_ISSET(cpu, &allowed)) --cpu;
  CPU_ZERO(&last);
  CPU_SET(cpu, &last);
  sched_setaffinity(0, sizeof last, &last);
}

int fly(double seconds, const Sinks& sinks) {
  const Scratch scratch;
  const Graph graph = graph_of(sinks);
  FlightOptions o;
  o.speed = 1;
  o.duration_s = seconds;
  o.log = has(sinks, "log");
  o.log_file = scratch.folder / "flight.mcap";
  auto flight = std::make_unique<Flight>(graph, o);
  std::vector<Process> others;
  if (graph.live.on)
    for (int n = 0; n < 2; ++n) others.emplace_back("--client " + std::to_string(flight->live_port()));
  if (graph.dds.on) others.emplace_back("--reader " + std::to_string(graph.dds.domain));
  std::vector<double> ticks_us;
  ticks_us.reserve(static_cast<std::size_t>(410 * (seconds + 6)));
  stay_on_last_cpu();
  flight->step();
  for (std::int64_t begin = thread_cpu_ns(), end = 0; flight->step(); begin = end) {
    end = thread_cpu_ns();
    ticks_us.push_back(1e-3 * static_cast<double>(end - begin));
  }
  const FlightResult r = flight->finish();
  flight.reset();  // sends its last messages
  json reported = {{"p50_us", quantile(ticks_us, 0.5)},
                   {"p99_us", quantile(ticks_us, 0.99)},
                   {"ticks", r.ticks},
                   {"wall_s", r.wall.took_s}};
  std::uint64_t lost = r.log.dropped;
  if (o.log) reported["log_dropped"] = r.log.dropped;
  if (r.live) {
    reported["live_sent"] = r.live->sent;
    reported["live_dropped"] = r.live->dropped + r.live->lost;
    lost += r.live->dropped + r.live->lost;
  }
  if (r.dds) {
    reported["dds_sent"] = r.dds->sent;
    reported["dds_dropped"] = r.dds->lost;
    lost += r.dds->lost;
  }
  reported["dropped"] = lost;
  for (Process& other : others) reported["received"].push_back(other.result());
  return print(reported);
}

struct Kind {
  std::string name, sinks;
};

/// Two flights at the same time, so that disturbances affect both: one without clients, one with them.
json fly_both(const Kind& kind, double seconds) {
  const std::string words = "--fly " + std::to_string(seconds) + " ";
  Process bare(words), heard(words + kind.sinks);
  const json one = bare.result(), two = heard.result();
  if (one.is_null() || two.is_null()) throw Error("a flight has failed");
  return {{"nothing", one},
          {kind.name, two},
          {"ratio_p50", two["p50_us"].get<double>() / one["p50_us"].get<double>()}};
}

int bench_loop(double seconds, int rounds, bool each, bool as_json) {
  std::vector<Kind> kinds = {{"log, two clients, DDS", "log live dds"}};
  if (each) kinds.insert(kinds.begin(), {{"log", "log"}, {"two clients", "live"}, {"DDS", "dds"}});
  json all = json::object();
  bool dropped = false;
  for (const Kind& kind : kinds) {
    std::vector<double> ratios;
    json pairs = json::array();
    for (int round = 0; round < rounds; ++round) {
      const json pair = pairs.emplace_back(fly_both(kind, seconds));
      ratios.push_back(pair["ratio_p50"]);
      dropped = dropped || pair[kind.name]["dropped"] != 0;
      if (as_json) continue;
      for (const std::string& name : {std::string("nothing"), kind.name})
        std::printf("%-22s %7.2f p50 %8.2f p99 us per tick%s\n", name.c_str(),
                    pair[name]["p50_us"].get<double>(), pair[name]["p99_us"].get<double>(),
                    name == "nothing"
                        ? ""
                        : (", " + std::to_string(pair[name]["dropped"].get<int>()) + " dropped").c_str());
    }
    const double ratio = quantile(ratios, 0.5);
    if (!as_json)
      std::printf("%-22s %7.3f times as much, median of %d flights\n", kind.name.c_str(), ratio, rounds);
    all[kind.name] = {{"ratio_p50", ratio}, {"flights", pairs}};
  }
  if (as_json) std::printf("%s\n", all.dump(2).c_str());
  return dropped ? 1 : 0;
}

// ---- sizes

double megabytes_per_minute(bool full) {
  const Scratch scratch;
  Graph graph = load_mission(mission);
  if (full) graph.record_rules = {{{"*"}, 0}};
  FlightOptions o;
  o.log_file = scratch.folder / "flight.mcap";
  Flight flight(graph, o);
  const FlightResult r = flight.run();
  if (r.outcome != Outcome::flown || !r.log.error.empty())
    throw Error("not flown: " + r.reason + " " + r.log.error);
  return 1e-6 * static_cast<double>(r.log.bytes) / (1e-9 / 60 * static_cast<double>(r.last_ns - r.first_ns));
}

int bench_sizes(bool as_json) {
  const double full = megabytes_per_minute(true), usual = megabytes_per_minute(false);
  if (as_json)
    std::printf("%s\n", json{{"full_mb_per_min", full}, {"default_mb_per_min", usual}}.dump(2).c_str());
  else
    std::printf(
        "every port at its full rate  %6.2f MB per minute of flight\ndefault                      %6.2f MB "
        "per minute of flight\n",
        full, usual);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  bool as_json = false, sizes = false, each = false;
  double seconds = 10;
  int rounds = 5;
  try {
    if (argc == 3 && std::strcmp(argv[1], "--client") == 0) return be_client(argv[2]);
    if (argc == 3 && std::strcmp(argv[1], "--reader") == 0) return be_reader(argv[2]);
    if (argc >= 3 && std::strcmp(argv[1], "--fly") == 0)
      return fly(std::atof(argv[2]), Sinks(argv + 3, argv + argc));
    for (int i = 1; i < argc; ++i) {
      const std::string word = argv[i];
      if (word == "--json")
        as_json = true;
      else if (word == "--sizes")
        sizes = true;
      else if (word == "--each")
        each = true;
      else if (word == "--seconds" && i + 1 < argc)
        seconds = std::atof(argv[++i]);
      else if (word == "--rounds" && i + 1 < argc)
        rounds = std::atoi(argv[++i]);
      else {
        std::fprintf(stderr,
                     "usage: bench_tap [--json] [--seconds N] [--rounds N] [--each] | bench_tap "
                     "--sizes [--json]\n");
        return 2;
      }
    }
    return sizes ? bench_sizes(as_json) : bench_loop(seconds, rounds, each, as_json);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
}

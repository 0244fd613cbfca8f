// SPDX-License-Identifier: BSD-3-Clause
// A flight in real time with all outputs at full rate: log, live clients, DDS. Then each of them is
// disturbed: it alone loses data.
#include <arpa/inet.h>
#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "core/app/test/standstill.hpp"
#include "core/loader/table.hpp"
#include "core/log/test/read_mcap.hpp"
#include "core/types/test/hex.hpp"
#include "core/types/wire.hpp"
#include "fulmar/msg/plan_edit.hpp"
#include "fulmar/schema.hpp"
#include "links/dds/test/domain.hpp"
#include "tools/fulmar_live/session.hpp"

namespace fs = std::filesystem;
using namespace fulmar::core;
using nlohmann::json;
using std::chrono::milliseconds;
using std::chrono::seconds;
using std::chrono::steady_clock;

namespace {

constexpr std::int64_t tick_ns = 2'500'000;
constexpr double settled_s = 5, flown_s = 8;  // on the ground before flight time 0, and after it
constexpr double stall_s = 2.5;  // a busy machine may delay a thread; each disturbance lasts longer than this

std::uint16_t free_port() {
  const int fd = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in at{};
  at.sin_family = AF_INET;
  at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof at;
  REQUIRE(bind(fd, reinterpret_cast<sockaddr*>(&at), size) == 0);
  REQUIRE(getsockname(fd, reinterpret_cast<sockaddr*>(&at), &size) == 0);
  close(fd);
  return ntohs(at.sin_port);
}

/// `fulmar run` in a separate process.
class Running {
 public:
  explicit Running(const std::string& preload = "")
      : folder_(fs::temp_directory_path() / ("fulmar-sinks-test-" + std::to_string(getpid()))) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    std::ofstream(folder_ / "mission.yaml")
        << "mission: trial\nextends: " FULMAR_SOURCE_DIR
           "/configs/missions/common.yaml\nairframe: " FULMAR_SOURCE_DIR
           "/configs/airframes/anaconda.yaml\norigin: {lat: 40.2463724, lon: -111.6474138, alt_msl: 1387 m}\n"
           "record: {ports: [\"*\"]}\ndds: {domain: "
        << test::own_domain()
        << ", export: [nav.state, vehicle.imu, inner.actuators], import: {plan.edits: /plan_edits}}\n"
        << "components:\n  sim: {params: {sensors: rosflight, turbulence: light, truth_rate: 400 Hz}}\n"
           "  plan: {params: {plan: " FULMAR_SOURCE_DIR "/configs/plans/hourglass.yaml}}\n";
    pid_ = fork();
    if (pid_ == 0) be_flight(preload);
  }
  ~Running() {
    if (pid_ > 0) {
      kill(pid_, SIGKILL);
      waitpid(pid_, nullptr, 0);
    }
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;

  LiveAddress target() const { return parse_target("127.0.0.1:" + std::to_string(port_)); }
  fs::path marker() const { return folder_ / "hang"; }
  fs::path log() const { return folder_ / "log.mcap"; }

  /// The result, after its end.
  json result() {
    int status = 0;
    waitpid(std::exchange(pid_, 0), &status, 0);
    std::ifstream reported(folder_ / "told"), in(folder_ / "result.json");
    const std::string words{std::istreambuf_iterator<char>(reported), {}};
    CHECK_MESSAGE((WIFEXITED(status) && WEXITSTATUS(status) == 0), words);
    json j = json::parse(in, nullptr, false);
    REQUIRE(j.is_object());
    return j;
  }

 private:
  [[noreturn]] void be_flight(const std::string& preload) const {
    const int out = open((folder_ / "result.json").c_str(), O_WRONLY | O_CREAT, 0600),
              reported = open((folder_ / "told").c_str(), O_WRONLY | O_CREAT, 0600);
    dup2(out, 1);
    dup2(reported, 2);
    if (!preload.empty()) {
      setenv("LD_PRELOAD", preload.c_str(), 1);
      setenv("FULMAR_HANG", marker().c_str(), 1);
    }
    const std::string mission = (folder_ / "mission.yaml").string(), file = log().string(),
                      live = "127.0.0.1:" + std::to_string(port_), duration = std::to_string(flown_s);
    execl(FULMAR_BIN_DIR "/fulmar", "fulmar", "run", mission.c_str(), "--speed", "real", "--duration",
          duration.c_str(), "--live", live.c_str(), "--log", file.c_str(), "--json", nullptr);
    _exit(127);
  }

  fs::path folder_;
  std::uint16_t port_ = free_port();
  pid_t pid_ = -1;
};

/// The flight listens some time after its process has begun.
template <class Make>
auto patiently(const Make& make) {
  for (const auto end = steady_clock::now() + seconds(20);;) {
    try {
      return make();
    } catch (const Error&) {
      if (steady_clock::now() > end) throw;
    }
    std::this_thread::sleep_for(milliseconds(20));
  }
}

/// Subscribes to all channels, reads until the flight has ended, and stores the arrival times of the inertial
/// samples.
class LiveClient {
 public:
  explicit LiveClient(const LiveAddress& target)
      : session_(patiently([&] { return std::make_unique<Session>(target); })) {
    for (const auto& [topic, channel] : session_->channels()) session_->subscribe(topic);
    thread_ = std::thread([this] { read(); });
  }
  ~LiveClient() { thread_.join(); }
  LiveClient(const LiveClient&) = delete;
  LiveClient& operator=(const LiveClient&) = delete;

  /// Waits for the end of the flight.
  const std::vector<std::int64_t>& times_ns() {
    while (!over_) std::this_thread::sleep_for(milliseconds(10));
    return times_ns_;
  }
  /// Largest delay of a sample relative to the earliest one, by its own time.
  double worst_delay_s() const { return 1e-9 * static_cast<double>(worst_ns_ - best_ns_); }
  double standstill_s() const { return standstill_.worst_s(); }
  bool hears() const { return heard_ > 0; }

 private:
  void read() {
    try {
      for (;;) {
        const auto sample = session_->next(seconds(1));
        if (!sample || sample->topic != "/vehicle/imu") continue;
        times_ns_.push_back(sample->time_ns);
        const std::int64_t late_ns = steady_clock::now().time_since_epoch().count() - sample->time_ns;
        best_ns_ = std::min(best_ns_, late_ns);
        worst_ns_ = std::max(worst_ns_, late_ns);
        ++heard_;
      }
    } catch (const Error&) {
    }
    over_ = true;
  }

  fulmar::fcu::testing::Standstill standstill_{false};
  std::unique_ptr<Session> session_;
  std::vector<std::int64_t> times_ns_;
  std::int64_t best_ns_ = INT64_MAX, worst_ns_ = INT64_MIN;
  std::atomic<std::uint64_t> heard_{0};
  std::atomic<bool> over_{false};
  std::thread thread_;
};

void wait_until_heard(const LiveClient& client) {
  for (int i = 0; i < 2000 && !client.hears(); ++i) std::this_thread::sleep_for(milliseconds(10));
  REQUIRE(client.hears());
}

std::vector<std::int64_t> logged_times_ns(const WholeLog& log, const std::string& topic) {
  const std::uint16_t channel = log.channel(topic);
  std::vector<std::int64_t> times;
  for (const McapFile::Message& m : log.messages)
    if (m.channel == channel) times.push_back(static_cast<std::int64_t>(m.log_ns));
  return times;
}

/// The log has no gap, and neither has the client's data from its first sample on.
void check_whole(const json& result, const fs::path& file, LiveClient& client) {
  CHECK(result.at("log_dropped") == 0);
  const WholeLog log = read_mcap(file);
  CHECK(log.complete);
  const std::vector<std::int64_t> all = logged_times_ns(log, "/vehicle/imu"), &seen = client.times_ns();
  CHECK(all.size() == static_cast<std::size_t>(400 * (settled_s + flown_s)));
  for (std::size_t i = 1; i < all.size(); ++i)
    if (all[i] != all[i - 1] + tick_ns) FAIL_CHECK("the log misses a tick after " << all[i - 1]);
  REQUIRE(!seen.empty());
  const auto first = std::lower_bound(all.begin(), all.end(), seen.front());
  CHECK(std::vector(first, all.end()) == seen);
  CHECK(seen.size() > 400 * 4);
  CHECK(client.worst_delay_s() < stall_s + client.standstill_s());
  MESSAGE("the loop or the way to the client stood still for "
          << 1e3 * client.worst_delay_s() << " ms at most, the machine for " << 1e3 * client.standstill_s()
          << " ms");
}

void check_others_whole(const json& result, bool live, bool dds) {
  if (live) {
    CHECK(result.at("live").at("dropped") == 0);
    CHECK(result.at("live").at("lost") == 0);
  }
  if (dds) CHECK(result.at("dds").at("lost") == 0);
}

/// A remote DDS program.
class Peer {
 public:
  Peer(const std::string& what, const std::string& words)
      : pipe_(popen((FULMAR_BIN_DIR "/dds_peer " + what + " " + std::to_string(test::own_domain()) + " " +
                     words + " 2>/dev/null")
                        .c_str(),
                    "r")) {
    REQUIRE(pipe_ != nullptr);
  }
  ~Peer() { lines(); }
  std::size_t lines() {
    if (!pipe_) return lines_;
    for (int c = 0; (c = std::fgetc(pipe_)) != EOF;) lines_ += c == '\n';
    pclose(std::exchange(pipe_, nullptr));
    return lines_;
  }

 private:
  FILE* pipe_;
  std::size_t lines_ = 0;
};

const std::string state_words = "rt/nav/state fulmar_msgs::msg::dds_::VehicleState_ ";

/// An edit that the planner rejects: the flight stays unchanged.
std::string edit_in_hex() {
  fulmar::PlanEdit edit;
  edit.kind = fulmar::PlanEditKind::remove;
  edit.index = 60000;
  std::vector<std::byte> bytes;
  CdrEncoder(*copy_type(*fulmar::detail::type_table<fulmar::PlanEdit>()))
      .encode(reinterpret_cast<const std::byte*>(&edit), bytes);
  return test::hex(bytes);
}

/// A raw client with a very small socket buffer: subscribes to all channels and never reads again.
class StuckClient {
 public:
  StuckClient(const LiveAddress& target, std::size_t channels) : fd_(socket(AF_INET, SOCK_STREAM, 0)) {
    const int room = 4096;
    setsockopt(fd_, SOL_SOCKET, SO_RCVBUF, &room, sizeof room);
    sockaddr_in at{};
    at.sin_family = AF_INET;
    at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    at.sin_port = htons(target.port);
    REQUIRE(connect(fd_, reinterpret_cast<sockaddr*>(&at), sizeof at) == 0);
    say("GET / HTTP/1.1\r\nHost: " + target.text() +
        "\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Key: "
        "dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n"
        "Sec-WebSocket-Protocol: foxglove.sdk.v1\r\n\r\n");
    char answer[12] = {};
    REQUIRE(recv(fd_, answer, sizeof answer, MSG_WAITALL) == sizeof answer);
    REQUIRE(std::string(answer, sizeof answer) == "HTTP/1.1 101");
    json list = json::array();
    for (std::size_t id = 1; id <= channels; ++id) list.push_back({{"id", id}, {"channelId", id}});
    say(frame(json{{"op", "subscribe"}, {"subscriptions", list}}.dump()));
  }
  ~StuckClient() { close(fd_); }
  StuckClient(const StuckClient&) = delete;
  StuckClient& operator=(const StuckClient&) = delete;

 private:
  /// RFC 6455, 5.2: final, text, masked with zeros, 16 bits of length.
  static std::string frame(const std::string& text) {
    REQUIRE(text.size() > 125);
    REQUIRE(text.size() < 65536);
    const char head[] = {
        '\x81', '\xfe', static_cast<char>(text.size() >> 8), static_cast<char>(text.size() & 0xff), 0, 0,
        0,      0};
    return std::string(head, sizeof head) + text;
  }
  void say(const std::string& bytes) {
    REQUIRE(send(fd_, bytes.data(), bytes.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(bytes.size()));
  }
  int fd_;
};

}  // namespace

TEST_CASE(
    "everything at full rate to a log, two clients and a DDS reader at 400 Hz: nothing is dropped anywhere") {
  Running flight;
  LiveClient one(flight.target()), two(flight.target());
  Peer reader("read", state_words + "1200");
  CHECK(reader.lines() == 1200);
  const json result = flight.result();
  check_whole(result, flight.log(), one);
  CHECK(two.times_ns().back() == one.times_ns().back());
  CHECK(static_cast<std::int64_t>(two.times_ns().size()) ==
        1 + (two.times_ns().back() - two.times_ns().front()) / tick_ns);
  check_others_whole(result, true, true);
  CHECK(result.at("dds").at("sent") >= 1200);
}

TEST_CASE(
    "a client that subscribes to everything and never reads loses samples; the other client and the log lose "
    "none") {
  Running flight;
  LiveClient reading(flight.target());
  const StuckClient stuck(flight.target(),
                          patiently([&] { return Session(flight.target()).channels().size(); }));
  const json result = flight.result();
  check_whole(result, flight.log(), reading);
  CHECK(result.at("live").at("dropped") > 0);
  CHECK(result.at("live").at("lost") == 0);
  check_others_whole(result, false, true);
}

TEST_CASE("a flood from DDS is cut and counted; it does not affect the log, the client or the loop") {
  Running flight;
  LiveClient reading(flight.target());
  wait_until_heard(reading);
  Peer flood("publish",
             "rt/plan_edits fulmar_msgs::msg::dds_::PlanEdit_ reliable 10000 " + edit_in_hex() + "*60000");
  const json result = flight.result();
  check_whole(result, flight.log(), reading);
  check_others_whole(result, true, false);
  const json& import = result.at("dds").at("imports").at("plan.edits");
  MESSAGE("taken " << import.at("received") << ", cut " << import.at("lost"));
  CHECK(import.at("received") > 1000);
  CHECK(import.at("lost") > 0);
  CHECK(import.at("refused") == 0);
  // the log has all samples that the loop has taken; the loop took all but those in transit at the end
  const std::size_t taken = logged_times_ns(read_mcap(flight.log()), "/plan/edits").size();
  CHECK(taken <= import.at("received").get<std::size_t>());
  CHECK(taken + 1024 >= import.at("received").get<std::size_t>());
}

TEST_CASE(
    "a disk that hangs for five seconds: the loop and the client go on, and the log is whole once it is "
    "over" *
    doctest::skip(!FULMAR_PRELOAD_TESTS)) {
  Running flight(FULMAR_HANGING_DISK);
  LiveClient reading(flight.target());
  wait_until_heard(reading);
  std::this_thread::sleep_for(seconds(2));
  const auto size = [&] { return fs::file_size(flight.log().string() + ".part"); };
  std::ofstream(flight.marker()) << "";
  std::this_thread::sleep_for(milliseconds(200));
  const auto before = size();
  std::this_thread::sleep_for(seconds(5));
  CHECK(size() == before);  // the disk did hang
  fs::remove(flight.marker());
  const json result = flight.result();
  check_whole(result, flight.log(), reading);  // the ring holds the data of five seconds
  check_others_whole(result, true, true);
}

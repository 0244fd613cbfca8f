// SPDX-License-Identifier: BSD-3-Clause
// Logs written and read back: content, order, equal bytes for equal runs, and what is left when the process
// or the disk fails.
#include <doctest/doctest.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstring>
#include <fstream>
#include <functional>
#include <random>
#include <sstream>
#include <thread>

#include "core/error.hpp"
#include "core/log/out_file.hpp"
#include "core/log/reader.hpp"
#include "core/tap/test/taped_log.hpp"
#include "core/types/sha256.hpp"
#include "core/types/test/types.hpp"
#include "core/types/wire.hpp"
#include "tools/fulmar_log/recover.hpp"

namespace log_test {

using namespace fulmar::core;
using namespace fulmar::core::test;
namespace fs = std::filesystem;

namespace {

constexpr std::int64_t epoch_ns = 1'767'225'600'000'000'000;  // 2026-01-01
constexpr std::int64_t period_ns = 2'500'000;

/// A folder of its own that goes with the test.
struct Folder {
  fs::path path;
  Folder() {
    std::string name = (fs::temp_directory_path() / "fulmar-log-XXXXXX").string();
    path = ::mkdtemp(name.data());
  }
  ~Folder() { fs::remove_all(path); }
};

std::string contents(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

struct Number {
  double value_ratio;
};
TypePtr number_type() { return make_type("Number", 8, 8, {number("value_ratio", 0)}); }

std::vector<TapChannel> two_channels() {
  return {{"/mixed", mixed_type()},
          {"/number", number_type()},
          {"/silent", number_type()},
          {"/other", number_type()}};
}

Mixed mixed_at(int i) {
  Mixed m = mixed_value();
  m.stamp_ns = i;
  m.speed_mps = 0.1 * i;
  m.legs.count = static_cast<std::uint32_t>(i % 4);
  if (m.legs.count == 3) m.legs.items[2] = m.legs.items[0];
  return m;
}

/// `ticks` ticks from -1 s on; one Mixed and, in every fourth, one Number.
void fly(TapedLog& log, int ticks, double value = 0.5) {
  for (int i = 0; i < ticks; ++i) {
    const std::int64_t now = i * period_ns - 1'000'000'000;
    const Mixed m = mixed_at(i);
    log.write(0, now, now - 1000, bytes_of(m));
    const Number n{value * i};
    if (i % 4 == 0) log.write(1, now, now, bytes_of(n));
  }
}

LogResult write_log(const fs::path& file, int ticks, double value = 0.5, std::size_t ring_bytes = 4u << 20) {
  TapedLog log({.file = file, .epoch_ns = epoch_ns}, two_channels(), ring_bytes);
  log.attach("mission.yaml", "application/yaml", "mission: test\n");
  log.metadata("run", {{"seed", "7"}, {"io", "sim"}});
  fly(log, ticks, value);
  log.attach("result.json", "application/json", "{}");
  return log.close();
}

/// Runs `body` in a child process; returns what waitpid says.
int in_child(const std::function<int()>& body) {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(body());
  int status = 0;
  ::waitpid(child, &status, 0);
  return status;
}

/// Each message is the next one of its channel as `fly` wrote it.
bool is_flight(const McapFile& log) {
  const CdrEncoder encoder(*mixed_type());
  int mixed = 0, numbers = 0;
  for (const McapFile::Message& m : log.messages) {
    const std::string& topic = log.channels.at(m.channel).topic;
    const int i = topic == "/mixed" ? mixed : 4 * numbers;
    const auto now = static_cast<std::uint64_t>(epoch_ns + i * period_ns - 1'000'000'000);
    if (m.log_ns != now) return false;
    if (topic == "/number") {
      Number n{};
      cdr_decode(*number_type(), m.data.data(), m.data.size(), bytes_of(n));
      if (n.value_ratio != 0.5 * i || m.publish_ns != now ||
          m.sequence != static_cast<std::uint32_t>(numbers))
        return false;
      ++numbers;
    } else {
      const Mixed want = mixed_at(i);
      std::vector<std::byte> bytes;
      encoder.encode(bytes_of(want), bytes);
      if (!std::equal(bytes.begin(), bytes.end(), m.data.begin(), m.data.end()) || m.publish_ns != now - 1000)
        return false;
      ++mixed;
    }
  }
  const int due = (mixed + 3) / 4;  // a chunk may end between the two messages of a tick
  return numbers == due || (numbers == due - 1 && mixed % 4 == 1);
}

}  // namespace

TEST_CASE("a log holds every message, attachment and metadata that went in") {
  const Folder folder;
  const LogResult result = write_log(folder.path / "a.mcap", 4000);
  CHECK(result.error == "");
  CHECK(result.dropped == 0);
  CHECK(result.messages == 5000);
  CHECK(result.file == folder.path / "a.mcap");
  CHECK_FALSE(fs::exists(folder.path / "a.mcap.part"));
  CHECK(result.bytes == fs::file_size(result.file));
  CHECK(result.sha256 == Sha256::of(contents(result.file)));

  const McapFile log = read_mcap(result.file);
  CHECK(log.fault == "");
  CHECK(log.complete);
  CHECK(log.profile == "ros2");
  CHECK(log.library == "fulmar");
  CHECK(log.messages.size() == 5000);
  CHECK(is_flight(log));
  CHECK(log.chunks >= 10);            // ten seconds of flight, at least one chunk each
  REQUIRE(log.channels.size() == 2);  // those with messages
  CHECK(log.schemas.size() == 2);
  const McapFile::Channel& channel = log.channels.at(log.channel("/mixed"));
  CHECK(channel.encoding == "cdr");
  CHECK(channel.metadata[0].first == "offered_qos_profiles");
  CHECK(channel.metadata[1] ==
        std::pair<std::string, std::string>("topic_type_hash", ros_type_hash(*mixed_type())));
  const McapFile::Schema& schema = log.schemas.at(channel.schema);
  CHECK(schema.name == "fulmar_msgs/msg/Mixed");
  CHECK(schema.encoding == "ros2msg");
  CHECK(schema.text == ros_definition(*mixed_type()));
  REQUIRE(log.attachments.size() == 2);
  CHECK(log.attachment("mission.yaml")->content == "mission: test\n");
  CHECK(log.attachment("mission.yaml")->log_ns == static_cast<std::uint64_t>(epoch_ns));
  CHECK(log.attachment("result.json")->media_type == "application/json");
  CHECK(log.metadata.at(0).pairs ==
        std::vector<std::pair<std::string, std::string>>{{"seed", "7"}, {"io", "sim"}});
  CHECK_THROWS_WITH_AS(log.channel("/mixd"), doctest::Contains("/mixed"), Error);
}

TEST_CASE("a log without messages is whole") {
  const Folder folder;
  const LogResult result = write_log(folder.path / "a.mcap", 0);
  const McapFile log = read_mcap(result.file);
  CHECK(log.complete);
  CHECK(log.messages.empty());
  CHECK(log.attachments.size() == 2);
}

TEST_CASE(
    "equal runs give equal bytes, whatever the file is called and however the ring fills; another run gives "
    "others") {
  const Folder folder;
  const LogResult a = write_log(folder.path / "a.mcap", 3000);
  const LogResult b = write_log(folder.path / "other_name.mcap", 3000, 0.5, 1u << 14);
  const LogResult c = write_log(folder.path / "c.mcap", 3000, 0.25);
  CHECK(a.sha256 == b.sha256);
  CHECK(contents(a.file) == contents(b.file));
  CHECK(a.sha256 != c.sha256);
}

TEST_CASE("a log never overwrites a file, finished or not, nor one that appears while it is written") {
  const Folder folder;
  const fs::path file = folder.path / "a.mcap";
  std::ofstream(file) << "precious";
  CHECK_THROWS_AS(write_log(file, 1), Error);
  CHECK_FALSE(fs::exists(folder.path / "a.mcap.part"));
  fs::rename(file, folder.path / "a.mcap.part");
  CHECK_THROWS_WITH_AS(write_log(file, 1), doctest::Contains("interrupted"), Error);
  CHECK(contents(folder.path / "a.mcap.part") == "precious");
  CHECK_THROWS_AS(write_log(folder.path / "no_such_folder" / "a.mcap", 1), Error);

  TapedLog log({.file = folder.path / "late.mcap", .epoch_ns = epoch_ns}, two_channels());
  std::ofstream(folder.path / "late.mcap") << "precious";
  const LogResult result = log.close();
  CHECK(contents(folder.path / "late.mcap") == "precious");
  CHECK(result.file == folder.path / "late.mcap.part");
  CHECK(result.error != "");
  CHECK(read_mcap(result.file).complete);
}

TEST_CASE(
    "a flight faster than its log loses messages only if it may not wait, and every loss is counted and "
    "shows in the sequence") {
  const Folder folder;
  struct Wide {
    std::array<double, 500> x;
  };
  const TypePtr type = make_type("Wide", sizeof(Wide), 8, {array(number("x", 0), 500)});
  std::mt19937_64 random(1);
  Wide wide;
  for (double& x : wide.x) x = static_cast<double>(random());  // hard to compress
  for (const bool wait : {false, true}) {
    TapedLog log(
        {.file = folder.path / (wait ? "wait.mcap" : "drop.mcap"), .epoch_ns = epoch_ns, .wait = wait},
        {{"/wide", type}}, 1u << 16);
    constexpr std::uint64_t n = 5000;
    for (std::uint64_t i = 0; i < n; ++i) log.write(0, static_cast<std::int64_t>(i), 0, bytes_of(wide));
    const LogResult result = log.close();
    CHECK(result.messages + result.dropped == n);
    const McapFile file = read_mcap(result.file);
    CHECK(file.messages.size() == result.messages);
    bool rising = true;
    for (std::size_t i = 0; i < file.messages.size(); ++i) {
      rising = rising &&
               file.messages[i].sequence == file.messages[i].log_ns - static_cast<std::uint64_t>(epoch_ns);
    }
    CHECK(rising);
    if (wait) {
      CHECK(result.dropped == 0);
    } else {
      CHECK(result.dropped > 0);
    }
  }
}

TEST_CASE("a run killed in flight leaves a file whose whole chunks, mission included, can be read") {
  const Folder folder;
  const fs::path file = folder.path / "a.mcap";
  int pipe_ends[2];
  REQUIRE(::pipe(pipe_ends) == 0);
  const pid_t child = ::fork();
  if (child == 0) {
    TapedLog log({.file = file, .epoch_ns = epoch_ns}, two_channels());
    log.attach("mission.yaml", "application/yaml", "mission: test\n");
    fly(log, 4000);
    // 10 s of flight: all but the last chunk, which is open, will get there
    while (read_mcap(file.string() + ".part").messages.size() < 4400)
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    const char ready = 'r';
    if (::write(pipe_ends[1], &ready, 1) != 1) ::_exit(3);
    for (;;) ::pause();
  }
  char ready = 0;
  REQUIRE(::read(pipe_ends[0], &ready, 1) == 1);
  ::kill(child, SIGKILL);
  int status = 0;
  ::waitpid(child, &status, 0);
  ::close(pipe_ends[0]), ::close(pipe_ends[1]);
  REQUIRE(WIFSIGNALED(status));
  CHECK_FALSE(fs::exists(file));
  const McapFile log = read_mcap(file.string() + ".part");
  CHECK_FALSE(log.complete);
  CHECK(log.fault != "");
  CHECK(log.messages.size() >= 4400);  // all but the last second
  CHECK(log.messages.size() < 5000);
  CHECK(is_flight(log));
  CHECK(log.attachment("mission.yaml") != nullptr);

  const McapWriter::Result recovered = recover_mcap(file.string() + ".part", folder.path / "recovered.mcap");
  CHECK(recovered.error == "");
  const McapFile whole = read_mcap(recovered.file);
  CHECK(whole.complete);
  CHECK(whole.messages.size() == log.messages.size());
  CHECK(is_flight(whole));
  CHECK(whole.attachment("mission.yaml")->content == "mission: test\n");
  CHECK(whole.channels.at(whole.channel("/mixed")).metadata ==
        log.channels.at(log.channel("/mixed")).metadata);
}

TEST_CASE(
    "a file cut off at any byte gives the chunks before the cut; a flipped byte never gives a wrong "
    "message") {
  const Folder folder;
  const LogResult result = write_log(folder.path / "a.mcap", 1200);
  const std::string whole = contents(result.file);
  const fs::path cut = folder.path / "cut.mcap";
  std::size_t last = 0;
  std::mt19937 random(5);
  for (std::size_t n = 20; n < whole.size(); n += 1 + random() % (whole.size() / 60)) {
    std::ofstream(cut, std::ios::binary) << whole.substr(0, n);
    const McapFile log = read_mcap(cut);
    CHECK_FALSE(log.complete);
    CHECK(log.messages.size() >= last);
    last = log.messages.size();
    REQUIRE(is_flight(log));
  }
  CHECK(last == 1500);
  for (int i = 0; i < 60; ++i) {
    std::string flipped = whole;
    flipped[100 + random() % (whole.size() - 100)] ^= static_cast<char>(1 + random() % 255);
    std::ofstream(cut, std::ios::binary) << flipped;
    const McapFile log = read_mcap(cut);
    CHECK_FALSE(log.complete);
    REQUIRE(is_flight(log));
  }
}

TEST_CASE(
    "on a full disk the flight goes on, every message not stored is counted, and the file stays one that was "
    "cut off") {
  const Folder folder;
  const fs::path file = folder.path / "a.mcap";
  const int status = in_child([&] {
    const rlimit limit{20'000, 20'000};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    const LogResult result = write_log(file, 40'000);  // 100 s
    if (result.messages + result.dropped != 50'000 || result.dropped == 0) return 1;
    if (result.error.find("File too large") == std::string::npos) return 2;
    if (result.bytes != fs::file_size(result.file) || result.bytes > 20'000) return 3;
    if (result.sha256 != Sha256::of(contents(result.file))) return 4;
    const McapFile log = read_mcap(result.file);
    if (log.messages.size() != result.messages || !is_flight(log)) return 5;
    if (log.complete || result.file != file.string() + ".part" || fs::exists(file)) return 6;
    return 0;
  });
  REQUIRE(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 0);
}

TEST_CASE("a log that fails is told of while the flight lasts") {
  const Folder folder;
  const int status = in_child([&] {
    const rlimit limit{20'000, 20'000};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    TapedLog log({.file = folder.path / "a.mcap", .epoch_ns = epoch_ns}, two_channels());
    if (log.log.failed()) return 1;
    fly(log, 40'000);
    for (int i = 0; !log.log.failed(); ++i) {
      if (i == 10'000) return 2;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return log.log.error() == "cannot write '" + (folder.path / "a.mcap.part").string() + "': File too large"
               ? 0
               : 3;
  });
  REQUIRE(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 0);
}

TEST_CASE(
    "a file of a log that rotates begins with the last sample of each topic, and of each name that a message "
    "is given") {
  const Folder folder;
  const auto positive = [](std::size_t channel, const std::byte* data) {
    double value = 0;
    std::memcpy(&value, data, sizeof value);
    return channel == 1 && value > 0 ? "positive" : "";
  };
  TapedLog log(
      {.file = folder.path / "a.mcap", .epoch_ns = epoch_ns, .rotate_ns = 1'000'000'000, .lasting = positive},
      two_channels());
  const auto write = [&](std::size_t channel, std::int64_t ms, double value) {
    const Number n{value};
    log.write(channel, ms * 1'000'000, ms * 1'000'000 - 500, bytes_of(n));
  };
  write(1, 0, 3), write(1, 100, 4), write(1, 200, -1), write(3, 300, 8), write(1, 900, -2), write(3, 990, 9),
      write(1, 1000, -3);
  const LogResult result = log.close();
  REQUIRE(result.files == 2);
  CHECK(result.messages == 7);
  CHECK(result.dropped == 0);
  const McapFile second = read_mcap(folder.path / "a-2.mcap");
  struct Wanted {
    const char* topic;
    std::uint32_t sequence;
    std::int64_t ms;
    double value;
  };
  const Wanted list[] = {
      {"/number", 1, 100, 4}, {"/number", 3, 900, -2}, {"/other", 1, 990, 9}, {"/number", 4, 1000, -3}};
  REQUIRE(second.messages.size() == 4);
  for (std::size_t i = 0; i < 4; ++i) {
    const McapFile::Message& m = second.messages[i];
    Number n{};
    cdr_decode(*number_type(), m.data.data(), m.data.size(), bytes_of(n));
    CHECK(second.channels.at(m.channel).topic == list[i].topic);
    CHECK(m.sequence == list[i].sequence);
    CHECK(m.log_ns == static_cast<std::uint64_t>(epoch_ns + list[i].ms * 1'000'000));
    CHECK(m.publish_ns == m.log_ns - 500);
    CHECK(n.value_ratio == list[i].value);
  }
}

TEST_CASE("a file that is being written is known as such until its writer ends") {
  const Folder folder;
  const fs::path part = folder.path / "a.mcap.part";
  {
    TapedLog log({.file = folder.path / "a.mcap", .epoch_ns = epoch_ns}, two_channels());
    fly(log, 1000);
    CHECK(OutFile::grows(part));
    CHECK_THROWS_WITH_AS(write_log(folder.path / "a.mcap", 1), doctest::Contains("another run is writing it"),
                         Error);
    log.close();
    CHECK_FALSE(OutFile::grows(folder.path / "a.mcap"));
  }
  const int status = in_child([&] {
    TapedLog log({.file = folder.path / "b.mcap", .epoch_ns = epoch_ns}, two_channels());
    return ::kill(::getpid(), SIGKILL);
  });
  CHECK(WIFSIGNALED(status));
  CHECK(fs::exists(folder.path / "b.mcap.part"));
  CHECK_FALSE(OutFile::grows(folder.path / "b.mcap.part"));
}

TEST_CASE("a log whose file is removed in flight says so and counts its messages as lost") {
  const Folder folder;
  TapedLog log({.file = folder.path / "a.mcap", .epoch_ns = epoch_ns}, two_channels());
  fly(log, 1000);
  fs::remove(folder.path / "a.mcap.part");
  fly(log, 1000);
  const LogResult result = log.close();
  CHECK(result.error.find("somebody has removed '" + (folder.path / "a.mcap.part").string()) == 0);
  CHECK(result.messages == 0);
  CHECK(result.dropped == 2500);
  CHECK(result.file.empty());
}

TEST_CASE(
    "a log whose file or folder is moved says so within 2 s of flight, and what was written is not lost") {
  for (const bool whole_folder : {false, true}) {
    const Folder folder;
    const fs::path from = folder.path / "logs", to = folder.path / "kept";
    for (const fs::path& path : {from, to}) fs::create_directory(path);
    const fs::path part = from / "a.mcap.part", moved = to / "a.mcap.part";
    TapedLog log({.file = from / "a.mcap", .epoch_ns = epoch_ns}, two_channels());
    const auto head = fs::file_size(part);
    fly(log, 2000);
    for (int i = 0; i < 10'000 && fs::file_size(part) == head; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    whole_folder ? fs::rename(from, to) : fs::rename(part, moved);
    if (!whole_folder) std::ofstream(part) << "what is not ours";
    fly(log, 800);
    for (int i = 0; i < 10'000 && !log.log.failed(); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    CHECK(log.log.failed());
    const LogResult result = log.close();
    CHECK(result.error == "somebody has moved '" + part.string() + "' to '" + moved.string() + "'");
    CHECK(result.file == moved);
    CHECK(result.messages > 0);
    CHECK(result.messages + result.dropped == 3500);
    CHECK(read_mcap(moved).messages.size() == result.messages);
  }
}

TEST_CASE("a log whose folder is removed, or in whose place another file lies, is not pointed to") {
  for (const bool another : {false, true}) {
    const Folder folder;
    const fs::path logs = folder.path / "logs";
    fs::create_directory(logs);
    TapedLog log({.file = logs / "a.mcap", .epoch_ns = epoch_ns}, two_channels());
    fly(log, 1000);
    fs::remove_all(logs);
    if (another) {
      fs::create_directory(logs);
      std::ofstream(logs / "a.mcap.part") << "what is not ours";
    }
    fly(log, 1000);
    const LogResult result = log.close();
    CHECK_MESSAGE(result.error.find("somebody has removed '") == 0, result.error);
    CHECK(result.messages == 0);
    CHECK(result.file.empty());
  }
}

TEST_CASE("a log that somebody has cut or lengthened in flight is not called whole") {
  for (const bool longer : {false, true}) {
    const Folder folder;
    const fs::path part = folder.path / "a.mcap.part";
    TapedLog log({.file = folder.path / "a.mcap", .epoch_ns = epoch_ns}, two_channels());
    fly(log, 1000);
    if (longer)
      std::ofstream(part, std::ios::app) << "what is not ours";
    else
      fs::resize_file(part, 0);
    fly(log, 1000);
    const LogResult result = log.close();
    CHECK_MESSAGE(result.error.find("somebody has changed '" + part.string()) == 0, result.error);
    CHECK(fs::exists(part));
    CHECK_FALSE(fs::exists(folder.path / "a.mcap"));
  }
}

TEST_CASE("a file that is no log is refused") {
  const Folder folder;
  std::ofstream(folder.path / "a.mcap") << "hello";
  CHECK_THROWS_AS(read_mcap(folder.path / "a.mcap"), Error);
  CHECK_THROWS_AS(read_mcap(folder.path / "none.mcap"), Error);
}

}  // namespace log_test

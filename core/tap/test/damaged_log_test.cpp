// SPDX-License-Identifier: BSD-3-Clause
// State of a log after the process or the disk fails, or another program changes the file.
#include <doctest/doctest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <functional>
#include <random>
#include <thread>

#include "core/error.hpp"
#include "core/log/out_file.hpp"
#include "core/log/test/read_mcap.hpp"
#include "core/tap/test/flown_log.hpp"
#include "core/types/sha256.hpp"
#include "tools/fulmar_log/recover.hpp"

namespace damaged_log_test {

using namespace fulmar::core;
using namespace fulmar::core::test;
namespace fs = std::filesystem;

namespace {

/// Runs `body` in a child process; returns the status of waitpid.
int in_child(const std::function<int()>& body) {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(body());
  int status = 0;
  ::waitpid(child, &status, 0);
  return status;
}

}  // namespace

TEST_CASE("a run killed in flight leaves a file whose complete chunks, mission included, can be read") {
  const Folder folder;
  const fs::path file = folder.path / "a.mcap";
  int pipe_ends[2];
  REQUIRE(::pipe(pipe_ends) == 0);
  const pid_t child = ::fork();
  if (child == 0) {
    TapedLog log({.file = file, .epoch_ns = epoch_ns}, two_channels());
    log.attach("mission.yaml", "application/yaml", "mission: test\n");
    fly(log, 4000);
    // 10 s of flight: all but the open last chunk reach the file
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
  ::close(pipe_ends[0]);
  ::close(pipe_ends[1]);
  REQUIRE(WIFSIGNALED(status));
  CHECK_FALSE(fs::exists(file));
  const WholeLog log = read_mcap(file.string() + ".part");
  CHECK_FALSE(log.complete);
  CHECK(log.fault != "");
  CHECK(log.messages.size() >= 4400);  // all but the last second
  CHECK(log.messages.size() < 5000);
  CHECK(is_flight(log));
  CHECK(log.attachment("mission.yaml") != nullptr);

  const McapWriter::Result recovered = recover_mcap(file.string() + ".part", folder.path / "recovered.mcap");
  CHECK(recovered.error == "");
  const WholeLog whole = read_mcap(recovered.file);
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
    const WholeLog log = read_mcap(cut);
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
    const WholeLog log = read_mcap(cut);
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
    const WholeLog log = read_mcap(result.file);
    if (log.messages.size() != result.messages || !is_flight(log)) return 5;
    if (log.complete || result.file != file.string() + ".part" || fs::exists(file)) return 6;
    return 0;
  });
  REQUIRE(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 0);
}

TEST_CASE("a log that fails is reported during the flight") {
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
    return log.log.error() == "log.operation_failed(write, " + (folder.path / "a.mcap.part").string() +
                                  ", File too large)"
               ? 0
               : 3;
  });
  REQUIRE(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 0);
}

TEST_CASE("a file that is being written is detected as such until its writer ends") {
  const Folder folder;
  const fs::path part = folder.path / "a.mcap.part";
  {
    TapedLog log({.file = folder.path / "a.mcap", .epoch_ns = epoch_ns}, two_channels());
    fly(log, 1000);
    CHECK(OutFile::grows(part));
    CHECK_THROWS_WITH_AS(write_log(folder.path / "a.mcap", 1),
                         ("log.partial_log_exists(" + part.string() +
                          ", another run is writing it; wait for its end, or give another name)")
                             .c_str(),
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

TEST_CASE("a log whose file is removed in flight reports it and counts its messages as lost") {
  const Folder folder;
  TapedLog log({.file = folder.path / "a.mcap", .epoch_ns = epoch_ns}, two_channels());
  fly(log, 1000);
  fs::remove(folder.path / "a.mcap.part");
  fly(log, 1000);
  const LogResult result = log.close();
  CHECK(result.error.find("log.log_removed(" + (folder.path / "a.mcap.part").string()) == 0);
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
    CHECK(result.error == "log.log_moved(" + part.string() + ", ' to '" + moved.string() + "')");
    CHECK(result.file == moved);
    CHECK(result.messages > 0);
    CHECK(result.messages + result.dropped == 3500);
    CHECK(read_mcap(moved).messages.size() == result.messages);
  }
}

TEST_CASE("a log whose folder is removed, or whose name another file has taken, is not named in the result") {
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
    CHECK_MESSAGE(result.error == "log.log_removed(" + (logs / "a.mcap.part").string() + ")", result.error);
    CHECK(result.messages == 0);
    CHECK(result.file.empty());
  }
}

TEST_CASE("a log that was truncated or extended in flight is not reported as complete") {
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
    CHECK_MESSAGE(result.error.find("log.log_altered(" + part.string()) == 0, result.error);
    CHECK(fs::exists(part));
    CHECK_FALSE(fs::exists(folder.path / "a.mcap"));
  }
}

}  // namespace damaged_log_test

// SPDX-License-Identifier: BSD-3-Clause
// Logs written and read back: content, order, equal bytes for equal runs.
#include <doctest/doctest.h>

#include <array>
#include <cstring>
#include <random>

#include "core/error.hpp"
#include "core/log/test/read_mcap.hpp"
#include "core/tap/test/flown_log.hpp"
#include "core/types/sha256.hpp"

namespace log_test {

using namespace fulmar::core;
using namespace fulmar::core::test;
namespace fs = std::filesystem;

TEST_CASE("a log holds every message, attachment and metadata that was written") {
  const Folder folder;
  const LogResult result = write_log(folder.path / "a.mcap", 4000);
  CHECK(result.error == "");
  CHECK(result.dropped == 0);
  CHECK(result.messages == 5000);
  CHECK(result.file == folder.path / "a.mcap");
  CHECK_FALSE(fs::exists(folder.path / "a.mcap.part"));
  CHECK(result.bytes == fs::file_size(result.file));
  CHECK(result.sha256 == Sha256::of(contents(result.file)));

  const WholeLog log = read_mcap(result.file);
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

TEST_CASE("a log without messages is complete") {
  const Folder folder;
  const LogResult result = write_log(folder.path / "a.mcap", 0);
  const WholeLog log = read_mcap(result.file);
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

TEST_CASE("a log never overwrites a file, complete or not, nor one that appears during the write") {
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
    const WholeLog file = read_mcap(result.file);
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

TEST_CASE("a file that is no log is rejected") {
  const Folder folder;
  std::ofstream(folder.path / "a.mcap") << "hello";
  CHECK_THROWS_AS(read_mcap(folder.path / "a.mcap"), Error);
  CHECK_THROWS_AS(read_mcap(folder.path / "none.mcap"), Error);
}

}  // namespace log_test

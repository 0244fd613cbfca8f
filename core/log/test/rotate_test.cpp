// SPDX-License-Identifier: BSD-3-Clause
// A log that goes on in further files: each whole, none larger than asked, all messages there once and in
// order.
#include <doctest/doctest.h>

#include <algorithm>
#include <compare>

#include "core/error.hpp"
#include "core/log/reader.hpp"
#include "core/log/test/log_kit.hpp"
#include "core/types/sha256.hpp"

namespace rotate_test {

using namespace fulmar::core;
using namespace fulmar::core::test;

namespace {

/// All files together hold what one file would, and each the last of both channels from the file before;
/// returns the messages.
std::size_t check_parts(const McapWriter::Result& result) {
  std::size_t messages = 0;
  std::uint32_t mixed = 0;
  for (const McapWriter::Part& part : result.files) {
    const McapFile file = read_mcap(part.file);
    CHECK(file.complete);
    CHECK(file.fault == "");
    CHECK(part.messages == file.messages.size());
    CHECK(part.bytes == std::filesystem::file_size(part.file));
    CHECK(part.sha256 == Sha256::of(contents(part.file)));
    REQUIRE(file.attachment("mission.yaml") != nullptr);
    CHECK(file.attachment("mission.yaml")->content == "mission: test\n");
    CHECK(file.attachment("mission.yaml")->log_ns == static_cast<std::uint64_t>(epoch_ns));
    const auto number = static_cast<std::size_t>(&part - result.files.data()) + 1;
    REQUIRE(file.metadata.size() == (number == 1 ? 1 : 2));
    CHECK(file.metadata[0].pairs[1] == std::pair<std::string, std::string>("seed", "7"));
    if (number > 1) CHECK(file.metadata[1].name == "series");
    if (number > 1)
      CHECK(file.metadata[1].pairs[0] == std::pair<std::string, std::string>("file", std::to_string(number)));
    CHECK(first_of_series(part.file, std::to_string(number)) == result.file);
    const std::uint16_t channel = file.channel("/mixed");
    CHECK(file.schemas.at(file.channels.at(channel).schema).text == ros_definition(*mixed_type()));
    if (number > 1) --mixed;  // the last one of the file before
    bool in_order = true;
    for (const McapFile::Message& m : file.messages)
      in_order = in_order && (m.channel != channel || m.sequence == mixed++);
    CHECK(in_order);
    messages += file.messages.size();
  }
  return messages;
}

}  // namespace

TEST_CASE("a log is cut by flight time") {
  const Folder folder;
  const auto result =
      write_sample({.file = folder.path / "a.mcap", .rotate_ns = 3'000'000'000}, 4000);  // 10 s
  CHECK(result.error == "");
  REQUIRE(result.files.size() == 4);
  CHECK(result.files[1].file == folder.path / "a-2.mcap");
  CHECK(result.files[3].file == folder.path / "a-4.mcap");
  CHECK(result.file == folder.path / "a.mcap");
  CHECK(result.messages == 5000);
  CHECK(result.lost == 0);
  CHECK(check_parts(result) == 5000 + 3 * 2);
  const McapFile second = read_mcap(result.files[1].file);
  CHECK(second.messages.at(0).log_ns == static_cast<std::uint64_t>(epoch_ns + 2'000'000'000 - 10'000'000));
  CHECK(second.messages.at(1).log_ns == static_cast<std::uint64_t>(epoch_ns + 2'000'000'000 - 2'500'000));
  CHECK(second.messages.at(2).log_ns == static_cast<std::uint64_t>(epoch_ns + 2'000'000'000));
  CHECK(second.messages.back().log_ns == static_cast<std::uint64_t>(epoch_ns + 5'000'000'000 - 2'500'000));
}

TEST_CASE("a log is cut by size, the same way in equal runs") {
  const Folder folder;
  const McapWriter::Options options{
      .file = folder.path / "a.mcap", .chunk_ns = 100'000'000, .rotate_bytes = 30'000};
  McapWriter::Options again = options;
  again.file = folder.path / "b.mcap";
  const auto a = write_sample(options, 4000), b = write_sample(again, 4000);
  REQUIRE(a.files.size() > 2);
  CHECK(check_parts(a) == 5000 + 2 * (a.files.size() - 1));
  for (const McapWriter::Part& part : a.files)
    CHECK(part.bytes < 30'000 + 10'000);  // the summary comes on top
  REQUIRE(a.files.size() == b.files.size());
  for (std::size_t i = 0; i < a.files.size(); ++i) CHECK(a.files[i].sha256 == b.files[i].sha256);
}

TEST_CASE(
    "every further file begins with what holds: the last of each name and of each channel, at their own "
    "times") {
  const Folder folder;
  McapWriter writer({.file = folder.path / "a.mcap", .max_message_bytes = 8, .rotate_ns = 3'000'000'000});
  std::vector<std::uint16_t> channels;
  for (const char* topic : {"/dense", "/plan", "/event"})
    channels.push_back(writer.add_channel(0, topic, "", {}));
  struct Told {
    std::uint16_t channel;
    std::uint64_t log_ms, publish_ms;
    char word;
    auto operator<=>(const Told&) const = default;
  };
  const auto write = [&](const Told& told, const std::string& lasting = "") {
    *writer.begin_message(channels[told.channel], 7, told.log_ms * 1'000'000, told.publish_ms * 1'000'000) =
        std::byte(told.word);
    writer.end_message(1, lasting);
  };
  const Told plan{1, 1500, 1400, 'p'}, take_off{2, 1000, 1000, 't'}, cruise{2, 5990, 5990, 'c'},
      wind{2, 2900, 2800, 'w'}, note{2, 2950, 2950, 'n'};
  for (std::uint64_t ms = 1000; ms < 11'000; ms += 10) {
    if (ms == 1000) write(take_off, "phase");
    if (ms == 1500) write(plan);
    if (ms == 2900) write(wind, "wind");
    if (ms == 2950) write(note);
    if (ms == 5990) write(cruise, "phase");
    write({0, ms, ms, 'd'});
  }
  const McapWriter::Result result = writer.close();
  CHECK(result.messages == 1000 + 5);
  CHECK(result.lost == 0);
  REQUIRE(result.files.size() == 4);
  const std::vector<std::vector<Told>> begins = {{take_off},
                                                 {take_off, plan, wind, note, {0, 3990, 3990, 'd'}},
                                                 {plan, wind, note, cruise, {0, 6990, 6990, 'd'}},
                                                 {plan, wind, note, cruise, {0, 9990, 9990, 'd'}}};
  for (std::size_t n = 0; n < 4; ++n) {
    const McapFile file = read_mcap(result.files[n].file);
    CHECK(file.complete);
    std::vector<Told> found;
    for (const McapFile::Message& m : file.messages)
      found.push_back(
          {m.channel, m.log_ns / 1'000'000, m.publish_ns / 1'000'000, static_cast<char>(m.data[0])});
    REQUIRE(found.size() > begins[n].size());
    const auto end = found.begin() + static_cast<std::ptrdiff_t>(begins[n].size());
    CHECK(std::equal(found.begin(), end, begins[n].begin()));
    CHECK(*end == Told{0, 1000 + 3000 * n, 1000 + 3000 * n, 'd'});
    CHECK(std::is_sorted(found.begin(), found.end(),
                         [](const Told& a, const Told& b) { return a.log_ms < b.log_ms; }));
  }
}

TEST_CASE("the first file is the same as if the log would not rotate") {
  const Folder folder;
  const auto plain = write_sample({.file = folder.path / "a.mcap"}, 1200);
  const auto first = write_sample({.file = folder.path / "b.mcap", .rotate_ns = 3'000'000'000}, 1200);
  const auto both = write_sample({.file = folder.path / "c.mcap", .rotate_ns = 3'000'000'000}, 1201);
  CHECK(both.files.size() == 2);
  CHECK(contents(plain.file) == contents(first.file));
  CHECK(contents(plain.file) == contents(both.file));
}

TEST_CASE(
    "a log that would rotate onto a file is refused; one whose next file cannot be begun goes on where it "
    "is, and says so") {
  const Folder folder;
  store(folder.path / "a-2.mcap", "precious");
  CHECK_THROWS_WITH_AS(write_sample({.file = folder.path / "a.mcap", .rotate_ns = 1}, 1),
                       doctest::Contains("a-2.mcap"), Error);
  std::filesystem::remove(folder.path / "a-2.mcap");
  store(folder.path / "a-3.mcap", "precious");
  const auto result = write_sample({.file = folder.path / "a.mcap", .rotate_ns = 3'000'000'000}, 4000);
  CHECK(result.files.size() == 2);
  CHECK(result.error.find("a-3.mcap") != std::string::npos);
  CHECK(result.messages == 5000);
  CHECK(check_parts(result) == 5000 + 2);
  CHECK(contents(folder.path / "a-3.mcap") == "precious");
}

}  // namespace rotate_test

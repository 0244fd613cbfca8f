// SPDX-License-Identifier: BSD-3-Clause
// Small files that expand in memory: comparison and reading of logs stay within a bound.
#include <doctest/doctest.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <algorithm>
#include <random>

#include "core/error.hpp"
#include "core/log/test/log_kit.hpp"
#include "core/sanitized.hpp"
#include "core/test/limits.hpp"
#include "tools/log_reading/message_diff.hpp"

namespace memory_test {

using namespace fulmar::core;
using namespace fulmar::core::test;

namespace {

/// `chunks` of one message of `bytes` zeros each, `step_ns` after the one before.
void write_zeros(const std::filesystem::path& file, int chunks, std::size_t bytes, std::uint64_t step_ns) {
  McapWriter writer({.file = file, .chunk_bytes = bytes, .max_message_bytes = bytes});
  const std::uint16_t channel = writer.add_channel(writer.add_schema("zeros", "", ""), "/zeros", "raw", {});
  for (int i = 0; i < chunks; ++i) {
    const std::uint64_t ns = 1'000'000'000 + step_ns * static_cast<std::uint64_t>(i);
    std::fill_n(writer.begin_message(channel, 0, ns, ns), bytes, std::byte{0});
    writer.end_message(bytes);
  }
  REQUIRE(writer.close().error == "");
}

struct Outcome {
  std::string said;
  long max_mb = 0;
};

/// Output of `work` in a separate process, and its largest use of memory.
template <class Work>
Outcome apart(const Folder& folder, const Work& work) {
  const pid_t child = ::fork();
  if (child == 0) {
    std::string said;
    try {
      said = work();
    } catch (const Error& fault) {
      said = fault.what();
    }
    store(folder.path / "said", said);
    ::_exit(0);
  }
  int status = 0;
  rusage used{};
  REQUIRE(::wait4(child, &status, 0, &used) == child);
  REQUIRE(status == 0);
#ifdef FULMAR_SANITIZED
  used.ru_maxrss = 0;  // its allocator keeps what is given back
#endif
  return {contents(folder.path / "said"), used.ru_maxrss / 1024};
}

}  // namespace

TEST_CASE("two logs of a gigabyte are compared in little memory") {
  const Folder folder;
  const auto a = folder.path / "a.mcap", b = folder.path / "b.mcap";
  write_zeros(a, 60, 16u << 20, 1'000'000);
  write_zeros(b, 60, 16u << 20, 1'000'000);
  CHECK(std::filesystem::file_size(a) < 400'000);
  const Outcome diff = apart(folder, [&] {
    const MessageDiff d = diff_messages(a, b);
    return std::to_string(d.topics.at("/zeros").equal) + " " + (d.messages_equal() ? "equal" : "different");
  });
  CHECK(diff.said == "60 equal");
  CHECK(diff.max_mb < 200);
}

TEST_CASE("two logs of millions of small messages are compared in little memory" *
          doctest::test_suite("amounts")) {
  const Folder folder;
  const auto log = folder.path / "a.mcap";
  constexpr int messages = 2'100'000;  // of 32 bytes with their heads: in chunks that are as large as may be
  // written apart as well: a process begins with the memory of the one that it comes from
  const Outcome written = apart(folder, [&] {
    McapWriter writer({.file = log, .chunk_bytes = 31u << 20, .chunk_ns = 3600'000'000'000});
    const std::uint16_t channel = writer.add_channel(writer.add_schema("tiny", "", ""), "/tiny", "raw", {});
    for (std::uint32_t i = 0; i < messages; ++i) {
      *writer.begin_message(channel, i, 1'000'000'000 + i, 0) = std::byte{7};
      writer.end_message(1);
    }
    return writer.close().error;
  });
  REQUIRE(written.said == "");
  const Outcome diff = apart(folder, [&] {
    const MessageDiff d = diff_messages(log, log);
    return d.fault_a + std::to_string(d.topics.at("/tiny").equal);
  });
  CHECK(diff.said == std::to_string(messages));
  CHECK(diff.max_mb < 200);
}

TEST_CASE("a log that holds a gigabyte at one time, or in one chunk, is refused") {
  const Folder folder;
  const auto at_once = folder.path / "at_once.mcap", chunk = folder.path / "chunk.mcap";
  write_zeros(at_once, 60, 16u << 20, 0);
  const Outcome diff = apart(folder, [&] { return diff_messages(at_once, at_once).fault_a; });
  CHECK(diff.said == "reading.messages_too_large(32, 1.000)");
  CHECK(diff.max_mb < 200);
  write_zeros(chunk, 1, 40u << 20, 0);
  McapStream stream(chunk);
  CHECK(stream.next() == nullptr);
  CHECK(stream.log().fault.ends_with(": log.chunk_too_largelog.repair_hint"));
}

TEST_CASE("each damaged log takes less than a gigabyte and five seconds to read and to compare") {
  const Folder folder;
  const auto whole = folder.path / "whole.mcap", damaged = folder.path / "damaged.mcap";
  write_sample({.file = whole}, 2000);
  const std::string good = contents(whole);
  std::mt19937 dice(7);
  for (int i = 0; i < mutants; ++i) {
    std::string bytes = good;
    for (auto n = 1 + dice() % 8; n > 0; --n) bytes[dice() % bytes.size()] = static_cast<char>(dice());
    if (i % 4 == 0) bytes.resize(dice() % bytes.size());
    store(damaged, bytes);
    CAPTURE(i);
    CHECK(within_limits([&] {
      try {
        McapStream stream(damaged);
        while (stream.next() != nullptr) {
        }
        diff_messages(whole, damaged);
      } catch (const Error&) {  // a sentence
      }
    }));
  }
}

}  // namespace memory_test

// SPDX-License-Identifier: BSD-3-Clause
// The tap under stress: a cursor returns the written samples in order, and counts each sample that it loses.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstring>
#include <thread>
#include <vector>

#include "core/tap/tap.hpp"
#include "core/types/test/types.hpp"

namespace cursor_test {

using namespace fulmar::core;
using fulmar::core::test::make_type;

namespace {

struct Block {
  std::uint64_t number = 0;
  std::array<std::uint64_t, 40> words{};
};

std::vector<TapChannel> channels() {
  Field number, words;
  number.name = "number";
  number.kind = FULMAR_U64;
  number.stride = 8;
  words.name = "words";
  words.kind = FULMAR_U64;
  words.shape = FULMAR_ARRAY;
  words.offset = 8;
  words.count = 40;
  words.stride = 8;
  const TypePtr block = make_type("Block", sizeof(Block), 8, {number, words}),
                small = make_type("Small", 8, 8, {number});
  return {{"/block", block}, {"/small", small}};
}

Block block(std::uint64_t i) {
  Block b;
  b.number = i;
  for (std::size_t k = 0; k < b.words.size(); ++k) b.words[k] = i * 0x9e3779b97f4a7c15ull + k;
  return b;
}

/// Message i is a block; every third is small.
void write(Tap& tap, std::uint64_t i) {
  const Block b = block(i);
  tap.write(i % 3 == 2 ? 1 : 0, static_cast<std::int64_t>(i), -static_cast<std::int64_t>(i),
            reinterpret_cast<const std::byte*>(&b), i % 2 == 0);
}

bool intact(const Tap::Sample& s) {
  const std::uint64_t i = s.number;
  const Block want = block(i);
  const bool header = s.now_ns == static_cast<std::int64_t>(i) && s.valid_ns == -s.now_ns &&
                      s.channel == (i % 3 == 2 ? 1 : 0) && s.for_log == (i % 2 == 0);
  return header && std::memcmp(s.data(), &want, s.channel == 1 ? 8 : sizeof want) == 0;
}

constexpr std::uint64_t many = 200'000;

}  // namespace

TEST_CASE(
    "a cursor that holds back gets every sample, while one that dawdles loses some, counted, and delays "
    "nobody") {
  Tap tap(channels(), 1u << 15);
  Tap::Cursor binding(tap, true);
  std::atomic<bool> ended{false};
  std::uint64_t kept = 0, good = 0, seen = 0, seen_good = 0, last = 0;
  bool in_order = true;
  std::thread log([&] {
    while (kept < many) {
      const Tap::Sample* s = binding.next();
      if (!s) {  // the writer may be waiting for this processor
        std::this_thread::yield();
        continue;
      }
      good += s->number == kept && intact(*s);
      ++kept;
    }
  });
  std::uint64_t lost = 0;
  std::thread live([&] {
    Tap::Cursor cursor(tap);
    for (bool last_look = false;;) {
      const Tap::Sample* s = cursor.next();
      if (!s && last_look) break;
      if (!s) {
        last_look = ended.load();
        std::this_thread::yield();
        continue;
      }
      in_order = in_order && (seen == 0 || s->number > last);
      last = s->number;
      seen_good += intact(*s);
      if (++seen % 500 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    lost = cursor.lost();
  });
  for (std::uint64_t i = 0; i < many; ++i) write(tap, i);
  log.join();
  ended = true;
  live.join();
  CHECK(kept == many);
  CHECK(good == many);
  CHECK(binding.lost() == 0);
  CHECK(in_order);
  CHECK(seen_good == seen);
  CHECK(last == many - 1);
  CHECK(seen + lost <= many);  // the cursor may have begun after the first
}

TEST_CASE(
    "without a cursor that holds back the loop never waits; who comes back late goes on half a ring behind") {
  Tap tap(channels(), 1u << 15);
  Tap::Cursor slow(tap);
  for (std::uint64_t i = 0; i < 10'000; ++i) write(tap, i);
  std::uint64_t got = 0, first = 0;
  while (const Tap::Sample* s = slow.next()) {
    REQUIRE(intact(*s));
    if (got++ == 0) first = s->number;
    CHECK(s->number == first + got - 1);
  }
  CHECK(slow.lost() == first);
  CHECK(first + got == 10'000);
  CHECK(got > 40);  // 32 kB hold some 140 of them
  CHECK(tap.take_wait_ns() == 0);
}

TEST_CASE("the log's sequence counts the samples for the log, separately for each channel") {
  Tap tap(channels(), 1u << 20);
  Tap::Cursor cursor(tap);
  for (std::uint64_t i = 0; i < 600; ++i) write(tap, i);
  std::array<std::uint64_t, 2> next{};
  while (const Tap::Sample* s = cursor.next()) {
    CHECK(s->sequence == next[s->channel]);
    if (s->for_log) ++next[s->channel];
  }
  CHECK(next[0] == 200);
  CHECK(next[1] == 100);
}

TEST_CASE("the loop writes a sample for each sink's request, at the shortest requested period") {
  Tap tap(channels(), 1u << 20);
  CHECK_FALSE(tap.wanted(0, 0));
  Tap::Cursor one(tap);
  one.want(0, 100);
  const auto given = [&](std::int64_t from, std::int64_t to) {
    int n = 0;
    for (std::int64_t t = from; t < to; t += 10) n += tap.wanted(0, t);
    return n;
  };
  CHECK(given(0, 1000) == 10);
  {
    Tap::Cursor two(tap);
    two.want(0, 20);
    CHECK(given(1000, 2000) == 50);
    two.want(0, 0);
    CHECK(given(2000, 3000) == 100);
  }
  const int again = given(3000, 4000);
  CHECK(again >= 10);
  CHECK(again <= 11);
  one.want(0, -1);
  CHECK(given(4000, 5000) == 0);
  CHECK_FALSE(tap.wanted(1, 0));
}

}  // namespace cursor_test

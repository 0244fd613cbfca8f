// SPDX-License-Identifier: BSD-3-Clause
// The ring under stress: records come out as they were written, in order, for any size and any wrap of the
// memory.
#include "core/run/component/ring.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <thread>

#include "core/run/component/stats.hpp"

namespace ring_test {

using fulmar::core::Ring;

namespace {

/// Message i: its size and bytes follow from i alone.
std::size_t size_of_message(std::uint64_t i) { return 1 + (i * 2654435761u) % 700; }
std::byte byte_of_message(std::uint64_t i, std::size_t k) { return static_cast<std::byte>(i * 31 + k * 7); }

std::vector<std::byte> content(std::uint64_t i) {
  std::vector<std::byte> bytes(size_of_message(i));
  for (std::size_t k = 0; k < bytes.size(); ++k) bytes[k] = byte_of_message(i, k);
  return bytes;
}
Ring::Record record(std::uint64_t i) {
  return {0, static_cast<std::uint32_t>(i % 13), i, static_cast<std::int64_t>(i) * 5,
          -static_cast<std::int64_t>(i)};
}
bool intact(const Ring::Record& r, std::uint64_t i) {
  const std::vector<std::byte> bytes = content(i);
  const Ring::Record want = record(i);
  return r.channel == want.channel && r.sequence == i && r.log_ns == want.log_ns &&
         r.valid_ns == want.valid_ns && std::equal(bytes.begin(), bytes.end(), r.data());
}

}  // namespace

TEST_CASE("a ring hands over 100000 messages of mixed sizes while the producer waits for room") {
  Ring ring(4096, 701);
  constexpr std::uint64_t n = 100'000;
  std::uint64_t good = 0, seen = 0;
  std::thread consumer([&] {
    while (seen < n) {
      const Ring::Record* r = ring.next();
      if (r == nullptr) {
        std::this_thread::yield();
        continue;
      }
      good += intact(*r, seen++);
      ring.release();
    }
  });
  for (std::uint64_t i = 0; i < n; ++i) {
    const std::vector<std::byte> bytes = content(i);
    while (!ring.push(record(i), bytes.data(), bytes.size())) ring.wait_for_room();
  }
  consumer.join();
  CHECK(good == n);
}

TEST_CASE("a full ring rejects, and accepts again after a read; no rejected record comes out") {
  Ring ring(4096, 701);
  std::uint64_t pushed = 0, taken = 0;
  for (int round = 0; round < 1000; ++round) {
    std::vector<std::byte> bytes = content(pushed);
    while (ring.push(record(pushed), bytes.data(), bytes.size())) bytes = content(++pushed);
    CHECK(pushed > taken);
    const std::uint64_t most = taken + 1 + static_cast<std::uint64_t>(round) % 40;
    while (taken < most) {
      const Ring::Record* r = ring.next();
      if (r == nullptr) break;
      REQUIRE(intact(*r, taken));
      ++taken;
      ring.release();
    }
  }
  CHECK(taken > 2000);
}

TEST_CASE("a ring that is too small for its messages grows until it holds four") {
  const Ring ring(64, 100'000);
  CHECK(ring.capacity() >= 400'000);
}

TEST_CASE("of equal step times every quantile is that time, and the least of several is the least") {
  fulmar::core::Histogram same, several;
  for (int i = 0; i < 4; ++i) same.add(20);
  for (const double q : {0.0, 0.5, 0.99}) CHECK(same.quantile_us(q) == doctest::Approx(0.020));
  for (const int ns : {20, 100, 1000}) several.add(ns);
  CHECK(several.quantile_us(0) == doctest::Approx(0.0205));
  CHECK(several.quantile_us(0.5) == doctest::Approx(0.1).epsilon(0.05).scale(0));
  CHECK(several.quantile_us(1) == doctest::Approx(1));
}

TEST_CASE("a ring that has been read completely has all its room again") {
  Ring ring(4096, 64);
  const std::vector<std::byte> bytes(64 - sizeof(Ring::Record));
  REQUIRE(ring.push({}, bytes.data(), bytes.size()));
  REQUIRE(ring.next() != nullptr);
  ring.release();
  std::size_t fitting = 0;
  while (ring.push({}, bytes.data(), bytes.size())) ++fitting;
  CHECK(fitting == ring.capacity() / 64);
}

}  // namespace ring_test

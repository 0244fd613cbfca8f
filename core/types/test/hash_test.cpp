// SPDX-License-Identifier: BSD-3-Clause
// The hash of a message covers exactly the bytes of the wire form: compared with the wire form itself.
#include "core/types/hash.hpp"

#include <doctest/doctest.h>

#include <vector>

#include "core/types/test/types.hpp"
#include "core/types/wire.hpp"

namespace hash_test {

using namespace fulmar::core;
using namespace fulmar::core::test;

TEST_CASE("a changed byte changes the hash if, and only if, it changes the wire form") {
  const TypePtr type = mixed_type();
  const MessageHash hash(*type);
  const CdrEncoder encoder(*type);
  const Mixed usual = mixed_value();
  const auto wire = [&](const std::byte* m) {
    std::vector<std::byte> bytes;
    encoder.encode(m, bytes);
    return bytes;
  };
  std::vector<std::byte> message(type->size);
  std::memcpy(message.data(), &usual, sizeof usual);
  const auto before = wire(message.data());
  const std::uint64_t of_usual = hash.of(1, message.data());
  int seen = 0, unseen = 0;
  for (std::size_t i = 0; i < message.size(); ++i) {
    const std::byte kept = message[i];
    message[i] ^= std::byte{1};
    const bool differs = wire(message.data()) != before;
    CHECK_MESSAGE((hash.of(1, message.data()) != of_usual) == differs, "byte " << i);
    (differs ? seen : unseen)++;
    message[i] = kept;
  }
  CHECK(seen > 60);
  CHECK(unseen > 0);  // padding, unused items
  CHECK(hash.of(2, message.data()) != of_usual);
}

TEST_CASE("a million neighbouring numbers have a million hashes") {
  constexpr std::uint64_t n = 1'000'000, room = 1u << 22;
  std::vector<std::uint64_t> found(room);  // open addressing: the next free slot after the hash; 0 is free
  std::uint64_t different = 0;
  for (std::uint64_t i = 0; i < n; ++i) {
    const std::uint64_t hash = hash_bytes(0, reinterpret_cast<const std::byte*>(&i), sizeof i);
    REQUIRE(hash != 0);
    std::uint64_t place = hash % room;
    while (found[place] != 0 && found[place] != hash) place = (place + 1) % room;
    if (found[place] != hash) ++different;
    found[place] = hash;
  }
  CHECK(different == n);
}

}  // namespace hash_test

// SPDX-License-Identifier: BSD-3-Clause
#include "links/live/gate.hpp"

#include <doctest/doctest.h>

#include "core/error.hpp"

namespace gate_test {

using namespace fulmar::core;
using namespace fulmar::core::live;

namespace {

LiveOptions listening(const std::string& host, const std::string& token = "") {
  LiveOptions options;
  options.host = host;
  options.token = token;
  return options;
}

unsigned status(const LiveOptions& options, const Caller& caller) { return admit(options, caller).status; }

}  // namespace

TEST_CASE("names of this computer are answered, others are not") {
  const LiveOptions options = listening("127.0.0.1");
  for (const char* host : {"localhost", "LocalHost:8765", "127.0.0.1:8765", "[::1]:8765", "localhost:9999"})
    CHECK(status(options, {"/", host, "", ""}) == 200);
  for (const char* host : {"evil.example", "evil.example:8765", "localhost.evil.example",
                           "127.0.0.1.evil.example", "192.168.1.5", "[fe80::1]"})
    CHECK(status(options, {"/", host, "", ""}) == 403);
  for (const char* host : {"", ":8765", "[::1", "a@localhost", "localhost/x", "localhost:8765evil",
                           "localhost:evil.example", "[::1]evil", "[::1]:x", "localhost:123456"})
    CHECK(status(options, {"/", host, "", ""}) == 400);
}

TEST_CASE("pages of other sites are rejected") {
  const LiveOptions options = listening("127.0.0.1");
  for (const char* origin :
       {"http://localhost:8765", "http://127.0.0.1:3000", "https://localhost", "http://[::1]:1"})
    CHECK(status(options, {"/", "localhost:8765", origin, ""}) == 200);
  for (const char* origin :
       {"http://evil.example", "https://localhost.evil.example", "null", "file://", "http://",
        "http://evil.example:8765", "http://localhost:8765.evil.example", "http://[::1].evil.example"})
    CHECK(status(options, {"/", "localhost:8765", origin, ""}) == 403);
}

TEST_CASE("with a token only a request that has it is accepted, under every host name") {
  const LiveOptions options = listening("0.0.0.0", "a b&c");
  CHECK(status(options, {"/", "plane.example:8765", "https://app.example", ""}) == 401);
  CHECK(status(options, {"/?token=a%20b%26c", "plane.example:8765", "https://app.example", ""}) == 200);
  CHECK(status(options, {"/?x=1&token=a%20b%26C", "localhost", "", ""}) == 401);
  CHECK(status(options, {"/?x=1&token=a%20b%26c&y", "localhost", "", ""}) == 200);
  CHECK(status(options, {"/", "localhost", "", "Bearer a b&c"}) == 200);
  CHECK(status(options, {"/", "localhost", "", "Basic a b&c"}) == 401);
  CHECK(status(options, {"/?token=", "localhost", "", ""}) == 401);
  CHECK(status(options, {"/?token=%", "localhost", "", "bearer "}) == 401);
}

TEST_CASE("a guesser of tokens has ten at once and one per second, and other addresses are not affected") {
  Guesses guesses;
  auto now = Guesses::Clock::time_point{} + std::chrono::hours(1);
  int looked_at = 0;
  for (int i = 0; i < 1000; ++i, now += std::chrono::milliseconds(10)) {  // ten seconds
    if (!guesses.may("a", now)) continue;
    guesses.wrong("a", now);
    ++looked_at;
  }
  CHECK(looked_at >= 19);
  CHECK(looked_at <= 22);
  CHECK(guesses.may("b", now));
  CHECK(guesses.may("a", now + std::chrono::seconds(2)));
  for (int i = 0; i < 20; ++i) guesses.wrong("b", now);
  for (int i = 0; i < 10'000; ++i) guesses.wrong(std::to_string(i), now + std::chrono::hours(1));
  CHECK(guesses.may("b", now + std::chrono::hours(1)));
  CHECK(guesser("2001:db8::1") == guesser("2001:db8::ffff:2"));
  CHECK(guesser("2001:db8::1") != guesser("2001:db8:0:1::1"));
  CHECK(guesser("192.0.2.1") != guesser("192.0.2.2"));
  CHECK(guesser("::ffff:192.0.2.1") != guesser("::ffff:192.0.2.2"));
}

TEST_CASE("secrets are equal only when every character is") {
  CHECK(same_secret("abc", "abc"));
  CHECK_FALSE(same_secret("abcabc", "abc"));
  CHECK_FALSE(same_secret("ab", "abc"));
  CHECK_FALSE(same_secret("", "abc"));
  CHECK_FALSE(same_secret("abc", ""));
  CHECK_FALSE(same_secret("abd", "abc"));
}

TEST_CASE("a path ends where its query begins") {
  CHECK(path_of("/view?token=a?b") == "/view");
  CHECK(path_of("/") == "/");
  CHECK(path_of("?x").empty());
}

TEST_CASE("a client that sends more than the bucket holds waits until it has refilled") {
  const Bucket::Clock::time_point t0{};
  Bucket bucket(100, 5, t0);
  for (int i = 0; i < 5; ++i) CHECK(bucket.take(1, t0).count() == 0);
  CHECK(std::chrono::duration<double>(bucket.take(1, t0)).count() == doctest::Approx(0.01));
  CHECK(std::chrono::duration<double>(bucket.take(1, t0)).count() == doctest::Approx(0.02));
  CHECK(bucket.take(1, t0 + std::chrono::milliseconds(31)).count() == 0);
  CHECK(bucket.take(5, t0 + std::chrono::hours(1)).count() == 0);  // never more than the burst
  CHECK(bucket.take(1, t0 + std::chrono::hours(1)).count() > 0);
}

}  // namespace gate_test

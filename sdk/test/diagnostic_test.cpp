// SPDX-License-Identifier: BSD-3-Clause
// Messages: a code with arguments, a sentence of a catalogue, a place. The tests of the project run with
// FULMAR_MESSAGES=codes; a separate program without it tests the sentence itself.
#include "fulmar/diagnostic.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

namespace {

namespace messages {
constexpr fulmar::MessageText empty{"test.empty", "nothing"};
constexpr fulmar::MessageText swapped{"test.swapped", {"a", "b"}, "{b} before {a}, {{raw}, {b}"};
}  // namespace messages

std::string written(std::size_t room, const auto& text, const auto&... values) {
  std::array<char, 64> to;
  to.fill('#');
  const std::size_t size = text.write(to.data(), room, values...);
  return std::to_string(size) + " " + to.data();
}

}  // namespace

TEST_CASE("a message has its code, its arguments by name and type, and no place of its own") {
  const fulmar::Diagnostic made = messages::swapped("x", 3);
  CHECK(made.code == "test.swapped");
  REQUIRE(made.arguments.size() == 2);
  CHECK(made.arguments[0].name == "a");
  CHECK(std::get<std::string>(made.arguments[0].value) == "x");
  CHECK(std::get<std::int64_t>(made.arguments[1].value) == 3);
  CHECK(made.place.empty());
  CHECK(made.line() == "test.swapped(x, 3)");
  CHECK(messages::empty().line() == "test.empty");
  CHECK(messages::empty.c_str() == std::string("test.empty"));
}

TEST_CASE("arguments: the largest count, a negative number, a double, digits, a character, a message") {
  CHECK(messages::swapped(UINT64_MAX, INT64_MIN).line() ==
        "test.swapped(18446744073709551615, -9223372036854775808)");
  CHECK(messages::swapped(0.1, 'c').line() == "test.swapped(0.1, c)");
  CHECK(messages::swapped(fulmar::Fixed{2.0 / 3, 3}, std::string_view("s")).line() ==
        "test.swapped(0.667, s)");
  CHECK(messages::swapped(messages::empty(), messages::swapped(1, 2)).line() ==
        "test.swapped(test.empty, test.swapped(1, 2))");
}

TEST_CASE("paths stand before each other, an empty one changes nothing") {
  fulmar::Diagnostic made = fulmar::located("outer", fulmar::located("inner", messages::empty()));
  CHECK(made.path == "outer: inner");
  CHECK(fulmar::located("", made).line() == "outer: inner: test.empty");
  made.place = "a.yaml:3";
  CHECK(made.line() == "a.yaml:3: outer: inner: test.empty");
}

TEST_CASE("a room that is too small cuts the text, ends it with a zero and returns the length of the whole") {
  CHECK(written(64, messages::swapped, "x", 2.5) == "20 test.swapped(x, 2.5)");
  CHECK(written(21, messages::swapped, "x", 2.5) == "20 test.swapped(x, 2.5)");
  CHECK(written(20, messages::swapped, "x", 2.5) == "20 test.swapped(x, 2.5");
  CHECK(written(1, messages::swapped, "x", 2.5) == "20 ");
  CHECK(written(64, messages::empty) == "10 test.empty");
}

TEST_CASE("without FULMAR_MESSAGES=codes the sentence appears, its arguments where their names stand") {
  if (const char* own = std::getenv("FULMAR_TEST_SENTENCE"); own != nullptr) {
    std::printf("[%s|%s]\n", messages::swapped("x", 3).line().c_str(), messages::empty.c_str());
    CHECK(written(64, messages::swapped, "x", 3) == "20 3 before x, {raw}, 3");
    return;
  }
  std::array<char, 4096> out{};
  std::FILE* const child = ::popen(
      "FULMAR_TEST_SENTENCE=1 FULMAR_MESSAGES=sentences /proc/$PPID/exe -tc='without FULMAR_MESSAGES*'", "r");
  REQUIRE(child != nullptr);
  const std::string all(out.data(), std::fread(out.data(), 1, out.size(), child));
  CHECK(::pclose(child) == 0);
  CHECK(all.find("[3 before x, {raw}, 3|nothing]") != std::string::npos);
}

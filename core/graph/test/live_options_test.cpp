// SPDX-License-Identifier: BSD-3-Clause
#include "core/graph/live_options.hpp"

#include <doctest/doctest.h>

#include "core/error.hpp"

namespace live_options_test {

using namespace fulmar::core;

namespace {

LiveOptions listening(const std::string& host, const std::string& token = "") {
  LiveOptions options;
  options.host = host;
  options.token = token;
  return options;
}

}  // namespace

TEST_CASE("an address that others can reach needs a token") {
  CHECK_THROWS_WITH_AS(check_live_options(listening("0.0.0.0")),
                       doctest::Contains("0.0.0.0 can be reached from other computers. Give a token"), Error);
  CHECK_THROWS_AS(check_live_options(listening("192.168.1.5")), Error);
  CHECK_THROWS_AS(check_live_options(listening("::")), Error);
  for (const char* host : {"127.0.0.1", "127.8.8.8", "localhost", "::1"})
    CHECK_NOTHROW(check_live_options(listening(host)));
  CHECK_NOTHROW(check_live_options(listening("0.0.0.0", "secret")));
}

TEST_CASE("who may have files written: this computer, unless the mission says otherwise") {
  LiveOptions options;
  CHECK(why_no_save(options) == "");
  options.host = "0.0.0.0";
  CHECK(why_no_save(options) ==
        "0.0.0.0 can be reached from other computers, and the mission does not say live: {save: on}");
  options.save = true;
  CHECK(why_no_save(options) == "");
  options.save = false;
  CHECK(why_no_save(options) == "the mission says live: {save: off}");
  options.host = "::1";
  CHECK(why_no_save(options) == "the mission says live: {save: off}");
}

}  // namespace live_options_test

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

TEST_CASE("an address that is not loopback needs a token") {
  CHECK_THROWS_WITH_AS(check_live_options(listening("0.0.0.0")),
                       doctest::Contains("graph.live_token_missing(0.0.0.0)"), Error);
  CHECK_THROWS_AS(check_live_options(listening("192.168.1.5")), Error);
  CHECK_THROWS_AS(check_live_options(listening("::")), Error);
  for (const char* host : {"127.0.0.1", "127.8.8.8", "localhost", "::1"})
    CHECK_NOTHROW(check_live_options(listening(host)));
  CHECK_NOTHROW(check_live_options(listening("0.0.0.0", "secret")));
}

TEST_CASE("clients of this computer may have files written, others only by the mission") {
  LiveOptions options;
  CHECK(why_no_save(options) == "");
  options.host = "0.0.0.0";
  CHECK(why_no_save(options) == "graph.save_not_enabled(0.0.0.0)");
  options.save = true;
  CHECK(why_no_save(options) == "");
  options.save = false;
  CHECK(why_no_save(options) == "graph.save_off");
  options.host = "::1";
  CHECK(why_no_save(options) == "graph.save_off");
}

}  // namespace live_options_test

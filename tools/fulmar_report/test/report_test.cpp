// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_report/report.hpp"

#include <doctest/doctest.h>
#include <zlib.h>

#include <nlohmann/json.hpp>

#include "core/error.hpp"

namespace report_test {

using namespace fulmar;
using nlohmann::json;

namespace {

constexpr std::uint64_t epoch_ns = 1'767'225'600'000'000'000;

/// A log of two topics: one at 100 Hz for two seconds, one with three messages at once.
core::McapFile log_of() {
  core::McapFile log;
  log.schemas[1] = {"p/msg/A", "ros2msg", "float64 x_m\n"};
  log.schemas[2] = {"p/msg/B", "jsonschema", "{}"};
  log.channels[1] = {1, "/fast", "cdr", {}};
  log.channels[2] = {1, "/rare", "cdr", {}};
  log.channels[3] = {2, "/foreign", "json", {}};
  log.metadata.push_back({"fulmar", {{"mission", "</script><b>"}, {"epoch_ns", std::to_string(epoch_ns)}}});
  log.memory.push_back({std::byte{0}, std::byte{1}, std::byte{0}, std::byte{0}, std::byte{0xff}});
  const std::span<const std::byte> bytes(log.memory.back());
  for (std::uint64_t i = 0; i < 200; ++i) {
    const std::uint64_t now_ns = epoch_ns - 1'000'000'000 + i * 10'000'000;
    log.messages.push_back({1, 0, now_ns, now_ns, bytes});
    if (i >= 100 && i < 103) log.messages.push_back({2, 0, now_ns, now_ns, bytes.subspan(0, 4)});
    if (i == 5) log.messages.push_back({3, 0, now_ns, now_ns, bytes});
  }
  return log;
}

json parsed(double rate_hz) { return json::parse(report::log_json(log_of(), "one.mcap", rate_hz)); }

}  // namespace

TEST_CASE("what came more often than the rate is thinned out, what is rare is whole") {
  const json all = parsed(10);
  REQUIRE(all["topics"].size() == 2);  // the foreign encoding is left out
  const json &fast = all["topics"][0], &rare = all["topics"][1];
  CHECK(fast["topic"] == "/fast");
  CHECK(fast["count"] == 200);
  CHECK(fast["t"].size() == 20);
  CHECK(fast["t"][0] == -1.0);
  CHECK(fast["t"][1] == -0.9);
  CHECK(rare["t"] == json({0.0, 0.01, 0.02}));
  CHECK(all["begin_s"] == -1.0);
  CHECK(all["end_s"] == 0.99);
  CHECK(parsed(1000)["topics"][0]["t"].size() == 200);
}

TEST_CASE("messages lie behind their lengths, compressed, in base64") {
  const std::string one("\4\0\0\0\0\1\0\0", 8);  // the length, and a message of four bytes
  CHECK(parsed(10)["topics"][1]["data"] == report::base64(report::compressed(one + one + one)));
  const std::string small = report::compressed(std::string(1000, 'x'));
  CHECK(small.size() < 40);
  std::string back(1000, '\0');
  uLongf size = back.size();
  CHECK(::uncompress(reinterpret_cast<Bytef*>(back.data()), &size,
                     reinterpret_cast<const Bytef*>(small.data()), small.size()) == Z_OK);
  CHECK(back == std::string(1000, 'x'));
  CHECK(report::base64("") == "");
  CHECK(report::base64("f") == "Zg==");  // RFC 4648, section 10
  CHECK(report::base64("fo") == "Zm8=");
  CHECK(report::base64("foo") == "Zm9v");
  CHECK(report::base64("foobar") == "Zm9vYmFy");
  CHECK(report::base64("\xff\xfe") == "//4=");
}

TEST_CASE("no name in a log ends the element that holds it") {
  const std::string json_text = report::log_json(log_of(), "<!--", 10);
  const std::string html = report::with_log("<script>LOG_OF_THE_FLIGHT</script>", json_text);
  CHECK(html.find("</script><b>") == std::string::npos);
  CHECK(html.find("<!--") == std::string::npos);
  const std::string inside = html.substr(8, html.size() - 17);
  CHECK(json::parse(inside)["mission"] == "</script><b>");
  CHECK(json::parse(inside)["name"] == "<!--");
  CHECK_THROWS_WITH_AS(report::with_log("<p>", json_text), doctest::Contains("has no place for a log"),
                       core::Error);
}

TEST_CASE("a log without messages is a report without topics") {
  const json empty = json::parse(report::log_json(core::McapFile(), "none", 10));
  CHECK(empty["topics"].empty());
  CHECK(empty["mission"] == "");
  CHECK(empty["end_s"] == 0);
}

}  // namespace report_test

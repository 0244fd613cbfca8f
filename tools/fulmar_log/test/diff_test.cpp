// SPDX-License-Identifier: BSD-3-Clause
// Comparison of logs: equal ones, and each possible difference.
#include "tools/fulmar_log/diff.hpp"

#include <doctest/doctest.h>

#include "core/error.hpp"
#include "core/log/events.hpp"
#include "core/log/test/log_kit.hpp"
#include "tools/fulmar_log/figures.hpp"

namespace diff_test {

using namespace fulmar::core;
using namespace fulmar::core::test;

TEST_CASE("equal logs are equal, whatever their chunks and compression") {
  const Folder folder;
  write_sample({.file = folder.path / "a.mcap"}, 1000);
  write_sample({.file = folder.path / "b.mcap", .zstd_level = 0, .chunk_bytes = 5000}, 1000);
  const LogDiff d = diff_logs(folder.path / "a.mcap", folder.path / "b.mcap");
  CHECK(d.equal());
  CHECK_FALSE(d.first.has_value());
  CHECK(d.topics.at("/mixed").equal == 1000);
  CHECK(d.topics.at("/number").equal == 250);
}

TEST_CASE("the first tick and field that differ are named, with both values, and the messages counted") {
  const Folder folder;
  write_sample({.file = folder.path / "a.mcap"}, 1000);
  write_sample({.file = folder.path / "b.mcap"}, 1000, [](int i, Mixed& m) {
    if (i == 401) m.attitude_std_rad.east = 0.1;
    if (i >= 500 && i < 510) m.mode = 0;
  });
  const LogDiff d = diff_logs(folder.path / "a.mcap", folder.path / "b.mcap");
  CHECK_FALSE(d.messages_equal());
  REQUIRE(d.first.has_value());
  CHECK(d.first->topic == "/mixed");
  CHECK(d.first->field == "attitude_std_rad.east");
  CHECK(d.first->time_ns == 2'500'000);  // 401 ticks after -1 s
  CHECK(d.first->a == "1");
  CHECK(d.first->b == "0.1");
  CHECK(d.topics.at("/mixed").different == 11);
  CHECK(d.topics.at("/mixed").equal == 989);
  CHECK(d.topics.at("/number").different == 0);
}

TEST_CASE("an enum is told by its label, a list by the element that one of them does not have") {
  const Folder folder;
  write_sample({.file = folder.path / "a.mcap"}, 20);
  write_sample({.file = folder.path / "b.mcap"}, 20, [](int i, Mixed& m) { m.mode = i == 3 ? 0 : m.mode; });
  write_sample({.file = folder.path / "c.mcap"}, 20,
               [](int i, Mixed& m) { m.legs.count = i == 5 ? 1 : m.legs.count; });
  const LogDiff d = diff_logs(folder.path / "a.mcap", folder.path / "b.mcap");
  CHECK(d.first->field == "mode");
  CHECK(d.first->a == "hold");
  CHECK(d.first->b == "idle");
  const LogDiff e = diff_logs(folder.path / "a.mcap", folder.path / "c.mcap");
  CHECK(e.first->field == "legs[1].kind");
  CHECK(e.first->b == "absent");
}

TEST_CASE("samples of equal content that are valid at other times differ, and are told so") {
  const Folder folder;
  for (const bool other : {false, true}) {
    Sample sample({.file = folder.path / (other ? "b.mcap" : "a.mcap")});
    const std::uint16_t x = sample.channel("/x", *number_type());
    const Number n{1};
    for (int i = 0; i < 5; ++i) sample.write(x, i * 10'000, bytes_of(n), 0, other && i >= 2 ? 1001 : 1000);
    sample.writer.close();
  }
  const LogDiff d = diff_logs(folder.path / "a.mcap", folder.path / "b.mcap");
  CHECK_FALSE(d.messages_equal());
  CHECK(d.topics.at("/x").different == 3);
  REQUIRE(d.first.has_value());
  CHECK(d.first->topic == "/x");
  CHECK(d.first->field == "valid at");
  CHECK(d.first->time_ns == 20'000);
  CHECK(d.first->a == "1767225600000019000");
  CHECK(d.first->b == "1767225600000018999");
}

TEST_CASE("a message more, a topic more, other metadata, another attachment: each is told") {
  const Folder folder;
  write_sample({.file = folder.path / "a.mcap"}, 100);
  write_sample({.file = folder.path / "longer.mcap"}, 101);
  const LogDiff d = diff_logs(folder.path / "a.mcap", folder.path / "longer.mcap");
  CHECK_FALSE(d.messages_equal());
  CHECK(d.topics.at("/mixed").only_b == 1);
  REQUIRE(d.first.has_value());
  CHECK(d.first->time_ns == 100 * 2'500'000LL - 1'000'000'000);
  CHECK(d.first->a == "absent");

  for (const bool more : {false, true}) {
    Sample sample({.file = folder.path / (more ? "more.mcap" : "less.mcap")});
    const std::uint16_t x = sample.channel("/x", *number_type()), y = sample.channel("/y", *number_type());
    const Number n{1};
    sample.write(x, 0, bytes_of(n));
    if (more) sample.write(y, 0, bytes_of(n));
    sample.writer.metadata("run", {{"seed", more ? "7" : "8"}});
    sample.writer.attach("plan.yaml", "application/yaml", more ? "a: 1\nb: 2\n" : "a: 1\nb: 3\n", epoch_ns);
    sample.writer.close();
  }
  const LogDiff e = diff_logs(folder.path / "less.mcap", folder.path / "more.mcap");
  CHECK_FALSE(e.messages_equal());
  CHECK(e.only_b == std::vector<std::string>{"/y"});
  CHECK(e.only_a.empty());
  CHECK_FALSE(e.first.has_value());  // the common part is the same
  CHECK(e.metadata == std::vector<std::string>{"run: seed is 8 and 7"});
  CHECK(e.attachments == std::vector<std::string>{"log_tool.attachment_differs(plan.yaml, 2)"});
}

TEST_CASE(
    "what comes later than is asked for is not compared; what differs is counted in messages and bytes") {
  const Folder folder;
  write_sample({.file = folder.path / "a.mcap"}, 100);
  write_sample({.file = folder.path / "b.mcap"}, 110, [](int i, Mixed& m) {
    if (i == 40) m.count ^= 0x0101;  // two bytes
    if (i >= 50) m.mode = 0;
  });
  const auto after = [](int i) {
    return static_cast<std::uint64_t>(epoch_ns - 1'000'000'000 + i * 2'500'000LL);
  };
  const LogDiff none = diff_logs(folder.path / "a.mcap", folder.path / "b.mcap", {.last_ns = after(39)});
  CHECK(none.messages_equal());
  CHECK(none.messages == 40 + 10);
  CHECK(none.differing_messages == 0);
  const LogDiff one = diff_logs(folder.path / "a.mcap", folder.path / "b.mcap", {.last_ns = after(49)});
  CHECK(one.differing_messages == 1);
  CHECK(one.differing_bytes == 2);
  CHECK(one.first->field == "count");
}

TEST_CASE(
    "a topic that only one log has holds the first difference where that is asked for, and the hashes of the "
    "ticks never do") {
  const Folder folder;
  for (const bool other : {false, true}) {
    Sample sample({.file = folder.path / (other ? "b.mcap" : "a.mcap")});
    const std::uint16_t ticks = sample.channel("/fulmar/ticks", *host_type<Ticks>());
    const std::uint16_t x = sample.channel("/x", *number_type());
    const Ticks t{0, 0, 2, {0, 10}, 2, {1, other ? 3u : 2u}};
    sample.write(ticks, 10, bytes_of(t));
    const Number n{1};
    if (!other) sample.write(x, 20, bytes_of(n));
    sample.writer.close();
  }
  const LogDiff d = diff_logs(folder.path / "a.mcap", folder.path / "b.mcap");
  CHECK_FALSE(d.first.has_value());
  CHECK_FALSE(d.messages_equal());
  REQUIRE(d.first_tick.has_value());
  CHECK(d.first_tick->index == 1);
  CHECK(d.differing_messages == 1);
  const LogDiff e = diff_logs(folder.path / "a.mcap", folder.path / "b.mcap", {.whole_topics = true});
  CHECK(e.first->topic == "/x");
  CHECK(e.first->a == "a message");
  CHECK(e.first->b == "absent");
}

TEST_CASE("where the components differed without a message of it, the hash of the ticks tells the tick") {
  const Folder folder;
  for (const bool other : {false, true}) {
    Sample sample({.file = folder.path / (other ? "b.mcap" : "a.mcap")});
    const std::uint16_t ticks = sample.channel("/fulmar/ticks", *host_type<Ticks>());
    for (std::uint32_t i = 0; i < 3; ++i) {
      Ticks t{i * 4, i * 40, 4, {10, 10, 10, 10}, 4, {1, 2, 3, 4}};
      if (other && i == 1) {
        t.hash[2] = 9;
        t.period_ns[3] = 11;
      }
      sample.write(ticks, i * 40 + 30, bytes_of(t));
    }
    sample.writer.close();
  }
  const LogDiff d = diff_logs(folder.path / "a.mcap", folder.path / "b.mcap");
  REQUIRE(d.first_tick.has_value());
  CHECK(d.first_tick->index == 6);
  CHECK(d.first_tick->time_ns == 60);
}

TEST_CASE("a role's topic is the output of whoever flew then: by habit, by phase, or the fallback") {
  LogFigures f;
  f.components = {"slc", "tecs", "mine"};
  f.first = {{"outer", "slc"}};
  f.assigned["research"]["outer"] = "mine";
  f.changes = {{0, true, "cruise", ""},
               {10, true, "research", ""},
               {20, false, "mine", "tecs"},  // its guard fired
               {30, false, "mine", ""},      // and was reset
               {40, true, "cruise", ""}};
  const auto who = [&](std::int64_t at_ns) { return f.owner("/outer/attitude", at_ns); };
  CHECK(who(-1) == "slc");
  CHECK(who(5) == "slc");
  CHECK(who(10) == "mine");
  CHECK(who(25) == "tecs");
  CHECK(who(35) == "mine");
  CHECK(who(45) == "slc");
  CHECK(f.owner("/tecs/probes", 5) == "tecs");
  CHECK(f.owner("/fulmar/event", 5) == "");
  CHECK(f.owner("", 5) == "");
}

}  // namespace diff_test

// SPDX-License-Identifier: BSD-3-Clause
#include <doctest/doctest.h>

#include <ctime>

#include "core/sanitized.hpp"
#include "links/live/test/hub_fixture.hpp"

namespace hub_test {

using namespace fulmar::core;
using namespace fulmar::core::live;
using namespace fulmar::core::live::test;

namespace {

/// A hub without a client; /slc/leg need not publish in every step.
struct SilentPort {
  Tap tap{channels()};
  MockControl control;
  Counters counters;
  Hub hub{tap, control, counters};

  SilentPort() {
    hub.begin([] {});
  }
  static std::vector<TapChannel> channels() {
    std::vector<TapChannel> list = mock_channels();
    list[1].may_stay_silent = true;
    return list;
  }
};

}  // namespace

TEST_CASE_FIXTURE(Fixture, "a client gets the server's info, the channels and the services") {
  REQUIRE(peer.texts.size() == 3);
  const json& info = peer.texts[0];
  CHECK(info["op"] == "serverInfo");
  CHECK(info["capabilities"] ==
        json({"clientPublish", "parameters", "parametersSubscribe", "services", "connectionGraph", "time"}));
  CHECK(info["supportedEncodings"] == json({"cdr", "json"}));
  CHECK(info["metadata"]["mission"] == "mock <1>");
  const json& channels = peer.texts[1]["channels"];
  REQUIRE(channels.size() == 4);
  CHECK(channels[1]["topic"] == "/slc/leg");
  CHECK(channels[1]["encoding"] == "cdr");
  CHECK(channels[1]["schemaEncoding"] == "ros2msg");
  CHECK(channels[1]["schemaName"] == "fulmar_msgs/msg/Leg");
  CHECK(channels[1]["schema"].get<std::string>().find("float64 course_rad") != std::string::npos);
  const json& services = peer.texts[2]["services"];
  REQUIRE(services.size() == 13);
  CHECK(services[12]["name"] == "/plan/add_leg");
  CHECK(services[12]["type"] == "fulmar_msgs/srv/Leg");
  CHECK(services[12]["request"]["schemaName"] == "fulmar_msgs/msg/Leg");
  CHECK(services[12]["requestSchema"] == channels[1]["schema"]);
  CHECK(services[12]["responseSchema"] == "bool accepted\nstring reason\n");
  CHECK(services[0]["requestSchema"] == "string component\nstring name\nstring text\n");
}

TEST_CASE_FIXTURE(
    Fixture,
    "a subscriber gets the channel's samples with its own subscription id and UTC, nobody else does") {
  TestPeer other;
  hub.add(other);
  say({{"op", "subscribe"}, {"subscriptions", {{{"id", 77}, {"channelId", 2}}}}});
  for (int i = 0; i < 100; ++i) mock_tick(tap, i);
  hub.tick();
  std::vector<std::string> data, times;
  for (const std::string& b : peer.binaries) (b[0] == 1 ? data : times).push_back(b);
  REQUIRE(data.size() == 100);
  CHECK(u32(data[99], 1) == 77);
  CHECK(u64(data[99], 5) == 1'767'225'600'000'000'000u + 99 * 2'500'000u);
  CHECK(data[99].substr(13) == cdr_of(*leg_type(), Leg{1, true, 99 * 0.001, {1, 2, 3}}));
  REQUIRE(times.size() == 1);
  CHECK(times[0].size() == 9);
  CHECK(u64(times[0], 1) == 1'767'225'600'000'000'000u + 99 * 2'500'000u);
  for (const std::string& b : other.binaries) CHECK(b[0] == 2);
  CHECK(counters.sent == 100);

  say({{"op", "unsubscribe"}, {"subscriptionIds", {77}}});
  CHECK(tap.wanted(1, 1'000'000'000'000));  // at a low rate, for later clients
  CHECK_FALSE(tap.wanted(1, 1'000'099'000'000));
  CHECK(counters.refused == 0);
}

TEST_CASE_FIXTURE(Fixture, "the loop writes a channel for the live view while a client subscribes to it") {
  CHECK(tap.wanted(0, 0));
  CHECK_FALSE(tap.wanted(0, 99'000'000));  // ten per second, for later subscribers
  CHECK(tap.wanted(0, 100'000'000));
  CHECK(tap.wanted(3, 0));  // the clock, while there are clients
  TestPeer other;
  const Hub::ClientId second = hub.add(other);
  const std::string text =
      json({{"op", "subscribe"}, {"subscriptions", {{{"id", 1}, {"channelId", 1}}}}}).dump();
  hub.text(id, text);
  hub.text(second, text);
  CHECK(tap.wanted(0, 100'000'001));
  hub.remove(id);
  CHECK(tap.wanted(0, 100'000'002));
  hub.remove(second);
  CHECK_FALSE(tap.wanted(0, 100'000'003));
  CHECK_FALSE(tap.wanted(3, 3'000'000'000));
  CHECK(counters.clients == 0);
}

TEST_CASE_FIXTURE(
    SilentPort,
    "who subscribes late gets the last sample of a port that may stay silent, with its own time") {
  const auto publish = [&](std::int64_t now_ns, double course_rad) {
    REQUIRE(tap.wanted(1, now_ns));
    const Leg leg{1, true, course_rad, {1, 2, 3}};
    tap.write(1, now_ns, now_ns, bytes_of(leg), false);
  };
  publish(2'500'000, 0.25);
  publish(5'000'000, 0.5);  // before the first client
  const auto subscriber = [&](TestPeer& peer) {
    const Hub::ClientId id = hub.add(peer);
    hub.text(
        id,
        R"({"op": "subscribe", "subscriptions": [{"id": 7, "channelId": 2}, {"id": 8, "channelId": 1}]})");
    std::erase_if(peer.binaries, [](const std::string& b) { return b[0] != 1; });
    return id;
  };
  hub.tick();
  TestPeer first, second, third;
  const Hub::ClientId id = subscriber(first);
  REQUIRE(first.binaries.size() == 1);
  CHECK(u32(first.binaries[0], 1) == 7);
  CHECK(u64(first.binaries[0], 5) == 1'767'225'600'000'000'000u + 5'000'000u);
  CHECK(first.binaries[0].substr(13) == cdr_of(*leg_type(), Leg{1, true, 0.5, {1, 2, 3}}));
  hub.remove(id);

  publish(90'000'000'000, 0.75);  // the first one has gone
  hub.tick();
  subscriber(second);
  REQUIRE(second.binaries.size() == 1);
  CHECK(u64(second.binaries[0], 5) == 1'767'225'600'000'000'000u + 90'000'000'000u);
  CHECK(counters.sent == 2);
  CHECK(counters.lost == 0);
}

TEST_CASE_FIXTURE(
    SilentPort,
    "a port that may stay silent but does not is left to those who look: for others the loop copies it ten "
    "times a second") {
  int copied = 0;
  for (int i = 0; i < 4000; ++i) {
    copied += tap.wanted(1, i * 2'500'000LL);
    mock_tick(tap, i);
    hub.tick();
  }
  CHECK(copied < 1000);
  CHECK(tap.wanted(1, 20'000'000'000));
  CHECK_FALSE(tap.wanted(1, 20'099'000'000));
  TestPeer peer;
  const Hub::ClientId id = hub.add(peer);
  hub.text(id, R"({"op": "subscribe", "subscriptions": [{"id": 7, "channelId": 2}]})");
  CHECK(tap.wanted(1, 20'099'000'001));
}

TEST_CASE(
    "who comes while the flight is paused gets its last samples, but none that nobody publishes any more") {
  Tap tap(mock_channels());
  MockControl control;
  Counters counters;
  Hub hub(tap, control, counters);
  hub.begin([] {});
  const Leg leg{1, true, 0.5, {1, 2, 3}};
  const std::int64_t stopped_ns = 500'000'000, paused_ns = 1'600'000'000;
  for (std::int64_t now_ns = 0; now_ns <= paused_ns; now_ns += 2'500'000) {
    Mixed m = mixed_value();
    m.stamp_ns = now_ns;
    if (tap.wanted(0, now_ns)) tap.write(0, now_ns, now_ns, bytes_of(m), false);
    if (now_ns <= stopped_ns && tap.wanted(1, now_ns)) tap.write(1, now_ns, now_ns, bytes_of(leg), false);
    hub.tick();
  }
  const std::string subscribe =
      R"({"op": "subscribe", "subscriptions": [{"id": 7, "channelId": 2}, {"id": 8, "channelId": 1}]})";
  TestPeer early, peer;
  hub.text(hub.add(early), subscribe);
  CHECK(early.binaries.empty());  // the next sample comes soon
  control.paused = true;
  hub.text(hub.add(peer), subscribe);
  REQUIRE(peer.binaries.size() == 1);
  CHECK(u32(peer.binaries[0], 1) == 8);
  const std::uint64_t epoch_ns = 1'767'225'600'000'000'000u, stamp_ns = u64(peer.binaries[0], 5) - epoch_ns;
  CHECK(stamp_ns <= static_cast<std::uint64_t>(paused_ns));
  CHECK(stamp_ns > static_cast<std::uint64_t>(paused_ns) - 100'000'000u);
  Mixed last = mixed_value();
  last.stamp_ns = static_cast<std::int64_t>(stamp_ns);
  CHECK(peer.binaries[0].substr(13) == cdr_of(*mixed_type(), last));
}

TEST_CASE_FIXTURE(Fixture,
                  "the stream of who subscribes begins behind what lay in the ring, and has no gap") {
  Tap::Cursor log(tap);
  log.want(0, 500'000'000);
  mock_tick(tap, 0);
  mock_tick(tap, 200);  // one of many for the log
  hub.text(id, R"({"op": "subscribe", "subscriptions": [{"id": 7, "channelId": 1}]})");
  for (int i = 201; i < 220; ++i) mock_tick(tap, i);
  hub.tick();
  REQUIRE(peer.binaries.size() >= 19);
  std::vector<std::uint64_t> ticks;
  for (const std::string& b : peer.binaries)
    if (b[0] == 1) ticks.push_back((u64(b, 5) - 1'767'225'600'000'000'000u) / 2'500'000u);
  REQUIRE(ticks.size() == 19);
  for (std::size_t k = 0; k < ticks.size(); ++k) CHECK(ticks[k] == 201 + k);
}

TEST_CASE("a late subscriber gets as many of the last samples as a channel keeps, in their order") {
  std::vector<TapChannel> channels = mock_channels();
  channels[1].past = 3;
  Tap tap(channels);
  MockControl control;
  Counters counters;
  Hub hub(tap, control, counters);
  hub.begin([] {});
  for (int i = 0; i < 1000; ++i) {  // at any rate
    REQUIRE(tap.wanted(1, i * 1'000'000LL));
    const Leg leg{1, true, i * 0.001, {1, 2, 3}};
    tap.write(1, i * 1'000'000LL, 0, bytes_of(leg), false);
    hub.tick();
  }
  TestPeer peer;
  const Hub::ClientId id = hub.add(peer);
  hub.text(id, R"({"op": "subscribe", "subscriptions": [{"id": 7, "channelId": 2}]})");
  REQUIRE(peer.binaries.size() == 3);
  for (std::size_t k = 0; k < 3; ++k) {
    CHECK(u64(peer.binaries[k], 5) == 1'767'225'600'000'000'000u + 997'000'000u + k * 1'000'000u);
    CHECK(peer.binaries[k].substr(13) ==
          cdr_of(*leg_type(), Leg{1, true, static_cast<double>(997 + k) * 0.001, {1, 2, 3}}));
  }
}

TEST_CASE_FIXTURE(Fixture, "a slow client loses samples, is notified, and delays no other") {
  TestPeer quick;
  const Hub::ClientId second = hub.add(quick);
  const std::string text =
      json({{"op", "subscribe"}, {"subscriptions", {{{"id", 1}, {"channelId", 1}}}}}).dump();
  hub.text(id, text);
  hub.text(second, text);
  peer.room = 10;
  for (int i = 0; i < 50; ++i) mock_tick(tap, i);
  hub.tick();
  CHECK(peer.binaries.size() == 10);
  CHECK(quick.binaries.size() == 51);  // and the clock
  CHECK(counters.dropped == 40);
  CHECK(peer.last("status")->at("level") == 1);
  CHECK(peer.last_status() == "live.client_too_slow(40)");
  CHECK(quick.last("status") == nullptr);
}

TEST_CASE("a slow client gets each sample of a rare channel, and loses a burst") {
  std::vector<TapChannel> channels = mock_channels();
  channels[1].may_stay_silent = true;
  Tap tap(channels);
  MockControl control;
  Counters counters;
  Hub hub(tap, control, counters);
  hub.begin([] {});
  TestPeer peer;
  hub.text(hub.add(peer), R"({"op": "subscribe", "subscriptions": [{"id": 7, "channelId": 2}]})");
  peer.room = 0;
  const auto publish = [&](std::int64_t now_ns) {
    const Leg leg{1, true, static_cast<double>(now_ns), {1, 2, 3}};
    tap.write(1, now_ns, now_ns, bytes_of(leg), false);
    hub.tick();
  };
  for (int i = 0; i < 100; ++i) publish(i * 1'000'000'000LL);
  CHECK(peer.binaries.size() == 100);
  CHECK(counters.dropped == 0);
  for (int i = 1; i <= 100; ++i) publish(99'000'000'000LL + i * 2'500'000LL);
  CHECK(peer.binaries.size() == 120);
  CHECK(counters.dropped == 80);
  CHECK(counters.sent == 120);
}

TEST_CASE_FIXTURE(Fixture, "contradictory subscriptions are rejected one by one") {
  say({{"op", "subscribe"},
       {"subscriptions",
        {{{"id", 1}, {"channelId", 1}},
         {{"id", 1}, {"channelId", 2}},
         {{"id", 2}, {"channelId", 1}},
         {{"id", 3}, {"channelId", 0}},
         {{"id", 4}, {"channelId", 5}},
         {{"id", 5}, {"channelId", 2}}}}});
  CHECK(counters.refused == 4);
  CHECK(peer.last_status() == "live.channel_unknown(5)");
  CHECK(tap.wanted(1, 0));
  say({{"op", "unsubscribe"}, {"subscriptionIds", {1, 99}}});
  CHECK(peer.last_status() == "live.subscription_unknown(99)");
  CHECK(peer.closed == 0);
}

TEST_CASE_FIXTURE(Fixture, "parameters are read with their types") {
  say({{"op", "getParameters"}, {"parameterNames", json::array()}, {"id", "a"}});
  const json& reply = *peer.last("parameterValues");
  CHECK(reply["id"] == "a");
  CHECK(reply["parameters"] == json::parse(R"([
    {"name": "slc.roll_kp", "value": 0.55, "type": "float64"}, {"name": "slc.law", "value": "climb"}, {"name": "slc.note", "value": "40 deg"},
    {"name": "slc.wind", "value": [3.0, -4.0, 0.0], "type": "float64_array"}, {"name": "slc.count", "value": 7}, {"name": "slc.on", "value": true}])"));
  say({{"op", "getParameters"}, {"parameterNames", {"slc.law", "slc.roll_k"}}});
  CHECK(peer.last("parameterValues")->at("parameters").size() == 1);
  CHECK_FALSE(peer.last("parameterValues")->contains("id"));
  CHECK(peer.last_status().find("live.parameter_path_unknown(slc.roll_k,  [slc.roll_kp] ") == 0);
}

TEST_CASE_FIXTURE(Fixture,
                  "parameters are set in the words of a mission file and answered with what they are then") {
  say({{"op", "setParameters"},
       {"id", "s"},
       {"parameters",
        {{{"name", "slc.roll_kp"}, {"value", 0.7}},
         {{"name", "slc.wind"}, {"value", {1, 2.5, 0}}, {"type", "float64_array"}},
         {{"name", "slc.note"}, {"value", "20 deg"}},
         {{"name", "slc.law"}, {"value", "takeoff"}},
         {{"name", "slc.on"}, {"value", false}}}}});
  REQUIRE(until([&] { return peer.last("parameterValues") != nullptr; }));
  const std::vector<std::string> expected = {"set slc.roll_kp 0.7", "set slc.wind [1,2.5,0]",
                                             "set slc.note \"20 deg\"", "set slc.law takeoff",
                                             "set slc.on false"};
  CHECK(control.received() == expected);
  const json& reply = *peer.last("parameterValues");
  CHECK(reply["id"] == "s");
  CHECK(reply["parameters"].size() == 5);
  CHECK(reply["parameters"][0] == json({{"name", "slc.roll_kp"}, {"value", 0.7}, {"type", "float64"}}));
  CHECK(peer.last_status() == "live.parameter_overlaid(slc.law, cruise)");
}

TEST_CASE_FIXTURE(Fixture, "a parameter that cannot be set reports the reason, and its present value") {
  say({{"op", "setParameters"},
       {"id", "s"},
       {"parameters",
        {{{"name", "slc.roll_kp"}, {"value", 9}},
         {{"name", "scl.roll_kp"}, {"value", 1}},
         {{"name", "roll_kp"}, {"value", 1}},
         {{"name", "slc.roll_kp"}}}}});
  REQUIRE(until([&] { return peer.last("parameterValues") != nullptr; }));
  CHECK(peer.last("parameterValues")->at("parameters")[0]["value"] == 0.55);
  const auto noted = [&](const char* begin) {
    return std::any_of(peer.texts.begin(), peer.texts.end(), [&](const json& t) {
      return t["op"] == "status" && t["message"].get<std::string>().starts_with(begin);
    });
  };
  CHECK(noted("roll_kp: live.parameter_name_invalid( [] slc.roll_kp)"));
  CHECK(noted("slc.roll_kp: 9 is outside 0 .. 2 rad/rad"));
  CHECK(noted("slc.roll_kp: live.parameter_not_removable"));
  CHECK(noted("scl.roll_kp: mock.component_unknown(scl,  [slc] slc, plan)"));
  CHECK(counters.refused == 0);  // no rule of the protocol was violated
}

TEST_CASE_FIXTURE(Fixture, "a client that watches a parameter gets every change") {
  TestPeer watcher;
  const Hub::ClientId second = hub.add(watcher);
  hub.text(second,
           R"({"op": "subscribeParameterUpdates", "parameterNames": ["slc.roll_kp", "slc.nothing"]})");
  CHECK(watcher.last_status().find("live.parameter_path_unknown(slc.nothing, ") == 0);
  say({{"op", "setParameters"},
       {"parameters", {{{"name", "slc.roll_kp"}, {"value", 0.25}}, {{"name", "slc.on"}, {"value", true}}}}});
  REQUIRE(until([&] { return watcher.last("parameterValues") != nullptr; }));
  CHECK(watcher.last("parameterValues")->at("parameters") ==
        json::parse(R"([{"name": "slc.roll_kp", "value": 0.25, "type": "float64"}])"));
  CHECK(peer.last("parameterValues") == nullptr);  // it has not subscribed
  hub.text(second, R"({"op": "unsubscribeParameterUpdates", "parameterNames": []})");
  say({{"op", "setParameters"}, {"id", "x"}, {"parameters", {{{"name", "slc.roll_kp"}, {"value", 0.5}}}}});
  REQUIRE(until([&] { return peer.last("parameterValues") != nullptr; }));
  hub.tick();
  CHECK(watcher.count("parameterValues") == 1);
}

TEST_CASE_FIXTURE(Fixture,
                  "ten thousand sets in one go are all answered, and nothing more is read meanwhile") {
  json list = json::array();
  for (int i = 0; i < 10'000; ++i) list.push_back({{"name", "slc.roll_kp"}, {"value", i * 1e-4}});
  say({{"op", "setParameters"}, {"id", "many"}, {"parameters", list}});
  CHECK(hub.busy(id));
  REQUIRE(until([&] { return peer.last("parameterValues") != nullptr; }));
  CHECK_FALSE(hub.busy(id));
  CHECK(control.sets == 10'000);
  CHECK(peer.last("parameterValues")->at("parameters").back()["value"] == 0.9999);
}

TEST_CASE_FIXTURE(Fixture, "of a message with many faults ten are reported, without a loss of time") {
  json names = json::array(), sets = json::array(), channels = json::array();
  for (int i = 0; i < 40'000; ++i) {
    const std::string name = "a_name_of_a_parameter_" + std::to_string(i);
    names.push_back(name);
    sets.push_back({{"name", "slc." + name}, {"value", 1}});
    channels.push_back({{"id", i}, {"topic", name}, {"encoding", "cdr"}, {"schemaName", ""}});
  }
  const auto statuses = [this](const json& message) {
    peer.texts.clear();
    say(message);
    return peer.count("status");
  };
  const std::clock_t begin = std::clock();
  CHECK(statuses({{"op", "getParameters"}, {"parameterNames", names}, {"id", "x"}}) == 11);
  CHECK(peer.texts[0]["message"] ==
        "live.parameter_path_unknown(a_name_of_a_parameter_0,  [] slc.roll_kp, slc.law, slc.note, slc.wind, "
        "slc.count, slc.on)");
  CHECK(peer.last("parameterValues")->at("id") == "x");
  CHECK(peer.last_status() == "live.more_refused");
  CHECK(statuses({{"op", "subscribeParameterUpdates"}, {"parameterNames", names}}) == 11);
  CHECK(statuses({{"op", "advertise"}, {"channels", channels}}) == 11);
  CHECK(statuses({{"op", "setParameters"}, {"parameters", sets}}) == 1);
  CHECK(peer.last_status() == "live.too_many_parameters(10000)");
  CHECK(statuses({{"op", "unsubscribe"}, {"subscriptionIds", std::vector<int>(40'000, 7)}}) == 11);
  CHECK(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC < 5 * sanitizer_slowdown);
  CHECK(statuses({{"op", "getParameters"}, {"parameterNames", {"slc.roll_kb"}}}) == 1);
}

TEST_CASE_FIXTURE(Fixture, "the connection graph shows publishers, subscribers and services") {
  say({{"op", "subscribeConnectionGraph"}});
  const json& graph = *peer.last("connectionGraphUpdate");
  CHECK(
      graph["publishedTopics"] ==
      json::parse(
          R"([{"name": "/fulmar/ticks", "publisherIds": ["fulmar"]}, {"name": "/plan/mixed", "publisherIds": ["plan"]}, {"name": "/slc/leg", "publisherIds": ["slc"]}])"));
  CHECK(
      graph["subscribedTopics"] ==
      json::parse(
          R"([{"name": "/plan/edits", "subscriberIds": ["plan"]}, {"name": "/plan/mixed", "subscriberIds": ["slc"]}])"));
  CHECK(graph["advertisedServices"].back() == json({{"name", "/plan/add_leg"}, {"providerIds", {"plan"}}}));
}

TEST_CASE_FIXTURE(
    Fixture,
    "what is no message of the protocol is answered with a close, what it does not know with a status") {
  struct Bad {
    std::string text;
    int code;
  };
  const std::vector<Bad> texts = {
      {"", 1007},
      {"nonsense", 1007},
      {"[]", 1007},
      {"{}", 1007},
      {R"({"op": 5})", 1007},
      {R"({"op": "fly"})", 0},
      {R"({"op": "subscribe"})", 1007},
      {R"({"op": "subscribe", "subscriptions": 5})", 1007},
      {R"({"op": "subscribe", "subscriptions": [5]})", 1007},
      {R"({"op": "subscribe", "subscriptions": [{"id": -1, "channelId": 1}]})", 1007},
      {R"({"op": "subscribe", "subscriptions": [{"id": 1, "channelId": 4294967297}]})", 1007},
      {R"({"op": "subscribe", "subscriptions": [{"id": 1.5, "channelId": 1}]})", 1007},
      {R"({"op": "getParameters", "parameterNames": [1]})", 1007},
      {R"({"op": "getParameters", "parameterNames": [], "id": 5})", 1007},
      {R"({"op": "setParameters", "parameters": [{"value": 1}]})", 1007},
      {R"({"op": "setParameters", "parameters": {"a": 1}})", 1007},
      {R"({"op": "advertise", "channels": [{"id": 1, "topic": [], "encoding": "cdr"}]})", 1007},
      {"{\"op\": \"\xff\"}", 1007},
      {std::string(1'000'000, '['), 1007}};
  std::uint64_t refused = 0;
  for (const Bad& bad : texts) {
    CAPTURE(bad.text.substr(0, 100));
    peer.closed = 0;
    hub.text(id, bad.text);
    CHECK(peer.closed == bad.code);
    CHECK(counters.refused == ++refused);
  }
  for (const Bad& bad : std::vector<Bad>{{"", 1007},
                                         {"\1", 1007},
                                         {"\1abc", 1007},
                                         {"\2abc", 1007},
                                         {"\2" + le(1) + le(1) + le(50) + "json", 1007},
                                         {"\7", 0}}) {
    peer.closed = 0;
    hub.binary(id, bad.text);
    CHECK(peer.closed == bad.code);
    CHECK(counters.refused == ++refused);
  }
  CHECK(control.received().empty());
}

TEST_CASE_FIXTURE(Fixture, "answers for a client that has left are dropped") {
  say({{"op", "setParameters"}, {"id", "s"}, {"parameters", {{{"name", "slc.roll_kp"}, {"value", 1}}}}});
  call("/plan/add_leg", "json", "{}");
  hub.remove(id);
  TestPeer other;
  hub.add(other);
  REQUIRE(until([&] { return control.sets == 1; }));
  for (int i = 0; i < 20; ++i) hub.tick();
  CHECK(other.last("parameterValues") == nullptr);
  CHECK(other.binaries.empty());
  CHECK(peer.binaries.empty());
}

}  // namespace hub_test

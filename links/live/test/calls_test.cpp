// SPDX-License-Identifier: BSD-3-Clause
#include <doctest/doctest.h>

#include <cmath>

#include "links/live/test/hub_fixture.hpp"

namespace calls_test {

using namespace fulmar::core;
using namespace fulmar::core::live;
using namespace fulmar::core::live::test;

TEST_CASE_FIXTURE(Fixture, "a request is called in JSON and in CDR") {
  CHECK(call_json("/plan/add_leg", R"({"course_rad": 0.5})") == json({{"accepted", true}, {"reason", ""}}));
  CHECK(control.received().back() == "request plan.add_leg");
  CHECK(reinterpret_cast<const Leg*>(control.message().data())->course_rad == 0.5);
  CHECK(call_json("/plan/add_leg", R"({"kind": "orbit"})") ==
        json({{"accepted", false}, {"reason", "no orbits here"}}));

  const Leg leg{1, true, 0.25, {1, 2, 3}};
  const std::size_t before = peer.binaries.size();
  call("/plan/add_leg", "cdr", cdr_of(*leg_type(), leg));
  REQUIRE(until([&] { return peer.binaries.size() > before; }));
  const std::string cdr("\0\1\0\0\1\0\0\0\1\0\0\0\0", 13);  // header; true; one byte of text: NUL
  CHECK(peer.binaries.back().substr(13) == "cdr" + cdr);
  CHECK(control.message().size() == sizeof leg);
  CHECK(reinterpret_cast<const Leg*>(control.message().data())->course_rad == 0.25);
}

TEST_CASE_FIXTURE(Fixture,
                  "a request may hold much, as long as it is flat, and brackets in its texts are text") {
  std::string legs;
  for (int i = 0; i < 300; ++i)
    legs += std::string(i > 0 ? "," : "") + R"({"course_rad": 0.5, "limits": []})";
  const json many = call_json("/plan/add_leg", R"({"legs": [)" + legs + "]}"),
             brackets = call_json("/plan/add_leg", R"({"name": ")" + std::string(300, '[') + R"("})");
  CHECK(many["reason"].get<std::string>().find("graph.field_unknown(") != std::string::npos);
  CHECK(many["reason"].get<std::string>().find(", legs, ") != std::string::npos);
  CHECK(brackets["reason"].get<std::string>().find("graph.field_unknown(") != std::string::npos);
  CHECK(brackets["reason"].get<std::string>().find(", name, ") != std::string::npos);
  const std::string deep = R"({"legs": )" + std::string(100, '[') + std::string(100, ']') + "}";
  CHECK(call_json("/plan/add_leg", deep)["reason"] == "live.request_too_deep");
  CHECK(control.received().empty());
}

TEST_CASE_FIXTURE(Fixture, "invalid requests are answered, and do not reach the flight") {
  for (const char* payload : {"{", "[]", "5", "nonsense"})
    CHECK(call_json("/plan/add_leg", payload)["reason"] == "live.request_not_object");
  CHECK(call_json("/plan/add_leg", std::string(100'000, '['))["reason"] == "live.request_too_deep");
  Leg leg{1, true, 0.25, {1, 2, 3}};
  leg.course_rad = std::nan("");
  for (const std::string& payload : {std::string(), std::string("\0\1\0\0", 4), cdr_of(*leg_type(), leg),
                                     cdr_of(*leg_type(), Leg{7, true, 0, {}})}) {
    const std::size_t before = peer.binaries.size();
    call("/plan/add_leg", "cdr", payload);
    REQUIRE(until([&] { return peer.binaries.size() > before; }));
    CHECK(peer.binaries.back()[20] == 0);  // not accepted
  }
  CHECK(control.received().empty());
}

TEST_CASE_FIXTURE(Fixture, "the services of the host") {
  CHECK(call_json("/fulmar/set_parameter",
                  R"({"component": "slc", "name": "roll_kp", "text": "0.8"})")["accepted"] == true);
  CHECK(call_json("/fulmar/set_parameter",
                  R"({"component": "slc", "name": "roll_kp", "text": "20 kg"})")["reason"] ==
        "mock.number_invalid(20 kg)");
  CHECK(call_json("/fulmar/phase", R"({"phase": "hold"})")["accepted"] == true);
  CHECK(call_json("/fulmar/phase", R"({"phase": 5})")["reason"] == "live.request_text_missing(phase)");
  CHECK(call_json("/fulmar/swap", R"({"component": "slc", "file": "x.so"})")["reason"] ==
        "mock.vehicle_armed");
  CHECK(call_json("/fulmar/reset_guards", "")["accepted"] == true);
  CHECK(call_json("/fulmar/record", R"({"component": "slc", "name": "roll_kp"})")["reason"] ==
        "live.parameter_not_record(slc, roll_kp)");
  CHECK(
      call_json("/fulmar/record", R"({"component": "slc", "name": "fence"})")["reason"] ==
      "live.parameter_unknown(slc, fence,  [] slc.roll_kp, slc.law, slc.note, slc.wind, slc.count, slc.on)");
  CHECK(call_json("/fulmar/view", "{}")["paused"] == false);
  CHECK(call_json("/fulmar/pause", "{}")["accepted"] == true);
  CHECK(call_json("/fulmar/pause", "{}")["reason"] == "mock.paused_already");
  CHECK(call_json("/fulmar/view", "{}")["paused"] == true);
  CHECK(call_json("/fulmar/step", R"({"ticks": "40"})")["accepted"] == true);
  CHECK(call_json("/fulmar/step", R"({"ticks": "0"})")["reason"] == "tap.step_count_invalid(0, 1000000)");
  CHECK(call_json("/fulmar/step", "{}")["reason"] == "live.request_text_missing(ticks)");
  CHECK(call_json("/fulmar/resume", "{}")["accepted"] == true);
  CHECK(call_json("/fulmar/speed", R"({"speed": "max"})")["accepted"] == true);
  CHECK(call_json("/fulmar/speed", R"({"speed": "warp"})")["reason"] == "tap.speed_invalid(warp)");
  CHECK(call_json("/fulmar/restart", R"({"seed": "11"})")["accepted"] == true);
  CHECK(call_json("/fulmar/restart", R"({"seed": ""})")["accepted"] == true);
  CHECK(call_json("/fulmar/restart", R"({"seed": "eleven"})")["reason"] == "tap.seed_invalid(eleven)");
  const std::vector<std::string> expected = {
      "set slc.roll_kp 0.8", "phase hold", "swap slc x.so", "reset", "pause", "pause", "step 40", "resume",
      "speed max",           "restart 11", "restart"};
  CHECK(control.received() == expected);

  const json view = call_json("/fulmar/view", "{}");
  CHECK(view["phases"] == json({"hold", "cruise"}));
  CHECK(view["seed"] == "18000000000000000001");
  CHECK(view["origin"] == json({{"lat_deg", 40.25}, {"lon_deg", -111.65}, {"alt_msl_m", 1387.0}}));
  CHECK(view["tiles"] == "https://a.b/{z}/{x}/{y}");
  CHECK(view["attribution"] == "Example");
  CHECK(view["components"][0]["params"][0]["text"] == "0.8 rad/rad");
  CHECK(view["components"][0]["params"][0]["begun"] == 0.55);
  CHECK(view["components"][0]["params"][0]["value"] == 0.8);
  CHECK(view["components"][0]["params"][0]["max"] == 2.0);
  CHECK(view["components"][0]["steps"] == 42);
  CHECK(view["components"][0]["step_us"] == 3.5);
  CHECK(view["components"][0]["step_max_us"] == 9.0);
  CHECK(view["components"][0]["budget_us"] == 250.0);
  CHECK(view["components"][0]["outputs"][0] ==
        json({{"name", "leg"}, {"type", "fulmar_msgs/msg/Leg"}, {"topic", "/slc/leg"}}));
  CHECK(view["components"][1]["inputs"][0]["topic"] == "/plan/add_leg");
  CHECK(view["components"][1]["inputs"][1]["imported"] == true);
}

TEST_CASE_FIXTURE(Fixture, "the services of the host are called in CDR, too") {
  const auto text = [](const std::string& s) {  // padded to 4
    std::string out = le(static_cast<std::uint32_t>(s.size() + 1)) + s + std::string(1, '\0');
    return out + std::string((4 - out.size() % 4) % 4, '\0');
  };
  const std::string header("\0\1\0\0", 4);
  call("/fulmar/swap", "cdr", header + text("slc") + text("law.so"));
  REQUIRE(until([&] { return !peer.binaries.empty(); }));
  CHECK(control.received().back() == "swap slc law.so");
  const std::string reason = std::string("mock.vehicle_armed") + '\0';
  CHECK(peer.binaries.back().substr(16) == header + std::string(4, '\0') + le(19) + reason);
  for (const std::string& payload :
       {header, header + text("slc"), header + text("slc") + le(0xffffffff) + "law",
        text("slc") + text("x")}) {
    const std::size_t before = peer.binaries.size();
    call("/fulmar/swap", "cdr", payload);
    REQUIRE(until([&] { return peer.binaries.size() > before; }));
    CHECK(peer.binaries.back()[20] == 0);
  }
  CHECK(control.received().size() == 1);
}

TEST_CASE_FIXTURE(Fixture, "calls of unknown services fail") {
  hub.binary(id, "\2" + le(99) + le(5) + le(4) + "json{}");
  CHECK(*peer.last("serviceCallFailure") == json({{"op", "serviceCallFailure"},
                                                  {"serviceId", 99},
                                                  {"callId", 5},
                                                  {"message", "live.service_unknown(99)"}}));
  call("/fulmar/view", "ros1", "");
  CHECK(peer.last("serviceCallFailure")->at("message") == "live.encoding_unknown(ros1)");
  CHECK(counters.refused == 2);
}

TEST_CASE_FIXTURE(Fixture, "a client publishes into an imported input, in CDR and in JSON") {
  say({{"op", "advertise"},
       {"channels",
        {{{"id", 1}, {"topic", "/plan/edits"}, {"encoding", "cdr"}, {"schemaName", "fulmar_msgs/msg/Mixed"}},
         {{"id", 2}, {"topic", "/plan/edits"}, {"encoding", "json"}, {"schemaName", ""}}}}});
  const Mixed mixed = mixed_value();
  hub.binary(id, "\1" + le(1) + cdr_of(*mixed_type(), mixed));
  REQUIRE(control.received().size() == 1);
  CHECK(control.received()[0] == "publish plan.edits");
  CHECK(control.message().size() == sizeof mixed);
  CHECK(cdr_of(*mixed_type(), *reinterpret_cast<const Mixed*>(control.message().data())) ==
        cdr_of(*mixed_type(), mixed));
  hub.binary(id, "\1" + le(2) + R"({"armed": true, "speed_mps": 2.5, "mode": "hold"})");
  REQUIRE(control.received().size() == 2);
  CHECK(reinterpret_cast<const Mixed*>(control.message().data())->speed_mps == 2.5);
  CHECK(reinterpret_cast<const Mixed*>(control.message().data())->mode == 1);
  CHECK(counters.refused == 0);

  hub.binary(id, "\1" + le(1) + "short");
  CHECK(peer.last_status().find("/plan/edits: types.bytes_invalid(") == 0);
  hub.binary(id, "\1" + le(2) + R"({"sped_mps": 1})");
  CHECK(peer.last_status().find("sped_mps") != std::string::npos);
  say({{"op", "unadvertise"}, {"channelIds", {1}}});
  hub.binary(id, "\1" + le(1) + cdr_of(*mixed_type(), mixed));
  CHECK(peer.last_status() == "live.channel_not_advertised(1)");
  CHECK(counters.refused == 3);
  CHECK(control.received().size() == 2);
}

TEST_CASE_FIXTURE(Fixture, "only imports of the mission accept client samples") {
  const auto refusal = [&](const char* topic, const char* encoding, const char* schema) {
    say({{"op", "advertise"},
         {"channels", {{{"id", 1}, {"topic", topic}, {"encoding", encoding}, {"schemaName", schema}}}}});
    return peer.last_status();
  };
  CHECK(refusal("/plan/add_leg", "cdr", "").find("live.topic_not_imported(/plan/add_leg, ") == 0);
  CHECK(refusal("/plan/edits", "protobuf", "") == "/plan/edits: live.encoding_unknown(protobuf)");
  CHECK(refusal("/plan/edits", "cdr", "std_msgs/msg/String") ==
        "live.topic_type_differs(/plan/edits, fulmar_msgs/msg/Mixed, std_msgs/msg/String)");
  CHECK(counters.refused == 3);
}

}  // namespace calls_test

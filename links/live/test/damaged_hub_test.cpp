// SPDX-License-Identifier: BSD-3-Clause
// Random input from a client: nothing crashes, and its cost is bounded.
#include <doctest/doctest.h>
#include <unistd.h>

#include <iterator>
#include <random>

#include "core/test/limits.hpp"
#include "links/live/test/hub_fixture.hpp"

namespace damaged_hub_test {

using namespace fulmar::core;
using namespace fulmar::core::live;
using namespace fulmar::core::live::test;

TEST_CASE_FIXTURE(Fixture, "a thousand messages with flipped bytes crash nothing") {
  std::mt19937 random(5);
  const std::vector<std::string> good = {
      R"({"op": "subscribe", "subscriptions": [{"id": 1, "channelId": 1}]})",
      R"({"op": "setParameters", "parameters": [{"name": "slc.wind", "value": [1, 2, 3], "type": "float64_array"}]})",
      R"({"op": "advertise", "channels": [{"id": 1, "topic": "/plan/edits", "encoding": "cdr", "schemaName": ""}]})",
      "\2" + le(6) + le(1) + le(3) + "cdr" + cdr_of(*leg_type(), Leg{1, true, 0.5, {1, 2, 3}}),
      "\1" + le(1) + cdr_of(*mixed_type(), mixed_value())};
  say({{"op", "advertise"}, {"channels", {{{"id", 1}, {"topic", "/plan/edits"}, {"encoding", "cdr"}}}}});
  for (int i = 0; i < 1000; ++i) {
    std::string message = good[static_cast<std::size_t>(i) % good.size()];
    for (int flips = 1 + i % 3; flips > 0; --flips)
      message[random() % message.size()] ^= static_cast<char>(1u << random() % 8);
    if (i % 7 == 0) message.resize(random() % message.size());
    if (static_cast<std::size_t>(i) % good.size() < 3) {
      hub.text(id, message);
    } else {
      hub.binary(id, message);
    }
    hub.tick();
  }
  CHECK(counters.refused > 500);
  CHECK(call_json("/fulmar/phase", R"({"phase": "hold"})")["accepted"] == true);  // still alive
}

TEST_CASE("each altered message of a megabyte takes less than a gigabyte and five seconds") {
  std::mt19937 dice(7);
  const std::string ops[] = {"subscribe",     "unsubscribe",   "advertise",
                             "getParameters", "setParameters", "subscribeParameterUpdates"};
  const std::string lists[] = {"subscriptions", "subscriptionIds", "channels", "parameterNames",
                               "parameters"};
  const std::string items[] = {"1",
                               "\"slc.roll_kp\"",
                               "\"slc.rol_kp\"",
                               R"({"id":1,"channelId":2})",
                               R"({"name":"slc.roll_kp","value":1})",
                               R"({"name":"slc.x","value":[1]})",
                               R"({"id":1,"topic":"/plan/edits","encoding":"json","schemaName":""})",
                               "[[[",
                               "null"};
  for (int i = 0; i < costly_mutants(); ++i) {
    std::string text =
        "{\"op\":\"" + ops[dice() % std::size(ops)] + "\",\"" + lists[dice() % std::size(lists)] + "\":[";
    const std::string& item = items[dice() % std::size(items)];
    while (text.size() < 1'000'000) text += item + ",";
    text += item + "]}";
    for (auto n = dice() % 3; n > 0; --n) text[dice() % text.size()] = static_cast<char>(dice());
    CAPTURE(i);
    CHECK(within_limits([&] {
      Fixture flight;
      flight.hub.text(flight.id, text);
      flight.hub.tick();
      ::_exit(0);  // without the end of the flight
    }));
  }
}

}  // namespace damaged_hub_test

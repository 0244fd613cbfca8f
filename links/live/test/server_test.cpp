// SPDX-License-Identifier: BSD-3-Clause
// Over real sockets: handshakes, limits, a client that does not read, raw frames that violate the rules.
#include "core/error.hpp"
#include "core/types/wire.hpp"
#include "links/live/test/server_fixture.hpp"

namespace server_test {

using namespace fulmar::core::live_server;

namespace {

std::string handshake(const std::string& extra = "") {
  return "GET / HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nConnection: "
         "Upgrade\r\nSec-WebSocket-Version: 13\r\n"
         "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Protocol: foxglove.websocket.v1\r\n" +
         extra + "\r\n";
}

}  // namespace

TEST_CASE_FIXTURE(Fixture, "a port in use is reported with a remedy") {
  serve();
  LiveOptions same = options;
  same.port = server->port();
  CHECK_THROWS_WITH_AS(
      LiveServer(tap, control, same),
      doctest::Contains(("live.port_in_use(" + same.host + ", " + std::to_string(same.port) + ")").c_str()),
      Error);
  same.host = "plane";
  CHECK_THROWS_WITH_AS(LiveServer(tap, control, same), doctest::Contains("graph.live_token_missing(plane)"),
                       Error);
  same.host = "0.0.0.0";
  CHECK_THROWS_WITH_AS(LiveServer(tap, control, same), doctest::Contains("graph.live_token_missing(0.0.0.0)"),
                       Error);
  same = options;
  same.host = "192.0.2.1";  // an address for documentation
  const std::string foreign = std::make_error_code(std::errc::address_not_available).message();
  same.token = "x";
  CHECK_THROWS_WITH_AS(LiveServer(tap, control, same),
                       doctest::Contains(("live.listen_failed(192.0.2.1, 0, " + foreign + ")").c_str()),
                       Error);
}

TEST_CASE_FIXTURE(Fixture, "a browser gets a page that loads nothing else") {
  serve();
  const Answer page = get("/");
  CHECK(page.status == 200);
  CHECK(page.content_type == "text/html; charset=utf-8");
  CHECK(page.body.find(mock_heading) != std::string::npos);
  CHECK(page.body.find("<td>/slc/leg<td>fulmar_msgs/msg/Leg") != std::string::npos);
  for (const char* word : {"src=", "href=", "url(", "http://", "https://", "<script"})
    CHECK(page.body.find(word) == std::string::npos);
  CHECK(get("/", {}, http::verb::head).status == 200);
  CHECK(server->stats().refused == 0);
}

TEST_CASE_FIXTURE(Fixture, "requests against the rules are rejected and counted") {
  serve();
  CHECK(get("/etc/passwd").status == 404);
  CHECK(get("/", {}, http::verb::post).status == 405);
  CHECK(get("/", {{"Host", "evil.example"}}).status == 403);
  CHECK(get("/", {{"Origin", "http://evil.example"}}).status == 403);
  CHECK(raw("GET / HTTP/1.1\r\n\r\n").find("400") != std::string::npos);
  CHECK(raw("GET / HTTP/1.1\r\nHost: localhost\r\nHost: evil.example\r\n\r\n").find("400") !=
        std::string::npos);
  CHECK(raw("nonsense\r\n\r\n").empty());
  CHECK(raw(handshake() + "too early").find("400") != std::string::npos);
  CHECK(raw("GET / HTTP/1.1\r\nHost: localhost\r\nX: " + std::string(100'000, 'x') + "\r\n\r\n").empty());
  CHECK(server->stats().refused == 9);
  CHECK(get("/").status == 200);
}

TEST_CASE_FIXTURE(Fixture, "with a token the page and the protocol are for clients that have it") {
  serve("abc", "0.0.0.0");
  CHECK(get("/").status == 401);
  CHECK(get("/?token=abd").status == 401);
  CHECK(get("/?token=abc", {{"Host", "plane.example"}, {"Origin", "https://viewer.example"}}).status == 200);
  CHECK_THROWS(Client(*this));
  CHECK(Client(*this, "foxglove.sdk.v1", "/?token=abc").next("serverInfo")["name"] == "Fulmar: mock <1>");
  CHECK(Client(*this, "foxglove.sdk.v1", "/", {{"Authorization", "Bearer abc"}})
            .next("advertise")["channels"]
            .size() == 4);
}

TEST_CASE_FIXTURE(Fixture, "a guesser of tokens is delayed, and counted") {
  serve("abc", "0.0.0.0");
  for (int i = 0; i < 30; ++i) get("/?token=" + std::to_string(i));
  CHECK(get("/?token=abc").status == 429);
  CHECK(server->stats().wrong_tokens >= 11);
  CHECK(server->stats().wrong_tokens < 30);
  CHECK(until([&] { return get("/?token=abc").status == 200; }));
}

TEST_CASE_FIXTURE(Fixture, "idle connections do not block a client") {
  serve();
  net::io_context io;
  std::vector<net::ip::tcp::socket> idle;
  for (int i = 0; i < 200; ++i) idle.push_back(connect(io));
  CHECK(get("/").status == 200);  // within their time-out of five seconds
  CHECK(Client(*this).next("serverInfo")["name"] == "Fulmar: mock <1>");
}

TEST_CASE_FIXTURE(Fixture, "both names of the protocol are accepted, others are rejected") {
  serve();
  CHECK(Client(*this, "foxglove.sdk.v1").protocol == "foxglove.sdk.v1");
  CHECK(Client(*this, "foxglove.websocket.v1").protocol == "foxglove.websocket.v1");
  CHECK(Client(*this, "foxglove.websocket.v1, foxglove.sdk.v1").protocol == "foxglove.sdk.v1");
  CHECK_THROWS(Client(*this, "mqtt"));
  CHECK_THROWS(Client(*this, "foxglove.sdk.v1", "/other"));
  CHECK_THROWS(Client(*this, "foxglove.sdk.v1", "/", {{"Origin", "https://evil.example"}}));
  CHECK(server->stats().refused == 3);
}

TEST_CASE_FIXTURE(Fixture, "two clients get every sample of their subscriptions") {
  serve();
  Client a(*this), b(*this);
  for (Client* c : {&a, &b}) c->say(R"({"op": "subscribe", "subscriptions": [{"id": 3, "channelId": 2}]})");
  const auto subscribed = [&](Client& c) {  // the answer to a later message
    c.say(R"({"op": "getParameters", "parameterNames": ["slc.on"]})");
    c.next("parameterValues");
  };
  subscribed(a);
  subscribed(b);
  for (int i = 0; i < 2000; ++i) mock_tick(tap, i);
  for (Client* c : {&a, &b}) {
    std::int64_t expected = 0;
    while (expected < 2000) {
      const std::string message = c->next();
      if (c->ws.got_text() || message[0] != 1) continue;
      std::uint64_t ns = 0;
      std::memcpy(&ns, message.data() + 5, sizeof ns);
      REQUIRE(ns == 1'767'225'600'000'000'000u + static_cast<std::uint64_t>(expected++) * 2'500'000u);
    }
  }
  CHECK(server->stats().sent == 4000);
  CHECK(server->stats().dropped == 0);
  CHECK(server->stats().lost == 0);
  CHECK(server->stats().clients == 2);
}

TEST_CASE(
    "a plan that was published long before anybody connected is not lost when the ring has gone round") {
  std::vector<TapChannel> channels = mock_channels();
  channels[1].may_stay_silent = true;
  Fixture f(channels, 1u << 16);
  f.serve();
  const Leg plan{1, true, 0.25, {1, 2, 3}};
  REQUIRE(f.tap.wanted(1, 0));
  f.tap.write(1, 0, 0, bytes_of(plan), false);
  const Mixed other = mixed_value();
  for (std::int64_t now_ns = 0; f.tap.written() < 4 * f.tap.ring_bytes(); now_ns += 2'500'000) {
    f.tap.write(0, now_ns, now_ns, bytes_of(other), true);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  Client late(f);
  late.say(R"({"op": "subscribe", "subscriptions": [{"id": 7, "channelId": 2}]})");
  std::string message;
  do message = late.next();
  while (late.ws.got_text() || message[0] != 1);
  std::uint64_t ns = 0;
  std::memcpy(&ns, message.data() + 5, sizeof ns);
  CHECK(ns == 1'767'225'600'000'000'000u);
  std::vector<std::byte> expected;
  CdrEncoder(*leg_type()).encode(bytes_of(plan), expected);
  CHECK(message.substr(13) == std::string(reinterpret_cast<const char*>(expected.data()), expected.size()));
}

TEST_CASE_FIXTURE(Fixture, "a client that does not read loses samples and does not affect the others") {
  serve();
  Client stuck(*this), quick(*this);
  for (Client* c : {&stuck, &quick}) {
    c->say(R"({"op": "subscribe", "subscriptions": [{"id": 3, "channelId": 1}]})");
    c->say(R"({"op": "getParameters", "parameterNames": ["slc.on"]})");
    c->next("parameterValues");
  }
  std::uint64_t got = 0;
  int tick = 0;
  while (server->stats().dropped == 0 && tick < 1'000'000) {  // some MB: the queue and the kernel's buffer
    for (const int end = tick + 200; tick < end; ++tick) mock_tick(tap, tick);
    while (got < static_cast<std::uint64_t>(tick)) {
      const std::string message = quick.next();
      if (!quick.ws.got_text() && message[0] == 1) ++got;
    }
  }
  CHECK(server->stats().dropped > 0);
  CHECK(got == static_cast<std::uint64_t>(tick));
  const json reported = stuck.next("status");  // now it reads
  CHECK(reported["level"] == 1);
  CHECK(reported["message"].get<std::string>().find("live.client_too_slow(") != std::string::npos);
}

TEST_CASE_FIXTURE(Fixture, "messages that violate the protocol close the connection with their code") {
  serve();
  const auto code = [&](const std::string& text, bool binary) {
    Client client(*this);
    client.ws.binary(binary);
    client.ws.write(net::buffer(text));
    return client.closed();
  };
  CHECK(code("nonsense", false) == 1007);
  CHECK(code("\1x", true) == 1007);
  CHECK(code(std::string((1u << 20) + 1, ' '), false) == 1009);
  CHECK(until([&] { return server->stats().refused == 3 && server->stats().clients == 0; }));
}

TEST_CASE_FIXTURE(Fixture, "frames that violate the rules end the connection and are counted") {
  serve();
  const std::string mask("\1\2\3\4", 4);
  const std::vector<std::string> frames = {
      std::string("\x81\x02{}", 4),                                        // not masked
      std::string("\x83\x80", 2) + mask,                                   // reserved op
      std::string("\xc1\x80", 2) + mask,                                   // reserved bit
      std::string("\x80\x80", 2) + mask,                                   // continues nothing
      std::string("\x89\xfe\x00\x7e", 4) + mask,                           // a long ping
      std::string("\x81\xff\xff\xff\xff\xff\xff\xff\xff\xff", 10) + mask,  // 2^64 - 1 bytes
      std::string("\x81\x81", 2) + mask + "\xfe"};                         // no UTF-8
  for (const std::string& frame : frames) {
    CAPTURE(frame.size());
    net::io_context io;
    net::ip::tcp::socket socket = connect(io);
    net::write(socket, net::buffer(handshake()));
    std::string answer;
    net::read_until(socket, net::dynamic_buffer(answer), "\r\n\r\n");
    CHECK(answer.find("101 Switching Protocols") != std::string::npos);
    net::write(socket, net::buffer(frame));
    boost::system::error_code ec;
    net::read(socket, net::dynamic_buffer(answer), ec);  // up to the end of the connection
    CHECK(ec == net::error::eof);
  }
  CHECK(until([&] { return server->stats().refused == frames.size() && server->stats().clients == 0; }));
}

TEST_CASE_FIXTURE(Fixture, "the seventeenth client is rejected, and accepted when another one leaves") {
  serve();
  std::vector<std::unique_ptr<Client>> clients;
  for (int i = 0; i < 16; ++i) clients.push_back(std::make_unique<Client>(*this));
  CHECK_THROWS(Client(*this));
  CHECK(server->stats().clients == 16);
  clients.pop_back();
  REQUIRE(until([&] { return server->stats().clients == 15; }));
  CHECK(Client(*this).next("serverInfo")["op"] == "serverInfo");
}

TEST_CASE_FIXTURE(Fixture, "thousands of single sets are all answered") {
  serve();
  Client script(*this);
  for (int i = 0; i < 5000; ++i)
    script.say(R"({"op": "setParameters", "id": "x", "parameters": [{"name": "slc.roll_kp", "value": )" +
               std::to_string(i) + "e-4}]}");
  for (int i = 0; i < 5000; ++i) script.next("parameterValues");
  CHECK(control.sets == 5000);
  script.say(R"({"op": "getParameters", "parameterNames": ["slc.roll_kp"]})");
  CHECK(script.next("parameterValues")["parameters"][0]["value"] == 0.4999);
}

TEST_CASE_FIXTURE(Fixture, "clients are notified at the end of the flight") {
  serve();
  Client client(*this);
  client.next("advertiseServices");
  client.say(R"({"op": "subscribe", "subscriptions": [{"id": 3, "channelId": 2}]})");
  client.say(R"({"op": "getParameters", "parameterNames": ["slc.on"]})");
  client.next("parameterValues");
  for (int i = 0; i < 100; ++i) mock_tick(tap, i);
  std::thread end([&] { server.reset(); });
  int data = 0;
  boost::system::error_code ec;
  for (;;) {
    beast::flat_buffer buffer;
    client.ws.read(buffer, ec);
    if (ec) break;
    data += !client.ws.got_text() && *static_cast<const char*>(buffer.data().data()) == 1;
  }
  end.join();
  CHECK(data == 100);  // pending data comes first
  CHECK(client.ws.reason().code == 1001);
}

TEST_CASE_FIXTURE(Fixture, "a server with a stuck client and an incomplete handshake still ends") {
  serve();
  Client stuck(*this);
  net::io_context io;
  net::ip::tcp::socket half = connect(io);
  net::write(half, net::buffer(std::string("GET / HTTP/1.1\r\nHost: ")));
  REQUIRE(until([&] { return server->stats().clients == 1; }));
  const auto begin = std::chrono::steady_clock::now();
  server.reset();
  CHECK(std::chrono::steady_clock::now() - begin < std::chrono::seconds(15));
}

}  // namespace server_test

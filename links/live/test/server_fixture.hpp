// SPDX-License-Identifier: BSD-3-Clause
// A live view over real sockets, and blocking clients.
#pragma once
#include <doctest/doctest.h>

#include <boost/asio/connect.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/read_until.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "links/live/server.hpp"
#include "links/live/test/mock.hpp"

namespace fulmar::core::live_server {

using namespace fulmar::core;
using namespace fulmar::core::test;
using nlohmann::json;
namespace net = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;

using Headers = std::map<std::string, std::string>;

/// Of the page with the topics of the mission "mock <1>".
inline constexpr const char* mock_heading = "<h1>mock &lt;1&gt;</h1>";

struct Answer {
  unsigned status = 0;
  std::string body, content_type;
};

struct Fixture {
  Tap tap;
  MockControl control;
  LiveOptions options;
  std::optional<LiveServer> server;

  explicit Fixture(const std::vector<TapChannel>& channels = mock_channels(),
                   std::size_t ring_bytes = 8u << 20)
      : tap(channels, ring_bytes) {}

  void serve(const std::string& token = "", const std::string& host = "127.0.0.1") {
    options.host = host;
    options.port = 0;
    options.token = token;
    server.emplace(tap, control, options);
  }

  net::ip::tcp::socket connect(net::io_context& io) const {
    net::ip::tcp::socket socket(io);
    socket.connect({net::ip::make_address("127.0.0.1"), server->port()});
    return socket;
  }

  Answer get(const std::string& target, const Headers& headers = {},
             http::verb verb = http::verb::get) const {
    net::io_context io;
    net::ip::tcp::socket socket = connect(io);
    http::request<http::empty_body> request(verb, target, 11);
    request.set(http::field::host, "localhost");
    for (const auto& [name, value] : headers) request.set(name, value);
    http::write(socket, request);
    beast::flat_buffer buffer;
    http::response_parser<http::string_body> response;
    response.skip(verb == http::verb::head);
    http::read(socket, buffer, response);
    const auto type = response.get()[http::field::content_type];
    return {response.get().result_int(), response.get().body(), std::string(type.data(), type.size())};
  }

  /// Sends raw bytes and returns the answer up to the end of the connection.
  std::string raw(const std::string& bytes) const {
    net::io_context io;
    net::ip::tcp::socket socket = connect(io);
    boost::system::error_code ec;
    net::write(socket, net::buffer(bytes), ec);  // the server may close before the end
    std::string answer;
    net::read(socket, net::dynamic_buffer(answer), ec);
    return answer;
  }

  template <class So>
  static bool until(const So& so) {
    for (int i = 0; i < 1000 && !so(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    return so();
  }
};

/// A blocking client.
struct Client {
  net::io_context io;
  websocket::stream<net::ip::tcp::socket> ws;
  std::string protocol;

  explicit Client(const Fixture& f, const std::string& offered = "foxglove.sdk.v1",
                  const std::string& target = "/", const Headers& headers = {})
      : ws(f.connect(io)) {
    ws.read_message_max(64u << 20);
    ws.set_option(websocket::stream_base::decorator([&](websocket::request_type& request) {
      request.set(http::field::sec_websocket_protocol, offered);
      for (const auto& [name, value] : headers) request.set(name, value);
    }));
    websocket::response_type response;
    ws.handshake(response, "localhost", target);
    const auto chosen = response[http::field::sec_websocket_protocol];
    protocol.assign(chosen.data(), chosen.size());
  }
  void say(const std::string& text) {
    ws.text(true);
    ws.write(net::buffer(text));
  }
  /// The next message; binary ones begin with their op.
  std::string next() {
    beast::flat_buffer buffer;
    ws.read(buffer);
    return beast::buffers_to_string(buffer.data());
  }
  json next(const std::string& op) {
    for (;;) {
      const std::string message = next();
      if (!ws.got_text()) continue;
      const json parsed = json::parse(message);
      if (parsed["op"] == op) return parsed;
    }
  }
  /// Reads until the server closes; returns the close code.
  int closed() {
    boost::system::error_code ec;
    while (!ec) {
      beast::flat_buffer buffer;
      ws.read(buffer, ec);
    }
    return ws.reason().code;
  }
};

}  // namespace fulmar::core::live_server

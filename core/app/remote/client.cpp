// SPDX-License-Identifier: BSD-3-Clause
// The only file of the command line that knows Boost.Beast. Its blocking calls know no time limit, so the asynchronous ones are run here.
#include "core/app/remote/client.hpp"

#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <charconv>

#include "core/error.hpp"

namespace fulmar::core {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = beast::websocket;
using boost::system::error_code;

std::string LiveAddress::text() const {
  return (host.find(':') == std::string::npos ? host : "[" + host + "]") + ":" + std::to_string(port);
}

LiveAddress parse_target(const std::string& at, const std::string& token) {
  LiveAddress target;
  target.token = token;
  std::string host = at, port;
  const std::size_t bracket = at.rfind(']'), colon = at.rfind(':');
  const bool bare_v6 = bracket == std::string::npos && colon != at.find(':');  // ::1
  if (colon != std::string::npos && !bare_v6 && (bracket == std::string::npos || colon > bracket)) {
    host = at.substr(0, colon);
    port = at.substr(colon + 1);
    const auto [end, code] = std::from_chars(port.data(), port.data() + port.size(), target.port);
    if (code != std::errc{} || end != port.data() + port.size() || target.port == 0)
      throw Error("'" + at + "': '" + port + "' is no port; give HOST:PORT, as in 127.0.0.1:8765");
  }
  std::uint16_t only = 0;  // a port alone
  if (const auto [end, code] = std::from_chars(at.data(), at.data() + at.size(), only);
      code == std::errc{} && end == at.data() + at.size() && only != 0) {
    target.port = only;
    return target;
  }
  if (host.size() > 1 && host.front() == '[' && host.back() == ']') host = host.substr(1, host.size() - 2);
  if (!host.empty()) target.host = host;
  return target;
}

struct Client::Impl {
  LiveAddress target;
  std::chrono::milliseconds patience;
  asio::io_context context{1};
  websocket::stream<beast::tcp_stream> stream{context};
  beast::flat_buffer buffer;
  websocket::response_type response;
  bool reading = false, read_done = false;
  error_code read_fault;

  Impl(const LiveAddress& t, std::chrono::milliseconds p) : target(t), patience(p) {}

  /// Runs what `start` has begun; it says through `done` that it is over. False when the time was up.
  template <class Duration>
  bool run_until(const bool& done, Duration limit) {
    const auto end = std::chrono::steady_clock::now() + limit;
    while (!done) {
      const auto left = end - std::chrono::steady_clock::now();
      context.restart();
      if (left <= left.zero()) return context.poll(), done;
      if (context.run_one_for(left) == 0 && context.stopped() && !done) return false;
    }
    return true;
  }

  /// The fault of one operation; timed_out when it took too long.
  template <class Start>
  error_code wait(Start start) {
    bool done = false;
    error_code fault;
    start([&](error_code code, auto&&...) { done = true, fault = code; });
    if (run_until(done, patience)) return fault;
    beast::get_lowest_layer(stream).close();  // its handler still refers to what lies here
    while (!done && context.run_one_for(std::chrono::seconds(1)) > 0) {
    }
    return asio::error::timed_out;
  }

  [[noreturn]] void nobody() const {
    throw Error("no flight listens on " + target.text() +
                ": start one with fulmar run MISSION --speed real --live 8765, or name it with --at");
  }

  void connect() {
    asio::ip::tcp::resolver resolver(context);
    error_code fault;
    const auto places = resolver.resolve(target.host, std::to_string(target.port), fault);
    if (fault) throw Error("there is no host '" + target.host + "': give --at HOST:PORT, as in --at 127.0.0.1:8765");
    fault = wait([&](auto done) { beast::get_lowest_layer(stream).async_connect(places, done); });
    if (fault) nobody();
    beast::get_lowest_layer(stream).socket().set_option(asio::ip::tcp::no_delay(true), fault);
  }

  void shake_hands() {
    stream.read_message_max(64u << 20);
    stream.set_option(websocket::stream_base::decorator([this](websocket::request_type& request) {
      request.set(beast::http::field::sec_websocket_protocol, "foxglove.sdk.v1, foxglove.websocket.v1");
      request.set(beast::http::field::user_agent, "fulmar");
      if (!target.token.empty()) request.set(beast::http::field::authorization, "Bearer " + target.token);
    }));
    const error_code fault = wait([&](auto done) { stream.async_handshake(response, target.text(), "/", done); });
    if (!fault) return;
    if (fault != websocket::error::upgrade_declined)
      throw Error("what listens on " + target.text() + " is no flight (" + fault.message() + "): name one with --at");
    if (response.result() == beast::http::status::unauthorized || response.result() == beast::http::status::forbidden)
      throw Error("the flight on " + target.text() + (target.token.empty() ? " wants a token" : " refuses this token") +
                  ": give it with --token or in FULMAR_TOKEN");
    throw Error("the flight on " + target.text() + " refuses the connection: " + std::to_string(response.result_int()) + " " +
                std::string(response.reason()));
  }

  void start_reading() {
    if (reading) return;
    reading = true, read_done = false;
    stream.async_read(buffer, [this](error_code code, std::size_t) { read_done = true, read_fault = code; });
  }

  void write(const std::string& data, bool binary) {
    stream.binary(binary);
    const error_code fault = wait([&](auto done) { stream.async_write(asio::buffer(data), done); });
    if (fault) gone(fault);
  }

  [[noreturn]] void gone(error_code fault) const {
    if (fault == websocket::error::closed && !stream.reason().reason.empty())
      throw FlightEnded("the flight on " + target.text() + " has closed the connection: " + std::string(stream.reason().reason.c_str()));
    throw FlightEnded("the flight on " + target.text() + " has ended");
  }
};

Client::Client(const LiveAddress& target, std::chrono::milliseconds patience) : impl_(std::make_unique<Impl>(target, patience)) {
  impl_->connect();
  impl_->shake_hands();
}

Client::~Client() {
  error_code fault;
  beast::get_lowest_layer(impl_->stream).socket().shutdown(asio::ip::tcp::socket::shutdown_both, fault);
  beast::get_lowest_layer(impl_->stream).close();
  impl_->context.restart();
  impl_->context.run_for(std::chrono::milliseconds(100));  // the handlers that are left refer to impl_
}

std::optional<Client::Message> Client::receive(std::chrono::milliseconds limit) {
  impl_->start_reading();
  if (!impl_->run_until(impl_->read_done, limit)) return std::nullopt;
  impl_->reading = false;
  if (impl_->read_fault) impl_->gone(impl_->read_fault);
  Message message{impl_->stream.got_binary(), beast::buffers_to_string(impl_->buffer.data())};
  impl_->buffer.consume(impl_->buffer.size());
  return message;
}

void Client::send(const std::string& text) { impl_->write(text, false); }
void Client::send_binary(const std::string& bytes) { impl_->write(bytes, true); }

}  // namespace fulmar::core

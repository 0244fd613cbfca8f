// SPDX-License-Identifier: BSD-3-Clause
// See client.hpp.
#include "tools/fulmar_live/client.hpp"

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core/buffers_to_string.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/websocket/stream.hpp>
#include <charconv>
#include <functional>

#include "core/error.hpp"
#include "tools/fulmar_live/messages.hpp"

namespace fulmar::core {
namespace {

namespace net = boost::asio;
namespace beast = boost::beast;
namespace websocket = beast::websocket;
using boost::system::error_code;
using net::ip::tcp;
using Clock = std::chrono::steady_clock;
// All handlers have the same type, so that each of Beast's operations is compiled once.
using OnFault = std::function<void(error_code)>;
using OnBytes = std::function<void(error_code, std::size_t)>;

constexpr std::size_t most_message_bytes = 64u << 20;

}  // namespace

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
      throw Error(remote_messages::port_number_invalid(at, port));
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

// Blocking calls of Beast have no time limit, so the asynchronous ones are run here.
struct Client::Impl {
  LiveAddress target;
  std::chrono::milliseconds patience;
  net::io_context context{1};
  websocket::stream<tcp::socket, false> stream{context};  // without compression
  beast::flat_buffer buffer;
  bool reading = false, read_done = false;
  error_code read_fault;

  Impl(const LiveAddress& t, std::chrono::milliseconds p) : target(t), patience(p) {}

  ~Impl() {
    error_code fault;
    stream.next_layer().shutdown(tcp::socket::shutdown_both, fault);
    close();
    context.restart();
    context.run_for(std::chrono::milliseconds(100));  // the remaining handlers refer to this object
  }

  void close() {
    error_code ignored;
    stream.next_layer().close(ignored);
  }

  /// Runs the started operation until it sets `done`. Returns false after the time limit.
  bool run_until(const bool& done, Clock::time_point end) {
    while (!done) {
      const auto left = end - Clock::now();
      context.restart();
      if (left <= left.zero()) {
        context.poll();
        return done;
      }
      if (context.run_one_for(left) == 0 && context.stopped() && !done) return false;
    }
    return true;
  }

  /// Fault of the operation that `start` begins; timed_out after the time limit.
  template <class Start>
  error_code wait(Clock::time_point end, Start start) {
    bool done = false;
    error_code fault;
    start([&](error_code code, auto&&...) {
      done = true;
      fault = code;
    });
    if (run_until(done, end)) return fault;
    close();  // its handler refers to local variables
    while (!done && context.run_one_for(std::chrono::seconds(1)) > 0) {
    }
    return net::error::timed_out;
  }

  error_code connect_to(const tcp::resolver::results_type& places) {
    const auto end = Clock::now() + patience;
    error_code fault = net::error::not_found;
    for (const auto& place : places) {
      close();
      fault = wait(end, [&](OnFault done) { stream.next_layer().async_connect(place, std::move(done)); });
      if (!fault || Clock::now() >= end) return fault;
    }
    return fault;
  }

  void connect() {
    tcp::resolver resolver(context);
    error_code fault;
    const auto places = resolver.resolve(target.host, std::to_string(target.port), fault);
    if (fault) throw Error(remote_messages::host_unknown(target.host));
    if (connect_to(places)) throw Error(remote_messages::flight_not_found(target.text()));
    stream.next_layer().set_option(tcp::no_delay(true), fault);
  }

  void shake_hands() {
    stream.read_message_max(most_message_bytes);
    stream.set_option(websocket::stream_base::decorator([&](websocket::request_type& request) {
      request.set("Sec-WebSocket-Protocol", "foxglove.sdk.v1, foxglove.websocket.v1");
      request.set("User-Agent", "fulmar");
      if (!target.token.empty()) request.set("Authorization", "Bearer " + target.token);
    }));
    websocket::response_type response;
    const error_code fault = wait(Clock::now() + patience, [&](OnFault done) {
      stream.async_handshake(response, target.text(), "/", std::move(done));
    });
    if (!fault) return;
    if (fault != websocket::error::upgrade_declined)
      throw Error(remote_messages::flight_expected(target.text(), fault.message()));
    constexpr unsigned unauthorized = 401, forbidden = 403;
    const unsigned status = response.result_int();
    if (status == unauthorized || status == forbidden)
      throw Error(remote_messages::token_rejected(
          target.text(), target.token.empty() ? " wants a token" : " refuses this token"));
    throw Error(remote_messages::connection_rejected(
        target.text(), status, std::string(response.reason().data(), response.reason().size())));
  }

  std::optional<Message> receive(std::chrono::milliseconds limit) {
    if (!reading) {
      reading = true;
      read_done = false;
      stream.async_read(buffer, OnBytes([this](error_code code, std::size_t) {
                          read_done = true;
                          read_fault = code;
                        }));
    }
    if (!run_until(read_done, Clock::now() + limit)) return std::nullopt;
    reading = false;
    if (read_fault) gone(read_fault);
    Message message{stream.got_binary(), beast::buffers_to_string(buffer.data())};
    buffer.consume(buffer.size());
    return message;
  }

  void write(const std::string& data, bool binary) {
    stream.binary(binary);
    const error_code fault = wait(Clock::now() + patience, [&](OnBytes done) {
      stream.async_write(net::buffer(data), std::move(done));
    });
    if (fault) gone(fault);
  }

  [[noreturn]] void gone(error_code fault) const {
    const std::string farewell = fault == websocket::error::closed ? stream.reason().reason.c_str() : "";
    if (!farewell.empty())
      throw FlightEnded(remote_messages::flight_closed_connection(target.text(), farewell));
    throw FlightEnded(remote_messages::flight_ended(target.text()));
  }
};

Client::Client(const LiveAddress& target, std::chrono::milliseconds patience)
    : impl_(std::make_unique<Impl>(target, patience)) {
  impl_->connect();
  impl_->shake_hands();
}

Client::~Client() = default;

std::optional<Client::Message> Client::receive(std::chrono::milliseconds limit) {
  return impl_->receive(limit);
}

void Client::send(const std::string& text) { impl_->write(text, false); }
void Client::send_binary(const std::string& bytes) { impl_->write(bytes, true); }

}  // namespace fulmar::core

// SPDX-License-Identifier: BSD-3-Clause
// See websocket.hpp. The only file that knows Boost.Asio's sockets and Boost.Beast: it takes its time to
// compile. Both ends are of the same types, and what is called back has always the same type, so that each of
// Beast's operations is compiled once.
#include "core/live/websocket.hpp"

#include <array>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core/buffers_to_string.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/rfc7230.hpp>
#include <boost/beast/http/status.hpp>
#include <boost/beast/websocket/stream.hpp>

#include "core/live/corked.hpp"

namespace fulmar::core::live {

namespace net = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using boost::system::error_code;
using net::ip::tcp;
using Stream = websocket::stream<Corked, false>;  // without compression
using OnFault = std::function<void(error_code)>;
using OnBytes = std::function<void(error_code, std::size_t)>;

namespace {

std::string text_of(beast::string_view text) { return {text.data(), text.size()}; }

std::array<net::const_buffer, 2> parts_of(std::string_view head, std::string_view body) {
  return {net::buffer(head.data(), head.size()), net::buffer(body.data(), body.size())};
}

}  // namespace

// ---- the loop

struct Loop::Impl {
  net::io_context io{1};
};
Loop::Loop() : impl_(std::make_unique<Impl>()) {}
Loop::~Loop() = default;
void Loop::run() { impl_->io.run(); }
void Loop::stop() { impl_->io.stop(); }
void Loop::post(std::function<void()> task) { net::post(impl_->io, std::move(task)); }

struct Timer::Impl {
  net::steady_timer timer;
  std::uint64_t starts = 0;
};
Timer::Timer(Loop& loop) : impl_(std::make_shared<Impl>(Impl{net::steady_timer(loop.impl().io)})) {}
Timer::~Timer() = default;

void Timer::start(std::chrono::steady_clock::duration after, std::function<void(bool)> then) {
  impl_->timer.expires_after(after);
  const std::weak_ptr<Impl> weak = impl_;
  impl_->timer.async_wait([weak, start = ++impl_->starts, then = std::move(then)](error_code ec) {
    const std::shared_ptr<Impl> impl = weak.lock();
    then(!ec && impl && impl->starts == start);  // one that is superseded may have been on its way already
  });
}

void Timer::cancel() {
  ++impl_->starts;
  impl_->timer.cancel();
}

// ---- the server's end

struct ServerEnd::Impl {
  Stream stream;
  beast::flat_buffer buffer;
  http::request_parser<http::empty_body> parser;
  Request request;

  explicit Impl(tcp::socket socket) : stream(std::move(socket)) {}
  Corked& corked() { return stream.next_layer(); }

  void note_request() {
    const auto& head = parser.get();
    const auto field = [&](http::field name) { return text_of(head[name]); };
    request.target = text_of(head.target());
    request.host = field(http::field::host);
    request.origin = field(http::field::origin);
    request.authorization = field(http::field::authorization);
    for (const auto& word : http::token_list(head[http::field::sec_websocket_protocol]))
      request.protocols.push_back(text_of(word));
    request.contradicts_itself = head.count(http::field::host) > 1 || head.count(http::field::origin) > 1;
    request.upgrade = websocket::is_upgrade(head);
    request.get = head.method() == http::verb::get;
    request.head = head.method() == http::verb::head;
    request.more = buffer.size() > 0;
  }

  static Outcome outcome_of_read(error_code ec) {
    if (!ec) return Outcome::good;
    const bool against_rules =
        ec == websocket::error::message_too_big || ec == websocket::error::buffer_overflow ||
        ec.category() == websocket::make_error_code(websocket::error::bad_opcode).category();
    return against_rules && ec != websocket::error::closed ? Outcome::against_rules : Outcome::gone;
  }
};

ServerEnd::ServerEnd(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
ServerEnd::ServerEnd(ServerEnd&&) noexcept = default;
ServerEnd::~ServerEnd() = default;
void ServerEnd::cut() { impl_->corked().close(); }
const ServerEnd::Request& ServerEnd::request() const { return impl_->request; }
bool ServerEnd::got_text() const { return impl_->stream.got_text(); }

std::string_view ServerEnd::message() const {
  const net::const_buffer data = impl_->buffer.cdata();
  return {static_cast<const char*>(data.data()), data.size()};
}

void ServerEnd::read_request(std::size_t most_bytes, Done done) {
  impl_->parser.header_limit(static_cast<std::uint32_t>(most_bytes));
  http::async_read_header(
      impl_->corked(), impl_->buffer, impl_->parser,
      OnBytes([impl = impl_.get(), done = std::move(done)](error_code ec, std::size_t) {
        if (ec) return done(ec == http::error::end_of_stream ? Outcome::gone : Outcome::against_rules);
        impl->note_request();
        done(Outcome::good);
      }));
}

void ServerEnd::respond(unsigned status, const Fields& fields, const std::string& body,
                        std::function<void()> done) {
  std::string answer = "HTTP/1.1 " + std::to_string(status) + " " +
                       text_of(http::obsolete_reason(http::status(status))) + "\r\n";
  for (const auto& [name, value] : fields) answer += name + ": " + value + "\r\n";
  answer += "Connection: close\r\nContent-Length: " + std::to_string(body.size()) + "\r\n\r\n";
  if (!impl_->request.head) answer += body;
  impl_->corked().write(answer, Resume::of([done = std::move(done)](error_code, std::size_t) { done(); }));
}

void ServerEnd::shut_down() {
  error_code ignored;
  impl_->corked().socket().shutdown(tcp::socket::shutdown_both, ignored);
}

void ServerEnd::accept(Terms terms, Done done) {
  impl_->corked().socket().set_option(tcp::no_delay(true));
  impl_->corked().socket().set_option(net::socket_base::send_buffer_size(terms.kernel_bytes));
  Stream& stream = impl_->stream;
  stream.set_option(websocket::stream_base::timeout{terms.handshake_limit, terms.idle_limit, true});
  stream.set_option(websocket::stream_base::decorator(
      [protocol = std::move(terms.protocol)](websocket::response_type& response) {
        response.set(http::field::sec_websocket_protocol, protocol);
      }));
  stream.read_message_max(terms.most_message_bytes);
  stream.auto_fragment(false);
  stream.control_callback([on_control = std::move(terms.on_control)](websocket::frame_type,
                                                                     beast::string_view) { on_control(); });
  stream.async_accept(impl_->parser.get(), OnFault([done = std::move(done)](error_code ec) {
                        done(ec ? Outcome::against_rules : Outcome::good);
                      }));
}

void ServerEnd::read(Done done) {
  impl_->buffer.clear();
  impl_->stream.async_read(impl_->buffer, OnBytes([done = std::move(done)](error_code ec, std::size_t) {
                             done(Impl::outcome_of_read(ec));
                           }));
}

void ServerEnd::write(std::string_view head, std::string_view body, bool binary, bool more, Done done) {
  impl_->stream.binary(binary);
  impl_->corked().cork(more);
  impl_->stream.async_write(parts_of(head, body),
                            OnBytes([done = std::move(done)](error_code ec, std::size_t) {
                              done(ec ? Outcome::gone : Outcome::good);
                            }));
}

void ServerEnd::close(std::uint16_t code, const std::string& why, std::function<void()> done) {
  impl_->corked().cork(false);
  impl_->stream.async_close({websocket::close_code(code), why},
                            OnFault([done = std::move(done)](error_code) { done(); }));
}

// ---- listening

struct Listener::Impl {
  tcp::acceptor acceptor;
};
Listener::Listener(Loop& loop) : impl_(std::make_unique<Impl>(Impl{tcp::acceptor(loop.impl().io)})) {}
Listener::~Listener() = default;

bool Listener::is_address(const std::string& text) {
  error_code ec;
  net::ip::make_address(text, ec);
  return !ec;
}

std::optional<Listener::Refusal> Listener::listen(const std::string& address, std::uint16_t port) {
  const tcp::endpoint at(net::ip::make_address(address), port);
  tcp::acceptor& acceptor = impl_->acceptor;
  error_code ec;
  acceptor.open(at.protocol(), ec);
  if (!ec) acceptor.set_option(tcp::acceptor::reuse_address(true), ec);
  if (!ec) acceptor.bind(at, ec);
  if (!ec) acceptor.listen(net::socket_base::max_listen_connections, ec);
  if (ec) return Refusal{ec.message(), ec == net::error::address_in_use};
  return std::nullopt;
}

std::uint16_t Listener::port() const { return impl_->acceptor.local_endpoint().port(); }

void Listener::accept(std::function<void(std::optional<ServerEnd>)> done) {
  impl_->acceptor.async_accept([done = std::move(done)](error_code ec, tcp::socket socket) {
    if (ec) return done(std::nullopt);
    done(ServerEnd(std::make_unique<ServerEnd::Impl>(std::move(socket))));
  });
}

void Listener::close() {
  error_code ignored;
  impl_->acceptor.close(ignored);
}

// ---- the client's end

// Blocking calls of Beast's know no time limit, so the asynchronous ones are run here.
struct ClientEnd::Impl {
  using Clock = std::chrono::steady_clock;
  std::chrono::milliseconds patience;
  net::io_context context{1};
  Stream stream{tcp::socket(context)};
  beast::flat_buffer buffer;
  websocket::response_type response;
  bool reading = false, read_done = false;
  error_code read_fault;
  std::string farewell;

  explicit Impl(std::chrono::milliseconds p) : patience(p) {}
  Corked& corked() { return stream.next_layer(); }

  /// Runs what has begun; it says through `done` that it is over. False when the time was up.
  bool run_until(const bool& done, Clock::time_point end) {
    while (!done) {
      const auto left = end - Clock::now();
      context.restart();
      if (left <= left.zero()) return context.poll(), done;
      if (context.run_one_for(left) == 0 && context.stopped() && !done) return false;
    }
    return true;
  }

  /// The fault of the operation that `start` begins; timed_out when it took too long.
  template <class Start>
  error_code wait(Clock::time_point end, Start start) {
    bool done = false;
    error_code fault;
    start([&](error_code code, auto&&...) { done = true, fault = code; });
    if (run_until(done, end)) return fault;
    corked().close();  // its handler still refers to what lies here
    while (!done && context.run_one_for(std::chrono::seconds(1)) > 0) {
    }
    return net::error::timed_out;
  }

  error_code connect(const tcp::resolver::results_type& places) {
    const auto end = Clock::now() + patience;
    error_code fault = net::error::not_found;
    for (const auto& place : places) {
      corked().close();
      fault = wait(end, [&](OnFault done) { corked().socket().async_connect(place, std::move(done)); });
      if (!fault || Clock::now() >= end) return fault;
    }
    return fault;
  }

  void note_end(error_code fault) {
    farewell = fault == websocket::error::closed ? stream.reason().reason.c_str() : "";
  }
};

ClientEnd::ClientEnd(std::chrono::milliseconds patience) : impl_(std::make_unique<Impl>(patience)) {}

ClientEnd::~ClientEnd() {
  error_code fault;
  impl_->corked().socket().shutdown(tcp::socket::shutdown_both, fault);
  impl_->corked().close();
  impl_->context.restart();
  impl_->context.run_for(std::chrono::milliseconds(100));  // the handlers that are left refer to impl_
}

ClientEnd::Reached ClientEnd::connect(const std::string& host, std::uint16_t port) {
  tcp::resolver resolver(impl_->context);
  error_code fault;
  const auto places = resolver.resolve(host, std::to_string(port), fault);
  if (fault) return Reached::no_host;
  if (impl_->connect(places)) return Reached::nobody;
  impl_->corked().socket().set_option(tcp::no_delay(true), fault);
  return Reached::yes;
}

ClientEnd::Answer ClientEnd::shake_hands(const std::string& host, const Fields& fields,
                                         std::size_t most_message_bytes) {
  Stream& stream = impl_->stream;
  stream.read_message_max(most_message_bytes);
  stream.set_option(websocket::stream_base::decorator([fields](websocket::request_type& request) {
    for (const auto& [name, value] : fields) request.set(name, value);
  }));
  const websocket::response_type& response = impl_->response;
  const error_code fault = impl_->wait(Impl::Clock::now() + impl_->patience, [&](OnFault done) {
    stream.async_handshake(impl_->response, host, "/", std::move(done));
  });
  if (!fault) return {true, false, 0, "", ""};
  if (fault != websocket::error::upgrade_declined) return {false, false, 0, "", fault.message()};
  return {false, true, response.result_int(), text_of(response.reason()), ""};
}

ClientEnd::Got ClientEnd::receive(std::chrono::milliseconds limit, std::string& message, bool& binary) {
  Impl& impl = *impl_;
  if (!impl.reading) {
    impl.reading = true, impl.read_done = false;
    impl.stream.async_read(impl.buffer, OnBytes([&impl](error_code code, std::size_t) {
                             impl.read_done = true, impl.read_fault = code;
                           }));
  }
  if (!impl.run_until(impl.read_done, Impl::Clock::now() + limit)) return Got::nothing;
  impl.reading = false;
  impl.note_end(impl.read_fault);
  if (impl.read_fault) return Got::end;
  binary = impl.stream.got_binary();
  message = beast::buffers_to_string(impl.buffer.data());
  impl.buffer.consume(impl.buffer.size());
  return Got::message;
}

bool ClientEnd::write(const std::string& data, bool binary) {
  impl_->stream.binary(binary);
  const error_code fault = impl_->wait(Impl::Clock::now() + impl_->patience, [&](OnBytes done) {
    impl_->stream.async_write(parts_of(data, {}), std::move(done));
  });
  impl_->note_end(fault);
  return !fault;
}

const std::string& ClientEnd::farewell() const { return impl_->farewell; }

}  // namespace fulmar::core::live

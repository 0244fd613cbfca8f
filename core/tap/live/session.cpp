// SPDX-License-Identifier: BSD-3-Clause
// See session.hpp. The only file that knows Boost.Beast: it takes its time to compile.
#include "core/tap/live/session.hpp"

#include <array>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <deque>
#include <optional>
#include <utility>

#include "core/tap/live/corked.hpp"
#include "core/tap/live/gate.hpp"

namespace fulmar::core::live {
namespace {

namespace net = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using beast::error_code;
using std::chrono::milliseconds;
using std::chrono::seconds;
using std::chrono::steady_clock;

constexpr seconds handshake_limit{5}, idle_limit{120}, farewell_limit{1};
constexpr std::size_t most_header_bytes = 8192;
constexpr std::size_t most_message_bytes = 1u << 20;
constexpr std::size_t most_clients = 16;
constexpr int kernel_bytes = 512 << 10;                    // what the system holds for a client, at most: it is late already
constexpr std::size_t most_queued_bytes = 4u << 20;        // then data is left out
constexpr std::size_t most_owed_bytes = 16u << 20;         // then the client is closed
constexpr double messages_per_s = 10'000, burst = 20'000;  // one for each KiB of a message, at least one
constexpr milliseconds busy_pause{5};

std::string text_of(beast::string_view text) { return {text.data(), text.size()}; }

/// The protocol to speak, of those that a client offers: "" when there is none. The two names mean the same.
std::string chosen_protocol(beast::string_view offered) {
  for (const char* name : {"foxglove.sdk.v1", "foxglove.websocket.v1"})
    for (const auto& word : http::token_list(offered))
      if (word == name) return name;
  return "";
}

class Connection final : public Session, public Peer, public std::enable_shared_from_this<Connection> {
 public:
  Connection(net::ip::tcp::socket socket, Context& context)
      : context_(context), ws_(std::move(socket)), timer_(ws_.get_executor()), bucket_(messages_per_s, burst, steady_clock::now()) {
    context_.sessions.insert(this);
  }
  ~Connection() override {
    leave();
    context_.sessions.erase(this);
  }

  void begin() {
    parser_.header_limit(most_header_bytes);
    stream().expires_after(handshake_limit);
    http::async_read_header(stream(), buffer_, parser_, [self = shared_from_this()](error_code ec, std::size_t) {
      if (ec && ec != http::error::end_of_stream) ++self->context_.counters.refused;
      if (!ec) self->answer();
    });
  }

  void finish() override { close(1001, "the flight has ended"); }
  void cut() override { stream().close(); }

  bool offer(const Message& message) override {
    if (closing_ || queued_ + message.size() > most_queued_bytes) return closing_;  // one that is going misses nothing
    push(message);
    return true;
  }

  void send(Message message) override {
    if (closing_) return;
    if (queued_ + message.size() > most_owed_bytes) return close(1008, "too slow for its own requests");
    push(std::move(message));
  }

  void close(std::uint16_t code, const std::string& why) override {
    if (closing_) return;
    closing_ = true;
    if (!client_) return cut();
    reason_ = {websocket::close_code(code), why.substr(0, 100)};
    timer_.expires_after(farewell_limit);
    timer_.async_wait([self = shared_from_this()](error_code ec) {
      if (!ec) self->cut();
    });
    if (!writing_) say_goodbye();
  }

 private:
  beast::tcp_stream& stream() { return ws_.next_layer().next_layer(); }

  // ---- HTTP
  void answer() {
    const auto& request = parser_.get();
    const auto header = [&](http::field name) { return text_of(request[name]); };
    const Caller caller{text_of(request.target()), header(http::field::host), header(http::field::origin),
                        header(http::field::authorization)};
    if (request.count(http::field::host) > 1 || request.count(http::field::origin) > 1)
      return respond(400, "The request contradicts itself.");
    const Verdict verdict = admit(context_.options, caller);
    if (verdict.status != 200) return respond(verdict.status, verdict.why);
    if (path_of(caller.target) != "/") return respond(404, "There is nothing here. The page of the flight is at /.");
    if (websocket::is_upgrade(request)) return upgrade();
    if (request.method() != http::verb::get && request.method() != http::verb::head) return respond(405, "Only GET and HEAD are answered.");
    respond(200, context_.page);
  }

  void respond(unsigned status, const std::string& body) {
    if (status != 200) ++context_.counters.refused;
    auto response = std::make_shared<http::response<http::string_body>>(http::status(status), 11);
    response->set(http::field::content_type, status == 200 ? "text/html; charset=utf-8" : "text/plain; charset=utf-8");
    response->set("Content-Security-Policy", "default-src 'none'; style-src 'unsafe-inline'; frame-ancestors 'none'");
    response->set("X-Content-Type-Options", "nosniff");
    response->set("Referrer-Policy", "no-referrer");
    response->set(http::field::cache_control, "no-store");
    if (status == 401) response->set(http::field::www_authenticate, "Bearer");
    response->keep_alive(false);
    response->body() = status == 200 ? body : body + "\n";
    response->prepare_payload();
    if (parser_.get().method() == http::verb::head) response->body().clear();
    http::async_write(stream(), *response, [self = shared_from_this(), response](error_code, std::size_t) {
      error_code ignored;
      self->stream().socket().shutdown(net::ip::tcp::socket::shutdown_both, ignored);
    });
  }

  // ---- the live protocol
  void upgrade() {
    if (buffer_.size() > 0) return respond(400, "A client of the protocol waits for the answer to its handshake.");
    const std::string protocol = chosen_protocol(parser_.get()[http::field::sec_websocket_protocol]);
    if (protocol.empty()) return respond(400, "This flight speaks the WebSocket subprotocols foxglove.sdk.v1 and foxglove.websocket.v1.");
    if (context_.hub.clients() >= most_clients)
      return respond(503, "This flight has " + std::to_string(most_clients) + " clients already.");
    stream().expires_never();  // the WebSocket has time-outs of its own
    stream().socket().set_option(net::ip::tcp::no_delay(true));
    stream().socket().set_option(net::socket_base::send_buffer_size(kernel_bytes));
    ws_.set_option(websocket::stream_base::timeout{handshake_limit, idle_limit, true});
    ws_.set_option(websocket::stream_base::decorator(
        [protocol](websocket::response_type& response) { response.set(http::field::sec_websocket_protocol, protocol); }));
    ws_.read_message_max(most_message_bytes);
    ws_.auto_fragment(false);
    ws_.control_callback([this](websocket::frame_type, beast::string_view) {
      if (bucket_.take(1, steady_clock::now()) > seconds(1)) cut();
    });
    ws_.async_accept(parser_.get(), [self = shared_from_this()](error_code ec) {
      if (ec) {
        ++self->context_.counters.refused;
        return;
      }
      self->join();
    });
  }

  void join() {
    if (context_.hub.clients() >= most_clients) {  // others were quicker
      ++context_.counters.refused;
      return cut();
    }
    client_ = context_.hub.add(*this);
    context_.joined();
    read();
  }

  void read() {
    buffer_.clear();
    ws_.async_read(buffer_, [self = shared_from_this()](error_code ec, std::size_t) { self->received(ec); });
  }

  void received(error_code ec) {
    if (ec) {
      const bool against_rules = ec == websocket::error::message_too_big || ec == websocket::error::buffer_overflow ||
                                 ec.category() == websocket::make_error_code(websocket::error::bad_opcode).category();
      if (against_rules && ec != websocket::error::closed) ++context_.counters.refused;
      return leave();
    }
    if (closing_) return read();  // until the other side has answered the good-bye
    const std::string_view message(static_cast<const char*>(buffer_.data().data()), buffer_.size());
    if (ws_.got_text()) {
      context_.hub.text(*client_, message);
    } else {
      context_.hub.binary(*client_, message);
    }
    pause_or_read(bucket_.take(1 + static_cast<double>(message.size() / 1024), steady_clock::now()));
  }

  void pause_or_read(steady_clock::duration pause) {
    if (context_.hub.busy(*client_) && pause < busy_pause) pause = busy_pause;
    if (closing_ || pause <= steady_clock::duration::zero()) return read();
    timer_.expires_after(pause);
    timer_.async_wait([self = shared_from_this()](error_code ec) {
      if (!ec && !self->closing_) return self->pause_or_read({});
      if (self->closing_) self->read();
    });
  }

  void push(Message message) {
    queued_ += message.size();
    queue_.push_back(std::move(message));
    if (!writing_) write();
  }

  void write() {
    writing_ = true;
    const Message& message = queue_.front();
    ws_.binary(message.binary);
    ws_.next_layer().cork(queue_.size() > 1);
    const std::array<net::const_buffer, 2> parts = {net::buffer(message.head.data(), message.head_size), net::buffer(*message.body)};
    ws_.async_write(parts, [self = shared_from_this()](error_code ec, std::size_t) { self->written(ec); });
  }

  void written(error_code ec) {
    queued_ -= queue_.front().size();
    queue_.pop_front();
    if (ec) return leave();
    if (!queue_.empty()) return write();
    writing_ = false;
    if (closing_) say_goodbye();
  }

  void say_goodbye() {
    writing_ = true;
    ws_.next_layer().cork(false);
    ws_.async_close(reason_, [self = shared_from_this()](error_code) { self->timer_.cancel(); });
  }

  void leave() {
    if (client_) context_.hub.remove(*client_);
    client_.reset();
    closing_ = true;
  }

  Context& context_;
  websocket::stream<Corked> ws_;
  net::steady_timer timer_;  // pauses; the farewell
  Bucket bucket_;
  beast::flat_buffer buffer_;
  http::request_parser<http::empty_body> parser_;
  std::optional<Hub::ClientId> client_;
  std::deque<Message> queue_;
  std::size_t queued_ = 0;  // bytes
  bool writing_ = false, closing_ = false;
  websocket::close_reason reason_;
};

}  // namespace

void begin_session(net::ip::tcp::socket socket, Context& context) { std::make_shared<Connection>(std::move(socket), context)->begin(); }

}  // namespace fulmar::core::live

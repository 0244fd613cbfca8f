// SPDX-License-Identifier: BSD-3-Clause
// One connection: a plain HTTP request, or a client of the live protocol. It uses Boost.Beast, whose
// templates compile slowly, so only server.cpp includes this header. All handlers have the same type, so that
// each operation of Beast is compiled once.
#pragma once
#include <array>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/rfc7230.hpp>
#include <boost/beast/http/status.hpp>
#include <boost/beast/websocket/stream.hpp>
#include <chrono>
#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "links/live/corked.hpp"
#include "links/live/gate.hpp"
#include "links/live/hub.hpp"
#include "links/live/pages.hpp"

namespace fulmar::core::live {

namespace net = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using boost::system::error_code;
using net::ip::tcp;
using std::chrono::milliseconds;
using std::chrono::seconds;
using std::chrono::steady_clock;
using OnFault = std::function<void(error_code)>;
using OnBytes = std::function<void(error_code, std::size_t)>;

class Timer {
 public:
  explicit Timer(net::io_context& io) : timer_(io) {}
  /// Replaces the previous start. Each `then` is called once: at its time, or when another start or `cancel`
  /// comes earlier.
  void start(steady_clock::duration after, std::function<void(bool due)> then) {
    timer_.expires_after(after);
    timer_.async_wait([starts = starts_, mine = ++*starts_, then = std::move(then)](error_code ec) {
      then(!ec && *starts == mine);  // the handler of a replaced start may already be queued
    });
  }
  void cancel() {
    ++*starts_;
    timer_.cancel();
  }

 private:
  net::steady_timer timer_;
  std::shared_ptr<std::uint64_t> starts_ = std::make_shared<std::uint64_t>(0);  // a pending wait may outlive
                                                                                // the timer
};

class Connection;

/// Shared by all connections. Outlives them.
struct Context {
  const LiveOptions& options;
  Hub& hub;
  Counters& counters;
  Pages pages;                   // GET /
  std::string policy;            // Content-Security-Policy of the page's files
  std::string table;             // GET /topics, and GET / without a page
  std::function<void()> joined;  // called when a client has joined
  std::set<Connection*> connections;
  Guesses guesses{};
};

/// Lives while an operation is pending. One read and one write at a time.
class Connection final : public Peer, public std::enable_shared_from_this<Connection> {
 public:
  Connection(tcp::socket socket, net::io_context& io, Context& context)
      : context_(context),
        stream_(std::move(socket)),
        timer_(io),
        bucket_(messages_per_s, burst, steady_clock::now()) {
    context_.connections.insert(this);
  }
  ~Connection() override {
    leave();
    context_.connections.erase(this);
  }

  void begin() {
    cut_after(handshake_limit);
    parser_.header_limit(max_header_bytes);
    http::async_read_header(corked(), buffer_, parser_,
                            OnBytes([self = shared_from_this()](error_code ec, std::size_t) {
                              if (!ec) return self->answer();
                              if (ec != http::error::end_of_stream) ++self->context_.counters.refused;
                            }));
  }

  /// Closes the oldest idle connections to make room for the next: an idle peer must not block a client.
  static void make_room(Context& context) {
    Connection* oldest = nullptr;
    for (Connection* c : context.connections)
      if (!c->client_ && !c->closing_ && (oldest == nullptr || c->begun_ < oldest->begun_)) oldest = c;
    if (oldest == nullptr) return;
    ++context.counters.refused;
    oldest->closing_ = true;
    oldest->cut();
  }

  /// Sends the queue, then closes the connection.
  void finish() { close(1001, "the flight has ended"); }

  bool offer(const Message& message) override {
    if (closing_ || queued_ + message.size() > max_queued_bytes)
      return closing_;  // a closing connection needs no data
    push(message);
    return true;
  }

  void send(Message message) override {
    if (closing_) return;
    if (queued_ + message.size() > max_owed_bytes) return close(1008, "too slow for its own requests");
    push(std::move(message));
  }

  void close(std::uint16_t code, const std::string& why) override {
    if (closing_) return;
    closing_ = true;
    if (!client_) return cut();
    code_ = code;
    why_ = why.substr(0, 100);
    timer_.start(farewell_limit, [self = shared_from_this()](bool due) {
      if (due) self->cut();
    });
    if (!writing_) say_goodbye();
  }

 private:
  static constexpr seconds handshake_limit{5}, idle_limit{120}, farewell_limit{1}, page_limit{60};
  static constexpr std::uint32_t max_header_bytes = 8192;
  static constexpr std::size_t small_body_bytes = 64u << 10;
  static constexpr std::size_t most_message_bytes = 1u << 20;
  static constexpr std::size_t max_clients = 16;
  static constexpr int kernel_bytes = 512 << 10;  // send buffer of the system for a client; a full one means
                                                  // that the client is slow
  static constexpr std::size_t max_queued_bytes = 4u << 20;         // beyond this, data is dropped
  static constexpr std::size_t max_owed_bytes = 16u << 20;          // beyond this, the client is closed
  static constexpr double messages_per_s = 10'000, burst = 20'000;  // a message costs one per KiB, at least
                                                                    // one
  static constexpr milliseconds busy_pause{5};

  static std::string text_of(beast::string_view text) { return {text.data(), text.size()}; }
  Corked& corked() { return stream_.next_layer(); }
  /// Ends at once.
  void cut() { corked().close(); }
  void cut_after(seconds limit) {
    timer_.start(limit, [weak = weak_from_this()](bool due) {
      if (const auto self = weak.lock(); self && due) self->cut();
    });
  }

  // ---- HTTP
  void answer() {
    const auto& head = parser_.get();
    const auto field = [&](http::field name) { return text_of(head[name]); };
    if (head.count(http::field::host) > 1 || head.count(http::field::origin) > 1)
      return respond(400, "The request contradicts itself.");
    const std::string target = text_of(head.target());
    const auto now = steady_clock::now();
    error_code gone;
    const std::string from = guesser(corked().socket().remote_endpoint(gone).address().to_string());
    if (!context_.guesses.may(from, now))
      return respond(429, "Too many wrong tokens came from this address. Try again in a few seconds.");
    const Verdict verdict = admit(
        context_.options,
        {target, field(http::field::host), field(http::field::origin), field(http::field::authorization)});
    if (verdict.wrong_token) {
      context_.guesses.wrong(from, now);
      ++context_.counters.wrong_tokens;
    }
    const std::string_view path = path_of(target);
    const PageFile* const file = context_.pages.find(path);
    // The page's files contain no data of the flight, and a browser loads them without a token.
    const bool open_to_all = file != nullptr && path != "/" && verdict.status == 401 && !verdict.wrong_token;
    if (verdict.status != 200 && !open_to_all) return respond(verdict.status, verdict.why);
    const bool topics = path == "/topics" || (path == "/" && file == nullptr);
    if (!topics && file == nullptr)
      return respond(404, "There is nothing here. The page of the flight is at /.");
    if (path == "/" && websocket::is_upgrade(head)) return upgrade();
    if (head.method() != http::verb::get && head.method() != http::verb::head)
      return respond(405, "Only GET and HEAD are answered.");
    if (topics) return respond(200, context_.table);
    const bool small = !file->gzipped.empty() && takes_gzip(field(http::field::accept_encoding));
    send_answer(200, file->type, context_.policy, small ? file->gzipped : file->body,
                small ? "Content-Encoding: gzip\r\n" : "");
  }

  /// The only answer to a plain request: the table of topics, or the error.
  void respond(unsigned status, const std::string& text) {
    const bool good = status == 200;
    if (!good) ++context_.counters.refused;
    send_answer(status, good ? "text/html; charset=utf-8" : "text/plain; charset=utf-8",
                "default-src 'none'; style-src 'unsafe-inline'; frame-ancestors 'none'",
                good ? text : text + "\n", status == 401 ? "WWW-Authenticate: Bearer\r\n" : "");
  }

  /// An answer to HEAD has no body.
  void send_answer(unsigned status, const std::string& type, std::string_view policy, const std::string& body,
                   const char* further) {
    answer_ = "HTTP/1.1 " + std::to_string(status) + " " +
              text_of(http::obsolete_reason(http::status(status))) + "\r\nContent-Type: " + type +
              "\r\nContent-Security-Policy: " + std::string(policy) +
              "\r\nX-Content-Type-Options: nosniff\r\n"
              "Cross-Origin-Resource-Policy: same-origin\r\n"
              "Referrer-Policy: no-referrer\r\n"
              "Cache-Control: no-store\r\n" +
              further;
    answer_ += "Connection: close\r\nContent-Length: " + std::to_string(body.size()) + "\r\n\r\n";
    if (parser_.get().method() != http::verb::head) answer_ += body;
    if (body.size() > small_body_bytes) cut_after(page_limit);  // a slow link needs more time
    net::async_write(corked().socket(), net::buffer(answer_),
                     OnBytes([self = shared_from_this()](error_code, std::size_t) {
                       error_code ignored;
                       self->corked().socket().shutdown(tcp::socket::shutdown_both, ignored);
                     }));
  }

  // ---- the live protocol
  /// The subprotocol, from those that the client offers: "" for none. The two names have the same meaning.
  std::string chosen_protocol() const {
    for (const char* name : {"foxglove.sdk.v1", "foxglove.websocket.v1"})
      for (const auto& offered : http::token_list(parser_.get()[http::field::sec_websocket_protocol]))
        if (offered == name) return name;
    return "";
  }

  void upgrade() {
    if (buffer_.size() > 0)
      return respond(400, "A client of the protocol waits for the answer to its handshake.");
    const std::string protocol = chosen_protocol();
    if (protocol.empty())
      return respond(
          400, "This flight speaks the WebSocket subprotocols foxglove.sdk.v1 and foxglove.websocket.v1.");
    if (context_.hub.clients() >= max_clients)
      return respond(503, "This flight has " + std::to_string(max_clients) + " clients already.");
    timer_.cancel();  // the WebSocket has its own time-outs
    corked().socket().set_option(tcp::no_delay(true));
    corked().socket().set_option(net::socket_base::send_buffer_size(kernel_bytes));
    stream_.set_option(websocket::stream_base::timeout{handshake_limit, idle_limit, true});
    stream_.set_option(websocket::stream_base::decorator([protocol](websocket::response_type& response) {
      response.set(http::field::sec_websocket_protocol, protocol);
    }));
    stream_.read_message_max(most_message_bytes);
    stream_.auto_fragment(false);
    stream_.control_callback([this](websocket::frame_type, beast::string_view) {
      if (bucket_.take(1, steady_clock::now()) > seconds(1)) cut();
    });
    stream_.async_accept(parser_.get(), OnFault([self = shared_from_this()](error_code ec) {
                           if (!ec) return self->join();
                           ++self->context_.counters.refused;
                         }));
  }

  void join() {
    if (context_.hub.clients() >= max_clients) {  // other clients came first
      ++context_.counters.refused;
      return cut();
    }
    client_ = context_.hub.add(*this);
    context_.joined();
    read();
  }

  void read() {
    buffer_.clear();
    stream_.async_read(
        buffer_, OnBytes([self = shared_from_this()](error_code ec, std::size_t) { self->received(ec); }));
  }

  void received(error_code ec) {
    if (ec) {
      const auto& of_protocol = websocket::make_error_code(websocket::error::bad_opcode).category();
      if (ec.category() == of_protocol && ec != websocket::error::closed) ++context_.counters.refused;
      return leave();
    }
    if (closing_) return read();  // until the peer has answered the close
    const net::const_buffer data = buffer_.cdata();
    const std::string_view message(static_cast<const char*>(data.data()), data.size());
    if (stream_.got_text()) {
      context_.hub.text(*client_, message);
    } else {
      context_.hub.binary(*client_, message);
    }
    pause_or_read(bucket_.take(1 + static_cast<double>(message.size() / 1024), steady_clock::now()));
  }

  void pause_or_read(steady_clock::duration pause) {
    if (context_.hub.busy(*client_) && pause < busy_pause) pause = busy_pause;
    if (closing_ || pause <= steady_clock::duration::zero()) return read();
    timer_.start(pause, [self = shared_from_this()](bool due) {
      if (due && !self->closing_) return self->pause_or_read({});
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
    const std::array<net::const_buffer, 2> parts{net::buffer(message.head.data(), message.head_size),
                                                 net::buffer(*message.body)};
    stream_.binary(message.binary);
    corked().cork(queue_.size() > 1);
    stream_.async_write(
        parts, OnBytes([self = shared_from_this()](error_code ec, std::size_t) { self->written(ec); }));
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
    corked().cork(false);
    stream_.async_close({websocket::close_code(code_), why_},
                        OnFault([self = shared_from_this()](error_code) { self->timer_.cancel(); }));
  }

  void leave() {
    if (client_) context_.hub.remove(*client_);
    client_.reset();
    closing_ = true;
  }

  Context& context_;
  websocket::stream<Corked, false> stream_;  // without compression
  beast::flat_buffer buffer_;
  http::request_parser<http::empty_body> parser_;
  std::string answer_;  // to a plain request
  Timer timer_;         // for the handshake, pauses and the close
  Bucket bucket_;
  std::optional<Hub::ClientId> client_;
  std::deque<Message> queue_;
  std::size_t queued_ = 0;  // bytes
  steady_clock::time_point begun_ = steady_clock::now();
  bool writing_ = false, closing_ = false;
  std::uint16_t code_ = 0;  // of the close
  std::string why_;
};

}  // namespace fulmar::core::live

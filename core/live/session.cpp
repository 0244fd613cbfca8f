// SPDX-License-Identifier: BSD-3-Clause
// See session.hpp.
#include "core/live/session.hpp"

#include <algorithm>
#include <chrono>
#include <deque>
#include <optional>
#include <utility>

#include "core/live/gate.hpp"

namespace fulmar::core::live {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using std::chrono::steady_clock;
using Outcome = ServerEnd::Outcome;

constexpr seconds handshake_limit{5}, idle_limit{120}, farewell_limit{1};
constexpr std::size_t most_header_bytes = 8192;
constexpr std::size_t most_message_bytes = 1u << 20;
constexpr std::size_t most_clients = 16;
constexpr int kernel_bytes = 512 << 10;  // what the system holds for a client, at most: it is late already
constexpr std::size_t most_queued_bytes = 4u << 20;        // then data is left out
constexpr std::size_t most_owed_bytes = 16u << 20;         // then the client is closed
constexpr double messages_per_s = 10'000, burst = 20'000;  // one for each KiB of a message, at least one
constexpr milliseconds busy_pause{5};

/// The protocol to speak, of those that a client offers: "" when there is none. The two names mean the same.
std::string chosen_protocol(const std::vector<std::string>& offered) {
  for (const char* name : {"foxglove.sdk.v1", "foxglove.websocket.v1"})
    if (std::find(offered.begin(), offered.end(), name) != offered.end()) return name;
  return "";
}

class Connection final : public Session, public Peer, public std::enable_shared_from_this<Connection> {
 public:
  Connection(ServerEnd end, Loop& loop, Context& context)
      : context_(context),
        end_(std::move(end)),
        timer_(loop),
        bucket_(messages_per_s, burst, steady_clock::now()) {
    context_.sessions.insert(this);
  }
  ~Connection() override {
    leave();
    context_.sessions.erase(this);
  }

  void begin() {
    timer_.start(handshake_limit, [weak = weak_from_this()](bool due) {
      if (const auto self = weak.lock(); self && due) self->cut();
    });
    end_.read_request(most_header_bytes, [self = shared_from_this()](Outcome outcome) {
      if (outcome == Outcome::against_rules) ++self->context_.counters.refused;
      if (outcome == Outcome::good) self->answer();
    });
  }

  void finish() override { close(1001, "the flight has ended"); }
  void cut() override { end_.cut(); }

  bool offer(const Message& message) override {
    if (closing_ || queued_ + message.size() > most_queued_bytes)
      return closing_;  // one that is going misses nothing
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
    code_ = code;
    why_ = why.substr(0, 100);
    timer_.start(farewell_limit, [self = shared_from_this()](bool due) {
      if (due) self->cut();
    });
    if (!writing_) say_goodbye();
  }

 private:
  // ---- HTTP
  void answer() {
    const ServerEnd::Request& request = end_.request();
    if (request.contradicts_itself) return respond(400, "The request contradicts itself.");
    const Verdict verdict =
        admit(context_.options, {request.target, request.host, request.origin, request.authorization});
    if (verdict.status != 200) return respond(verdict.status, verdict.why);
    if (path_of(request.target) != "/")
      return respond(404, "There is nothing here. The page of the flight is at /.");
    if (request.upgrade) return upgrade();
    if (!request.get && !request.head) return respond(405, "Only GET and HEAD are answered.");
    respond(200, context_.page);
  }

  void respond(unsigned status, const std::string& body) {
    if (status != 200) ++context_.counters.refused;
    Fields fields{
        {"Content-Type", status == 200 ? "text/html; charset=utf-8" : "text/plain; charset=utf-8"},
        {"Content-Security-Policy", "default-src 'none'; style-src 'unsafe-inline'; frame-ancestors 'none'"},
        {"X-Content-Type-Options", "nosniff"},
        {"Referrer-Policy", "no-referrer"},
        {"Cache-Control", "no-store"}};
    if (status == 401) fields.emplace_back("WWW-Authenticate", "Bearer");
    end_.respond(status, fields, status == 200 ? body : body + "\n",
                 [self = shared_from_this()] { self->end_.shut_down(); });
  }

  // ---- the live protocol
  void upgrade() {
    if (end_.request().more)
      return respond(400, "A client of the protocol waits for the answer to its handshake.");
    const std::string protocol = chosen_protocol(end_.request().protocols);
    if (protocol.empty())
      return respond(
          400, "This flight speaks the WebSocket subprotocols foxglove.sdk.v1 and foxglove.websocket.v1.");
    if (context_.hub.clients() >= most_clients)
      return respond(503, "This flight has " + std::to_string(most_clients) + " clients already.");
    timer_.cancel();  // the WebSocket has time-outs of its own
    const auto on_control = [this] {
      if (bucket_.take(1, steady_clock::now()) > seconds(1)) cut();
    };
    end_.accept({protocol, kernel_bytes, most_message_bytes, handshake_limit, idle_limit, on_control},
                [self = shared_from_this()](Outcome outcome) {
                  if (outcome == Outcome::good) return self->join();
                  ++self->context_.counters.refused;
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
    end_.read([self = shared_from_this()](Outcome outcome) { self->received(outcome); });
  }

  void received(Outcome outcome) {
    if (outcome != Outcome::good) {
      if (outcome == Outcome::against_rules) ++context_.counters.refused;
      return leave();
    }
    if (closing_) return read();  // until the other side has answered the good-bye
    const std::string_view message = end_.message();
    if (end_.got_text()) {
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
    end_.write({message.head.data(), message.head_size}, *message.body, message.binary, queue_.size() > 1,
               [self = shared_from_this()](Outcome outcome) { self->written(outcome); });
  }

  void written(Outcome outcome) {
    queued_ -= queue_.front().size();
    queue_.pop_front();
    if (outcome != Outcome::good) return leave();
    if (!queue_.empty()) return write();
    writing_ = false;
    if (closing_) say_goodbye();
  }

  void say_goodbye() {
    writing_ = true;
    end_.close(code_, why_, [self = shared_from_this()] { self->timer_.cancel(); });
  }

  void leave() {
    if (client_) context_.hub.remove(*client_);
    client_.reset();
    closing_ = true;
  }

  Context& context_;
  ServerEnd end_;
  Timer timer_;  // the handshake; pauses; the farewell
  Bucket bucket_;
  std::optional<Hub::ClientId> client_;
  std::deque<Message> queue_;
  std::size_t queued_ = 0;  // bytes
  bool writing_ = false, closing_ = false;
  std::uint16_t code_ = 0;  // of the good-bye
  std::string why_;
};

}  // namespace

void begin_session(ServerEnd end, Loop& loop, Context& context) {
  std::make_shared<Connection>(std::move(end), loop, context)->begin();
}

}  // namespace fulmar::core::live

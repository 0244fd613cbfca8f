// SPDX-License-Identifier: BSD-3-Clause
// Both ends of a WebSocket, and what one thread waits for. Without Boost: Asio's and Beast's templates take
// long to compile, so that websocket.cpp alone knows them. All but Loop::post and Loop::stop belongs to the
// loop's thread.
#pragma once
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace fulmar::core::live {

using Fields = std::vector<std::pair<std::string, std::string>>;  // of an HTTP header

/// Calls what has come, in the thread that runs it.
class Loop {
 public:
  Loop();
  ~Loop();  // what still waits is dropped, not called
  /// Until nothing is waited for, or `stop`. What a call throws comes out here; the loop can be run on.
  void run();
  void stop();
  void post(std::function<void()> task);

  struct Impl;
  Impl& impl() { return *impl_; }

 private:
  std::unique_ptr<Impl> impl_;
};

class Timer {
 public:
  explicit Timer(Loop& loop);
  ~Timer();
  /// In place of what it was started for before. Each `then` is called once: whether its time has come, or
  /// another start or `cancel` was quicker.
  void start(std::chrono::steady_clock::duration after, std::function<void(bool due)> then);
  void cancel();

 private:
  struct Impl;
  std::shared_ptr<Impl> impl_;
};

/// The server's end of a connection: first one HTTP request, then, when it asks for that and is accepted, a
/// WebSocket. One read and one write at a time. What is called back may hold the owner: then the connection
/// lives as long as it has something to wait for.
class ServerEnd {
 public:
  enum class Outcome { good, gone, against_rules };  // gone: nothing that anybody is to blame for
  using Done = std::function<void(Outcome)>;
  struct Impl;
  explicit ServerEnd(std::unique_ptr<Impl> impl);
  ServerEnd(ServerEnd&&) noexcept;
  ~ServerEnd();
  /// Closes the connection at once.
  void cut();

  struct Request {
    std::string target, host, origin, authorization;  // "" when there is none
    std::vector<std::string> protocols;               // that it offers, in its order
    bool contradicts_itself = false;                  // more than one host or origin
    bool upgrade = false;                             // wants a WebSocket
    bool get = false, head = false;                   // the method
    bool more = false;                                // bytes have come behind it
  };
  void read_request(std::size_t most_bytes, Done done);
  const Request& request() const;
  /// The only answer to the request. The body of an answer to HEAD is not sent.
  void respond(unsigned status, const Fields& fields, const std::string& body, std::function<void()> done);
  void shut_down();

  struct Terms {
    std::string protocol;
    int kernel_bytes = 0;  // that the system holds for the client
    std::size_t most_message_bytes = 0;
    std::chrono::seconds handshake_limit{}, idle_limit{};
    std::function<void()> on_control;  // a ping, a pong, or a close has come
  };
  /// Makes a WebSocket of it.
  void accept(Terms terms, Done done);
  void read(Done done);
  std::string_view message() const;  // that was read
  bool got_text() const;
  /// One message. `more`: another one follows at once, so that this one may wait for it. Both parts have to
  /// stay until `done`.
  void write(std::string_view head, std::string_view body, bool binary, bool more, Done done);
  /// Says good-bye. Instead of a write.
  void close(std::uint16_t code, const std::string& why, std::function<void()> done);

 private:
  std::unique_ptr<Impl> impl_;
};

class Listener {
 public:
  explicit Listener(Loop& loop);
  ~Listener();
  static bool is_address(const std::string& text);
  struct Refusal {
    std::string why;
    bool taken = false;  // the port is another program's
  };
  std::optional<Refusal> listen(const std::string& address, std::uint16_t port);
  std::uint16_t port() const;
  /// One connection; nothing when the system has failed to give it.
  void accept(std::function<void(std::optional<ServerEnd>)> done);
  void close();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// The client's end. It blocks and has a loop of its own; every call returns within its time.
class ClientEnd {
 public:
  explicit ClientEnd(std::chrono::milliseconds patience);
  ~ClientEnd();

  enum class Reached { yes, no_host, nobody };
  Reached connect(const std::string& host, std::uint16_t port);

  struct Answer {
    bool accepted = false, declined = false;  // neither: no WebSocket speaks there, `fault` says why
    unsigned status = 0;                      // of one that declines, and its words
    std::string reason, fault;
  };
  /// `host` is what the request names.
  Answer shake_hands(const std::string& host, const Fields& fields, std::size_t most_message_bytes);

  enum class Got { message, nothing, end };
  Got receive(std::chrono::milliseconds limit, std::string& message, bool& binary);
  /// False when the other end has gone.
  bool write(const std::string& data, bool binary);
  /// What the other end said when it closed; "" when it said nothing.
  const std::string& farewell() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace fulmar::core::live

// SPDX-License-Identifier: BSD-3-Clause
// A WebSocket connection to the live view of a running flight. One thread; every call has a time limit.
#pragma once
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "core/error.hpp"

namespace fulmar::core {

/// Address of a flight's server.
struct LiveAddress {
  std::string host = "127.0.0.1";
  std::uint16_t port = 8765;
  std::string token;
  std::string text() const;  // "127.0.0.1:8765"
};

/// "host:port", "host", "port", ":port", "[::1]:8765". Throws Error.
LiveAddress parse_target(const std::string& at, const std::string& token = "");

/// The flight has ended or closed the connection.
struct FlightEnded : Error {
  using Error::Error;
};

class Client {
 public:
  /// Throws Error with the remedy: no server, a missing token, or another program at that address.
  explicit Client(const LiveAddress& target, std::chrono::milliseconds patience = std::chrono::seconds(5));
  ~Client();
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  struct Message {
    bool binary = false;
    std::string data;
  };
  /// No value when no message arrives in that time. Throws FlightEnded.
  std::optional<Message> receive(std::chrono::milliseconds limit);
  void send(const std::string& text);
  void send_binary(const std::string& bytes);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace fulmar::core

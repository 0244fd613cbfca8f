// SPDX-License-Identifier: BSD-3-Clause
// See client.hpp.
#include "tools/fulmar_live/client.hpp"

#include <charconv>

#include "core/error.hpp"
#include "core/live/websocket.hpp"

namespace fulmar::core {
namespace {

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
  live::ClientEnd end;

  Impl(const LiveAddress& t, std::chrono::milliseconds patience) : target(t), end(patience) {}

  void connect() {
    using Reached = live::ClientEnd::Reached;
    const Reached reached = end.connect(target.host, target.port);
    if (reached == Reached::no_host)
      throw Error("there is no host '" + target.host + "': give --at HOST:PORT, as in --at 127.0.0.1:8765");
    if (reached == Reached::nobody)
      throw Error("no flight listens on " + target.text() +
                  ": start one with fulmar run MISSION --speed real --live 8765, or name it with --at");
  }

  void shake_hands() {
    live::Fields fields{{"Sec-WebSocket-Protocol", "foxglove.sdk.v1, foxglove.websocket.v1"},
                        {"User-Agent", "fulmar"}};
    if (!target.token.empty()) fields.emplace_back("Authorization", "Bearer " + target.token);
    const live::ClientEnd::Answer answer = end.shake_hands(target.text(), fields, most_message_bytes);
    if (answer.accepted) return;
    if (!answer.declined)
      throw Error("what listens on " + target.text() + " is no flight (" + answer.fault +
                  "): name one with --at");
    constexpr unsigned unauthorized = 401, forbidden = 403;
    if (answer.status == unauthorized || answer.status == forbidden)
      throw Error("the flight on " + target.text() +
                  (target.token.empty() ? " wants a token" : " refuses this token") +
                  ": give it with --token or in FULMAR_TOKEN");
    throw Error("the flight on " + target.text() +
                " refuses the connection: " + std::to_string(answer.status) + " " + answer.reason);
  }

  void write(const std::string& data, bool binary) {
    if (!end.write(data, binary)) gone();
  }

  [[noreturn]] void gone() const {
    if (!end.farewell().empty())
      throw FlightEnded("the flight on " + target.text() + " has closed the connection: " + end.farewell());
    throw FlightEnded("the flight on " + target.text() + " has ended");
  }
};

Client::Client(const LiveAddress& target, std::chrono::milliseconds patience)
    : impl_(std::make_unique<Impl>(target, patience)) {
  impl_->connect();
  impl_->shake_hands();
}

Client::~Client() = default;

std::optional<Client::Message> Client::receive(std::chrono::milliseconds limit) {
  using Got = live::ClientEnd::Got;
  Message message;
  const Got got = impl_->end.receive(limit, message.data, message.binary);
  if (got == Got::nothing) return std::nullopt;
  if (got == Got::end) impl_->gone();
  return message;
}

void Client::send(const std::string& text) { impl_->write(text, false); }
void Client::send_binary(const std::string& bytes) { impl_->write(bytes, true); }

}  // namespace fulmar::core

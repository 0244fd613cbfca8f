// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_fcu/client.hpp"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <thread>

#include "plugins/fcu_serial/firmware_version.hpp"
#include "tools/fulmar_fcu/messages.hpp"

namespace fulmar::fcu {

namespace {

std::int64_t steady_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

std::string printable(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (c < ' ' || c > '~') c = '?';
  return out;
}

}  // namespace

Endpoint device(const std::string& port, std::int64_t baud) {
  return {port, [=] { return Port::open(port, baud); }, steady_ns};
}

std::string Param::text() const {
  if (whole) return std::to_string(integer());
  const float value = real();
  if (std::isnan(value)) return ".nan";
  if (std::isinf(value)) return value > 0 ? ".inf" : "-.inf";
  std::array<char, 32> room{};
  const auto end = std::to_chars(room.data(), room.data() + room.size(), value).ptr;
  return {room.data(), end};
}

Client::Client(Endpoint endpoint) : endpoint_(std::move(endpoint)), port_(endpoint_.open()) {
  beat_ns_ = now_ns() - second;
}

void Client::reopen(std::int64_t limit_ns) {
  constexpr std::int64_t each = 100 * ms;
  port_.reset();
  parser_.restart();
  for (std::int64_t waited = 0;; waited += each) {
    try {
      port_ = endpoint_.open();
      beat_ns_ = now_ns() - second;
      return;
    } catch (const PortError&) {
      if (waited >= limit_ns) throw;
    }
    std::this_thread::sleep_for(std::chrono::nanoseconds(each));
  }
}

void Client::pump(std::int64_t ns) {
  const std::int64_t until = now_ns() + ns;
  while (now_ns() < until) step(until);
}

bool Client::wait(std::int64_t ns, const std::function<bool()>& done) {
  const std::int64_t until = now_ns() + ns;
  while (!done()) {
    if (now_ns() >= until) return false;
    step(until);
  }
  return true;
}

void Client::step(std::int64_t until_ns) {
  if (cancelled && cancelled()) throw Interrupted();
  const std::int64_t now = now_ns();
  if (now - beat_ns_ >= second) {
    beat_ns_ = now;
    send(Heartbeat{});
  }
  const auto timeout_ms =
      static_cast<int>(std::clamp((until_ns - now + ms - 1) / ms, std::int64_t{1}, std::int64_t{10}));
  std::array<std::uint8_t, 4096> room;
  const std::size_t n = port_->read(room, timeout_ms);
  bytes_ += n;
  const auto readable = [](std::uint8_t b) { return (b >= ' ' && b <= '~') || b == '\r' || b == '\n'; };
  readable_ += static_cast<std::uint64_t>(
      std::count_if(room.begin(), room.begin() + static_cast<std::ptrdiff_t>(n), readable));
  parser_.feed({room.data(), n}, [&](const Packet& packet) { take(packet); });
}

void Client::take(const Packet& packet) {
  last_[packet.id] = packet;
  heard_ns_[packet.id] = now_ns();
  ++count_[packet.id];
  // other messages may have any system id
  if (packet.is<RosflightStatus>()) system_ = packet.system;
  if (packet.is<ParamValue>()) take_param(packet.as<ParamValue>());
  if (packet.is<RosflightCmdAck>()) {
    const auto ack = packet.as<RosflightCmdAck>();
    acks_[ack.command] = {now_ns(), ack.success == 1};
  }
  if (packet.is<RosflightVersion>()) {
    version_ = printable(text(packet.as<RosflightVersion>().version));
    if (version_.empty()) version_ = "without a version";  // counts as an answer
  }
  if (packet.is<Statustext>()) {
    const auto message = packet.as<Statustext>();
    said_.push_back({now_ns(), message.severity, printable(text(message.text))});
  }
  if (on_packet) on_packet(packet);
}

void Client::take_param(const ParamValue& value) {
  if (value.param_index >= value.param_count ||
      (value.param_type != param_int32 && value.param_type != param_real32))
    return;
  param_count_ = value.param_count;
  const std::string name = printable(text(value.param_id));
  params_[name] = {name, value.param_index, value.param_type == param_int32, value.param_value, now_ns()};
}

void Client::send_frame(const Frame& frame) {
  for (int i = 0; i < 5; ++i) {
    if (port_->write(frame.view())) return;
    // output full: keep reading, so that the controller can continue
    std::array<std::uint8_t, 4096> room;
    const std::size_t n = port_->read(room, 5);
    bytes_ += n;
    parser_.feed({room.data(), n}, [&](const Packet& packet) { take(packet); });
  }
}

void Client::explain_silence() const {
  const Parser::Counts& seen = parser_.counts();
  if (bytes_ == 0) throw Error(fcu_messages::port_silent(name()));
  if (seen.frames == 0 && talks_mavlink_2(seen.modern, bytes_))
    throw Error(fcu_messages::mavlink_version_unsupported(name()));
  if (seen.frames == 0 && readable_ * 20 >= bytes_ * 19) throw Error(fcu_messages::text_received(name()));
  if (seen.frames == 0) throw Error(fcu_messages::protocol_unknown(name(), bytes_));
  throw Error(fcu_messages::rosflight_status_missing(name(), seen.frames));
}

void Client::connect() {
  if (!wait(2 * second, [&] { return count<RosflightStatus>() > 0; })) explain_silence();
  ask_version();
  pump(150 * ms);  // texts of its boot, held until the first heartbeat, are dropped
}

void Client::ask_version() {
  for (int i = 0; i < 8 && version_.empty(); ++i) {
    if (const auto ack = acks_.find(static_cast<std::uint8_t>(Command::send_version));
        ack != acks_.end() && !ack->second.success)
      return;
    send(RosflightCmd{static_cast<std::uint8_t>(Command::send_version)});
    wait(250 * ms, [&] { return !version_.empty(); });
  }
  if (version_.empty()) throw Error(fcu_messages::version_not_reported(name()));
  if (major_version(version_).value_or(oldest_firmware) < oldest_firmware)
    throw Error(fcu_messages::firmware_too_old(name(), version_));
}

bool Client::armed() {
  if (age_s<RosflightStatus>() > 0.3) {
    // data that waited on the line, for example during a question to the user, are out of date
    pump(150 * ms);
    const std::uint64_t before = count<RosflightStatus>();
    if (!wait(2 * second, [&] { return count<RosflightStatus>() > before; }))
      throw Error(fcu_messages::status_lost(name()));
  }
  return last<RosflightStatus>()->armed != 0;
}

void Client::refuse_armed(const std::string& deed) {
  if (armed()) throw Error(fcu_messages::aircraft_armed(deed));
}

std::optional<bool> Client::command(Command c, int tries, std::int64_t each_ns) {
  const auto code = static_cast<std::uint8_t>(c);
  acks_.erase(code);
  for (int i = 0; i < tries; ++i) {
    send(RosflightCmd{code});
    if (wait(each_ns, [&] { return acks_.count(code) > 0; })) return acks_[code].success;
  }
  return {};
}

void Client::demand(Command c, const std::string& deed, const std::string& refusal) {
  const std::optional<bool> answer = command(c, 6);
  if (!answer) throw Error(fcu_messages::acknowledgement_timeout(name(), deed));
  if (*answer) return;
  if (armed()) throw Error(fcu_messages::action_refused_armed(deed));
  throw Error(fcu_messages::action_refused(deed, refusal));
}

std::optional<std::int64_t> Client::round_trip_ns(int questions) {
  std::optional<std::int64_t> least;
  for (int i = 0; i < questions; ++i) {
    const std::int64_t asked = now_ns();
    send(Timesync{0, asked});
    const bool came = wait(100 * ms, [&] {
      const auto answer = last<Timesync>();
      return answer && answer->tc1 != 0 && answer->ts1 == asked;
    });
    if (came && (!least || now_ns() - asked < *least)) least = now_ns() - asked;
    pump(5 * ms);
  }
  return least;
}

}  // namespace fulmar::fcu

// SPDX-License-Identifier: BSD-3-Clause
// Messages that the host itself logs: plain structs; their tables are in events.cpp alone. Programs read
// codes and fields. `words` is a sentence for users and may change or be translated.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "core/log/reader.hpp"
#include "core/types/names.hpp"
#include "core/types/type.hpp"
#include "fulmar/diagnostic.hpp"

namespace fulmar::core {

/// Meaning of an event and its valid fields. The label, kind and severity of each are in events.cpp, in this
/// order.
enum class Code : std::uint8_t {
  phase_entered,     // name: the phase
  guard,             // component: it was stopped; cause
  hung,              // as guard, for a process that did not answer in time; name: the call
  over_budget,       // as guard, by wall-clock time
  cannot_take_over,  // component: it cannot take over; cause
  took_over,         // component: it was stopped; name: its fallback
  nobody_else,       // component: the role; name: the component that stays active, as the phase names no
                     // usable one
  vehicle_failed,    // component: the vehicle, with which the flight ends; cause
  late_result,       // component; value_ns: due time of the result that is taken now
  request_taken,     // component; name: the request
  request_refused,   // component; name: the request; cause
  parameter_set,     // component; name: the parameter; value
  guard_reset,       // component
  guard_not_reset,   // component; cause
  failsafe,          // name: the component that caused it; cause
  gave_up,           // the failsafe, requested by a signal
  swapped,           // component: its plugin has been changed
  notice,            // component: its message to the user
  log_failed,        // cause
  concluded,         // `done` or `failed` has decided the end of the flight; the aircraft is still armed
  duration_reached,  // as concluded, decided by the duration of the flight
  signal_refused,    // a signal that must be repeated
  silent,            // the failsafe is over; the pilot has control
  resumed,           // name: the phase; one more for each parameter, with component, name, value
  not_resumed,       // the vehicle is not in the air, armed
  died,              // component: it was stopped because its process has ended; name: the call; cause
};

enum class Severity : std::uint8_t { info, warning, error, critical };

/// Topic /fulmar/event.
struct Event {
  static constexpr const char* topic = "/fulmar/event";
  Code code = Code::phase_entered;
  Severity severity = Severity::info;
  std::array<char, component_room> component{};
  std::array<char, name_room> name{};
  std::int64_t value_ns = 0;  // flight time
  double value = 0;
  // Text of a component about itself, byte for byte: a replay repeats it.
  std::array<char, 256> cause{};
  std::array<char, 512> words{};  // one line of UTF-8, for users
};

/// The same for the log panels of viewers: rcl_interfaces/msg/Log, topic /rosout.
struct LogLine {
  static constexpr const char* topic = "/rosout";
  std::int32_t sec = 0;  // UTC
  std::uint32_t nanosec = 0;
  std::uint8_t level = 20;                  // 10 debug, 20 info, 30 warning, 40 error, 50 fatal
  std::array<char, component_room> name{};  // the component, or "fulmar"
  std::array<char, 512> msg{};
  std::array<char, 4> file{};
  std::array<char, 16> function{};  // kind of the event, from kind_words
  std::uint32_t line = 0;
};

/// Times and hashes of ticks, for a replay: topic /fulmar/ticks, one message for several consecutive ticks.
struct Ticks {
  static constexpr const char* topic = "/fulmar/ticks";
  static constexpr std::uint32_t most = 40;
  std::uint64_t first = 0;
  std::int64_t time_ns = 0;  // of the first tick
  std::uint32_t periods = 0;
  std::array<std::uint32_t, most> period_ns{};  // since the previous tick; 0 for the first of the flight
  std::uint32_t hashes = 0;
  std::array<std::uint32_t, most> hash{};  // of the outputs of all components in the tick, without the
                                           // vehicle and drivers, whose samples are stored
};

/// Calls `take` with the index of each tick in the message and its flight time.
template <class Take>
void each_tick(const Ticks& ticks, const Take& take) {
  std::int64_t time_ns = ticks.time_ns;
  for (std::uint32_t i = 0; i < ticks.hashes && i < ticks.periods; ++i) {
    if (i > 0) time_ns += ticks.period_ns[i];
    take(i, time_ns);
  }
}

enum class CommandKind : std::uint8_t { parameter, phase, swap, reset, request, import };

/// Accepted input from outside the flight: topic /fulmar/parameter, and /fulmar/command for all but
/// parameters. The message of a request or import is in the topic of its port; the log holds no other copy.
struct CommandNote {
  static constexpr const char *topic = "/fulmar/command", *parameter_topic = "/fulmar/parameter";
  CommandKind kind = CommandKind::parameter;
  std::array<char, component_room> component{};
  std::array<char, name_room> name{};  // of the parameter or phase
  std::array<double, 3> number{};      // value of a parameter: a number or vector
  std::int64_t integer = 0;            // of a count, choice or flag
  std::array<char, 256> text{};    // a text; any other value in the form of a mission file; for a swap the
                                   // plugin's file
  std::array<char, 64> version{};  // of the plugin
  std::array<char, 65> sha256{};
};

/// Type table of a struct above.
template <class Message>
const TypePtr& host_type();
template <>
const TypePtr& host_type<Event>();
template <>
const TypePtr& host_type<Ticks>();
template <>
const TypePtr& host_type<CommandNote>();
template <>
const TypePtr& host_type<LogLine>();

/// Kind of the event, for users: "phase", "guard", "request", ...
const char* kind_words(Code code) noexcept;

/// An event of this code, with the code's severity. [tick]
Event event_of(Code code, std::string_view component = {}, std::string_view name = {}) noexcept;
/// [tick] Log line of an event for viewers. `utc_ns`: since 1970.
LogLine log_line_of(const Event& event, std::int64_t utc_ns) noexcept;
/// [tick] Replaces the end of a truncated sentence by dots, after a whole word.
void end_in_dots(char* text, std::size_t room) noexcept;
/// [tick] Makes a component's text safe for terminals, logs and JSON: one line of UTF-8.
void make_printable(char* text) noexcept;
/// [tick] Sets the event's sentence: one line of UTF-8; a text that is too long ends in dots.
void say(Event& event, std::string_view text) noexcept;
template <std::size_t N, class... Values>
void say(Event& event, const MessageText<N>& text, const Values&... values) noexcept {
  const std::size_t size = text.write(event.words.data(), event.words.size(), values...);
  if (size >= event.words.size()) end_in_dots(event.words.data(), event.words.size());
  make_printable(event.words.data());
}

/// [tick] Copies a text and its terminating zero; text beyond the room is dropped.
template <std::size_t N>
void put(std::array<char, N>& to, std::string_view text) noexcept {
  const std::size_t size = text.size() < N ? text.size() : N - 1;
  for (std::size_t i = 0; i < size; ++i) to[i] = text[i];
  to[size] = '\0';
}

/// Reads the structs above from a log: the messages of one topic, when the log's table equals ours.
class HostMessages {
 public:
  HostMessages(const McapFile& file, const char* topic, TypePtr type);
  bool there() const { return there_; }
  bool same() const { return same_; }
  bool holds(const McapFile::Message& m) const { return same_ && m.channel == channel_; }
  std::uint16_t channel() const { return channel_; }
  /// Throws Error when the topic exists with other fields.
  void check() const;

 protected:
  void decode(std::span<const std::byte> bytes, std::byte* message) const;

 private:
  const char* topic_;
  TypePtr type_;
  bool there_ = false, same_ = false;
  std::uint16_t channel_ = 0;
};

template <class Message>
struct HostTopic : HostMessages {
  explicit HostTopic(const McapFile& file, const char* topic = Message::topic)
      : HostMessages(file, topic, host_type<Message>()) {}
  /// Decodes one message. Throws Error when the bytes do not fit.
  Message read(std::span<const std::byte> bytes) const {
    Message message;
    decode(bytes, reinterpret_cast<std::byte*>(&message));
    return message;
  }
};

}  // namespace fulmar::core

// SPDX-License-Identifier: BSD-3-Clause
// What the host itself logs: plain structs, whose tables stand in events.cpp and nowhere else. Programs read
// codes and fields; `words` are for people and may be worded anew, or translated, without anybody else taking
// notice.
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

/// What an event tells, and which of its fields count. The label, kind and severity of each stand in
/// events.cpp, in this order.
enum class Code : std::uint8_t {
  phase_entered,     // name: the phase
  guard,             // component: it was stopped; cause
  hung,              // the same, of one whose process did not answer in time; name: the call
  over_budget,       // the same, by the wall clock
  cannot_take_over,  // component: it was to fly; cause
  took_over,         // component: it was stopped; name: its fallback
  nobody_else,       // component: the role; name: who goes on in it, as nobody that the phase names can
  vehicle_failed,    // component: the vehicle, with which the flight ends; cause
  late_result,       // component; value_ns: when the result was due that is taken now
  request_taken,     // component; name: the request
  request_refused,   // component; name: the request; cause
  parameter_set,     // component; name: the parameter; value
  guard_reset,       // component
  guard_not_reset,   // component; cause
  failsafe,          // name: the component whose fault it is; cause
  gave_up,           // the failsafe, asked for by a signal
  swapped,           // component: its plugin has been changed
  notice,            // component: what it has to tell people
  log_failed,        // cause
  concluded,         // `done` or `failed` has decided how the flight of an aircraft ends that is still armed
  duration_reached,  // the same, decided by whoever set the flight's duration
  signal_refused,    // a signal that has to be repeated
  silent,            // the failsafe is over: the pilot's
  resumed,           // name: the phase; one more for each parameter, with component, name, value
  not_resumed,       // the vehicle is not in the air, armed
  died,              // component: it was stopped, since its process has ended; name: the call; cause
};

enum class Severity : std::uint8_t { info, warning, error, critical };

/// What happened: topic /fulmar/event.
struct Event {
  static constexpr const char* topic = "/fulmar/event";
  Code code = Code::phase_entered;
  Severity severity = Severity::info;
  std::array<char, component_room> component{};
  std::array<char, name_room> name{};
  std::int64_t value_ns = 0;  // flight time
  double value = 0;
  // What a component said of itself, byte for byte: in a replay its stand-in says it again.
  std::array<char, 256> cause{};
  std::array<char, 512> words{};  // one line of UTF-8, for people
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
  std::array<char, 16> function{};  // the kind of event, as kind_words has it
  std::uint32_t line = 0;
};

/// When the ticks were, and what came of them, for a replay: topic /fulmar/ticks, one message for some ticks
/// in a row.
struct Ticks {
  static constexpr const char* topic = "/fulmar/ticks";
  static constexpr std::uint32_t most = 40;
  std::uint64_t first = 0;
  std::int64_t time_ns = 0;  // of the first
  std::uint32_t periods = 0;
  std::array<std::uint32_t, most> period_ns{};  // since the tick before; 0 for the first of the flight
  std::uint32_t hashes = 0;
  std::array<std::uint32_t, most> hash{};  // of what components published in it, but for the vehicle and
                                           // drivers, whose samples are stored
};

/// `take` gets the place of each tick in the message, and its flight time.
template <class Take>
void each_tick(const Ticks& ticks, const Take& take) {
  std::int64_t time_ns = ticks.time_ns;
  for (std::uint32_t i = 0; i < ticks.hashes && i < ticks.periods; ++i) {
    if (i > 0) time_ns += ticks.period_ns[i];
    take(i, time_ns);
  }
}

enum class CommandKind : std::uint8_t { parameter, phase, swap, reset, request, import };

/// What was asked of a flight from outside, and taken: topic /fulmar/parameter, and /fulmar/command for all
/// but parameters. The message of a request or import stands in the topic of its port, and is all that the
/// log holds of it.
struct CommandNote {
  static constexpr const char *topic = "/fulmar/command", *parameter_topic = "/fulmar/parameter";
  CommandKind kind = CommandKind::parameter;
  std::array<char, component_room> component{};
  std::array<char, name_room> name{};  // of the parameter, of the phase
  std::array<double, 3> number{};      // a parameter's value: a number or vector
  std::int64_t integer = 0;            // of a count, choice or flag
  std::array<char, 256> text{};  // a text; any other value as in a mission file; of a swap the plugin's file
  std::array<char, 64> version{};  // of the plugin
  std::array<char, 65> sha256{};
};

/// The table of a struct above.
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

/// What kind of event it is, for people: "phase", "guard", "request", ...
const char* kind_words(Code code) noexcept;

/// An event of this code, with the code's severity. [tick]
Event event_of(Code code, std::string_view component = {}, std::string_view name = {}) noexcept;
/// [tick] An event as viewers list it. `utc_ns`: since 1970.
LogLine log_line_of(const Event& event, std::int64_t utc_ns) noexcept;
/// [tick] A sentence that was cut at the end of its room ends in dots instead, behind a whole word.
void end_in_dots(char* text, std::size_t room) noexcept;
/// What a component says of itself goes to terminals, logs and JSON: one line of UTF-8. [tick]
void make_printable(char* text) noexcept;
/// The event's sentence: one line of UTF-8; a text that is too long ends in dots. [tick]
void say(Event& event, std::string_view text) noexcept;
template <std::size_t N, class... Values>
void say(Event& event, const MessageText<N>& text, const Values&... values) noexcept {
  const std::size_t size = text.write(event.words.data(), event.words.size(), values...);
  if (size >= event.words.size()) end_in_dots(event.words.data(), event.words.size());
  make_printable(event.words.data());
}

/// [tick] A text and the zero at its end; what does not fit is left out.
template <std::size_t N>
void put(std::array<char, N>& to, std::string_view text) noexcept {
  const std::size_t size = text.size() < N ? text.size() : N - 1;
  for (std::size_t i = 0; i < size; ++i) to[i] = text[i];
  to[size] = '\0';
}

/// The one way from a log to the structs above: the messages of one topic, where the log's table of them is
/// ours.
class HostMessages {
 public:
  HostMessages(const McapFile& file, const char* topic, TypePtr type);
  bool there() const { return there_; }
  bool same() const { return same_; }
  bool holds(const McapFile::Message& m) const { return same_ && m.channel == channel_; }
  std::uint16_t channel() const { return channel_; }
  /// Throws Error when the topic is there with other fields.
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
  /// Of a message that it holds. Throws Error when the bytes do not fit.
  Message read(std::span<const std::byte> bytes) const {
    Message message;
    decode(bytes, reinterpret_cast<std::byte*>(&message));
    return message;
  }
};

}  // namespace fulmar::core

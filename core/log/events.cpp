// SPDX-License-Identifier: BSD-3-Clause
#include "core/log/events.hpp"

#include <cstdio>
#include <cstring>
#include <iterator>
#include <utility>

#include "core/error.hpp"
#include "core/log/messages.hpp"
#include "core/types/wire.hpp"

namespace fulmar::core {
namespace {

struct CodeRow {
  Code code;
  const char *label, *kind;
  Severity severity = Severity::info;
};

constexpr CodeRow code_rows[] = {
    {Code::phase_entered, "phase_entered", "phase"},
    {Code::guard, "guard", "guard", Severity::warning},
    {Code::hung, "hung", "guard", Severity::warning},
    {Code::over_budget, "over_budget", "guard", Severity::warning},
    {Code::cannot_take_over, "cannot_take_over", "guard", Severity::warning},
    {Code::took_over, "took_over", "guard", Severity::warning},
    {Code::nobody_else, "nobody_else", "guard", Severity::warning},
    {Code::vehicle_failed, "vehicle_failed", "guard", Severity::critical},
    {Code::late_result, "late_result", "notice"},
    {Code::request_taken, "request_taken", "request"},
    {Code::request_refused, "request_refused", "request"},
    {Code::parameter_set, "parameter_set", "parameter"},
    {Code::guard_reset, "guard_reset", "request"},
    {Code::guard_not_reset, "guard_not_reset", "request"},
    {Code::failsafe, "failsafe", "failsafe", Severity::critical},
    {Code::gave_up, "gave_up", "failsafe", Severity::critical},
    {Code::swapped, "swapped", "swap"},
    {Code::notice, "notice", "notice"},
    {Code::log_failed, "log_failed", "notice", Severity::warning},
    {Code::concluded, "concluded", "end"},
    {Code::duration_reached, "duration_reached", "end"},
    {Code::signal_refused, "signal_refused", "end", Severity::warning},
    {Code::silent, "silent", "end", Severity::warning},
    {Code::resumed, "resumed", "resume", Severity::warning},
    {Code::not_resumed, "not_resumed", "resume"},
    {Code::died, "died", "guard", Severity::warning},
};

constexpr bool in_order() {
  for (std::size_t i = 0; i < std::size(code_rows); ++i)
    if (static_cast<std::size_t>(code_rows[i].code) != i) return false;
  return code_rows[std::size(code_rows) - 1].code == Code::died;
}
static_assert(in_order());

const CodeRow& row_of(Code code) noexcept { return code_rows[static_cast<std::size_t>(code)]; }

std::vector<std::string> code_labels() {
  std::vector<std::string> labels;
  for (const CodeRow& row : code_rows) labels.emplace_back(row.label);
  return labels;
}

Field enum_field(const char* name, std::size_t offset, std::vector<std::string> labels) {
  Field field = host_field(name, FULMAR_ENUM, offset);
  field.labels = std::move(labels);
  return field;
}

Field array_field(const char* name, fulmar_kind kind, std::size_t offset, std::size_t count) {
  Field field = host_field(name, kind, offset);
  field.shape = FULMAR_ARRAY;
  field.count = static_cast<std::uint32_t>(count);
  return field;
}

/// `offset`: of the list's count.
Field list_field(const char* name, fulmar_kind kind, std::size_t offset, std::size_t items,
                 std::size_t count) {
  Field field = array_field(name, kind, offset, count);
  field.shape = FULMAR_LIST;
  field.items = static_cast<std::uint32_t>(items - offset);
  return field;
}

}  // namespace

template <>
const TypePtr& host_type<Event>() {
  using E = Event;
  static const TypePtr type =
      host_struct("Event", sizeof(E), alignof(E),
                  {enum_field("code", offsetof(E, code), code_labels()),
                   enum_field("severity", offsetof(E, severity), {"info", "warning", "error", "critical"}),
                   host_field("component", FULMAR_TEXT, offsetof(E, component), sizeof(E::component)),
                   host_field("name", FULMAR_TEXT, offsetof(E, name), sizeof(E::name)),
                   host_field("value_ns", FULMAR_I64, offsetof(E, value_ns)),
                   host_field("value", FULMAR_F64, offsetof(E, value)),
                   host_field("cause", FULMAR_TEXT, offsetof(E, cause), sizeof(E::cause)),
                   host_field("words", FULMAR_TEXT, offsetof(E, words), sizeof(E::words))});
  return type;
}

template <>
const TypePtr& host_type<Ticks>() {
  using T = Ticks;
  static const TypePtr type =
      host_struct("Ticks", sizeof(T), alignof(T),
                  {host_field("first", FULMAR_U64, offsetof(T, first)),
                   host_field("time_ns", FULMAR_I64, offsetof(T, time_ns)),
                   list_field("period_ns", FULMAR_U32, offsetof(T, periods), offsetof(T, period_ns), T::most),
                   list_field("hash", FULMAR_U32, offsetof(T, hashes), offsetof(T, hash), T::most)});
  return type;
}

template <>
const TypePtr& host_type<CommandNote>() {
  using C = CommandNote;
  static const TypePtr type = host_struct(
      "Command", sizeof(C), alignof(C),
      {enum_field("kind", offsetof(C, kind), {"parameter", "phase", "swap", "reset", "request", "import"}),
       host_field("component", FULMAR_TEXT, offsetof(C, component), sizeof(C::component)),
       host_field("name", FULMAR_TEXT, offsetof(C, name), sizeof(C::name)),
       array_field("number", FULMAR_F64, offsetof(C, number), 3),
       host_field("integer", FULMAR_I64, offsetof(C, integer)),
       host_field("text", FULMAR_TEXT, offsetof(C, text), sizeof(C::text)),
       host_field("version", FULMAR_TEXT, offsetof(C, version), sizeof(C::version)),
       host_field("sha256", FULMAR_TEXT, offsetof(C, sha256), sizeof(C::sha256))});
  return type;
}

/// Names, kinds and order are those of ROS 2: viewers identify the type by its name.
template <>
const TypePtr& host_type<LogLine>() {
  using L = LogLine;
  static const TypePtr type = [] {
    const auto ros = [](const char* name, const char* whole, std::size_t size, std::size_t align,
                        std::vector<Field> fields) {
      Type named = *host_struct(name, size, align, std::move(fields));
      named.ros = whole;
      return std::make_shared<const Type>(std::move(named));
    };
    Field stamp;
    stamp.name = "stamp";
    stamp.kind = FULMAR_STRUCT;
    stamp.offset = offsetof(L, sec);
    stamp.stride = 8;
    stamp.type = ros("Time", "builtin_interfaces/msg/Time", 8, 4,
                     {host_field("sec", FULMAR_I32, 0), host_field("nanosec", FULMAR_U32, 4)});
    return ros("Log", "rcl_interfaces/msg/Log", sizeof(L), alignof(L),
               {stamp, host_field("level", FULMAR_U8, offsetof(L, level)),
                host_field("name", FULMAR_TEXT, offsetof(L, name), sizeof(L::name)),
                host_field("msg", FULMAR_TEXT, offsetof(L, msg), sizeof(L::msg)),
                host_field("file", FULMAR_TEXT, offsetof(L, file), sizeof(L::file)),
                host_field("function", FULMAR_TEXT, offsetof(L, function), sizeof(L::function)),
                host_field("line", FULMAR_U32, offsetof(L, line))});
  }();
  return type;
}

// ---- events

const char* kind_words(Code code) noexcept {
  return static_cast<std::size_t>(code) < std::size(code_rows) ? row_of(code).kind : "unknown";
}

Event event_of(Code code, std::string_view component, std::string_view name) noexcept {
  Event e;
  e.code = code;
  e.severity = row_of(code).severity;
  put(e.component, component);
  put(e.name, name);
  return e;
}

LogLine log_line_of(const Event& e, std::int64_t utc_ns) noexcept {
  constexpr std::int64_t second_ns = 1'000'000'000;
  LogLine line;
  const std::int64_t sec = utc_ns / second_ns - (utc_ns % second_ns < 0 ? 1 : 0);
  line.sec = static_cast<std::int32_t>(sec);
  line.nanosec = static_cast<std::uint32_t>(utc_ns - sec * second_ns);
  line.level = static_cast<std::uint8_t>(20 + 10 * static_cast<int>(e.severity));
  put(line.name, e.component[0] != '\0' ? e.component.data() : "fulmar");
  put(line.msg, e.words.data());
  put(line.function, kind_words(e.code));
  return line;
}

void end_in_dots(char* text, std::size_t room) noexcept {
  std::size_t end = room - 4;  // three dots and the zero
  while (end > room / 2 && text[end] != ' ') --end;
  if (text[end] != ' ') end = room - 4;  // one long word
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80) --end;
  std::memcpy(text + end, "...", 4);
}

void say(Event& e, std::string_view text) noexcept {
  put(e.words, text);
  if (text.size() >= e.words.size()) end_in_dots(e.words.data(), e.words.size());
  make_printable(e.words.data());
}

void make_printable(char* text) noexcept {
  for (auto* p = reinterpret_cast<unsigned char*>(text); *p != 0;) {
    const int more = *p < 0x80                           ? 0
                     : (*p & 0xe0) == 0xc0 && *p >= 0xc2 ? 1
                     : (*p & 0xf0) == 0xe0               ? 2
                     : *p >= 0xf0                        ? 3
                                                         : -1;
    int there = 0;
    while (there < more && (p[there + 1] & 0xc0) == 0x80) ++there;
    const bool too_long = (*p == 0xe0 && p[1] < 0xa0) || (*p == 0xf0 && p[1] < 0x90);  // overlong encoding
    const bool no_character = (*p == 0xed && p[1] >= 0xa0) || *p > 0xf4 || (*p == 0xf4 && p[1] >= 0x90);
    if (more < 0 || there < more || too_long || no_character) {
      *p++ = '?';
      continue;
    }
    if (*p < 0x20 || *p == 0x7f) *p = ' ';
    if (*p == 0xc2 && p[1] < 0xa0) p[0] = p[1] = ' ';  // U+0080 to U+009F: control characters for a terminal
    p += more + 1;
  }
}

// ---- reading a log

HostMessages::HostMessages(const McapFile& file, const char* topic, TypePtr type)
    : topic_(topic), type_(std::move(type)) {
  for (const auto& [id, channel] : file.channels) {
    if (channel.topic != topic) continue;
    const auto schema = file.schemas.find(channel.schema);
    there_ = true;
    channel_ = id;
    same_ = schema != file.schemas.end() && schema->second.text == ros_definition(*type_);
  }
}

void HostMessages::check() const {
  if (there_ && !same_) throw Error(log_messages::host_fields_differ(topic_, type_->name));
}

void HostMessages::decode(std::span<const std::byte> bytes, std::byte* message) const {
  cdr_decode(*type_, bytes.data(), bytes.size(), message);
}

}  // namespace fulmar::core

// SPDX-License-Identifier: BSD-3-Clause
// See events.hpp.
#include "core/log/events.hpp"

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <iterator>
#include <limits>
#include <utility>

#include "core/error.hpp"
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
};

constexpr bool in_order() {
  for (std::size_t i = 0; i < std::size(code_rows); ++i)
    if (static_cast<std::size_t>(code_rows[i].code) != i) return false;
  return code_rows[std::size(code_rows) - 1].code == Code::not_resumed;
}
static_assert(in_order());

const CodeRow& row_of(Code code) noexcept { return code_rows[static_cast<std::size_t>(code)]; }

std::vector<std::string> code_labels() {
  std::vector<std::string> labels;
  for (const CodeRow& row : code_rows) labels.emplace_back(row.label);
  return labels;
}

/// Lists the members of a struct; kind and place of each are those that the compiler knows.
template <class Message>
class HostTable {
 public:
  explicit HostTable(const char* name) {
    type_.name = name;
    type_.size = sizeof(Message), type_.align = alignof(Message);
  }
  template <std::size_t N>
  HostTable& add(const char* name, std::array<char, N> Message::*member) {
    return field(name, FULMAR_TEXT, member, N);
  }
  HostTable& add(const char* name, std::uint64_t Message::*member) {
    return field(name, FULMAR_U64, member, 8);
  }
  HostTable& add(const char* name, std::int64_t Message::*member) {
    return field(name, FULMAR_I64, member, 8);
  }
  HostTable& add(const char* name, double Message::*member) {
    return number(field(name, FULMAR_F64, member, 8));
  }
  template <std::size_t N>
  HostTable& add(const char* name, std::array<double, N> Message::*member) {
    number(field(name, FULMAR_F64, member, 8));
    type_.fields.back().shape = FULMAR_ARRAY, type_.fields.back().count = N;
    return *this;
  }
  template <class Enum>
  HostTable& add(const char* name, Enum Message::*member, std::vector<std::string> labels) {
    static_assert(sizeof(Enum) == 1);
    field(name, FULMAR_ENUM, member, 1);
    type_.fields.back().labels = std::move(labels);
    return *this;
  }
  template <std::size_t N>
  HostTable& add(const char* name, std::uint32_t Message::*count,
                 std::array<std::uint32_t, N> Message::*items) {
    field(name, FULMAR_U32, count, 4);
    Field& f = type_.fields.back();
    f.shape = FULMAR_LIST, f.count = N, f.items = offset(items) - f.offset;
    return *this;
  }
  TypePtr type() const { return std::make_shared<const Type>(type_); }

 private:
  template <class Member>
  static std::uint32_t offset(Member Message::*member) {
    static const Message one{};
    return static_cast<std::uint32_t>(reinterpret_cast<const std::byte*>(&(one.*member)) -
                                      reinterpret_cast<const std::byte*>(&one));
  }
  template <class Member>
  HostTable& field(const char* name, fulmar_kind kind, Member Message::*member, std::size_t stride) {
    Field f;
    f.name = name, f.kind = kind, f.offset = offset(member), f.stride = static_cast<std::uint32_t>(stride);
    type_.fields.push_back(std::move(f));
    return *this;
  }
  HostTable& number(HostTable& table) {
    type_.fields.back().max = std::numeric_limits<double>::infinity();
    type_.fields.back().min = -type_.fields.back().max;
    return table;
  }

  Type type_;
};

}  // namespace

template <>
const TypePtr& host_type<Event>() {
  static const TypePtr type = HostTable<Event>("Event")
                                  .add("code", &Event::code, code_labels())
                                  .add("severity", &Event::severity, {"info", "warning", "error", "critical"})
                                  .add("component", &Event::component)
                                  .add("name", &Event::name)
                                  .add("value_ns", &Event::value_ns)
                                  .add("value", &Event::value)
                                  .add("cause", &Event::cause)
                                  .add("words", &Event::words)
                                  .type();
  return type;
}

template <>
const TypePtr& host_type<Ticks>() {
  static const TypePtr type = HostTable<Ticks>("Ticks")
                                  .add("first", &Ticks::first)
                                  .add("time_ns", &Ticks::time_ns)
                                  .add("period_ns", &Ticks::periods, &Ticks::period_ns)
                                  .add("hash", &Ticks::hashes, &Ticks::hash)
                                  .type();
  return type;
}

template <>
const TypePtr& host_type<CommandNote>() {
  static const TypePtr type =
      HostTable<CommandNote>("Command")
          .add("kind", &CommandNote::kind, {"parameter", "phase", "swap", "reset", "request", "import"})
          .add("component", &CommandNote::component)
          .add("name", &CommandNote::name)
          .add("number", &CommandNote::number)
          .add("integer", &CommandNote::integer)
          .add("text", &CommandNote::text)
          .add("version", &CommandNote::version)
          .add("sha256", &CommandNote::sha256)
          .type();
  return type;
}

// ---- events

const char* kind_words(Code code) noexcept {
  return static_cast<std::size_t>(code) < std::size(code_rows) ? row_of(code).kind : "unknown";
}

Event event_of(Code code, std::string_view component, std::string_view name) noexcept {
  Event e;
  e.code = code, e.severity = row_of(code).severity;
  put(e.component, component), put(e.name, name);
  return e;
}

void say(Event& e, const char* format, ...) noexcept {
  std::va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(e.words.data(), e.words.size(), format, arguments);
  va_end(arguments);
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
    const bool too_long =
        (*p == 0xe0 && p[1] < 0xa0) || (*p == 0xf0 && p[1] < 0x90);  // a shorter form exists
    const bool no_character = (*p == 0xed && p[1] >= 0xa0) || *p > 0xf4 || (*p == 0xf4 && p[1] >= 0x90);
    if (more < 0 || there < more || too_long || no_character) {
      *p++ = '?';
      continue;
    }
    if (*p < 0x20 || *p == 0x7f) *p = ' ';
    p += more + 1;
  }
}

// ---- out of a log

HostMessages::HostMessages(const McapFile& file, const char* topic, TypePtr type)
    : topic_(topic), type_(std::move(type)) {
  for (const auto& [id, channel] : file.channels) {
    if (channel.topic != topic) continue;
    const auto schema = file.schemas.find(channel.schema);
    there_ = true, channel_ = id;
    same_ = schema != file.schemas.end() && schema->second.text == ros_definition(*type_);
  }
}

void HostMessages::check() const {
  if (there_ && !same_)
    throw Error(std::string("the log's ") + topic_ + " has other fields than " + type_->name +
                " has here: it was written by another version");
}

void HostMessages::decode(std::span<const std::byte> bytes, std::byte* message) const {
  cdr_decode(*type_, bytes.data(), bytes.size(), message);
}

}  // namespace fulmar::core

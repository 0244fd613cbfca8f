// SPDX-License-Identifier: BSD-3-Clause
// Errors, warnings and notices: each has a code, arguments and a place. Its sentence is in the catalogue of
// its folder (messages.hpp) alone. A call of an entry allocates, and is for set-up; `write` does not
// allocate, and may be used in a tick.
#pragma once
#include <algorithm>
#include <array>
#include <charconv>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace fulmar {

namespace detail {

// Read at load time, not in a tick. Hidden: two plugin files must not share it, so that each can be unloaded.
[[gnu::visibility("hidden")]] inline const bool codes_wanted = [] {
  const char* const set = std::getenv("FULMAR_MESSAGES");
  return set != nullptr && std::string_view(set) == "codes";
}();

}  // namespace detail

/// True if messages are written as `code(argument, ...)` instead of their sentences: FULMAR_MESSAGES=codes in
/// the environment. For scripts and tests that read messages: a sentence may change, a code does not.
inline bool writes_codes() noexcept { return detail::codes_wanted; }

/// Name of an argument in the catalogue, and its value.
struct Argument {
  std::string name;
  std::variant<std::string, std::int64_t, std::uint64_t, double> value;

  std::string text() const {
    if (const auto* text = std::get_if<std::string>(&value)) return *text;
    if (const auto* whole = std::get_if<std::int64_t>(&value)) return std::to_string(*whole);
    if (const auto* count = std::get_if<std::uint64_t>(&value)) return std::to_string(*count);
    std::array<char, 32> room{};
    const auto end = std::to_chars(room.data(), room.data() + room.size(), std::get<double>(value));
    return {room.data(), end.ptr};
  }
};

/// A message with its arguments. `text` is the sentence, without the place and the path.
struct Diagnostic {
  std::string code;  // "graph.key_unknown"; "" for a text of another program or plugin
  std::vector<Argument> arguments;
  std::string place;  // "hourglass.yaml:12"; "" without a file
  std::string path;   // "components.slc.rate", an option, or ""
  std::string text;

  Diagnostic() = default;
  Diagnostic(std::string foreign) : text(std::move(foreign)) {}
  Diagnostic(const char* foreign) : text(foreign) {}

  operator std::string() const { return line(); }
  /// "hourglass.yaml:12: components.slc.rate: the sentence"
  std::string line() const {
    std::string all;
    for (const std::string* part : {&place, &path})
      if (!part->empty()) all += *part + ": ";
    return all + text;
  }
};

/// A number with this many digits behind the point.
struct Fixed {
  double value;
  int digits;
};

namespace detail {

/// Text of limited size: characters beyond it are counted and left out.
struct Room {
  char* data;
  std::size_t size;  // including the final zero
  std::size_t used = 0;

  void put(std::string_view text) noexcept {
    for (const char c : text) {
      if (used + 1 < size) data[used] = c;
      ++used;
    }
  }
  void close() noexcept {
    if (size > 0) data[used < size ? used : size - 1] = '\0';
  }
};

/// One argument as text, without allocation.
struct Written {
  std::array<char, 32> room{};
  std::string_view text;

  explicit Written(std::string_view value) noexcept : text(value) {}
  explicit Written(const char* value) noexcept : text(value) {}
  template <class Number>
  requires std::integral<Number> || std::floating_point<Number>
  explicit Written(Number value) noexcept {
    const auto end = std::to_chars(room.data(), room.data() + room.size(), value);
    text = {room.data(), static_cast<std::size_t>(end.ptr - room.data())};
  }
  explicit Written(Fixed number) noexcept {
    const auto end = std::to_chars(room.data(), room.data() + room.size(), number.value,
                                   std::chars_format::fixed, number.digits);
    text = {room.data(), end.ec == std::errc() ? static_cast<std::size_t>(end.ptr - room.data()) : 0};
  }
  Written(const Written&) = delete;
  Written& operator=(const Written&) = delete;
};

}  // namespace detail

/// An entry of a catalogue: the code, the names of the arguments in the order of the call, and the sentence.
/// In the sentence `{name}` stands for an argument and `{{` for a brace. A call makes the message:
///   inline constexpr MessageText key_unknown{"graph.key_unknown", {"key"}, "there is no key '{key}'"};
///   throw Error(key_unknown(name));
/// Hidden, because two plugin files must not share an entry.
template <std::size_t N>
class [[gnu::visibility("hidden")]] MessageText {
 public:
  // An unknown name between braces is a compile error.
  constexpr MessageText(const char* code, const char* text) requires(N == 0) : code_(code), text_(text) {
    check();
  }
  template <std::size_t M>
  requires(M == N) constexpr MessageText(const char* code, const char* const(&names)[M], const char* text)
      : code_(code), text_(text) {
    for (std::size_t i = 0; i < N; ++i) names_[i] = names[i];
    check();
  }

  constexpr std::string_view code() const { return code_; }
  /// For a message without arguments. [tick]
  const char* c_str() const noexcept requires(N == 0) { return writes_codes() ? code_ : text_; }

  template <class... Values>
  requires(sizeof...(Values) == N) Diagnostic operator()(const Values&... values) const {
    Diagnostic made;
    made.code = code_;
    made.arguments.reserve(N);
    std::size_t i = 0;
    (made.arguments.push_back({names_[i++], value_of(values)}), ...);
    made.text = text_of(made.arguments);
    return made;
  }

  /// Writes into `size` characters, including a final zero. Returns the length of the whole text, as snprintf
  /// does. [tick]
  template <class... Values>
  requires(sizeof...(Values) == N) std::size_t write(char* room, std::size_t size, const Values&... values)
  const noexcept {
    detail::Room out{room, size};
    if constexpr (N == 0) {
      put(out, [](std::size_t) { return std::string_view(); });
    } else {
      const std::array<detail::Written, N> written{detail::Written(values)...};
      put(out, [&](std::size_t i) { return written[i].text; });
    }
    out.close();
    return out.used;
  }

  /// As a text of limited size: `notice.text = low.to<Text<96>>(height)`. [tick]
  template <class Fit, class... Values>
  requires(sizeof...(Values) == N) Fit to(const Values&... values)
  const noexcept {
    Fit made{};
    write(made.bytes.data(), made.bytes.size(), values...);
    return made;
  }

 private:
  template <class Out, class TextOf>
  void put(Out & out, const TextOf& argument) const {
    if (writes_codes())
      put_key(out, argument);
    else
      put_sentence(out, argument);
  }

  template <class Value>
  static decltype(Argument::value) value_of(const Value& value) {
    static_assert(!std::same_as<Value, bool>, "name the two states as text");
    if constexpr (std::same_as<Value, char>) {
      return std::string(1, value);
    } else if constexpr (std::unsigned_integral<Value>) {
      return static_cast<std::uint64_t>(value);
    } else if constexpr (std::integral<Value>) {
      return static_cast<std::int64_t>(value);
    } else if constexpr (std::floating_point<Value>) {
      return static_cast<double>(value);
    } else if constexpr (std::same_as<Value, Fixed>) {
      return std::string(detail::Written(value).text);
    } else if constexpr (std::same_as<Value, Diagnostic>) {
      return value.line();
    } else {
      return std::string(value);
    }
  }

  /// Length of the argument's name in `at` after its '{'; sets `index` to its index.
  constexpr std::size_t name_length(std::string_view at, std::size_t & index) const {
    const std::size_t end = at.find('}');
    for (index = 0; index < N; ++index)
      if (end != std::string_view::npos && at.substr(0, end) == names_[index]) return end;
    throw std::invalid_argument("a name in braces is not an argument of the message");
  }

  constexpr void check() const {
    const std::string_view text = text_;
    std::array<bool, N + 1> used{};
    for (std::size_t i = 0; i < text.size(); ++i) {
      if (text[i] != '{') continue;
      ++i;
      if (i < text.size() && text[i] == '{') continue;
      std::size_t index = 0;
      i += name_length(text.substr(i), index);
      used[index] = true;
    }
    for (std::size_t i = 0; i < N; ++i)
      if (!used[i]) throw std::invalid_argument("an argument does not stand in the sentence");
  }

  template <class Out, class TextOf>
  void put_sentence(Out & out, const TextOf& argument) const {
    const std::string_view text = text_;
    for (std::size_t i = 0; i < text.size(); ++i) {
      const std::size_t brace = std::min(text.find('{', i), text.size());
      out.put(text.substr(i, brace - i));
      if (brace == text.size()) return;
      i = brace + 1;
      if (text[i] == '{') {
        out.put("{");
        continue;
      }
      std::size_t index = 0;
      i += name_length(text.substr(i), index);
      out.put(argument(index));
    }
  }

  template <class Out, class TextOf>
  void put_key(Out & out, const TextOf& argument) const {
    out.put(code_);
    for (std::size_t i = 0; i < N; ++i) {
      out.put(i == 0 ? "(" : ", ");
      out.put(argument(i));
    }
    if (N > 0) out.put(")");
  }

  std::string text_of(const std::vector<Argument>& arguments) const {
    struct Text {
      std::string all;
      void put(std::string_view part) { all += part; }
    } made;
    put(made, [&](std::size_t i) { return arguments[i].text(); });
    return made.all;
  }

  const char* code_;
  std::array<const char*, N> names_{};
  const char* text_;
};

MessageText(const char*, const char*)->MessageText<0>;
template <std::size_t M>
MessageText(const char*, const char* const (&)[M], const char*) -> MessageText<M>;

/// The message with `path` before it: "components.slc.rate: ...". No change for an empty path.
inline Diagnostic located(const std::string& path, Diagnostic message) {
  if (path.empty()) return message;
  message.path = message.path.empty() ? path : path + ": " + message.path;
  return message;
}

}  // namespace fulmar

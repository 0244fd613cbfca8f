// SPDX-License-Identifier: BSD-3-Clause
// Types of message fields besides numbers, enums, frames and std::array: fixed text and fixed-capacity lists.
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "fulmar/frames.hpp"

namespace fulmar {

/// Text of at most N - 1 bytes. Longer text is cut.
template <std::size_t N>
struct Text {
  std::array<char, N> bytes{};

  constexpr Text() = default;
  constexpr Text(std::string_view text) {  // NOLINT(google-explicit-constructor): a literal is a text
    const std::size_t n = std::min(text.size(), N - 1);
    for (std::size_t i = 0; i < n; ++i) bytes[i] = text[i];
  }
  template <std::size_t M>
  constexpr Text(const Text<M>& text) : Text(text.view()) {}  // NOLINT(google-explicit-constructor): as above
  constexpr Text(const char* text) : Text(std::string_view(text)) {}  // NOLINT(google-explicit-constructor)

  constexpr std::string_view view() const {
    const auto end = std::find(bytes.begin(), bytes.end(), '\0');
    return {bytes.data(), static_cast<std::size_t>(end - bytes.begin())};
  }
  friend constexpr bool operator==(const Text& a, const Text& b) { return a.view() == b.view(); }
};

/// Copies a text for people into `room` bytes, with a final zero. A longer text is cut after a whole word or
/// UTF-8 character, and ends in dots.
inline void fit_words(std::string_view words, char* text, std::size_t room) {
  const bool fits = words.size() < room;
  std::size_t end = fits ? words.size() : room - 4;  // three dots and the zero
  if (!fits) {
    std::size_t word = end;
    while (word > room / 2 && words[word] != ' ') --word;
    if (words[word] == ' ') end = word;  // otherwise one long word
    while (end > 0 && (static_cast<unsigned char>(words[end]) & 0xc0) == 0x80) --end;
  }
  std::copy_n(words.begin(), end, text);
  for (std::size_t i = 0; !fits && i < 3; ++i) text[end++] = '.';
  text[end] = '\0';
}

/// At most N items; only the first `count` are valid, logged and sent.
template <class T, std::size_t N>
struct List {
  std::uint32_t count = 0;
  std::array<T, N> items{};

  static constexpr std::size_t capacity() { return N; }
  constexpr std::size_t size() const { return count; }
  constexpr bool empty() const { return count == 0; }
  constexpr bool full() const { return count == N; }
  constexpr const T& operator[](std::size_t i) const { return items[i]; }
  constexpr T& operator[](std::size_t i) { return items[i]; }
  constexpr const T* begin() const { return items.data(); }
  constexpr const T* end() const { return items.data() + count; }
  constexpr T* begin() { return items.data(); }
  constexpr T* end() { return items.data() + count; }
  /// Returns false, and adds nothing, if the list is full.
  constexpr bool push_back(const T& item) {
    if (full()) return false;
    items[count++] = item;
    return true;
  }
  constexpr void clear() { count = 0; }
};

/// Range of a field. The host rejects published values and values of a mission beyond it.
struct FieldRange {
  std::string_view field;
  double min = 0, max = 0;
};

/// Ranges of the fields of a message, as a specialization next to the struct (as for Actuators).
template <class T>
inline constexpr std::array<FieldRange, 0> field_ranges{};

/// First field appended to a message after a release, as a specialization next to the struct. A writer from
/// before the field still feeds a reader, which then reads zeros from this field on. Therefore zero means
/// "not given" in every appended field.
template <class T>
inline constexpr std::string_view appended_from{};

/// Fields that a file or map of a `Record<T>` must give, as a specialization next to the struct, for example
/// of Airframe. Without them the host rejects the record, since a default would belong to another aircraft. A
/// struct field adds its own required fields.
template <class T>
inline constexpr std::array<std::string_view, 0> required_fields{};

/// An alternative field: if a record gives it, its own required fields replace those of its struct.
template <class T>
inline constexpr std::string_view instead_field{};

/// Lists of numbers that must rise from item to item, such as the points of a table. The host rejects others
/// with the place of the item.
template <class T>
inline constexpr std::array<std::string_view, 0> rising_fields{};

/// Standard deviation of an unknown quantity: large, and finite so that weighted sums stay valid.
inline constexpr double unknown_std = 1e9;

}  // namespace fulmar

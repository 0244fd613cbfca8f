// SPDX-License-Identifier: BSD-3-Clause
// What a message may be made of, beside numbers, enums, frames and std::array: fixed text and fixed-capacity
// lists.
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

/// Copies words that people read into `room` bytes, with a zero at the end. What does not fit ends in dots
/// behind a whole word, or a whole character of UTF-8.
inline void fit_words(std::string_view words, char* text, std::size_t room) {
  const bool fits = words.size() < room;
  std::size_t end = fits ? words.size() : room - 4;  // three dots and the zero
  if (!fits) {
    std::size_t word = end;
    while (word > room / 2 && words[word] != ' ') --word;
    if (words[word] == ' ') end = word;  // else one long word
    while (end > 0 && (static_cast<unsigned char>(words[end]) & 0xc0) == 0x80) --end;
  }
  std::copy_n(words.begin(), end, text);
  for (std::size_t i = 0; !fits && i < 3; ++i) text[end++] = '.';
  text[end] = '\0';
}

/// At most N items; only the first `count` are there, logged and sent.
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
  /// False, and nothing added, when the list is full.
  constexpr bool push_back(const T& item) {
    if (full()) return false;
    items[count++] = item;
    return true;
  }
  constexpr void clear() { count = 0; }
};

/// What a field may be, where its unit alone says less: the host refuses what a component publishes beyond
/// it, and what a mission says.
struct FieldRange {
  std::string_view field;
  double min = 0, max = 0;
};

/// Of the fields of a message: a specialization beside it, as of Actuators, lists them.
template <class T>
inline constexpr std::array<FieldRange, 0> field_ranges{};

/// The first field that was appended to a message after plugins were built with it, in a specialization
/// beside the message. A reader is fed by such an older plugin as well, and then sees zeros from there on: so
/// zero means "not said" in every field that is appended.
template <class T>
inline constexpr std::string_view appended_from{};

/// What a file or map of a record `Record<T>` has to say, as a specialization beside the struct lists it, the
/// fields of Airframe for one: without it the host refuses the record, for every reader, where it would else
/// fly on a default that is of no aircraft. A field that is a struct brings its own ones with it.
template <class T>
inline constexpr std::array<std::string_view, 0> required_fields{};

/// A field that, when a record names it, stands in for the required fields of its struct: another way to say
/// the same, which then needs its own required fields.
template <class T>
inline constexpr std::string_view instead_field{};

/// Lists of numbers that have to rise from item to item, such as the points of a table: the host refuses
/// others with the place of the item.
template <class T>
inline constexpr std::array<std::string_view, 0> rising_fields{};

/// Deviation of a quantity that nobody knows: large, finite, and so honest to every weighted sum.
inline constexpr double unknown_std = 1e9;

}  // namespace fulmar

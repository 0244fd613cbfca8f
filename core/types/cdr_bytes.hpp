// SPDX-License-Identifier: BSD-3-Clause
// XCDR1 bytes by hand, value by value: OMG DDS-XTypes 1.3, section 7.4.1. Numbers are aligned to their size
// from the start of the body, which begins behind the encapsulation header.
#pragma once
#include <span>
#include <string_view>
#include <utility>

#include "core/error.hpp"
#include "core/types/element.hpp"
#include "core/types/messages.hpp"
#include "core/types/wire.hpp"

namespace fulmar::core {

/// All functions throw Error when the bytes end early or are invalid.
class CdrReader {
 public:
  explicit CdrReader(std::span<const std::byte> message) : data_(message) {
    if (message.size() < cdr_header_bytes) throw Error(types_messages::message_too_short(message.size()));
    const auto form = static_cast<unsigned>(message[0]) << 8 | static_cast<unsigned>(message[1]);
    if (form != 1) throw Error(types_messages::encapsulation_invalid(form));
  }

  /// `count` consecutive elements of `size` bytes each; the size is a power of two.
  const std::byte* take(std::size_t size, std::uint32_t count = 1) {
    if (count > 0) at_ = ((at_ - cdr_header_bytes + size - 1) & ~(size - 1)) + cdr_header_bytes;
    const std::size_t bytes = size * count;
    if (at_ > data_.size() || bytes > data_.size() - at_)
      throw Error(types_messages::message_truncated(data_.size(), at_ + bytes));
    at_ += bytes;
    return data_.data() + (at_ - bytes);
  }
  template <class T>
  T number() {
    return load<T>(take(sizeof(T)));
  }
  /// Count of elements of at least `least` bytes each: a count that the bytes cannot hold is rejected before
  /// any allocation.
  std::size_t count(std::size_t least) {
    const std::size_t n = number<std::uint32_t>();
    if (n * least > data_.size() - at_) throw Error(types_messages::list_truncated());
    return n;
  }
  /// Number of the following elements: one, those of an array, or the count of a list.
  std::uint32_t elements(const Field& field) {
    if (field.shape == FULMAR_LIST) return number<std::uint32_t>();
    return field.shape == FULMAR_ARRAY ? field.count : 1;
  }
  /// Includes the NUL at its end, if it has one.
  std::string_view text() {
    const auto size = number<std::uint32_t>();
    return {reinterpret_cast<const char*>(take(1, size)), size};
  }
  /// Without the NUL, which must be there.
  std::string_view ended_text() {
    const std::string_view all = text();
    if (all.empty() || all.back() != '\0') throw Error(types_messages::text_not_terminated());
    return all.substr(0, all.size() - 1);
  }
  bool flag() { return number<std::uint8_t>() != 0; }
  std::vector<std::string> texts() {
    std::vector<std::string> list(count(4));
    for (std::string& s : list) s = ended_text();
    return list;
  }
  template <class T>
  std::vector<T> numbers() {
    std::vector<T> list(count(sizeof(T)));
    for (T& x : list) x = number<T>();
    return list;
  }
  /// Throws Error unless only padding is left: up to 3 bytes in own messages, up to 7 in foreign ones.
  void finish(std::size_t padding = 7) const {
    if (data_.size() - at_ > padding) throw Error(types_messages::message_too_long(data_.size(), at_));
  }

 private:
  std::span<const std::byte> data_;
  std::size_t at_ = cdr_header_bytes;
};

/// Writes a message that has no type table.
class CdrOut {
 public:
  template <class T>
  void number(T value) {
    while ((bytes_.size() - cdr_header_bytes) % sizeof(T) != 0) bytes_.push_back(std::byte{0});
    const auto* first = reinterpret_cast<const std::byte*>(&value);
    bytes_.insert(bytes_.end(), first, first + sizeof(T));
  }
  void flag(bool value) { number<std::uint8_t>(value ? 1 : 0); }
  void count(std::size_t n) { number(static_cast<std::uint32_t>(n)); }
  void text(std::string_view s) {
    count(s.size() + 1);
    const auto* first = reinterpret_cast<const std::byte*>(s.data());
    bytes_.insert(bytes_.end(), first, first + s.size());
    bytes_.push_back(std::byte{0});
  }
  template <class T>
  void numbers(const std::vector<T>& list) {
    count(list.size());
    for (const T x : list) number(x);
  }
  void texts(const std::vector<std::string>& list) {
    count(list.size());
    for (const std::string& s : list) text(s);
  }
  std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  std::vector<std::byte> bytes_{std::byte{0}, std::byte{1}, std::byte{0}, std::byte{0}};  // CDR_LE
};

}  // namespace fulmar::core

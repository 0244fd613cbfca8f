// SPDX-License-Identifier: BSD-3-Clause
// XCDR1 bytes, value by value: OMG DDS-XTypes 1.3, section 7.4.1. Numbers are aligned to their size from the
// start of the body, which begins behind the encapsulation header.
#pragma once
#include <span>
#include <string_view>

#include "core/error.hpp"
#include "core/types/element.hpp"
#include "core/types/wire.hpp"

namespace fulmar::core {

/// All functions throw Error on bytes that do not hold what is asked for.
class CdrReader {
 public:
  explicit CdrReader(std::span<const std::byte> message) : data_(message) {
    if (message.size() < cdr_header_bytes) throw Error("a message is too short");
    const auto form = static_cast<unsigned>(message[0]) << 8 | static_cast<unsigned>(message[1]);
    if (form != 1)
      throw Error("a message has the encapsulation " + std::to_string(form) +
                  "; only 1, plain little-endian CDR, is read");
  }

  /// `count` elements of `size` bytes each, one after the other; the size is a power of two.
  const std::byte* take(std::size_t size, std::uint32_t count = 1) {
    if (count > 0) at_ = ((at_ - cdr_header_bytes + size - 1) & ~(size - 1)) + cdr_header_bytes;
    const std::size_t bytes = size * count;
    if (at_ > data_.size() || bytes > data_.size() - at_)
      throw Error("a message is too short for its definition");
    at_ += bytes;
    return data_.data() + (at_ - bytes);
  }
  /// How many elements follow: one, those of an array, or as many as a list says.
  std::uint32_t elements(const Field& field) {
    if (field.shape == FULMAR_LIST) return load<std::uint32_t>(take(4));
    return field.shape == FULMAR_ARRAY ? field.count : 1;
  }
  /// The NUL at its end included, if it has one.
  std::string_view text() {
    const auto size = load<std::uint32_t>(take(4));
    return {reinterpret_cast<const char*>(take(1, size)), size};
  }
  /// Nothing but padding of the whole may be left: 3 bytes of our own messages, up to 7 of others.
  void finish(std::size_t padding = 7) const {
    if (data_.size() - at_ > padding) throw Error("a message is longer than its definition");
  }

 private:
  std::span<const std::byte> data_;
  std::size_t at_ = cdr_header_bytes;
};

}  // namespace fulmar::core

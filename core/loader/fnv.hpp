// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>

namespace fulmar::core {

// FNV-1a, 64 bit (Fowler, Noll, Vo), with the finalizer of MurmurHash3 (Appleby): FNV alone leaves the high
// bits of short inputs poor.
class Fnv {
 public:
  void bytes(const void* data, std::size_t size) {
    const auto* at = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < size; ++i) value_ = (value_ ^ at[i]) * 0x100000001b3u;
  }
  void number(std::uint64_t x) {
    for (unsigned shift = 0; shift < 64; shift += 8)
      value_ = (value_ ^ ((x >> shift) & 0xffu)) * 0x100000001b3u;
  }
  void text(const std::string& s) {
    number(s.size());
    bytes(s.data(), s.size());
  }
  std::uint64_t value() const {
    std::uint64_t x = value_;
    x = (x ^ (x >> 33)) * 0xff51afd7ed558ccdu;
    x = (x ^ (x >> 33)) * 0xc4ceb9fe1a85ec53u;
    return x ^ (x >> 33);
  }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325u;
};

}  // namespace fulmar::core

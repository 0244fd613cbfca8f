// SPDX-License-Identifier: BSD-3-Clause
// Hash of a message's values. Padding, bytes behind the end of a text and items beyond a list's count have no
// effect. Four lanes of multiply and xor, finished as splitmix64; not cryptographic: it finds accidental
// differences.
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "core/types/element.hpp"
#include "core/types/type.hpp"
#include "core/types/walk.hpp"

namespace fulmar::core {

inline std::uint64_t mix(std::uint64_t h, std::uint64_t word) noexcept {
  h = (h ^ word) * 0x9e3779b97f4a7c15ull;
  return h ^ (h >> 32);
}

inline std::uint64_t hash_bytes(std::uint64_t h, const std::byte* data, std::size_t size) noexcept {
  std::array<std::uint64_t, 4> lane{h, ~h, h + 1, h ^ 0xbf58476d1ce4e5b9ull};
  for (; size >= 32; data += 32, size -= 32)
    for (std::size_t k = 0; k < 4; ++k) lane[k] = mix(lane[k], load<std::uint64_t>(data + 8 * k));
  std::size_t k = 0;
  for (; size >= 8; data += 8, size -= 8, ++k) lane[k] = mix(lane[k], load<std::uint64_t>(data));
  std::uint64_t rest = size;
  std::memcpy(reinterpret_cast<std::byte*>(&rest) + 1, data, size);
  return mix(mix(mix(mix(lane[0], lane[1]), lane[2]), lane[3]), rest);
}

class MessageHash {
 public:
  explicit MessageHash(const Type& type) {
    Compiler compiler;
    walk(type, 0, compiler);
    steps_ = std::move(compiler.steps);
  }

  std::uint64_t of(std::uint64_t h, const std::byte* data) const noexcept {
    return run(steps_.data(), steps_.data() + steps_.size(), h, data);
  }

 private:
  struct Step {
    enum class Kind : std::uint8_t { bytes, text, list } kind = Kind::bytes;
    std::uint32_t offset = 0, size = 0;
    std::uint32_t count = 1, stride = 0, items = 0;  // list: capacity; bytes from offset to the first item
    std::uint32_t body = 0;                          // list: number of the following steps that belong to one
                                                     // item
    bool counted = false;                            // counted by the number at the offset, else always
                                                     // `count`
  };

  struct Compiler {
    static constexpr std::uint32_t unrolled = 0;
    std::vector<Step> steps;
    bool closed = false;  // the last step belongs to a loop that has ended, or that has only begun

    void bytes(std::uint32_t offset, std::uint32_t size) {
      const bool run = !steps.empty() && steps.back().kind == Step::Kind::bytes && !closed;
      if (run && steps.back().offset + steps.back().size == offset)
        steps.back().size += size;
      else
        steps.push_back({Step::Kind::bytes, offset, size});
      closed = false;
    }
    void value(const Field& f, std::uint32_t offset) {
      if (f.kind != FULMAR_TEXT) return bytes(offset, primitive_size(f.kind));
      steps.push_back({Step::Kind::text, offset, f.stride});
    }
    bool at_once(const Field& f, std::uint32_t offset) {
      const bool packed = f.stride == primitive_size(f.kind);
      if (packed) bytes(offset, f.count * f.stride);
      return packed;
    }
    std::size_t begin(const Field& f, std::uint32_t offset) {
      const bool counted = f.shape == FULMAR_LIST;
      steps.push_back({Step::Kind::list, offset, 0, f.count, f.stride, counted ? f.items : 0, 0, counted});
      closed = true;
      return steps.size() - 1;
    }
    void end(std::size_t loop) {
      steps[loop].body = static_cast<std::uint32_t>(steps.size() - loop - 1);
      closed = true;
    }
  };

  static std::uint64_t run(const Step* step, const Step* end, std::uint64_t h,
                           const std::byte* data) noexcept {
    for (; step != end; ++step) {
      const std::byte* const at = data + step->offset;
      if (step->kind == Step::Kind::bytes) {
        h = hash_bytes(h, at, step->size);
      } else if (step->kind == Step::Kind::text) {
        h = hash_bytes(h, at, strnlen(reinterpret_cast<const char*>(at), step->size));
      } else {
        const std::uint32_t n = step->counted ? std::min(load<std::uint32_t>(at), step->count) : step->count;
        h = mix(h, n);
        for (std::uint32_t k = 0; k < n; ++k)
          h = run(step + 1, step + 1 + step->body, h, at + step->items + std::size_t{k} * step->stride);
        step += step->body;
      }
    }
    return h;
  }

  std::vector<Step> steps_;
};

}  // namespace fulmar::core

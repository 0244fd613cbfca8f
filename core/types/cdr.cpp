// SPDX-License-Identifier: BSD-3-Clause
// XCDR1, plain little-endian: OMG DDS-XTypes 1.3, section 7.4.1. Numbers are aligned to their size (at most
// 8) from the start of the body.
#include <array>

#include "core/types/cdr_bytes.hpp"
#include "core/types/messages.hpp"
#include "core/types/walk.hpp"

namespace fulmar::core {
namespace {

constexpr std::array<std::byte, cdr_header_bytes> header{std::byte{0}, std::byte{1}, std::byte{0},
                                                         std::byte{0}};  // CDR_LE

using Op = CdrEncoder::Op;

// ---- compiling

struct Compiler {
  std::vector<Op> ops;
  std::size_t mergeable_from = 0;  // ops before this one belong to another level

  /// `bytes` of consecutive elements of `size` each. Joins the previous copy where neither the struct nor the
  /// wire has padding between.
  void copy(std::uint32_t offset, std::uint32_t size, std::uint32_t bytes) {
    if (ops.size() > mergeable_from) {
      Op& last = ops.back();
      const bool joined = last.what == Op::copy && last.offset + last.bytes == offset && size <= last.align &&
                          last.bytes % size == 0;
      if (joined) {
        last.bytes += bytes;
        return;
      }
    }
    ops.push_back(
        {.what = Op::copy, .align = static_cast<std::uint8_t>(size), .offset = offset, .bytes = bytes});
  }

  static constexpr std::uint32_t unrolled = 8;

  void value(const Field& f, std::uint32_t offset) {
    if (f.kind == FULMAR_TEXT)
      ops.push_back({.what = Op::text, .offset = offset, .bytes = f.stride});
    else
      copy(offset, primitive_size(f.kind), primitive_size(f.kind));
  }

  bool at_once(const Field& f, std::uint32_t offset) {
    const bool packed = f.stride == primitive_size(f.kind);
    if (packed) copy(offset, f.stride, f.stride * f.count);
    return packed;
  }

  std::size_t begin(const Field& f, std::uint32_t offset) {
    const auto what = f.shape == FULMAR_LIST ? Op::list : Op::loop;
    ops.push_back({.what = what, .offset = offset, .count = f.count, .stride = f.stride, .items = f.items});
    mergeable_from = ops.size();
    return ops.size() - 1;
  }

  void end(std::size_t head) {
    Op& loop = ops[head];
    loop.body = static_cast<std::uint32_t>(ops.size() - head - 1);
    const Op item = ops.back();
    const bool whole = loop.what == Op::list && loop.body == 1 && item.what == Op::copy && item.offset == 0 &&
                       item.bytes == loop.stride && loop.stride % item.align == 0;
    if (whole) {  // the items are copied at once
      loop.align = item.align;
      loop.bytes = loop.stride;
      loop.body = 0;
      ops.pop_back();
    }
    mergeable_from = ops.size();
  }

  void empty() { ops.push_back({.what = Op::dummy}); }  // ROS 2: an empty struct has one dummy byte
};

/// Upper bound of what the ops write, padding included.
std::size_t bound(const Op* op, const Op* end) {
  std::size_t sum = 0;
  for (; op != end; ++op) {
    switch (op->what) {
      case Op::copy: sum += op->align - 1u + op->bytes; break;
      case Op::text: sum += 3 + 4 + op->bytes + 1; break;
      case Op::dummy: sum += 1; break;
      case Op::list:
      case Op::loop: {
        const std::size_t one = op->body > 0 ? bound(op + 1, op + 1 + op->body) : op->bytes;
        sum += 3 + 4 + 7 + op->count * one;
        op += op->body;
        break;
      }
    }
  }
  return sum;
}

// ---- encoding

struct Writer {
  std::byte* const start;  // of the body
  std::byte* at;

  void align(std::size_t to) noexcept {
    while ((static_cast<std::size_t>(at - start) & (to - 1)) != 0) *at++ = std::byte{0};
  }
  void copy(const std::byte* from, std::size_t bytes) noexcept {
    std::memcpy(at, from, bytes);
    at += bytes;
  }
  void count(std::uint32_t n) noexcept {
    align(4);
    std::memcpy(at, &n, 4);
    at += 4;
  }
  void text(std::string_view s) noexcept {
    count(static_cast<std::uint32_t>(s.size() + 1));  // the NUL counts
    copy(reinterpret_cast<const std::byte*>(s.data()), s.size());
    *at++ = std::byte{0};
  }

  void run(const Op* op, const Op* end, const std::byte* data) noexcept {
    for (; op != end; ++op) {
      switch (op->what) {
        case Op::copy:
          align(op->align);
          copy(data + op->offset, op->bytes);
          break;
        case Op::text: text(text_at(data + op->offset, op->bytes)); break;
        case Op::dummy: *at++ = std::byte{0}; break;
        case Op::loop:
          elements(*op, data + op->offset, op->count);
          op += op->body;
          break;
        case Op::list: {
          const std::uint32_t n = std::min(load<std::uint32_t>(data + op->offset), op->count);
          count(n);
          if (n > 0) elements(*op, data + op->offset + op->items, n);
          op += op->body;
          break;
        }
      }
    }
  }

  void elements(const Op& op, const std::byte* first, std::uint32_t n) noexcept {
    if (op.body == 0) {
      align(op.align);
      copy(first, std::size_t{n} * op.bytes);
      return;
    }
    for (std::uint32_t i = 0; i < n; ++i) run(&op + 1, &op + 1 + op.body, first + std::size_t{i} * op.stride);
  }
};

// ---- decoding

struct Decoder {
  CdrReader in;

  void element(const Field& f, std::byte* to) {
    if (f.kind == FULMAR_STRUCT) return type(*f.type, to);
    const std::string_view text = in.text();
    if (text.empty() || text.back() != '\0') throw Error(types_messages::field_not_terminated(f.name));
    if (text.size() > f.stride) throw Error(types_messages::field_too_long(f.name, f.stride - 1));
    std::memcpy(to, text.data(), text.size());
  }

  void type(const Type& t, std::byte* to) {
    if (t.fields.empty()) in.take(1);
    for (const Field& f : t.fields) {
      std::byte* first = to + f.offset;
      const std::uint32_t n = in.elements(f), size = primitive_size(f.kind);
      if (f.shape == FULMAR_LIST) {
        if (n > f.count) throw Error(types_messages::too_many_items(f.name, n, f.count));
        std::memcpy(first, &n, 4);
        first += f.items;
      }
      if (size > 0 && size == f.stride) {
        std::memcpy(first, in.take(size, n), std::size_t{size} * n);
        continue;
      }
      for (std::uint32_t i = 0; i < n; ++i, first += f.stride) {
        if (size > 0)
          std::memcpy(first, in.take(size), size);
        else
          element(f, first);
      }
    }
  }
};

}  // namespace

CdrEncoder::CdrEncoder(const Type& type) {
  Compiler compiler;
  walk(type, 0, compiler);
  ops_ = std::move(compiler.ops);
  max_size_ = cdr_header_bytes + bound(ops_.data(), ops_.data() + ops_.size());
}

std::size_t CdrEncoder::encode(const std::byte* data, std::byte* out) const noexcept {
  std::memcpy(out, header.data(), cdr_header_bytes);
  Writer writer{out + cdr_header_bytes, out + cdr_header_bytes};
  writer.run(ops_.data(), ops_.data() + ops_.size(), data);
  return static_cast<std::size_t>(writer.at - out);
}

void CdrEncoder::encode(const std::byte* data, std::vector<std::byte>& out) const {
  const std::size_t before = out.size();
  out.resize(before + max_size_);
  out.resize(before + encode(data, out.data() + before));
}

void cdr_decode(const Type& type, const std::byte* bytes, std::size_t size, std::byte* message) try {
  Decoder decoder{CdrReader({bytes, size})};
  std::memset(message, 0, type.size);
  decoder.type(type, message);
  decoder.in.finish(3);
} catch (const Error& e) {
  throw Error(types_messages::bytes_invalid(type.name, e.what()));
}

}  // namespace fulmar::core

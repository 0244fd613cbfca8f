// SPDX-License-Identifier: BSD-3-Clause
// The check of every published message. Fields are flattened at load into steps; neighbouring doubles without
// a range become one run.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>

#include "core/error.hpp"
#include "core/types/element.hpp"
#include "core/types/messages.hpp"
#include "core/types/walk.hpp"

namespace fulmar::core {
namespace {

// Adding one to the exponent of a number whose exponent is all ones, and of no other, carries into the sign
// bit (IEEE 754 binary64).
bool finite_run(const std::byte* at, std::uint32_t count) noexcept {
  constexpr std::uint64_t magnitude = 0x7fffffffffffffffu, one = 0x0010000000000000u;
  std::uint64_t carry[4] = {0, 0, 0, 0};
  std::uint32_t i = 0;
  for (; i + 4 <= count; i += 4, at += 32)
    for (std::uint32_t k = 0; k < 4; ++k)
      carry[k] |= (load<std::uint64_t>(at + std::size_t{8} * k) & magnitude) + one;
  for (; i < count; ++i, at += 8) carry[0] |= (load<std::uint64_t>(at) & magnitude) + one;
  return ((carry[0] | carry[1] | carry[2] | carry[3]) >> 63) == 0;
}

bool finite_floats(const std::byte* at, std::uint32_t count) noexcept {
  std::uint32_t carry = 0;
  for (std::uint32_t i = 0; i < count; ++i)
    carry |= (load<std::uint32_t>(at + std::size_t{4} * i) & 0x7fffffffu) + 0x00800000u;
  return (carry >> 31) == 0;
}

bool bytes_at_most(const std::byte* at, std::uint32_t count, double max) noexcept {
  const auto limit = static_cast<unsigned>(max);
  unsigned worst = 0;
  for (std::uint32_t i = 0; i < count; ++i) worst = std::max(worst, std::to_integer<unsigned>(at[i]));
  return worst <= limit;
}

bool whole_byte(fulmar_kind kind) { return primitive_size(kind) == 1 && kind != FULMAR_I8; }

// The largest valid value of a one-byte kind.
double byte_limit(const Field& field) {
  if (field.kind == FULMAR_BOOL) return 1;
  return field.kind == FULMAR_ENUM ? static_cast<double>(field.labels.size() - 1) : 255;
}

// An infinite bound accepts every finite double and nothing else.
double low(const Field& field) { return std::max(field.min, -std::numeric_limits<double>::max()); }
double high(const Field& field) { return std::min(field.max, std::numeric_limits<double>::max()); }

}  // namespace

// ---- from a type to steps

struct Guard::Compiler {
  static constexpr std::uint32_t unrolled = 64;
  std::vector<Step> steps;

  void add(const Step& step) {
    using enum Step::Kind;
    const std::uint32_t size = step.kind == finite_f64 ? 8 : step.kind == finite_f32 ? 4 : 1;
    const bool run = step.kind == finite_f64 || step.kind == finite_f32 || step.kind == bytes;
    if (run && joinable) {
      Step& last = steps.back();
      if (last.kind == step.kind && last.max == step.max && last.offset + last.count * size == step.offset) {
        last.count += step.count;
        return;
      }
    }
    steps.push_back(step);
    joinable = run;
  }

  // `count` elements of `field` from `offset` on.
  void elements(const Field& field, std::uint32_t offset, std::uint32_t count) {
    Step step{.element = field.kind, .offset = offset, .count = count, .stride = field.stride};
    const bool ranged = std::isfinite(field.min) || std::isfinite(field.max);
    const bool dense = field.stride == element_size(field) || count == 1;
    if (is_integer(field.kind) && !ranged) return;  // every value is valid
    if (field.kind == FULMAR_TEXT) {
      step.kind = Step::Kind::text;
    } else if (whole_byte(field.kind) && !ranged && dense) {
      step.kind = Step::Kind::bytes;
      step.max = byte_limit(field);
    } else if (!ranged && dense) {
      step.kind = field.kind == FULMAR_F64 ? Step::Kind::finite_f64 : Step::Kind::finite_f32;
    } else {
      step.kind = field.kind == FULMAR_F64 ? Step::Kind::range_f64 : Step::Kind::range;
      step.min = whole_byte(field.kind) ? std::max(0.0, field.min) : low(field);
      step.max = whole_byte(field.kind) ? std::min(byte_limit(field), field.max) : high(field);
    }
    add(step);
  }

  void value(const Field& field, std::uint32_t offset) { elements(field, offset, 1); }

  bool at_once(const Field& field, std::uint32_t offset) {
    elements(field, offset, field.count);
    return true;
  }

  std::size_t begin(const Field& field, std::uint32_t offset) {
    const bool counted = field.shape == FULMAR_LIST;
    steps.push_back({.kind = Step::Kind::repeat,
                     .offset = offset + (counted ? field.items : 0),
                     .count = field.count,
                     .stride = field.stride,
                     .count_offset = offset,
                     .counted = counted});
    joinable = false;
    return steps.size() - 1;
  }

  void end(std::size_t head) {
    steps[head].end = static_cast<std::uint32_t>(steps.size() - head);
    joinable = false;
  }

 private:
  bool joinable = false;  // the last step is a run of the same struct
};

Guard::Guard(const Type& type) : type_(std::make_shared<const Type>(type)) {
  Compiler compiler;
  walk(type, 0, compiler);
  steps_ = std::move(compiler.steps);
}

// ---- in the tick

bool Guard::run(const Step* step, const Step* end, const std::byte* data) noexcept {
  for (; step != end; ++step) {
    const std::byte* at = data + step->offset;
    switch (step->kind) {
      case Step::Kind::finite_f64:
        if (!finite_run(at, step->count)) return false;
        break;
      case Step::Kind::finite_f32:
        if (!finite_floats(at, step->count)) return false;
        break;
      case Step::Kind::bytes:
        if (!bytes_at_most(at, step->count, step->max)) return false;
        break;
      case Step::Kind::range_f64:
        for (std::uint32_t i = 0; i < step->count; ++i, at += step->stride) {
          const auto x = load<double>(at);
          if (!(x >= step->min && x <= step->max)) return false;
        }
        break;
      case Step::Kind::range:
        for (std::uint32_t i = 0; i < step->count; ++i, at += step->stride) {
          const double x = number_at(step->element, at);
          if (!(x >= step->min && x <= step->max)) return false;
        }
        break;
      case Step::Kind::text:
        for (std::uint32_t i = 0; i < step->count; ++i, at += step->stride)
          if (std::memchr(at, '\0', step->stride) == nullptr) return false;
        break;
      case Step::Kind::repeat: {
        const std::uint32_t count =
            step->counted ? load<std::uint32_t>(data + step->count_offset) : step->count;
        if (count > step->count) return false;
        for (std::uint32_t i = 0; i < count; ++i, at += step->stride)
          if (!run(step + 1, step + step->end, at)) return false;
        step += step->end - 1;
        break;
      }
    }
  }
  return true;
}

bool Guard::check(const std::byte* data) const noexcept {
  return run(steps_.data(), steps_.data() + steps_.size(), data);
}

// ---- messages

namespace {

/// A number with at most so many digits.
struct Short {
  std::array<char, 32> text;
  Short(double value, int digits) noexcept { std::snprintf(text.data(), text.size(), "%.*g", digits, value); }
};

// Walks a message by its table and stops at the first invalid value; `text` then holds its path and the
// fault.
class Explainer {
 public:
  Explainer(char* text, std::size_t size) : text_(text), size_(size) { text_[0] = '\0'; }

  bool fields(const Type& type, const std::byte* data) noexcept {
    const std::size_t here = length_;
    for (const Field& field : type.fields) {
      append("%s%s", here > 0 ? "." : "", field.name.c_str());
      if (one_field(field, data + field.offset)) return true;
      cut(here);
    }
    return false;
  }

 private:
  bool one_field(const Field& field, const std::byte* at) noexcept {
    std::uint32_t count = field.count;
    if (field.shape == FULMAR_LIST) {
      count = load<std::uint32_t>(at);
      if (count > field.count) return fault(types_messages::too_many_items, count, field.count);
      at += field.items;
    }
    const std::size_t here = length_;
    for (std::uint32_t i = 0; i < count; ++i, at += field.stride) {
      if (field.shape != FULMAR_SCALAR) append("[%u]", i);
      if (element(field, at)) return true;
      cut(here);
    }
    return false;
  }

  bool element(const Field& field, const std::byte* at) noexcept {
    if (field.kind == FULMAR_STRUCT) return fields(*field.type, at);
    if (field.kind == FULMAR_TEXT)
      return std::memchr(at, '\0', field.stride) == nullptr && fault(types_messages::field_not_terminated);
    const double x = number_at(field, at);
    if (!std::isfinite(x))
      return fault(types_messages::value_not_finite, std::isnan(x) ? "nan" : x > 0 ? "inf" : "-inf");
    if (field.kind == FULMAR_BOOL && x > 1) return fault(types_messages::flag_value_invalid, x);
    if (field.kind == FULMAR_ENUM && x > byte_limit(field))
      return fault(types_messages::label_value_invalid, x);
    if (x < field.min || x > field.max)
      return fault(types_messages::value_out_of_range, Short(x, 9).text.data(),
                   Short(field.min, 6).text.data(), Short(field.max, 6).text.data());
    return false;
  }

  template <class... Args>
  bool append(const char* format, Args... args) noexcept {
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wformat-nonliteral"
#pragma GCC diagnostic ignored "-Wformat-security"
    const int n = std::snprintf(text_ + length_, size_ - length_, format, args...);
#pragma GCC diagnostic pop
    if (n > 0) length_ = std::min(length_ + static_cast<std::size_t>(n), size_ - 1);
    return true;
  }
  /// Writes a message about the current path into `text`.
  template <std::size_t N, class... Values>
  bool fault(const MessageText<N>& message, const Values&... values) noexcept {
    std::array<char, 512> path{};
    std::copy_n(text_, std::min(length_, path.size() - 1), path.data());
    message.write(text_, size_, path.data(), values...);
    return true;
  }
  void cut(std::size_t length) noexcept {
    length_ = length;
    text_[length_] = '\0';
  }

  char* text_;
  std::size_t size_, length_ = 0;
};

}  // namespace

void Guard::explain_to(const std::byte* data, char* text, std::size_t size) const noexcept {
  if (size == 0) return;
  Explainer(text, size).fields(*type_, data);
}

std::string Guard::explain(const std::byte* data) const {
  char text[512];
  explain_to(data, text, sizeof text);
  return text;
}

}  // namespace fulmar::core

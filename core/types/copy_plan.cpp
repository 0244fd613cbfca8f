// SPDX-License-Identifier: BSD-3-Clause
// Compatibility of a reader's table with a writer's, and the moves that copy a message from one to the other.
#include <algorithm>
#include <cstring>

#include "core/error.hpp"
#include "core/types/messages.hpp"
#include "core/types/type.hpp"

namespace fulmar::core {

namespace {

std::string shape_words(const Field& field) {
  if (field.shape == FULMAR_ARRAY) return types_messages::array_shape(field.count).line();
  return field.shape == FULMAR_LIST ? types_messages::list_shape(field.count).line() : "one value";
}

std::string or_none(const std::string& text) { return text.empty() ? "none" : text; }

std::string differ(const std::string& path, const std::string& what, const std::string& reader,
                   const std::string& writer) {
  return located(path, types_messages::reader_differs(what, reader, writer)).line();
}

std::string fields_differ(const Type& from, const Type& to, const std::string& path);

// "" when the reader's field `to` can be filled from the writer's field `from`.
std::string field_differs(const Field& from, const Field& to, const std::string& path) {
  if (from.kind != to.kind) return differ(path, "kind ", kind_word(to.kind), kind_word(from.kind));
  const bool longer =
      to.shape == FULMAR_LIST && from.count <= to.count;  // a reader's list may have more room
  if (from.shape != to.shape || (from.count != to.count && !longer))
    return differ(path, "", shape_words(to), shape_words(from));
  if (from.unit != to.unit) return differ(path, "unit ", or_none(to.unit), or_none(from.unit));
  if (to.kind == FULMAR_TEXT && from.stride > to.stride)
    return differ(path, "room for ", std::to_string(to.stride) + " bytes", std::to_string(from.stride));
  if (to.kind == FULMAR_ENUM) {  // each label that the writer may send has the same meaning for the reader
    const bool known = from.labels.size() <= to.labels.size() &&
                       std::equal(from.labels.begin(), from.labels.end(), to.labels.begin());
    if (!known) return differ(path, "labels ", join(to.labels), join(from.labels));
  }
  if (to.kind != FULMAR_STRUCT) return "";
  if (from.type->frame != to.type->frame)
    return differ(path, "frame ", or_none(to.type->frame), or_none(from.type->frame));
  return fields_differ(*from.type, *to.type, path + ".");
}

std::string fields_differ(const Type& from, const Type& to, const std::string& path) {
  for (const Field& field : to.fields) {
    const Field* source = from.find(field.name);
    if (source == nullptr && field.appended) continue;
    if (source == nullptr) return types_messages::writer_field_missing(path, field.name).line();
    const std::string fault = field_differs(*source, field, path + field.name);
    if (!fault.empty()) return fault;
  }
  return "";
}

class Mover {
 public:
  void fields(const Type& from, const Type& to, std::uint32_t from_base, std::uint32_t to_base) {
    for (const Field& field : to.fields) {
      if (const Field* const source = from.find(field.name)) {
        one(*source, field, from_base, to_base);
      } else {
        gaps.push_back({to_base + field.offset, static_cast<std::uint32_t>(field_span(field))});
      }
    }
  }

  std::vector<CopyPlan::Gap> gaps;

  std::vector<CopyPlan::Move> merged() {
    std::sort(moves_.begin(), moves_.end(), [](const auto& a, const auto& b) { return a.to < b.to; });
    std::vector<CopyPlan::Move> result;
    for (const CopyPlan::Move& move : moves_) {
      if (!result.empty() && joins(result.back(), move)) {
        result.back().bytes = move.to + move.bytes - result.back().to;
      } else {
        result.push_back(move);
      }
    }
    return result;
  }

 private:
  void one(const Field& from, const Field& to, std::uint32_t from_base, std::uint32_t to_base) {
    std::uint32_t source = from_base + from.offset, target = to_base + to.offset;
    if (to.shape == FULMAR_LIST) {
      moves_.push_back({source, target, sizeof(std::uint32_t)});
      source += from.items;
      target += to.items;
    }
    for (std::uint32_t i = 0; i < from.count; ++i, source += from.stride, target += to.stride) {
      if (to.kind == FULMAR_STRUCT) {
        fields(*from.type, *to.type, source, target);
      } else {
        moves_.push_back({source, target, element_size(from)});
      }
    }
  }

  // Padding between two fields may be copied when both sides have equal gaps.
  static bool joins(const CopyPlan::Move& a, const CopyPlan::Move& b) {
    const std::uint32_t gap = b.to - (a.to + a.bytes);
    return b.from - (a.from + a.bytes) == gap && gap < 8;
  }

  std::vector<CopyPlan::Move> moves_;
};

// Whether at most the labels of an enum, a range or a name differ: all bytes have the same offsets.
bool same_layout(const Type& from, const Type& to) {
  if (from.size != to.size || from.fields.size() != to.fields.size()) return false;
  for (std::size_t i = 0; i < to.fields.size(); ++i) {
    const Field &a = from.fields[i], &b = to.fields[i];
    if (a.name != b.name || a.kind != b.kind || a.shape != b.shape || a.offset != b.offset ||
        a.count != b.count || a.stride != b.stride || a.items != b.items)
      return false;
    if (b.kind == FULMAR_STRUCT && !same_layout(*a.type, *b.type)) return false;
  }
  return true;
}

}  // namespace

std::string incompatibility(const Type& from, const Type& to) {
  if (from.hash == to.hash) return "";
  if (from.frame != to.frame)
    return types_messages::frames_differ(or_none(to.frame), or_none(from.frame)).line();
  return fields_differ(from, to, "");
}

CopyPlan copy_plan(const Type& from, const Type& to) {
  if (const std::string fault = incompatibility(from, to); !fault.empty()) throw Error(fault);
  CopyPlan plan;
  plan.size = to.size;
  plan.whole = from.hash == to.hash || same_layout(from, to);
  if (plan.whole) return plan;
  Mover mover;
  mover.fields(from, to, 0, 0);
  plan.moves = mover.merged();
  plan.gaps = std::move(mover.gaps);
  return plan;
}

void CopyPlan::run(const std::byte* from, std::byte* to) const {
  if (whole) {
    std::memcpy(to, from, size);
    return;
  }
  for (const Move& move : moves) std::memcpy(to + move.to, from + move.from, move.bytes);
  for (const Gap& gap : gaps) std::memset(to + gap.to, 0, gap.bytes);
}

}  // namespace fulmar::core

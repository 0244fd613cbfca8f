// SPDX-License-Identifier: BSD-3-Clause
// Copies a type table and checks it: fields inside the struct, aligned, no overlap. All later code relies on
// these checks.
#include "core/loader/table.hpp"

#include <bit>

#include "core/loader/fnv.hpp"
#include "core/loader/messages.hpp"

namespace fulmar::core {
namespace {

constexpr int deepest = 16;                 // levels of nesting
constexpr std::uint32_t max_fields = 1024;  // of one struct
constexpr std::uint32_t largest_struct = 1u << 26;
constexpr std::uint32_t max_labels = 256;  // an enum is one byte

std::uint64_t hash_of(const Type& type) {
  Fnv hash;
  hash.text(type.name);
  hash.text(type.frame);
  hash.text(type.ros);
  for (const std::uint32_t x : {type.size, type.align}) hash.number(x);
  hash.number(type.fields.size());
  for (const Field& field : type.fields) {
    hash.text(field.name);
    hash.text(field.unit);
    for (const std::uint32_t x :
         {static_cast<std::uint32_t>(field.kind), static_cast<std::uint32_t>(field.shape), field.offset,
          field.count, field.stride, field.items})
      hash.number(x);
    hash.number(field.labels.size());
    for (const std::string& label : field.labels) hash.text(label);
    hash.number(field.type ? field.type->hash : 0);
  }
  return hash.value();
}

std::uint32_t alignment(const Field& field) {
  if (field.kind == FULMAR_TEXT) return 1;
  return field.kind == FULMAR_STRUCT ? field.type->align : element_size(field);
}

void check_layout(const Field& field, const std::string& what) {
  const std::uint32_t size = element_size(field);
  if (field.count == 0) throw Error(loader_messages::field_without_elements(what));
  if (field.shape == FULMAR_SCALAR && field.count != 1)
    throw Error(loader_messages::scalar_count_invalid(what, field.count));
  if (field.stride < size || size == 0) throw Error(loader_messages::elements_overlap(what));
  if (field.shape == FULMAR_LIST && field.items < sizeof(std::uint32_t))
    throw Error(loader_messages::items_overlap_count(what));
  const std::uint32_t align = alignment(field);
  const bool count_aligned = field.shape != FULMAR_LIST || field.offset % alignof(std::uint32_t) == 0;
  const std::uint64_t first = std::uint64_t{field.offset} + (field.shape == FULMAR_LIST ? field.items : 0);
  const bool strided = field.count > 1 && field.stride % align != 0;
  if (first % align != 0 || strided || !count_aligned) throw Error(loader_messages::field_not_aligned(what));
}

void check_struct(const Type& type, const std::string& what) {
  if (type.size == 0 || type.size > largest_struct)
    throw Error(loader_messages::struct_size_invalid(what, type.size));
  if (!std::has_single_bit(type.align) || type.align > 64 || type.size % type.align != 0)
    throw Error(loader_messages::struct_alignment_invalid(what, type.align, type.size));
  std::vector<const Field*> order;
  for (const Field& field : type.fields) order.push_back(&field);
  std::sort(order.begin(), order.end(), [](const Field* a, const Field* b) { return a->offset < b->offset; });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Field& field = *order[i];
    if (field.offset + field_span(field) > type.size)
      throw Error(located(what, loader_messages::field_outside_struct(field.name)));
    if (type.align % std::max(alignment(field), field.shape == FULMAR_LIST ? 4u : 1u) != 0)
      throw Error(located(what, loader_messages::field_alignment_invalid(field.name)));
    if (i > 0 && order[i - 1]->offset + field_span(*order[i - 1]) > field.offset)
      throw Error(located(what, loader_messages::fields_overlap(order[i - 1]->name, field.name)));
  }
}

}  // namespace

std::vector<std::string> TableReader::texts(const char* const* at, std::uint32_t count,
                                            const std::string& what) const {
  std::vector<std::string> list;
  for (std::uint32_t i = 0; i < count; ++i) list.push_back(text(element(at, sizeof(char*), i, what), what));
  return list;
}

Field TableReader::read_field(const fulmar_field& from, const std::string& owner) {
  Field field;
  field.name = text(from.name, owner + ": the name of a field");
  if (!is_identifier(field.name))
    throw Error(located(owner, loader_messages::field_name_invalid(field.name)));
  const std::string what = owner + ": field '" + field.name + "'";
  if (from.kind < FULMAR_BOOL || from.kind > FULMAR_U16)
    throw Error(loader_messages::port_kind_unknown(what, from.kind));
  if (from.shape > FULMAR_LIST) throw Error(loader_messages::field_shape_unknown(what, from.shape));
  field.unit = text(from.unit, what + ": the unit");
  field.kind = static_cast<fulmar_kind>(from.kind);
  field.shape = static_cast<fulmar_shape>(from.shape);
  field.offset = from.offset;
  field.count = from.count;
  field.items = field.shape == FULMAR_LIST ? from.items : 0;
  if (field.kind == FULMAR_STRUCT) field.type = type(from.type, what);
  if (field.kind == FULMAR_ENUM) {
    if (from.label_count == 0 || from.label_count > max_labels)
      throw Error(loader_messages::label_count_invalid(what, from.label_count));
    field.labels = texts(from.labels, from.label_count, what + ": the labels");
  }
  field.stride = from.stride != 0 || field.kind == FULMAR_TEXT ? from.stride : element_size(field);
  field.min = from.min;
  field.max = from.max;
  field.appended = (from.flags & FULMAR_FIELD_APPENDED) != 0;
  field.in_record.required = (from.flags & FULMAR_FIELD_REQUIRED) != 0;
  field.in_record.instead = (from.flags & FULMAR_FIELD_INSTEAD) != 0;
  field.in_record.rising = (from.flags & FULMAR_FIELD_RISING) != 0;
  if (!(field.min <= field.max)) throw Error(loader_messages::range_empty(what));
  check_layout(field, what);
  return field;
}

std::shared_ptr<Type> TableReader::read_type(const fulmar_type& from, const std::string& what) {
  auto type = std::make_shared<Type>();
  type->name = text(from.name, what + ": the name of the type");
  if (type->name.empty()) throw Error(located(what, loader_messages::type_name_missing()));
  const std::string self = "type '" + type->name + "'";
  type->frame = text(from.frame, self + ": the frame");
  type->ros = text(from.ros, self + ": the ROS name");
  type->size = from.size;
  type->align = from.align;
  if (from.field_count > max_fields)
    throw Error(loader_messages::too_many_fields(self, from.field_count, max_fields));
  for (std::uint32_t i = 0; i < from.field_count; ++i) {
    Field field = read_field(element(from.fields, from.field_stride, i, self + ": the fields"), self);
    if (type->find(field.name) != nullptr) throw Error(loader_messages::field_repeated(self, field.name));
    type->fields.push_back(std::move(field));
  }
  check_struct(*type, self);
  type->hash = hash_of(*type);
  return type;
}

TypePtr TableReader::type(const fulmar_type* from, const std::string& what) {
  if (from == nullptr) throw Error(loader_messages::type_missing(what));
  if (!memory_.readable(from, sizeof *from))
    throw Error(located(what, loader_messages::type_outside_memory()));
  if (const auto known = done_.find(from); known != done_.end()) return known->second;
  if (depth_ >= deepest) throw Error(loader_messages::type_too_deep(what, deepest));
  ++depth_;  // an exception does not restore it: a reader is not used after a throw
  TypePtr result = read_type(*from, what);
  --depth_;
  done_.emplace(from, result);
  return result;
}

TypePtr copy_type(const fulmar_type& type) { return TableReader().type(&type, "the type"); }

}  // namespace fulmar::core

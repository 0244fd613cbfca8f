// SPDX-License-Identifier: BSD-3-Clause
// Type tables written by hand: the tap does not depend on messages of the SDK.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/types/type.hpp"

namespace fulmar::core::test {

struct Vector {
  double north, east, down;
};
struct Leg {
  std::uint8_t kind;
  bool has_course;
  double course_rad;
  Vector position_m;
};
template <class T, std::uint32_t N>
struct Items {
  std::uint32_t count;
  std::array<T, N> items;
};
/// One of everything.
struct Mixed {
  bool armed;
  double speed_mps;
  std::uint32_t count;
  std::array<double, 3> gains_ratio;
  std::array<char, 8> name;
  Items<double, 4> samples_volt;
  std::uint8_t mode;
  std::int64_t stamp_ns;
  float load_ratio;
  std::int32_t offset;
  Vector attitude_std_rad;
  std::array<std::array<char, 4>, 2> tags;
  Items<Leg, 3> legs;
};

inline Field scalar(std::string name, fulmar_kind kind, std::size_t offset, std::size_t stride,
                    std::string unit = "") {
  Field f;
  f.name = std::move(name);
  f.unit = std::move(unit);
  f.kind = kind;
  f.offset = static_cast<std::uint32_t>(offset);
  f.stride = static_cast<std::uint32_t>(stride);
  f.min = -std::numeric_limits<double>::infinity();
  f.max = std::numeric_limits<double>::infinity();
  return f;
}
inline Field number(std::string name, std::size_t offset, std::string unit = "") {
  return scalar(std::move(name), FULMAR_F64, offset, 8, std::move(unit));
}
inline Field nested(std::string name, TypePtr type, std::size_t offset, std::string unit = "") {
  Field f = scalar(std::move(name), FULMAR_STRUCT, offset, type->size, std::move(unit));
  f.type = std::move(type);
  return f;
}
inline Field label(std::string name, std::vector<std::string> labels, std::size_t offset) {
  Field f = scalar(std::move(name), FULMAR_ENUM, offset, 1);
  f.labels = std::move(labels);
  return f;
}
inline Field array(Field f, std::uint32_t count) {
  f.shape = FULMAR_ARRAY;
  f.count = count;
  return f;
}
inline Field list(Field f, std::uint32_t capacity, std::size_t items) {
  f.shape = FULMAR_LIST;
  f.count = capacity;
  f.items = static_cast<std::uint32_t>(items);
  return f;
}
inline TypePtr make_type(std::string name, std::size_t size, std::size_t align, std::vector<Field> fields,
                         std::string frame = "", std::string ros = "") {
  Type t;
  t.name = std::move(name);
  t.frame = std::move(frame);
  t.ros = std::move(ros);
  t.fields = std::move(fields);
  t.size = static_cast<std::uint32_t>(size);
  t.align = static_cast<std::uint32_t>(align);
  return std::make_shared<const Type>(std::move(t));
}

inline TypePtr vector_type() {
  return make_type("Vec3Ned", sizeof(Vector), 8, {number("north", 0), number("east", 8), number("down", 16)},
                   "ned");
}
inline TypePtr leg_type() {
  return make_type("Leg", sizeof(Leg), 8,
                   {label("kind", {"line", "orbit"}, offsetof(Leg, kind)),
                    scalar("has_course", FULMAR_BOOL, offsetof(Leg, has_course), 1),
                    number("course_rad", offsetof(Leg, course_rad), "rad"),
                    nested("position_m", vector_type(), offsetof(Leg, position_m), "m")});
}
inline TypePtr mixed_type() {
  using S = Items<double, 4>;
  using L = Items<Leg, 3>;
  return make_type("Mixed", sizeof(Mixed), 8,
                   {scalar("armed", FULMAR_BOOL, offsetof(Mixed, armed), 1),
                    number("speed_mps", offsetof(Mixed, speed_mps), "m/s"),
                    scalar("count", FULMAR_U32, offsetof(Mixed, count), 4),
                    array(number("gains_ratio", offsetof(Mixed, gains_ratio)), 3),
                    scalar("name", FULMAR_TEXT, offsetof(Mixed, name), 8),
                    list(number("samples_volt", offsetof(Mixed, samples_volt), "V"), 4, offsetof(S, items)),
                    label("mode", {"idle", "hold", "2d_fix"}, offsetof(Mixed, mode)),
                    scalar("stamp_ns", FULMAR_I64, offsetof(Mixed, stamp_ns), 8, "ns"),
                    scalar("load_ratio", FULMAR_F32, offsetof(Mixed, load_ratio), 4),
                    scalar("offset", FULMAR_I32, offsetof(Mixed, offset), 4),
                    nested("attitude_std_rad", vector_type(), offsetof(Mixed, attitude_std_rad), "rad"),
                    array(scalar("tags", FULMAR_TEXT, offsetof(Mixed, tags), 4), 2),
                    list(nested("legs", leg_type(), offsetof(Mixed, legs)), 3, offsetof(L, items))});
}

inline Mixed mixed_value() {
  Mixed m{};
  m.armed = true;
  m.speed_mps = 1.5;
  m.count = 7;
  m.gains_ratio = {1, 2, -2};
  m.name = {'a', 'b'};
  m.samples_volt = {2, {0.5, 1.0}};
  m.mode = 1;
  m.stamp_ns = -2;
  m.load_ratio = 0.25F;
  m.offset = -3;
  m.attitude_std_rad = {0.5, 1, 2};
  m.tags = {{{'x'}, {'y', 'z', 'w'}}};
  m.legs.count = 2;
  m.legs.items[0] = {1, true, 0.5, {3, 4, 5}};
  m.legs.items[1] = {0, false, -0.5, {6, 7, 8}};
  return m;
}

template <class T>
const std::byte* bytes_of(const T& value) {
  return reinterpret_cast<const std::byte*>(&value);
}
template <class T>
std::byte* bytes_of(T& value) {
  return reinterpret_cast<std::byte*>(&value);
}

}  // namespace fulmar::core::test

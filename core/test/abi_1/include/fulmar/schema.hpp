// SPDX-License-Identifier: BSD-3-Clause
// A plain struct describes itself: names, kinds, counts, offsets, units and frames of its fields, at compile time, without a macro.
//
// How: count the members by brace initialisation and bind them (detail/members.hpp); a pointer to a member of an object that is declared
// and never defined, used as a template argument, appears with the member's name in the signature of a function; offsets follow from the
// layout rule of standard-layout aggregates and are checked against sizeof.
#pragma once
#include <array>
#include <cstdint>
#include <limits>
#include <string_view>
#include <type_traits>

#include "fulmar/abi.h"
#include "fulmar/detail/members.hpp"
#include "fulmar/detail/units.hpp"
#include "fulmar/message.hpp"

#ifdef __FAST_MATH__
#error "Fulmar plugins are not built with -ffast-math: it breaks the finite checks and switches denormals off in the whole host"
#endif

namespace fulmar::detail {

// ---- names ------------------------------------------------------------------------------------------------------------------

template <class T>
struct Holder {
  T value;
};
#if defined(__clang__)
#pragma clang diagnostic push
#pragma clang diagnostic ignored "-Wundefined-var-template"
#pragma clang diagnostic ignored "-Wundefined-internal"
#endif
template <class T>
extern const Holder<T> fake;

template <auto A>
consteval const char* value_signature() {
  return __PRETTY_FUNCTION__;
}
template <class T>
consteval const char* type_signature() {
  return __PRETTY_FUNCTION__;
}

constexpr bool word(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_'; }

/// The last identifier in a signature, before what the compiler closes it with.
constexpr std::string_view last_word(std::string_view s) {
  while (!s.empty() && !word(s.back())) s.remove_suffix(1);
  std::size_t b = s.size();
  while (b > 0 && word(s[b - 1])) --b;
  return s.substr(b);
}

template <std::size_t N>
struct Name {
  std::array<char, N + 1> bytes{};
};
template <std::size_t N>
consteval Name<N> make_name(std::string_view s) {
  Name<N> name;
  for (std::size_t i = 0; i < N; ++i) name.bytes[i] = s[i];
  return name;
}

template <class T, std::size_t I>
struct FieldName {
  static constexpr std::string_view view = last_word(value_signature<std::get<I>(members(fake<T>.value))>());
  static constexpr auto stored = make_name<view.size()>(view);
  static constexpr const char* c_str = stored.bytes.data();
};
#if defined(__clang__)
#pragma clang diagnostic pop
#endif

template <auto V>
struct EnumName {
  static constexpr std::string_view signature = value_signature<V>();
  // "... = fulmar::PathKind::line]" or, for a number that names nothing, "... = (fulmar::PathKind)7]"
  static constexpr std::string_view tail = signature.substr(signature.rfind("= "));
  static constexpr std::string_view view = last_word(tail);
  static constexpr bool valid = !(view[0] >= '0' && view[0] <= '9');
  static constexpr auto stored = make_name<view.size()>(view);
  static constexpr const char* c_str = stored.bytes.data();
};

template <class T>
struct TypeName {
  static constexpr std::string_view view = last_word(type_signature<T>());
  static constexpr auto stored = make_name<view.size()>(view);
  static constexpr const char* c_str = stored.bytes.data();
};
template <>
struct TypeName<Vec3<Ned>> {
  static constexpr const char* c_str = "Vec3Ned";
};
template <>
struct TypeName<Vec3<Body>> {
  static constexpr const char* c_str = "Vec3Body";
};

template <class E, std::size_t N = 0>
consteval std::size_t label_count() {
  if constexpr (N < 128 && EnumName<static_cast<E>(N)>::valid)
    return label_count<E, N + 1>();
  else
    return N;
}
template <class E>
struct Labels {
  static constexpr std::size_t count = label_count<E>();
  static_assert(count > 0, "an enum of a message names its values from 0 on, without gaps");
  template <std::size_t... I>
  static consteval std::array<const char*, count> make(std::index_sequence<I...>) {
    return {EnumName<static_cast<E>(I)>::c_str...};
  }
  static constexpr std::array<const char*, count> names = make(std::make_index_sequence<count>{});
};

// ---- kinds ------------------------------------------------------------------------------------------------------------------

template <class T>
inline constexpr bool always_false = false;

template <class T>
struct Shape {  // of a scalar
  using Element = T;
  static constexpr std::uint32_t shape = FULMAR_SCALAR, count = 1, items = 0;
};
template <class T, std::size_t N>
struct Shape<std::array<T, N>> {
  using Element = T;
  static constexpr std::uint32_t shape = FULMAR_ARRAY, count = N, items = 0;
};
template <class T, std::size_t N>
struct Shape<List<T, N>> {
  using Element = T;
  static constexpr std::uint32_t shape = FULMAR_LIST, count = N, items = (sizeof(std::uint32_t) + alignof(T) - 1) / alignof(T) * alignof(T);
};

template <class T>
struct IsText : std::false_type {};
template <std::size_t N>
struct IsText<Text<N>> : std::true_type {};

/// Eigen types have this nested enum.
template <class T>
concept EigenType = requires {
  T::RowsAtCompileTime;
}
|| requires { typename T::Scalar; };

template <class T>
consteval std::uint32_t kind_of() {
  static_assert(!std::is_pointer_v<T> && !std::is_reference_v<T>, "a message holds no pointer and no reference");
  static_assert(!EigenType<T>, "a message holds no Eigen type: its layout changes with compiler flags; use Vec3<Ned>, Vec3<Body> or Quat");
  if constexpr (std::is_same_v<T, bool>)
    return FULMAR_BOOL;
  else if constexpr (std::is_same_v<T, std::uint8_t>)
    return FULMAR_U8;
  else if constexpr (std::is_same_v<T, std::int8_t>)
    return FULMAR_I8;
  else if constexpr (std::is_same_v<T, std::int16_t>)
    return FULMAR_I16;
  else if constexpr (std::is_same_v<T, std::uint16_t>)
    return FULMAR_U16;
  else if constexpr (std::is_same_v<T, std::int32_t>)
    return FULMAR_I32;
  else if constexpr (std::is_same_v<T, std::uint32_t>)
    return FULMAR_U32;
  else if constexpr (std::is_same_v<T, std::int64_t>)
    return FULMAR_I64;
  else if constexpr (std::is_same_v<T, std::uint64_t>)
    return FULMAR_U64;
  else if constexpr (std::is_same_v<T, float>)
    return FULMAR_F32;
  else if constexpr (std::is_same_v<T, double>)
    return FULMAR_F64;
  else if constexpr (std::is_enum_v<T>) {
    static_assert(sizeof(T) == 1, "an enum of a message is one byte: enum class Name : std::uint8_t");
    return FULMAR_ENUM;
  } else if constexpr (IsText<T>::value)
    return FULMAR_TEXT;
  else if constexpr (std::is_class_v<T> && std::is_aggregate_v<T>)
    return FULMAR_STRUCT;
  else
    static_assert(always_false<T>, "a message holds numbers, bool, enum, Text, List, std::array, Vec3, Quat and structs of these");
}

template <class T>
inline constexpr bool is_frame_vector = std::is_same_v<T, Vec3<Ned>> || std::is_same_v<T, Vec3<Body>>;
template <class T>
inline constexpr bool has_own_names = is_frame_vector<T> || std::is_same_v<T, Quat>;

/// A foreign message states its ROS type and is exempt from the unit rule: `static constexpr const char* ros_type = "sensor_msgs/msg/Imu";`
template <class T>
concept Foreign = requires {
  T::ros_type;
};

// ---- tables -----------------------------------------------------------------------------------------------------------------

template <class T>
struct Table;

template <class T, std::size_t I>
using MemberType = std::remove_cvref_t<decltype(*std::get<I>(members(std::declval<T&>())).p)>;

template <class T, std::size_t I>
consteval std::size_t member_offset() {
  if constexpr (I == 0)
    return 0;
  else {
    constexpr std::size_t end = member_offset<T, I - 1>() + sizeof(MemberType<T, I - 1>), a = alignof(MemberType<T, I>);
    return (end + a - 1) / a * a;
  }
}
/// Where the struct would end by the layout rule; differs from sizeof when the rule does not hold.
template <class T>
consteval std::size_t layout_size() {
  constexpr std::size_t n = member_count<T>();
  if constexpr (n == 0)
    return sizeof(T);
  else
    return (member_offset<T, n - 1>() + sizeof(MemberType<T, n - 1>) + alignof(T) - 1) / alignof(T) * alignof(T);
}

template <class T>
constexpr const fulmar_type* type_table();

template <class T, std::size_t I>
consteval fulmar_field make_field() {
  using Member = MemberType<T, I>;
  using Element = typename Shape<Member>::Element;
  constexpr std::uint32_t kind = kind_of<Element>();
  constexpr std::string_view name = FieldName<T, I>::view;
  constexpr int unit = has_own_names<T> || Foreign<T> ? -1 : find_unit(name);
  constexpr bool needs_unit = (kind == FULMAR_F32 || kind == FULMAR_F64 || is_frame_vector<Element>)&&!has_own_names<T> && !Foreign<T>;
  static_assert(!needs_unit || unit >= 0,
                "every floating-point field name ends in its unit: _m, _mps, _rad, _s, _ratio, ... (fulmar/detail/units.hpp)");
  constexpr bool has_unit = needs_unit || (unit >= 0 && (kind == FULMAR_I64 || kind == FULMAR_U64) && name.ends_with("_ns"));

  fulmar_field f{};
  f.name = FieldName<T, I>::c_str;
  f.unit = has_unit && unit >= 0 ? units[static_cast<std::size_t>(unit)].printed : "";
  f.kind = kind;
  f.shape = Shape<Member>::shape;
  f.offset = static_cast<std::uint32_t>(member_offset<T, I>());
  f.count = Shape<Member>::count;
  f.stride = sizeof(Element);
  f.items = Shape<Member>::items;
  f.min = needs_unit && unit >= 0 ? units[static_cast<std::size_t>(unit)].min : -std::numeric_limits<double>::infinity();
  f.max = needs_unit && unit >= 0 ? units[static_cast<std::size_t>(unit)].max : std::numeric_limits<double>::infinity();
  if constexpr (kind == FULMAR_STRUCT) f.type = type_table<Element>();
  if constexpr (kind == FULMAR_ENUM) {
    f.labels = Labels<Element>::names.data();
    f.label_count = Labels<Element>::count;
  }
  return f;
}

template <class T>
consteval const char* frame_of() {
  if (std::is_same_v<T, Vec3<Ned>>) return "ned";
  if (std::is_same_v<T, Vec3<Body>>) return "body";
  if (std::is_same_v<T, Quat>) return "body to ned";
  return "";
}
template <class T>
consteval const char* ros_of() {
  if constexpr (Foreign<T>)
    return T::ros_type;
  else
    return "";
}

template <class T>
struct Table {
  static_assert(std::is_aggregate_v<T>, "a message is a plain struct: no constructor, no base class, no private member");
  static_assert(std::is_trivially_copyable_v<T>, "a message is trivially copyable: no std::string, no std::vector, no Eigen type");
  static_assert(std::is_standard_layout_v<T>, "a message is a plain struct");
  static constexpr std::size_t count = member_count<T>();
  static_assert(layout_size<T>() == sizeof(T), "the layout of this struct is unusual: no alignas, no bit fields, no C arrays");

  template <std::size_t... I>
  static consteval std::array<fulmar_field, count> make(std::index_sequence<I...>) {
    return {make_field<T, I>()...};
  }
  static constexpr std::array<fulmar_field, count> fields = make(std::make_index_sequence<count>{});

  static constexpr fulmar_type type{TypeName<T>::c_str,   frame_of<T>(), ros_of<T>(), fields.data(), static_cast<std::uint32_t>(count),
                                    sizeof(fulmar_field), sizeof(T),     alignof(T)};
};

template <class T>
constexpr const fulmar_type* type_table() {
  return &Table<T>::type;
}

}  // namespace fulmar::detail

namespace fulmar {

/// The field table of a message, as it crosses to the host. Fails to compile, with a sentence, for a struct that cannot be a message.
template <class T>
constexpr const fulmar_type& describe() {
  return *detail::type_table<T>();
}

}  // namespace fulmar

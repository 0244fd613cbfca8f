// SPDX-License-Identifier: BSD-3-Clause
// Self-description of plain structs: names, kinds, counts, offsets, units and frames of the fields, at
// compile time, without a macro.
//
// Brace initialisation counts the members, and structured bindings access them (detail/members.hpp). Pointers
// to the members of a declared, undefined object are template arguments: the signature of a function then
// contains the member names. Offsets follow from the layout rule of standard-layout aggregates, and are
// checked against sizeof. All is computed once per type, not once per field, since this dominates the compile
// time of a plugin.
#pragma once
#include <array>
#include <cstdint>
#include <limits>
#include <string_view>
#include <type_traits>
#include <utility>

#include "fulmar/abi.h"
#include "fulmar/detail/members.hpp"
#include "fulmar/detail/units.hpp"
#include "fulmar/detail/words.hpp"
#include "fulmar/message.hpp"

#ifdef __FAST_MATH__
#error \
    "Fulmar plugins are not built with -ffast-math: it breaks the finite checks and switches denormals off in the whole host"
#endif

namespace fulmar::detail {

// ---- names

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

template <auto... A>
consteval const char* value_signature() {
  return __PRETTY_FUNCTION__;
}
template <class T>
consteval const char* type_signature() {
  return __PRETTY_FUNCTION__;
}

/// Address of a member as a template argument of class type: clang 14 does not accept a bare address.
struct At {
  const void* address;
};
struct ToAddresses {
  template <class... M>
  constexpr std::array<At, sizeof...(M)> operator()(const M&... member) const {
    return {At{&member}...};
  }
};

/// Names of the members of T, from one signature: "... {At{(... ::position_m)}, At{(... ::speed_mps)}}".
template <class T>
struct FieldNames {
  static constexpr std::size_t count = member_count<T>();

  template <std::size_t... I>
  static constexpr std::string_view signature(std::index_sequence<I...>) {
    constexpr auto addresses =
        with_members(fake<T>.value, ToAddresses{});  // no member: the linker must not need `fake`
    return value_signature<addresses[I]...>();
  }
  /// From the last to the first: the word before a closing brace; then back to its opening brace.
  static constexpr Found<count> find() {
    Found<count> out;
    if constexpr (count > 0) {
      std::string_view rest = signature(std::make_index_sequence<count>{});
      rest = rest.substr(
          0, rest.rfind('}') + (rest.ends_with("}}]") ? 0 : 1));  // gcc also closes the list with a brace
      for (std::size_t i = count; i-- > 0;) {
        rest = rest.substr(0, rest.rfind('}'));
        out.words[i] = last_word(rest);
        out.room += out.words[i].size() + 1;
        for (int depth = 1; depth > 0; rest.remove_suffix(1))
          depth += rest.back() == '}' ? 1 : rest.back() == '{' ? -1 : 0;
      }
    }
    return out;
  }
  static constexpr Found<count> found = find();
  static constexpr auto stored = cut_out<count, found.room>(found);
  static constexpr const char* c_str(std::size_t i) { return stored.bytes.data() + stored.begin[i]; }
  static constexpr std::string_view view(std::size_t i) { return found.words[i]; }
};
#if defined(__clang__)
#pragma clang diagnostic pop
#endif

/// A name as text with the lifetime of the plugin.
template <class T>
struct TypeName {
  static constexpr Found<1> find() {
    const std::string_view name = last_word(type_signature<T>());
    return {{name}, name.size() + 1};
  }
  static constexpr Found<1> found = find();
  static constexpr auto stored = cut_out<1, found.room>(found);
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

/// Names of the first `tried` values of an enum from one signature: "... {Kind::line, Kind::orbit, (Kind)2}"
/// or with <>.
template <class E, std::size_t tried>
struct Enumerators {
  template <std::size_t... I>
  static constexpr std::string_view signature(std::index_sequence<I...>) {
    return value_signature<static_cast<E>(I)...>();
  }
  /// Number of values before the first without a name, and their names.
  static constexpr std::pair<std::size_t, std::array<std::string_view, tried>> find() {
    std::pair<std::size_t, std::array<std::string_view, tried>> out{};
    std::string_view rest = signature(std::make_index_sequence<tried>{});
    rest = rest.substr(rest.rfind("A = ") + 5);
    for (std::size_t i = 0, depth = 0, n = 0; i < rest.size() && out.first < tried; ++i) {
      const char c = rest[i];
      if ((c == ',' && depth == 0) || i + 2 == rest.size()) {  // i + 2: before the closing "}]" or ">]"
        const std::string_view name = last_word(rest.substr(n, i - n));
        if (name[0] >= '0' && name[0] <= '9') break;  // a number: a value without a name
        out.second[out.first++] = name;
        n = i + 1;
      } else if (c == '(' || c == '{' || c == '<') {
        ++depth;
      } else if (c == ')' || c == '}' || c == '>') {
        --depth;
      }
    }
    return out;
  }
  static constexpr auto found = find();
};

template <class E>
struct Labels {
  static constexpr std::size_t most = 128;
  static constexpr auto some() {
    if constexpr (constexpr std::size_t first = 16; Enumerators<E, first>::found.first < first)
      return Enumerators<E, first>::found;
    else
      return Enumerators<E, most>::found;
  }
  static constexpr std::size_t count = some().first;
  static_assert(count > 0, "an enum of a message names its values from 0 on, without gaps");
  static constexpr Found<count> find() {
    Found<count> out;
    for (std::size_t i = 0; i < count; ++i) out.room += (out.words[i] = some().second[i]).size() + 1;
    return out;
  }
  static constexpr Found<count> found = find();
  static constexpr auto stored = cut_out<count, found.room>(found);
  static constexpr std::array<const char*, count> make() {
    std::array<const char*, count> out{};
    for (std::size_t i = 0; i < count; ++i) out[i] = stored.bytes.data() + stored.begin[i];
    return out;
  }
  static constexpr std::array<const char*, count> names = make();
};

// ---- kinds

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
  static constexpr std::uint32_t shape = FULMAR_LIST, count = N,
                                 items = (sizeof(std::uint32_t) + alignof(T) - 1) / alignof(T) * alignof(T);
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
  static_assert(!std::is_pointer_v<T> && !std::is_reference_v<T>,
                "a message holds no pointer and no reference");
  static_assert(!EigenType<T>,
                "a message holds no Eigen type: its layout changes with compiler flags; use Vec3<Ned>, "
                "Vec3<Body> or Quat");
  if constexpr (Shape<T>::shape != FULMAR_SCALAR) {
    static_assert(always_false<T>,
                  "a message holds no array of arrays: write one array, row by row, or an array of structs");
    return FULMAR_U8;
  } else if constexpr (std::is_same_v<T, bool>)
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
    static_assert(
        always_false<T>,
        "a message holds numbers, bool, enum, Text, List, std::array, Vec3, Quat and structs of these");
}

template <class T>
inline constexpr bool is_frame_vector = std::is_same_v<T, Vec3<Ned>> || std::is_same_v<T, Vec3<Body>>;
template <class T>
inline constexpr bool has_own_names = is_frame_vector<T> || std::is_same_v<T, Quat>;

/// A foreign message states its ROS type and is exempt from the unit rule: `static constexpr const char*
/// ros_type = "sensor_msgs/msg/Imu";`
template <class T>
concept Foreign = requires {
  T::ros_type;
};

// ---- tables

template <class T>
constexpr const fulmar_type* type_table();

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

/// Properties of a field from the type of its member: all but name, unit and offset.
template <class Member>
consteval fulmar_field field_of() {
  using Element = typename Shape<Member>::Element;
  fulmar_field f{};
  f.name = f.unit = "";
  f.kind = kind_of<Element>();
  f.shape = Shape<Member>::shape;
  f.count = Shape<Member>::count;
  f.stride = sizeof(Element);
  f.items = Shape<Member>::items;
  f.min = -std::numeric_limits<double>::infinity();
  f.max = std::numeric_limits<double>::infinity();
  if constexpr (kind_of<Element>() == FULMAR_STRUCT) f.type = type_table<Element>();
  if constexpr (kind_of<Element>() == FULMAR_ENUM) {
    f.labels = Labels<Element>::names.data();
    f.label_count = Labels<Element>::count;
  }
  return f;
}
template <class Member>
inline constexpr fulmar_field field_table = field_of<Member>();

/// A number, whose name must end in its unit.
template <class Member>
inline constexpr bool is_measured = std::is_floating_point_v<typename Shape<Member>::Element> ||
                                    is_frame_vector<typename Shape<Member>::Element>;

/// Offset of each member by the layout rule; last, the end of the struct.
template <class... M>
consteval std::array<std::size_t, sizeof...(M) + 1> offsets_of(std::size_t align) {
  const std::array<std::size_t, sizeof...(M) + 1> sizes{sizeof(M)..., 0}, aligns{alignof(M)..., align};
  std::array<std::size_t, sizeof...(M) + 1> out{};
  for (std::size_t i = 0, end = 0; i < out.size(); ++i) {
    out[i] = (end + aligns[i] - 1) / aligns[i] * aligns[i];
    end = out[i] + sizes[i];
  }
  return out;
}

template <class T, std::size_t count>
struct Rows {
  std::array<fulmar_field, count> fields{};
  std::size_t nameless = count;  ///< first number whose name does not end in a unit
};
template <class T>
consteval std::size_t appended_index() {
  constexpr std::size_t count = member_count<T>();
  if (appended_from<T>.empty()) return count;
  for (std::size_t i = 0; i < count; ++i)
    if (FieldNames<T>::view(i) == appended_from<T>) return i;
  throw "appended_from names no field of this message";
}
template <class T>
consteval bool is_required(std::string_view name) {
  for (const std::string_view required : required_fields<T>)
    if (required == name) return true;
  return false;
}
template <class T>
consteval bool is_rising(std::string_view name) {
  for (const std::string_view rising : rising_fields<T>)
    if (rising == name) return true;
  return false;
}
template <class T>
consteval bool names_member(std::string_view name) {
  for (std::size_t i = 0; i < member_count<T>(); ++i)
    if (FieldNames<T>::view(i) == name) return true;
  return false;
}
template <class T>
consteval bool required_exist() {
  for (const std::string_view required : required_fields<T>)
    if (!names_member<T>(required)) return false;
  return true;
}
template <class T>
consteval bool marked_exist() {
  for (const std::string_view rising : rising_fields<T>)
    if (!names_member<T>(rising)) return false;
  return instead_field<T>.empty() || names_member<T>(instead_field<T>);
}
template <class T>
constexpr void take_range(fulmar_field& field, std::string_view name) {
  for (const FieldRange& range : field_ranges<T>)
    if (range.field == name) {
      field.min = range.min;
      field.max = range.max;
    }
}
template <class T, class... M>
consteval Rows<T, sizeof...(M)> rows_of(Types<M...>) {
  constexpr std::size_t count = sizeof...(M);
  constexpr bool exempt = has_own_names<T> || Foreign<T>;
  Rows<T, count> out{{field_table<M>...}};
  if constexpr (count > 0) {
    const std::array<bool, count> measured{is_measured<M>...};
    const auto offsets = offsets_of<M...>(alignof(T));
    for (std::size_t i = count; i-- > 0;) {
      fulmar_field& f = out.fields[i];
      f.name = FieldNames<T>::c_str(i);
      f.offset = static_cast<std::uint32_t>(offsets[i]);
      const std::string_view name = FieldNames<T>::view(i);
      if (i >= appended_index<T>()) f.flags |= FULMAR_FIELD_APPENDED;
      if (is_required<T>(name)) f.flags |= FULMAR_FIELD_REQUIRED;
      if (is_rising<T>(name)) f.flags |= FULMAR_FIELD_RISING;
      if (!name.empty() && name == instead_field<T>) f.flags |= FULMAR_FIELD_INSTEAD;
      take_range<T>(f, name);  // for a count, which needs no unit
      const bool stamp = (f.kind == FULMAR_I64 || f.kind == FULMAR_U64) && name.ends_with("_ns");
      if (exempt || !(measured[i] || stamp)) continue;
      const int unit = find_unit(name);
      if (unit < 0) {
        out.nameless = i;
        continue;
      }
      f.unit = units[static_cast<std::size_t>(unit)].printed;
      if (!measured[i]) continue;
      f.min = units[static_cast<std::size_t>(unit)].min;
      f.max = units[static_cast<std::size_t>(unit)].max;
      take_range<T>(f, name);
    }
  }
  return out;
}

/// Rejects a number without a unit; the compiler message names the struct and the index of the field.
template <class T, std::size_t field, std::size_t count>
struct EveryNumberHasAUnit {
  static_assert(field == count,
                "every floating-point field name ends in its unit: _m, _mps, _rad, _s, _ratio, ... "
                "(fulmar/detail/units.hpp)");
};

template <class T>
struct Table {
  static_assert(std::is_aggregate_v<T>,
                "a message is a plain struct: no constructor, no base class, no private member");
  static_assert(std::is_trivially_copyable_v<T>,
                "a message is trivially copyable: no std::string, no std::vector, no Eigen type");
  static_assert(std::is_standard_layout_v<T>, "a message is a plain struct");
  static constexpr std::size_t count = member_count<T>();
  template <class... M>
  static constexpr std::size_t end_of(Types<M...>) {
    return count == 0 ? sizeof(T) : offsets_of<M...>(alignof(T))[count];
  }
  static_assert(end_of(MemberTypes<T>{}) == sizeof(T),
                "the layout of this struct is unusual: no alignas, no bit fields, no C arrays");

  static_assert(required_exist<T>(), "required_fields names what is no field of this struct");
  static_assert(marked_exist<T>(), "rising_fields or instead_field names what is no field of this struct");

  static constexpr Rows<T, count> rows = rows_of<T>(MemberTypes<T>{});
  static constexpr EveryNumberHasAUnit<T, rows.nameless, count> rule{};
  static constexpr fulmar_type type{
      TypeName<T>::c_str,   frame_of<T>(), ros_of<T>(), rows.fields.data(), static_cast<std::uint32_t>(count),
      sizeof(fulmar_field), sizeof(T),     alignof(T)};
};

template <class T>
constexpr const fulmar_type* type_table() {
  return &Table<T>::type;
}

}  // namespace fulmar::detail

namespace fulmar {

/// The field table of a message for the host. A struct that cannot be a message is a compile error with a
/// sentence.
template <class T>
constexpr const fulmar_type& describe() {
  return *detail::type_table<T>();
}

}  // namespace fulmar

// SPDX-License-Identifier: BSD-3-Clause
// From a struct of parameters, with its groups, to the table of abi.h, and from the host's values back into
// it. A part of plugin.hpp, which includes it at its end.
#pragma once
#include <array>
#include <cstring>
#include <string_view>
#include <type_traits>

namespace fulmar::detail {

constexpr std::uint32_t access_flags(Access access) { return access == Access::live ? FULMAR_LIVE : 0; }
constexpr std::uint32_t need_flags(Need need) { return need == Need::required ? FULMAR_REQUIRED : 0; }

constexpr fulmar_param blank_param() {
  fulmar_param e{};
  e.name = e.unit = e.doc = e.initial_text = "";
  return e;
}
constexpr fulmar_param param_entry(const Param& p) {
  fulmar_param e = blank_param();
  e.unit = p.unit, e.doc = p.doc, e.kind = FULMAR_NUMBER, e.flags = access_flags(p.access);
  e.initial[0] = p.value, e.min = p.min, e.max = p.max;
  return e;
}
constexpr fulmar_param param_entry(const Flag& p) {
  fulmar_param e = blank_param();
  e.doc = p.doc, e.kind = FULMAR_FLAG, e.flags = access_flags(p.access), e.initial[0] = p.value ? 1 : 0,
  e.max = 1;
  return e;
}
constexpr fulmar_param param_entry(const Count& p) {
  fulmar_param e = blank_param();
  e.doc = p.doc, e.kind = FULMAR_COUNT, e.flags = access_flags(p.access),
  e.initial[0] = static_cast<double>(p.value);
  e.min = static_cast<double>(p.min), e.max = static_cast<double>(p.max);
  return e;
}
template <class E>
constexpr fulmar_param param_entry(const Choice<E>& p) {
  fulmar_param e = blank_param();
  e.doc = p.doc, e.kind = FULMAR_CHOICE, e.flags = access_flags(p.access),
  e.initial[0] = static_cast<double>(p.value);
  e.choices = Labels<E>::names.data(), e.choice_count = Labels<E>::count,
  e.max = static_cast<double>(Labels<E>::count - 1);
  return e;
}
template <std::size_t N>
constexpr fulmar_param param_entry(const TextParam<N>& p) {
  fulmar_param e = blank_param();
  e.doc = p.doc, e.kind = FULMAR_STRING, e.initial_text = p.value.bytes.data(), e.capacity = N;
  return e;
}
template <class F>
constexpr fulmar_param param_entry(const Vector<F>& p) {
  fulmar_param e = blank_param();
  e.unit = p.unit, e.doc = p.doc, e.kind = FULMAR_VECTOR, e.flags = access_flags(p.access),
  e.type = type_table<Vec3<F>>();
  const auto& [a, b, c] = p.value;
  e.initial[0] = a, e.initial[1] = b, e.initial[2] = c, e.min = p.min, e.max = p.max;
  return e;
}
template <class T>
constexpr fulmar_param param_entry(const Record<T>& p) {
  fulmar_param e = blank_param();
  e.doc = p.doc, e.kind = FULMAR_RECORD, e.flags = need_flags(p.need), e.type = type_table<T>(),
  e.initial_data = &p.value;
  return e;
}
constexpr fulmar_param param_entry(const Blob& p) {
  fulmar_param e = blank_param();
  e.doc = p.doc, e.kind = FULMAR_BLOB, e.flags = need_flags(p.need);
  return e;
}

inline void assign(Param& p, const fulmar_value& v) { p.value = v.number[0]; }
inline void assign(Flag& p, const fulmar_value& v) { p.value = v.integer != 0; }
inline void assign(Count& p, const fulmar_value& v) { p.value = v.integer; }
template <class E>
void assign(Choice<E>& p, const fulmar_value& v) {
  p.value = static_cast<E>(v.integer);
}
template <std::size_t N>
void assign(TextParam<N>& p, const fulmar_value& v) {
  p.value = Text<N>(std::string_view(v.text ? v.text : ""));
}
template <class F>
void assign(Vector<F>& p, const fulmar_value& v) {
  p.value = {v.number[0], v.number[1], v.number[2]};
}
template <class T>
void assign(Record<T>& p, const fulmar_value& v) {
  if (v.data && v.size == sizeof(T))
    std::memcpy(&p.value, v.data, sizeof(T));  // retune leaves records as they are
  if (v.data) p.is_given = v.integer != 0;
}
inline void assign(Blob& p, const fulmar_value& v) {
  if (!v.data) return;
  p.data = static_cast<const std::byte*>(v.data);
  p.size = v.size;
  p.name = v.text ? v.text : "";
}

template <class M>
concept Parameter = requires(const M& m) {
  param_entry(m);
};

template <class M, class F>
constexpr void visit_param(M& member, F& f);

/// Calls f(parameter) for each parameter of a struct, those of its groups (structs of parameters) in their
/// places.
template <class S, class F>
constexpr void for_each_param(S& params, F& f) {
  with_members(params, [&f](auto&... member) { (visit_param(member, f), ...); });
}
template <class M, class F>
constexpr void visit_param(M& member, F& f) {
  if constexpr (Parameter<M>) {
    f(member);
  } else {
    static_assert(
        std::is_class_v<M> && std::is_aggregate_v<M>,
        "Params holds Param, Flag, Count, Choice, TextParam, Vector, Record, Blob and structs of these");
    for_each_param(member, f);
  }
}

template <class S>
struct ParamTable {
  static constexpr S initial{};
  static constexpr std::size_t count_all() {
    std::size_t n = 0;
    auto one = [&](const auto&) { ++n; };
    for_each_param(initial, one);
    return n;
  }
  static constexpr std::size_t count = count_all();
  /// The name of a parameter is that of its member, in a group as well.
  template <class G, class... M>
  static constexpr void name(std::array<fulmar_param, count>& out, std::size_t& at, Types<M...>) {
    std::size_t i = 0;
    [[maybe_unused]] const auto one = [&]<class P>(const P*) {
      if constexpr (Parameter<P>)
        out[at++].name = FieldNames<G>::c_str(i);
      else
        name<P>(out, at, MemberTypes<P>{});
      ++i;
    };
    (one(static_cast<const M*>(nullptr)), ...);
  }
  static constexpr std::array<fulmar_param, count> make() {
    std::array<fulmar_param, count> out{};
    std::size_t at = 0;
    auto one = [&](const auto& param) { out[at++] = param_entry(param); };
    for_each_param(initial, one);
    at = 0;
    name<S>(out, at, MemberTypes<S>{});
    return out;
  }
  static constexpr std::array<fulmar_param, count> table = make();
  static constexpr bool names_differ() {
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t k = 0; k < i; ++k)
        if (std::string_view(table[i].name) == table[k].name) return false;
    return true;
  }
  static_assert(names_differ(),
                "two parameters have one name: a group's members are parameters beside all others");
};

}  // namespace fulmar::detail

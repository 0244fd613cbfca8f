// SPDX-License-Identifier: BSD-3-Clause
// From a struct of parameters, with its groups, to the table of abi.h, and from the host's values back into
// the struct. plugin.hpp includes this file at its end.
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
  e.unit = p.unit;
  e.doc = p.doc;
  e.kind = FULMAR_NUMBER;
  e.flags = access_flags(p.access);
  e.initial[0] = p.value;
  e.min = p.min;
  e.max = p.max;
  return e;
}
constexpr fulmar_param param_entry(const Flag& p) {
  fulmar_param e = blank_param();
  e.doc = p.doc;
  e.kind = FULMAR_FLAG;
  e.flags = access_flags(p.access);
  e.initial[0] = p.value ? 1 : 0;
  e.max = 1;
  return e;
}
constexpr fulmar_param param_entry(const Count& p) {
  fulmar_param e = blank_param();
  e.doc = p.doc;
  e.kind = FULMAR_COUNT;
  e.flags = access_flags(p.access);
  e.initial[0] = static_cast<double>(p.value);
  e.min = static_cast<double>(p.min);
  e.max = static_cast<double>(p.max);
  return e;
}
template <class E>
constexpr fulmar_param param_entry(const Choice<E>& p) {
  fulmar_param e = blank_param();
  e.doc = p.doc;
  e.kind = FULMAR_CHOICE;
  e.flags = access_flags(p.access);
  e.initial[0] = static_cast<double>(p.value);
  e.choices = Labels<E>::names.data();
  e.choice_count = Labels<E>::count;
  e.max = static_cast<double>(Labels<E>::count - 1);
  return e;
}
template <std::size_t N>
constexpr fulmar_param param_entry(const TextParam<N>& p) {
  fulmar_param e = blank_param();
  e.doc = p.doc;
  e.kind = FULMAR_STRING;
  e.initial_text = p.value.bytes.data();
  e.capacity = N;
  return e;
}
template <class F>
constexpr fulmar_param param_entry(const Vector<F>& p) {
  fulmar_param e = blank_param();
  e.unit = p.unit;
  e.doc = p.doc;
  e.kind = FULMAR_VECTOR;
  e.flags = access_flags(p.access);
  e.type = type_table<Vec3<F>>();
  const auto& [a, b, c] = p.value;
  e.initial[0] = a;
  e.initial[1] = b;
  e.initial[2] = c;
  e.min = p.min;
  e.max = p.max;
  return e;
}
template <class T>
constexpr fulmar_param param_entry(const Record<T>& p) {
  fulmar_param e = blank_param();
  e.doc = p.doc;
  e.kind = FULMAR_RECORD;
  e.flags = need_flags(p.need);
  e.type = type_table<T>();
  e.initial_data = &p.value;
  return e;
}
constexpr fulmar_param param_entry(const Blob& p) {
  fulmar_param e = blank_param();
  e.doc = p.doc;
  e.kind = FULMAR_BLOB;
  e.flags = need_flags(p.need);
  return e;
}

/// An element of a Matrix, as a parameter. M may be const.
template <class M>
struct MatrixItem {
  M* matrix;
  std::size_t row, column;
};
template <class M>
constexpr fulmar_param param_entry(const MatrixItem<M>& item) {
  const M& m = *item.matrix;
  return param_entry(Param{m.value[item.row][item.column], m.unit, m.min, m.max, m.doc, m.access});
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
    std::memcpy(&p.value, v.data, sizeof(T));  // retune does not change records
  if (v.data) p.is_given = v.integer != 0;
}
inline void assign(Blob& p, const fulmar_value& v) {
  if (!v.data) return;
  p.data = static_cast<const std::byte*>(v.data);
  p.size = v.size;
  p.name = v.text ? v.text : "";
}

template <class M>
void assign(MatrixItem<M>& item, const fulmar_value& v) {
  item.matrix->value[item.row][item.column] = v.number[0];
}

template <class M>
concept Parameter = requires(const M& m) {
  param_entry(m);
};

/// Rows and columns of a member that stands for several parameters. No other member has this specialization.
template <class M>
struct Several {
  static constexpr bool matrix = false, array = false;
  static constexpr std::size_t count = 1;
};
template <std::size_t R, std::size_t C>
struct Several<Matrix<R, C>> {
  static constexpr bool matrix = true, array = false;
  static constexpr std::size_t count = R * C, rows = R, columns = C;
  static constexpr std::size_t inner = C;  ///< number of parameters that differ in the last index alone
};
template <class T, std::size_t N>
struct Several<std::array<T, N>> {
  static constexpr bool matrix = false, array = true;
  static constexpr std::size_t count = N * Several<T>::count;
  static constexpr std::size_t inner = Several<T>::count;
  static constexpr bool right = Parameter<T> || Several<T>::array;
};

template <class M, class F>
constexpr void visit_param(M& member, F& f);

/// Calls f(parameter) for each parameter of a struct, in order, including those of its groups (structs of
/// parameters).
template <class S, class F>
constexpr void for_each_param(S& params, F& f) {
  with_members(params, [&f](auto&... member) { (visit_param(member, f), ...); });
}
template <class M>
concept Group = std::is_class_v<M> && std::is_aggregate_v<M> && !Parameter<M> && !Several<M>::matrix &&
                !Several<M>::array;

/// Compile error for a member that is no parameter, before other errors.
template <class M>
consteval bool is_parameter() {
  if constexpr (Several<M>::array) {
    static_assert(Several<M>::right,
                  "an array of parameters holds Param, Flag, Count, Choice or arrays of these");
    return Several<M>::right;
  } else {
    constexpr bool one = Parameter<M> || Several<M>::matrix || Group<M>;
    static_assert(one,
                  "Params holds Param, Flag, Count, Choice, TextParam, Vector, Matrix, Record, Blob, "
                  "std::array of Param "
                  "and structs of these");
    return one;
  }
}
template <class S>
consteval bool are_parameters();
template <class M>
consteval bool is_right() {
  if constexpr (!is_parameter<M>())
    return false;
  else if constexpr (Group<M>)
    return are_parameters<M>();
  return true;
}
template <class... M>
consteval bool all_right(Types<M...>) {
  return (is_right<M>() && ...);
}
template <class S>
consteval bool are_parameters() {
  return all_right(MemberTypes<S>{});
}

template <class M, class F>
constexpr void visit_param(M& member, F& f) {
  using P = std::remove_const_t<M>;
  if constexpr (Parameter<P>) {
    f(member);
  } else if constexpr (Several<P>::matrix) {
    for (std::size_t k = 0; k < Several<P>::count; ++k) {
      MatrixItem<M> item{&member, k / Several<P>::columns, k % Several<P>::columns};
      f(item);
    }
  } else if constexpr (Several<P>::array) {
    for (auto& item : member) visit_param(item, f);
  } else {
    for_each_param(member, f);
  }
}

/// Names of the parameters of one member, with their indices: "gains_0", "K_1_2".
template <class G, std::size_t i, class P>
struct ItemNames {
  static constexpr std::size_t room = FieldNames<G>::view(i).size() + 24;
  using Name = std::array<char, room>;
  static constexpr void number(Name& to, std::size_t& at, std::size_t n) {
    if (n >= 10) number(to, at, n / 10);
    to[at++] = static_cast<char>('0' + n % 10);
  }
  template <class M>
  static constexpr void indices(Name& to, std::size_t& at, std::size_t k) {
    if constexpr (Several<M>::matrix || Several<M>::array) {
      to[at++] = '_';
      number(to, at, k / Several<M>::inner);
      k %= Several<M>::inner;
      if constexpr (Several<M>::matrix) {
        to[at++] = '_';
        number(to, at, k);
      } else {
        indices<typename M::value_type>(to, at, k);
      }
    }
  }
  static constexpr std::array<Name, Several<P>::count> make() {
    std::array<Name, Several<P>::count> out{};
    for (std::size_t k = 0; k < out.size(); ++k) {
      std::size_t at = 0;
      for (const char c : FieldNames<G>::view(i)) out[k][at++] = c;
      indices<P>(out[k], at, k);
    }
    return out;
  }
  static constexpr std::array<Name, Several<P>::count> names = make();
};

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
  /// The name of a parameter is that of its member, also in a group.
  template <class G, std::size_t i, class P>
  static constexpr void name_one(std::array<fulmar_param, count>& out, std::size_t& at) {
    if constexpr (Parameter<P>)
      out[at++].name = FieldNames<G>::c_str(i);
    else if constexpr (Several<P>::matrix || Several<P>::array)
      for (const auto& text : ItemNames<G, i, P>::names) out[at++].name = text.data();
    else
      name<P>(out, at, MemberTypes<P>{});
  }
  template <class G, class... M>
  static constexpr void name(std::array<fulmar_param, count>& out, std::size_t& at, Types<M...>) {
    [&]<std::size_t... i>(std::index_sequence<i...>) { (name_one<G, i, M>(out, at), ...); }
    (std::make_index_sequence<sizeof...(M)>{});
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
  /// Not a standard comparison: clang 14 counts each of its steps, and stops after a million.
  static constexpr bool same(const char* a, const char* b) {
    while (*a == *b && *a != 0) {
      ++a;
      ++b;
    }
    return *a == *b;
  }
  static constexpr bool names_differ() {
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t k = 0; k < i; ++k)
        if (same(table[i].name, table[k].name)) return false;
    return true;
  }
  static_assert(names_differ(),
                "two parameters have one name: a group's members are parameters beside all others");
};

}  // namespace fulmar::detail

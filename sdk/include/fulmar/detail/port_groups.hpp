// SPDX-License-Identifier: BSD-3-Clause
// Groups of ports: a struct of ports inside Inputs or Outputs, whose ports are ports of the component.
// plugin.hpp includes this file at its beginning.
#pragma once
#include <array>
#include <cstddef>
#include <type_traits>

#include "fulmar/detail/members.hpp"

namespace fulmar {

template <class T>
struct In;
template <class T>
struct Optional;
template <class T>
struct Queue;
template <class T>
struct Request;
template <class T>
struct Out;
template <class T, std::size_t N>
struct OutQueue;
struct Probe;

namespace detail {

/// A type that is a port by itself. A plain message in Outputs is not.
template <class M>
inline constexpr bool is_port = false;
template <class T>
inline constexpr bool is_port<In<T>> = true;
template <class T>
inline constexpr bool is_port<Optional<T>> = true;
template <class T>
inline constexpr bool is_port<Queue<T>> = true;
template <class T>
inline constexpr bool is_port<Request<T>> = true;
template <class T>
inline constexpr bool is_port<Out<T>> = true;
template <class T, std::size_t N>
inline constexpr bool is_port<OutQueue<T, N>> = true;
template <>
inline constexpr bool is_port<Probe> = true;

template <class... M>
consteval bool any_port(Types<M...>) {
  return (is_port<M> || ...);
}
template <class M>
inline constexpr bool is_array = false;
template <class T, std::size_t N>
inline constexpr bool is_array<std::array<T, N>> = true;

/// A struct that holds at least one port. A struct of messages alone is a message.
template <class M>
consteval bool is_port_group() {
  if constexpr (is_port<M> || is_array<M> || !std::is_class_v<M> || !std::is_aggregate_v<M>)
    return false;
  else
    return any_port(MemberTypes<M>{});
}

template <class S, class F>
constexpr void visit_ports(S& ports, F& f, std::size_t& i);
template <class M, class F>
constexpr void visit_port(M& member, F& f, std::size_t& i) {
  if constexpr (is_port_group<std::remove_const_t<M>>())
    visit_ports(member, f, i);
  else
    f(member, i++);
}
template <class S, class F>
constexpr void visit_ports(S& ports, F& f, std::size_t& i) {
  with_members(ports, [&](auto&... member) { (visit_port(member, f, i), ...); });
}
/// Calls f(port, i) for each port of Inputs or Outputs, in order, including those of groups.
template <class S, class F>
constexpr void for_each_port(S& ports, F&& f) {
  std::size_t i = 0;
  visit_ports(ports, f, i);
}

template <class S>
consteval std::size_t port_count();
template <class M>
consteval std::size_t ports_of_member() {
  if constexpr (is_port_group<M>())
    return port_count<M>();
  else
    return 1;
}
template <class... M>
consteval std::size_t ports_of(Types<M...>) {
  return (ports_of_member<M>() + ... + 0);
}
template <class S>
consteval std::size_t port_count() {
  return ports_of(MemberTypes<S>{});
}

template <class S, class M>
consteval bool has_port();
template <class G, class M>
consteval bool holds_port() {
  if constexpr (is_port_group<G>())
    return has_port<G, M>();
  else
    return std::is_same_v<G, M>;
}
template <class M, class... N>
consteval bool any_is(Types<N...>) {
  return (holds_port<N, M>() || ...);
}
/// True if S has a port of type M, also in a group.
template <class S, class M>
consteval bool has_port() {
  return any_is<M>(MemberTypes<S>{});
}

}  // namespace detail
}  // namespace fulmar

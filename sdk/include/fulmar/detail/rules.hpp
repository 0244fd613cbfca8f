// SPDX-License-Identifier: BSD-3-Clause
// Requirements of a component, each with one sentence, checked before anything else is compiled. Otherwise a
// member function with a wrong signature would not be found, and never be called. A part of plugin.hpp.
#pragma once
#include <array>
#include <concepts>
#include <string_view>
#include <type_traits>

#include "fulmar/detail/params.hpp"

namespace fulmar::detail {

template <class C>
concept Vehicle = requires(C c, Tick& tick, const typename C::Params& p, typename C::Outputs& out) {
  c.read(tick, p, out);
};

/// `activate` in its older form, without Applied: `last` is the outputs alone.
template <class C>
concept TakesOutputs = requires(C c, const Tick& t, const typename C::Inputs& in, const typename C::Params& p,
                                const typename C::Outputs& last) {
  { c.activate(t, in, p, last) } -> std::same_as<Status>;
};
template <class C>
concept TakesApplied = requires(C c, const Tick& t, const typename C::Inputs& in, const typename C::Params& p,
                                const Applied<typename C::Outputs>& last) {
  { c.activate(t, in, p, last) } -> std::same_as<Status>;
};

template <class C>
concept HasPorts = requires {
  typename C::Inputs;
  typename C::Outputs;
  typename C::Params;
};
template <class C>
concept Steps = requires(C c, const Tick& t, const typename C::Inputs& in, const typename C::Params& p,
                         typename C::Outputs& out) {
  { c.step(t, in, p, out) } -> std::same_as<Status>;
};
template <class C>
concept Reads = requires(C c, Tick& t, const typename C::Params& p, typename C::Outputs& out) {
  { c.read(t, p, out) } -> std::same_as<Status>;
};
template <class C>
concept Writes = requires(C c, const Tick& t, const typename C::Inputs& in, const typename C::Params& p) {
  { c.write(t, in, p) } -> std::same_as<Status>;
};

/// A member with that name, but a signature that the host cannot call.
template <class C>
concept WrongStep = requires {
  &C::step;
}
&&!Steps<C>;
template <class C>
concept WrongRead = requires {
  &C::read;
}
&&!Reads<C>;
template <class C>
concept WrongWrite = requires {
  &C::write;
}
&&!Writes<C>;
template <class C>
concept WrongConfigure = requires {
  &C::configure;
}
&&!requires(C c, const typename C::Params& p) { c.configure(p); };
template <class C>
concept WrongRetune = requires {
  &C::retune;
}
&&!requires(C c, const typename C::Params& p) { c.retune(p); };
template <class C>
concept WrongActivate = requires {
  &C::activate;
}
&&!TakesOutputs<C> && !TakesApplied<C>;
template <class C>
concept WrongDeactivate = requires {
  &C::deactivate;
}
&&!requires(C c) { c.deactivate(); };

/// True if the component can be compiled further.
template <class C>
consteval bool is_component() {
  static_assert(HasPorts<C>, "a component has Inputs, Outputs and Params, be they empty: struct Params {};");
  if constexpr (HasPorts<C>) {
    static_assert(!WrongStep<C>, "step is Status step(const Tick&, const Inputs&, const Params&, Outputs&)");
    static_assert(!WrongRead<C>, "read is Status read(Tick&, const Params&, Outputs&)");
    static_assert(!WrongWrite<C>, "write is Status write(const Tick&, const Inputs&, const Params&)");
    constexpr bool wrong = WrongStep<C> || WrongRead<C> || WrongWrite<C>;
    static_assert(wrong || Steps<C> || (Reads<C> && Writes<C>),
                  "a component has Status step(const Tick&, const Inputs&, const Params&, Outputs&), a "
                  "vehicle has read "
                  "and write in its place");
    static_assert(!WrongConfigure<C>, "configure is void configure(const Params&)");
    static_assert(!WrongRetune<C>, "retune is void retune(const Params&)");
    static_assert(!WrongActivate<C>,
                  "activate is Status activate(const Tick&, const Inputs&, const Params&, const "
                  "Applied<Outputs>& last)");
    static_assert(!WrongDeactivate<C>, "deactivate is void deactivate()");
    return !wrong && (Steps<C> || (Reads<C> && Writes<C>)) && !WrongConfigure<C> && !WrongRetune<C> &&
           !WrongActivate<C> && !WrongDeactivate<C> && are_parameters<typename C::Params>();
  }
  return false;
}

template <class... C>
consteval bool names_differ() {
  const std::array<std::string_view, sizeof...(C)> names{TypeName<C>::c_str...};
  for (std::size_t i = 0; i < names.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (names[i] == names[k]) return false;
  return true;
}

}  // namespace fulmar::detail

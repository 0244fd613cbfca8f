// SPDX-License-Identifier: BSD-3-Clause
// From a plain struct to the C tables and functions of abi.h. Every thunk catches all exceptions: none
// crosses the interface. plugin.hpp includes this file at its end.
#pragma once
#include <concepts>
#include <exception>
#include <memory>
#include <utility>

#include "fulmar/detail/exception_words.hpp"
#include "fulmar/detail/params.hpp"
#include "fulmar/detail/rules.hpp"

namespace fulmar::detail {

// ---- ports

/// Mapping of a member of Inputs or Outputs to a port. The primary template is a plain message in Outputs.
template <class M>
struct PortOf {
  using Message = M;
  static constexpr std::uint32_t kind = FULMAR_OUT_VALUE, flags = 0, capacity = 1;
  static void write(M& member, fulmar_output& out) { std::memcpy(out.data, &member, sizeof(M)); }
  static void read_last(M& member, const fulmar_input& last) { std::memcpy(&member, last.data, sizeof(M)); }
};
template <class T>
struct PortOf<In<T>> {
  using Message = T;
  static constexpr std::uint32_t kind = FULMAR_IN_VALUE, flags = 0, capacity = 1;
};
template <class T>
struct PortOf<Optional<T>> {
  using Message = T;
  static constexpr std::uint32_t kind = FULMAR_IN_VALUE, flags = FULMAR_PORT_OPTIONAL, capacity = 1;
};
template <class T>
struct PortOf<Queue<T>> {
  using Message = T;
  static constexpr std::uint32_t kind = FULMAR_IN_QUEUE, flags = FULMAR_PORT_OPTIONAL, capacity = 64;
};
template <class T>
struct PortOf<Request<T>> {
  using Message = T;
  static constexpr std::uint32_t kind = FULMAR_IN_REQUEST, flags = FULMAR_PORT_OPTIONAL, capacity = 16;
};
template <class T>
struct PortOf<Out<T>> {
  using Message = T;
  static constexpr std::uint32_t kind = FULMAR_OUT_EVENT, flags = 0, capacity = 1;
  static void write(Out<T>& member, fulmar_output& out) {
    if (!member.written) return;
    std::memcpy(out.data, &member.value, sizeof(T));
    if (member.dated) out.valid_at_ns = member.valid_at_ns;
    out.count = 1;
    member.written = false;
  }
  static void read_last(Out<T>& member, const fulmar_input& last) {
    std::memcpy(&member.value, last.data, sizeof(T));
    member.valid_at_ns = last.valid_at_ns;
    member.written = member.dated = true;
  }
};
template <class T, std::size_t N>
struct PortOf<OutQueue<T, N>> {
  using Message = T;
  static constexpr std::uint32_t kind = FULMAR_OUT_QUEUE, flags = 0, capacity = N;
  static void write(OutQueue<T, N>& member, fulmar_output& out) {
    std::memcpy(out.data, member.items.data(), member.count * sizeof(T));
    std::memcpy(out.stamps_ns, member.stamps_ns.data(), member.count * sizeof(std::int64_t));
    out.count = member.count;
    out.lost = member.lost;
    member.count = member.lost = 0;
  }
  static void read_last(OutQueue<T, N>&, const fulmar_input&) {}
};
template <>
struct PortOf<Probe> {
  static constexpr std::uint32_t kind = FULMAR_OUT_PROBE, flags = 0, capacity = 1;
  static void write(Probe& member, fulmar_output& out) {
    if (!member.written) return;
    std::memcpy(out.data, &member.value, sizeof(double));
    out.count = 1;
    member.written = false;
  }
  static void read_last(Probe& member, const fulmar_input& last) {
    std::memcpy(&member.value, last.data, sizeof(double));
  }
};

template <class T>
consteval const fulmar_type* message_table() {
  if constexpr (requires { typename PortOf<T>::Message; })
    return type_table<typename PortOf<T>::Message>();
  else
    return nullptr;
}

template <class M, bool inputs>
consteval fulmar_port port_of() {
  using Port = PortOf<M>;
  static_assert(!inputs || Port::kind < FULMAR_OUT_VALUE,
                "Inputs holds In<T>, Optional<T>, Queue<T> and Request<T>");
  static_assert(inputs || Port::kind >= FULMAR_OUT_VALUE,
                "Outputs holds messages, Out<T>, OutQueue<T> and Probe");
  return {"", message_table<M>(), Port::kind, Port::flags, Port::capacity};
}

template <class S, bool inputs>
struct Ports {
  static constexpr std::size_t count = port_count<S>();
  using Table = std::array<fulmar_port, count>;
  /// The name of a port is that of its member, also in a group.
  template <class G, std::size_t i, class M>
  static constexpr void add(Table& out, std::size_t& at) {
    if constexpr (is_port_group<M>()) {
      add_all<M>(out, at, MemberTypes<M>{});
    } else {
      out[at] = port_of<M, inputs>();
      out[at++].name = FieldNames<G>::c_str(i);
    }
  }
  template <class G, class... M>
  static constexpr void add_all(Table& out, std::size_t& at, Types<M...>) {
    [&]<std::size_t... i>(std::index_sequence<i...>) { (add<G, i, M>(out, at), ...); }
    (std::make_index_sequence<sizeof...(M)>{});
  }
  static constexpr Table make() {
    Table out{};
    std::size_t at = 0;
    add_all<S>(out, at, MemberTypes<S>{});
    return out;
  }
  static constexpr Table table = make();
  static constexpr bool probes_have_units() {
    for (std::size_t i = 0; i < count; ++i)
      if (table[i].kind == FULMAR_OUT_PROBE && find_unit(table[i].name) < 0) return false;
    return true;
  }
  static constexpr bool ports_differ() {
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t k = 0; k < i; ++k)
        if (std::string_view(table[i].name) == table[k].name) return false;
    return true;
  }
  static_assert(probes_have_units(), "a probe's name ends in its unit: roll_error_rad");
  static_assert(ports_differ(), "two ports have one name: a group's ports are ports beside all others");
};

// ---- thunks

template <class C>
struct Instance {
  static C make(std::uint64_t seed) {
    if constexpr (!std::is_aggregate_v<C> && std::is_constructible_v<C, std::uint64_t>)
      return C(seed);
    else
      return C();
  }
  explicit Instance(std::uint64_t seed) : component(make(seed)) {}

  C component;
  typename C::Inputs in{};
  typename C::Outputs out{};
  Applied<typename C::Outputs> last{};
  typename C::Params params{};
};

template <class F>
std::uint32_t guarded(fulmar_error* error, F&& f) noexcept {
  try {
    return static_cast<std::uint32_t>(f());
  } catch (const std::exception& e) {
    report_exception(error, e);
  } catch (...) {
    report(error, "threw something that is not a std::exception");
  }
  return FULMAR_FAILED;
}

template <class C>
struct Thunks {
  using I = Instance<C>;
  static I& self(void* instance) { return *static_cast<I*>(instance); }
  static Tick tick_of(const fulmar_tick& t) { return {t.now_ns, t.dt_ns, t.index}; }

  static void bind(typename C::Inputs& in, const fulmar_input* inputs) {
    for_each_port(in, [&](auto& member, std::size_t i) { member.input = inputs + i; });
  }
  static void write_out(typename C::Outputs& out, fulmar_output* outputs) {
    for_each_port(out, [&]<class M>(M& member, std::size_t i) { PortOf<M>::write(member, outputs[i]); });
  }
  /// Outputs that a step wrote before an exception are not published by the next step.
  static void forget(typename C::Outputs& out) {
    for_each_port(out, []<class M>(M& member, std::size_t) {
      if constexpr (requires { member.written; }) member.written = false;
      if constexpr (requires { member.stamps_ns; }) member.count = member.lost = 0;
    });
  }
  static void take(typename C::Params& params, const fulmar_value* values) {
    auto one = [&](auto& param) { assign(param, *values++); };
    for_each_param(params, one);
  }

  static void take_last(Applied<typename C::Outputs>& applied, const fulmar_input* last) {
    applied.made_bits = 0;
    for_each_port(applied.outputs, [&]<class M>(M& member, std::size_t k) {
      if (last[k].data) {
        PortOf<M>::read_last(member, last[k]);
        applied.made_bits |= std::uint64_t{1} << k;
      } else if constexpr (!requires { member.stamps_ns; }) {
        member = M{};  // no applied output: not the value of an earlier switch
      }
    });
  }

  static void* create(std::uint64_t seed, fulmar_error* error) {
    void* instance = nullptr;
    guarded(error, [&] {
      instance = new I(seed);
      return Status::ok;
    });
    return instance;
  }
  static void destroy(void* instance) { delete static_cast<I*>(instance); }

  static std::uint32_t configure(void* instance, const fulmar_value* values, fulmar_error* error) {
    return guarded(error, [&] {
      take(self(instance).params, values);
      if constexpr (requires(C c, const typename C::Params& p) { c.configure(p); })
        self(instance).component.configure(self(instance).params);
      return Status::ok;
    });
  }
  static std::uint32_t retune(void* instance, const fulmar_value* values, fulmar_error* error) {
    return guarded(error, [&] {
      take(self(instance).params, values);
      if constexpr (requires(C c, const typename C::Params& p) { c.retune(p); })
        self(instance).component.retune(self(instance).params);
      return Status::ok;
    });
  }
  static std::uint32_t activate(void* instance, const fulmar_tick* tick, const fulmar_input* inputs,
                                const fulmar_input* last, fulmar_error* error) {
    return guarded(error, [&] {
      I& i = self(instance);
      bind(i.in, inputs);
      take_last(i.last, last);
      if constexpr (TakesOutputs<C>)
        return i.component.activate(tick_of(*tick), i.in, i.params, i.last.outputs);
      else
        return i.component.activate(tick_of(*tick), i.in, i.params, i.last);
    });
  }
  static void deactivate(void* instance) {
    guarded(nullptr, [&] {
      self(instance).component.deactivate();
      return Status::ok;
    });
  }
  static std::uint32_t step(void* instance, const fulmar_tick* tick, const fulmar_input* inputs,
                            fulmar_output* outputs, fulmar_error* error) {
    return guarded(error, [&] {
      I& i = self(instance);
      bind(i.in, inputs);
      forget(i.out);
      const Status status = i.component.step(tick_of(*tick), i.in, i.params, i.out);
      write_out(i.out, outputs);
      return status;
    });
  }
  static std::uint32_t read(void* instance, fulmar_tick* tick, fulmar_output* outputs, fulmar_error* error) {
    return guarded(error, [&] {
      I& i = self(instance);
      Tick t = tick_of(*tick);
      forget(i.out);
      const Status status = i.component.read(t, i.params, i.out);
      tick->now_ns = t.now_ns;
      write_out(i.out, outputs);
      return status;
    });
  }
  static const fulmar_last_frame* last_frame(void* instance, const fulmar_input* inputs,
                                             fulmar_error* error) {
    const fulmar_last_frame* frame = nullptr;
    guarded(error, [&] {
      bind(self(instance).in, inputs);
      frame = self(instance).component.last_frame(self(instance).in);
      return Status::ok;
    });
    return frame;
  }
  static const void* get_extension(const char* id) {
    if (std::strcmp(id, FULMAR_LAST_FRAME) != 0) return nullptr;
    if constexpr (requires(C c, const typename C::Inputs& in) { c.last_frame(in); })
      return reinterpret_cast<const void*>(&Thunks::last_frame);
    else
      return nullptr;
  }
  static std::uint32_t write(void* instance, const fulmar_tick* tick, const fulmar_input* inputs,
                             fulmar_error* error) {
    return guarded(error, [&] {
      I& i = self(instance);
      bind(i.in, inputs);
      return i.component.write(tick_of(*tick), i.in, i.params);
    });
  }
};

template <class C>
consteval const char* doc_of() {
  if constexpr (requires { C::doc; })
    return C::doc;
  else
    return "";
}

template <class C>
consteval fulmar_component described() {
  using T = Thunks<C>;
  using In_ = Ports<typename C::Inputs, true>;
  using Out_ = Ports<typename C::Outputs, false>;
  using Params_ = ParamTable<typename C::Params>;
  constexpr bool vehicle = Vehicle<C>;
  fulmar_component e{};
  e.name = TypeName<C>::c_str;
  e.doc = doc_of<C>();
  e.inputs = In_::table.data();
  e.input_count = static_cast<std::uint32_t>(In_::count);
  e.outputs = Out_::table.data();
  e.output_count = static_cast<std::uint32_t>(Out_::count);
  e.params = Params_::table.data();
  e.param_count = static_cast<std::uint32_t>(Params_::count);
  e.port_stride = sizeof(fulmar_port);
  e.param_stride = sizeof(fulmar_param);
  e.flags = vehicle ? FULMAR_VEHICLE : 0;
  e.create = &T::create;
  e.destroy = &T::destroy;
  e.configure = &T::configure;
  e.retune = &T::retune;
  if constexpr (TakesOutputs<C> || TakesApplied<C>) e.activate = &T::activate;
  if constexpr (requires(C c) { c.deactivate(); }) e.deactivate = &T::deactivate;
  if constexpr (vehicle) {
    e.read = &T::read;
    e.write = &T::write;
    e.get_extension = &T::get_extension;
  } else {
    e.step = &T::step;
  }
  return e;
}

template <class C>
consteval fulmar_component component_entry() {
  if constexpr (is_component<C>())
    return described<C>();
  else
    return {};  // nothing else to report
}

template <class... C>
inline constexpr std::array<fulmar_component, sizeof...(C)> component_table{component_entry<C>()...};

#if defined(__clang__)
#define FULMAR_TOOLCHAIN "clang " __clang_version__
#else
#define FULMAR_TOOLCHAIN "gcc " __VERSION__
#endif
#if defined(__SANITIZE_ADDRESS__)
#define FULMAR_FLAGS_SANITIZED "sanitized "
#else
#define FULMAR_FLAGS_SANITIZED ""
#endif
#if defined(NDEBUG)
#define FULMAR_BUILD_FLAGS FULMAR_FLAGS_SANITIZED "NDEBUG"
#else
#define FULMAR_BUILD_FLAGS FULMAR_FLAGS_SANITIZED "assertions"
#endif

template <class... C>
consteval fulmar_plugin plugin_entry(const char* version) {
  static_assert(sizeof...(C) > 0,
                "FULMAR_PLUGIN names its components: FULMAR_PLUGIN(version, Component, ...)");
  static_assert(names_differ<C...>(),
                "two components of a plugin have one name: a mission could not tell them apart");
  return {FULMAR_ABI_MAJOR, FULMAR_ABI_MINOR, sizeof...(C),       sizeof(fulmar_component),
          version,          FULMAR_TOOLCHAIN, FULMAR_BUILD_FLAGS, component_table<C...>.data(),
          nullptr,          nullptr};
}

}  // namespace fulmar::detail

/// The only exported symbol of the plugin: FULMAR_PLUGIN("1.0.0", Component, ...). Once per shared object, at
/// namespace scope.
#define FULMAR_PLUGIN(version, ...)                                                                         \
  extern "C" {                                                                                              \
  __attribute__((visibility("default"))) extern const fulmar_plugin fulmar_plugin_entry;                    \
  constinit const fulmar_plugin fulmar_plugin_entry = ::fulmar::detail::plugin_entry<__VA_ARGS__>(version); \
  }

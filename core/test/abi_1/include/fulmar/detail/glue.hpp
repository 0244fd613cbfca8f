// SPDX-License-Identifier: BSD-3-Clause
// From a plain struct to the C tables and functions of abi.h. Every thunk catches everything: no exception crosses.
#pragma once
#include <concepts>
#include <exception>
#include <memory>
#include <utility>

#include "fulmar/plugin.hpp"

namespace fulmar::detail {

// ---- ports --------------------------------------------------------------------------------------------------------------------

/// How a member of Inputs or Outputs crosses. The primary template is a plain message in Outputs.
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
  static void read_last(Probe& member, const fulmar_input& last) { std::memcpy(&member.value, last.data, sizeof(double)); }
};

template <class T>
consteval const fulmar_type* message_table() {
  if constexpr (requires { typename PortOf<T>::Message; })
    return type_table<typename PortOf<T>::Message>();
  else
    return nullptr;
}

template <class S, bool inputs>
struct Ports {
  static constexpr std::size_t count = member_count<S>();
  template <std::size_t I>
  static consteval fulmar_port one() {
    using Port = PortOf<MemberType<S, I>>;
    static_assert(!inputs || Port::kind < FULMAR_OUT_VALUE, "Inputs holds In<T>, Optional<T>, Queue<T> and Request<T>");
    static_assert(inputs || Port::kind >= FULMAR_OUT_VALUE, "Outputs holds messages, Out<T>, OutQueue<T> and Probe");
    static_assert(Port::kind != FULMAR_OUT_PROBE || find_unit(FieldName<S, I>::view) >= 0,
                  "a probe's name ends in its unit: roll_error_rad");
    return {FieldName<S, I>::c_str, message_table<MemberType<S, I>>(), Port::kind, Port::flags, Port::capacity};
  }
  template <std::size_t... I>
  static consteval std::array<fulmar_port, count> make(std::index_sequence<I...>) {
    return {one<I>()...};
  }
  static constexpr std::array<fulmar_port, count> table = make(std::make_index_sequence<count>{});
};

/// Calls f(member, i) for each member of a struct.
template <class S, class F>
void for_each(S& s, F&& f) {
  auto all = members(s);
  [&]<std::size_t... I>(std::index_sequence<I...>) { (f(*std::get<I>(all).p, I), ...); }
  (std::make_index_sequence<std::tuple_size_v<decltype(all)>>{});
}

// ---- parameters ---------------------------------------------------------------------------------------------------------------

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
  e.doc = p.doc, e.kind = FULMAR_FLAG, e.flags = access_flags(p.access), e.initial[0] = p.value ? 1 : 0, e.max = 1;
  return e;
}
constexpr fulmar_param param_entry(const Count& p) {
  fulmar_param e = blank_param();
  e.doc = p.doc, e.kind = FULMAR_COUNT, e.flags = access_flags(p.access), e.initial[0] = static_cast<double>(p.value);
  e.min = static_cast<double>(p.min), e.max = static_cast<double>(p.max);
  return e;
}
template <class E>
constexpr fulmar_param param_entry(const Choice<E>& p) {
  fulmar_param e = blank_param();
  e.doc = p.doc, e.kind = FULMAR_CHOICE, e.flags = access_flags(p.access), e.initial[0] = static_cast<double>(p.value);
  e.choices = Labels<E>::names.data(), e.choice_count = Labels<E>::count, e.max = static_cast<double>(Labels<E>::count - 1);
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
  e.unit = p.unit, e.doc = p.doc, e.kind = FULMAR_VECTOR, e.flags = access_flags(p.access), e.type = type_table<Vec3<F>>();
  const auto& [a, b, c] = p.value;
  e.initial[0] = a, e.initial[1] = b, e.initial[2] = c, e.min = p.min, e.max = p.max;
  return e;
}
template <class T>
constexpr fulmar_param param_entry(const Record<T>& p) {
  fulmar_param e = blank_param();
  e.doc = p.doc, e.kind = FULMAR_RECORD, e.flags = need_flags(p.need), e.type = type_table<T>(), e.initial_data = &p.value;
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
  if (v.data && v.size == sizeof(T)) std::memcpy(&p.value, v.data, sizeof(T));  // retune leaves records as they are
  if (v.data) p.is_given = v.integer != 0;
}
inline void assign(Blob& p, const fulmar_value& v) {
  if (!v.data) return;
  p.data = static_cast<const std::byte*>(v.data);
  p.size = v.size;
  p.name = v.text ? v.text : "";
}

template <class S>
struct ParamTable {
  static constexpr std::size_t count = member_count<S>();
  static constexpr S initial{};
  template <std::size_t I>
  static consteval fulmar_param one() {
    fulmar_param e = param_entry(*std::get<I>(members(initial)).p);
    e.name = FieldName<S, I>::c_str;
    return e;
  }
  template <std::size_t... I>
  static consteval std::array<fulmar_param, count> make(std::index_sequence<I...>) {
    return {one<I>()...};
  }
  static constexpr std::array<fulmar_param, count> table = make(std::make_index_sequence<count>{});
};

// ---- thunks -------------------------------------------------------------------------------------------------------------------

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
  typename C::Outputs last{};
  typename C::Params params{};
};

inline void report(fulmar_error* error, const char* text) noexcept {
  if (!error) return;
  const std::size_t n = std::min(std::strlen(text), sizeof error->text - 1);
  std::memcpy(error->text, text, n);
  error->text[n] = '\0';
}

template <class F>
std::uint32_t guarded(fulmar_error* error, F&& f) noexcept {
  try {
    return static_cast<std::uint32_t>(f());
  } catch (const std::exception& e) {
    report(error, e.what());
  } catch (...) {
    report(error, "threw something that is not a std::exception");
  }
  return FULMAR_FAILED;
}

template <class C>
concept Vehicle = requires(C c, Tick& tick, const typename C::Params& p, typename C::Outputs& out) {
  c.read(tick, p, out);
};

template <class C>
struct Thunks {
  using I = Instance<C>;
  static I& self(void* instance) { return *static_cast<I*>(instance); }
  static Tick tick_of(const fulmar_tick& t) { return {t.now_ns, t.dt_ns, t.index}; }

  static void bind(typename C::Inputs& in, const fulmar_input* inputs) {
    for_each(in, [&](auto& member, std::size_t i) { member.input = inputs + i; });
  }
  static void write_out(typename C::Outputs& out, fulmar_output* outputs) {
    for_each(out, [&]<class M>(M& member, std::size_t i) { PortOf<M>::write(member, outputs[i]); });
  }
  /// What a step wrote before it threw is not published by the next one.
  static void forget(typename C::Outputs& out) {
    for_each(out, []<class M>(M& member, std::size_t) {
      if constexpr (requires { member.written; }) member.written = false;
      if constexpr (requires { member.stamps_ns; }) member.count = member.lost = 0;
    });
  }
  static void take(typename C::Params& params, const fulmar_value* values) {
    for_each(params, [&](auto& member, std::size_t i) { assign(member, values[i]); });
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
      if constexpr (requires(C c, const typename C::Params& p) { c.retune(p); }) self(instance).component.retune(self(instance).params);
      return Status::ok;
    });
  }
  static std::uint32_t activate(void* instance, const fulmar_tick* tick, const fulmar_input* inputs, const fulmar_input* last,
                                fulmar_error* error) {
    return guarded(error, [&] {
      I& i = self(instance);
      bind(i.in, inputs);
      for_each(i.last, [&]<class M>(M& member, std::size_t k) {
        if (last[k].data)
          PortOf<M>::read_last(member, last[k]);
        else if constexpr (!requires { member.stamps_ns; })
          member = M{};  // nobody's: not what was handed over once before
      });
      return i.component.activate(tick_of(*tick), i.in, i.params, i.last);
    });
  }
  static void deactivate(void* instance) {
    guarded(nullptr, [&] {
      self(instance).component.deactivate();
      return Status::ok;
    });
  }
  static std::uint32_t step(void* instance, const fulmar_tick* tick, const fulmar_input* inputs, fulmar_output* outputs,
                            fulmar_error* error) {
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
  static const fulmar_last_frame* last_frame(void* instance, const fulmar_input* inputs, fulmar_error* error) {
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
  static std::uint32_t write(void* instance, const fulmar_tick* tick, const fulmar_input* inputs, fulmar_error* error) {
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
consteval fulmar_component component_entry() {
  using T = Thunks<C>;
  using In_ = Ports<typename C::Inputs, true>;
  using Out_ = Ports<typename C::Outputs, false>;
  using Params_ = ParamTable<typename C::Params>;
  constexpr bool vehicle = Vehicle<C>;
  fulmar_component e{};
  e.name = TypeName<C>::c_str;
  e.doc = doc_of<C>();
  e.inputs = In_::table.data(), e.input_count = static_cast<std::uint32_t>(In_::count);
  e.outputs = Out_::table.data(), e.output_count = static_cast<std::uint32_t>(Out_::count);
  e.params = Params_::table.data(), e.param_count = static_cast<std::uint32_t>(Params_::count);
  e.port_stride = sizeof(fulmar_port), e.param_stride = sizeof(fulmar_param);
  e.flags = vehicle ? FULMAR_VEHICLE : 0;
  e.create = &T::create, e.destroy = &T::destroy, e.configure = &T::configure, e.retune = &T::retune;
  if constexpr (requires(C c, const Tick& t, const typename C::Inputs& in, const typename C::Params& p, const typename C::Outputs& last) {
                  { c.activate(t, in, p, last) } -> std::same_as<Status>;
                })
    e.activate = &T::activate;
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
  return {FULMAR_ABI_MAJOR, FULMAR_ABI_MINOR, sizeof...(C),       sizeof(fulmar_component),
          version,          FULMAR_TOOLCHAIN, FULMAR_BUILD_FLAGS, component_table<C...>.data(),
          nullptr,          nullptr};
}

}  // namespace fulmar::detail

/// The plugin's one exported symbol: FULMAR_PLUGIN("1.0.0", Component, ...). Once per shared object, at namespace scope.
#define FULMAR_PLUGIN(version, ...)                                                                         \
  extern "C" {                                                                                              \
  __attribute__((visibility("default"))) extern const fulmar_plugin fulmar_plugin_entry;                    \
  constinit const fulmar_plugin fulmar_plugin_entry = ::fulmar::detail::plugin_entry<__VA_ARGS__>(version); \
  }

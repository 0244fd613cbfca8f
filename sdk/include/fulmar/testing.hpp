// SPDX-License-Identifier: BSD-3-Clause
// Drives one component without a host, through the C functions of the binary contract, and counts
// allocations.
//
//   Bench<AttitudeHold> bench;
//   bench.params.roll_kp.value = 0.55;
//   bench.set(bench.in.state, state);             // a sample for an input, valid now
//   CHECK(bench.step(0.01) == Status::ok);        // advances time by 10 ms, then steps
//   CHECK(bench.out.actuators.aileron_rad == doctest::Approx(...));
//
// `bench.out` holds the outputs of the step. `bench.validation_error()` names an output that is not finite or
// out of range. An Out<T> has `written` set if it was published; an OutQueue has its `count`. To count
// allocations, one source file of the test program defines FULMAR_COUNT_ALLOCATIONS before it includes this
// header; without it the program does not link. `allocations([&] { bench.step(0.01); })` is then the number
// of calls of operator new, malloc and its relatives; with a sanitizer of operator new alone.
#ifndef FULMAR_TESTING_HPP
#define FULMAR_TESTING_HPP
#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <new>
#include <string>
#include <type_traits>
#include <vector>

#include "fulmar/plugin.hpp"

namespace fulmar {

inline thread_local std::uint64_t allocation_count = 0;
void one_source_file_defines_FULMAR_COUNT_ALLOCATIONS() noexcept;

/// Number of allocations by `work` in this thread.
template <class F>
std::uint64_t allocations(F&& work) {
  one_source_file_defines_FULMAR_COUNT_ALLOCATIONS();  // link error: a test without counting would always
                                                       // pass
  const std::uint64_t before = allocation_count;
  asm volatile("" ::: "memory");  // without it clang assumes that operator new has no visible effect
  work();
  asm volatile("" ::: "memory");
  return allocation_count - before;
}

namespace detail {

inline std::string number_words(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", x);
  return text;
}

inline std::string fault_in(const fulmar_type& type, const void* message, const std::string& name);

/// Fault in the items of one field; "" without a fault.
inline std::string fault_in(const fulmar_field& field, const std::byte* at, const std::string& name) {
  std::uint32_t count = field.count;
  if (field.shape == FULMAR_LIST) std::memcpy(&count, at, sizeof count);
  for (std::uint32_t i = 0; i < std::min(count, field.count); ++i) {
    const std::byte* item = at + field.items + i * field.stride;
    const std::string place = field.shape == FULMAR_SCALAR ? name : name + "[" + std::to_string(i) + "]";
    if (field.kind == FULMAR_STRUCT) {
      if (std::string words = fault_in(*field.type, item, place); !words.empty()) return words;
    } else if (field.kind == FULMAR_F64 || field.kind == FULMAR_F32) {
      double x = 0;
      float f = 0;
      if (field.kind == FULMAR_F64) std::memcpy(&x, item, sizeof x);
      if (field.kind == FULMAR_F32) {
        std::memcpy(&f, item, sizeof f);
        x = static_cast<double>(f);
      }
      if (!std::isfinite(x)) return place + " is " + number_words(x);
      if (x < field.min || x > field.max)
        return place + " is " + number_words(x) + ", beyond [" + number_words(field.min) + ", " +
               number_words(field.max) + "]";
    }
  }
  return "";
}
inline std::string fault_in(const fulmar_type& type, const void* message, const std::string& name) {
  for (std::uint32_t i = 0; i < type.field_count; ++i) {
    const fulmar_field& field = type.fields[i];
    std::string words =
        fault_in(field, static_cast<const std::byte*>(message) + field.offset, name + "." + field.name);
    if (!words.empty()) return words;
  }
  return "";
}

}  // namespace detail

template <class C>
class Bench {
 public:
  explicit Bench(std::uint64_t seed = 1) : component_(detail::component_entry<C>()) {
    instance_ = component_.create(seed, &error_);
    if (!instance_) throw std::runtime_error(error_.text);
    inputs_.resize(detail::port_count<typename C::Inputs>() + 1);
    std::vector<std::size_t> sizes;
    detail::for_each_port(in, [&](auto& member, std::size_t i) {
      using Port = detail::PortOf<std::remove_cvref_t<decltype(member)>>;
      member.input = &inputs_[i];
      rooms_.push_back(Room{});
      rooms_.back().answers.resize(Port::capacity);
    });
  }
  ~Bench() { component_.destroy(instance_); }
  Bench(const Bench&) = delete;
  Bench& operator=(const Bench&) = delete;

  typename C::Inputs in{};
  typename C::Outputs out{};
  typename C::Params params{};
  Tick tick{};

  C& component() { return self().component; }
  std::string error() const { return error_.text; }  ///< message of the last failed call

  /// Sets the latest sample of a value input, valid `age_s` before the time of the previous step. `-dt` is
  /// valid at the next step.
  template <template <class> class P, class T>
  requires(detail::PortOf<P<T>>::kind == FULMAR_IN_VALUE) void set(const P<T>& port, const T& value,
                                                                   double age_s = 0) {
    fulmar_input& input = at(port.input);
    Room& room = rooms_[index(port.input)];
    room.bytes.resize(sizeof(T));
    std::memcpy(room.bytes.data(), &value, sizeof(T));
    input.data = room.bytes.data();
    input.age_ns = static_cast<std::int64_t>(age_s * 1e9);
    input.valid_at_ns = tick.now_ns - input.age_ns;
    input.sequence++;
    input.count = 1;
    input.flags |= FULMAR_FRESH;
  }
  /// Adds a sample of a queue or request, valid `age_s` ago; it is removed after the next step.
  template <template <class> class P, class T>
  requires(detail::PortOf<P<T>>::kind == FULMAR_IN_QUEUE ||
           detail::PortOf<P<T>>::kind == FULMAR_IN_REQUEST) void push(const P<T>& port,
                                                                      const std::type_identity_t<T>& value,
                                                                      double age_s = 0) {
    fulmar_input& input = at(port.input);
    Room& room = rooms_[index(port.input)];
    room.bytes.resize((input.count + 1) * sizeof(T));
    std::memcpy(room.bytes.data() + input.count * sizeof(T), &value, sizeof(T));
    room.stamps.resize(input.count + 1);
    room.stamps[input.count] = tick.now_ns - static_cast<std::int64_t>(age_s * 1e9);
    if (room.answers.size() <= input.count) room.answers.resize(input.count + 1);
    room.answers[input.count] = {};
    input.data = room.bytes.data();
    input.stamps_ns = room.stamps.data();
    input.answers = room.answers.data();
    input.count++;
  }
  /// Answer to request `i` of the last step: "accepted", "unanswered", or the reason of the rejection.
  template <class T>
  std::string answer(const Request<T>& port, std::size_t i = 0) const {
    const fulmar_answer& answer = rooms_[static_cast<std::size_t>(port.input - inputs_.data())].answers[i];
    if (answer.verdict == FULMAR_ACCEPTED) return "accepted";
    return answer.verdict == FULMAR_REFUSED ? answer.reason : "unanswered";
  }

  /// First invalid output of the last step: "attitude.roll_rad is nan", "actuators.throttle_frac is 1.2,
  /// beyond [0, 1]"; "" if all outputs are finite and in range.
  std::string validation_error() const {
    std::string words;
    detail::for_each_port(out, [&]<class M>(const M& member, std::size_t i) {
      const std::string name(output_name(i));
      const auto look = [&](const auto& message) {
        if (words.empty())
          words = detail::fault_in(describe<std::remove_cvref_t<decltype(message)>>(), &message, name);
      };
      if constexpr (std::is_same_v<M, Probe>) {
        if (member.written && !std::isfinite(member.value))
          words = name + " is " + detail::number_words(member.value);
      } else if constexpr (requires { member.stamps_ns; }) {
        for (std::uint32_t k = 0; k < member.count; ++k) look(member.items[k]);
      } else if constexpr (requires { member.written; }) {
        if (member.written) look(member.value);
      } else {
        look(member);
      }
    });
    return words;
  }

  /// Passes `params` to the component. The first step calls it if the test did not. Call it again after a
  /// change of `params` with `live` false.
  Status configure() {
    configured_ = true;
    self().params = params;
    return call([&] {
      if constexpr (requires(C c, const typename C::Params& p) { c.configure(p); })
        self().component.configure(self().params);
      return Status::ok;
    });
  }
  /// A live change of parameters.
  Status retune() {
    self().params = params;
    return call([&] {
      if constexpr (requires(C c, const typename C::Params& p) { c.retune(p); })
        self().component.retune(self().params);
      return Status::ok;
    });
  }
  /// Without a previous component: at the start of the flight, or after the pilot.
  Status activate() { return activate(Applied<typename C::Outputs>{}); }
  /// After a previous component that applied all these outputs.
  Status activate(const typename C::Outputs& applied) {
    return activate(Applied<typename C::Outputs>::all(applied));
  }
  /// With the outputs that were applied. A template, so that `activate({})` means an Outputs.
  template <std::same_as<Applied<typename C::Outputs>> A>
  Status activate(const A& last) {
    if (!configured_) configure();
    return call([&] {
      if constexpr (detail::TakesOutputs<C>)
        return self().component.activate(tick, in, self().params, last.outputs);
      else
        return self().component.activate(tick, in, self().params, last);
    });
  }

  /// Advances time by dt and steps once.
  Status step(double dt_s) {
    if (!configured_ && configure() == Status::failed) return Status::failed;
    advance(dt_s);
    const Status status = call([&] { return self().component.step(tick, in, self().params, self().out); });
    finish();
    return status;
  }
  /// For vehicles: `read` sets the time.
  Status read() {
    if (!configured_ && configure() == Status::failed) return Status::failed;
    const std::int64_t before = tick.now_ns;
    const Status status = call([&] { return self().component.read(tick, self().params, self().out); });
    tick.dt_ns = tick.now_ns - before;
    tick.index++;
    finish();
    return status;
  }
  Status write() {
    const Status status = call([&] { return self().component.write(tick, in, self().params); });
    drop_queues();
    return status;
  }

 private:
  struct Room {
    std::vector<std::byte> bytes;
    std::vector<std::int64_t> stamps;
    std::vector<fulmar_answer> answers;
  };
  detail::Instance<C>& self() { return *static_cast<detail::Instance<C>*>(instance_); }
  std::size_t index(const fulmar_input* input) const {
    return static_cast<std::size_t>(input - inputs_.data());
  }
  fulmar_input& at(const fulmar_input* input) { return inputs_[index(input)]; }

  void advance(double dt_s) {
    tick.dt_ns = static_cast<std::int64_t>(dt_s * 1e9 + 0.5);
    tick.now_ns += tick.dt_ns;
    tick.index++;
    for (fulmar_input& input : inputs_)
      if (input.sequence > 0) input.age_ns = tick.now_ns - input.valid_at_ns;
  }
  template <class F>
  Status call(F&& f) {
    error_.text[0] = '\0';
    return static_cast<Status>(detail::guarded(&error_, f));
  }
  /// Not inlined: g++ 12 otherwise reports a missing end of the name.
  [[gnu::noinline]] static const char* output_name(std::size_t i) {
    return detail::Ports<typename C::Outputs, false>::table[i].name;
  }
  void finish() {
    out = self().out;
    detail::for_each_port(self().out, []<class M>(M& member, std::size_t) {
      if constexpr (requires { member.written; }) member.written = false;
      if constexpr (requires { member.stamps_ns; }) member.count = member.lost = 0;
    });
    for (fulmar_input& input : inputs_) input.flags &= ~static_cast<std::uint32_t>(FULMAR_FRESH);
    if constexpr (!detail::Vehicle<C>) drop_queues();
  }
  void drop_queues() {
    for (fulmar_input& input : inputs_)
      if (input.sequence == 0) input.count = 0;
  }

  fulmar_component component_;
  void* instance_ = nullptr;
  bool configured_ = false;
  fulmar_error error_{};
  std::vector<fulmar_input> inputs_;
  std::vector<Room> rooms_;
};

}  // namespace fulmar

#endif  // FULMAR_TESTING_HPP

// Outside the include guard: in a unity build, another file may include this header first.
#if defined(FULMAR_COUNT_ALLOCATIONS) && !defined(FULMAR_COUNTS_ALLOCATIONS)
#define FULMAR_COUNTS_ALLOCATIONS
void fulmar::one_source_file_defines_FULMAR_COUNT_ALLOCATIONS() noexcept {}
// Replaces the global allocation functions of this program: those of glibc, or, under a sanitizer that
// replaces them, the operators.
#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
#define FULMAR_HEAP_OF_A_SANITIZER
#endif
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define FULMAR_HEAP_OF_A_SANITIZER
#endif
#if defined(__GLIBC__) && !defined(FULMAR_HEAP_OF_A_SANITIZER)
#if defined(__clang__) && __has_include(<mm_malloc.h>)
#include <mm_malloc.h>  // declares posix_memalign, which clang requires before its definition
#endif
extern "C" {
void* __libc_malloc(std::size_t);                 // NOLINT(bugprone-reserved-identifier): glibc's names
void* __libc_calloc(std::size_t, std::size_t);    // NOLINT(bugprone-reserved-identifier)
void* __libc_realloc(void*, std::size_t);         // NOLINT(bugprone-reserved-identifier)
void* __libc_memalign(std::size_t, std::size_t);  // NOLINT(bugprone-reserved-identifier)
void* malloc(std::size_t size) noexcept {
  ++fulmar::allocation_count;
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) noexcept {
  ++fulmar::allocation_count;
  return __libc_calloc(count, size);
}
void* realloc(void* p, std::size_t size) noexcept {
  ++fulmar::allocation_count;
  return __libc_realloc(p, size);
}
void* memalign(std::size_t align, std::size_t size) noexcept {
  ++fulmar::allocation_count;
  return __libc_memalign(align, size);
}
void* aligned_alloc(std::size_t align, std::size_t size) noexcept {
  ++fulmar::allocation_count;
  return __libc_memalign(align, size);
}
int posix_memalign(void** out, std::size_t align, std::size_t size) noexcept {
  ++fulmar::allocation_count;
  void* const p = __libc_memalign(align, size);
  if (!p) return ENOMEM;
  *out = p;
  return 0;
}
}
#else
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++fulmar::allocation_count;
  if (void* p = std::malloc(size ? size : 1)) return p;
  throw std::bad_alloc();
}
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t align) {
  ++fulmar::allocation_count;
  const std::size_t a = static_cast<std::size_t>(align);
  if (void* p = std::aligned_alloc(a, (size + a - 1) / a * a)) return p;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* p) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p, std::size_t) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p, std::align_val_t) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p, std::size_t, std::align_val_t) noexcept { std::free(p); }
#endif
#endif

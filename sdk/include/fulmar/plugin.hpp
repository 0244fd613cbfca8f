// SPDX-License-Identifier: BSD-3-Clause
// What a plugin author includes: ports, parameters, tick, status, and FULMAR_PLUGIN, which makes the entry of
// the binary contract.
//
//   struct AttitudeHold {
//     struct Inputs  { In<VehicleState> state;  In<AttitudeCommand> attitude; };
//     struct Outputs { Actuators actuators;  Probe roll_error_rad; };
//     struct Params  { Param roll_kp{0.55, "rad/rad", 0, 2, "aileron per roll error"}; };
//     Status step(const Tick&, const Inputs&, const Params&, Outputs&);
//   };
//   FULMAR_PLUGIN("1.0.0", AttitudeHold)
//
// Ports may be grouped, as parameters may: a struct of ports inside Inputs or Outputs, shared by several
// components (flight/estimator.hpp). Their names are those of the members, in a group as well.
//
// Optional members: a constructor from a 64-bit seed, `configure`, `retune`, `deactivate`,
// `static constexpr const char* doc`, and
//   Status activate(const Tick&, const Inputs&, const Params&, const Applied<Outputs>& last);
// where `last` may be a `const Outputs&` too. A vehicle has `read(Tick&, const Params&, Outputs&)` and
// `write(const Tick&, const Inputs&, const Params&)` in place of `step`, and may have
// `const fulmar_last_frame* last_frame(const Inputs& failsafe)`: what its device gets when the host dies
// (abi.h).
#pragma once
#include <cstdint>
#include <cstring>
#include <string_view>

#include "fulmar/detail/port_groups.hpp"
#include "fulmar/schema.hpp"

namespace fulmar {

/// One pass of the loop, as a component sees it. Time is flight time, 0 at the first armed tick.
struct Tick {
  std::int64_t now_ns = 0;
  std::int64_t dt_ns = 0;  ///< since this component's previous step; its nominal period in the first one
  std::uint64_t index = 0;
  double now_s() const { return 1e-9 * static_cast<double>(now_ns); }
  double dt_s() const { return 1e-9 * static_cast<double>(dt_ns); }
};

enum class Status : std::uint32_t { ok = FULMAR_OK, degraded = FULMAR_DEGRADED, failed = FULMAR_FAILED };

// ---- inputs: views of what the host holds; valid during the call

/// The latest sample of a wire. There is one whenever `step` is called.
template <class T>
struct In {
  const fulmar_input* input = nullptr;  ///< set by the glue

  const T& operator*() const { return *static_cast<const T*>(input->data); }
  const T* operator->() const { return static_cast<const T*>(input->data); }
  bool fresh() const {
    return input && (input->flags & FULMAR_FRESH) != 0;
  }  ///< not seen by the previous step
  bool stale() const {
    return input && (input->flags & FULMAR_STALE) != 0;
  }  ///< older than the wire's max_age
  std::int64_t valid_at_ns() const { return input->valid_at_ns; }
  double valid_at_s() const { return 1e-9 * static_cast<double>(input->valid_at_ns); }
  double age_s() const { return 1e-9 * static_cast<double>(input->age_ns); }
  std::uint64_t sequence() const { return input ? input->sequence : 0; }  ///< counts samples from 1
};

/// As In, but the component also steps without it: `if (in.gnss && in.gnss.fresh()) ...`.
template <class T>
struct Optional : In<T> {
  explicit operator bool() const { return this->input && this->input->data; }
};

template <class T>
struct Sample {
  const T& value;
  std::int64_t valid_at_ns;  ///< flight time at which it was true, as its writer says
  double valid_at_s() const { return 1e-9 * static_cast<double>(valid_at_ns); }
};

/// Every sample since the last step, oldest first: `for (const auto& sample : in.edits)`.
template <class T>
struct Queue {
  const fulmar_input* input = nullptr;

  struct Iterator {
    const fulmar_input* input;
    std::uint32_t i;
    Sample<T> operator*() const { return {static_cast<const T*>(input->data)[i], input->stamps_ns[i]}; }
    Iterator& operator++() {
      ++i;
      return *this;
    }
    bool operator!=(const Iterator& other) const { return i != other.i; }
  };
  Iterator begin() const { return {input, 0}; }
  Iterator end() const { return {input, size()}; }
  std::uint32_t size() const { return input ? input->count : 0; }
  bool empty() const { return size() == 0; }
  std::uint32_t lost() const {
    return input ? input->lost : 0;
  }  ///< samples that found no room since the last step
};

/// Questions, each to be answered in the step that sees it: `for (auto request : in.edit)`. What is not
/// answered counts as refused. Who asks from outside hears the answer; a component that feeds a request hears
/// none: what it has to know, a port of the answering component says, as `plan.results` does.
template <class T>
struct Request {
  const fulmar_input* input = nullptr;

  struct One {
    const T& asked;
    fulmar_answer& answer;
    const T& value() const { return asked; }
    void accept() const { answer.verdict = FULMAR_ACCEPTED; }
    /// The reason is told in some 120 bytes; a longer one ends in dots.
    void refuse(std::string_view reason) const {
      answer.verdict = FULMAR_REFUSED;
      fit_words(reason, answer.reason, sizeof answer.reason);
    }
  };
  struct Iterator {
    const fulmar_input* input;
    std::uint32_t i;
    One operator*() const { return {static_cast<const T*>(input->data)[i], input->answers[i]}; }
    Iterator& operator++() {
      ++i;
      return *this;
    }
    bool operator!=(const Iterator& other) const { return i != other.i; }
  };
  Iterator begin() const { return {input, 0}; }
  Iterator end() const { return {input, size()}; }
  std::uint32_t size() const { return input ? input->count : 0; }
  bool empty() const { return size() == 0; }
};

// ---- outputs. A plain message is published in every step.

/// A message that may stay silent.
template <class T>
struct Out {
  T value{};
  std::int64_t valid_at_ns = 0;
  bool written = false, dated = false;

  void publish(const T& message) {
    value = message;
    written = true;
    dated = false;
  }
  void publish(const T& message, std::int64_t valid_at) {
    publish(message);
    valid_at_ns = valid_at;
    dated = true;
  }
};

/// Time of validity of a sample of a driver: the time at which the loop takes it over. A driver has no flight
/// time of its own.
inline constexpr std::int64_t on_arrival = FULMAR_ON_ARRIVAL;

/// None, one or several messages per step; at most N.
template <class T, std::size_t N = 16>
struct OutQueue {
  std::array<T, N> items{};
  std::array<std::int64_t, N> stamps_ns{};
  std::uint32_t count = 0, lost = 0;

  /// False when there is no room; the loss is counted and told to the reader.
  bool push(const T& message, std::int64_t valid_at_ns) {
    if (count == N) {
      ++lost;
      return false;
    }
    items[count] = message;
    stamps_ns[count++] = valid_at_ns;
    return true;
  }
};

/// One number to look at: logged and plottable, without a message. Its name ends in its unit.
struct Probe {
  double value = 0;
  bool written = false;
  Probe& operator=(double number) {
    value = number;
    written = true;
    return *this;
  }
};

/// What was last applied in the component's role, whoever made it: `activate` goes on from there.
///   if (last.has(last->attitude)) throttle_ = last->attitude.throttle_frac;
template <class Outputs>
struct Applied {
  Outputs outputs{};            ///< what nobody made is zeros, which may be a command too
  std::uint64_t made_bits = 0;  ///< one per output, in their order: the host has one to go on from

  const Outputs* operator->() const { return &outputs; }
  operator const Outputs&() const { return outputs; }  // NOLINT(google-explicit-constructor)

  /// Somebody flew: at least one output was applied. Not so when the flight begins and while the pilot flies.
  bool given() const { return made_bits != 0; }
  /// This output was applied: `last.has(last->attitude)`. A predecessor need not have all of its successor's.
  template <class M>
  bool has(const M& output) const {
    static_assert(detail::has_port<Outputs, M>(),
                  "has() asks for one of the outputs: last.has(last->attitude)");
    bool made = false;
    detail::for_each_port(outputs, [&]<class Member>(const Member& member, std::size_t i) {
      if constexpr (std::is_same_v<Member, M>)
        made = made || (&member == &output && (made_bits >> i & 1) != 0);
    });
    return made;
  }
  /// What was applied of a group of outputs: `estimator_.activate(tick, in.nav, p.nav,
  /// last.part(last->nav))`.
  template <class G>
  Applied<G> part(const G& group) const {
    static_assert(detail::is_port_group<G>(), "part() asks for a group of the outputs: last.part(last->nav)");
    Applied<G> out{group, 0};
    const auto place = [](const auto& thing) { return reinterpret_cast<std::uintptr_t>(&thing); };
    std::size_t k = 0;
    detail::for_each_port(outputs, [&](const auto& member, std::size_t i) {
      if (place(member) < place(group) || place(member) >= place(group) + sizeof group) return;
      out.made_bits |= (made_bits >> i & 1) << k++;
    });
    return out;
  }
  /// All of these were applied.
  static Applied all(const Outputs& applied) {
    constexpr std::size_t n = detail::port_count<Outputs>();
    return {applied, n < 64 ? (std::uint64_t{1} << n % 64) - 1 : ~std::uint64_t{0}};
  }
};

// ---- parameters

enum class Access : std::uint8_t { live, setup };
inline constexpr Access live = Access::live;    ///< may change between ticks
inline constexpr Access setup = Access::setup;  ///< fixed when the flight begins

struct Param {
  double value = 0;
  const char* unit = "";
  double min = -std::numeric_limits<double>::infinity(), max = std::numeric_limits<double>::infinity();
  const char* doc = "";
  Access access = live;
  constexpr operator double() const { return value; }  // NOLINT(google-explicit-constructor)
};

struct Flag {
  bool value = false;
  const char* doc = "";
  Access access = live;
  constexpr operator bool() const { return value; }  // NOLINT(google-explicit-constructor)
};

struct Count {
  std::int64_t value = 0;
  std::int64_t min = 0, max = std::numeric_limits<std::int32_t>::max();
  const char* doc = "";
  Access access = live;
  constexpr operator std::int64_t() const { return value; }  // NOLINT(google-explicit-constructor)
};

/// One of the names of an enum.
template <class E>
struct Choice {
  E value{};
  const char* doc = "";
  Access access = live;
  constexpr operator E() const { return value; }  // NOLINT(google-explicit-constructor)
};

template <std::size_t N>
struct TextParam {
  Text<N> value{};
  const char* doc = "";
  std::string_view view() const { return value.view(); }
};

template <class Frame>
struct Vector {
  Vec3<Frame> value{};
  const char* unit = "";
  double min = -std::numeric_limits<double>::infinity(),
         max = std::numeric_limits<double>::infinity();  ///< of each element
  const char* doc = "";
  Access access = live;
};

/// A matrix of numbers: R times C parameters, "K_0_0", "K_0_1", ..., counted from 0, row by row.
///   Matrix<2, 3> K{{{1, 0, 0}, {0, 1, 0}}, "rad/rad", -10, 10, "state feedback gain"};  // p.K(1, 2)
template <std::size_t R, std::size_t C>
struct Matrix {
  double value[R][C]{};
  const char* unit = "";
  double min = -std::numeric_limits<double>::infinity(),
         max = std::numeric_limits<double>::infinity();  ///< of each element
  const char* doc = "";
  Access access = live;
  constexpr double operator()(std::size_t row, std::size_t column) const { return value[row][column]; }
};

enum class Need : std::uint8_t { optional, required };
inline constexpr Need required = Need::required;

/// A YAML file that the host has read into a described struct.
template <class T>
struct Record {
  const char* doc = "";
  Need need = Need::optional;
  T value{};
  bool is_given = false;
  bool given() const { return is_given; }  ///< the mission names one
  const T& operator*() const { return value; }
  const T* operator->() const { return &value; }
};

/// The bytes of a file. They belong to the host and stay until the next `configure`.
struct Blob {
  const char* doc = "";
  Need need = Need::optional;
  const std::byte* data = nullptr;
  std::size_t size = 0;
  const char* name = "";
};

}  // namespace fulmar

#include "fulmar/detail/glue.hpp"

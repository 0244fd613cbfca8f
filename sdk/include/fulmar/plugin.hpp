// SPDX-License-Identifier: BSD-3-Clause
// The header for plugin authors: ports, parameters, tick, status, and FULMAR_PLUGIN, which generates the
// entry of the binary contract.
//
//   struct AttitudeHold {
//     struct Inputs  { In<VehicleState> state;  In<AttitudeCommand> attitude; };
//     struct Outputs { Actuators actuators;  Probe roll_error_rad; };
//     struct Params  { Param roll_kp{0.55, "rad/rad", 0, 2, "aileron per roll error"}; };
//     Status step(const Tick&, const Inputs&, const Params&, Outputs&);
//   };
//   FULMAR_PLUGIN("1.0.0", AttitudeHold)
//
// A struct of ports inside Inputs or Outputs is a group of ports, for several components
// (flight/estimator.hpp). A group of parameters works alike. The name of a port is that of its member, also
// in a group.
//
// Optional members: a constructor from a 64-bit seed, `configure`, `retune`, `deactivate`,
// `static constexpr const char* doc`, and
//   Status activate(const Tick&, const Inputs&, const Params&, const Applied<Outputs>& last);
// `last` may also be a `const Outputs&`. A vehicle has `read(Tick&, const Params&, Outputs&)` and
// `write(const Tick&, const Inputs&, const Params&)` in place of `step`. It may have `const
// fulmar_last_frame* last_frame(const Inputs& failsafe)`: the data for its device when the host crashes
// (abi.h).
#pragma once
#include <cstdint>
#include <cstring>
#include <string_view>

#include "fulmar/detail/port_groups.hpp"
#include "fulmar/schema.hpp"

namespace fulmar {

/// One pass of the loop. Time is flight time, 0 at the first armed tick.
struct Tick {
  std::int64_t now_ns = 0;
  std::int64_t dt_ns =
      0;  ///< since the previous step of this component; in its first step the nominal period
  std::uint64_t index = 0;
  double now_s() const { return 1e-9 * static_cast<double>(now_ns); }
  double dt_s() const { return 1e-9 * static_cast<double>(dt_ns); }
};

enum class Status : std::uint32_t { ok = FULMAR_OK, degraded = FULMAR_DEGRADED, failed = FULMAR_FAILED };

// ---- inputs: views of data of the host; valid during the call

/// The latest sample of a wire. The host calls `step` only when there is one.
template <class T>
struct In {
  const fulmar_input* input = nullptr;  ///< set by the host's adapter

  const T& operator*() const { return *static_cast<const T*>(input->data); }
  const T* operator->() const { return static_cast<const T*>(input->data); }
  bool fresh() const {
    return input && (input->flags & FULMAR_FRESH) != 0;
  }  ///< true if the previous step did not read this sample
  bool stale() const {
    return input && (input->flags & FULMAR_STALE) != 0;
  }  ///< true if the sample is older than the wire's max_age
  std::int64_t valid_at_ns() const { return input->valid_at_ns; }
  double valid_at_s() const { return 1e-9 * static_cast<double>(input->valid_at_ns); }
  double age_s() const { return 1e-9 * static_cast<double>(input->age_ns); }
  std::uint64_t sequence() const { return input ? input->sequence : 0; }  ///< number of samples, from 1
};

/// As In, but the component also steps without a sample: `if (in.gnss && in.gnss.fresh()) ...`.
template <class T>
struct Optional : In<T> {
  explicit operator bool() const { return this->input && this->input->data; }
};

template <class T>
struct Sample {
  const T& value;
  std::int64_t valid_at_ns;  ///< flight time of validity, set by the writer
  double valid_at_s() const { return 1e-9 * static_cast<double>(valid_at_ns); }
};

/// All samples since the last step, oldest first: `for (const auto& sample : in.edits)`.
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
  }  ///< number of samples since the last step that exceeded the capacity
};

/// Requests. The component answers each in the same step: `for (auto request : in.edit)`. A request without
/// an answer counts as rejected. An external client receives the answer. A component that feeds a request
/// receives none: the answering component publishes a port of results, as `plan.results`.
template <class T>
struct Request {
  const fulmar_input* input = nullptr;

  struct One {
    const T& asked;
    fulmar_answer& answer;
    const T& value() const { return asked; }
    void accept() const { answer.verdict = FULMAR_ACCEPTED; }
    /// A reason longer than about 120 bytes is cut, and ends in dots.
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

/// A message that a step may leave unpublished.
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

/// Time of validity for samples of a driver, which has no flight time: the time at which the loop takes the
/// sample.
inline constexpr std::int64_t on_arrival = FULMAR_ON_ARRIVAL;

/// Zero to N messages per step.
template <class T, std::size_t N = 16>
struct OutQueue {
  std::array<T, N> items{};
  std::array<std::int64_t, N> stamps_ns{};
  std::uint32_t count = 0, lost = 0;

  /// Returns false if the queue is full; the host counts the loss for the reader.
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

/// One number for observation: logged and plotted without a message type. Its name ends in its unit.
struct Probe {
  double value = 0;
  bool written = false;
  Probe& operator=(double number) {
    value = number;
    written = true;
    return *this;
  }
};

/// Outputs applied last in the role of the component, by any component. `activate` continues from them.
///   if (last.has(last->attitude)) throttle_ = last->attitude.throttle_frac;
template <class Outputs>
struct Applied {
  Outputs outputs{};  ///< outputs that were never applied are zero, which may also be a valid command
  std::uint64_t made_bits = 0;  ///< one bit per output, in their order: 1 if the output was applied

  const Outputs* operator->() const { return &outputs; }
  operator const Outputs&() const { return outputs; }  // NOLINT(google-explicit-constructor)

  /// True if at least one output was applied. False at the start of the flight and while the pilot flies.
  bool given() const { return made_bits != 0; }
  /// True if this output was applied: `last.has(last->attitude)`. The previous component may have fewer
  /// outputs.
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
  /// Applied outputs of a group: `estimator_.activate(tick, in.nav, p.nav, last.part(last->nav))`.
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
  /// Marks all of these outputs as applied.
  static Applied all(const Outputs& applied) {
    constexpr std::size_t n = detail::port_count<Outputs>();
    return {applied, n < 64 ? (std::uint64_t{1} << n % 64) - 1 : ~std::uint64_t{0}};
  }
};

// ---- parameters

enum class Access : std::uint8_t { live, setup };
inline constexpr Access live = Access::live;    ///< may change between ticks
inline constexpr Access setup = Access::setup;  ///< fixed at the start of the flight

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

/// One value of an enum.
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
         max = std::numeric_limits<double>::infinity();  ///< limits of each element
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
         max = std::numeric_limits<double>::infinity();  ///< limits of each element
  const char* doc = "";
  Access access = live;
  constexpr double operator()(std::size_t row, std::size_t column) const { return value[row][column]; }
};

enum class Need : std::uint8_t { optional, required };
inline constexpr Need required = Need::required;

/// A YAML file, read by the host into a described struct.
template <class T>
struct Record {
  const char* doc = "";
  Need need = Need::optional;
  T value{};
  bool is_given = false;
  bool given() const { return is_given; }  ///< true if the mission names one
  const T& operator*() const { return value; }
  const T* operator->() const { return &value; }
};

/// The bytes of a file. The host owns them; they are valid until the next `configure`.
struct Blob {
  const char* doc = "";
  Need need = Need::optional;
  const std::byte* data = nullptr;
  std::size_t size = 0;
  const char* name = "";
};

}  // namespace fulmar

#include "fulmar/detail/glue.hpp"

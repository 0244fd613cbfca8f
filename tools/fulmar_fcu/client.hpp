// SPDX-License-Identifier: BSD-3-Clause
// A connection to a ROSflight flight controller: sends the heartbeat, stores the last of every message, and
// waits with time-outs. Answers of the firmware: rosflight_firmware 2.0, comm_manager.
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "plugins/fcu_serial/link/frame.hpp"
#include "plugins/fcu_serial/link/port.hpp"

namespace fulmar::fcu {

using core::Error;

inline constexpr std::int64_t ms = 1'000'000, second = 1'000'000'000;

/// A device and a clock, which a test can replace.
struct Endpoint {
  std::string name;                             ///< as given by the user
  std::function<std::unique_ptr<Port>()> open;  ///< throws PortError
  std::function<std::int64_t()> now_ns;         ///< monotonic
};
Endpoint device(const std::string& port, std::int64_t baud);

struct Param {
  std::string name;
  std::uint16_t index = 0;
  bool whole = false;      ///< an integer of 32 bits; else a float of 32 bits
  std::uint32_t bits = 0;  ///< never through a float: small integers would be denormal, negative ones NaN
  std::int64_t heard_ns = 0;

  std::int32_t integer() const { return std::bit_cast<std::int32_t>(bits); }
  float real() const { return std::bit_cast<float>(bits); }
  double number() const { return whole ? integer() : static_cast<double>(real()); }
  std::string text() const;  ///< the shortest that reads back as the same bits
};

struct Said {  ///< a STATUSTEXT
  std::int64_t at_ns = 0;
  std::uint8_t severity = 6;
  std::string text;
};

/// The user pressed Ctrl-C.
struct Interrupted : Error {
  /// `more`: the consequence, such as " The former values are back."
  explicit Interrupted(const std::string& more = "") : Error("Interrupted." + more) {}
};

class Client {
 public:
  /// Opens the device. Throws PortError.
  explicit Client(Endpoint endpoint);

  /// Checks that a ROSflight controller of version 2 answers. Throws Error, one sentence, within 5 s.
  void connect();
  /// Closes the device and opens it again, within that time.
  void reopen(std::int64_t limit_ns);

  std::int64_t now_ns() const { return endpoint_.now_ns(); }
  const std::string& name() const { return endpoint_.name; }
  /// Reads for that time.
  void pump(std::int64_t ns);
  /// Reads until `done()`. Returns false after `ns`.
  bool wait(std::int64_t ns, const std::function<bool()>& done);

  template <class M>
  void send(const M& message) {
    send_frame(encode(message, sequence_++));
  }
  template <class M>
  std::optional<M> last() const {
    if (count_[M::id] == 0) return {};
    return last_[M::id].template as<M>();
  }
  /// Time since the last one; 1e9 without one.
  template <class M>
  double age_s() const {
    return count_[M::id] == 0 ? 1e9 : static_cast<double>(now_ns() - heard_ns_[M::id]) * 1e-9;
  }
  template <class M>
  std::uint64_t count() const {
    return count_[M::id];
  }
  std::uint64_t count_of(std::uint8_t id) const { return count_[id]; }
  std::uint64_t bytes() const { return bytes_; }
  const Parser::Counts& counts() const { return parser_.counts(); }
  const std::vector<Said>& said() const { return said_; }
  const std::string& version() const { return version_; }  ///< "" when it does not answer, as while armed
  std::uint8_t system() const { return system_; }

  /// Last reported value of each parameter, by name.
  const std::map<std::string, Param>& params() const { return params_; }
  std::uint16_t param_count() const { return param_count_; }
  void forget_params() { params_.clear(); }

  bool armed();  ///< from a fresh status. Throws Error without one
  /// Throws Error "... is armed" for an armed controller. `deed`: "calibrating".
  void refuse_armed(const std::string& deed);
  /// Sends a command until it is acknowledged, or only once. Returns true: accepted; false: rejected; none:
  /// no answer in time.
  std::optional<bool> command(Command c, int tries = 4, std::int64_t each_ns = 500 * ms);
  /// The same, but throws Error, one sentence, unless accepted. `deed`: "writing the parameters". `refusal`
  /// ends the sentence after a rejection: the protocol gives no reason, and texts that arrive meanwhile are
  /// about other things.
  void demand(Command c, const std::string& deed, const std::string& refusal = " and gave no reason.");
  /// The smallest of some round trips, in ns; none without an answer.
  std::optional<std::int64_t> round_trip_ns(int questions = 20);
  /// Called for each packet, after it was stored.
  std::function<void(const Packet&)> on_packet;
  /// Called while reading; true ends any operation with Interrupted.
  std::function<bool()> cancelled;

 private:
  void step(std::int64_t until_ns);
  void take(const Packet& packet);
  void take_param(const ParamValue& value);
  void send_frame(const Frame& frame);
  void ask_version();
  [[noreturn]] void explain_silence() const;

  struct Ack {
    std::int64_t at_ns = 0;
    bool success = false;
  };
  Endpoint endpoint_;
  std::unique_ptr<Port> port_;
  Parser parser_;
  std::array<Packet, 256> last_{};
  std::array<std::int64_t, 256> heard_ns_{};
  std::array<std::uint64_t, 256> count_{};
  std::map<std::uint8_t, Ack> acks_;
  std::map<std::string, Param> params_;
  std::vector<Said> said_;
  std::string version_;
  std::uint64_t bytes_ = 0, readable_ = 0;
  std::int64_t beat_ns_ = 0;
  std::uint16_t param_count_ = 0;
  std::uint8_t sequence_ = 0, system_ = 1;
};

}  // namespace fulmar::fcu

// SPDX-License-Identifier: BSD-3-Clause
// Output of a flight: messages, probes, events, commands, ticks and their hashes into the tap and its log,
// texts to users.
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/log/events.hpp"
#include "core/run/component/unit.hpp"
#include "core/run/state/state.hpp"
#include "core/tap/log.hpp"
#include "core/tap/tap.hpp"

namespace fulmar::core {

using Units = std::vector<std::unique_ptr<Unit>>;

class Recorder {
 public:
  explicit Recorder(FlightState& state) : state_(state) {}

  /// [setup] setup.cpp: makes the tap, and the log when there is to be one. Throws Error.
  void open(const Units& units, bool with_log);
  /// [setup] Selects the units whose texts are printed; call it again after an exchange of units.
  void listen(const Units& units);
  /// [setup] Records a swapped plugin.
  void note_swap(const std::string& component, const PluginInfo& plugin);
  Tap* tap() const noexcept { return tap_.get(); }

  /// [tick] Records an event in the log, and prints it when `aloud`.
  void note(const Event& event, bool aloud = true);
  /// [tick] Records a sample that was just published, and prints its texts.
  void put(Slot& slot);
  void put_probes(Unit& unit);
  /// [tick] Records a command from outside.
  void put_command(const CommandNote& note);
  void put_input(int channel, const std::byte* message);
  /// [tick] Records the requests that a component has rejected. The senders already have the answer.
  void note_refusals(Unit& unit) noexcept;
  /// [tick] At its end.
  void note_tick();
  /// [tick] Reports once that the log's disk has failed.
  void check_log();
  /// [tick] Time that the loop has waited for the log since the last call.
  std::int64_t take_wait_ns() noexcept { return tap_ ? tap_->take_wait_ns() : 0; }
  /// [tick] Whether the loop waits for the log from now on: for a flight as fast as the machine allows.
  void wait_for_log(bool on) noexcept {
    if (log_) tap_->hold_back(on);
  }
  /// At the end of the flight.
  LogResult close();

 private:
  struct Channels {
    std::size_t event = 0, ticks = 0, parameter = 0, command = 0, lines = 0;
  };
  /// A port whose texts are printed for users.
  struct Reported {
    const Slot* slot = nullptr;
    const Field *text = nullptr, *severity = nullptr, *cause = nullptr;
    std::vector<char> last;  // of a port that is written in every step: printed when it changes
  };
  class ChannelList;

  std::vector<TapChannel> channels(const Units& units);
  void add_channels(ChannelList& list, Unit& unit);
  void add_further_requests(ChannelList& list, Unit& unit);
  void open_log(const Units& units);
  std::int64_t record_period(const std::string& port, const Slot& slot) const;  // -1: not recorded
  void attach_texts(const Units& units);
  void listen_to(const Unit& unit, int output);
  void report(Reported& reported);
  void put_ticks();

  FlightState& state_;
  std::unique_ptr<Tap> tap_;  // before the log, which uses it
  std::unique_ptr<Log> log_;
  Channels channels_;
  Ticks ticks_;
  std::uint64_t tick_hash_ = 0;
  std::vector<Reported> reported_;
  bool reported_log_failed_ = false;
};

}  // namespace fulmar::core

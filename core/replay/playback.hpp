// SPDX-License-Identifier: BSD-3-Clause
// What entered a flight from outside, out of its log: the outputs of the vehicle and of drivers, tick by
// tick, in place of the devices; and what was asked of the flight between ticks.
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/graph/graph.hpp"
#include "core/log/events.hpp"
#include "core/log/reader.hpp"
#include "core/run/circumstances.hpp"
#include "core/run/command.hpp"
#include "core/run/resume.hpp"

namespace fulmar::core {

class RecordedVehicle;

/// The ticks of a flight, of the log's topic /fulmar/ticks.
struct TickList {
  std::vector<std::int64_t> time_ns;
  std::vector<std::uint32_t> hash;  // of what the components have published in that tick
};
/// Throws Error when the log has none, or does not begin with the flight.
TickList read_ticks(const McapFile& file);

/// Something that entered between two ticks. Of a swap `command.note` tells which plugin.
struct Entry {
  std::size_t before = 0;  // the index of the tick that saw it first
  Command command;
};

class Playback final : public Circumstances {
 public:
  /// `file` must outlive it. `changed`: components of an experiment, which do not die as they did. Throws
  /// Error when a topic is missing or has other fields than the graph's.
  Playback(const McapFile& file, const Graph& graph, std::vector<std::string> changed = {});
  ~Playback() override;

  const TickList& ticks() const { return ticks_; }
  const std::vector<Entry>& entries() const { return entries_; }
  /// What the log lacks of the vehicle's samples, one sentence per topic: a replay cannot be equal then.
  const std::vector<std::string>& gaps() const { return gaps_; }

  /// The flight ended with a fault of its vehicle, after the last tick.
  bool vehicle_failed() const { return vehicle_failed_; }

  /// When the owner of a hardware flight had it end while the aircraft was armed, seconds of flight.
  std::optional<double> duration_s() const { return duration_s_; }
  /// Where the flight went on, when it was the second of one.
  const std::optional<Resume>& resume() const { return resume_; }
  /// Whether a signal to the host took effect at the end of this tick.
  bool signalled(std::int64_t now_ns) const;
  bool ran_over(const std::string& component, std::int64_t now_ns) const override;
  void stand_in(const Graph& graph, const Component& component, UnitOptions& options) override;

 private:
  /// What the host told of a component that a replay cannot find out by itself.
  struct Told {
    std::int64_t at_ns = 0, value_ns = 0;
    Code code = Code::guard;
    std::string component, name, cause;
  };
  void index_host();
  void take_event(const Event& event, std::int64_t now_ns);
  void index_entries(const Graph& graph);
  void take_resume(const Event& event, bool begun);
  void check_gap(std::uint16_t channel);
  bool told(Code code, const std::string& component, std::int64_t now_ns) const;

  const McapFile& file_;
  std::vector<std::string> changed_;
  std::int64_t epoch_ns_;
  TickList ticks_;
  std::vector<Entry> entries_;
  std::vector<std::string> gaps_;
  std::unique_ptr<RecordedVehicle> vehicle_;  // until it takes its place
  std::string last_words_;                    // of a vehicle that failed
  bool vehicle_failed_ = false;
  HostTopic<Event> events_;
  std::vector<Told> told_;
  std::optional<double> duration_s_;
  std::optional<Resume> resume_;
};

}  // namespace fulmar::core

// SPDX-License-Identifier: BSD-3-Clause
// External inputs of a flight from its log. The outputs of the vehicle and of drivers replace the devices,
// tick by tick; requests enter between ticks. The log is read during the replay, some ticks ahead.
#pragma once
#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/graph/graph.hpp"
#include "core/log/events.hpp"
#include "core/log/reader.hpp"
#include "core/run/command/command.hpp"
#include "core/run/component/replay_context.hpp"
#include "core/run/state/resume.hpp"
#include "tools/fulmar_replay/survey.hpp"

namespace fulmar::core {

class SampleTrack;
class VehicleTrack;

class Playback final : public Circumstances {
 public:
  /// `log` is the file of `survey`; both and `graph` must outlive it. `changed`: components of an experiment,
  /// whose logged stops do not apply. Throws Error when a topic is missing or has other fields than the
  /// graph's.
  Playback(const std::filesystem::path& log, const Survey& survey, const Graph& graph,
           std::vector<std::string> changed = {});
  ~Playback() override;

  /// Inputs that the log lacks, one sentence per topic: with a gap a replay cannot be equal.
  const std::vector<std::string>& gaps() const { return gaps_; }
  /// Flight time, s, at which a hardware flight was ended while the aircraft was armed.
  std::optional<double> duration_s() const;
  /// Start of a resumed flight.
  const std::optional<Resume>& resume() const { return resume_; }
  /// True when the flight ended with a fault of its vehicle, after the last tick.
  bool vehicle_failed() const { return vehicle_failed_; }

  /// Reads all inputs up to the end of the next tick. Throws Error.
  void begin_tick();
  /// Called after the last tick.
  void end() { over_ = true; }
  /// The next input of this tick. For a swap `note` names the plugin.
  std::optional<Command> entry();
  /// True when a signal to the host took effect at the end of this tick.
  bool signalled() const;
  bool ran_over(const std::string& component, std::int64_t now_ns) const override;
  const Event* conclusion() const override { return survey_.conclusion ? &*survey_.conclusion : nullptr; }
  void stand_in(const Graph& graph, const Component& component, UnitOptions& options) override;

 private:
  using Take = std::function<void(const McapFile::Message&)>;
  struct Entry {
    bool at_begin = false;  // before the first tick
    std::int64_t log_ns = 0;
    Command command;
  };
  void prepare_vehicle(const Graph& graph);
  void prepare_entries(const Graph& graph);
  void prepare_resume(const Graph& graph);
  std::shared_ptr<SampleTrack> driver(const Graph& graph, const Component& component);
  void route(std::uint16_t channel, Take take);
  void store(const McapFile::Message& message, Command command);
  bool read();
  bool changed(const std::string& component) const;
  std::int64_t flight_ns(std::uint64_t log_ns) const;
  std::uint64_t log_ns(std::int64_t flight_ns) const;

  const Survey& survey_;
  std::vector<std::string> changed_;
  std::int64_t epoch_ns_;
  std::vector<std::string> gaps_;
  std::optional<Resume> resume_;
  bool vehicle_failed_ = false;
  std::shared_ptr<VehicleTrack> vehicle_;
  std::map<std::string, std::shared_ptr<SampleTrack>> drivers_;

  struct Reading {
    McapStream stream;
    std::int64_t now_ns;                   // of the last message read
    std::uint64_t place = 0;               // of the next message
    std::vector<std::vector<Take>> takes;  // by channel
    std::size_t ahead_bytes = 0;           // read since the last message of ticks
  } reading_;
  std::deque<std::int64_t> ticks_;  // read and not yet run
  std::deque<Entry> entries_;
  std::int64_t now_ns_;
  bool over_ = false;
};

}  // namespace fulmar::core

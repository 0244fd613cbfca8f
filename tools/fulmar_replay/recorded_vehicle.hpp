// SPDX-License-Identifier: BSD-3-Clause
// Replaces a vehicle: publishes the samples of another flight, tick by tick. Commands have no effect.
#pragma once
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/graph/graph.hpp"
#include "core/log/reader.hpp"
#include "core/run/component/runner.hpp"
#include "tools/fulmar_replay/survey.hpp"

namespace fulmar::core {

/// Samples of a vehicle from the log that wait for their tick.
class VehicleTrack {
 public:
  /// Throws Error when a topic is missing or has other fields than the graph's.
  VehicleTrack(const Survey& survey, const Graph& graph);

  /// Channel -> output, or `all_probes`.
  const std::map<std::uint16_t, std::uint32_t>& outputs() const { return outputs_; }
  /// Sets the message of a vehicle that failed after the last tick.
  void set_last_words(const std::string& words) { last_words_ = words; }

  /// Takes the next message of one of these channels. Throws Error.
  void take(std::uint32_t output, const McapFile::Message& message);
  /// Begins the tick that is read next. Throws Error when earlier samples belong to no tick.
  void begin_tick(std::int64_t now_ns);
  /// [tick] Throws Error, with the message of the vehicle, when there is no further tick.
  void read(fulmar_tick& tick, std::vector<fulmar_output>& out);

 private:
  static constexpr std::uint32_t all_probes = ~0u;
  struct Sample {
    std::int64_t log_ns = 0, valid_at_ns = 0;
    std::uint16_t channel = 0;
    std::uint32_t output = 0;
    std::vector<std::byte> data;
  };
  void put(const Sample& sample, std::vector<fulmar_output>& out) const;

  const McapFile& log_;
  std::int64_t epoch_ns_;
  const Component& vehicle_;
  std::map<std::uint16_t, std::uint32_t> outputs_;
  std::vector<std::uint32_t> probes_;  // outputs that are probes
  std::deque<Sample> waiting_;
  std::optional<std::int64_t> now_ns_;
  std::string last_words_ = "the log ends here";
};

class RecordedVehicle final : public Runner {
 public:
  explicit RecordedVehicle(std::shared_ptr<VehicleTrack> track) : track_(std::move(track)) {}
  std::uint32_t read(fulmar_tick& tick, Outlets& out, fulmar_error& problem) noexcept override;

 private:
  std::shared_ptr<VehicleTrack> track_;
};

}  // namespace fulmar::core

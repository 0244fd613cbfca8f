// SPDX-License-Identifier: BSD-3-Clause
// In the place of a vehicle: what one published in another flight, tick by tick. Commands go nowhere.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "core/graph/graph.hpp"
#include "core/log/reader.hpp"
#include "core/run/runner.hpp"

namespace fulmar::core {

class RecordedVehicle final : public Runner {
 public:
  /// `file` and `time_ns`, the times of the ticks, must outlive it. Throws Error when a topic is missing or
  /// has other fields than the graph's.
  RecordedVehicle(const McapFile& file, const Graph& graph, const std::vector<std::int64_t>& time_ns);

  /// What the log lacks of its samples, one sentence per topic.
  const std::vector<std::string>& gaps() const { return gaps_; }
  /// What a vehicle that failed said, after the last tick.
  void set_last_words(const std::string& words) { last_words_ = words; }

  std::uint32_t read(fulmar_tick& tick, Outlets& out, fulmar_error& problem) noexcept override;

 private:
  static constexpr std::uint32_t all_probes = ~0u;
  struct Sample {
    std::uint32_t output = 0;
    const McapFile::Message* message = nullptr;
  };
  void index(const McapFile::Message& message, std::uint32_t output, std::size_t tick);
  void put(const Sample& sample, fulmar_output& out) const;  // throws Error

  const std::vector<std::int64_t>& time_ns_;
  std::int64_t epoch_ns_;
  const ComponentInfo& info_;
  std::vector<std::vector<Sample>> samples_;  // per tick
  std::vector<std::uint32_t> probes_;         // outputs that are probes
  std::vector<std::string> gaps_;
  std::string last_words_ = "the log ends here";
  std::size_t at_ = 0;
};

}  // namespace fulmar::core

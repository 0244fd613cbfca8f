// SPDX-License-Identifier: BSD-3-Clause
// Replaces a driver: the samples of its queues from the log of another flight, at the ticks at which they
// entered it.
#pragma once
#include <cstdint>
#include <deque>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/log/reader.hpp"
#include "core/run/component/driver.hpp"
#include "core/types/type.hpp"

namespace fulmar::core {

/// Samples that were read from a log and wait for their tick.
class SampleTrack {
 public:
  /// `component`: its name in the mission. `topics`: one per output, "" for a probe and for an output that
  /// was never published. `probes`: the topic of all probes, "" for none. Throws Error when the log has none
  /// of them, or with other fields.
  SampleTrack(const McapFile& log, const std::string& component, const ComponentInfo& info,
              const std::vector<std::string>& topics, const std::string& probes, std::int64_t epoch_ns);

  /// Channel -> output, or `all_probes`.
  const std::map<std::uint16_t, std::uint32_t>& outputs() const { return outputs_; }
  static constexpr std::uint32_t all_probes = ~0u;

  /// The next message of the log; ignores other channels. Throws Error.
  void take(const McapFile::Message& message);
  /// [tick] As in SampleSource; the sample is valid until the next call.
  bool next(std::int64_t now_ns, SampleSource::Sample& sample) noexcept;
  std::uint64_t lost() const noexcept { return lost_; }

 private:
  struct Stored {
    std::int64_t log_ns = 0, valid_at_ns = 0;
    std::uint32_t output = 0;
    std::vector<std::byte> data;
    bool ends = false;
  };
  void add(std::uint32_t output, const McapFile::Message& message);
  void add_probes(const McapFile::Message& message);
  void store(Stored sample);

  std::string name_;
  std::vector<TypePtr> types_;  // of the outputs; nullptr for a probe
  std::int64_t epoch_ns_;
  std::map<std::uint16_t, std::uint32_t> outputs_;
  std::deque<Stored> waiting_;
  std::size_t waiting_bytes_ = 0;
  Stored given_;
  std::vector<std::byte> probes_;  // the previous values
  std::uint64_t lost_ = 0;
};

class RecordedSamples final : public SampleSource {
 public:
  /// Reads the log itself. Throws Error as SampleTrack does, and when samples are not in the order of time.
  RecordedSamples(const std::filesystem::path& log, const std::string& component, const ComponentInfo& info,
                  const std::vector<std::string>& topics, const std::string& probes, std::int64_t epoch_ns);
  /// Uses a track that another object fills, and the texts with which a guard stopped the driver, in the
  /// order of time.
  RecordedSamples(std::shared_ptr<SampleTrack> track,
                  std::vector<std::pair<std::int64_t, std::string>> faults);
  bool next(std::int64_t now_ns, Sample& sample) noexcept override;
  void release() noexcept override {}
  const char* fault() const noexcept override;
  std::uint64_t lost() const noexcept override { return track_->lost(); }

 private:
  void read_on(std::int64_t now_ns) noexcept;

  std::shared_ptr<SampleTrack> track_;
  std::vector<std::pair<std::int64_t, std::string>> faults_;
  std::unique_ptr<McapStream> stream_;  // while there is more to read
  std::int64_t epoch_ns_ = 0, read_ns_ = std::numeric_limits<std::int64_t>::min();
  std::string unreadable_;  // reason for the early end of reading
  std::int64_t now_ns_ = 0;
};

}  // namespace fulmar::core

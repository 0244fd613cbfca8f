// SPDX-License-Identifier: BSD-3-Clause
// `run: driver`: a component that does input and output is stepped again and again in a thread of its own;
// its samples wait in a ring until the next tick takes them. Or, in its place, the samples that a log holds.
#pragma once
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "core/log/reader.hpp"
#include "core/run/async.hpp"
#include "core/run/ring.hpp"
#include "core/types/type.hpp"

namespace fulmar::core {

/// What a driver has to say at a tick. One consumer: the loop, which also starts it.
struct SampleSource {
  struct Sample {
    std::uint32_t output = 0;  // of the component
    std::int64_t valid_at_ns = 0;
    const std::byte* data = nullptr;  // one message, or a double; valid until `release`
    bool ends = false;                // what follows is published separately
  };
  virtual ~SampleSource() = default;
  /// [tick] Once, before the first sample is asked for.
  virtual void start() {}
  /// [tick] The next sample that has arrived by now, or false.
  virtual bool next(std::int64_t now_ns, Sample& sample) noexcept = 0;
  virtual void release() noexcept = 0;
  /// [tick] Why no more samples come: "" as long as they may.
  virtual const char* fault() const noexcept = 0;
  /// Samples that found no room in the ring.
  virtual std::uint64_t lost() const noexcept = 0;
};

class Driver final : public SampleSource {
 public:
  Driver(const std::string& name, const fulmar_component& functions, void* instance,
         const ComponentInfo& info);
  ~Driver() override;
  Driver(const Driver&) = delete;
  Driver& operator=(const Driver&) = delete;

  void start() override;
  bool next(std::int64_t now_ns, Sample& sample) noexcept override;
  void release() noexcept override { ring_.release(); }
  const char* fault() const noexcept override {
    return failed_.load(std::memory_order_acquire) ? error_.text : "";
  }
  std::uint64_t lost() const noexcept override { return lost_.load(std::memory_order_relaxed); }

 private:
  void run() noexcept;
  bool step() noexcept;

  std::string name_;  // of the component
  const fulmar_component& functions_;
  void* instance_;
  const ComponentInfo& info_;
  OutputRoom out_;
  Ring ring_;
  fulmar_error error_{};
  std::uint64_t steps_ = 0;
  std::atomic<std::int64_t> now_ns_{0};
  std::atomic<std::uint64_t> lost_{0};
  std::atomic<bool> failed_{false}, stop_{false}, ended_{false};
  std::thread thread_;
};

/// Samples of a component's queues from the log of another flight, at the ticks at which they entered then.
class RecordedSamples final : public SampleSource {
 public:
  /// `topics`: one per output, "" for a probe. Throws Error when the log has none of them, or with other
  /// fields.
  RecordedSamples(const std::filesystem::path& log, const ComponentInfo& info,
                  const std::vector<std::string>& topics, std::int64_t epoch_ns);
  /// The same, and the topic of its probes, "" for none; and when a guard stopped it, with what words.
  RecordedSamples(const McapFile& log, const ComponentInfo& info, const std::vector<std::string>& topics,
                  const std::string& probes, std::int64_t epoch_ns,
                  std::vector<std::pair<std::int64_t, std::string>> faults);
  bool next(std::int64_t now_ns, Sample& sample) noexcept override;
  void release() noexcept override {}
  const char* fault() const noexcept override;
  std::uint64_t lost() const noexcept override { return 0; }

 private:
  struct Stored {
    std::int64_t log_ns = 0, valid_at_ns = 0;
    std::uint32_t output = 0;
    std::vector<std::byte> data;
    bool ends = false;
  };
  void add(const ComponentInfo& info, std::uint32_t output, const McapFile::Message& message,
           std::int64_t epoch_ns);
  void add_probes(const ComponentInfo& info, const McapFile::Message& message, std::int64_t epoch_ns);

  std::vector<Stored> samples_;
  std::vector<std::byte> probes_;  // the values of before
  std::vector<std::pair<std::int64_t, std::string>> faults_;
  std::int64_t now_ns_ = 0;
  std::size_t at_ = 0;
};

}  // namespace fulmar::core

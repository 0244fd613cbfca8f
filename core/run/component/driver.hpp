// SPDX-License-Identifier: BSD-3-Clause
// `run: driver`: a component with input and output steps continuously in a separate thread; its samples wait
// in a ring for the next tick.
#pragma once
#include <atomic>
#include <cstdint>
#include <string>
#include <thread>

#include "core/run/component/async.hpp"
#include "core/run/component/ring.hpp"
#include "core/types/type.hpp"

namespace fulmar::core {

/// Samples of a driver for a tick. One consumer: the loop, which also starts it.
struct SampleSource {
  struct Sample {
    std::uint32_t output = 0;  // of the component
    std::int64_t valid_at_ns = 0;
    const std::byte* data = nullptr;  // one message, or a double; valid until `release`
    bool ends = false;                // the following samples are published separately
  };
  virtual ~SampleSource() = default;
  /// [tick] Call once, before the first `next`.
  virtual void start() {}
  /// [tick] The next sample that has arrived by now, or false.
  virtual bool next(std::int64_t now_ns, Sample& sample) noexcept = 0;
  virtual void release() noexcept = 0;
  /// [tick] Why no more samples come: "" while they may.
  virtual const char* fault() const noexcept = 0;
  /// Samples that were dropped because the ring was full.
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

}  // namespace fulmar::core

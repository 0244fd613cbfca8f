// SPDX-License-Identifier: BSD-3-Clause
// `run: async`: a component steps in a separate thread, on copies of its inputs; the loop takes each result
// when its latency is over.
#pragma once
#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "core/run/component/allocation.hpp"
#include "core/run/component/reply.hpp"
#include "core/types/type.hpp"

namespace fulmar::core {

/// Room for the outputs of a component in a separate thread; `views` point to the rest.
struct OutputRoom {
  explicit OutputRoom(const ComponentInfo& info);
  OutputRoom() = default;
  /// [tick] Clears the outputs and sets their time to now.
  void prepare(std::int64_t now_ns) noexcept;

  std::vector<fulmar_output> views;
  std::vector<std::vector<std::byte>> data;
  std::vector<std::vector<std::int64_t>> stamps;
};

class Async {
 public:
  /// Samples of inputs, copied: `views` point to the rest.
  struct Inputs {
    std::vector<fulmar_input> views;
    std::vector<std::vector<std::byte>> data;
    std::vector<std::vector<std::int64_t>> stamps;
    std::vector<std::vector<fulmar_answer>> answers;
    std::vector<std::vector<Reply>> replies;
  };
  /// One pending call: filled in by the loop, executed by the thread, taken back by the loop.
  struct Job {
    enum class Call : std::uint8_t { step, retune, activate };
    Call call = Call::step;
    bool dropped = false;  // its component has become inactive meanwhile: the result is not needed
    std::int64_t due_ns = 0;
    std::int64_t held_until_ns = 0;  // in a replay: it was late, and was taken at this time
    fulmar_tick tick{};
    Inputs in, last;
    OutputRoom out;
    std::vector<fulmar_value> values;
    std::uint32_t status = 0;
    fulmar_error error{};
    std::int64_t took_ns = 0, heap_growth = 0;
    bool missed = false;  // counted
  };

  /// `depth`: largest number of pending steps.
  Async(const std::string& name, const fulmar_component& functions, void* instance, const ComponentInfo& info,
        std::size_t depth);
  ~Async();  // ends the thread, after its present call
  Async(const Async&) = delete;
  Async& operator=(const Async&) = delete;

  /// [tick] A free job to fill in, or nullptr; `submit` passes it to the thread. Steps have separate room, so
  /// that its availability does not depend on the duration of a retune or an activate, which a replay does
  /// not have.
  Job* room(Job::Call call) noexcept;
  void submit() noexcept;
  /// [tick] The oldest pending call, or nullptr; call `release` after it has been taken.
  Job* oldest() noexcept;
  bool done() const noexcept { return finished_.load(std::memory_order_acquire) > taken_; }
  void wait() const noexcept;
  void release() noexcept;
  /// [tick] Drops the results of all pending calls.
  void drop() noexcept;

  static void copy_inputs(const std::vector<fulmar_input>& from, const ComponentInfo& info,
                          Job& job) noexcept;

 private:
  void run() noexcept;
  void work(Job& job) noexcept;
  Job& at(std::uint64_t n) { return jobs_[static_cast<std::size_t>(n % jobs_.size())]; }

  std::string name_;  // of the component
  const fulmar_component& functions_;
  void* instance_;
  std::vector<Job> jobs_;
  std::uint64_t taken_ = 0;                  // loop only
  std::size_t max_steps_, steps_ = 0;        // pending; loop only
  std::atomic<std::uint64_t> submitted_{0};  // counter; its top bit asks the thread to end
  std::atomic<std::uint64_t> finished_{0};
  static constexpr std::uint64_t ending = std::uint64_t{1} << 63;
  std::thread thread_;
};

}  // namespace fulmar::core

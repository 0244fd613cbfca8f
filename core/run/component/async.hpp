// SPDX-License-Identifier: BSD-3-Clause
// `run: async`: a component is stepped in a thread of its own, on copies of its inputs; the loop takes each
// result when its latency is over.
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

/// Room for what a component publishes in a thread of its own; `views` point to the rest.
struct OutputRoom {
  explicit OutputRoom(const ComponentInfo& info);
  OutputRoom() = default;
  /// [tick] Empty again, dated now.
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
  /// One call on its way: filled in by the loop, worked on by the thread, taken back by the loop.
  struct Job {
    enum class Call : std::uint8_t { step, retune, activate };
    Call call = Call::step;
    bool dropped = false;  // its component has stopped flying meanwhile: nobody waits for the result
    std::int64_t due_ns = 0;
    std::int64_t held_until_ns = 0;  // in a replay: it was late, and taken then
    fulmar_tick tick{};
    Inputs in, last;
    OutputRoom out;
    std::vector<fulmar_value> values;
    std::uint32_t status = 0;
    fulmar_error error{};
    std::int64_t took_ns = 0, heap_growth = 0;
    bool missed = false;  // counted
  };

  /// `depth`: steps that can be on their way at once.
  Async(const std::string& name, const fulmar_component& functions, void* instance, const ComponentInfo& info,
        std::size_t depth);
  ~Async();  // ends the thread, after the call that it is in
  Async(const Async&) = delete;
  Async& operator=(const Async&) = delete;

  /// [tick] A free job to fill in, or nullptr; `submit` hands it over. Steps have room of their own: whether
  /// there is some does not depend on how long a retune or an activate takes, which a replay does not know.
  Job* room(Job::Call call) noexcept;
  void submit() noexcept;
  /// [tick] The oldest call on its way, or nullptr; `release` when it has been taken.
  Job* oldest() noexcept;
  bool done() const noexcept { return finished_.load(std::memory_order_acquire) > taken_; }
  void wait() const noexcept;
  void release() noexcept;
  /// [tick] Nobody wants the results of what is on its way.
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
  std::uint64_t taken_ = 0;                  // the loop's
  std::size_t max_steps_, steps_ = 0;        // on their way; the loop's
  std::atomic<std::uint64_t> submitted_{0};  // counts for ever; the top bit asks the thread to end
  std::atomic<std::uint64_t> finished_{0};
  static constexpr std::uint64_t ending = std::uint64_t{1} << 63;
  std::thread thread_;
};

}  // namespace fulmar::core

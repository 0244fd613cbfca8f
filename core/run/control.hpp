// SPDX-License-Identifier: BSD-3-Clause
// The Control of a flight. Commands are checked and prepared in the sender's thread, cross into the loop
// through a lock-free queue, and take effect between two ticks. Another queue returns them to be answered and
// freed.
#pragma once
#include <array>
#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "core/graph/graph.hpp"
#include "core/run/command/command.hpp"
#include "core/run/flight.hpp"
#include "core/tap/control.hpp"

namespace fulmar::core {

class Unit;

/// One producer, one consumer, pointers; when full, a push is rejected.
template <class T, std::size_t N>
class PointerQueue {
 public:
  bool push(T* p) noexcept {
    const std::size_t at = head_.load(std::memory_order_relaxed);
    if (at - tail_.load(std::memory_order_acquire) == N) return false;
    room_[at % N] = p;
    head_.store(at + 1, std::memory_order_release);
    return true;
  }
  T* pop() noexcept {
    const std::size_t at = tail_.load(std::memory_order_relaxed);
    if (at == head_.load(std::memory_order_acquire)) return nullptr;
    T* const p = room_[at % N];
    tail_.store(at + 1, std::memory_order_release);
    return p;
  }

 private:
  std::array<T*, N> room_{};
  alignas(64) std::atomic<std::size_t> head_{0};
  alignas(64) std::atomic<std::size_t> tail_{0};
};

class FlightControl final : public Control {
 public:
  explicit FlightControl(Flight::Impl& flight);
  ~FlightControl() override;

  /// [tick] Between two ticks. Applies a bounded number of commands, so that a flood does not delay the loop.
  /// Returns false when one of them allocates and is allowed on the ground alone: a swap, a reset.
  bool apply() noexcept;
  /// [tick] Paused: no tick may begin. `apply` is called repeatedly meanwhile.
  bool stands() const noexcept { return clock_.paused && clock_.left == 0; }
  /// [tick] Paused, also during requested single ticks: nothing waits for the clock.
  bool paused() const noexcept { return clock_.paused; }
  /// [tick] One more tick has been flown, and noted.
  void ticked() noexcept;
  /// [tick] State of the flight for `view`.
  void note(int phase, std::int64_t now_ns, bool armed) noexcept;
  void note_unit(std::size_t component, const Unit& unit) noexcept;
  /// The flight is over: rejects new commands and answers all pending ones.
  void end();

  FlightView view() const override;
  void set_parameter(const std::string& component, const std::string& param, const std::string& text,
                     Answer answer) override;
  void request(const std::string& component, const std::string& port, std::vector<std::byte> message,
               Answer answer) override;
  bool publish(const std::string& component, const std::string& port,
               std::vector<std::byte> message) override;
  void enter_phase(const std::string& phase, Answer answer) override;
  void swap(const std::string& component, const std::string& file, Answer answer) override;
  void reset_guards(Answer answer) override;
  void pace(const PaceOrder& order, Answer answer) override;
  void on_parameter(std::function<void(const std::string&, const std::string&)> changed) override;
  std::uint64_t lost_samples() const override { return lost_samples_.load(std::memory_order_relaxed); }

 private:
  struct Waiting;
  struct Directory;
  static constexpr std::size_t max_waiting = 1024, max_per_tick = 32, max_of_import = 64;

  void send(Command command, Answer answer);
  bool take(Waiting& waiting) noexcept;
  bool apply(Waiting& waiting);
  bool apply_pace(Waiting& waiting);
  void end_steps() noexcept;
  void go_on() noexcept;
  void enqueue(std::unique_ptr<Waiting> waiting);
  bool refuse(Waiting& waiting, const char* why) noexcept;
  void done(Waiting& waiting) noexcept;
  std::shared_ptr<const Directory> directory() const;
  void run() noexcept;
  void answer_done();

  struct Queues {
    PointerQueue<Waiting, max_waiting> in, samples;  // samples do not delay a parameter
    PointerQueue<Waiting, 2 * max_waiting> out;
  };
  /// Loop only: requests without room yet, in their order.
  struct Held {
    std::array<Waiting*, max_waiting> list{};
    std::size_t count = 0;
    bool grounded = false;  // a command that is allowed on the ground alone was executed
  };
  /// State of the flight, written by the loop.
  struct Seen {
    explicit Seen(std::size_t count) : components(std::make_unique<Component[]>(count)) {}
    std::atomic<int> phase{0};
    std::atomic<std::int64_t> now_ns{0};
    std::atomic<bool> armed{false}, paused{false};
    std::atomic<double> speed{1};
    struct Component {
      std::atomic<bool> active{false}, stopped{false};
      std::atomic<std::uint64_t> steps{0};
      std::atomic<double> step_us{0}, step_max_us{0};
    };
    std::unique_ptr<Component[]> components;
  };
  /// Loop only: the pause of flight time.
  struct Clock {
    bool paused = false;
    std::uint64_t left = 0;      // ticks to fly despite the pause
    Waiting* stepper = nullptr;  // its sender
  };
  /// All commands that wait to be applied or answered.
  struct Account {
    std::map<Waiting*, std::unique_ptr<Waiting>> all;
    std::size_t samples = 0;             // of the pending commands
    std::vector<std::size_t> of_import;  // samples per import
  };

  Flight::Impl& flight_;
  Queues queues_;
  Held held_;
  Clock clock_;
  Seen seen_;
  std::atomic<bool> over_{false}, stop_{false};
  std::atomic<std::uint64_t> lost_samples_{0};

  mutable std::mutex mutex_;  // not used by the loop; guards the following members
  std::shared_ptr<const Directory> directory_;
  std::vector<std::vector<ParamValue>> base_;  // values that the loop has applied
  Account waiting_;
  std::vector<std::function<void(const std::string&, const std::string&)>> changed_;
  std::thread thread_;
};

}  // namespace fulmar::core

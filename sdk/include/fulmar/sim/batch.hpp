// SPDX-License-Identifier: BSD-3-Clause
// Many aircraft, stepped in one call by several threads. Arrays are row-major, one row per aircraft: actions
// N x 4, rows N x 26 (simulation.hpp). Aircraft are independent: the number of threads changes no bit of the
// result.
#pragma once
#include <algorithm>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <span>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "fulmar/random.hpp"
#include "fulmar/sim/messages.hpp"
#include "fulmar/sim/simulation.hpp"

namespace fulmar::sim {

/// Many simulations in one call. Throws std::invalid_argument for wrong sizes, actions or steps.
class Batch {
 public:
  /// Aircraft `i` has the seed mix_seed(seed, i). `threads` is at least 1, and includes the calling thread.
  Batch(const Airframe& a, std::size_t count, const SimulationOptions& options = {}, std::uint64_t seed = 1,
        unsigned threads = 1) {
    if (count == 0) throw std::invalid_argument(sim_messages::batch_empty().line());
    if (threads == 0 || threads > 256)
      throw std::invalid_argument(sim_messages::batch_threads_invalid(threads).line());
    all_.reserve(count);
    for (std::size_t i = 0; i < count; ++i) all_.emplace_back(a, options, mix_seed(seed, i));
    try {
      for (unsigned t = 1; t < threads; ++t) helpers_.emplace_back([this, t] { help(t); });
    } catch (...) {  // no more threads available: the running ones must end
      join();
      throw;
    }
  }
  ~Batch() { join(); }
  Batch(const Batch&) = delete;
  Batch& operator=(const Batch&) = delete;

  std::size_t size() const { return all_.size(); }
  Simulation& operator[](std::size_t i) { return all_[i]; }
  const Simulation& operator[](std::size_t i) const { return all_[i]; }

  /// `steps` steps of `dt_s` with these actions, then the rows. If it throws, no aircraft has moved.
  void step(std::span<const double> actions, double dt_s, unsigned steps, std::span<double> rows) {
    demand(actions.size(), action_columns, "actions");
    demand(rows.size(), row_columns, "rows");
    for (std::size_t k = 0; k < actions.size(); ++k)
      if (!std::isfinite(actions[k]))
        throw std::invalid_argument("aircraft " + std::to_string(k / action_columns) + ": " +
                                    Simulation::validation_error(action(&actions[k - k % action_columns])));
    Simulation::demand_step(dt_s);
    work_ = {actions.data(), rows.data(), dt_s, steps};
    {
      const std::lock_guard lock(mutex_);
      ++round_;
      busy_ = helpers_.size();
    }
    begin_.notify_all();
    share(0);
    std::unique_lock lock(mutex_);
    end_.wait(lock, [&] { return busy_ == 0; });
  }
  void rows(std::span<double> out) const {
    demand(out.size(), row_columns, "rows");
    for (std::size_t i = 0; i < all_.size(); ++i) write_row(all_[i], &out[i * row_columns]);
  }

 private:
  struct Work {
    const double* actions = nullptr;
    double* rows = nullptr;
    double dt_s = 0;
    unsigned steps = 0;
  };

  void join() {
    {
      const std::lock_guard lock(mutex_);
      over_ = true;
    }
    begin_.notify_all();
    for (std::thread& t : helpers_) t.join();
  }

  static Actuators action(const double* a) { return {a[0], a[1], a[2], a[3]}; }

  void demand(std::size_t found, std::size_t columns, const char* what) const {
    if (found != all_.size() * columns)
      throw std::invalid_argument(
          located(what, sim_messages::number_count_invalid(all_.size(), columns, found)).line());
  }

  /// The part of thread `t`: contiguous, so that two threads share a cache line only at its ends.
  void share(std::size_t t) {
    const std::size_t threads = helpers_.size() + 1, n = all_.size();
    for (std::size_t i = n * t / threads; i < n * (t + 1) / threads; ++i) {
      const Actuators command = action(work_.actions + i * action_columns);
      for (unsigned k = 0; k < work_.steps; ++k) all_[i].step(command, work_.dt_s);
      write_row(all_[i], work_.rows + i * row_columns);
    }
  }

  void help(std::size_t t) {
    for (std::uint64_t done = 0;;) {
      {
        std::unique_lock lock(mutex_);
        begin_.wait(lock, [&] { return over_ || round_ != done; });
        if (over_) return;
        done = round_;
      }
      share(t);
      const std::lock_guard lock(mutex_);
      if (--busy_ == 0) end_.notify_one();
    }
  }

  std::vector<Simulation> all_;
  std::vector<std::thread> helpers_;
  Work work_;
  std::mutex mutex_;
  std::condition_variable begin_, end_;
  std::uint64_t round_ = 0;
  std::size_t busy_ = 0;
  bool over_ = false;
};

}  // namespace fulmar::sim

// SPDX-License-Identifier: BSD-3-Clause
// A flight that only stores its input. Answers come from a separate thread, as in a real flight.
#pragma once
#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/tap/control.hpp"

namespace fulmar::core::test {

class MockControl : public Control {
 public:
  FlightView flight;
  std::vector<std::vector<std::byte>> published;  // guarded by mutex

  MockControl() : thread_([this] { answer_all(); }) {}
  ~MockControl() override {
    {
      const std::lock_guard lock(mutex);
      stop_ = true;
    }
    wake_.notify_one();
    thread_.join();
  }

  mutable std::mutex mutex;

  std::vector<std::vector<std::byte>> requested() const {
    const std::lock_guard lock(mutex);
    return requested_;
  }
  /// "slc.roll_kp=0.6"
  std::vector<std::string> parameters_set() const {
    const std::lock_guard lock(mutex);
    return set_;
  }
  void refuse_requests(const std::string& reason) {
    const std::lock_guard lock(mutex);
    refusal_ = reason;
  }

  FlightView view() const override {
    const std::lock_guard lock(mutex);
    return flight;
  }
  void set_parameter(const std::string& component, const std::string& param, const std::string& text,
                     Answer answer) override {
    const std::lock_guard lock(mutex);
    for (ComponentView& c : flight.components) {
      for (ParameterView& p : c.params) {
        if (c.name != component || p.info.name != param) continue;
        if (!p.info.live) throw Error("mock.parameter_fixed(" + component + "." + param + ")");
        if (p.info.kind == FULMAR_NUMBER) p.base.number[0] = std::stod(text);
        set_.push_back(component + "." + param + "=" + text);
        work_.emplace_back([this, component, param, answer] {
          answer("");
          for (const auto& reported : changed_) reported(component, param);
        });
        wake_.notify_one();
        return;
      }
    }
    throw Error("there is no " + component + "." + param);
  }
  void request(const std::string&, const std::string&, std::vector<std::byte> message,
               Answer answer) override {
    const std::lock_guard lock(mutex);
    requested_.push_back(std::move(message));
    work_.emplace_back([reason = refusal_, answer] { answer(reason); });
    wake_.notify_one();
  }
  bool publish(const std::string& component, const std::string& port,
               std::vector<std::byte> message) override {
    const std::lock_guard lock(mutex);
    if (component != "follow" || port != "leader") throw Error("not an input");
    published.push_back(std::move(message));
    return true;
  }
  void enter_phase(const std::string&, Answer) override {}
  void swap(const std::string&, const std::string&, Answer) override {}
  void reset_guards(Answer) override {}
  void pace(const PaceOrder&, Answer) override {}
  void on_parameter(std::function<void(const std::string&, const std::string&)> changed) override {
    changed_.push_back(std::move(changed));
  }
  std::uint64_t lost_samples() const override { return 0; }

 private:
  void answer_all() {
    std::unique_lock lock(mutex);
    while (!stop_) {
      wake_.wait(lock, [this] { return stop_ || !work_.empty(); });
      while (!work_.empty()) {
        const auto job = std::move(work_.front());
        work_.pop_front();
        lock.unlock();
        job();
        lock.lock();
      }
    }
  }

  std::vector<std::vector<std::byte>> requested_;
  std::vector<std::string> set_;
  std::string refusal_;
  std::condition_variable wake_;
  std::deque<std::function<void()>> work_;
  std::vector<std::function<void(const std::string&, const std::string&)>> changed_;
  bool stop_ = false;
  std::thread thread_;
};

}  // namespace fulmar::core::test

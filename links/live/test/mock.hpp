// SPDX-License-Identifier: BSD-3-Clause
// A flight for tests: two components, a ring, a control that stores its input and answers in a separate
// thread.
#pragma once
#include <algorithm>
#include <atomic>
#include <cmath>
#include <condition_variable>
#include <deque>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/tap/control.hpp"
#include "core/tap/tap.hpp"
#include "core/types/test/types.hpp"

namespace fulmar::core::test {

/// Parameters are texts of numbers between 0 and 2, except slc.law (a choice), slc.note (a text) and slc.wind
/// (a vector).
class MockControl : public Control {
 public:
  MockControl() : thread_([this] { answer(); }) {}
  ~MockControl() override {
    {
      const std::lock_guard lock(mutex_);
      stop_ = true;
    }
    ready_.notify_one();
    thread_.join();
  }

  FlightView view() const override {
    const std::lock_guard lock(mutex_);
    FlightView v;
    v.mission = "mock <1>";
    v.io = "sim";
    v.phase.now = "cruise";
    v.phase.all = {"hold", "cruise"};
    v.pace.paused = paused;
    v.seed = 18'000'000'000'000'000'001u;
    v.origin = Geodetic{40.25, -111.65, 1387};
    v.map.tiles = "https://a.b/{z}/{x}/{y}";
    v.map.attribution = "Example";
    v.epoch_ns = 1'767'225'600'000'000'000;
    v.components = {controller(), planner()};
    return v;
  }

  void set_parameter(const std::string& component, const std::string& param, const std::string& text,
                     Answer answer) override {
    if (component != "slc")
      throw Error("mock.component_unknown(" + component + ", " + choices_text(component, {"slc", "plan"}) +
                  ")");
    if (param == "roll_kp" && (text.find_first_not_of("0123456789.e-") != std::string::npos))
      throw Error("mock.number_invalid(" + text + ")");
    note("set " + component + "." + param + " " + text);
    work([this, param, text, answer = std::move(answer)] {
      ++sets;
      const bool wrong = param == "roll_kp" && std::stod(text) > 2;
      if (!wrong) {
        const std::lock_guard lock(mutex_);
        values_[param] = text;
      }
      answer(wrong ? text + " is outside 0 .. 2 rad/rad" : "");
      if (!wrong && changed_) changed_("slc", param);
    });
  }
  void request(const std::string& component, const std::string& port, std::vector<std::byte> message,
               Answer answer) override {
    note("request " + component + "." + port);
    const auto* const leg = reinterpret_cast<const Leg*>(message.data());
    const bool bare_orbit = leg->kind == 1 && !leg->has_course;
    take(std::move(message));
    work([answer = std::move(answer), bare_orbit] { answer(bare_orbit ? "no orbits here" : ""); });
  }
  bool publish(const std::string& component, const std::string& port,
               std::vector<std::byte> message) override {
    note("publish " + component + "." + port);
    take(std::move(message));
    return true;
  }
  void enter_phase(const std::string& phase, Answer answer) override {
    note("phase " + phase);
    work([answer = std::move(answer), phase] { answer(phase == "hold" ? "" : "there is no such phase"); });
  }
  void swap(const std::string& component, const std::string& file, Answer answer) override {
    note("swap " + component + " " + file);
    work([answer = std::move(answer)] { answer("mock.vehicle_armed"); });
  }
  void reset_guards(Answer answer) override {
    note("reset");
    work([answer = std::move(answer)] { answer(""); });
  }
  void pace(const PaceOrder& order, Answer answer) override {
    static constexpr const char* words[] = {"pause", "resume", "step", "speed", "restart"};
    using What = PaceOrder::What;
    note(words[static_cast<std::size_t>(order.what)] +
         (order.what == What::step    ? " " + std::to_string(order.ticks)
          : order.what == What::speed ? " " + speed_text(order.speed)
          : order.seed                ? " " + std::to_string(*order.seed)
                                      : std::string()));
    work([this, what = order.what, answer = std::move(answer)] {
      const bool twice = what == What::pause && paused.exchange(true);
      if (what == What::resume || what == What::speed) paused = false;
      answer(twice ? "mock.paused_already" : "");
    });
  }
  void on_parameter(std::function<void(const std::string&, const std::string&)> changed) override {
    changed_ = std::move(changed);
  }
  std::uint64_t lost_samples() const override { return 0; }

  std::vector<std::string> received() const {
    const std::lock_guard lock(mutex_);
    return heard_;
  }
  std::vector<std::byte> message() const {
    const std::lock_guard lock(mutex_);
    return message_;
  }
  std::atomic<std::uint64_t> sets{0};
  std::atomic<bool> paused{false};

 private:
  static ParameterView number(std::string name, double value) {
    ParameterView p;
    p.info.name = std::move(name);
    p.info.unit = "rad/rad";
    p.info.doc = "aileron per \"roll\" error";
    p.info.live = true;
    p.info.min = 0;
    p.info.max = 2;
    p.base.number[0] = value;
    return p;
  }
  ComponentView controller() const {
    ComponentView c;
    c.name = "slc";
    c.use = "control_slc/Outer";
    c.role = "outer";
    c.run = "tick";
    c.active = true;
    c.steps = 42;
    c.step_us = 3.5;
    c.step_max_us = 9;
    c.budget_us = 250;
    c.params = {number("roll_kp", values_.contains("roll_kp") ? std::stod(values_.at("roll_kp")) : 0.55),
                number("law", 0),
                number("note", 0),
                number("wind", 3),
                number("count", 0),
                number("on", 0)};
    c.params[1].info.kind = FULMAR_CHOICE;
    c.params[1].info.choices = {"climb", "takeoff"};
    c.params[1].base.integer = values_.contains("law") ? 1 : 0;
    c.params[1].overlaid = true;
    c.params[2].info.kind = FULMAR_STRING;
    c.params[2].base.text = "40 deg";
    c.params[3].info.kind = FULMAR_VECTOR;
    c.params[3].base.number[1] = -4;
    c.params[3].info.min = -50;
    c.params[3].info.max = 50;
    c.params[4].info.kind = FULMAR_COUNT;
    c.params[4].base.integer = 7;
    c.params[4].info.max = 100;
    c.params[5].info.kind = FULMAR_FLAG;
    c.params[5].base.integer = 1;
    c.inputs = {{"plan", mixed_type(), "plan.mixed", -1, false, false}};
    c.outputs = {{"leg", leg_type(), "", 1, false, false}};
    return c;
  }
  static ComponentView planner() {
    ComponentView c;
    c.name = "plan";
    c.use = "path/Planner";
    c.inputs = {{"add_leg", leg_type(), "", 2, true, false}, {"edits", mixed_type(), "", -1, false, true}};
    c.outputs = {{"mixed", mixed_type(), "", 0, false, false}};
    return c;
  }

  void note(std::string what) {
    const std::lock_guard lock(mutex_);
    if (heard_.size() < 1000) heard_.push_back(std::move(what));
  }
  void take(std::vector<std::byte> message) {
    const std::lock_guard lock(mutex_);
    message_ = std::move(message);
  }
  void work(std::function<void()> task) {
    {
      const std::lock_guard lock(mutex_);
      tasks_.push_back(std::move(task));
    }
    ready_.notify_one();
  }
  void answer() {
    std::unique_lock lock(mutex_);
    for (;;) {
      ready_.wait(lock, [this] { return stop_ || !tasks_.empty(); });
      if (stop_) return;
      const auto task = std::move(tasks_.front());
      tasks_.pop_front();
      lock.unlock();
      task();
      lock.lock();
    }
  }

  mutable std::mutex mutex_;
  std::condition_variable ready_;
  std::deque<std::function<void()>> tasks_;
  bool stop_ = false;
  std::map<std::string, std::string> values_;
  std::vector<std::string> heard_;
  std::vector<std::byte> message_;
  std::function<void(const std::string&, const std::string&)> changed_;
  std::thread thread_;
};

inline std::vector<TapChannel> mock_channels() {
  return {{"/plan/mixed", mixed_type()},
          {"/slc/leg", leg_type()},
          {"/plan/add_leg", leg_type()},
          {"/fulmar/ticks", make_type("Ticks", 8, 8, {scalar("first", FULMAR_U64, 0, 8)})}};
}

/// The loop's part: one tick at flight time i * 2.5 ms. The value of every sample follows from i.
inline void mock_tick(Tap& tap, int i) {
  const std::int64_t now = i * 2'500'000LL;
  if (tap.wanted(0, now)) {
    Mixed m = mixed_value();
    m.speed_mps = i * 0.5;
    m.stamp_ns = now;
    m.legs.count = static_cast<std::uint32_t>(i % 4);
    tap.write(0, now, now, bytes_of(m), false);
  }
  if (tap.wanted(1, now)) {
    const Leg leg{1, true, i * 0.001, {1, 2, 3}};
    tap.write(1, now, now, bytes_of(leg), false);
  }
  const auto first = static_cast<std::uint64_t>(i);
  if (i % 40 == 0 && tap.wanted(3, now)) tap.write(3, now, now, bytes_of(first), false);
}

}  // namespace fulmar::core::test

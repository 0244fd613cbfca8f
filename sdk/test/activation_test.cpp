// SPDX-License-Identifier: BSD-3-Clause
// Arguments of `activate`, from the host and from the bench.
#include <doctest/doctest.h>

#include <vector>

#include "sdk/test/everything.hpp"

namespace activation_test {

using namespace fulmar;
using plugin_test::Everything;

namespace {

/// Records at a switch if a component flew before, and its outputs.
struct Successor {
  struct Inputs {};
  struct Outputs {
    Actuators actuators;
    Out<AttitudeCommand> wish;
    OutQueue<PlanEdit, 2> made;
    Actuators spare;
  };
  struct Params {};
  Status activate(const Tick&, const Inputs&, const Params&, const Applied<Outputs>& last) {
    given = last.given();
    had_actuators = last.has(last->actuators);
    had_wish = last.has(last->wish);
    had_made = last.has(last->made);
    had_spare = last.has(last->spare);
    aileron_rad = last->actuators.aileron_rad;
    return given ? Status::ok : Status::degraded;
  }
  Status step(const Tick&, const Inputs&, const Params&, Outputs&) { return Status::ok; }
  bool given = false, had_actuators = false, had_wish = false, had_made = false, had_spare = false;
  double aileron_rad = 0;
};

}  // namespace

TEST_CASE("parameters arrive in configure and retune, the last outputs in activate") {
  Bench<Everything> bench;
  bench.params.roll_kp.value = 0.7;
  REQUIRE(bench.configure() == Status::ok);
  CHECK(bench.component().configured == 0.7);
  bench.params.roll_kp.value = 0.9;
  REQUIRE(bench.retune() == Status::ok);
  CHECK(bench.component().configured == 0.9);
  Everything::Outputs last;
  last.actuators.aileron_rad = 0.25;
  REQUIRE(bench.activate(last) == Status::ok);
  CHECK(bench.component().taken_over == 0.25);
}

TEST_CASE("activated with nothing to go on from, a component does not get what was handed over before") {
  const fulmar_component c = detail::component_entry<Everything>();
  fulmar_error error{};
  void* instance = c.create(1, &error);
  REQUIRE(instance != nullptr);
  const std::vector<fulmar_input> in(c.input_count);
  std::vector<fulmar_input> last(c.output_count);
  const fulmar_tick tick{};
  Actuators actuators;
  actuators.aileron_rad = 0.25;
  last[0].data = &actuators;
  const auto& component = static_cast<detail::Instance<Everything>*>(instance)->component;
  REQUIRE(c.activate(instance, &tick, in.data(), last.data(), &error) == FULMAR_OK);
  CHECK(component.taken_over == 0.25);
  last[0].data = nullptr;
  REQUIRE(c.activate(instance, &tick, in.data(), last.data(), &error) == FULMAR_OK);
  CHECK(component.taken_over == 0);
  c.destroy(instance);
}

TEST_CASE(
    "activated by the host, it sees whether a component flew and its outputs: zeros are a command too") {
  const fulmar_component c = detail::component_entry<Successor>();
  REQUIRE((c.activate != nullptr));
  fulmar_error error{};
  void* instance = c.create(1, &error);
  REQUIRE(instance != nullptr);
  std::vector<fulmar_input> last(c.output_count);
  const fulmar_tick tick{};
  const auto& component = static_cast<detail::Instance<Successor>*>(instance)->component;
  CHECK(c.activate(instance, &tick, nullptr, last.data(), &error) == FULMAR_DEGRADED);
  CHECK_FALSE(component.given);
  const Actuators glide, other{0.5, 0.25, 0, 0};
  last[3].data = &glide;
  CHECK(c.activate(instance, &tick, nullptr, last.data(), &error) == FULMAR_OK);
  CHECK(component.given);
  CHECK(component.had_spare);
  CHECK_FALSE(component.had_actuators);
  CHECK_FALSE(component.had_wish);
  CHECK_FALSE(component.had_made);
  const AttitudeCommand wish;
  last[0].data = &other;
  last[1].data = &wish;
  last[3].data = nullptr;
  CHECK(c.activate(instance, &tick, nullptr, last.data(), &error) == FULMAR_OK);
  CHECK(component.had_actuators);
  CHECK(component.had_wish);
  CHECK_FALSE(component.had_spare);
  CHECK(component.aileron_rad == 0.25);
  last = std::vector<fulmar_input>(c.output_count);
  CHECK(c.activate(instance, &tick, nullptr, last.data(), &error) ==
        FULMAR_DEGRADED);  // no memory of the time before
  CHECK_FALSE(component.had_actuators);
  CHECK(component.aileron_rad == 0);
  c.destroy(instance);
}

TEST_CASE("the bench activates after no component, after one, and after one that made some of the outputs") {
  Bench<Successor> bench;
  const auto& component = bench.component();
  CHECK(bench.activate() == Status::degraded);
  CHECK_FALSE(component.given);
  CHECK(bench.activate(Successor::Outputs{}) == Status::ok);
  CHECK(component.had_actuators);
  CHECK(component.had_wish);
  CHECK(component.had_made);
  CHECK(component.had_spare);
  CHECK(bench.activate({}) == Status::ok);
  Applied<Successor::Outputs> last;
  last.made_bits = 0b0010;
  CHECK(bench.activate(last) == Status::ok);
  CHECK(component.had_wish);
  CHECK_FALSE(component.had_actuators);
  CHECK_FALSE(component.had_spare);

  Bench<Everything> old;  // has the older signature, with outputs alone: unchanged
  Everything::Outputs outputs;
  outputs.actuators.aileron_rad = 0.5;
  REQUIRE(old.activate(outputs) == Status::ok);
  CHECK(old.component().taken_over == 0.5);
  REQUIRE(old.activate() == Status::ok);
  CHECK(old.component().taken_over == 0);
  REQUIRE(old.activate(Applied<Everything::Outputs>::all(outputs)) == Status::ok);
  CHECK(old.component().taken_over == 0.5);
}

TEST_CASE("what was applied reads as the outputs themselves") {
  Successor::Outputs outputs;
  outputs.spare.rudder_rad = 0.125;
  const auto last = Applied<Successor::Outputs>::all(outputs);
  CHECK(last.made_bits == 0b1111);
  const Successor::Outputs& plain = last;
  CHECK(plain.spare.rudder_rad == 0.125);
  CHECK(last->spare.rudder_rad == 0.125);
  CHECK_FALSE(last.has(outputs.spare));  // member of another struct
}

}  // namespace activation_test

// SPDX-License-Identifier: BSD-3-Clause
// A component through the interface of the host: tables, thunks, exceptions, parameters; and the bench for
// authors.
#include <doctest/doctest.h>

#include <stdexcept>
#include <string>
#include <vector>

#define FULMAR_COUNT_ALLOCATIONS
#include "fulmar/msg/actuators.hpp"
#include "fulmar/msg/attitude_command.hpp"
#include "fulmar/msg/plan_edit.hpp"
#include "fulmar/msg/vehicle_state.hpp"
#include "fulmar/testing.hpp"
#include "sdk/test/everything.hpp"

namespace plugin_test {

using namespace fulmar;

namespace {

struct Seeded {
  struct Inputs {};
  struct Outputs {
    Probe seed_ratio;
  };
  struct Params {};
  explicit Seeded(std::uint64_t seed) : seed_(seed) {}
  Status step(const Tick&, const Inputs&, const Params&, Outputs& out) {
    out.seed_ratio = static_cast<double>(seed_);
    return Status::ok;
  }

 private:
  std::uint64_t seed_;
};

struct Clockwork {
  struct Inputs {
    Optional<Actuators> actuators;
  };
  struct Outputs {
    Out<VehicleState> truth;
  };
  struct Params {};
  Status read(Tick& tick, const Params&, Outputs& out) {
    tick.now_ns += 2'500'000;
    out.truth.publish({});
    return Status::ok;
  }
  Status write(const Tick&, const Inputs&, const Params&) { return Status::ok; }
};

}  // namespace

TEST_CASE("ports and parameters appear in the table under their own names") {
  constexpr fulmar_component c = detail::component_entry<Everything>();
  CHECK(std::string(c.name) == "Everything");
  CHECK(std::string(c.doc) == "every kind of port");
  REQUIRE(c.input_count == 4);
  CHECK(std::string(c.inputs[0].name) == "state");
  CHECK(c.inputs[0].kind == FULMAR_IN_VALUE);
  CHECK(c.inputs[0].flags == 0);
  CHECK(c.inputs[1].flags == FULMAR_PORT_OPTIONAL);
  CHECK(c.inputs[2].kind == FULMAR_IN_QUEUE);
  CHECK(c.inputs[3].kind == FULMAR_IN_REQUEST);
  REQUIRE(c.output_count == 4);
  CHECK(c.outputs[0].kind == FULMAR_OUT_VALUE);
  CHECK(c.outputs[1].kind == FULMAR_OUT_EVENT);
  CHECK(c.outputs[2].kind == FULMAR_OUT_QUEUE);
  CHECK(c.outputs[2].capacity == 2);
  CHECK(c.outputs[3].kind == FULMAR_OUT_PROBE);
  CHECK(c.outputs[3].type == nullptr);
  REQUIRE(c.param_count == 9);
  CHECK(std::string(c.params[0].name) == "roll_kp");
  CHECK(std::string(c.params[0].unit) == "rad/rad");
  CHECK(c.params[0].initial[0] == 0.5);
  CHECK(c.params[0].max == 2);
  CHECK((c.params[0].flags & FULMAR_LIVE) != 0);
  CHECK((c.params[8].flags & FULMAR_LIVE) == 0);
  CHECK(std::string(c.params[3].choices[1]) == "takeoff");
  CHECK(std::string(c.params[4].initial_text) == "abc");
  CHECK(c.params[5].initial[1] == -4);
  CHECK(static_cast<const Gains*>(c.params[6].initial_data)->roll_ratio == 1);
  CHECK(c.flags == 0);
  CHECK((c.step != nullptr));
  CHECK((c.read == nullptr));
}

TEST_CASE("a vehicle has read and write in place of step") {
  constexpr fulmar_component c = detail::component_entry<Clockwork>();
  CHECK(c.flags == FULMAR_VEHICLE);
  CHECK((c.step == nullptr));
  CHECK((c.activate == nullptr));
  Bench<Clockwork> bench;
  CHECK(bench.read() == Status::ok);
  CHECK(bench.tick.now_ns == 2'500'000);
  CHECK(bench.out.truth.written);
}

TEST_CASE("a step reads inputs, answers requests and publishes") {
  Bench<Everything> bench;
  VehicleState state;
  state.roll_rad = 0.1;
  AttitudeCommand attitude;
  attitude.roll_rad = 0.5;
  PlanEdit edit;
  bench.set(bench.in.state, state);
  bench.set(bench.in.attitude, attitude);
  edit.index = 2;
  bench.push(bench.in.edit, edit);
  edit.index = 9;
  bench.push(bench.in.edit, edit);
  for (int i = 0; i < 3; ++i) bench.push(bench.in.edits, edit);
  REQUIRE(bench.step(0.01) == Status::ok);
  CHECK(bench.out.actuators.aileron_rad == doctest::Approx(0.2));
  CHECK(bench.out.roll_error_rad.value == doctest::Approx(-0.1));
  CHECK(bench.out.wish.written);
  CHECK(bench.out.wish.valid_at_ns == bench.tick.now_ns - 5);
  CHECK(bench.out.made.count == 2);
  CHECK(bench.out.made.lost == 1);
  CHECK(bench.answer(bench.in.edit, 0) == "accepted");
  CHECK(bench.answer(bench.in.edit, 1) == "there is no waypoint 9");
  CHECK(bench.component().last_dt == doctest::Approx(0.01));

  REQUIRE(bench.step(0.02) ==
          Status::ok);  // without new samples the event stays silent, and queues are empty
  CHECK_FALSE(bench.out.wish.written);
  CHECK(bench.out.made.count == 0);
  CHECK(bench.component().last_dt == doctest::Approx(0.02));
}

TEST_CASE("a text takes a text of another length") {
  const Text<8> name = "aileron";
  const Text<96> words = name;
  CHECK(words.view() == "aileron");
  Text<4> cut;
  cut = words;
  CHECK(cut.view() == "ail");
}

TEST_CASE("a reason that is too long ends in dots, behind a whole word or a whole character") {
  Bench<Everything> bench;
  bench.set(bench.in.state, VehicleState{});
  PlanEdit edit;
  edit.index = 100;
  bench.push(bench.in.edit, edit);
  edit.index = 101;
  bench.push(bench.in.edit, edit);
  REQUIRE(bench.step(0.01) == Status::ok);
  const std::string cut = bench.answer(bench.in.edit, 0), word = bench.answer(bench.in.edit, 1);
  CHECK(cut.size() > 110);
  CHECK(cut.size() < 124);
  CHECK(cut.ends_with("..."));
  CHECK(long_reason[cut.size() - 3] == ' ');
  CHECK(long_reason.starts_with(cut.substr(0, cut.size() - 3)));
  CHECK(word == long_word.substr(0, 120) + "...");  // 60 letters of two bytes
}

TEST_CASE("what a component throws arrives as text, and nothing crosses") {
  Bench<Everything> bench;
  VehicleState state;
  state.roll_rad = 3.1;
  bench.set(bench.in.state, state);
  CHECK(bench.step(0.01) == Status::failed);
  CHECK(bench.error() == "upside down");
  bench.params.n.value = 7;
  CHECK(bench.configure() == Status::failed);
  CHECK(bench.error() == "seven is unlucky");
}

namespace {

struct Wordless : std::exception {
  const char* what() const noexcept override { return nullptr; }
};
struct Empty : std::exception {
  const char* what() const noexcept override { return ""; }
};
[[noreturn]] void throw_something() { throw std::runtime_error("there are no words"); }
struct Failing : std::exception {
  const char* what() const noexcept override { throw_something(); }
};

enum class Place { nowhere, constructor, configure, activate, step };
Place thrown_in = Place::nowhere;
int kind_thrown = 0;

/// Throws an exception without a message at the place `thrown_in`.
struct Odd {
  struct Inputs {};
  struct Outputs {
    Probe steps_ratio;
  };
  struct Params {};
  Odd() { pass(Place::constructor); }
  void configure(const Params&) { pass(Place::configure); }
  Status activate(const Tick&, const Inputs&, const Params&, const Outputs&) { return pass(Place::activate); }
  Status step(const Tick&, const Inputs&, const Params&, Outputs&) { return pass(Place::step); }

  static Status pass(Place here) {
    if (here != thrown_in) return Status::ok;
    if (kind_thrown == 0) throw Wordless();
    if (kind_thrown == 1) throw Empty();
    throw Failing();
  }
};

/// The first call that fails, and its text.
std::pair<Place, std::string> first_failure() {
  const fulmar_component c = detail::component_entry<Odd>();
  fulmar_error error{};
  const fulmar_tick tick{};
  double probe = 0;
  fulmar_input last{};
  fulmar_output out{};
  out.data = &probe;
  void* const instance = c.create(1, &error);
  if (!instance) return {Place::constructor, error.text};
  Place failed = Place::nowhere;
  if (c.configure(instance, nullptr, &error) == FULMAR_FAILED)
    failed = Place::configure;
  else if (c.activate(instance, &tick, nullptr, &last, &error) == FULMAR_FAILED)
    failed = Place::activate;
  else if (c.step(instance, &tick, nullptr, &out, &error) == FULMAR_FAILED)
    failed = Place::step;
  c.destroy(instance);
  return {failed, error.text};
}

}  // namespace

TEST_CASE(
    "an exception without a message, or whose message throws, fails its call and is named by its type") {
  const std::terminate_handler before = std::get_terminate();
  const char* const types[] = {"Wordless", "Empty", "Failing"};
  for (const Place place : {Place::constructor, Place::configure, Place::activate, Place::step})
    for (kind_thrown = 0; kind_thrown < 3; ++kind_thrown) {
      CAPTURE(static_cast<int>(place));
      CAPTURE(kind_thrown);
      thrown_in = place;
      const auto failure = first_failure();
      const std::string text = failure.second;
      CHECK(failure.first == place);
      CHECK_MESSAGE(text.find(types[kind_thrown]) != std::string::npos, text);
      CHECK(std::uncaught_exceptions() == 0);
      CHECK_FALSE(std::current_exception());
    }
  thrown_in = Place::nowhere;
  CHECK(first_failure().first == Place::nowhere);
  CHECK((std::get_terminate() == before));
}

TEST_CASE("values of every kind cross into Params") {
  const fulmar_component c = detail::component_entry<Everything>();
  fulmar_error error{};
  void* instance = c.create(1, &error);
  REQUIRE(instance != nullptr);
  std::vector<fulmar_value> v(c.param_count);
  v[0].number[0] = 1.25;
  v[1].integer = 0;
  v[2].integer = 4;
  v[3].integer = 1;
  v[4].text = "longer than eight";
  v[5].number[0] = 1;
  v[5].number[1] = 2;
  v[5].number[2] = 3;
  const Gains gains{6};
  v[6].data = &gains;
  v[6].size = sizeof gains;
  v[6].integer = 1;
  const char bytes[] = "xyz";
  v[7].data = bytes;
  v[7].size = 3;
  v[7].text = "table.bin";
  v[8].number[0] = 5;
  REQUIRE(c.configure(instance, v.data(), &error) == FULMAR_OK);
  const Everything::Params& p = static_cast<detail::Instance<Everything>*>(instance)->params;
  CHECK(p.roll_kp == 1.25);
  CHECK_FALSE(p.on);
  CHECK(p.n == 4);
  CHECK(p.law == Law::takeoff);
  CHECK(p.word.view() == "longer ");
  CHECK(p.wind.value == Vec3<Ned>{1, 2, 3});
  CHECK(p.gains->roll_ratio == 6);
  CHECK(p.gains.given());
  CHECK(p.table.size == 3);
  CHECK(p.mass == 5);
  v[6].data = nullptr;  // retune does not change records
  REQUIRE(c.retune(instance, v.data(), &error) == FULMAR_OK);
  CHECK(p.gains->roll_ratio == 6);
  CHECK(p.gains.given());
  c.destroy(instance);
}

TEST_CASE("a component that wants its seed gets it") {
  Bench<Seeded> bench(42);
  REQUIRE(bench.step(0.01) == Status::ok);
  CHECK(bench.out.seed_ratio.value == 42);
}

TEST_CASE("the bench counts allocations and a plain step makes none") {
  Bench<Everything> bench;
  bench.set(bench.in.state, VehicleState{});
  bench.step(0.01);
  CHECK(allocations([&] { bench.step(0.01); }) == 0);
  CHECK(allocations([&] {
          std::vector<int> v(100);
          asm volatile("" ::"r"(v.data()) : "memory");
        }) == 1);
#ifndef FULMAR_HEAP_OF_A_SANITIZER
  const auto takes = [](auto&& of) {
    return allocations([&] {
      void* p = of();
      asm volatile("" ::"r"(p) : "memory");
      std::free(p);
    });
  };
  CHECK(takes([] { return std::malloc(8); }) == 1);  // Eigen's matrices of dynamic size, C libraries
  CHECK(takes([] { return std::calloc(2, 8); }) == 1);
  CHECK(takes([] { return std::realloc(nullptr, 8); }) == 1);
  CHECK(takes([] { return std::aligned_alloc(64, 64); }) == 1);
  struct alignas(64) Wide {
    double lanes[8];
  };
  CHECK(allocations([] {
          auto wide = std::make_unique<Wide>();
          asm volatile("" ::"r"(wide.get()) : "memory");
        }) == 1);
#endif
}

}  // namespace plugin_test

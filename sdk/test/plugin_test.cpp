// SPDX-License-Identifier: BSD-3-Clause
// A component as the host sees it: tables, thunks, life cycle; and the bench that authors test with.
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

namespace plugin_test {

using namespace fulmar;

namespace {

enum class Law : std::uint8_t { hold, takeoff };

struct Gains {
  double roll_ratio = 1;
};

const std::string long_reason = [] {
  std::string text = "because";
  while (text.size() < 300) text += " of words";
  return text;
}();
const std::string long_word = [] {
  std::string text;
  while (text.size() < 300) text += "\xc3\xbc";  // a letter of two bytes
  return text;
}();

struct Everything {
  static constexpr const char* doc = "Uses every kind of port and parameter.";
  struct Inputs {
    In<VehicleState> state;
    Optional<AttitudeCommand> attitude;
    Queue<PlanEdit> edits;
    Request<PlanEdit> edit;
  };
  struct Outputs {
    Actuators actuators;
    Out<AttitudeCommand> wish;
    OutQueue<PlanEdit, 2> made;
    Probe roll_error_rad;
  };
  struct Params {
    Param roll_kp{0.5, "rad/rad", 0, 2, "aileron per roll error"};
    Flag on{true, "whether it works"};
    Count n{3, 0, 10, "how many"};
    Choice<Law> law{Law::hold, "which law"};
    TextParam<8> word{"abc", "a word"};
    Vector<Ned> wind{{3, -4, 0}, "m/s", -30, 30, "wind"};
    Record<Gains> gains{"a record"};
    Blob table{"bytes"};
    Param mass{2, "kg", 0, 9, "fixed", setup};
  };

  void configure(const Params& p) {
    if (p.n == 7) throw std::runtime_error("seven is unlucky");
    configured = p.roll_kp;
  }
  void retune(const Params& p) { configured = p.roll_kp; }
  Status activate(const Tick&, const Inputs&, const Params&, const Outputs& last) {
    taken_over = last.actuators.aileron_rad;
    return Status::ok;
  }
  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
    if (in.state->roll_rad > 3) throw std::runtime_error("upside down");
    if (in.state->roll_rad < -3) return Status::failed;
    out.actuators.aileron_rad = p.roll_kp * (in.attitude ? in.attitude->roll_rad - in.state->roll_rad : 0);
    out.roll_error_rad = -in.state->roll_rad;
    if (in.attitude.fresh()) out.wish.publish(*in.attitude, tick.now_ns - 5);
    for (const auto& sample : in.edits) out.made.push(sample.value, sample.valid_at_ns);
    for (auto request : in.edit) {
      if (request.value().index == 100)
        request.refuse(long_reason);
      else if (request.value().index == 101)
        request.refuse(long_word);
      else if (request.value().index > 3)
        request.refuse("there is no waypoint " + std::to_string(request.value().index));
      else
        request.accept();
    }
    last_dt = tick.dt_s();
    return Status::ok;
  }
  double configured = 0, taken_over = 0, last_dt = 0;
};

/// Takes over as of today: knows whether somebody flew, and what he made.
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
  CHECK(std::string(c.doc) == "Uses every kind of port and parameter.");
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

  REQUIRE(bench.step(0.02) == Status::ok);  // nothing new: the event stays silent, queues are empty
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

/// Throws where it shall what has no words.
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

/// The first of its calls that fails, and the text that comes with it.
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

TEST_CASE("an exception without words, or whose words throw, fails its call and is named by its type") {
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

TEST_CASE("activated by the host, it knows whether somebody flew and what he made: zeros are a command too") {
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
        FULMAR_DEGRADED);  // nothing of the time before is left
  CHECK_FALSE(component.had_actuators);
  CHECK(component.aileron_rad == 0);
  c.destroy(instance);
}

TEST_CASE("the bench activates after nobody, after somebody, and after one who made some of the outputs") {
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

  Bench<Everything> old;  // takes the outputs alone: unchanged
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
  CHECK_FALSE(last.has(outputs.spare));  // another struct's
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
  v[6].data = nullptr;  // retune leaves records as they are
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

// SPDX-License-Identifier: BSD-3-Clause
// Commands from other threads to a flight: time of their effect, rejections, cost of a flood for the loop.
#include "core/tap/control.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <future>
#include <limits>
#include <memory>
#include <mutex>
#include <thread>

#include "core/run/test/commands.hpp"
#include "core/run/test/lab.hpp"
#include "core/test/refusal.hpp"

namespace control_test {

using fulmar::core::test::refusal;

namespace {

const std::string watched = "live: {listen: \"127.0.0.1:0\"}\n";

/// Paced, so that clients are admitted, but too fast to wait for the clock.
FlightOptions quick(double duration_s = 1000) {
  FlightOptions o = options(duration_s);
  o.speed = 1e6;
  return o;
}

/// An answer that comes from another thread.
class Reply {
 public:
  Control::Answer take() {
    return [promise = promise_](const std::string& refusal) { promise->set_value(refusal); };
  }
  /// Steps the flight until the answer has come.
  std::string wait(Flight& flight) {
    while (future_.wait_for(std::chrono::milliseconds(1)) != std::future_status::ready) flight.step();
    return future_.get();
  }
  std::string wait() { return future_.get(); }

 private:
  std::shared_ptr<std::promise<std::string>> promise_ = std::make_shared<std::promise<std::string>>();
  std::future<std::string> future_ = promise_->get_future();
};

const ParameterView& parameter(const FlightView& view, const std::string& component,
                               const std::string& name) {
  for (const ComponentView& c : view.components)
    for (const ParameterView& p : c.params)
      if (c.name == component && p.info.name == name) return p;
  FAIL("no parameter " << name);
  return view.components[0].params[0];
}

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

double commanded(const Graph& g, const Flight& flight) {
  return value(g, flight, "one", "command", "u_frac");
}

}  // namespace

TEST_CASE("a set parameter reaches the controller at the next tick, and every client") {
  const Graph g = mission(watched + one_phase);
  Flight flight(g, quick());
  Control* const control = flight.control();
  REQUIRE(control != nullptr);
  CHECK(flight.live_port() != 0);
  REQUIRE(flight.step());
  REQUIRE(flight.step());
  CHECK(commanded(g, flight) == 0.1);
  std::promise<std::string> seen;
  control->on_parameter(
      [&](const std::string& component, const std::string& name) { seen.set_value(component + "." + name); });
  Reply reply;
  control->set_parameter("one", "u", "-0.25", reply.take());
  CHECK(commanded(g, flight) == 0.1);  // not in the middle of a tick
  REQUIRE(flight.step());
  CHECK(commanded(g, flight) == -0.25);
  CHECK(reply.wait() == "");
  CHECK(seen.get_future().get() == "one.u");
  CHECK(parameter(control->view(), "one", "u").base.number[0] == -0.25);
}

TEST_CASE(
    "an invalid command is rejected in the sender's thread, with the valid choices, and changes nothing") {
  const Graph g = mission(watched + one_phase);
  Flight flight(g, quick());
  Control& control = *flight.control();
  REQUIRE(flight.step());
  const auto none = [](const std::string&) { FAIL("nobody may be answered"); };
  const auto set = [&](const char* component, const char* param, const char* value) {
    return refusal([&] { control.set_parameter(component, param, value, none); });
  };
  CHECK(holds(set("one", "u", "1.5"), "graph.value_out_of_range(1.5, -1, 1, , )"));
  CHECK(holds(set("one", "u", "nan"), "u"));
  CHECK(holds(set("one", "u", "fast"), "fast"));
  CHECK(holds(set("one", "uu", "0"), "types.name_unknown_in('one', parameter, uu,  [u] u, id, fault, fault"));
  CHECK(holds(set("ome", "u", "0"), "types.name_unknown(component, ome,  [one] sim, filter, one, watch)"));
  CHECK(holds(set("one", "fixed", "0"), "run.parameter_not_live(one, fixed)"));
  CHECK(holds(set("one", "fault", "nothing"), "none"));
  CHECK(holds(refusal([&] { control.enter_phase("fli", none); }), "run.phase_unknown(fli,  [fly] fly)"));
  const auto asks = [&] { control.request("watch", "asks", ask(0), none); };
  CHECK(holds(refusal(asks), "run.entrance_unknown(watch, request, asks,  [ask] ask)"));
  CHECK(holds(refusal([&] { control.publish("watch", "burst", {}); }), "imported"));
  const auto swap = [&] { control.swap("nobody", "x.so", none); };
  CHECK(holds(refusal(swap), "types.name_unknown(component, nobody, "));
  REQUIRE(flight.step());
  CHECK(commanded(g, flight) == 0.1);
}

TEST_CASE("a component answers a request in its next step; the end of the flight answers the rest") {
  const Graph g = mission(watched + one_phase);
  std::string last;
  Reply late;
  {
    Flight flight(g, quick());
    Control& control = *flight.control();
    REQUIRE(flight.step());
    Reply good, bad;
    control.request("watch", "ask", ask(1), good.take());
    CHECK(good.wait(flight) == "");
    control.request("watch", "ask", ask(-1), bad.take());
    CHECK(bad.wait(flight) == "cannot go back");
    control.request("watch", "ask", ask(1), late.take());
    flight.finish();
    CHECK(refusal([&] { control.enter_phase("fly", {}); }) == "run.flight_ended");
  }
  CHECK(late.wait() == "run.flight_ended");
}

TEST_CASE("thousands of parameters per second do not block the loop, and the last one stays") {
  Graph g = mission(watched + one_phase);
  g.timeout_ns = 0;  // until the end of the flood
  Flight flight(g, quick(1e6));
  Control& control = *flight.control();
  REQUIRE(flight.step());
  std::atomic<int> accepted{0}, full{0}, answered{0};
  std::atomic<bool> over{false};
  std::thread flood([&] {
    for (int n = 1; n <= 20'000; ++n) {
      const std::string text = std::to_string(n % 1000) + "e-4";
      const std::string why =
          refusal([&] { control.set_parameter("one", "u", text, [&](const std::string&) { ++answered; }); });
      ++(why.empty() ? accepted : full);
      if (!why.empty()) CHECK(holds(why, "run.too_many_commands(1024)"));
    }
    over = true;
  });
  int ticks = 0;
  bool flies = true;
  for (; flies && (!over || answered < accepted); ++ticks) flies = flight.step();
  flood.join();
  REQUIRE(flies);
  CHECK(accepted + full == 20'000);
  CHECK(answered == accepted);
  CHECK(ticks >= accepted / 32);  // no more than so many in one tick
  const double last = commanded(g, flight);
  CHECK(parameter(control.view(), "one", "u").base.number[0] == last);
  const FlightResult result = flight.finish();
  CHECK(result.loop_allocations == 0);
}

TEST_CASE("a command to a component is not executed on its successor after a swap") {
  const Graph g = mission(watched + one_phase);
  Flight flight(g, quick());
  Control& control = *flight.control();
  REQUIRE(flight.step());
  Reply swapped, set, asked;
  control.swap("one", variant("_better"), swapped.take());
  control.set_parameter("one", "u", "0.7", set.take());
  CHECK(swapped.wait(flight) == "");
  CHECK(holds(set.wait(flight), "run.component_was_swapped"));
  CHECK(parameter(control.view(), "one", "u").base.number[0] == 0.1);
  control.set_parameter("one", "u", "0.7", asked.take());
  CHECK(asked.wait(flight) == "");
}

TEST_CASE("a swap is rejected in whole sentences, and reports its changes of the parameters") {
  const Graph g = mission(watched + one_phase);
  Flight flight(g, quick());
  Control& control = *flight.control();
  REQUIRE(flight.step());
  Reply nowhere, folder, done;
  const std::string file = "/tmp/" + std::string(400, 'x') + ".so";
  control.swap("one", file, nowhere.take());
  CHECK(holds(nowhere.wait(flight), "graph.plugin_file_missing(" + file));
  control.swap("one", "/etc/hostname", folder.take());
  CHECK(holds(folder.wait(flight), "graph.plugin_path_invalid(/etc, ' is a folder)"));
  control.swap("one", variant("_wider"), done.take());
  CHECK(done.wait(flight) == "");
  for (const ComponentView& c : control.view().components)
    CHECK(c.swapped == (c.name == "one"
                            ? "run.parameters_kept(run.parameter_default_changed(fixed, 1, 1.5)); "
                              "run.parameters_added(reserve = 0)"
                            : ""));
}

TEST_CASE("a sentence that is too long ends in dots, after a whole word and a whole letter") {
  std::array<char, 24> text{};
  const auto cut = [&](const std::string& words) {
    std::snprintf(text.data(), text.size(), "%s", words.c_str());
    end_in_dots(text.data(), text.size());
    return std::string(text.data());
  };
  const std::string sentence = "there is no output of type GuidanceCommand";
  CHECK(cut(sentence) == "there is no output...");
  CHECK(cut("supercalifragilisticexpialidocious") == "supercalifragilistic...");
  CHECK(cut("supercalifragilisti\u00e4\u00e4\u00e4\u00e4") == "supercalifragilisti...");
  Event e = event_of(Code::notice);
  say(e, std::string(600, 'y'));
  CHECK(std::string(e.words.data()).ends_with("yyy..."));
}

TEST_CASE("requests wait for room in their order, delay no parameter, and cost the loop no allocation") {
  const Graph g = mission(watched + one_phase);
  Flight flight(g, quick());
  Control& control = *flight.control();
  REQUIRE(flight.step());
  REQUIRE(flight.step());
  constexpr int many = 200;  // Watch::ask has room for few
  std::vector<int> order;
  std::mutex mutex;
  for (int n = 0; n < many; ++n)
    control.request("watch", "ask", ask(n % 10 == 9 ? -1 : 1), [&, n](const std::string& refusal) {
      const std::lock_guard lock(mutex);
      CHECK(refusal == (n % 10 == 9 ? "cannot go back" : ""));
      order.push_back(n);
    });
  Reply set;
  control.set_parameter("one", "u", "0.5", set.take());
  const auto answered = [&] {
    const std::lock_guard lock(mutex);
    return order.size();
  };
  while (answered() < many) REQUIRE(flight.step());
  CHECK(std::is_sorted(order.begin(), order.end()));
  CHECK(set.wait(flight) == "");
  CHECK(flight.finish().loop_allocations == 0);
}

TEST_CASE("a request to an inactive component is rejected, not kept for later") {
  const Graph g = mission(watched + one_phase);
  Flight flight(g, quick());
  Control& control = *flight.control();
  REQUIRE(flight.step());
  Reply stop, before, after;
  control.set_parameter("watch", "stop_at", "-100 s", stop.take());
  control.request("watch", "ask", ask(1), before.take());
  CHECK(before.wait(flight) == "was not answered");  // that step threw
  control.request("watch", "ask", ask(1), after.take());
  CHECK(after.wait(flight) == "run.component_not_active(watch)");
  CHECK(refusal([&] { request(flight, "watch", "ask", 0.0); }) == "run.component_not_active(watch)");
}

TEST_CASE("a request without an answer at the end of the flight is answered once") {
  const Graph g = mission(
      "  watch: {use: lab/Watch, rate: 1 Hz, in: {burst: vehicle.burst, applied: vehicle.applied}}\n" +
      watched + one_phase);
  std::atomic<int> answers{0};
  {
    Flight flight(g, quick());
    REQUIRE(flight.step());
    flight.control()->request("watch", "ask", ask(1), [&](const std::string& refusal) {
      ++answers;
      CHECK(refusal == "run.flight_ended");
    });
    for (int n = 0; n < 3; ++n) REQUIRE(flight.step());  // it waits at the component
    flight.finish();
  }
  CHECK(answers == 1);
}

TEST_CASE("a law whose imported input stops is stopped like any other") {
  mission(watched + with_fallback);
  const fs::path file = folder().path / "fed-from-outside.yaml";  // takes the wire of lab.yaml out
  std::ofstream(file) << "extends: lab.yaml\ndds: {import: {one.signal: /lab/signal}}\n";
  Graph g = load_mission(file.string(), {});
  g.dds.on = false;
  Flight flight(g, quick());
  Control& control = *flight.control();
  const auto type =
      g.components[static_cast<std::size_t>(g.dds.imports.at(0).component)].info().inputs.at(0).type;
  for (int n = 0; n < 40; ++n) {
    REQUIRE(flight.step());
    CHECK(control.publish("one", "signal", std::vector<std::byte>(type->size)));
  }
  CHECK(value(g, flight, "sim", "applied", "u_frac") == 0.1);
  const std::int64_t silent_ns = flight.now_ns();
  while (value(g, flight, "sim", "applied", "u_frac") == 0.1) REQUIRE(flight.step());
  CHECK(value(g, flight, "sim", "applied", "u_frac") == 0.2);
  CHECK(flight.now_ns() - silent_ns == doctest::Approx(1e9).epsilon(0.02));  // docs/loop.md: 1 s
  const FlightResult result = flight.finish();
  REQUIRE(result.guards.size() == 1);
  CHECK(holds(result.guards[0].what, "run.input_too_old(signal, "));
}

TEST_CASE("a flood of one import takes no room of another's, and its losses are reported") {
  const Graph whole =
      mission("  ear: {use: lab/OldReader}\n  other: {use: lab/OldReader}\n" + watched + one_phase +
              "dds: {import: {ear.signal: /lab/flood, other.signal: /lab/calm}}\n");
  Graph g = whole;
  g.dds.on = false;
  Flight flight(g, quick());
  Control& control = *flight.control();
  REQUIRE(flight.step());
  std::vector<std::byte> message(sizeof(double));
  int taken = 0;
  for (int n = 0; n < 3000; ++n) taken += control.publish("ear", "signal", message);
  CHECK(taken == 64);
  CHECK(control.lost_samples() == 3000 - 64);
  CHECK(control.publish("other", "signal", message));
  Reply set;
  control.set_parameter("one", "u", "0.9", set.take());
  REQUIRE(flight.step());
  CHECK(commanded(g, flight) == 0.9);  // samples do not delay a parameter
  for (int n = 0; n < 3; ++n) REQUIRE(flight.step());
  CHECK(value(g, flight, "other", "tally", "steps_ratio") >= 1);
  Reply later;  // answered after the samples
  control.set_parameter("one", "u", "0.8", later.take());
  CHECK(later.wait(flight) == "");
  CHECK(control.publish("ear", "signal", message));  // the flood has passed
}

TEST_CASE("clients get the number of steps and the step time of each component") {
  const Graph g =
      mission("  two: {fills: law, use: lab/Law, budget: 5 s, params: {id: 2}}\n" + watched + with_fallback);
  Flight flight(g, quick());
  const auto seen = [&](const std::string& name) {
    for (const ComponentView& c : flight.control()->view().components)
      if (c.name == name) return c;
    return ComponentView();
  };
  for (int n = 0; n < 17; ++n) REQUIRE(flight.step());  // they are updated with every 16th tick
  CHECK(seen("one").steps >= 15);
  CHECK(seen("one").steps <= 17);
  CHECK(seen("one").step_us > 0);
  CHECK(seen("one").step_max_us >= seen("one").step_us);
  CHECK(seen("one").budget_us == 0);
  CHECK(seen("one").active);
  CHECK(seen("two").name == "two");
  CHECK(seen("two").steps == 0);  // waits
  CHECK(seen("two").budget_us == 5e6);
  CHECK_FALSE(seen("two").active);
}

TEST_CASE("a phase is entered between two ticks, and clients get it") {
  const Graph g = mission(watched +
                          "phases:\n  fly: {law: one, next: [{to: rest, when: \"vehicle.signal.x_m < "
                          "0\"}]}\n  rest: {law: two}\n");
  Flight flight(g, quick());
  Control& control = *flight.control();
  REQUIRE(flight.step());
  CHECK(control.view().phase.now == "fly");
  Reply reply;
  control.enter_phase("rest", reply.take());
  REQUIRE(flight.step());
  CHECK(flight.phase() == "rest");
  CHECK(value(g, flight, "two", "command", "u_frac") == 0.2);
  CHECK(control.view().phase.now == "rest");
  CHECK(reply.wait() == "");
}

TEST_CASE("a parameter under an overlay is reported; the present phase can be entered again, after a reset") {
  const Graph g = mission(
      "  one:    {fills: law, use: lab/Law, params: {id: 1, u: 0.1, fault: fails, fault_at: 0.02 s}}\n" +
      watched + "phases:\n  fly: {law: {use: one, fallback: two, set: {u: 0.3}}}\n");
  Flight flight(g, quick());
  Control& control = *flight.control();
  REQUIRE(flight.step());
  CHECK(commanded(g, flight) == 0.3);
  CHECK(parameter(control.view(), "one", "u").overlaid);
  CHECK_FALSE(parameter(control.view(), "two", "u").overlaid);
  Reply hidden;
  control.set_parameter("one", "u", "0.7", hidden.take());
  REQUIRE(flight.step());
  CHECK(commanded(g, flight) == 0.3);
  CHECK(parameter(control.view(), "one", "u").base.number[0] != 0.3);
  while (value(g, flight, "sim", "applied", "u_frac") != 0.2) REQUIRE(flight.step());
  Reply healed, reset, again;
  control.set_parameter("one", "fault", "none", healed.take());
  control.reset_guards(reset.take());
  control.enter_phase("fly", again.take());
  REQUIRE(flight.step());
  REQUIRE(flight.step());
  CHECK(value(g, flight, "sim", "applied", "u_frac") == 0.3);
}

TEST_CASE("a sample from outside is at the input in the next tick; a damaged one is rejected") {
  const Graph whole = mission("  ear: {use: lab/OldReader}\n" + watched + one_phase +
                              "dds: {import: {ear.signal: /lab/signal}}\n");
  Graph g = whole;
  g.dds.on = false;  // the test publishes itself
  Flight flight(g, quick());
  Control& control = *flight.control();
  REQUIRE(flight.step());
  const TypePtr type = [&] {
    for (const ComponentView& c : control.view().components)
      if (c.name == "ear") return c.inputs[0].type;
    return TypePtr{};
  }();
  REQUIRE(type);
  std::vector<std::byte> message(type->size);
  CHECK(holds(refusal([&] {
                control.publish("ear", "signal", {message.begin(), message.end() - 1});
              }),
              "run.message_size_invalid(ear, signal, 7, Signal, 8)"));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::memcpy(message.data() + type->fields[0].offset, &nan, sizeof nan);
  CHECK(holds(refusal([&] { control.publish("ear", "signal", message); }), "nan"));
  const double tick_s = 5;
  std::memcpy(message.data() + type->fields[0].offset, &tick_s, sizeof tick_s);
  REQUIRE(flight.step());
  CHECK(flight.sample(port(g, "ear", "tally")) == nullptr);  // it has not had a sample yet
  control.publish("ear", "signal", message);
  REQUIRE(flight.step());
  CHECK(value(g, flight, "ear", "tally", "steps_ratio") == 1);
  CHECK(value(g, flight, "ear", "tally", "dt_s") ==
        doctest::Approx(tick_s - 1e-9 * static_cast<double>(flight.now_ns())));
  CHECK(control.lost_samples() == 0);
}

TEST_CASE("an unpaced flight admits no client, and a reachable one requires a token") {
  Flight flight(mission(watched + one_phase), options(0.1));
  CHECK(flight.control() == nullptr);
  CHECK(flight.live_port() == 0);
  const Graph open = mission("live: {listen: \"0.0.0.0:0\"}\n"s + one_phase);
  CHECK_THROWS_WITH_AS(Flight(open, quick()), doctest::Contains("graph.live_token_missing(0.0.0.0)"), Error);
}

TEST_CASE("a port that is in use does not prevent the flight") {
  const Graph g = mission(watched + one_phase);
  Flight first(g, quick());
  Graph same = g;
  same.live.port = first.live_port();
  std::vector<std::string> printed;
  FlightOptions o = quick(0.05);
  o.say = [&](const std::string& line, bool warning) {
    if (warning) printed.push_back(line);
  };
  Flight second(same, o);
  CHECK(second.live_port() == 0);
  CHECK(second.run().outcome == Outcome::flown);
  REQUIRE(printed.size() == 1);
  CHECK(holds(printed[0], "run.live_view_missing("));
  CHECK(holds(printed[0], std::to_string(same.live.port)));
}

TEST_CASE("the filler of a role publishes as the role: one topic for all of them") {
  Flight flight(mission(watched + "phases:\n  fly: {law: one, next: [{to: rest, when: \"vehicle.signal.x_m < "
                                  "0\"}]}\n  rest: {law: two}\n"),
                quick());
  std::vector<int> channels;
  for (const ComponentView& c : flight.control()->view().components)
    for (const PortView& port : c.outputs)
      if (port.name == "command") channels.push_back(port.channel);
  REQUIRE(channels.size() == 2);
  CHECK(channels[0] == channels[1]);
  CHECK(channels[0] >= 0);
}

}  // namespace control_test

// SPDX-License-Identifier: BSD-3-Clause
// A component's file is swapped on the ground, in a host that continues: parameters stay, and after a failed
// swap the old component can still fly.
#include "core/log/test/read_mcap.hpp"
#include "core/run/command/swap_checks.hpp"
#include "core/run/test/commands.hpp"
#include "core/run/test/lab.hpp"
#include "core/types/named.hpp"

namespace swap_test {

namespace {

// The cart arms itself at its first tick and reports it from time 0 on: before that it stands on the ground.
struct Ground {
  Graph graph;
  FlightOptions o = options(0.2);
  std::unique_ptr<Flight> flight;
  explicit Ground(Graph g, bool log = false) : graph(std::move(g)) {
    o.keep_inputs = true;
    if (log) {
      o.log = true;
      o.log_file = folder().path / "swap.mcap";
      fs::remove(o.log_file);
    }
    flight = std::make_unique<Flight>(graph, o);
    for (int i = 0; i < 100; ++i) REQUIRE(flight->step());
  }
  double u() const { return value(graph, *flight, "one", "command", "u_frac"); }
  std::string refused(const std::string& file) const {
    try {
      swap(*flight, "one", file);
    } catch (const Error& fault) {
      return fault.what();
    }
    return "";
  }
};

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("a swapped law flies with the previous parameters, overlays and live changes") {
  Ground ground(mission("phases:\n  wait: {law: {use: one, set: {id: 7}}, next: [{to: fly, when: "
                        "\"vehicle.status.armed\"}]}\n  fly: {law: one}\n"),
                true);
  ParamValue v;
  v.number[0] = 0.4;
  set_parameter(*ground.flight, "one", "u", v);
  ground.flight->step();
  CHECK(ground.u() == 0.4);
  swap(*ground.flight, "one", variant("_better"));
  ground.flight->step();
  CHECK(ground.u() == 0.2);  // the better law halves its input
  CHECK(value(ground.graph, *ground.flight, "one", "command", "by") == 7);
  while (ground.flight->step()) {
  }
  CHECK(value(ground.graph, *ground.flight, "one", "command", "by") == 1);  // the overlay has ended
  CHECK(ground.u() == 0.2);
  const FlightResult r = ground.flight->finish();
  CHECK(r.guards.empty());
  CHECK(r.outcome == Outcome::flown);
  const WholeLog file = read_mcap(ground.o.log_file);
  const std::string hash = sha256_file(variant("_better"));
  bool reported = false;
  for (const McapFile::Metadata& m : file.metadata)
    for (const auto& [key, text] : m.pairs) reported = reported || (m.name == "swap" && has(text, hash));
  CHECK(reported);
}

TEST_CASE("an impossible swap is rejected in a sentence, and the old law flies on") {
  Ground ground(mission(one_phase));
  CHECK(has(ground.refused(variant("_wild")), "output 'command': types.value_not_finite(u_frac, nan)"));
  CHECK(has(ground.refused(variant("_throwing")), "no law today"));
  CHECK(has(ground.refused(variant("_renamed")),
            "types.name_unknown_in(the plugin " + variant("_renamed") + ", component, Law,  [] Statute)"));
  CHECK(has(ground.refused(variant("_nowhere")), "graph.plugin_file_missing(" + variant("_nowhere")));
  CHECK(has(ground.refused(std::string(FULMAR_TEST_PLUGIN_DIR) + "/wrong_abi.so"),
            "loader.plugin_abi_differs(wrong_abi.so, 2.0, 1.2)"));
  CHECK(has(ground.refused(std::string(FULMAR_TEST_PLUGIN_DIR) + "/crash.so"),
            "loader.plugin_crashed(crash.so, "));
  if (FULMAR_CRASH_TESTS) CHECK(has(ground.refused(variant("_crashing")), "isolate.segmentation_fault"));
  for (const double u : {-0.75, 0.1}) {
    ParamValue v;
    v.number[0] = u;
    set_parameter(*ground.flight, "one", "u", v);
    CHECK(ground.flight->step());
    if (u < 0) CHECK(has(ground.refused(variant("_better")), "run.value_not_carried(u, -0.75, -0.5, 1)"));
  }
  for (int i = 0; i < 10; ++i) CHECK(ground.flight->step());
  CHECK(ground.u() == 0.1);
  while (ground.flight->step()) {
  }
  const FlightResult r = ground.flight->finish();
  CHECK(r.guards.empty());
  CHECK(r.outcome == Outcome::flown);
}

TEST_CASE("a swap reports the values that it keeps, the new parameters, and the removed ones") {
  Ground ground(mission(one_phase), true);
  swap(*ground.flight, "one", variant("_wider"));
  ground.flight->step();
  const std::string words =
      "run.parameters_kept(run.parameter_default_changed(fixed, 1, 1.5)); run.parameters_added(reserve = 0)";
  ground.flight->finish();
  const WholeLog file = read_mcap(ground.o.log_file);
  const HostTopic<Event> events(file);
  std::string reported;
  for (const McapFile::Message& m : file.messages)
    if (events.holds(m))
      if (const Event e = events.read(m.data); e.code == Code::swapped) reported = e.words.data();
  CHECK(reported.ends_with(", ; , " + words + ")"));
}

TEST_CASE("a swap does not report values that both have by default") {
  const auto number = [](const char* name, double initial) {
    ParamInfo p;
    p.name = name;
    p.unit = "s";
    p.initial[0] = initial;
    p.min = 0;
    p.max = 100;
    return p;
  };
  ComponentInfo old, fresh;
  old.params = {number("law_gain", 7), number("lead", 1), number("lag", 2), number("set_by_user", 3)};
  fresh.params = {number("law_gain", 5), number("lag", 2), number("set_by_user", 3), number("bank", 4)};
  std::vector<ParamValue> values(4), into(4);
  for (std::size_t i = 0; i < 4; ++i) values[i].number[0] = old.params[i].initial[0];
  for (std::size_t i = 0; i < 4; ++i) into[i].number[0] = fresh.params[i].initial[0];
  values[3].number[0] = 9;  // live: its default has not changed
  CHECK(parameter_words(old, values, fresh, into) ==
        "run.parameters_kept(run.parameter_default_changed(law_gain, 7 s, 5 s)); "
        "run.parameters_added(bank = 4 s); run.parameters_removed(lead)");
  into[0].number[0] = 7;  // the mission sets 7: nothing else is kept
  CHECK(parameter_words(old, values, fresh, into) ==
        "run.parameters_added(bank = 4 s); run.parameters_removed(lead)");
  CHECK(parameter_words(old, values, old, values) == "");
}

TEST_CASE("nothing is swapped while armed, and never the vehicle") {
  Ground ground(mission(one_phase));
  CHECK(has(
      [&] {
        try {
          swap(*ground.flight, "sim", variant("_better"));
        } catch (const Error& fault) {
          return std::string(fault.what());
        }
        return std::string();
      }(),
      "run.vehicle_not_swappable(sim)"));
  while (ground.flight->now_ns() < 100'000'000) ground.flight->step();
  CHECK(has(ground.refused(variant("_better")), "run.aircraft_armed"));
  CHECK(ground.u() == 0.1);
}

TEST_CASE("ports that the mission names are found in the new component, at any index") {
  Ground ground(mission(
      "phases:\n"
      "  wait: {law: {use: one, set: {u: 0.9}}, next: [{to: fly, when: \"law.command.u_frac < 0\"}, "
      "{to: fly, when: \"vehicle.status.armed\"}]}\n"
      "  fly:  {law: {use: one, set: {u: 0.6}}, next: [{to: wait, when: \"law.command.by == 8\"}]}\n"));
  swap(*ground.flight, "one", variant("_wider"));  // one more parameter, in front
  REQUIRE(ground.flight->step());
  CHECK(ground.u() == 0.9);
  CHECK(ground.flight->phase() == "wait");
  while (ground.flight->now_ns() < 100'000'000) REQUIRE(ground.flight->step());
  CHECK(ground.flight->phase() == "fly");
  CHECK(ground.u() == 0.6);
}

TEST_CASE("each condition on the flight reads the new component's output, at any index") {
  const std::string done = "done: \"vehicle.signal.tick_s > 0.1 s\"\n";
  for (const std::string key : {"flown", "failed"}) {
    CAPTURE(key);
    Ground ground(mission(done + key + ": \"one.error_m > 300\"\n" + one_phase));
    swap(*ground.flight, "one", variant("_wider"));  // outputs in another order
    while (ground.flight->step()) {
    }
    CHECK(ground.flight->finish().outcome == (key == "flown" ? Outcome::flown : Outcome::failed));
  }
}

TEST_CASE("a choice is kept while its labels are the same, a number while it is in range") {
  ComponentInfo old;
  ParamInfo choice{}, number{};
  choice.name = "law";
  choice.kind = FULMAR_CHOICE;
  choice.choices = {"takeoff", "cruise"};
  number.name = "gain";
  number.kind = FULMAR_NUMBER;
  number.min = 0;
  number.max = 2;
  old.params = {choice, number};
  ComponentInfo fresh = old;
  std::vector<ParamValue> values(2), into(2);
  values[0].integer = 1;
  values[1].number[0] = 1.5;
  carry_parameters(old, values, fresh, into);
  CHECK(into[0].integer == 1);
  CHECK(into[1].number[0] == 1.5);
  fresh.params[0].choices = {"cruise", "takeoff"};  // 1 would be another one
  into.assign(2, ParamValue{});
  carry_parameters(old, values, fresh, into);
  CHECK(into[0].integer == 0);
  for (const auto& [min, max] : {std::pair{1.6, 2.0}, std::pair{0.0, 1.4}}) {
    fresh.params[1].min = min;
    fresh.params[1].max = max;
    CHECK_THROWS_WITH(
        carry_parameters(old, values, fresh, into),
        min > 1 ? "run.value_not_carried(gain, 1.5, 1.6, 2)" : "run.value_not_carried(gain, 1.5, 0, 1.4)");
  }
}

TEST_CASE("many swaps leave nothing behind") {
  const int swaps = std::getenv("FULMAR_LONG") ? 1000 : 12;
  Ground ground(mission(one_phase));
  for (int i = 0; i < swaps; ++i) {
    swap(*ground.flight, "one",
         variant(i % 2 == 0 ? "_better" : ""));  // each unload is verified, or it throws
    if (i % 5 > 0) continue;                     // 300 ticks are left on the ground
    REQUIRE(ground.flight->step());
    REQUIRE(ground.u() == (i % 2 == 0 ? 0.05 : 0.1));
  }
}

TEST_CASE("a child that has died is started again on the ground, and never in the air") {
  if (!FULMAR_CRASH_TESTS) return;
  const auto said_after_reset = [](const char* fault_at, std::int64_t until_ns) {
    const Graph g =
        mission("  one: {fills: law, use: lab/Law, run: process, params: {fault: crashes, fault_at: "s +
                fault_at + "}}\n" + with_fallback);
    std::string printed;
    FlightOptions o = options(0.3);
    o.say = [&](const std::string& text, bool) { printed += text + "\n"; };
    Flight flight(g, o);
    do flight.step();
    while (flight.now_ns() < until_ns);
    CHECK(value(g, flight, "sim", "applied", "by") == 2);  // the fallback
    CHECK(value(g, flight, "sim", "applied", "u_frac") == 0.2);
    ParamValue u, never;
    u.number[0] = 0.3;
    never.number[0] = 1e9;
    set_parameter(flight, "one", "u", u);
    set_parameter(flight, "one", "fault_at", never);
    printed.clear();
    reset_guards(flight);
    const std::string reported = printed;
    const bool on_ground = until_ns < 0;
    enter_phase(flight, "fly");
    for (int i = 0; i < 2; ++i) REQUIRE(flight.step());
    if (on_ground) CHECK(value(g, flight, "one", "command", "u_frac") == 0.3);  // as set since then
    return reported;
  };
  CHECK(has(said_after_reset("-0.5 s", -400'000'000), "one: run.guard_reset"));
  CHECK(has(said_after_reset("0.1 s", 150'000'000), "one: run.guard_not_reset(run.aircraft_armed)"));
}

TEST_CASE("after a swap elsewhere a role's filler that is stopped is lost in the same tick, as before") {
  Ground ground(mission(with_fallback, {{"filter.stop_at", "0.1"}}));
  swap(*ground.flight, "two", variant("_better"));
  while (ground.flight->step()) {
  }
  const FlightResult r = ground.flight->finish();
  REQUIRE(r.guards.size() >= 2);
  CHECK(r.guards[1].what == "run.input_of_stopped(signal, filter)");
  CHECK(r.guards[1].at_ns == r.guards[0].at_ns);
}

TEST_CASE("after a swap no component reads zeros where a wire carries the previous tick") {
  Ground ground(
      mission("  ear: {use: lab/Filter, in: {signal: {from: sense.signal, delayed: true}}}\n"s + one_phase));
  const auto received = [&] { return value(ground.graph, *ground.flight, "ear", "signal", "x_m"); };
  const double before = received();
  REQUIRE(before > 0);
  swap(*ground.flight, "one", variant("_better"));
  for (int i = 0; i < 3; ++i) {
    REQUIRE(ground.flight->step());
    CHECK(received() >= before);
  }
  CHECK(received() > before);
}

TEST_CASE("a second swap does not undo the first one's changes of the mission") {
  Ground ground(
      mission("phases:\n  wait: {law: {use: one, set: {u: 0.9}}, next: [{to: fly, when: "
              "\"vehicle.status.armed\"}]}\n  fly:  {law: {use: one, fallback: two, set: {u: 0.6}}}\n"));
  swap(*ground.flight, "one", variant("_wider"));  // one more parameter, in front
  swap(*ground.flight, "two", variant("_better"));
  REQUIRE(ground.flight->step());
  CHECK(ground.u() == 0.9);
  while (ground.flight->now_ns() < 100'000'000) REQUIRE(ground.flight->step());
  CHECK(ground.u() == 0.6);
}

TEST_CASE("requests to a swapped component are in the log, like those to its predecessor") {
  Ground ground(mission(one_phase), true);
  request(*ground.flight, "watch", "ask", 1.0);
  REQUIRE(ground.flight->step());
  swap(*ground.flight, "watch", variant("_better"));
  request(*ground.flight, "watch", "ask", 2.0);
  while (ground.flight->step()) {
  }
  ground.flight->finish();
  const WholeLog file = read_mcap(ground.o.log_file);
  const std::uint16_t asked = file.channel("/watch/ask");
  CHECK(std::count_if(file.messages.begin(), file.messages.end(),
                      [&](const McapFile::Message& m) { return m.channel == asked; }) == 2);
}

TEST_CASE("a tape keeps the stamps of a queue with its items when the port's content changes") {
  const Graph g = mission(one_phase);
  const Component* const watch = find_named(g.components, "watch");
  REQUIRE(watch != nullptr);
  const auto burst = static_cast<std::size_t>(watch->info().input("burst"));
  std::vector<fulmar_input> inputs(watch->info().inputs.size());
  std::vector<std::byte> item(watch->info().inputs[burst].type->size);
  std::int64_t stamp_ns = 0;
  inputs[burst].data = item.data();
  inputs[burst].stamps_ns = &stamp_ns;
  inputs[burst].count = 1;
  Tape tape(watch->info(), 4);
  for (std::uint64_t n = 1; n <= 3; ++n) {
    stamp_ns = static_cast<std::int64_t>(10 * n);
    tape.record({stamp_ns, 0, n}, inputs);
  }
  for (std::size_t i = 0; i < 3; ++i)
    CHECK(tape.step(i).inputs[burst].stamps_ns[0] == tape.step(i).tick.now_ns);
}

}  // namespace swap_test

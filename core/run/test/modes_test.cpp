// SPDX-License-Identifier: BSD-3-Clause
// Run modes: in a child, with a latency, in a separate thread.
#include <cmath>
#include <cstdlib>

#include "core/log/test/read_mcap.hpp"
#include "core/run/component/async.hpp"
#include "core/run/component/recorded_samples.hpp"
#include "core/run/test/commands.hpp"
#include "core/run/test/lab.hpp"
#include "core/types/named.hpp"

namespace modes_test {

namespace {

std::string log_hash(const Graph& g, const std::string& name, double duration_s, double speed = 0) {
  FlightOptions o = options(duration_s);
  o.log = true;
  o.log_file = folder().path / name;
  o.speed = speed;
  fs::remove(o.log_file);
  Flight flight(g, o);
  const FlightResult r = flight.run();
  CHECK(r.log.dropped == 0);
  return r.log.sha256;
}

/// The messages of one topic, as bytes.
std::vector<std::string> messages(const std::string& log, const std::string& topic) {
  const WholeLog file = read_mcap(folder().path / log);
  std::vector<std::string> all;
  for (const McapFile::Message& m : file.messages)
    if (m.channel == file.channel(topic))
      all.emplace_back(reinterpret_cast<const char*>(m.data.data()), m.data.size());
  return all;
}

}  // namespace

TEST_CASE("a component in a child publishes the same bytes as in the loop") {
  const Graph here = mission(one_phase);
  const Graph there =
      mission("  one: {fills: law, use: lab/Law, run: process, params: {id: 1, u: 0.1}}\n"s + one_phase);
  log_hash(here, "here.mcap", 1);
  log_hash(there, "there.mcap", 1);
  const auto a = messages("here.mcap", "/law/command"), b = messages("there.mcap", "/law/command");
  CHECK(a.size() > 20);  // 10 Hz
  CHECK(a == b);
  CHECK(messages("here.mcap", "/one/probes") == messages("there.mcap", "/one/probes"));
}

TEST_CASE("a child gets live changes and overlays") {
  const Graph g = mission(
      "  one: {fills: law, use: lab/Law, run: process, params: {id: 1, u: 0.1}}\n"
      "phases:\n  slow: {law: one, next: [{to: fast, when: \"vehicle.status.armed\", for: 0.1 s}]}\n"
      "  fast: {law: {use: one, set: {u: 0.3}}}\n"s);
  Flight flight(g, options(0.5));
  const FlightResult r = flight.run();
  CHECK(r.guards.empty());
  CHECK(value(g, flight, "one", "command", "u_frac") == 0.3);
}

TEST_CASE(
    "what an asynchronous step computes is seen its latency later, and belongs to the tick in which it "
    "began") {
  const Graph g = mission(
      "  think: {use: lab/Thinker, run: async, latency: 50 ms, rate: 100 Hz, in: {signal: sense.signal}}\n"s +
      one_phase);
  Flight flight(g, options(0.5));
  const FlightResult r = flight.run();
  CHECK(r.outcome == Outcome::flown);
  const double now = value(g, flight, "sim", "signal", "x_m");
  const double seen = value(g, flight, "think", "thought", "x_m");
  CHECK(now == 600);
  CHECK(seen <= now - 20);  // 20 ticks of 2.5 ms
  CHECK(seen > now - 24);   // and the next one is pending
  CHECK(std::fmod(seen, 4) == 0);
  // it was activated when its input first existed
  CHECK(value(g, flight, "think", "thought", "tick_s") == 0);
  for (const ComponentStats& c : r.components)
    if (c.name == "think") CHECK(c.misses == 0);
}

TEST_CASE("asynchronous steps are deterministic, however long they take") {
  const std::string tail =
      "  think: {use: lab/Thinker, run: async, latency: 20 ms, rate: 50 Hz, in: {signal: sense.signal}, params: {takes: TAKES ms}}\n"s +
      one_phase;
  std::string quick = tail, slow = tail;
  quick.replace(quick.find("TAKES"), 5, "0");
  slow.replace(slow.find("TAKES"), 5, "4");
  log_hash(mission(quick), "quick.mcap", 0.2);
  log_hash(mission(slow), "slow.mcap", 0.2);
  CHECK(messages("quick.mcap", "/think/thought").size() > 10);
  CHECK(messages("quick.mcap", "/think/thought") == messages("slow.mcap", "/think/thought"));
}

TEST_CASE("an asynchronous step that fails is stopped by its guard when its result is due") {
  const Graph g = mission(
      "  think: {use: lab/Thinker, run: async, latency: 50 ms, rate: 100 Hz, in: {signal: sense.signal}, params: {fails: true}}\n"s +
      one_phase);
  Flight flight(g, options(0.1));
  const FlightResult r = flight.run();
  REQUIRE(r.guards.size() == 1);
  CHECK(r.guards[0].component == "think");
  CHECK(r.guards[0].at_ns == -1'000'000'000 + 50'000'000);
}

TEST_CASE("live changes reach an asynchronous component in order") {
  const Graph g = mission(
      "  think: {use: lab/Thinker, run: async, latency: 10 ms, in: {signal: sense.signal}, params: {takes: 0 ms}}\n"s +
      one_phase);
  Flight flight(g, options(1));
  ParamValue v;
  v.number[0] = -1;
  for (int i = 0; i < 400; ++i) flight.step();
  CHECK(value(g, flight, "think", "thought", "x_m") > 0);
  set_parameter(flight, "think", "gain", v);
  for (int i = 0; i < 10; ++i) flight.step();
  CHECK(value(g, flight, "think", "thought", "x_m") < 0);
}

TEST_CASE("samples of a driver enter at the next tick, are recorded completely, and replay from the log") {
  const std::string tail =
      "  gauge: {use: lab/Ticker, run: driver, params: {samples: 30}}\n  count: {use: lab/Watch, in: {burst: gauge.reading}}\n"s +
      one_phase;
  const Graph g = mission(tail);
  FlightOptions o = options(0.2);
  o.log = true;
  o.log_file = folder().path / "driven.mcap";
  fs::remove(o.log_file);
  o.speed = 1;  // two or three publications in a tick, each with its probes
  Flight flight(g, o);
  const FlightResult r = flight.run();
  CHECK(r.guards.empty());
  CHECK(value(g, flight, "count", "tally", "samples_ratio") == 30);
  CHECK(value(g, flight, "count", "tally", "sum_m") == 30 * 31 / 2);
  CHECK(value(g, flight, "gauge", "count_ratio", "") == 30);
  const auto driven = messages("driven.mcap", "/gauge/reading");
  CHECK(driven.size() == 30);

  FlightOptions again = options(0.2);
  again.log = true;
  again.log_file = folder().path / "again.mcap";
  fs::remove(again.log_file);
  again.drivers_from = o.log_file;
  Flight second(g, again);
  second.run();
  CHECK(value(g, second, "count", "tally", "sum_m") == 30 * 31 / 2);
  const WholeLog a = read_mcap(o.log_file), b = read_mcap(again.log_file);
  const auto stamps = [](const WholeLog& file) {
    std::vector<std::pair<std::uint64_t, std::uint64_t>> all;
    for (const McapFile::Message& m : file.messages)
      if (m.channel == file.channel("/gauge/reading")) all.emplace_back(m.log_ns, m.publish_ns);
    return all;
  };
  CHECK(stamps(a) == stamps(b));
  CHECK(messages("again.mcap", "/gauge/reading") == driven);
  CHECK(messages("driven.mcap", "/gauge/probes").size() > 20);
  CHECK(messages("again.mcap", "/gauge/probes") == messages("driven.mcap", "/gauge/probes"));

  ComponentInfo other = find_named(g.components, "gauge")->info();
  std::vector<std::string> topics;
  for (Port& port : other.outputs) {
    topics.push_back(port.type ? "/gauge/" + port.name : "");
    if (!port.type) continue;
    Type shorter = *port.type;
    shorter.fields.pop_back();
    port.type = std::make_shared<const Type>(shorter);
  }
  const std::string start =
      o.log_file.string() + ": run.topic_fields_differ(/gauge/reading, gauge, reading, ";
  CHECK_THROWS_WITH_AS(RecordedSamples(o.log_file, "gauge", other, topics, "", g.epoch_ns),
                       doctest::Contains(start.c_str()), Error);
}

TEST_CASE("a driver that fails is stopped, and reported") {
  const Graph g =
      mission("  gauge: {use: lab/Ticker, run: driver, params: {samples: 3, fails: true}}\n"s + one_phase);
  FlightOptions o = options(0.5);
  o.speed = 10;
  Flight flight(g, o);
  const FlightResult r = flight.run();
  CHECK(r.outcome == Outcome::flown);
  REQUIRE(r.guards.size() == 1);
  CHECK(r.guards[0].component == "gauge");
  CHECK(r.guards[0].what == "says that it failed");
}

TEST_CASE("a driver's sample is valid at the driver's stamp, else at its arrival") {
  for (const bool dated : {true, false}) {
    CAPTURE(dated);
    const Graph g =
        mission("  gauge: {use: lab/Ticker, run: driver, params: {samples: 5, dated: "s +
                (dated ? "true" : "false") + "}}\nrecord: {ports: {gauge.reading: all}}\n" + one_phase);
    FlightOptions o = options(0.5);
    o.speed = 4;
    o.log = true;
    o.log_file = folder().path / "dated.mcap";
    fs::remove(o.log_file);
    Flight(g, o).run();
    const WholeLog file = read_mcap(o.log_file);
    const std::uint64_t epoch_ns = static_cast<std::uint64_t>(g.epoch_ns);
    int seen = 0;
    for (const McapFile::Message& m : file.messages) {
      if (m.channel != file.channel("/gauge/reading")) continue;
      ++seen;
      const bool as_said = m.publish_ns == epoch_ns + static_cast<std::uint64_t>(seen) * 1'000'000;
      CHECK(as_said == dated);
      if (!dated) CHECK(m.publish_ns == m.log_ns);
    }
    CHECK(seen == 5);
  }
}

TEST_CASE("run modes that do not fit are rejected") {
  const auto refused = [](const std::string& tail) {
    try {
      mission(tail + one_phase);
    } catch (const Error& fault) {
      return std::string(fault.what());
    }
    return std::string();
  };
  const std::pair<const char*, const char*> cases[] = {
      {"  think: {use: lab/Thinker, run: async, in: {signal: sense.signal}}\n", "graph.latency_missing"},
      {"  gauge: {use: lab/Ticker, latency: 20 ms, run: driver}\n", "graph.latency_misplaced("},
      {"  gauge: {use: lab/Thinker, run: driver, in: {signal: sense.signal}}\n",
       "graph.driver_output_invalid(components.gauge, thought, lab/Thinker)"},
      {"  sim: {fills: vehicle, use: lab/Cart, run: process}\n", "graph.vehicle_run_invalid(components.sim)"},
      {"  one: {fills: law, use: lab/Law, memory: 64 parsecs}\n", "graph.memory_size_invalid("},
  };
  for (const auto& [part, reported] : cases) {
    const std::string components = part;
    CAPTURE(components);
    CHECK(refused(components).find(reported) != std::string::npos);
  }
}

TEST_CASE(
    "on hardware, a plugin that did not come with the host flies in a child unless the mission says "
    "otherwise") {
  const std::string tail =
      "  fcu: {fills: vehicle, use: lab/Cart}\n  two: {fills: law, use: lab/Law, run: tick}\nphases:\n  fly: {law: {use: one, fallback: two}}\nio: fcu\n"s;
  const Graph g = mission(tail);
  const auto mode = [&](const std::string& name) {
    for (const Component& c : g.components)
      if (c.name == name) return c.run;
    FAIL("no component " << name);
    return RunMode::tick;
  };
  CHECK(mode("fcu") == RunMode::tick);  // a vehicle runs in the loop
  CHECK(mode("one") == RunMode::process);
  CHECK(mode("two") == RunMode::tick);
  for (const Component& c : mission(with_fallback).components) CHECK(c.run == RunMode::tick);
}

TEST_CASE("pending results of a deactivated component are dropped when it is active again") {
  mission("");
  const fs::path file = folder().path / "muse.yaml";
  std::ofstream(file)
      << "extends: lab.yaml\n"
         "roles:\n  muse: {in: {signal: vehicle.signal}, out: {thought: Signal}}\n"
         "components:\n"
         "  think: {fills: muse, use: lab/Thinker, run: async, latency: 100 ms, rate: 100 Hz, "
         "params: {takes: 0 ms}}\n"
         "  other: {fills: muse, use: lab/Thinker, params: {takes: 0 ms}}\n"
         "phases:\n"
         "  a: {law: one, muse: think, next: [{to: b, when: \"vehicle.signal.tick_s >= 0.1 "
         "s\"}]}\n"
         "  b: {law: one, muse: other, next: [{to: c, when: \"vehicle.signal.tick_s >= 0.12 "
         "s\"}]}\n"
         "  c: {law: one, muse: think}\n";
  const Graph g = load_mission(file.string());
  Flight flight(g, options(1));
  const auto thought = [&](double t_s, const char* field) {
    while (flight.now_ns() < std::llround(1e9 * t_s)) REQUIRE(flight.step());
    return value(g, flight, "think", "thought", field);
  };
  const double last = thought(0.1, "x_m");
  CHECK(thought(0.2, "x_m") == last);  // until then old ones would have come
  CHECK(thought(0.25, "x_m") > last);
  CHECK(thought(0.25, "tick_s") == 448);  // it took over at 0.12 s, in tick 448
}

namespace {

/// Always fails, with a message only the first time.
std::uint32_t fail(void* times, const fulmar_tick*, const fulmar_input*, fulmar_output*,
                   fulmar_error* error) {
  if ((*static_cast<int*>(times))++ == 0) std::strcpy(error->text, "out of paper");
  return FULMAR_FAILED;
}
std::uint32_t accept(void*, const fulmar_value*, fulmar_error*) { return FULMAR_OK; }

struct Worker {
  fulmar_component functions{};
  int times = 0;
  ComponentInfo info;
  std::unique_ptr<Async> async;
  explicit Worker(std::size_t depth) {
    functions.step = fail;
    functions.retune = accept;
    async = std::make_unique<Async>("worker", functions, &times, info, depth);
  }
  bool submit(Async::Job::Call call) const {
    Async::Job* const job = async->room(call);
    if (!job) return false;
    job->call = call;
    async->submit();
    return true;
  }
};

}  // namespace

TEST_CASE(
    "so many steps are on their way in another thread and no more, and other calls find room beside them") {
  using Call = Async::Job::Call;
  const Worker worker(3);
  for (int i = 0; i < 3; ++i) CHECK(worker.submit(Call::step));
  CHECK_FALSE(worker.submit(Call::step));
  for (int i = 0; i < 4; ++i) CHECK(worker.submit(Call::retune));
  CHECK_FALSE(worker.submit(Call::retune));
  worker.async->wait();
  worker.async->release();  // the oldest: a step
  CHECK(worker.submit(Call::step));
  CHECK_FALSE(worker.submit(Call::step));
}

TEST_CASE("the message of a failed step in another thread is not repeated by a later one without a message") {
  const Worker worker(1);
  for (int i = 0; i < 12; ++i) {  // more than once for each slot of a call
    REQUIRE(worker.submit(Async::Job::Call::step));
    worker.async->wait();
    CHECK(std::string(worker.async->oldest()->error.text) == (i == 0 ? "out of paper" : ""));
    worker.async->release();
  }
}

}  // namespace modes_test

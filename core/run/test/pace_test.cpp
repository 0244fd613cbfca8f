// SPDX-License-Identifier: BSD-3-Clause
// A simulation that is paused, stepped, and set to another speed in flight. No test depends on a duration;
// each waits for an event.
#include "core/tap/pace.hpp"

#include <atomic>
#include <chrono>
#include <functional>
#include <future>
#include <iterator>
#include <memory>
#include <thread>

#include "core/run/test/commands.hpp"
#include "core/run/test/lab.hpp"
#include "core/tap/control.hpp"

namespace pace_test {

namespace {

const std::string watched = "live: {listen: \"127.0.0.1:0\"}\n";
constexpr auto soon = std::chrono::seconds(60);

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

PaceOrder order(PaceOrder::What what) { return {what, 0, 0}; }
constexpr auto pause = PaceOrder::What::pause, resume = PaceOrder::What::resume;

/// A flight in a separate thread, which other threads command.
class Aloft {
 public:
  explicit Aloft(const std::string& tail = one_phase, double duration_s = 90, double speed = 1,
                 const fs::path& log = {})
      : graph_(mission(tail + watched)) {
    FlightOptions o = options(duration_s);
    o.speed = speed;
    o.interrupt = &signal;
    o.log = !log.empty();
    o.log_file = log;
    o.no_restart = "";
    flight_ = std::make_unique<Flight>(graph_, o);
    REQUIRE(flight_->step());
    control_ = flight_->control();
    thread_ = std::thread([this] { result_ = flight_->run(); });
  }
  ~Aloft() {
    if (thread_.joinable()) end();
  }

  Control& control() { return *control_; }
  std::string ask(const std::function<void(Control::Answer)>& question) {
    const auto promise = std::make_shared<std::promise<std::string>>();
    auto answer = promise->get_future();
    question([promise](const std::string& refusal) { promise->set_value(refusal); });
    REQUIRE(answer.wait_for(soon) == std::future_status::ready);
    return answer.get();
  }
  std::string pace(const PaceOrder& asked) {
    return ask([&](Control::Answer answer) { control_->pace(asked, std::move(answer)); });
  }
  std::string step(std::uint64_t ticks) { return pace({PaceOrder::What::step, ticks, 0}); }
  std::string speed(double times) { return pace({PaceOrder::What::speed, 0, times}); }
  std::string set(const std::string& value) {
    return ask(
        [&](Control::Answer answer) { control_->set_parameter("one", "u", value, std::move(answer)); });
  }
  FlightView view() const { return control_->view(); }
  std::int64_t now_ns() const { return view().now_ns; }
  void wait_until(const std::function<bool()>& there) const {
    const auto end = std::chrono::steady_clock::now() + soon;
    while (!there()) {
      REQUIRE(std::chrono::steady_clock::now() < end);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
  /// Waits for the flight's own end.
  FlightResult wait() {
    thread_.join();
    return result_;
  }
  FlightResult end() {
    signal = 1;
    return wait();
  }
  const Graph& graph() const { return graph_; }
  const Flight& flight() const { return *flight_; }

  std::atomic<int> signal{0};

 private:
  Graph graph_;
  std::unique_ptr<Flight> flight_;
  Control* control_ = nullptr;
  FlightResult result_;
  std::thread thread_;
};

std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

constexpr std::int64_t tick_ns = 2'500'000;

}  // namespace

TEST_CASE("a paused flight stands still, answers, and takes parameters at once") {
  Aloft aloft;
  CHECK_FALSE(aloft.view().pace.paused);
  CHECK(aloft.view().pace.speed == 1);
  CHECK(aloft.pace(order(pause)) == "");
  CHECK(aloft.view().pace.paused);
  const std::int64_t then = aloft.now_ns();
  CHECK(aloft.pace(order(pause)) == "run.flight_already_paused");
  CHECK(aloft.set("0.5") == "");
  for (int i = 0; i < 5; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));  // several periods: ticks would occur
    CHECK(aloft.now_ns() == then);
  }
  CHECK(aloft.pace(order(resume)) == "");
  CHECK_FALSE(aloft.view().pace.paused);
  aloft.wait_until([&] { return aloft.now_ns() > then; });
  CHECK(aloft.pace(order(resume)) == "run.flight_not_paused");
  CHECK(aloft.end().outcome == Outcome::interrupted);
  CHECK(value(aloft.graph(), aloft.flight(), "one", "command", "u_frac") == 0.5);
}

TEST_CASE("exactly N ticks are flown, and the sender is answered after the last") {
  Aloft aloft;
  CHECK(aloft.step(3) == "run.step_without_pause");
  aloft.pace(order(pause));
  const std::int64_t then = aloft.now_ns();
  for (const std::uint64_t n : {1u, 2u, 400u, 1u}) {
    const std::int64_t before = aloft.now_ns();
    CHECK(aloft.step(n) == "");
    CHECK(aloft.now_ns() == before + static_cast<std::int64_t>(n) * tick_ns);
    CHECK(aloft.view().pace.paused);
  }
  CHECK(aloft.now_ns() == then + 404 * tick_ns);
}

TEST_CASE("commands after a step take effect after it, in their order") {
  Aloft aloft;
  aloft.pace(order(pause));
  std::promise<std::string> stepped, set;
  aloft.control().pace({PaceOrder::What::step, 1, 0}, [&](const std::string& w) { stepped.set_value(w); });
  aloft.control().set_parameter("one", "u", "0.75", [&](const std::string& w) { set.set_value(w); });
  CHECK(stepped.get_future().get() == "");
  CHECK(set.get_future().get() == "");
  aloft.signal = 1;
  aloft.wait();
  CHECK(value(aloft.graph(), aloft.flight(), "one", "command", "u_frac") == 0.1);  // of the previous tick
}

TEST_CASE("a request to a paused flight is answered in the next tick") {
  Aloft aloft;
  aloft.pace(order(pause));
  std::promise<std::string> promise;
  auto answer = promise.get_future();
  aloft.control().request("watch", "ask", ask(-1), [&](const std::string& why) { promise.set_value(why); });
  CHECK(aloft.set("0.3") == "");  // was applied after the request
  CHECK(answer.wait_for(std::chrono::milliseconds(10)) == std::future_status::timeout);
  CHECK(aloft.step(1) == "");
  CHECK(answer.get() == "cannot go back");
}

TEST_CASE(
    "many ticks can be ended by a pause, by continuing, and by the flight's end: their number is reported") {
  Aloft aloft("  one: {fills: law, use: lab/Law, params: {id: 1, u: 0.1, fault: slow, fault_at: -100 s}}\n" +
              std::string(one_phase));
  aloft.pace(order(pause));
  for (const auto& [cut, stands] : {std::pair(order(pause), true), std::pair(order(resume), false),
                                    std::pair(PaceOrder{PaceOrder::What::speed, 0, 1}, false)}) {
    if (!aloft.view().pace.paused) aloft.pace(order(pause));
    std::promise<std::string> promise;
    auto answer = promise.get_future();
    const std::int64_t then = aloft.now_ns();
    aloft.control().pace({PaceOrder::What::step, 1'000'000, 0},
                         [&](const std::string& why) { promise.set_value(why); });
    aloft.wait_until([&] { return aloft.now_ns() > then + 2 * tick_ns; });
    CHECK(holds(aloft.step(1), "run.steps_in_progress"));
    CHECK(aloft.pace(cut) == "");
    const std::string reported = answer.get();
    CHECK(holds(reported, "of 1000000 ticks"));
    CHECK(holds(reported, "ended after "));
    CHECK(aloft.view().pace.paused == stands);
    if (stands) CHECK(holds(reported, "after " + std::to_string((aloft.now_ns() - then) / tick_ns) + " of "));
  }
  aloft.pace(order(pause));
  std::promise<std::string> promise;
  aloft.control().pace({PaceOrder::What::step, 1'000'000, 0},
                       [&](const std::string& why) { promise.set_value(why); });
  aloft.end();
  CHECK(promise.get_future().get() == "run.flight_ended");
}

TEST_CASE("a paused flight ends by a signal, and its log is complete") {
  const fs::path log = folder().path / "paused.mcap";
  fs::remove(log);
  Aloft aloft(one_phase, 90, 1, log);
  aloft.pace(order(pause));
  const FlightResult result = aloft.end();
  CHECK(result.outcome == Outcome::interrupted);
  CHECK(result.reason == "run.ended_by_signal");
  CHECK(result.log.error == "");
  CHECK(fs::exists(log));
}

TEST_CASE(
    "a flight that was paused, stepped and hurried leaves the same log as one that was not, byte for byte") {
  const fs::path plain = folder().path / "plain.mcap", paced = folder().path / "paced.mcap";
  fs::remove(plain);
  fs::remove(paced);
  const std::string async =
      "  two: {fills: law, use: lab/Law, run: async, latency: 10 ms, params: {id: 2, u: 0.2}}\n"
      "phases:\n  fly: {law: two}\n";
  {
    Aloft aloft(async, 1.5, 1e6, plain);
    CHECK(aloft.wait().outcome == Outcome::flown);
  }
  {
    Aloft aloft(async, 1.5, 1, paced);
    CHECK(aloft.pace(order(pause)) == "");
    CHECK(aloft.step(7) == "");
    CHECK(aloft.step(100) == "");
    CHECK(aloft.speed(20) == "");
    CHECK(aloft.pace(order(pause)) == "");
    CHECK(aloft.step(1) == "");
    CHECK(aloft.speed(0) == "");
    CHECK(aloft.wait().outcome == Outcome::flown);
  }
  const std::string a = bytes_of(plain), b = bytes_of(paced);
  CHECK(a.size() > 1000);
  CHECK((a == b));
}

TEST_CASE("a pause is charged to no component, and is not made up for") {
  Aloft aloft("  one: {fills: law, use: lab/Law, budget: 200 ms, params: {id: 1, u: 0.1}}\n" +
              std::string(with_fallback));
  for (int i = 0; i < 6; ++i) {  // more than the overruns in a row that stop a component
    aloft.pace(order(pause));
    std::this_thread::sleep_for(std::chrono::milliseconds(250));
    aloft.step(1);
  }
  aloft.pace(order(resume));
  const std::int64_t then = aloft.now_ns();
  aloft.wait_until([&] { return aloft.now_ns() > then + 20 * tick_ns; });
  const FlightResult result = aloft.end();
  CHECK(result.guards.empty());
  CHECK(result.wall.behind_max_s < 1.2);  // 1.5 s, if the pauses counted
  CHECK(result.wall.took_s < 1e-9 * static_cast<double>(result.last_ns - result.first_ns) + 1.2);
}

TEST_CASE("a flight at full speed flies as fast as it can, and then in real time again") {
  Aloft aloft(one_phase, 1e6);
  CHECK(aloft.speed(0) == "");
  CHECK(aloft.view().pace.speed == 0);
  const std::int64_t then = aloft.now_ns();
  aloft.wait_until([&] { return aloft.now_ns() > then + 60'000'000'000; });
  CHECK(aloft.speed(2) == "");
  CHECK(aloft.view().pace.speed == 2);
  CHECK(aloft.end().outcome == Outcome::interrupted);
}

TEST_CASE("on hardware none of that is possible, and each command reports it") {
  const Graph g =
      mission("  fcu: {fills: vehicle, use: lab/Cart}\n" + std::string(one_phase) + watched + "io: fcu\n");
  FlightOptions o = options(1);
  Flight flight(g, o);
  Control* const control = flight.control();
  REQUIRE(control != nullptr);
  const auto none = [](const std::string&) { FAIL("nobody may be answered"); };
  const auto why = [&](const PaceOrder& asked) -> std::string {
    try {
      control->pace(asked, none);
    } catch (const Error& fault) {
      return fault.what();
    }
    return "";
  };
  CHECK(why(order(pause)) == "run.hardware_pace_fixed(an aircraft cannot be paused)");
  CHECK(why(order(resume)) == "run.hardware_pace_fixed(an aircraft cannot be paused)");
  CHECK(holds(why({PaceOrder::What::step, 1, 0}), "run.hardware_pace_fixed(an aircraft cannot be stepped)"));
  CHECK(holds(why({PaceOrder::What::speed, 0, 2}),
              "run.hardware_pace_fixed(its time has no speed but that of the clock)"));
  CHECK(holds(why(order(PaceOrder::What::restart)),
              "run.hardware_pace_fixed(an aircraft cannot be put back to where it began)"));
}

TEST_CASE("a flight ends for another one in the usual way: its log is complete, the sender is answered") {
  for (const bool paused : {false, true}) {
    CAPTURE(paused);
    const fs::path log = folder().path / "room.mcap";
    fs::remove(log);
    Aloft aloft(one_phase, 1e6, 1, log);
    std::promise<std::string> stepped;
    if (paused) {
      aloft.pace(order(pause));
      aloft.control().pace({PaceOrder::What::step, 1'000'000, 0},
                           [&](const std::string& why) { stepped.set_value(why); });
    }
    CHECK(aloft.pace({PaceOrder::What::restart, 0, 0, 11}) == "");
    const FlightResult result = aloft.wait();
    CHECK(result.outcome == Outcome::interrupted);
    CHECK(result.reason == "run.ended_for_restart");
    REQUIRE(aloft.flight().restart());
    CHECK(aloft.flight().restart()->seed == 11u);
    CHECK(result.log.error == "");
    CHECK(fs::exists(log));
    if (paused) CHECK(holds(stepped.get_future().get(), "of 1000000 ticks"));
    CHECK_THROWS_WITH(aloft.control().pace(order(PaceOrder::What::restart), {}), "run.flight_ended");
  }
}

TEST_CASE("of two requests for another flight at once one is accepted, and the other is answered") {
  Aloft aloft;
  std::promise<std::string> first, second;
  aloft.pace(order(pause));
  aloft.control().pace({PaceOrder::What::restart, 0, 0, 3},
                       [&](const std::string& why) { first.set_value(why); });
  try {
    aloft.control().pace({PaceOrder::What::restart, 0, 0, 4},
                         [&](const std::string& why) { second.set_value(why); });
  } catch (const Error& late) {
    second.set_value(late.what());
  }
  CHECK(first.get_future().get() == "");
  CHECK(second.get_future().get() == "run.flight_ended");
  aloft.wait();
  CHECK(aloft.flight().restart()->seed == 3u);
}

TEST_CASE("a flight whose owner begins no other rejects the request, and continues") {
  const Graph g = mission(std::string(one_phase) + watched);
  FlightOptions o = options(1);
  o.speed = 1;
  Flight flight(g, o);
  CHECK_THROWS_WITH(flight.control()->pace(order(PaceOrder::What::restart), {}),
                    "run.restart_not_possible(who began this flight begins no other)");
  CHECK(flight.step());
}

TEST_CASE("a flight that gets the request before its first tick ends after it") {
  const Graph g = mission(std::string(one_phase) + watched);
  FlightOptions o = options(1);
  o.speed = 1;
  o.no_restart = "";
  Flight flight(g, o);
  flight.control()->pace(order(PaceOrder::What::restart), {});
  const FlightResult result = flight.run();
  CHECK(result.ticks == 1);
  CHECK((flight.restart() && !flight.restart()->seed));
}

TEST_CASE("ticks and speeds are read exactly, and an invalid one is reported with the valid ones") {
  CHECK(step_order("400").ticks == 400);
  CHECK(speed_order("real").speed == 1);
  CHECK(speed_order("max").speed == 0);
  CHECK(speed_order("0.25").speed == 0.25);
  for (const char* const wrong : {"", "0", "-1", "1.5", "1x", "1000001", "99999999999999999999"})
    CHECK_THROWS_WITH(step_order(wrong), ("tap.step_count_invalid("s + wrong + ", 1000000)").c_str());
  for (const char* const wrong : {"", "0", "-1", "fast", "2x", "nan", "inf", "0.001", "1e7"})
    CHECK_THROWS_WITH(speed_order(wrong), ("tap.speed_invalid("s + wrong + ")").c_str());
  CHECK_FALSE(restart_order("").seed);
  CHECK(restart_order("0").seed == 0u);
  CHECK(restart_order("18446744073709551615").seed == 18446744073709551615u);
  for (const char* const wrong : {"-1", "1.5", "1x", " 1", "18446744073709551616"})
    CHECK_THROWS_WITH(restart_order(wrong), ("tap.seed_invalid("s + wrong + ")").c_str());
  for (const double speed : {0.0, 1.0, 0.25, 10.0}) CHECK(speed_of(speed_text(speed)) == speed);
}

}  // namespace pace_test

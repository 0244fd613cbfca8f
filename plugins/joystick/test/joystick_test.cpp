// SPDX-License-Identifier: BSD-3-Clause
// A pipe of joystick records, against the definitions of linux/joystick.h.
#include "plugins/joystick/joystick.hpp"

#include <doctest/doctest.h>
#include <linux/joystick.h>

#include <cstring>
#include <fstream>
#include <string>

#include "fulmar/random.hpp"
#include "fulmar/testing.hpp"
#include "pipe.hpp"

namespace joystick_test {

using namespace fulmar;
using namespace fulmar::hand;
using doctest::Approx;

namespace {

constexpr double frame_s = 0.02;

void use(Bench<Joystick>& bench, const Pipe& pipe) {
  bench.params.device.value = Text<128>(pipe.path());
  bench.params.dead_zone.value = 0;
}

/// The frame of one step, which is as long as frames are apart.
Rc frame(Bench<Joystick>& bench) {
  bench.step(frame_s);
  REQUIRE(bench.out.rc.count == 1);
  CHECK(bench.out.rc.stamps_ns[0] == FULMAR_ON_ARRIVAL);
  return bench.out.rc.items[0];
}

std::string reported(const Bench<Joystick>& bench) {
  std::string all;
  for (std::uint32_t i = 0; i < bench.out.notices.count; ++i)
    all += std::string(bench.out.notices.items[i].text.view()) + "\n";
  return all;
}

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("records are those of the kernel's header, signs and ends of the range included") {
  static_assert(sizeof(js_event) == JsEvent::size);
  CHECK(JsEvent::axis == JS_EVENT_AXIS);
  CHECK(JsEvent::button == JS_EVENT_BUTTON);
  CHECK(JsEvent::init == JS_EVENT_INIT);
  for (const int value : {-32767, -1, 0, 1, 300, 32767}) {
    const js_event event{123456789, static_cast<__s16>(value), JS_EVENT_AXIS | JS_EVENT_INIT, 5};
    JsState state;
    char bytes[sizeof event];
    std::memcpy(bytes, &event, sizeof event);
    state.take(bytes);
    CHECK(state.axis(5, 7) == Approx(value / 32767.0).epsilon(1e-15));
    CHECK(state.axis(4, 7) == 7);
    CHECK(record(JS_EVENT_AXIS | JS_EVENT_INIT, 5, value, 123456789) == std::string(bytes, sizeof bytes));
  }
}

TEST_CASE("sticks, throttle and switches come out as a transmitter's channels, each the right way") {
  Pipe pipe;
  pipe.plug();
  Bench<Joystick> bench;
  use(bench, pipe);
  CHECK_FALSE(frame(bench).link);  // no record yet
  pipe.write(axis(0, 16384) + axis(1, -32767) + axis(2, -32767) + axis(3, 8192) + axis(4, 32767) +
             axis(7, -32767));
  Rc rc = frame(bench);
  CHECK(rc.link);
  CHECK(rc.roll_frac == Approx(0.5).epsilon(1e-4));
  CHECK(rc.pitch_frac == -1);
  CHECK(rc.throttle_frac == 0);
  CHECK(rc.yaw_frac == Approx(0.25).epsilon(1e-4));
  CHECK(rc.aux1_frac == 1);
  CHECK(rc.aux2_frac == 0);  // no record: the middle
  CHECK(rc.aux4_frac == -1);
  CHECK(holds(reported(bench), "joystick.pilot_present(" + pipe.path() + ")"));
  pipe.write(axis(0, -32768) + axis(2, 32767));
  rc = frame(bench);
  CHECK(rc.roll_frac == -1);  // a driver outside the kernel's range
  CHECK(rc.throttle_frac == 1);
  CHECK(rc.pitch_frac == -1);  // stays where it was
  CHECK(reported(bench) == "");
}

TEST_CASE("reversed axes, a dead zone and an exponential, by their formulas") {
  Pipe pipe;
  pipe.plug();
  Bench<Joystick> bench;
  use(bench, pipe);
  bench.params.dead_zone.value = 0.1;
  bench.params.expo.value = 0.4;
  bench.params.axes.pitch_reversed.value = true;
  bench.params.axes.throttle_reversed.value = true;
  bench.params.axes.yaw_axis.value = -1;
  pipe.write(axis(0, -3277) + axis(1, 32767) + axis(2, -16384) + axis(3, 32767));
  Rc rc = frame(bench);
  CHECK(std::abs(rc.roll_frac) < 2e-5);  // the edge of the dead zone
  CHECK(rc.pitch_frac == Approx(-1));    // the end stays the end
  CHECK(rc.throttle_frac == Approx(0.75).epsilon(1e-4));
  CHECK(rc.yaw_frac == 0);
  pipe.write(axis(0, -18022));  // -0.55: half of what the dead zone leaves
  CHECK(frame(bench).roll_frac == Approx(-(0.6 * 0.5 + 0.4 * 0.125)).epsilon(1e-3));
}

TEST_CASE("a throttle that was never heard of, or that there is not, is closed and not half open") {
  Pipe pipe;
  pipe.plug();
  Bench<Joystick> bench;
  use(bench, pipe);
  pipe.write(axis(0, 100));
  CHECK(frame(bench).throttle_frac == 0);
  pipe.write(axis(2, 0));
  CHECK(frame(bench).throttle_frac == 0.5);
}

TEST_CASE(
    "a button turns its switch over at each press, or holds it; one that was down from the start does not") {
  for (const bool latch : {true, false}) {
    CAPTURE(latch);
    Pipe pipe;
    pipe.plug();
    Bench<Joystick> bench;
    use(bench, pipe);
    bench.params.buttons.aux4_button.value = 3;
    bench.params.buttons.buttons_latch.value = latch;
    pipe.write(record(0x81, 3, 1));
    CHECK(frame(bench).aux4_frac == (latch ? -1 : 1));
    pipe.write(button(3, false) + button(3, true) + button(3, true));  // repeated records count as one press
    CHECK(frame(bench).aux4_frac == 1);
    pipe.write(button(3, false));
    CHECK(frame(bench).aux4_frac == (latch ? 1 : -1));
    pipe.write(button(3, true) + button(3, false));
    CHECK(frame(bench).aux4_frac == -1);
  }
}

TEST_CASE("of two records of one axis in a step the later counts, and a record may come in pieces") {
  Pipe pipe;
  pipe.plug();
  Bench<Joystick> bench;
  use(bench, pipe);
  pipe.write(axis(0, 32767) + axis(0, -32767));
  CHECK(frame(bench).roll_frac == -1);
  const std::string bytes = axis(0, 32767);
  pipe.write(bytes.substr(0, 5));
  CHECK(frame(bench).roll_frac == -1);
  pipe.write(bytes.substr(5));
  CHECK(frame(bench).roll_frac == 1);
}

TEST_CASE("frames come 50 times a second of flight, neither faster nor slower than it goes") {
  Pipe pipe;
  pipe.plug();
  Bench<Joystick> bench;
  use(bench, pipe);
  bench.tick.now_ns = 0;
  pipe.write(axis(0, 0));
  unsigned frames = 0;
  for (int i = 0; i < 400; ++i) {
    bench.step(0.0025);
    frames += bench.out.rc.count;
  }
  CHECK(frames == 50);
  const std::int64_t then = bench.tick.now_ns;
  for (int i = 0; i < 10; ++i) {  // the flight is paused
    bench.tick.now_ns = then;
    bench.step(0);
    CHECK(bench.out.rc.count == 0);
  }
  bench.tick.now_ns = -5'000'000'000;  // the loop's first tick: a driver began with 0
  bench.step(0.0025);
  CHECK(bench.out.rc.count == 1);
}

TEST_CASE(
    "a joystick that is not there, that is pulled out and plugged in again: no link meanwhile, and told "
    "once") {
  Pipe pipe;
  Bench<Joystick> bench;
  use(bench, pipe);
  CHECK(bench.step(frame_s) == Status::degraded);
  CHECK(bench.out.rc.count == 1);
  CHECK_FALSE(bench.out.rc.items[0].link);
  CHECK(holds(reported(bench), "joystick.pilot_absent(" + pipe.path() + ", No such file"));
  frame(bench);
  CHECK(reported(bench) == "");
  pipe.plug();
  pipe.write(axis(0, 32767) + axis(2, 32767) + button(1, true));
  Rc rc = frame(bench);
  CHECK(rc.link);
  CHECK(holds(reported(bench), "joystick.pilot_back(" + pipe.path() + ")") == true);
  pipe.pull();
  rc = frame(bench);
  CHECK_FALSE(rc.link);
  CHECK(rc.throttle_frac == 0);
  CHECK(holds(reported(bench), "joystick.pilot_lost(" + pipe.path() + ", joystick.sender_missing)"));
  frame(bench);
  CHECK(reported(bench) == "");
  pipe.plug();
  CHECK_FALSE(frame(bench).link);  // no record yet
  pipe.write(axis(1, 16384));
  rc = frame(bench);
  CHECK(rc.link);
  CHECK(rc.roll_frac == 0);  // where the stick was before is not where it is
  CHECK(rc.throttle_frac == 0);
  CHECK(holds(reported(bench), "joystick.pilot_back(" + pipe.path() + ")"));
}

TEST_CASE("a pipe that nobody has opened for writing is nobody") {
  Pipe pipe;
  pipe.make();
  Bench<Joystick> bench;
  use(bench, pipe);
  CHECK_FALSE(frame(bench).link);
  CHECK(holds(reported(bench), "joystick.pilot_absent(" + pipe.path() + ", joystick.sender_missing)"));
}

TEST_CASE("a sender that opens a pipe at any time does not find it broken, and a second one goes on") {
  Pipe pipe;
  pipe.make();
  Bench<Joystick> bench;
  use(bench, pipe);
  frame(bench);
  for (const int value : {32767, -32767}) {
    const int end = open(pipe.path().c_str(), O_WRONLY | O_NONBLOCK);  // fails without a reader
    REQUIRE(end >= 0);
    const std::string bytes = axis(0, value);
    CHECK(write(end, bytes.data(), bytes.size()) == 8);
    const Rc rc = frame(bench);
    CHECK(rc.link);
    CHECK(rc.roll_frac == (value > 0 ? 1 : -1));
    close(end);
    CHECK_FALSE(frame(bench).link);
  }
}

TEST_CASE("a record that no joystick sends changes nothing and is counted; many in a row are no joystick") {
  Pipe pipe;
  pipe.plug();
  Bench<Joystick> bench;
  use(bench, pipe);
  pipe.write(axis(0, 32767) + record(3, 0, 5) + axis(40, 7) + button(70, true) + record(1, 0, 2) +
             record(0, 0, 0));
  CHECK(frame(bench).roll_frac == 1);
  CHECK(bench.out.unknown_records_ratio.value == 5);
  std::string garbage;
  for (int i = 0; i < 8; ++i) garbage += "garbage\n";
  pipe.write(garbage);
  CHECK_FALSE(frame(bench).link);
  CHECK(holds(reported(bench), "joystick.pilot_lost(" + pipe.path() + ", joystick.records_foreign"));
  CHECK(bench.out.unknown_records_ratio.value == 13);
  pipe.write(axis(0, -32767));
  CHECK(frame(bench).roll_frac == -1);  // it comes to its senses
}

TEST_CASE("a flood neither keeps frames waiting nor loses the last word") {
  Pipe pipe;
  pipe.plug();
  Bench<Joystick> bench;
  use(bench, pipe);
  std::string flood;
  for (int i = 0; i < 8000; ++i) flood += axis(0, i % 2 ? 32767 : -32767);
  pipe.write(flood + axis(0, 16384));  // all but the capacity of a pipe
  int frames = 0;
  for (Rc rc; rc.roll_frac != Approx(0.5).epsilon(1e-4) && frames < 100; ++frames) rc = frame(bench);
  CHECK(frames > 1);
  CHECK(frames < 100);
}

TEST_CASE("random bytes never make a frame that is out of range") {
  Pipe pipe;
  pipe.plug();
  Bench<Joystick> bench;
  use(bench, pipe);
  bench.params.expo.value = 1;
  Random random(5);
  for (int i = 0; i < 300; ++i) {
    std::string bytes(1 + random.bits() % 97, '\0');
    for (char& c : bytes) c = static_cast<char>(random.bits() % 5 == 0 ? random.bits() : random.bits() % 3);
    pipe.write(bytes);
    const Rc rc = frame(bench);
    CHECK(bench.validation_error() == "");
    for (const double stick : {rc.roll_frac, rc.pitch_frac, rc.yaw_frac, rc.aux1_frac, rc.aux4_frac})
      CHECK(std::abs(stick) <= 1);
    CHECK(rc.throttle_frac >= 0);
    CHECK(rc.throttle_frac <= 1);
  }
}

TEST_CASE("what can be no joystick is refused before the flight; what may not be read is told") {
  Pipe pipe;
  Bench<Joystick> bench;
  std::ofstream(pipe.path()) << "text";
  use(bench, pipe);
  CHECK_THROWS_WITH(bench.component().configure(bench.params),
                    ("device: joystick.device_invalid(" + pipe.path() + ")").c_str());
  bench.params.device.value = Text<128>("");
  CHECK_THROWS_WITH(bench.component().configure(bench.params), "device: joystick.device_missing");
  std::filesystem::remove(pipe.path());
  if (geteuid() == 0) return;  // root has every permission
  pipe.make();
  chmod(pipe.path().c_str(), 0);
  use(bench, pipe);
  CHECK_FALSE(frame(bench).link);
  CHECK(holds(reported(bench), "joystick.pilot_absent(" + pipe.path() + ", joystick.permission_missing"));
}

}  // namespace joystick_test

// SPDX-License-Identifier: BSD-3-Clause
// Keys through a pipe and through a pseudo-terminal.
#include "plugins/joystick/keyboard.hpp"

#include <doctest/doctest.h>
#include <pty.h>

#include <cmath>
#include <string>

#include "fulmar/testing.hpp"
#include "pipe.hpp"

namespace keyboard_test {

using namespace fulmar;
using namespace fulmar::hand;
using doctest::Approx;

namespace {

Rc frame(Bench<Keyboard>& bench) {
  bench.step(0.02);
  REQUIRE(bench.out.rc.count == 1);
  return bench.out.rc.items[0];
}

/// Of a keyboard on which so much was pressed.
Rc after(const std::string& keys) {
  Pipe pipe;
  pipe.plug();
  Bench<Keyboard> bench;
  bench.params.device.value = Text<128>(pipe.path());
  pipe.write(keys);
  return frame(bench);
}

}  // namespace

TEST_CASE("each key moves its stick its way, an arrow as its letter does") {
  CHECK(after("").link);
  CHECK(after("d").roll_frac == 0.25);
  CHECK(after("aa").roll_frac == -0.5);
  CHECK(after("\x1b[C").roll_frac == 0.25);
  CHECK(after("\x1bOD").roll_frac == -0.25);
  CHECK(after("s").pitch_frac == 0.25);  // pulled: nose up
  CHECK(after("\x1b[B").pitch_frac == 0.25);
  CHECK(after("\x1b[A").pitch_frac == -0.25);
  CHECK(after("\x1b[1;2C").roll_frac == 0.25);  // with shift
  CHECK(after("e").yaw_frac == 0.25);
  CHECK(after("qq").yaw_frac == -0.5);
  CHECK(after("ddddddd").roll_frac == 1);  // not beyond the end
  CHECK(after("ddsse ").roll_frac == 0);
  CHECK(after("ddsse ").pitch_frac == 0);
  CHECK(after("ddsse ").yaw_frac == 0);
}

TEST_CASE("the throttle stays where it is put, within its range") {
  CHECK(after("rrrf").throttle_frac == Approx(0.1));
  CHECK(after("ff").throttle_frac == 0);
  CHECK(after(std::string(30, 'r')).throttle_frac == 1);
  CHECK(after("rrrx").throttle_frac == 0);
}

TEST_CASE("digits turn the switches over") {
  CHECK(after("").aux4_frac == -1);
  CHECK(after("4").aux4_frac == 1);
  CHECK(after("44").aux4_frac == -1);
  CHECK(after("123").aux1_frac == 1);
  CHECK(after("123").aux2_frac == 1);
  CHECK(after("123").aux3_frac == 1);
  CHECK(after("123").aux4_frac == -1);
}

TEST_CASE("a stick returns with its time constant, by flight time alone, and the throttle does not") {
  Pipe pipe;
  pipe.plug();
  Bench<Keyboard> bench;
  bench.params.device.value = Text<128>(pipe.path());
  frame(bench);
  pipe.write("ddrr");
  CHECK(frame(bench).roll_frac == 0.5);
  Rc rc;
  for (int i = 0; i < 25; ++i) rc = frame(bench);  // 0.5 s
  CHECK(rc.roll_frac == Approx(0.5 * std::exp(-1.0)).epsilon(1e-9));
  CHECK(rc.throttle_frac == Approx(0.1));
}

TEST_CASE("an arrow that comes in pieces is one, and an unknown key is counted and moves nothing") {
  Pipe pipe;
  pipe.plug();
  Bench<Keyboard> bench;
  bench.params.device.value = Text<128>(pipe.path());
  pipe.write("\x1b");
  frame(bench);
  pipe.write("[");
  frame(bench);
  pipe.write("C");
  CHECK(frame(bench).roll_frac == 0.25);
  pipe.write(" zZ\x1b[3~\n");
  const Rc rc = frame(bench);
  CHECK(rc.roll_frac == 0);
  CHECK(bench.out.unknown_keys_ratio.value == 4);  // Delete is one
}

TEST_CASE(
    "a keyboard that goes away is a transmitter that is switched off, and comes back with closed throttle") {
  Pipe pipe;
  pipe.plug();
  Bench<Keyboard> bench;
  bench.params.device.value = Text<128>(pipe.path());
  pipe.write("rrrr4");
  CHECK(frame(bench).throttle_frac == Approx(0.2));
  pipe.pull();
  CHECK_FALSE(frame(bench).link);
  REQUIRE(bench.out.notices.count == 1);
  CHECK(bench.out.notices.items[0].severity == Severity::warning);
  pipe.plug();
  const Rc rc = frame(bench);
  CHECK(rc.link);
  CHECK(rc.throttle_frac == 0);
  CHECK(rc.aux4_frac == -1);
  CHECK(bench.out.notices.count == 1);
}

TEST_CASE("a terminal of another program is left as it is") {
  int master = -1, slave = -1;
  REQUIRE(openpty(&master, &slave, nullptr, nullptr, nullptr) == 0);
  const std::string name = ttyname(slave);
  termios before{}, after{};
  tcgetattr(slave, &before);
  Bench<Keyboard> bench;
  bench.params.device.value = Text<128>(name);
  CHECK_FALSE(frame(bench).link);
  tcgetattr(slave, &after);
  CHECK(after.c_lflag == before.c_lflag);
  close(master);
  close(slave);
}

}  // namespace keyboard_test

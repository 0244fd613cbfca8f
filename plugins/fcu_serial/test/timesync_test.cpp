// SPDX-License-Identifier: BSD-3-Clause
// The controller's clock against a simulated one: drift, jitter, garbage, reboots. All times are simulated.
#include "plugins/fcu_serial/link/timesync.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "fulmar/random.hpp"

namespace timesync_test {

using namespace fulmar;
using namespace fulmar::fcu;

namespace {

constexpr std::int64_t us = 1000, ms = 1'000'000, second = 1'000'000'000;

/// The controller: its clock runs fast by `drift`, cut to whole us, and its messages take their time.
struct Controller {
  Random random{1};
  std::int64_t started_ns = -1234 * second;  // in host time: the true offset
  double drift = 0;
  std::int64_t up_ns = 300 * us, down_ns = 300 * us;  // least, each way
  double up_jitter_ns = 0, down_jitter_ns = 0;        // mean of an exponential

  std::int64_t clock_ns(std::int64_t host_ns) const {
    const std::int64_t elapsed = host_ns - started_ns;
    return (elapsed + std::llround(static_cast<double>(elapsed) * drift)) / us * us;
  }
  std::int64_t delay(std::int64_t least, double jitter) {
    const double u = (static_cast<double>(random.bits() >> 11) + 1) / 9007199254740993.0;
    return least + std::llround(-jitter * std::log(u));
  }
};

struct Answer {
  std::int64_t ts1, tc1, came_ns;
};

Answer ask(ClockSync& clock, Controller& c, std::int64_t now_ns) {
  clock.asked(now_ns);
  const std::int64_t there = now_ns + c.delay(c.up_ns, c.up_jitter_ns);
  return {now_ns, c.clock_ns(there), there + c.delay(c.down_ns, c.down_jitter_ns)};
}
ClockSync::Verdict take(ClockSync& clock, const Answer& a) { return clock.answered(a.ts1, a.tc1, a.came_ns); }

/// How far an event that happens now on the controller is dated wrong.
std::int64_t error_ns(const ClockSync& clock, const Controller& c, std::int64_t now_ns) {
  return std::llabs(c.clock_ns(now_ns) + clock.offset_ns(now_ns) - now_ns);
}

/// Asks at 10 Hz; the worst error after `settled_ns`, looked at 100 times a second.
std::int64_t worst_error(ClockSync& clock, Controller& c, std::int64_t from_ns, std::int64_t until_ns,
                         std::int64_t settled_ns) {
  std::int64_t worst = 0;
  for (std::int64_t t = from_ns; t < until_ns; t += 10 * ms) {
    if (t % (100 * ms) == 0) take(clock, ask(clock, c, t));
    if (t >= settled_ns) worst = std::max(worst, error_ns(clock, c, t + 50 * ms));
  }
  return worst;
}

}  // namespace

TEST_CASE("the first answer gives the offset to half of its round trip") {
  ClockSync clock;
  Controller c;
  CHECK_FALSE(clock.synchronised());
  CHECK(take(clock, ask(clock, c, second)) == ClockSync::Verdict::taken);
  CHECK(clock.synchronised());
  CHECK(clock.round_trip_ns() == 600 * us);
  CHECK(std::llabs(clock.offset_ns(second) - c.started_ns) <= us);
}

TEST_CASE("drift of 50 ppm and jitter of several ms one way leave less than 0.5 ms") {
  for (const double drift : {50e-6, -50e-6, 400e-6}) {
    for (const auto& [up, down] : {std::pair{0.0, 0.0}, {100e3, 3e6}, {3e6, 100e3}, {1e6, 1e6}}) {
      const double up_jitter = up, down_jitter = down;
      CAPTURE(drift);
      CAPTURE(up_jitter);
      CAPTURE(down_jitter);
      ClockSync clock;
      Controller c;
      c.drift = drift;
      c.up_jitter_ns = up_jitter;
      c.down_jitter_ns = down_jitter;
      CHECK(worst_error(clock, c, second, 120 * second, 8 * second) < 500 * us);
      CHECK(std::abs(clock.drift_ppm() + drift * 1e6) < 30);
    }
  }
}

TEST_CASE("on a quiet line the offset holds from the first second on") {
  ClockSync clock;
  Controller c;
  c.drift = 50e-6;
  c.up_jitter_ns = 100e3;
  c.down_jitter_ns = 400e3;
  CHECK(worst_error(clock, c, second, 10 * second, 2 * second) < 500 * us);
}

TEST_CASE("one question in ten is answered 50 ms late, one twice, one never: nothing of it is believed") {
  ClockSync clock;
  Controller c;
  c.drift = 50e-6;
  c.down_jitter_ns = 500e3;
  std::int64_t worst = 0;
  for (std::int64_t t = second; t < 60 * second; t += 100 * ms) {
    Answer a = ask(clock, c, t);
    const std::uint64_t dice = c.random.bits() % 10;
    if (dice == 0) a.came_ns += 50 * ms;
    if (dice == 1) continue;
    CHECK(take(clock, a) == ClockSync::Verdict::taken);
    if (dice == 2) {
      a.came_ns += 70 * ms;
      CHECK(take(clock, a) == ClockSync::Verdict::ignored);  // an answer counts once
    }
    CHECK(clock.answered(a.ts1 - 7, a.tc1, a.came_ns + 1) ==
          ClockSync::Verdict::ignored);  // of another sender's request
    CHECK(clock.answered(t + 5 * second, a.tc1, a.came_ns + 2) ==
          ClockSync::Verdict::ignored);                                         // of the future
    CHECK(clock.answered(t, 0, a.came_ns + 3) == ClockSync::Verdict::ignored);  // a question, not an answer
    CHECK(clock.answered(t, INT64_MAX, a.came_ns + 3) == ClockSync::Verdict::ignored);
    if (t > 3 * second) worst = std::max(worst, error_ns(clock, c, t));
  }
  CHECK(worst < 500 * us);
}

TEST_CASE("an answer that comes after a second is none") {
  ClockSync clock;
  Controller c;
  Answer a = ask(clock, c, second);
  a.came_ns = a.ts1 + ClockSync::patience_ns + 1;
  CHECK(take(clock, a) == ClockSync::Verdict::ignored);
  CHECK_FALSE(clock.synchronised());
}

TEST_CASE("a first answer that was 80 ms late is corrected by the next and is no jump of the clock") {
  ClockSync clock;
  Controller c;
  Answer a = ask(clock, c, second);
  a.came_ns += 80 * ms;
  take(clock, a);
  CHECK(error_ns(clock, c, second) == doctest::Approx(40 * ms).epsilon(0.01));
  CHECK(take(clock, ask(clock, c, 2 * second)) == ClockSync::Verdict::taken);
  CHECK(error_ns(clock, c, 2 * second) < 50 * us);
}

TEST_CASE(
    "a clock that jumps by more than 10 ms is another one once two answers agree; by 5 ms it is followed") {
  for (const std::int64_t jump : {15 * ms, -15 * ms, 20 * second, -20 * second}) {
    CAPTURE(jump);
    ClockSync clock;
    Controller c;
    worst_error(clock, c, second, 20 * second, second);
    c.started_ns += jump;
    CHECK(take(clock, ask(clock, c, 20 * second)) == ClockSync::Verdict::ignored);
    CHECK(take(clock, ask(clock, c, 20 * second + 100 * ms)) == ClockSync::Verdict::jumped);
    CHECK(error_ns(clock, c, 20 * second + 100 * ms) <= us);
    CHECK(take(clock, ask(clock, c, 20 * second + 200 * ms)) == ClockSync::Verdict::taken);
  }
  ClockSync clock;
  Controller c;
  worst_error(clock, c, second, 20 * second, second);
  c.started_ns += 5 * ms;
  CHECK(take(clock, ask(clock, c, 20 * second)) == ClockSync::Verdict::ignored);
  CHECK(take(clock, ask(clock, c, 20 * second + 100 * ms)) == ClockSync::Verdict::taken);
  CHECK(worst_error(clock, c, 20 * second + 200 * ms, 40 * second, 21 * second) < 500 * us);
}

TEST_CASE("a single stamp of another time is not believed") {
  ClockSync clock;
  Controller c;
  worst_error(clock, c, second, 20 * second, second);
  Answer a = ask(clock, c, 20 * second);
  a.tc1 += 3 * second;
  CHECK(take(clock, a) == ClockSync::Verdict::ignored);
  for (int i = 1; i < 20; ++i)
    CHECK(take(clock, ask(clock, c, 20 * second + i * 100 * ms)) == ClockSync::Verdict::taken);
  CHECK(error_ns(clock, c, 22 * second) < 50 * us);
}

TEST_CASE("a silence of minutes is no reboot, however the crystals run") {
  ClockSync clock;
  Controller c;
  c.drift = 200e-6;
  worst_error(clock, c, second, 5 * second, second);
  clock.forget_questions();
  CHECK(take(clock, ask(clock, c, 605 * second)) == ClockSync::Verdict::taken);  // 120 ms apart by now
  CHECK(worst_error(clock, c, 606 * second, 620 * second, 608 * second) < 500 * us);
}

/// The controller sends an inertial sample, which takes 300 us.
void sample(Dater& dater, const Controller& c, std::int64_t host_ns) {
  const auto stamp_us = static_cast<std::uint64_t>(c.clock_ns(host_ns) / us);
  dater.started_anew(stamp_us);
  dater.date_imu(stamp_us, host_ns + 300 * us);
}
/// Samples at 400 Hz, questions at 10 Hz. How often the clock was put back.
int fly(Dater& dater, Controller& c, std::int64_t from_ns, std::int64_t until_ns) {
  int jumps = 0;
  for (std::int64_t t = from_ns; t < until_ns; t += 2500 * us) {
    sample(dater, c, t);
    if (t % (100 * ms) != 0) continue;
    const Answer a = ask(dater.clock, c, t);
    if (dater.answered(a.ts1, a.tc1, a.came_ns) == ClockSync::Verdict::jumped) ++jumps;
  }
  return jumps;
}

TEST_CASE(
    "answers of a controller in simulation that was held up after it had read its clock are no reboot") {
  Dater dater;
  Controller c;
  REQUIRE(fly(dater, c, second, 5 * second) == 0);
  const std::int64_t read_ns = c.clock_ns(5 * second);
  std::vector<std::int64_t> asked;
  for (int i = 0; i < 6; ++i) dater.clock.asked(asked.emplace_back(5 * second + i * 100 * ms));
  for (const std::int64_t t : asked)
    CHECK(dater.answered(t, read_ns, 5600 * ms + t / 1000000) != ClockSync::Verdict::jumped);
  CHECK(fly(dater, c, 5700 * ms, 8 * second) == 0);
  CHECK(error_ns(dater.clock, c, 8 * second) < 200 * us);
}

TEST_CASE(
    "a reboot is seen by the answers when its stamps go on from where the last ones were; a leap forward is "
    "none") {
  Dater dater;
  Controller c;
  c.started_ns = 0;
  REQUIRE(fly(dater, c, second, 4 * second) == 0);
  c.started_ns = 5 * second;  // off the air for 6 s, and rebooted meanwhile: its stamps go on at 5 s
  dater.clock.forget_questions();
  CHECK(fly(dater, c, 10 * second, 13 * second) == 1);
  CHECK(error_ns(dater.clock, c, 13 * second) < 50 * us);
  c.started_ns -= 20 * second;
  CHECK(fly(dater, c, 13 * second, 16 * second) == 0);
  CHECK(error_ns(dater.clock, c, 16 * second) < 50 * us);
}

TEST_CASE("a question from before the unplugging is not answered after it") {
  ClockSync clock;
  Controller c;
  const Answer a = ask(clock, c, second);
  clock.forget_questions();
  CHECK(take(clock, a) == ClockSync::Verdict::ignored);
}

TEST_CASE("dates of inertial samples keep their distance while the line bends") {
  // 2.5 ms apart on the controller; a new answer may move the line by as much as the jitter lets it.
  Dater dater;
  Controller c;
  c.drift = 30e-6;
  c.up_jitter_ns = c.down_jitter_ns = 1e6;
  std::int64_t last = 0, shortest = second, longest = 0;
  for (std::int64_t t = second; t < 30 * second; t += 2'500 * us) {
    if (t % (100 * ms) == 0) take(dater.clock, ask(dater.clock, c, t));
    const std::int64_t at = dater.date_imu(static_cast<std::uint64_t>(c.clock_ns(t) / us), t + 5 * ms);
    CHECK(at <= t + 5 * ms);
    if (t > 5 * second) {
      shortest = std::min(shortest, at - last);
      longest = std::max(longest, at - last);
    }
    last = at;
  }
  CHECK(shortest > 2'400 * us);
  CHECK(longest < 2'600 * us);
}

TEST_CASE(
    "before the first answer, and for impossible stamps, the arrival counts; the impossible are counted") {
  Dater dater;
  CHECK(dater.date_us(123'456, 7 * second) == 7 * second);
  CHECK(dater.date_ms32(5, 7 * second) == 7 * second);
  CHECK(dater.undated() == 0);

  Controller c;
  c.started_ns = -100 * second;
  take(dater.clock, ask(dater.clock, c, 7 * second));
  const auto stamp_us = [&](std::int64_t host_ns) {
    return static_cast<std::uint64_t>(c.clock_ns(host_ns) / us);
  };
  const std::int64_t now = 8 * second;
  CHECK(dater.date_us(stamp_us(now - 4 * ms), now) == doctest::Approx(now - 4 * ms).epsilon(1e-7));
  CHECK(dater.date_us(stamp_us(now + ms), now) == now);  // no later than it came: the error of the offset
  CHECK(dater.undated() == 0);
  CHECK(dater.date_us(stamp_us(now + 50 * ms), now) == now);
  CHECK(dater.date_us(stamp_us(now - second - 10 * ms), now) == now);
  CHECK(dater.date_us(UINT64_MAX, now) == now);
  CHECK(dater.date_ms(UINT64_MAX, now) == now);
  CHECK(dater.undated() == 4);
}

TEST_CASE("stamps in ms are the middle of that ms, also where 32 bits of them wrap after 49.7 days") {
  Dater dater;
  Controller c;
  const std::int64_t wrap_ns = (std::int64_t{1} << 32) * ms;
  c.started_ns = 100 * second - wrap_ns;  // wraps at 100 s of host time
  take(dater.clock, ask(dater.clock, c, 99 * second));
  for (const std::int64_t host :
       {99 * second + 300 * us, 100 * second - 700 * us, 100 * second + 300 * us, 101 * second}) {
    const std::int64_t clock_ms = c.clock_ns(host) / ms;
    const std::int64_t middle = c.started_ns + clock_ms * ms + ms / 2;
    CHECK(std::llabs(dater.date_ms32(static_cast<std::uint32_t>(clock_ms), host + 3 * ms) - middle) <=
          2 * us);
    CHECK(std::llabs(dater.date_ms(static_cast<std::uint64_t>(clock_ms), host + 3 * ms) - middle) <= 2 * us);
  }
  CHECK(dater.undated() == 0);
}

TEST_CASE(
    "inertial samples of equal stamps, and at the first answer, still get increasing times no later than "
    "they came") {
  Dater dater;
  Controller c;
  std::int64_t last = 0;
  for (std::int64_t t = second; t < 2 * second; t += 2'500 * us) {
    if (t == second + 500 * ms) take(dater.clock, ask(dater.clock, c, t - ms));
    const std::int64_t at = dater.date_imu(static_cast<std::uint64_t>(c.clock_ns(t - t % (10 * ms)) / us), t);
    CHECK(at > last);
    CHECK(at <= t);
    last = at;
  }
}

TEST_CASE(
    "two stamps in a row from before the newest are a new beginning; one, or a step of less than 10 ms, is "
    "not") {
  Dater dater;
  CHECK_FALSE(dater.started_anew(50'000'000));
  CHECK_FALSE(dater.started_anew(49'993'000));
  CHECK_FALSE(dater.started_anew(50'002'500));
  CHECK_FALSE(dater.started_anew(49'000'000));  // an old one, come late
  CHECK_FALSE(dater.started_anew(50'005'000));
  CHECK_FALSE(dater.started_anew(1'000));
  CHECK(dater.started_anew(3'500));
  CHECK_FALSE(dater.started_anew(6'000));
  CHECK_FALSE(dater.started_anew(8'500));
  dater.forget_stamps();
  CHECK_FALSE(dater.started_anew(100));
  CHECK_FALSE(dater.started_anew(2'600));
}

TEST_CASE(
    "whatever stamps and answers come, dates are within the second before the arrival, and inertial ones "
    "increase") {
  Random random(9);
  Dater dater;
  std::int64_t now = second, last = 0;
  const auto anything = [&] {
    const std::uint64_t bits = random.bits();
    return bits >> (random.bits() % 64);
  };
  for (int i = 0; i < 20'000; ++i) {
    now += 1 + static_cast<std::int64_t>(random.bits() % (5 * ms));
    if (i % 5 == 0) dater.clock.asked(now);
    dater.clock.answered(i % 3 == 0 ? static_cast<std::int64_t>(anything()) : now,
                         static_cast<std::int64_t>(anything()), now + 1);
    if (dater.started_anew(anything())) dater.clock.restart();
    const std::int64_t arrived = now + 2;
    for (const std::int64_t at : {dater.date_us(anything(), arrived), dater.date_ms(anything(), arrived),
                                  dater.date_ms32(static_cast<std::uint32_t>(anything()), arrived)}) {
      REQUIRE(at <= arrived);
      REQUIRE(at >= arrived - second);
    }
    const std::int64_t at = dater.date_imu(anything(), arrived);
    REQUIRE(at > last);
    REQUIRE(at <= arrived);
    last = at;
  }
  CHECK(dater.undated() > 1000);
}

TEST_CASE("what samples said of the clock before a pause is forgotten: the controller may have stood still") {
  constexpr std::int64_t pause_ms = 2000;
  Dater dater;
  const auto sample = [&](std::int64_t host_ms, std::int64_t stood_ms) {
    dater.date_imu(static_cast<std::uint64_t>((5000 + host_ms - stood_ms) * 1000), host_ms * ms);
  };
  for (std::int64_t t = 0; t < 1000; t += 5) sample(t, 0);
  for (std::int64_t t = 4000; t < 4010; t += 5) sample(t, pause_ms);
  dater.clock.asked(4010 * ms);
  CHECK(dater.answered(4010 * ms, (5000 + 4011 - pause_ms) * ms, 4012 * ms) == ClockSync::Verdict::taken);
}

}  // namespace timesync_test

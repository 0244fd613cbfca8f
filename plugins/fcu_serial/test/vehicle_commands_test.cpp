// SPDX-License-Identifier: BSD-3-Clause
#include <doctest/doctest.h>

#include <limits>

#include "plugins/fcu_serial/commands.hpp"
#include "plugins/fcu_serial/pace.hpp"

namespace vehicle_commands_test {

using namespace fulmar;
using namespace fulmar::fcu;
using doctest::Approx;

namespace {
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

Airframe airframe() {
  Airframe a;
  a.aileron.limit_rad = 0.7;
  a.elevator.limit_rad = 0.5;
  a.rudder.limit_rad = 0.35;
  a.elevator.trim_rad = 0.1;
  return a;
}
}  // namespace

TEST_CASE("radians become shares of the throw, signs as they are, and trims are not added") {
  const auto c = to_offboard({0.25, 0.35, -0.125, 0.07}, Throws::of(airframe()));
  REQUIRE(c);
  CHECK(c->mode == 0);
  CHECK(c->ignore == 0);
  CHECK(c->u[0] == 0.25f);
  CHECK(c->u[1] == 0);
  CHECK(c->u[2] == 0);
  CHECK(c->u[3] == 0.5f);
  CHECK(c->u[4] == -0.25f);
  CHECK(c->u[5] == Approx(0.2));
  for (std::size_t i = 6; i < 10; ++i) CHECK(c->u[i] == 0);
}

TEST_CASE("what the firmware's mixer makes of a command is the deflection that was asked for") {
  // Mixer 9 and an unreversed servo: deflection = u * throw.
  const Airframe a = airframe();
  const auto c = to_offboard({0.5, 0.2, 0.3, -0.1}, Throws::of(a));
  CHECK(c->u[3] * a.aileron.limit_rad == Approx(0.2));
  CHECK(c->u[4] * a.elevator.limit_rad == Approx(0.3));
  CHECK(c->u[5] * a.rudder.limit_rad == Approx(-0.1));
}

TEST_CASE("a reversed surface turns round, the others do not") {
  Airframe a = airframe();
  a.elevator.reversed = true;
  const auto c = to_offboard({0, 0.35, 0.25, 0.07}, Throws::of(a));
  CHECK(c->u[3] == 0.5f);
  CHECK(c->u[4] == -0.5f);
  CHECK(c->u[5] == Approx(0.2));
}

TEST_CASE("commands stay within the throws and throttle within 0 to 1") {
  const auto over = to_offboard({1.5, 2, 2, 2}, Throws::of(airframe()));
  CHECK(over->u[0] == 1);
  CHECK(over->u[3] == 1);
  CHECK(over->u[4] == 1);
  CHECK(over->u[5] == 1);
  const auto under = to_offboard({-0.5, -2, -2, -2}, Throws::of(airframe()));
  CHECK(under->u[0] == 0);
  CHECK(under->u[3] == -1);
  CHECK(under->u[4] == -1);
  CHECK(under->u[5] == -1);
}

TEST_CASE("a command with one value that is not finite is none") {
  const Throws t = Throws::of(airframe());
  CHECK_FALSE(to_offboard({not_a_number, 0, 0, 0}, t));
  CHECK_FALSE(to_offboard({0, not_a_number, 0, 0}, t));
  CHECK_FALSE(to_offboard({0, 0, std::numeric_limits<double>::infinity(), 0}, t));
  CHECK_FALSE(to_offboard({0, 0, 0, not_a_number}, t));
}

TEST_CASE("an airframe without throws is refused, and the surface is named") {
  Airframe a = airframe();
  a.rudder.limit_rad = 0;
  CHECK_THROWS_WITH(Throws::of(a), "airframe.rudder.limit: fcu_serial.throw_too_small(rudder, 0)");
  a.rudder.limit_rad = not_a_number;
  CHECK_THROWS(Throws::of(a));
}

TEST_CASE("auxiliary outputs have their kinds and bounds; those that are off count for nothing") {
  AuxOutputs a;
  a.kinds[1] = AuxKind::servo;
  a.values_ratio[1] = -1.5;
  a.kinds[13] = AuxKind::motor;
  a.values_ratio[13] = -0.5;
  a.kinds[4] = AuxKind::motor;
  a.values_ratio[4] = 0.75;
  a.values_ratio[0] = not_a_number;  // off
  const auto c = to_aux(a);
  REQUIRE(c);
  CHECK(c->type_array[1] == 1);
  CHECK(c->aux_cmd_array[1] == -1);
  CHECK(c->type_array[13] == 2);
  CHECK(c->aux_cmd_array[13] == 0);
  CHECK(c->aux_cmd_array[4] == 0.75f);
  CHECK(c->type_array[0] == 0);
  CHECK(c->aux_cmd_array[0] == 0);
  a.values_ratio[1] = not_a_number;
  CHECK_FALSE(to_aux(a));
}

TEST_CASE(
    "an auxiliary motor that is switched off is stopped; a servo stays, and what never was a motor is left "
    "alone") {
  std::array<bool, 14> motors{};
  AuxOutputs a;
  a.kinds[10] = AuxKind::motor;
  a.values_ratio[10] = 0.6;
  a.kinds[11] = AuxKind::servo;
  a.values_ratio[11] = 0.5;
  const auto sent = [&] {
    RosflightAuxCmd c = *to_aux(a);
    stop_motors(c, motors);
    return c;
  };
  CHECK(sent().aux_cmd_array[10] == 0.6f);
  a.kinds[10] = a.kinds[11] = AuxKind::off;
  for (int i = 0; i < 2; ++i) {
    CHECK(sent().type_array[10] == 2);
    CHECK(sent().aux_cmd_array[10] == 0);
    CHECK(sent().type_array[11] == 0);
    CHECK(sent().type_array[12] == 0);
  }
  a.kinds[10] = AuxKind::servo;
  CHECK(sent().type_array[10] == 1);
  a.kinds[10] = AuxKind::off;
  CHECK(sent().type_array[10] == 0);
}

TEST_CASE("an attitude for the controller is of length 1, or is not sent") {
  const auto c = to_external_attitude({0.95 * 0.8, 0.95 * 0.6, 0, 0});
  REQUIRE(c);
  CHECK(c->qw == doctest::Approx(0.8));
  CHECK(c->qx == doctest::Approx(0.6));
  CHECK_FALSE(to_external_attitude({0, 0, 0, 0}));
  CHECK_FALSE(to_external_attitude({0.5, 0.5, 0, 0}));
  CHECK_FALSE(to_external_attitude({not_a_number, 0, 0, 1}));
}

namespace {
/// Commands that go out in ten seconds of ticks at 400 Hz when each `every`th brings a new one.
int sent_in_ten_seconds(double rate_hz, int every) {
  Pace pace(rate_hz);
  int n = 0;
  for (int i = 0; i < 4000; ++i) {
    const std::int64_t now =
        std::int64_t{i} * 2'500'000 + (i % 3) * 50'000;  // arrivals are not quite regular
    if (!pace.due(i % every == 0, now)) continue;
    pace.sent(now);
    ++n;
  }
  return n;
}
}  // namespace

TEST_CASE("each new command goes out, as far as the rate allows") {
  CHECK(sent_in_ten_seconds(400, 1) == 4000);
  CHECK(sent_in_ten_seconds(400, 4) == 1000);
  CHECK(sent_in_ten_seconds(200, 1) == 2000);
  CHECK(sent_in_ten_seconds(100, 1) == 1000);
}

TEST_CASE("a command is repeated at 20 Hz at least when nobody renews it") {
  const int n = sent_in_ten_seconds(400, 100000);
  CHECK(n >= 200);
  CHECK(n <= 500);
}

TEST_CASE("a new command that came too early goes out when it may") {
  Pace pace(100);
  REQUIRE(pace.due(true, 0));
  pace.sent(0);
  CHECK_FALSE(pace.due(true, 2'500'000));
  CHECK_FALSE(pace.due(false, 7'500'000));
  CHECK(pace.due(false, 10'000'000));
}

TEST_CASE("a tick that was late does not put off the command after it") {
  Pace pace(100);
  REQUIRE(pace.due(true, 0));
  pace.sent(0);
  REQUIRE(pace.due(true, 12'400'000));
  pace.sent(12'400'000);
  CHECK_FALSE(pace.due(true, 17'500'000));
  CHECK(pace.due(true, 20'000'000));
}

}  // namespace vehicle_commands_test

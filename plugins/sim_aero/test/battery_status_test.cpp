// SPDX-License-Identifier: BSD-3-Clause
// The battery in the vehicle's status.
#include <doctest/doctest.h>

#include <cmath>

#include "faulty.hpp"

namespace battery_status_test {

using namespace fulmar;
using namespace fulmar::sim;
using doctest::Approx;

namespace {

constexpr double dt = 0.0025;

Airframe with(double resistance_ohm, double capacity_ah) {
  Airframe a = anaconda();
  a.propulsion.pack.resistance_ohm = resistance_ohm;
  a.propulsion.pack.capacity_ah = capacity_ah;
  return a;
}

}  // namespace

TEST_CASE("status says the voltage at the terminals and the current; the fault `empty` goes on top") {
  auto b = airborne(SensorSet::perfect);
  b->params.airframe.value = with(0.05, 10);
  const auto status = [&](double seconds) {
    for (int i = 0; i < std::lround(seconds / dt); ++i) pass(*b, &level);
    while (!b->out.status.written) pass(*b, &level);
    return b->out.status.value;
  };
  const VehicleStatus s = status(2);
  const double full = anaconda().propulsion.battery_volt;
  CHECK(s.battery_amp > 0.5);
  CHECK((full - s.battery_volt) / (0.05 * s.battery_amp) == Approx(1).epsilon(1e-9));
  b->params.faults.body_that_fails.battery_fault.value = BatteryFault::empty;
  b->params.faults.body_that_fails.battery_fault_time.value = 4;
  b->retune();
  CHECK(status(5).battery_volt == 0);
}

}  // namespace battery_status_test

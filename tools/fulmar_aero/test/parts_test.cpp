// SPDX-License-Identifier: BSD-3-Clause
// `fulmar aero` on servos, propellers, battery and gear, and rejected values with their lines.
#include "tools/fulmar_aero/test/aero_kit.hpp"

namespace parts_test {

using namespace fulmar::aero::test;
using doctest::Approx;

namespace {

const char* const gear = "gear:";

/// The Anaconda with another surface, propulsion or gear; the output of `check`.
Answer checked(const std::string& old, const std::string& by, const std::string& words = "") {
  const Folder folder;
  return call("check " + words + folder.write("a.yaml", changed("anaconda", old, by)));
}

std::string contacts(const std::string& list) { return "gear:\n  contacts: " + list + "\n#"; }

}  // namespace

TEST_CASE("suspicious servos are found" * doctest::test_suite("amounts")) {
  const auto servo = [](const std::string& more) {
    return checked("elevator: {limit: 40 deg,", "elevator: {limit: 40 deg, " + more + ",");
  };
  CHECK(servo("natural_frequency_radps: 10")
            .says("elevator.natural_frequency: aero.servo_frequency_unusual(10, "
                  "aero.servo_frequency_in_hertz(62.8))"));
  const std::string fast = "natural_frequency: 100 rad/s, damping: ";
  CHECK(servo(fast + "17").says("elevator.damping: aero.servo_damping_unusual(17)"));
  CHECK(servo("dead_band_rad: 0.5").says("elevator.dead_band: aero.dead_band_unusual(28.6 deg)"));
  CHECK(servo("max: 30 deg").says("elevator.max: aero.servo_range_small(-40.0 deg, 30.0 deg, 40.0 deg)"));
  CHECK_FALSE(servo(fast + "1.71").says("elevator."));
}

TEST_CASE("elevons that are not alike are found") {
  CHECK(checked("elevator: {limit: 40 deg,", "mixer: elevons\nelevator: {limit: 35 deg,")
            .says("mixer: aero.paired_servos_differ(aileron, elevator, elevon)"));
  CHECK_FALSE(
      checked("elevator: {limit: 40 deg,", "mixer: elevons\nelevator: {limit: 40 deg,").says("mixer"));
}

TEST_CASE("propellers that turn the aircraft, and a battery in milliohm, are found") {
  const auto places = [](const std::string& list) {
    return checked("  battery: 24 V", "  battery: 24 V\n  propellers: " + list);
  };
  const std::string one_side = "[{at_m: [0, 0.5, 0]}, {at_m: [0, 0.5, 0]}]",
                    both_sides = "[{at_m: [0, -0.5, 0]}, {at_m: [0, 0.5, 0], turns: left}]";
  CHECK(places(one_side).says("propulsion.propellers: aero.thrust_off_centre(left, 0.5)"));
  CHECK_FALSE(places(both_sides).says("propellers"));
  CHECK(places("[{at_m: [0, 0, 0], tilt: 180 deg}]").says("aero.forward_thrust_missing"));
  CHECK(checked("  battery: 24 V", "  battery: 24 V\n  pack: {resistance_ohm: 20}")
            .says("aero.pack_resistance_unusual(476)"));
}

TEST_CASE("the gear's attitude is told, and one on which nothing stands is refused with its line") {
  const Answer good =
      checked(gear, contacts("[{at_m: [0.4, 0, 0.25], carries: 0.2}, {at_m: [-0.1, -0.2, 0.25], "
                             "carries: 0.4}, {at_m: [-0.1, 0.2, 0.25], carries: 0.4}]"));
  CHECK(good.says("0.250 m high, pitch 0.0 deg"));
  const Answer two = checked(gear, contacts("[{at_m: [0.4, 0, 0.25], carries: 0.2}, {at_m: [-0.1, 0, 0.25], "
                                            "carries: 0.8}]"));
  CHECK(two.code == 4);
  CHECK(two.says("gear.contacts: sim.contacts_few(2)"));
  const Folder folder;
  const std::string text = changed("anaconda", gear, contacts("[{at_m: [0.4, 0, 0.25], carries: 0.2}]"));
  const std::string file = folder.write("a.yaml", text);
  const auto line =
      1 + std::count(text.begin(), text.begin() + std::ptrdiff_t(text.find("  contacts:")), '\n');
  CHECK(
      call("trim " + file).says(file + ":" + std::to_string(line) + ": gear.contacts: sim.contacts_few(1)"));
}

TEST_CASE("a fault in an item of a list has the item's line") {
  const Answer answer =
      checked("  battery: 24 V",
              "  battery: 24 V\n  propellers:\n    - {at_m: [0, 1, 0]}\n    - {at_m: [0, 0, 0], "
              "differential: 0.2}");
  CHECK(answer.code == 4);
  CHECK(answer.says("propulsion.propellers[1].differential: sim.propeller_in_middle"));
}

}  // namespace parts_test

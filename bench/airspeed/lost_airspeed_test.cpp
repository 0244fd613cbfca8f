// SPDX-License-Identifier: BSD-3-Clause
// Two of the flights of bench_airspeed, with its bounds.
#include <doctest/doctest.h>

#include "bench/airspeed/flight.hpp"

namespace lost_airspeed_test {

using namespace fulmar::lost_airspeed;

namespace {

struct Folder {
  fs::path path = fs::temp_directory_path() / ("fulmar-lost-airspeed-test-" + std::to_string(getpid()));
  Folder() { fs::create_directories(path); }
  ~Folder() { fs::remove_all(path); }
};

}  // namespace

TEST_CASE("without tube and receiver the airspeed comes from the throttle, through climbs and turns") {
  const Folder folder;
  const Case c = case_of("both_60");
  for (const char* sensors : {"ublox", "rosflight"}) {
    CAPTURE(sensors);
    const Flown with = fly(c, sensors, true, 3, folder.path),
                without = fly(c, sensors, false, 3, folder.path);
    CHECK_FALSE(with.crashed);
    CHECK(with.rms() < c.rms_mps);
    CHECK(with.rms() < 0.7 * without.rms());
    CHECK(with.most < c.max_mps);
    CHECK(with.share(with.within_2) > c.within_2);
    CHECK(with.share(with.modelled) > 0.95);
    CHECK(without.modelled == 0);
  }
}

TEST_CASE("a motor that stops meanwhile is no airspeed") {
  const Folder folder;
  const Case c = case_of("motor_off");
  const Flown f = fly(c, "ublox", true, 3, folder.path);
  CHECK(f.share(f.modelled) < c.max_modelled);
  CHECK(f.share(f.modelled) > 0.25);  // it was in use before
  CHECK(f.most < c.max_mps);
}

TEST_CASE("a motor that gets 0.7 of its voltage is found by what it moves the airspeed by, not by a jump") {
  const Folder folder;
  Flown sum;
  for (const unsigned seed : {6u, 7u}) sum.add(fly(case_of("motor_weak"), "ublox", true, seed, folder.path));
  CHECK(sum.share(sum.modelled) < 0.5);  // else 0.63
}

}  // namespace lost_airspeed_test

// SPDX-License-Identifier: BSD-3-Clause
// Four of the flights of bench_sensor_faults, and what it promises of them.
#include <doctest/doctest.h>

#include "bench/sensor_faults/flight.hpp"

namespace sensor_faults_test {

using namespace fulmar::sensor_faults;

namespace {

struct Folder {
  fs::path path = fs::temp_directory_path() / ("fulmar-sensor-faults-test-" + std::to_string(getpid()));
  Folder() { fs::create_directories(path); }
  ~Folder() { fs::remove_all(path); }
};

}  // namespace

TEST_CASE("a sensor that goes bad in flight is told within 2 s, bounded, and right again within 10 s") {
  const Folder folder;
  const Flown nothing = fly(row("nothing"), 3, {}, folder.path);
  CHECK(nothing.reported_s < 0);
  CHECK(nothing.accused == "");
  CHECK_FALSE(nothing.crashed);
  for (const char* name : {"gnss_drift", "pitot_offset", "gyro_saturated", "gnss_pitot_off"}) {
    const Row r = row(name);
    CAPTURE(r.name);
    const Flown f = fly(r, 3, nothing.most, folder.path);
    CHECK_FALSE(f.crashed);
    CHECK(f.shown);
    CHECK(f.reported_s >= 0);
    CHECK(f.reported_s <= 2);
    CHECK(f.recovered_s >= 0);
    CHECK(f.recovered_s <= 10);
    for (std::size_t i = 0; i < whats; ++i) {
      CAPTURE(i);
      CHECK(f.max_valid[i] <= r.most[i]);
    }
    CHECK(f.over_std <= r.max_over_std);
  }
}

TEST_CASE("it flies without a magnetometer from the ground on, and knows its heading to 4 deg") {
  const Folder folder;
  const Row r = row("no_mag");
  const Flown f = fly(r, 3, {}, folder.path);
  CHECK_FALSE(f.crashed);
  CHECK(f.reported_by == "mag never");
  CHECK(f.max_valid[attitude] > 0);
  CHECK(f.most[attitude] < r.most[attitude]);
}

TEST_CASE("a fault that is not there is refused with those that are") {
  std::string words;
  try {
    row("gnss");
  } catch (const std::exception& e) {
    words = e.what();
  }
  CHECK(words.find("sensor_faults.fault_unknown(gnss, nothing, gnss_jump, ") == 0);
}

}  // namespace sensor_faults_test

// SPDX-License-Identifier: BSD-3-Clause
// One flight of each row of bench_safety, and what it promises of it.
#include <doctest/doctest.h>

#include "bench/safety/flight.hpp"
#include "core/run/allocation.hpp"

namespace safety_flights_test {

using namespace fulmar::safety_flights;

namespace {

struct Folder {
  fs::path path = fs::temp_directory_path() / ("fulmar-safety-test-" + std::to_string(getpid()));
  Folder() {
    fs::create_directories(path);
    setenv("FULMAR_STORE", (path / "store").c_str(), 1);
  }
  ~Folder() { fs::remove_all(path); }
};

}  // namespace

TEST_CASE("whatever fails is told in time, answered as the table says, and ends on the ground, whole") {
  const Folder folder;
  for (const char* airframe : {"anaconda", "aerosonde"})
    for (const Row& row : rows_of(airframe)) {
      CAPTURE(airframe);
      CAPTURE(row.name);
      const Flown f = fly(row, 3, folder.path);
      CAPTURE(f.outcome);
      CHECK(f.end == End::on_ground);
      CHECK(f.in_order);
      CHECK(f.touch_sink_mps < 3);
      CHECK(f.outside_m <= 0);
      if (row.cause) {
        CHECK(f.told_s >= 0);
        CHECK(f.told_s <= row.told_within_s);
        CHECK_FALSE((row.at_s > 0 && f.told_else));
      } else {
        CHECK_FALSE(f.told_else);
      }
      if (!fulmar::core::counts_allocations())
        return;  // under the sanitizers a flight takes twenty times as long
    }
}

}  // namespace safety_flights_test

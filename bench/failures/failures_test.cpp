// SPDX-License-Identifier: BSD-3-Clause
// A sample of the flights of bench_failures, and all four classes of its evaluation.
#include <doctest/doctest.h>

#include <set>

#include "bench/failures/flight.hpp"

namespace failures_test {

using namespace fulmar::failing_flights;

namespace {

struct Folder {
  fs::path path = fs::temp_directory_path() / ("fulmar-failures-test-" + std::to_string(getpid()));
  Folder() { fs::create_directories(path); }
  ~Folder() { fs::remove_all(path); }
};

}  // namespace

TEST_CASE("a flight in which something fails by chance does its mission, or a reason names what failed") {
  const Folder folder;
  int named = 0;
  for (const unsigned seed : {4U, 14U, 19U, 20U, 149U, 46U, 57U, 86U}) {
    const Drawn d = draw(seed);
    const Flown f = fly(d, seed, folder.path);
    CAPTURE(seed);
    CAPTURE(d.mission);
    CAPTURE(d.failure);
    CAPTURE(f.missed);
    CAPTURE(f.verdict);
    CAPTURE(f.reason);
    CHECK(f.failed_at_all);
    CHECK((f.of == Class::named || f.of == Class::done));
    named += f.of == Class::named ? 1 : 0;
  }
  CHECK(named >= 7);
}

TEST_CASE("the draws cover every group and mission, and one seed is one draw") {
  std::set<std::string> groups, missions;
  for (unsigned seed = 1; seed <= 100; ++seed) {
    groups.insert(draw(seed).group);
    missions.insert(draw(seed).mission);
    CHECK(draw(seed).at_s == draw(seed).at_s);
  }
  CHECK(groups.size() == 5);
  CHECK(missions.size() == 8);
}

TEST_CASE("a flight whose reason has another name is reported as such, and silence as silence") {
  const Folder folder;
  Drawn d = draw(51);  // a weak motor: 70 m too low at the end, and called flown
  d.names = {"no such word"};
  CHECK(word(fly(d, 51, folder.path).of) == word(Class::silent));
  d = draw(4);
  d.names = {"no such word"};
  CHECK(word(fly(d, 4, folder.path).of) == word(Class::other));
}

}  // namespace failures_test

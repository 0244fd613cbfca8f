// SPDX-License-Identifier: BSD-3-Clause
// The seeds of a campaign, and the statistics of its flights.
#include "tools/fulmar_campaign/seeds.hpp"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "core/error.hpp"

namespace seeds_test {

using nlohmann::json;

TEST_CASE("seeds are a list of numbers and ranges") {
  using fulmar::core::parse_seeds;
  CHECK(parse_seeds("7") == std::vector<std::uint64_t>{7});
  CHECK(parse_seeds("1..4") == std::vector<std::uint64_t>{1, 2, 3, 4});
  CHECK(parse_seeds("3,5,8..10") == std::vector<std::uint64_t>{3, 5, 8, 9, 10});
  CHECK(parse_seeds("18446744073709551615").front() == 18446744073709551615u);
  for (const char* wrong :
       {"", "a", "1..", "..3", "4..1", "1,,2", "-1", "1...3", "0..18446744073709551615"}) {
    CAPTURE(wrong);
    CHECK_THROWS_AS(parse_seeds(wrong), fulmar::core::Error);
  }
}

TEST_CASE("the mean and the deviation of many flights leave out those that failed") {
  std::vector<json> results;
  for (const double north : {1, 2, 3, 4})
    results.push_back({{"result", north == 2 ? "flown with guards" : "flown"},
                       {"seed", north},
                       {"wall_time_s", 1},
                       {"guards", json::array()},
                       {"tracking_rmse", {{"north_m", north}, {"east_m", nullptr}}}});
  results.push_back({{"result", "failed"}, {"seed", 5}, {"tracking_rmse", {{"north_m", 900}}}});
  const json all = fulmar::core::spread(results);
  CHECK(all["flown"] == 4);
  CHECK(all["mean"] == json{{"tracking_rmse", {{"north_m", 2.5}}}});
  const double deviation = all["deviation"]["tracking_rmse"]["north_m"];
  CHECK(deviation == doctest::Approx(1.2909944487358056).epsilon(1e-12));  // sqrt(5 / 3)
  CHECK(all["least"]["tracking_rmse"]["north_m"] == 1);
  CHECK(all["most"]["tracking_rmse"]["north_m"] == 4);
  CHECK(fulmar::core::spread_table(results).find("4 of 5 flights flown") != std::string::npos);
}

}  // namespace seeds_test

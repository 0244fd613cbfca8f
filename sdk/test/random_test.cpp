// SPDX-License-Identifier: BSD-3-Clause
#include "fulmar/random.hpp"

#include <doctest/doctest.h>

#include <cmath>

namespace random_test {

using fulmar::Random;

TEST_CASE("splitmix64 gives the published sequence of seed 1234567") {
  // https://prng.di.unimi.it/splitmix64.c; the values are those that Rosetta Code lists for this seed
  std::uint64_t state = 1234567;
  CHECK(fulmar::splitmix64(state) == 6457827717110365317ULL);
  CHECK(fulmar::splitmix64(state) == 3203168211198807973ULL);
  CHECK(fulmar::splitmix64(state) == 9817491932198370423ULL);
}

TEST_CASE("the same seed gives the same numbers, another seed others") {
  Random a(7), b(7), c(8);
  int equal = 0;
  for (int i = 0; i < 1000; ++i) {
    const double x = a.normal();
    CHECK(x == b.normal());
    equal += x == c.normal();
  }
  CHECK(equal == 0);
}

TEST_CASE("uniform numbers fill [0, 1) evenly") {
  Random random(1);
  constexpr int n = 1000000, cells = 50;
  std::array<int, cells> count{};
  double sum = 0;
  for (int i = 0; i < n; ++i) {
    const double u = random.uniform();
    REQUIRE(u >= 0);
    REQUIRE(u < 1);
    sum += u;
    ++count[static_cast<std::size_t>(u * cells)];
  }
  CHECK(sum / n == doctest::Approx(0.5).epsilon(0.003));
  double chi2 = 0;
  for (int k : count) chi2 += (k - n / cells) * (k - n / cells) / (1.0 * n / cells);
  CHECK(chi2 < 95.0);  // 49 degrees of freedom: exceeded with probability 1e-4
  CHECK(chi2 > 18.0);
}

TEST_CASE("normal numbers have the moments and tails of the normal distribution") {
  Random random(2);
  constexpr int n = 4000000;
  double m1 = 0, m2 = 0, m3 = 0, m4 = 0;
  int beyond1 = 0, beyond2 = 0, beyond3 = 0, beyond4 = 0;
  for (int i = 0; i < n; ++i) {
    const double x = random.normal();
    m1 += x;
    m2 += x * x;
    m3 += x * x * x;
    m4 += x * x * x * x;
    beyond1 += std::abs(x) > 1;
    beyond2 += std::abs(x) > 2;
    beyond3 += std::abs(x) > 3;
    beyond4 += x > 4;
  }
  // four standard errors each
  CHECK(std::abs(m1 / n) < 4 * std::sqrt(1.0 / n));
  CHECK(std::abs(m2 / n - 1) < 4 * std::sqrt(2.0 / n));
  CHECK(std::abs(m3 / n) < 4 * std::sqrt(15.0 / n));
  CHECK(std::abs(m4 / n - 3) < 4 * std::sqrt(96.0 / n));
  const auto near = [](int count, double p) {
    return std::abs(count - n * p) < 4 * std::sqrt(n * p * (1 - p));
  };
  CHECK(near(beyond1, std::erfc(1 / std::sqrt(2))));
  CHECK(near(beyond2, std::erfc(2 / std::sqrt(2))));
  CHECK(near(beyond3, std::erfc(3 / std::sqrt(2))));
  CHECK(near(beyond4, 0.5 * std::erfc(4 / std::sqrt(2))));
}

TEST_CASE("successive normal numbers are uncorrelated, and so are the streams of one seed") {
  Random a(fulmar::mix_seed(5, 1)), b(fulmar::mix_seed(5, 2));
  constexpr int n = 1000000;
  double previous = a.normal(), serial = 0, cross = 0;
  for (int i = 0; i < n; ++i) {
    const double x = a.normal();
    serial += x * previous;
    cross += x * b.normal();
    previous = x;
  }
  CHECK(std::abs(serial / n) < 4 / std::sqrt(n));
  CHECK(std::abs(cross / n) < 4 / std::sqrt(n));
}

}  // namespace random_test

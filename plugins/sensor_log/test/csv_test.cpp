// SPDX-License-Identifier: BSD-3-Clause
#include "../csv.hpp"

#include <doctest/doctest.h>

#include <random>

#include "../order.hpp"

namespace csv_test {

using namespace fulmar::sensor_log;
using Stamps = std::vector<std::int64_t>;

namespace {

Table read(const std::string& text, const std::vector<Wanted>& wanted) {
  return Csv(File{"a.csv", "log.imu.from.file", text}, wanted).read();
}

std::string refusal(const std::string& text, const std::vector<Wanted>& wanted) {
  try {
    read(text, wanted);
  } catch (const std::exception& fault) {
    return fault.what();
  }
  return "";
}

const Wanted t{"t", "log.imu.from.time", 1'000'000'000}, x{"x", "log.imu.rate.columns[0]", 0};

Stamps kept(const Stamps& stamps) {
  Stamps values;
  for (const std::size_t i : in_order(stamps)) values.push_back(stamps[i]);
  return values;
}

/// The length of the longest increasing part, by trying every subset.
std::size_t longest(const Stamps& stamps) {
  std::size_t best = 0;
  for (unsigned subset = 0; subset < 1U << stamps.size(); ++subset) {
    Stamps part;
    for (std::size_t i = 0; i < stamps.size(); ++i)
      if ((subset >> i & 1U) != 0) part.push_back(stamps[i]);
    bool rises = true;
    for (std::size_t i = 1; i < part.size(); ++i) rises = rises && part[i - 1] < part[i];
    if (rises) best = std::max(best, part.size());
  }
  return best;
}

}  // namespace

TEST_CASE(
    "columns are found by name, wherever they are; comments, blanks, quotes and DOS line ends count for "
    "nothing") {
  const Table table = read(
      "\xef\xbb\xbf# made by hand\r\n\r\n \"x\" , other, t\r\n 1.5,nothing to do with it,0\r\n# "
      "gap\r\n-2e3,,0.25\r\n",
      {t, x});
  REQUIRE(table.rows() == 2);
  CHECK(table.columns[0].stamps_ns == Stamps{0, 250'000'000});
  CHECK(table.columns[1].numbers == std::vector<double>{1.5, -2000});
  CHECK(table.lines == std::vector<std::size_t>{4, 6});
}

TEST_CASE("stamps are exact to the nanosecond, whatever their unit, where a double would round") {
  CHECK(stamp_of("1384992000.123456789", 1'000'000'000) == 1'384'992'000'123'456'789);
  CHECK(stamp_of("-0.5", 1'000'000'000) == -500'000'000);
  CHECK(stamp_of("1384992000123456.789", 1'000) == 1'384'992'000'123'456'789);
  CHECK(stamp_of("1384992000123456789", 1) == 1'384'992'000'123'456'789);
  CHECK(stamp_of("12.", 1'000'000) == 12'000'000);
  const Table table = read("t,x\n2.5e-1,1\n", {t, x});
  CHECK(table.columns[0].stamps_ns[0] == 250'000'000);
}

TEST_CASE("what is no stamp is none: empty, infinite, beyond 95 years in any unit") {
  for (const char* text : {"", "1:30", "9223372036854775807", "-9223372036854775808", "3000000001"})
    CHECK(stamp_of(text, 1'000'000'000) == no_stamp);
  const Table table = read("t,x\n,1\nnan,2\n-inf,3\n1e300,4\n9e18,5\n", {t, x});
  CHECK(table.columns[0].stamps_ns == Stamps(5, no_stamp));
}

TEST_CASE("an empty cell is not a number, an overflow is infinite, an underflow zero") {
  const Table table = read("t,x\n1,\n2,NaN\n3,-1e999\n4,1e-999\n", {t, x});
  const std::vector<double>& numbers = table.columns[1].numbers;
  REQUIRE(numbers.size() == 4);
  CHECK(std::isnan(numbers[0]));
  CHECK(std::isnan(numbers[1]));
  CHECK(std::isinf(numbers[2]));
  CHECK(numbers[3] == 0);
}

TEST_CASE("a missing column is told with the key that names it, the line, and the columns that are there") {
  CHECK(refusal("# a\nt,y,z\n1,2,3\n", {t, x}) ==
        "log.imu.rate.columns[0]: sensor_log.column_unknown(x, a.csv:2, t, y, z)");
  CHECK(refusal("t,x,x\n1,2,3\n", {t, x}) ==
        "log.imu.rate.columns[0]: sensor_log.column_repeated(a.csv:1, x)");
}

TEST_CASE("what is no number is told with its line, its column and itself") {
  CHECK(refusal("t,x\n1,2\n2,3;4\n", {t, x}) ==
        "log.imu.rate.columns[0]: sensor_log.number_not_valid(a.csv:3, 3;4, x)");
  CHECK(refusal("t,x\n1:30,2\n", {t, x}) ==
        "log.imu.from.time: sensor_log.number_not_valid(a.csv:2, 1:30, t)");
  CHECK(refusal("t,x\n1,2\n2,0x1p3\n", {t, x}) != "");
}

TEST_CASE(
    "a file that ends early is told with its last line: within a row, within a number, before the first "
    "row") {
  CHECK(refusal("t,x\n1,2\n2", {t, x}) == "log.imu.from.file: sensor_log.row_of_one_cell(a.csv:3, 2)");
  CHECK(refusal("t,x\n1,2\n2,2", {t, x}) == "log.imu.from.file: sensor_log.last_line_cut(a.csv:3)");
  CHECK(refusal("", {t, x}) == "log.imu.from.file: sensor_log.file_empty(a.csv)");
  CHECK(refusal("t,x\n1,2,3\n", {t, x}) == "log.imu.from.file: sensor_log.row_too_long(a.csv:2, 3, 2)");
}

TEST_CASE("every beginning of a file is read or refused, never anything else") {
  const std::string whole = "t,x\n1,2.5\n2,-3\n";
  for (std::size_t n = 0; n < whole.size(); ++n) {
    const std::string said = refusal(whole.substr(0, n), {t, x});
    const bool row_ends = n == 4 || n == 10;
    CHECK_MESSAGE(said.empty() == row_ends, n << ": " << said);
  }
}

TEST_CASE(
    "of stamps that go back or repeat the earlier row stays, and one that lies years ahead costs itself "
    "alone") {
  CHECK(kept({0, 1, 2, 3}) == Stamps{0, 1, 2, 3});
  CHECK(in_order({0, 1, 1, 2}) == std::vector<std::size_t>{0, 1, 3});
  CHECK(kept({0, 1, 2, 1, 3}) == Stamps{0, 1, 2, 3});
  CHECK(in_order({0, 10, 20, 15, 30}) == std::vector<std::size_t>{0, 1, 2, 4});
  CHECK(kept({0, 1, 999, 2, 3}) == Stamps{0, 1, 2, 3});
  CHECK(kept({}).empty());
}

TEST_CASE("as few stamps as possible are left out") {
  std::mt19937 random(5);
  for (int n = 0; n < 300; ++n) {
    Stamps stamps(1 + random() % 10);
    for (std::int64_t& each : stamps) each = random() % 8;
    const Stamps part = kept(stamps);
    for (std::size_t i = 1; i < part.size(); ++i) CHECK(part[i - 1] < part[i]);
    CHECK(part.size() == longest(stamps));
  }
}

}  // namespace csv_test

// SPDX-License-Identifier: BSD-3-Clause
#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "tools/fulmar_report/test/report_kit.hpp"

namespace report_test {

using report::Columns;

TEST_CASE("columns are unpacked bit by bit, with times before the flight and NaN") {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const Columns c{{-50000, -49900, 0, 0, 2'000'000'000},
                  {{1, 1, -0.f, 3.25f, nan}, {0, 1e-30f, 1e30f, 5, 5}}};
  const Columns back = columns_of(report::packed(c), 5, 2);
  CHECK(back.t == c.t);
  REQUIRE(back.values.size() == 2);
  CHECK(back.values[1] == c.values[1]);
  for (std::size_t i = 0; i < 5; ++i)
    CHECK(std::bit_cast<std::uint32_t>(back.values[0][i]) == std::bit_cast<std::uint32_t>(c.values[0][i]));
  CHECK(columns_of(report::packed(Columns{{7}, {}}), 1, 0).t == std::vector<std::int32_t>{7});
  CHECK(unpacked(report::packed(Columns{})).empty());
}

TEST_CASE("a stream with few changes is short") {
  Columns steady;
  steady.values.resize(1);
  for (int i = 0; i < 10'000; ++i) {
    steady.t.push_back(100 * i);
    steady.values[0].push_back(17);
  }
  CHECK(report::packed(steady).size() < 400);  // 80 kB as it is
}

TEST_CASE("messages follow their lengths; base64 is that of RFC 4648, section 10") {
  CHECK(unpacked(report::packed(std::vector<std::string>{"ab", "", "c"})) ==
        std::string("\2\0\0\0ab\0\0\0\0\1\0\0\0c", 15));
  CHECK(report::base64("") == "");
  CHECK(report::base64("f") == "Zg==");
  CHECK(report::base64("fo") == "Zm8=");
  CHECK(report::base64("foobar") == "Zm9vYmFy");
  CHECK(report::base64("\xff\xfe") == "//4=");
}

TEST_CASE("each time interval keeps its largest error with the reported standard deviation") {
  Columns c;
  c.values.resize(2);
  for (int i = 0; i < 1000; ++i) {
    c.t.push_back(10 * i);
    c.values[0].push_back(i == 333 ? -9.f : i == 334 ? 8.f : 0.01f * static_cast<float>(i % 7));
    c.values[1].push_back(static_cast<float>(i));
  }
  const Columns thin = report::thinned_to_peaks(c, 100);
  REQUIRE(thin.t.size() == 100);
  CHECK(std::is_sorted(thin.t.begin(), thin.t.end()));
  const auto peak = std::find(thin.values[0].begin(), thin.values[0].end(), -9.f);
  REQUIRE(peak != thin.values[0].end());
  const auto at = static_cast<std::size_t>(peak - thin.values[0].begin());
  CHECK(thin.t[at] == 3330);
  CHECK(thin.values[1][at] == 333);
  CHECK(report::thinned_to_peaks(c, 1000).t == c.t);
  CHECK(report::thinned_to_peaks(c, 2000).t == c.t);
  CHECK(report::every(c, 400).t == std::vector<std::int32_t>{0, 4000, 8000});
  CHECK(report::every(c, 400).values[1] == std::vector<float>{0, 400, 800});
}

TEST_CASE("times are rounded to tenths of a millisecond, and limited to the range") {
  CHECK(report::tenths_of_ms(49'999) == 0);
  CHECK(report::tenths_of_ms(-50'001) == -1);
  CHECK(report::tenths_of_ms(2'500'000) == 25);
  CHECK(report::tenths_of_ms(std::numeric_limits<std::int64_t>::max()) == 2'147'483'647);
  CHECK(report::tenths_of_ms(std::numeric_limits<std::int64_t>::min()) == -2'147'483'647);
}

}  // namespace report_test

// SPDX-License-Identifier: BSD-3-Clause
// Numbers over time as compressed text for the page of a report.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace fulmar::report {

/// Columns of one length. Times are in tenths of a millisecond of flight: 59 hours fit.
struct Columns {
  std::vector<std::int32_t> t;
  std::vector<std::vector<float>> values;  ///< one per field
};

/// Base64 of zlib of the columns in sequence, the times first. A time is stored as the difference to the one
/// before, a value as the bits that differ from the one before. The lowest bytes of a column come first, then
/// the second lowest bytes, and so on.
std::string packed(const Columns& columns);

/// Base64 of zlib of messages as in the log, each after its length (4 bytes, little endian).
std::string packed(const std::vector<std::string>& messages);

/// At most `most` rows of `series` (error and reported standard deviation): the row with the largest absolute
/// error of each time interval.
Columns thinned_to_peaks(const Columns& series, std::size_t most);

/// Every n-th row.
Columns every(const Columns& columns, std::size_t n);

/// Flight time, rounded and limited to the range.
std::int32_t tenths_of_ms(std::int64_t ns);

std::string base64(std::string_view bytes);
/// RFC 1950, called "deflate" in browsers.
std::string compressed(const std::string& bytes);

}  // namespace fulmar::report

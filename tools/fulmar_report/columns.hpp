// SPDX-License-Identifier: BSD-3-Clause
// Numbers over time as text that is short and that a browser unpacks: what a report is made of.
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

/// zlib, in base64, of the columns one behind the other, the times first. Of each number there stays what is
/// new: of a time the difference to the one before, of a value its bits that differ from those before. Then
/// the lowest byte of each, the second lowest of each, and so on.
std::string packed(const Columns& columns);

/// Messages as they are in the log, each behind its length (4 bytes, little endian); zlib, in base64.
std::string packed(const std::vector<std::string>& messages);

/// So many rows at most, from `series`: an error, and what is claimed for it. Of equal parts of the time the
/// row with the largest error in size.
Columns thinned_to_peaks(const Columns& series, std::size_t most);

/// Every n-th row.
Columns every(const Columns& columns, std::size_t n);

/// Flight time, rounded; what does not fit is the nearest that does.
std::int32_t tenths_of_ms(std::int64_t ns);

std::string base64(std::string_view bytes);
/// As RFC 1950 has it, which browsers call "deflate".
std::string compressed(const std::string& bytes);

}  // namespace fulmar::report

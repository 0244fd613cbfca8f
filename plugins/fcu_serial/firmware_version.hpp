// SPDX-License-Identifier: BSD-3-Clause
// The controller's firmware by its version, as `git describe` writes it: "v2.0.1-3-gabc"; a build without
// tags is a bare hash.
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace fulmar::fcu {

inline constexpr std::int32_t oldest_firmware = 2;
/// The tested release, as in docs/hardware.md. Releases before it swap the choice between primary and
/// secondary mixer.
inline constexpr std::string_view tried_firmware = "2.0.1";

inline std::string_view without_v(std::string_view text) {
  if (!text.empty() && (text[0] == 'v' || text[0] == 'V')) text.remove_prefix(1);
  return text;
}

/// The first number of "v2.0.1-3-gabc" or "2.0"; no value for other texts.
inline std::optional<std::int32_t> major_version(std::string_view version) {
  const std::string_view text = without_v(version);
  std::int32_t major = 0;
  std::size_t n = 0;
  for (; n < text.size() && n < 4 && text[n] >= '0' && text[n] <= '9'; ++n)
    major = 10 * major + (text[n] - '0');
  if (n == 0 || n >= text.size() || text[n] != '.') return {};
  return major;
}

/// True for the tested release or one a few commits later.
inline bool tried(std::string_view version) {
  const std::string_view text = without_v(version);
  return text.substr(0, tried_firmware.size()) == tried_firmware &&
         (text.size() == tried_firmware.size() || text[tried_firmware.size()] == '-');
}

}  // namespace fulmar::fcu

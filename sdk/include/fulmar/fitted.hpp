// SPDX-License-Identifier: BSD-3-Clause
// A message of a catalogue as a text of limited size, for notices and answers.
#pragma once
#include <cstddef>

#include "fulmar/diagnostic.hpp"
#include "fulmar/message.hpp"

namespace fulmar {

/// `notice.text = fitted<96>(path_messages::go_around_slope, height)`. A longer text is cut. [tick]
template <std::size_t Size, std::size_t N, class... Values>
Text<Size> fitted(const MessageText<N>& message, const Values&... values) noexcept {
  Text<Size> made;
  message.write(made.bytes.data(), made.bytes.size(), values...);
  return made;
}

}  // namespace fulmar

// SPDX-License-Identifier: BSD-3-Clause
// Use of the radio's channels, by the controller's parameters. rosflight_firmware 2.0, rc.cpp: a channel is
// (us - 1000) / 1000, a switch is on from 0.8, or below 0.2 when it is reversed; it counts only on channels 4
// to RC_NUM_CHN - 1, from 0.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "tools/fulmar_fcu/params.hpp"

namespace fulmar::fcu {

struct RadioMap {
  enum Switch : std::size_t { arm, attitude_override, throttle_override, switches };
  int x = 0, y = 1, z = 3, f = 2, channels = 6;
  std::array<int, switches> channel{-1, -1, -1};
  std::array<bool, switches> turned{};

  bool mapped(Switch s) const { return channel[s] > 3 && channel[s] < channels && channel[s] < 8; }
  bool on(Switch s, const RcChannels& rc) const;
  double throttle(const RcChannels& rc) const;  ///< 0 to 1
};

RadioMap radio_map(const std::vector<Param>& params);
std::vector<std::string> map_faults(const RadioMap& map);
/// The displayed channels count from 1.
std::string map_words(const RadioMap& map);
std::array<std::uint16_t, 8> channels_us(const RcChannels& rc);

}  // namespace fulmar::fcu

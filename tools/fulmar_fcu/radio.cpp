// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_fcu/radio.hpp"

#include <algorithm>

#include "tools/fulmar_fcu/messages.hpp"

namespace fulmar::fcu {

namespace {

int whole(const std::vector<Param>& params, const std::string& name) {
  const auto it = std::find_if(params.begin(), params.end(), [&](const Param& p) { return p.name == name; });
  return it == params.end() ? -1 : static_cast<int>(it->number());
}

double value(const RcChannels& rc, int channel) {
  return channel < 0 || channel > 7 ? 0
                                    : (channels_us(rc)[static_cast<std::size_t>(channel)] - 1000.0) / 1000.0;
}

}  // namespace

std::array<std::uint16_t, 8> channels_us(const RcChannels& rc) {
  return {rc.chan1_raw, rc.chan2_raw, rc.chan3_raw, rc.chan4_raw,
          rc.chan5_raw, rc.chan6_raw, rc.chan7_raw, rc.chan8_raw};
}

bool RadioMap::on(Switch s, const RcChannels& rc) const {
  if (!mapped(s)) return false;
  const double v = value(rc, channel[s]);
  return turned[s] ? v < 0.2 : v >= 0.8;
}

double RadioMap::throttle(const RcChannels& rc) const { return value(rc, f); }

RadioMap radio_map(const std::vector<Param>& params) {
  RadioMap map;
  map.x = whole(params, "RC_X_CHN");
  map.y = whole(params, "RC_Y_CHN");
  map.z = whole(params, "RC_Z_CHN");
  map.f = whole(params, "RC_F_CHN");
  map.channels = whole(params, "RC_NUM_CHN");
  map.channel = {whole(params, "RC_ARM_CHN"), whole(params, "RC_ATT_OVRD_CHN"),
                 whole(params, "RC_THR_OVRD_CHN")};
  for (std::size_t s = 0; s < RadioMap::switches; ++s)
    map.turned[s] = map.channel[s] >= 4 && map.channel[s] <= 7 &&
                    whole(params, "SWITCH_" + std::to_string(map.channel[s] + 1) + "_DIR") < 0;
  return map;
}

std::vector<std::string> map_faults(const RadioMap& map) {
  std::vector<std::string> out;
  const std::array<int, 4> sticks{map.x, map.y, map.z, map.f};
  for (std::size_t i = 0; i < sticks.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (sticks[i] == sticks[k]) out.push_back(fcu_messages::sticks_on_one_channel(sticks[i] + 1));
  if (std::any_of(sticks.begin(), sticks.end(),
                  [&](int c) { return c < 0 || c >= std::min(map.channels, 8); }))
    out.push_back(fcu_messages::stick_channel_invalid(map.channels - 1));
  if (!map.mapped(RadioMap::attitude_override))
    out.push_back(
        fcu_messages::override_switch_missing(map.channel[RadioMap::attitude_override], map.channels - 1));
  if (!map.mapped(RadioMap::throttle_override))
    out.push_back(
        fcu_messages::throttle_switch_missing(map.channel[RadioMap::throttle_override], map.channels - 1));
  if (map.channel[RadioMap::arm] >= 0 && !map.mapped(RadioMap::arm))
    out.push_back(fcu_messages::arm_channel_invalid(map.channel[RadioMap::arm], map.channels - 1));
  if (map.mapped(RadioMap::arm) && (map.channel[RadioMap::arm] == map.channel[RadioMap::attitude_override] ||
                                    map.channel[RadioMap::arm] == map.channel[RadioMap::throttle_override]))
    out.push_back(fcu_messages::switch_shared());
  return out;
}

std::string map_words(const RadioMap& map) {
  const auto number = [](int channel) { return std::to_string(channel + 1); };
  return fcu_messages::radio_channel_map(
             number(map.x), number(map.y), number(map.f), number(map.z),
             number(map.channel[RadioMap::attitude_override]),
             map.channel[RadioMap::throttle_override] == map.channel[RadioMap::attitude_override]
                 ? ""
                 : ", throttle override " + number(map.channel[RadioMap::throttle_override]),
             map.mapped(RadioMap::arm) ? ", arm " + number(map.channel[RadioMap::arm])
                                       : ", armed by the sticks")
      .line();
}

}  // namespace fulmar::fcu

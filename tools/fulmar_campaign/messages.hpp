// SPDX-License-Identifier: BSD-3-Clause
// The messages of this folder: code, arguments, sentence (fulmar/diagnostic.hpp).
#pragma once
#include "fulmar/diagnostic.hpp"

namespace fulmar::campaign_messages {

inline constexpr MessageText build_failed{"campaign.build_failed",
                                          "the build failed; what flew before stays as it is"};
inline constexpr MessageText build_without_watch{"campaign.build_without_watch",
                                                 "--build belongs to --watch"};
inline constexpr MessageText seeds_on_hardware{
    "campaign.seeds_on_hardware", "--seeds belongs to a simulation: on hardware nothing is drawn by chance"};
inline constexpr MessageText watched_file_missing{
    "campaign.watched_file_missing", {"file"}, "{file} is gone; waiting for it"};

}  // namespace fulmar::campaign_messages

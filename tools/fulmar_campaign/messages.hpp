// SPDX-License-Identifier: BSD-3-Clause
// The messages of this folder: code, arguments, sentence (fulmar/diagnostic.hpp).
#pragma once
#include "fulmar/diagnostic.hpp"

namespace fulmar::campaign_messages {

inline constexpr MessageText build_failed{"campaign.build_failed",
                                          "the build failed; the former build stays in use"};
inline constexpr MessageText build_without_watch{"campaign.build_without_watch",
                                                 "--build requires --watch; add --watch, or omit --build"};
inline constexpr MessageText seeds_on_hardware{
    "campaign.seeds_on_hardware",
    "--seeds requires a simulation: hardware has no random draws. Omit --seeds, or fly with --io sim"};
inline constexpr MessageText watched_file_missing{
    "campaign.watched_file_missing", {"file"}, "{file} is missing; the watch waits for it"};

}  // namespace fulmar::campaign_messages

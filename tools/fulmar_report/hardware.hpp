// SPDX-License-Identifier: BSD-3-Clause
// Flight controller of a flight on hardware: firmware, calibration, link, battery, radio, time in control.
#pragma once
#include <filesystem>
#include <nlohmann/json_fwd.hpp>

namespace fulmar::report {

/// Null without a link to a flight controller in the log. Figures without messages are null.
nlohmann::json hardware_of(const std::filesystem::path& log);

}  // namespace fulmar::report

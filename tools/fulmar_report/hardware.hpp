// SPDX-License-Identifier: BSD-3-Clause
// With which controller a flight was flown on hardware: firmware, calibration, link, battery, radio, and who
// flew how long.
#pragma once
#include <filesystem>
#include <nlohmann/json_fwd.hpp>

namespace fulmar::report {

/// Null of a log that holds no link of a flight controller. Figures that it has no messages for are null.
nlohmann::json hardware_of(const std::filesystem::path& log);

}  // namespace fulmar::report

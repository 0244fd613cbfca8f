// SPDX-License-Identifier: BSD-3-Clause
// The messages of this folder: code, arguments, sentence (fulmar/diagnostic.hpp).
#pragma once
#include "fulmar/diagnostic.hpp"

namespace fulmar::sensor_faults_messages {

inline constexpr MessageText fault_unknown{
    "sensor_faults.fault_unknown", {"fault", "choices"}, "no fault '{fault}'; valid: {choices}"};
inline constexpr MessageText mag_missing{
    "sensor_faults.mag_missing", {"sensors"}, "configs/sensors/{sensors}.yaml has no line of a magnetometer"};

}  // namespace fulmar::sensor_faults_messages

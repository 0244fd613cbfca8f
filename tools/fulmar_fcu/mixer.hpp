// SPDX-License-Identifier: BSD-3-Clause
// The controller's mixer from its parameters: ten commands to ten outputs. Rows u[0] throttle, u[3] aileron,
// u[4] elevator, u[5] rudder on a fixed wing. rosflight_firmware 2.0, mixer.cpp: PRI_MIXER_i_j is from
// command i to output j.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "tools/fulmar_fcu/params.hpp"

namespace fulmar::fcu {

enum class OutputKind : std::uint8_t { none = 0, servo = 1, motor = 2, gpio = 3 };
using Matrix = std::array<std::array<double, 10>, 10>;  ///< [command][output]

struct Mixer {
  int choice = 255, secondary_choice = 255;
  std::array<OutputKind, 10> kind{};
  std::array<double, 10> rate_hz{};
  Matrix primary{}, secondary{};

  /// Outputs that a command moves in the secondary matrix, which is for commands of a computer.
  std::vector<int> outputs_of(int command) const;
};

inline constexpr int row_throttle = 0, row_aileron = 3, row_elevator = 4, row_rudder = 5;

/// From a full list of parameters.
Mixer mixer_of(const std::vector<Param>& params);
/// Faults for a fixed wing, one sentence each with the remedy; empty for none.
std::vector<std::string> mixer_faults(const Mixer& mixer);
/// Remarks that do not prevent a flight.
std::vector<std::string> mixer_remarks(const Mixer& mixer);
/// "aileron", "elevator and rudder", "motor", "not used".
std::string output_words(const Mixer& mixer, int output);
std::string mixer_name(int choice);
std::string mixer_text(const Mixer& mixer);

}  // namespace fulmar::fcu

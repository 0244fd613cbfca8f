// SPDX-License-Identifier: BSD-3-Clause
// Response of an output to an input: figures of a step, and the frequency response. For series in memory,
// independent of logs.
#pragma once
#include <optional>
#include <vector>

namespace fulmar::response {

/// Times in s, strictly increasing, and the same number of values.
struct Series {
  std::vector<double> t_s, x;
};

/// Definitions: Nise, Control Systems Engineering (2011), section 4.6; with the levels given at each field.
struct StepFigures {
  double at_s = 0, until_s = 0;                // the step, and where the input steps again or the series end
  double input_change = 0;                     // means of up to 1 s before, and from the step on
  double output_before = 0, output_after = 0;  // means of up to 1 s before, and of the last fifth
  std::optional<double> rise_s;                // from 10 % to 90 % of the output's change
  std::optional<double> settling_s;            // from the step until it stays in the band; empty: never
  double overshoot_percent = 0;                // of the output's change, beyond it
  double peak_s = 0;                           // from the step to the farthest value in its direction
  double output_change() const { return output_after - output_before; }
  double steady_gain() const { return output_change() / input_change; }
  /// In the output's unit; meaningful when input and output have the same unit.
  double steady_error() const { return input_change - output_change(); }
};

/// The largest step of the input, the first of equal ones, and its response. `band`: 0.05 for 5 %. Throws
/// core::Error when the input has no step or the output does not move.
StepFigures step_figures(const Series& input, const Series& output, double band);

struct Frequency {
  double hz = 0;
  double gain = 0;       // output per input
  double phase_rad = 0;  // without jumps of a turn, from the lowest frequency on
  double coherence = 0;  // squared: the share of the output's power that the input explains
  double gain_std = 0;   // of the gain, relative, due to noise
};

struct FrequencyResponse {
  double rate_hz = 0, segment_s = 0;
  std::size_t segments = 0;
  std::vector<Frequency> at;  // frequencies with enough excitation
};

/// Welch's estimate, H1: segments of `segment_s` (0: a quarter of the time) that overlap by half, with a Hann
/// window, so that a mean has an effect on the first frequency only. Gain and phase are S_xy / S_xx,
/// coherence |S_xy|^2 / (S_xx S_yy). Bendat & Piersol, Random Data (2010), sections 6.1, 9.2 and 11.5.
/// Frequencies are those from the second of the segment up to 0.4 of the rate at which the input has a
/// thousandth of the largest power density. Throws core::Error when a series has a gap, or is too short for
/// three segments.
FrequencyResponse frequency_response(const Series& input, const Series& output, double segment_s = 0);

}  // namespace fulmar::response

// SPDX-License-Identifier: BSD-3-Clause
// See response_command.hpp.
#include "tools/fulmar_log/response_command.hpp"

#include <spdlog/fmt/fmt.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "core/error.hpp"
#include "tools/fulmar_log/messages.hpp"
#include "tools/fulmar_log/response_series.hpp"
#include "tools/fulmar_log/terminal.hpp"
#include "tools/log_reading/log_file.hpp"

namespace fulmar::response {
namespace {

using core::Error;
using core::printable;
using nlohmann::json;

constexpr std::size_t max_rows = 24;  // of the table; --json has all

double degrees(double rad) { return rad * 180 / std::numbers::pi; }
double decibel(double gain) { return 20 * std::log10(gain); }
bool same_unit(const std::array<Signal, 2>& s) { return s[0].unit == s[1].unit; }

json signal_json(const Signal& s) {
  return {{"field", s.name}, {"unit", s.unit}, {"samples", s.series.x.size()}, {"left_out", s.left_out}};
}
template <class T>
json or_null(const std::optional<T>& x) {
  return x ? json(*x) : json(nullptr);
}

json step_json(const StepFigures& f, double band, bool same) {
  return {{"step_time_s", f.at_s},
          {"end_time_s", f.until_s},
          {"input_change", f.input_change},
          {"output_change", f.output_change()},
          {"rise_time_s", or_null(f.rise_s)},
          {"overshoot_percent", f.overshoot_percent},
          {"peak_time_s", f.peak_s},
          {"settling_time_s", or_null(f.settling_s)},
          {"settling_band_percent", 100 * band},
          {"steady_gain", f.steady_gain()},
          {"steady_error", same ? json(f.steady_error()) : json(nullptr)}};
}
json frequency_json(const FrequencyResponse& r) {
  json rows = json::array();
  for (const Frequency& f : r.at)
    rows.push_back({{"frequency_hz", f.hz},
                    {"gain", f.gain},
                    {"gain_db", f.gain > 0 ? json(decibel(f.gain)) : json(nullptr)},
                    {"gain_std_percent", 100 * f.gain_std},
                    {"phase_deg", degrees(f.phase_rad)},
                    {"coherence", f.coherence}});
  return {{"rate_hz", r.rate_hz}, {"segment_s", r.segment_s}, {"segments", r.segments}, {"rows", rows}};
}

std::string seconds_or_dash(const std::optional<double>& s) {
  return s ? fmt::format("{:10.3f} s", *s) : fmt::format("{:>10}", "-");
}
std::string head_text(const Signal& s, const char* what) {
  std::string out = fmt::format("{:<7} {}: {} samples, {:.2f} s to {:.2f} s\n", what, printable(s.name),
                                s.series.x.size(), s.series.t_s.front(), s.series.t_s.back());
  if (s.left_out > 0)
    out += fmt::format("  {} more are no numbers, or not later than the one before: left out\n", s.left_out);
  return out;
}
std::string step_text(const StepFigures& f, double band, const std::array<Signal, 2>& s) {
  std::string out = fmt::format("\nstep of {:.4g} {} at {:.2f} s, looked at until {:.2f} s\n", f.input_change,
                                s[0].unit, f.at_s, f.until_s);
  out += fmt::format("  {:<24} {}\n", "rise time, 10 to 90 %", seconds_or_dash(f.rise_s));
  out += fmt::format("  {:<24} {:10.1f} %\n", "overshoot", f.overshoot_percent);
  out += fmt::format("  {:<24} {:10.3f} s\n", "peak time", f.peak_s);
  out += fmt::format("  {:<24} {}\n", fmt::format("settling time, {:g} %", 100 * band),
                     f.settling_s ? seconds_or_dash(f.settling_s) : "         - does not settle");
  out += fmt::format("  {:<24} {:10.4g}\n", "steady gain", f.steady_gain());
  if (same_unit(s)) out += fmt::format("  {:<24} {:10.4g} {}\n", "steady error", f.steady_error(), s[1].unit);
  return out;
}
std::string limited_text(const std::optional<double>& share) {
  if (!share) return "";
  std::string out = fmt::format("servos  {:.1f} % of this time at a stop or at the rate limit", 100 * *share);
  if (*share > 0.01) out += log_tool_messages::servos_limited().line();
  return out + "\n";
}
std::string frequency_text(const FrequencyResponse& r) {
  std::string out = fmt::format(
      "\n{} segments of {:.2f} s at {:.4g} Hz\n{:>12} {:>11} {:>9} {:>9} {:>11} {:>10}\n", r.segments,
      r.segment_s, r.rate_hz, "frequency Hz", "gain", "dB", "+- %", "phase deg", "coherence");
  // equal steps of the logarithm, when there are more frequencies than rows
  double next_hz = 0;
  for (const Frequency& f : r.at) {
    if (r.at.size() > max_rows && f.hz < next_hz && &f != &r.at.back()) continue;
    next_hz = f.hz * std::pow(r.at.back().hz / r.at.front().hz, 1.0 / max_rows);
    out += fmt::format("{:12.3f} {:11.4g} {:9.2f} {:9.1f} {:11.1f} {:10.3f}\n", f.hz, f.gain, decibel(f.gain),
                       100 * f.gain_std, degrees(f.phase_rad), f.coherence);
  }
  return out;
}

/// The result, or the reason why there is none.
template <class Make>
auto attempt(bool wanted, std::string& why, const Make& make) -> std::optional<decltype(make())> try {
  if (!wanted) return std::nullopt;
  return make();
} catch (const Error& e) {
  why = e.what();
  return std::nullopt;
}

}  // namespace

struct ResponseCommand::Impl {
  CLI::App* command;
  std::string log, input, output;
  Window window;
  double band_percent = 5, segment_s = 0;
  bool step = false, frequency = false, as_json = false;

  explicit Impl(CLI::App& app) {
    command = app.add_subcommand("response", "compute step and frequency response between two log fields");
    command->footer(
        "Step: rise time (10 to 90 % of the output's change), overshoot, settling time and steady-state "
        "error; "
        "the end value is the mean of the last fifth.\n"
        "Frequency: gain, phase and coherence by Welch's method, Hann windows with 50 % overlap, at "
        "frequencies "
        "where the input has at least 0.1 % of its largest power density.\n"
        "Example: fulmar response x.mcap --phase height_step --input command_signal.height_excitation_m "
        "--output nav.state.height_m");
    command->add_option("LOG", log, "log of a flight (MCAP)")->required();
    command->add_option("--input", input, "excitation signal: PORT.FIELD or COMPONENT.PROBE")
        ->required()
        ->type_name("FIELD");
    command->add_option("--output", output, "response signal")->required()->type_name("FIELD");
    const auto seconds = CLI::Range(-1e7, 1e7);
    command->add_option("--from", window.from_s, "start at SECONDS of flight time")
        ->type_name("SECONDS")
        ->check(seconds);
    command->add_option("--to", window.to_s, "end at SECONDS of flight time")
        ->type_name("SECONDS")
        ->check(seconds);
    command->add_option("--phase", window.phase, "use only the first time in phase PHASE")
        ->type_name("PHASE");
    CLI::Option* const only_step = command->add_flag("--step", step, "print only the step response");
    command->add_flag("--frequency", frequency, "print only the frequency response")->excludes(only_step);
    command->add_option("--band", band_percent, "set the band of the settling time in percent; default 5")
        ->check(CLI::Range(0.1, 50.0));
    command
        ->add_option("--segment", segment_s,
                     "set the segment length of the spectra in seconds; default: a quarter of the time")
        ->check(CLI::Range(1e-3, 1e6));
    command->add_flag("--json", as_json, "print one JSON object");
  }

  int run() const {
    core::check_log_file(log);
    const std::array<Signal, 2> s = read_signals(log, {input, output}, window);
    const double band = band_percent / 100;
    std::string no_step, no_frequency;
    const auto f = attempt(!frequency, no_step, [&] { return step_figures(s[0].series, s[1].series, band); });
    const auto r =
        attempt(!step, no_frequency, [&] { return frequency_response(s[0].series, s[1].series, segment_s); });
    if (!f && !r)
      throw Error(located(log, log_tool_messages::response_missing(no_step, step || frequency ? "" : "; and ",
                                                                   no_frequency)));
    const std::vector<double>& t_s = s[0].series.t_s;
    const std::optional<double> limited = limited_share(log, t_s.front(), t_s.back());
    if (as_json) {
      core::print_json({{"servo_limited_ratio", or_null(limited)},
                        {"input", signal_json(s[0])},
                        {"output", signal_json(s[1])},
                        {"step", f ? step_json(*f, band, same_unit(s)) : json(nullptr)},
                        {"frequency", r ? frequency_json(*r) : json(nullptr)}});
      return 0;
    }
    std::string text = head_text(s[0], "input") + head_text(s[1], "output") + limited_text(limited);
    if (f) text += step_text(*f, band, s);
    if (!f && !frequency) text += "\n" + log_tool_messages::step_figures_missing(no_step).line() + "\n";
    if (r) text += frequency_text(*r);
    if (!r && !step) text += "\n" + log_tool_messages::frequency_figures_missing(no_frequency).line() + "\n";
    std::cout << text;
    return 0;
  }
};

ResponseCommand::ResponseCommand(CLI::App& app) : impl_(std::make_unique<Impl>(app)) {}
ResponseCommand::~ResponseCommand() = default;
bool ResponseCommand::parsed() const { return impl_->command->parsed(); }
int ResponseCommand::run() const { return impl_->run(); }

}  // namespace fulmar::response

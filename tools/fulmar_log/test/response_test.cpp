// SPDX-License-Identifier: BSD-3-Clause
// fulmar response: its figures against closed forms, and its messages.
#include "tools/fulmar_log/response.hpp"

#include <random>

#include "fulmar/msg/attitude_command.hpp"
#include "tools/fulmar_log/response_command.hpp"
#include "tools/fulmar_log/test/compare_kit.hpp"

namespace response_test {

using namespace fulmar;
using compare_test::degree;
using compare_test::Log;
using compare_test::ms;
using core::test::Folder;
using nlohmann::json;
using response::FrequencyResponse;
using response::Series;
using response::StepFigures;

constexpr double turn = 2 * std::numbers::pi;

/// x(t) from `begin` to `end`, at `hz`.
Series sampled(const std::function<double(double)>& x, double begin, double end, double hz) {
  Series s;
  for (int i = 0; i <= std::lround((end - begin) * hz); ++i) {
    s.t_s.push_back(begin + i / hz);
    s.x.push_back(x(s.t_s.back()));
  }
  return s;
}
Series step_of(double size, double end, double hz = 200) {
  return sampled([&](double t) { return t > -1e-9 ? size : 0.0; }, -2, end, hz);
}

/// The answer of w^2 / (s^2 + 2 z w s + w^2) to a step of 1: Nise (4.28).
double second_order(double t, double z, double w) {
  if (t <= 0) return 0;
  const double d = std::sqrt(1 - z * z);
  return 1 - std::exp(-z * w * t) / d * std::sin(w * d * t + std::acos(z));
}

TEST_CASE("a second-order system: overshoot and peak time in closed form, rise times of Nise's table") {
  const std::pair<double, double> rise_times[] = {{0.2, 1.203}, {0.3, 1.321}, {0.5, 1.638}, {0.7, 2.126}};
  for (const auto& [damping, rise] : rise_times) {
    const double z = damping;
    CAPTURE(z);
    const double w = 4, end = 12 / (z * w);
    const Series y = sampled([&](double t) { return second_order(t, z, w); }, -2, end, 200);
    const StepFigures f = response::step_figures(step_of(1, end), y, 0.02);
    CHECK(f.at_s == doctest::Approx(0).epsilon(1e-9));
    CHECK(f.input_change == doctest::Approx(1));
    CHECK(f.overshoot_percent ==
          doctest::Approx(100 * std::exp(-std::numbers::pi * z / std::sqrt(1 - z * z))).epsilon(0.01));
    CHECK(f.peak_s == doctest::Approx(std::numbers::pi / (w * std::sqrt(1 - z * z))).epsilon(0.01));
    REQUIRE(f.rise_s.has_value());
    CHECK(*f.rise_s * w == doctest::Approx(rise).epsilon(0.005));
    CHECK(f.steady_gain() == doctest::Approx(1).epsilon(0.002));
    // 2 %: the closed form itself, searched from the end
    double settled = end;
    while (std::abs(second_order(settled, z, w) - 1) <= 0.02) settled -= 1e-5;
    REQUIRE(f.settling_s.has_value());
    CHECK(*f.settling_s == doctest::Approx(settled).epsilon(0.01));
    CHECK(*f.settling_s < 1.02 * -std::log(0.02 * std::sqrt(1 - z * z)) / (z * w));  // Nise (4.41)
  }
}

TEST_CASE("a first-order lag: ln 9, ln 20 and what is missing at the end, downwards and from an offset") {
  const double tau = 0.4, gain = 0.8;
  for (const double size : {2.0, -3.0}) {
    CAPTURE(size);
    const Series y =
        sampled([&](double t) { return 7 + (t > 0 ? gain * size * -std::expm1(-t / tau) : 0); }, -2, 6, 100);
    Series u = step_of(size, 6, 100);
    for (double& x : u.x) x += 1;
    const StepFigures f = response::step_figures(u, y, 0.05);
    CHECK(f.output_before == doctest::Approx(7));
    CHECK(f.output_change() == doctest::Approx(gain * size).epsilon(1e-4));
    CHECK(*f.rise_s == doctest::Approx(tau * std::log(9)).epsilon(0.002));
    CHECK(*f.settling_s == doctest::Approx(tau * std::log(20)).epsilon(0.002));
    CHECK(f.overshoot_percent < 0.01);
    CHECK(f.steady_gain() == doctest::Approx(gain).epsilon(1e-3));
    CHECK(f.steady_error() == doctest::Approx(0.2 * size).epsilon(1e-3));
  }
}

TEST_CASE("the next step ends it; of two rates; what does not settle has no settling time") {
  const auto pulse = [](double t) { return t > -1e-9 && t < 2 - 1e-9 ? 1.0 : 0.0; };
  const auto lag = [](double t) {
    const double up = t > 0 ? -std::expm1(-t / 0.1) : 0, down = t > 2 ? -std::expm1(-(t - 2) / 0.1) : 0;
    return up - down;
  };
  const StepFigures f = response::step_figures(sampled(pulse, -1.5, 5, 100), sampled(lag, -1, 5, 400), 0.05);
  CHECK(f.until_s == doctest::Approx(1.99));
  CHECK(f.output_change() == doctest::Approx(1).epsilon(1e-6));
  CHECK(*f.settling_s == doctest::Approx(0.1 * std::log(20)).epsilon(0.01));
  const auto swing = [](double t) { return t > 0 ? 1 - std::cos(turn * t) : 0; };
  const StepFigures g = response::step_figures(step_of(1, 5), sampled(swing, -2, 5, 200), 0.05);
  CHECK_FALSE(g.settling_s.has_value());
  CHECK(g.overshoot_percent == doctest::Approx(100).epsilon(0.02));
}

TEST_CASE("no step, no answer, no samples: each in a sentence") {
  const auto says = [](const Series& u, const Series& y) {
    try {
      response::step_figures(u, y, 0.05);
    } catch (const core::Error& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  const Series step = step_of(1, 4), ramp = sampled([](double t) { return t; }, -2, 4, 100);
  CHECK(says(ramp, step) == "log_tool.input_step_missing(6, 0.01)");
  CHECK(says(step_of(0, 4), step) == "log_tool.input_step_missing(0, 0)");
  CHECK(says(step, step_of(0, 4)) == "log_tool.output_constant");
  CHECK(says(step, sampled([](double t) { return t; }, 1, 4, 100))
            .starts_with("log_tool.step_samples_too_few(0, 301)"));
  CHECK(says({}, step) == "log_tool.step_samples_missing");
}

/// A logarithmic sweep from 0.1 to 5 Hz in 60 s, with four seconds of rest on either side, and the response
/// of a first-order lag: in steps so small that these are exact to 1e-6.
struct Swept {
  static constexpr double tau = 0.2, gain = 2;
  Series x, y;
  explicit Swept(double hz = 100) {
    const double dt = 1e-4, octaves = std::log(50.0);
    const auto chirp = [&](double t) {
      return t < 0 || t > 60 ? 0 : std::sin(turn * 0.1 * 60 / octaves * std::expm1(octaves * t / 60));
    };
    const auto every = static_cast<int>(std::lround(1 / (hz * dt)));
    double state = 0;
    for (int i = -40000; i <= 640000; ++i) {
      const double t = i * dt;
      if (i % every == 0) {
        x.t_s.push_back(t);
        x.x.push_back(chirp(t));
        y.t_s.push_back(t);
        y.x.push_back(gain * state);
      }
      state += (chirp(t + dt / 2) - state) * -std::expm1(-dt / tau);
    }
  }
};

TEST_CASE("a sweep through a first-order lag: gain within 2 %, phase within 1 degree, coherence above 0.99") {
  const Swept s;
  const FrequencyResponse r = response::frequency_response(s.x, s.y);
  CHECK(r.rate_hz == doctest::Approx(100));
  CHECK(r.segment_s == doctest::Approx(17));
  CHECK(r.segments == 7);
  std::size_t within = 0;
  for (const response::Frequency& f : r.at) {
    if (f.hz < 0.2 || f.hz > 4.8) continue;  // the ends of the sweep
    CAPTURE(f.hz);
    const double wt = turn * f.hz * Swept::tau;
    CHECK(std::abs(f.gain * std::sqrt(1 + wt * wt) / Swept::gain - 1) < 0.02);
    CHECK(std::abs(f.phase_rad + std::atan(wt)) < 1 * degree);
    CHECK(f.coherence > 0.99);
    ++within;
  }
  CHECK(within > 60);
  CHECK(r.at.front().hz < 0.2);
  CHECK(r.at.back().hz > 4.5);
  CHECK(r.at.back().hz < 6);  // no result beyond the excited range
}

TEST_CASE("an output of half the rate gives the same as far as its rate reaches") {
  const Swept s, slow(50);
  const FrequencyResponse r = response::frequency_response(s.x, slow.y, 15);
  CHECK(r.rate_hz == doctest::Approx(50));
  for (const response::Frequency& f : r.at) {
    if (f.hz < 0.2 || f.hz > 4.5) continue;
    const double wt = turn * f.hz * Swept::tau;
    CHECK(std::abs(f.gain * std::sqrt(1 + wt * wt) / Swept::gain - 1) < 0.02);
  }
}

TEST_CASE(
    "noise in the output: coherence is the share that the input explains, and the gain's deviation grows") {
  // white noise in and out: 1 / (1 + 0.5^2) = 0.8
  std::mt19937 engine(5);
  std::normal_distribution<double> normal;
  Series x, y;
  for (int i = 0; i < 40000; ++i) {
    x.t_s.push_back(0.01 * i);
    x.x.push_back(normal(engine));
    y.t_s.push_back(0.01 * i);
    y.x.push_back(3 * (x.x.back() + 0.5 * normal(engine)));
  }
  const FrequencyResponse r = response::frequency_response(x, y, 2);
  CHECK(r.segments == 399);
  double coherence = 0, gain = 0, squares = 0, claimed = 0;
  for (const response::Frequency& f : r.at) {
    coherence += f.coherence;
    gain += f.gain;
    claimed += f.gain_std;
    squares += (f.gain / 3 - 1) * (f.gain / 3 - 1);
  }
  const auto n = static_cast<double>(r.at.size());
  CHECK(n == 79);  // from the second to 0.4 of the rate, of 100 Hz in steps of 0.5 Hz
  CHECK(coherence / n == doctest::Approx(0.8).epsilon(0.01));
  CHECK(gain / n == doctest::Approx(3).epsilon(0.01));
  // Bendat & Piersol: sqrt((1 - 0.8) / (2 200 0.8)); overlapping makes it a little less
  CHECK(std::abs(claimed / n / std::sqrt(0.2 / 320) - 1) < 0.05);
  CHECK(std::sqrt(squares / n) < claimed / n);
  CHECK(std::sqrt(squares / n) > 0.5 * claimed / n);
}

TEST_CASE("a dead time: the phase goes on below half a turn, without jumps") {
  std::mt19937 engine(6);
  std::normal_distribution<double> normal;
  Series x, y;
  for (int i = 0; i < 8000; ++i) {
    x.t_s.push_back(0.01 * i);
    x.x.push_back(normal(engine));
  }
  y.t_s = x.t_s;
  for (std::size_t i = 0; i < x.x.size(); ++i) y.x.push_back(i < 10 ? 0 : x.x[i - 10]);  // 0.1 s
  const FrequencyResponse r = response::frequency_response(x, y, 8);
  REQUIRE(r.at.size() > 200);
  for (const response::Frequency& f : r.at) CHECK(std::abs(f.phase_rad + turn * 0.1 * f.hz) < 2 * degree);
  CHECK(r.at.back().phase_rad < -3.5 * turn);
}

TEST_CASE("a gap, too little time and too few samples are refused with figures") {
  const auto says = [](const Series& x, const Series& y, double segment = 0) {
    try {
      response::frequency_response(x, y, segment);
    } catch (const core::Error& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  const Series x = sampled([](double t) { return std::sin(turn * t); }, 0, 20, 50);
  Series holed = x;
  holed.t_s.erase(holed.t_s.begin() + 500, holed.t_s.begin() + 600);
  holed.x.erase(holed.x.begin() + 500, holed.x.begin() + 600);
  CHECK(says(x, holed) == "log_tool.sample_gap(output, 9.98 s, 12.00 s)");
  CHECK(says(x, x, 15).starts_with("log_tool.segment_too_short(15.00 s, 20.00 s, 0.02 s, 3)"));
  CHECK(says({{1, 2}, {1, 2}}, x) == "log_tool.too_few_samples(input, 2)");
  CHECK(says(x, x, 10).empty());
}

// ---- words

struct Said {
  int code = 0;
  std::string text;
};
Said say(const std::string& words) {
  CLI::App app;
  const response::ResponseCommand command(app);
  std::ostringstream out;
  std::streambuf* const before = std::cout.rdbuf(out.rdbuf());
  Said said;
  try {
    app.parse("response " + words);
    said.code = command.run();
  } catch (const CLI::ParseError&) {
    said.code = 2;
  } catch (const core::Error& e) {
    said = {1, e.what()};
  }
  std::cout.rdbuf(before);
  if (said.code == 0) said.text = out.str();
  return said;
}

/// A step of 10 degrees of roll at 3 s, across +-180 degrees of course, for 10 s; half of it comes at once.
std::string stepped_log(const Folder& folder) {
  const std::string file = (folder.path / "a.mcap").string();
  Log log(file);
  for (int i = 0; i < 1000; ++i) {
    AttitudeCommand command;
    command.roll_rad = i < 300 ? 0 : 10 * degree;
    VehicleState state = compare_test::state();
    state.roll_rad = (i < 301 ? 0 : 5) * degree;
    state.course_rad = (i < 301 ? 179 : -179) * degree;
    state.position_m.north = i == 500 ? std::nan("") : 0.02 * i;
    log.write("/outer/attitude", i * 10 * ms, command);
    log.write("/nav/state", i * 10 * ms, state, 5 * ms);
  }
  return file;
}

TEST_CASE(
    "fields by their names, angles in degrees and the short way, at the times for which they are valid") {
  const Folder folder;
  const std::string log = stepped_log(folder),
                    input = log + " --json --input outer.attitude.roll_rad --output ";
  const Said roll = say(input + "nav.state.roll_rad");
  INFO(roll.text);
  REQUIRE(roll.code == 0);
  const json o = json::parse(roll.text);
  CHECK(o.at("input").at("field") == "outer.attitude.roll_deg");
  CHECK(o.at("output").at("unit") == "deg");
  CHECK(o.at("output").at("samples") == 1000);
  const json step = o.at("step");
  CHECK(step.at("step_time_s").get<double>() == doctest::Approx(3));
  CHECK(step.at("input_change").get<double>() == doctest::Approx(10));
  CHECK(step.at("steady_error").get<double>() == doctest::Approx(5));
  CHECK(step.at("steady_gain").get<double>() == doctest::Approx(0.5));
  CHECK(step.at("settling_band_percent") == 5);
  CHECK(o.at("frequency").at("rows").size() > 10);
  CHECK(o.at("frequency").at("rows").at(5).at("gain").get<double>() == doctest::Approx(0.5).epsilon(0.01));
  const json course = json::parse(say(input + "nav.state.course_rad").text);
  CHECK(course.at("step").at("output_change").get<double>() == doctest::Approx(2));
  const json north = json::parse(say(input + "nav.state.position_m.north").text);
  CHECK(north.at("output").at("unit") == "m");
  CHECK(north.at("output").at("left_out") == 1);
  CHECK(north.at("step").at("steady_error") == nullptr);  // metres are no degrees
}

TEST_CASE("one of the two alone, a part of the time, another band; the table says the same") {
  const Folder folder;
  const std::string log = stepped_log(folder),
                    words = log + " --input outer.attitude.roll_rad --output nav.state.roll_rad ";
  CHECK(json::parse(say(words + "--json --step").text).at("frequency") == nullptr);
  CHECK(json::parse(say(words + "--json --frequency").text).at("step") == nullptr);
  const json part = json::parse(say(words + "--json --step --from 2 --to 6 --band 2").text);
  CHECK(part.at("input").at("samples") == 401);
  CHECK(part.at("step").at("end_time_s").get<double>() == doctest::Approx(5.995).epsilon(0.001));
  CHECK(part.at("step").at("settling_band_percent") == 2);
  const std::string text = say(words).text;
  for (const char* line : {"step of 10 deg at 3.00 s", "rise time, 10 to 90 %", "settling time, 5 %",
                           "steady gain                     0.5", "phase deg", "coherence"})
    CHECK_MESSAGE(text.find(line) != std::string::npos, text);
  // half of the request has a result: the other half gives the reason
  const std::string none = say(words + "--from 4").text;
  CHECK_MESSAGE(none.find("log_tool.step_figures_missing(log_tool.input_step_missing(") != std::string::npos,
                none);
}

TEST_CASE(
    "the share of the time with a servo at its limit is that of the time looked at; without a report none") {
  const Folder folder;
  const std::string file = (folder.path / "limited.mcap").string();
  {
    core::test::Sample log({.file = file, .max_message_bytes = 4096});
    const auto type = core::test::make_type(
        "Probes", 16, 8, {core::test::number("size_rad", 0), core::test::number("limited_ratio", 8)});
    const std::uint16_t probes = log.channel("/surface_signal/probes", *type);
    for (int i = 0; i < 1000; ++i) {  // of 10 s the fifth and the first half of the sixth
      const double values[] = {i < 450 ? 0.0 : 0.1, i >= 400 && i < 550 ? 1.0 : 0.0};
      log.write(probes, i * 10 * ms, reinterpret_cast<const std::byte*>(values), 0, 0);
    }
    log.writer.close();
  }
  const std::string words =
      file + " --step --input surface_signal.size_rad --output surface_signal.size_rad ";
  const auto share = [&](const std::string& more) {
    return json::parse(say(words + "--json " + more).text).at("servo_limited_ratio").get<double>();
  };
  CHECK(share("") == doctest::Approx(0.15));
  CHECK(share("--from 4 --to 4.995") == doctest::Approx(1));
  CHECK(share("--from 3.5 --to 7.495") == doctest::Approx(0.375));
  CHECK(say(words).text.find("servos  15.0 % ") != std::string::npos);
  CHECK(say(words).text.find("log_tool.servos_limited\n") != std::string::npos);
  const std::string other =
      stepped_log(folder) + " --input outer.attitude.roll_rad --output nav.state.roll_rad";
  CHECK(json::parse(say(other + " --json").text).at("servo_limited_ratio") == nullptr);
  CHECK(say(other).text.find("servos") == std::string::npos);
}

TEST_CASE("what is not in the log is told with what there is") {
  const Folder folder;
  const std::string log = stepped_log(folder);
  const auto says = [&](const std::string& input, const std::string& output, const std::string& more = "") {
    const Said said = say(log + " --input " + input + " --output " + output + " " + more);
    return std::to_string(said.code) + " " + said.text.substr(std::min(said.text.size(), log.size()));
  };
  const std::string state = "nav.state.roll_rad", command = "outer.attitude.roll_rad";
  CHECK(says("nav.stat.roll_rad", state) ==
        "1 : log_tool.field_unknown(nav.stat.roll_rad,  [nav.state] nav.state, outer.attitude)");
  CHECK(says("outer.attitude.rol_rad", state) ==
        "1 : types.name_unknown_in(outer.attitude, field, rol_rad,  [roll_rad] roll_rad, pitch_rad, "
        "throttle_frac)");
  CHECK(says(command, state, "--phase cruise") ==
        "1 : types.name_unknown_in(the flight, phase, cruise,  [] none)");
  CHECK(says(command, state, "--from 100") == "1 : log_tool.numbers_missing(outer.attitude.roll_rad)");
  CHECK(says(command, state, "--step --from 5")
            .starts_with("1 : log_tool.response_missing(log_tool.input_step_missing("));
  CHECK(say(log + " --input " + command).code == 2);
  CHECK(says(command, state, "--step --frequency").starts_with("2"));
  CHECK(says(command, state, "--band 0").starts_with("2"));
  CHECK(say("nowhere.mcap --input a.b --output c.d").text ==
        "reading.file_not_readable(nowhere.mcap, reading.file_missing)");
}

}  // namespace response_test

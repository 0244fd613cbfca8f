// SPDX-License-Identifier: BSD-3-Clause
// `fulmar aero tune`: its reports, files, flights and rejections.
#include <cmath>
#include <map>

#include "tools/fulmar_aero/airframe_file.hpp"
#include "tools/fulmar_aero/test/aero_kit.hpp"
#include "tools/fulmar_aero/tune_flight.hpp"
#include "tools/fulmar_aero/tune_words.hpp"

namespace tune_test {

using namespace fulmar;
using namespace fulmar::aero;
using namespace fulmar::aero::test;
using doctest::Approx;
using nlohmann::json;

namespace {
json tuned(const std::string& words) {
  const Answer answer = call("tune " + words + " --json");
  CHECK_MESSAGE(answer.code == 0, answer.out);
  return answer.json();
}
std::string without_params(const std::string& text) { return text.substr(0, text.find("\nparams:") + 1); }
}  // namespace

TEST_CASE("the gains of all shipped aircraft have their margins, broken at the actuator and at the sensor" *
          doctest::test_suite("amounts")) {
  for (const std::string name : {"anaconda", "aerosonde", "x8"}) {
    CAPTURE(name);
    const json o = tuned("configs/airframes/" + name + ".yaml --altitude '1457 m'");
    for (const char* which : {"computed", "shipped"}) {
      CHECK(o[which]["unstable_poles"] == 0);
      CHECK(o[which]["loops"].size() == (name == "x8" ? 7 : 8));
      for (const auto& [loop, figures] : o[which]["loops"].items()) {
        const std::string where = loop;  // no binding is captured
        CAPTURE(where);
        for (const char* at : {"at_actuator", "at_sensor"})
          for (const auto& [margin, least] :
               std::map<std::string, double>{{"gain_db", 6}, {"reduction_db", 6}, {"phase_deg", 45}})
            if (!figures[at][margin].is_null()) CHECK(figures[at][margin].get<double>() >= least);
        // A damper that turns the Dutch roll by less than 0 dB has no crossover, and no margin to lose.
        const json& width = figures["bandwidth_radps"];
        const bool none = where == "yaw damper" && width.is_null();
        CHECK((none || width.get<double>() > 0.1));
        CHECK((!none || figures["at_actuator"]["crossover_radps"].is_null()));
      }
    }
    CHECK(o["faults"].empty());
  }
}

TEST_CASE("a damper without a crossover has a dash, and null in JSON") {
  fulmar::aero::Judged judged;
  judged.loops.resize(2);
  judged.loops[0].name = "yaw damper";
  judged.loops[1].name = "roll";
  judged.loops[1].bandwidth_radps = 12;
  const std::string text = fulmar::aero::loops_text("shipped", judged);
  CHECK(text.find("  yaw damper        -    0.00") != std::string::npos);
  CHECK(text.find("  roll          12.00    0.00") != std::string::npos);
  CHECK(fulmar::aero::loops_json(judged)["loops"]["yaw damper"]["bandwidth_radps"].is_null());
  CHECK(fulmar::aero::loops_json(judged)["loops"]["roll"]["bandwidth_radps"] == 12);
}

TEST_CASE("bandwidths become gains by the relations of the README" * doctest::test_suite("amounts")) {
  const json o = tuned(
      "configs/airframes/anaconda.yaml --altitude '1457 m' --bandwidth 'roll=12 rad/s' "
      "--bandwidth course=1.2 --bandwidth 'height=1.5 rad/s' --bandwidth airspeed=2");
  const json& inner = o["gains"]["control_slc/Inner"];
  const json& outer = o["gains"]["control_slc/Outer"];
  const auto value = [](const json& gains, const char* name) {
    return gains[name]["computed"].get<double>();
  };
  // q S b / Jxx times the derivatives, with the product of inertia: Beard & McLain, section 5.4
  const double rho = 1.0626, V = 17, q = 0.5 * rho * V * V, S = 0.52, b = 2.08;
  const double gamma = 0.24855 * 0.618 - 0.06 * 0.06, g3 = 0.618 / gamma, g4 = 0.06 / gamma;
  const double a2 = q * S * b * (g3 * 0.17 + g4 * -0.011);
  const double a1 = q * S * b * b / (2 * V) * (g3 * 0.51 + g4 * 0.0364);
  CHECK(value(inner, "roll_kp") == Approx(12 * 12 / a2).epsilon(0.04).scale(0));
  CHECK(value(inner, "roll_kff") == Approx(a1 / a2).epsilon(0.03).scale(0));
  CHECK(value(inner, "roll_kd") == Approx((24 - a1) / a2).epsilon(0.05).scale(0));
  CHECK(value(outer, "course_kp") == Approx(1.2 * 17 / 9.80665).epsilon(0.03).scale(0));
  CHECK(value(outer, "altitude_kp") == Approx(1.5 / 17).epsilon(0.03).scale(0));
  CHECK(value(outer, "airspeed_kp") == Approx(2 * 4.5 / value(outer, "thrust")).epsilon(0.03).scale(0));
  CHECK(value(outer, "climb_kff") ==
        Approx(4.5 * 9.80665 / (17 * value(outer, "thrust"))).epsilon(0.03).scale(0));
  CHECK(o["shipped"]["loops"]["course"]["at_sensor"]["crossover_radps"].get<double>() ==
        Approx(1.21).epsilon(0.1).scale(0));  // the file: course_kp 2.1, 1.21 rad/s
}

TEST_CASE("delay takes phase, and bandwidth where nothing was asked for" * doctest::test_suite("amounts")) {
  const std::string file = "configs/airframes/anaconda.yaml";
  const json now = tuned(file), late = tuned(file + " --delay '40 ms'");
  const auto phase = [](const json& o) {
    return o["shipped"]["loops"]["pitch"]["at_actuator"]["delay_s"].get<double>();
  };
  CHECK(phase(now) - phase(late) == Approx(0.04).epsilon(0.25).scale(0));
  CHECK(late["gains"]["control_slc/Inner"]["pitch_kp"]["computed"].get<double>() <
        0.5 * now["gains"]["control_slc/Inner"]["pitch_kp"]["computed"].get<double>());
  // the assumed lag is reported
  CHECK(call("tune " + file + " --delay '40 ms' --step '20 ms'")
            .says("aero.tuning_assumptions(20 ms, 40 ms, 60 ms, 60 ms, 100 ms)\n"));
}

TEST_CASE("too little margin is told for each loop, and nothing is written" *
          doctest::test_suite("amounts")) {
  const Folder folder;
  const std::string text = text_of(FULMAR_SOURCE_DIR "/configs/airframes/anaconda.yaml");
  const std::string file = folder.write("late.yaml", text);
  const Answer answer =
      call("tune " + file +
           " --delay '60 ms' --write --bandwidth roll=6 --bandwidth pitch=6 --bandwidth course=5");
  CHECK(answer.code == 1);
  CHECK_MESSAGE(answer.says("anaconda: aero.phase_margin_small(course, course, "), answer.out);
  CHECK(answer.says("anaconda: aero.gain_increase_small(roll, aileron, 5.3)"));
  CHECK(text_of(file) == text);
}

TEST_CASE("a bandwidth that an actuator cannot give is refused, with the limit and its place") {
  const std::map<std::string, std::string> reported{
      {"anaconda.yaml --bandwidth 'roll=60 rad/s'",
       "anaconda: aero.bandwidth_too_high(roll, 60, aileron, servo 10 ms, 5 ms, 0 ms, 15 ms, 33.3, "
       "configs/airframes/anaconda.yaml:38)"},
      {"x8.yaml --bandwidth pitch=15 --delay '10 ms'",
       "aero.bandwidth_too_high(pitch, 15, elevator, servo 34.2 ms, 5 ms, 10 ms, 49.2 ms, 10.2, "
       "configs/airframes/x8.yaml:33)"},
      {"x8.yaml --bandwidth airspeed=3",
       "aero.bandwidth_too_high(airspeed, 3, throttle, motor 200 ms, 5 ms, 0 ms, 205 ms, 2.44, "
       "configs/airframes/x8.yaml:25)"}};
  for (const auto& [words, sentence] : reported) {
    const Answer answer = call("tune configs/airframes/" + words);
    CHECK(answer.code == 1);
    CHECK_MESSAGE(answer.says(sentence), answer.out);
  }
  const Answer stall = call("tune configs/airframes/anaconda.yaml --airspeed '8 m/s'");
  CHECK(stall.code == 1);
  CHECK(
      stall.says("configs/airframes/anaconda.yaml: aero.flight_impossible(aero.flight_condition(steady level "
                 "flight, 8, 0), "));
}

TEST_CASE("words that mean nothing are wrong usage") {
  const std::map<std::string, std::string> reported{
      {"--bandwidth 'rol=3'",
       "aero.bandwidth_loop_unknown(rol=3,  [roll] roll, pitch, course, height, airspeed)"},
      {"--bandwidth roll", "aero.bandwidth_loop_unknown(roll, "},
      {"--bandwidth 'roll=8 kg'", "graph.dimension_differs(8 kg, a mass, "},
      {"--bandwidth roll=0", "aero.tuning_out_of_range(0, 0.01, 1000, rad/s)"},
      {"--delay '2 s'", "aero.tuning_out_of_range(2 s, 0, 1, s)"},
      {"--step 0", "aero.tuning_out_of_range(0, 0.001, 0.1, s)"}};
  for (const auto& [words, sentence] : reported) {
    const Answer answer = call("tune configs/airframes/anaconda.yaml " + words);
    CHECK(answer.code == 2);
    CHECK_MESSAGE(answer.says(sentence), answer.out);
  }
}

TEST_CASE("gains of the file that no law has are refused by file and line") {
  const Folder folder;
  const std::map<std::string, std::string> reported{
      {"roll_kq: 1.2",
       "params.control_slc/Inner: aero.parameter_unknown(roll_kq,  [roll_kp] roll_kp, roll_ki, roll_kd, "
       "roll_kff, roll_from_sideslip, pitch_kp, pitch_ki, pitch_kd, turn_kff, yaw_kd, yaw_washout, "
       "command_filter, airspeed_smoothing, scale_limit, quieten, airframe)"},
      {"roll_kp: 50", "graph.value_out_of_range(50, 0, 20, "},
      {"roll_kp: quick", "graph.number_invalid(quick)"}};
  for (const auto& [by, sentence] : reported) {
    const Answer answer = call("tune " + folder.write("a.yaml", changed("anaconda", "roll_kp: 1.4", by)));
    CHECK(answer.code == 4);
    CHECK_MESSAGE(answer.says("a.yaml:56: "), answer.out);
    CHECK_MESSAGE(answer.says(sentence), answer.out);
  }
  const Answer law =
      call("tune " + folder.write("a.yaml", changed("anaconda", "control_slc/Inner:", "control_slc/Iner:")));
  CHECK(law.code == 4);
  CHECK_MESSAGE(law.says("aero.component_unknown(control_slc/Iner,  [control_slc/Inner] control_slc/Inner, "
                         "control_slc/Outer, control_tecs/Outer)"),
                law.out);
}

TEST_CASE("--write changes the gains and nothing else, and says the same when it is asked again" *
          doctest::test_suite("amounts")) {
  const Folder folder;
  const std::string old = text_of(FULMAR_SOURCE_DIR "/configs/airframes/anaconda.yaml");
  const std::string file = folder.write("a.yaml", old);
  const json o = tuned(file + " --write");
  const std::string now = text_of(file);
  CHECK(now != old);
  CHECK(without_params(now) == without_params(old));
  const std::string comment = "# 12.6 rad/s, damping 0.9: aileron 113 rad/s2 per rad";
  CHECK(now.find(comment) != std::string::npos);                  // comments stay
  CHECK(now.find("takeoff_pitch: 12 deg") != std::string::npos);  // what is not computed
  CHECK(std::count(now.begin(), now.end(), '\n') ==
        std::count(old.begin(), old.end(), '\n'));  // each is there
  const json again = tuned(file + " --write");
  for (const auto& [component, gains] : again["gains"].items())
    for (const auto& [name, gain] : gains.items()) {
      const std::string which = name;  // no binding is captured
      CAPTURE(which);
      CHECK(gain["shipped"] == o["gains"][component][name]["computed"]);
      CHECK(gain["shipped"] == gain["computed"]);
    }
  CHECK(text_of(file) == now);
}

TEST_CASE("--write makes the section where there is none, and fills one in braces" *
          doctest::test_suite("amounts")) {
  const Folder folder;
  const std::string all = text_of(FULMAR_SOURCE_DIR "/configs/airframes/anaconda.yaml");
  const std::string bare = folder.write("bare.yaml", without_params(all));
  const json o = tuned(bare + " --write");
  CHECK(o["shipped"].is_null());
  CHECK(text_of(bare).rfind(without_params(all) + "params:\n  control_slc/Inner:\n    roll_kp: ", 0) == 0);
  const std::string braces = folder.write(
      "braces.yaml",
      without_params(all) + "params:\n  control_slc/Inner: {roll_kd: 0.01, turn_kff: 0.9}   # mine\n");
  tuned(braces + " --write");
  const std::string text = text_of(braces);
  CHECK(text.find("turn_kff: 0.9}   # mine\n") != std::string::npos);
  CHECK(text.find("roll_kd: 0.01,") == std::string::npos);
  const json again = tuned(braces);
  CHECK(again["gains"]["control_tecs/Outer"]["altitude_gain"]["shipped"] ==
        again["gains"]["control_tecs/Outer"]["altitude_gain"]["computed"]);
  const Answer empty =
      call("tune " + folder.write("empty.yaml", without_params(all) + "params:\n") + " --write");
  CHECK(empty.code == 4);
  const Answer installed = call("tune fulmar:airframes/anaconda.yaml --write");
  CHECK(installed.code == 4);
  CHECK_MESSAGE(installed.says("fulmar:airframes/anaconda.yaml: aero.shipped_file_read_only"), installed.out);
}

TEST_CASE("--verify flies the hourglass, and an aircraft that does not keep to it is told" *
          doctest::test_suite("amounts")) {
  const Answer flown = call("tune configs/airframes/x8.yaml --altitude '1457 m' --verify");
  CHECK_MESSAGE(flown.code == 0, flown.out);
  CHECK(flown.says("aero.hourglass_result(flown"));
  const Answer slow = call(
      "tune configs/airframes/anaconda.yaml --verify --json --bandwidth height=0.04 --bandwidth pitch=0.2");
  CHECK(slow.code == 1);
  CHECK_MESSAGE(slow.says("anaconda: aero.hourglass_bound_missed(height, "), slow.out);
  CHECK_MESSAGE(!slow.says("stalled"), slow.out);
}

TEST_CASE("a wing beyond its most lift for a second has stalled, one in a gust or in the hand has not") {
  const Airframe anaconda = read_airframe_file(FULMAR_SOURCE_DIR "/configs/airframes/anaconda.yaml").airframe;
  const auto flown = [&](double alpha_deg, double for_s, double Va) {
    FlightTrack track;
    for (double t = 0; t < 20; t += track_step_s) {
      TrackPoint p;
      p.time_s = t;
      p.airspeed_mps = Va;
      p.roll_rad = 0.5;
      p.alpha_rad = t >= 10 && t < 10 + for_s ? alpha_deg * std::numbers::pi / 180 : 0.05;
      track.truth.push_back(p);
    }
    return stall_of(track, anaconda);
  };
  CHECK(flown(12.5, 2, 13).find("aero.stall_in_flight(10.0, 13.0, 29 deg, 12.0 deg)") == 0);
  CHECK(flown(11.5, 2, 13) == "");
  CHECK(flown(12.5, 0.5, 13) == "");
  CHECK(flown(12.5, 2, 11) == "");  // slower than the least airspeed all the time: it never flew
}

TEST_CASE("an outer law with a wrong least airspeed banks no further than the wing carries" *
          doctest::test_suite("amounts")) {
  // Level flight ends at 9.6 m/s: at 11 m/s the wing carries a turn of acos((9.6 / 11)^2) = 40 deg.
  const Folder folder;
  const std::string wrong = changed("anaconda", "airspeed_min: 12 m/s", "airspeed_min: 8 m/s");
  const Answer stalled = call("tune " + folder.write("wrong.yaml", wrong) + " --airspeed '11 m/s' --verify");
  CHECK(stalled.code == 1);
  CHECK_MESSAGE(!stalled.says("stalled at "), stalled.out);
  const Answer kept = call("tune configs/airframes/anaconda.yaml --airspeed '12 m/s' --verify");
  CHECK_MESSAGE(kept.says("aero.hourglass_result(flown)\n"), kept.out);
}

}  // namespace tune_test

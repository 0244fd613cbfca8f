// SPDX-License-Identifier: BSD-3-Clause
// `fulmar aero` as a user calls it: messages, exit codes, JSON.
#include <map>

#include "tools/fulmar_aero/test/aero_kit.hpp"

namespace words_test {

using namespace fulmar::aero::test;
using doctest::Approx;
using nlohmann::json;

TEST_CASE("trim tells angles, deflections, throttle and forces") {
  const Answer text = call("trim configs/airframes/anaconda.yaml --altitude '1457 m'");
  CHECK(text.code == 0);
  CHECK(text.says("anaconda: aero.flight_condition(steady level flight, 17, 1457), density 1.0626 kg/m3"));
  const Answer as_json = call("trim configs/airframes/anaconda.yaml --altitude '1457 m' --json");
  CHECK(as_json.code == 0);
  const json o = as_json.json();
  CHECK(o["found"] == true);
  CHECK(o["reason"].is_null());
  CHECK(o["elevator_deg"].get<double>() ==
        Approx(0.1212 * 57.2958).epsilon(2e-3).scale(0));  // the file's trim
  CHECK(o["aileron_deg"].get<double>() == Approx(0.0041 * 57.2958).epsilon(2e-2).scale(0));
  CHECK(o["throttle_frac"].get<double>() == Approx(0.57).epsilon(2e-3).scale(0));
  CHECK(o["turn_radius_m"].is_null());
  CHECK(o["thrust_newton"].get<double>() == Approx(o["drag_newton"].get<double>()).epsilon(1e-3).scale(0));
}

TEST_CASE("climb and turn are said by angle or rate, by bank or radius, in any unit") {
  const auto trim = [](const std::string& words) {
    const Answer answer = call("trim fulmar:airframes/anaconda.yaml --json " + words);
    CHECK(answer.code == 0);
    return answer.json();
  };
  const json angle = trim("--airspeed '61.2 km/h' --climb '5 deg'");
  CHECK(angle["airspeed_mps"].get<double>() == Approx(17).epsilon(1e-12).scale(0));
  CHECK(angle["climb_rate_mps"].get<double>() == Approx(17 * 0.0871557).epsilon(1e-6).scale(0));
  const json rate = trim("--airspeed 17 --climb '1.4816474 m/s'");
  CHECK(rate["alpha_deg"].get<double>() == Approx(angle["alpha_deg"].get<double>()).epsilon(1e-6).scale(0));
  const json bank = trim("--turn '30 deg'"), left = trim("--turn '-30 deg'");
  CHECK(bank["roll_deg"].get<double>() == Approx(30).epsilon(1e-9).scale(0));
  CHECK(bank["turn_degps"].get<double>() > 0);
  CHECK(left["turn_degps"].get<double>() < 0);
  const json radius = trim("--turn '" + std::to_string(bank["turn_radius_m"].get<double>()) + " m'");
  CHECK(radius["roll_deg"].get<double>() == Approx(30).epsilon(1e-4).scale(0));
}

TEST_CASE("where there is no trim the limit that stops it is told, with its place, and the exit code is 1") {
  const std::map<std::string, std::string> reported{{"--airspeed '8 m/s'", "aero.wing_stalls(2.16, 1.51, "},
                                                    {"--airspeed '40 m/s'", "aero.thrust_insufficient("},
                                                    {"--turn '75 deg'", "aero.wing_stalls("},
                                                    {"--climb '-60 deg'", "aero.braking_insufficient("}};
  for (const auto& [words, sentence] : reported) {
    const Answer answer = call("trim configs/airframes/anaconda.yaml " + words);
    CHECK(answer.code == 1);
    CHECK(
        answer.says("configs/airframes/anaconda.yaml: aero.flight_impossible(aero.flight_condition(steady "));
    CHECK_MESSAGE(answer.says(sentence), answer.out);
    CHECK(answer.says("anaconda.yaml:"));
    CHECK(call("linearize configs/airframes/anaconda.yaml " + words).code == 1);
  }
  const Answer as_json = call("trim configs/airframes/anaconda.yaml --airspeed '8 m/s' --json");
  CHECK(as_json.code == 1);
  CHECK(as_json.json()["found"] == false);
  const Folder folder;
  const std::string nose_heavy =
      folder.write("heavy.yaml", changed("anaconda", "pitch: {zero: 0.135", "pitch: {zero: -0.9"));
  CHECK_MESSAGE(call("trim " + nose_heavy)
                    .says("aero.surface_throw_exceeded(-54.8 deg, elevator, 40.0 deg, " + nose_heavy + ":"),
                call("trim " + nose_heavy).out);
}

TEST_CASE("what cannot be an aircraft is refused with its line") {
  const Folder folder;
  const auto refused = [&](const std::string& old, const std::string& by, const std::string& sentence) {
    const std::string file = folder.write("bad.yaml", changed("anaconda", old, by));
    for (const char* word : {"trim ", "linearize ", "modes ", "check "}) {
      const Answer answer = call(word + file);
      CHECK(answer.code == 4);
      CHECK_MESSAGE(answer.says(file + ":" + sentence), answer.out);
    }
  };
  refused("mass: 4.5 kg", "mass: -4.5 kg",
          "6: mass: graph.value_out_of_range(-4.5 kg, 0.0001, 1e+06,  kg, )");
  refused("xz_kgm2: 0.06", "xz_kgm2: 0.6", "7: aero.inertia_not_positive_definite(0.36, 0.1536039)");
  refused("xx_kgm2: 0.24855", "xx_kgm2: 0",
          "7: inertia.xx_kgm2: graph.value_out_of_range(0, 1e-09, 1e+09,  kg m2, )");
  refused("elevator: {limit: 40 deg", "elevator: {limit_rad: 40",
          "39: elevator.limit_rad: graph.value_out_of_range(40, 0, 1.6,  rad, . Did you mean 40 deg?)");
  refused("span: 2.08 m", "span: 2.08 kg", "10: wing.span: ");
  refused("chord: 0.235 m", "cord: 0.235 m", "11: graph.field_unknown(wing: , cord, Wing, ");
}

TEST_CASE("faults of the command line are sentences, and the exit code is 2") {
  const std::map<std::string, std::string> reported{
      {"trim", "AIRFRAME is required"},
      {"trim configs/airframes/anaconda.yaml --fast", "--fast"},
      {"trim configs/airframes/anaconda.yaml --airspeed '5 kg'",
       "graph.dimension_differs(5 kg, a mass, , a speed)"},
      {"trim configs/airframes/anaconda.yaml --airspeed 0", "aero.airspeed_out_of_range(0)"},
      {"trim configs/airframes/anaconda.yaml --climb 5", "aero.climb_unit_invalid(5)"},
      {"trim configs/airframes/anaconda.yaml --turn 5", "aero.turn_unit_invalid(5)"},
      {"trim configs/airframes/anaconda.yaml --turn '89 deg'", "aero.turn_out_of_range(89 deg)"},
      {"trim configs/airframes/anaconda.yaml --altitude '90 km'", "aero.altitude_out_of_range(90 km)"},
      {"modes configs/airframes/anaconda.yaml --airspeed 20..10", "aero.airspeed_range_reversed(20..10)"},
      {"modes configs/airframes/anaconda.yaml --airspeed 10..20 --step 0", "aero.speed_step_invalid(500)"},
      {"", "subcommand"},
      {"trm configs/airframes/anaconda.yaml",
       "aero.command_unknown(trm,  [trim] trim, linearize, modes, check, tune, vlm, see, fly, import)"}};
  for (const auto& [words, sentence] : reported) {
    const Answer answer = call(words);
    CHECK(answer.code == 2);
    CHECK_MESSAGE(answer.says(sentence), answer.out);
  }
  const Answer no_file = call("check nowhere.yaml");
  CHECK(no_file.code == 4);
  CHECK(no_file.says("graph.file_missing(nowhere.yaml, )"));
  CHECK(call("check fulmar:airframes/anacond.yaml")
            .says("graph.file_missing(fulmar:airframes/anacond.yaml, . Did you mean "
                  "'fulmar:airframes/anaconda.yaml'?)"));
}

TEST_CASE("linearize prints the same matrices as JSON and as CSV") {
  const json o = call("linearize configs/airframes/aerosonde.yaml --json").json();
  CHECK(o["A"].size() == 12);
  CHECK(o["B"][0].size() == 4);
  CHECK(o["states"][3] == "u_mps");
  CHECK(o["longitudinal"]["states"] == json({"u_mps", "w_mps", "q_radps", "pitch_rad"}));
  CHECK(o["longitudinal"]["A"][0][0] == o["A"][3][3]);
  CHECK(o["lateral"]["B"][1][0] == o["B"][9][0]);
  std::istringstream csv(call("linearize configs/airframes/aerosonde.yaml --csv").out);
  std::string line, cell;
  std::getline(csv, line);
  CHECK(line ==
        "d/dt,north_m,east_m,down_m,u_mps,v_mps,w_mps,roll_rad,pitch_rad,yaw_rad,p_radps,q_radps,r_radps,"
        "aileron_rad,elevator_rad,rudder_rad,throttle_frac");
  for (std::size_t i = 0; i < 12; ++i) {
    REQUIRE(std::getline(csv, line));
    std::istringstream cells(line);
    std::getline(cells, cell, ',');
    CHECK(cell == o["states"][i]);
    for (std::size_t k = 0; k < 16; ++k) {
      REQUIRE(std::getline(cells, cell, ','));
      CHECK(std::stod(cell) == (k < 12 ? o["A"][i][k] : o["B"][i][k - 12]).get<double>());
    }
  }
}

TEST_CASE("modes over a range of speeds: every speed that is flown, and why the others are not") {
  const Folder folder;
  const std::string svg = (folder.path / "modes.svg").string();
  const Answer answer =
      call("modes configs/airframes/anaconda.yaml --airspeed '8..12 m/s' --step '2 m/s' --json --svg " + svg);
  CHECK(answer.code == 0);
  const json o = answer.json();
  REQUIRE(o["speeds"].size() == 2);
  REQUIRE(o["not_flown"].size() == 1);
  CHECK(o["not_flown"][0]["airspeed_mps"] == 8.0);
  const json& modes = o["speeds"][1]["modes"];
  REQUIRE(modes.size() == 5);
  CHECK(modes[0]["mode"] == "short period");
  CHECK(modes[2]["mode"] == "Dutch roll");
  CHECK(modes[4]["mode"] == "spiral");
  CHECK(modes[4]["stable"] == false);
  CHECK(modes[4]["time_to_half_s"].is_null());
  CHECK(modes[4]["natural_frequency_radps"].is_null());
  CHECK(modes[1]["period_s"].get<double>() > 5);
  const std::string too_slow = "modes configs/airframes/anaconda.yaml --airspeed '5 m/s'";
  CHECK(call(too_slow).code == 1);

  const std::string picture = text_of(svg);
  CHECK(picture.starts_with("<svg "));
  CHECK(picture.ends_with("</svg>\n"));
  CHECK(picture.find("Dutch roll") != std::string::npos);
  CHECK(picture.find("nan") == std::string::npos);
  const std::string again = (folder.path / "again.svg").string();
  call("modes configs/airframes/anaconda.yaml --airspeed '8..12 m/s' --step '2 m/s' --json --svg " + again);
  CHECK(text_of(again) == picture);
  const Answer nowhere =
      call("modes configs/airframes/anaconda.yaml --svg " + folder.path.string() + "/no/a.svg");
  CHECK(nowhere.code != 0);
  CHECK(nowhere.says("aero.picture_not_writable(" + folder.path.string() + "/no/a.svg)"));
}

TEST_CASE("a refused import names the line and the value") {
  const Folder folder;
  const std::string file = (folder.path / "x8_param.json").string();
  std::ofstream(file) << "{\"C_L_alpha\": 4,\n \"C_l_p\": -0.4,\n \"b\": }\n";
  CHECK(call("import " + file).says("x8_param.json:3: aero.json_invalid"));
  std::ofstream(file) << "{\"C_L_alpha\": 4,\n \"C_l_p\": -0.4, \"S_wing\": -1, \"b\": 2, \"c\": 1}\n";
  CHECK(call("import " + file).says("x8_param.json:2 S_wing: aero.positive_value_expected(-1)"));
  CHECK(call("import " + file + " --inertia 1 2").says("aero.inertia_values_expected(2)"));
}

}  // namespace words_test

// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_aero/test/aero_kit.hpp"

namespace words_test {

using namespace fulmar::aero::test;
using doctest::Approx;

TEST_CASE("trim tells angles, deflections, throttle and forces") {
  const Answer text = call("trim configs/airframes/anaconda.yaml --altitude '1457 m'");
  CHECK(text.code == 0);
  CHECK(text.says("anaconda: steady level flight at 17 m/s, 1457 m above the sea, density 1.0633 kg/m3"));
  const Answer as_json = call("trim configs/airframes/anaconda.yaml --altitude '1457 m' --json");
  CHECK(as_json.code == 0);
  const nlohmann::json o = as_json.json();
  CHECK(o["found"] == true);
  CHECK(o["elevator_deg"].get<double>() == Approx(0.1212 * 57.2958).epsilon(2e-3).scale(0));  // the file's trim
  CHECK(o["aileron_deg"].get<double>() == Approx(0.0041 * 57.2958).epsilon(2e-2).scale(0));
  CHECK(o["throttle_frac"].get<double>() == Approx(0.57).epsilon(2e-3).scale(0));
  CHECK(o["turn_radius_m"].is_null());
}

}  // namespace words_test

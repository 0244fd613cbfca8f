// SPDX-License-Identifier: BSD-3-Clause
// Controls ahead of the centre of gravity have the sign of their effect.
#include "tools/fulmar_aero/airframe_file.hpp"
#include "tools/fulmar_aero/test/aero_kit.hpp"

namespace canard_test {

using namespace fulmar::aero;
using namespace fulmar::aero::test;

namespace {
const std::string petrel = FULMAR_SOURCE_DIR "/configs/drawings/petrel.yaml";
std::string with(std::string text, const std::string& old, const std::string& by) {
  const std::size_t at = text.find(old);
  REQUIRE(at != std::string::npos);
  return text.replace(at, old.size(), by);
}
}  // namespace

TEST_CASE("an elevator and a rudder ahead of the centre of gravity are turned as a whole, and told" *
          doctest::test_suite("amounts")) {
  const Folder folder;
  const std::string text = text_of(petrel);
  const auto computed = [&](const char* name, const std::string& drawing) {
    const Answer answer = call("vlm " + folder.write(name, drawing) + " --json -o " +
                               (folder.path / (std::string(name) + ".out")).string());
    REQUIRE_MESSAGE(answer.code == 0, answer.out);
    return answer.json();
  };
  const std::string canard = with(text, "x: 0.78 m", "x: -0.55 m");
  const auto front = computed("canard.yaml", canard);
  const auto& turned = front["derivatives"]["elevator"];
  const auto& lattice = front["lattice"]["elevator"];
  for (const char* c : {"CL", "CD", "Cm"}) CHECK(turned[c].get<double>() == -lattice[c].get<double>());
  CHECK(turned["Cm"].get<double>() < 0);
  CHECK(turned["CL"].get<double>() < 0);
  CHECK(front["turned"] == "aero.elevator_leading_up: aero.servo_reversal_needed");
  const std::string out = (folder.path / "canard.yaml.out").string();
  CHECK(text_of(out).find("aero.elevator_leading_up: aero.servo_reversal_needed") != std::string::npos);
  const fulmar::Airframe a = read_airframe_file(out).airframe;
  CHECK(a.aero.pitch.elevator_ratio / turned["Cm"].get<double>() == doctest::Approx(1).epsilon(1e-4));

  const auto fin = computed("fin.yaml", with(text, "x: 0.76 m", "x: -0.6 m"));
  CHECK(fin["derivatives"]["rudder"]["Cn"].get<double>() < 0);
  CHECK(fin["derivatives"]["rudder"]["CY"].get<double>() == -fin["lattice"]["rudder"]["CY"].get<double>());
  CHECK(fin["turned"].get<std::string>().rfind("aero.rudder_leading_right: ", 0) == 0);

  const auto tail = computed("petrel.yaml", text);
  CHECK(tail["turned"] == "");
  CHECK(tail["derivatives"]["elevator"]["CL"].get<double>() > 0);
}

TEST_CASE("winglets of their own in the vortex of the wing tip: the sentence says what spoils the lift") {
  const Folder folder;
  const std::string winglets =
      "  - {name: winglet, mirror: true, x: 0.15 m, chordwise: 6, spanwise: 8, sections: [{x: 0 m, y: 0.9 m, "
      "z: 0.06 m, chord: 0.12 m, airfoil: tail}, {x: 0.05 m, y: 0.9 m, z: 0.2 m, chord: 0.08 m, airfoil: "
      "tail}]}\n  - name: fin\n";
  const Answer answer =
      call("vlm " + folder.write("w.yaml", with(text_of(petrel), "  - name: fin\n", winglets)));
  CHECK(answer.code == 4);
  CHECK_MESSAGE(
      answer.says("aero.cruise_lift_unreachable(15, 2.5, 0.448, aero.lift_not_of_wings(4.4, -1.66))"),
      answer.out);
  // too heavy is another sentence
  const Answer heavy =
      call("vlm " + folder.write("h.yaml", with(text_of(petrel), "mass: 0.62 kg, x", "mass: 62 kg, x")));
  CHECK(heavy.says("aero.cruise_lift_unreachable(15, 63.9, 11.5, aero.cruise_condition_unsuitable)"));
  CHECK_FALSE(heavy.says("aero.lift_not_of_wings"));
}

}  // namespace canard_test

// SPDX-License-Identifier: BSD-3-Clause
// `fulmar restart`: a simulation ends, and the same host flies its mission again.
#include <string>

#include "core/app/test/shell.hpp"

namespace app_test {
namespace {

/// Shell words. `fly OPTIONS`: a flight in the background, whose port is then in $FULMAR_LIVE. `landed`: its
/// exit code.
std::string script(const std::string& then) {
  return "cd " + folder().string() +
         " && rm -rf new && mkdir new && cd new && export FULMAR_TOKEN=secret && F=" FULMAR_BIN_DIR
         "/fulmar\n"
         "fly() { (\"$F\" run m.yaml --live 127.0.0.1:0 \"$@\" >out 2>&1 & echo $! >pid; wait $!; echo $? "
         ">code) & \n"
         "  until grep -q 'live view' out 2>/dev/null; do [ ! -e code ] || { cat out; exit 99; }; sleep "
         "0.05; done\n"
         "  export FULMAR_LIVE=$(sed -n 's|live view: ws://||p' out); }\n"
         "landed() { wait; cat code; }\n"
         "mission() { printf 'mission: m\\nextends: %s\\n%s\\n' " +
         hourglass + " \"$1\" >m.yaml; }\n" + then;
}

}  // namespace

TEST_CASE(
    "the second flight of a host is that of a fresh one, with its seed and the files as they are then") {
  const Result r = shell(script(
      "mission ''; echo mine >one-2.mcap\n"
      "fly --speed real --duration 20 --log one.mcap\n"
      "\"$F\" pause && \"$F\" param set slc.course_kp 1.1\n"  // applies to this flight alone
      "mission 'components: {slc: {params: {roll_limit: 31 deg}}}'\n"
      "\"$F\" restart --seed 11 >/dev/null && echo accepted\n"  // once the new flight listens
      "\"$F\" param get slc.roll_limit slc.course_kp\n"
      "\"$F\" list --json | grep -o '\"origin\":{[^}]*}'; \"$F\" list --json | grep -o "
      "'\"seed\":\"[0-9]*\"'\n"
      "sed -i 's/31 deg/31 kg/' m.yaml\n"
      "\"$F\" restart\n"  // cannot be flown: the previous mission flies
      "\"$F\" speed max; landed\n"
      "sed -i 's/31 kg/31 deg/' m.yaml\n"
      "\"$F\" run m.yaml --duration 20 --seed 11 --log fresh.mcap >/dev/null 2>&1\n"
      "cmp fresh.mcap one-4.mcap && echo equal; cat one-2.mcap; ls *.mcap *.part 2>/dev/null\n"
      "\"$F\" log info one.mcap >/dev/null && \"$F\" log info one-3.mcap >/dev/null && echo whole; cat out"));
  CAPTURE(r.out);
  CAPTURE(r.err);
  const auto holds = [&](const char* words) { return r.out.find(words) != std::string::npos; };
  const char* const second =
      "accepted\nslc.roll_limit: 31 deg\nslc.course_kp: 2.1 rad/rad\n"
      "\"origin\":{\"alt_msl_m\":1387.0,\"lat_deg\":40.2463724,\"lon_deg\":-111.6474138}\n\"seed\":\"11\"\n";
  CHECK(holds(second));
  CHECK(holds("\n0\nequal\nmine\nfresh.mcap\none-2.mcap\none-3.mcap\none-4.mcap\none.mcap\nwhole\n"));
  CHECK(holds("m: interrupted (run.ended_for_restart)"));
  CHECK(holds("31 kg"));
  CHECK(holds("app.former_mission_kept"));
  CHECK_FALSE(holds("       change\n"));
}

TEST_CASE("one of several flights rejects a restart, and so does an invalid seed") {
  const Result r =
      shell(script("mission ''; fly --speed real --repeat 2 --duration 20 --no-log\n"
                   "\"$F\" restart 2>&1; echo $?; \"$F\" restart --seed -1 2>&1; echo $?\n"
                   "kill -INT $(cat pid); landed"));
  CAPTURE(r.out);
  CHECK(r.out.starts_with(
      "remote.request_rejected(restart, run.restart_not_possible(this is one of the flights of "
      "--repeat))\n1\ntap.seed_invalid(-1)\n2\n"));
  CHECK(r.out.ends_with("\n2\n130\n"));
}

}  // namespace app_test

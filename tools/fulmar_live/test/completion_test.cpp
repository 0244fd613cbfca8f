// SPDX-License-Identifier: BSD-3-Clause
// Completions of shells at the end of a line.
#include <algorithm>

#include "core/log/test/log_kit.hpp"
#include "tools/fulmar_live/test/typed.hpp"

namespace remote_test {
namespace {

/// Completions of bash at the end of a line.
std::vector<std::string> completed(const MockFlight& flight, const std::string& line) {
  const std::string script = "source <(" + program + " completion bash); COMP_LINE='" + line +
                             "'; COMP_POINT=${#COMP_LINE}; read -ra COMP_WORDS <<<\"$COMP_LINE\"; [[ "
                             "$COMP_LINE == *\" \" ]] && COMP_WORDS+=(\"\"); "
                             "COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); COMP_WORDS[0]=" +
                             program + "; _fulmar; printf \"%s\\n\" \"${COMPREPLY[@]}\"";
  const fs::path file = fs::temp_directory_path() / ("fulmar-completion-" + std::to_string(getpid()) + ".sh");
  std::ofstream(file) << script;
  const Result r = shell("FULMAR_LIVE=" + flight.at() + " bash " + file.string());
  fs::remove(file);
  CHECK(r.err == "");
  std::vector<std::string> list = lines(r.out);
  std::erase(list, "");
  return list;
}

}  // namespace

TEST_CASE("bash completes commands, options, and names of the running flight") {
  const MockFlight flight;
  CHECK(completed(flight, "fulmar ech") == Words{"echo"});
  CHECK(completed(flight, "fulmar param s") == Words{"set", "save"});
  CHECK(completed(flight, "fulmar echo --c") == Words{"--count", "--csv"});
  CHECK(completed(flight, "fulmar echo s") == Words{"slc.leg"});
  CHECK(completed(flight, "fulmar echo --rate 5 slc.leg.c") == Words{"slc.leg.course_deg"});
  CHECK(completed(flight, "fulmar plot slc.leg.position_m.n") == Words{"slc.leg.position_m.north"});
  CHECK(completed(flight, "fulmar plot plan.m") == Words{"plan.mixed."});
  const Folder folder;
  const std::string log = (folder.path / "seen.mcap").string();
  std::ofstream(folder.path / "seen.txt") << "no log", std::ofstream(log) << "";
  CHECK(completed(flight, "fulmar plot " + (folder.path / "se").string()) == Words{log});
  CHECK(completed(flight, "fulmar plot --ov") == Words{"--over"});
  CHECK(completed(flight, "fulmar plot x --over slc.leg.position_m.n") == Words{"slc.leg.position_m.north"});
  const std::string real = (folder.path / "real.mcap").string();
  {
    test::Sample sample({.file = real});
    const std::uint16_t channel = sample.channel("/nav/number", *test::number_type());
    const test::Number number{1};
    sample.write(channel, 0, test::bytes_of(number));
    sample.writer.close();
  }
  const Result picture = typed(flight, "plot " + real + " nav.number.value_ratio");
  CHECK(picture.code == 0);
  CHECK(picture.out.starts_with("\u2501\u2501 nav.number.value_ratio  1\n"));
  CHECK(lines(picture.out).size() == 23);
  CHECK(typed(flight, "plot " + real + " nav.number.value_ratio --over nav.number.value_ratio").code == 2);
  CHECK(completed(flight, "fulmar plot " + real + " n") == Words{"nav.number."});
  CHECK(completed(flight, "fulmar plot " + real + " --from 3 nav.number.") ==
        Words{"nav.number.value_ratio"});
  const std::pair<const char*, Words> offers[] = {
      {"fulmar param set slc.r", {"slc.roll_kp"}},
      {"fulmar param set slc.roll_kp ", {}},
      {"fulmar param set slc.roll_kp 0.5 slc.l", {"slc.law"}},
      {"fulmar param save ", {"plan", "slc"}},
      {"fulmar call p", {"plan.add_leg"}},
      {"fulmar phase ", {"cruise", "hold"}},
      {"fulmar run --io ", {"sim", "fcu"}},
      {"fulmar speed ", {"real", "max"}},
      {"fulmar paus", {"pause"}},
      {"fulmar aero m", {"modes"}},
      {"fulmar aero modes --s", {"--step", "--svg"}},
      {"fulmar aero trim configs/airframes/an", {"configs/airframes/anaconda.yaml"}},
      {"fulmar aero import README.md --mas", {"--mass"}},
      {"fulmar aero import README.md configs/airframes/an", {"configs/airframes/anaconda.yaml"}},
      {"fulmar import ", {"rosplane"}},
      {"fulmar run configs/missions/hourg", {"configs/missions/hourglass.yaml"}},
      {"fulmar echo s --at 127.0.0.1:1 sl", {}},
      {"fulmar fcu ", {}},
  };
  for (const auto& offer : offers) {
    const std::string line(offer.first);
    CAPTURE(line);
    CHECK(completed(flight, line) == offer.second);
  }
  const Words all = completed(flight, "fulmar ");
  CHECK(std::find(all.begin(), all.end(), "fcu") != all.end());
  CHECK(std::find(all.begin(), all.end(), "aero") != all.end());
  CHECK(std::find(all.begin(), all.end(), "param") != all.end());
  CHECK(std::find(all.begin(), all.end(), "complete") == all.end());
}

}  // namespace remote_test

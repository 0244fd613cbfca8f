// SPDX-License-Identifier: BSD-3-Clause
// NASA's check cases of six degrees of freedom (NASA/TM-2015-218675): each runs with the SDK's equations of
// motion, Earth and atmosphere and is compared with the simulators of NASA, whose files are in DIR. The
// difference from their median may be three times the largest one among them. Exits 1 when it is larger, 2
// when the files are missing or damaged.
// bench_six_dof DIR [--json]
#include <cstdio>
#include <cstring>
#include <nlohmann/json.hpp>

#include "six_dof/family.hpp"

using namespace fulmar::six_dof;
namespace six_dof_messages = fulmar::six_dof_messages;

namespace {

int usage() {
  std::fprintf(stderr, "%s\n", six_dof_messages::usage.c_str());
  return 2;
}

void print(const Case& c, const std::vector<Figure>& figures) {
  std::printf("%s  %s\n", c.number, c.what);
  for (const Figure& f : figures)
    std::printf("    %-14s departure %12.3g   bar %12.3g%s\n", f.signal, f.departure, f.bar,
                f.within() ? "" : "   BEYOND");
}

}  // namespace

int main(int argc, char** argv) {
  const char* folder = nullptr;
  bool json = false;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--json") == 0)
      json = true;
    else if (folder || argv[i][0] == '-')
      return usage();
    else
      folder = argv[i];
  }
  if (!folder) return usage();
  bool within = true;
  nlohmann::json all = nlohmann::json::object();
  try {
    for (const Case& c : cases()) {
      const auto theirs = recordings(folder, c.number);
      const auto figures = compared(flown(c, start_of(theirs, c)), theirs, c);
      for (const Figure& f : figures) {
        within = within && f.within();
        all["cases"][c.number][f.signal] = {
            {"departure", f.departure}, {"bar", f.bar}, {"within", f.within()}};
      }
      if (!json) print(c, figures);
    }
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 2;
  }
  all["within"] = within;
  if (json) std::printf("%s\n", all.dump(2).c_str());
  return within ? 0 : 1;
}

// SPDX-License-Identifier: BSD-3-Clause
// Times of `fulmar aero` and `fulmar import` on one core, with the start of the program: the smallest of five
// runs, in processor time of the program and its children, and in real time. Exits 1 when a time exceeds its
// bound.
// bench_aero [--json]
#include <fcntl.h>
#include <sched.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

struct Cost {
  double processor_s = 0, clock_s = 0;
  int code = 0;
};

double seconds(const timeval& t) { return double(t.tv_sec) + 1e-6 * double(t.tv_usec); }
double now_s() {
  timespec t{};
  clock_gettime(CLOCK_MONOTONIC, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

Cost run_once(const std::vector<std::string>& words) {
  const double begin = now_s();
  const pid_t child = fork();
  if (child == 0) {
    cpu_set_t one;
    CPU_ZERO(&one);
    CPU_SET(0, &one);
    sched_setaffinity(0, sizeof one, &one);
    const int null = open("/dev/null", O_WRONLY);
    dup2(null, 1);
    dup2(null, 2);
    std::vector<char*> argv;
    for (const std::string& word : words) argv.push_back(const_cast<char*>(word.c_str()));
    argv.push_back(nullptr);
    execv(argv[0], argv.data());
    _exit(127);
  }
  Cost cost;
  int status = 0;
  rusage used{};
  if (wait4(child, &status, 0, &used) != child) return {0, 0, 127};
  cost.clock_s = now_s() - begin;
  cost.processor_s = seconds(used.ru_utime) + seconds(used.ru_stime);
  cost.code = WIFEXITED(status) ? WEXITSTATUS(status) : 127;
  return cost;
}

struct Row {
  std::string name;
  double most_s;
  int runs;
  std::vector<std::string> words;
  Cost cost;
};

/// The shipped drawing with `times` as many panels along chord and span.
std::string finer(const std::string& drawing, int times) {
  std::ifstream in(drawing);
  std::string out;
  for (std::string line; std::getline(in, line); out += line + "\n")
    for (const char* key : {"chordwise: ", "spanwise: "})
      if (const std::size_t at = line.find(key); at != std::string::npos) {
        const std::size_t number = at + std::strlen(key);
        line = line.substr(0, number) + std::to_string(times * std::atoi(line.c_str() + number));
      }
  return out;
}

}  // namespace

int main(int argc, char** argv) {
  const bool json = argc == 2 && std::strcmp(argv[1], "--json") == 0;
  if (argc > 1 && !json) {
    std::fprintf(stderr, "usage: bench_aero [--json]\n");
    return 2;
  }
  const std::string bin = fs::read_symlink("/proc/self/exe").parent_path().string() + "/",
                    source = FULMAR_SOURCE_DIR;
  const std::string aero = bin + "fulmar-aero", tern = source + "/tools/fulmar_aero/test/import/";
  char folder_name[] = "/tmp/bench_aero_XXXXXX";
  const std::string folder = std::string(mkdtemp(folder_name)) + "/";
  std::ofstream(folder + "fine.yaml") << finer(source + "/configs/drawings/petrel.yaml", 2);
  const std::string petrel = folder + "petrel.yaml", anaconda = source + "/configs/airframes/anaconda.yaml";
  std::vector<Row> rows{
      {"import, three logs of XFLR5",
       0.1,
       5,
       {aero, "import", tern + "tern_e.log", tern + "tern_a.log", tern + "tern_r.log", "-o",
        folder + "tern.yaml"},
       {}},
      {"import, AVL's .st and .mass",
       0.1,
       5,
       {aero, "import", tern + "tern.st", tern + "tern.mass", "-o", folder + "tern.yaml"},
       {}},
      {"import, a sweep of VSPAERO",
       0.1,
       5,
       {aero, "import", tern + "tern_sweep.stab", "--mass", "3 kg", "-o", folder + "tern.yaml"},
       {}},
      {"check, anaconda.yaml", 1, 5, {aero, "check", anaconda}, {}},
      {"vlm, the Petrel, 504 panels",
       5,
       3,
       {aero, "vlm", source + "/configs/drawings/petrel.yaml", "-o", petrel},
       {}},
      {"vlm, the Petrel, 2016 panels",
       5,
       3,
       {aero, "vlm", folder + "fine.yaml", "-o", folder + "fine_out.yaml"},
       {}},
      {"fly, the Petrel: check to hourglass", 20, 1, {aero, "fly", petrel}, {}}};
  bool kept = true;
  nlohmann::json out = nlohmann::json::array();
  if (!json) std::printf("%-38s%14s%12s%10s\n", "", "processor, s", "clock, s", "at most");
  for (Row& row : rows) {
    for (int i = 0; i < row.runs; ++i) {
      const Cost one = run_once(row.words);
      if (i == 0 || one.processor_s < row.cost.processor_s) row.cost = one;
      if (one.code != 0) row.cost.code = one.code;
    }
    const bool good = row.cost.code == 0 && row.cost.processor_s <= row.most_s;
    kept = kept && good;
    out.push_back({{"name", row.name},
                   {"processor_s", row.cost.processor_s},
                   {"clock_s", row.cost.clock_s},
                   {"most_s", row.most_s},
                   {"code", row.cost.code},
                   {"kept", good}});
    if (!json)
      std::printf("%-38s%14.3f%12.3f%10.1f%s\n", row.name.c_str(), row.cost.processor_s, row.cost.clock_s,
                  row.most_s,
                  good                 ? ""
                  : row.cost.code != 0 ? "  failed"
                                       : "  too long");
    std::fflush(stdout);
  }
  if (json) std::printf("%s\n", out.dump(2).c_str());
  fs::remove_all(folder);
  return kept ? 0 : 1;
}

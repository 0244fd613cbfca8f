// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_fcu/param_file.hpp"

#include <doctest/doctest.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>

#include "lossy_port.hpp"

namespace param_file_test {

namespace {

using namespace fulmar::fcu;
using fulmar::fcu::test::Bench;

struct File {
  std::string path = "/tmp/fulmar_fcu_params_" + std::to_string(::getpid()) + ".yaml";
  explicit File(const std::string& text) { std::ofstream(path) << text; }
  ~File() { std::remove(path.c_str()); }
};

std::string fault_of(const std::string& text, const std::vector<Param>& now = {}) {
  const File file(text);
  try {
    const auto list = read_param_file(file.path);
    if (!now.empty()) changes(list, now);
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

const std::vector<Param> controller{{"RC_ARM_CHN", 0, true, std::bit_cast<std::uint32_t>(-1), 0},
                                    {"ACC_LPF", 1, false, std::bit_cast<std::uint32_t>(0.5f), 0}};

TEST_CASE("what is saved is what is read, for all 333 to the bit") {
  Bench bench;
  bench.firmware.provision();
  Client client = bench.client();
  client.connect();
  const auto list = read_params(client);
  const File file(param_file_text(list, client.version()));
  const auto back = read_param_file(file.path);
  CHECK(back.size() == 333);
  CHECK(changes(back, list).empty());
  std::vector<Param> other = list;
  for (Param& p : other) p.bits ^= 1;
  CHECK(changes(back, other).size() == 333);
}

TEST_CASE("the file names the firmware, and stands in the order of the controller") {
  CHECK(param_file_text(controller, "v2.0.1") ==
        "# fcu.param_file_title(v2.0.1)\n"
        "# fcu.param_file_columns\n"
        "RC_ARM_CHN: -1                     # 0 int\n"
        "ACC_LPF: 0.5                       # 1 float\n");
}

TEST_CASE("the list of ROSflight's own tools is read, too") {
  const File file(
      "- {name: RC_ARM_CHN, type: 6, value: 4}\n- {name: ACC_LPF, type: 9, value: 0.3000000119}\n");
  const auto todo = changes(read_param_file(file.path), controller);
  REQUIRE(todo.size() == 2);
  CHECK(todo[0].wanted() == "4");
  CHECK(todo[1].bits == std::bit_cast<std::uint32_t>(0.3f));
  CHECK(changes_text(todo) ==
        "parameter         controller      file\n"
        "RC_ARM_CHN        -1              4\n"
        "ACC_LPF           0.5             0.3\n");
}

TEST_CASE("every fault of a file is told with its line") {
  struct Fault {
    std::string text, message;
    std::vector<Param> now;
  };
  const Fault faults[] = {
      {"RC_ARM_CHM: 4\n",
       ".yaml:1: fcu.file_parameter_unknown(RC_ARM_CHM, fcu.parameter_suggestion(RC_ARM_CHN))", controller},
      {"ACC_LPF: 0.1\nRC_ARM_CHN: 1.5\n", ".yaml:2: fcu.whole_number_expected(RC_ARM_CHN, 1.5)", controller},
      {"- {name: ACC_LPF, type: 6, value: 1}\n", ".yaml:1: fcu.parameter_type_mismatch(ACC_LPF, 9 (number))",
       controller},
      {"- {name: ACC_LPF, type: 5, value: 1}\n", "fcu.parameter_type_invalid('5')", {}},
      {"- {name: ACC_LPF, value: 1}\n", ".yaml:1: fcu.parameter_key_missing(type)", {}},
      {"ACC_LPF: 1\nACC_LPF: 2\n", ":2", {}},
      {"- {name: A, type: 6, value: 1}\n- {name: A, type: 6, value: 1}\n",
       "fcu.parameter_duplicate(A, 1)",
       {}},
      {"ACC_LPF: [1, 2]\n", "fcu.number_expected(a list)", {}},
      {"A: 1\nACC_LPF: [1, 2\n", ".yaml:", {}},
      {"just words\n", "fcu.parameter_list_expected('just words')", {}}};
  for (const Fault& fault : faults) {
    CAPTURE(fault.text);
    CHECK(fault_of(fault.text, fault.now).find(fault.message) != std::string::npos);
  }
  const std::string several = fault_of("A: 1\nB: 2\nACC_LPF: x\n", controller);
  CHECK(std::count(several.begin(), several.end(), '\n') >= 2);
}

TEST_CASE("a file that is there is not written over, unless asked for") {
  const File file("A: 1\n");
  CHECK_THROWS_WITH(write_param_file(file.path, "B: 2\n", false),
                    ("fcu.file_exists(" + file.path + ")").c_str());
  write_param_file(file.path, "B: 2\n", true);
  CHECK(read_param_file(file.path)[0].name == "B");
  CHECK_THROWS_WITH(write_param_file("/nowhere/at/all.yaml", "B: 2\n", false),
                    "fcu.file_not_writable(/nowhere/at/all.yaml)");
}

TEST_CASE("a loaded mixer of one's own survives that the choice of a mixer fills the matrix") {
  Bench bench;
  bench.firmware.provision();
  Client client = bench.client();
  client.connect();
  const File file("PRI_MIXER_4_1: 0.75\nPRIMARY_MIXER: 11\nFIXED_WING: 1\nFAILSAFE_THR: 0.1\n");
  const auto wanted = read_param_file(file.path);
  const auto left = load_params(client, wanted, changes(wanted, read_params(client)));
  CHECK(left.empty());
  CHECK(bench.firmware.params().f(bench.firmware.params().find("PRI_MIXER_4_1")) == 0.75f);
}

}  // namespace

}  // namespace param_file_test

// SPDX-License-Identifier: BSD-3-Clause
// Arrays and matrices of parameters: each element is a parameter, with its indices in the name.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "fulmar/testing.hpp"

namespace arrays_test {

using namespace fulmar;

namespace {

struct Regulator {
  struct Inputs {};
  struct Outputs {
    Probe sum_ratio;
  };
  struct Params {
    Flag on{true, "works"};
    Matrix<2, 3> K{{{1, 2, 3}, {4, 5, 6}}, "rad/rad", -10, 10, "state feedback"};
    std::array<Param, 2> gains{{{0.5, "1/s", 0, 1, "slow"}, {0.7, "1/s", 0, 2, "fast", setup}}};
    std::array<std::array<Count, 2>, 11> deep{};
    Param last{9, "s", 0, 10, "after all"};
  };
  Status step(const Tick&, const Inputs&, const Params& p, Outputs& out) {
    out.sum_ratio = p.K(1, 2) + p.gains[1] + p.last;
    return Status::ok;
  }
};

constexpr fulmar_component entry = detail::component_entry<Regulator>();

const fulmar_param& param(const std::string& name) {
  for (std::uint32_t i = 0; i < entry.param_count; ++i)
    if (entry.params[i].name == name) return entry.params[i];
  FAIL(name);
  return entry.params[0];
}

}  // namespace

TEST_CASE("each element is a parameter, named by its indices, in the order of the members") {
  REQUIRE(entry.param_count == 1 + 6 + 2 + 22 + 1);
  std::vector<std::string> names;
  for (std::uint32_t i = 0; i < 9; ++i) names.emplace_back(entry.params[i].name);
  CHECK(names == std::vector<std::string>{"on", "K_0_0", "K_0_1", "K_0_2", "K_1_0", "K_1_1", "K_1_2",
                                          "gains_0", "gains_1"});
  CHECK(std::string(entry.params[30].name) == "deep_10_1");
  CHECK(std::string(entry.params[31].name) == "last");
}

TEST_CASE("an element has its own default, and the range, unit and text of its matrix") {
  const fulmar_param& k = param("K_1_0");
  CHECK(k.kind == FULMAR_NUMBER);
  CHECK(k.initial[0] == 4);
  CHECK(k.min == -10);
  CHECK(std::string(k.unit) == "rad/rad");
  CHECK(std::string(k.doc) == "state feedback");
  CHECK(k.flags == FULMAR_LIVE);
  CHECK(param("gains_1").max == 2);
  CHECK(param("gains_1").flags == 0);
}

TEST_CASE("values of the host arrive in their elements") {
  fulmar_error error{};
  void* instance = entry.create(1, &error);
  std::vector<fulmar_value> values(entry.param_count);
  for (std::uint32_t i = 0; i < entry.param_count; ++i) {
    values[i].number[0] = 100 + i;
    values[i].integer = 100 + i;
  }
  REQUIRE(entry.configure(instance, values.data(), &error) == FULMAR_OK);
  const auto& p = static_cast<detail::Instance<Regulator>*>(instance)->params;
  CHECK(p.K(0, 0) == 101);
  CHECK(p.K(1, 2) == 106);
  CHECK(p.gains[0] == 107);
  CHECK(p.deep[10][1] == 130);
  CHECK(p.last == 131);
  entry.destroy(instance);
}

}  // namespace arrays_test

// SPDX-License-Identifier: BSD-3-Clause
// Groups of parameters: structs of parameters inside Params, flattened without a prefix.
#include <doctest/doctest.h>

#include <string>
#include <utility>
#include <vector>

#include "fulmar/testing.hpp"

namespace groups_test {

using namespace fulmar;

namespace {

enum class Law : std::uint8_t { hold, takeoff };

struct Gains {
  double roll_ratio = 1;
};

/// Two laws share these; one of them contains another group.
struct Limits {
  Param roll_max{0.5, "rad", 0, 1, "bank"};
  Param pitch_max{0.25, "rad", 0, 1, "pitch", setup};
};
struct Lateral {
  Param course_kp{2, "rad/rad", 0, 10, "roll per course error"};
  Limits limits;
  Flag coordinated{true, "turns"};
};
struct Grouped {
  struct Inputs {};
  struct Outputs {
    Probe sum_ratio;
  };
  struct Params {
    Choice<Law> law{Law::takeoff, "which law"};
    Lateral lateral{.course_kp = {3, "rad/rad", 0, 9, "this law's own"}, .limits = {}, .coordinated = {}};
    Count n{3, 0, 10, "how many"};
    struct Air {
      Record<Gains> gains{"a record"};
      TextParam<8> word{"abc", "a word"};
    } air;
    Param last{1, "s", 0, 2, "after all groups"};
  };
  void configure(const Params& p) { seen = p; }
  void retune(const Params& p) { seen = p; }
  Status step(const Tick&, const Inputs&, const Params& p, Outputs& out) {
    out.sum_ratio = p.lateral.course_kp + p.lateral.limits.roll_max + p.last;
    return Status::ok;
  }
  Params seen;
};
/// The same group alone, with other defaults.
struct Other {
  struct Inputs {};
  struct Outputs {};
  struct Params {
    Lateral lateral;
  };
  Status step(const Tick&, const Inputs&, const Params&, Outputs&) { return Status::ok; }
};

}  // namespace

TEST_CASE("a group's parameters stand in its place in the table, under their own names, without a prefix") {
  constexpr fulmar_component c = detail::component_entry<Grouped>();
  std::vector<std::string> names;
  for (std::uint32_t i = 0; i < c.param_count; ++i) names.emplace_back(c.params[i].name);
  CHECK(names == std::vector<std::string>{"law", "course_kp", "roll_max", "pitch_max", "coordinated", "n",
                                          "gains", "word", "last"});
  CHECK(c.params[1].initial[0] == 3);  // default of this law; the rest of the group has its own defaults
  CHECK(c.params[1].max == 9);
  CHECK(std::string(c.params[1].doc) == "this law's own");
  CHECK(c.params[2].initial[0] == 0.5);
  CHECK(std::string(c.params[2].unit) == "rad");
  CHECK((c.params[2].flags & FULMAR_LIVE) != 0);
  CHECK((c.params[3].flags & FULMAR_LIVE) == 0);
  CHECK(c.params[4].kind == FULMAR_FLAG);
  CHECK(c.params[4].initial[0] == 0);
  CHECK(c.params[6].kind == FULMAR_RECORD);
  CHECK(static_cast<const Gains*>(c.params[6].initial_data)->roll_ratio == 1);
  CHECK(std::string(c.params[7].initial_text) == "abc");
  CHECK(c.params[8].initial[0] == 1);

  constexpr fulmar_component other = detail::component_entry<Other>();
  REQUIRE(other.param_count == 4);
  CHECK(std::string(other.params[0].name) == "course_kp");
  CHECK(other.params[0].initial[0] == 2);
  CHECK(other.params[3].initial[0] == 1);
}

TEST_CASE("values find their way into groups, in configure, retune and step") {
  const fulmar_component c = detail::component_entry<Grouped>();
  fulmar_error error{};
  void* instance = c.create(1, &error);
  REQUIRE(instance != nullptr);
  std::vector<fulmar_value> v(c.param_count);
  v[0].integer = 0;
  v[1].number[0] = 4;
  v[2].number[0] = 0.75;
  v[3].number[0] = 0.125;
  v[4].integer = 1;
  v[5].integer = 7;
  const Gains gains{6};
  v[6].data = &gains;
  v[6].size = sizeof gains;
  v[6].integer = 1;
  v[7].text = "xyz";
  v[8].number[0] = 1.5;
  REQUIRE(c.configure(instance, v.data(), &error) == FULMAR_OK);
  const Grouped::Params& p = static_cast<detail::Instance<Grouped>*>(instance)->component.seen;
  CHECK(p.law == Law::hold);
  CHECK(p.lateral.course_kp == 4);
  CHECK(p.lateral.limits.roll_max == 0.75);
  CHECK(p.lateral.limits.pitch_max == 0.125);
  CHECK(p.lateral.coordinated);
  CHECK(p.n == 7);
  CHECK(p.air.gains->roll_ratio == 6);
  CHECK(p.air.word.view() == "xyz");
  CHECK(p.last == 1.5);
  v[2].number[0] = 0.25;
  REQUIRE(c.retune(instance, v.data(), &error) == FULMAR_OK);
  CHECK(p.lateral.limits.roll_max == 0.25);
  double sum = 0;
  fulmar_output out{};
  out.data = &sum;
  const fulmar_tick tick{};
  REQUIRE(c.step(instance, &tick, nullptr, &out, &error) == FULMAR_OK);
  CHECK(sum == 4 + 0.25 + 1.5);
  c.destroy(instance);

  Bench<Grouped> bench;
  bench.params.lateral.limits.roll_max.value = 0.125;
  REQUIRE(bench.step(0.01) == Status::ok);
  CHECK(bench.out.sum_ratio.value == 3 + 0.125 + 1);
}

TEST_CASE("a walk through const parameters sees them const, and one through others may change them") {
  Grouped::Params params;
  int numbers = 0;
  auto look = [&]<class P>(P&) {
    static_assert(std::is_const_v<P>);
    if constexpr (std::is_same_v<P, const Param>) ++numbers;
  };
  detail::for_each_param(std::as_const(params), look);
  CHECK(numbers == 4);
  auto change = [&]<class P>(P& p) {
    static_assert(!std::is_const_v<P>);
    if constexpr (std::is_same_v<P, Param>) p.value = 0.5;
  };
  detail::for_each_param(params, change);
  CHECK(params.lateral.limits.pitch_max == 0.5);
  CHECK(params.last == 0.5);
}

}  // namespace groups_test

// SPDX-License-Identifier: BSD-3-Clause
// Groups of ports: structs of ports inside Inputs and Outputs, flattened without a prefix.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "fulmar/testing.hpp"

namespace port_groups_test {

using namespace fulmar;

namespace {

struct Height {
  double height_m = 0;
};
struct Speed {
  double speed_mps = 0;
};

struct Sensors {
  In<Height> height;
  Optional<Speed> speed;
};
struct Shown {
  Out<Height> mean;
  Speed fastest;
  Probe n_ratio;
};
struct Pair {
  struct Inputs {
    Queue<Speed> before;
    Sensors sensors;
    Optional<Height> after;
  };
  struct Outputs {
    Probe first_ratio;
    Shown shown;
    Out<Speed> last;
    OutQueue<Height, 2> some;
  };
  struct Params {};
  Status activate(const Tick&, const Inputs&, const Params&, const Applied<Outputs>& applied) {
    part = applied.part(applied->shown);
    mean_applied = applied.has(applied->shown.mean);
    return Status::ok;
  }
  Status step(const Tick&, const Inputs& in, const Params&, Outputs& out) {
    out.first_ratio = in.before.size();
    out.shown.fastest.speed_mps = in.sensors.speed ? in.sensors.speed->speed_mps : -1;
    out.shown.n_ratio = in.after ? in.after->height_m : -1;
    if (in.sensors.height.fresh()) out.shown.mean.publish(*in.sensors.height);
    out.last.publish({3});
    out.some.push({4}, 0);
    return Status::ok;
  }
  Applied<Shown> part;
  bool mean_applied = false;
};

template <class S, bool inputs>
std::vector<std::string> names() {
  std::vector<std::string> out;
  for (const fulmar_port& port : detail::Ports<S, inputs>::table) out.emplace_back(port.name);
  return out;
}

}  // namespace

TEST_CASE("a group's ports are ports beside all others, in their places, with their own names and kinds") {
  CHECK(names<Pair::Inputs, true>() == std::vector<std::string>{"before", "height", "speed", "after"});
  CHECK(names<Pair::Outputs, false>() ==
        std::vector<std::string>{"first_ratio", "mean", "fastest", "n_ratio", "last", "some"});
  const auto& in = detail::Ports<Pair::Inputs, true>::table;
  CHECK(in[1].kind == FULMAR_IN_VALUE);
  CHECK((in[1].flags & FULMAR_PORT_OPTIONAL) == 0);
  CHECK((in[2].flags & FULMAR_PORT_OPTIONAL) != 0);
  CHECK(std::string(in[2].type->name) == "Speed");
  const auto& out = detail::Ports<Pair::Outputs, false>::table;
  CHECK(out[1].kind == FULMAR_OUT_EVENT);
  CHECK(out[2].kind == FULMAR_OUT_VALUE);
  CHECK(out[3].kind == FULMAR_OUT_PROBE);
  CHECK(out[5].kind == FULMAR_OUT_QUEUE);
}

TEST_CASE("a struct of messages alone is one message") {
  struct Both {
    Height height;
    Speed speed;
  };
  CHECK_FALSE(detail::is_port_group<Both>());
  CHECK(detail::is_port_group<Sensors>());
  CHECK(detail::is_port_group<Shown>());
}

TEST_CASE("what is wired to a group arrives, and what is written into one leaves") {
  Bench<Pair> bench;
  bench.set(bench.in.sensors.height, Height{7});
  bench.set(bench.in.sensors.speed, Speed{5});
  bench.set(bench.in.after, Height{9});
  bench.push(bench.in.before, {1});
  CHECK(bench.step(0.01) == Status::ok);
  CHECK(bench.out.first_ratio.value == 1);
  CHECK(bench.out.shown.mean.written);
  CHECK(bench.out.shown.mean.value.height_m == 7);
  CHECK(bench.out.shown.fastest.speed_mps == 5);
  CHECK(bench.out.shown.n_ratio.value == 9);
  CHECK(bench.out.last.value.speed_mps == 3);
  bench.step(0.01);
  CHECK_FALSE(bench.out.shown.mean.written);
  bench.set(bench.in.sensors.speed, Speed{std::numeric_limits<double>::infinity()});
  bench.step(0.01);
  CHECK(bench.validation_error() == "fastest.speed_mps is inf");
}

TEST_CASE("a group is told what was applied of it, and nothing of the outputs beside") {
  Bench<Pair> bench;
  Applied<Pair::Outputs> last;
  last.outputs.shown.mean.value.height_m = 12;
  last.made_bits = 0b110011;  // first_ratio, mean, last, some
  REQUIRE(bench.activate(last) == Status::ok);
  const Applied<Shown>& part = bench.component().part;
  CHECK(bench.component().mean_applied);
  CHECK(part->mean.value.height_m == 12);
  CHECK(part.has(part->mean));
  CHECK_FALSE(part.has(part->fastest));
  CHECK(part.made_bits == 1);
  CHECK(Applied<Pair::Outputs>::all(last.outputs).made_bits == 0b111111);
}

}  // namespace port_groups_test

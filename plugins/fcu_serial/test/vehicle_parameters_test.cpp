// SPDX-License-Identifier: BSD-3-Clause
// The record of the controller's set-up: its parameters are published, each at its first report and at a
// change.
#include <bit>
#include <cstdlib>

#include "flying.hpp"

namespace vehicle_parameters_test {

using namespace fulmar;
using namespace fulmar::fcu;
using namespace fulmar::fcu::testing;

namespace {

constexpr std::size_t all = peer::param_count;

/// As a reader of the log has them.
struct Reader {
  Flying f;
  std::map<std::string, std::string> values;
  std::map<std::string, int> times;
  std::size_t messages = 0;
  explicit Reader(double loss = 0) {
    f.world.lost = [loss, n = 0](const Packet& p) mutable {
      return p.is<ParamValue>() && loss > 0 && ++n % static_cast<int>(1 / loss) == 0;
    };
  }
  void fly(double seconds) {
    for (const std::int64_t end = f.world.now_ns + static_cast<std::int64_t>(seconds * 1e9);
         f.world.now_ns < end;) {
      f.tick();
      const auto& out = f.bench.out.parameters;
      CHECK(out.lost == 0);
      for (std::uint32_t i = 0; i < out.count; ++i) {
        const std::string name(out.items[i].name.view());
        values[name] = std::string(out.items[i].value.view());
        ++times[name];
        ++messages;
      }
    }
  }
  bool as_in_the_controller() {
    auto& params = f.world.fcu.params();
    std::size_t same = 0;
    for (std::size_t i = 0; i < all; ++i) {
      const auto at = values.find(params.name(i));
      if (at == values.end()) continue;
      const char* text = at->second.c_str();
      same += params.integer(i) ? std::atoll(text) == params.i(i) : std::strtof(text, nullptr) == params.f(i);
    }
    return same == all && values.size() == all;
  }
};

}  // namespace

TEST_CASE(
    "all parameters are published within 10 s of the start, each once, bit for bit, on a lossy line too") {
  for (const double loss : {0.0, 0.1}) {
    CAPTURE(loss);
    Reader r(loss);
    r.f.world.fcu.params().set(peer::param("RC_ARM_CHN"), -1);
    r.f.world.fcu.params().set(peer::param("ACC_X_BIAS"), -0.037f);
    r.fly(loss > 0 ? 10 : 6);  // 7.7 s after its boot the controller has zeroed the airspeed
    CHECK(r.as_in_the_controller());
    if (loss == 0) CHECK(r.messages == all);
    CHECK(r.values["RC_ARM_CHN"] == "-1");
    CHECK(r.values["ACC_X_BIAS"] == "-0.037");
    CHECK(r.f.heard("fcu_serial.params_logged(333)"));
  }
}

TEST_CASE("they are asked for one by one, 100 a second at most: the line is for samples") {
  Reader r;
  r.fly(1);
  std::size_t asked = 0;
  for (std::size_t i = 0; i < r.f.world.sent.size(); ++i)
    asked += r.f.world.sent[i].is<ParamRequestRead>() && r.f.world.sent_ns[i] > 500'000'000;
  CHECK(asked <= 100);
  CHECK(asked > 30);
  CHECK(r.f.world.count<ParamRequestList>() == 0);
  r.fly(5);
  asked = r.f.world.count<ParamRequestRead>();
  r.fly(5);
  CHECK(r.f.world.count<ParamRequestRead>() == asked);
}

TEST_CASE("a change is published when it comes, the same value again is not") {
  Reader r;
  r.fly(5);
  REQUIRE(r.as_in_the_controller());
  const std::size_t before = r.messages;
  r.f.world.fcu.params().set(peer::param("X_EQ_TORQUE"), 0.25f);
  r.fly(0.1);
  CHECK(r.messages == before + 1);
  CHECK(r.values["X_EQ_TORQUE"] == "0.25");
  ParamValue same;
  same.param_count = all;
  same.param_index = static_cast<std::uint16_t>(peer::param("X_EQ_TORQUE"));
  same.param_id = field<16>("X_EQ_TORQUE");
  same.param_value = std::bit_cast<std::uint32_t>(0.25f);
  r.f.world.inject(same);
  r.fly(0.1);
  CHECK(r.messages == before + 1);
}

TEST_CASE("after a reboot they are asked for anew, and what is other than before is published and counted") {
  Reader r;
  r.fly(13);  // zeroed
  REQUIRE(r.as_in_the_controller());
  r.f.world.fcu.write_flash();
  r.f.world.fcu.params().set(peer::param("X_EQ_TORQUE"), 0.25f);
  r.fly(1);
  const std::size_t before = r.messages;
  r.f.world.fcu.reboot(r.f.world.now_ns / 1000);  // unwritten values are lost
  r.f.world.happen(LinkEvent::rebooted);
  r.fly(6);
  CHECK(r.messages == before + 1);
  CHECK(r.as_in_the_controller());
  CHECK(r.f.heard("fcu_serial.params_changed(1)"));
}

TEST_CASE("the calibration is told in figures") {
  Reader r;
  for (const auto& [name, value] : std::map<const char*, float>{{"ACC_X_BIAS", -0.037f},
                                                                {"ACC_Y_BIAS", -0.089f},
                                                                {"ACC_Z_BIAS", 0.074f},
                                                                {"GYRO_X_BIAS", 0.008f},
                                                                {"GYRO_Y_BIAS", -0.0021f},
                                                                {"GYRO_Z_BIAS", 1.f},
                                                                {"DIFF_PRESS_BIAS", -12.3f}})
    r.f.world.fcu.params().set(r.f.world.fcu.params().find(name), value);
  r.fly(6);
  CHECK(r.f.heard("fcu_serial.calibration(-0.037 -0.089 0.074, 0.0080 -0.0021 1.0000, -12.3)\n"));
}

TEST_CASE("what does not come in five rounds is given up and told") {
  Reader r;
  r.f.world.lost = [](const Packet& p) {
    return p.is<ParamValue>() && p.as<ParamValue>().param_index % 100 == 99;
  };
  r.fly(20);
  CHECK(r.f.heard("fcu_serial.params_missing(3, 333)"));
  const std::size_t asked = r.f.world.count<ParamRequestRead>();
  r.fly(5);
  CHECK(r.f.world.count<ParamRequestRead>() == asked);
}

}  // namespace vehicle_parameters_test

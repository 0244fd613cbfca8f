// SPDX-License-Identifier: BSD-3-Clause
// The vehicle with the software flight controller, in virtual time, and its messages and reports so far.
#pragma once
#include <doctest/doctest.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "fulmar/testing.hpp"
#include "plugins/fcu_serial/vehicle.hpp"
#include "virtual_link.hpp"

namespace fulmar::fcu::testing {

struct TestVehicle : Vehicle<VirtualLink> {};

/// Its airspeed has been zeroed since.
inline peer::Options up_for_20_s() {
  peer::Options options;
  options.first_clock_us = 20'000'000;
  return options;
}

/// A controller that is set up for a fixed wing, and the vehicle on it.
struct Flying {
  explicit Flying(const peer::Options& options = up_for_20_s()) : world(options) {
    world.fcu.provision();
    bench.params.airframe.value.aileron.limit_rad = 0.7;
    bench.params.airframe.value.elevator.limit_rad = 0.5;
    bench.params.airframe.value.rudder.limit_rad = 0.35;
    bench.params.airframe.is_given = true;
  }

  World world;
  Bench<TestVehicle> bench;
  Actuators command{0.4, 0.1, -0.05, 0.07};
  bool commands = true;
  std::optional<VehicleState> state;  ///< the estimate that the vehicle is given, valid now
  std::optional<Path> path;
  std::string reported;
  std::map<std::string, int> published;
  VehicleStatus status;
  Rc rc;
  std::vector<std::int64_t> ticks_ns, imu_ns;

  /// One tick of the loop, with a command at 100 Hz.
  Status tick() {
    const Status result = bench.read();
    auto& out = bench.out;
    ticks_ns.push_back(bench.tick.now_ns);
    count("gnss", out.gnss);
    count("mag", out.mag);
    count("baro", out.baro);
    count("pitot", out.pitot);
    count("attitude", out.attitude);
    count("outputs", out.outputs);
    count("link", out.link);
    count("rc", out.rc);
    count("status", out.status);
    if (out.imu.written) imu_ns.push_back(out.imu.valid_at_ns);
    if (out.status.written) status = out.status.value;
    if (out.rc.written) rc = out.rc.value;
    for (std::uint32_t i = 0; i < out.notices.count; ++i)
      reported += std::string(out.notices.items[i].text.view()) + "\n";
    if (commands && ticks_ns.size() % 4 == 1) bench.set(bench.in.actuators, command);
    if (state) bench.set(bench.in.state, *state);
    if (path) bench.set(bench.in.path, *path);
    bench.write();
    return result;
  }
  void fly(double seconds) {
    const std::int64_t end = world.now_ns + static_cast<std::int64_t>(seconds * 1e9);
    while (world.now_ns < end) tick();
  }
  /// Armed by its switch, as the pilot does it: override on, armed, override off.
  void arm() {
    fly(1.2);
    world.fcu.inputs.rc_us[4] = world.fcu.inputs.rc_us[5] = 2000;
    fly(0.2);
    world.fcu.inputs.rc_us[5] = 1000;
    fly(1.5);
    REQUIRE(status.armed);
    REQUIRE(status.in_control);
    reported.clear();
  }
  bool heard(const char* words) const { return reported.find(words) != std::string::npos; }

 private:
  template <class T>
  void count(const char* name, const Out<T>& port) {
    published[name] += port.written ? 1 : 0;
  }
};

}  // namespace fulmar::fcu::testing

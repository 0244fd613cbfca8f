// SPDX-License-Identifier: BSD-3-Clause
// ports in: actuators Actuators, arm ArmRequest
// ports out: imu Imu, gnss Gnss, mag Mag, baro Baro, pitot Pitot, rc Rc, status VehicleStatus
// A frame of a vehicle: `read` publishes the samples of the sensors, `write` sends the surface commands. As
// generated, the aircraft stands at the origin and never moves. Replace the code at the comments 1 to 4.
#pragma once
#include <algorithm>
#include <cmath>
#include <fulmar/flight/earth/atmosphere.hpp>
#include <fulmar/msg/actuators.hpp>
#include <fulmar/msg/arm_request.hpp>
#include <fulmar/msg/baro.hpp>
#include <fulmar/msg/gnss.hpp>
#include <fulmar/msg/imu.hpp>
#include <fulmar/msg/mag.hpp>
#include <fulmar/msg/origin.hpp>
#include <fulmar/msg/pitot.hpp>
#include <fulmar/msg/rc.hpp>
#include <fulmar/msg/vehicle_state.hpp>
#include <fulmar/msg/vehicle_status.hpp>
#include <fulmar/plugin.hpp>

using namespace fulmar;

struct MyLaw {  // fills the role `vehicle`
  static constexpr const char* doc = "MyLaw vehicle.";
  struct Inputs {
    Optional<Actuators> actuators;  // no command before the first phase
    Request<ArmRequest> arm;
  };
  struct Outputs {
    Imu imu;         // in each tick
    Out<Gnss> gnss;  // when there is a sample: an Out<T> may stay silent
    Out<Mag> mag;
    Out<Baro> baro;
    Out<Pitot> pitot;
    Out<Rc> rc;
    Out<VehicleStatus> status;
    Out<VehicleState> truth;  // of a simulator; remove it on hardware
  };
  struct Params {
    Record<Origin> origin{"origin of the local frame"};
    Param rate{400, "Hz", 50, 1000, "rate of the loop; the rate of the mission", setup};
  };

  /// May allocate, open devices, and throw an exception with a message.
  void configure(const Params& p) {
    period_ns_ = std::llround(1e9 / p.rate);
    now_ns_ =
        -static_cast<std::int64_t>(5 * p.rate) * period_ns_;  // stands for 5 s, in which the estimator aligns
    origin_ = p.origin.given() ? *p.origin : Origin{40.2463724, -111.6474138, 1387, true};
    tick_ = 0;
    wanted_ = armed_ = false;
  }

  Status read(Tick& tick, const Params&, Outputs& out) {
    // 1. Time in ns, strictly increasing; 0 is the first armed tick. A device waits here for its next sample,
    // at most 10 ms, and uses the time of that sample. A simulation advances by one period.
    tick.now_ns = now_ns_ += period_ns_;
    if (wanted_ && now_ns_ >= 0) armed_ = true;
    // 2. Samples since the last tick. A late sample has the time at which it was valid: publish(gnss,
    // valid_at_ns).
    out.imu.specific_force_mps2 = {0, 0, -9.80665};  // at rest and level
    out.imu.rate_radps = {0, 0, 0};
    if (tick_ % 4 == 0) publish_air(out);
    if (tick_ % 40 == 0) publish_gnss(out);
    // 3. Status that the phases of the mission read. `in_control`: commands move the aircraft, the pilot does
    // not override.
    if (tick_ % 8 == 0) {
      VehicleStatus status;
      status.armed = status.in_control = status.offboard = armed_;
      status.on_ground = true;
      out.status.publish(status);
      Rc rc;
      rc.link = true;
      out.rc.publish(rc);
    }
    ++tick_;
    return Status::ok;
  }

  Status write(const Tick& tick, const Inputs& in, const Params&) {
    for (auto request : in.arm) {  // reject with refuse("reason")
      wanted_ = request.value().armed;
      armed_ = armed_ && wanted_;
      request.accept();
    }
    // 4. Surface commands to the aircraft. Old commands are not used.
    const bool recent = in.actuators && tick.now_ns - in.actuators.valid_at_ns() < 100'000'000;
    command_ = recent ? *in.actuators : Actuators{};
    return Status::ok;
  }

 private:
  void publish_air(Outputs& out) const {
    const auto air = standard_air(origin_.alt_msl_m);
    out.mag.publish({{2.1e-5, 0, 4.6e-5}});  // nose to magnetic north
    out.baro.publish({air.pressure_pa, air.temperature_kelvin});
    out.pitot.publish({0, 0, air.temperature_kelvin});
  }
  void publish_gnss(Outputs& out) const {
    Gnss gnss;
    gnss.latitude_deg = origin_.lat_deg;
    gnss.longitude_deg = origin_.lon_deg;
    gnss.altitude_m = origin_.alt_msl_m;
    gnss.horizontal_std_m = gnss.vertical_std_m = 0.5;
    gnss.speed_std_mps = 0.1;
    gnss.fix = FixType::fix_3d;
    gnss.satellites = 12;
    out.gnss.publish(gnss);
  }

  Origin origin_;
  Actuators command_;  // in force until the next one
  std::int64_t now_ns_ = 0, period_ns_ = 2'500'000;
  std::uint64_t tick_ = 0;
  bool wanted_ = false, armed_ = false;
};

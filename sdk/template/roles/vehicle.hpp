// SPDX-License-Identifier: BSD-3-Clause
// ports in: actuators Actuators, arm ArmRequest
// ports out: imu Imu, gnss Gnss, mag Mag, baro Baro, pitot Pitot, rc Rc, status VehicleStatus
// The frame of a vehicle: `read` brings in what its sensors say, `write` hands the surfaces out. As generated
// it is an aircraft that stands at the origin and moves nothing; fill in the four places that say so.
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
    Optional<Actuators> actuators;  // nobody commands before the first phase
    Request<ArmRequest> arm;
  };
  struct Outputs {
    Imu imu;         // in each tick
    Out<Gnss> gnss;  // when there is one: an Out<T> stays silent otherwise
    Out<Mag> mag;
    Out<Baro> baro;
    Out<Pitot> pitot;
    Out<Rc> rc;
    Out<VehicleStatus> status;
    Out<VehicleState> truth;  // a simulator's; remove it where nobody knows the truth
  };
  struct Params {
    Record<Origin> origin{"origin of the local frame"};
    Param rate{400, "Hz", 50, 1000, "rate of the loop; the rate of the mission", setup};
  };

  /// May allocate, open devices, and throw a sentence.
  void configure(const Params& p) {
    period_ns_ = std::llround(1e9 / p.rate);
    now_ns_ = -static_cast<std::int64_t>(5 * p.rate) * period_ns_;  // stands for 5 s: the estimator aligns
    origin_ = p.origin.given() ? *p.origin : Origin{40.2463724, -111.6474138, 1387, true};
    tick_ = 0;
    wanted_ = armed_ = false;
  }

  Status read(Tick& tick, const Params&, Outputs& out) {
    // 1. Time, in ns, strictly increasing; 0 is the first armed tick. A device waits here for its next
    // sample, 10 ms
    //    at most, and takes its time; a simulation goes on by one period and moves its aircraft.
    tick.now_ns = now_ns_ += period_ns_;
    if (wanted_ && now_ns_ >= 0) armed_ = true;
    // 2. What was measured since the last tick. What is late says when it was true: publish(gnss,
    // valid_at_ns).
    out.imu.specific_force_mps2 = {0, 0, -9.80665};  // at rest and level
    out.imu.rate_radps = {0, 0, 0};
    if (tick_ % 4 == 0) publish_air(out);
    if (tick_ % 40 == 0) publish_gnss(out);
    // 3. What the mission's phases look at. `in_control`: commands move the aircraft, no pilot has the
    // sticks.
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
    for (auto request : in.arm) {  // refuse("why") what cannot be
      wanted_ = request.value().armed;
      armed_ = armed_ && wanted_;
      request.accept();
    }
    // 4. The surfaces go out. Commands that are old are not followed.
    const bool heard = in.actuators && tick.now_ns - in.actuators.valid_at_ns() < 100'000'000;
    command_ = heard ? *in.actuators : Actuators{};
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

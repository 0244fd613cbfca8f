// SPDX-License-Identifier: BSD-3-Clause
// The simulated vehicle: advances the plant by one period per tick and publishes its sensors.
#pragma once
#include <cmath>
#include <cstdint>
#include <optional>
#include <stdexcept>

#include "actuation.hpp"
#include "arming.hpp"
#include "changed_airframe.hpp"
#include "command_switch.hpp"
#include "contact.hpp"
#include "faults.hpp"
#include "fulmar/eigen.hpp"
#include "fulmar/flight/earth/magnetic_model.hpp"
#include "fulmar/msg/arm_request.hpp"
#include "fulmar/msg/contact_truth.hpp"
#include "fulmar/msg/fault_request.hpp"
#include "fulmar/msg/flaps.hpp"
#include "fulmar/msg/ground_state.hpp"
#include "fulmar/msg/notice.hpp"
#include "fulmar/msg/origin.hpp"
#include "fulmar/msg/rc.hpp"
#include "fulmar/msg/vehicle_state.hpp"
#include "fulmar/msg/vehicle_status.hpp"
#include "fulmar/plugin.hpp"
#include "fulmar/sim/airframe_rules.hpp"
#include "fulmar/sim/plant.hpp"
#include "launch.hpp"
#include "messages.hpp"
#include "model_params.hpp"
#include "motion.hpp"
#include "pilot.hpp"
#include "refusals.hpp"
#include "sensor_outputs.hpp"
#include "start.hpp"
#include "status_report.hpp"
#include "suite_spec.hpp"
#include "surroundings.hpp"
#include "truth.hpp"
#include "wind_params.hpp"

namespace fulmar::sim {

struct SensorParams {
  Record<SensorSuite> sensor_file{"set of sensors in a file, in place of `sensors`"};
  Flag calibrated{false, "removal of the biases that a calibration on the ground finds", setup};
};

class Aircraft {
 public:
  static constexpr const char* doc = "A fixed-wing aircraft, its sensors, the air and the ground.";
  struct Inputs {
    Optional<Actuators> actuators;
    Optional<Flaps> flaps;
    Request<ArmRequest> arm;
    Request<FaultRequest> fault;
    Optional<GroundState> ground;  // keeps the throttle closed after a landing
    Optional<Rc> pilot;            // a transmitter, in place of the parameters pilot_flies, stick_* and aux*
  };
  struct Outputs {
    Out<Imu> imu;
    Out<Gnss> gnss;
    Out<Mag> mag;
    Out<Baro> baro;
    Out<Pitot> pitot;
    Out<Rc> rc;
    Out<VehicleStatus> status;
    Out<VehicleState> truth;
    Out<ContactTruth> contact;
    Out<MotionTruth> motion;
    OutQueue<Notice, 4> notices;  // source of the commands in force
  };
  struct Params {
    Record<Airframe> airframe{"airframe of the aircraft", required};
    Record<Origin> origin{"origin of the local frame; without it Provo airport"};
    Param rate{400, "Hz", 10, 2000, "rate of the loop: one read advances time by one period", setup};
    Param settle{5, "s", 0, 3600, "time on the ground before the first armed tick", setup};
    Param epoch{1767225600, "s", 0, 4102444800, "UTC of flight time 0, since 1970; default 2026-01-01",
                setup};
    WindParams wind;
    Choice<EarthModel> earth{
        EarthModel::flat,
        "model of the Earth; flat: 9.80665 m/s2; gravity: by latitude and height; wgs84: rotating ellipsoid",
        setup};
    Choice<SensorSet> sensors{SensorSet::rosflight, "set of sensors, with its errors", setup};
    SensorParams own_sensors;
    Param truth_rate{50, "Hz", 1, 2000, "rate of the output `truth`", setup};
    Param motion_rate{10, "Hz", 1, 2000, "rate of the output `motion`; identification needs 100", setup};
    StartParams start;
    ActuationParams outputs;
    Flag motor{true, "operation of the motor; false: the motor stops"};
    SensorSwitches works;
    Flag rc_link{true, "operation of the radio link; false: no link"};
    StickParams sticks;
    FaultParams faults;
    Surroundings around;
    PilotParams pilot;
    ModelParams model;
    LaunchParams launching;
  };

  explicit Aircraft(std::uint64_t seed) : seed_(seed) {}

  /// A table that cannot be read is reported with its place in the record.
  static void check_tables(const Airframe& a) {
    for (std::size_t i = 0; i < a.aero.tables.size(); ++i)
      if (const std::string fault = table_fault(a.aero.tables[i]); !fault.empty())
        throw std::runtime_error("airframe.aero.tables[" + std::to_string(i) + "]." + fault);
  }

  Earth earth(const Params& p) const {
    constexpr double degree = std::numbers::pi / 180;
    const GroundParams& g = p.around.ground;
    if (p.earth == EarthModel::wgs84 && g.ground_slope > 0)
      throw std::runtime_error(located("ground_slope", sim_aero_messages::ground_slope_unsupported()).line());
    return {p.earth,
            degree * origin_.lat_deg,
            degree * origin_.lon_deg,
            {g.ground_slope, g.ground_slope_towards, g.ground_friction, g.ground_effect}};
  }

  void configure(const Params& p) {
    origin_ = p.origin.given() ? *p.origin : Origin{40.2463724, -111.6474138, 1387, true};
    const Airframe& airframe = *p.airframe;
    if (const std::string missing = missing_part(airframe); !missing.empty())
      throw std::runtime_error(missing);
    if (const AirframeFault fault = airframe_fault(airframe))
      throw std::runtime_error("airframe." + fault.field + ": " + fault.sentence);
    check_tables(airframe);
    airframe_ = ChangedAirframe(airframe);
    period_ns_ = std::llround(1e9 / p.rate);
    now_ns_ = -std::llround(p.settle * 1e9 / static_cast<double>(period_ns_)) * period_ns_;
    arming_ = {};
    command_ = {};
    pilot_ = {};
    launch_ = Launch(p.launching);
    actuation_ = Actuation(spec_of(p.outputs), airframe, now_ns_);
    plant_.emplace(airframe, weather(p.wind, p.around.air), origin_.alt_msl_m, mix_seed(seed_, 10), earth(p));
    place(*plant_, airframe, origin_.alt_msl_m, p.start, p.launching, now_ns_);
    faults_ = {};
    faults_.set(p.faults, now_ns_);
    if (airframe_.add(p.model)) plant_->set_aerodynamics(airframe_.now(p.faults.body_that_fails));
    switch_on_sensors(p);
    const std::int64_t first_ns = now_ns_ + period_ns_;
    rc_due_ = Due(50, first_ns);
    status_ = StatusReport(first_ns);
    truth_due_ = Due(p.truth_rate, first_ns);
    motion_due_ = Due(p.motion_rate, first_ns);
    contact_ = {};
    gusts_ = {};
    gusts_.set(p.around.air, now_ns_);
  }

  void retune(const Params& p) {
    plant_->set_wind(steady_wind(p.wind));
    faults_.set(p.faults, now_ns_);
    gusts_.set(p.around.air, now_ns_);
    if (airframe_.add(p.model)) plant_->set_aerodynamics(airframe_.now(p.faults.body_that_fails));
  }

  Status read(Tick& tick, const Params& p, Outputs& out) {
    now_ns_ += period_ns_;
    tick.now_ns = now_ns_;
    const double dt = 1e-9 * static_cast<double>(period_ns_);
    suffer(p, dt);
    if (gusts_.due(now_ns_ - period_ns_)) plant_->fire(gust_spec(p.around.air));
    const Actuators& applied = actuation_.at(now_ns_ - period_ns_);
    const double armed_s = arming_.age_s(now_ns_);
    if (arming_.released() && launch_.holds(armed_s))
      plant_->push(launch_.push_mps2(armed_s), dt);
    else if (arming_.released())
      plant_->advance(applied, arming_.armed() && p.motor ? faults_.power(now_ns_) : 0, dt);
    else
      plant_->carry(dt);
    if (plant_->departure() != Departure::none) [[unlikely]]
      throw std::runtime_error(departure_words(*plant_));
    arming_.advance(!pilot_.wired() || pilot_.link(), now_ns_);
    sensors_->publish(p.works, *plant_, now_ns_, out);
    publish_rc_and_status(p, out);
    if (truth_due_(now_ns_)) out.truth.publish(truth_of(*plant_, sensors_->sensors(), origin_));
    if (motion_due_(now_ns_)) out.motion.publish(motion_truth(*plant_));
    contact_.publish(*plant_, held(), now_ns_, out.contact);
    return plant_->crashed() ? Status::degraded : Status::ok;
  }

  Status write(const Tick& tick, const Inputs& in, const Params& p) {
    for (auto request : in.arm) answer(request);
    for (auto request : in.fault) faults_.answer(request, tick.now_ns);
    const std::optional<Actuators> computer = heard_command(in.actuators, in.ground, tick.now_ns);
    pilot_.hear(in.pilot, carries(p), tick.now_ns);
    obey_arm_switch(p);
    const CommandSwitch::Pilot pilot{pilot_flies(p), pilot_.wired(), pilot_.link(),
                                     by_hand(pilot_rc(p), airframe_.file())};
    actuation_.put(command_.choose(computer, pilot, arming_.armed(), arming_.released()), tick.now_ns);
    plant_->set_flap(flap_command(in));
    return Status::ok;
  }

  const Plant& plant() const { return *plant_; }
  double ice() const { return airframe_.ice(); }  ///< share of the full ice that the parameters describe

 private:
  /// Flaps keep their last command: a flap command is sent only for a change.
  static double flap_command(const Inputs& in) {
    return in.flaps && std::isfinite(in.flaps->flap_rad) ? in.flaps->flap_rad : 0;
  }

  bool held() const {
    return launch_.given() && (!arming_.released() || launch_.holds(arming_.age_s(now_ns_)));
  }

  /// True when the radio works, according to parameters and faults.
  bool carries(const Params& p) const {
    return p.rc_link && faults_[FaultTarget::radio].kind != FaultKind::off;
  }
  bool pilot_flies(const Params& p) const {
    return pilot_.wired() ? pilot_.overrides(p.pilot) : p.sticks.pilot_flies.value;
  }
  Rc pilot_rc(const Params& p) const { return pilot_.wired() ? pilot_.rc() : rc_of(p.sticks); }

  void obey_arm_switch(const Params& p) {
    const PilotRadio::Arming asked = pilot_.arming(p.pilot);
    if (asked == PilotRadio::Arming::stays || plant_->crashed()) return;
    arming_.ask(asked == PilotRadio::Arming::arm);
  }

  void answer(const Request<ArmRequest>::One& request) {
    if (request.value().armed && plant_->crashed())
      return request.refuse(sim_aero_messages::aircraft_crashed.c_str());
    arming_.ask(request.value().armed);
    request.accept();
  }

  /// Applies the faults in force to the parts that they concern.
  void suffer(const Params& p, double dt) {
    const bool other = faults_.advance(now_ns_);
    if (other) {
      sensors_->suffer(faults_);
      plant_->suffer(faults_[FaultTarget::aileron], faults_[FaultTarget::elevator],
                     faults_[FaultTarget::rudder]);
    }
    if (airframe_.freeze(faults_[FaultTarget::icing].rate, dt) || (other && airframe_.ice() > 0))
      plant_->set_aerodynamics(airframe_.now(p.faults.body_that_fails));
  }

  static SensorSpec sensors_of(const Params& p) {
    const Record<SensorSuite>& file = p.own_sensors.sensor_file;
    SensorSpec spec = file.given() ? spec_of(*file, p.rate) : with_timing(sensor_spec(p.sensors));
    spec.calibrated = spec.calibrated || p.own_sensors.calibrated;
    return spec;
  }

  void switch_on_sensors(const Params& p) {
    const SensorClock clock{std::llround(p.epoch) * 1000000000, now_ns_, period_ns_};
    const LocalFrame frame(origin_.lat_deg, origin_.lon_deg, origin_.alt_msl_m);
    const Eigen::Vector3d field_n =
        magnetic_field_ned(origin_.lat_deg, origin_.lon_deg, origin_.alt_msl_m, decimal_year(clock.epoch_ns));
    sensors_.emplace(sensors_of(p), p.rate, clock, frame, field_n, seed_);
  }

  void publish_rc_and_status(const Params& p, Outputs& out) {
    const bool flies = pilot_flies(p);
    if (rc_due_(now_ns_) && carries(p) && (!pilot_.wired() || pilot_.link())) out.rc.publish(pilot_rc(p));
    VehicleStatus s;
    s.armed = arming_.armed();
    s.override = flies;
    s.failsafe = command_.failsafe();
    s.on_ground = !s.armed;  // as published by a controller without a contact switch
    s.crashed = plant_->crashed();
    s.in_control = s.armed && !flies && !command_.silent() && !s.failsafe && !s.crashed;
    s.health = s.crashed ? Health::failed : Health::ok;
    if (!status_.due(s, now_ns_)) return;
    s.battery_volt = faults_.voltage(now_ns_) * plant_->battery_volt();
    s.battery_amp = plant_->battery_amp();
    status_.publish(s, now_ns_, out.status, out.notices);
  }

  std::uint64_t seed_;
  Origin origin_;
  std::int64_t now_ns_ = 0, period_ns_ = 2500000;
  ChangedAirframe airframe_;
  std::optional<Plant> plant_;
  std::optional<SensorOutputs> sensors_;
  Faults faults_;
  GustClock gusts_;
  PilotRadio pilot_;
  Arming arming_;
  Launch launch_;
  CommandSwitch command_;
  Actuation actuation_;
  StatusReport status_;
  ContactReport contact_;
  Due rc_due_, truth_due_, motion_due_;
};

}  // namespace fulmar::sim

// SPDX-License-Identifier: BSD-3-Clause
// The simulated vehicle: advances the plant by one period per tick and lets its sensors speak.
#pragma once
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "actuation.hpp"
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
#include "icing.hpp"
#include "launch.hpp"
#include "model_params.hpp"
#include "motion.hpp"
#include "pilot.hpp"
#include "refusals.hpp"
#include "sensors.hpp"
#include "suite_spec.hpp"
#include "surroundings.hpp"

namespace fulmar::sim {

struct SensorParams {
  Record<SensorSuite> sensor_file{"a set of sensors in a file, in place of `sensors`"};
  Flag calibrated{false, "biases that a calibration on the ground takes off are off", setup};
};

class Aircraft {
 public:
  static constexpr const char* doc = "A fixed-wing aircraft, its sensors, the air and the ground.";
  static constexpr double turn = 2 * std::numbers::pi;  ///< rad
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
    OutQueue<Notice, 4> notices;  // who flies
  };
  struct Params {
    Record<Airframe> airframe{"the aircraft", required};
    Record<Origin> origin{"of the local frame; Provo airport when not given"};
    Param rate{400, "Hz", 10, 2000, "of the loop: one read advances time by one period", setup};
    Param settle{5, "s", 0, 3600, "standing still before the first armed tick", setup};
    Param epoch{1767225600, "s", 0, 4102444800, "UTC of flight time 0, since 1970; 2026-01-01", setup};
    Vector<Ned> wind_ned{{0, 0, 0}, "m/s", -50, 50, "steady velocity of the air"};
    Param wind_speed{-1, "m/s", -1, 50, "steady and level, in place of wind_ned; below 0: wind_ned counts"};
    Param wind_from{0, "rad", -turn, turn, "where wind_speed comes from: from north, clockwise"};
    Choice<WindProfile> wind_profile{WindProfile::constant, "how the steady wind grows with height", setup};
    Param wind_reference{10,   "m", 0.1, 300, "height at which wind_ned and wind_speed hold, with a profile",
                         setup};
    Param wind_exponent{1.0 / 7, "", 0, 1, "of the power profile", setup};
    Param wind_roughness{0.03, "m", 1e-4, 5, "of the log profile: 0.03 grass, 0.6 trees and houses", setup};
    Choice<Turbulence> turbulence{Turbulence::none, "Dryden model at 50 m", setup};
    Param temperature_offset{0, "K", -60, 60, "of the air, at every altitude; 0: standard", setup};
    Param pressure_offset{0, "Pa", -10000, 10000, "of the air at mean sea level; 0: standard", setup};
    Choice<EarthModel> earth{EarthModel::flat,
                             "flat: 9.80665 m/s2; gravity: by latitude and height; wgs84: turning ellipsoid",
                             setup};
    Choice<SensorSet> sensors{SensorSet::rosflight, "errors of the sensors", setup};
    SensorParams own_sensors;
    Param truth_rate{50, "Hz", 1, 2000, "of the truth", setup};
    Param motion_rate{
        10, "Hz", 1, 2000, "of the deflections and angular accelerations; identification needs 100", setup};
    Param start_north{0, "m", -1e5, 1e5, "position at flight time 0", setup};
    Param start_east{0, "m", -1e5, 1e5, "position at flight time 0", setup};
    Param start_height{0, "m", 0, 5000, "0: on the ground; more: in trimmed level flight", setup};
    Param start_heading{0, "rad", -turn, turn, "from north, clockwise", setup};
    Param start_airspeed{0, "m/s", 0, 100, "of a start in the air; 0: the airframe's cruise", setup};
    Param mux_rate{
        0,
        "Hz",
        0,
        2000,
        "commands move the outputs at frames of the radio only; 111 on ROSflight hardware; 0: at once",
        setup};
    Param pwm_resolution{0, "s", 0, 1e-4, "of the servos' pulses of 1 to 2 ms; 0: none", setup};
    Param link_latency{0, "s", 0, 0.1, "of commands on their way to the outputs", setup};
    Flag motor{true, "false: the motor stops"};
    Flag imu_works{true, "false: silent"};
    Flag gnss_works{true, "false: silent"};
    Flag mag_works{true, "false: silent"};
    Flag baro_works{true, "false: silent"};
    Flag pitot_works{true, "false: silent"};
    Flag rc_link{true, "false: no radio link"};
    Flag pilot_flies{false, "the pilot overrides: the sticks below move surfaces and motor"};
    Param stick_roll{0, "", -1, 1, "of the pilot; right is positive"};
    Param stick_pitch{0, "", -1, 1, "of the pilot; nose up is positive"};
    Param stick_yaw{0, "", -1, 1, "of the pilot; nose right is positive"};
    Param stick_throttle{0, "", 0, 1, "of the pilot"};
    Param aux1{0, "", -1, 1, "switch of the pilot"};
    Param aux2{0, "", -1, 1, "switch of the pilot"};
    Param aux3{0, "", -1, 1, "switch of the pilot"};
    Param aux4{0, "", -1, 1, "switch of the pilot"};
    FaultParams faults;
    Surroundings around;
    PilotParams pilot;
    ModelParams model;
    LaunchParams launching;
  };

  explicit Aircraft(std::uint64_t seed) : seed_(seed) {}

  /// A table that cannot be read is told with its place in the record.
  static void check_tables(const Airframe& a) {
    for (std::size_t i = 0; i < a.aero.tables.size(); ++i)
      if (const std::string fault = table_fault(a.aero.tables[i]); !fault.empty())
        throw std::runtime_error("airframe.aero.tables[" + std::to_string(i) + "]." + fault);
  }

  /// Velocity of the air, NED, m/s: a wind from the west blows to the east.
  static Eigen::Vector3d steady_wind(const Params& p) {
    if (p.wind_speed < 0) return eigen(p.wind_ned.value);
    return -p.wind_speed * Eigen::Vector3d(std::cos(p.wind_from), std::sin(p.wind_from), 0);
  }

  static Weather weather(const Params& p) {
    if (p.wind_profile == WindProfile::log && p.wind_reference <= p.wind_roughness)
      throw std::runtime_error("wind_reference: the log profile has no wind as low as wind_roughness");
    return {steady_wind(p),
            p.turbulence,
            {p.wind_profile, p.wind_reference, p.wind_exponent, p.wind_roughness},
            {p.temperature_offset, p.pressure_offset},
            p.around.air.turbulence_height,
            p.around.air.turbulence_wind,
            *p.around.air.thermals};
  }

  Earth earth(const Params& p) const {
    constexpr double degree = std::numbers::pi / 180;
    const GroundParams& g = p.around.ground;
    if (p.earth == EarthModel::wgs84 && g.ground_slope > 0)
      throw std::runtime_error(
          "ground_slope: the ground of earth: wgs84 follows the ellipsoid; use flat or "
          "gravity");
    return {p.earth,
            degree * origin_.lat_deg,
            degree * origin_.lon_deg,
            {g.ground_slope, g.ground_slope_towards, g.ground_friction, g.ground_effect}};
  }

  void configure(const Params& p) {
    origin_ = p.origin.given() ? *p.origin : Origin{40.2463724, -111.6474138, 1387, true};
    airframe_ = *p.airframe;
    if (const std::string missing = missing_part(airframe_); !missing.empty())
      throw std::runtime_error(missing);
    if (const AirframeFault fault = airframe_fault(airframe_))
      throw std::runtime_error("airframe." + fault.field + ": " + fault.sentence);
    check_tables(airframe_);
    changed_ = airframe_;
    period_ns_ = std::llround(1e9 / p.rate);
    now_ns_ = -std::llround(p.settle * 1e9 / static_cast<double>(period_ns_)) * period_ns_;
    epoch_ns_ = std::llround(p.epoch) * 1000000000;
    armed_ = wants_armed_ = released_ = failsafe_ = false;
    command_ = {};
    pilot_ = {};
    launch_ = Launch(p.launching);
    actuation_ = Actuation({p.mux_rate, p.pwm_resolution, p.link_latency}, airframe_, now_ns_);
    status_ = {};
    plant_.emplace(airframe_, weather(p), origin_.alt_msl_m, mix_seed(seed_, 10), earth(p));
    place(p);
    if (add_to(airframe_, p.model, changed_)) plant_->set_aerodynamics(changed_);
    const LocalFrame frame(origin_.lat_deg, origin_.lon_deg, origin_.alt_msl_m);
    const Eigen::Vector3d field_n =
        magnetic_field_ned(origin_.lat_deg, origin_.lon_deg, origin_.alt_msl_m, decimal_year(epoch_ns_));
    const SensorSpec spec = sensors_of(p);
    sensors_.emplace(spec, p.rate, frame, field_n, seed_);
    power_on_ns_ = now_ns_;
    const std::int64_t first_ns = now_ns_ + period_ns_;
    imu_line_ = {spec.imu_timing, p.rate, first_ns, "imu", mix_seed(seed_, 40)};
    gnss_line_ = {spec.gnss_timing, p.rate, first_ns, "gnss", mix_seed(seed_, 41)};
    mag_line_ = {spec.mag_timing, p.rate, first_ns, "mag", mix_seed(seed_, 42)};
    baro_line_ = {spec.baro_timing, p.rate, first_ns, "baro", mix_seed(seed_, 43)};
    pitot_line_ = {spec.pitot_timing, p.rate, first_ns, "pitot", mix_seed(seed_, 44)};
    rc_due_ = Due(50, first_ns);
    status_rate_ = Due(10, first_ns);
    truth_due_ = Due(p.truth_rate, first_ns);
    motion_due_ = Due(p.motion_rate, first_ns);
    faults_ = {};
    faults_.set(p.faults, now_ns_);
    icing_ = {};
    contact_ = {};
    gusts_ = {};
    gusts_.set(p.around.air, now_ns_);
  }

  void retune(const Params& p) {
    plant_->set_wind(steady_wind(p));
    faults_.set(p.faults, now_ns_);
    gusts_.set(p.around.air, now_ns_);
    if (add_to(airframe_, p.model, changed_))
      plant_->set_aerodynamics(iced(changed_, icing_.ice(), p.faults.body_that_fails));
  }

  Status read(Tick& tick, const Params& p, Outputs& out) {
    now_ns_ += period_ns_;
    tick.now_ns = now_ns_;
    const double dt = 1e-9 * static_cast<double>(period_ns_);
    suffer(p, dt);
    if (gusts_.due(now_ns_ - period_ns_)) plant_->fire(gust_spec(p.around.air));
    const Actuators& applied = actuation_.at(now_ns_ - period_ns_);
    if (released_ && launch_.holds(armed_for_s()))
      plant_->push(launch_.push_mps2(armed_for_s()), dt);
    else if (released_)
      plant_->advance(applied, armed_ && p.motor ? faults_.power(now_ns_) : 0, dt);
    else
      plant_->carry(dt);
    if (plant_->departure() != Departure::none) [[unlikely]]
      throw std::runtime_error(departure_words(*plant_));
    const bool may_arm = !pilot_.wired() || pilot_.link();
    if (wants_armed_ && !armed_ && may_arm && now_ns_ >= 0) {
      if (!released_) armed_at_ns_ = now_ns_;
      armed_ = released_ = true;
    }
    publish_sensors(p, out);
    publish_rc_and_status(p, out);
    if (truth_due_(now_ns_)) out.truth.publish(truth());
    if (motion_due_(now_ns_)) out.motion.publish(motion_truth(*plant_));
    contact_.publish(*plant_, held(), now_ns_, out.contact);
    return plant_->crashed() ? Status::degraded : Status::ok;
  }

  Status write(const Tick& tick, const Inputs& in, const Params& p) {
    for (auto request : in.arm) answer(request);
    for (auto request : in.fault) faults_.answer(request, tick.now_ns);
    const bool heard =
        in.actuators && tick.now_ns - in.actuators.valid_at_ns() <= patience_ns && sound(*in.actuators);
    pilot_.hear(in.pilot, carries(p), tick.now_ns);
    obey_arm_switch(p);
    const bool flies = pilot_flies(p), lost = pilot_.wired() && !pilot_.link();
    silent_ = !heard && pilot_.link();  // of the computer: the firmware then gives the sticks the aircraft
    failsafe_ = armed_ && (lost || (!heard && !flies && !silent_));
    if (lost && released_)
      command_ = {};  // the firmware's failsafe: whatever the computer says
    else if (flies || silent_)
      command_ = by_hand(pilot_rc(p));
    else if (heard)
      command_ = with_lock(*in.actuators, in.ground);
    else if (released_)
      command_ = {};  // motor off, surfaces neutral
    actuation_.put(command_, tick.now_ns);
    plant_->set_flap(flap_command(in));
    return Status::ok;
  }

  const Plant& plant() const { return *plant_; }
  double ice() const { return icing_.ice(); }  ///< share of all the ice that the parameters describe

 private:
  static constexpr std::int64_t patience_ns =
      100000000;  ///< commands older than this are silence, as on ROSflight

  static Actuators with_lock(Actuators a, const Optional<GroundState>& ground) {
    if (ground && ground->throttle_locked) a.throttle_frac = 0;
    return a;
  }
  static bool sound(const Actuators& a) {
    return std::isfinite(a.throttle_frac) && std::isfinite(a.aileron_rad) && std::isfinite(a.elevator_rad) &&
           std::isfinite(a.rudder_rad);
  }

  /// Flaps stay where they were told to go: who sets them speaks when he wants another place.
  static double flap_command(const Inputs& in) {
    return in.flaps && std::isfinite(in.flaps->flap_rad) ? in.flaps->flap_rad : 0;
  }

  void place(const Params& p) {
    const bool in_air = p.start_height > 0, own = in_air && p.start_airspeed > 0;
    const double Va = own ? p.start_airspeed : airframe_.limits.airspeed_cruise_mps;
    const SteadyFlight flight =
        steady_flight(AircraftModel(airframe_, origin_.alt_msl_m + p.start_height), {Va});
    if (in_air && launch_.given())
      throw std::runtime_error("launch: it begins in the air, by start_height; give one of them");
    if (!in_air && flight.found()) {
      plant_->stand(p.start_north, p.start_east, p.start_heading);
      if (launch_.given()) lift(p.launching.launch_pitch);
      return;
    }
    if (!in_air || !plant_->fly({p.start_north, p.start_east, -p.start_height}, p.start_heading, Va))
      throw std::runtime_error(
          trim_words(airframe_, flight, own ? "start_airspeed" : "airframe.limits.airspeed_cruise"));
    if (plant_->height_above_ground() < airframe_.gear.height_m)
      throw std::runtime_error(
          "start_height: the ground is higher at this place; ground_slope says how high");
    plant_->shift(1e-9 * static_cast<double>(now_ns_));
  }

  /// From where it stands into the hand, or onto the catapult.
  void lift(double pitch_rad) {
    RigidBody x = plant_->state();
    x.p_n.z() -= launch_.height_m();
    x.q_nb = x.q_nb * Eigen::AngleAxisd(pitch_rad, Eigen::Vector3d::UnitY());
    plant_->set_state(x);
  }
  double armed_for_s() const { return 1e-9 * static_cast<double>(now_ns_ - armed_at_ns_); }
  bool held() const { return launch_.given() && (!released_ || launch_.holds(armed_for_s())); }

  /// Whether the radio works, as far as parameters and faults go.
  bool carries(const Params& p) const {
    return p.rc_link && faults_[FaultTarget::radio].kind != FaultKind::off;
  }
  bool pilot_flies(const Params& p) const {
    return pilot_.wired() ? pilot_.overrides(p.pilot) : p.pilot_flies.value;
  }
  Rc pilot_rc(const Params& p) const {
    if (pilot_.wired()) return pilot_.rc();
    return {p.stick_roll, p.stick_pitch, p.stick_yaw, p.stick_throttle, p.aux1, p.aux2, p.aux3, p.aux4, true};
  }
  Actuators by_hand(const Rc& rc) const {
    return {rc.throttle_frac, rc.roll_frac * airframe_.aileron.limit_rad,
            -rc.pitch_frac * airframe_.elevator.limit_rad, -rc.yaw_frac * airframe_.rudder.limit_rad};
  }

  void obey_arm_switch(const Params& p) {
    const PilotRadio::Arming asked = pilot_.arming(p.pilot);
    if (asked == PilotRadio::Arming::stays || plant_->crashed()) return;
    wants_armed_ = asked == PilotRadio::Arming::arm;
    if (!wants_armed_) armed_ = false;
  }

  void answer(const Request<ArmRequest>::One& request) {
    if (request.value().armed && plant_->crashed()) return request.refuse("the aircraft has crashed");
    wants_armed_ = request.value().armed;
    if (!wants_armed_) armed_ = false;
    request.accept();
  }

  /// The faults that are in force now reach what they concern. Nothing to do as long as there is none.
  void suffer(const Params& p, double dt) {
    const bool other = faults_.advance(now_ns_);
    if (other) {
      sensors_->suffer(faults_);
      plant_->suffer(faults_[FaultTarget::aileron], faults_[FaultTarget::elevator],
                     faults_[FaultTarget::rudder]);
    }
    if (icing_.advance(faults_[FaultTarget::icing].rate, dt) || (other && icing_.ice() > 0))
      plant_->set_aerodynamics(iced(changed_, icing_.ice(), p.faults.body_that_fails));
  }

  static SensorSpec sensors_of(const Params& p) {
    const Record<SensorSuite>& file = p.own_sensors.sensor_file;
    SensorSpec spec = file.given() ? spec_of(*file, p.rate) : with_timing(sensor_spec(p.sensors));
    spec.calibrated = spec.calibrated || p.own_sensors.calibrated;
    return spec;
  }

  /// `works` is asked when a sample is taken.
  template <class T, class Measure>
  void publish_sensor(SensorLine<T>& line, bool works, const Channel& fault, Out<T>& port, Measure measure) {
    if (line.due(now_ns_)) {
      const T sample = measure();
      line.take(sample, now_ns_, works && !fault.off(), port);
    }
    line.deliver(now_ns_, true, port);
  }

  void publish_sensors(const Params& p, Outputs& out) {
    Sensors& s = *sensors_;
    const SensorFaults& faults = s.faults();
    if (imu_line_.due(now_ns_)) {
      const Imu imu = s.imu(*plant_);
      imu_line_.take(imu, now_ns_, p.imu_works && !faults.imu_off(), out.imu);
    }
    imu_line_.deliver(now_ns_, true, out.imu);
    publish_sensor(mag_line_, p.mag_works, faults.mag, out.mag, [&] { return s.mag(*plant_); });
    publish_sensor(baro_line_, p.baro_works, faults.baro, out.baro, [&] { return s.baro(*plant_); });
    publish_sensor(pitot_line_, p.pitot_works, faults.pitot, out.pitot, [&] { return s.pitot(*plant_); });
    if (gnss_line_.due(now_ns_)) {  // what is under way when the receiver is switched off is lost
      const Gnss gnss = s.gnss(*plant_, epoch_ns_ + now_ns_, now_ns_ - power_on_ns_);
      gnss_line_.take(gnss, now_ns_, p.gnss_works || gnss_line_.delayed(), out.gnss);
    }
    gnss_line_.deliver(now_ns_, p.gnss_works, out.gnss);
  }

  void publish_rc_and_status(const Params& p, Outputs& out) {
    const bool flies = pilot_flies(p);
    if (rc_due_(now_ns_) && carries(p) && (!pilot_.wired() || pilot_.link())) out.rc.publish(pilot_rc(p));
    VehicleStatus s;
    s.armed = armed_;
    s.override = flies;
    s.failsafe = failsafe_;
    s.on_ground = !armed_;  // as a controller without a contact switch publishes it
    s.crashed = plant_->crashed();
    s.in_control = armed_ && !flies && !silent_ && !failsafe_ && !s.crashed;
    s.health = s.crashed ? Health::failed : Health::ok;
    const bool changed = s.armed != status_.armed || s.override != status_.override ||
                         s.failsafe != status_.failsafe || s.on_ground != status_.on_ground ||
                         s.crashed != status_.crashed;
    if (!status_rate_(now_ns_) && !changed) return;
    s.battery_volt = faults_.voltage(now_ns_) * plant_->battery_volt();
    s.battery_amp = plant_->battery_amp();
    report_pilot(s, out);
    status_ = s;
    out.status.publish(s);
  }

  /// The texts that fcu_serial has for a flight controller.
  void report_pilot(const VehicleStatus& s, Outputs& out) const {
    if (!s.armed || !status_.armed || s.override == status_.override) return;
    Notice notice;
    notice.text = s.override ? "the pilot flies" : "the pilot hands over";
    out.notices.push(notice, now_ns_);
  }

  VehicleState truth() const;

  std::uint64_t seed_;
  Origin origin_;
  Airframe airframe_, changed_;  ///< as the file has it; with what the parameters add
  std::optional<Plant> plant_;
  std::optional<Sensors> sensors_;
  std::int64_t now_ns_ = 0, period_ns_ = 2500000, epoch_ns_ = 0, power_on_ns_ = 0;
  SensorLine<Imu> imu_line_;
  SensorLine<Gnss> gnss_line_;
  SensorLine<Mag> mag_line_;
  SensorLine<Baro> baro_line_;
  SensorLine<Pitot> pitot_line_;
  Due rc_due_, status_rate_, truth_due_, motion_due_;
  Actuators command_;
  Actuation actuation_;
  VehicleStatus status_;
  Faults faults_;
  PilotRadio pilot_;
  Icing icing_;
  ContactReport contact_;
  GustClock gusts_;
  bool armed_ = false, wants_armed_ = false;
  Launch launch_;
  std::int64_t armed_at_ns_ = 0;  ///< for the first time
  bool released_ = false;         ///< has been armed once: from then on it is free to move
  bool failsafe_ = false, silent_ = false;
};

inline VehicleState Aircraft::truth() const {
  const RigidBody& x = plant_->seen();
  const AirData air(plant_->air_velocity_b());
  const Eigen::Matrix3d R = x.q_nb.toRotationMatrix();
  VehicleState s;
  s.position_m = from_eigen<Ned>(plant_->state().p_n);
  s.velocity_mps = from_eigen<Ned>(x.v_n);
  s.attitude = from_eigen(x.q_nb);
  s.roll_rad = std::atan2(R(2, 1), R(2, 2));
  s.pitch_rad = std::asin(std::clamp(-R(2, 0), -1.0, 1.0));
  s.yaw_rad = std::atan2(R(1, 0), R(0, 0));
  s.rate_radps = from_eigen<Body>(x.omega_b);
  s.specific_force_mps2 = from_eigen<Body>(plant_->specific_force());
  s.height_m = -x.p_n.z();
  s.climb_rate_mps = -x.v_n.z();
  s.ground_speed_mps = std::hypot(x.v_n.x(), x.v_n.y());
  s.course_rad = s.ground_speed_mps > 0.1 ? std::atan2(x.v_n.y(), x.v_n.x()) : s.yaw_rad;
  s.airspeed_mps = air.Va;
  if (air.Va > 0.5) {  // the angles of hardly any wind mean nothing
    s.alpha_rad = air.alpha;
    s.beta_rad = air.beta;
  }
  s.wind_mps = from_eigen<Ned>(plant_->wind_n());
  s.gyro_bias_radps = from_eigen<Body>(sensors_->gyro_bias());
  s.accel_bias_mps2 = from_eigen<Body>(sensors_->accel_bias());
  s.position_std_m = s.velocity_std_mps = s.attitude_std_rad = s.wind_std_mps = {};
  s.airspeed_std_mps = 0;
  s.origin_latitude_deg = origin_.lat_deg;
  s.origin_longitude_deg = origin_.lon_deg;
  s.origin_altitude_m = origin_.alt_msl_m;
  s.origin_valid = s.attitude_valid = s.velocity_valid = s.position_valid = s.height_valid =
      s.airspeed_valid = s.wind_valid = true;
  return s;
}

}  // namespace fulmar::sim

// SPDX-License-Identifier: BSD-3-Clause
// An outer law as it was written for revision 0f1b247: every kind of parameter that a law may want, a
// request, a probe, and a hand-over that takes the outputs alone.
#include <algorithm>
#include <cmath>
#include <fulmar/msg/attitude_command.hpp>
#include <fulmar/msg/guidance_command.hpp>
#include <fulmar/msg/vehicle_state.hpp>
#include <fulmar/plugin.hpp>
#include <stdexcept>

using namespace fulmar;

/// Asks for an integral to begin anew.
struct Restart {
  double throttle_frac = 0;
};

enum class Height : std::uint8_t { hold, ignore };

struct Trim {
  double throttle_frac = 0.4;
  double pitch_rad = 0.02;
};

struct CppLaw {  // fills the role `outer`
  static constexpr const char* doc = "Proportional course and height hold, airspeed with an integral.";
  struct Inputs {
    In<VehicleState> state;
    In<GuidanceCommand> command;
    Request<Restart> restart;
  };
  struct Outputs {
    AttitudeCommand attitude;
    Probe throttle_integral_frac;
  };
  struct Params {
    Param course_kp{1.2, "rad/rad", 0, 5, "roll per course error"};
    Param height_kp{0.03, "rad/m", 0, 1, "pitch per height error"};
    Param airspeed_kp{0.1, "s/m", 0, 1, "throttle per airspeed error"};
    Param airspeed_ki{0.05, "1/m", 0, 1, "throttle per integrated airspeed error"};
    Param roll_max{0.785, "rad", 0, 1.2, "limit, either way"};
    Flag feedforward{true, "adds the bank that guidance asks for"};
    Choice<Height> height{Height::hold, "whether height is held"};
    Count unused{3, 0, 10, "nothing", setup};
    Record<Trim> trim{"of level flight"};
  };

  void configure(const Params& p) {
    if (p.unused == 7) throw std::runtime_error("seven is unlucky");
  }
  Status activate(const Tick&, const Inputs& in, const Params& p, const Outputs& last) {
    const double Va_error = in.command->airspeed_mps - in.state->airspeed_mps;
    const double trim = p.trim->throttle_frac + p.airspeed_kp * Va_error;
    integral_ = std::clamp<double>(last.attitude.throttle_frac - trim, -0.5, 0.5);
    return Status::ok;
  }
  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
    for (auto request : in.restart) {
      if (std::abs(request.value().throttle_frac) > 0.5) {
        request.refuse("an integral is at most 0.5");
      } else {
        integral_ = request.value().throttle_frac;
        request.accept();
      }
    }
    const VehicleState& x = *in.state;
    const GuidanceCommand& c = *in.command;
    const double chi_error = std::remainder(c.course_rad - x.course_rad, 2 * 3.14159265358979323846);
    const double Va_error = c.airspeed_mps - x.airspeed_mps, h_error = c.height_m - x.height_m;
    const double roll = p.course_kp * chi_error + (p.feedforward ? c.roll_feedforward_rad : 0.0);
    const double climb = p.height == Height::hold ? p.height_kp * h_error : 0.0;
    integral_ = std::clamp<double>(integral_ + p.airspeed_ki * Va_error * tick.dt_s(), -0.5, 0.5);
    out.attitude.roll_rad = std::clamp<double>(roll, -p.roll_max, p.roll_max);
    out.attitude.pitch_rad = std::clamp(p.trim->pitch_rad + climb, -0.25, 0.25);
    out.attitude.throttle_frac =
        std::clamp(p.trim->throttle_frac + p.airspeed_kp * Va_error + integral_, 0.0, 1.0);
    out.throttle_integral_frac = integral_;
    return Status::ok;
  }

 private:
  double integral_ = 0;
};
FULMAR_PLUGIN("1.0.0", CppLaw)

// SPDX-License-Identifier: BSD-3-Clause
// Figures of a flight: tracking, estimation and injected GNSS errors, touch-downs, a crash, and a few others.
// The component only observes.
#pragma once
#include <algorithm>
#include <cmath>

#include "fulmar/flight/path/curve.hpp"
#include "fulmar/flight/path/route.hpp"
#include "fulmar/msg/actuators.hpp"
#include "fulmar/msg/attitude_command.hpp"
#include "fulmar/msg/contact_truth.hpp"
#include "fulmar/msg/gnss.hpp"
#include "fulmar/msg/ground_state.hpp"
#include "fulmar/msg/guidance_command.hpp"
#include "fulmar/msg/home_progress.hpp"
#include "fulmar/msg/landing_progress.hpp"
#include "fulmar/msg/loiter_progress.hpp"
#include "fulmar/msg/path.hpp"
#include "fulmar/msg/plan.hpp"
#include "fulmar/msg/progress.hpp"
#include "fulmar/msg/safety_state.hpp"
#include "fulmar/msg/vehicle_state.hpp"
#include "fulmar/msg/vehicle_status.hpp"
#include "fulmar/plugin.hpp"
#include "gnss_errors.hpp"
#include "mean_square.hpp"
#include "plan_figures.hpp"
#include "score_messages.hpp"
#include "story.hpp"
#include "surface_rate.hpp"
#include "touch_watch.hpp"
#include "truth_frame.hpp"
#include "truth_history.hpp"

namespace fulmar::score {

/// The legs around the active waypoint. They are kept until it changes, so that the whole plan is never
/// searched.
class NearRoute {
 public:
  /// False without a defined route: no plan, or on the way to the first leg.
  bool nearest_to(const Plan& plan, const Progress& progress, double north_m, double east_m,
                  RoutePoint& best);

 private:
  void update(const Route& route, std::uint32_t item);

  std::array<RouteLeg, 3> legs_{};
  std::uint32_t count_ = 0;
  RouteOrbit orbit_;
  bool point_ = false;  // all waypoints are in one place
  std::uint32_t revision_ = 0, item_ = 0;
};

struct Score {
  static constexpr const char* doc = "Tracking and estimation errors and figures of a flight.";
  struct Inputs {
    In<VehicleState> state;
    Optional<VehicleState> truth;
    Optional<Path> path;
    Optional<Plan> plan;
    Optional<Progress> progress;
    Optional<GuidanceCommand> command;
    Optional<AttitudeCommand> attitude;
    Optional<Actuators> actuators;
    Optional<Gnss> gnss;
    Optional<VehicleStatus> status;  // source of the commands
    Optional<GroundState> ground;
    Optional<ContactTruth> contact;
    Optional<SafetyState> safety;
    // While one of these arrives, another guide than that of the plan is active.
    Optional<LandingProgress> landing;
    Optional<HomeProgress> home;
    Optional<LoiterProgress> loiter;
    Optional<GuidanceCommand> by_hand;
  };
  struct Outputs {
    Out<TrackingError> tracking;       // relative to the estimate
    Out<TrackingError> tracking_true;  // relative to the truth
    Out<EstimationError> estimation;
    Out<GnssError> gnss_error;
    Out<Figures> figures;
    Out<TouchDown> touch_down;       // from the estimate
    Out<TouchDown> touch_down_true;  // from the simulator's contact
    Out<Crash> crash;
    Out<Verdict> verdict;
  };
  struct Params {
    Param start_height{20, "m", 0, 10000, "height at which the score starts, without the input `progress`"};
  };

  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out);

 private:
  struct Tracking {
    MeanSquare north, east, altitude, roll, pitch, course, airspeed;
    TrackingError rms(double counted_s) const {
      return {north.rms_if_any(), east.rms_if_any(),   altitude.rms_if_any(), roll.rms_if_any(),
              pitch.rms_if_any(), course.rms_if_any(), airspeed.rms_if_any(), counted_s};
    }
    bool any() const { return north.count + roll.count + airspeed.count > 0; }
  };
  struct Estimation {
    MeanSquare north, east, altitude, vel_x, vel_y, vel_z, roll, pitch, heading, course, airspeed, wind_n,
        wind_e;
  };
  void watch(const Tick& tick, const Inputs& in, Outputs& out);
  bool follows_plan(const Tick& tick, const Inputs& in);
  void track(const Inputs& in, const VehicleState& state, Tracking& sums);
  bool nearest_point(const Inputs& in, const VehicleState& state, RoutePoint& point);
  void note_truth(const Inputs& in);
  void estimate(const Inputs& in);
  void add_estimation(const Compared& estimate, const Compared& truth);
  void count(const Tick& tick, const Inputs& in, bool counts);
  static const Progress* progress(const Inputs& in) { return in.progress ? &*in.progress : nullptr; }
  void publish(Outputs& out) const;

  NearRoute route_;
  Tracking tracking_, tracking_true_;
  TruthFrame frame_;
  TruthHistory history_;
  Estimation estimation_;
  Pending state_;
  GnssErrors gnss_;
  SurfaceRate surface_rate_;
  PlanFigures plan_;
  UnderWay under_way_;
  TouchWatch touch_;
  std::int64_t touch_published_ns_ = 0;
  Story story_;
  bool crashed_ = false, started_ = false;
  double counted_s_ = 0, left_out_s_ = 0;
  double airspeed_min_ = unknown_std;
};

}  // namespace fulmar::score

#include "score_impl.hpp"

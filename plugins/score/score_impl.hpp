// SPDX-License-Identifier: BSD-3-Clause
// The functions of score.hpp.
#pragma once
#include "score.hpp"

namespace fulmar::score {

inline void NearRoute::update(const Route& route, std::uint32_t item) {
  count_ = 0;
  point_ = route.is_point();
  if (point_ || !route.closed()) orbit_ = route.final_orbit();
  if (point_) return;
  const auto add = [&](std::uint32_t i) {
    if (route.closed() || i > 0) legs_[count_++] = route.leg(i);
  };
  add(item);
  if (route.before(item) != item) add(route.before(item));
  const std::uint32_t next = route.after(item);
  if (next != item && next != route.before(item)) add(next);
}

inline bool NearRoute::nearest_to(const Plan& plan, const Progress& progress, double north_m, double east_m,
                                  RoutePoint& best) {
  const Route route(plan);
  if (progress.joining || progress.reached == 0 || progress.plan_revision != plan.revision ||
      progress.item >= route.size())
    return false;
  if (revision_ != plan.revision || item_ != progress.item || (count_ == 0 && !point_)) {
    revision_ = plan.revision;
    item_ = progress.item;
    update(route, item_);
  }
  if (point_ || progress.finished) {
    const double n = north_m - orbit_.north_m, e = east_m - orbit_.east_m, d = std::hypot(n, e);
    const double unit_n = d > 1e-9 ? n / d : 1, unit_e = d > 1e-9 ? e / d : 0;
    best = {orbit_.north_m + orbit_.radius_m * unit_n, orbit_.east_m + orbit_.radius_m * unit_e,
            orbit_.height_m, std::abs(d - orbit_.radius_m)};
    return true;
  }
  NearestSearch search(north_m, east_m);
  for (std::uint32_t i = 0; i < count_; ++i) search.consider(legs_[i]);
  best = search.result();
  return true;
}

inline Status Score::step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
  if (crashed_) return Status::ok;
  note_truth(in);
  watch(tick, in, out);
  if (!started_) {
    started_ = in.progress ? in.progress->reached > 0 : in.state->height_m > p.start_height;
    if (started_) plan_.begin(progress(in), tick.now_ns);
  }
  const bool counts = started_ && follows_plan(tick, in);
  const double dt = std::clamp(tick.dt_s(), 0.0, 1.0);
  if (counts) counted_s_ += dt;
  if (!counts && touch_.flying()) left_out_s_ += dt;
  if (!started_) return Status::ok;
  if (in.state.fresh()) {
    if (counts && in.state->position_valid) track(in, *in.state, tracking_);
    estimate(in);
  }
  if (counts && in.truth && in.truth.fresh()) track(in, *in.truth, tracking_true_);
  if (in.truth && in.gnss && frame_.known()) gnss_.fix(in.gnss, frame_, history_);
  count(tick, in, counts);
  if (plan_.due(progress(in), tick.now_ns) || crashed_) publish(out);
  return Status::ok;
}

/// Detects touch-downs and crash and gives the verdict, from the first step on.
inline void Score::watch(const Tick& tick, const Inputs& in, Outputs& out) {
  const auto seen = [](const auto& port) { return port ? &*port : nullptr; };
  const bool down = touch_.step(
      {&*in.state, seen(in.truth), seen(in.contact), seen(in.ground), seen(in.landing)}, tick.now_ns);
  const bool rolls = !touch_.flying() && tick.now_ns - touch_published_ns_ >= 1'000'000'000;
  if (down || rolls) {
    touch_published_ns_ = tick.now_ns;
    if (touch_.estimated().any) out.touch_down.publish(touch_.estimated().figures);
    if (touch_.truth().any) out.touch_down_true.publish(touch_.truth().figures);
  }
  const bool flies = touch_.flying();
  const bool lifted = story_.lift(in.ground || in.contact, flies);
  const bool answered = in.safety && story_.answer(*in.safety, flies, tick.now_s());
  if (lifted || answered) out.verdict.publish(story_.verdict());
  crashed_ = (in.contact && in.contact->crashed) || (in.status && in.status->crashed);
  if (!crashed_) return;
  Crash crash;
  crash.at_s = tick.now_s();
  if (in.contact && in.contact->crashed) crash = crash_of(*in.contact);
  out.crash.publish(crash);
  out.verdict.publish(story_.verdict(crash));
}

/// True when the flight should follow the plan: no take-off, landing or return, no pilot, no failsafe.
inline bool Score::follows_plan(const Tick& tick, const Inputs& in) {
  constexpr std::int64_t recent_ns = 100'000'000;
  const auto flies = [&](const auto& port) { return port && tick.now_ns - port.valid_at_ns() < recent_ns; };
  const bool stands =
      (in.ground && in.ground->contact == Contact::ground) || (in.contact && in.contact->touching);
  const bool under_way = under_way_.step(stands, progress(in));
  const bool aside = flies(in.landing) || flies(in.home) || flies(in.loiter) || flies(in.by_hand);
  return under_way && !stands && !aside && !crashed_ && (!in.status || in.status->in_control);
}

inline void Score::track(const Inputs& in, const VehicleState& state, Tracking& sums) {
  RoutePoint point;
  if (nearest_point(in, state, point)) {
    sums.north.add(point.north_m - state.position_m.north);
    sums.east.add(point.east_m - state.position_m.east);
    sums.altitude.add(point.height_m - state.height_m);
  }
  if (in.command) {
    if (in.command->lateral == LateralMode::course)
      sums.course.add(angle_difference(in.command->course_rad, state.course_rad));
    sums.airspeed.add(in.command->airspeed_mps - state.airspeed_mps);
  }
  if (in.attitude) {
    sums.roll.add(angle_difference(in.attitude->roll_rad, state.roll_rad));
    sums.pitch.add(in.attitude->pitch_rad - state.pitch_rad);
  }
}

/// Nearest point on the route of the plan or, without a plan, on the present path.
inline bool Score::nearest_point(const Inputs& in, const VehicleState& state, RoutePoint& point) {
  const double north = state.position_m.north, east = state.position_m.east;
  if (in.plan && in.progress) return route_.nearest_to(*in.plan, *in.progress, north, east, point);
  if (!in.path) return false;
  const Path& path = *in.path;
  if (path.is_curve) {
    const Curve curve = curve_of(path);
    const Vec3<Ned> at = curve.point(curve.closest(north, east));
    point = {at.north, at.east, -at.down, std::hypot(north - at.north, east - at.east)};
    return true;
  }
  const double n = north - path.origin_m.north, e = east - path.origin_m.east;
  point.north_m = path.origin_m.north;
  point.east_m = path.origin_m.east;
  point.height_m = -path.origin_m.down;
  if (path.kind == PathKind::line) {
    const Vec3<Ned>& q = path.direction_ratio;
    const double level2 = std::max(q.north * q.north + q.east * q.east, 1e-12),
                 s = (n * q.north + e * q.east) / level2;
    point.north_m += s * q.north;
    point.east_m += s * q.east;
    point.height_m -= s * q.down;
  } else {
    const double d = std::hypot(n, e), azimuth = d > 1e-9 ? std::atan2(e, n) : path.start_rad;
    point.north_m += path.radius_m * std::cos(azimuth);
    point.east_m += path.radius_m * std::sin(azimuth);
    point.height_m +=
        path.climb_ratio * path.radius_m * sign_of(path.turn) * wrap_pi(azimuth - path.start_rad);
  }
  return true;
}

inline void Score::note_truth(const Inputs& in) {
  if (!in.truth || !in.truth.fresh()) return;
  frame_.note(*in.truth);
  history_.add(in.truth.valid_at_ns(), compared(*in.truth));
}

inline void Score::estimate(const Inputs& in) {
  if (!in.truth) return;
  Compared truth;
  if (state_.waits && history_.at(state_.time_ns, truth) != TruthHistory::Found::not_yet) {
    if (history_.at(state_.time_ns, truth) == TruthHistory::Found::yes) add_estimation(state_.sample, truth);
    state_.waits = false;
  }
  const VehicleState& state = *in.state;
  if (!state.position_valid || !state.attitude_valid || !state.velocity_valid) return;
  const std::int64_t time_ns = in.state.valid_at_ns();
  const TruthHistory::Found found = history_.at(time_ns, truth);
  if (found == TruthHistory::Found::too_old || (found == TruthHistory::Found::not_yet && state_.waits))
    return;
  Compared estimate = compared(state);
  if (!frame_.same_origin(state) && state.origin_valid && frame_.known()) {
    // Conversion to another origin: the two local frames are parallel within a metre.
    const Vec3<Ned> o =
        frame_.at(state.origin_latitude_deg, state.origin_longitude_deg, state.origin_altitude_m);
    estimate.north += o.north;
    estimate.east += o.east;
    estimate.height -= o.down;
  }
  if (found == TruthHistory::Found::yes) {
    add_estimation(estimate, truth);
  } else {
    state_ = {true, time_ns, estimate};
  }
}

inline void Score::add_estimation(const Compared& estimate, const Compared& truth) {
  Estimation& s = estimation_;
  s.north.add(estimate.north - truth.north);
  s.east.add(estimate.east - truth.east);
  s.altitude.add(estimate.height - truth.height);
  s.vel_x.add(estimate.vel_x - truth.vel_x);
  s.vel_y.add(estimate.vel_y - truth.vel_y);
  s.vel_z.add(estimate.vel_z - truth.vel_z);
  s.roll.add(angle_difference(estimate.roll, truth.roll));
  s.pitch.add(estimate.pitch - truth.pitch);
  s.heading.add(angle_difference(estimate.heading, truth.heading));
  s.course.add(angle_difference(estimate.course, truth.course));
  s.airspeed.add(estimate.airspeed - truth.airspeed);
  s.wind_n.add(estimate.wind_n - truth.wind_n);
  s.wind_e.add(estimate.wind_e - truth.wind_e);
}

inline void Score::count(const Tick& tick, const Inputs& in, bool counts) {
  if (in.progress) plan_.count(*in.progress, tick.now_ns);
  if (counts)
    airspeed_min_ = std::min(airspeed_min_, in.truth ? in.truth->airspeed_mps : in.state->airspeed_mps);
  if (in.actuators && in.actuators.fresh())
    surface_rate_.command(*in.actuators, in.actuators.valid_at_ns(), counts);
}

inline void Score::publish(Outputs& out) const {
  if (tracking_.any()) out.tracking.publish(tracking_.rms(counted_s_));
  if (tracking_true_.any()) out.tracking_true.publish(tracking_true_.rms(counted_s_));
  if (estimation_.north.count > 0) {
    const Estimation& s = estimation_;
    out.estimation.publish({s.north.rms(), s.east.rms(), s.altitude.rms(), s.vel_x.rms(), s.vel_y.rms(),
                            s.vel_z.rms(), s.roll.rms(), s.pitch.rms(), s.heading.rms(), s.course.rms(),
                            s.airspeed.rms(), s.wind_n.rms(), s.wind_e.rms()});
  }
  if (gnss_.any()) out.gnss_error.publish(gnss_.rms());
  Figures figures = plan_.figures();
  figures.surface_rate_rms_radps = surface_rate_.rms_if_any();
  figures.airspeed_min_mps = airspeed_min_;
  figures.left_out_s = left_out_s_;
  out.figures.publish(figures);
}

}  // namespace fulmar::score

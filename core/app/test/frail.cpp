// SPDX-License-Identifier: BSD-3-Clause
// The shipped components, made to fail in a given way at a given time; and one that fills two roles.
#include <csignal>
#include <cstdlib>
#include <limits>
#include <stdexcept>

#include "fulmar/plugin.hpp"
#include "plugins/control_slc/inner.hpp"
#include "plugins/control_slc/outer.hpp"
#include "plugins/control_tecs/outer.hpp"
#include "plugins/path/manager.hpp"
#include "plugins/path/planner.hpp"
#include "plugins/path/vector_field.hpp"
#include "plugins/sim_aero/truth_state.hpp"

using namespace fulmar;

namespace {

enum class Fault : std::uint8_t { none, throws, fails, nan, crashes, hangs, aborts, exits };

struct FaultParams {
  Choice<Fault> fault{Fault::none, "what goes wrong"};
  Param fault_at{1e9, "s", -1e9, 1e9, "from when on"};
};

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Sets a value in the outputs that is not finite.
template <class Outputs>
void spoil(Outputs& out) {
  if constexpr (requires { out.attitude.roll_rad; }) out.attitude.roll_rad = nan;
  if constexpr (requires { out.actuators.throttle_frac; }) out.actuators.throttle_frac = nan;
  if constexpr (requires { out.command.course_rad; }) out.command.course_rad = nan;
  if constexpr (requires { out.state.height_m; }) out.state.height_m = nan;
  if constexpr (requires { out.path.publish(Path{}); }) {
    Path path;
    path.radius_m = nan;
    out.path.publish(path);
  }
  if constexpr (requires { out.plan.publish(Plan{}); }) {
    Plan plan;
    plan.turn_radius_m = nan;
    out.plan.publish(plan);
  }
}

template <class Component>
struct Frail {
  using Inputs = typename Component::Inputs;
  using Outputs = typename Component::Outputs;
  struct Params {
    typename Component::Params own;
    FaultParams wrong;
  };

  void configure(const Params& p) {
    if constexpr (requires { component_.configure(p.own); }) component_.configure(p.own);
  }
  void retune(const Params& p) {
    if constexpr (requires { component_.retune(p.own); }) component_.retune(p.own);
  }
  Status activate(const Tick& tick, const Inputs& in, const Params& p, const Applied<Outputs>& last) {
    if constexpr (requires { component_.activate(tick, in, p.own, last); })
      return component_.activate(tick, in, p.own, last);
    else
      return Status::ok;
  }
  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
    const Status status = component_.step(tick, in, p.own, out);
    if (tick.now_s() < p.wrong.fault_at) return status;
    switch (p.wrong.fault) {
      case Fault::none: break;
      case Fault::throws: throw std::runtime_error("lost");
      case Fault::fails: return Status::failed;
      case Fault::nan: spoil(out); break;
      case Fault::crashes: raise(SIGSEGV); break;
      case Fault::hangs:
        for (;;) asm volatile("");
      case Fault::aborts: std::abort();
      case Fault::exits: std::exit(3);
    }
    return status;
  }

 private:
  Component component_;
};

/// From guidance to surfaces: the outer and the inner law in one, without a mission's gains.
struct Whole {
  struct Inputs {
    In<VehicleState> state;
    In<GuidanceCommand> command;
  };
  struct Outputs {
    AttitudeCommand attitude;
    Actuators actuators;
  };
  struct Params {
    Record<Airframe> airframe{"of both laws"};
  };

  void configure(const Params& p) {
    outer_params_.common.airframe = p.airframe;
    inner_params_.airframe = p.airframe;
  }
  Status activate(const Tick& tick, const Inputs& in, const Params&, const Applied<Outputs>& last) {
    Applied<slc::Outer::Outputs> outer;
    Applied<slc::Inner::Outputs> inner;
    outer.outputs.attitude = last->attitude;
    inner.outputs.actuators = last->actuators;
    outer.made_bits = last.has(last->attitude);
    inner.made_bits = last.has(last->actuators);
    attitude_ = last->attitude;
    const Status status = outer_.activate(tick, {in.state, in.command}, outer_params_, outer);
    return status == Status::failed ? status : inner_.activate(tick, inputs(in), inner_params_, inner);
  }
  Status step(const Tick& tick, const Inputs& in, const Params&, Outputs& out) {
    slc::Outer::Outputs outer;
    const Status status = outer_.step(tick, {in.state, in.command}, outer_params_, outer);
    if (status == Status::failed) return status;
    out.attitude = attitude_ = outer.attitude;
    slc::Inner::Outputs inner;
    const Status last = inner_.step(tick, inputs(in), inner_params_, inner);
    out.actuators = inner.actuators;
    return last;
  }

 private:
  slc::Inner::Inputs inputs(const Inputs& in) {
    view_.data = &attitude_;
    view_.count = 1;
    view_.sequence = ++sequence_;
    view_.flags = FULMAR_FRESH;
    slc::Inner::Inputs inputs;
    inputs.state = in.state;
    inputs.attitude.input = &view_;
    return inputs;
  }

  slc::Outer outer_;
  slc::Inner inner_;
  slc::Outer::Params outer_params_;
  slc::Inner::Params inner_params_;
  AttitudeCommand attitude_;
  fulmar_input view_{};
  std::uint64_t sequence_ = 0;
};

struct Truth : Frail<sim::TruthState> {};
struct Planner : Frail<path::Planner> {};
struct Manager : Frail<path::Manager> {};
struct Guide : Frail<path::VectorField> {};
struct Slc : Frail<slc::Outer> {};
struct Tecs : Frail<tecs::Outer> {};
struct Inner : Frail<slc::Inner> {};
struct Both : Frail<Whole> {};

}  // namespace
FULMAR_PLUGIN("1.0.0", Truth, Planner, Manager, Guide, Slc, Tecs, Inner, Both)

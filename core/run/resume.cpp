// SPDX-License-Identifier: BSD-3-Clause
// Resumes a flight at the end of a log.
#include <algorithm>
#include <utility>

#include "core/run/flight_impl.hpp"
#include "core/run/messages.hpp"
#include "core/types/named.hpp"

namespace fulmar::core {

/// Before the first step, or when a vehicle turns out to be armed. The parameters are those of a log: one
/// that cannot be set any more is reported, and the flight continues without it.
void Flight::Impl::resume_now(bool begun) {
  const Resume resume = std::move(*state.options.resume);
  state.options.resume.reset();
  end.taken_up();
  const int to = std::max(0, index_named(state.graph.phases, resume.phase));
  if (!begun) roles.begin_in(to);
  Event e = event_of(Code::resumed, "", resume.phase);
  say(e, run_messages::resumed, resume.text());
  recorder.note(e);
  for (const Resume::Param& param : resume.params) resume_parameter(param);
  if (to != roles.phase()) roles.enter(to);
}

void Flight::Impl::resume_parameter(const Resume::Param& param) {
  try {
    Command command = command_of(CommandKind::parameter, param.component, param.param);
    command.value = param.value;
    commands->prepare(command);
    apply_parameter(command, Code::resumed);
  } catch (const Error& fault) {
    Event e = event_of(Code::not_resumed, param.component, param.param);
    put(e.cause, fault.what());
    say(e, run_messages::not_resumed, fault.what());
    recorder.note(e);
  }
}

void Flight::Impl::resume_if_armed() {
  if (!protection.has_spoken()) return;
  if (heard_ns == never_ns) heard_ns = state.now_ns;
  if (protection.flies()) return resume_now(true);
  if (state.now_ns - heard_ns < 1'000'000'000) return;
  state.options.resume.reset();
  Event e = event_of(Code::not_resumed);
  say(e, run_messages::not_resumed_on_ground);
  recorder.note(e);
}

}  // namespace fulmar::core

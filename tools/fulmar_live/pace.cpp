// SPDX-License-Identifier: BSD-3-Clause
// `fulmar pause | resume | step | speed | restart`: the clock of a simulation.
#include "core/tap/pace.hpp"

#include <cstdio>
#include <nlohmann/json.hpp>
#include <thread>

#include "tools/fulmar_live/commands.hpp"
#include "tools/fulmar_live/messages.hpp"
#include "tools/fulmar_live/session.hpp"

namespace fulmar::core {
namespace {

constexpr auto as_long_as_it_takes = std::chrono::hours(24);

int order(Session& session, const std::string& service, const nlohmann::json& request,
          const std::string& what) {
  const Session::Verdict verdict = session.order(service, request);
  if (!verdict.accepted) {
    std::fprintf(stderr, "%s\n", remote_messages::request_rejected(what, verdict.reason).text.c_str());
    return 1;
  }
  const double now_s = 1e-9 * static_cast<double>(session.view().value("now_ns", std::int64_t{0}));
  std::printf("%s\n", remote_messages::order_accepted(what, Fixed{now_s, 4}).text.c_str());
  return 0;
}

/// An invalid value is wrong usage, with or without a flight.
void check(const auto& parse, const std::string& text) {
  try {
    parse(text);
  } catch (const Error& wrong) {
    throw WrongUsage(wrong.what());
  }
}

/// True when another flight than `old` starts there within the time of the set-up of a mission.
bool another_comes(const LiveAddress& target, const std::string& old) {
  constexpr auto patience = std::chrono::seconds(20);
  for (const auto end = std::chrono::steady_clock::now() + patience; std::chrono::steady_clock::now() < end;
       std::this_thread::sleep_for(std::chrono::milliseconds(50))) {
    try {
      if (Session(target).id() != old) return true;
    } catch (const Error&) {  // no server in between
    }
  }
  return false;
}

}  // namespace

int pause_command(const LiveAddress& target) {
  Session session(target);
  return order(session, "/fulmar/pause", nlohmann::json::object(), "pause");
}

int resume_command(const LiveAddress& target) {
  Session session(target);
  return order(session, "/fulmar/resume", nlohmann::json::object(), "resume");
}

int step_command(const LiveAddress& target, const std::string& ticks) {
  check(step_order, ticks);
  Session session(target);
  session.be_patient(as_long_as_it_takes);
  return order(session, "/fulmar/step", {{"ticks", ticks}}, "step " + ticks);
}

int speed_command(const LiveAddress& target, const std::string& speed) {
  check(speed_order, speed);
  Session session(target);
  return order(session, "/fulmar/speed", {{"speed", speed}}, "speed " + speed);
}

int restart_command(const LiveAddress& target, const std::string& seed) {
  check(restart_order, seed);
  Session session(target);
  const std::string old = session.id();
  const auto [accepted, reason] = session.order("/fulmar/restart", {{"seed", seed}});
  if (!accepted) {
    std::fprintf(stderr, "%s\n", remote_messages::request_rejected("restart", reason).text.c_str());
    return 1;
  }
  if (!another_comes(target, old)) throw Error(remote_messages::restarted_flight_missing(target.text()));
  std::printf("%s\n", remote_messages::restart_accepted.c_str());
  return 0;
}

}  // namespace fulmar::core

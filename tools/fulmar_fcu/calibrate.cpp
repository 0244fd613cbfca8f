// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_fcu/calibrate.hpp"

#include <algorithm>
#include <cctype>
#include <utility>

#include "tools/fulmar_fcu/messages.hpp"

namespace fulmar::fcu {

namespace {

const std::vector<Calibration>& calibrations() {
  static const std::vector<Calibration> list{
      {"imu",
       Command::accel_calibration,
       "Lay the aircraft level and do not touch it.",
       {"ACC_X_BIAS", "ACC_Y_BIAS", "ACC_Z_BIAS", "GYRO_X_BIAS", "GYRO_Y_BIAS", "GYRO_Z_BIAS"},
       {"imu", "accel", "gyro"},
       {"offsets captured"},
       {"movement", "accel bias"},
       3,
       10,
       true,
       false},
      {"gyro",
       Command::gyro_calibration,
       "Do not touch the aircraft.",
       {"GYRO_X_BIAS", "GYRO_Y_BIAS", "GYRO_Z_BIAS"},
       {"gyro"},
       {},
       {"movement", "gyro bias"},
       3,
       10,
       true,
       false},
      {"rc",
       Command::rc_calibration,
       "Trim the aircraft by the transmitter and leave the sticks alone.",
       {"X_EQ_TORQUE", "Y_EQ_TORQUE", "Z_EQ_TORQUE"},
       {},
       {"torques found", "applied"},
       {"cannot"},
       1,
       3,
       false,
       false},
      {"baro",
       Command::baro_calibration,
       "Keep wind and doors away.",
       {"BARO_BIAS", "GROUND_LEVEL"},
       {"baro"},
       {"success", "complete"},
       {"movement", "failed", "variance"},
       8,
       40,
       true,
       true},
      {"airspeed",
       Command::airspeed_calibration,
       "Cover the pitot tube.",
       {"DIFF_PRESS_BIAS"},
       {"airspeed", "diff press"},
       {"success", "complete"},
       {"movement", "failed", "variance"},
       8,
       40,
       true,
       true},
  };
  return list;
}

bool says_one(const std::string& text, const std::vector<std::string>& parts) {
  std::string low = text;
  std::transform(low.begin(), low.end(), low.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return std::any_of(parts.begin(), parts.end(),
                     [&](const std::string& part) { return low.find(part) != std::string::npos; });
}

/// State of one calibration.
class Run {
 public:
  Run(Client& client, const Calibration& what) : client_(client), what_(what), texts_(client.said().size()) {}

  std::vector<Param> before, after;

  void start() {
    started_ns_ = client_.now_ns();
    if (what_.command != Command::rc_calibration) return client_.demand(what_.command, deed());
    // The firmware adds to the present value, so a second command would count twice: it is repeated only
    // while nothing was added.
    for (int i = 0; i < 3; ++i) {
      const std::optional<bool> answer = client_.command(what_.command, 1, 700 * ms);
      if (answer && !*answer)
        throw Error(fcu_messages::action_refused(
            deed(), client_.armed() ? ": it is armed." : " and gave no reason."));
      if (answer || said(what_.good) || read_back()) return;
    }
    throw Error(fcu_messages::action_not_acknowledged(client_.name(), deed()));
  }

  /// Returns true at the end. A failure is an Error.
  bool over() {
    if (const Said* bad = said(what_.bad)) {
      last_failure_ = bad->text;
      if (!what_.repeats) throw Error(fcu_messages::calibration_failed(name(), bad->text, what_.prepare));
    }
    return said(what_.good) || changed_last();
  }

  /// Reads the result; returns true when there is one.
  bool read_back() {
    after = read_some(client_, what_.params);
    if (after.size() != what_.params.size()) return false;
    if (what_.zeroes &&
        std::any_of(after.begin(), after.end(), [](const Param& p) { return p.number() == 0; }))
      return false;
    return differs();
  }

  bool complete() const { return after.size() == what_.params.size(); }
  bool said_good() { return said(what_.good) != nullptr; }
  double elapsed_s() const { return static_cast<double>(client_.now_ns() - started_ns_) * 1e-9; }
  /// Restores the former values after a failure, and returns a report of it; "" when they are unchanged. Not
  /// for a calibration that restarts by itself. Throws BiasesLost.
  std::string put_back(const std::string& why) {
    if (!what_.zeroes || what_.repeats) return "";
    bool changed = false;
    try {
      after = read_some(client_, what_.params);
      if (complete() && !(changed = differs())) return "";
      client_.pump(std::max<std::int64_t>(0, started_ns_ + what_.usual_s * second + 500 * ms -
                                                 client_.now_ns()));  // until no more of its messages arrive
      after = read_some(client_, what_.params);
      if (complete()) {
        changed = differs();
        for (std::size_t i = 0; i < after.size(); ++i) set_param(client_, after[i], before[i].bits);
        return fcu_messages::values_restored().line();
      }
    } catch (const std::exception&) {  // no answer, no device: reported below
    }
    throw BiasesLost(
        changed ? fcu_messages::values_not_restored(why) : fcu_messages::restored_values_unknown(why),
        before);
  }
  [[noreturn]] void give_up() const {
    const std::string limit = std::to_string(what_.limit_s) + " s";
    if (!last_failure_.empty())
      throw Error(fcu_messages::calibration_not_successful(name(), limit, last_failure_, what_.prepare));
    throw Error(fcu_messages::calibration_end_missing(name(), limit));
  }

 private:
  std::string name() const { return what_.name; }
  std::string deed() const { return "the " + name() + " calibration"; }

  const Said* said(const std::vector<std::string>& parts) const {
    // An earlier report is about another calibration, such as that of the boot.
    const std::int64_t soonest_ns = started_ns_ + (what_.zeroes ? what_.usual_s * second * 3 / 10 : 0);
    const auto found = std::find_if(client_.said().begin() + static_cast<std::ptrdiff_t>(texts_),
                                    client_.said().end(), [&](const Said& text) {
                                      return text.at_ns >= soonest_ns && says_one(text.text, parts) &&
                                             (what_.about.empty() || says_one(text.text, what_.about));
                                    });
    return found == client_.said().end() ? nullptr : &*found;
  }
  bool differs() const {
    for (const Param& p : after)
      for (const Param& q : before)
        if (p.name == q.name && p.bits != q.bits) return true;
    return false;
  }
  /// True when its last parameter is reported and is not the zero of its start.
  bool changed_last() const {
    return std::all_of(what_.params.begin(), what_.params.end(), [&](const std::string& n) {
      const auto it = client_.params().find(n);
      return it != client_.params().end() && it->second.heard_ns > started_ns_ && it->second.number() != 0;
    });
  }

  Client& client_;
  const Calibration& what_;
  std::size_t texts_;
  std::int64_t started_ns_ = 0;
  std::string last_failure_;
};

/// Returns at its success; a failure is an Error.
void wait_for_end(Client& client, const Calibration& what, Run& run,
                  const std::function<void(double)>& progress) {
  const std::int64_t began = client.now_ns(), until = began + what.limit_s * second;
  while (client.now_ns() < until) {
    client.pump(100 * ms);
    if (progress) progress(run.elapsed_s());
    // A lost text or echo delays the end only: the result is read when it is due.
    const bool due = client.now_ns() - began > what.usual_s * second &&
                     static_cast<std::int64_t>(run.elapsed_s() * 10) % 10 == 0;
    if (!run.over() && !due) continue;
    if (run.read_back() || (run.said_good() && run.complete())) return;
  }
  run.give_up();
}

}  // namespace

const Calibration* find_calibration(const std::string& name) {
  const auto it = std::find_if(calibrations().begin(), calibrations().end(),
                               [&](const Calibration& c) { return c.name == name; });
  return it == calibrations().end() ? nullptr : &*it;
}

Calibrated calibrate(Client& client, const Calibration& what, const std::function<void(double)>& progress) {
  client.refuse_armed(std::string("the ") + what.name + " calibration");
  Run run(client, what);
  run.before = read_some(client, what.params);
  if (run.before.size() != what.params.size())
    throw Error(fcu_messages::parameters_not_reported(client.name()));
  try {
    run.start();
    wait_for_end(client, what, run, progress);
  } catch (const Interrupted& e) {
    const auto cancelled = std::exchange(client.cancelled, nullptr);  // it ends after this
    throw Interrupted(run.put_back(e.what()));
  } catch (const std::exception& e) {
    throw Error(fcu_messages::calibration_stopped(e.what(), run.put_back(e.what())));
  }
  return {run.before, run.after};
}

}  // namespace fulmar::fcu

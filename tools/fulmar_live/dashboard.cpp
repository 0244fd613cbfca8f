// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_live/dashboard.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

#include "core/tap/pace.hpp"
#include "core/types/text.hpp"
#include "tools/fulmar_live/messages.hpp"
#include "tools/fulmar_live/table.hpp"

namespace fulmar::core {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr std::size_t name_width = 10, cell_width = 26, max_events = 100, min_events = 3;
constexpr double stale_s = 2;  // of flight: older values are not shown as present ones
const char* const event_topic = "/fulmar/event";
const char* const none = "-";

std::string fixed(double value, int decimals) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, "%.*f", decimals, value);
  const std::string text = buffer;
  return text.starts_with('-') && text.find_first_not_of("-0.") == std::string::npos ? text.substr(1) : text;
}
std::string with_unit(double value, int decimals, const std::string& unit) {
  if (!std::isfinite(value)) return none;
  return fixed(value, decimals) + (unit == "°" ? "" : " ") + unit;
}
/// 0 to 359.
double bearing(double degrees) { return std::fmod(std::fmod(std::round(degrees), 360) + 360, 360); }

/// "0:23.4" of flight.
std::string clock_text(double seconds) {
  const double tenths = std::round(std::abs(seconds) * 10);
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, "%s%.0f:%04.1f", seconds < 0 && tenths > 0 ? "-" : "",
                std::floor(tenths / 600), std::fmod(tenths, 600) / 10);
  return buffer;
}

/// A text in one line without control characters.
std::string one_line(const std::string& text) {
  std::string line = for_terminal(text);
  for (char& c : line)
    if (c == '\n' || c == '\t') c = ' ';
  return line;
}

std::string text_at(const ordered_json& object, const std::string& key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? one_line(found->get<std::string>()) : "";
}

/// The first characters of UTF-8.
std::string first_of(const std::string& text, std::size_t width) {
  std::size_t at = 0;
  for (std::size_t count = 0; at < text.size(); ++at)
    if ((static_cast<unsigned char>(text[at]) & 0xc0u) != 0x80u && count++ == width) break;
  return text.substr(0, at);
}

/// Lines of at most `width` characters, broken at spaces where there are some.
std::vector<std::string> wrapped(const std::string& text, std::size_t width) {
  std::vector<std::string> lines;
  std::string rest = text;
  while (width_of(rest) > width) {
    std::string line = first_of(rest, width + 1);
    const std::size_t space = line.rfind(' ');
    line = space == std::string::npos || space == 0 ? first_of(rest, width) : line.substr(0, space);
    lines.push_back(line);
    rest = std::string(trimmed(rest.substr(line.size())));
  }
  lines.push_back(rest);
  return lines;
}

std::string padded(const std::string& text, std::size_t width) {
  return text + std::string(width - std::min(width, width_of(text)), ' ');
}

std::vector<std::string> split(const std::string& list) {  // "guide, outer"
  std::vector<std::string> words;
  for (std::size_t from = 0; from < list.size();) {
    const std::size_t end = std::min(list.find(", ", from), list.size());
    words.push_back(list.substr(from, end - from));
    from = end + 2;
  }
  return words;
}

}  // namespace

// ---- input

void Dashboard::take_view(json view) { view_ = std::move(view); }

std::vector<std::string> Dashboard::choose(const std::map<std::string, std::string>& topics) {
  static const std::set<std::string> shown = {
      "VehicleState", "GuidanceCommand", "AttitudeCommand",  "Progress", "VehicleStatus",
      "Rc",           "LinkStatus",      "NavigationHealth", "Gnss",     "SafetyState"};
  std::set<std::string> roles;
  for (const json& c : view_.value("components", json::array()))
    for (const std::string& role : split(c.value("role", ""))) roles.insert(role);
  std::map<std::string, int> best;
  newest_.clear();
  for (const auto& [topic, type] : topics) {
    if (!shown.contains(type)) continue;
    const bool truth = type == "VehicleState" && topic.find("truth") != std::string::npos;
    const int liked = (roles.contains(topic.substr(1, topic.find('/', 1) - 1)) ? 2 : 0) + (truth ? 0 : 1) + 1;
    if (liked > best[type]) {
      best[type] = liked;
      newest_[type].topic = topic;
    }
  }
  std::vector<std::string> chosen;
  for (const auto& [type, newest] : newest_) chosen.push_back(newest.topic);
  if (topics.contains(event_topic)) chosen.emplace_back(event_topic);
  return chosen;
}

void Dashboard::take(const std::string& topic, double time_s, const ordered_json& message) {
  if (!message.is_object()) return;
  if (topic != event_topic) {
    now_s_ = std::max(now_s_, time_s);
    for (auto& [type, newest] : newest_)
      if (newest.topic == topic) {
        newest.message = message;
        newest.time_s = time_s;
      }
    return;
  }
  const std::string severity = text_at(message, "severity"), code = text_at(message, "code"),
                    component = text_at(message, "component"), name = text_at(message, "name");
  std::string said = text_at(message, "words");
  if (said.empty()) said = code + " " + component + " " + name + " " + text_at(message, "cause");
  Happened event{clock_text(time_s) + (severity == "info" ? "   " : " ! ") + said,
                 code == "parameter_set" ? component + "." + name : "",
                 severity == "info" ? Look::plain : Look::bad};
  // a slider or a stick changes a parameter many times: only its last value is shown
  if (!event.of.empty() && !events_.empty() && events_.front().of == event.of) events_.pop_front();
  events_.push_front(std::move(event));
  if (events_.size() > max_events) events_.pop_back();
}

bool Dashboard::whole() const {
  return std::all_of(newest_.begin(), newest_.end(),
                     [](const auto& entry) { return !entry.second.message.empty(); });
}

/// Empty without a message, or with one that is too old.
const ordered_json& Dashboard::message(const std::string& type) const {
  static const ordered_json nothing = ordered_json::object();
  const auto found = newest_.find(type);
  return found != newest_.end() && now_s_ - found->second.time_s <= stale_s ? found->second.message : nothing;
}

double Dashboard::number(const std::string& type, const std::string& path) const {
  const ordered_json* at = &message(type);
  for (std::size_t from = 0; at != nullptr && from <= path.size();) {
    const std::size_t dot = std::min(path.find('.', from), path.size());
    const auto found = at->find(path.substr(from, dot - from));
    at = at->is_object() && found != at->end() ? &*found : nullptr;
    from = dot + 1;
  }
  return at != nullptr && at->is_number() ? at->get<double>() : NAN;
}

bool Dashboard::flag(const std::string& type, const std::string& field) const {
  return message(type).value(field, ordered_json()) == true;
}

std::string Dashboard::word(const std::string& type, const std::string& field) const {
  return text_at(message(type), field);
}

// ---- output

/// "70.2 → 75.0 m": present and commanded value.
std::string Dashboard::asked_for(const std::string& type, const std::string& valid, const std::string& path,
                                 const std::string& asked_type, const std::string& asked_path, int decimals,
                                 const std::string& unit) const {
  const bool turns = path == "course_deg";
  double is = flag(type, valid) ? number(type, path) : NAN, asked = number(asked_type, asked_path);
  if (turns) {
    is = bearing(is);
    asked = bearing(asked);
  }
  if (!std::isfinite(asked)) return with_unit(is, decimals, unit);
  return (std::isfinite(is) ? fixed(is, decimals) : none) + " → " + with_unit(asked, decimals, unit);
}

std::vector<Dashboard::Cell> Dashboard::cells() const {
  const std::string state = "VehicleState", guide = "GuidanceCommand", attitude = "AttitudeCommand";
  const auto of = [&](const char* valid, const char* path, int decimals, const char* unit) {
    return flag(state, valid) ? with_unit(number(state, path), decimals, unit) : none;
  };
  const double wind_n = number(state, "wind_mps.north"), wind_e = number(state, "wind_mps.east"),
               battery = number("VehicleStatus", "battery_frac"), items = number("Progress", "items");
  std::string wind = none, waypoint = none;
  if (flag(state, "wind_valid"))
    wind = with_unit(bearing(std::atan2(-wind_e, -wind_n) * 180 / M_PI), 0, "°") + ", " +
           with_unit(std::hypot(wind_n, wind_e), 1, "m/s");
  if (items > 0)
    waypoint = fixed(number("Progress", "item"), 0) + " of " + fixed(items, 0) + ", " +
               with_unit(number("Progress", "distance_m"), 0, "m");
  return {
      {"height", asked_for(state, "height_valid", "height_m", guide, "height_m", 1, "m")},
      {"roll", asked_for(state, "attitude_valid", "roll_deg", attitude, "roll_deg", 1, "°")},
      {"north", of("position_valid", "position_m.north", 0, "m")},
      {"airspeed", asked_for(state, "airspeed_valid", "airspeed_mps", guide, "airspeed_mps", 1, "m/s")},
      {"pitch", asked_for(state, "attitude_valid", "pitch_deg", attitude, "pitch_deg", 1, "°")},
      {"east", of("position_valid", "position_m.east", 0, "m")},
      {"climb", asked_for(state, "velocity_valid", "climb_rate_mps", guide, "climb_rate_mps", 1, "m/s")},
      {"course", asked_for(state, "velocity_valid", "course_deg", guide, "course_deg", 0, "°")},
      {"ground", of("velocity_valid", "ground_speed_mps", 1, "m/s")},
      {"throttle", with_unit(number(attitude, "throttle_frac") * 100, 0, "%")},
      {"heading",
       flag(state, "attitude_valid") ? with_unit(bearing(number(state, "yaw_deg")), 0, "°") : none},
      {"waypoint", waypoint},
      {"battery",
       with_unit(battery * 100, 0, "%") + ", " + with_unit(number("VehicleStatus", "battery_volt"), 1, "V"),
       battery < 0.2 ? Look::bad : Look::plain},
      {"current", with_unit(number("VehicleStatus", "battery_amp"), 1, "A")},
      {"wind from", wind}};
}

Dashboard::Cell Dashboard::control() const {
  const auto is = [&](const char* field) { return flag("VehicleStatus", field); };
  if (message("VehicleStatus").empty()) return {"control", remote_messages::vehicle_silent(), Look::bad};
  const bool bad = is("crashed") || is("failsafe");
  std::string who = is("crashed")      ? "crashed"
                    : is("failsafe")   ? remote_messages::vehicle_failsafe.c_str()
                    : is("override")   ? "pilot"
                    : is("in_control") ? "autopilot"
                                       : "nobody";
  const std::string health = word("VehicleStatus", "health");
  if (health != "ok") who += ", vehicle " + health;
  Look look = bad || health != "ok" ? Look::bad : who == "autopilot" ? Look::good : Look::plain;
  if (!message("Rc").empty()) {
    const bool radio = flag("Rc", "link");
    who += radio ? "; radio there" : "; no radio";
    if (!radio) look = Look::bad;
  }
  const auto link = newest_.find("LinkStatus");
  if (link != newest_.end() && !link->second.message.empty()) {
    const double age_s = number("LinkStatus", "heard_age_s");
    const bool good = age_s < 1 && flag("LinkStatus", "open");
    who += good ? "; link " + fixed(number("LinkStatus", "imu_rate_hz"), 0) + " Hz, " +
                      with_unit(number("LinkStatus", "round_trip_s") * 1000, 1, "ms")
                : "; link lost";
    if (!good) look = Look::bad;
  }
  return {"control", who, look};
}

Dashboard::Cell Dashboard::estimator() const {
  if (message("VehicleState").empty()) return {"estimator", remote_messages::estimate_absent(), Look::bad};
  std::string lacks;
  for (const char* what : {"attitude", "position", "height", "velocity", "airspeed", "wind"})
    if (!flag("VehicleState", std::string(what) + "_valid"))
      lacks += (lacks.empty() ? "no " : ", ") + std::string(what);
  const double std_m = std::hypot(number("VehicleState", "position_std_m.north"),
                                  number("VehicleState", "position_std_m.east"));
  constexpr double known_m = 1e6;
  const std::string position = std_m < known_m ? "; position within " + fixed(std_m, 1) + " m (1 sigma)" : "";
  return {"estimator", (lacks.empty() ? "valid" : lacks) + position, lacks.empty() ? Look::good : Look::bad};
}

Dashboard::Cell Dashboard::sensors() const {
  std::string good, bad;
  for (const auto& [name, sensor] : message("NavigationHealth").items()) {
    const std::string state = sensor.is_object() ? text_at(sensor, "state") : "";
    std::string words = one_line(name);
    std::replace(words.begin(), words.end(), '_', ' ');
    if (state == "ok")
      good += (good.empty() ? "" : ", ") + words;
    else if (state != "never" && !state.empty())
      bad += (bad.empty() ? "" : ", ") + words + " " + state;
  }
  if (!message("Gnss").empty()) {
    std::string fix = word("Gnss", "fix");
    std::replace(fix.begin(), fix.end(), '_', ' ');
    (fix == "none" ? bad : good) += (fix == "none" ? bad : good).empty() ? "" : ", ";
    (fix == "none" ? bad : good) += fixed(number("Gnss", "satellites"), 0) + " satellites, " + fix;
  }
  if (!bad.empty()) return {"sensors", bad + (good.empty() ? "" : "; ok: " + good), Look::bad};
  return {"sensors", good.empty() ? none : good, good.empty() ? Look::faint : Look::good};
}

Dashboard::Cell Dashboard::safety() const {
  std::string wrong;
  for (const auto& [name, value] : message("SafetyState").items()) {
    if (value != true || name == "airborne" || name == "ready") continue;
    std::string words = one_line(name);
    std::replace(words.begin(), words.end(), '_', ' ');
    wrong += (wrong.empty() ? "" : ", ") + words;
  }
  const std::string answer = word("SafetyState", "answer");
  if (answer != "none" && !answer.empty())
    wrong += (wrong.empty() ? "" : "; ") + std::string("answer: ") + answer;
  if (wrong.empty()) return {"safety", remote_messages::nothing_wrong(), Look::good};
  return {"safety", wrong, Look::bad};
}

Dashboard::Cell Dashboard::roles() const {
  std::vector<std::string> order;
  std::map<std::string, std::string> flies, stopped;
  for (const json& c : view_.value("components", json::array()))
    for (const std::string& role : split(c.value("role", ""))) {
      if (std::find(order.begin(), order.end(), role) == order.end()) order.push_back(role);
      if (c.value("stopped", false))
        stopped[role] += " " + c.value("name", "");
      else if (c.value("active", false))
        flies[role] += " " + c.value("name", "");
    }
  std::string words;
  bool bad = false;
  for (const std::string& role : order) {
    words += (words.empty() ? "" : ", ") + role + (flies.contains(role) ? flies[role] : " nobody");
    if (stopped.contains(role)) words += " (stopped:" + stopped[role] + ")";
    bad = bad || !flies.contains(role) || stopped.contains(role);
  }
  return {"roles", one_line(words), bad ? Look::bad : Look::plain};
}

/// Component with the longest steps, and the one whose longest step exceeded its budget.
Dashboard::Cell Dashboard::steps() const {
  struct Step {
    std::string name;
    double mean_us, most_us, budget_us;
  };
  std::vector<Step> list;
  for (const json& c : view_.value("components", json::array()))
    if (c.value("steps", 0.0) > 0)
      list.push_back({c.value("name", ""), c.value("step_us", 0.0), c.value("step_max_us", 0.0),
                      c.value("budget_us", 0.0)});
  std::stable_sort(list.begin(), list.end(),
                   [](const Step& a, const Step& b) { return a.mean_us > b.mean_us; });
  constexpr std::size_t most = 4;
  if (list.size() > most) list.resize(most);
  std::string words;
  bool over = false;
  for (const Step& s : list) {
    words += (words.empty() ? "" : ", ") + s.name + " " + fixed(s.mean_us, s.mean_us < 10 ? 1 : 0) + " (" +
             fixed(s.most_us, 0) + ") us";
    if (s.budget_us > 0 && s.most_us > s.budget_us) {
      words += " of " + fixed(s.budget_us, 0);
      over = true;
    }
  }
  return {"slowest", words.empty() ? none : one_line(words), over ? Look::bad : Look::plain};
}

std::vector<Dashboard::Cell> Dashboard::words() const {
  std::vector<Cell> list = {control(), estimator(), sensors()};
  if (newest_.contains("SafetyState")) list.push_back(safety());
  list.push_back(roles());
  list.push_back(steps());
  return list;
}

std::string Dashboard::head() const {
  const double speed = view_.value("speed", 1.0);
  const std::string pace = view_.value("paused", false)     ? "paused"
                           : view_.value("io", "") != "sim" ? "hardware"
                           : speed == 1                     ? "real time"
                                                            : "speed " + speed_text(speed);
  const double now_s = static_cast<double>(view_.value("now_ns", std::int64_t{0})) * 1e-9;
  return one_line(view_.value("mission", "") + "  " + view_.value("phase", "") + "  " +
                  clock_text(std::max(now_s, now_s_)) + "  " +
                  (view_.value("armed", false) ? "armed" : "disarmed") + "  " + pace +
                  (view_.value("over", false) ? "  over" : ""));
}

std::string Dashboard::text(const PlotSize& size, const std::string& lost) const {
  const auto width = static_cast<std::size_t>(std::max(size.columns, 20)),
             most = static_cast<std::size_t>(std::max(size.rows, 4));
  const std::size_t across = std::max<std::size_t>(1, width / cell_width), room = width / across;
  const auto painted = [&](const std::string& text, Look look) {
    static constexpr const char* codes[] = {"", "\x1b[2m", "\x1b[32m", "\x1b[1;31m", "\x1b[1m"};
    if (!lost.empty() && look != Look::head) look = Look::faint;
    const char* code = codes[static_cast<std::size_t>(look)];
    return size.colours && *code ? code + text + "\x1b[0m" : text;
  };
  std::vector<std::string> lines;
  const auto put = [&](const std::string& name, const std::string& words, Look look) {
    bool first = true;
    for (const std::string& line : wrapped(words, width - std::min(width / 2, name_width))) {
      const std::string begin = padded(first ? name : "", std::min(width / 2, name_width));
      lines.push_back(painted(begin, Look::faint) + painted(line, look));
      first = false;
    }
  };
  for (const std::string& line : wrapped(lost.empty() ? head() : one_line("! " + lost), width))
    lines.push_back(painted(line, Look::head));

  // A cell that is too wide also takes the next column.
  std::size_t column = 0;
  for (const Cell& cell : cells()) {
    const std::size_t needs = name_width + width_of(cell.words) + 1,
                      taken = std::min(across, (needs + room - 1) / room);
    if (column == 0 || column + taken > across) {
      lines.emplace_back();
      column = 0;
    }
    const std::string words = first_of(cell.words, room * taken - name_width);
    lines.back() += painted(padded(cell.name, name_width), Look::faint) + painted(words, cell.look);
    column += taken;
    if (column < across)
      lines.back() += std::string(room * taken - name_width - width_of(words), ' ');
    else
      column = 0;
  }
  for (const Cell& cell : words()) put(cell.name, cell.words, cell.look);

  if (lines.size() + min_events > most) lines.resize(most - std::min(most, min_events));
  std::string text;
  for (std::string& line : lines) {
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  std::size_t left = most - lines.size();
  for (const Happened& event : events_)
    for (const std::string& line : wrapped(event.words, width)) {
      if (left == 0) return text;
      --left;
      text += painted(line, event.look) + "\n";
    }
  return text;
}

}  // namespace fulmar::core

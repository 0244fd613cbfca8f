// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_aero/import/airframe_yaml.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "tools/fulmar_aero/flight_model.hpp"
#include "tools/fulmar_aero/import/lines.hpp"
#include "tools/fulmar_aero/words.hpp"

namespace fulmar::aero::imports {
namespace {

constexpr double g0 = 9.80665, sea_level = 1.225;

/// Results of a trimmed flight.
struct Flown {
  double elevator = 0, aileron = 0, rudder = 0, throttle = 0.5;
  double slowest = 0, fastest = 0, climb = 2, sink = 1;
};

/// A comment is one line of printable characters, for any text of the files.
std::string comment(const std::string& text) {
  std::string out;
  for (const char c : text) out += c >= ' ' && c < 127 ? c : '?';
  return out;
}

std::string number(double x) { return figures(x, 7); }

std::string line(const std::string& key, const std::string& value, const std::string& why, int indent) {
  const std::string text = std::string(std::size_t(indent), ' ') + key + ": " + value;
  return (why.empty() ? text : padded(text, 30) + " # " + comment(why)) + "\n";
}

class Writer {
 public:
  Writer(const Aircraft& aircraft, std::vector<std::string>& assumptions)
      : a_(aircraft), assumed_(assumptions) {}

  std::string text(const Flown& flown, double cruise) {
    assumed_.clear();
    std::string out = head();
    out += line("name", quoted_name(), "", 0);
    out += value("mass", a_.mass_kg, " kg");
    out += "inertia:\n" + line("xx_kgm2", number(a_.xx.x), a_.xx.from, 2) +
           line("yy_kgm2", number(a_.yy.x), a_.yy.from, 2) + line("zz_kgm2", number(a_.zz.x), a_.zz.from, 2) +
           line("xz_kgm2", number(a_.xz.x), a_.xz.from, 2);
    out += wing() + aero() + parts(flown, cruise) + limits(flown, cruise) + gear();
    for (const Value* one : {&a_.mass_kg, &a_.xx, &a_.parasite})
      if (begins(one->from, "assumption"))
        assume(one == &a_.mass_kg ? "mass " + number(one->x) + " kg"
               : one == &a_.xx    ? "inertia"
                                  : "parasite drag " + number(one->x),
               one->from.substr(std::min<std::size_t>(12, one->from.size())));
    return out;
  }

 private:
  void assume(const std::string& what, const std::string& why) { assumed_.push_back(what + ": " + why); }

  std::string head() const {
    std::string out =
        "# Imported by `fulmar aero import`. Signs and equations: Beard & McLain, chapter 4; angles in "
        "coefficients are\n"
        "# radians. Behind each number stands the place that it is from.\n";
    for (const std::string& source : a_.sources) out += "# - " + comment(source) + "\n";
    for (const std::string& warning : a_.warnings) out += "# Doubtful: " + comment(warning) + "\n";
    for (const std::string& note : a_.notes) out += "# " + comment(note) + "\n";
    return out;
  }
  std::string quoted_name() const {
    std::string name;
    for (const char c : a_.name)
      if (name.size() < 31) name += std::isalnum(static_cast<unsigned char>(c)) && c > 0 ? c : '_';
    return "\"" + (name.empty() ? "imported" : name) + "\"";
  }
  std::string value(const std::string& key, const Value& of, const std::string& unit, int indent = 0) const {
    return line(key, number(of.x) + unit, of.from, indent);
  }

  std::string wing() {
    std::string out = "wing:\n" + value("area_m2", a_.area_m2, "", 2) + value("span", a_.span_m, " m", 2) +
                      value("chord", a_.chord_m, " m", 2) + value("oswald", a_.oswald, "", 2);
    if (a_.stall_alpha.known)
      return out + value("stall_alpha", a_.stall_alpha, " rad", 2) +
             value("stall_sharpness", a_.stall_sharpness, "", 2);
    assume("stall 15 deg, span efficiency 0.9", "usual; none of these tools knows the stall");
    return out + line("stall_alpha", "15 deg", "assumption, usual", 2) +
           line("stall_sharpness", "50", "assumption", 2);
  }

  std::string aero() const {
    constexpr std::array<std::pair<Force, const char*>, forces> tables{
        {{lift, "lift"}, {drag, "drag"}, {side, "side"}, {roll, "roll"}, {pitch, "pitch"}, {yaw, "yaw"}}};
    constexpr std::array<const char*, terms> names{"zero", "alpha",   "beta",     "p",      "q",
                                                   "r",    "aileron", "elevator", "rudder", "flap"};
    std::string out = "aero:\n" + value("parasite_drag", a_.parasite, "", 2);
    for (const auto& [force, table] : tables) {
      std::string rows;
      for (std::size_t term = 0; term < terms; ++term)
        if (const Value& one = a_.c[force][term]; one.known) rows += value(names[term], one, "", 4);
      if (!rows.empty()) out += std::string("  ") + table + ":\n" + rows;
    }
    return out + a_.more_aero;
  }

  bool acts(Term term) const {
    for (const auto& row : a_.c)
      if (row[term].known && row[term].x != 0) return true;
    return false;
  }

  std::string surface(const char* name, double trim) const {
    return std::string(name) +
           ": {limit: 25 deg, rate_limit: 300 deg/s, time_constant: 0.02 s, trim: " + figures(trim, 4) +
           " rad}\n";
  }

  /// A propeller disc (Beard & McLain, section 4.3) with a static thrust equal to the weight.
  std::string parts(const Flown& flown, double cruise) {
    if (!a_.parts.empty()) return a_.parts + trims(flown);
    const double exit = 2.5 * cruise, area = a_.mass_kg.x * g0 / (0.5 * sea_level * exit * exit);
    assume("propulsion", "a disc with the weight as thrust at rest; put in your motor and propeller");
    assume("throws 25 deg, servos 300 deg/s", "usual; put in yours");
    std::string out =
        "# Assumptions: a disc that gives the weight as thrust at rest; usual throws and servos. Put "
        "in yours.\n";
    out += "propulsion:\n  disc: {area: " + number(area) +
           " m^2, efficiency: 1, exit_speed: " + number(exit) +
           " m/s, torque: 0, speed: 800 rad/s}\n  battery: 14.8 V\n  time_constant: 0.1 s\n";
    if (a_.elevons || a_.v_tail) out += std::string("mixer: ") + (a_.elevons ? "elevons" : "v_tail") + "\n";
    out += surface("aileron", flown.aileron) + surface("elevator", flown.elevator);
    out += acts(t_rudder) ? surface("rudder", flown.rudder)
                          : "rudder: {limit: 0 rad}  # there is none in the files\n";
    if (acts(t_flap)) out += "flap: {limit: 30 deg}\n";
    return out;
  }

  /// Surfaces of the source: `parts` ends in open lines "aileron: {limit: ...".
  std::string trims(const Flown& flown) const {
    return "aileron:  {" + a_.surfaces + ", trim: " + figures(flown.aileron, 4) + " rad}\nelevator: {" +
           a_.surfaces + ", trim: " + figures(flown.elevator, 4) + " rad}\n" +
           (acts(t_rudder) ? "rudder:   {" + a_.surfaces + ", trim: " + figures(flown.rudder, 4) + " rad}\n"
                           : "rudder:   {limit: 0 rad}\n");
  }

  std::string limits(const Flown& flown, double cruise) {
    assume("airspeeds " + figures(flown.slowest) + ", " + figures(cruise) + ", " + figures(flown.fastest) +
               " m/s, bank 45 deg, climb and sink",
           "what this model flies; choose yours under limits");
    return "limits:  # assumptions: what this model flies, with a margin\n" +
           line("airspeed_min", figures(flown.slowest) + " m/s", "", 2) +
           line("airspeed_cruise", figures(cruise, 4) + " m/s", "", 2) +
           line("airspeed_max", figures(flown.fastest) + " m/s", "", 2) +
           "  roll_max: 45 deg\n  pitch_max: 20 deg\n  pitch_min: -20 deg\n" +
           line("climb_rate_max", figures(flown.climb, 2) + " m/s", "", 2) +
           line("sink_rate_max", figures(flown.sink, 2) + " m/s", "", 2) +
           line("throttle_cruise", figures(flown.throttle, 3), "", 2);
  }
  std::string gear() {
    assume("gear", "a tricycle in proportion to the span");
    const double b = a_.span_m.x;
    return "gear: {height: " + figures(0.11 * b) + " m, length: " + figures(0.29 * b) +
           " m, track: " + figures(0.22 * b) +
           " m, rolling_friction: 0.05, side_friction: 0.6}  # assumption\n";
  }

  const Aircraft& a_;
  std::vector<std::string>& assumed_;
};

void complete(Aircraft& a) {
  if (!a.mass_kg.known) {
    a.mass_kg = {8 * a.area_m2.x,
                 "assumption: 8 kg/m2 of wing, it is in none of the files (--mass, or a mass table)"};
    a.warnings.push_back("the mass is in none of the files; taken are " + figures(a.mass_kg.x) +
                         " kg, 8 kg/m2 of wing: say yours with --mass");
  }
  if (!a.xx.known) {
    const double b2 = a.mass_kg.x * a.span_m.x * a.span_m.x;
    const std::string why =
        "assumption: usual radius of gyration, of the span 0.115, 0.14, 0.18 (--inertia, or a mass table)";
    a.xx = {0.115 * 0.115 * b2, why};
    a.yy = {0.14 * 0.14 * b2, why};
    a.zz = {0.18 * 0.18 * b2, why};
    a.xz = {0, "assumption"};
  }
}

double flow_speed(const Aircraft& a, double CL) {
  return std::sqrt(2 * a.mass_kg.x * g0 / (sea_level * a.area_m2.x * CL));
}

/// The given airspeed. Else that of the files, if the wing carries the weight with it and CL is at most 0.5,
/// some 1.6 times the stall speed. Else that of CL 0.5.
double cruise_of(const Aircraft& a, const ImportOptions& options) {
  if (options.cruise_mps > 0) return options.cruise_mps;
  const double usual = flow_speed(a, 0.5), fast = flow_speed(a, 0.15);
  return a.cruise_mps < fast ? std::max(usual, a.cruise_mps) : usual;
}

Flown flown_of(const Airframe& airframe, double cruise) {
  Flown f;
  const AircraftModel model(airframe, 0);
  const double stall_CL = std::max(0.3, max_lift(airframe).coefficient);
  const double stall = std::sqrt(2 * airframe.mass_kg * g0 / (sea_level * airframe.wing.area_m2 * stall_CL));
  f.slowest = std::min(1.2 * stall, 0.95 * cruise);
  f.fastest = 1.6 * cruise;
  const SteadyFlight level = fly(model, {cruise});
  if (!level.found()) return f;
  f.elevator = level.input(model::elevator);
  f.aileron = level.input(model::aileron);
  f.rudder = level.input(model::rudder);
  f.throttle = level.input(model::throttle);
  while (f.slowest < 0.95 * cruise && !fly(model, {f.slowest}).found())
    f.slowest = std::min(1.03 * f.slowest, 0.951 * cruise);
  while (f.fastest > 1.05 * cruise && !fly(model, {f.fastest}).found()) f.fastest *= 0.97;
  const auto max_rate = [&](double sign, double part) {  // of the steepest steady flight
    double steepest = 0;
    for (int tenths = 1; tenths <= 40; ++tenths) {
      const double angle = sign * 0.01 * tenths;
      if (!fly(model, {cruise, angle}).found()) break;
      steepest = std::abs(angle);
    }
    return std::clamp(part * cruise * std::sin(steepest), 0.3, 5.0);
  };
  f.climb = max_rate(1, 0.5);
  f.sink = max_rate(-1, 0.8);  // a good glider needs most of it to land
  return f;
}

}  // namespace

Imported written(Aircraft aircraft, const ImportOptions& options, const std::string& name) {
  Imported out;
  complete(aircraft);
  out.aircraft = std::move(aircraft);
  const double cruise = cruise_of(out.aircraft, options);
  Writer writer(out.aircraft, out.assumptions);
  Flown flown;
  flown.slowest = 0.7 * cruise;
  flown.fastest = 1.5 * cruise;
  flown = flown_of(airframe_of_text(writer.text(flown, cruise), name).airframe, cruise);
  out.text = writer.text(flown, cruise);
  out.file = airframe_of_text(out.text, name);
  return out;
}

}  // namespace fulmar::aero::imports

// SPDX-License-Identifier: BSD-3-Clause
#include "core/graph/test/shelf.hpp"

#include <unistd.h>

#include <fstream>
#include <limits>
#include <stdexcept>

#include "core/graph/messages.hpp"
#include "core/graph/test/shelf_types.hpp"
#include "core/types/named.hpp"
#include "fulmar/msg/actuators.hpp"
#include "fulmar/msg/airframe.hpp"
#include "fulmar/msg/attitude_command.hpp"
#include "fulmar/msg/baro.hpp"
#include "fulmar/msg/gnss.hpp"
#include "fulmar/msg/guidance_command.hpp"
#include "fulmar/msg/imu.hpp"
#include "fulmar/msg/mag.hpp"
#include "fulmar/msg/origin.hpp"
#include "fulmar/msg/path.hpp"
#include "fulmar/msg/pitot.hpp"
#include "fulmar/msg/plan.hpp"
#include "fulmar/msg/plan_edit.hpp"
#include "fulmar/msg/progress.hpp"
#include "fulmar/msg/rc.hpp"
#include "fulmar/msg/vehicle_state.hpp"
#include "fulmar/msg/vehicle_status.hpp"

namespace fulmar::core::test {

ComponentInfo& Shelf::add(const std::string& plugin, const std::string& name, std::vector<Port> inputs,
                          std::vector<Port> outputs, std::vector<ParamInfo> params) {
  auto& info = plugins[plugin];
  if (!info) info = std::make_shared<PluginInfo>();
  info->file = plugin + ".so";
  ComponentInfo component;
  component.name = name;
  component.inputs = std::move(inputs);
  component.outputs = std::move(outputs);
  component.params = std::move(params);
  info->components.push_back(std::move(component));
  return info->components.back();
}

FoundPlugin Shelf::open(const std::string& name) {
  const std::string stem = name.ends_with(".so") ? name.substr(0, name.size() - 3) : name;
  const auto it = plugins.find(stem);
  if (it != plugins.end()) return {it->second, nullptr};
  std::vector<std::string> names;
  for (const auto& [key, info] : plugins) names.push_back(key);
  throw Error(graph_messages::plugin_unknown(name, "shelf", choices_text(name, names)));
}

Shelf::Shelf() {
  constexpr double inf = std::numeric_limits<double>::infinity();
  const auto sensors = [] {
    return std::vector<Port>{in<Imu>("imu"), in<Gnss>("gnss"), in<Mag>("mag"), in<Baro>("baro"),
                             in<Pitot>("pitot")};
  };
  const auto vehicle_out = [] {
    return std::vector<Port>{out<Imu>("imu"),
                             out<Gnss>("gnss", FULMAR_OUT_EVENT),
                             out<Mag>("mag", FULMAR_OUT_EVENT),
                             out<Baro>("baro", FULMAR_OUT_EVENT),
                             out<Pitot>("pitot", FULMAR_OUT_EVENT),
                             out<Rc>("rc"),
                             out<VehicleStatus>("status")};
  };
  ParamInfo wind;
  wind.name = "wind_ned";
  wind.unit = "m/s";
  wind.kind = FULMAR_VECTOR;
  wind.type = type_of<Vec3<Ned>>();
  wind.min = -30;
  wind.max = 30;
  wind.live = true;
  auto outputs = vehicle_out();
  outputs.push_back(out<VehicleState>("truth"));
  add("sim_aero", "Aircraft", {in<Actuators>("actuators")}, outputs,
      {number("rate", 400, "Hz", 50, 2000, false), number("epoch", 0, "s", 0, 1e10, false), wind,
       choice("turbulence", {"none", "light", "moderate"}), record<Airframe>("airframe", true),
       record<Origin>("origin", false)})
      .vehicle = true;
  ParamInfo device;
  device.name = "port";
  device.kind = FULMAR_STRING;
  device.initial_text = "/dev/ttyACM0";
  device.capacity = 16;
  add("fcu_serial", "Fcu", {in<Actuators>("actuators")}, vehicle_out(),
      {device, record<Airframe>("airframe", true)})
      .vehicle = true;
  ParamInfo count;
  count.name = "skip";
  count.kind = FULMAR_COUNT;
  count.min = 0;
  count.max = 10;
  ParamInfo flag;
  flag.name = "use_mag";
  flag.kind = FULMAR_FLAG;
  flag.initial[0] = 1;
  flag.live = true;
  auto ekf_in = sensors();
  ekf_in.push_back(optional<VehicleStatus>("status"));
  add("estimator_ekf", "Ekf", ekf_in, {out<VehicleState>("state", FULMAR_OUT_EVENT)},
      {flag, count, number("gate", 20 * 3.14159265358979 / 180, "rad", 0, 1),
       record<Origin>("origin", false)});
  add("sim_aero", "TruthState", {in<VehicleState>("truth")}, {out<VehicleState>("state")});
  add("path", "Planner",
      {optional<VehicleState>("state"), port<PlanEdit>("edits", FULMAR_IN_QUEUE),
       port<PlanEdit>("edit", FULMAR_IN_REQUEST)},
      {out<Plan>("plan", FULMAR_OUT_EVENT)}, {record<Plan>("plan", false), record<Origin>("origin", false)});
  add("path", "Manager", {in<VehicleState>("state"), in<Plan>("plan")},
      {out<Path>("path"), out<Progress>("progress")});
  add("path", "VectorField", {in<VehicleState>("state"), in<Path>("path")}, {out<GuidanceCommand>("command")},
      {number("chi_inf", 1.2, "rad", 0, 1.5707963), number("k_path", 0.05, "1/m", 0, inf)});
  Port probe;
  probe.name = "roll_error_rad";
  probe.kind = FULMAR_OUT_PROBE;
  for (const char* plugin : {"control_slc", "control_tecs", "my_law"})
    add(plugin, "Outer", {in<VehicleState>("state"), in<GuidanceCommand>("command")},
        {out<AttitudeCommand>("attitude")},
        {number("course_kp", 0.9, "rad/rad", 0, 3), choice("law", {"normal", "takeoff"}),
         number("span", 1, "m", 0.1, 10, false), record<Airframe>("airframe", false)});
  add("control_slc", "Inner", {in<VehicleState>("state"), in<AttitudeCommand>("attitude")},
      {out<Actuators>("actuators"), probe},
      {number("roll_kp", 0.55, "rad/rad", 0, 2), number("roll_limit", 0.7853981634, "rad", 0, 1.0471975512),
       record<Airframe>("airframe", true)});
  ParamInfo epoch;
  epoch.name = "epoch";
  epoch.kind = FULMAR_COUNT;
  epoch.min = 0;
  epoch.max = 4e9;
  add("score", "Score",
      {in<VehicleState>("state"), optional<VehicleState>("truth"), in<Path>("path"),
       in<GuidanceCommand>("command"), in<AttitudeCommand>("attitude")},
      {out<Progress>("tracking"), out<Progress>("estimation")}, {epoch});
}

Folder::Folder() {
  static int number = 0;
  path = std::filesystem::temp_directory_path() /
         ("fulmar_graph_" + std::to_string(::getpid()) + "_" + std::to_string(number++));
  std::filesystem::create_directories(path);
}

Folder::~Folder() {
  std::error_code code;
  std::filesystem::remove_all(path, code);
}

std::string Folder::write(const std::string& name, const std::string& text) const {
  std::filesystem::create_directories((path / name).parent_path());
  std::ofstream(path / name, std::ios::binary) << text;
  return (path / name).string();
}

const char* const anaconda = R"(name: Anaconda
mass: 4.5 kg
wing: {area_m2: 0.55, span: 2.9 m, chord: 19 cm, stall_alpha: 15 deg, oswald: 0.9}
inertia: {xx_kgm2: 0.8, yy_kgm2: 1.1, zz_kgm2: 1.8}
aero: {lift: {alpha: 5.6}, pitch: {alpha: -2.7}}
propulsion: {ct0: 0.09}
aileron: {limit: 20 deg, reversed: true}
elevator: {limit: 20 deg}
rudder: {limit: 20 deg}
params:
  control_slc/Inner: {roll_kp: 0.7}
  control_tecs: {course_kp: 1.1}
  control_lqr/Outer: {q: 3}
)";

const char* const all_but_mass = R"(wing: {area_m2: 0.55, span: 2.9 m, chord: 19 cm}
inertia: {xx_kgm2: 0.8, yy_kgm2: 1.1, zz_kgm2: 1.8}
aero: {lift: {alpha: 5.6}, pitch: {alpha: -2.7}}
propulsion: {ct0: 0.09}
aileron: {limit: 20 deg}
elevator: {limit: 20 deg}
rudder: {limit: 20 deg}
)";

const char* const hourglass_plan = R"(end: circuit
turn_radius: 50 m
airspeed: 17 m/s
waypoints:
  - {position_m: [400, -250, -70]}
  - {position: [-400 m, -50 m, -70 m]}
  - {position_m: {north: -400, east: -250, down: -70}, course: 90 deg}
)";

const char* const hourglass = R"(mission: hourglass
io: sim
airframe: anaconda.yaml
origin: {lat: 40.2463724, lon: -111.6474138, alt_msl: 1387 m}
rate: 400 Hz
seed: 7
arm: auto
done: "manage.progress.circuits >= 2"
progress: [nav.state.height_m, nav.state.airspeed_mps, manage.progress.item, attitude.roll_error_rad]
summary: {tracking_rmse: score.tracking, estimation_rmse: score.estimation}
failsafe: {throttle_frac: 0, for: 2 s}

roles:
  vehicle: {in: {actuators: inner.actuators}, out: {imu: Imu, gnss: Gnss, mag: Mag, baro: Baro, pitot: Pitot, rc: Rc, status: VehicleStatus, truth?: VehicleState}}
  nav:     {in: {imu: vehicle.imu, gnss: vehicle.gnss, mag: vehicle.mag, baro: vehicle.baro, pitot: vehicle.pitot}, out: {state: VehicleState}}
  guide:   {in: {state: nav.state, path: manage.path}, out: {command: GuidanceCommand}}
  outer:   {in: {state: nav.state, command: guide.command}, out: {attitude: AttitudeCommand}}
  inner:   {in: {state: nav.state, attitude: outer.attitude}, out: {actuators: Actuators}}

components:
  sim:    {fills: vehicle, use: sim_aero, params: {wind_ned: [3, -4, 0], turbulence: light}}
  fcu:    {fills: vehicle, use: fcu_serial, params: {port: /dev/ttyACM0}}
  ekf:    {fills: nav, use: estimator_ekf, in: {status: vehicle.status}}
  truth:  {fills: nav, use: sim_aero/TruthState, in: {truth: vehicle.truth}, only: sim}
  plan:   {use: path/Planner, params: {plan: plans/hourglass.yaml}}
  manage: {use: path/Manager, in: {state: nav.state, plan: plan.plan}}
  follow: {fills: guide, use: path/VectorField, rate: 100 Hz}
  slc:    {fills: outer, use: control_slc/Outer, rate: 100 Hz}
  tecs:   {fills: outer, use: control_tecs/Outer, rate: 100 Hz}
  attitude: {fills: inner, use: control_slc/Inner, rate: 100 Hz}
  mine:   {fills: outer, use: my_law.so, rate: 100 Hz}
  score:  {use: score, in: {state: nav.state, truth: vehicle.truth, path: manage.path, command: guide.command, attitude: outer.attitude}}

phases:
  any:      {next: [{to: hold, when: "vehicle.status.override"}]}
  hold:     {outer: slc, next: [{to: takeoff, when: "vehicle.status.armed and nav.state.height_m < 3 m"}, {to: cruise, when: "nav.state.height_m > 20 m"}]}
  takeoff:  {outer: {use: slc, set: {law: takeoff}}, next: [{to: cruise, when: "nav.state.height_m > 30 m", for: 0.5 s}]}
  cruise:   {outer: tecs, next: [{to: research, when: "vehicle.rc.aux1_frac > 0.5", for: 0.2 s}]}
  research: {outer: {use: mine, fallback: tecs}, next: [{to: cruise, when: "vehicle.rc.aux1_frac < 0.5"}]}
)";

Mission::Mission() {
  folder.write("anaconda.yaml", anaconda);
  folder.write("plans/hourglass.yaml", hourglass_plan);
}

Mission& Mission::replace(const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  if (at == std::string::npos) throw std::runtime_error("the test's text is not there: " + from);
  text.replace(at, from.size(), to);
  return *this;
}

Graph Mission::load(const Overrides& overrides) {
  return load_mission(folder.write("hourglass.yaml", text), overrides, shelf);
}

std::string Mission::faults(const Overrides& overrides) {
  try {
    load(overrides);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

std::string changed(const std::string& from, const std::string& to) {
  Mission mission;
  std::string text = mission.replace(from, to).faults();
  for (auto at = text.find("hourglass.yaml:"); at != std::string::npos; at = text.find("hourglass.yaml:", at))
    if (at == 0 || text[at - 1] == '\n')
      text.erase(at, 15);
    else
      ++at;
  return text;
}

int index_of(const Graph& graph, const std::string& name) { return index_named(graph.components, name); }
const Component& component(const Graph& graph, const std::string& name) {
  return nth(graph.components, index_of(graph, name));
}
const ParamValue& param(const Graph& graph, const std::string& owner, const std::string& name) {
  const Component& c = component(graph, owner);
  return nth(c.params, c.info().param(name));
}
const Wire& wire(const Graph& graph, const std::string& owner, const std::string& input) {
  const Component& c = component(graph, owner);
  return nth(c.wires, c.info().input(input));
}
std::string names(const Graph& graph, const std::vector<int>& indices) {
  std::vector<std::string> list;
  for (const int i : indices) list.push_back(nth(graph.components, i).name);
  return join(list);
}

}  // namespace fulmar::core::test

// SPDX-License-Identifier: BSD-3-Clause
// Topics by message type, since a mission names its roles freely.
import type { Message, Value } from "./protocol/schema";
import { number_at } from "./protocol/schema";
import { type Source, topic_of_type } from "./source";
import type { Plan, Waypoint } from "./flight/route";

export interface Names {
  state: string;
  truth: string;
  plan: string;
  path: string;
  progress: string;
  command: string;
  attitude: string;
  actuators: string;
  status: string;
  health: string;
  gnss: string;
  rc: string;
  link: string;
  safety: string;
  ground: string;
  contact: string;
}

export function names_of(source: Source): Names {
  const first = (type: string) => topic_of_type(source, type);
  const is_truth = (name: string) => name.includes("truth");
  const state = topic_of_type(source, "VehicleState", (t) => t.name.endsWith("/state"));
  return {
    state: state || topic_of_type(source, "VehicleState", (t) => !is_truth(t.name)),
    truth: topic_of_type(source, "VehicleState", (t) => is_truth(t.name)),
    plan: first("Plan"),
    path: first("Path"),
    progress: first("Progress"),
    command: first("GuidanceCommand"),
    attitude: first("AttitudeCommand"),
    actuators: first("Actuators"),
    status: first("VehicleStatus"),
    health: first("NavigationHealth"),
    gnss: first("Gnss"),
    rc: first("Rc"),
    link: first("LinkState"),
    safety: first("SafetyState"),
    ground: first("GroundState"),
    contact: first("ContactTruth"),
  };
}

export interface State {
  n: number;
  e: number;
  up: number;
  roll: number;
  pitch: number;
  yaw: number;
  course: number;
  ground: number;
  air: number;
  climb: number;
  wind_n: number;
  wind_e: number;
  valid: {
    attitude: boolean;
    position: boolean;
    height: boolean;
    airspeed: boolean;
    velocity: boolean;
    wind: boolean;
  };
}
export function state_of(m: Message | undefined): State | null {
  if (!m) return null;
  const x = (path: string) => number_at(m, path) ?? NaN;
  return {
    n: x("position_m.north"),
    e: x("position_m.east"),
    up: x("height_m"),
    roll: x("roll_rad"),
    pitch: x("pitch_rad"),
    yaw: x("yaw_rad"),
    course: x("course_rad"),
    ground: x("ground_speed_mps"),
    air: x("airspeed_mps"),
    climb: x("climb_rate_mps"),
    wind_n: x("wind_mps.north"),
    wind_e: x("wind_mps.east"),
    valid: {
      attitude: m.attitude_valid === true,
      position: m.position_valid === true,
      height: m.height_valid === true,
      airspeed: m.airspeed_valid === true,
      velocity: m.velocity_valid === true,
      wind: m.wind_valid === true,
    },
  };
}

function waypoint_of(value: Value): Waypoint {
  const m = value as Message;
  const x = (path: string) => number_at(m, path) ?? NaN;
  return {
    north: x("position_m.north"),
    east: x("position_m.east"),
    up: -x("position_m.down"),
    course: m.has_course === true ? x("course_rad") : null,
    airspeed: x("airspeed_mps"),
    id: x("id"),
    geodetic: null,
  };
}
export function plan_of(m: Message | undefined): Plan | null {
  if (!m || !Array.isArray(m.waypoints)) return null;
  return {
    end: m.end === "orbit" ? "orbit" : "circuit",
    radius: number_at(m, "turn_radius_m") ?? 50,
    airspeed: number_at(m, "airspeed_mps") ?? 15,
    waypoints: m.waypoints.map(waypoint_of),
  };
}

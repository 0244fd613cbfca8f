// SPDX-License-Identifier: BSD-3-Clause
// 3-D view from behind: attitude, surfaces, track, the plan at its heights. Loaded after the rest of the page. Scene axes: x east, y up, z south, so that a body axis of NED is (e, -d, -n).
import {
  AmbientLight,
  BoxGeometry,
  BufferAttribute,
  BufferGeometry,
  Color,
  ConeGeometry,
  CylinderGeometry,
  DirectionalLight,
  Fog,
  GridHelper,
  Group,
  Line,
  LineBasicMaterial,
  Matrix4,
  Mesh,
  MeshLambertMaterial,
  PerspectiveCamera,
  PlaneGeometry,
  Scene,
  Vector3,
  WebGLRenderer,
} from "three";
import { colours } from "../dom";
import { type Plan, Route } from "../flight/route";
import type { State } from "../names";

// Largest share of the time for drawing, measured at intervals: without a graphics card the processor draws.
const share = 0.12,
  measure_every = 20,
  shortest_ms = 33,
  longest_ms = 1000;
const most_trail = 3000,
  jump_m = 100,
  behind_m = 9,
  above_m = 3;

export interface Surfaces {
  aileron: number;
  elevator: number;
  rudder: number;
  throttle: number; // rad; 0 to 1
}

interface Model {
  body: Group;
  left: Group;
  right: Group;
  elevator: Group;
  rudder: Group;
  propeller: Mesh;
}

/** In body axes x forward, y right, z down, 3 m of span; `scale` makes it visible. */
function aircraft(): Model {
  const body = new Group();
  const skin = new MeshLambertMaterial({ color: 0xf2f2f2 }),
    band = new MeshLambertMaterial({ color: 0xe69f00 });
  const dark = new MeshLambertMaterial({ color: 0x333333 }),
    moving = new MeshLambertMaterial({ color: 0x0072b2 });
  const box = (
    l: number,
    w: number,
    h: number,
    x: number,
    y: number,
    z: number,
    m = skin,
    to: Group = body,
  ) => {
    const mesh = new Mesh(new BoxGeometry(l, w, h), m);
    mesh.position.set(x, y, z);
    to.add(mesh);
    return mesh;
  };
  const hinge = (x: number, y: number, z: number) => {
    const group = new Group();
    group.position.set(x, y, z);
    body.add(group);
    return group;
  };
  const tube = new Mesh(new CylinderGeometry(0.05, 0.14, 1.5, 12), skin);
  tube.rotation.z = Math.PI / 2;
  tube.position.set(-0.35, 0, 0);
  body.add(tube);
  const nose = new Mesh(new ConeGeometry(0.14, 0.35, 12), band);
  nose.rotation.z = -Math.PI / 2;
  nose.position.set(0.57, 0, 0);
  body.add(nose);
  box(0.34, 3, 0.04, 0, 0, -0.1);
  box(0.34, 0.3, 0.045, 0, 1.36, -0.1, band);
  box(0.34, 0.3, 0.045, 0, -1.36, -0.1, band);
  box(0.2, 0.86, 0.03, -1.0, 0, -0.02);
  box(0.22, 0.03, 0.32, -1.0, 0, -0.2);
  const flap = (x: number, y: number, z: number, length: number, width: number, height: number) => {
    const group = hinge(x, y, z);
    box(length, width, height, -length / 2, 0, 0, moving, group);
    return group;
  };
  const right = flap(-0.17, 0.85, -0.1, 0.12, 0.7, 0.03),
    left = flap(-0.17, -0.85, -0.1, 0.12, 0.7, 0.03);
  const elevator = flap(-1.1, 0, -0.02, 0.12, 0.86, 0.025),
    rudder = flap(-1.11, 0, -0.2, 0.12, 0.025, 0.32);
  const propeller = box(0.02, 0.62, 0.05, 0.76, 0, 0, dark);
  return { body, left, right, elevator, rudder, propeller };
}

export class Chase {
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly camera = new PerspectiveCamera(55, 1, 0.5, 6000);
  private readonly model = aircraft();
  private readonly trail = new BufferGeometry();
  private readonly trail_points = new Float32Array(3 * most_trail);
  private trail_count = 0;
  private readonly ground: Group;
  private plan_line: Line | null = null;
  private drawn_plan: Plan | null = null;
  private heading = NaN;
  private scheme = "";
  private pictures = 0;
  private last_ms = 0;
  private period_ms = shortest_ms;

  /** Throws when there is no WebGL. */
  constructor(private readonly canvas: HTMLCanvasElement) {
    this.renderer = new WebGLRenderer({ canvas, antialias: window.devicePixelRatio < 2 });
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio || 1, 2));
    this.scene.add(new AmbientLight(0xffffff, 1.6));
    const sun = new DirectionalLight(0xffffff, 2);
    sun.position.set(300, 800, 200);
    this.scene.add(sun, this.model.body);
    this.model.body.matrixAutoUpdate = false;
    this.ground = new Group();
    const plane = new Mesh(new PlaneGeometry(12000, 12000), new MeshLambertMaterial({ color: 0x5b7a4a }));
    plane.rotation.x = -Math.PI / 2;
    plane.position.y = -0.4;
    this.ground.add(plane, new GridHelper(4000, 80, 0x2b3d24, 0x34492b));
    this.scene.add(this.ground);
    this.trail.setAttribute("position", new BufferAttribute(this.trail_points, 3));
    const line = new Line(this.trail, new LineBasicMaterial({ color: 0x56b4e9 }));
    line.frustumCulled = false;
    this.scene.add(line);
  }

  private sky(): void {
    const sky = colours.get("sky3d");
    if (sky === this.scheme) return;
    this.scheme = sky;
    this.scene.background = new Color(sky);
    this.scene.fog = new Fog(new Color(sky), 400, 2500);
  }

  private add_trail(s: State): void {
    const last = 3 * (this.trail_count - 1),
      [x = s.e, , z = -s.n] = this.trail_points.subarray(Math.max(0, last), Math.max(0, last) + 3);
    if (this.trail_count > 0 && Math.hypot(x - s.e, z + s.n) > jump_m) this.trail_count = 0; // another time or place
    if (this.trail_count === most_trail) {
      this.trail_points.copyWithin(0, 3 * 500);
      this.trail_count -= 500;
    }
    this.trail_points.set([s.e, s.up, -s.n], 3 * this.trail_count++);
    this.trail.setDrawRange(0, this.trail_count);
    (this.trail.getAttribute("position") as BufferAttribute).needsUpdate = true;
  }

  private show_plan(plan: Plan | null): void {
    if (plan === this.drawn_plan) return;
    this.drawn_plan = plan;
    if (this.plan_line) this.scene.remove(this.plan_line);
    this.plan_line = null;
    if (!plan) return;
    const points: Vector3[] = [];
    for (const leg of new Route(plan).legs()) {
      const to = plan.waypoints[leg.to]?.up ?? 0;
      const from = plan.waypoints[leg.to > 0 ? leg.to - 1 : plan.waypoints.length - 1]?.up ?? to;
      leg.points.forEach((p, i) =>
        points.push(new Vector3(p.e, from + ((to - from) * i) / Math.max(1, leg.points.length - 1), -p.n)),
      );
    }
    this.plan_line = new Line(
      new BufferGeometry().setFromPoints(points),
      new LineBasicMaterial({ color: 0xe69f00 }),
    );
    this.scene.add(this.plan_line);
  }

  draw(s: State | null, surfaces: Surfaces | null, plan: Plan | null): void {
    const width = this.canvas.clientWidth,
      height = this.canvas.clientHeight;
    const begun = performance.now();
    if (!s || width === 0 || height === 0 || begun - this.last_ms < this.period_ms) return;
    this.last_ms = begun;
    this.sky();
    this.show_plan(plan);
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    const [cr, sr, cp, sp, cy, sy] = [
      Math.cos(s.roll),
      Math.sin(s.roll),
      Math.cos(s.pitch),
      Math.sin(s.pitch),
      Math.cos(s.yaw),
      Math.sin(s.yaw),
    ];
    // columns of the rotation from body to NED: Beard & McLain (2.5), transposed
    const x = [cp * cy, cp * sy, -sp],
      y = [sr * sp * cy - cr * sy, sr * sp * sy + cr * cy, sr * cp];
    const z = [cr * sp * cy + sr * sy, cr * sp * sy - sr * cy, cr * cp];
    const axis = (c: number[]) => new Vector3(c[1], -(c[2] as number), -(c[0] as number));
    this.model.body.matrix = new Matrix4()
      .makeBasis(axis(x), axis(y), axis(z))
      .setPosition(s.e, Math.max(s.up, 0.2), -s.n);
    if (surfaces) {
      // a positive rotation about y (right) raises the nose and lowers a trailing edge
      this.model.right.rotation.y = -surfaces.aileron * -1;
      this.model.left.rotation.y = -surfaces.aileron;
      this.model.elevator.rotation.y = -surfaces.elevator * -1;
      this.model.rudder.rotation.z = surfaces.rudder;
      this.model.propeller.rotation.x += 0.3 + surfaces.throttle;
    }
    this.add_trail(s);
    // the ground moves with the aircraft in steps of one square
    this.ground.position.set(Math.round(s.e / 50) * 50, 0, -Math.round(s.n / 50) * 50);
    const to = s.valid.velocity && s.ground > 2 ? s.course : s.yaw;
    if (Number.isNaN(this.heading)) this.heading = to;
    const turn = Math.atan2(Math.sin(to - this.heading), Math.cos(to - this.heading));
    this.heading += Math.min(1, 0.0024 * this.period_ms) * turn;
    this.camera.position.set(
      s.e - behind_m * Math.sin(this.heading),
      Math.max(s.up + above_m, 1.5),
      -s.n + behind_m * Math.cos(this.heading),
    );
    this.camera.lookAt(s.e, s.up + 0.6, -s.n);
    this.renderer.render(this.scene, this.camera);
    if (this.pictures++ % measure_every !== 1) return; // the first frame takes longer
    const g = this.renderer.getContext();
    g.readPixels(0, 0, 1, 1, g.RGBA, g.UNSIGNED_BYTE, new Uint8Array(4)); // waits for the end of drawing
    this.period_ms = Math.min(longest_ms, Math.max(shortest_ms, (performance.now() - begun) / share));
  }
}

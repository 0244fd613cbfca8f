// SPDX-License-Identifier: BSD-3-Clause
// Layout of the components of a mission, and lines from outputs to inputs: layers from left to right, by the longest path
// to each (Sugiyama, Tagawa & Toda, 1981), and between the boxes, never through one.

export interface Part {
  name: string;
  role: string;
  inputs: { name: string; source?: string }[];
  outputs: { name: string; type: string }[];
}
export interface Box {
  name: string;
  layer: number;
  row: number;
  x: number;
  y: number;
  width: number;
  height: number;
}
export interface Wire {
  source: string; // "nav.state"
  from: string; // a component that publishes it
  to: string;
  input: string;
  points: [number, number][]; // corners, from the output to the input
}
export interface Drawing {
  width: number;
  height: number;
  boxes: Box[];
  wires: Wire[];
}

/** Pixels: width of a letter of the names and of the small lines, distance between lines. */
export const name_letter = 7.2,
  small_letter = 5.9;
const pitch = 4,
  box_height = 52,
  margin = 8,
  least_width = 106,
  pin_gap = 4,
  apart = 1.7;
const roles_of = (part: Part) => part.role.split(", ").filter(Boolean);

interface Net {
  source: string;
  from: Part[];
  readers: { part: Part; input: string }[];
}

/** One for each connected output port. The components of a role share its ports. */
function nets_of(parts: Part[]): Net[] {
  const nets = new Map<string, Net>();
  for (const part of parts)
    for (const { name, source } of part.inputs) {
      if (!source) continue;
      const [owner = "", port = ""] = source.split(/\.(.*)/);
      let net = nets.get(source);
      if (!net) {
        const from = parts.filter(
          (p) => (p.name === owner || roles_of(p).includes(owner)) && p.outputs.some((o) => o.name === port),
        );
        nets.set(source, (net = { source, from, readers: [] }));
      }
      net.readers.push({ part, input: name });
    }
  return [...nets.values()].filter((n) => n.from.length > 0);
}

/** The layer of each component. Closed loops of connections, as through the vehicle, start at the vehicle. */
function layers_of(parts: Part[], nets: Net[]): Map<string, number> {
  const key = (p: Part) => p.role || p.name; // the components of a role share a layer
  const groups = [...new Set(parts.map(key))];
  const before = new Map(groups.map((g) => [g, new Set<string>()]));
  for (const net of nets)
    for (const from of net.from)
      for (const { part } of net.readers) if (key(from) !== key(part)) before.get(key(part))?.add(key(from));
  const vehicle = parts.find((p) => p.outputs.some((o) => o.type.endsWith("/VehicleStatus")));
  const layer = new Map<string, number>();
  while (layer.size < groups.length) {
    const left = groups.filter((g) => !layer.has(g));
    const open = (g: string) => [...(before.get(g) ?? [])].filter((b) => !layer.has(b)).length;
    const free = left.filter((g) => open(g) === 0);
    const stuck = vehicle && !layer.has(key(vehicle)) ? [key(vehicle)] : left.slice(0, 1);
    for (const g of layer.size === 0 ? stuck : free.length > 0 ? free : stuck)
      layer.set(g, Math.max(-1, ...[...(before.get(g) ?? [])].map((b) => layer.get(b) ?? -1)) + 1);
  }
  // a component without inputs is in the layer before its first reader
  for (const g of groups) {
    if ((before.get(g)?.size ?? 0) > 0 || (vehicle && g === key(vehicle))) continue;
    const readers = groups.filter((r) => before.get(r)?.has(g)).map((r) => layer.get(r) ?? 1);
    if (readers.length > 0) layer.set(g, Math.max(0, Math.min(...readers) - 1));
  }
  return new Map(parts.map((p) => [p.name, layer.get(key(p)) ?? 0]));
}

/** `lines`: number of letters that fit below the name. */
export function draw_wiring(parts: Part[], lines: (part: Part) => number): Drawing {
  const nets = nets_of(parts),
    layer = layers_of(parts, nets);
  const at = (p: Part) => layer.get(p.name) ?? 0;
  const columns: Part[][] = Array.from({ length: Math.max(0, ...layer.values()) + 1 }, (_, i) =>
    parts.filter((p) => at(p) === i),
  );
  const rows = Math.max(1, ...columns.map((c) => c.length));
  const row = (p: Part) => columns[at(p)]?.indexOf(p) ?? 0;

  // A net has a vertical in the gutter behind each of its writers' layers and before each layer that it reaches from farther away, and
  // then a lane below its writers' row; feedback connections run below all.
  const gutters: Net[][] = Array.from({ length: columns.length + 1 }, () => []); // [0]: left of the first column
  const lanes: Net[][] = Array.from({ length: rows }, () => []);
  const column = (net: Net) => at(net.from[0] as Part);
  const lane_row = (net: Net) =>
    net.readers.some(({ part }) => at(part) <= column(net)) ? rows - 1 : Math.min(...net.from.map(row));
  const add = (list: Net[] | undefined, net: Net) => list && !list.includes(net) && list.push(net);
  for (const net of nets) add(gutters[column(net) + 1], net); // left of the arriving lines: their pins are on the left
  for (const net of nets) {
    for (const { part } of net.readers) {
      if (at(part) === column(net) + 1) continue;
      add(gutters[at(part)], net);
      add(lanes[lane_row(net)], net);
    }
  }

  const gutter_width = (i: number) => (gutters[i]?.length ?? 0) * pitch + 2 * pin_gap + (i === 0 ? 0 : pitch);
  const widths = columns.map((c) =>
    Math.max(
      least_width,
      ...c.map((p) => Math.max((p.name.length + 3) * name_letter, lines(p) * small_letter) + 14),
    ),
  );
  const lefts: number[] = [];
  let x = margin;
  widths.forEach((w, i) => {
    x += gutter_width(i);
    lefts.push(x);
    x += w;
  });
  const pins = (p: Part) => Math.max(p.inputs.length, p.outputs.length);
  const heights = Array.from({ length: rows }, (_, r) =>
    Math.max(box_height, ...columns.map((c) => (c[r] ? (pins(c[r] as Part) + 1) * pitch : 0))),
  );
  const tops: number[] = [];
  let y = margin;
  heights.forEach((h, r) => {
    tops.push(y);
    y += h + 2 * pin_gap + (lanes[r]?.length ?? 0) * pitch;
  });
  const boxes = new Map(
    parts.map((p): [string, Box] => [
      p.name,
      {
        name: p.name,
        layer: at(p),
        row: row(p),
        x: lefts[at(p)] as number,
        y: tops[row(p)] as number,
        width: widths[at(p)] as number,
        height: heights[row(p)] as number,
      },
    ]),
  );

  const gutter_x = (i: number, net: Net) =>
    (i === 0 ? margin : (lefts[i - 1] as number) + (widths[i - 1] as number)) +
    pin_gap +
    ((gutters[i]?.indexOf(net) ?? 0) + 0.5) * pitch;
  const lane_y = (net: Net) => {
    const r = lane_row(net);
    return (
      (tops[r] as number) + (heights[r] as number) + pin_gap + ((lanes[r]?.indexOf(net) ?? 0) + 0.5) * pitch
    );
  };
  const pin = (list: { name: string }[], name: string, box: Box) =>
    box.y + (box.height * (list.findIndex((p) => p.name === name) + 1)) / (list.length + 1);
  const read = (p: Part) => p.inputs.filter((i) => i.source);
  const written = (p: Part) =>
    p.outputs.filter((o) => nets.some((n) => n.from.includes(p) && n.source.endsWith("." + o.name)));
  const wires: Wire[] = [];
  for (const net of nets)
    for (const from of net.from)
      for (const { part, input } of net.readers) {
        const a = boxes.get(from.name) as Box,
          b = boxes.get(part.name) as Box;
        const y1 = pin(written(from), net.source.replace(/^[^.]*\./, ""), a),
          y2 = pin(read(part), input, b) + apart; // no output's line beside it
        const x1 = gutter_x(a.layer + 1, net),
          x2 = gutter_x(b.layer, net);
        const points: [number, number][] = [
          [a.x + a.width, y1],
          [x1, y1],
        ];
        if (b.layer !== a.layer + 1) points.push([x1, lane_y(net)], [x2, lane_y(net)]);
        points.push([b.layer === a.layer + 1 ? x1 : x2, y2], [b.x, y2]);
        wires.push({ source: net.source, from: from.name, to: part.name, input, points });
      }
  return {
    width: x + gutter_width(columns.length) + margin,
    height: y + margin,
    boxes: [...boxes.values()],
    wires,
  };
}

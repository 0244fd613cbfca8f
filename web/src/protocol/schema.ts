// SPDX-License-Identifier: BSD-3-Clause
// Decoder of XCDR1 bytes from ROS 2 message text. An enumeration becomes its label in lower case, as in a mission file.

export type Value = number | boolean | string | Value[] | Message;
export interface Message {
  [field: string]: Value;
}

export interface Field {
  name: string;
  type: string; // "float64", or the name of a message
  labels: string[]; // of an enumeration; else empty
  list: boolean; // a list of at most `count` items
  count: number; // 0: one value
  fields: Field[]; // of a message
  unit: string; // "" without a unit
}

const scalar_bytes: Record<string, number> = {
  bool: 1,
  int8: 1,
  uint8: 1,
  byte: 1,
  char: 1,
  int16: 2,
  uint16: 2,
  int32: 4,
  uint32: 4,
  int64: 8,
  uint64: 8,
  float32: 4,
  float64: 8,
};
const most_items = 100_000;

interface Line {
  type: string;
  name: string;
  constant: number | null;
}

function parse_line(line: string): Line | null {
  const text = line.replace(/#.*$/, "").trim();
  const match = /^(\S+)\s+([A-Za-z_][A-Za-z0-9_]*)\s*(?:=\s*(\S+))?$/.exec(text);
  if (!match) return null;
  return {
    type: match[1] ?? "",
    name: match[2] ?? "",
    constant: match[3] === undefined ? null : Number(match[3]),
  };
}

/** Constants before a field are its labels, without the field's name as a prefix. */
function labels_of(field: string, constants: Line[]): string[] {
  const labels: string[] = [];
  const prefix = field.toUpperCase() + "_";
  const all = constants.every((c) => c.name.startsWith(prefix));
  for (const c of constants)
    labels[c.constant ?? 0] = (all ? c.name.slice(prefix.length) : c.name).toLowerCase();
  return labels;
}

const units: [string, string][] = [
  ["_radps", "rad/s"],
  ["_mps2", "m/s²"],
  ["_mps", "m/s"],
  ["_rad", "rad"],
  ["_deg", "°"],
  ["_kelvin", "K"],
  ["_tesla", "T"],
  ["_volt", "V"],
  ["_amp", "A"],
  ["_newton", "N"],
  ["_pa", "Pa"],
  ["_ns", "ns"],
  ["_us", "µs"],
  ["_m", "m"],
  ["_s", "s"],
  ["_frac", ""],
  ["_ratio", ""],
];
/** Unit of a field, by the end of its name. */
export function unit_of(field: string): string {
  for (const [suffix, unit] of units) if (field.endsWith(suffix)) return unit;
  return "";
}

export function parse_schema(name: string, text: string): Field[] {
  const parts = new Map<string, string>();
  const sections = text.split(/^=+\s*\nMSG:\s*/m);
  sections.forEach((section, i) => {
    if (i === 0) return parts.set(name, section);
    const end = section.indexOf("\n");
    return parts.set(section.slice(0, end).trim(), section.slice(end + 1));
  });
  const fields_of = (part: string, depth: number): Field[] => {
    const fields: Field[] = [];
    let constants: Line[] = [];
    for (const raw of (parts.get(part) ?? "").split("\n")) {
      const line = parse_line(raw);
      if (!line) continue;
      if (line.constant !== null) {
        constants.push(line);
        continue;
      }
      const shape = /^(.*?)(?:\[(<=)?(\d*)\])?$/.exec(line.type);
      const type = shape?.[1] ?? line.type;
      const array = line.type.endsWith("]");
      const count = array ? Number(shape?.[3] || most_items) : 0;
      fields.push({
        name: line.name,
        type,
        count,
        labels: labels_of(line.name, constants),
        list: array && (shape?.[2] === "<=" || shape?.[3] === ""),
        fields:
          type in scalar_bytes || type.startsWith("string") || depth > 16 ? [] : fields_of(type, depth + 1),
        unit: unit_of(line.name),
      });
      constants = [];
    }
    return fields;
  };
  return fields_of(name, 0);
}

const decoder = new TextDecoder();

class Reader {
  private at: number;
  private readonly begin: number;
  private readonly little: boolean;
  constructor(
    private readonly view: DataView,
    offset: number,
  ) {
    this.begin = offset + 4; // behind the encapsulation; alignment counts from there
    this.at = this.begin;
    this.little = view.getUint8(offset + 1) === 1;
  }
  private take(bytes: number): number {
    const pad = (bytes - ((this.at - this.begin) % bytes)) % bytes;
    const at = this.at + pad;
    this.at = at + bytes;
    return at;
  }
  scalar(type: string): number | boolean {
    const v = this.view;
    const le = this.little;
    const at = this.take(scalar_bytes[type] ?? 1);
    switch (type) {
      case "float64":
        return v.getFloat64(at, le);
      case "float32":
        return v.getFloat32(at, le);
      case "bool":
        return v.getUint8(at) !== 0;
      case "int8":
        return v.getInt8(at);
      case "int16":
        return v.getInt16(at, le);
      case "uint16":
        return v.getUint16(at, le);
      case "int32":
        return v.getInt32(at, le);
      case "uint32":
        return v.getUint32(at, le);
      case "int64":
        return Number(v.getBigInt64(at, le));
      case "uint64":
        return Number(v.getBigUint64(at, le));
      default:
        return v.getUint8(at);
    }
  }
  text(): string {
    const size = this.scalar("uint32") as number;
    const bytes = new Uint8Array(this.view.buffer, this.view.byteOffset + this.at, Math.max(0, size - 1));
    this.at += size;
    return decoder.decode(bytes);
  }
  one(field: Field): Value {
    if (field.fields.length > 0) return this.message(field.fields);
    if (field.type.startsWith("string")) return this.text();
    const value = this.scalar(field.type);
    return field.labels.length > 0 ? (field.labels[value as number] ?? String(value)) : value;
  }
  message(fields: Field[]): Message {
    const message: Message = {};
    for (const field of fields) {
      if (field.count === 0) {
        message[field.name] = this.one(field);
        continue;
      }
      const count = field.list ? (this.scalar("uint32") as number) : field.count;
      if (count > field.count) throw new RangeError(field.name + " has too many items");
      const list: Value[] = [];
      for (let i = 0; i < count; ++i) list.push(this.one(field));
      message[field.name] = list;
    }
    return message;
  }
}

/** The message whose encapsulation begins at `offset`. Throws RangeError when the bytes end too early. */
export function decode(fields: Field[], view: DataView, offset: number): Message {
  return new Reader(view, offset).message(fields);
}

/** "position_m.north" of a message; undefined when there is no such number. */
export function number_at(message: Message | undefined, path: string): number | undefined {
  let value: Value | undefined = message;
  for (const key of path.split(".")) {
    if (typeof value !== "object" || value === null) return undefined;
    value = (value as Record<string, Value>)[key];
  }
  if (typeof value === "boolean") return value ? 1 : 0;
  return typeof value === "number" ? value : undefined;
}

/** Every number of a message, as paths. */
export function number_paths(fields: Field[], prefix = ""): { path: string; unit: string }[] {
  const list: { path: string; unit: string }[] = [];
  for (const f of fields) {
    if (f.count > 0 || f.labels.length > 0 || f.type.startsWith("string")) continue;
    if (f.fields.length > 0) {
      for (const inner of number_paths(f.fields, prefix + f.name + "."))
        list.push({ path: inner.path, unit: inner.unit || f.unit });
    } else {
      list.push({ path: prefix + f.name, unit: f.unit });
    }
  }
  return list;
}

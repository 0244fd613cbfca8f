// SPDX-License-Identifier: BSD-3-Clause
// Where views get their figures from: a flight that is connected, or one that was recorded. A view that only
// looks knows this and nothing else.
import type { Field, Message } from "./protocol/schema";

export interface Topic {
  name: string; // "/nav/state"
  type: string; // "fulmar_msgs/msg/VehicleState"
  fields: Field[];
}

/** A field over flight time. Both lists are as long, the oldest first. */
export interface Series {
  readonly t: number[]; // seconds
  readonly v: number[];
}

export interface Source {
  /** Seconds of flight. */
  readonly now: number;
  topics(): Topic[];
  /** The newest message of a topic; undefined as long as there was none. Asking makes it come. */
  latest(topic: string): Message | undefined;
  /** Seconds of flight since the newest message; Infinity as long as there was none. */
  age(topic: string): number;
  /** A field's values, of the last minutes at 50 a second at most. */
  series(topic: string, path: string): Series;
  /** Every message of a topic from now on, until the function that is returned is called. */
  listen(topic: string, heard: (message: Message, t: number) => void): () => void;
}

/** The first topic of a type, "VehicleState", that a predicate likes. */
export function topic_of_type(
  source: Source,
  type: string,
  likes: (t: Topic) => boolean = () => true,
): string {
  return source.topics().find((t) => t.type.endsWith("/" + type) && likes(t))?.name ?? "";
}

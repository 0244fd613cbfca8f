// SPDX-License-Identifier: BSD-3-Clause
// Data source of the views: a connected flight or a recorded one. Views that only display use nothing else.
import type { Field, Message } from "./protocol/schema";

export interface Topic {
  name: string; // "/nav/state"
  type: string; // "fulmar_msgs/msg/VehicleState"
  fields: Field[];
}

/** A field over flight time. Both lists have the same length, oldest first. */
export interface Series {
  readonly t: number[]; // seconds
  readonly v: number[];
}

export interface Source {
  /** Seconds of flight. */
  readonly now: number;
  topics(): Topic[];
  /** The newest message of a topic; undefined before the first. The first call subscribes to it. */
  latest(topic: string): Message | undefined;
  /** Seconds of flight since the newest message; Infinity before the first. */
  age(topic: string): number;
  /** A field's values, of the last minutes, at most 50 per second. */
  series(topic: string, path: string): Series;
  /** Every message of a topic from now on, until the returned function is called. */
  listen(topic: string, heard: (message: Message, t: number) => void): () => void;
}

/** The first topic of a type, "VehicleState", that satisfies the predicate. */
export function topic_of_type(
  source: Source,
  type: string,
  likes: (t: Topic) => boolean = () => true,
): string {
  return source.topics().find((t) => t.type.endsWith("/" + type) && likes(t))?.name ?? "";
}

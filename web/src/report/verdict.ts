// SPDX-License-Identifier: BSD-3-Clause
// What became of the flight, in a line. A whole file without a verdict is no killed host: flights ended without one once.
import { clock } from "../units";
import type { Log } from "./model";

export interface VerdictLine {
  words: string;
  bad: boolean;
}

export function verdict_of(log: Pick<Log, "verdict" | "fault" | "end_s">): VerdictLine {
  const { words, severity } = log.verdict;
  if (words)
    return {
      words: words.charAt(0).toUpperCase() + words.slice(1),
      bad: severity === "error" || severity === "critical",
    };
  const at = `The log ends at ${clock(log.end_s)} without a verdict: `;
  if (log.fault) return { words: `${at}${log.fault}.`, bad: true };
  return { words: `${at}it is whole; its host wrote none, or it was recovered.`, bad: false };
}

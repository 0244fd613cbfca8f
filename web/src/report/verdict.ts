// SPDX-License-Identifier: BSD-3-Clause
// Verdict of the flight, in one line. A complete file may lack a verdict: old hosts wrote none.
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
  return { words: `${at}the file is complete; the host wrote none, or the log was recovered.`, bad: false };
}

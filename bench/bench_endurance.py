#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Does a flight cost the same per second, and the same memory, however long it is? The hourglass flown on and on: processor time of all
threads per second of flight, less that of setting up (the least of nine runs each, of three from an hour on), and the most memory that was resident.

    bench/bench_endurance.py [BUILD] [--hours H] [--log] [--json]
"""
import argparse
import json
import os
import pathlib
import subprocess
import sys
import tempfile

MISSION = """mission: endurance
extends: {hourglass}
done: "manage.progress.circuits >= 1000000"
timeout: 0 s
"""
BEGINNING_S = 1  # the shortest flight: what setting up costs


def flown(fulmar, mission, log, seconds):
    """Processor seconds and kB of one flight."""
    words = [fulmar, "run", mission, "--live", "off", "--duration", str(seconds), *(["--log", log] if log else ["--no-log"])]
    process = subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    said = process.stdout.read()
    _, status, used = os.wait4(process.pid, 0)
    if status != 0 or "duration reached" not in said:
        sys.exit(f"bench_endurance: {' '.join(words)} did not fly:\n{said}")
    if log:
        os.remove(log)
    return used.ru_utime + used.ru_stime, used.ru_maxrss


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", nargs="?", default="build")
    parser.add_argument("--hours", type=float, default=10, help="of the longest flight")
    parser.add_argument("--log", action="store_true", help="with the default log; the longest flight takes 200 MB an hour")
    parser.add_argument("--json", action="store_true")
    options = parser.parse_args()
    if not options.hours > 0:
        parser.error(f"--hours is {options.hours} and must be more than 0")
    root = pathlib.Path(__file__).resolve().parent.parent
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        mission = pathlib.Path(folder, "endurance.yaml")
        mission.write_text(MISSION.format(hourglass=root / "configs/missions/hourglass.yaml"))
        log = os.path.join(folder, "endurance.mcap") if options.log else None
        fly = lambda seconds: flown(f"{options.build}/bin/fulmar", str(mission), log, seconds)
        begun = min(fly(BEGINNING_S)[0] for _ in range(9))
        longest = 3600 * options.hours
        for seconds in sorted({s for s in (60, 600, 3600) if s < longest} | {longest}):
            runs = [fly(seconds) for _ in range(9 if seconds < 3600 else 3)]
            cost = min(run[0] for run in runs) - begun
            rows.append({"flight_s": seconds, "us_per_s": 1e6 * cost / (seconds - BEGINNING_S), "memory_kB": max(run[1] for run in runs)})
    if options.json:
        print(json.dumps(rows, indent=1))
        return
    print("| flight | processor time per second of flight | memory |")
    print("|---|---|---|")
    for row in rows:
        length = f"{row['flight_s'] / 60:g} min" if row["flight_s"] < 3600 else f"{row['flight_s'] / 3600:g} h"
        print(f"| {length} | {row['us_per_s']:.0f} us | {row['memory_kB'] / 1000:.1f} MB |")


main()

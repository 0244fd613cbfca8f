#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws flights as an SVG of a few kilobytes: the track from above, or numbers over time.

  track.py LOG... -o track.svg [--from 20] [--to 200]        the track, with the plan's waypoints as crosses
  track.py LOG... -o height.svg --plot nav.state.height_m score.tracking.altitude_m
  track.py LOG... -o new.svg --like track.svg                also: exit code 1 if the two pictures differ by more than 2 % of their size

A LOG may have a name for the legend: --names shipped mine. The program `fulmar` must be on the PATH; only the standard library is needed.
"""
import argparse
import csv
import math
import pathlib
import re
import subprocess
import sys
import tempfile

WIDTH, HEIGHT, EDGE = 640, 400, 40
COLOURS = ["#1f5fa8", "#c4581a", "#2b8a4b", "#8a3b8f", "#6b6b6b"]


def columns(log, port, wanted):
    """Rows of [time_s, requested columns] of a port; empty if the log does not have it."""
    with tempfile.TemporaryDirectory() as folder:
        topic = "/" + port.replace(".", "/")
        command = ["fulmar", "log", "export", log, "--to", "csv", "--topic", topic, "--out", folder + "/csv"]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        file = pathlib.Path(folder, "csv", port + ".csv")
        if done.returncode != 0 or not file.exists():
            return []
        with file.open(newline="", encoding="utf-8") as lines:
            rows = csv.reader(lines)
            head = next(rows)
            missing = [name for name in wanted if name not in head]
            if missing:
                sys.exit(f"track.py: {port} has no {missing[0]}. Valid: {', '.join(head[2:])}.")
            places = [0] + [head.index(name) for name in wanted]
            return [[float(row[i]) for i in places] for row in rows if all(row[i] for i in places)]


def track(log):
    """Position of the aircraft, the truth if the log has it: rows of time, east, north."""
    for port in ("vehicle.truth", "nav.state"):
        rows = columns(log, port, ["position_m.east", "position_m.north"])
        if rows:
            return rows
    sys.exit(f"track.py: {log} has neither vehicle.truth nor nav.state")


def waypoints(log):
    """East and north of the last plan's waypoints."""
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(["fulmar", "log", "export", log, "--to", "csv", "--topic", "/plan/plan", "--out", folder + "/csv"],
                       capture_output=True, check=False)
        file = pathlib.Path(folder, "csv", "plan.plan.csv")
        if not file.exists():
            return []
        with file.open(newline="", encoding="utf-8") as lines:
            rows = list(csv.DictReader(lines))
    points = []
    for row in rows[-1:]:
        name = "waypoints[0].position_m."
        while row.get(name + "east"):
            points.append((float(row[name + "east"]), float(row[name + "north"])))
            name = f"waypoints[{len(points)}].position_m."
    return points


def thinned(points, tolerance):
    """Polyline simplified by the algorithm of Ramer, Douglas and Peucker."""
    keep, stack = {0, len(points) - 1}, [(0, len(points) - 1)]
    while stack:
        a, b = stack.pop()
        (xa, ya), (xb, yb) = points[a], points[b]
        length, worst, at = math.hypot(xb - xa, yb - ya), tolerance, None
        for i in range(a + 1, b):
            x, y = points[i]
            d = abs((xb - xa) * (ya - y) - (xa - x) * (yb - ya)) / length if length > 1e-9 else math.hypot(x - xa, y - ya)
            if d > worst:
                worst, at = d, i
        if at is not None:
            keep.add(at)
            stack += [(a, at), (at, b)]
    return [points[i] for i in sorted(keep)]


def step_of(span):
    """A round step, of which four to nine make the span."""
    power = 10 ** math.floor(math.log10(max(span, 1e-9) / 4))
    return max(s * power for s in (1, 2, 5) if s * power <= span / 4 + 1e-12)


class Picture:
    """Scales lines from units of the flight to units of paper."""

    def __init__(self, lines, equal):
        xs, ys = [x for line in lines for x, _ in line], [y for line in lines for _, y in line]
        self.x0, self.y0 = min(xs), min(ys)
        x_span, y_span = max(max(xs) - self.x0, 1e-9), max(max(ys) - self.y0, 1e-9)
        self.width = WIDTH
        self.kx, self.ky = (WIDTH - 2 * EDGE) / x_span, (HEIGHT - 2 * EDGE) / y_span
        if equal:
            self.kx = self.ky = min(self.kx, self.ky)
            self.width = max(round(x_span * self.kx) + 2 * EDGE, 240)
        self.x_span, self.y_span, self.parts = x_span, y_span, []

    def at(self, x, y):
        return EDGE + (x - self.x0) * self.kx, HEIGHT - EDGE - (y - self.y0) * self.ky

    def line(self, points, colour):
        corners = thinned([self.at(*p) for p in points], 0.4)
        path = " ".join(f"{x:.1f},{y:.1f}" for x, y in corners)
        self.parts.append(f'<polyline fill="none" stroke="{colour}" stroke-width="1.4" points="{path}"/>')

    def cross(self, point):
        x, y = self.at(*point)
        self.parts.append(f'<path d="M{x - 4:.1f} {y:.1f}h8m-4 -4v8" stroke="#222"/>')

    def text(self, x, y, words, colour="#222", anchor="start"):
        words = words.replace("&", "&amp;").replace("<", "&lt;")
        self.parts.append(f'<text x="{x:.0f}" y="{y:.0f}" fill="{colour}" text-anchor="{anchor}">{words}</text>')

    def scale(self):
        length = step_of(self.x_span)
        x, y = EDGE, HEIGHT - 12
        self.parts.append(f'<path d="M{x} {y}h{length * self.kx:.1f}" stroke="#222" stroke-width="2"/>')
        self.text(x + length * self.kx + 6, y + 4, f"{length:g} m, north is up")

    def axes(self, unit):
        for span, first, along_x in ((self.x_span, self.x0, True), (self.y_span, self.y0, False)):
            step = step_of(span)
            tick = math.ceil(first / step - 1e-9) * step
            while tick <= first + span * (1 + 1e-9):
                x, y = self.at(tick if along_x else self.x0, self.y0 if along_x else tick)
                self.parts.append(f'<path d="M{x:.1f} {y:.1f}{"v4" if along_x else "h-4"}" stroke="#222"/>')
                self.text(x if along_x else x - 6, y + 16 if along_x else y + 4, f"{round(tick / step) * step:g}",
                          anchor="middle" if along_x else "end")
                tick += step
        x, y = self.at(self.x0, self.y0)
        self.parts.append(f'<path d="M{x:.1f} {EDGE}V{y:.1f}H{self.width - EDGE}" fill="none" stroke="#222"/>')
        self.text(self.width - EDGE, HEIGHT - 8, "s", anchor="end")
        self.text(8, 16, unit)

    def legend(self, names, colours):
        for i, (name, colour) in enumerate(zip(names, colours)):
            self.text(self.width - EDGE, 16 + 15 * i, name, colour, "end")

    def svg(self):
        head = (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {self.width} {HEIGHT}" font-family="sans-serif" font-size="12">'
                f'<rect width="{self.width}" height="{HEIGHT}" fill="#fff"/>')
        return head + "\n" + "\n".join(self.parts) + "\n</svg>\n"


def between(rows, given):
    return [row for row in rows if given.begin <= row[0] <= given.end]


def draw_track(given):
    lines = [[(east, north) for _, east, north in between(track(log), given)] for log in given.logs]
    if not all(lines):
        sys.exit("track.py: nothing was flown in that time")
    crosses = waypoints(given.logs[0])
    picture = Picture(lines + ([crosses] if crosses else []), equal=True)
    for line, colour in zip(lines, COLOURS):
        picture.line(line, colour)
    for point in crosses:
        picture.cross(point)
    picture.scale()
    if given.names or len(lines) > 1:
        picture.legend(given.names or [pathlib.Path(log).stem for log in given.logs], COLOURS)
    return picture.svg()


def draw_plot(given):
    lines, names = [], []
    for k, log in enumerate(given.logs):
        for field in given.plot:
            owner, port, name = (field.split(".", 2) + ["", ""])[:3]
            rows = between(columns(log, f"{owner}.{port}", [name]), given)
            if not rows:
                sys.exit(f"track.py: {log} has no {owner}.{port}")
            degrees = 180 / math.pi if name.endswith(("_rad", "_radps")) else 1
            lines.append([(t, degrees * y) for t, y in rows])
            label = given.names[k] if given.names else pathlib.Path(log).stem
            names.append(label if len(given.plot) == 1 else field if len(given.logs) == 1 else f"{label} {field}")
    picture = Picture(lines, equal=False)
    for line, colour in zip(lines, COLOURS):
        picture.line(line, colour)
    picture.axes(given.plot[0].replace("_rad", "_deg") if len(given.plot) == 1 else "")
    if len(lines) > 1:
        picture.legend(names, COLOURS)
    return picture.svg()


def corners_of(svg):
    return [[tuple(map(float, pair.split(","))) for pair in path.split()] for path in re.findall(r' points="([^"]*)"', svg)]


def distance(point, line):
    """Distance from a point to a polyline."""
    best = math.inf
    for (xa, ya), (xb, yb) in zip(line, line[1:]):
        square = (xb - xa) ** 2 + (yb - ya) ** 2
        t = 0 if square == 0 else max(0, min(1, ((point[0] - xa) * (xb - xa) + (point[1] - ya) * (yb - ya)) / square))
        best = min(best, math.hypot(point[0] - xa - t * (xb - xa), point[1] - ya - t * (yb - ya)))
    return best


def difference(one, other):
    """Greatest distance of a corner of one picture from the same line of the other, in units of paper."""
    a, b = corners_of(one), corners_of(other)
    if len(a) != len(b):
        return math.inf
    return max((distance(p, q) for x, y in zip(a, b) for line, q in ((x, y), (y, x)) for p in line), default=0)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("logs", nargs="+", metavar="LOG")
    parser.add_argument("-o", dest="out", required=True, metavar="FILE")
    parser.add_argument("--plot", nargs="+", metavar="PORT.FIELD")
    parser.add_argument("--names", nargs="+", metavar="NAME")
    parser.add_argument("--from", dest="begin", type=float, default=-math.inf, metavar="S")
    parser.add_argument("--to", dest="end", type=float, default=math.inf, metavar="S")
    parser.add_argument("--like", metavar="FILE")
    given = parser.parse_args()
    if given.names and len(given.names) != len(given.logs):
        parser.error("a name for each log")
    svg = draw_plot(given) if given.plot else draw_track(given)
    pathlib.Path(given.out).write_text(svg, encoding="utf-8")
    if given.like:
        apart = difference(svg, pathlib.Path(given.like).read_text(encoding="utf-8"))
        if apart > 0.02 * WIDTH:
            sys.exit(f"track.py: {given.out} is {apart:.0f} of {WIDTH} away from {given.like}")


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks the order of the folders: no include upwards, and no circle of units, where a unit is a header with
its source. Each folder of core/, links/ and flight/ has a README. Tests may include any file."""
import re
import subprocess
import sys
from pathlib import Path

# From the bottom up. A folder includes itself and the folders before it; folders of one line do not include each other.
ORDER = [line.split() for line in """
sdk/include/fulmar
sdk/include/fulmar/flight/math
sdk/include/fulmar/flight/earth
sdk/include/fulmar/flight/model
sdk/include/fulmar/flight/control sdk/include/fulmar/flight/path sdk/include/fulmar/flight/navigation
sdk/include/fulmar/sim
core
core/types
core/loader
core/loader/probe
core/log
core/isolate
core/isolate/child
core/graph
core/tap
links/live links/dds
core/run/component
core/run/state
core/run/record
core/run/flight
core/run/command
core/run
core/app
plugins examples
tools
bench
""".strip().split("\n")]
RANK = {folder: rank for rank, folders in enumerate(ORDER) for folder in folders}
READMES = [f for f in RANK if re.match(r"(core/(run/)?|links/)\w+$", f) or "/flight/" in f]
root = Path(__file__).resolve().parent.parent
listed = subprocess.run(["git", "ls-files", "core", "links", "sdk/include", "tools", "plugins", "examples", "bench"], cwd=root, capture_output=True,
                        text=True, check=True).stdout
sources = [f for f in listed.split() if f.endswith((".cpp", ".hpp", ".h", ".c")) and "/test/" not in f and (root / f).exists()]
known = set(sources)
faults = []


def target(file, name):
    """The file of the tree that an include names, or None."""
    near = f"{file.rsplit('/', 1)[0]}/{name}"
    return next((t for t in (name, f"sdk/include/{name}", near) if t in known), None)


def read_includes(file):
    names = re.findall(r'^#include [<"]([^>"]+)[>"]', (root / file).read_text(), re.M)
    return [t for name in names if (t := target(file, name))]


def folder_of(file):
    """The nearest folder of ORDER around a file. A new folder of core/ or links/ has to be listed first."""
    parts = file.split("/")[:-1]
    if parts[0] in ("core", "links") and len(parts) > 1 and "/".join(parts) not in RANK:
        faults.append(f"{file}: {'/'.join(parts)} is no folder of cmake/layers.py")
    while parts and "/".join(parts) not in RANK:
        parts.pop()
    return "/".join(parts)


includes = {f: read_includes(f) for f in sources}
folders = {f: folder_of(f) for f in sources}
for file, targets in includes.items():
    for other in targets:
        here, there = folders[file], folders[other]
        if other.endswith("/messages.hpp") and here.startswith(f"{there}/"):
            continue  # the catalogue of messages of the folder around it
        if here != there and RANK.get(there, -1) >= RANK.get(here, -1):
            faults.append(f"{file} includes {other}: {'upwards' if RANK.get(there, -1) > RANK.get(here, -1) else 'sideways'}")


def unit(file):
    """A header, its source and `_impl`, the definitions that its templates or its sources share, are one unit."""
    return file.rsplit(".", 1)[0].removesuffix("_impl")


def circle():
    """Depth first: the first circle of units, as a path."""
    edges = {}
    for file, targets in includes.items():
        edges.setdefault(unit(file), set()).update(unit(t) for t in targets if unit(t) != unit(file))
    state, path = {}, []

    def visit(name):
        state[name] = "open"
        path.append(name)
        for other in sorted(edges[name]):
            if state.get(other) == "open":
                return path[path.index(other):] + [other]
            if other not in state and (found := visit(other)):
                return found
        path.pop()
        state[name] = "done"
        return None

    for name in edges:
        if name not in state and (found := visit(name)):
            return found
    return None


if found := circle():
    faults.append("circle: " + " -> ".join(found))
faults += [f"{folder} has no README.md" for folder in READMES if not (root / folder / "README.md").exists()]
print("\n".join(dict.fromkeys(faults)) or f"{len(sources)} files: no include upwards, no circle")
sys.exit(bool(faults))

#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The folders of core/ stand on each other: no include upwards, no circle of files, a README in each. Tests may include what they like."""
import re
import subprocess
import sys
from pathlib import Path

ORDER = "types loader log isolate graph tap live dds run replay app".split()
root = Path(__file__).resolve().parent.parent
listed = subprocess.run(["git", "ls-files", "core", "sdk", "tools", "plugins"], cwd=root, capture_output=True, text=True, check=True).stdout
sources = [f for f in listed.split() if f.endswith((".cpp", ".hpp", ".h", ".c")) and "/test/" not in f and (root / f).exists()]
includes = {f: re.findall(r'^#include "((?:core|tools|plugins|fulmar)/[^"]+)"', (root / f).read_text(), re.M) for f in sources}
faults = []


def floor(path):
    """Which floor of core a file stands on; 0 for what lies in core/ itself."""
    folder = path.split("/")[1] if path.count("/") > 1 else ""
    if folder and folder not in ORDER:
        faults.append(f"{path}: core/{folder} is no folder of cmake/layers.py")
        return 0
    return ORDER.index(folder) + 1 if folder else 0


for file, targets in includes.items():
    if not file.startswith("core/"):
        continue
    for target in targets:
        if target.startswith(("tools/", "plugins/")):
            faults.append(f"{file} includes {target}: core stands below")
        elif target.startswith("core/") and floor(target) > floor(file):
            faults.append(f"{file} includes {target}: upwards")


def circle():
    """Depth first: the first circle of headers, as a path."""
    state, path = {}, []

    def visit(file):
        state[file] = "open"
        path.append(file)
        for target in includes.get(file, []):
            target = target if target in includes else f"sdk/include/{target}"
            if state.get(target) == "open":
                return path[path.index(target):] + [target]
            if target in includes and target not in state and (found := visit(target)):
                return found
        path.pop()
        state[file] = "done"
        return None

    for file in includes:
        if file not in state and (found := visit(file)):
            return found
    return None


if found := circle():
    faults.append("circle: " + " -> ".join(found))
faults += [f"core/{folder} has no README.md" for folder in ORDER if not (root / "core" / folder / "README.md").exists()]
print("\n".join(faults) or f"{len(sources)} files: no include upwards, no circle")
sys.exit(bool(faults))

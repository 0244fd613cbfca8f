#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The folders of core/ stand on each other: no include upwards, no circle of files, a README in each. Tests may include what they like.
In core/run, where the next change is hardest to get right, no struct has more than 15 members and no file more than 450 lines."""
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


def structs(text):
    """Every struct and class of a source with the number of its data members: [(name, members)]."""
    text = re.sub(r"//[^\n]*|/\*.*?\*/|^#[^\n]*", "", text, flags=re.S | re.M)
    text = re.sub(r'"(?:\\.|[^"\\])*"', '""', text)
    out, pattern = [], re.compile(r"\b(?:struct|class)\s+([\w:]+)(?:\s+final)?\s*(?::[^;{]*)?\{")
    for match in pattern.finditer(text):
        if re.search(r"\benum\s*$", text[:match.start()]):
            continue
        depth, body = 1, []
        for char in text[match.end():]:
            depth += (char == "{") - (char == "}")
            if depth == 0:
                break
            if depth == 1:
                body.append(";" if char == "}" else char)  # what a brace held ends here: a function, a type, an initial value
        out.append((match[1], sum(map(declared, "".join(body).split(";")))))
    return out


def declared(statement):
    """How many data members a statement at the first level of a struct declares."""
    statement = re.sub(r"\b(?:public|private|protected)\s*:", "", statement).strip()
    while re.search(r"<[^<>]*>", statement):
        statement = re.sub(r"<[^<>]*>", "", statement)
    if re.match(r"(?:static|using|friend|enum|struct|class|union|template|explicit|virtual|typedef|=|[),&|])", statement) or "operator" in statement:
        return 0
    declaration = statement.split("=")[0]
    if "(" in declaration or not re.match(r"[\w:\s&*\[\],]+$", declaration) or not re.search(r"[\w\]&*>]\s+[\w*&]", declaration):
        return 0
    return 1 + re.sub(r"\([^()]*\)|\[[^\[\]]*\]", "", statement).count(",")


for file in sources:
    if file.startswith("core/run/"):
        lines = (root / file).read_text().count("\n")
        if lines > 450:
            faults.append(f"{file} has {lines} lines; 450 is the limit in core/run")
        for name, members in structs((root / file).read_text()):
            if "--members" in sys.argv:
                print(f"{members:4d} {name} ({file})")
            if members > 15:
                faults.append(f"{file}: {name} has {members} data members; 15 is the limit in core/run")

if found := circle():
    faults.append("circle: " + " -> ".join(found))
faults += [f"core/{folder} has no README.md" for folder in ORDER if not (root / "core" / folder / "README.md").exists()]
print("\n".join(faults) or f"{len(sources)} files: no include upwards, no circle")
sys.exit(bool(faults))

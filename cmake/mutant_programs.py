# SPDX-License-Identifier: BSD-3-Clause
"""The test programs of a build with drawn faults: the files of each, the faults that the compiler rejects, and
the program that detects each fault."""
import concurrent.futures
import json
import os
import re
import shlex
import subprocess
import time

INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', re.M)
ROOTS = ("", "sdk/include/", "sdk/test/", "tools/")
PLACE = re.compile(r"^(?:In file included from |\s+from )?(/[^\s:]+):(\d+)[:,]", re.M)
TIMES, LEAST_S = 10, 30  # of a run without a fault: who needs longer hangs, which is noticed


class Includes:
    """The files of the tree that a source reads, including itself."""

    def __init__(self, tree):
        self.tree = tree
        self.known = {}
        self.direct = {}

    def named(self, file, name):
        for root in (os.path.dirname(file) + "/", *ROOTS):
            path = os.path.normpath(root + name)
            if os.path.isabs(name):
                path = os.path.relpath(name, self.tree)
            if (self.tree / path).is_file():
                return path
        return None

    def of(self, file):
        if file not in self.direct:
            text = (self.tree / file).read_text(errors="replace")
            self.direct[file] = {p for name in INCLUDE.findall(text) if (p := self.named(file, name))}
        return self.direct[file]

    def all_of(self, file):
        if file not in self.known:
            found, left = {file}, [file]
            while left:
                new = self.of(left.pop()) - found
                found |= new
                left += new
            self.known[file] = found
        return self.known[file]


def edges(text):
    """Of a build.ninja: output -> its inputs, without order-only ones."""
    made = {}
    for line in text.replace("$\n", "").split("\n"):
        m = re.match(r"build ((?:\$.|[^:$])+): \S+ ?(.*)", line)
        if m:
            inputs = re.split(r" \|\|", m.group(2))[0].replace(" | ", " ").split()
            for output in m.group(1).replace(" | ", " ").split():
                made[output] = inputs
    return made


def sources_of(output, made):
    """The compiled sources of a program, with those of its libraries."""
    found, seen, left = set(), set(), [output]
    while left:
        now = left.pop()
        if now in seen:
            continue
        seen.add(now)
        if re.search(r"\.(cpp|cxx|cc|c)$", now):
            found.add(now)
        else:
            left += made.get(now, [])
    return found


def compiled_of(out, tree):
    """Each test program: the files of the tree that it is compiled from."""
    made = edges((out / "build.ninja").read_text())
    includes = Includes(tree)
    programs = {}
    for output in made:
        m = re.fullmatch(r"bin/(\w+_test)", output)
        if m:
            files = set()
            for source in sources_of(output, made):
                files |= includes.all_of(os.path.relpath(out / source, tree))
            programs[m.group(1)] = files
    return programs


def places_in(output, tree):
    """Places of the tree in the compiler's messages: (path, line)."""
    prefix = str(tree) + "/"
    return {(m.group(1)[len(prefix):], int(m.group(2))) for m in PLACE.finditer(output)
            if m.group(1).startswith(prefix)}


def refused_places(out, tree, wanted, programs, jobs):
    """Runs the front end for as few sources as include all of `wanted`."""
    includes = Includes(tree)
    made = edges((out / "build.ninja").read_text())
    used = {os.path.normpath(out / s) for name in programs for s in sources_of("bin/" + name, made)}
    commands = {}
    for entry in json.loads((out / "compile_commands.json").read_text()):
        if entry["file"] in used:
            commands[entry["file"]] = entry
    left, chosen = set(wanted), []
    reads = {file: includes.all_of(os.path.relpath(file, tree)) & left for file in commands}
    while left and reads:
        best = max(sorted(reads), key=lambda file: len(reads[file] & left))
        if not reads[best] & left:
            break
        left -= reads[best]
        chosen.append(commands[best])

    def messages(entry):
        command = shlex.split(entry["command"])
        command = command[:command.index("-o")] + command[command.index("-o") + 2:] + ["-fsyntax-only"]
        command = [c for c in command if "ccache" not in c]
        result = subprocess.run(command, cwd=entry["directory"], capture_output=True, text=True, errors="replace")
        return result.stderr if result.returncode else ""

    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        return set().union(*(places_in(text, tree) for text in pool.map(messages, chosen)))


def run(program, folder, limit_s, mutant=0):
    """None when the tests pass, otherwise the one that fails."""
    try:
        result = subprocess.run([folder / "build/bin" / program, "--abort-after=1"], cwd=folder / "tree",
                                capture_output=True, text=True, errors="replace", timeout=limit_s,
                                env=dict(os.environ, FULMAR_MUTANT=str(mutant)))
    except subprocess.TimeoutExpired:
        return "takes too long"
    if result.returncode == 0:
        return None
    m = re.search(r"^TEST CASE: +(.*)", result.stdout, re.M)
    return m.group(1) if m else f"ends with {result.returncode}"


def judge(drawn, programs, folder, enough_percent, jobs):
    """Test that detects each fault; returns 1 when too few are detected."""
    took_s = {}
    for name in sorted(programs):
        begin = time.monotonic()
        failed = run(name, folder, None)
        took_s[name] = time.monotonic() - begin
        if failed:
            print(f"{name} fails without a fault and is left out: {failed}", flush=True)
            del took_s[name]

    def noticed_by(m):
        for name in sorted((n for n in took_s if m.path in programs[n]), key=took_s.get):
            if by := run(name, folder, LEAST_S + TIMES * took_s[name], m.id):
                return f"{name}: {by}"
        return None

    survivors = []
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        for m, by in zip(drawn, pool.map(noticed_by, drawn)):
            print(f"{m.path}:{m.line}: {m.kind}: {m.was} -> {m.now}: {by or 'SURVIVED'}", flush=True)
            if not by:
                survivors.append(m)
    for m in survivors:
        print(f"not noticed: {m.path}:{m.line}: {m.kind}: {m.was} -> {m.now}")
    noticed = len(drawn) - len(survivors)
    percent = 100 * noticed // len(drawn) if drawn else 100
    print(f"{noticed} of {len(drawn)} noticed ({percent} %), wanted: {enough_percent} %")
    return 0 if 100 * noticed >= enough_percent * len(drawn) else 1

#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Do the tests notice a fault? Builds the test programs once with every fault of cmake/mutants.txt in them, each
switched on by FULMAR_MUTANT, and runs the programs that cover a fault. Ends with 1 when too few are noticed.

    cmake/mutate.py [--folder FOLDER] [--jobs N] [ID...]
    cmake/mutate.py --only-list       only whether each fault has its place in the sources
"""
import argparse
import collections
import os
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
LIST = ROOT / "cmake/mutants.txt"
ENOUGH_PERCENT = 92
LIMIT_S = 300  # of one program: a fault that makes it hang is noticed, too
SWITCH = """// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#ifdef __cplusplus
#include <cstdlib>
inline bool fulmar_mutant(int id) {
  static const char* text = std::getenv("FULMAR_MUTANT");
  static const int chosen = text ? std::atoi(text) : 0;
  return chosen == id;
}
#endif
"""

Mutant = collections.namedtuple("Mutant", "id path type programs original mutated equivalent")


def mutants():
    found = []
    lines = [(n, l) for n, l in enumerate(LIST.read_text().splitlines(), 1) if l and not l.startswith("#")]
    while lines:
        (n, head), (_, old), (_, new) = (lines + [(0, "")] * 2)[:3]
        words = head.split()
        if len(words) < 4 or not words[0].isdigit() or old[:2] != "- " or new[:2] != "+ ":
            sys.exit(f"{LIST}:{n}: a fault is 'id file type program...', '- original', '+ mutated'")
        why = lines[3][1][2:] if len(lines) > 3 and lines[3][1][:2] == "= " else ""
        found.append(Mutant(words[0], words[1], words[2], words[3:], old[2:], new[2:], why))
        lines = lines[4 if why else 3:]
    doubled = [i for i, n in collections.Counter(m.id for m in found).items() if n > 1]
    if doubled:
        sys.exit(f"{LIST}: given twice: {' '.join(doubled)}")
    return found


def choice(m):
    if m.type == "statement":
        return f"if (::fulmar_mutant({m.id})) {{ {m.mutated} }} else {{ {m.original} }}"
    return f"(::fulmar_mutant({m.id}) ? {m.type}({m.mutated}) : {m.type}({m.original}))"


def mutated(chosen):
    """The files with the faults in them: path -> text."""
    by_path = collections.defaultdict(list)
    for m in chosen:
        by_path[m.path].append(m)
    texts = {}
    for path, group in by_path.items():
        text = (ROOT / path).read_text()
        spans = []
        for m in group:
            if text.count(m.original) != 1:
                sys.exit(f"{LIST}: {m.id}: {path} has {text.count(m.original)} times '{m.original}', wanted: once")
            begin = text.index(m.original)
            spans.append((begin, begin + len(m.original), m))
        spans.sort(reverse=True, key=lambda s: s[0])
        for (begin, _, m), (_, before_end, before) in zip(spans, spans[1:]):
            if before_end > begin:
                sys.exit(f"{LIST}: {before.id} and {m.id} overlap in {path}")
        for begin, end, m in spans:
            text = text[:begin] + choice(m) + text[end:]
        texts[path] = text
    return texts


def write(path, content, mode=0o644):
    """Only what has changed, so that little is built again."""
    if path.exists() and path.read_bytes() == content:
        return
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(content)
    path.chmod(mode)


def build(folder, jobs, chosen, known):
    tree, out = folder / "tree", folder / "build"
    texts = mutated(known)
    files = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, check=True, capture_output=True, text=True).stdout
    for name in filter(None, files.split("\0")):
        source = ROOT / name
        content = texts[name].encode() if name in texts else source.read_bytes()
        write(tree / name, content, source.stat().st_mode & 0o777)
    switch = folder / "mutant.hpp"
    write(switch, SWITCH.encode())
    programs = sorted({p.split("@")[0] for m in chosen for p in m.programs})
    log = folder / "build.log"
    with log.open("w") as to:
        for command in (["cmake", "-S", tree, "-B", out, "-G", "Ninja", "-DFULMAR_TESTS=ON", "-DCMAKE_BUILD_TYPE=Release",
                         "-DCMAKE_CXX_FLAGS_RELEASE=-O1 -DNDEBUG", f"-DCMAKE_CXX_FLAGS=-w -include {switch}"],
                        ["ninja", "-C", out, "-j", str(jobs), "fulmar", *programs]):
            if subprocess.run(command, stdout=to, stderr=to).returncode:
                sys.exit(f"the build with the faults in it failed: {log}")
    return out / "bin"


def passes(bin_folder, program, folder, mutant="0"):
    """`program` or `program@part`: the tests of the source files whose name contains `part`."""
    name, _, part = program.partition("@")
    command = [bin_folder / name, "--abort-after=1"] + ([f"--source-file=*{part}*"] if part else [])
    try:
        return subprocess.run(command, cwd=folder, stdout=subprocess.DEVNULL,
                              stderr=subprocess.DEVNULL, timeout=LIMIT_S,
                              env=dict(os.environ, FULMAR_MUTANT=mutant)).returncode == 0
    except subprocess.TimeoutExpired:
        return False


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--folder", type=pathlib.Path, default=ROOT / "build-mutants")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="of the build")
    parser.add_argument("--only-list", action="store_true", help="build and run nothing")
    parser.add_argument("id", nargs="*", help="faults of the list; all when none is named")
    given = parser.parse_args()
    known = mutants()
    unknown = set(given.id) - {m.id for m in known}
    if unknown:
        sys.exit(f"no such fault in {LIST}: {' '.join(sorted(unknown))}")
    if given.only_list:
        mutated(known)
        return 0
    chosen = [m for m in known if not given.id or m.id in given.id]
    folder = given.folder.resolve()
    bin_folder = build(folder, given.jobs, chosen, known)
    for program in sorted({p for m in chosen for p in m.programs}):
        if not passes(bin_folder, program, folder / "build"):
            sys.exit(f"{program} fails without a fault")
    survivors, equivalents = [], []
    for m in chosen:
        by = next((p for p in m.programs if not passes(bin_folder, p, folder / "build", m.id)), None)
        if not by:
            (equivalents if m.equivalent else survivors).append(m)
        print(f"{m.id:>5} {m.path:50} {by or ('equivalent' if m.equivalent else 'SURVIVED')}", flush=True)
    counted = len(chosen) - len(equivalents)
    noticed = counted - len(survivors)
    for m in equivalents:
        print(f"equivalent: {m.id} {m.path}: {m.original} -> {m.mutated}: {m.equivalent}")
    for m in survivors:
        print(f"not noticed: {m.id} {m.path}: {m.original} -> {m.mutated}")
    percent = 100 * noticed // counted if counted else 100
    print(f"{noticed} of {counted} noticed ({percent} %), wanted: {ENOUGH_PERCENT} %")
    return 0 if 100 * noticed >= ENOUGH_PERCENT * counted else 1


if __name__ == "__main__":
    sys.exit(main())

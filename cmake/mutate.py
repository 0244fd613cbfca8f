#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Do the tests notice a fault? Builds the test programs once with every fault of cmake/mutants.txt in them, each
switched on by FULMAR_MUTANT, and runs the programs that cover a fault. Ends with 1 when too few are noticed.

    cmake/mutate.py [--folder FOLDER] [ID...]
"""
import argparse
import collections
import os
import pathlib
import shutil
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

Mutant = collections.namedtuple("Mutant", "id path type programs original mutated")


def mutants():
    found = []
    lines = [(n, l) for n, l in enumerate(LIST.read_text().splitlines(), 1) if l and not l.startswith("#")]
    if len(lines) % 3:
        sys.exit(f"{LIST}: each fault has three lines; there are {len(lines)}")
    for (n, head), (_, old), (_, new) in zip(lines[::3], lines[1::3], lines[2::3]):
        words = head.split()
        if len(words) < 4 or not words[0].isdigit() or old[:2] != "- " or new[:2] != "+ ":
            sys.exit(f"{LIST}:{n}: a fault is 'id file type program...', '- original', '+ mutated'")
        found.append(Mutant(words[0], words[1], words[2], words[3:], old[2:], new[2:]))
    doubled = [i for i, n in collections.Counter(m.id for m in found).items() if n > 1]
    if doubled:
        sys.exit(f"{LIST}: given twice: {' '.join(doubled)}")
    return found


def choice(m):
    if m.type == "statement":
        return f"if (::fulmar_mutant({m.id})) {{ {m.mutated} }} else {{ {m.original} }}"
    return f"(::fulmar_mutant({m.id}) ? {m.type}({m.mutated}) : {m.type}({m.original}))"


def mutate(tree, chosen):
    by_path = collections.defaultdict(list)
    for m in chosen:
        by_path[m.path].append(m)
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
        (tree / path).write_text(text)


def build(folder, chosen):
    tree, out = folder / "tree", folder / "build"
    tree.mkdir(parents=True, exist_ok=True)
    files = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, check=True, capture_output=True, text=True).stdout
    for name in filter(None, files.split("\0")):
        copy = tree / name
        copy.parent.mkdir(parents=True, exist_ok=True)
        if not copy.exists() or (ROOT / name).read_bytes() != copy.read_bytes():
            shutil.copy2(ROOT / name, copy)
    mutate(tree, chosen)
    switch = folder / "mutant.hpp"
    switch.write_text(SWITCH)
    programs = sorted({p for m in chosen for p in m.programs})
    log = folder / "build.log"
    with log.open("w") as to:
        for command in (["cmake", "-S", tree, "-B", out, "-G", "Ninja", "-DFULMAR_TESTS=ON", "-DCMAKE_BUILD_TYPE=Release",
                         "-DCMAKE_CXX_FLAGS_RELEASE=-O1 -DNDEBUG", f"-DCMAKE_CXX_FLAGS=-w -include {switch}"],
                        ["ninja", "-C", out, *programs]):
            if subprocess.run(command, stdout=to, stderr=to).returncode:
                sys.exit(f"the build with the faults in it failed: {log}")
    return out / "bin", programs


def passes(program, folder, mutant="0"):
    try:
        return subprocess.run([program, "--abort-after=1"], cwd=folder, stdout=subprocess.DEVNULL,
                              stderr=subprocess.DEVNULL, timeout=LIMIT_S,
                              env=dict(os.environ, FULMAR_MUTANT=mutant)).returncode == 0
    except subprocess.TimeoutExpired:
        return False


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--folder", type=pathlib.Path, default=ROOT / "build-mutants")
    parser.add_argument("id", nargs="*", help="faults of the list; all when none is named")
    given = parser.parse_args()
    known = mutants()
    unknown = set(given.id) - {m.id for m in known}
    if unknown:
        sys.exit(f"no such fault in {LIST}: {' '.join(sorted(unknown))}")
    chosen = [m for m in known if not given.id or m.id in given.id]
    folder = given.folder.resolve()
    bin_folder, programs = build(folder, chosen)
    for program in programs:
        if not passes(bin_folder / program, folder / "build"):
            sys.exit(f"{program} fails without a fault")
    survivors = []
    for m in chosen:
        by = next((p for p in m.programs if not passes(bin_folder / p, folder / "build", m.id)), None)
        if not by:
            survivors.append(m)
        print(f"{m.id:>5} {m.path:45} {by or 'SURVIVED'}", flush=True)
    noticed = len(chosen) - len(survivors)
    print(f"{noticed} of {len(chosen)} noticed ({100 * noticed // len(chosen)} %), wanted: {ENOUGH_PERCENT} %")
    for m in survivors:
        print(f"not noticed: {m.id} {m.path}: {m.original} -> {m.mutated}")
    return 0 if 100 * noticed >= ENOUGH_PERCENT * len(chosen) else 1


if __name__ == "__main__":
    sys.exit(main())

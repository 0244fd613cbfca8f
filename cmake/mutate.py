#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks that the tests detect faults. Builds the test programs once with every fault of cmake/mutants.txt, each
switched on by FULMAR_MUTANT, and runs the programs that cover a fault. Ends with 1 when too few are noticed.

    cmake/mutate.py [--folder FOLDER] [--jobs N] [ID...]
    cmake/mutate.py --only-list       only whether each fault has its place in the sources
    cmake/mutate.py --draw N --seed S [--in PATH...] [--programs NAME...]
                                      N faults that no list has, drawn from the flight code (of these paths)
"""
import argparse
import collections
import os
import pathlib
import subprocess
import sys

import drawn_faults
import mutant_programs

ROOT = pathlib.Path(__file__).resolve().parent.parent
LIST = ROOT / "cmake/mutants.txt"
ENOUGH_PERCENT = 92
ENOUGH_OF_DRAWN_PERCENT = 85
ROUNDS = 12  # of drawing others for those that the compiler refuses
LIMIT_S = 300  # of one program: a fault that makes it hang is noticed, too
SWITCH = """// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#ifdef __cplusplus
#include <cstdlib>
#include <type_traits>
inline bool fulmar_mutant(int id) {
  static const char* text = std::getenv("FULMAR_MUTANT");
  static const int chosen = text ? std::atoi(text) : 0;
  return chosen == id;
}
// By value: of two expressions with operators of Eigen neither is of the other's type.
template <class T, class = void>
struct FulmarChosen {
  using type = std::decay_t<T>;
};
template <class T>
struct FulmarChosen<T, std::void_t<typename std::decay_t<T>::PlainObject>> {
  using type = typename std::decay_t<T>::PlainObject;
};
template <class T>
typename FulmarChosen<T>::type fulmar_chosen(T&& x) {
  return typename FulmarChosen<T>::type(static_cast<T&&>(x));
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
    """Writes only changed files, so that little is built again."""
    if path.exists() and path.read_bytes() == content:
        return
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(content)
    path.chmod(mode)


def configure(folder, texts, log):
    """A copy of the tree with these texts in it, ready to be built."""
    tree, out = folder / "tree", folder / "build"
    files = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, check=True, capture_output=True, text=True).stdout
    for name in filter(None, files.split("\0")):
        source = ROOT / name
        content = texts[name].encode() if name in texts else source.read_bytes()
        write(tree / name, content, source.stat().st_mode & 0o777)
    switch = folder / "mutant.hpp"
    write(switch, SWITCH.encode())
    if subprocess.run(["cmake", "-S", tree, "-B", out, "-G", "Ninja", "-DFULMAR_TESTS=ON", "-DCMAKE_BUILD_TYPE=Release",
                       "-DCMAKE_CXX_FLAGS_RELEASE=-O1 -DNDEBUG", f"-DCMAKE_CXX_FLAGS=-w -include {switch}"],
                      stdout=log, stderr=log).returncode:
        sys.exit(f"the copy with the faults in it cannot be configured: {log.name}")
    return out


def ninja(out, jobs, targets, log):
    """Builds as much as possible; returns True when all of it was built."""
    command = ["ninja", "-C", out, "-k", "0", "-j", str(jobs), *targets]
    return subprocess.run(command, stdout=log, stderr=log).returncode == 0


def build(folder, jobs, chosen, known):
    programs = sorted({p.split("@")[0] for m in chosen for p in m.programs})
    folder.mkdir(parents=True, exist_ok=True)
    with (folder / "build.log").open("w") as log:
        out = configure(folder, mutated(known), log)
        if not ninja(out, jobs, ["fulmar", *programs], log):
            sys.exit(f"the build with the faults in it failed: {log.name}")
    return out / "bin"


def passes(bin_folder, program, folder, mutant="0"):
    """`program` or `program@part`: the tests of the source files with `part` in their names."""
    name, _, part = program.partition("@")
    command = [bin_folder / name, "--abort-after=1"] + ([f"--source-file=*{part}*"] if part else [])
    try:
        return subprocess.run(command, cwd=folder, stdout=subprocess.DEVNULL,
                              stderr=subprocess.DEVNULL, timeout=LIMIT_S,
                              env=dict(os.environ, FULMAR_MUTANT=mutant)).returncode == 0
    except subprocess.TimeoutExpired:
        return False


def draw(given):
    files = subprocess.run(["git", "ls-files"], cwd=ROOT, check=True, capture_output=True, text=True).stdout.split()
    sources = {f: (ROOT / f).read_text() for f in files
               if drawn_faults.is_flight_code(f) and f.startswith(tuple(given.within))}
    drawing = drawn_faults.Draw(sources, given.seed)
    drawing.draw(given.draw)
    folder = given.folder.resolve().with_name(given.folder.name + "-drawn")
    if given.only_list:
        for m in drawing.drawn():
            print(f"{m.path}:{m.line}: {m.kind}: {m.was} -> {m.now}")
        return 0
    folder.mkdir(parents=True, exist_ok=True)
    with (folder / "build.log").open("w+") as log:
        programs = build_drawn(folder, drawing, given, log)
    return mutant_programs.judge(list(drawing.drawn()), programs, folder, ENOUGH_OF_DRAWN_PERCENT, given.jobs)


def build_drawn(folder, drawing, given, log):
    """The programs with the faults: name -> the files of the tree that it is compiled from."""
    refused = None
    for _ in range(ROUNDS):
        out = configure(folder, drawing.texts(), log)
        compiled = mutant_programs.compiled_of(out, folder / "tree")
        wanted = {path for path, _ in drawing.taken.values()}
        programs = {name: files for name, files in compiled.items()
                    if files & wanted and (not given.programs or name in given.programs)}
        # First the compiler's front end alone, for as few sources as hold all faults.
        places = mutant_programs.refused_places(out, folder / "tree", wanted, programs, given.jobs)
        if not places:
            begin = log.tell()
            if ninja(out, given.jobs, programs, log):
                return programs
            log.seek(begin)
            places = mutant_programs.places_in(log.read(), folder / "tree")
        refused = list(drawing.on_lines(places))
        if not refused:
            break
        print(f"the compiler refuses {len(refused)}: others in their place", flush=True)
        drawing.drop(refused)
    sys.exit(f"the build with the faults in it failed: {log.name}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--folder", type=pathlib.Path, default=ROOT / "build-mutants")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="of the build")
    parser.add_argument("--draw", type=int, metavar="N", help="so many faults that no list has")
    parser.add_argument("--seed", type=int, default=1, metavar="S", help="of the draw")
    parser.add_argument("--in", dest="within", nargs="+", default=[""], metavar="PATH", help="draw from these alone")
    parser.add_argument("--programs", nargs="+", default=[], metavar="NAME", help="run these alone")
    parser.add_argument("--only-list", action="store_true", help="build and run nothing")
    parser.add_argument("id", nargs="*", help="faults of the list; all when none is named")
    given = parser.parse_args()
    if given.draw is not None:
        return draw(given)
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

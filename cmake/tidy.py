#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs clang-tidy on the sources of host and plugins, with `.clang-tidy`, in the batches in which they are compiled.

    tidy.py [BUILD] [--tools]      BUILD (build) has been configured and built; --tools: the programs beside the host as well

A batch is looked at again when its command, one of the project's files that it reads, or .clang-tidy has changed.
"""
import concurrent.futures
import hashlib
import json
import subprocess
import sys
import time
from pathlib import Path

root = Path(__file__).resolve().parent.parent
with_tools = "--tools" in sys.argv
arguments = [a for a in sys.argv[1:] if a != "--tools"]
build = (root / (arguments[0] if arguments else "build")).resolve()
stamps = build / "tidy"
stamps.mkdir(exist_ok=True)


def read_files():
    """The sources of each object, from the depfiles of ninja: {object: [files of the project]}."""
    files, current = {}, []
    for line in subprocess.run(["ninja", "-t", "deps"], cwd=build, capture_output=True, text=True, check=True).stdout.splitlines():
        if line and not line.startswith(" "):
            current = files.setdefault(line.split(":")[0], [])
        elif line.strip() and (build / line.strip()).resolve().is_relative_to(root):
            current.append(str((build / line.strip()).resolve()))
    return files


def output(entry):
    words = entry["command"].split()
    return words[words.index("-o") + 1]


def wanted(entry):
    """Host, plugins and examples; tests and benches are checked by their compilers alone."""
    out = output(entry)
    return out.split("/")[0] in ("core", "links", "plugins", "examples", *["tools"] * with_tools) and "/test" not in out and "_test.dir" not in out and "/abi_1" not in out


def look(entry, digest):
    """Output of clang-tidy for one batch; "" for none."""
    words = [w for w in entry["command"].split() if w not in ("-Wno-subobject-linkage", "-fno-gnu-unique") and not w.startswith("--param=")]  # gcc's own
    words = words[next(i for i, w in enumerate(words) if w.startswith(("-D", "-I", "-isystem"))):]  # behind launcher and compiler
    words = [w.replace('\\"', '"') for w in words[:words.index("-o")]]
    tidy = subprocess.run(["clang-tidy", "--quiet", entry["file"], "--", "-Wno-unknown-warning-option", "-std=c++20", *words],
                          cwd=entry["directory"], capture_output=True, text=True)
    if tidy.returncode == 0:
        (stamps / digest).touch()
        return ""
    return tidy.stdout or tidy.stderr


def main():
    begin = time.monotonic()
    if not (build / "compile_commands.json").exists():
        sys.exit(f"{build} has not been configured")
    made_of, rules = read_files(), (root / ".clang-tidy").read_text()
    jobs = []
    for entry in filter(wanted, json.loads((build / "compile_commands.json").read_text())):
        digest = hashlib.sha256((rules + entry["command"]).encode())
        for file in made_of.get(output(entry), []):
            digest.update(Path(file).read_bytes() if Path(file).exists() else b"")
        jobs.append((entry, digest.hexdigest()))
    fresh = [job for job in jobs if not (stamps / job[1]).exists()]
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        found = [text for text in pool.map(lambda job: look(*job), fresh) if text]
    for text in sorted(set("\n".join(found).splitlines()), key="\n".join(found).splitlines().index) if found else []:
        print(text)
    print(f"{len(jobs)} batches, {len(fresh)} looked at, {len(found)} with findings; {time.monotonic() - begin:.0f} s")
    return bool(found)


if __name__ == "__main__":
    sys.exit(main())

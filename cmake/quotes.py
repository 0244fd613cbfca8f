#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks the code that documents quote against the sources.

  cmake/quotes.py             checks each page of the repository
  cmake/quotes.py FILE...     checks these pages alone

A quote is a code block after the comment `<!-- source: core/run/loop.cpp -->`; the path starts at the root of the repository. The source holds the lines of
the block one after the other. Indentation and empty lines do not count. A line `...` stands for any number of lines that the quote leaves out. Each fault is
one line that starts with the page and the line number; the exit code is then 1.
"""
import argparse
import pathlib
import re
import subprocess
import sys

root = pathlib.Path(__file__).resolve().parent.parent
marker = re.compile(r"<!-- source: (\S+) -->$")


def quotes(text):
    """(line of the marker, source, [(line number, line)] or None without a block) of each quote."""
    lines = text.splitlines()
    fences = [i for i, line in enumerate(lines) if line.startswith("```")]
    opening, closing = fences[::2], fences[1::2]
    for i, line in enumerate(lines):
        found = marker.match(line)
        if not found or any(first < i < last for first, last in zip(opening, closing)):
            continue
        block = None
        if i + 1 in opening:
            end = next((last for last in closing if last > i + 1), len(lines))
            block = [(n + 1, lines[n].strip()) for n in range(i + 2, end) if lines[n].strip()]
        yield i + 1, found[1], block


def parts_of(block):
    """The block cut at each line `...`."""
    parts = [[]]
    for number, line in block:
        if line == "...":
            parts.append([])
        else:
            parts[-1].append((number, line))
    return [part for part in parts if part]


def place(part, source, begin):
    """(index after the first copy of `part` in `source` from `begin`, or None; largest number of lines of `part` that match anywhere)."""
    most = 0
    for start in range(begin, len(source)):
        same = 0
        while same < len(part) and start + same < len(source) and source[start + same] == part[same][1]:
            same += 1
        if same == len(part):
            return start + same, same
        most = max(most, same)
    return None, most


def faults(page, base):
    """The faults of one page, each as a line of text."""
    for number, name, block in quotes(page.read_text(encoding="utf-8")):
        if block is None:
            yield f"{page}:{number}: no code block follows"
            continue
        if not (base / name).is_file():
            yield f"{page}:{number}: there is no file {name}"
            continue
        text = (base / name).read_text(encoding="utf-8")
        source = [line.strip() for line in text.splitlines() if line.strip()]
        at = 0
        for part in parts_of(block):
            end, most = place(part, source, at)
            if end is None:
                line, wanted = part[most]
                yield f"{page}:{line}: {name} does not hold this line here: {wanted}"
                break
            at = end


def pages(names):
    if names:
        return [pathlib.Path(name) for name in names]
    command = ["git", "ls-files", "--cached", "--others", "--exclude-standard", "*.md"]
    listed = subprocess.run(command, cwd=root, capture_output=True, text=True, check=True)
    return [root / name for name in sorted(set(listed.stdout.split())) if (root / name).exists()]


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("pages", nargs="*")
    found = [fault for page in pages(parser.parse_args(arguments).pages) for fault in faults(page, root)]
    for fault in found:
        print(fault.removeprefix(f"{root}/"))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())

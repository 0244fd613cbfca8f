#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Test cases that were removed since a revision, and the number of added ones, to check a redesign.

    test_cases.py REV [REV]      exit code 1 when one is gone; the second revision is HEAD unless given
"""
import re
import subprocess
import sys
from collections import Counter

CASE = re.compile(r'TEST_CASE(?:_FIXTURE|_TEMPLATE(?:_DEFINE)?)?\(\s*(?:[\w:]+,\s*)?((?:"(?:[^"\\]|\\.)*"\s*)+)')


def git(*words):
    return subprocess.run(["git", *words], capture_output=True, text=True, check=True, errors="replace").stdout


def cases(revision):
    names = Counter()
    for file in git("ls-tree", "-r", "--name-only", "--full-tree", revision).split():
        if file.endswith((".cpp", ".hpp")):
            for match in CASE.finditer(git("show", f"{revision}:{file}")):
                names["".join(re.findall(r'"((?:[^"\\]|\\.)*)"', match[1]))] += 1
    return names


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    before, now = cases(sys.argv[1]), cases(sys.argv[2] if len(sys.argv) == 3 else "HEAD")
    gone = list((before - now).elements())
    for name in gone:
        print("gone:", name)
    print(f"{before.total()} test cases before, {now.total()} now; {(now - before).total()} added, {len(gone)} gone")
    return bool(gone)


if __name__ == "__main__":
    sys.exit(main())

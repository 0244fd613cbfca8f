#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Lines of code without comments and blank lines, per folder of core/, tests apart; and functions above 60 lines.

    code_size.py [--most N]     exit code 1 when the part of the host that flies has more than N lines
"""
import re
import subprocess
import sys
from collections import Counter
from pathlib import Path

FLIES = "types loader log isolate graph tap run".split()
FUNCTION_LINES = 60
root = Path(__file__).resolve().parent.parent


def code_lines(text):
    """Strings stay whole: a // inside one starts no comment."""
    pattern = re.compile(r'"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])*\'|//[^\n]*|/\*.*?\*/', re.S)
    bare = pattern.sub(lambda m: m[0] if m[0][0] in "\"'" else "\n" * m[0].count("\n"), text)
    return sum(1 for line in bare.split("\n") if line.strip())


def long_functions(text):
    """Functions at the first column: [(line, lines)]. Bodies end with a brace in that column."""
    lines, begin, found = text.split("\n"), None, []
    for number, line in enumerate(lines, 1):
        if re.match(r"[A-Za-z_].*[)\w] (?:\w+ )*\{$", line) and not re.match(r"(?:namespace|struct|class|enum|union|extern)\b", line):
            begin = number
        elif line == "}" and begin:
            if number - begin + 1 > FUNCTION_LINES:
                found.append((begin, number - begin + 1))
            begin = None
    return found


def main():
    listed = subprocess.run(["git", "ls-files", "core"], cwd=root, capture_output=True, text=True, check=True).stdout.split()
    size = Counter()
    for name in listed:
        if "/test/" in name or not name.endswith((".cpp", ".hpp", ".h", ".c")):
            continue
        text = (root / name).read_text()
        size[name.split("/")[1] if name.count("/") > 1 else "(core)"] += code_lines(text)
        for line, lines in long_functions(text):
            print(f"{name}:{line}: a function of {lines} lines; {FUNCTION_LINES} is the limit")
    for folder, lines in size.most_common():
        print(f"{lines:6d}  {folder}")
    flies = sum(size[folder] for folder in FLIES)
    print(f"{flies:6d}  what flies: {', '.join(FLIES)}")
    print(f"{sum(size.values()) - size['dds']:6d}  core without dds")
    if "--most" in sys.argv:
        sys.exit(flies > int(sys.argv[sys.argv.index("--most") + 1]))


main()

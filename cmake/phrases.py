#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Counts the assertions of tests that quote a phrase, so that a sentence can be improved without a change of a test.

  cmake/phrases.py          prints the count of each folder; exits 1 when there are more than the limit below
  cmake/phrases.py --list   prints each as file:line

An assertion is a call of CHECK..., REQUIRE..., WARN... (doctest), assert... (Python, JavaScript). A phrase is five words or more in one text. The code of a
message with its arguments, `graph.key_unknown(rate, Hz)`, and the name of a port, `nav.state.height_m`, are none.
"""
import re
import subprocess
import sys

limit = 60
words_of_phrase = 5
call = re.compile(r"\b(?:(?:CHECK|REQUIRE|WARN)\w*|(?:self\.)?assert\w*(?:\.\w+)?)\(")
text = re.compile(r'"((?:[^"\\\n]|\\.)*)"(?:\s*"((?:[^"\\\n]|\\.)*)")*')
message = re.compile(r"\b[a-z]\w*(?:\.[a-z]\w*)+(?:\([^\n]*\)?)?")


def end_of(source, begin):
    """The place after the bracket that closes the one before `begin`."""
    depth, i = 1, begin
    while i < len(source) and depth:
        if source[i] == '"':
            i += 1
            while i < len(source) and source[i] != '"':
                i += 2 if source[i] == "\\" else 1
        depth += {"(": 1, ")": -1}.get(source[i], 0) if i < len(source) else 0
        i += 1
    return i


def phrases(source):
    """The lines of the assertions that quote a phrase."""
    for found in call.finditer(source):
        inside = source[found.end():end_of(source, found.end())]
        for quoted in text.finditer(inside):
            whole = "".join(re.findall(r'"((?:[^"\\\n]|\\.)*)"', quoted[0]))
            plain = message.sub("", whole.replace("\\n", "\n"))
            if " " in plain and max(len(re.findall(r"[A-Za-z][A-Za-z'-]*", line)) for line in plain.split("\n")) >= words_of_phrase:
                yield source.count("\n", 0, found.start()) + 1
                break


def main():
    listed = subprocess.run(["git", "ls-files"], capture_output=True, text=True, check=True).stdout.split()
    tests = [f for f in listed if re.search(r"(^|/)test/|_test\.\w+$", f) and f.endswith((".cpp", ".hpp", ".py", ".mjs"))]
    counts, total = {}, 0
    for file in tests:
        with open(file, encoding="utf-8") as source:
            lines = list(phrases(source.read()))
        total += len(lines)
        folder = "/".join(file.split("/")[:2])
        counts[folder] = counts.get(folder, 0) + len(lines)
        if "--list" in sys.argv:
            print(*(f"{file}:{line}" for line in lines), sep="\n", end="\n" if lines else "")
    for folder, count in sorted(counts.items(), key=lambda entry: -entry[1]):
        if count and "--list" not in sys.argv:
            print(f"{count:5} {folder}")
    print(f"{total} assertions quote a phrase of {words_of_phrase} words or more; the limit is {limit}")
    return 1 if total > limit else 0


if __name__ == "__main__":
    sys.exit(main())

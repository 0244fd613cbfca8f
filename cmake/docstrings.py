#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Lists public declarations of the SDK's flight and simulation headers, and C functions of the simulation library, that have no comment.

  docstrings.py [FILE...]     exits 1 when a declaration has no docstring and is not in cmake/docstrings_missing.txt, or when that list names one that is
                              documented or does not exist

A docstring is a comment that ends on the line above the declaration or stands on one of its lines. Declarations are free functions, structs, classes, unions
and enums of a namespace; namespaces without a name or called `detail`, forward declarations and definitions of members are left out. Of a .cpp file only
the functions in extern "C" count.
"""
import pathlib
import re
import subprocess
import sys

HEADERS = ["sdk/include/fulmar/flight/*.hpp", "sdk/include/fulmar/sim/*.hpp", "tools/fulmar_sim/library.cpp"]
LIST = "cmake/docstrings_missing.txt"

BLANK = re.compile(r'R"([^(\s]*)\(.*?\)\1"|(?P<comment>//(?:\\\n|[^\n])*|/\*.*?\*/)|"(?:\\.|[^"\\\n])*"|'
                   r"(?<![0-9a-fA-F])'(?:\\.|[^'\\\n])+'|^[ \t]*#(?:\\\n|[^\n])*", re.S | re.M)
NOT_FUNCTIONS = re.compile(r"(using|typedef|friend|static_assert|namespace|extern template)\b")
TYPE = re.compile(r"(?:struct|class|union|enum(?: class| struct)?)\s+(?:alignas\s*\([^)]*\)\s*|\[\[[^\]]*\]\]\s*)*(\w+)(?!\s*::)")
FUNCTION = re.compile(r"(operator\s*(?:\(\s*\)|\[\s*\]|[^\s\w(]+|[\w:]+)|(?<![\w:])\w+)\s*$")


def read(text):
    """The text with comments, literals and directives as blanks (a quote stays for a literal), and the lines that comments cover."""
    lines = set()

    def blank(match):
        if match["comment"]:
            first = text.count("\n", 0, match.start()) + 1
            lines.update(range(first, first + match[0].count("\n") + 1))
        keep = '"' if match[0][0] in "\"'R" else " "
        return keep + re.sub(r"[^\n]", " ", match[0][1:])
    return BLANK.sub(blank, text), lines


def closed(code, at):
    """The place after the bracket that closes `code[at]`."""
    opens, shuts, depth = code[at], {"(": ")", "{": "}", "[": "]", "<": ">"}[code[at]], 0
    for place in range(at, len(code)):
        depth += (code[place] == opens) - (code[place] == shuts)
        if depth == 0:
            return place + 1
    return len(code)


def without_template(head):
    """A declaration without `template <...>`, `requires (...)` and attributes before it."""
    while match := re.match(r"\s*(template\s*<|requires\s*\(|\[\[)", head):
        head = head[closed(head, match.end() - (2 if match[1] == "[[" else 1)):]
    return re.sub(r"^\s*requires\s+[\w:]+\s*(<[^{;()]*>)?", "", head).strip()


def name_of(head, opens):
    """The name of a declaration, or None: `head` is its text up to `{` or `;`, `opens` is that character."""
    if re.match(r"\s*template\s*<\s*>", head):
        return None
    head = without_template(head)
    if match := TYPE.match(head):
        if opens == "{" and "(" not in re.sub(r"alignas\s*\([^)]*\)", "", head):
            return match[1]
    if NOT_FUNCTIONS.match(head) or "(" not in head:
        return None
    operator = re.search(r"\boperator\s*\(\s*\)", head)
    before = head[:head.index("(", operator.end() if operator else 0)]
    if "=" in re.sub(r"operator\s*[=!<>+\-*/]*=", "", before):
        return None
    match = FUNCTION.search(before)
    return match[1] if match and before[:match.start()].strip() else None


def declarations(text, only_c=False):
    """(name, has a docstring) of each declaration at namespace level."""
    code, comments = read(text)
    alone = {line for line in comments if not code.split("\n")[line - 1].strip()}
    found, scopes, start, at = [], [], 0, 0  # of each scope: whether it is of C, whether it is hidden

    def declared(end, opens):
        head = code[start:end]
        if not (name := name_of(head, opens)):
            return
        if only_c and not any(c for c, _ in scopes) or any(hidden for _, hidden in scopes):
            return
        first = text.count("\n", 0, start + len(head) - len(head.lstrip())) + 1
        last = text.count("\n", 0, end) + 1
        found.append((name, first - 1 in alone or any(line in comments for line in range(first, last + 1))))

    while at < len(code):
        char, head = code[at], code[start:at]
        if char == "{":
            scope = re.match(r"\s*(?:inline\s+)?namespace\b\s*([\w:]*)\s*$", head)
            of_c = re.match(r'\s*extern\s+"\s*$', head)
            if scope or of_c:
                scopes.append((bool(of_c), bool(scope) and scope[1] in ("", "detail")))
                start = at = at + 1
                continue
            declared(at, "{")
            start = at = closed(code, at)
            continue
        if char == "(":
            at = closed(code, at)
            continue
        if char == "}":
            if scopes:
                scopes.pop()
            start = at + 1
        elif char == ";":
            declared(at, ";")
            start = at + 1
        at += 1
    return found


def missing(files):
    """`file: name` of each declaration without a docstring; a name counts once a file."""
    out = []
    for file in files:
        bare = [name for name, documented in declarations(pathlib.Path(file).read_text(), str(file).endswith(".cpp")) if not documented]
        out.extend(f"{file}: {name}" for name in dict.fromkeys(bare))
    return out


def main(arguments):
    files = arguments
    if not files:
        files = subprocess.run(["git", "ls-files", *HEADERS], capture_output=True, text=True, check=True).stdout.split()
    found = missing(files)
    path = pathlib.Path(LIST)
    allowed = [line for line in path.read_text().splitlines() if line and not line.startswith("#")] if path.exists() else []
    faults = [f"{entry}: no docstring" for entry in found if entry not in allowed]
    if not arguments:
        faults += [f"{entry}: remove it from {LIST}" for entry in allowed if entry not in found]
    print(*faults, sep="\n", end="\n" if faults else "")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Lines of code without comments and blank lines, per folder of core/ and links/, tests apart; and what is too large.

    code_size.py                prints the lines; exit code 1 when a limit below is exceeded
    code_size.py --most N       the same, and when the part of the host that flies has more than N lines
    code_size.py --members      the data members of each struct of core/ and links/

Limits: a file has 400 lines, comments included, or what cmake/long_files.txt lists for it, a list that only shrinks; a
function of core/ and links/ has 60 lines, a struct of these 15 data members.
"""
import re
import subprocess
import sys
from collections import Counter
from pathlib import Path

FLIES = "types loader log isolate graph tap run".split()
FUNCTION_LINES, FILE_LINES, MEMBERS = 60, 400, 15
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


def structs(text):
    """Every struct and class of a source with the number of its data members: [(name, members)]."""
    text = re.sub(r"//[^\n]*|/\*.*?\*/|^#[^\n]*", "", text, flags=re.S | re.M)
    text = re.sub(r'"(?:\\.|[^"\\])*"', '""', text)
    out, pattern = [], re.compile(r"\b(?:struct|class)\s+([\w:]+)(?:\s+final)?\s*(?::[^;{]*)?\{")
    for match in pattern.finditer(text):
        if re.search(r"\benum\s*$", text[:match.start()]):
            continue
        depth, body = 1, []
        for char in text[match.end():]:
            depth += (char == "{") - (char == "}")
            if depth == 0:
                break
            if depth == 1:
                body.append(";" if char == "}" else char)  # what a brace held ends here: a function, a type, an initial value
        out.append((match[1], sum(map(declared, "".join(body).split(";")))))
    return out


def declared(statement):
    """How many data members a statement at the first level of a struct declares."""
    statement = re.sub(r"\b(?:public|private|protected)\s*:", "", statement).strip()
    while re.search(r"<[^<>]*>", statement):
        statement = re.sub(r"<[^<>]*>", "", statement)
    if re.match(r"(?:static|using|friend|enum|struct|class|union|template|explicit|virtual|typedef|=|[),&|])", statement) or "operator" in statement:
        return 0
    declaration = statement.split("=")[0]
    if "(" in declaration or not re.match(r"[\w:\s&*\[\],]+$", declaration) or not re.search(r"[\w\]&*>]\s+[\w*&]", declaration):
        return 0
    return 1 + re.sub(r"\([^()]*\)|\[[^\[\]]*\]", "", statement).count(",")


def long_files(names):
    """Faults: files above the limit, and entries of the list that are too generous."""
    listed = {}
    for line in (root / "cmake/long_files.txt").read_text().splitlines():
        lines, name = line.split()
        listed[name] = int(lines)
    found = []
    for name in names:
        lines = (root / name).read_text().count("\n")
        limit = max(FILE_LINES, listed.pop(name, 0))
        if lines > limit:
            found.append(f"{name} has {lines} lines; {limit} is the limit")
        elif limit > FILE_LINES and lines < limit:
            found.append(f"cmake/long_files.txt: {name} has {lines} lines, not {limit}: {'write that' if lines > FILE_LINES else 'drop the line'}")
    return found + [f"cmake/long_files.txt: there is no file {name}" for name in listed]


def git_files(*folders):
    listed = subprocess.run(["git", "ls-files", *folders], cwd=root, capture_output=True, text=True, check=True).stdout.split()
    return [name for name in listed if (root / name).exists() and not name.startswith("core/test/abi_1/")]


def main():
    faults = long_files([f for f in git_files() if f.endswith((".cpp", ".hpp", ".h", ".c", ".ts", ".py", ".sh", ".mjs"))])
    size = Counter()
    for name in git_files("core", "links"):
        if "/test/" in name or not name.endswith((".cpp", ".hpp", ".h", ".c")):
            continue
        text = (root / name).read_text()
        top, *folders = name.split("/")[:-1]
        size[f"links/{folders[0]}" if top == "links" else folders[0] if folders else "(core)"] += code_lines(text)
        faults += [f"{name}:{line}: a function of {lines} lines; {FUNCTION_LINES} is the limit" for line, lines in long_functions(text)]
        for struct, members in structs(text):
            if "--members" in sys.argv:
                print(f"{members:4d} {struct} ({name})")
            if members > MEMBERS:
                faults.append(f"{name}: {struct} has {members} data members; {MEMBERS} is the limit")
    for folder, lines in size.most_common():
        print(f"{lines:6d}  {folder}")
    flies = sum(size[folder] for folder in FLIES)
    print(f"{flies:6d}  what flies: {', '.join(FLIES)}")
    print(f"{sum(lines for folder, lines in size.items() if not folder.startswith('links/')):6d}  core")
    print("\n".join(faults), end="\n" if faults else "", file=sys.stderr)
    sys.exit(bool(faults) or "--most" in sys.argv and flies > int(sys.argv[sys.argv.index("--most") + 1]))


main()

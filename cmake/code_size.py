#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Lines of code without comments and blank lines, per folder of core/ and links/, without tests; and parts that are too large.

    code_size.py                prints the lines; exit code 1 when a limit below is exceeded
    code_size.py --most N       the same, and when the part of the host that flies has more than N lines
    code_size.py --members      the data members of each struct of core/, links/, plugins/ and tools/

Limits: a file has 400 lines, comments included, or what cmake/long_files.txt lists for it; a function of core/ and
links/ has 60 lines, a struct of these 15 data members; a struct of plugins/ and tools/ has 25 data members, ports and
parameters included, or what cmake/wide_structs.txt lists for it. Both lists only shrink. A catalogue of messages
(messages.hpp, MessageText) is a table of texts: it is counted apart and may be long.
"""
import re
import subprocess
import sys
from collections import Counter
from pathlib import Path

FLIES = "types loader log isolate graph tap run".split()
FUNCTION_LINES, FILE_LINES, MEMBERS, PLUGIN_MEMBERS = 60, 400, 15, 25
root = Path(__file__).resolve().parent.parent


def code_lines(text):
    """Strings are skipped: a // inside one starts no comment."""
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
        for at in range(match.end(), len(text)):
            char = text[at]
            depth += (char == "{") - (char == "}")
            if depth == 0:
                break
            if depth == 1:  # what a brace held ends here: a function, a type, an initial value that no other follows
                body.append(char if char != "}" else "" if text[at + 1:at + 2] == "," else ";")
        out.append((match[1], sum(map(declared, "".join(body).split(";")))))
    return out


def declared(statement):
    """Number of data members that a statement at the first level of a struct declares."""
    statement = re.sub(r"\b(?:public|private|protected)\s*:", "", statement).strip()
    while re.search(r"<[^<>]*>", statement):
        statement = re.sub(r"<[^<>]*>", "", statement)
    if re.match(r"(?:static|using|friend|enum|struct|class|union|template|explicit|virtual|typedef|=|[),&|])", statement) or "operator" in statement:
        return 0
    declaration = statement.split("=")[0]
    if "(" in declaration or not re.match(r"[\w:\s&*\[\],]+$", declaration) or not re.search(r"[\w\]&*>]\s+[\w*&]", declaration):
        return 0
    return 1 + re.sub(r"\([^()]*\)|\[[^\[\]]*\]", "", statement).count(",")


def against_list(kind, found, limit, unit):
    """Faults: sizes above the limit, and entries of the list of exceptions that are too large. `found`: {name: size}."""
    name_of_list = f"cmake/{kind}s.txt"
    listed = {}
    for line in (root / name_of_list).read_text().splitlines():
        size, name = line.split()
        listed[name] = int(size)
    faults = []
    for name, size in found.items():
        most = max(limit, listed.pop(name, 0))
        if size > most:
            faults.append(f"{name} has {size} {unit}; {most} is the limit")
        elif most > limit and size < most:
            faults.append(f"{name_of_list}: {name} has {size} {unit}, not {most}: {'write that' if size > limit else 'drop the line'}")
    return faults + [f"{name_of_list}: there is no {kind.split('_')[1]} {name}" for name in listed]


def members_of(folders):
    """{file:struct: data members}; of structs of one name in a file the largest."""
    found = {}
    for name in git_files(*folders):
        if "/test/" not in name and name.endswith((".cpp", ".hpp", ".h", ".c")):
            for struct, members in structs((root / name).read_text()):
                found[f"{name}:{struct}"] = max(members, found.get(f"{name}:{struct}", 0))
    return found


def git_files(*folders):
    listed = subprocess.run(["git", "ls-files", *folders], cwd=root, capture_output=True, text=True, check=True).stdout.split()
    return [name for name in listed if (root / name).exists() and not name.startswith("core/test/abi_1/")]


def is_catalogue(name):
    return name.endswith("messages.hpp") and "MessageText" in (root / name).read_text()


def main():
    sources = [f for f in git_files() if not is_catalogue(f) and f.endswith((".cpp", ".hpp", ".h", ".c", ".ts", ".py", ".sh", ".mjs"))]
    faults = against_list("long_file", {f: (root / f).read_text().count("\n") for f in sources}, FILE_LINES, "lines")
    core, plugins = members_of(["core", "links"]), members_of(["plugins", "tools"])
    faults += [f"{name} has {n} data members; {MEMBERS} is the limit" for name, n in core.items() if n > MEMBERS]
    faults += against_list("wide_struct", plugins, PLUGIN_MEMBERS, "data members")
    if "--members" in sys.argv:
        print("\n".join(f"{members:4d} {name}" for name, members in {**core, **plugins}.items()))
    size = Counter()
    for name in git_files("core", "links"):
        if "/test/" in name or not name.endswith((".cpp", ".hpp", ".h", ".c")):
            continue
        text = (root / name).read_text()
        if is_catalogue(name):
            size["links/texts"] += code_lines(text)
            continue
        top, *folders = name.split("/")[:-1]
        size[f"links/{folders[0]}" if top == "links" else folders[0] if folders else "(core)"] += code_lines(text)
        faults += [f"{name}:{line}: a function of {lines} lines; {FUNCTION_LINES} is the limit" for line, lines in long_functions(text)]
    texts = size.pop("links/texts", 0)
    for folder, lines in size.most_common():
        print(f"{lines:6d}  {folder}")
    print(f"{texts:6d}  catalogues of messages, not in the sums below")
    flies = sum(size[folder] for folder in FLIES)
    print(f"{flies:6d}  what flies: {', '.join(FLIES)}")
    print(f"{sum(lines for folder, lines in size.items() if not folder.startswith('links/')):6d}  core")
    print("\n".join(faults), end="\n" if faults else "", file=sys.stderr)
    sys.exit(bool(faults) or "--most" in sys.argv and flies > int(sys.argv[sys.argv.index("--most") + 1]))


main()

#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks the prose of the documents against docs/style.md, and counts it.

  cmake/prose.py              exits 1 and lists each fault as file:line
  cmake/prose.py --count      prints words and the longest sentences of each page as well
  cmake/prose.py FILE...      checks these files alone
  cmake/prose.py --built BUILD
                              checks the help of the programs of a build and the descriptions in its reference alone

Without files, the catalogues of messages are checked too. A page whose second paragraph says "Written by `command`" is
generated; its words are counted apart. Code blocks and code spans are left out of the rules, not of the count.
"""
import argparse
import os
import pathlib
import re
import subprocess
import sys

longest_sentence = 40
most_words = 65000  # of all pages that are not generated

# The left column of the glossary, as expressions that have no other use in a document.
terms = {
    r"\btell(s|ing)?\b|\btold\b": "report",
    r"\b(no|some|every)body\b": "component, reader",
    r"\b(who|what)ever\b": "each component, each value",
    r"\banew\b": "again",
    r"\bclaimed\b|\bclaims\b": "reported",
    r"\bthe tube\b|\btubes?\b": "pitot",
    r"\bat (its|their) stops?\b": "saturated",
    r"\bhand-overs?\b": "bumpless transfer, switch",
    r"\bonlookers?\b": "client",
    r"\bborne out\b|\bin vain\b|\bbids?\b": "plain verb",
    r"\bgets? company\b|\bneighbours?\b": "plain noun",
}

# A description of a component, a parameter or a field is a noun phrase.
description_terms = {
    **terms,
    r"(?<!standard )(?<!Allan )\bdeviations?\b": "standard deviation, error",
    r"\bby hand\b|\bas far as\b": "plain noun",
}
help_terms = {
    **description_terms,
    r"\bwords? of\b": "subcommand",
    r"\bso (many|much)\b": "the name of the value, as in SECONDS",
    r"\brefused?\b": "rejected",
    r"\b(is|are) called\b": "name",
    r"\bdo not ask\b": "skip the confirmation",
}
first_words = r"(until|while|whether|what|who|how|if|when|and|or|to|not|else|its|their)\b"
described = {"component": 2, "parameter": 2, "field": 1}  # the first column of a table, and the fewest words of a text


def pages(names):
    if names:
        return [pathlib.Path(name) for name in names]
    listed = subprocess.run(["git", "ls-files", "--cached", "--others", "--exclude-standard", "*.md"], capture_output=True, text=True, check=True)
    return [pathlib.Path(name) for name in sorted(set(listed.stdout.split())) if pathlib.Path(name).exists()]


def is_generated(text):
    return re.search(r"^Written by `", "\n".join(text.splitlines()[:6]), re.MULTILINE) is not None


def paragraphs(text):
    """(line, text) of each paragraph, list item and table cell, without code."""
    found, start, part, fenced = [], 0, [], False

    def close():
        if part:
            found.append((start, " ".join(part)))
        part.clear()

    for number, line in enumerate(text.splitlines(), 1):
        if line.lstrip().startswith("```"):
            fenced = not fenced
            close()
            continue
        if fenced:
            continue
        line = re.sub(r"`[^`]*`", "CODE", line)
        line = re.sub(r"<!--.*?-->", "", line)
        line = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", line)
        stripped = line.strip()
        if not stripped or stripped.startswith("#"):
            close()
            if stripped.startswith("#"):
                found.append((number, stripped.lstrip("# ")))
            continue
        if stripped.startswith("|"):
            close()
            found.extend((number, cell.strip()) for cell in stripped.strip("|").split("|"))
            continue
        if re.match(r"([-*+]|\d+\.) ", stripped):
            close()
            stripped = re.sub(r"^([-*+]|\d+\.) ", "", stripped)
        if not part:
            start = number
        part.append(stripped)
    close()
    return found


def sentences(paragraph):
    return re.split(r"(?<=[.!?;])[)\"*]*\s+(?=[A-Z`*\"(]|CODE)", paragraph)


def words(sentence):
    return re.findall(r"[A-Za-z][A-Za-z0-9'_/-]*", sentence)


def faults(path, text):
    for line, paragraph in paragraphs(text):
        for sentence in sentences(paragraph):
            count = len(words(sentence))
            if count > longest_sentence:
                yield f"{path}:{line}: a sentence of {count} words, at most {longest_sentence}: {sentence[:70]} ..."
            if re.match(r"(What|Who|Whoever|Whatever)\b[^?]*$", sentence):
                yield f"{path}:{line}: a sentence begins with a relative clause as its subject: {sentence[:70]}"
        if path.as_posix() == "docs/style.md":
            continue
        for term, standard in terms.items():
            for match in re.finditer(term, paragraph, re.IGNORECASE):
                yield f"{path}:{line}: '{match[0]}'; use: {standard}"


def descriptions(text):
    """(line, column, name, description) of each row of the tables that `described` names."""
    head = []
    for number, line in enumerate(text.splitlines(), 1):
        cells = [cell.strip() for cell in re.split(r"(?<!\\)\|", line)[1:-1]]
        if not cells:
            head = []
        elif not head:
            head = cells
        elif head[0] in described and head[-1] == "what" and len(cells) == len(head) and cells[-1].strip("-"):
            yield number, head[0], re.sub(r"[`\[\]]|\(.*", "", cells[0]), cells[-1]


def description_faults(path, text):
    for line, column, name, description in descriptions(text):
        where = f"{path}:{line}: {column} {name}"
        if len(description.split()) < described[column]:
            yield f"{where}: '{description}' is too short, at least {described[column]} words"
        if re.match(first_words, description, re.IGNORECASE):
            yield f"{where}: not a noun phrase: {description[:70]}"
        plain = re.sub(r"`[^`]*`", "CODE", description)
        for term, standard in description_terms.items():
            for match in re.finditer(term, plain, re.IGNORECASE):
                yield f"{where}: '{match[0]}'; use: {standard}"


entry = re.compile(r'MessageText (\w+)\{\s*"([^"]*)",\s*(?:\{[^}]*\},\s*)?((?:"(?:[^"\\]|\\.)*"\s*)+)\}')


def braces_pair(sentence):
    """Whether each brace that is printed has its partner: `{{` is written for one that opens, `}` for one that closes."""
    depth = 0
    for part in re.findall(r"\{\{|\{\w+\}|\}", sentence):
        depth += {"{{": 1, "}": -1}.get(part, 0)
        if depth < 0:
            return False
    return depth == 0


def message_faults(path, text):
    """Of a catalogue of messages: codes that are not the name of the entry in its folder, and the terms and braces of their sentences."""
    folder = re.search(r"namespace fulmar::(\w+)_messages", text)
    for found in entry.finditer(text):
        where = f"{path}:{text.count(chr(10), 0, found.start()) + 1}"
        if folder is None or found[2] != f"{folder[1]}.{found[1].removesuffix('_')}":
            yield f"{where}: the code '{found[2]}' is not the name of its entry"
        sentence = "".join(re.findall(r'"((?:[^"\\]|\\.)*)"', found[3]))
        if not braces_pair(sentence):
            yield f"{where}: a brace without its partner: {sentence[:70]}"
        plain = re.sub(r"\{\w+\}|'\w+'", "VALUE", sentence)
        for term, standard in terms.items():
            for match in re.finditer(term, plain, re.IGNORECASE):
                yield f"{where}: '{match[0]}'; use: {standard}"


def check_messages():
    """The number of faults, printed, in the catalogues of messages."""
    listed = subprocess.run(["git", "ls-files", "--cached", "--others", "--exclude-standard", "*messages.hpp"], capture_output=True, text=True, check=True)
    catalogues = [path for path in map(pathlib.Path, listed.stdout.split()) if "MessageText" in path.read_text()]
    found = [fault for path in catalogues for fault in message_faults(path, path.read_text())]
    print(*found, sep="\n", end="\n" if found else "")
    return len(found)


def check_reference(folder):
    """The number of faults, printed, in the descriptions of a folder of generated pages."""
    found = [fault for page in sorted(folder.glob("*.md")) for fault in description_faults(page, page.read_text())]
    print(*found, sep="\n", end="\n" if found else "")
    return len(found)


def helps(program, path=()):
    """(path, help) of a program, of its subcommands and of the programs beside it. One that is not built is left out."""
    run = subprocess.run([program, *path, "--help"], capture_output=True, text=True, stdin=subprocess.DEVNULL)
    if run.returncode:
        return
    yield path, run.stdout
    listed = run.stdout.partition("\nSubcommands:\n")[2].partition("\n\n")[0]
    beside = re.search(r"^Programs beside this one: ([^(]*)", run.stdout, re.MULTILINE) if not path else None
    for name in re.findall(r"^  (\S+)", listed, re.MULTILINE) + (beside[1].replace(",", " ").split() if beside else []):
        yield from helps(program, (*path, name))


def help_faults(path, text):
    where = " ".join(("fulmar", *path, "--help"))
    examples = [line.split() for line in text.splitlines() if line.startswith("Example: ")]
    if examples and not any(set(path) <= set(example) for example in examples):
        yield f"{where}: the example is of another command: {' '.join(examples[-1][1:])}"
    for line in text.splitlines():
        column = re.match(r"\s+\S.*?\s{2,}(\S.*)|\s{12,}(\S.*)", line)
        description = (column[1] or column[2]) if column else line
        if column and re.match(first_words, description, re.IGNORECASE):
            yield f"{where}: neither a verb nor a noun phrase: {description[:70]}"
        for term, standard in () if line.startswith("Example: ") else help_terms.items():
            for match in re.finditer(term, description, re.IGNORECASE):
                yield f"{where}: '{match[0]}'; use: {standard}"


def check_help(program):
    """The number of faults, printed, in the help of a program."""
    if not os.access(program, os.X_OK):
        return 0
    found = [fault for path, text in helps(str(program.resolve())) for fault in help_faults(path, text)]
    print(*found, sep="\n", end="\n" if found else "")
    return len(found)


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("files", nargs="*")
    arguments.add_argument("--count", action="store_true", help="print the words of each page")
    arguments.add_argument("--built", type=pathlib.Path, metavar="BUILD", help="check the texts of a build: help and descriptions")
    options = arguments.parse_args()
    if options.built:
        return 1 if check_reference(options.built / "docs/reference") + check_help(options.built / "bin/fulmar") else 0
    written = generated = bad = 0
    for path in pages(options.files):
        text = path.read_text()
        count = len(text.split())
        if is_generated(text):
            generated += count
            continue
        written += count
        of_page = list(faults(path, text))
        bad += len(of_page)
        if options.count:
            print(f"{count:6} {len(of_page):4} {path}")
        else:
            print(*of_page, sep="\n", end="\n" if of_page else "")
    if not options.files:
        bad += check_messages()
    print(f"{written} words, {generated} more in generated pages, {bad} faults")
    if not options.files and written > most_words:
        print(f"more than {most_words} words in pages that are not generated")
        return 1
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())

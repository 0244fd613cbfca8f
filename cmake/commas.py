#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""One statement a line: finds the statements that a comma operator chains (`a = 1, b = 2;`, `return f(), x;`). Commas of declarations,
initial values, arguments, templates and `for` heads are others, and so are the values that `<<` fills a matrix with.
Usage: commas.py [--fix] FILE...; prints file:line of each chain, or splits them (lay the file out with clang-format then)."""
import re
import sys
from pathlib import Path

BLANK = re.compile(r'R"([^(\s]*)\(.*?\)\1"|//(?:\\\n|[^\n])*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|(?<![0-9a-fA-F])\'(?:\\.|[^\'\\\n])+\'|^[ \t]*#(?:\\\n|[^\n])*', re.S | re.M)
TOKEN = re.compile(r"[A-Za-z_]\w*|\d[\w.']*|::|->|<<=|>>=|<=>|<<|[-+*/%&|^=!<>]=|&&|\|\||\+\+|--|\.\.\.|\S")
CLOSES = {"(": ")", "[": "]", "{": "}"}
SCOPES = {"namespace", "struct", "class", "union", "extern", "enum"}
VERBS = {"return", "throw", "delete", "new", "goto", "sizeof", "co_return", "co_await", "co_yield", "this"}
SPECIFIERS = {"static", "const", "constexpr", "constinit", "inline", "thread_local", "volatile", "mutable", "register", "unsigned", "signed",
              "long", "short", "typename", "extern", "struct", "class", "union", "enum", "_Thread_local", "alignas", "decltype"}
DECLARE = {"using", "template", "typedef", "friend", "static_assert", "namespace"}
HEADS = {"if", "for", "while", "switch"}


class Item:
    """A token, or a bracket with its content as one."""

    def __init__(self, text, start, end):
        self.text, self.start, self.end = text, start, end

    def word(self):
        return re.match(r"[A-Za-z_]", self.text) is not None


def strip(text):
    """Comments, literals and directives as blanks; a literal stays a token."""
    def blank(match):
        body = match[0]
        first = "0" if body[0] in "\"'R" else " "
        return first + re.sub(r"[^\n]", " ", body[1:])
    return BLANK.sub(blank, text)


class Reader:
    def __init__(self, text):
        self.tokens = [Item(m[0], m.start(), m.end()) for m in TOKEN.finditer(strip(text))]
        self.at = 0
        self.chains = []  # (items before the chain, items of the chain, places of its commas)
        self.read(None, "scope")

    def read(self, close, kind):
        """Up to the bracket `close`; `kind` is scope, code or list."""
        items = []
        while self.at < len(self.tokens):
            token = self.tokens[self.at]
            self.at += 1
            if token.text == close:
                break
            if token.text in CLOSES:
                inner = classify(items, kind) if token.text == "{" else "list"
                self.read(CLOSES[token.text], inner)
                items.append(Item(token.text, token.start, self.tokens[self.at - 1].end))
                if inner == "code" and kind != "list" and not is_lambda(items[:-1]):
                    items = []
            elif token.text == ";":
                if kind == "code":
                    self.check(items, token)
                items = []
            else:
                items.append(token)

    def check(self, items, end):
        head = skip_head(items)
        body = items[head:]
        if not body or is_declaration(body):
            return
        outside = [body[i] for i in outside_templates(body)]
        commas = [item for item in outside if item.text == ","]
        fills = [item.text for item in outside if item.text in ("<<", "=", ",")][:1] == ["<<"]
        if commas and not fills:
            self.chains.append((items[:head], body, commas, end))


def before_type(items):
    """The place of `->` when a trailing return type ends here, else the end."""
    i = len(items)
    while i and (items[i - 1].word() or items[i - 1].text in ("::", "<", ">", "*", "&", "&&", ",")):
        i -= 1
    return i - 1 if i > 1 and items[i - 1].text == "->" and items[i - 2].text in ("(", "]") else len(items)


def is_lambda(items):
    i = before_type(items)
    while i and items[i - 1].text in ("mutable", "noexcept", "const", "constexpr"):
        i -= 1
    if i > 1 and items[i - 1].text == "(" and items[i - 2].text in ("[", ">", "noexcept"):
        i -= 1
    return i > 0 and items[i - 1].text == "[" and (i < 2 or not (items[i - 2].word() and items[i - 2].text not in VERBS) and
                                                   items[i - 2].text not in ("(", "[", ">"))


def classify(items, kind):
    """Kind of the content of a brace after these items."""
    if is_lambda(items):
        return "code"
    words = [item.text for item in items]
    if kind != "list" and SCOPES & set(words) and "=" not in words:
        named = [w for i, w in enumerate(words) if w == "(" and words[i - 1] not in ("alignas", "__attribute__")]
        if not named:
            return "list" if "enum" in words else "scope"
    if kind == "list":
        return "list"
    if not items or words[-1] in ("else", "do", "try", ":", "const", "noexcept", "override", "final", "&&"):
        return "code"
    if words[-1] == "(" or before_type(items) < len(items):
        return "code"
    return "code" if kind == "scope" and words[-1] == "{" and ":" in words else "list"


def skip_head(items):
    """Number of items before the statement itself: labels and the heads of control statements."""
    i = 0
    while i < len(items):
        text = items[i].text
        if text in HEADS:
            i += 1 + (i + 1 < len(items) and items[i + 1].text == "constexpr")
            i += i < len(items) and items[i].text == "("
        elif text in ("else", "do"):
            i += 1
        elif text == "case" or text == "default" or (items[i].word() and i + 1 < len(items) and items[i + 1].text == ":"):
            while i < len(items) and items[i].text != ":":
                i += 1
            i += 1
        elif text == "[" and (i == 0 or items[i - 1].text == "("):  # an attribute
            rest = [item.text for item in items[i + 1:i + 2]]
            if rest in (["("], ["{"], ["="], ["mutable"]):
                return i
            i += 1
        else:
            return i
    return i


def template_end(items, i):
    """The place after the template arguments that begin at `<`, or None for a comparison."""
    depth = 0
    for k in range(i, len(items)):
        text = items[k].text
        depth += (text == "<") - (text == ">")
        if depth == 0:
            after = items[k + 1].text if k + 1 < len(items) else ";"
            fits = after in ("(", "{", "::", ">", ",", "&", "*", "&&", "...", "[", ";") or re.match(r"[A-Za-z_]", after)
            return k + 1 if fits else None
        if text in ("=", ".", "&&", "||", "?", "+=", "-=", "==", "!", "<<"):
            return None
    return None


def outside_templates(items):
    places, i = [], 0
    while i < len(items):
        named = i and (items[i - 1].word() or (i > 1 and items[i - 2].text == "operator"))
        if items[i].text == "<" and named and (end := template_end(items, i)):
            i = end
            continue
        places.append(i)
        i += 1
    return places


def is_declaration(items):
    """True when a statement begins with a type and a name."""
    if items[0].text in DECLARE or items[0].text in SPECIFIERS:
        return True
    if items[0].text in VERBS or not (items[0].word() or items[0].text == "::"):
        return False
    kept = [items[i].text for i in outside_templates(items)]
    i = kept[0] == "::"
    while i + 1 < len(kept) and kept[i + 1] == "::":
        i += 2
    i += 1
    i += i + 1 < len(kept) and kept[i] == "(" and re.match(r"[A-Za-z_]", kept[i + 1]) is not None  # a macro names the type
    while i < len(kept) and kept[i] in ("const", "*", "&", "&&", "volatile"):
        i += 1
    return i < len(kept) and (re.match(r"[A-Za-z_]", kept[i]) is not None or (kept[0] == "auto" and kept[i] == "["))


def split(text, chains):
    """The text with each chain as separate statements, in braces where a head had none."""
    edits = []  # (place, characters to drop, what comes there)
    for head, body, commas, end in chains:
        for comma in commas:
            rest = text[comma.end:].split("\n", 1)[0].strip()
            edits.append((comma.start, 1, ";" if rest.startswith("//") or not rest else ";\n"))
        if body[0].text == "return":
            edits.append((body[0].start, len("return"), ""))
            edits.append((commas[-1].end, 0, " return "))
        if head and head[-1].text != ":":
            edits.append((head[-1].end, 0, " {\n"))
            rest, line = text[end.end:].split("\n", 1)[0].strip(), text.find("\n", end.end)
            edits.append((line, 0, "\n}") if rest.startswith("//") else (end.end, 0, "\n}" + ("\n" if rest else "")))
    for place, drop, new in sorted(edits, key=lambda edit: edit[0], reverse=True):
        text = text[:place] + new + text[place + drop:]
    return text


def main(arguments):
    fix = "--fix" in arguments
    count = 0
    for file in (a for a in arguments if a != "--fix"):
        text = Path(file).read_text()
        chains = Reader(text).chains
        if fix and chains:
            Path(file).write_text(split(text, chains))
            continue
        for _, body, _, _ in chains:
            line = text.count("\n", 0, body[0].start) + 1
            print(f"{file}:{line}: {text.splitlines()[line - 1].strip()}")
            count += 1
    return count > 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

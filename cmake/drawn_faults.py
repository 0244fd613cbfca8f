# SPDX-License-Identifier: BSD-3-Clause
"""One-line faults, drawn from the flight code: another operator, sign, comparison, constant, axis or function, a
condition negated, a statement dropped. Each is put beside the original, and FULMAR_MUTANT chooses between them
at run time: many faults share one build. The layout of clang-format tells a binary operator from other uses of
the same character."""
import collections
import random
import re

FOLDERS = ("sdk/include/fulmar/flight/", "sdk/include/fulmar/sim/", "plugins/estimator_ekf/", "plugins/control_slc/",
           "plugins/control_tecs/", "plugins/control_manual/", "plugins/path/", "plugins/safety/",
           "plugins/fcu_serial/", "plugins/sim_aero/", "plugins/score/", "tools/fulmar_aero/")
# Tests, and the parts of the tools that read and write text.
NOT_FLIGHT = re.compile(r"/test/|_command\.|words|/see/|report|main\.|/check_|_svg\.|options\.|gains_file|/lines\."
                        r"|/read|/planform_|recognise|xml_|airframe_(?:file|text|yaml)|coefficient_json|/import\.")
FIRST_ID = 100000  # the listed faults have smaller ones

# A fault in [begin, end): `new` replaces the text. The fault is put in at `slot`, the expression or
# the statement around it.
Fault = collections.namedtuple("Fault", "kind line begin end new slot statement")
Drawn = collections.namedtuple("Drawn", "id path line kind was now")

SWAPS = {
    "arithmetic": {" + ": " - ", " - ": " + ", " * ": " / ", " / ": " * "},
    "comparison": {" < ": " >= ", " > ": " <= ", " <= ": " > ", " >= ": " < ", " == ": " != ", " != ": " == "},
    "logic": {" && ": " || ", " || ": " && "},
    "truth": {"true": "false", "false": "true"},
    "function": {"std::min": "std::max", "std::max": "std::min", "std::sin": "std::cos", "std::cos": "std::sin",
                 "std::abs": ""},
    "axis": {".x()": ".y()", ".y()": ".x()", ".z()": ".x()", ".north": ".east", ".east": ".north"},
}
TOKENS = re.compile(
    r"(?P<arithmetic> [-+*/] )|(?P<comparison> (?:[<>]=?|[=!]=) )|(?P<logic> (?:&&|\|\|) )"
    r"|(?P<truth>\b(?:true|false)\b)|(?P<function>\bstd::(?:min|max|sin|cos|abs)\b(?=[(<]))"
    r"|(?P<axis>\.(?:[xyz]\(\)|(?:north|east)\b(?!\()))"
    r"|(?P<sign>(?<=[(\[{=?:,] )-(?=[\w(])|(?<=[(\[{])-(?=[\w(])|(?<=return )-(?=[\w(]))"
    r"|(?P<constant>(?<![\w.<'])\d[\d']*(?:\.\d+)?(?:e-?\d+)?(?![\w.>']))")
LITERAL = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|(?<![0-9a-fA-F])\'(?:\\.|[^\'\\\n])*\'', re.S)
# Lines without faults of flight: directives, declared parameters, checks of the compiler, types.
NO_LINE = re.compile(r"^\s*(#|static_assert|using |template\b|enum\b|friend |case .*:$)")
PARAMETER = re.compile(r"^\s*(?:\w*Param\w*|Flag|Count|(?:Choice|Vector|Record)<[\w:]+>) \w+\{")
NO_STATEMENT = r"(?!(?:return|const|constexpr|static|auto|delete|using|break|continue|else)\b)"
STATEMENT = re.compile(r"^\s*" + NO_STATEMENT + r"[A-Za-z_*][\w.:>()\[\]<-]*(?:(?:\(.*\))| [-+*/|&]?= .+);$")
AFTER_A_STATEMENT = re.compile(r"(?:[;{}:]|\belse|\))\s*$")


def masked(text):
    """The same length and lines; comments are blank, literals are quotation marks."""
    def blank(m):
        return re.sub(r"[^\n]", '"' if m.group()[0] in "\"'" else " ", m.group())
    return LITERAL.sub(blank, text)


def matching(text, at):
    """The place after the bracket that closes the one at `at`."""
    depth = 0
    for i in range(at, len(text)):
        depth += (text[i] in "([{") - (text[i] in ")]}")
        if depth == 0:
            return i + 1
    return len(text)


def ends_expression(text, i):
    if text[i] in ",;?":
        return True
    if text[i] == ":":
        return text[i - 1] != ":" and text[i + 1:i + 2] != ":"
    return text[i] == "=" and text[i + 1:i + 2] != "=" and text[i - 1] not in "<>=!"


def expression(text, begin, end):
    """The widest expression around [begin, end) that no bracket, comma, `=`, `?` or `return` cuts."""
    depth, left = 0, begin
    while left > 0:
        c = text[left - 1]
        depth += (c in ")]}") - (c in "([{")
        if depth < 0 or (depth == 0 and (c in "}" or ends_expression(text, left - 1)
                                         or re.search(r"\b(?:return|else)\s$", text[max(0, left - 8):left]))):
            break
        left -= 1
    depth, right = 0, end
    while right < len(text):
        c = text[right]
        depth += (c in "([{") - (c in ")]}")
        if depth < 0 or (depth == 0 and ends_expression(text, right)):
            break
        right += 1
    while left < begin and text[left].isspace():
        left += 1
    while right > end and text[right - 1].isspace():
        right -= 1
    return left, right


def other_constant(number):
    if float(number.replace("'", "")) == 0:
        return number.replace("0", "1", 1)
    return number + " / 2.0" if "." in number else "2 * " + number


def token_fault(text, m, line):
    kind, token = m.lastgroup, m.group()
    begin, end = m.span()
    if kind == "sign":
        return Fault(kind, line, begin, end, "", expression(text, begin, end + 1), False)
    if kind == "constant":
        return Fault(kind, line, begin, end, "(" + other_constant(token) + ")", (begin, end), False)
    if kind == "truth":
        return Fault(kind, line, begin, end, SWAPS[kind][token], (begin, end), False)
    if kind == "function":
        bracket = text.find("(", end)
        return Fault(kind, line, begin, end, SWAPS[kind][token], (begin, matching(text, bracket)), False)
    return Fault(kind, line, begin, end, SWAPS[kind][token], expression(text, begin, end), False)


def line_faults(text, start, line_text, line):
    """Faults of a whole line: a removed statement, a removed summand, an inverted condition."""
    before = text[:start].rstrip()
    whole = STATEMENT.match(line_text) and line_text.count("(") == line_text.count(")")
    if whole and '"' not in line_text and AFTER_A_STATEMENT.search(before):
        begin, end = start + len(line_text) - len(line_text.lstrip()), start + len(line_text)
        yield Fault("statement", line, begin, end, "", (begin, end), True)
        for m in re.finditer(r" ([-+])= ", line_text):
            at = start + m.start()
            yield Fault("arithmetic", line, at, at + 4, " -= " if m.group(1) == "+" else " += ", (begin, end), True)
    m = re.match(r"^\s*(?:\} else )?if (?!constexpr)(\()", line_text)
    if m:
        begin = start + m.start(1) + 1
        end = matching(text, begin - 1) - 1
        if ";" not in text[begin:end] and not re.search(r"[^=!<>]=[^=]", text[begin:end]):
            yield Fault("condition", line, begin, end, None, (begin, end), False)


def faults_in(source):
    """All possible faults of one file, in order."""
    text, found, start = masked(source), [], 0
    in_parameter = False
    for line, line_text in enumerate(text.split("\n"), 1):
        in_parameter = in_parameter or PARAMETER.match(line_text) is not None
        if not NO_LINE.match(line_text) and not in_parameter:
            found += line_faults(text, start, line_text, line)
            for m in TOKENS.finditer(text, start, start + len(line_text)):
                fault = token_fault(text, m, line)
                if fault.kind != "arithmetic" or '"' not in text[slice(*fault.slot)]:  # words that are joined
                    found.append(fault)
        in_parameter = in_parameter and "};" not in line_text
        start += len(line_text) + 1
    return found


def in_place(source, fault):
    """The slot of the fault as it was and as it is with the fault."""
    begin, end = fault.slot
    if fault.kind == "condition":
        return source[begin:end], f"!({source[begin:end]})"
    return source[begin:end], source[begin:fault.begin] + fault.new + source[fault.end:end]


def on_one_line(text):
    """The text without comments; line numbers stay."""
    return " ".join(LITERAL.sub(lambda m: m.group() if m.group()[0] in "\"'" else " ", text).split())


def choice(source, fault, fault_id):
    was, now = in_place(source, fault)
    now = on_one_line(now)
    if fault.kind == "statement":
        return f"{{ if (!::fulmar_mutant({fault_id})) {{ {was} }} }}"
    if fault.statement:
        return f"{{ if (::fulmar_mutant({fault_id})) {{ {now} }} else {{ {was} }} }}"
    return f"(::fulmar_mutant({fault_id}) ? ::fulmar_chosen({now}) : ::fulmar_chosen({was}))"


def unfixed(source, begin):
    """Places where a constant of the compiler must become one of the program: a fault is chosen at run time."""
    start = source.rfind("\n", 0, begin) + 1
    while start > 0 and source[:start].rstrip()[-1:] == ",":  # goes on from the line before
        start = source.rfind("\n", 0, start - 1) + 1
    m = re.compile(r"\s*(static constexpr|inline constexpr|constexpr)(?= (?:\w|::)+ \w+[ {])").match(source, start)
    if not m:
        return None
    held = {"static constexpr": "static inline const", "inline constexpr": "inline const", "constexpr": "const"}
    return m.start(1), m.end(1), held[m.group(1)]


def with_faults(source, faults):
    """The text with each of {id: fault} to be chosen."""
    edits = {}
    for fault_id, fault in faults.items():
        edits[fault.slot] = choice(source, fault, fault_id)
        fixed = unfixed(source, fault.slot[0])
        if fixed:
            edits[fixed[:2]] = fixed[2]
    for (begin, end), new in sorted(edits.items(), reverse=True):
        source = source[:begin] + new + source[end:]
    return source


class Draw:
    """Draws from the sources, {path: text}, in an order that depends on the seed alone."""

    def __init__(self, sources, seed):
        self.sources = sources
        self.random = random.Random(seed)
        self.left = []  # by line: path, the faults that it can have
        for path, text in sorted(sources.items()):
            by_line = collections.defaultdict(list)
            for fault in faults_in(text):
                by_line[fault.line].append(fault)
            self.left += [(path, faults) for _, faults in sorted(by_line.items())]
        self.taken = {}  # id -> (path, fault)
        self.next_id = FIRST_ID

    def draw(self, count):
        """Draws `count` more, all at different places. The line, the kind, and the place in the line are drawn, so
        that long expressions and constants are not preferred."""
        while count > 0 and self.left:
            path, faults = self.left.pop(self.random.randrange(len(self.left)))
            kind = self.random.choice(sorted({f.kind for f in faults}))
            fault = self.random.choice([f for f in faults if f.kind == kind])
            if any(p == path and f.slot[0] < fault.slot[1] and fault.slot[0] < f.slot[1]
                   for p, f in self.taken.values()):
                continue
            self.taken[self.next_id] = (path, fault)
            self.next_id += 1
            count -= 1

    def drop(self, ids):
        """Replaces faults that the compiler rejects by others."""
        for fault_id in ids:
            del self.taken[fault_id]
        self.draw(len(ids))

    def on_lines(self, places):
        """Of these (path, line) places."""
        lines = collections.defaultdict(set)
        for path, line in places:
            lines[path].add(line)
        for fault_id, (path, fault) in self.taken.items():
            text = self.sources[path]
            first, last = (text.count("\n", 0, at) + 1 for at in fault.slot)
            if not lines[path].isdisjoint(range(first, last + 1)):
                yield fault_id

    def texts(self):
        by_path = collections.defaultdict(dict)
        for fault_id, (path, fault) in self.taken.items():
            by_path[path][fault_id] = fault
        return {path: with_faults(self.sources[path], faults) for path, faults in by_path.items()}

    def drawn(self):
        for fault_id, (path, fault) in self.taken.items():
            was, now = (on_one_line(t) for t in in_place(self.sources[path], fault))
            yield Drawn(fault_id, path, fault.line, fault.kind, was, now if fault.kind != "statement" else "(gone)")


def is_flight_code(path):
    return path.startswith(FOLDERS) and path.endswith((".hpp", ".cpp")) and not NOT_FLIGHT.search(path)

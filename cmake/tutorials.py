#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the commands of a page of the documentation, and compares their output with that on the page.

  cmake/tutorials.py [--prefix PREFIX | --build BUILD] [--update] [PAGE.md...]

Each page has a home folder of its own, where ~/fulmar is PREFIX and its bin is on the PATH; without --prefix, BUILD is installed into a
scratch folder for it. In a page

  ```console 5%        lines `$ command` (go on with `> `) are run, what follows them is compared with the output; a line `...` stands for
                       any lines, `...` in a line for any text, numbers may differ by 5 % and half their last digit (without it: not at
                       all), blanks count as one. With `exit=1` the block's last command must end with that code; with `background` its
                       one command goes on, and a later block `console continues` is what it says then.
  ```cpp file=law.hpp  is written to that file, whatever the language (with `append`, to its end); with diff, its
                       lines `-` become its lines `+`
  <!-- $ command -->   is run unseen
  <!-- refused: a.yaml -->  before a table: each row is one change to a.yaml, `old` -> `new`, or options of `fulmar check a.yaml`,
                       and what is told

With --update, lines that differ by their numbers alone get those of today, in the page; what changes is to be read before it is kept.
"""
import argparse
import concurrent.futures
import contextlib
import difflib
import fcntl
import math
import os
import pathlib
import pty
import re
import select
import shlex
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import termios
import time

NUMBER = r"(?<![\w.])-?\d+(?:\.\d+)?(?:e[-+]?\d+)?(?![\w]|\.\w)"
FENCE = re.compile(r"^```(\S+)?\s*(.*)$")
HIDDEN = re.compile(r"^<!-- \$ (.*) -->$")
REFUSED = re.compile(r"^<!-- refused: (\S+) -->$")


class Mismatch(Exception):
    """A page and the output differ. The text begins with file:line."""


# ---- reading a page ---------------------------------------------------------------------------------------------------------------


class Block:
    def __init__(self, language, info, line):
        self.language, self.line, self.lines = language, line, []
        words = dict(word.partition("=")[::2] for word in info.split())
        self.file, self.append = words.get("file"), "append" in words
        self.exit = int(words.get("exit", 0))
        self.background, self.continues = "background" in words, "continues" in words
        self.tolerance = next((float(word[:-1]) / 100 for word in words if word.endswith("%")), 0)


def blocks_of(text):
    """Blocks, hidden commands and tables of refusals of a page, in its order."""
    found, open_block, refused = [], None, None
    for number, line in enumerate(text.splitlines(), 1):
        fence = FENCE.match(line)
        if open_block is not None:
            if line == "```":
                open_block = None
            else:
                open_block.lines.append(line)
        elif fence:
            open_block = Block(fence[1] or "", fence[2], number)
            found.append(open_block)
        elif HIDDEN.match(line):
            block = Block("console", "", number - 1)
            block.lines = ["$ " + HIDDEN.match(line)[1], "..."]
            found.append(block)
        elif REFUSED.match(line):
            refused = Block("refused", "file=" + REFUSED.match(line)[1], number)
            found.append(refused)
        elif refused is not None and line.startswith("|"):
            refused.lines.append((number, line))
        elif refused is not None and line.strip():
            refused = None
    return found


def commands_of(block):
    """[(line number, command, expected lines)] of a console block."""
    commands = []
    for number, line in enumerate(block.lines, block.line + 1):
        if line.startswith("$ "):
            commands.append((number, line[2:], []))
        elif line.startswith("> ") and commands and not commands[-1][2]:
            commands[-1] = (commands[-1][0], commands[-1][1] + "\n" + line[2:], [])
        elif commands:
            commands[-1][2].append(line)
    return commands


# ---- comparing --------------------------------------------------------------------------------------------------------------------


def pattern_of(expected, tolerance):
    """Regular expression of an expected line; its groups are the compared numbers."""
    tokens = re.split(r"(\.\.\.|\s+|" + NUMBER + ")", expected.strip())
    out = ""
    for token in tokens:
        if token == "...":
            out += ".*?"
        elif token and token.isspace():
            out += r"\s+"
        elif tolerance and re.fullmatch(NUMBER, token):
            out += "(" + NUMBER + ")"
        else:
            out += re.escape(token)
    return re.compile(r"\s*" + out + r"\s*")


def near(expected, actual, tolerance):
    decimals = len(expected.partition(".")[2]) if "e" not in expected else 0
    return abs(float(actual) - float(expected)) <= tolerance * abs(float(expected)) + 0.5001 * 10.0**-decimals


def same_line(expected, actual, tolerance=0):
    match = pattern_of(expected, tolerance).fullmatch(actual)
    if not match:
        return False
    numbers = re.findall(NUMBER, expected) if tolerance else []
    return all(tolerance == math.inf or near(e, a, tolerance) for e, a in zip(numbers, match.groups()))


def reach(expected, actual, tolerance):
    """For each number of expected lines: possible numbers of actual lines. Empty for none."""
    steps = [{0}]
    for line in expected:
        if line.strip() == "...":
            steps.append(set(range(min(steps[-1]), len(actual) + 1)) if steps[-1] else set())
        else:
            steps.append({i + 1 for i in steps[-1] if i < len(actual) and same_line(line, actual[i], tolerance)})
    return steps


def same_output(expected, actual, tolerance=0):
    return len(actual) in reach(expected, actual, tolerance)[-1]


def renewed(expected, actual, tolerance):
    """The expected lines with the actual numbers where these are out of tolerance. None when more than numbers differ."""
    steps = reach(expected, actual, math.inf)
    if len(actual) not in steps[-1]:
        return None
    lines, end = list(expected), len(actual)
    for i in reversed(range(len(expected))):
        if expected[i].strip() == "...":
            end = max(at for at in steps[i] if at <= end)
            continue
        end = end - 1
        if not same_line(expected[i], actual[end], tolerance):
            numbers = iter(pattern_of(expected[i], math.inf).fullmatch(actual[end]).groups())
            lines[i] = re.sub(NUMBER, lambda old: next(numbers).rjust(len(old[0])), expected[i])
    return lines


def difference(expected, actual, tolerance):
    """The first missing line, with the line in its place."""
    steps = reach(expected, actual, tolerance)
    lost = next((i for i, step in enumerate(steps) if not step), None)
    if lost is None:
        return "\n".join("+" + line for line in actual[max(steps[-1]):])
    line, begin = expected[lost - 1], min(steps[lost - 1])
    rest = actual[begin:]
    if lost > 1 and expected[lost - 2].strip() == "...":
        near_by = difflib.get_close_matches(line, rest, 1, 0.5)
        rest = near_by or rest
    return "\n".join([" " + text for text in actual[max(0, begin - 2) : begin]] + ["-" + line] + ["+" + text for text in rest[:10]])


# ---- running the commands of a page ------------------------------------------------------------------------------------------------


def as_seen(raw):
    """The final state of the lines on a terminal: without colours, redrawn lines in their last state."""
    lines = []
    for line in raw.decode("utf-8", "replace").replace("\r\n", "\n").split("\n"):
        shown = ""
        for part in line.split("\r"):
            shown = part[3:] if part.startswith("\x1b[K") else part + shown[len(part):]
        lines.append(re.sub(r"\x1b\[[0-9;?]*[A-Za-z]", "", shown).rstrip())
    while lines and not lines[-1]:
        lines.pop()
    return lines


class Job:
    """A command on a separate terminal."""

    def __init__(self, script, folder, environment):
        self.ours, theirs = pty.openpty()
        fcntl.ioctl(theirs, termios.TIOCSWINSZ, struct.pack("HHHH", 50, 200, 0, 0))
        self.child = subprocess.Popen(["bash", "-c", script], stdin=subprocess.DEVNULL, stdout=theirs, stderr=theirs, cwd=folder,
                                      env=environment, start_new_session=True)
        os.close(theirs)
        self.raw, self.open = b"", True

    def pump(self):
        """Reads the present output. False when the command has ended and all its output is read."""
        ended = self.child.poll() is not None
        if not select.select([self.ours], [], [], 0.02)[0]:
            return not ended  # what still runs in the background keeps the terminal open
        try:
            piece = os.read(self.ours, 65536)
        except OSError:
            piece = b""
        self.raw += piece
        if not piece:
            self.child.wait()
        return bool(piece)

    def close(self):
        """Ends the command and all its children."""
        if not self.open:
            return
        self.open = False
        try:
            os.killpg(self.child.pid, signal.SIGKILL)
        except ProcessLookupError:
            pass
        self.child.wait()
        os.close(self.ours)


class Terminal:
    """Commands in one folder after another, as typed by a user: the folder and exported variables stay."""

    def __init__(self, home, prefix, limit_s):
        self.home, self.limit_s = home, limit_s
        self.state = home / ".state"
        (home / "fulmar").symlink_to(prefix)
        keep = ("CCACHE_DIR", "CCACHE_BASEDIR", "CCACHE_NOHASHDIR", "CMAKE_CXX_COMPILER_LAUNCHER", "CC", "CXX", "ASAN_OPTIONS", "UBSAN_OPTIONS")
        environment = {name: os.environ[name] for name in keep if name in os.environ}
        ccache = pathlib.Path(os.environ.get("XDG_CACHE_HOME", os.path.expanduser("~/.cache"))) / "ccache"
        environment.setdefault("CCACHE_DIR", str(ccache))
        environment.update(HOME=str(home), PATH=f"{home}/fulmar/bin:/usr/local/bin:/usr/bin:/bin", LC_ALL="C.UTF-8", TERM="dumb")
        self.environment = environment
        self.folder = home
        self.jobs = []

    def start(self, command):
        script = f"[ -f {self.state} ] && . {self.state}; cd {shlex.quote(str(self.folder))}\n{command}\n"
        script += f"code=$?; export -p >{self.state}; pwd >{self.state}.folder; exit $code"
        job = Job(script, self.home, self.environment)
        self.jobs.append(job)
        return job

    def run(self, command):
        """(exit code, lines)"""
        job, end = self.start(command), time.monotonic() + self.limit_s
        while job.pump():
            if time.monotonic() > end:
                job.close()
                raise TimeoutError(f"has not ended after {self.limit_s:g} s")
        job.close()
        folder = pathlib.Path(f"{self.state}.folder")
        if folder.exists():
            self.folder = pathlib.Path(folder.read_text().strip())
        return job.child.returncode, as_seen(job.raw)

    def close(self):
        for job in self.jobs:
            job.close()


def patched(text, lines):
    """`text` with the lines of a diff applied; replaced lines must be there exactly once."""
    old = "".join(line[1:] + "\n" for line in lines if line[:1] != "+")
    new = "".join(line[1:] + "\n" for line in lines if line[:1] != "-")
    if text.count(old) != 1:
        raise ValueError(f"what the diff replaces is there {text.count(old)} times")
    return text.replace(old, new)


class Page:
    def __init__(self, path, terminal, given):
        self.path = os.path.relpath(path)
        self.terminal, self.show, self.commands = terminal, given.show, 0
        self.update = given.update

    def fail(self, line, sentence):
        raise Mismatch(f"{self.path}:{line}: {sentence}")

    def run(self):
        for block in blocks_of(pathlib.Path(self.path).read_text(encoding="utf-8")):
            if block.language == "console" and (block.background or block.continues):
                self.background(block)
            elif block.language == "console":
                self.console(block)
            elif block.language == "refused":
                self.refused(block)
            elif block.file:
                self.write(block)

    def write(self, block):
        file = self.terminal.folder / block.file
        if block.language == "diff":
            try:
                file.write_text(patched(file.read_text(), block.lines))
            except (OSError, ValueError) as fault:
                self.fail(block.line, f"{block.file}: {fault}")
        else:
            file.parent.mkdir(parents=True, exist_ok=True)
            before = file.read_text() if block.append else ""
            file.write_text(before + "\n".join(block.lines) + "\n")

    def command(self, line, command, expected, code, tolerance=0):
        self.commands += 1
        try:
            actual_code, actual = self.terminal.run(command)
        except TimeoutError as fault:
            self.fail(line, f"$ {command}\n{fault}")
        if self.show:
            print("$ " + command, *actual, sep="\n")
        if not same_output(expected, actual, tolerance) and not self.renew(line, command, expected, actual, tolerance):
            self.fail(line, f"$ {command}\n{difference(expected, actual, tolerance)}")
        if actual_code != code:
            if self.update and " --like " in command:
                return
            self.fail(line, f"$ {command}\nends with exit code {actual_code}, not {code}\n" + "\n".join(actual[-20:]))

    def renew(self, line, command, expected, actual, tolerance):
        """With --update: writes the present numbers, or the drawing, into the page. False for other differences."""
        drawing = re.search(r" -o (\S+) --like (\S+)$", command)
        if self.update and drawing:
            shutil.copy(self.terminal.folder / drawing[1], pathlib.Path(self.path).parent / drawing[2])
            print(f"{self.path}:{line}: {drawing[2]} updated", flush=True)
            return True
        lines = renewed(expected, actual, tolerance) if self.update else None
        if lines is None:
            return False
        page, first = pathlib.Path(self.path), line + command.count("\n")
        text = page.read_text(encoding="utf-8").splitlines()
        text[first : first + len(lines)] = lines
        page.write_text("\n".join(text) + "\n", encoding="utf-8")
        print(f"{self.path}:{line}: updated", flush=True)
        return True

    def console(self, block):
        commands = commands_of(block)
        for index, (line, command, expected) in enumerate(commands):
            while expected and not expected[-1].strip():
                expected.pop()
            self.command(line, command, expected, block.exit if index + 1 == len(commands) else 0, block.tolerance)

    def background(self, block):
        if block.background:
            (line, command, expected), = commands_of(block)
            self.commands += 1
            self.job, self.seen = self.terminal.start(command), 0
        else:
            line, command, expected = block.line, "(goes on)", block.lines
        end = time.monotonic() + self.terminal.limit_s
        while not same_output(expected, as_seen(self.job.raw[self.seen :]), block.tolerance):
            if not self.job.pump() or time.monotonic() > end:
                if self.renew(line, command, expected, as_seen(self.job.raw[self.seen :]), block.tolerance):
                    break
                self.fail(line, f"$ {command}\n{difference(expected, as_seen(self.job.raw[self.seen :]), block.tolerance)}")
        if self.show:
            print("$ " + command, *as_seen(self.job.raw[self.seen :]), sep="\n")
        self.seen = len(self.job.raw)

    def refused(self, block):
        rows = block.lines[2:]
        if not rows:
            self.fail(block.line, "no table follows")
        file = self.terminal.folder / block.file
        original = file.read_text()
        for line, row in rows:
            cells = [cell.replace(r"\|", "|") for cell in re.split(r"(?<!\\)\|", row)[1:3]]
            change, told = [[part.split("`")[1] for part in side.split("<br>")] for side in (cells[0].split("→")[-1], cells[1])]
            options = ""
            if "→" in cells[0]:
                old = cells[0].split("→")[0].split("`")[1]
                if original.count(old) != 1:
                    self.fail(line, f"{block.file} has '{old}' {original.count(old)} times")
                file.write_text(original.replace(old, "\n".join(change)))
            else:
                options = " " + " ".join(change)
            self.command(line, f"fulmar check {block.file}{options}", told, 4)
            file.write_text(original)


def do_page(path, prefix, given):
    """The fault, or ""."""
    # In the folder of the prefix, so that the path from one to the other is the same in each run: ccache then finds the compiled files.
    home = pathlib.Path(tempfile.mkdtemp(prefix="fulmar-page-", dir=None if given.keep else given.homes))
    terminal = Terminal(home, prefix, given.limit)
    page, begin, fault = Page(path, terminal, given), time.monotonic(), ""
    try:
        page.run()
    except Mismatch as mismatch:
        fault = str(mismatch)
    finally:
        terminal.close()
        if given.keep:
            print(f"{page.path}: {home} is kept")
        else:
            shutil.rmtree(home, ignore_errors=True)
    if not fault and page.commands == 0:
        fault = f"{page.path}: there is no command in it"
    print(fault or f"{page.path}: {page.commands} commands, {time.monotonic() - begin:.1f} s", flush=True)
    return fault


ROOT = pathlib.Path(__file__).resolve().parent.parent


def default_pages():
    """Runs all pages; those that compile most begin first, so that none of them is left alone at the end."""
    pages = [*(ROOT / "docs" / f"{name}.md" for name in ("missions", "live", "viewers", "logs", "ros2", "many-flights", "vehicles", "aero", "aircraft", "by_hand", "tour")),
             *sorted((ROOT / "docs/tutorial").glob("[0-9]-*.md")), *sorted((ROOT / "examples").glob("*/README.md"))]
    return sorted(pages, key=lambda page: -page.read_text().count("cmake --build"))


def main(arguments=None):
    parser = argparse.ArgumentParser(description="Does what pages of the documentation tell, and compares.")
    parser.add_argument("--prefix", help="where Fulmar is installed")
    parser.add_argument("--build", default=ROOT / "build", help="a build that is installed when there is no --prefix")
    parser.add_argument("--keep", action="store_true", help="leave the pages' home folders")
    parser.add_argument("--update", action="store_true", help="write today's numbers into the pages where numbers alone differ")
    parser.add_argument("--show", action="store_true", help="print what comes")
    parser.add_argument("--limit", type=float, default=300, help="seconds that one command may take")
    parser.add_argument("--jobs", type=int, default=1, help="pages at a time")
    parser.add_argument("pages", nargs="*", default=default_pages())
    given = parser.parse_args(arguments)
    with contextlib.ExitStack() as stack:
        given.homes = pathlib.Path(stack.enter_context(tempfile.TemporaryDirectory(prefix="fulmar-pages-")))
        if given.prefix:
            prefix = pathlib.Path(given.prefix).resolve()
        else:
            prefix = given.homes / "prefix"
            subprocess.run(["cmake", "--install", given.build, "--prefix", prefix], check=True, stdout=subprocess.DEVNULL)
        with concurrent.futures.ThreadPoolExecutor(given.jobs) as pool:
            faults = list(pool.map(lambda page: do_page(page, prefix, given), given.pages))
    return 1 if any(faults) else 0


if __name__ == "__main__":
    sys.exit(main())

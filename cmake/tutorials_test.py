#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The runner of the documentation reports each difference. Needs no build: a stand-in replaces Fulmar."""
import contextlib
import io
import pathlib
import tempfile
import textwrap
import unittest

import tutorials


class Pages(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        stand_in = self.folder / "prefix/bin/fulmar"
        stand_in.parent.mkdir(parents=True)
        # `fulmar check FILE [options]`: one fault per line with the word bad, and one per option
        stand_in.write_text('#!/bin/sh\nshift; grep -n bad "$1" | sed "s/:.*/: is bad/; s/^/$1:/"; f=$?; shift\n'
                            '[ $# -gt 0 ] && echo "$1 is not understood"; exit 4\n')
        stand_in.chmod(0o755)

    def updated(self, text):
        code, out = self.run_page(text, more=["--update"])
        return code, (self.folder / "page.md").read_text()

    def run_page(self, text, limit="20", more=()):
        page = self.folder / "page.md"
        page.write_text(textwrap.dedent(text))
        out = io.StringIO()
        with contextlib.redirect_stdout(out):
            code = tutorials.main(["--prefix", str(self.folder / "prefix"), "--limit", limit, *more, str(page)])
        return code, out.getvalue()

    def passes(self, text):
        code, out = self.run_page(text)
        self.assertEqual(code, 0, out)

    def fails(self, text, *words, **more):
        code, out = self.run_page(text, **more)
        self.assertEqual(code, 1, out)
        for word in words:
            self.assertIn(word, out)

    def test_expected_output_is_compared(self):
        self.passes("""
            ```console
            $ printf 'one\\n  two  three\\n'
            one
            two three
            ```""")
        self.fails("""
            ```console
            $ printf 'one\\ntwo\\n'
            one
            three
            ```""", "page.md:3: $ printf", "-three", "+two")

    def test_lines_that_are_missing_or_too_many_are_noticed(self):
        self.fails("```console\n$ echo a\na\nb\n```", "-b")
        self.fails("```console\n$ echo a; echo b\na\n```", "+b")
        self.fails("```console\n$ echo a\n```", "+a")
        self.fails("```console\n$ true\na\n```", "-a")

    def test_dots_stand_for_any_lines_and_any_text(self):
        self.passes("```console\n$ seq 1 9\n1\n...\n5\n...\n```")
        self.passes("```console\n$ echo at 12:30 all is well\nat ... all is well\n```")
        self.fails("```console\n$ seq 1 9\n1\n...\n50\n...\n```", "-50")
        self.fails("```console\n$ seq 1 9\n...\n5\n```", "+9")

    def test_numbers_differ_within_the_stated_tolerance_alone(self):
        self.passes("```console 5%\n$ echo 'error 1.04 m at -20 s, aux1'\nerror 1.00 m at -20 s, aux1\n```")
        self.fails("```console 5%\n$ echo 'error 1.07 m'\nerror 1.00 m\n```", "-error 1.00 m", "+error 1.07 m")
        self.fails("```console\n$ echo 'error 1.01 m'\nerror 1.00 m\n```", "+error 1.01 m")
        self.fails("```console 5%\n$ echo 'error 1.00 ft'\nerror 1.00 m\n```")
        self.fails("```console 50%\n$ echo aux1\naux2\n```")

    def test_update_writes_numbers_that_are_out_of_tolerance_and_nothing_else(self):
        page = "```console 5%\n$ printf 'a 1.50 m\\nb 7 x\\nb 10.25 s at 3\\nend\\n'\na  1.00 m\n...\nb  9.90 s at 3\n...\n```\n"
        self.assertEqual(self.updated(page), (0, page.replace("a  1.00", "a  1.50")))  # 10.25 is within 5 % of 9.90
        code, text = self.updated(page.replace("9.90", "8.00"))
        self.assertEqual((code, text), (0, page.replace("a  1.00", "a  1.50").replace("9.90", "10.25")))
        other = page.replace("a  1.00 m", "a  1.00 ft")
        self.assertEqual(self.updated(other), (1, other))  # not a number alone
        drawing = "```console\n$ touch new.svg; echo is 9 away; true -o new.svg --like old.svg\n```\n"
        (self.folder / "old.svg").write_text("of yesterday")
        self.assertEqual(self.updated(drawing)[0], 0)
        self.assertEqual((self.folder / "old.svg").read_text(), "")

    def test_exit_codes_are_compared(self):
        self.passes("```console exit=3\n$ true\n$ exit 3\n```")
        self.fails("```console\n$ exit 3\n```", "exit code 3, not 0")
        self.fails("```console exit=3\n$ true\n```", "exit code 0, not 3")
        self.fails("```console exit=3\n$ exit 3\n$ exit 3\n```", "exit code 3, not 0")

    def test_files_are_written_and_changed(self):
        self.passes("""
            ```yaml file=a/b.yaml
            rate: 1 Hz
            seed: 7
            ```
            ```diff file=a/b.yaml
             rate: 1 Hz
            -seed: 7
            +seed: 8
            ```
            ```console
            $ cat a/b.yaml
            rate: 1 Hz
            seed: 8
            ```""")
        self.fails("```diff file=none.yaml\n-a\n+b\n```\n```console\n$ true\n```", "page.md:1: none.yaml")
        self.fails("```yaml file=a\nb\nb\n```\n```diff file=a\n-b\n+c\n```\n```console\n$ true\n```", "page.md:5: a: ", "2 times")

    def test_folder_and_exported_variables_stay(self):
        self.passes("""
            ```console
            $ mkdir x && cd x && export ANSWER='4 2'
            $ echo \\
            > $ANSWER $(basename $PWD)
            4 2 x
            ```
            <!-- $ touch unseen -->
            ```console
            $ ls
            unseen
            ```""")

    def test_what_is_shown_is_the_last_state_of_a_line(self):
        self.passes("```console\n$ printf 'height 1\\r\\033[Kheight 22\\r\\033[K\\033[32mdone\\033[0m\\n'\ndone\n```")

    def test_refusals_are_compared_and_changes_taken_back(self):
        page = """
            ```yaml file=a.yaml
            first: good
            second: good
            ```
            <!-- refused: a.yaml -->
            | written | told |
            |---|---|
            | `first: good` → `first: bad` | `a.yaml:1: is bad` |
            | `second: good` → `x`<br>`y: bad` | `a.yaml:3: is bad` |
            | `--wrong` | `--wrong is not understood` |
            """
        self.passes(page)
        self.fails(page.replace("a.yaml:3", "a.yaml:4"), "page.md:10", "+a.yaml:3: is bad")
        self.fails(page.replace("`second: good` →", "`third` →"), "page.md:10", "has 'third' 0 times")
        self.fails(page.split("| written")[0] + "```console\n            $ true\n            ```\n", "no table follows")

    def test_a_command_in_the_background_is_followed(self):
        page = """
            ```console background
            $ echo one; until [ -f go ]; do sleep 0.01; done; echo two; sleep 30
            one
            ```
            ```text file=go
            ```
            ```console continues
            two
            ```
            """
        self.passes(page)
        self.fails(page.replace("file=go", ""), "page.md:8", "-two", limit="0.5")
        self.fails(page.replace("one\n            ```", "none\n            ```"), "page.md:3", "-none", "+one", limit="0.5")

    def test_a_command_that_hangs_and_a_page_without_commands_fail(self):
        self.fails("```console\n$ sleep 30\n```", "has not ended after 0.5 s", limit="0.5")
        self.fails("no command here", "there is no command in it")


if __name__ == "__main__":
    unittest.main()

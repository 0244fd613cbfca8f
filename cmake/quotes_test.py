#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""quotes.py accepts a quote that its source holds, and reports the first line that is not in the source."""
import contextlib
import io
import pathlib
import tempfile
import unittest
import unittest.mock

import quotes

SOURCE = "int f() {\n  one();\n\n  two();\n  three();\n  one();\n  four();\n}\n"


class Quotes(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.root = pathlib.Path(scratch.name)
        (self.root / "a.cpp").write_text(SOURCE)
        self.page = self.root / "page.md"

    def faults(self, *lines, source="a.cpp"):
        """The faults of a page with one quote, whose first line is line 5."""
        self.page.write_text("\n".join(["# A page", "", f"<!-- source: {source} -->", "```cpp", *lines, "```", ""]))
        return [fault.removeprefix(f"{self.page}:") for fault in quotes.faults(self.page, self.root)]

    def reported(self, *lines):
        """(line of the page, source, line of the quote) of the one fault."""
        (fault,) = self.faults(*lines)
        number, sentence = fault.split(": ", 1)
        return int(number), sentence.split(" ")[0], sentence.split(": ")[-1]

    def test_a_quote_without_indentation_and_empty_lines(self):
        self.assertEqual(self.faults("one();", "two();"), [])
        self.assertEqual(self.faults("int f() {", "", "    one();"), [])

    def test_lines_left_out(self):
        self.assertEqual(self.faults("one();", "...", "four();", "}"), [])
        self.assertEqual(self.faults("...", "three();", "  ...", "}", "..."), [])
        self.assertEqual(self.faults("one();", "...", "one();"), [])

    def test_lines_left_out_without_a_mark(self):
        self.assertEqual(self.reported("two();", "four();"), (6, "a.cpp", "four();"))

    def test_another_order(self):
        self.assertEqual(self.reported("four();", "...", "two();"), (7, "a.cpp", "two();"))

    def test_a_changed_line(self):
        self.assertEqual(self.reported("one();", "two(2);"), (6, "a.cpp", "two(2);"))
        self.assertEqual(self.reported("one(); // first"), (5, "a.cpp", "one(); // first"))

    def test_the_longest_match_names_the_line(self):
        self.assertEqual(self.reported("one();", "four();", "five();"), (7, "a.cpp", "five();"))

    def test_an_unknown_source(self):
        self.assertEqual(self.faults("one();", source="b.cpp"), ["3: there is no file b.cpp"])

    def test_a_marker_without_a_block(self):
        self.page.write_text("<!-- source: a.cpp -->\n\n```cpp\none();\n```\n")
        self.assertEqual(list(quotes.faults(self.page, self.root)), [f"{self.page}:1: no code block follows"])

    def test_other_blocks_are_not_quotes(self):
        self.page.write_text("```cpp\nfive();\n```\n\n```md\n<!-- source: a.cpp -->\n```\n")
        self.assertEqual(list(quotes.faults(self.page, self.root)), [])

    def test_the_exit_code(self):
        for lines, code in ((["one();"], 0), (["five();"], 1)):
            self.faults(*lines)
            with contextlib.redirect_stdout(io.StringIO()) as out, unittest.mock.patch.object(quotes, "root", self.root):
                self.assertEqual(quotes.main([str(self.page)]), code)
            self.assertEqual(bool(out.getvalue()), code == 1)


if __name__ == "__main__":
    unittest.main()

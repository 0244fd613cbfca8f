#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""docstrings.py finds each public declaration without a comment, and no other; the list of exceptions only shrinks."""
import contextlib
import io
import os
import pathlib
import subprocess
import tempfile
import unittest

import docstrings


def bare(text, only_c=False):
    """The names without a docstring."""
    return [name for name, documented in docstrings.declarations(text, only_c) if not documented]


class Declarations(unittest.TestCase):
    def test_declarations_without_a_comment(self):
        for text, names in (("int f();", ["f"]), ("inline int f(int a = g(1)) { return a; }", ["f"]), ("struct A { int b(); };", ["A"]),
                            ("template <class T>\nclass A final : public B<T> {};", ["A"]), ("enum class E : int { a };", ["E"]),
                            ("template <class T>\nrequires std::is_same_v<T, int>\nT f(T a) { return a; }", ["f"]),
                            ("[[nodiscard]] std::pair<int, int> f();", ["f"]), ("auto f() -> int { return 1; }", ["f"]),
                            ("bool operator==(A a, A b);", ["operator=="]), ("inline A operator()(A a);", ["operator()"]),
                            ("namespace n {\nint f();\n}\nint g();", ["f", "g"]), ('extern "C" {\nint f();\n}', ["f"]),
                            ("struct A {} a;\nint f();", ["A", "f"]), ("const char* f() { return \"// no {comment\"; }\nint g();", ["f", "g"]),
                            ("union U { int a; };", ["U"]), ("struct alignas(8) A { int b; };", ["A"])):
            self.assertEqual(bare(text), names, text)

    def test_no_declaration_of_this_kind(self):
        for text in ("struct A;", "using F = int (*)(int);", "int A::f() { return 1; }", "template <class T>\nint A<T>::f() { return 1; }",
                     "constexpr double a = f(1);", "static_assert(f(1) > 0);", "namespace detail {\nint f();\n}", "namespace {\nint f();\n}",
                     "#define F(x) int f(x);", "constexpr int a[] = {1, 2};", "template <>\nint f<3>() { return 1; }", "friend int f();"):
            self.assertEqual(bare(text), [], text)

    def test_docstrings(self):
        for text in ("/// What.\nint f();", "int f();  ///< what", "/* what */\nstruct A {};", "/// What.\ntemplate <class T>\nT f() { return 1; }",
                     "int f(int a,  // metres\n      int b);", "struct A {  ///< what\n};", "/// One\n/// two.\ninline int f() {\n  return 1;\n}"):
            self.assertEqual(bare(text), [], text)

    def test_comments_that_belong_elsewhere(self):
        for text in ("// Of the file.\n\nint f();", "int a;  // of a\nint f();", "int f() {\n  // inside\n}", "// Of the file.\n#pragma once\nint f();",
                     "struct f {\n  int a;  ///< of a\n};"):
            self.assertEqual(bare(text), ["f"], text)

    def test_only_c_functions_of_a_source(self):
        self.assertEqual(bare('int a();\nextern "C" {\nint b();\n}\nint c();', only_c=True), ["b"])


class List(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        root = pathlib.Path(scratch.name)
        before = os.getcwd()
        self.addCleanup(os.chdir, before)
        os.chdir(root)
        self.header = root / "sdk/include/fulmar/sim/a.hpp"
        self.header.parent.mkdir(parents=True)
        (root / "cmake").mkdir()
        self.list = root / "cmake/docstrings_missing.txt"
        subprocess.run(["git", "init", "-q", "."], check=True)

    def run_on(self, text, listed):
        self.header.write_text(text)
        self.list.write_text(listed)
        subprocess.run(["git", "add", "."], check=True)
        with contextlib.redirect_stdout(io.StringIO()) as out:
            code = docstrings.main([])
        return code, out.getvalue()

    def test_the_list_only_shrinks(self):
        entry = "sdk/include/fulmar/sim/a.hpp: f\n"
        self.assertEqual(self.run_on("int f();\n", "")[0], 1)
        self.assertEqual(self.run_on("int f();\n", "# exceptions\n" + entry), (0, ""))
        self.assertEqual(self.run_on("/// What.\nint f();\n", "# exceptions\n"), (0, ""))
        code, out = self.run_on("/// What.\nint f();\n", entry)
        self.assertEqual((code, entry.strip() in out), (1, True))
        self.assertEqual(self.run_on("int g();\n", entry)[0], 1)


if __name__ == "__main__":
    unittest.main()

#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""commas.py finds each chain of statements and no other comma, and splits the chains."""
import contextlib
import io
import pathlib
import tempfile
import unittest

import commas


def squeezed(text):
    return " ".join(text.split())


class Commas(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.file = pathlib.Path(scratch.name) / "a.cpp"

    def run_on(self, text, *options):
        self.file.write_text(text)
        with contextlib.redirect_stdout(io.StringIO()) as out:
            code = commas.main([*options, str(self.file)])
        return int(code), out.getvalue()

    def lines(self, text):
        """The lines of the chains found."""
        code, out = self.run_on(text)
        self.assertEqual(code, 1 if out else 0)
        return [int(line.removeprefix(f"{self.file}:").split(":")[0]) for line in out.splitlines()]

    def in_body(self, statement):
        return self.lines("void f() {\n" + statement + "\n}\n")

    def test_chains(self):
        for chain in ("c.begin = begin, c.end = end;", "f(1, 2), g();", "if (x) a = 1, b = 2;", "for (;;) a = 1, b = 2;", "return x = 1, y;",
                      "if (x) y(); else a = 1, b = 2;", "case 1: a = 1, b = 2;", "a[i] = 1, b[j] = 2;", "++n, sum += x;", "*p = 1, *q = 2;",
                      "std::swap(a, b), n = 0;", "this->a = 1, this->b = 2;", "delete p, p = nullptr;", "(void)a, (void)b;",
                      "x = most<a, b>(c), y = d;", "a = T{1, 2}, b = 3;", "while (x) f(), g();", "if (x) { f(), g(); }"):
            self.assertEqual(self.in_body(chain), [2], chain)

    def test_other_commas(self):
        for plain in ("double a = 1, b = 2;", "const char *a, *b;", "std::vector<int> a(1, 2), b;", "for (i = 0, j = 1; i < j; ++i, --j) f();",
                      "f(a, b);", "T x{1, 2};", "auto [a, b] = f();", "const auto& [a, b] = f(1, 2);", "std::array<int, n + 1> a{};",
                      "each.template operator()<A, B>();", "using T = std::pair<int, int>;", "matrix << 1, 2, 3;", "x = most<a, b>(c);",
                      "unsigned a = 1, b;", "decltype(x) a = 1, b = 2;", "ElfW(Shdr) a{}, b{};", "A::B<1>::C a, b;", "const auto f = [a, b](int c, int d) { return c; };",
                      "enum E { a, b };", "struct S { int a, b; };", "throw E(1, 2);", "return T{1, 2};", "// a = 1, b = 2;", "/* a = 1, b = 2; */",
                      'f("a = 1, b = 2;");', "f(R\"x(a = 1, b = 2;)x\");", "#define F a = 1, b = 2;", "char c = ',', d = ';';", "x = f(1'000, 2);"):
            self.assertEqual(self.in_body(plain), [], plain)

    def test_constructors_members_and_functions(self):
        for source, lines in (("struct A : B, C {\n  A(int a, int b) : a_(a), b_{b} { f(); }\n  int a_ = 1, b_ = 2;\n};\n", []),
                              ("struct A {\n  A() : a_{1}, b_{2} {\n    a_ = 1, b_ = 2;\n  }\n};\n", [3]),
                              ("namespace n {\nauto f() -> std::pair<int, int> {\n  a = 1, b = 2;\n}\n}\n", [3])):
            self.assertEqual(self.lines(source), lines, source)

    def test_the_body_of_a_lambda_is_code_wherever_it_stands(self):
        for chain in ("const auto f = [&] { a = 1, b = 2; };", "g(1, [&](int x) { a = x, b = 2; });", "g({[=]() mutable { a = 1, b = 2; }});",
                      "g([&](int x) -> T<int> { return a = x, b; });"):
            self.assertEqual(self.in_body(chain), [2], chain)

    def test_the_line_is_that_of_the_statement(self):
        source = 'void f() {\n  /* 1,\n 2 */\n  g("x\\"", 1);\n  a = 1,\n  b = 2;\n  c(), d();\n}\n'
        self.assertEqual(self.lines(source), [5, 7])

    def test_splitting(self):
        for chain, wanted in (("a = 1, b = f(2, 3), c();", "a = 1; b = f(2, 3); c();"),
                              ("if (x) a = 1, b = 2; else c = 1, d = 2;", "if (x) { a = 1; b = 2; } else { c = 1; d = 2; }"),
                              ("for (auto& x : y) a = 1, b = 2;  // why", "for (auto& x : y) { a = 1; b = 2; // why }"),
                              ("if (x) return a = 1, b;", "if (x) { a = 1; return b; }"),
                              ("case 1: a = 1, b = 2;", "case 1: a = 1; b = 2;"),
                              ("a = 1,  // one\nb = 2;", "a = 1; // one b = 2;"),
                              ("g([&] { a = 1, b = 2; }), h();", "g([&] { a = 1; b = 2; }); h();")):
            self.assertEqual(self.run_on("void f() {\n" + chain + "\n}\n", "--fix")[0], 0)
            self.assertEqual(squeezed(self.file.read_text()), "void f() { " + wanted + " }", chain)
            self.assertEqual(self.lines(self.file.read_text()), [], chain)


if __name__ == "__main__":
    unittest.main()

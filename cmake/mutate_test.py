#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""mutate.py draws faults in flight code, the same ones for a seed, and can put each of them in."""
import pathlib
import tempfile
import unittest

import drawn_faults
import mutant_programs

SOURCE = """#include <cmath>
/// 5 apples + 3 pears
static_assert(sizeof(int) == 4);
struct Params {
  Param gain{0.5, "1/s", 0, 10,
             "1 + 1 of it"};
};
constexpr double share = 0.25, whole = 1;
inline double law(double error, const State& s) {
  const double limit = std::max(error - 0.5, s.velocity.north);  // not 7 - 7
  if (error > limit && s.valid) sum_ += 2.0 * error;
  count_ = 1'000;
  note("true - or " + name);
  return s.turns ? -limit : a * -b +
                                c;
}
"""


def kinds(line):
    return {f.kind for f in drawn_faults.faults_in(SOURCE) if f.line == line}


class Drawn(unittest.TestCase):
    def test_comments_words_parameters_and_checks_have_no_fault(self):
        lines = {f.line for f in drawn_faults.faults_in(SOURCE)}
        self.assertEqual(lines, {8, 10, 11, 12, 14})

    def test_each_line_has_its_kinds(self):
        self.assertEqual(kinds(8), {"constant"})
        self.assertEqual(kinds(10), {"function", "arithmetic", "constant", "axis"})
        self.assertEqual(kinds(11), {"condition", "comparison", "logic", "constant", "arithmetic"})
        self.assertEqual(kinds(12), {"constant", "statement"})
        self.assertEqual(kinds(14), {"sign", "arithmetic"})

    def test_the_expression_ends_at_brackets_commas_and_choices(self):
        slots = {}
        for f in drawn_faults.faults_in(SOURCE):
            slots.setdefault((f.kind, f.line), SOURCE[slice(*f.slot)])
        self.assertEqual(slots["arithmetic", 10], "error - 0.5")
        self.assertEqual(slots["function", 10], "std::max(error - 0.5, s.velocity.north)")
        self.assertEqual(slots["logic", 11], "error > limit && s.valid")
        self.assertEqual(slots["sign", 14], "-limit")
        self.assertEqual(slots["arithmetic", 14], SOURCE[SOURCE.index("a * -b"):SOURCE.rindex(";\n}")])

    def test_a_fault_stands_beside_the_original_on_the_same_line(self):
        for n, fault in enumerate(drawn_faults.faults_in(SOURCE)):
            text = drawn_faults.with_faults(SOURCE, {n: fault})
            self.assertEqual(text.count("\n"), SOURCE.count("\n"), fault)
            self.assertIn(f"::fulmar_mutant({n})", text.split("\n")[SOURCE.count("\n", 0, fault.slot[0])])
            was, now = drawn_faults.in_place(SOURCE, fault)
            self.assertNotEqual(was, now)
            self.assertEqual(text.count("{"), text.count("}"), fault)
            self.assertEqual(text.count("("), text.count(")"), fault)

    def test_a_constant_of_the_compiler_becomes_one_of_the_program(self):
        fault = next(f for f in drawn_faults.faults_in(SOURCE) if f.line == 8)
        line = drawn_faults.with_faults(SOURCE, {7: fault}).split("\n")[7]
        begin = "const double share = (::fulmar_mutant(7) ? "
        self.assertTrue(line.startswith(begin), line)

    def test_a_constant_is_another_one(self):
        for number, other in (("0", "1"), ("0.0", "1.0"), ("3", "2 * 3"), ("0.3", "0.3 / 2.0"), ("1'000", "2 * 1'000")):
            self.assertEqual(drawn_faults.other_constant(number), other)

    def test_the_seed_alone_decides(self):
        def drawn(seed, count=8):
            drawing = drawn_faults.Draw({"a.hpp": SOURCE, "b.hpp": SOURCE}, seed)
            drawing.draw(count)
            return list(drawing.drawn())
        self.assertEqual(drawn(1), drawn(1))
        self.assertNotEqual(drawn(1), drawn(2))
        self.assertEqual(drawn(1)[:4], drawn(1, 4))
        self.assertLess(len(drawn(1, 100)), 100)  # a line has one

    def test_what_the_compiler_refuses_is_replaced(self):
        drawing = drawn_faults.Draw({"a.hpp": SOURCE}, 1)
        drawing.draw(2)
        fault_id, (path, fault) = next(iter(drawing.taken.items()))
        self.assertEqual(list(drawing.on_lines({(path, fault.line), ("b.hpp", fault.line)})), [fault_id])
        drawing.drop([fault_id])
        self.assertEqual(len(drawing.taken), 2)
        self.assertNotIn(fault_id, drawing.taken)
        self.assertNotIn(fault.line, {f.line for _, f in drawing.taken.values()})

    def test_tests_and_texts_are_no_flight_code(self):
        self.assertTrue(drawn_faults.is_flight_code("plugins/path/manager.hpp"))
        self.assertTrue(drawn_faults.is_flight_code("tools/fulmar_aero/loops.cpp"))
        for path in ("plugins/path/test/kinematic.hpp", "plugins/path/README.md", "tools/fulmar_aero/tune_words.cpp",
                     "core/run/loop.hpp"):
            self.assertFalse(drawn_faults.is_flight_code(path), path)


class Programs(unittest.TestCase):
    def test_a_program_is_compiled_of_its_sources_and_libraries_and_what_they_include(self):
        with tempfile.TemporaryDirectory() as scratch:
            tree = pathlib.Path(scratch) / "tree"
            out = tree.parent / "build"
            for path, text in {"plugins/a/a.hpp": '#include "fulmar/b.hpp"\n', "sdk/include/fulmar/b.hpp": "",
                               "plugins/a/test/a_test.cpp": '#include "../a.hpp"\n', "plugins/a/own.cpp": "",
                               "plugins/a/late.cpp": ""}.items():
                (tree / path).parent.mkdir(parents=True, exist_ok=True)
                (tree / path).write_text(text)
            out.mkdir()
            (out / "build.ninja").write_text(
                f"build a.o: CXX {tree}/plugins/a/test/a_test.cpp || before\n"
                f"build own.o: CXX {tree}/plugins/a/own.cpp\nbuild late.so: CXX {tree}/plugins/a/late.cpp\n"
                "build libown.a: AR own.o\nbuild bin/a_test: LINK a.o | $\n  libown.a || late.so\n")
            self.assertEqual(mutant_programs.compiled_of(out, tree),
                             {"a_test": {"plugins/a/test/a_test.cpp", "plugins/a/a.hpp", "sdk/include/fulmar/b.hpp",
                                         "plugins/a/own.cpp"}})

    def test_a_refusal_names_the_lines_that_it_comes_from(self):
        message = ("In file included from /t/tree/a.hpp:3,\n                 from /t/tree/a.cpp:1:\n"
                   "/t/tree/b.hpp:12:5: error: no\n/usr/include/c.h:4:1: note: here\n")
        self.assertEqual(mutant_programs.places_in(message, pathlib.Path("/t/tree")),
                         {("a.hpp", 3), ("a.cpp", 1), ("b.hpp", 12)})


if __name__ == "__main__":
    unittest.main()

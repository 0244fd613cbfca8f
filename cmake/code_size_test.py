#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""code_size.py finds each part that is too large: every fault is put into a separate small tree."""
import pathlib
import shutil
import subprocess
import tempfile
import unittest

here = pathlib.Path(__file__).resolve().parent


class CodeSize(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.root = pathlib.Path(scratch.name)
        self.write("cmake/long_files.txt", "")
        self.write("cmake/wide_structs.txt", "")
        self.write("core/run/loop.cpp", '// a comment\n\nint loop() {\n  return 1;  // one\n}\nconst char* text = "// no comment";\n')
        self.write("links/dds/topic.cpp", "int topic;\n")
        shutil.copy(here / "code_size.py", self.root / "cmake")
        subprocess.run(["git", "init", "-q", str(self.root)], check=True)

    def write(self, file, text):
        path = self.root / file
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)

    def size(self, *options):
        subprocess.run(["git", "add", "."], cwd=self.root, check=True)
        return subprocess.run(["python3", "cmake/code_size.py", *options], cwd=self.root, capture_output=True, text=True)

    def refused(self, sentence):
        found = self.size()
        self.assertEqual((found.returncode, found.stderr), (1, sentence + "\n"))

    def test_lines_are_counted_without_comments_and_blank_lines(self):
        found = self.size("--most", "4")
        self.assertEqual(found.returncode, 0, found.stderr)
        self.assertIn("     4  what flies", found.stdout)
        self.assertIn("     4  core\n", found.stdout)
        self.assertIn("     1  links/dds\n", found.stdout)
        self.assertEqual(self.size("--most", "3").returncode, 1)

    def test_a_long_file(self):
        self.write("sdk/long.hpp", "int a;\n" * 400)
        self.assertEqual(self.size().returncode, 0)
        self.write("sdk/long.hpp", "int a;\n" * 401)
        self.refused("sdk/long.hpp has 401 lines; 400 is the limit")
        self.write("cmake/long_files.txt", "401 sdk/long.hpp\n")
        self.assertEqual(self.size().returncode, 0)

    def test_a_catalogue_of_messages_is_counted_apart(self):
        self.write("core/run/messages.hpp", 'inline constexpr MessageText a{"run.a", "b"};\n' * 401)
        found = self.size("--most", "4")
        self.assertEqual(found.returncode, 0, found.stderr)
        self.assertIn("   401  catalogues", found.stdout)
        self.write("core/run/messages.hpp", "int a;\n" * 401)
        self.refused("core/run/messages.hpp has 401 lines; 400 is the limit")

    def test_the_list_of_long_files_shrinks(self):
        self.write("cmake/long_files.txt", "450 sdk/long.hpp\n")
        self.write("sdk/long.hpp", "int a;\n" * 449)
        self.refused("cmake/long_files.txt: sdk/long.hpp has 449 lines, not 450: write that")
        self.write("sdk/long.hpp", "int a;\n" * 400)
        self.refused("cmake/long_files.txt: sdk/long.hpp has 400 lines, not 450: drop the line")
        (self.root / "sdk/long.hpp").unlink()
        self.refused("cmake/long_files.txt: there is no file sdk/long.hpp")

    def test_a_long_function_of_core(self):
        body = "  call();\n"
        self.write("core/run/long.cpp", "void a() {\n" + body * 58 + "}\n")
        self.assertEqual(self.size().returncode, 0)
        self.write("core/run/long.cpp", "void a() {\n" + body * 59 + "}\n")
        self.refused("core/run/long.cpp:1: a function of 61 lines; 60 is the limit")

    def test_a_fat_struct_of_core(self):
        members = "  int a = 0, b{1};\n  std::map<int, std::vector<int>> c;\n  void f() { int inside; }\n  static int s;\n  std::size_t d[2];\n"
        self.write("core/graph/fat.hpp", "struct Fat {\n" + members + "};\nenum class Kind { a, b };\n")
        self.assertIn("   4 core/graph/fat.hpp:Fat\n", self.size("--members").stdout)
        self.write("core/graph/fat.hpp", "class Fat final : public Base {\n" + "".join(f"  int m{i}_;\n" for i in range(16)) + "};\n")
        self.refused("core/graph/fat.hpp:Fat has 16 data members; 15 is the limit")

    def test_members_of_one_declaration_with_initial_values_count_each(self):
        self.write("core/graph/fat.hpp", "struct Fat {\n  std::atomic<int> a{0}, b{1},\n      c{2};\n  void f() {}\n  int d{3};\n};\n")
        self.assertIn("   4 core/graph/fat.hpp:Fat\n", self.size("--members").stdout)

    def fat(self, file, members):
        self.write(file, "struct Fat {\n  struct Params {\n" + "    Param p{1};\n" * members + "  };\n  Params seen;\n};\n")

    def test_a_wide_struct_of_a_plugin_or_tool(self):
        for file in ("plugins/path/fat.hpp", "tools/fulmar_fcu/fat.cpp"):
            self.fat(file, 25)
            self.assertEqual(self.size().returncode, 0)
            self.fat(file, 26)
            self.refused(f"{file}:Params has 26 data members; 25 is the limit")
            (self.root / file).unlink()
        self.fat("plugins/path/test/fat.hpp", 26)
        self.assertEqual(self.size().returncode, 0)

    def test_the_list_of_wide_structs_shrinks(self):
        self.write("cmake/wide_structs.txt", "30 plugins/path/fat.hpp:Params\n")
        self.fat("plugins/path/fat.hpp", 31)
        self.refused("plugins/path/fat.hpp:Params has 31 data members; 30 is the limit")
        self.fat("plugins/path/fat.hpp", 29)
        self.refused("cmake/wide_structs.txt: plugins/path/fat.hpp:Params has 29 data members, not 30: write that")
        self.fat("plugins/path/fat.hpp", 25)
        self.refused("cmake/wide_structs.txt: plugins/path/fat.hpp:Params has 25 data members, not 30: drop the line")
        (self.root / "plugins/path/fat.hpp").unlink()
        self.refused("cmake/wide_structs.txt: there is no struct plugins/path/fat.hpp:Params")


if __name__ == "__main__":
    unittest.main()

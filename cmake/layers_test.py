#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""layers.py finds what stands on the wrong floor: each fault is put into a small tree of its own."""
import pathlib
import shutil
import subprocess
import tempfile
import unittest

here = pathlib.Path(__file__).resolve().parent
FLOORS = "types loader log isolate graph tap live dds run replay app".split()


class Layers(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.root = pathlib.Path(scratch.name)
        for folder in FLOORS:
            self.write(f"core/{folder}/README.md", "what it is\n")
        self.write("core/types/type.hpp", "struct Type {};\n")
        self.write("core/run/flight.hpp", '#include "core/types/type.hpp"\n')
        self.write("core/types/test/type_test.cpp", '#include "core/run/flight.hpp"\n')  # tests may include what they like
        (self.root / "cmake").mkdir()
        shutil.copy(here / "layers.py", self.root / "cmake")
        subprocess.run(["git", "init", "-q", str(self.root)], check=True)

    def write(self, file, text):
        path = self.root / file
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)

    def layers(self, *options):
        subprocess.run(["git", "add", "."], cwd=self.root, check=True)
        return subprocess.run(["python3", "cmake/layers.py", *options], cwd=self.root, capture_output=True, text=True)

    def refused(self, sentence):
        found = self.layers()
        self.assertEqual(found.returncode, 1, found.stdout)
        self.assertIn(sentence, found.stdout)

    def test_a_tree_in_order(self):
        found = self.layers()
        self.assertEqual((found.returncode, found.stdout), (0, "2 files: no include upwards, no circle\n"), found.stderr)

    def test_an_include_upwards(self):
        self.write("core/types/field.hpp", '#include "core/graph/graph.hpp"\n')
        self.write("core/graph/graph.hpp", "")
        self.refused("core/types/field.hpp includes core/graph/graph.hpp: upwards")

    def test_core_on_what_stands_on_it(self):
        self.write("core/app/main.cpp", '#include "tools/fulmar_log/info.hpp"\n')
        self.refused("core/app/main.cpp includes tools/fulmar_log/info.hpp: core stands below")

    def test_a_circle(self):
        self.write("core/graph/a.hpp", '#include "core/graph/b.hpp"\n')
        self.write("core/graph/b.hpp", '#include "core/graph/a.hpp"\n')
        self.refused("circle: core/graph/a.hpp -> core/graph/b.hpp -> core/graph/a.hpp")

    def test_a_folder_without_a_floor_and_one_without_a_readme(self):
        self.write("core/other/thing.hpp", '#include "core/types/type.hpp"\n')
        self.refused("core/other is no folder of cmake/layers.py")
        (self.root / "core/tap/README.md").unlink()
        self.refused("core/tap has no README.md")

    def test_a_long_file_and_a_fat_struct_of_run(self):
        self.write("core/run/long.cpp", "int a;\n" * 451)
        self.refused("core/run/long.cpp has 451 lines; 450 is the limit in core/run")
        members = "  int a = 0, b{1};\n  std::map<int, std::vector<int>> c;\n  void f() { int inside; }\n  static int s;\n  std::size_t d[2];\n"
        self.write("core/run/fat.hpp", "struct Fat {\n" + members + "};\nenum class Kind { a, b };\n")
        self.assertIn("   4 Fat (core/run/fat.hpp)", self.layers("--members").stdout)
        self.write("core/run/fat.hpp", "class Fat final : public Base {\n" + "".join(f"  int m{i}_;\n" for i in range(16)) + "};\n")
        self.refused("core/run/fat.hpp: Fat has 16 data members; 15 is the limit in core/run")


if __name__ == "__main__":
    unittest.main()

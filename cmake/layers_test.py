#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""layers.py finds each wrong order: every fault is put into a separate small tree."""
import pathlib
import shutil
import subprocess
import tempfile
import unittest

here = pathlib.Path(__file__).resolve().parent
ROOMS = [f"core/{name}" for name in "types loader log isolate graph tap run app".split()] + ["links/live", "links/dds"]
ROOMS += [f"core/run/{name}" for name in "component state record flight command".split()]
ROOMS += [f"sdk/include/fulmar/flight/{name}" for name in "math earth model control path navigation".split()]


class Layers(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.root = pathlib.Path(scratch.name)
        for folder in ROOMS:
            self.write(f"{folder}/README.md", "what it is\n")
        self.write("core/types/type.hpp", "struct Type {};\n")
        self.write("core/run/flight/loop.hpp", '#include "core/types/type.hpp"\n')
        self.write("core/types/test/type_test.cpp", '#include "core/run/flight/loop.hpp"\n')  # tests may include what they like
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
        self.assertEqual((found.returncode, found.stdout.split(":")[0]), (0, "2 files"), found.stderr)

    def test_an_include_upwards(self):
        self.write("core/types/field.hpp", '#include "core/graph/graph.hpp"\n')
        self.write("core/graph/graph.hpp", "")
        self.refused("core/types/field.hpp includes core/graph/graph.hpp: upwards")

    def include(self, file, other):
        """One more include in `file`, of a file that is there then."""
        for path in (self.root / file, self.root / other):
            path.parent.mkdir(parents=True, exist_ok=True)
            path.touch()
        (self.root / file).write_text((self.root / file).read_text() + f'#include "{other.removeprefix("sdk/include/")}"\n')

    def test_core_on_what_stands_on_it(self):
        self.include("core/app/main.cpp", "tools/fulmar_log/info.hpp")
        self.refused("core/app/main.cpp includes tools/fulmar_log/info.hpp: upwards")

    def test_the_rooms_of_run_stand_on_each_other(self):
        self.include("core/run/run.hpp", "core/run/command/arm.hpp")
        self.include("core/run/command/arm.hpp", "core/run/flight/loop.hpp")
        self.include("core/run/flight/loop.hpp", "core/run/component/step.hpp")
        self.assertEqual(self.layers().returncode, 0)
        self.include("core/run/state/mode.hpp", "core/run/flight/loop.hpp")
        self.refused("core/run/state/mode.hpp includes core/run/flight/loop.hpp: upwards")
        self.include("core/run/component/call.hpp", "core/run/run.hpp")
        self.refused("core/run/component/call.hpp includes core/run/run.hpp: upwards")

    def test_the_rooms_of_flight_and_those_beside_each_other(self):
        flight = "sdk/include/fulmar/flight"
        self.include(f"{flight}/path/line.hpp", f"{flight}/math/vec.hpp")
        self.assertEqual(self.layers().returncode, 0)
        self.include(f"{flight}/math/vec.hpp", f"{flight}/model/wing.hpp")
        self.refused(f"{flight}/math/vec.hpp includes {flight}/model/wing.hpp: upwards")
        self.include(f"{flight}/path/line.hpp", f"{flight}/control/pid.hpp")
        self.refused(f"{flight}/path/line.hpp includes {flight}/control/pid.hpp: sideways")
        self.include("links/live/stream.hpp", "links/dds/topic.hpp")
        self.refused("links/live/stream.hpp includes links/dds/topic.hpp: sideways")

    def test_a_circle_of_headers(self):
        self.include("core/graph/a.hpp", "core/graph/b.hpp")
        self.include("core/graph/b.hpp", "core/graph/a.hpp")
        self.refused("circle: core/graph/a -> core/graph/b -> core/graph/a")

    def test_a_circle_that_closes_through_a_source(self):
        self.include("core/graph/a.cpp", "core/graph/a.hpp")
        self.include("core/graph/a.cpp", "core/graph/b.hpp")
        self.assertEqual(self.layers().returncode, 0)
        self.include("core/graph/b.hpp", "core/graph/a.hpp")
        self.refused("circle: core/graph/a -> core/graph/b -> core/graph/a")

    def test_what_a_unit_shares_with_itself_is_of_the_unit(self):
        self.include("core/graph/a_impl.hpp", "core/graph/a.hpp")
        self.include("core/graph/a.hpp", "core/graph/a_impl.hpp")
        self.assertEqual(self.layers().returncode, 0)
        self.include("core/graph/a_impl.hpp", "core/graph/b.hpp")
        self.include("core/graph/b.hpp", "core/graph/a.hpp")
        self.refused("circle: core/graph/a -> core/graph/b -> core/graph/a")

    def test_a_folder_out_of_the_order(self):
        self.include("core/other/thing.hpp", "core/types/type.hpp")
        self.refused("core/other is no folder of cmake/layers.py")
        self.include("core/run/other/thing.hpp", "core/types/type.hpp")
        self.refused("core/run/other is no folder of cmake/layers.py")
        self.include("links/other/thing.hpp", "core/types/type.hpp")
        self.refused("links/other is no folder of cmake/layers.py")

    def test_a_room_without_a_readme(self):
        for room in ("core/tap", "core/run/record", "links/dds", "sdk/include/fulmar/flight/earth"):
            (self.root / room / "README.md").unlink()
            self.refused(f"{room} has no README.md")


if __name__ == "__main__":
    unittest.main()

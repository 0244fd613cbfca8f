#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The reference is read from pages and headers, and a missing description is reported. Needs no build."""
import contextlib
import io
import pathlib
import tempfile
import unittest

import reference

PAGE = """# own

`own.so`, version 1.0.0, ABI 1.1

| component | what |
| --- | --- |
| [Law](#law) | Holds something. |

## Law

Holds something.

```yaml
name: {use: own/Law, in: {state: ...}}
```

### Inputs

| input | message | kind |
| --- | --- | --- |
| `state` | [Thing](#thing) | value |

### Parameters

| parameter | default | range | set | what |
| --- | --- | --- | --- | --- |
| `gain` | 2 rad/m | 0 .. 10 | live | roll \\| per error |

## Messages

### Thing

24 bytes, layout `0123456789abcdef`

| field | kind | unit |
| --- | --- | --- |
| `height_m` | f64 | m |
| `parts[].width_m` | f64 | m |
"""

HEADER = """// A licence
/// Something that is
/// somewhere.
struct Part {
  double width_m = 0, depth_m = 0;  ///< across
                                    ///< the way
};
struct Thing {
  double height_m = 0;  ///< above | the origin
  List<Part, 4> parts;
};
"""


class Reference(unittest.TestCase):
    def make(self, page):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            (folder / "out").mkdir()
            (folder / "out/own.md").write_text(page)
            (folder / "thing.hpp").write_text(HEADER)
            (folder / "mission.yaml").write_text("components:\n  mine: {fills: outer, use: own/Law}\n")
            out = io.StringIO()
            with contextlib.redirect_stdout(out):
                code = reference.main([str(folder / "out"), str(folder / "mission.yaml"), "--", str(folder / "thing.hpp")])
            return code, out.getvalue(), (folder / "out/README.md").read_text(), (folder / "out/messages.md").read_text()

    def test_index_and_messages(self):
        code, said, index, messages = self.make(PAGE)
        self.assertEqual(code, 0)
        self.assertTrue(said.startswith("1 plugins, 1 components: "), said)
        component = "[own/Law](own.md#law)"
        row = "| outer | Holds something. |"
        self.assertIn(f"| {component} {row}", index)
        self.assertIn(f"Read by {component}", messages)
        for field in ("| `height_m` | f64 | m |  |  | above \\| the origin |", "| `parts[].width_m` | f64 | m |  |  | across the way |"):
            self.assertIn(field, messages)

    def test_silence_is_told(self):
        code, said, _, _ = self.make(PAGE.replace("roll \\| per error", ""))
        self.assertEqual(code, 1)
        self.assertRegex(said, r"^own/Law: [^\n]*`gain`[^\n]*\n$")
        code, said, _, _ = self.make(PAGE.replace("\nHolds something.\n\n```", "\n```"))
        self.assertEqual(code, 1)
        self.assertIn("own/Law: no doc", said)


if __name__ == "__main__":
    unittest.main()

// SPDX-License-Identifier: BSD-3-Clause
// Scripts that are opened, refused and reloaded; messages declared in Python.
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <fulmar/message.hpp>
#include <fulmar/msg/plan.hpp>
#include <fulmar/schema.hpp>

#include "open_script.hpp"

namespace script_test {

using namespace script_test;
namespace fs = std::filesystem;

namespace {

enum class Shape : std::uint8_t { sine, square };

/// The message of the script below: the C++ compiler gives the expected table.
struct Wobble {
  float amplitude_rad = 0.5f;
  bool on = true;
  std::uint8_t small = 0;
  std::int64_t at_ns = 0;
  Shape shape = Shape::sine;
  fulmar::Text<12> name;
  fulmar::Vec3<fulmar::Ned> offset_m;
  fulmar::Quat turn;
  std::array<double, 3> gains_ratio{};
  fulmar::List<fulmar::Waypoint, 5> points;
  std::uint32_t count = 0;
  double share_frac = 0;
};

const char* const wobble = R"(
import enum
import fulmar_plugin as f
class Shape(enum.IntEnum):
    sine = 0
    square = 1
class Wobble(f.Message):
    amplitude_rad: f.f32 = 0.5
    on: bool = True
    small: f.u8
    at_ns: int
    shape: Shape
    name: f.Text(12)
    offset_m: f.Ned
    turn: f.Quat
    gains_ratio: f.Array(float, 3)
    points: f.List(f.Waypoint, 5)
    count: f.u32
    share_frac: float
class Law:
    class Outputs: wobble = f.Out(Wobble)
    def step(self, tick, inp, p, out):
        w = out.wobble
        w.shape = Shape.square
        w.name = "albatross and more"
        w.gains_ratio[1] = 2.5
        w.points.clear()
        w.points.append(f.Waypoint(course_rad=1.5))
        w.points.append(f.Waypoint())
        w.count = len(w.points)
)";

void same_tables(const fulmar_type& a, const fulmar_type& b) {
  CHECK(std::string(a.name) == b.name);
  CHECK(a.size == b.size);
  CHECK(a.align == b.align);
  REQUIRE(a.field_count == b.field_count);
  for (std::uint32_t i = 0; i < a.field_count; ++i) {
    const fulmar_field &x = a.fields[i], &y = b.fields[i];
    CAPTURE(x.name);
    CHECK(std::string(x.name) == y.name);
    CHECK(std::string(x.unit) == y.unit);
    CHECK(x.kind == y.kind);
    CHECK(x.shape == y.shape);
    CHECK(x.offset == y.offset);
    CHECK(x.count == y.count);
    CHECK(x.stride == y.stride);
    CHECK(x.items == y.items);
    CHECK(x.min == y.min);
    CHECK(x.max == y.max);
    REQUIRE((x.type == nullptr) == (y.type == nullptr));
    if (x.type != nullptr) same_tables(*x.type, *y.type);
    REQUIRE(x.label_count == y.label_count);
    for (std::uint32_t k = 0; k < x.label_count; ++k) CHECK(std::string(x.labels[k]) == y.labels[k]);
  }
}

std::string with_ports(const std::string& inputs, const std::string& outputs = "e_m = f.Probe()") {
  return "import fulmar_plugin as f\nclass Law:\n  class Inputs:\n    " + inputs +
         "\n  class Outputs:\n    " + outputs + "\n  def step(self, tick, inp, p, out): pass\n";
}

struct Folder {
  fs::path path = fs::temp_directory_path() / ("fulmar-python-test-" + std::to_string(::getpid()));
  Folder() { fs::create_directories(path); }
  ~Folder() { fs::remove_all(path); }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(path / name) << text;
    return (path / name).string();
  }
};

}  // namespace

TEST_CASE("a message declared in Python has the table that the C++ compiler gives its twin") {
  Law law(wobble);
  same_tables(*law.c->outputs[0].type, fulmar::describe<Wobble>());
  REQUIRE(law.configure() == FULMAR_OK);
  REQUIRE(law.step() == FULMAR_OK);
  const auto w = law.result<Wobble>("wobble");
  CHECK(w.amplitude_rad == 0.5f);
  CHECK(w.on);
  CHECK(w.shape == Shape::square);
  CHECK(w.name.view() == "albatross a");  // cut to the room
  CHECK(w.turn.w == 1);
  CHECK(w.gains_ratio[1] == 2.5);
  CHECK(w.points.count == 2);
  CHECK(w.points[0].course_rad == 1.5);
  CHECK(w.count == 2);
}

TEST_CASE("what cannot be a component is refused with one sentence that names the line") {
  CHECK(refusal("x = (\n").starts_with("law.py:1: '(' was never closed"));
  CHECK(refusal("import nosuchthing\n") == "law.py:1: python.module_missing(nosuchthing)");
  const std::string by_zero = "ZeroDivisionError: division by zero";  // of Python
  CHECK(refusal("import sys\n\nx = 1 / 0\n") == "law.py:3: " + by_zero + " [x = 1 / 0]");
  CHECK(refusal("import sys\nsys.exit(3)\n").starts_with("law.py:2: SystemExit: 3"));
  CHECK(refusal("x = 1\n") == "law.py: python.component_missing");
  const std::string import = "import fulmar_plugin as f\n", message = import + "class M(f.Message):\n";
  const std::string without_step = import + "class Law:\n  class Outputs: e_m = f.Probe()\n";
  CHECK(refusal(without_step) == "law.py:2: Law: python.step_missing");
  CHECK(
      refusal(with_ports("state = f.In('VehicleStat')"))
          .starts_with(
              "law.py:4: Law.Inputs.state: python.message_unknown(VehicleStat,  [VehicleState] Actuators, "));
  CHECK(refusal(with_ports("state = 3")) ==
        "law.py:4: Law.Inputs.state: python.declaration_invalid(3, input; Inputs holds In, Optional, Queue "
        "and Request)");
  CHECK(refusal(with_ports("state = f.In(int)")) ==
        "law.py:4: Law.Inputs.state: python.message_type_invalid(<class 'int'>)");
  CHECK(refusal(with_ports("s = f.In('Imu')", "e = f.Probe()")) ==
        "law.py:6: Law.Outputs.e: python.probe_unit_missing");
  CHECK(refusal(message + "  height: float\n").starts_with("law.py:3: M.height: python.unit_missing(_mps2 "));
  CHECK(refusal(message + "  name: str\n")
            .starts_with("law.py:3: M.name: python.field_type_invalid(<class 'str'>)"));
  const std::string from_one = "class E(enum.IntEnum):\n  a = 1\n";
  CHECK(refusal("import enum\n" + import + from_one + "class M(f.Message):\n  e: E\n") ==
        "law.py:6: M.e: python.enum_values_invalid(E)");
}

TEST_CASE("a changed script is a new module; the old one flies on until it is closed") {
  const auto text = [](const std::string& number) {
    return "import fulmar_plugin as f\nclass Law:\n  class Outputs: n_ratio = f.Probe()\n  def step(self, "
           "tick, inp, p, out): out.n_ratio "
           "= " +
           number + "\n";
  };
  Law before(text("1"));
  REQUIRE(before.configure() == FULMAR_OK);
  {
    Law after(text("2"));
    REQUIRE(after.configure() == FULMAR_OK);
    REQUIRE(after.step() == FULMAR_OK);
    CHECK(after.result<double>("n_ratio") == 2);
  }
  REQUIRE(before.step() == FULMAR_OK);
  CHECK(before.result<double>("n_ratio") == 1);
}

TEST_CASE("a module beside the script is found, and imported anew when it has changed") {
  const Folder folder;
  const std::string script =
      "import fulmar_plugin as f\nimport fulmar_test_gains\nclass Law:\n  class Outputs: n_ratio = "
      "f.Probe()\n"
      "  def step(self, tick, inp, p, out): out.n_ratio = fulmar_test_gains.gain\n";
  const std::string file = folder.write("law.py", script);
  for (const std::string gain : {"1.5", "22.5"}) {
    folder.write("fulmar_test_gains.py", "gain = " + gain + "\n");
    Law law(script, "", file);
    REQUIRE(law.configure() == FULMAR_OK);
    REQUIRE(law.step() == FULMAR_OK);
    CHECK(law.result<double>("n_ratio") == std::stod(gain));
  }
  CHECK(!fs::exists(folder.path / "__pycache__"));
}

TEST_CASE("a thousand scripts opened and closed leave nothing open") {
  const std::string text = with_ports("s = f.In('Imu')");
  for (int i = 0; i < 1000; ++i) REQUIRE(refusal(text) == "opened");  // more than may be open at once
}

TEST_CASE("several classes of a file are several components, in their order; helpers are none") {
  const std::string text =
      "import fulmar_plugin as f\nclass _Base:\n  class Outputs: e_m = f.Probe()\n  def step(self, tick, "
      "inp, p, out): out.e_m = self.n\n"
      "class Two(_Base): n = 2\nclass One(_Base): n = 1\nclass Helper: pass\n";
  Law one(text, "One");
  REQUIRE(one.configure() == FULMAR_OK);
  REQUIRE(one.step() == FULMAR_OK);
  CHECK(one.result<double>("e_m") == 1);
  CHECK(std::string(Law(text).c->name) == "Two");
}

}  // namespace script_test

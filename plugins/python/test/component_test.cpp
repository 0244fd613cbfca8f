// SPDX-License-Identifier: BSD-3-Clause
// A Python class as a component: ports and parameters of every kind, status, exceptions, reloading.
#include <fulmar/msg/airframe.hpp>
#include <fulmar/msg/attitude_command.hpp>
#include <fulmar/msg/guidance_command.hpp>
#include <fulmar/msg/path.hpp>
#include <fulmar/msg/plan_edit.hpp>
#include <fulmar/msg/vehicle_state.hpp>
#include <thread>

#include "open_script.hpp"

namespace component_test {

using namespace fulmar;
using namespace script_test;

TEST_CASE("a sample goes in and a result comes out") {
  Law law(R"(
import fulmar_plugin as f
class Law:
    """Says what it sees."""
    class Inputs:
        state = f.In("VehicleState")
        command = f.In("GuidanceCommand")
    class Outputs:
        attitude = f.Out("AttitudeCommand")
    def step(self, tick, inp, p, out):
        out.attitude.roll_rad = inp.command.course_rad - inp.state.course_rad
        out.attitude.pitch_rad = inp.state.position_m.east + inp.state.attitude.w
        out.attitude.throttle_frac = tick.dt_s + tick.now_s
)");
  CHECK(std::string(law.c->name) == "Law");
  CHECK(std::string(law.c->doc) == "Says what it sees.");
  CHECK((law.c->flags & FULMAR_RESIDENT) != 0);
  REQUIRE(law.configure() == FULMAR_OK);
  VehicleState state;
  state.course_rad = 0.25;
  state.position_m.east = 7;
  state.attitude.w = 0.5;
  GuidanceCommand command;
  command.course_rad = 1;
  law.show("state", state);
  law.show("command", command);
  REQUIRE(law.step() == FULMAR_OK);
  const auto attitude = law.result<AttitudeCommand>("attitude");
  CHECK(attitude.roll_rad == 0.75);
  CHECK(attitude.pitch_rad == 7.5);
  CHECK(attitude.throttle_frac == doctest::Approx(1.51));
}

TEST_CASE("an input knows its sample's age, number and freshness; an optional one may have none") {
  Law law(R"(
import fulmar_plugin as f
class Law:
    class Inputs: state = f.Optional("VehicleState")
    class Outputs: seen_ratio = f.Probe(); age_s = f.Probe()
    def step(self, tick, inp, p, out):
        if inp.state:
            out.seen_ratio = inp.state.sequence * 100 + inp.state.fresh * 10 + inp.state.stale
            out.age_s = inp.state.age_s + inp.state.valid_at_ns
)");
  REQUIRE(law.configure() == FULMAR_OK);
  REQUIRE(law.step() == FULMAR_OK);
  CHECK(law.out("seen_ratio").count == 0);  // a probe that is not written stays silent
  VehicleState state;
  law.show("state", state, 5);
  law.inputs[0].age_ns = 250'000'000;
  law.inputs[0].valid_at_ns = 3;
  REQUIRE(law.step() == FULMAR_OK);
  CHECK(law.out("seen_ratio").count == 1);
  CHECK(law.result<double>("seen_ratio") == 510);
  CHECK(law.result<double>("age_s") == 3.25);
  law.inputs[0].flags = FULMAR_STALE;
  REQUIRE(law.step() == FULMAR_OK);
  CHECK(law.result<double>("seen_ratio") == 501);
}

TEST_CASE("queues bring every sample, requests are answered, events and queues come out") {
  Law law(R"(
import fulmar_plugin as f
class Law:
    class Inputs: edits = f.Queue("PlanEdit"); edit = f.Request("PlanEdit", 4)
    class Outputs: told = f.Event("PlanEdit"); copies = f.OutQueue("PlanEdit", 2); lost_ratio = f.Probe()
    def step(self, tick, inp, p, out):
        out.lost_ratio = inp.edits.lost
        for edit in inp.edits:
            out.copies.push(edit, edit.valid_at_ns + 1)
        if len(inp.edits) == 1:
            out.copies.push(f.PlanEdit(index=77))
        for ask in inp.edit:
            if ask.kind == f.PlanEdit.Kind.remove and ask.index == 11:
                ask.refuse("nothing is removed here")
            elif ask.kind == f.PlanEdit.Kind.remove:
                ask.refuse("\u00fc" * 100 + " of" * 100)
            else:
                ask.accept()
                out.told.publish(ask, 5)
)");
  REQUIRE(law.configure() == FULMAR_OK);
  PlanEdit edits[3];
  for (std::uint32_t i = 0; i < 3; ++i) {
    edits[i].index = 10 + i;
    edits[i].waypoint.position_m.north = i;
  }
  const std::int64_t stamps[3] = {100, 200, 300};
  fulmar_input& queue = law.inputs[law.input("edits")];
  queue.data = edits;
  queue.stamps_ns = stamps;
  queue.count = 3;
  queue.lost = 6;
  REQUIRE(law.step() == FULMAR_OK);
  CHECK(law.result<double>("lost_ratio") == 6);
  CHECK(law.out("copies").count == 2);
  CHECK(law.out("copies").lost == 1);
  CHECK(law.result<PlanEdit>("copies", 1).index == 11);
  CHECK(law.result<PlanEdit>("copies", 1).waypoint.position_m.north == 1);
  CHECK(law.out("copies").stamps_ns[1] == 201);
  CHECK(law.out("told").count == 0);

  queue.count = 1;
  fulmar_answer answers[2] = {};
  fulmar_input& requests = law.inputs[law.input("edit")];
  edits[1].kind = PlanEditKind::remove;
  requests.data = edits;
  requests.stamps_ns = stamps;
  requests.count = 2;
  requests.answers = answers;
  REQUIRE(law.step() == FULMAR_OK);
  CHECK(law.out("copies").count == 2);
  CHECK(law.out("copies").lost == 0);
  CHECK(law.result<PlanEdit>("copies", 1).index == 77);
  CHECK(law.out("copies").stamps_ns[1] == law.tick.now_ns);
  CHECK(law.out("told").count == 1);
  CHECK(law.out("told").valid_at_ns == 5);
  CHECK(law.result<PlanEdit>("told").index == 10);
  CHECK(answers[0].verdict == FULMAR_ACCEPTED);
  CHECK(answers[1].verdict == FULMAR_REFUSED);
  CHECK(std::string(answers[1].reason) == "nothing is removed here");

  edits[0].kind = PlanEditKind::remove;
  REQUIRE(law.step() == FULMAR_OK);
  const std::string cut = answers[0].reason;
  CHECK(cut.size() == 123);
  CHECK(cut.ends_with("\xc3\xbc..."));
}

TEST_CASE("parameters of every kind arrive, and change with a retune") {
  Law law(R"(
import fulmar_plugin as f
class Law:
    class Outputs: sum_ratio = f.Probe(); word_ratio = f.Probe(); mass_kg = f.Probe()
    class Params:
        gain = f.Param(1.5, "rad/rad", 0, 5, "a gain")
        on = f.Flag(True)
        n = f.Count(3, 0, 10)
        law = f.Choice("hold", ["hold", "takeoff"])
        name = f.TextParam("wren", 16)
        wind = f.Vector((3, -4, 0), "ned", "m/s", -30, 30)
        airframe = f.Record("Airframe")
        table = f.Blob()
        fixed = f.Param(1, setup=True)
    def configure(self, p): self.calls = 0
    def retune(self, p): self.calls += 1
    def step(self, tick, inp, p, out):
        out.sum_ratio = p.gain + 10 * p.on + 100 * p.n + 1000 * (p.law == "takeoff") + 1e4 * p.wind.east
        out.word_ratio = len(p.name) + 100 * len(p.table.data) + 1000 * len(p.table.name) + 1e6 * self.calls
        out.mass_kg = p.airframe.mass_kg * (10 if p.airframe.given else 1)
)");
  const fulmar_param& gain = law.c->params[law.param("gain")];
  CHECK(gain.kind == FULMAR_NUMBER);
  CHECK(gain.initial[0] == 1.5);
  CHECK(gain.max == 5);
  CHECK(std::string(gain.unit) == "rad/rad");
  CHECK(gain.flags == FULMAR_LIVE);
  CHECK(law.c->params[law.param("fixed")].flags == 0);
  CHECK(law.c->params[law.param("airframe")].type->size == sizeof(Airframe));
  CHECK(static_cast<const Airframe*>(law.c->params[law.param("airframe")].initial_data)->wing.oswald_ratio ==
        0.9);

  Airframe airframe;
  airframe.mass_kg = 4.5;
  fulmar_value& record = law.values[law.param("airframe")];
  record.data = &airframe;
  record.size = sizeof airframe;
  record.integer = 1;
  fulmar_value& blob = law.values[law.param("table")];
  blob.data = "12345";
  blob.size = 5;
  blob.text = "polar.bin";
  REQUIRE(law.configure() == FULMAR_OK);
  REQUIRE(law.step() == FULMAR_OK);
  CHECK(law.result<double>("sum_ratio") == 1.5 + 10 + 300 - 4e4);
  CHECK(law.result<double>("word_ratio") == 4 + 500 + 9000);
  CHECK(law.result<double>("mass_kg") == 45);

  record.data = blob.data = nullptr;  // as in a retune: they stay
  law.values[law.param("law")].integer = 1;
  law.values[law.param("gain")].number[0] = 2;
  law.values[law.param("wind")].number[1] = 0;
  law.values[law.param("name")].text = "albatross";
  REQUIRE(law.retune() == FULMAR_OK);
  REQUIRE(law.step() == FULMAR_OK);
  CHECK(law.result<double>("sum_ratio") == 2 + 10 + 300 + 1000);
  CHECK(law.result<double>("word_ratio") == 9 + 500 + 9000 + 1e6);
  CHECK(law.result<double>("mass_kg") == 45);
}

TEST_CASE("who takes over sees what was last applied") {
  Law law(R"(
import fulmar_plugin as f
class Law:
    class Outputs: attitude = f.Out("AttitudeCommand"); plan = f.Event("PlanEdit"); error_m = f.Probe()
    def activate(self, tick, inp, p, last):
        self.roll = last.attitude.roll_rad
        if last.plan is not None: return f.failed
    def step(self, tick, inp, p, out):
        out.attitude.roll_rad = self.roll
)");
  REQUIRE(law.configure() == FULMAR_OK);
  AttitudeCommand applied;
  applied.roll_rad = 0.3;
  law.last[law.output("attitude")].data = &applied;
  REQUIRE(law.activate() == FULMAR_OK);
  REQUIRE(law.step() == FULMAR_OK);
  CHECK(law.result<AttitudeCommand>("attitude").roll_rad == 0.3);
  const PlanEdit edit;
  law.last[law.output("plan")].data = &edit;
  CHECK(law.activate() == FULMAR_FAILED);
}

TEST_CASE("a vehicle reads, sets the time, and writes") {
  Law law(R"(
import fulmar_plugin as f
class Cart:
    class Inputs: actuators = f.In("Actuators")
    class Outputs: truth = f.Out("VehicleState")
    def read(self, tick, p, out):
        tick.now_ns += 2500000
        out.truth.height_m = 12
    def write(self, tick, inp, p):
        if inp.actuators.throttle_frac < 0: raise ValueError("no such throttle")
)");
  CHECK((law.c->flags & FULMAR_VEHICLE) != 0);
  REQUIRE(law.configure() == FULMAR_OK);
  REQUIRE(law.read() == FULMAR_OK);
  CHECK(law.tick.now_ns == 1'502'500'000);
  CHECK(law.result<VehicleState>("truth").height_m == 12);
  CHECK(law.result<VehicleState>("truth").attitude.w == 1);  // the defaults of C++
  CHECK(law.result<VehicleState>("truth").airspeed_std_mps == unknown_std);
  double actuators[4] = {};
  law.show("actuators", actuators);
  CHECK(law.write() == FULMAR_OK);
  actuators[0] = -1;
  CHECK(law.write() == FULMAR_FAILED);
  CHECK(std::string(law.error.text).find("no such throttle") != std::string::npos);
}

TEST_CASE("the seed reaches whoever asks for it, and sets keep their order") {
  const char* const text = R"(
import fulmar_plugin as f
import random
class Law:
    class Outputs: chance_ratio = f.Probe(); order_ratio = f.Probe()
    def __init__(self, seed): self.random = random.Random(seed)
    def step(self, tick, inp, p, out):
        out.chance_ratio = self.random.random()
        out.order_ratio = hash("albatross") % 1000003
)";
  Law one(text, "", "/nowhere/a.py", 7), same(text, "", "/nowhere/a.py", 7),
      other(text, "", "/nowhere/a.py", 8);
  for (Law* law : {&one, &same, &other}) {
    REQUIRE(law->configure() == FULMAR_OK);
    REQUIRE(law->step() == FULMAR_OK);
  }
  CHECK(one.result<double>("chance_ratio") == same.result<double>("chance_ratio"));
  CHECK(one.result<double>("chance_ratio") != other.result<double>("chance_ratio"));
  CHECK(one.result<double>("chance_ratio") == 0.32383276483316237);  // random.Random(7).random() of CPython
}

TEST_CASE("a step may come from any thread") {
  Law law(R"(
import fulmar_plugin as f
class Law:
    class Outputs: n_ratio = f.Probe()
    n = 0
    def step(self, tick, inp, p, out):
        self.n += 1
        out.n_ratio = self.n
)");
  REQUIRE(law.configure() == FULMAR_OK);
  std::uint32_t status = FULMAR_FAILED;
  for (int i = 0; i < 3; ++i) std::thread([&] { status = law.step(); }).join();
  CHECK(status == FULMAR_OK);
  CHECK(law.result<double>("n_ratio") == 3);
}

TEST_CASE("numpy sees the memory of a port") {
  if (refusal("import numpy\nimport fulmar_plugin as f\nclass L:\n  class Outputs: a_m = f.Probe()\n  def "
              "step(self, t, i, p, o): pass") != "opened") {
    MESSAGE("numpy is not installed: skipped");
    return;
  }
  Law law(R"(
import fulmar_plugin as f
import numpy as np
class Law:
    class Inputs: state = f.In("VehicleState")
    class Outputs: path = f.Out("Path"); norm_m = f.Probe(); roll_rad = f.Probe()
    def step(self, tick, inp, p, out):
        state = inp.state.numpy()
        out.norm_m = np.linalg.norm(inp.state.position_m.numpy())
        out.roll_rad = state["roll_rad"] + state["position_m"]["east"]
        out.path.origin_m.numpy()[:] = 2 * inp.state.position_m.numpy()
        out.path.direction_ratio.set(np.array([0.0, 1.0, 0.0]))
)");
  REQUIRE(law.configure() == FULMAR_OK);
  VehicleState state;
  state.position_m = {3, 4, 0};
  state.roll_rad = 0.125;
  law.show("state", state);
  REQUIRE(law.step() == FULMAR_OK);
  CHECK(law.result<double>("norm_m") == 5);
  CHECK(law.result<double>("roll_rad") == 4.125);
  CHECK(law.result<Path>("path").origin_m == Vec3<Ned>{6, 8, 0});
  CHECK(law.result<Path>("path").direction_ratio == Vec3<Ned>{0, 1, 0});
  state.position_m.north = 0;  // the next sample shows in the same view
  REQUIRE(law.step() == FULMAR_OK);
  CHECK(law.result<double>("norm_m") == 4);
}

TEST_CASE("an exception is a failed status with place, line and message") {
  Law law(R"(
import fulmar_plugin as f
def helper(x):
    return 1 / x
class Law:
    class Outputs: attitude = f.Out("AttitudeCommand"); told = f.Event("PlanEdit"); error_m = f.Probe()
    bad = True
    def step(self, tick, inp, p, out):
        out.told.publish()
        out.error_m = 3
        if self.bad:
            self.bad = False
            helper(0)
        if tick.index == 1: raise ValueError("x" * 1000)
)");
  REQUIRE(law.configure() == FULMAR_OK);
  CHECK(law.step() == FULMAR_FAILED);
  const std::string by_zero = "ZeroDivisionError: division by zero";  // of Python
  CHECK(std::string(law.error.text) == "law.py:4 in helper: " + by_zero + " [return 1 / x]");
  CHECK(law.out("error_m").count == 0);
  CHECK(law.out("told").count == 0);
  CHECK(law.step() == FULMAR_OK);
  law.tick.index = 1;
  CHECK(law.step() == FULMAR_FAILED);
  const std::string text = law.error.text;
  CHECK(text.size() == 247);
  CHECK(text.starts_with("law.py:14 in step: ValueError: xxx"));
  CHECK(text.ends_with("..."));
}

TEST_CASE("a misspelt name fails at once, and a whole message may be assigned") {
  const std::string head =
      "import fulmar_plugin as f\nclass Law:\n  class Outputs: attitude = f.Out('AttitudeCommand'); e_m = "
      "f.Probe()\n"
      "  class Params: gain = f.Param(1.0)\n  def step(self, tick, inp, p, out):\n    ";
  const auto error = [&](const std::string& line) {
    Law law(head + line + "\n");
    law.configure();
    return law.step() == FULMAR_OK ? std::string("ok") : std::string(law.error.text);
  };
  const std::string lacks = " object has no attribute ";  // of Python
  CHECK(error("out.atitude = 1").find("'Outputs'" + lacks + "'atitude'") != std::string::npos);
  CHECK(error("out.attitude.rol_rad = 1").find("'AttitudeCommand'" + lacks + "'rol_rad'") !=
        std::string::npos);
  CHECK(error("p.gian").find("'Params'" + lacks + "'gian'") != std::string::npos);
  CHECK(error("out.attitude = 3").find("python.output_type_invalid(attitude, AttitudeCommand, int)") !=
        std::string::npos);
  CHECK(error("return 'ok'").find("return nothing, f.ok, f.degraded or f.failed") != std::string::npos);
  CHECK(error("return f.ok") == "ok");
  Law law(head + "out.attitude = f.AttitudeCommand(roll_rad=0.5); return f.degraded\n");
  REQUIRE(law.configure() == FULMAR_OK);
  REQUIRE(law.step() == FULMAR_DEGRADED);
  CHECK(law.result<AttitudeCommand>("attitude").roll_rad == 0.5);
}

TEST_CASE("an exception in the constructor or in configure is told at set-up") {
  const std::string tail = "  class Outputs: e_m = f.Probe()\n  def step(self, tick, inp, p, out): pass\n";
  const std::string head = "import fulmar_plugin as f\nclass Law:\n  def ", raised = "OSError: no polar";
  Law unborn(head + "__init__(self): raise OSError('no polar')\n" + tail);
  CHECK(!unborn.created());
  CHECK(std::string(unborn.error.text).starts_with("law.py:3 in __init__: " + raised));
  Law law(head + "configure(self, p): raise OSError('no polar')\n" + tail);
  CHECK(law.configure() == FULMAR_FAILED);
  CHECK(std::string(law.error.text).starts_with("law.py:3 in configure: " + raised));
}

}  // namespace component_test

// SPDX-License-Identifier: BSD-3-Clause
// Each kind of death of a child costs the component one call, and the host nothing.
#include <csignal>

#include "core/error.hpp"
#include "workshop.hpp"

namespace death_test {

using namespace workshop;

namespace {

std::string fault_of_setup(const std::string& component, std::int64_t setup_ns = 10'000'000'000) {
  IsolatedOptions options = options_for(component);
  options.setup_ns = setup_ns;
  try {
    const Isolated child(lab()->info().components[options.index], options);
  } catch (const Error& fault) {
    CHECK(no_children());
    return fault.what();
  }
  return "";
}

}  // namespace

TEST_CASE("a fork in a step is rejected and fails the step") {
  Rig rig("Faulty");
  rig.there();
  rig.choose("fault", forks);
  REQUIRE(rig.configure() == FULMAR_OK);
  rig.give({3, 4, 5});
  CHECK(rig.step() == FULMAR_FAILED);
  CHECK(rig.text().find("isolate.fork_refused(fork, ") == 0);
  CHECK(rig.child->alive());
}

TEST_CASE("a copy of the child does not answer for it, neither when it returns nor when it crashes") {
  for (const Fault fault : {clones, clone_crashes}) {
    CAPTURE(fault);
    Rig rig("Faulty");
    rig.there();
    rig.choose("fault", fault);
    REQUIRE(rig.configure() == FULMAR_OK);
    for (int i = 0; i < 20; ++i) {
      rig.give({3, 4.0 + i, 5});
      CHECK(rig.step() == FULMAR_OK);
      CHECK(rig.first_output().y_m == 4.0 + i);
    }
    CHECK(rig.child->alive());
  }
}

TEST_CASE("each kind of death in a step is one failed step with its name, and the proxy stays dead") {
  struct Case {
    Fault fault;
    const char* death;
  };
  for (const Case& c :
       {Case{segfault, "isolate.segmentation_fault"}, Case{overflow, "isolate.stack_overflowed"},
        Case{aborts, "isolate.aborted"}, Case{terminates, "isolate.aborted"},
        Case{exits, "isolate.child_exited(3)"}, Case{killed, "isolate.child_killed(9)"},
        Case{divides, "isolate.arithmetic_error"}, Case{hangs, "isolate.child_hung(1500)"}}) {
    CAPTURE(c.death);
    Rig rig("Faulty");
    IsolatedOptions options = options_for("Faulty");
    if (c.fault == hangs) options.hang_ns = 1'500'000'000;
    rig.there(options);
    rig.choose("fault", c.fault);
    rig.value("at").number[0] = 1;
    REQUIRE(rig.configure() == FULMAR_OK);
    rig.give({3, 4, 5});
    CHECK(rig.step() == FULMAR_OK);
    CHECK(rig.first_output().y_m == 4);
    CHECK(rig.child->death() == std::string());
    rig.tick.now_ns = 2'000'000'000;
    rig.give({30, 40, 50});
    const std::int64_t begin = monotonic_ns();
    CHECK(rig.step() == FULMAR_FAILED);
    CHECK(monotonic_ns() - begin < 15'000'000'000);
    CHECK(rig.text() == c.death);
    CHECK(rig.child->death() == std::string(c.death));
    CHECK_FALSE(rig.child->alive());
    CHECK(rig.first_output().y_m == 4);  // no partial output is copied
    const std::int64_t again = monotonic_ns();
    CHECK(rig.step() == FULMAR_FAILED);
    CHECK(rig.retune() == FULMAR_FAILED);
    CHECK(rig.activate() == FULMAR_FAILED);
    CHECK(rig.configure() == FULMAR_FAILED);
    rig.table->deactivate(rig.instance);
    CHECK(monotonic_ns() - again < 1'500'000'000);  // no further wait
    CHECK(rig.text() == c.death);
    rig.instance = nullptr;
    rig.child.reset();
    CHECK(no_children());
  }
}

TEST_CASE("a child killed between two steps is detected in the next") {
  Rig rig("Faulty");
  rig.there();
  REQUIRE(rig.configure() == FULMAR_OK);
  rig.give({1, 2, 3});
  REQUIRE(rig.step() == FULMAR_OK);
  REQUIRE(rig.child->check());
  REQUIRE(::kill(rig.child->pid(), SIGKILL) == 0);
  CHECK(soon(2000, zombie_or_gone, rig.child->pid()));
  SUBCASE("or in a check") {
    CHECK(rig.child->alive());
    CHECK_FALSE(rig.child->check());
    CHECK_FALSE(rig.child->alive());
  }
  SUBCASE("by itself") { CHECK(rig.child->alive()); }
  CHECK(rig.step() == FULMAR_FAILED);
  CHECK(rig.text() == "isolate.child_killed(9)");
}

TEST_CASE("death in configure, activate and retune is reported in the same way") {
  for (const char* where : {"in_configure", "in_activate", "in_retune"}) {
    CAPTURE(where);
    Rig rig("Faulty");
    rig.there();
    rig.choose(where, segfault);
    rig.give({1, 2, 3});
    std::uint32_t status = rig.configure();
    if (where != std::string("in_configure")) {
      CHECK(status == FULMAR_OK);
      status = where == std::string("in_activate") ? rig.activate() : rig.retune();
    }
    CHECK(status == FULMAR_FAILED);
    CHECK(rig.text() == "isolate.segmentation_fault");
  }
}

TEST_CASE("a component that cannot be created is rejected with a sentence") {
  CHECK(fault_of_setup("CrashBorn") ==
        "mine: isolate.child_stopped(isolate_lab.so, isolate.segmentation_fault, created)");
  CHECK(fault_of_setup("ExitBorn") ==
        "mine: isolate.child_stopped(isolate_lab.so, isolate.child_exited(3), created)");
  CHECK(fault_of_setup("ThrowBorn") == "mine: isolate.not_created(the law is broken)");
  CHECK(fault_of_setup("HangBorn", 2'000'000'000) ==
        "mine: isolate.child_stopped(isolate_lab.so, isolate.child_hung(2000), created)");
}

TEST_CASE("a component that cannot be destroyed reports it and ends anyway") {
  for (const char* component : {"CrashEnd", "HangEnd"}) {
    IsolatedOptions options = options_for(component);
    options.setup_ns = 2'000'000'000;
    const bool hang = component == std::string("HangEnd");
    Isolated child(lab()->info().components[options.index], options);
    CHECK(child.end() ==
          (hang ? "mine: isolate.child_stopped(isolate_lab.so, isolate.child_hung(2000), destroyed)"
                : "mine: isolate.child_stopped(isolate_lab.so, isolate.segmentation_fault, destroyed)"));
    CHECK_FALSE(child.alive());
    CHECK(child.end().empty());
  }
  CHECK(no_children());
}

}  // namespace death_test

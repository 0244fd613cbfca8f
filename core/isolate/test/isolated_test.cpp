// SPDX-License-Identifier: BSD-3-Clause
// A component in a child: the same bytes as in this process, and nothing of the host lost when it dies.
#include "core/isolate/isolated.hpp"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>

#include "core/error.hpp"
#include "core/run/allocation.hpp"
#include "workshop.hpp"

using namespace workshop;
namespace fs = std::filesystem;

namespace {

// Inputs of every kind, by chance, the same for all rigs that get the same numbers.
void give_anything(Rig& rig, std::uint64_t number) {
  std::mt19937_64 random(number);
  const auto real = [&] { return static_cast<double>(random() % 20001) * 1e-3 - 10; };
  rig.tick = {static_cast<std::int64_t>(number) * 2'500'000, 2'500'000, number};
  if (number == 0 || random() % 3 != 0) rig.give({real(), real(), static_cast<std::uint32_t>(random())});
  else rig.inputs[0].flags = 0;
  rig.inputs[0].valid_at_ns = rig.tick.now_ns - static_cast<std::int64_t>(random() % 1000);
  rig.inputs[0].age_ns = rig.tick.now_ns - rig.inputs[0].valid_at_ns;
  if (random() % 50 == 0) rig.inputs[0].flags |= FULMAR_STALE;

  fulmar_input& word = rig.inputs[1];
  word = {};
  if (random() % 2 == 0) {
    for (std::byte& b : rig.in_data[1]) b = static_cast<std::byte>(random() % 64);
    word.data = rig.in_data[1].data();
    word.sequence = number;
    word.count = 1;
    word.valid_at_ns = static_cast<std::int64_t>(random() % 1000);
  }
  for (std::size_t i = 2; i < 4; ++i) {
    fulmar_input& in = rig.inputs[i];
    const std::uint32_t capacity = rig.info.inputs[i].capacity;
    in = {rig.in_data[i].data(), rig.in_stamps[i].data(), rig.answers[i].data(), 0, 0, 0, static_cast<std::uint32_t>(random() % (capacity + 1)), static_cast<std::uint32_t>(random() % 2), 0, 0};
    for (std::uint32_t k = 0; k < in.count; ++k) {
      const double x = real();
      std::memcpy(rig.in_data[i].data() + k * rig.info.inputs[i].type->size, &x, sizeof x);
      rig.in_stamps[i][k] = rig.tick.now_ns + k;
      rig.answers[i][k] = {};
    }
  }
}

bool same_output(const Rig& a, const Rig& b, std::size_t i) {
  const fulmar_output &x = a.outputs[i], &y = b.outputs[i];
  if (x.count != y.count || x.lost != y.lost || x.valid_at_ns != y.valid_at_ns) return false;
  const fulmar_port_kind kind = a.info.outputs[i].kind;
  if (kind == FULMAR_OUT_QUEUE && std::memcmp(x.stamps_ns, y.stamps_ns, x.count * sizeof(std::int64_t)) != 0) return false;
  return a.out_data[i] == b.out_data[i];
}

bool same_answers(const Rig& a, const Rig& b) {
  for (std::uint32_t k = 0; k < a.inputs[3].count; ++k)
    if (a.answers[3][k].verdict != b.answers[3][k].verdict || std::strcmp(a.answers[3][k].reason, b.answers[3][k].reason) != 0) return false;
  return true;
}

bool zombie_or_gone(pid_t pid) {
  std::ifstream in("/proc/" + std::to_string(pid) + "/stat");
  std::string word, state;
  if (!(in >> word)) return true;
  while (in >> state && state.size() != 1) continue;  // the name in parentheses may hold blanks
  return state == "Z" || state == "X";
}

bool soon(int limit_ms, bool (*done)(pid_t), pid_t pid) {
  for (int i = 0; i < limit_ms; ++i, ::usleep(1000))
    if (done(pid)) return true;
  return false;
}

std::size_t open_files() {
  std::size_t n = 0;
  for ([[maybe_unused]] const auto& entry : fs::directory_iterator("/proc/self/fd")) ++n;
  return n;
}

std::size_t shared_mappings() {
  std::ifstream in("/proc/self/maps");
  std::size_t n = 0;
  for (std::string line; std::getline(in, line);) n += line.find("memfd:fulmar-child") != std::string::npos ? 1 : 0;
  return n;
}

bool no_children() {
  return ::waitpid(-1, nullptr, WNOHANG) == -1 && errno == ECHILD;
}

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

TEST_CASE("a component in a child computes the same bytes as in the host, whatever crosses") {
  Rig here("Everything"), there("Everything");
  here.here();
  SUBCASE("sleeping") {
    IsolatedOptions options = options_for("Everything");
    options.spin_ns = 0;
    there.there(options);
  }
  SUBCASE("spinning") { there.there(); }
  Table table;
  table.gain_ratio[3] = 0.25;
  table.used = 4;
  std::vector<std::byte> blob(100'000, std::byte{17});
  for (Rig* rig : {&here, &there}) {
    rig->value("table").data = &table;
    rig->value("table").size = sizeof table;
    rig->value("table").integer = 1;
    rig->value("bytes").data = blob.data();
    rig->value("bytes").size = blob.size();
    rig->value("bytes").text = "bytes.bin";
    rig->value("tag").text = "red";
    rig->value("offset").number[0] = -4;
    REQUIRE(rig->configure() == FULMAR_OK);
  }
  std::size_t wrong = 0, refused = 0, silent = 0, full = 0;
  for (std::uint64_t n = 0; n < 3000; ++n) {
    for (Rig* rig : {&here, &there}) {
      give_anything(*rig, n);
      if (n % 500 == 100) rig->choose("law", static_cast<int>(n / 500 % 3)), rig->value("gain").number[0] = 0.001 * static_cast<double>(n);
      if (n % 500 == 100) rig->value("tag").text = n % 1000 == 100 ? "a longer tag" : "";
    }
    if (n % 500 == 100) wrong += here.retune() != there.retune();
    if (n % 700 == 200) {
      for (Rig* rig : {&here, &there})
        for (std::size_t i = 0; i < rig->last.size(); ++i) {
          std::memcpy(rig->last_data[i].data(), rig->out_data[i].data(), rig->last_data[i].size());
          rig->last[i] = {rig->last_data[i].data(), nullptr, nullptr, 5, 6, n, 1, 0, 0, 0};
        }
      wrong += here.activate() != there.activate();
    }
    if (n % 700 == 600) here.table->deactivate(here.instance), there.table->deactivate(there.instance);
    wrong += here.step() != there.step();
    for (std::size_t i = 0; i < here.outputs.size(); ++i) wrong += same_output(here, there, i) ? 0 : 1;
    wrong += same_answers(here, there) ? 0 : 1;
    silent += here.outputs[1].count == 0;
    full += here.outputs[2].lost;
    for (std::uint32_t k = 0; k < here.inputs[3].count; ++k) refused += here.answers[3][k].verdict == FULMAR_REFUSED;
  }
  CHECK(wrong == 0);
  CHECK(refused > 600);  // every way is taken
  CHECK(silent > 1000);
  CHECK(full > 100);
  CHECK(there.child->alive());
}

TEST_CASE("a second configure brings new files, and what the first brought is not needed any more") {
  Rig here("Everything"), there("Everything");
  here.here();
  there.there();
  for (std::size_t size : {10u, 300'000u, 1000u, 0u}) {
    const std::vector<std::byte> blob(size, static_cast<std::byte>(size % 251));
    for (Rig* rig : {&here, &there}) {
      rig->value("bytes").data = blob.empty() ? nullptr : blob.data();
      rig->value("bytes").size = blob.size();
      REQUIRE(rig->configure() == FULMAR_OK);
    }
    for (std::uint64_t n = 0; n < 20; ++n) {
      for (Rig* rig : {&here, &there}) give_anything(*rig, n);
      if (!blob.empty()) CHECK(here.step() == there.step());
      if (!blob.empty()) CHECK(same_output(here, there, 0));
    }
  }
}

TEST_CASE("every way to die in a step is one failed step with its name, and the proxy stays dead") {
  struct Case {
    Fault fault;
    const char* death;
  };
  for (const Case& c : {Case{segfault, "crashed (segmentation fault)"}, Case{overflow, "crashed (stack overflow)"}, Case{aborts, "aborted"},
                        Case{terminates, "aborted"}, Case{exits, "ended itself (exit code 3)"}, Case{killed, "was killed (signal 9)"},
                        Case{divides, "crashed (arithmetic error)"}, Case{hangs, "hung: no answer within 50 ms"}}) {
    CAPTURE(c.death);
    Rig rig("Faulty");
    IsolatedOptions options = options_for("Faulty");
    if (c.fault == hangs) options.hang_ns = 50'000'000;
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
    CHECK(monotonic_ns() - begin < 1'000'000'000);
    CHECK(rig.text() == c.death);
    CHECK(rig.child->death() == std::string(c.death));
    CHECK_FALSE(rig.child->alive());
    CHECK(rig.first_output().y_m == 4);  // nothing half-written comes out
    const std::int64_t again = monotonic_ns();
    CHECK(rig.step() == FULMAR_FAILED);
    CHECK(rig.retune() == FULMAR_FAILED);
    CHECK(rig.activate() == FULMAR_FAILED);
    CHECK(rig.configure() == FULMAR_FAILED);
    rig.table->deactivate(rig.instance);
    CHECK(monotonic_ns() - again < 10'000'000);  // at once: nobody is waited for
    CHECK(rig.text() == c.death);
    rig.instance = nullptr;
    rig.child.reset();
    CHECK(no_children());
  }
}

TEST_CASE("a child killed between two steps is found out in the next") {
  Rig rig("Faulty");
  rig.there();
  REQUIRE(rig.configure() == FULMAR_OK);
  rig.give({1, 2, 3});
  REQUIRE(rig.step() == FULMAR_OK);
  REQUIRE(::kill(rig.child->pid(), SIGKILL) == 0);
  CHECK(soon(2000, zombie_or_gone, rig.child->pid()));
  CHECK(rig.step() == FULMAR_FAILED);
  CHECK(rig.text() == "was killed (signal 9)");
}

TEST_CASE("dying in configure, activate and retune is told in the same way") {
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
    CHECK(rig.text() == "crashed (segmentation fault)");
  }
}

TEST_CASE("an exception arrives as its text and a failed step as its status, and the child lives on") {
  Rig rig("Faulty");
  rig.there();
  rig.choose("fault", throws);
  REQUIRE(rig.configure() == FULMAR_OK);
  rig.give({1, 2, 3});
  CHECK(rig.step() == FULMAR_FAILED);
  CHECK(rig.text() == "the law is broken");
  rig.choose("fault", fails);
  CHECK(rig.retune() == FULMAR_OK);
  CHECK(rig.step() == FULMAR_FAILED);
  CHECK(rig.text().empty());
  rig.choose("fault", none);
  rig.choose("in_retune", throws);
  CHECK(rig.retune() == FULMAR_FAILED);
  CHECK(rig.text() == "the law is broken");
  CHECK(rig.step() == FULMAR_OK);
  CHECK(rig.child->alive());
}

TEST_CASE("what is not a number comes through for the host's guard") {
  Rig rig("Faulty");
  rig.there();
  rig.choose("fault", not_a_number);
  REQUIRE(rig.configure() == FULMAR_OK);
  rig.give({1, 2, 3});
  CHECK(rig.step() == FULMAR_OK);
  CHECK(std::isnan(rig.first_output().y_m));
  CHECK(rig.first_output().x_m == 1);
}

TEST_CASE("the heap of a child is counted and weighed") {
  Rig rig("Faulty");
  rig.there();
  REQUIRE(rig.configure() == FULMAR_OK);
  rig.give({1, 2, 3});
  for (int i = 0; i < 100; ++i) REQUIRE(rig.step() == FULMAR_OK);
  CHECK(rig.child->allocations() == 0);
  CHECK(rig.child->heap_growth() == 0);
  rig.choose("fault", allocates);
  REQUIRE(rig.retune() == FULMAR_OK);
  for (int i = 0; i < 100; ++i) REQUIRE(rig.step() == FULMAR_OK);
  CHECK(rig.child->allocations() == 100);  // taken and given back
  CHECK(rig.child->heap_growth() == 0);
  rig.choose("fault", leaks);
  REQUIRE(rig.retune() == FULMAR_OK);
  for (int i = 0; i < 100; ++i) REQUIRE(rig.step() == FULMAR_OK);
  CHECK(rig.child->allocations() == 200);
  CHECK(rig.child->heap_growth() >= 100'000);
  CHECK(rig.child->heap_growth() < 110'000);
}

TEST_CASE("a component that cannot be created is refused in a sentence") {
  CHECK(fault_of_setup("CrashBorn") == "mine: isolate_lab.so crashed (segmentation fault) while being created");
  CHECK(fault_of_setup("ExitBorn") == "mine: isolate_lab.so ended itself (exit code 3) while being created");
  CHECK(fault_of_setup("ThrowBorn") == "mine: cannot be created: the law is broken");
  CHECK(fault_of_setup("HangBorn", 200'000'000) == "mine: isolate_lab.so hung: no answer within 200 ms while being created");
}

TEST_CASE("a component that cannot be destroyed says so and is gone all the same") {
  for (const char* component : {"CrashEnd", "HangEnd"}) {
    IsolatedOptions options = options_for(component);
    options.setup_ns = 2'000'000'000;
    const bool hang = component == std::string("HangEnd");
    Isolated child(lab()->info().components[options.index], options);
    CHECK(child.end() == (hang ? "mine: isolate_lab.so hung: no answer within 2000 ms while being destroyed"
                               : "mine: isolate_lab.so crashed (segmentation fault) while being destroyed"));
    CHECK_FALSE(child.alive());
    CHECK(child.end().empty());
  }
  CHECK(no_children());
}

TEST_CASE("a child that finds another component than its host knows is refused") {
  IsolatedOptions options = options_for("Faulty");
  ComponentInfo info = lab()->info().components[options.index];
  CHECK_THROWS_WITH_AS(Isolated(lab()->info().components[0], options),
                       doctest::Contains("mine: isolate_lab.so has no component 'Everything' in place 1 any more"), Error);
  options.index = 400;
  CHECK_THROWS_WITH_AS(Isolated(info, options), doctest::Contains("no component 'Faulty' in place 400"), Error);
  options = options_for("Faulty");
  auto grown = std::make_shared<Type>(*info.inputs[0].type);
  grown->hash ^= 1;
  grown->size += 8;
  info.inputs[0].type = grown;
  CHECK_THROWS_WITH_AS(Isolated(info, options), "mine: isolate_lab.so: the ports or parameters of 'Faulty' are not those that the host knows",
                       Error);
  info = lab()->info().components[options.index];
  info.vehicle = true;
  CHECK_THROWS_WITH_AS(Isolated(info, options), "mine: a vehicle cannot run in a process of its own.", Error);
  info.vehicle = false;
  options.copy = "/nowhere/at/all.so";
  CHECK_THROWS_WITH_AS(Isolated(info, options), doctest::Contains("mine: isolate_lab.so"), Error);
  ::setenv("FULMAR_CHILD", "/nowhere/fulmar-child", 1);
  CHECK_THROWS_WITH_AS(Isolated(info, options_for("Faulty")), "cannot start /nowhere/fulmar-child: No such file or directory.", Error);
  ::unsetenv("FULMAR_CHILD");
  CHECK(no_children());
}

TEST_CASE("a child inherits nothing but what it needs") {
  const int file = ::open("/dev/zero", O_RDONLY);  // without close-on-exec
  REQUIRE(file >= 0);
  Rig rig("Look");
  rig.there();
  REQUIRE(rig.configure() == FULMAR_OK);
  REQUIRE(rig.step() == FULMAR_OK);
  double seen[3];
  std::memcpy(seen, rig.out_data[0].data(), sizeof seen);
  CHECK(seen[0] == 0);  // descriptors
  CHECK(seen[1] == 0);  // bytes of standard input
  CHECK(seen[2] == 1);  // denormals are kept
  CHECK(::getpgid(rig.child->pid()) == rig.child->pid());
  ::close(file);
}

TEST_CASE("what a component prints goes to the host's standard error, not into its output") {
  int ends[2];
  REQUIRE(::pipe(ends) == 0);
  const int error = ::dup(STDERR_FILENO);
  ::dup2(ends[1], STDERR_FILENO);
  Rig rig("Faulty");
  rig.there();
  ::dup2(error, STDERR_FILENO);
  rig.choose("fault", prints);
  REQUIRE(rig.configure() == FULMAR_OK);
  rig.give({1, 2, 3});
  REQUIRE(rig.step() == FULMAR_OK);
  rig.instance = nullptr;
  rig.child.reset();
  char text[64] = "";
  CHECK(::read(ends[0], text, sizeof text - 1) > 0);
  CHECK(text == std::string("a word of the component\n"));
  for (int d : {ends[0], ends[1], error}) ::close(d);
}

TEST_CASE("two hundred children leave no zombie, descriptor or memory") {
  {
    Rig warm("Everything");
    warm.there();
  }
  const std::size_t files = open_files();
  REQUIRE(shared_mappings() == 0);
  for (int i = 0; i < 200; ++i) {
    Rig rig("Everything");
    rig.there();
    if (i % 2 == 0) REQUIRE(rig.configure() == FULMAR_OK);
  }
  CHECK(open_files() == files);
  CHECK(shared_mappings() == 0);
  CHECK(no_children());
}

TEST_CASE("a child ends with its host, be it asleep or in a step that never ends") {
  for (const bool busy : {false, true}) {
    int ends[2];
    REQUIRE(::pipe(ends) == 0);
    const pid_t host = ::fork();
    if (host == 0) {
      Rig rig("Faulty");
      rig.there();
      rig.choose("fault", busy ? hangs : none);
      rig.configure();
      const pid_t child = rig.child->pid();
      if (::write(ends[1], &child, sizeof child) != sizeof child) ::_exit(1);
      rig.give({1, 2, 3});
      if (busy) rig.step();
      for (;;) ::pause();
    }
    pid_t child = 0;
    REQUIRE(::read(ends[0], &child, sizeof child) == sizeof child);
    ::usleep(20'000);  // into the step
    CHECK_FALSE(zombie_or_gone(child));
    ::kill(host, SIGKILL);
    ::waitpid(host, nullptr, 0);
    CHECK(soon(5000, zombie_or_gone, child));
    ::close(ends[0]);
    ::close(ends[1]);
  }
}

TEST_CASE("two children live side by side, and the death of one is nothing to the other") {
  Rig one("Faulty"), two("Faulty");
  one.there();
  two.there();
  one.choose("fault", aborts);
  one.value("at").number[0] = 1;
  REQUIRE(one.configure() == FULMAR_OK);
  REQUIRE(two.configure() == FULMAR_OK);
  for (int i = 0; i < 1000; ++i) {
    one.give({1.0 * i, 1, 1});
    two.give({2.0 * i, 2, 2});
    REQUIRE(one.step() == FULMAR_OK);
    REQUIRE(two.step() == FULMAR_OK);
    REQUIRE(one.first_output().x_m == 1.0 * i);
    REQUIRE(two.first_output().x_m == 2.0 * i);
  }
  one.tick.now_ns = 1'000'000'000;
  CHECK(one.step() == FULMAR_FAILED);
  two.give({7, 8, 9});
  CHECK(two.step() == FULMAR_OK);
  CHECK(two.first_output().y_m == 8);
}

TEST_CASE("the proxy takes nothing from the host's heap in flight") {
  if (!counts_allocations()) {
    MESSAGE("skipped: this build does not count");
    return;
  }
  Rig rig("Everything"), dying("Faulty");
  rig.there();
  dying.there();
  dying.choose("fault", exits);
  REQUIRE(rig.configure() == FULMAR_OK);
  REQUIRE(dying.configure() == FULMAR_OK);
  give_anything(rig, 0);
  dying.give({1, 2, 3});
  const std::vector<fulmar_value> live = rig.values;
  const std::uint64_t before = thread_allocations();
  for (int i = 0; i < 100; ++i) rig.step();
  rig.table->retune(rig.instance, live.data(), &rig.error);
  rig.activate();
  rig.table->deactivate(rig.instance);
  dying.step();
  dying.step();
  CHECK(thread_allocations() == before);
  CHECK_FALSE(dying.child->alive());
}

// SPDX-License-Identifier: BSD-3-Clause
// The child as a process: inheritance, leftovers, and its end.
#include <fcntl.h>
#include <sys/resource.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>

#include "core/error.hpp"
#include "workshop.hpp"

namespace process_test {

using namespace workshop;
namespace fs = std::filesystem;

namespace {

std::size_t open_files() {
  std::size_t n = 0;
  for ([[maybe_unused]] const auto& entry : fs::directory_iterator("/proc/self/fd")) ++n;
  return n;
}

std::size_t shared_mappings() {
  std::ifstream in("/proc/self/maps");
  std::size_t n = 0;
  for (std::string line; std::getline(in, line);)
    n += line.find("memfd:fulmar-child") != std::string::npos ? 1 : 0;
  return n;
}

}  // namespace

TEST_CASE("the memory may have the same descriptor in the host as in the child") {
  const IsolatedOptions options = options_for("Faulty");
  const ComponentInfo info = lab()->info().components[options.index];
  const int kept = ::fcntl(shared_descriptor, F_DUPFD_CLOEXEC, 100);
  ::close(shared_descriptor);  // the next descriptor that is opened gets its number
  {
    Isolated isolated(info, options);
    CHECK(fs::read_symlink("/proc/self/fd/3").string().starts_with("/memfd:fulmar-child"));
    CHECK(isolated.alive());
  }
  if (kept >= 0) {
    ::dup2(kept, shared_descriptor);
    ::close(kept);
  }
}

TEST_CASE("a child that finds another component than its host expects is rejected") {
  IsolatedOptions options = options_for("Faulty");
  ComponentInfo info = lab()->info().components[options.index];
  CHECK_THROWS_WITH_AS(Isolated(lab()->info().components[0], options),
                       doctest::Contains("mine: isolate.component_moved(isolate_lab.so, Everything, 1)"),
                       Error);
  options.index = 400;
  CHECK_THROWS_WITH_AS(Isolated(info, options),
                       doctest::Contains("isolate.component_moved(isolate_lab.so, Faulty, 400)"), Error);
  options = options_for("Faulty");
  auto grown = std::make_shared<Type>(*info.inputs[0].type);
  grown->hash ^= 1;
  grown->size += 8;
  info.inputs[0].type = grown;
  CHECK_THROWS_WITH_AS(Isolated(info, options), "mine: isolate_lab.so: isolate.tables_differ(Faulty)", Error);
  info = lab()->info().components[options.index];
  info.vehicle = true;
  CHECK_THROWS_WITH_AS(Isolated(info, options), "mine: isolate.vehicle_not_isolated", Error);
  info.vehicle = false;
  options.copy = "/nowhere/at/all.so";
  CHECK_THROWS_WITH_AS(Isolated(info, options),
                       doctest::Contains("mine: loader.plugin_not_loadable(isolate_lab.so, "), Error);
  ::setenv("FULMAR_CHILD", "/nowhere/fulmar-child", 1);
  CHECK_THROWS_WITH_AS(Isolated(info, options_for("Faulty")),
                       "loader.program_not_started(/nowhere/fulmar-child, No such file or directory)", Error);
  ::unsetenv("FULMAR_CHILD");
  CHECK(no_children());
}

TEST_CASE("a child inherits only the descriptors that it needs") {
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

TEST_CASE("the output of a component goes to the host's standard error, not to its standard output") {
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
  const std::string printed = "a word of the component\n";  // by the component Faulty
  CHECK(text == printed);
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

TEST_CASE("a child ends with its host, asleep or in a step that never ends") {
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

TEST_CASE("a child leaves a core file only on request") {
  rlimit own{}, seen{};
  REQUIRE(::getrlimit(RLIMIT_CORE, &own) == 0);
  for (const bool wanted : {false, true}) {
    if (wanted) ::setenv("FULMAR_CORE", "1", 1);
    Rig rig("Faulty");
    rig.there();
    REQUIRE(::prlimit(rig.child->pid(), RLIMIT_CORE, nullptr, &seen) == 0);
    CHECK(seen.rlim_max == (wanted ? own.rlim_max : 0));
    ::unsetenv("FULMAR_CORE");
  }
}

}  // namespace process_test

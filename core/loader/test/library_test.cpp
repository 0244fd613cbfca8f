// SPDX-License-Identifier: BSD-3-Clause
// Loading, calling, unloading, reloading.
#include "core/loader/library.hpp"

#include <doctest/doctest.h>
#include <malloc.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cfenv>
#include <cstring>
#include <random>
#include <span>
#include <sstream>

#include "core/loader/build_id.hpp"
#include "tools/fulmar_inspect/inspect.hpp"
#include "workshop.hpp"

namespace library_test {

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define __SANITIZE_ADDRESS__ 1  // as clang defines it
#endif
#endif
#ifdef __SANITIZE_ADDRESS__
extern "C" std::size_t
__sanitizer_get_current_allocated_bytes();  // not every package has the header of that name
#endif

using namespace fulmar::core;
using namespace workshop;

namespace {

struct Sample {  // as in good.c
  double airspeed_mps = 0, north = 0, east = 0, down = 0;
  std::uint8_t mode = 0, valid = 0;
};

// One step of component 0: its output for 10 m/s.
double scaled(const Library& library) {
  const fulmar_component& c = library.functions(0);
  fulmar_error error{};
  void* self = c.create(7, &error);
  REQUIRE(self != nullptr);
  const Sample in{10};
  Sample out;
  fulmar_input inputs[4]{};
  inputs[0].data = &in;
  fulmar_output outputs[4]{};
  outputs[0].data = &out;
  const fulmar_tick tick{0, 2500000, 0};
  CHECK(c.step(self, &tick, inputs, outputs, &error) == FULMAR_OK);
  c.destroy(self);
  return out.airspeed_mps;
}

struct Maps {
  std::size_t lines = 0, plugins = 0;  // plugins: mappings of files in the store
};

Maps maps() {
  Maps result;
  std::ifstream in("/proc/self/maps");
  const std::string store = (folder() / "store").string();
  for (std::string line; std::getline(in, line);) {
    ++result.lines;
    if (line.find(store) != std::string::npos) ++result.plugins;
  }
  return result;
}

// Bytes that are allocated on the heap.
std::size_t heap_bytes() {
#ifdef __SANITIZE_ADDRESS__
  return __sanitizer_get_current_allocated_bytes();
#else
  return ::mallinfo2().uordblks;
#endif
}

std::string unload_fault(std::shared_ptr<Library>&& library) {
  try {
    Library::unload(std::move(library));
    return "unloaded";
  } catch (const Error& e) {
    return e.what();
  }
}

// The build id from binutils. "" when the linker wrote none, or without readelf.
std::string build_id_by_readelf(const fs::path& file) {
  std::FILE* pipe = ::popen(("readelf -n " + file.string() + " | sed -n 's/.*Build ID: //p'").c_str(), "r");
  REQUIRE(pipe != nullptr);
  char id[128] = "";
  const int read = std::fscanf(pipe, "%127s", id);
  ::pclose(pipe);
  return read == 1 ? id : "";
}

}  // namespace

TEST_CASE("a good plugin is loaded with its whole description") {
  const auto library = Library::open(plugin("good"));
  const PluginInfo& info = library->info();
  CHECK(info.file == "good.so");
  CHECK(info.sha256 == sha256_file(plugin("good")));
  CHECK(info.version == "1.2.0");
  CHECK(info.toolchain == "a C compiler");
  CHECK(info.flags == "NDEBUG");
  CHECK(info.abi_major == 1);
  CHECK(info.build_id == build_id_by_readelf(plugin("good")));
  REQUIRE(info.components.size() == 1);
  const ComponentInfo& scaler = info.components[0];
  CHECK(scaler.name == "Scaler");
  CHECK_FALSE(scaler.vehicle);
  CHECK_FALSE(scaler.retunes);
  REQUIRE(scaler.inputs.size() == 4);
  CHECK(scaler.input("hint") == 1);
  CHECK(scaler.inputs[1].optional);
  CHECK(scaler.inputs[2].kind == FULMAR_IN_QUEUE);
  CHECK(scaler.inputs[2].capacity == 16);
  CHECK(scaler.output("error_mps") == 3);
  CHECK_FALSE(scaler.outputs[3].type);
  CHECK(scaler.output("nothing") == -1);
  CHECK(scaler.inputs[0].type->hash == scaler.outputs[0].type->hash);
}

TEST_CASE("parameters have default, range, unit and kind") {
  const auto library = Library::open(plugin("good"));
  const ComponentInfo& scaler = library->info().components[0];
  REQUIRE(scaler.params.size() == 8);
  const ParamInfo& gain = scaler.params[static_cast<std::size_t>(scaler.param("gain"))];
  CHECK(gain.initial[0] == 0.5);
  CHECK(gain.max == 2);
  CHECK(gain.unit == "rad/rad");
  CHECK(gain.live);
  CHECK(scaler.params[3].choices == std::vector<std::string>{"hold", "climb"});
  CHECK(scaler.params[4].initial_text == "x");
  CHECK(scaler.params[5].initial[1] == -4);
  CHECK(scaler.params[5].type->frame == "ned");
  double airspeed = 0;
  REQUIRE(scaler.params[6].initial_data.size() == sizeof(Sample));
  std::memcpy(&airspeed, scaler.params[6].initial_data.data(), sizeof airspeed);
  CHECK(airspeed == 17);
  CHECK(scaler.params[7].required);
}

TEST_CASE("a loaded component does its work") { CHECK(scaled(*Library::open(plugin("good"))) == 20); }

TEST_CASE("additional exported symbols do no harm") {
  CHECK(scaled(*Library::open(plugin("good_open"))) == 20);
}

TEST_CASE("the version script exports exactly the entry symbol") {
  const auto defined = [](const std::string& name) {
    std::FILE* nm = ::popen(("nm -D --defined-only " + plugin(name).string()).c_str(), "r");
    REQUIRE(nm != nullptr);
    std::string symbols;
    char address[64], kind[8], symbol[256];
    while (std::fscanf(nm, "%63s %7s %255s", address, kind, symbol) == 3)
      symbols += std::string(symbol) + " ";
    ::pclose(nm);
    return symbols;
  };
  CHECK(defined("good") == "fulmar_plugin_entry ");
  CHECK(defined("good_open").find("an_extra_symbol") != std::string::npos);
}

TEST_CASE("the same content is one library, in every folder") {
  const auto first = Library::open(plugin("good"));
  const auto second = Library::open(write("twin.so", read(plugin("good"))));
  CHECK(first == second);
  CHECK(unload_fault(std::shared_ptr<Library>(first)) == "loader.plugin_in_use(good.so)");
}

TEST_CASE("the private copy holds the same bytes and lies in the store") {
  const auto library = Library::open(plugin("good"));
  CHECK(library->copy() == folder() / "store" / (library->info().sha256 + ".so"));
  CHECK(read(library->copy()) == read(plugin("good")));
}

TEST_CASE(
    "a file that is rebuilt under the same path gives the new code, and the old one goes on meanwhile") {
  const fs::path file = write("law.so", read(plugin("good")));
  auto old = Library::open(file);
  CHECK(scaled(*old) == 20);
  write("law.so", read(plugin("good_changed")));
  auto changed = Library::open(file);
  CHECK(changed->info().version == "1.3.0");
  CHECK(scaled(*changed) == 30);
  CHECK(scaled(*old) == 20);
  CHECK(unload_fault(std::move(old)) == "unloaded");
  CHECK(scaled(*changed) == 30);
  CHECK(unload_fault(std::move(changed)) == "unloaded");
  CHECK(maps().plugins == 0);
}

TEST_CASE("loading and unloading many times leaves nothing behind") {
  const bool all = std::getenv("FULMAR_LONG") != nullptr;
#ifdef __SANITIZE_ADDRESS__
  const int cycles = all ? 10'000 : 100;  // a sanitized cycle takes a hundred times as long
#else
  const int cycles = all ? 10'000 : 2000;
#endif
  for (const char* name : {"good", "good_changed"}) Library::unload(Library::open(plugin(name)));
  const Maps before = maps();
  const std::size_t heap_before = heap_bytes();
  CHECK(before.plugins == 0);
  int verified = 0;
  for (int i = 0; i < cycles; ++i) {
    auto library = Library::open(plugin(i % 2 == 0 ? "good" : "good_changed"));
    REQUIRE(scaled(*library) == (i % 2 == 0 ? 20 : 30));  // never the old code
    if (unload_fault(std::move(library)) == "unloaded") ++verified;
  }
  CHECK(verified == cycles);
  const Maps after = maps();
  CHECK(after.plugins == 0);
  CHECK(after.lines <= before.lines + 8);  // the C library's heap may have grown
  CHECK(heap_bytes() < heap_before + static_cast<std::size_t>(cycles));  // less than a byte per cycle
}

TEST_CASE("a plugin that stays resident is reported") {
  CHECK(unload_fault(Library::open(plugin("resident"))) == "loader.plugin_still_resident(resident.so)");
  CHECK(unload_fault(Library::open(plugin("resident_thread"))) ==
        "loader.plugin_still_resident(resident_thread.so)");
  if (fs::exists(plugin("resident_unique")))
    CHECK(unload_fault(Library::open(plugin("resident_unique"))) ==
          "loader.plugin_still_resident(resident_unique.so)");
}

TEST_CASE("a component that declares itself resident may stay") {
  CHECK(unload_fault(Library::open(plugin("resident_allowed"))) == "unloaded");
}

TEST_CASE("loading leaves the floating-point mode as it was") {
  REQUIRE(std::fesetround(FE_DOWNWARD) == 0);
  auto library = Library::open(plugin("good"));
  const int mode = std::fegetround();
  std::fesetround(FE_TONEAREST);
  CHECK(mode == FE_DOWNWARD);
}

namespace {

// Copies of the good plugin, each with a different byte changed.
std::vector<std::string> flipped_copies(int count) {
  std::mt19937 random(20260101);
  std::vector<std::string> copies(static_cast<std::size_t>(count), read(plugin("good")));
  for (std::string& bytes : copies) {
    char& byte = bytes[random() % bytes.size()];
    byte = static_cast<char>(static_cast<unsigned>(byte) ^ static_cast<unsigned>(1 + random() % 255));
  }
  return copies;
}

}  // namespace

// An altered instruction in the code that runs at loading or unloading may pass the probe and crash the host,
// whose memory differs. This is rare; a mission can list the SHA-256 of its files against it.
TEST_CASE("copies with a flipped byte rarely crash the host") {
  const int flips = std::getenv("FULMAR_LONG") != nullptr ? 1000 : 200;
  const Environment limit("FULMAR_PROBE_SECONDS", "2");
  enum : int { accepted, refused, misnamed, brought_down };
  int seen[] = {0, 0, 0, 0};
  for (const std::string& bytes : flipped_copies(flips)) {
    const pid_t host = ::fork();
    REQUIRE(host >= 0);
    if (host == 0) {
      int printed = accepted;
      try {
        Library::open(write("flipped.so", bytes));
      } catch (const Error& e) {
        printed = std::string(e.what()).find("flipped.so") != std::string::npos ? refused : misnamed;
      }
      ::_exit(printed);
    }
    int status = 0;
    REQUIRE(::waitpid(host, &status, 0) == host);
    ++seen[WIFEXITED(status) && WEXITSTATUS(status) < brought_down ? WEXITSTATUS(status) : brought_down];
  }
  MESSAGE(seen[refused] << " of " << flips << " flipped copies were refused, " << seen[brought_down]
                        << " brought the host down");
  CHECK(seen[refused] > 0);
  CHECK(seen[misnamed] == 0);
  CHECK(seen[brought_down] * 200 <= flips);  // 46 of 1000 without a probe
}

TEST_CASE("the description of a plugin is aligned") {
  PluginInfo info = Library::open(plugin("good"))->info();
  info.sha256 = std::string(64, 'a');
  info.build_id = "0123abcd";
  std::string text = describe_plugin(info);
  char hash[20];
  std::snprintf(hash, sizeof hash, "%016llx",
                static_cast<unsigned long long>(info.components[0].inputs[0].type->hash));
  for (std::size_t at; (at = text.find(hash)) != std::string::npos;) text.replace(at, 16, "HASH");
  CHECK(text == R"(good.so  version 1.2.0
  abi        1.2
  toolchain  a C compiler
  flags      NDEBUG
  sha256     aaaaaaaaaaaaaaaa
  build      0123abcd

Scaler  Multiplies an airspeed.
  inputs
    state  Sample  value            40 bytes  HASH
    hint   Sample  value, optional  40 bytes  HASH
    edits  Sample  queue of 16      40 bytes  HASH
    edit   Sample  request of 4     40 bytes  HASH
  outputs
    scaled     Sample  value                      40 bytes  HASH
    news       Sample  inspect.event_output_kind  40 bytes  HASH
    events     Sample  queue of 8                 40 bytes  HASH
    error_mps          probe
  parameters
    gain     0.5 rad/rad     0 .. 2       live             multiplies
    on       true                         live             does anything
    repeats  3               0 .. 10      setup            how often
    law      climb           hold, climb  live             which one
    label    "x"                          setup            a word
    wind     [3, -4, 0] m/s  -30 .. 30    live             of the air
    start    Sample (file)                setup            where it begins
    table    bytes (file)                 setup, required  bytes
)");
}

TEST_CASE("the field tables show kind, unit, frame and place") {
  const std::string text = describe_plugin(Library::open(plugin("good"))->info(), true);
  for (const char* row :
       {"  position_m        Vec3  m     ned    8\n", "  position_m.north  f64   m            8\n",
        "  mode              enum               32    idle, glide\n"})
    CHECK_MESSAGE(text.find(row) != std::string::npos, row);
}

TEST_CASE("notes are read with their padding, and damaged ones give nothing") {
  // two notes, the first of another owner with 3 bytes of content: the second begins at the next multiple of
  // 4
  const unsigned char notes[] = {4, 0, 0, 0, 3, 0, 0, 0, 9, 0, 0, 0, 'X', 'Y', 'Z', 0,   1, 2,    3,
                                 0, 4, 0, 0, 0, 2, 0, 0, 0, 3, 0, 0, 0,   'G', 'N', 'U', 0, 0xab, 0x0c};
  const auto bytes = std::as_bytes(std::span(notes));
  CHECK(build_id_in_notes(bytes) == "ab0c");
  CHECK(build_id_in_notes(bytes.first(bytes.size() - 1)) == "");
  CHECK(build_id_in_notes(bytes.first(30)) == "");
  CHECK(build_id_in_notes({}) == "");
  unsigned char huge[sizeof notes];
  std::copy(std::begin(notes), std::end(notes), huge);
  huge[3] = 0xff;  // a name of 4 GB
  CHECK(build_id_in_notes(std::as_bytes(std::span(huge))) == "");
  CHECK(build_id(bytes) == "");
}

}  // namespace library_test

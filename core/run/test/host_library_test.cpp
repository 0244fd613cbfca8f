// SPDX-License-Identifier: BSD-3-Clause
// The libraries of the host are opened on request; this program links none of them, and neither does the
// host.
#include "core/run/host_library.hpp"

#include <fstream>
#include <sstream>

#include "core/build.hpp"
#include "core/run/test/lab.hpp"
#include "core/tap/tap.hpp"
#include "core/types/test/types.hpp"
#include "links/dds/library.hpp"
#include "links/dds/test/domain.hpp"
#include "links/dds/test/mock_control.hpp"
#include "links/live/library.hpp"

namespace host_library_test {
namespace {

const fs::path build = fs::path(FULMAR_BIN_DIR).parent_path();

/// A home folder of this test, whose library is a copy of `file`, or empty.
struct Home {
  fs::path folder = fs::temp_directory_path() / ("fulmar_home_" + std::to_string(getpid()));
  fs::path library;
  explicit Home(const std::string& section, const fs::path& file = {})
      : library(folder / "lib" / "fulmar" / "host" / ("fulmar_" + section + ".so")) {
    fs::create_directories(library.parent_path());
    if (file.empty())
      std::ofstream(library).put('x');
    else
      fs::copy_file(file, library);
  }
  ~Home() { fs::remove_all(folder); }
};

template <class Library>
std::string refusal(const std::vector<fs::path>& homes, const Where& where = {"m.yaml", 6}) {
  try {
    host_library<Library>(where, homes);
  } catch (const Error& fault) {
    return fault.what();
  }
  return "";
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

bool is_mapped(const std::string& library) {
  std::ostringstream maps;
  maps << std::ifstream("/proc/self/maps").rdbuf();
  return has(maps.str(), library);
}

std::vector<TapChannel> channels() { return {TapChannel{"/nav/state", test::mixed_type()}}; }

TEST_CASE("a flight opens the libraries that its mission uses, and no other") {
  FlightOptions options;
  options.speed = 1e6;  // paced: clients are admitted
  options.duration_s = 0.05;
  options.log = false;
  const std::string phase = lab::one_phase, live = "live: {listen: \"127.0.0.1:0\"}\n";
  CHECK(Flight(lab::mission(phase), options).run().outcome == Outcome::flown);
  CHECK_FALSE(is_mapped("fulmar_live.so"));
  options.speed = 0;
  CHECK_FALSE(Flight(lab::mission(live + phase), options).run().live.has_value());
  CHECK_FALSE(is_mapped("fulmar_live.so"));
  options.speed = 1e6;
  Flight watched(lab::mission(live + phase), options);
  CHECK(watched.live_port() != 0);
  CHECK(is_mapped("fulmar_live.so"));
  CHECK_FALSE(is_mapped("fulmar_dds.so"));
  CHECK(watched.run().live.has_value());
}

TEST_CASE_TEMPLATE(
    "without its library a section is refused at the mission's line, with each place searched and a package",
    Library, DdsLibrary, LiveLibrary) {
  const std::string section = Library::section, file = "/lib/fulmar/host/fulmar_" + section + ".so";
  const std::string text = refusal<Library>({"/nowhere/a", "/nowhere/b"});
  CHECK(text.starts_with("m.yaml:6: " + section + ": "));
  CHECK(has(text, "/nowhere/a" + file));
  CHECK(has(text, "/nowhere/b" + file));
  CHECK(has(text, "run.library_missing("));
  CHECK(text.ends_with(", fulmar_" + section + ")"));
  CHECK(refusal<Library>({}).starts_with("m.yaml:6: " + section + ": "));
  const Where option = {"--live 127.0.0.1:0", 0};  // from the command line: no file has a line for it
  CHECK(refusal<Library>({}, option).starts_with("--live 127.0.0.1:0: " + section + ": "));
}

TEST_CASE_TEMPLATE("a library that cannot be loaded is rejected by its path, with its requirements", Library,
                   DdsLibrary, LiveLibrary) {
  const Home home(Library::section);
  const std::string text = refusal<Library>({"/nowhere", home.folder, build});
  const std::string fault = "loader.plugin_not_loadable(" + home.library.string() + ", file too short)";
  const std::string needs = Library::needs;
  CHECK(text == "m.yaml:6: " + std::string(Library::section) + ": " +
                    (needs.empty() ? fault : "run.library_needs(" + fault + ", " + needs + ")"));
  CHECK(has(text, home.library.string()));
  CHECK(has(text, Library::needs));
}

TEST_CASE_TEMPLATE("a library of another build, or another library, is rejected", Library, DdsLibrary,
                   LiveLibrary) {
  const std::string section = Library::section;
  {
    const Home home(section, FULMAR_TEST_PLUGIN_DIR "/foreign_library.so");
    const std::string text = refusal<Library>({home.folder});
    CHECK(text.starts_with("m.yaml:6: " + section + ": run.library_build_differs(" + home.library.string()));
    CHECK(has(text, "0.0.0 foreign"));
    CHECK(has(text, build_identity));
  }
  const Home home(section, FULMAR_TEST_PLUGIN_DIR "/good.so");
  CHECK(refusal<Library>({home.folder}) ==
        "m.yaml:6: " + section + ": run.library_invalid(" + home.library.string() + ")");
}

TEST_CASE("Fast DDS is in the process once a flight uses it, and its faults arrive as the host's own") {
  CHECK_FALSE(is_mapped("libfastrtps"));
  const auto& library = host_library<DdsLibrary>({}, {"/nowhere", build});
  CHECK(is_mapped("libfastrtps"));
  CHECK(&library == &host_library<DdsLibrary>({}, {build}));
  CHECK(std::string(library.build) == build_identity);

  Tap tap(channels());
  test::MockControl control;
  static std::string printed;
  const DdsHost host{tap, control, [](const std::string& text, Tone) { printed += text; }};
  DdsOptions options;
  options.on = true;
  options.domain = 233;
  CHECK_THROWS_WITH_AS(library.open(host, options), "dds.domain_out_of_range(233, 232)", Error);
  options.domain = test::own_domain();
  const auto bridge = library.open(host, options);
  CHECK(bridge->stats().sent == 0);
  CHECK(bridge->stats().imports.empty());
  CHECK(printed.empty());
}

TEST_CASE("the faults of the live view arrive as the host's own") {
  const auto& library = host_library<LiveLibrary>({}, {build});
  CHECK(std::string(library.build) == build_identity);
  Tap tap(channels());
  test::MockControl control;
  LiveOptions options;
  options.on = true;
  options.port = 0;
  const auto view = library.open(tap, control, options, {});
  CHECK(view->stats().clients == 0);
  options.port = view->port();
  CHECK_THROWS_AS(library.open(tap, control, options, {}), Error);
}

}  // namespace
}  // namespace host_library_test

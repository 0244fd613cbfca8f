// SPDX-License-Identifier: BSD-3-Clause
// The library for DDS is opened when it is asked for; this program links none of Fast DDS, as the host does
// not.
#include "core/run/dds_library.hpp"

#include <doctest/doctest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/build.hpp"
#include "core/dds/test/domain.hpp"
#include "core/dds/test/mock_control.hpp"
#include "core/tap/tap.hpp"
#include "core/types/test/types.hpp"

using namespace fulmar::core;

namespace dds_library_test {
namespace {

namespace fs = std::filesystem;

const Where section{"m.yaml", 6};
const fs::path build = fs::path(FULMAR_BIN_DIR).parent_path();

/// A home folder of this test's own, whose library is a copy of `file`, or empty.
struct Home {
  fs::path folder = fs::temp_directory_path() / ("fulmar_dds_home_" + std::to_string(getpid()));
  fs::path library = folder / "lib" / "fulmar" / "host" / "fulmar_dds.so";
  explicit Home(const fs::path& file = {}) {
    fs::create_directories(library.parent_path());
    if (file.empty())
      std::ofstream(library).put('x');
    else
      fs::copy_file(file, library);
  }
  ~Home() { fs::remove_all(folder); }
};

std::string refusal(const std::vector<fs::path>& homes) {
  try {
    dds_library(homes, section);
  } catch (const Error& fault) {
    return fault.what();
  }
  return "";
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

bool fast_dds_is_mapped() {
  std::ostringstream maps;
  maps << std::ifstream("/proc/self/maps").rdbuf();
  return has(maps.str(), "libfastrtps");
}

TEST_CASE(
    "without its library DDS is refused at the mission's line, with each place searched and a package") {
  const std::string text = refusal({"/nowhere/a", "/nowhere/b"});
  CHECK(text.starts_with("m.yaml:6: dds: "));
  CHECK(has(text, "/nowhere/a/lib/fulmar/host/fulmar_dds.so"));
  CHECK(has(text, "/nowhere/b/lib/fulmar/host/fulmar_dds.so"));
  CHECK(has(text, "package fulmar"));
  CHECK(refusal({}).starts_with("m.yaml:6: dds: "));
}

TEST_CASE("a library that cannot be loaded is refused by its path, with what to install") {
  const Home home;
  const std::string text = refusal({"/nowhere", home.folder, build});
  CHECK(text.starts_with("m.yaml:6: dds: " + home.library.string()));
  CHECK(has(text, "libfastrtps-dev"));
}

TEST_CASE("a library of another build, or another library, is refused") {
  {
    const Home home(FULMAR_TEST_PLUGIN_DIR "/dds_foreign.so");
    const std::string text = refusal({home.folder});
    CHECK(text.starts_with("m.yaml:6: dds: " + home.library.string()));
    CHECK(has(text, "0.0.0 foreign"));
    CHECK(has(text, build_identity));
  }
  const Home home(FULMAR_TEST_PLUGIN_DIR "/good.so");
  CHECK(refusal({home.folder}).starts_with("m.yaml:6: dds: " + home.library.string()));
}

TEST_CASE("Fast DDS is in the process once a flight asks for it, and its faults arrive as the host's own") {
  CHECK_FALSE(fast_dds_is_mapped());
  const DdsLibrary& library = dds_library({"/nowhere", build}, section);
  CHECK(fast_dds_is_mapped());
  CHECK(&library == &dds_library({build}, section));
  CHECK(std::string(library.build) == build_identity);

  Tap tap(std::vector<TapChannel>{TapChannel{"/nav/state", test::mixed_type()}});
  test::MockControl control;
  static std::string said;
  const DdsHost host{tap, control, [](const std::string& text, Tone) { said += text; }};
  DdsOptions options;
  options.on = true;
  options.domain = 233;
  CHECK_THROWS_WITH_AS(library.open(host, options), "dds: domain 233 is outside 0 .. 232", Error);
  options.domain = test::own_domain();
  const auto bridge = library.open(host, options);
  CHECK(bridge->stats().sent == 0);
  CHECK(bridge->stats().imports.empty());
  CHECK(said.empty());
}

}  // namespace
}  // namespace dds_library_test

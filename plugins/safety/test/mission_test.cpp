// SPDX-License-Identifier: BSD-3-Clause
// The shipped mission, and rejected variants with file and line.
#include <doctest/doctest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "sdk/test/said.hpp"

namespace mission_test {

namespace fs = std::filesystem;
using namespace fulmar::test;

namespace {

struct Folder {
  fs::path path = fs::temp_directory_path() / ("fulmar_safety_" + std::to_string(getpid()));
  Folder() {
    fs::remove_all(path);
    fs::create_directories(path);
  }
  ~Folder() { fs::remove_all(path); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  Said check(const std::string& params) const {
    const fs::path file = path / "wrong.yaml";
    std::ofstream(file) << "extends: " FULMAR_SOURCE_DIR "/configs/missions/return_home.yaml\nlive: off\n"
                        << "components:\n"
                        << params << "\n";
    return typed("check " + file.string());
  }
};

}  // namespace

TEST_CASE("the mission is in order in simulation and on a flight controller") {
  for (const char* io : {"sim", "fcu"}) {
    const Said r =
        typed(std::string("check " FULMAR_SOURCE_DIR "/configs/missions/return_home.yaml --io ") + io);
    CHECK_MESSAGE(r.code == 0, r.out);
  }
}

TEST_CASE("a fence or places that cannot be are refused with file and line") {
  const Folder folder;
  const auto refused = [&](const std::string& params, const std::string& why) {
    const Said r = folder.check(params);
    CHECK(r.code == 4);
    CHECK_MESSAGE(r.out.find("wrong.yaml:4") != std::string::npos, r.out);
    CHECK_MESSAGE(r.out.find(why) != std::string::npos, r.out);
  };
  const auto fence = [](const std::string& corners) {
    return "  watch: {params: {fence: {corners: [" + corners + "]}}}";
  };
  refused(fence("{north: 500 m, east: 0 m}, {north: -500 m, east: 0 m}"),
          "fence.corners: flight.fence_corners_few(2)");
  refused(fence("{north: 500 m, east: -500 m}, {north: -500 m, east: 500 m}, {north: 500 m, east: 500 m}, "
                "{north: -500 m, east: -500 m}"),
          "fence.corners: flight.fence_sides_cross(");
  refused(fence("{north: 500 m, east: 100 m}, {north: 500 m, east: 500 m}, {north: -500 m, east: 300 m}"),
          "safety.home_outside_fence(0, 0)");
  refused(fence("{north: 500 m}, {north: 500 m, east: 500 m}, {north: -500 m, east: 300 m}"),
          "fence.corners[0]: flight.place_missing");
  refused("  back: {params: {places: {places: []}}}", "places.places: safety.places_missing");
  const std::string twice =
      "{places: [{north: 0 m, east: 0 m}, {north: 9 m, east: 0 m}, {north: 9.5 m, east: 0.5 m}]}";
  for (const char* who : {"back", "watch"})
    refused("  " + std::string(who) + ": {params: {places: " + twice + "}}",
            "places.places[2]: flight.places_equal(1)");
}

}  // namespace mission_test

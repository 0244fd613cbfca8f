// SPDX-License-Identifier: BSD-3-Clause
// Small recordings of the tests, and the output of the vehicle for them.
#pragma once
#include <doctest/doctest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <fulmar/testing.hpp>
#include <string>
#include <vector>

#include "../recorded.hpp"

namespace recording {

using namespace fulmar;
using namespace fulmar::sensor_log;

struct Folder {
  std::filesystem::path path;
  Folder() {
    static int number = 0;
    path = std::filesystem::temp_directory_path() /
           ("fulmar-sensor-log-" + std::to_string(getpid()) + "-" + std::to_string(number++));
    std::filesystem::create_directories(path);
  }
  ~Folder() { std::filesystem::remove_all(path); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(path / name, std::ios::binary) << text;
    return (path / name).string();
  }
};

/// Everything that was published, each with its tick and the time for which it holds.
template <class M>
struct Sample {
  std::int64_t now_ns = 0, valid_at_ns = 0;
  M value;
};

struct Flown {
  std::vector<std::int64_t> ticks_ns;
  std::vector<Sample<Imu>> imu;
  std::vector<Sample<Gnss>> gnss;
  std::vector<Sample<Mag>> mag;
  std::vector<Sample<Baro>> baro;
  std::vector<Sample<Pitot>> pitot;
  std::vector<VehicleStatus> status;
  std::vector<std::string> notices;
  Recording last;
  std::string fault;  ///< reason for a failed start, or a value that is not finite
};

inline Flown fly(const Description& description, const Folder& folder) {
  Flown f;
  Bench<Recorded> bench;
  bench.params.log.value = description;
  bench.params.folder.value = Text<256>(folder.path.string());
  if (bench.configure() == Status::failed) {
    f.fault = bench.error();
    return f;
  }
  const auto note = [&](const auto& out, auto& samples) {
    if (out.written) samples.push_back({bench.tick.now_ns, out.valid_at_ns, out.value});
  };
  while (!f.last.ended && f.fault.empty()) {
    REQUIRE(bench.read() == Status::ok);
    f.ticks_ns.push_back(bench.tick.now_ns);
    note(bench.out.imu, f.imu);
    note(bench.out.gnss, f.gnss);
    note(bench.out.mag, f.mag);
    note(bench.out.baro, f.baro);
    note(bench.out.pitot, f.pitot);
    f.status.push_back(bench.out.status);
    f.last = bench.out.recording;
    f.fault = bench.validation_error();
    for (std::uint32_t i = 0; i < bench.out.notices.count; ++i)
      f.notices.emplace_back(bench.out.notices.items[i].text.view());
  }
  return f;
}

/// `bytes` is the file that all sensors of `d` come from.
inline Flown flown(const Description& d, const std::string& file, const std::string& bytes) {
  const Folder folder;
  folder.write(file, bytes);
  Flown f = fly(d, folder);
  const std::string path = folder.path.string() + "/";
  if (const std::size_t at = f.fault.find(path); at != std::string::npos) f.fault.erase(at, path.size());
  return f;
}

inline void imu_columns(Description& d) {
  d.imu.from.file = "imu.csv";
  d.imu.from.time = "t";
  d.imu.rate.columns = {"p", "q", "r"};
  d.imu.specific_force.columns = {"x", "y", "z"};
}

inline Description imu_alone() {
  Description d;
  imu_columns(d);
  return d;
}

/// Rows of an aircraft that stands level: 100 Hz.
inline std::string level(int rows) {
  std::string text = "t,p,q,r,x,y,z\n";
  for (int i = 0; i < rows; ++i) text += std::to_string(i) + "e-2,0,0,0,0,0,-9.8\n";
  return text;
}

}  // namespace recording

// SPDX-License-Identifier: BSD-3-Clause
// The check cases of bench_six_dof, its comparison, and its messages for missing or damaged files.
#include <doctest/doctest.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <sstream>

#include "bench/six_dof/family.hpp"

namespace six_dof_test {

using namespace fulmar::six_dof;
using doctest::Approx;
namespace fs = std::filesystem;

namespace {

const char* const header =
    "time,feVelocity_ft_s_X,feVelocity_ft_s_Y,feVelocity_ft_s_Z,altitudeMsl_ft,longitude_deg,latitude_deg,"
    "eulerAngle_deg_Yaw,eulerAngle_deg_Pitch,eulerAngle_deg_Roll,bodyAngularRateWrtEi_deg_s_Roll,"
    "bodyAngularRateWrtEi_deg_s_Pitch,bodyAngularRateWrtEi_deg_s_Yaw,trueAirspeed_nmi_h";

struct Folder {
  fs::path path = fs::temp_directory_path() / ("six_dof_test_" + std::to_string(getpid()));
  Folder() { fs::create_directories(path); }
  ~Folder() { fs::remove_all(path); }
};

std::string file_of(const std::string& first_line, double last_s = 30) {
  std::ostringstream s;
  s << first_line << "\n";
  for (int i = 0; i * sample_s < last_s + 1e-6; ++i)
    s << i * sample_s << ",1,2,3,30000,0,0,10,20,30,4,5,6,100\n";
  return s.str();
}

/// The message for a file with this content.
std::string fault(const std::string& content) {
  const Folder folder;
  const fs::path file = folder.path / "damaged.csv";
  std::ofstream(file) << content;
  try {
    RecordingFile(file).read();
  } catch (const Fault& e) {
    const std::string text = e.what(), name = file.string();
    REQUIRE(text.find(name) == 0);
    return text.substr(name.size());
  }
  return "";
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

/// Constant values, the same in every column.
Recording constant(int simulator, double value) {
  Recording r;
  r.simulator = simulator;
  for (auto& column : r.of) column.assign(samples, value);
  return r;
}

const Figure& figure(const std::vector<Figure>& all, const std::string& name) {
  for (const Figure& f : all)
    if (f.signal == name) return f;
  FAIL("no figure " << name);
  return all.front();
}

struct Output {
  int code = 0;
  std::string text;
};
Output run(const std::string& arguments) {
  FILE* pipe = popen((std::string(FULMAR_BIN_DIR) + "/bench_six_dof " + arguments + " 2>&1").c_str(), "r");
  REQUIRE(pipe);
  Output out;
  char buffer[4096];
  while (const std::size_t n = std::fread(buffer, 1, sizeof buffer, pipe)) out.text.append(buffer, n);
  out.code = WEXITSTATUS(pclose(pipe));
  return out;
}

}  // namespace

TEST_CASE("NASA's check cases are flown within three times the spread of NASA's simulators") {
  const std::string folder = FULMAR_REFERENCE_DATA "/six_dof";
  if (!fs::is_directory(folder)) {
    MESSAGE("skipped: no " << folder);
    return;
  }
  for (const Case& c : cases()) {
    const auto theirs = recordings(folder, c.number);
    const Recording ours = flown(c, start_of(theirs, c));
    const auto figures = compared(ours, theirs, c);
    CHECK(figures.size() == signals.size());
    for (const Figure& f : figures) {
      INFO("case " << c.number << ", " << f.signal << ": " << f.departure << ", bar " << f.bar);
      CHECK(f.within());
    }
    // the same at a quarter of the rate: the comparison is one of physics, not of the step
    const Recording coarse = flown(c, start_of(theirs, c), 0.01);
    for (std::size_t column = 0; column < columns; ++column)
      CHECK(std::abs(coarse.of[column].back() - ours.of[column].back()) < 1e-5);
  }
}

TEST_CASE("a recording that is a little beyond the bar is found out, whatever the signal") {
  const Case c = cases().front();
  const std::vector<Recording> theirs{constant(1, 0), constant(2, 0), constant(3, 0)};
  const Column of_signal[] = {altitude, roll, pitch, yaw, roll, p, q, r, airspeed};
  for (std::size_t i = 0; i < signals.size(); ++i)
    for (const double sign : {-1.0, 1.0}) {
      Recording ours = constant(0, 0);
      ours.of[of_signal[i]][150] = sign * 0.99 * signals[i].floor;
      CHECK(figure(compared(ours, theirs, c), signals[i].name).within());
      ours.of[of_signal[i]][150] = sign * 1.01 * signals[i].floor;
      CHECK_FALSE(figure(compared(ours, theirs, c), signals[i].name).within());
    }
}

TEST_CASE(
    "the bar is three times the largest departure from the median, without the simulator that is left out") {
  Case c = cases().front();
  std::vector<Recording> theirs{constant(1, 0), constant(2, 0), constant(3, 0), constant(4, 0),
                                constant(5, 0)};
  theirs[1].of[altitude][7] = 3;
  theirs[3].of[altitude][7] = -2;
  theirs[4].of[airspeed][9] = 50;
  Recording ours = constant(0, 0);
  ours.of[altitude][7] = 8.9;
  CHECK(figure(compared(ours, theirs, c), "altitude_m").bar == Approx(9));
  CHECK(figure(compared(ours, theirs, c), "altitude_m").departure == Approx(8.9));
  CHECK(figure(compared(ours, theirs, c), "airspeed_mps").bar == Approx(150));
  c.faulty_airspeed = 5;
  CHECK(figure(compared(ours, theirs, c), "airspeed_mps").bar == Approx(0.01));
  c.faulty = 2;
  CHECK(figure(compared(ours, theirs, c), "altitude_m").bar == Approx(6));
  theirs[2].of[airspeed].clear();  // one without a value: three are left
  CHECK(figure(compared(ours, theirs, c), "airspeed_mps").departure == 0);
}

TEST_CASE(
    "angles are compared the short way round, and attitudes by their rotation where roll and yaw are none") {
  const Case c = cases().front();
  std::vector<Recording> theirs{constant(1, 0), constant(2, 0), constant(3, 0)};
  theirs[0].of[yaw].assign(samples, 179.99);
  theirs[1].of[yaw].assign(samples, -179.99);
  theirs[2].of[yaw].assign(samples, 180);
  Recording ours = constant(0, 0);
  ours.of[yaw].assign(samples, -179.98);
  const Figure f = figure(compared(ours, theirs, c), "yaw_deg");
  CHECK(f.bar == Approx(0.03));
  CHECK(f.departure == Approx(0.02));
  // straight up: only the difference of roll and yaw is an attitude
  for (Recording* r : {&theirs[0], &theirs[1], &theirs[2], &ours}) r->of[pitch].assign(samples, 90);
  theirs[0].of[yaw].assign(samples, 40);
  theirs[0].of[roll].assign(samples, 40);
  theirs[1].of[yaw].assign(samples, 0);
  theirs[2].of[yaw].assign(samples, 0);
  ours.of[yaw].assign(samples, -100);
  ours.of[roll].assign(samples, -100);
  CHECK(figure(compared(ours, theirs, c), "rotation_deg").departure < 1e-6);
  ours.of[roll].assign(samples, -99);
  CHECK(figure(compared(ours, theirs, c), "rotation_deg").departure == Approx(1));
}

TEST_CASE("a recording is read in metres and degrees, whatever the order of its columns") {
  const Folder folder;
  std::ofstream(folder.path / "a.csv") << file_of(header);
  const Recording r = RecordingFile(folder.path / "a.csv").read();
  CHECK(r.of[altitude].size() == samples);
  CHECK(r.of[altitude].front() == Approx(9144));
  CHECK(r.of[v_down].back() == Approx(3 * 0.3048));
  CHECK(r.of[yaw].back() == 10);
  CHECK(r.of[fulmar::six_dof::r].back() == 6);
  CHECK(r.of[airspeed].back() == Approx(51.4444).epsilon(1e-5));
  CHECK(r.has_attitude());
}

TEST_CASE("damaged files are refused with file and line") {
  const std::string good = file_of(header);
  CHECK(fault(good) == "");
  CHECK(fault("") == ":1: six_dof.file_empty");
  CHECK(fault(replaced(good, "altitudeMsl_ft", "altitude")) == ":1: six_dof.column_missing(altitudeMsl_ft)");
  CHECK(fault(replaced(good, "time,", "t,")) == ":1: six_dof.first_column_not_time");
  CHECK(fault(replaced(good, "\n0.2,1,2,", "\n0.2,1,x,")) == ":4: six_dof.number_expected(x)");
  CHECK(fault(replaced(good, "\n0.2,1,2,", "\n0.2,1,,")) == ":4: six_dof.number_expected()");
  CHECK(fault(replaced(good, "\n0.2,1,2,", "\n0.2,1,nan,")) == ":4: six_dof.number_expected(nan)");
  CHECK(fault(replaced(good, "\n0.2,1,2,", "\n0.2,1,")) == ":4: six_dof.cell_count_mismatch(13, 14)");
  CHECK(fault(replaced(good, "\n0.2,", "\n0.1,")).find(":5: six_dof.row_missing(0.2") == 0);
  CHECK(fault(replaced(good, "\n0.2,", "\n0.05,")) == ":4: six_dof.time_backwards");
  CHECK(fault(file_of(header, 12)).find(":123: six_dof.recording_short(12") == 0);
  CHECK(fault(good.substr(0, good.size() - 9)) == ":302: six_dof.cell_count_mismatch(11, 14)");
}

TEST_CASE("without the files the program says so in one sentence, and 2") {
  const Output none = run("no/such/folder");
  CHECK(none.code == 2);
  CHECK(none.text == "six_dof.check_cases_missing(no/such/folder)\n");
  const Folder empty;
  CHECK(run(empty.path.string()).text == "six_dof.recordings_missing(" + empty.path.string() + ", 01)\n");
  CHECK(run(empty.path.string()).code == 2);
  for (const char* wrong : {"", "--jsn", "a b"}) {
    CHECK(run(wrong).code == 2);
    CHECK(run(wrong).text == "six_dof.usage\n");
  }
}

TEST_CASE(
    "the program exits with 1 when a departure is beyond its bar, with 0 when none is, and tells it as "
    "JSON") {
  const std::string folder = FULMAR_REFERENCE_DATA "/six_dof";
  if (!fs::is_directory(folder)) {
    MESSAGE("skipped: no " << folder);
    return;
  }
  const Output good = run("--json " + folder);
  CHECK(good.code == 0);
  CHECK(good.text.find("\"cases\": {\n    \"01\": {\n      \"airspeed_mps\": {\n        \"bar\": ") !=
        std::string::npos);
  CHECK(good.text.find("\"within\": true\n}\n") != std::string::npos);
  const Folder copy;  // whose first case is of three simulators in which nothing falls
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().filename().string().starts_with("Atmos_"))
      fs::copy(entry.path(), copy.path / entry.path().filename(), fs::copy_options::recursive);
  const fs::path first = copy.path / "Atmos_01_DroppedSphere";
  fs::remove_all(first);
  fs::create_directory(first);
  for (const char* name : {"sim_1.csv", "sim_2.csv", "sim_3.csv"})
    std::ofstream(first / name) << file_of(header);
  const Output bad = run(copy.path.string());
  CHECK(bad.code == 1);
  CHECK(bad.text.find("BEYOND") != std::string::npos);
}

}  // namespace six_dof_test

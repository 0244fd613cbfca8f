// SPDX-License-Identifier: BSD-3-Clause
// fulmar log as a user calls it: messages, exit codes, JSON.
#include "tools/fulmar_log/log_command.hpp"

#include <doctest/doctest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/log/test/log_kit.hpp"

using namespace fulmar::core;
using namespace fulmar::core::test;
using nlohmann::json;

namespace {

struct Answer {
  int code = 0;
  std::string out;  // what was printed as JSON
};

Answer call(const std::string& words) {
  CLI::App app;
  const LogCommand log(app);
  std::ostringstream out;
  std::streambuf* const before = std::cout.rdbuf(out.rdbuf());
  Answer answer;
  try {
    app.parse(words);
    REQUIRE(log.parsed());
    answer.code = log.run();
  } catch (const CLI::ParseError&) {
    answer.code = 2;
  } catch (const Error& e) {
    answer = {1, e.what()};
  }
  std::cout.rdbuf(before);
  if (answer.code != 1 || answer.out.empty()) answer.out = out.str();
  return answer;
}

}  // namespace

TEST_CASE("info as JSON: what the log holds, by topic") {
  const Folder folder;
  const std::string log = (folder.path / "a.mcap").string();
  write_sample({.file = log}, 4001);
  const Answer answer = call("log info --json " + log);
  CHECK(answer.code == 0);
  const json o = json::parse(answer.out);
  CHECK(o["complete"] == true);
  CHECK(o["messages"] == 5002);
  CHECK(o["begin_s"] == -1.0);
  CHECK(o["duration_s"] == 10.0);
  CHECK(o["metadata"]["fulmar"]["mission"] == "test");
  CHECK(o["attachments"][0]["name"] == "mission.yaml");
  CHECK(o["topics"][0]["topic"] == "/mixed");
  CHECK(o["topics"][0]["rate_hz"] == doctest::Approx(400));
  CHECK(o["topics"][0]["type"] == "fulmar_msgs/msg/Mixed");
  CHECK(call("log info " + log).code == 0);
}

TEST_CASE("diff ends with 0 for equal logs and 1 for others; metadata count unless --messages") {
  const Folder folder;
  const std::string a = (folder.path / "a.mcap").string(), b = (folder.path / "b.mcap").string(),
                    c = (folder.path / "c.mcap").string(), d = (folder.path / "d.mcap").string();
  write_sample({.file = a}, 100);
  write_sample({.file = b}, 100);
  write_sample({.file = c}, 100, [](int i, Mixed& m) { m.count += i == 50; });
  {
    Sample sample({.file = d});
    sample.writer.metadata("run", {{"seed", "8"}});
    sample.writer.close();
  }
  CHECK(call("log diff " + a + " " + b).code == 0);
  const Answer other = call("log diff --json " + a + " " + c);
  CHECK(other.code == 1);
  const json o = json::parse(other.out);
  CHECK(o["first_difference"]["topic"] == "/mixed");
  CHECK(o["first_difference"]["field"] == "count");
  CHECK(o["first_difference"]["first"] == "7");
  CHECK(o["first_difference"]["second"] == "8");
  CHECK(o["first_difference"]["time_s"] == -0.875);
  CHECK(o["topics"]["/mixed"]["different"] == 1);

  Sample sample({.file = folder.path / "e.mcap"});
  sample.writer.close();
  const std::string e = (folder.path / "e.mcap").string();
  CHECK(call("log diff " + d + " " + e).code == 1);
  CHECK(call("log diff --messages " + d + " " + e).code == 0);
}

TEST_CASE("a log that was cut off is recovered under its own name, which is never overwritten") {
  const Folder folder;
  const std::filesystem::path log = folder.path / "a.mcap", part = folder.path / "a.mcap.part";
  write_sample({.file = log}, 4000);
  const std::string whole = contents(log);
  store(part, whole.substr(0, whole.size() * 3 / 4));
  CHECK(call("log recover " + part.string()).code == 1);
  CHECK(contents(log) == whole);
  std::filesystem::remove(log);
  CHECK(call("log recover " + part.string()).code == 0);
  const json o = json::parse(call("log info --json " + log.string()).out);
  CHECK(o["complete"] == true);
  CHECK(o["messages"] > 3000);
  CHECK(o["messages"] < 5000);
  CHECK(std::filesystem::exists(part));
}

TEST_CASE("what is no log is refused, and why; info tells the epoch as a date and no empty heading") {
  const Folder folder;
  const std::string log = (folder.path / "a.mcap").string(), nothing = (folder.path / "empty.mcap").string();
  store(nothing, "");
  CHECK(call("log info " + folder.path.string()).out ==
        "reading.file_not_readable(" + folder.path.string() + ", reading.file_is_directory)");
  CHECK(call("log export --to csv " + nothing).out ==
        "reading.file_not_readable(" + nothing + ", reading.file_empty)");
  CHECK(call("log recover /dev/null").out ==
        "reading.file_not_readable(/dev/null, reading.file_not_regular)");
  CHECK(call("log info " + log).out == "reading.file_not_readable(" + log + ", reading.file_missing)");
  {
    Sample sample({.file = log});
    sample.writer.metadata("fulmar", {{"epoch_ns", "1767225600250000000"}});
    sample.writer.metadata("overrides", {});
    sample.writer.close();
  }
  CHECK(call("log diff " + log + " " + nothing).out ==
        "reading.file_not_readable(" + nothing + ", reading.file_empty)");
  const std::string text = (folder.path / "text").string();
  std::fflush(stdout);
  const int own = dup(STDOUT_FILENO);
  REQUIRE(std::freopen(text.c_str(), "w", stdout) != nullptr);
  const int code = call("log info " + log).code;
  std::fflush(stdout);
  dup2(own, STDOUT_FILENO);
  close(own);
  CHECK(code == 0);
  CHECK(contents(text).find("  epoch                2026-01-01T00:00:00.25Z\n") != std::string::npos);
  CHECK(contents(text).find("overrides") == std::string::npos);
}

TEST_CASE("an export that fails leaves nothing half behind") {
  const Folder folder;
  const std::string log = (folder.path / "a.mcap").string();
  write_sample({.file = log}, 4001);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  rlimit small = before;
  small.rlim_cur = 20'000;
  const auto was = std::signal(SIGXFSZ, SIG_IGN);
  for (const char* form : {"csv", "npz", "mat"}) {
    const std::filesystem::path out = folder.path / form;
    setrlimit(RLIMIT_FSIZE, &small);
    const Answer answer = call("log export " + log + " --to " + form + " --out " + out.string());
    setrlimit(RLIMIT_FSIZE, &before);
    CHECK(answer.code == 1);
    CHECK(answer.out.find("log_tool.disk_write_failed(") != std::string::npos);
    CHECK_FALSE(std::filesystem::exists(out.string() + ".part"));
    CHECK_FALSE(std::filesystem::exists(out / "mixed.csv.part"));
    CHECK_FALSE(std::filesystem::exists(out / "mixed.csv"));
  }
  std::signal(SIGXFSZ, was);
}

TEST_CASE("export writes what is asked for, and refuses what it cannot") {
  const Folder folder;
  const std::string log = (folder.path / "a.mcap").string(), out = (folder.path / "out").string();
  write_sample({.file = log}, 100);
  const std::string one_topic = " --to csv --topic /number --out ";
  CHECK(call("log export " + log + one_topic + out).code == 0);
  CHECK(std::filesystem::exists(out + "/number.csv"));
  CHECK_FALSE(std::filesystem::exists(out + "/mixed.csv"));
  CHECK(call("log export " + log + " --to xls").code == 2);
  CHECK(call("log export " + log).code == 2);
  CHECK(call("log").code == 2);
  const Answer no_topic = call("log export " + log + " --to csv --topic /numbr --out " + out);
  CHECK(no_topic.code == 1);
  CHECK(no_topic.out.find("log.topic_unknown(/numbr,  [/number] /mixed, /number)") != std::string::npos);
  CHECK(call("log info " + (folder.path / "none.mcap").string()).code == 1);
}

TEST_CASE("two results are compared by their figures, one that only one of them has among these") {
  const Folder folder;
  const std::string a = (folder.path / "a.json").string(), b = (folder.path / "b.json").string();
  std::ofstream(a)
      << R"({"seed": 1, "flight_time_s": 10, "rmse": {"north_m": 2.0, "course_rad": 0.1, "mode": null}})";
  std::ofstream(b) << R"({"seed": 2, "flight_time_s": 10, "rmse": {"north_m": 3.0, "east_m": 4.0}})";
  const Answer answer = call("log diff --json " + a + " " + b);
  CHECK(answer.code == 1);
  const json figures = json::parse(answer.out).at("figures");
  CHECK(figures.size() == 3);
  CHECK(figures.at("rmse.north_m") == json{{"first", 2.0}, {"second", 3.0}});
  CHECK(figures.at("rmse.course_rad") == json{{"first", 0.1}, {"second", nullptr}});
  CHECK(figures.at("rmse.east_m") == json{{"first", nullptr}, {"second", 4.0}});
}

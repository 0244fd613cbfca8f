// SPDX-License-Identifier: BSD-3-Clause
// Texts that would become large trees: each is rejected with a sentence, and quickly.
#include "core/graph/yaml.hpp"

#include <doctest/doctest.h>

#include <ctime>

#include "core/graph/test/shelf.hpp"
#include "core/sanitized.hpp"

namespace yaml_test {

using namespace fulmar::core;
using namespace fulmar::core::test;

namespace {

std::string repeated(const std::string& text, int times) {
  std::string all;
  all.reserve(text.size() * static_cast<std::size_t>(times));
  for (int i = 0; i < times; ++i) all += text;
  return all;
}

struct Read {
  std::string printed;
  double seconds = 0;  // CPU time
};

Read read(const std::string& text) {
  Report report;
  const std::clock_t begin = std::clock();
  parse_yaml(std::make_shared<SourceFile>(SourceFile{"folder/file.yaml", "file.yaml", text}), report);
  return {report.text(), static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC};
}

Read resolve(const std::string& text) {
  Mission mission;
  mission.text = text;
  const std::clock_t begin = std::clock();
  std::string printed = mission.faults();
  return {std::move(printed), static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC};
}

}  // namespace

TEST_CASE("aliases count with the size of their content, in bytes as well") {
  const std::string long_text(100'000, 'x');
  const Read bytes = read("a: &a \"" + long_text + "\"\nb: [" + repeated("*a, ", 400'000) + "]\n");
  CHECK(bytes.printed == "file.yaml:2: graph.yaml_text_too_large(32)");
  CHECK(bytes.seconds < 1 * sanitizer_slowdown);
  const Read keys =
      read("a: &a {" + long_text.substr(0, 1000) + ": 1}\nb: [" + repeated("*a, ", 100'000) + "]\n");
  CHECK(keys.printed == "file.yaml:2: graph.yaml_text_too_large(32)");
  std::string tenfold = "a0: &a0 1\n";
  for (int i = 1; i < 9; ++i)
    tenfold += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [" +
               repeated("*a" + std::to_string(i - 1) + ", ", 10) + "]\n";
  CHECK(read(tenfold).printed == "file.yaml:7: graph.yaml_too_many_values(500000)");
  CHECK(read("a: &a {x: 1}\nb: [*a, *a]\n").printed == "");
}

TEST_CASE("an alias has its anchor's value and its line") {
  Report report;
  const Node node = parse_yaml(
      std::make_shared<SourceFile>(SourceFile{"f.yaml", "f.yaml", "a: &a {x: '1'}\nb:\n  - *a\n  - ~\n"}),
      report);
  REQUIRE(report.text() == "");
  const Node& item = node.find("b")->items.at(0);
  CHECK(item.find("x")->text == "1");
  CHECK(item.find("x")->quoted);
  CHECK(item.find("x")->line == 1);
  CHECK(node.find("b")->items.at(1).is(Node::Kind::null));
  CHECK(node.find("b")->line == 3);
}

TEST_CASE("millions of documents or values are rejected before the tree is built" *
          doctest::test_suite("amounts")) {
  const Read documents = read(repeated("---\n", 4'000'000));
  CHECK(documents.printed.ends_with(": graph.document_repeated"));
  CHECK(documents.seconds < 5 * sanitizer_slowdown);
  const Read items = read(repeated("- 1\n", 4'000'000));
  CHECK(items.printed.ends_with(": graph.yaml_too_many_values(500000)"));
  CHECK(items.seconds < 10 * sanitizer_slowdown);
}

TEST_CASE("too deep nesting is reported as such") {
  CHECK(read("a: " + repeated("[", 1000)).printed == "file.yaml:1: graph.yaml_too_deep(60)");
  CHECK(read("a: " + repeated("{a: ", 100'000)).printed == "file.yaml:1: graph.yaml_too_deep(60)");
  CHECK(read(repeated("- ", 1'000'000)).printed == "file.yaml:1: graph.yaml_too_deep(60)");
  CHECK(read("a: " + repeated("[", 59) + repeated("]", 59)).printed == "");
  std::string chain = "a0: &a0 1\n";  // each alias is one deeper than the one before
  for (int i = 1; i < 200; ++i)
    chain += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [*a" + std::to_string(i - 1) + "]\n";
  CHECK(read(chain).printed == "file.yaml:61: graph.yaml_too_deep(60)");
}

TEST_CASE("control characters are rejected, 8-bit ones as well") {
  CHECK(read("mission: \"a\\e[2J\"\n").printed == "file.yaml:1: graph.control_character_found(27)");
  const std::string of_eight_bits = "mission: \"a\\u009b2J\"\n";
  CHECK(read(of_eight_bits).printed == "file.yaml:1: graph.control_character_found(155)");
  CHECK(read("mission: \"a\\0b\"\n").printed == "file.yaml:1: graph.control_character_found(0)");
  CHECK(read("mission: \"caf\\u00e9\"\n").printed == "");
}

TEST_CASE("of 400000 unknown keys the first hundred are reported" * doctest::test_suite("amounts")) {
  std::string text;
  for (int i = 0; i < 400'000; ++i) text += "unknown" + std::to_string(i) + ": 1\n";
  const Read keys = resolve(text);
  CHECK(keys.printed.find(
            "hourglass.yaml:1: graph.key_unknown(, unknown0,  [] mission, extends, io, airframe, origin, "
            "rate, seed, arm, done, failed, flown, verdict, timeout, epoch, progress, summary, failsafe, "
            "roles, components, phases, record, control, tell, resume, live, dds, hardware)") == 0);
  CHECK(keys.printed.ends_with("graph.more_faults(100)"));
  CHECK(keys.seconds < 10 * sanitizer_slowdown);
}

struct Flood : Read {
  double parsed_seconds = 0;  // to read the text alone
};

/// The synthetic mission with 50000 of `one` behind `at`; # stands for a number.
Flood flood(const std::string& at, const std::string& one) {
  Mission mission;
  std::string many;
  for (int i = 0; i < 50'000; ++i) {
    std::string text = one;
    many += text.replace(text.find('#'), 1, std::to_string(i));
  }
  mission.replace(at, at + many);
  return {resolve(mission.text), read(mission.text).seconds};
}

TEST_CASE("50000 wrong names cost little more than the hundred that are reported, in any place" *
          doctest::test_suite("amounts")) {
  for (const auto& [at, one] : {std::pair{"params: {", "x#: 1, "}, std::pair{"set: {", "x#: 1, "},
                                std::pair{"failsafe: {", "x#: 1, "}, std::pair{"origin: {", "x#: 1, "},
                                std::pair{"progress: [", "nav.x#, "}, std::pair{"next: [", "{to: x#}, "}}) {
    const Flood wrong = flood(at, one);
    CHECK(wrong.printed.ends_with("graph.more_faults(100)"));
    CHECK(wrong.seconds < 10 * wrong.parsed_seconds);  // a comparison of each with each takes 50
  }
}

TEST_CASE("more than a thousand roles, components or phases are rejected" * doctest::test_suite("amounts")) {
  const auto refusal = [](const std::string& section, const std::string& one) {
    const Flood wrong = flood(section + ":\n", "  x#: " + one + "\n");
    CHECK(wrong.seconds < 10 * wrong.parsed_seconds);
    return wrong.printed.find(section + ": graph.too_many_entries(500") != std::string::npos &&
           wrong.printed.find(", 1000)") != std::string::npos;
  };
  CHECK(refusal("components", "{use: sim_aero}"));
  CHECK(refusal("phases", "{}"));
  CHECK(refusal("roles", "{}"));
}

}  // namespace yaml_test

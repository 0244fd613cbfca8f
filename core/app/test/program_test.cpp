// SPDX-License-Identifier: BSD-3-Clause
// Messages of command-line programs for exceptions, and their output.
#include "core/app/program.hpp"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <unistd.h>

#include <any>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <tuple>
#include <variant>
#include <vector>

#include "core/error.hpp"
#include "core/say.hpp"

namespace program_test {

using namespace fulmar::core;

namespace {

std::string reported(const std::function<void()>& fault) {
  try {
    fault();
  } catch (const std::exception& e) {
    return sentence_of(e);
  }
  return "nothing was thrown";
}

/// Output on standard error during `words`.
std::string error_output(const std::function<void()>& words) {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("fulmar-program-test-" + std::to_string(getpid()));
  const int own = dup(STDERR_FILENO);
  const int to = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  dup2(to, STDERR_FILENO);
  words();
  dup2(own, STDERR_FILENO);
  close(own);
  close(to);
  std::ifstream in(file);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  std::filesystem::remove(file);
  return text;
}

}  // namespace

TEST_CASE("an exception of the standard library becomes a sentence for users") {
  const std::string inside = "app.internal_error(";
  CHECK(reported([] { std::vector<int>().reserve(std::vector<int>().max_size() + 1); }) ==
        inside + "std::length_error, app.length_excessive)");
  CHECK(reported([] { std::ignore = std::string().substr(1); }) ==
        inside + "std::out_of_range, app.element_missing)");
  const std::string taken = "app.value_type_differs)";
  CHECK(reported([] { std::ignore = std::get<int>(std::variant<double, int>(1.0)); }) ==
        inside + "std::bad_variant_access, " + taken);
  CHECK(reported([] { std::ignore = std::optional<int>().value(); }) ==
        inside + "std::bad_optional_access, " + taken);
  CHECK(reported([] { std::ignore = std::any_cast<int>(std::any(1.0)); }) ==
        inside + "std::bad_any_cast, " + taken);
  CHECK(reported([] { std::ignore = std::stoi("x"); }) ==
        inside + "std::invalid_argument, app.argument_invalid)");
  CHECK(reported([] { std::function<void()>()(); }) ==
        inside + "std::bad_function_call, app.callable_empty)");
}

TEST_CASE("an exception with a text for users keeps it") {
  CHECK(reported([] { throw Error("mission.yaml:3: no"); }) == "mission.yaml:3: no");
  CHECK(reported([] {
          throw std::system_error(std::make_error_code(std::errc::no_space_on_device), "basic_filebuf");
        }) == std::make_error_code(std::errc::no_space_on_device).message());
  CHECK(reported([] { std::ignore = std::filesystem::file_size("/nowhere"); }) ==
        "'/nowhere': " + std::make_error_code(std::errc::no_such_file_or_directory).message());
  CHECK(reported([] { throw std::bad_alloc(); }) == "app.memory_exhausted");
  CHECK(reported([] { throw std::runtime_error("the ellipsoid is flat"); }) ==
        "app.internal_error(std::runtime_error, the ellipsoid is flat)");
}

TEST_CASE("messages of the host contain no control characters and no time stamp") {
  const std::string text = error_output([] {
    speak_on_standard_error();
    say_aloud(
        "a\x1b[2J\xc2\x9b"
        "2J b\xc3\xa9");
    warn("c\x7f");
  });
  const std::string harmless = "a?[2J?2J b\xc3\xa9\nc?\n";
  CHECK(text == harmless);
}

}  // namespace program_test

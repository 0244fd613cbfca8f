// SPDX-License-Identifier: BSD-3-Clause
#include "core/loader/memory_file.hpp"

#include <doctest/doctest.h>

#include "core/loader/process.hpp"

namespace memory_file_test {

using namespace fulmar::core;

TEST_CASE("a child reads a text from its beginning, and its own text is read completely") {
  const std::string text = std::string(100'000, 'a') + '\0' + "end";
  const MemoryFile in(text), out;
  ChildFiles files;
  files.in = in.descriptor();
  files.out = out.descriptor();
  Process process("/bin/cat", {}, files);
  REQUIRE(process.wait(std::chrono::minutes(1)));
  CHECK(out.contents() == text);
  CHECK(out.contents() == text);
}

}  // namespace memory_file_test

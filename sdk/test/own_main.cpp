// SPDX-License-Identifier: BSD-3-Clause
// Main function of the project's own tests. Messages, also those of programs that a test starts, are codes
// with their arguments: a test does not depend on a sentence.
#include <cstdlib>
#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#include <doctest/doctest.h>

namespace {

// Runs before any other constructor of the program.
__attribute__((constructor(101))) void write_codes() { ::setenv("FULMAR_MESSAGES", "codes", 0); }

}  // namespace

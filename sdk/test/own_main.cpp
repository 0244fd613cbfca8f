// SPDX-License-Identifier: BSD-3-Clause
// doctest's main of the project's own tests: messages, also of the programs that a test starts, are written
// as codes with their arguments. A sentence can change without a change of a test.
#include <cstdlib>
#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#include <doctest/doctest.h>

namespace {

// Before any other constructor of the program.
__attribute__((constructor(101))) void write_codes() { ::setenv("FULMAR_MESSAGES", "codes", 0); }

}  // namespace

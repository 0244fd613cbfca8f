// SPDX-License-Identifier: BSD-3-Clause
// A plugin that needs a resource at its start, and does not get it.
#include <cstdio>
#include <cstdlib>
#include <stdexcept>

namespace {

struct Solver {
  Solver() {
#if defined(WORDS_ABORT)
    std::fputs("==7==ERROR: the solver\n\x1b[31mSUMMARY: out of licences\x07\n==7==ABORTING\n", stderr);
    std::abort();
#elif defined(WORDS_EXIT)
    for (int i = 0; i < 20000; ++i) std::fputs("the solver waits\n", stderr);  // more than a pipe holds
    std::fputs("the runtime does not come first\n\n", stderr);
    std::exit(1);
#else
    throw std::runtime_error("the licence server is not reached");
#endif
  }
} solver;

}  // namespace

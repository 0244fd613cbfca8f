// SPDX-License-Identifier: BSD-3-Clause
// Leaves a thread-local object with a destructor behind: the system's loader keeps the library until the
// thread ends.
#include <cstdlib>

namespace {
struct Local {
  int* number = static_cast<int*>(std::malloc(sizeof(int)));
  ~Local() { std::free(number); }
};
thread_local Local local;
}  // namespace

extern "C" int fulmar_test_touch();
extern "C" int fulmar_test_touch() { return local.number != nullptr; }

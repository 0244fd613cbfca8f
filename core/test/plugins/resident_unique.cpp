// SPDX-License-Identifier: BSD-3-Clause
// A static of a template is a unique symbol (STB_GNU_UNIQUE) on gcc: one object in the whole process, and a
// library that is never unloaded.
template <class T>
struct Shared {
  static inline int calls = 0;
};

extern "C" int fulmar_test_touch();
extern "C" int fulmar_test_touch() { return ++Shared<int>::calls; }

// SPDX-License-Identifier: BSD-3-Clause
// Identity of this build. Generated: cmake/build_identity.cmake.
#pragma once

namespace fulmar::core {

/// "0.1.0 5f0c1d2e3a4b5968": the version, and a digest of core's sources, compiler and flags. The host and a
/// library that shares C++ types with it must have the same identity.
extern const char build_identity[];

}  // namespace fulmar::core

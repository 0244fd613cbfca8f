// SPDX-License-Identifier: BSD-3-Clause
// Airframes for tests and benchmarks, by a reader that is independent of the host.
#pragma once
#include <string>

#include "fulmar/msg/airframe.hpp"

namespace fulmar::test {

/// configs/airframes/NAME.yaml without its `params`. Throws on an unknown key.
Airframe airframe_file(const std::string& name);
/// The same from the text of a file.
Airframe airframe_text(const std::string& yaml);

}  // namespace fulmar::test

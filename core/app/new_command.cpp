// SPDX-License-Identifier: BSD-3-Clause
#include "core/app/new_command.hpp"

#include "core/error.hpp"

namespace fulmar::core {

int new_command(const NewOptions& options) { throw Error("new " + options.name + ": this build has no templates"); }

}  // namespace fulmar::core

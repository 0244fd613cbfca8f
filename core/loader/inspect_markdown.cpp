// SPDX-License-Identifier: BSD-3-Clause
// Text of `fulmar inspect --markdown`: the reference page of a plugin.
#include "core/loader/inspect.hpp"

namespace fulmar::core {

std::string describe_plugin_markdown(const PluginInfo& plugin) { return "# " + plugin.file + "\n"; }

}  // namespace fulmar::core

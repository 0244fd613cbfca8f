// SPDX-License-Identifier: BSD-3-Clause
// Description of a plugin: the text of `fulmar inspect`.
#pragma once
#include <string>

#include "core/types/type.hpp"

namespace fulmar::core {

/// Version, components, ports and parameters in aligned columns; with `fields` also the tables of every
/// message.
std::string describe_plugin(const PluginInfo& plugin, bool fields = false);

/// The complete description as a Markdown page.
std::string describe_plugin_markdown(const PluginInfo& plugin);

}  // namespace fulmar::core

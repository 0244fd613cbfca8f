// SPDX-License-Identifier: BSD-3-Clause
// Libraries of the host (links/), which a flight opens when its mission has the section.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/loader/home.hpp"

namespace fulmar::core {

/// Opens lib/fulmar/host/fulmar_SECTION.so of the first of the folders that has one; it stays open. Returns
/// its table `fulmar_SECTION_library`. `needs`: further requirements, in a sentence, or ""; `where`: place of
/// the section. Throws Error when there is none, when it cannot be loaded, and when it comes from another
/// build than this program.
const void* open_host_library(const std::string& section, const std::string& needs,
                              const std::vector<std::filesystem::path>& homes, const Where& where);

/// The same for a table that names section and needs, and begins with the identity of its build.
template <class Library>
const Library& host_library(const Where& where,
                            const std::vector<std::filesystem::path>& homes = home_folders()) {
  return *static_cast<const Library*>(open_host_library(Library::section, Library::needs, homes, where));
}

}  // namespace fulmar::core

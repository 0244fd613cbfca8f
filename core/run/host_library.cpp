// SPDX-License-Identifier: BSD-3-Clause
#include "core/run/host_library.hpp"

#include <cstring>

#include "core/build.hpp"
#include "core/loader/shared_object.hpp"
#include "core/run/messages.hpp"

namespace fulmar::core {
namespace {

namespace fs = std::filesystem;

// A library has its own threads, and answers may be pending when a flight ends. So it is linked with -z
// nodelete and stays mapped when the object closes.
const void* open(const std::string& section, const std::string& needs, const fs::path& path) {
  SharedObject file;
  try {
    file.load(path, path.string());
  } catch (const Error& fault) {
    throw Error(needs.empty() ? fault.diagnostic : run_messages::library_needs(fault.diagnostic, needs));
  }
  const void* const table = file.find(("fulmar_" + section + "_library").c_str());
  if (table == nullptr) throw Error(run_messages::library_invalid(path.string()));
  const char* const build = *static_cast<const char* const*>(table);
  if (std::strcmp(build, build_identity) != 0)
    throw Error(run_messages::library_build_differs(path.string(), build, build_identity));
  return table;
}

}  // namespace

const void* open_host_library(const std::string& section, const std::string& needs,
                              const std::vector<fs::path>& homes, const Where& where) {
  const std::string name = "fulmar_" + section;
  std::vector<std::string> searched;
  try {
    for (const fs::path& home : homes) {
      const fs::path file = home / "lib" / "fulmar" / "host" / (name + ".so");
      std::error_code fault;
      if (fs::is_regular_file(file, fault)) return open(section, needs, file);
      searched.push_back(file.string());
    }
    throw Error(run_messages::library_missing(join(searched), name));
  } catch (const Error& fault) {
    const Diagnostic why = located(section, fault.diagnostic);
    throw Error(where.file.empty() ? why : located(where, why));
  }
}

}  // namespace fulmar::core

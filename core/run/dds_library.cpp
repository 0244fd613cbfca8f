// SPDX-License-Identifier: BSD-3-Clause
#include "core/run/dds_library.hpp"

#include <cstring>

#include "core/build.hpp"
#include "core/loader/shared_object.hpp"

namespace fulmar::core {
namespace {

namespace fs = std::filesystem;

// Fast DDS has threads of its own, and answers may be under way when a flight ends: the library is linked
// with -z nodelete, so that it stays mapped when the object closes.
const DdsLibrary& open(const fs::path& path) {
  SharedObject file;
  try {
    file.load(path, path.string());
  } catch (const Error& fault) {
    throw Error(
        std::string(fault.what()) +
        ". It needs Fast DDS: install libfastrtps-dev and libfastcdr-dev, or what they are called here");
  }
  const auto* const library = static_cast<const DdsLibrary*>(file.find("fulmar_dds_library"));
  if (library == nullptr) throw Error(path.string() + " is not the DDS library of Fulmar");
  if (std::strcmp(library->build, build_identity) != 0)
    throw Error(path.string() + " is of another build (" + library->build + ") than this program (" +
                build_identity + "): build or install both together");
  return *library;
}

}  // namespace

const DdsLibrary& dds_library(const std::vector<fs::path>& homes, const Where& section) {
  std::vector<std::string> searched;
  try {
    for (const fs::path& home : homes) {
      const fs::path file = home / "lib" / "fulmar" / "host" / "fulmar_dds.so";
      std::error_code fault;
      if (fs::is_regular_file(file, fault)) return open(file);
      searched.push_back(file.string());
    }
    throw Error("the DDS library is not there. Searched: " + join(searched) +
                ". Install the package fulmar, or build it: cmake --build build --target fulmar_dds");
  } catch (const Error& fault) {
    throw Error((section.file.empty() ? "" : section.text() + ": ") + "dds: " + fault.what());
  }
}

}  // namespace fulmar::core

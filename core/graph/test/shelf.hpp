// SPDX-License-Identifier: BSD-3-Clause
// A synthetic mission with its files and components: resolution is tested without a plugin file.
#pragma once
#include <cstring>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/graph/catalogue.hpp"
#include "core/graph/graph.hpp"

namespace fulmar::core::test {

/// A catalogue of synthetic plugins. A test may change `plugins`.
struct Shelf : Catalogue {
  std::map<std::string, std::shared_ptr<PluginInfo>> plugins;

  Shelf();
  ComponentInfo& add(const std::string& plugin, const std::string& name, std::vector<Port> inputs,
                     std::vector<Port> outputs, std::vector<ParamInfo> params = {});
  FoundPlugin open(const std::string& name) override;
};

/// A temporary folder for the files of one test.
struct Folder {
  std::filesystem::path path;
  Folder();
  ~Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::string write(const std::string& name, const std::string& text) const;
};

extern const char* const anaconda;
extern const char* const all_but_mass;  // required fields of an airframe but one
extern const char* const hourglass_plan;
extern const char* const hourglass;

/// The hourglass mission with its files, for changes by a test.
struct Mission {
  Folder folder;
  Shelf shelf;
  std::string text = hourglass;

  Mission();
  Mission& replace(const std::string& from, const std::string& to);
  Graph load(const Overrides& overrides = {});
  /// The faults when it is rejected; "" when it is accepted.
  std::string faults(const Overrides& overrides = {});
};

/// The synthetic hourglass as the lowest layer of a mission with `text`.
struct Layered : Mission {
  explicit Layered(const std::string& top) {
    folder.write("ground.yaml", text);
    text = top;
  }
};

/// The faults of the hourglass mission with `from` replaced by `to`, without "hourglass.yaml:".
std::string changed(const std::string& from, const std::string& to);

int index_of(const Graph& graph, const std::string& name);  // -1: missing
const Component& component(const Graph& graph, const std::string& name);
const ParamValue& param(const Graph& graph, const std::string& owner, const std::string& name);
const Wire& wire(const Graph& graph, const std::string& owner, const std::string& input);
/// "ekf, slc"
std::string names(const Graph& graph, const std::vector<int>& indices);

/// Value of a record parameter.
template <class T>
T value(const ParamValue& param) {
  if (param.data.size() != sizeof(T)) throw Error("a record of another size");
  T out;
  std::memcpy(static_cast<void*>(&out), param.data.data(), sizeof out);
  return out;
}

}  // namespace fulmar::core::test

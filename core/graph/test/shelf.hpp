// SPDX-License-Identifier: BSD-3-Clause
// A mission, its files and the components it uses, all made up: resolution is tested without a plugin file.
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

/// A catalogue of made-up plugins. `plugins` may be changed by a test.
struct Shelf : Catalogue {
  std::map<std::string, std::shared_ptr<PluginInfo>> plugins;

  Shelf();
  ComponentInfo& add(const std::string& plugin, const std::string& name, std::vector<Port> inputs,
                     std::vector<Port> outputs, std::vector<ParamInfo> params = {});
  FoundPlugin open(const std::string& name) override;
};

/// A folder of its own for the files of one test; gone afterwards.
struct Folder {
  std::filesystem::path path;
  Folder();
  ~Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::string write(const std::string& name, const std::string& text) const;
};

extern const char* const anaconda;
extern const char* const all_but_mass;  // of what an airframe has to say
extern const char* const hourglass_plan;
extern const char* const hourglass;

/// The hourglass mission with its files, and what a test changes in it.
struct Mission {
  Folder folder;
  Shelf shelf;
  std::string text = hourglass;

  Mission();
  Mission& replace(const std::string& from, const std::string& to);
  Graph load(const Overrides& overrides = {});
  /// What is said when it is refused; "" when it is not.
  std::string faults(const Overrides& overrides = {});
};

/// The made-up hourglass as the lowest layer of a mission that says `text`.
struct Layered : Mission {
  explicit Layered(const std::string& top) {
    folder.write("ground.yaml", text);
    text = top;
  }
};

/// The faults of the hourglass mission with `from` replaced by `to`; "hourglass.yaml:" is left out.
std::string changed(const std::string& from, const std::string& to);

int index_of(const Graph& graph, const std::string& name);  // -1: not there
const Component& component(const Graph& graph, const std::string& name);
const ParamValue& param(const Graph& graph, const std::string& owner, const std::string& name);
const Wire& wire(const Graph& graph, const std::string& owner, const std::string& input);
/// "ekf, slc"
std::string names(const Graph& graph, const std::vector<int>& indices);

/// Of a record.
template <class T>
T value(const ParamValue& param) {
  if (param.data.size() != sizeof(T)) throw Error("a record of another size");
  T out;
  std::memcpy(static_cast<void*>(&out), param.data.data(), sizeof out);
  return out;
}

}  // namespace fulmar::core::test

// SPDX-License-Identifier: BSD-3-Clause
#include "core/graph/places.hpp"

#include "core/graph/graph.hpp"
#include "core/graph/params.hpp"
#include "core/types/named.hpp"

namespace fulmar::core {

std::optional<Where> place_in(const Component& component, const std::string& sentence) {
  const std::size_t colon = sentence.find(':');
  if (colon == std::string::npos) return {};
  const ParamPath at = param_path(component.info(), sentence.substr(0, colon));
  if (at.param < 0 || static_cast<std::size_t>(at.param) >= component.params.size()) return {};
  const SaidPlacesPtr& places = nth(component.params, at.param).places;
  if (!places) return {};
  for (std::string path = without_units(at.field);;) {
    if (const auto it = places->find(path); it != places->end()) return it->second;
    if (path.empty()) return {};
    const std::size_t cut = path.find_last_of(".[");
    path.resize(cut == std::string::npos ? 0 : cut);
  }
}

}  // namespace fulmar::core

// SPDX-License-Identifier: BSD-3-Clause
#include "core/graph/places.hpp"

#include "core/graph/graph.hpp"
#include "core/graph/params.hpp"
#include "core/graph/quantity.hpp"
#include "core/graph/yaml.hpp"
#include "core/types/named.hpp"

namespace fulmar::core {
namespace {

/// "stall_alpha_rad" and "stall_alpha" are one place.
std::string without_units(const std::string& path) {
  std::string out;
  for (std::size_t begin = 0; begin <= path.size();) {
    const std::size_t end = std::min(path.find('.', begin), path.size());
    const std::string step = path.substr(begin, end - begin);
    const auto split = split_suffix(step);
    out += (begin > 0 ? "." : "") + (split ? split->name : step);
    begin = end + 1;
  }
  return out;
}

void note(SaidPlaces& places, const std::string& path, const Where& where, const Node& node) {
  places[without_units(path)] = where;
  for (const Node::Entry& entry : node.entries)
    note(places, path.empty() ? entry.key : path + "." + entry.key, entry.where(), entry.value);
  for (std::size_t i = 0; i < node.items.size(); ++i)
    note(places, path + "[" + std::to_string(i) + "]", node.items[i].where(), node.items[i]);
}

}  // namespace

SaidPlacesPtr places_of(const Node& node) {
  auto places = std::make_shared<SaidPlaces>();
  note(*places, "", node.where(), node);
  return places;
}

SaidPlacesPtr with_place(const SaidPlacesPtr& places, const std::string& field, const Node& node) {
  auto more = places ? std::make_shared<SaidPlaces>(*places) : std::make_shared<SaidPlaces>();
  note(*more, field, node.where(), node);
  return more;
}

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

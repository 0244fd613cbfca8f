// SPDX-License-Identifier: BSD-3-Clause
#include "core/graph/said_places.hpp"

#include <algorithm>

#include "core/graph/quantity.hpp"
#include "core/graph/yaml.hpp"

namespace fulmar::core {

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

namespace {

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

}  // namespace fulmar::core

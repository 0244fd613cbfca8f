// SPDX-License-Identifier: BSD-3-Clause
// Components that use a geofence share one: of two different ones, that of the steering component applies.
#include <string>

#include "core/graph/draft.hpp"
#include "core/graph/messages.hpp"

namespace fulmar::core {
namespace {

/// A supplied record of that name; null: none.
const ParamValue* given_record(const Component& c, const std::string& name) {
  const auto& params = c.info().params;
  for (std::size_t i = 0; i < params.size(); ++i)
    if (params[i].name == name && params[i].kind == FULMAR_RECORD && c.params[i].integer != 0)
      return &c.params[i];
  return nullptr;
}

}  // namespace

void report_two_fences(Draft& draft) {
  const Component* first = nullptr;
  for (const Component& c : draft.graph.components) {
    const ParamValue* const fence = given_record(c, "fence");
    if (!fence) continue;
    if (!first)
      first = &c;
    else if (given_record(*first, "fence")->data != fence->data)
      draft.graph.source.warnings.push_back(
          located(c.where, graph_messages::fences_differ(c.name, first->name)).line());
  }
}

}  // namespace fulmar::core

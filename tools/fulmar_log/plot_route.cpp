// SPDX-License-Identifier: BSD-3-Clause
// The route of a flight's plan, as published by its scene: poses in metres to the east and to the north.
#include <algorithm>
#include <cmath>

#include "tools/fulmar_log/log_field.hpp"
#include "tools/fulmar_log/plot_log.hpp"

namespace fulmar::plot {

std::vector<chart::ChartPoint> route_of(const std::filesystem::path& file, const core::LogInfo& info) {
  const auto is_route = [](const core::LogInfo::Topic& t) { return t.topic.ends_with("/route"); };
  const auto topic = std::find_if(info.topics.begin(), info.topics.end(), is_route);
  std::vector<chart::ChartPoint> route;
  if (topic == info.topics.end() || topic->messages == 0) return route;
  const core::Tables tables(file, {topic->topic});
  std::vector<std::size_t> east, north;
  const std::vector<core::Column>& columns = tables.list().at(0).columns;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (columns[i].name.ends_with(".pose.position.x")) east.push_back(i);
    if (columns[i].name.ends_with(".pose.position.y")) north.push_back(i);
  }
  tables.rows([](std::size_t) { return true; },
              [&](const core::Tables::Row& row) {
                route.clear();
                for (std::size_t i = 0; i < std::min(east.size(), north.size()); ++i)
                  route.push_back({core::number_of_cell((*row.cells)[east[i]]),
                                   core::number_of_cell((*row.cells)[north[i]])});
                std::erase_if(route, [](const chart::ChartPoint& p) { return !chart::is_there(p); });
              });
  return route;
}

}  // namespace fulmar::plot

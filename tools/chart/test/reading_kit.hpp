// SPDX-License-Identifier: BSD-3-Clause
// Reads charts as a reader does: axes by their marks, curves by where they are drawn, tags by their ends.
#pragma once
#include <doctest/doctest.h>

#include <cstdlib>
#include <string>
#include <vector>

namespace fulmar::chart::test {

/// What stands between two texts, each time.
inline std::vector<std::string> between(const std::string& text, const std::string& from,
                                        const std::string& to) {
  std::vector<std::string> all;
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos;) {
    at += from.size();
    const std::size_t end = text.find(to, at);
    if (end == std::string::npos) break;
    all.push_back(text.substr(at, end - at));
  }
  return all;
}

/// Places on the page to values, by the first and the last mark of an axis.
struct AxisScale {
  double place0 = 0, value0 = 0, per_place = 0;
  double at(double place) const { return value0 + (place - place0) * per_place; }
};
inline AxisScale scale_of(const std::vector<double>& places, const std::vector<double>& values) {
  REQUIRE(places.size() >= 2);
  return {places[0], values[0], (values.back() - values[0]) / (places.back() - places[0])};
}

/// The parts of a path of M and L.
template <class Point>
std::vector<std::vector<Point>> read_parts(const std::string& d, const AxisScale& x, const AxisScale& y) {
  std::vector<std::vector<Point>> parts;
  for (std::size_t at = 0; (at = d.find_first_of("ML", at)) != std::string::npos; ++at) {
    char* next = nullptr;
    const double px = std::strtod(d.c_str() + at + 1, &next), py = std::strtod(next, nullptr);
    if (d[at] == 'M') parts.emplace_back();
    REQUIRE(!parts.empty());
    parts.back().push_back({x.at(px), y.at(py)});
  }
  return parts;
}

/// The first tag that is not closed where it should be; "": all are.
inline std::string unbalanced(const std::string& page) {
  std::vector<std::string> open;
  for (std::size_t at = 0; (at = page.find('<', at)) != std::string::npos; ++at) {
    if (page.compare(at, 2, "<!") == 0) continue;
    const bool closes = page.compare(at, 2, "</") == 0;
    const std::size_t begin = at + (closes ? 2 : 1), end = page.find('>', at);
    const std::string name = page.substr(begin, page.find_first_of(" />", begin) - begin);
    if (name == "meta" || page[end - 1] == '/') continue;
    if (!closes) {
      open.push_back(name);
      continue;
    }
    if (open.empty() || open.back() != name) return "</" + name + "> at " + std::to_string(at);
    open.pop_back();
  }
  return open.empty() ? "" : "<" + open.back() + ">";
}

}  // namespace fulmar::chart::test

// SPDX-License-Identifier: BSD-3-Clause
// The reference page of a plugin: complete, and a table stays a table for any text of the author.
#include <doctest/doctest.h>

#include <cstdio>
#include <cstring>
#include <sstream>

#include "core/loader/test/tables.hpp"
#include "core/loader/test/workshop.hpp"
#include "tools/fulmar_inspect/inspect.hpp"

namespace inspect_markdown_test {

using namespace fulmar::core;
using namespace workshop;

namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

// A line of a table that begins with these cells.
std::string row(const std::vector<std::string>& cells) {
  std::string line = "|";
  for (const std::string& cell : cells) line += (cell.empty() ? "  |" : " " + cell + " |");
  return line;
}

// Cells of a table's line, by GitHub's rule: a bar that no backslash precedes ends a cell, between back-ticks
// too.
std::size_t cells(const std::string& line) {
  std::size_t bars = 0;
  for (std::size_t i = 0; i < line.size(); ++i)
    if (line[i] == '|' && (i == 0 || line[i - 1] != '\\')) ++bars;
  return bars - 1;
}

// Lines of tables whose number of cells differs from that of the line above.
std::size_t torn_lines(const std::string& page) {
  std::size_t torn = 0, width = 0;
  std::istringstream in(page);
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] != '|') {
      width = 0;
      continue;
    }
    if (width != 0 && cells(line) != width) ++torn;
    width = cells(line);
  }
  return torn;
}

PluginInfo one_component() {
  PluginInfo plugin;
  plugin.file = "own.so";
  plugin.version = "0.3";
  plugin.abi_major = 1;
  plugin.components.push_back({});
  plugin.components[0].name = "Own";
  return plugin;
}

ParamInfo angle(double initial) {
  ParamInfo param;
  param.name = "bank";
  param.unit = "rad";
  param.initial[0] = initial;
  param.min = -1;
  param.max = 1;
  return param;
}

}  // namespace

TEST_CASE("the page of a plugin holds everything that the plugin says of itself") {
  const PluginInfo info = Library::open(plugin("good"))->info();
  std::string page = describe_plugin_markdown(info);
  char hash[20];
  std::snprintf(hash, sizeof hash, "%016llx",
                static_cast<unsigned long long>(info.components[0].inputs[0].type->hash));
  for (std::size_t at; (at = page.find(hash)) != std::string::npos;) page.replace(at, 16, "HASH");
  CHECK(page == R"page(# good

`good.so`, version 1.2.0, ABI 1.2

| component | what |
| --- | --- |
| [Scaler](#scaler) | Multiplies an airspeed. |

## Scaler

Multiplies an airspeed.

```yaml
name: {use: good/Scaler, in: {state: ...}}
```

### Inputs

| input | message | kind |
| --- | --- | --- |
| `state` | [Sample](#sample) | value |
| `hint` | [Sample](#sample) | value, optional |
| `edits` | [Sample](#sample) | queue of 16 |
| `edit` | [Sample](#sample) | request of 4 |

### Outputs

| output | message | kind |
| --- | --- | --- |
| `scaled` | [Sample](#sample) | value |
| `news` | [Sample](#sample) | inspect.event_output_kind |
| `events` | [Sample](#sample) | queue of 8 |
| `error_mps` |  | probe |

### Parameters

| parameter | default | range | set | what |
| --- | --- | --- | --- | --- |
| `gain` | 0.5 rad/rad | 0 .. 2 | live | multiplies |
| `on` | true |  | live | does anything |
| `repeats` | 3 | 0 .. 10 | set-up | how often |
| `law` | climb | hold, climb | live | which one |
| `label` | "x" |  | set-up | a word |
| `wind` | \[3, -4, 0] m/s | -30 .. 30 | live | of the air |
| `start` | [Sample](#sample) |  | set-up | where it begins |
| `table` | bytes (file) |  | set-up, required | bytes |

## Files

What the parameters above read. A field that is not named has its default.

### Sample

40 bytes, layout `HASH`

| field | kind | unit | frame | default | range |
| --- | --- | --- | --- | --- | --- |
| `airspeed_mps` | f64 | m/s |  | 17 |  |
| `position_m` | {north, east, down} | m | ned | \[1, 2, -70] |  |
| `mode` | enum |  |  | glide | idle, glide |
| `valid` | bool |  |  | true |  |
)page");
}

TEST_CASE("what authors write does not tear a table") {
  PluginInfo plugin = one_component();
  plugin.components[0].doc = "a|b <br> `c|d <e>`\nnext *line* [f]";
  ParamInfo param = angle(0.5);
  param.doc = "either|or, <1 s, a\\b, one ` alone";
  plugin.components[0].params = {param};
  const std::string page = describe_plugin_markdown(plugin);
  CHECK(torn_lines(page) == 0);
  for (const char* cell : {"| [Own](#own) | a\\|b &lt;br> `c\\|d <e>` next \\*line\\* \\[f] |",
                           "either\\|or, &lt;1 s, a\\\\b, one \\` alone |"})
    CHECK_MESSAGE(has(page, cell), cell);
}

TEST_CASE("angles are told in degrees too, other units are not") {
  PluginInfo plugin = one_component();
  plugin.components[0].params = {angle(0.785)};
  CHECK(has(describe_plugin_markdown(plugin),
            "| 0.785 rad (44.98 deg) | -1 .. 1 |"));  // 0.785 * 180 / pi = 44.977
  plugin.components[0].params[0].unit = "rad/rad";
  CHECK(has(describe_plugin_markdown(plugin), "| 0.785 rad/rad | -1 .. 1 |"));
}

TEST_CASE("a message with one of everything, and a file with its defaults") {
  PluginInfo plugin = one_component();
  const TypePtr type = copy_type(tables::route);
  tables::Route initial{};
  initial.airspeed_mps = 1e9;  // unknown
  initial.position_m = {1, 2, -70};
  initial.mode = 2;
  std::strcpy(initial.label, "north");
  ParamInfo file;
  file.name = "start";
  file.kind = FULMAR_RECORD;
  file.type = type;
  file.initial_data.assign(tables::bytes(initial), tables::bytes(initial) + sizeof initial);
  Port port;
  port.name = "route";
  port.type = type;
  plugin.components[0].inputs = {port};
  const std::string message = describe_plugin_markdown(plugin);
  CHECK(torn_lines(message) == 0);
  CHECK(has(message, "| `throttle_frac` | f64 |  |  | 0 .. 1 |"));
  CHECK(has(message, "| `waypoints` | Waypoint\\[&lt;=5] |"));
  CHECK(has(message, row({"`waypoints[].position_m`", "{north, east, down}", "m", "ned"})));
  CHECK(has(message, "| `gains_ratio` | f64\\[4] |"));
  CHECK_FALSE(has(message, "## Files"));
  plugin.components[0].params = {file};
  const std::string page = describe_plugin_markdown(plugin);
  CHECK(torn_lines(page) == 0);
  CHECK(has(page, row({"`airspeed_mps`", "f64", "m/s", "", "none"})));
  CHECK(has(page, row({"`position_m`", "{north, east, down}", "m", "ned", "\\[1, 2, -70]"})));
  CHECK(has(page, row({"`mode`", "enum", "", "", "climb", "idle, glide, climb"})));
  CHECK(has(page, "| `label` | text of 14 |  |  | north |"));
  CHECK(has(page, "| `start` | [Route](#route) |"));
  CHECK(page.find("### Route") == page.rfind("### Route"));  // once, though it is a port's message too
}

}  // namespace inspect_markdown_test

// SPDX-License-Identifier: BSD-3-Clause
// The page that a browser gets on the port of the live view.
#include "core/live/describe.hpp"
#include "core/types/wire.hpp"

namespace fulmar::core::live {
namespace {

constexpr const char* head =
    "<!doctype html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
    "content=\"width=device-width\">\n"
    "<style>body{font:16px/1.5 system-ui,sans-serif;max-width:52rem;margin:2rem auto;padding:0 "
    "1rem;color:#222}"
    "code{background:#f2f2f2;padding:0 "
    ".2em}table{border-collapse:collapse}td,th{text-align:left;padding:.1rem 1rem .1rem 0}</style>\n";

constexpr const char* how =
    "<p>This port speaks the Foxglove WebSocket protocol. To see the flight, open a connection of the kind "
    "<em>Foxglove WebSocket</em> in "
    "Foxglove, Lichtblick or PlotJuggler, and give it this page's address with <code>ws://</code> in front. "
    "In a terminal: <code>fulmar "
    "list</code>, <code>fulmar echo PORT</code>, <code>fulmar param list</code>.</p>\n";

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&': out += "&amp;"; break;
      case '<': out += "&lt;"; break;
      case '>': out += "&gt;"; break;
      case '"': out += "&quot;"; break;
      default: out += c;
    }
  }
  return out;
}

}  // namespace

std::string page(const std::string& mission, const Tap& tap) {
  std::string html = head;
  html += "<title>" + escaped(mission) + " - Fulmar</title>\n<h1>" + escaped(mission) + "</h1>\n" + how;
  html += "<table>\n<tr><th>topic<th>type\n";
  for (const TapChannel& c : tap.channels())
    html += "<tr><td>" + escaped(c.topic) + "<td>" + escaped(ros_name(*c.type)) + "\n";
  return html + "</table>\n";
}

}  // namespace fulmar::core::live

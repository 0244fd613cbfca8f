// SPDX-License-Identifier: BSD-3-Clause
// What opens a log, or the flight that runs, in a viewer: the link or the command line, and the layout that
// is shipped for it. Sources: Lichtblick's and Foxglove's pages on links and on their command lines; the
// options of PlotJuggler and Rerun.
#pragma once
#include <string>
#include <vector>

#include "tools/fulmar_live/client.hpp"

namespace fulmar::core {

struct ViewOptions {
  std::string what;    // a log's file; "" or "running": the flight at the target
  std::string in;      // a viewer; "": the page of a running flight, Lichtblick for a log
  bool print = false;  // nothing is opened
};

/// How a viewer is told. `words` is what is run: a program and its arguments.
struct Opening {
  std::vector<std::string> words;
  std::string link;                // what is opened, when it is a link: then `words` opens it
  std::string layout;              // a file; "": there is none
  std::vector<std::string> to_do;  // what people do by hand, a sentence each
  std::string report;              // a page that is made of the log first, unless it is there; "": none
};

/// Throws Error, WrongUsage when the viewer cannot do that. `log`: whole, or "" for the running flight.
Opening opening_of(const std::string& viewer, const std::string& log, const LiveAddress& target);

/// Text for the query of a link: RFC 3986, 2.1.
std::string percent_encoded(const std::string& text);
/// A word as a shell takes it back.
std::string shell_quoted(const std::string& word);

int view_command(const LiveAddress& target, const ViewOptions& options);

}  // namespace fulmar::core

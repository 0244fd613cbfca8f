// SPDX-License-Identifier: BSD-3-Clause
// Opens a log or the running flight in a viewer: the link or the command line, and the shipped layout.
// Sources: Lichtblick's and Foxglove's pages on links and on their command lines; the options of PlotJuggler
// and Rerun.
#pragma once
#include <string>
#include <vector>

#include "tools/fulmar_live/client.hpp"

namespace fulmar::core {

struct ViewOptions {
  std::string what;    // a log's file; "" or "running": the flight at the target
  std::string in;      // viewer; "": the page of a running flight, Lichtblick for a log
  bool print = false;  // only prints the command
};

/// Start of a viewer. `words` is the command: a program and its arguments.
struct Opening {
  std::vector<std::string> words;
  std::string link;                // link to open, if any: then `words` opens it
  std::string layout;              // a file; "": none
  std::vector<std::string> to_do;  // manual steps, one sentence each
  std::string report;              // page of the log that is made first if it is missing; "": none
};

/// Throws Error, or WrongUsage when the viewer has no such function. `log`: a complete one, or "" for the
/// running flight.
Opening opening_of(const std::string& viewer, const std::string& log, const LiveAddress& target);

/// Text for the query of a link: RFC 3986, 2.1.
std::string percent_encoded(const std::string& text);
/// A word quoted for a shell.
std::string shell_quoted(const std::string& word);

int view_command(const LiveAddress& target, const ViewOptions& options);

}  // namespace fulmar::core

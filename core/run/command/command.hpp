// SPDX-License-Identifier: BSD-3-Clause
// A command, from whoever gives it to where it takes effect: one struct for the queue of the live flight, the
// loop, the log and a replay.
#pragma once
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "core/graph/graph.hpp"
#include "core/log/events.hpp"

namespace fulmar::core {

struct Command {
  CommandKind kind = CommandKind::parameter;
  std::string component, name;     // name: parameter, port or phase; of a swap the file
  ParamValue value;                // of a parameter
  std::vector<std::byte> message;  // of a request or import: a struct of the port's type
  // What CommandTable::prepare has found.
  std::size_t at = 0, part = 0;                // component; its parameter or input; import; phase
  std::shared_ptr<const PluginInfo> made_for;  // the component's plugin
  CommandNote note;                            // what the log will hold
};

Command command_of(CommandKind kind, std::string component = {}, std::string name = {});

/// For the log: the plugin that was swapped in. Throws Error when it has no room for its version.
CommandNote swap_note(const std::string& component, const PluginInfo& plugin);

/// The value that a log tells, of a parameter of this kind. Throws Error for a choice that it does not have.
ParamValue value_of(const CommandNote& note, const ParamInfo& info);

/// What there is to command, as of one moment: it changes with a swap alone. Any thread may read it.
class CommandTable {
 public:
  /// An input that others than components feed.
  struct Entrance {
    std::string port;
    std::size_t input = 0;  // of the component
    int import = -1;        // into the flight's imports; -1: a request
    TypePtr type;
    std::shared_ptr<const Guard> guard;
  };
  explicit CommandTable(const Graph& graph);

  /// The one check of what is commanded: whether it is there, may change, and is in its range. Throws Error
  /// with the valid choices.
  void prepare(Command& command) const;

  std::size_t component(const std::string& name) const;
  std::size_t param(std::size_t component, const std::string& name) const;
  const Entrance& entrance(std::size_t component, const std::string& port, bool imported) const;
  const ComponentInfo& info(std::size_t component) const { return *parties_[component].info; }

 private:
  struct Party {
    std::string name;
    std::shared_ptr<const PluginInfo> plugin;  // keeps the info alive
    const ComponentInfo* info = nullptr;
    std::vector<Entrance> entrances;
  };
  void prepare_parameter(Command& command) const;
  void prepare_message(Command& command) const;
  std::size_t phase(const std::string& name) const;

  std::vector<Party> parties_;
  std::vector<std::string> phases_;
};

/// Throws Error for a parameter that is set before the flight, for good.
void check_live(const std::string& component, const ParamInfo& info);

}  // namespace fulmar::core

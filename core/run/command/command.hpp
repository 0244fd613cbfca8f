// SPDX-License-Identifier: BSD-3-Clause
// A command, from its sender to its effect: one struct for the queue of the live flight, the loop, the log
// and a replay.
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
  // Result of CommandTable::prepare.
  std::size_t at = 0, part = 0;                // component; its parameter or input; import; phase
  std::shared_ptr<const PluginInfo> made_for;  // the component's plugin
  CommandNote note;                            // content for the log
};

Command command_of(CommandKind kind, std::string component = {}, std::string name = {});

/// Log entry of a swapped plugin. Throws Error when its version is too long.
CommandNote swap_note(const std::string& component, const PluginInfo& plugin);

/// The logged value of a parameter of this kind. Throws Error for an unknown choice.
ParamValue value_of(const CommandNote& note, const ParamInfo& info);

/// Possible commands at one moment: only a swap changes them. Any thread may read it.
class CommandTable {
 public:
  /// An input that is fed from outside the components.
  struct Entrance {
    std::string port;
    std::size_t input = 0;  // of the component
    int import = -1;        // into the flight's imports; -1: a request
    TypePtr type;
    std::shared_ptr<const Guard> guard;
  };
  explicit CommandTable(const Graph& graph);

  /// The single check of a command: whether its target exists, may change, and accepts the value. Throws
  /// Error with the valid choices.
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

/// Throws Error for a parameter that is fixed before the flight.
void check_live(const std::string& component, const ParamInfo& info);

}  // namespace fulmar::core

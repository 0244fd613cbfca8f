// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_replay/replay.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdlib>
#include <cstring>

#include "core/graph/stored_files.hpp"
#include "core/loader/store.hpp"
#include "core/log/mcap.hpp"
#include "core/run/command/command.hpp"
#include "core/types/named.hpp"
#include "tools/fulmar_replay/messages.hpp"
#include "tools/fulmar_replay/playback.hpp"
#include "tools/log_reading/message_diff.hpp"

namespace fulmar::core {
namespace {

namespace fs = std::filesystem;

fs::path private_folder() {
  std::string name = (fs::temp_directory_path() / "fulmar-replay-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr)
    throw Error(
        replay_messages::folder_not_creatable(fs::temp_directory_path().string(), std::strerror(errno)));
  return name;
}

struct TemporaryFolder {
  fs::path path = private_folder();
  TemporaryFolder() = default;
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
};

/// A replay has no connections to other programs.
Graph alone(Graph graph) {
  graph.live.on = graph.dds.on = false;
  return graph;
}

bool names_component(const std::vector<std::pair<std::string, std::string>>& with,
                     const std::string& component) {
  return std::any_of(with.begin(), with.end(), [&](const auto& w) { return w.first == component; });
}

}  // namespace

// ---- the mission

Recording::Recording(const fs::path& log) try : path_(log), survey_(log) {
  std::vector<std::pair<std::string, std::string>> files;
  for (const McapFile::Attachment& a : survey_.log.attachments)
    if (a.media_type == "application/yaml") files.emplace_back(a.name, a.content);
  if (files.empty()) throw Error(replay_messages::mission_missing());
  HostTopic<Event>(survey_.log).check();
  mission_file_ = files.front().first;
  read_overrides();
  flown_ = flown_plugins(survey_.log);
  overrides_.files = std::make_shared<const StoredFiles>(std::move(files));
} catch (const Error& fault) {
  const std::string text = fault.what();
  throw Error(text.find(log.string()) == std::string::npos ? located(log.string(), fault.diagnostic)
                                                           : fault.diagnostic);
}

Recording::~Recording() {
  std::error_code ignored;
  if (!folder_.empty()) fs::remove_all(folder_, ignored);
}

void Recording::read_overrides() {
  const McapFile::Metadata* const metadata = find_named(survey_.log.metadata, "overrides");
  if (!metadata) throw Error(replay_messages::overrides_not_recorded());
  for (const auto& [key, value] : metadata->pairs) {
    std::uint64_t seed = 0;
    if (key == "io") overrides_.io = value;
    if (key == "arm") overrides_.arm = value;
    if (key == "seed" && std::from_chars(value.data(), value.data() + value.size(), seed).ec == std::errc{})
      overrides_.seed = seed;
    if (key.starts_with("role ")) overrides_.roles.emplace_back(key.substr(5), value);
    if (key.starts_with("set ")) overrides_.set.emplace_back(key.substr(4), value);
    if (key.starts_with("record ")) overrides_.record.push_back(value);
  }
}

Overrides Recording::by_component(const Overrides& changes) const {
  Overrides of_log = overrides_, named = changes;
  of_log.with = changes.with;
  named.with = with_components(mission_file_, of_log).with;
  return named;
}

/// Files of the store are named by content: a link restores the name, which messages and logs show.
fs::path Recording::plugin(const FlownPlugin& flown) const {
  const fs::path copy = version_that_flew(flown.file, flown.version, flown.sha256);
  if (folder_.empty()) folder_ = private_folder();
  const fs::path link = folder_ / flown.sha256 / fs::path(flown.file).filename();
  fs::create_directories(link.parent_path());
  std::error_code there;
  fs::create_symlink(copy, link, there);
  return link;
}

void Recording::use_copies(Overrides& overrides, const std::vector<const FlownPlugin*>& wanted,
                           const Overrides& changes, const Say& say) const {
  overrides.with.clear();
  for (const FlownPlugin* flown : wanted) {
    if (names_component(changes.with, flown->component)) continue;
    try {
      overrides.with.emplace_back(flown->component, plugin(*flown).string());
    } catch (const Error& fault) {
      if (say) say(flown->component + ": " + fault.what(), true);
    }
  }
  overrides.with.insert(overrides.with.end(), changes.with.begin(), changes.with.end());
}

Graph Recording::mission(const Overrides& changes, const Say& say) const {
  Overrides overrides = overrides_;
  overrides.set.insert(overrides.set.end(), changes.set.begin(), changes.set.end());
  overrides.record.insert(overrides.record.begin(), changes.record.begin(), changes.record.end());
  overrides.with = changes.with;
  for (const FlownPlugin& flown : flown_) overrides.flown.push_back(flown.sha256);
  std::vector<const FlownPlugin*> wanted;
  Graph graph;
  try {
    graph = load_mission(mission_file_, overrides);
    for (const FlownPlugin& flown : flown_)
      for (const Component& c : graph.components)
        if (c.name == flown.component && c.plugin->sha256 != flown.sha256 &&
            !names_component(changes.with, c.name))
          wanted.push_back(&flown);
    if (wanted.empty()) return alone(std::move(graph));
  } catch (const Error&) {  // the plugin was next to the mission, or has changed
    for (const FlownPlugin& flown : flown_) wanted.push_back(&flown);
  }
  use_copies(overrides, wanted, changes, say);
  graph = {};
  graph = load_mission(mission_file_, overrides);
  for (const FlownPlugin& flown : flown_)
    for (const Component& c : graph.components)
      if (say && c.name == flown.component && c.plugin->sha256 != flown.sha256 &&
          !names_component(changes.with, c.name))
        say(replay_messages::plugin_replaced(c.name, c.plugin->file, c.plugin->version, c.plugin->sha256),
            true);
  return alone(std::move(graph));
}

// ---- the flight

namespace {

/// Components that an experiment changes.
std::vector<std::string> changed_components(const Overrides& changes) {
  std::vector<std::string> names;
  for (const auto& [name, file] : changes.with) names.push_back(name);
  for (const auto& [param, value] : changes.set) names.push_back(param.substr(0, param.find('.')));
  return names;
}

class Player {
 public:
  Player(const Recording& recording, const Graph& graph, const Overrides& changes, FlightOptions options,
         ReplayResult& result)
      : recording_(recording),
        result_(result),
        playback_(std::make_shared<Playback>(recording.path(), recording.survey(), graph,
                                             changed_components(changes))) {
    options.circumstances = playback_;
    options.duration_s = playback_->duration_s();
    options.resume = playback_->resume();
    options.interrupt = &signal_;
    flight_ = std::make_unique<Flight>(graph, options);
  }
  const Playback& playback() const { return *playback_; }
  std::unique_ptr<Flight> fly(const std::atomic<bool>* stop);

 private:
  void apply(Command command, std::uint64_t tick);

  const Recording& recording_;
  ReplayResult& result_;
  std::shared_ptr<Playback> playback_;
  std::atomic<int> signal_{0};
  std::unique_ptr<Flight> flight_;
};

void Player::apply(Command command, std::uint64_t tick) try {
  const CommandNote& note = command.note;
  if (command.kind == CommandKind::swap)
    command.name =
        recording_.plugin({command.component, note.text.data(), note.version.data(), note.sha256.data()})
            .string();
  flight_->apply(std::move(command));
} catch (const Error& fault) {
  result_.notes.push_back(replay_messages::input_not_repeatable(tick, fault.what()));
}

std::unique_ptr<Flight> Player::fly(const std::atomic<bool>* stop) {
  const std::uint64_t ticks = recording_.survey().ticks.count;
  bool goes_on = true;
  for (std::uint64_t tick = 0; goes_on && tick <= ticks; ++tick) {
    if (tick < ticks)
      playback_->begin_tick();
    else
      playback_->end();
    while (std::optional<Command> entry = playback_->entry()) apply(std::move(*entry), tick);
    if (stop && stop->load(std::memory_order_relaxed)) throw Error(replay_messages::replay_interrupted());
    if (tick < ticks && playback_->signalled()) signal_ = SIGINT;
    if (tick < ticks || playback_->vehicle_failed()) goes_on = flight_->step();
  }
  result_.flight = flight_->finish();
  return std::move(flight_);
}

/// Finds the differences between the log and that of the replay, up to the last tick of the log.
void find_differences(const fs::path& was, const fs::path& is, std::int64_t epoch_ns, ReplayResult& result) {
  const auto last_ns = static_cast<std::uint64_t>(result.last_ns + epoch_ns);
  const MessageDiff diff = diff_messages(was, is, {.last_ns = last_ns, .whole_topics = true});
  result.messages = diff.messages;
  result.differing_messages = diff.differing_messages;
  result.differing_bytes = diff.differing_bytes;
  if (diff.first_tick) {
    result.first_tick = diff.first_tick->index;
    result.first_tick_ns = diff.first_tick->time_ns;
  }
  if (!diff.first) return;
  const MessageDiff::First& first = *diff.first;
  const auto word = [&](const std::string& text) {
    return text == "absent" ? "none" : first.field.empty() ? "a sample" : text;
  };
  result.first = Difference{first.topic, first.field, word(first.a), word(first.b), first.time_ns};
}

}  // namespace

std::pair<std::unique_ptr<Flight>, ReplayResult> replay(const Recording& recording, const Graph& graph,
                                                        const ReplayOptions& options) {
  ReplayResult result;
  const TemporaryFolder folder;
  FlightOptions o;
  o.log_file = options.out.empty() ? folder.path / "replay.mcap" : options.out;
  o.progress = options.progress;
  Player player(recording, graph, options.changes, o, result);
  const Survey& log = recording.survey();
  result.notes = player.playback().gaps();
  result.cut_off = !log.log.complete;
  result.recorded_ticks = log.ticks.count;
  result.first_ns = log.ticks.first_ns;
  result.last_ns = log.ticks.last_ns;
  std::unique_ptr<Flight> flight = player.fly(options.stop);
  result.ticks = result.flight.ticks;
  if (!result.flight.log.error.empty())
    throw Error(replay_messages::replay_log_failed(result.flight.log.error));
  if (options.look) options.look(result.flight.log.file);
  if (!options.compare) return {std::move(flight), std::move(result)};
  // A log that was cut off may have gigabytes of holes, so files are compared only when the sizes are equal.
  std::error_code fault;
  result.same_file = fs::file_size(recording.path(), fault) == result.flight.log.bytes && !fault &&
                     result.flight.log.sha256 == sha256_file(recording.path());
  if (result.same_file) {
    result.messages = log.messages;
  } else {
    find_differences(recording.path(), result.flight.log.file, graph.epoch_ns, result);
  }
  return {std::move(flight), std::move(result)};
}

}  // namespace fulmar::core

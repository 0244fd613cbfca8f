// SPDX-License-Identifier: BSD-3-Clause
// Altered inputs: logs for replay and `fulmar log`; plans for the planner. Each takes less than a gigabyte
// and five seconds, and ends in a result or a message.
#include "core/test/limits.hpp"

#include <doctest/doctest.h>

#include "core/log/test/log_kit.hpp"
#include "core/log/test/read_mcap.hpp"
#include "core/test/altered.hpp"
#include "tools/fulmar_log/export_log.hpp"
#include "tools/fulmar_log/info.hpp"
#include "tools/fulmar_log/recover.hpp"
#include "tools/fulmar_replay/replay.hpp"

namespace limits_test {

using namespace fulmar::core;
using namespace fulmar::core::test;
namespace fs = std::filesystem;

namespace {

const char* const hourglass = FULMAR_SOURCE_DIR "/configs/missions/hourglass.yaml";

/// A log of one second of flight.
fs::path flown(const fs::path& file) {
  FlightOptions o;
  o.duration_s = 1;
  o.log_file = file;
  o.log = true;
  Flight flight(load_mission(hourglass, {}), o);
  flight.run();
  return file;
}

/// Alters bytes of the file: most are covered by checksums, and are rejected.
void damage(const fs::path& log, const fs::path& to, Dice& dice) {
  std::string bytes = contents(log);
  for (std::size_t n = 1 + dice.below(8); n > 0; --n)
    bytes[dice.below(bytes.size())] = static_cast<char>(dice.below(256));
  if (dice.below(4) == 0) bytes.resize(dice.below(bytes.size()));
  store(to, bytes);
}

/// Alters contents under valid checksums: messages changed, lost and moved in time, attached texts, other
/// tables of fields.
void forge(const fs::path& log, const fs::path& to, Dice& dice) {
  const WholeLog file = read_mcap(log);
  fs::remove(to);
  McapWriter writer({.file = to, .zstd_level = 0});
  const std::size_t rare = 20 + dice.below(2000);
  for (const McapFile::Attachment& a : file.attachments) {
    std::string text = a.content;
    if (!text.empty() && dice.below(16) == 0) mutate(text, dice);
    writer.attach(a.name, a.media_type, text, a.log_ns);
  }
  for (const McapFile::Metadata& m : file.metadata) writer.metadata(m.name, m.pairs);
  std::map<std::uint16_t, std::uint16_t> schemas, channels;
  for (const auto& [id, s] : file.schemas) {
    std::string text = s.text;
    if (dice.below(200) == 0) mutate(text, dice);
    schemas[id] = writer.add_schema(s.name, s.encoding, text);
  }
  for (const auto& [id, c] : file.channels)
    channels[id] = writer.add_channel(schemas[c.schema], c.topic, c.encoding, c.metadata);
  for (const McapFile::Message& m : file.messages) {
    const bool other = dice.below(rare) == 0;
    if (other && dice.below(4) == 0) continue;
    const std::uint64_t log_ns = m.log_ns + (other && dice.below(4) == 0 ? dice.below(1u << 30) : 0);
    std::byte* const room = writer.begin_message(channels[m.channel], m.sequence, log_ns, m.publish_ns);
    std::copy(m.data.begin(), m.data.end(), room);
    if (other && !m.data.empty()) room[dice.below(m.data.size())] = static_cast<std::byte>(dice.below(256));
    writer.end_message(other && dice.below(4) == 0 ? dice.below(m.data.size() + 1) : m.data.size());
  }
  writer.close();
}

template <class Words>
void with_altered_logs(int many, const Words& words) {
  const Folder folder;
  const fs::path log = flown(folder.path / "whole.mcap"), altered = folder.path / "altered.mcap";
  Dice dice;
  for (int i = 0; i < many; ++i) {
    i % 2 == 0 ? damage(log, altered, dice) : forge(log, altered, dice);
    CAPTURE(i);
    CHECK(within_limits([&] {
      try {
        words(altered, folder.path / ("out" + std::to_string(i)));
      } catch (const Error&) {  // a sentence
      }
    }));
  }
}

}  // namespace

TEST_CASE("each altered log is flown again, or refused, within a gigabyte and five seconds") {
  const auto fly = [](const fs::path& log) {
    const Recording recording(log);
    return replay(recording, recording.mission({}, {}), {}).second;
  };
  const Folder folder;
  CHECK(fly(flown(folder.path / "whole.mcap")).equal());
  with_altered_logs(costly_mutants(), [&](const fs::path& log, const fs::path&) { fly(log); });
}

TEST_CASE("each altered log is described, recovered and exported within a gigabyte and five seconds") {
  with_altered_logs(mutants, [](const fs::path& log, const fs::path& out) {
    try {
      read_info(log);
    } catch (const Error&) {
    }
    try {
      recover_log(log, out.string() + ".mcap");
    } catch (const Error&) {
    }
    export_log(log, ExportForm::npz, out.string() + ".npz", {});
  });
}

TEST_CASE("each altered plan is taken by the planner, or refused, within a gigabyte and five seconds") {
  const Folder folder;
  const std::string good = contents(FULMAR_SOURCE_DIR "/configs/plans/hourglass.yaml");
  Dice dice;
  for (int i = 0; i < costly_mutants(); ++i) {
    std::string plan = good;
    for (std::size_t n = 1 + dice.below(3); n > 0; --n) mutate(plan, dice);
    if (i % 8 == 0) swell(plan, dice);
    store(folder.path / "plan.yaml", plan);
    CAPTURE(i);
    CHECK(within_limits([&] {
      try {
        Overrides o;
        o.set.emplace_back("plan.plan", (folder.path / "plan.yaml").string());
        Flight(load_mission(hourglass, o), {});
      } catch (const Error&) {  // a sentence
      }
    }));
  }
}

}  // namespace limits_test

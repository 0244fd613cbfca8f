// SPDX-License-Identifier: BSD-3-Clause
// Flights that are logged and replayed, for tests.
#pragma once
#include <iterator>

#include "core/log/test/read_mcap.hpp"
#include "core/run/test/lab.hpp"
#include "sdk/test/said.hpp"
#include "tools/fulmar_replay/replay.hpp"

namespace lab {

inline const std::string hourglass = FULMAR_SOURCE_DIR "/configs/missions/hourglass.yaml";

/// Standard output alone.
inline fulmar::test::Said run_fulmar(const std::string& words) {
  return fulmar::test::shell(FULMAR_BIN_DIR "/fulmar " + words + " 2>/dev/null");
}

inline std::string contents(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

inline fs::path fresh(const std::string& name) {
  const fs::path file = folder().path / name;
  fs::remove(file);
  fs::remove(file.string() + ".part");
  return file;
}

inline FlightOptions logged(const fs::path& file, double duration_s, double speed = 0) {
  FlightOptions o = options(duration_s);
  o.log = true;
  o.log_file = file;
  o.speed = speed;
  return o;
}

inline ReplayResult replay_of(const fs::path& log, const Overrides& changes = {}, const fs::path& out = {}) {
  const Recording recording(log);
  const Graph graph = recording.mission(changes, {});
  ReplayOptions o;
  o.changes = changes;
  o.out = out;
  return replay(recording, graph, o).second;
}

/// Both from end to end.
inline void check_equal(const ReplayResult& r, const fs::path& log, const fs::path& again) {
  CHECK(r.notes == std::vector<std::string>{});
  if (r.first_tick) MESSAGE("first tick " << *r.first_tick);
  if (r.first)
    MESSAGE(r.first->topic << " " << r.first->at_ns << " ns, " << r.first->field << ": " << r.first->was
                           << ", now " << r.first->is);
  CHECK(r.equal());
  CHECK(r.differing_bytes == 0);
  CHECK(contents(log) == contents(again));
  CHECK(fs::file_size(log) > 10'000);
}

}  // namespace lab

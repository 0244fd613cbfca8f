// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_campaign/campaign.hpp"

#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <memory>
#include <thread>
#include <vector>

#include "core/app/ends.hpp"
#include "core/app/program.hpp"
#include "core/app/result_file.hpp"
#include "core/app/session.hpp"
#include "core/error.hpp"
#include "core/sanitized.hpp"
#include "core/say.hpp"
#include "tools/fulmar_campaign/build.hpp"
#include "tools/fulmar_campaign/messages.hpp"
#include "tools/fulmar_campaign/seeds.hpp"

namespace fulmar::core {
namespace {

namespace fs = std::filesystem;

class Campaign {
 public:
  Campaign(const RunOptions& options, const ManyOptions& many, std::vector<std::uint64_t> seeds)
      : many_(many), seeds_(std::move(seeds)), json_(options.json), session_(options) {
    if (!seeds_.empty() && session_.graph().io == Io::fcu)
      throw CLI::ValidationError(campaign_messages::seeds_on_hardware().line());
    if (!many.build.empty())
      sources_ = std::make_unique<FileStamps>(
          source_files(fs::absolute(session_.graph().source.file).parent_path()));
  }

  /// Returns the exit code.
  int fly() {
    int worst = 0;
    const int flights = seeds_.empty() ? many_.repeat : static_cast<int>(seeds_.size());
    for (int flight = 1;; ++flight) {
      if (!seeds_.empty()) session_.set_seed(seeds_[static_cast<std::size_t>(flight - 1)]);
      const std::optional<int> code = session_.restarts() ? session_.fly_again() : session_.try_fly();
      worst = worse(worst, code.value_or(ExitCode::failed));
      if (session_.restarts()) continue;
      if (code == ExitCode::interrupted || (flights > 0 ? flight >= flights : !many_.watch)) break;
      if (flights > 0) {
        if (many_.watch) session_.take_changes();
      } else if (!wait_for_change()) {
        break;
      }
      alarm(0);
    }
    return worst;
  }

  bool print(ResultFile& output) const {
    const std::vector<nlohmann::json>& results = session_.results();
    if (seeds_.empty()) return output.write(results);
    if (!json_) std::printf("%s", spread_table(results).c_str());
    nlohmann::json all = spread(results);
    all["flights"] = results;
    return results.empty() || output.write(all);
  }

 private:
  bool wait_for_change();

  const ManyOptions& many_;
  const std::vector<std::uint64_t> seeds_;
  const bool json_;
  Session session_;
  std::unique_ptr<FileStamps> sources_;  // of the mission's folder, with --build
};

/// Waits until a file of the mission has changed and the mission is valid. Returns false when interrupted.
bool Campaign::wait_for_change() {
  say_aloud("\nwaiting for a change; Ctrl-C ends");
  std::string gone;
  while (signal_seen.load() == 0) {
    if (sources_)
      if (const auto changed = sources_->changed(); !changed.empty()) {
        say_aloud("changed: " + changed[0].filename().string() + "; building");
        if (!run_build(many_.build, signal_seen) && signal_seen.load() == 0)
          warn(campaign_messages::build_failed());
      }
    if (const auto changed = session_.stamps().changed(); !changed.empty() && session_.reload(changed))
      return true;
    const std::string missing = session_.stamps().missing().string();
    if (!missing.empty() && missing != gone) warn(campaign_messages::watched_file_missing(missing));
    gone = missing;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return false;
}

std::vector<std::uint64_t> valid_seeds(const std::string& text) try {
  return text.empty() ? std::vector<std::uint64_t>{} : parse_seeds(text);
} catch (const Error& fault) {
  throw CLI::ValidationError(fault.what());
}

}  // namespace

int fly_campaign(RunOptions options, const ManyOptions& many) {
  if (!many.build.empty() && !many.watch)
    throw CLI::ValidationError(campaign_messages::build_without_watch().line());
  const std::vector<std::uint64_t> seeds = valid_seeds(many.seeds);
  options.part = {many.repeat > 0  ? "this is one of the flights of --repeat"
                  : !seeds.empty() ? "this is one of the flights of --seeds"
                                   : "",
                  many.watch, !seeds.empty()};
  ResultFile output(options.json);
  handle_signals(false, 10);  // also during the set-up
  Campaign campaign(options, many, seeds);
  const int worst = campaign.fly();
  if (!campaign.print(output)) return ExitCode::failed;
#ifndef FULMAR_SANITIZED  // the sanitizer searches for leaks at the exit, which takes time
  expect_exit(worst);
#endif
  return worst;
}

}  // namespace fulmar::core

// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_replay/estimates.hpp"

#include <unistd.h>

#include <array>
#include <cstdio>
#include <memory>

#include "core/error.hpp"
#include "core/loader/home.hpp"
#include "core/loader/process.hpp"
#include "core/say.hpp"
#include "tools/fulmar_replay/messages.hpp"

namespace fulmar::core {
namespace {

struct Close {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

std::string contents(std::FILE* file) {
  std::string text;
  std::rewind(file);
  std::array<char, 4096> piece;
  for (std::size_t n = 0; (n = std::fread(piece.data(), 1, piece.size(), file)) > 0;)
    text.append(piece.data(), n);
  return text;
}

}  // namespace

std::string compared_estimates(const std::filesystem::path& before, const std::filesystem::path& now,
                               bool json, const std::atomic<bool>& stop) {
  using namespace std::chrono_literals;
  const std::filesystem::path program = own_program("fulmar-log");
  const std::unique_ptr<std::FILE, Close> out(program.empty() ? nullptr : std::tmpfile());
  if (!out) {
    warn(replay_messages::estimates_not_compared(program.empty() ? replay_messages::log_program_missing()
                                                                 : replay_messages::file_space_missing()));
    return "";
  }
  std::vector<std::string> words{"log",       "compare", before.string(), now.string(),
                                 "--changed", "--names", "before,now"};
  if (json) words.push_back("--json");
  ChildFiles files;
  files.out = fileno(out.get());
  files.error = STDERR_FILENO;
  Process process(program.string(), words, files);
  while (!process.wait(50ms))
    if (stop) throw Error(replay_messages::replay_interrupted());
  return process.signal() == 0 && process.exit_code() == 0 ? contents(out.get()) : "";
}

}  // namespace fulmar::core

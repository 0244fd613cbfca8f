// SPDX-License-Identifier: BSD-3-Clause
#include "core/app/run_command.hpp"

#include "core/app/ends.hpp"
#include "core/app/program.hpp"
#include "core/app/result_file.hpp"
#include "core/app/session.hpp"
#include "core/sanitized.hpp"

namespace fulmar::core {

int run_command(const RunOptions& options) {
  ResultFile output(options.json);
  handle_signals(false, 10);  // also during the set-up
  Session session(options);
  int worst = session.try_fly().value_or(ExitCode::failed);
  while (session.restarts()) worst = worse(worst, session.fly_again().value_or(ExitCode::failed));
  if (!output.write(session.results())) return ExitCode::failed;
#ifndef FULMAR_SANITIZED  // a sanitizer searches for leaks at the exit, which takes time
  expect_exit(worst);
#endif
  return worst;
}

}  // namespace fulmar::core

// SPDX-License-Identifier: BSD-3-Clause
#include "links/live/saving.hpp"

#include <unistd.h>

#include <nlohmann/json.hpp>
#include <utility>

#include "core/error.hpp"
#include "core/loader/home.hpp"
#include "core/loader/memory_file.hpp"
#include "core/loader/process.hpp"
#include "fulmar/quiet_thread.hpp"
#include "links/live/describe.hpp"
#include "links/live/messages.hpp"

namespace fulmar::core::live {
namespace {

using nlohmann::json;

std::string answer_of_program(const std::string& request, std::chrono::seconds limit) {
  const std::string program = own_program("fulmar-save", "FULMAR_SAVE").string();
  if (program.empty()) throw Error(live_messages::save_program_missing());
  const MemoryFile in(request), out;
  ChildFiles files;
  files.in = in.descriptor();
  files.out = out.descriptor();
  files.error = STDERR_FILENO;
  Process process(program, {}, files);
  if (!process.wait(limit)) throw Error(live_messages::save_timed_out(program, limit.count()));
  if (process.signal() != 0) throw Error(live_messages::save_program_killed(program, process.signal()));
  if (process.exit_code() != 0) throw Error(live_messages::save_program_failed(program, process.exit_code()));
  return out.contents();
}

}  // namespace

SaveAnswer save(const FlightView& view, const std::string& component, const std::string& mark,
                std::chrono::seconds limit) noexcept {
  SaveAnswer answer;
  try {
    if (!view.no_save.empty()) throw Error(live_messages::save_not_allowed(view.no_save));
    if (view.file.empty()) throw Error(live_messages::mission_file_missing());
    const json reply = json::parse(answer_of_program(dumped(save_request(view, component, mark)), limit));
    answer = {reply.at("accepted"), reply.at("reason"), reply.at("lines"), reply.at("mark")};
  } catch (const json::exception&) {
    answer.reason = live_messages::save_answer_invalid();
  } catch (const std::exception& fault) {
    answer.reason = fault.what();
  }
  return answer;
}

void Saving::begin(FlightView view, std::string component, std::string mark,
                   std::function<void(const SaveAnswer&)> answer) {
  if (busy_->exchange(true)) throw Error(live_messages::save_in_progress());
  // The thread holds only `busy_` of this object, so that a hanging disk does not delay the end of the
  // flight.
  quiet_thread("fulmar-save", [busy = busy_, view = std::move(view), component = std::move(component),
                               mark = std::move(mark), answer = std::move(answer)] {
    const SaveAnswer reply = save(view, component, mark);
    busy->store(false);
    answer(reply);
  }).detach();
}

}  // namespace fulmar::core::live

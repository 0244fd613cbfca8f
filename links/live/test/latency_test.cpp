// SPDX-License-Identifier: BSD-3-Clause
// Wall-clock time that other clients wait while one client sends messages of a megabyte.
#include <algorithm>
#include <atomic>
#include <thread>

#include "links/live/test/server_fixture.hpp"

namespace latency_test {

using namespace fulmar::core::live_server;
using Clock = std::chrono::steady_clock;

namespace {

constexpr double limit_s = 0.1;
constexpr double ci_slowdown = 10;  // other programs use both processors as well

double seconds_of(const std::function<void()>& what) {
  const auto begin = Clock::now();
  what();
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// Messages of almost a megabyte, the largest size: of each kind one with unknown names and one with valid
/// names.
std::vector<std::pair<std::string, std::string>> large_messages() {
  constexpr std::size_t size = 1'000'000;
  const auto filled = [](const std::string& begin, const auto& item, const std::string& end) {
    std::string text = begin;
    for (int i = 0; text.size() + 100 < size; ++i) text += (i > 0 ? "," : "") + item(i);
    return text + end;
  };
  const auto wrong = [](int i) { return "\"a_wrong_name_" + std::to_string(i) + "\""; };
  const auto right = [](int) { return std::string("\"slc.roll_kp\""); };
  const auto set = [](const std::string& name) {
    return [name](int i) { return R"({"name":")" + name + R"(","value":)" + std::to_string(i % 2) + "}"; };
  };
  const auto subscription = [](int i) {
    return R"({"id":)" + std::to_string(i) + R"(,"channelId":)" + std::to_string(i % 4 + 1) + "}";
  };
  const auto channel = [](int i) {
    return R"({"id":)" + std::to_string(i) + R"(,"topic":"x","encoding":"cdr","schemaName":""})";
  };
  const auto id = [](int i) { return std::to_string(i); };
  return {
      {"wrong names", filled(R"({"op":"getParameters","parameterNames":[)", wrong, "]}")},
      {"one name again and again", filled(R"({"op":"getParameters","parameterNames":[)", right, "]}")},
      {"wrong watches", filled(R"({"op":"subscribeParameterUpdates","parameterNames":[)", wrong, "]}")},
      {"one watch", filled(R"({"op":"subscribeParameterUpdates","parameterNames":[)", right, "]}")},
      {"watches ended", filled(R"({"op":"unsubscribeParameterUpdates","parameterNames":[)", wrong, "]}")},
      {"sets", filled(R"({"op":"setParameters","parameters":[)", set("slc.roll_kp"), "]}")},
      {"wrong sets", filled(R"({"op":"setParameters","parameters":[)", set("slc.roll_kb"), "]}")},
      {"subscriptions", filled(R"({"op":"subscribe","subscriptions":[)", subscription, "]}")},
      {"ends of them", filled(R"({"op":"unsubscribe","subscriptionIds":[)", id, "]}")},
      {"channels", filled(R"({"op":"advertise","channels":[)", channel, "]}")},
      {"ends of channels", filled(R"({"op":"unadvertise","channelIds":[)", id, "]}")},
      {"depth", R"({"op":"getParameters","parameterNames":)" + std::string(400'000, '[') +
                    std::string(400'000, ']') + "}"},
      {"one long name", R"({"op":"getParameters","parameterNames":[")" + std::string(900'000, 'x') + "\"]}"}};
}

/// Sends a message and reads the answers, until it is stopped.
struct Talker {
  Talker(const Fixture& f, const std::string& message)
      : thread_([this, &f, message] {
          while (!stop_) {
            try {
              Client client(f);
              client.say(message);
              ++sent_;
              client.say(R"({"op": "getParameters", "parameterNames": ["slc.on"], "id": "last"})");
              while (client.next("parameterValues").value("id", "") != "last") {
              }
            } catch (const std::exception&) {  // closed by the server: it connects again
            }
          }
        }) {}
  ~Talker() {
    stop_ = true;
    thread_.join();
  }
  int sent() const { return sent_; }

 private:
  std::atomic<bool> stop_ = false;
  std::atomic<int> sent_ = 0;
  std::thread thread_;
};

}  // namespace

TEST_CASE_FIXTURE(Fixture,
                  "while one client sends messages of a megabyte, another is answered, and accepted") {
  serve();
  for (const auto& [what, message] : large_messages()) {
    CAPTURE(what);
    double max_answer_s = 0, max_entry_s = 0;
    Client other(*this);
    const Talker talker(*this, message);
    for (int i = 0; i < 20; ++i) {
      max_answer_s = std::max(max_answer_s, seconds_of([&] {
                                other.say(R"({"op":"getParameters","parameterNames":["slc.on"]})");
                                other.next("parameterValues");
                              }));
      max_entry_s = std::max(max_entry_s, seconds_of([&] { Client(*this).next("serverInfo"); }));
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    CHECK(talker.sent() > 0);
    CHECK(max_answer_s < ci_slowdown * limit_s);
    CHECK(max_entry_s < ci_slowdown * limit_s);
    MESSAGE(what, ": answered within ", 1e3 * max_answer_s, " ms, let in within ", 1e3 * max_entry_s, " ms");
  }
}

}  // namespace latency_test

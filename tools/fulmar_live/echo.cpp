// SPDX-License-Identifier: BSD-3-Clause
// `fulmar echo`: messages as text, one JSON object per line, or CSV.
#include <cmath>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "core/types/text.hpp"
#include "core/types/wire.hpp"
#include "tools/fulmar_live/commands.hpp"
#include "tools/fulmar_live/message_text.hpp"
#include "tools/fulmar_live/messages.hpp"
#include "tools/fulmar_live/ports.hpp"
#include "tools/fulmar_live/session.hpp"

namespace fulmar::core {
namespace {

using nlohmann::ordered_json;

class Echo {
 public:
  Echo(Session& session, const EchoOptions& options) : session_(session), options_(options) {
    for (const std::string& name : options.ports) ports_.push_back(find_port(session, name));
    if (options.csv && ports_.size() > 1)
      for (const PortField& p : ports_)
        if (p.topic != ports_[0].topic)
          throw Error(remote_messages::csv_ports_differ(p.label, ports_[0].label));
    epoch_ns_ = session.epoch_ns();
    for (const PortField& p : ports_) session.subscribe(p.topic);
  }

  /// Runs until the requested number of samples has been printed.
  void run() {
    if (options_.csv) print_header();
    while (options_.count == 0 || printed_ < options_.count) {
      const auto sample = session_.next(std::chrono::milliseconds(500));
      report_silent();
      if (!sample) {
        std::fflush(stdout);
        continue;
      }
      heard_.insert(sample->topic);
      if (due(*sample)) print(*sample);
    }
    std::fflush(stdout);
  }

 private:
  /// Reports once: a port may publish rarely or never.
  void report_silent() {
    if (reported_ || std::chrono::steady_clock::now() - begin_ < std::chrono::seconds(2)) return;
    reported_ = true;
    for (const PortField& p : ports_)
      if (!heard_.contains(p.topic))
        std::fprintf(stderr, "%s\n", remote_messages::first_sample_awaited(p.label).text.c_str());
  }

  bool due(const Session::Sample& sample) {
    if (options_.rate_hz <= 0) return true;
    const auto period = static_cast<std::int64_t>(1e9 / options_.rate_hz);
    auto [next, first] = next_ns_.try_emplace(sample.topic, sample.time_ns);
    if (sample.time_ns < next->second) return false;
    next->second = std::max(next->second + period, sample.time_ns - period);  // no burst after a gap
    return true;
  }

  void print(const Session::Sample& sample) {
    const double time_s = static_cast<double>(sample.time_ns - epoch_ns_) * 1e-9;
    const TypePtr type = session_.type(sample.topic);
    message_.resize(type->size);
    cdr_decode(*type, sample.bytes.data(), sample.bytes.size(), message_.data());
    const ordered_json message = shown_json(*type, message_.data());
    if (options_.csv) return print_csv(message, time_s);
    for (const PortField& p : ports_) {
      if (p.topic != sample.topic || (options_.count > 0 && printed_ >= options_.count)) continue;
      const ordered_json part = part_of(message, p.field);
      if (options_.json)
        std::printf("%s\n",
                    ordered_json{{"port", p.label}, {"time_s", time_s}, {"value", part}}.dump().c_str());
      else if (part.is_object())
        std::printf("%.4f s  %s\n%s", time_s, p.label.c_str(), message_lines(part).c_str());
      else
        std::printf("%.4f s  %s  %s\n", time_s, p.label.c_str(), short_text(part).c_str());
      ++printed_;
    }
    std::fflush(stdout);
  }

  void print_header() const {
    std::string line = "time_s";
    for (const PortField& p : ports_) {
      const std::vector<std::string> names =
          p.field.empty() ? columns(*p.type, "") : std::vector{p.label.substr(port_of(p.topic).size() + 1)};
      for (const std::string& name : names) line += "," + csv_cell(name);
    }
    std::printf("%s\n", line.c_str());
  }

  void print_csv(const ordered_json& message, double time_s) {
    char time[32];
    std::snprintf(time, sizeof time, "%.9g", time_s);
    std::string line = time;
    for (const PortField& p : ports_) {
      const std::vector<std::string> values =
          p.field.empty() ? cells(*p.type, message) : std::vector{csv_cell(part_of(message, p.field))};
      for (const std::string& value : values) line += "," + value;
    }
    std::printf("%s\n", line.c_str());
    ++printed_;
  }

  Session& session_;
  const EchoOptions& options_;
  std::vector<PortField> ports_;
  std::map<std::string, std::int64_t> next_ns_;
  std::set<std::string> heard_;  // topics
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  bool reported_ = false;
  std::int64_t epoch_ns_ = 0;
  std::uint64_t printed_ = 0;
  std::vector<std::byte> message_;
};

}  // namespace

int echo_command(const LiveAddress& target, const EchoOptions& options) {
  Session session(target);
  Echo echo(session, options);
  try {
    echo.run();
    return 0;
  } catch (const FlightEnded& end) {
    std::fflush(stdout);
    std::fprintf(stderr, "%s\n", for_terminal(end.what()).c_str());
    return options.count > 0 ? 1 : 0;
  }
}

}  // namespace fulmar::core
